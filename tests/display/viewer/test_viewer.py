"""What ``offwind view`` makes of results: shapes, stills, films, and messages; nothing is solved."""

from __future__ import annotations

import re
from dataclasses import replace
from html import unescape
from pathlib import Path
from typing import Any

import matplotlib.image
import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import modes_dataset, static_dataset
from offwind_pin.base.mode_labels import mode_family
from offwind_pin.base.whole_files import write_netcdf
from offwind_pin.display.viewer import picture as pictures
from offwind_pin.display.viewer.history_frames import frames
from offwind_pin.display.viewer.history_page import ARROW_SHARE, TOP_COLOUR, curves
from offwind_pin.display.viewer.history_picture import HistoryPicture
from offwind_pin.display.viewer.mode_frames import PEAK_TILT, shapes
from offwind_pin.display.viewer.modes_picture import ModesPicture
from offwind_pin.display.viewer.picture import write_frames
from offwind_pin.display.viewer.view import View


@pytest.fixture(scope="module")
def modal(coupled_wet: ow.System) -> xr.Dataset:
    return modes_dataset(coupled_wet, ow.modes(coupled_wet, 8))


@pytest.fixture(scope="module")
def history(undamped: ow.Turbine) -> xr.Dataset:
    """A wave and an oblique load on soil."""
    sea = ow.RegularWaves(6.0, 8.0, direction_deg=60.0)
    system = ow.build(undamped, "distributed_springs", sea, elements=10)
    load = np.array([9e5, -4e5, 2e5, 0, 0, 0])
    return ow.simulate(system, 12.0, 0.05, [load], ramp=4.0, save_at=ow.SaveAt(0.2))


