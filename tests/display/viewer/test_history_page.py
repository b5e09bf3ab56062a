"""A time history as frames and as a page: what moves is what the results say, and nothing else."""

from __future__ import annotations

import base64
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose, assert_array_equal

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.display.viewer import history_frames as frames_module
from offwind_pin.display.viewer.history_frames import frames, outline, surface_waves
from offwind_pin.display.viewer.history_page import (
    render_time_history,
    rim_of,
    sides_mesh,
    surface_mesh,
)
from offwind_pin.dynamics.acting_loads import smooth_ramp
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.surface import KEPT_SHARE, SurfaceWaves
from offwind_pin.structure.section import outer_diameter

RAMP = 4.0
SEAS: dict[str, Sea] = {
    "regular": ow.RegularWaves(3.0, 7.0, 60.0, water_level=1.5),
    "irregular": ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0, direction_deg=-30.0),
    "stream": ow.StreamWaves(8.0, 9.0, 20.0),
}


def history(turbine: ow.Turbine, sea: Sea | None, **settings: Any) -> xr.Dataset:
    system = ow.build(turbine, "clamped", sea, elements=6)
    return ow.simulate(system, 20.0, 0.05, ramp=RAMP, save_at=ow.SaveAt(0.1), **settings)


@pytest.fixture(scope="module")
def histories(undamped: ow.Turbine) -> dict[str, xr.Dataset]:
    return {name: history(undamped, sea) for name, sea in SEAS.items()}


@pytest.fixture(scope="module")
def page(histories: dict[str, xr.Dataset]) -> str:
    return render_time_history(histories["regular"], 5.0, 10.0)


def part_of(page: str, name: str) -> Any:
    """A constant of the page's script."""
    found = re.search(rf"const {name} = (.*);\n", page)
    assert found is not None
    return json.loads(found.group(1))


class TestSurfaceWaves:
    @pytest.mark.parametrize("name", SEAS)
    def test_results_hold_the_elevation_at_the_axis(
        self, histories: dict[str, xr.Dataset], name: str
    ) -> None:
        """The components give back the channel, the ramp included."""
        data = histories[name]
        waves = surface_waves(data)
        assert waves is not None
        time = data.time.values
        found = waves.at(time, np.zeros(1), np.zeros(1))[:, 0, 0] * smooth_ramp(time, RAMP)
        assert_allclose(found, data.wave_elevation, atol=1e-9)

    def test_a_regular_wave_travels_as_airys(self, histories: dict[str, xr.Dataset]) -> None:
        """a cos(w t - k (x cos 60 + y sin 60)) at any place, over the depth at that level."""
        waves = surface_waves(histories["regular"])
        assert waves is not None
        omega = 2 * np.pi / 7.0
        k = wave_number(np.array([omega]), 31.5, 9.80665)[0]
        time, x, y = np.array([0.3, 9.0]), np.linspace(-70, 70, 5), np.linspace(-60, 50, 4)
        way = np.cos(np.radians(60)) * x[:, None] + np.sin(np.radians(60)) * y
        exact = 1.5 * np.cos(omega * time[:, None, None] - k * way)
        assert_allclose(waves.at(time, x, y), exact, atol=2e-4)

    def test_a_steady_wave_keeps_its_shape(self, histories: dict[str, xr.Dataset]) -> None:
        """A third of a period later the same profile stands a third of a wave further on."""
        waves = surface_waves(histories["stream"])
        assert waves is not None
        first = int(np.argmax(np.abs(waves.elevation)))
        number = np.hypot(waves.number_x[first], waves.number_y[first])
        further = 2 * np.pi / number / 3
        x, y = further * np.cos(np.radians(20)), further * np.sin(np.radians(20))
        time = np.linspace(0, 9.0, 13)
        here = waves.at(time, np.zeros(1), np.zeros(1))[:, 0, 0]
        there = waves.at(time + 3.0, np.array([x]), np.array([y]))[:, 0, 0]
        assert_allclose(there, here, atol=1e-6)
        # negative control: free waves of its frequencies would not keep it
        free = SurfaceWaves(
            waves.frequency,
            waves.elevation,
            wave_number(2 * np.pi * waves.frequency, 30.0, 9.80665),
            0 * waves.number_x,
        )
        length = 2 * np.pi / free.number_x[first] / 3
        assert not np.allclose(
            free.at(time + 3.0, np.array([length]), np.zeros(1))[:, 0, 0], here, atol=0.05
        )

    def test_the_fewest_that_hold_the_variance_are_kept(self) -> None:
        rng = np.random.default_rng(0)
        harmonic = np.arange(20.0, 520.0)
        elevation = rng.rayleigh(size=500) * np.exp(-harmonic / 80) + 0j
        waves = SurfaceWaves.of(LinearWaves.free(600.0, harmonic, elevation, 30.0, 9.81))
        assert waves is not None
        power = np.abs(elevation) ** 2
        kept = waves.largest(most=100)
        held = np.abs(kept.elevation) ** 2
        assert held.sum() >= KEPT_SHARE * power.sum()
        assert held.sum() - held.min() < KEPT_SHARE * power.sum()
        assert np.all(np.diff(kept.frequency) > 0)
        assert len(kept.frequency) < 500
        assert waves.largest(most=500) is waves

    def test_short_waves_are_left_out(self, histories: dict[str, xr.Dataset]) -> None:
        waves = surface_waves(histories["irregular"])
        assert waves is not None
        longer = waves.longer_than(20.0)
        length = 2 * np.pi / np.hypot(longer.number_x, longer.number_y)
        assert 0 < len(longer.frequency) < len(waves.frequency)
        assert length.min() >= 20.0

    def test_still_and_dry_have_none(self, undamped: ow.Turbine) -> None:
        for sea in (None, ow.StillWater(water_level=2.0)):
            data = history(undamped, sea)
            assert surface_waves(data) is None
            shown = frames(data, 0.0, 5.0)
            assert shown.sea is None
            page = render_time_history(data, 0.0, 5.0)
            assert ("+2.00 m" in page) == (sea is not None)
            assert ("The sea is to scale" in page) == (sea is not None)


