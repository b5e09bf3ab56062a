"""The page of natural modes: what moves, springs, tuned mass dampers, recorded commands."""

from __future__ import annotations

import base64
import html
import json
import re
import socket
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import umsgpack
import xarray as xr
from helpers.dampers import damper, several, with_dampers
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import modes_dataset
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.display.viewer.meshcat_recorder import Recorder, meshcat, meshcat_geometry
from offwind_pin.display.viewer.mode_frames import PEAK_SHARE, Shapes, carried, shapes
from offwind_pin.display.viewer.modes_page import render_modes
from offwind_pin.display.viewer.springs import node_step, zigzag

Array = NDArray[np.float64]


def modal(system: ow.System, count: int = 6) -> xr.Dataset:
    return modes_dataset(system, ow.modes(system, count))


@pytest.fixture(scope="module")
def distributed(distributed_wet: ow.System) -> xr.Dataset:
    return modal(distributed_wet, 8)


@pytest.fixture(scope="module")
def page(distributed: xr.Dataset) -> str:
    return render_modes(distributed, ["FA2"])


def constant(page: str, name: str) -> Any:
    """A constant of the page's script."""
    text = re.search(rf"const {name} = (.*?);\n", page)
    assert text is not None
    return json.loads(text.group(1))


def motion_of(shown: Shapes, mode: int, height: Array, offset: Array, factor: float) -> Array:
    """Points beside the axis at a share of a mode's amplitude."""
    points, _ = carried(factor * shown.motion_at(height)[mode], height, offset)
    return points


class TestSprings:
    @pytest.mark.parametrize("name", FOUNDATIONS)
    def test_of_each_foundation(self, undamped: ow.Turbine, name: str) -> None:
        """None where the root is fixed without soil along a pile; pairs at soil nodes; otherwise
        two pairs and a vertical spring at the mudline. The page has a legend for them."""
        system = ow.build(undamped, name, ow.StillWater(), elements=8)
        data = modal(system, 4)
        shown, soil = shapes(data), soil_springs(system)
        springs = shown.springs[shown.index("FA1")]
        legend = render_modes(data).partition("axis at rest")[2].partition("</div>")[0]
        assert bool(len(springs.height)) == ("</i>" in legend)
        if name in {"clamped", "apparent_fixity"}:
            assert len(springs.height) == 0
        elif soil is None:
            assert np.all(springs.height == undamped.site.mudline)
            assert len(springs.height) == 5
        else:
            lateral = sorted(set(springs.height[:-1].tolist()))
            assert set(lateral) <= set(soil.height.tolist())
            assert (lateral[0], lateral[-1]) == (soil.height.min(), soil.height.max())
            assert (len(soil.height) - 1) % node_step(soil.height, shown.size) == 0
            assert len(springs.height) == 2 * len(lateral) + 1

    def test_lie_in_the_plane_of_the_mode(self, distributed: xr.Dataset) -> None:
        shown = shapes(distributed)
        for label, across in (("FA2", 1), ("SS2", 0)):
            springs = shown.springs[shown.index(label)]
            assert np.abs(springs.anchor[:-1, across]).max() < 1e-12
            assert np.abs(springs.anchor[:-1, 1 - across]).min() > 4

    def test_reach_from_anchor_to_wall(self, distributed: xr.Dataset) -> None:
        """At rest they touch the wall and are unstretched; in motion one of a pair grows longer."""
        shown = shapes(distributed)
        mode = shown.index("FA1")
        springs = shown.springs[mode]
        rest, moved = (
            motion_of(shown, mode, springs.height, springs.offset, factor) for factor in (0.0, 1.0)
        )
        radius = np.interp(springs.height, shown.height, shown.radius)
        assert_allclose(np.linalg.norm(rest[:-1, :2], axis=1), radius[:-1])
        lengths = []
        for ends in (rest, moved):
            middle, along = springs.symbols(ends)
            first, second = middle - along / 2, middle + along / 2
            touching = [
                np.minimum(
                    np.linalg.norm(first - end, axis=1), np.linalg.norm(second - end, axis=1)
                )
                for end in (ends, springs.anchor)
            ]
            assert_allclose(touching, 0, atol=1e-9)
            lengths.append(np.linalg.norm(along, axis=1))
        assert_allclose(lengths[0], lengths[0][0])
        top = np.flatnonzero(springs.height == springs.height[:-1].max())
        grown = (lengths[1] - lengths[0])[top]
        assert grown.max() > 0.05
        assert grown.min() < -0.05

    def test_symbol_is_of_length_one(self) -> None:
        symbol = zigzag(2.0, 0.2)
        assert np.ptp(symbol.vertices[:, 0]) == pytest.approx(1.0, rel=1e-6)
        assert_allclose(symbol.vertices.mean(axis=0)[:2], 0, atol=0.02)