@pytest.fixture(scope="module")
def run(history: xr.Dataset, modal: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory with ``history/results.nc`` and ``modes/results.nc``."""
    folder = tmp_path_factory.mktemp("run")
    write_netcdf(folder / "history" / "results.nc", history)
    write_netcdf(folder / "modes" / "results.nc", modal)
    return folder


@pytest.fixture
def nothing_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever builds a system or asks for modes, statics or time fails the test."""

    def refuse(*_: Any, **__: Any) -> None:
        raise AssertionError("something was solved")

    for name in (
        "analysis.build.build",
        "analysis.modal.modes",
        "analysis.static.static",
        "cases.run.run_case",
        "definitions.reader.load_turbine",
    ):
        monkeypatch.setattr(f"offwind_pin.{name}", refuse)


class TestShapes:
    def test_are_the_modes_at_a_size_to_be_seen(self, modal: xr.Dataset) -> None:
        """Proportional to the shape at element boundaries; the peak as high as it may be."""
        shown = shapes(modal)
        size = float(np.ptp(modal.height.values))
        inside = [
            i for i, z in enumerate(shown.height) if np.abs(modal.height.values - z).min() < 1e-9
        ]
        assert len(inside) >= 5
        for i, label in enumerate(shown.label):
            shape = modal["shape"].sel(height=shown.height[inside], method="nearest").values[i]
            scale = (
                shown.motion[i, -1, :]
                @ modal["shape"].values[i, -1]
                / np.sum(modal["shape"].values[i, -1] ** 2)
            )
            assert_allclose(shown.motion[i, inside], scale * shape, atol=1e-9 * abs(scale))
            tilt = np.linalg.norm(scale * modal["shape"].values[i, :, 3:5], axis=1).max()
            if mode_family(label) == "T":
                assert shown.peak[i] == pytest.approx(np.radians(30))
            else:
                assert max(shown.peak[i] / (0.08 * size), tilt / PEAK_TILT) == pytest.approx(1)
            assert 0.97 < shown.share[i].max() <= 1 + 1e-12

    def test_first_that_bend_are_chosen(self, modal: xr.Dataset) -> None:
        shown = shapes(modal)
        names = [shown.label[i] for i in shown.chosen(None, 4)]
        assert names == ["FA1", "SS1", "FA2", "SS2"]
        assert [shown.label[i] for i in shown.chosen(["T1", "FA1"], 4)] == ["T1", "FA1"]

    @pytest.mark.parametrize(
        ("labels", "told"),
        [(["FA9"], "FA9"), (["FA1", "FA1"], "different"), ([""], "modes"), (["FA1"] * 5, "1 to 4")],
    )
    def test_others_are_refused(self, modal: xr.Dataset, labels: list[str], told: str) -> None:
        with pytest.raises(ow.InputError, match=told):
            shapes(modal).chosen(labels, 4)

    def test_modes_that_hold_no_outline(self, modal: xr.Dataset) -> None:
        with pytest.raises(ow.InputError, match="outline_height"):
            shapes(modal.drop_vars(["outline_height", "outline_diameter"]))


def orange(picture: HistoryPicture) -> np.ndarray:
    """Centre of the pixels of the arrow at the tower top, in the scene's coordinates."""
    picture._tag.set_visible(False)
    for cursor in picture._cursors:
        cursor.set_visible(False)
    pixels = picture.pixels().astype(float) / 255
    red, green, blue = np.moveaxis(pixels, 2, 0)
    rows, columns = np.nonzero((red > 0.6) & (green < 0.5 * red) & (blue < 0.1 * red))
    assert len(rows) > 50
    height, breadth = pixels.shape[:2]
    place = np.column_stack([columns / breadth, 1 - rows / height])
    return np.asarray(
        picture.scene.transData.inverted().transform(
            picture.figure.transFigure.transform(place.mean(axis=0))
        )
    )


class TestStills:
    def test_the_arrow_stands_where_the_results_have_the_tower_top(
        self, history: xr.Dataset
    ) -> None:
        """Pixels of its colour lie about it, seen through the camera, at two moments apart."""
        assert TOP_COLOUR == 0xD55E00
        shown = frames(history, 4.0, 8.0)
        lean = (shown.height - shown.height[0]) / np.ptp(shown.height)
        way = np.linspace(-1, 1, len(shown.time))[:, None, None] * np.array([12.0, -9.0, 0.0])
        shown = replace(shown, displacement=way * lean[:, None])
        picture = HistoryPicture(history, shown)
        assert picture.factor == 1
        centres, expected = [], []
        for k in (0, len(shown.time) - 1):
            picture.show(float(shown.time[k]))
            centres.append(orange(picture))
            root = shown.displacement[k, -1] + [0, 0, shown.height[-1]]
            force = shown.top_force[k] / np.linalg.norm(shown.top_force[k])
            length = ARROW_SHARE * np.ptp(shown.height)
            expected.append(picture.camera.project(root + 0.7 * length * force)[:2])
        assert_allclose(centres, expected, atol=0.012)  # the nacelle hides some of it
        moved = np.subtract(*expected)
        assert np.linalg.norm(moved) > 0.03
        assert_allclose(np.subtract(*centres), moved, atol=0.006)

    def test_png_and_svg(self, history: xr.Dataset, tmp_path: Path) -> None:
        view = View(history, 4.0, 4.0)
        view.still(tmp_path / "a.png")
        view.still(tmp_path / "a.svg")
        image = matplotlib.image.imread(tmp_path / "a.png")
        assert image.shape[:2] == (1080, 1920)
        assert np.ptp(image[:, 700:]) > 0.5
        assert "bending moment" in (tmp_path / "a.svg").read_text()
        assert sorted(path.name for path in tmp_path.iterdir()) == ["a.png", "a.svg"]

    def test_shows_the_start_or_the_largest_moment(
        self, history: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        seen: list[float] = []
        monkeypatch.setattr(HistoryPicture, "show", lambda self, now: seen.append(now))
        monkeypatch.setattr(pictures, "imsave", lambda path, *_, **__: Path(path).touch())
        View(history, 5.0, 4.0).still(tmp_path / "a.png")
        View(history).still(tmp_path / "b.png")
        later = history.sel(time=slice(4.0, 12.0)).mudline_moment.sel(direction=["x", "y"])
        size = np.linalg.norm(later.values, axis=1)
        assert seen == [5.0, pytest.approx(later.time.values[np.argmax(size)])]

    def test_modes_move_by_their_shapes(self, modal: xr.Dataset) -> None:
        """Painted vertices at the peak are mirrored half a cycle later; at rest the two agree."""
        shown = shapes(modal)
        picture = ModesPicture(modal, shown, [shown.index("FA1")], 1.0)
        kept: list[np.ndarray] = []
        picture.paint = lambda surfaces: kept.append(surfaces[0].mesh.vertices)  # type: ignore[method-assign]
        period = 1 / shown.frequency_hz[shown.index("FA1")]
        for now in (0.0, period / 4, 3 * period / 4, np.inf):
            picture.show(now)
        rest, one, other, peak = (v.reshape(len(shown.height), -1, 3).mean(axis=1) for v in kept)
        assert_allclose(
            rest, np.column_stack([0 * shown.height, 0 * shown.height, shown.height]), atol=1e-9
        )
        assert_allclose(one + other, 2 * rest, atol=1e-9)
        assert_allclose(one, peak, atol=1e-9)
        assert_allclose(peak - rest, shown.motion[shown.index("FA1"), :, :3], atol=1e-9)


class TestFilms:
    def test_frames_are_numbered_and_of_one_size(self, modal: xr.Dataset, tmp_path: Path) -> None:
        told: list[tuple[int, int]] = []
        View(modal, duration=0.5, labels=["FA1"]).film(
            tmp_path / "film", 6, lambda *count: told.append(count)
        )
        names = sorted(path.name for path in (tmp_path / "film").iterdir())
        assert names == ["frame_00001.png", "frame_00002.png", "frame_00003.png"]
        images = [matplotlib.image.imread(tmp_path / "film" / name) for name in names]
        assert {image.shape[:2] for image in images} == {(720, 1280)}
        assert np.abs(images[0] - images[2]).max() > 0.3
        assert told == [(1, 3), (2, 3), (3, 3)]
        assert [path.name for path in tmp_path.iterdir()] == ["film"]

    def test_nothing_is_left_of_half_a_film(self, modal: xr.Dataset, tmp_path: Path) -> None:
        def stop(written: int, count: int) -> None:
            if written == 2:
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            View(modal, duration=1.0, labels=["FA1"]).film(tmp_path / "film", 3, stop)
        assert list(tmp_path.iterdir()) == []

    def test_a_folder_that_holds_something_is_left_alone(
        self, modal: xr.Dataset, tmp_path: Path
    ) -> None:
        (tmp_path / "mine.txt").write_text("mine")
        shown = shapes(modal)
        with pytest.raises(ow.InputError, match="empty"):
            write_frames(ModesPicture(modal, shown, [0], 1.0), tmp_path, np.zeros(1))
        assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]

    def test_history_in_real_time(
        self, history: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        seen: list[float] = []
        monkeypatch.setattr(HistoryPicture, "show", lambda self, now: seen.append(now))
        monkeypatch.setattr(HistoryPicture, "pixels", lambda self: np.zeros((2, 2, 3), np.uint8))
        View(history, 5.0, 2.0).film(tmp_path / "film", 8)
        assert_allclose(seen, 5 + np.arange(16) / 8)


class TestView:
    def test_window(self, history: xr.Dataset, modal: xr.Dataset) -> None:
        """What follows the ramp, no longer than there is."""
        assert View(history).window() == (4.0, pytest.approx(8.0))
        assert View(history, 2.0, 3.0).window() == (2.0, 3.0)
        assert View(modal).window() == (0.0, 8.0)

    def test_a_state_does_not_move(self, coupled_wet: ow.System) -> None:
        state = static_dataset(coupled_wet, ow.static(coupled_wet))
        with pytest.raises(ow.InputError, match="can be animated"):
            View(state)

    def test_curves_have_all_outputs(self, history: xr.Dataset) -> None:
        """Their range is that of the results, of which the frames are fewer."""
        fewer = frames(history, 4.0, 8.0, rate=1.0)
        time, channels = curves(history, fewer)
        part = history.sel(time=slice(4.0, 12.0))
        assert_allclose(time, part.time)
        moment = part.mudline_moment.sel(direction="y").values / 1e6
        assert_allclose(dict(channels)["mudline moment My, MN m"], moment)
        assert len(fewer.time) < len(time) / 3
        assert np.ptp(fewer.moment[:, 1] / 1e6) < 0.999 * np.ptp(moment)

    def test_soil_that_older_files_lack(self, history: xr.Dataset) -> None:
        """Without ``soil_force`` there are no arrows, and nothing else is missing."""
        page = View(history, 4.0, 4.0).page()
        assert "soil on the pile, at most" in page
        older = View(history.drop_dims("soil_node"), 4.0, 4.0).page()
        assert "soil on the pile" not in older
        assert "bending moment" in older

    def test_loads_that_the_channel_does_not_hold_are_told(self, history: xr.Dataset) -> None:
        note = "prescribed loads, which exclude the thrust of the rotor"
        told = history.assign_attrs(tower_top_load_holds=note)
        assert note in unescape(View(told, 4.0, 4.0).page())
        without = told.assign(tower_top_load=0 * told.tower_top_load)
        page = View(without, 4.0, 4.0).page()
        assert note in unescape(page)
        assert "applied tower-top load" not in page

    @pytest.mark.parametrize(
        ("foundation", "sea"),
        [("clamped", None), ("coupled_springs", ow.StillWater(water_level=2.0))],
    )
    def test_with_little_to_show(
        self, undamped: ow.Turbine, tmp_path: Path, foundation: str, sea: ow.StillWater | None
    ) -> None:
        """No load, no soil, a sea that is dry or does not move: page, still and film all the same."""
        data = ow.simulate(ow.build(undamped, foundation, sea, elements=6), 1.0, 0.05)
        view = View(data)
        view.still(tmp_path / "a.png")
        view.film(tmp_path / "film", 1)
        page = view.page()
        assert '"top_force": null' in page
        assert '"soil_height": []' in page
        assert ("+2.00 m" in page) == (sea is not None)

    def test_names_are_escaped(self, modal: xr.Dataset) -> None:
        hostile = modal.assign_attrs(
            case="</script><script>alert(1)</script>", turbine='"><img src=x>'
        )
        page = View(hostile).page()
        assert "<script>alert(1)" not in page
        assert "<img src=x>" not in page

    def test_torsion_and_dry(self, clamped_dry: ow.System, tmp_path: Path) -> None:
        data = modes_dataset(clamped_dry, ow.modes(clamped_dry, 6))
        page = View(data, labels=["T1"]).page()
        assert "still water" not in page
        assert re.search(r'"first": \[(\d)\]', page)[1] == str(shapes(data).index("T1"))  # type: ignore[index]
        View(data, labels=["T1"]).still(tmp_path / "t.png")


class TestCommand:
    @pytest.mark.usefixtures("nothing_solved")
    def test_results_alone_are_enough(self, offwind: Any, run: Path, tmp_path: Path) -> None:
        """Page, still and film of a directory, and the same page of the file in it."""
        html, again = tmp_path / "a.html", tmp_path / "b.html"
        still, film = tmp_path / "a.png", tmp_path / "film"
        window = ["--start", "4", "--duration", "0.4"]
        code, out, err = offwind(
            "view", str(run / "history"), "--html", str(html), "--still", str(still),
            "--frames", str(film), "--fps", "5", *window,
        )  # fmt: skip
        assert (code, err.count("Traceback")) == (0, 0)
        assert "ffmpeg -framerate 5" in out
        assert len(list(film.iterdir())) == 2
        assert still.stat().st_size > 1e5
        code, _, _ = offwind(
            "view", str(run / "history" / "results.nc"), "--html", str(again), *window
        )
        assert code == 0
        same = [re.search(r"const motion = .*;", path.read_text())[0] for path in (html, again)]  # type: ignore[index]
        assert same[0] == same[1]
        code, _, _ = offwind("view", str(run / "modes"), "--html", str(html))
        assert code == 0
        assert "Natural modes" in html.read_text()

    def test_a_turbine_is_solved_for_its_modes(
        self, offwind: Any, tmp_path: Path, nothing_solved: None
    ) -> None:
        """Negative control: here the check of solving strikes."""
        with pytest.raises(AssertionError, match="something was solved"):
            offwind("view", "oc6_phase2", "--html", str(tmp_path / "a.html"))

    @pytest.mark.parametrize(
        ("words", "told"),
        [
            (["nowhere", "--html", "a.html"], "nowhere"),
            (["nowhere.nc", "--html", "a.html"], "nowhere.nc"),
            ([".", "--html", "a.html"], "results.nc"),
            (["text.nc", "--html", "a.html"], "NetCDF"),
            (["other.nc", "--html", "a.html"], "offwind-pin"),
            (["history", "--html", "."], "file name"),
            (["history", "--still", "a.gif"], ".png or .svg"),
            (["history", "--frames", "full"], "empty directory"),
            (["history", "--frames", "f", "--fps", "0"], "--fps"),
            (["history", "--html", "a.html", "--start", "50"], "0 to 12 s"),
            (["history", "--html", "a.html", "--duration", "0"], "--duration"),
            (["history", "--html", "a.html", "--modes", "FA1"], "--modes"),
            (["modes", "--html", "a.html", "--modes", "FA1,FA9"], "FA9"),
            (["modes", "--html", "a.html", "--start", "3"], "--start"),
            (["modes", "--no-browser", "--port", "99999"], "--port"),
        ],
    )
    def test_bad_input(
        self, offwind: Any, run: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], told: str
    ) -> None:
        """Exit status 2, one message that says what is wrong, and no file."""
        monkeypatch.chdir(run)
        Path("text.nc").write_text("no NetCDF")
        if not Path("other.nc").exists():
            xr.Dataset({"a": ("x", [1.0])}).to_netcdf("other.nc", engine="netcdf4")
        Path("full").mkdir(exist_ok=True)
        Path("full/mine.txt").write_text("mine")
        before = sorted(Path.cwd().rglob("*"))
        code, _, err = offwind("view", *words)
        assert code == 2, err
        assert told in err
        assert "Traceback" not in err
        assert sorted(Path.cwd().rglob("*")) == before