class TestFrames:
    def test_are_the_results_at_their_times(self, histories: dict[str, xr.Dataset]) -> None:
        data = histories["regular"]
        shown = frames(data, 5.0, 10.0)
        assert_allclose(shown.time, np.arange(5.0, 15.01, 0.2))
        there = data.sel(time=shown.time, method="nearest")
        assert_array_equal(shown.displacement, there.displacement)
        assert_array_equal(shown.elevation, there.wave_elevation)
        assert_array_equal(shown.moment, there.mudline_moment[:, :2])

    def test_sea_at_the_axis_is_the_elevation(self, histories: dict[str, xr.Dataset]) -> None:
        """In the ramp too; the middle of the patch is the axis."""
        shown = frames(histories["regular"], 0.0, 10.0)
        assert shown.sea is not None
        middle = len(shown.x) // 2
        assert (shown.x[middle], shown.y[middle]) == (0.0, 0.0)
        assert_allclose(shown.sea[:, middle, middle], shown.elevation, atol=1e-9)
        assert abs(shown.sea[0]).max() < 1e-12 < 0.5 < abs(shown.sea[-1]).max()

    def test_long_parts_have_fewer_frames_and_very_long_ones_none(
        self, histories: dict[str, xr.Dataset], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        data = histories["regular"]
        monkeypatch.setattr(frames_module, "MOST_HEIGHTS", 61 * 61 * 40)
        shown = frames(data, 5.0, 15.0)
        assert shown.sea is not None
        assert 30 <= len(shown.time) <= 40
        assert_allclose(np.diff(shown.time), 0.4)
        monkeypatch.setattr(frames_module, "MOST_HEIGHTS", 61 * 61 * 20)
        with pytest.raises(ow.InputError, match="at most 10 s"):
            frames(data, 5.0, 15.0)

    @pytest.mark.parametrize(("start", "duration"), [(-1, 5), (18, 5), (5, 0.01), (25, 1)])
    def test_parts_that_are_not_there(
        self, histories: dict[str, xr.Dataset], start: float, duration: float
    ) -> None:
        with pytest.raises(ow.InputError, match="0 to 20 s"):
            frames(histories["regular"], start, duration)

    def test_results_that_hold_no_outline(self, histories: dict[str, xr.Dataset]) -> None:
        older = histories["regular"].drop_vars(["outline_height", "outline_diameter"])
        with pytest.raises(ow.InputError, match="outline_height, outline_diameter"):
            frames(older, 5.0, 5.0)

    def test_outline_is_the_wall(
        self, histories: dict[str, xr.Dataset], undamped: ow.Turbine
    ) -> None:
        height, radius = outline(histories["regular"], 2.5)
        assert np.diff(height).max() <= 2.5 + 1e-9
        assert (height[0], height[-1]) == (-30.0, 115.63)
        inside = np.diff(height, prepend=-np.inf, append=np.inf)
        single = (inside[:-1] > 1e-6) & (inside[1:] > 1e-6)
        exact = outer_diameter(undamped, height[single]) / 2
        assert_allclose(radius[single], exact, rtol=1e-9)


class TestPage:
    def test_holds_the_frames(self, page: str, histories: dict[str, xr.Dataset]) -> None:
        """Displacements in single precision, the sea to a part in 65 000."""
        motion = part_of(page, "motion")
        shown = frames(histories["regular"], 5.0, 10.0)
        assert shown.sea is not None
        moved = np.frombuffer(base64.b64decode(motion["displacement"]), "<f4")
        assert_array_equal(moved, shown.displacement.astype("<f4").ravel())
        sea = np.frombuffer(base64.b64decode(motion["sea"]), "<i2") * motion["unit"]
        assert_allclose(sea, shown.sea.ravel(), atol=np.abs(shown.sea).max() / 65000)
        assert motion["level"] == 1.5

    def test_is_whole_and_small(self, page: str) -> None:
        assert "Content-Security-Policy" in page
        assert len(page) < 4e6
        body = page[: page.index("<script>")]
        assert "http:" not in body
        assert "https:" not in body

    def test_names_are_escaped(self, histories: dict[str, xr.Dataset]) -> None:
        hostile = histories["regular"].assign_attrs(
            case="</script><script>alert(1)</script>", turbine='"><img src=x>'
        )
        text = render_time_history(hostile, 5.0, 2.0)
        assert "<script>alert(1)" not in text
        assert "<img src=x>" not in text

    def test_of_a_file_is_that_of_memory(
        self, undamped: ow.Turbine, tmp_path: Path, histories: dict[str, xr.Dataset]
    ) -> None:
        """Results alone are enough: nothing of the run is at hand."""
        history(undamped, SEAS["regular"], directory=tmp_path).close()
        with xr.open_dataset(tmp_path / "results.nc") as data:
            motion = part_of(render_time_history(data, 5.0, 10.0), "motion")
        same = part_of(render_time_history(histories["regular"], 5.0, 10.0), "motion")
        assert motion["sea"] == same["sea"]
        assert motion["time"] == same["time"]

    def test_surrogates_are_reported(self, histories: dict[str, xr.Dataset]) -> None:
        data = histories["regular"]
        assert data.attrs["surrogates"] == "none"
        assert "Surrogate data" not in render_time_history(data, 5.0, 2.0)
        reported = data.assign_attrs(surrogates="soil made up | load made up")
        text = render_time_history(reported, 5.0, 2.0)
        assert "Soil made up." in text
        assert "Load made up." in text

    def test_what_does_not_change_is_a_level_line(self, undamped: ow.Turbine) -> None:
        """The rounding of a structure at rest is not blown up to fill the chart."""
        text = render_time_history(history(undamped, None), 5.0, 10.0)
        points = re.findall(r'<polyline points="([^"]*)"', text)
        assert len(points) == 2
        for curve in points:
            heights = {float(pair.split(",")[1]) for pair in curve.split()}
            assert heights == {17.0}

    def test_displacements_are_enlarged_to_be_seen(
        self, page: str, histories: dict[str, xr.Dataset]
    ) -> None:
        factor = int(re.search(r'id="factor">.*?<option selected>(\d+)<', page, re.S)[1])  # type: ignore[index]
        largest = float(np.abs(histories["regular"].displacement.values).max())
        assert 0.01 < factor * largest / 145.63 < 0.045


class TestMeshes:
    def test_surface_is_level_and_seen_from_above(self) -> None:
        mesh = surface_mesh(np.array([-1.0, 0, 2]), np.array([0.0, 3, 4, 5]), 7.0)
        corner = mesh.vertices[mesh.faces]
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]) / 2
        assert_allclose(normal.sum(axis=0), [0, 0, 15.0])
        assert np.all(normal[:, 2] > 0)

    def test_sides_close_the_water(self) -> None:
        """Surface, sides and ground enclose length by breadth by depth."""
        x: Array = np.linspace(-3, 3, 5)
        y: Array = np.linspace(-2, 2, 4)
        surface, ground = surface_mesh(x, y, 1.0), surface_mesh(x, y, -9.0)
        sides = sides_mesh(surface, rim_of(5, 4), -9.0)
        assert surface.volume + sides.volume - ground.volume == pytest.approx(6 * 4 * 10)