class TestTunedMassDampers:
    def test_slide_on_their_carriers(self, undamped: ow.Turbine) -> None:
        """Strokes are the joint displacements; carrier and mass together those of Pinocchio."""
        system = ow.build(several(undamped), "coupled_springs", elements=8)
        result = ow.modes(system, 8)
        shown = shapes(modes_dataset(system, result))
        joints = system.chain.joint_name
        for mode in range(8):
            vector = result.vector[:, mode]
            scale = shown.motion[mode, -1] @ result.mass_normalised[mode, -1]
            scale /= np.sum(result.mass_normalised[mode, -1] ** 2)
            for d, mass in enumerate(system.chain.tuned_masses):
                for axis, joint in enumerate(("px", "py")):
                    name = f"zz_tmd_{mass.name}_{joint}"
                    slid = vector[joints.index(name)] if name in joints else 0.0
                    assert shown.stroke[mode, d, axis] == pytest.approx(scale * slid, abs=1e-9)
            stroke = np.linalg.norm(shown.stroke[mode], axis=1).max()
            assert stroke <= PEAK_SHARE * shown.size * (1 + 1e-9)
        page = render_modes(modes_dataset(system, result), ["TMD1"])
        assert "tuned mass damper" in page
        assert np.shape(constant(page, "modes")["damper_stroke"]) == (8, 4, 3)
        drawn = {command["path"] for command in commands(page)}
        assert {f"/meshcat/places/0/damper/{d}" for d in range(4)} <= drawn

    def test_that_moves_alone(self, undamped: ow.Turbine) -> None:
        """On a clamped base it slides to the largest distance drawn, and the axis is at rest."""
        own = damper("a", undamped.site.mudline, "fore_aft", frequency_hz=0.15, damping_ratio=0.2)
        system = ow.build(with_dampers(undamped, own), "clamped", elements=5)
        shown = shapes(modal(system, 3))
        mode = shown.index("TMD1")
        assert np.abs(shown.motion[mode]).max() == 0
        assert np.all(np.isfinite(shown.share))
        assert np.abs(shown.stroke[mode, 0, 0]) == pytest.approx(PEAK_SHARE * shown.size)


def test_short_waves_do_not_curl_up(distributed: xr.Dataset) -> None:
    """Modes that bend sharply are drawn smaller, others with the full amplitude."""
    shown = shapes(distributed)
    full = [shown.peak[shown.index(label)] > 0.999 * 0.08 * shown.size for label in ("FA1", "SS3")]
    assert full == [True, False]


# Commands and page


def commands(page: str) -> list[dict[str, Any]]:
    """The viewer's commands in a page."""
    return [umsgpack.unpackb(base64.b64decode(text)) for text in constant(page, "commands")]


def test_recorder_keeps_what_the_viewer_reads() -> None:
    """Commands come back in order, with meshcat's own keys and numbers in single precision."""
    recorder = Recorder()
    view = recorder.visualizer()
    view["part"].set_object(meshcat_geometry.Box([1.0, 2.0, 3.0]))
    view["part"].set_transform(np.eye(4))
    first, second = (umsgpack.unpackb(command) for command in recorder.commands)
    assert first["type"] == "set_object"
    assert first["path"] == "/meshcat/part"
    assert first["object"]["geometries"][0]["depth"] == 3.0
    assert second["type"] == "set_transform"
    assert b"\xcb" not in recorder.commands[1]  # the mark of a double
    assert second["matrix"] == np.eye(4).ravel().tolist()


def test_no_server_and_no_socket(coupled_wet: ow.System, monkeypatch: pytest.MonkeyPatch) -> None:
    """A page is made without meshcat's server and without any socket."""

    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("something listens or connects")

    data = modal(coupled_wet, 3)
    monkeypatch.setattr(meshcat.visualizer, "start_zmq_server_as_subprocess", refuse)
    monkeypatch.setattr(meshcat.visualizer.ViewerWindow, "connect_zmq", refuse)
    for name in ("bind", "listen", "connect"):
        monkeypatch.setattr(socket.socket, name, refuse)
    assert render_modes(data).startswith("<!DOCTYPE html>")
    # Negative control: meshcat's own window would have been caught.
    with pytest.raises(AssertionError, match="listens"):
        meshcat.visualizer.Visualizer()


def test_page_is_self_contained_and_stays_small(page: str) -> None:
    """Nothing is fetched: every source and link is data; and the file is below 3 MB."""
    assert len(page.encode()) < 3e6
    markup = re.sub(r"<script>.*?</script>", "", page, flags=re.DOTALL)
    references = re.findall(r"(?:src|href|action|url)\s*[=(]\s*[\"']?([^\"')\s>]+)", markup)
    assert references == ["data:,"]
    assert "default-src 'none'" in html.unescape(markup)
    assert "Permission is hereby granted, free of charge" in page


def test_page_shows_facts(page: str, distributed: xr.Dataset, coupled_wet: ow.System) -> None:
    """Turbine, foundation, modes with their numbers, the one chosen; surrogate data if there are."""
    modes = constant(page, "modes")
    assert modes["first"] == [modes["label"].index("FA2")]
    assert_allclose(modes["frequency"], distributed.frequency)
    assert_allclose(modes["damping"], distributed.damping_ratio)
    text = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", page))
    assert "oc6_phase2, distributed springs, still water" in text
    assert 'class="surrogate"' in page
    assert 'class="surrogate"' not in render_modes(modal(coupled_wet, 3))


def test_names_cannot_break_the_page(coupled_wet: ow.System) -> None:
    """What a file calls a turbine is text, not markup."""
    turbine = coupled_wet.turbine.model_copy(update={"name": "<script>alert(1)</script>"})
    page = render_modes(modal(replace(coupled_wet, turbine=turbine), 2))
    assert "<script>alert(1)" not in page
    assert "&lt;script&gt;alert(1)" in page
