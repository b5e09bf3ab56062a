"""What the animation draws: poses, meshes, springs, recorded commands and the page around them."""

from __future__ import annotations

import base64
import itertools
import json
import re
import socket
from collections import Counter
from dataclasses import replace
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
import umsgpack
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.base.mode_labels import mode_name
from offwind_pin.definitions.rotor_nacelle import rotor_apex
from offwind_pin.definitions.turbine import RigidBodyRNA
from offwind_pin.display.viewer.meshcat_recorder import Recorder, meshcat, meshcat_geometry
from offwind_pin.display.viewer.mode_motion import (
    FRAMES,
    PEAK_SHARE,
    PEAK_TILT,
    PEAK_TWIST,
    mode_motion,
)
from offwind_pin.display.viewer.mode_page import animate
from offwind_pin.display.viewer.scene import view_extent
from offwind_pin.display.viewer.springs import foundation_springs, node_step, zigzag
from offwind_pin.dynamics.reference.poses import body_poses
from offwind_pin.structure import meshes
from offwind_pin.structure.frustum import Frustum
from offwind_pin.structure.meshes import body_meshes
from offwind_pin.structure.rotor import rna_meshes

Array = NDArray[np.float64]

# A polygon of n sides in a circle has this share of its area.
FACETED = np.sin(2 * np.pi / meshes.FACETS) / (2 * np.pi / meshes.FACETS)

SYSTEMS = ["clamped_dry", "coupled_wet", "distributed_wet"]


@pytest.fixture(params=SYSTEMS)
def system(request: pytest.FixtureRequest) -> ow.System:
    found: ow.System = request.getfixturevalue(request.param)
    return found


@pytest.fixture(scope="module")
def distributed_modes(distributed_wet: ow.System) -> ow.ModalResult:
    return ow.modes(distributed_wet, 10)


@pytest.fixture(scope="module")
def fa2_page(distributed_wet: ow.System, distributed_modes: ow.ModalResult) -> str:
    return animate(distributed_wet, distributed_modes, "FA2")


def commands_of(page: str) -> list[dict[str, Any]]:
    """The viewer's commands that a page holds."""
    texts = re.search(r"const commands = (\[.*?\]);", page)
    assert texts is not None
    return [umsgpack.unpackb(base64.b64decode(text)) for text in json.loads(texts.group(1))]


# Poses


def test_bodies_at_rest_stand_upright(system: ow.System) -> None:
    """At zero displacement each frame lies on the axis at its height, unturned."""
    poses = body_poses(system, np.zeros(system.nv))
    upright = np.tile(np.eye(4), (system.chain.elements + 1, 1, 1))
    upright[:, 2, 3] = system.chain.origin
    assert_allclose(poses, upright, atol=1e-12)


def test_small_motion_is_the_modal_shape(system: ow.System) -> None:
    """Differences of poses along a modal vector are the mode's displacements and rotations."""
    equilibrium = ow.static(system)
    modes = ow.modes(system, 5, about=equilibrium)
    lever = modes.height - system.chain.origin
    step = 1e-4
    for index in range(5):
        vector = step * modes.vector[:, index]
        fore, aft = (body_poses(system, equilibrium.q + s * vector) for s in (1, -1))
        centre = body_poses(system, equilibrium.q)
        rate = (fore - aft) / (2 * step)
        moved = rate[:, :3, 3] + lever[:, None] * rate[:, :3, 2]
        spin = rate[:, :3, :3] @ centre[:, :3, :3].transpose(0, 2, 1)
        turned = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
        shape = modes.mass_normalised[index]
        size = np.abs(shape[:, :3]).max()
        assert_allclose(moved, shape[:, :3], rtol=0, atol=1e-6 * size)
        assert_allclose(turned, shape[:, 3:], rtol=0, atol=1e-6 * np.abs(shape[:, 3:]).max())
        # Negative control: the neighbouring mode is no match at this tolerance.
        other = modes.mass_normalised[(index + 1) % 5]
        assert np.abs(moved - other[:, :3]).max() > 0.1 * size


def test_poses_are_no_view_into_scratch_memory(coupled_wet: ow.System) -> None:
    """A later call leaves earlier poses as they were."""
    first = body_poses(coupled_wet, np.zeros(coupled_wet.nv))
    kept = first.copy()
    second = body_poses(coupled_wet, np.full(coupled_wet.nv, 0.01))
    assert_array_equal(first, kept)
    assert np.abs(second - kept).max() > 0.1


# The motion drawn


def test_cycle_is_a_sine_of_the_stated_peak(
    distributed_wet: ow.System, distributed_modes: ow.ModalResult
) -> None:
    """FA1 peaks at 8 % of the height a quarter through, then mirrors that; it ends as it began."""
    motion = mode_motion(distributed_wet, distributed_modes, "FA1")
    chain = distributed_wet.chain
    height = chain.top - chain.base
    assert motion.peak == pytest.approx(PEAK_SHARE * height, rel=1e-12)
    assert motion.poses.shape == (FRAMES + 1, chain.elements + 1, 4, 4)
    assert_allclose(motion.poses[-1], motion.poses[0], atol=1e-12)
    assert_allclose(motion.poses[0, :, :2, 3], 0, atol=1e-12)
    quarter, later = motion.poses[FRAMES // 4], motion.poses[3 * FRAMES // 4]
    assert_allclose(quarter[:, 0, 3], -later[:, 0, 3], atol=1e-9)
    top = quarter[-1] @ np.array([0, 0, chain.top - chain.origin[-1], 1])
    # The axis keeps its length, so that a sway of 8 % falls short by about 0.3 %.
    assert top[0] == pytest.approx(motion.peak, rel=1e-2)
    assert motion.share.max() == 1
    assert np.argmax(motion.share) == chain.elements


def test_torsion_turns_the_top(
    distributed_wet: ow.System, distributed_modes: ow.ModalResult
) -> None:
    """T1 turns the highest body by the stated angle about the vertical."""
    motion = mode_motion(distributed_wet, distributed_modes, "T1")
    assert motion.peak == pytest.approx(PEAK_TWIST)
    rotation = motion.poses[FRAMES // 4, -1, :3, :3]
    assert np.arctan2(rotation[1, 0], rotation[0, 0]) == pytest.approx(PEAK_TWIST, rel=0.02)


def test_short_waves_do_not_curl_up(
    distributed_wet: ow.System, distributed_modes: ow.ModalResult
) -> None:
    """Modes that bend sharply are drawn smaller: no body leans more than the bound."""
    bound = []
    for label in ("FA1", "FA2", "SS3", "FA4"):
        motion = mode_motion(distributed_wet, distributed_modes, label)
        lean = np.arccos(np.clip(motion.poses[:, :, 2, 2], -1, 1)).max()
        assert lean <= PEAK_TILT * 1.02
        chain = distributed_wet.chain
        bound.append(motion.peak < 0.999 * PEAK_SHARE * (chain.top - chain.base))
    # Negative control: the bound acts on some of them and not on all.
    assert bound[0] is False
    assert bound[2] is True


def test_names_in_words() -> None:
    """Labels as a person says them."""
    assert mode_name("FA2") == "second fore-aft"
    assert mode_name("SS1") == "first side-side"
    assert mode_name("T3") == "third torsion"
    assert mode_name("V11") == "11th vertical"


# Meshes


def open_edges(mesh: meshes.Mesh) -> int:
    """Number of edges that do not have one triangle on each side, coincident vertices merged."""
    rounded = np.round(mesh.vertices, 7) + 0.0  # no negative zeros
    _, place = np.unique(rounded, axis=0, return_inverse=True)
    corners = place.ravel()[mesh.faces]
    corners = corners[[len(set(face)) == 3 for face in corners.tolist()]]
    pairs = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    edges = Counter(map(tuple, pairs.tolist()))
    return sum(1 for (a, b), count in edges.items() if edges[(b, a)] != count)


def test_hollow_frustum_has_the_volume_of_its_steel() -> None:
    """Volume is that of the closed form, times the share of a polygon in its circle."""
    shell = Frustum(4.0, 5.0, 4.0, 4.9, 3.92, density=1000.0)
    mesh = meshes.hollow_frustum(-3.0, shell)
    assert mesh.volume == pytest.approx(FACETED * shell.lump().mass / 1000, rel=1e-10)
    assert open_edges(mesh) == 0
    assert mesh.vertices[:, 2].min() == -3.0
    assert mesh.vertices[:, 2].max() == 1.0


def test_detector_of_open_edges_finds_a_hole() -> None:
    """Negative control: without a triangle, or with one turned over, edges are open."""
    cube = meshes.box([0, 0, 0], [1, 2, 3])
    assert open_edges(cube) == 0
    assert cube.volume == pytest.approx(6)
    assert open_edges(meshes.Mesh(cube.vertices, cube.faces[1:])) > 0
    turned = np.concatenate([cube.faces[:1, ::-1], cube.faces[1:]])
    assert open_edges(meshes.Mesh(cube.vertices, turned)) > 0


def test_bodies_are_drawn_with_their_steel(system: ow.System) -> None:
    """Volume times density of each body's mesh is its mass, point masses apart."""
    turbine, chain = system.turbine, system.chain
    drawn = body_meshes(system.turbine, system.chain)
    assert len(drawn) == chain.elements + 1
    density = {material.density for material in turbine.materials.values()}
    masses = np.array([body.mass for body in chain.body])
    volumes = np.array([mesh.volume for mesh in drawn.values()]) / FACETED
    heaviest = volumes * max(density)
    with_points = sum(mass.mass for mass in turbine.point_masses if mass.z >= chain.base)
    if len(density) == 1:
        extra = masses - heaviest
        assert extra.sum() == pytest.approx(with_points, abs=1e-8 * masses.sum())
        assert np.count_nonzero(np.abs(extra) > 1e-8 * masses) <= len(turbine.point_masses)
    assert np.all(volumes > 0)


def test_bodies_meet_at_the_joints(distributed_wet: ow.System) -> None:
    """Each mesh ends where the next begins, from the toe to the yaw bearing."""
    chain = distributed_wet.chain
    spans = [
        (mesh.vertices[:, 2].min() + origin, mesh.vertices[:, 2].max() + origin)
        for mesh, origin in zip(
            body_meshes(distributed_wet.turbine, distributed_wet.chain).values(),
            chain.origin,
            strict=True,
        )
    ]
    assert spans[0][0] == pytest.approx(chain.base)
    assert spans[-1][1] == pytest.approx(chain.top)
    for below, above in itertools.pairwise(spans):
        assert below[1] == pytest.approx(above[0], abs=1e-9)


def test_rotor_has_the_dimensions_of_the_definition(oc6: ow.Turbine) -> None:
    """Three closed blades, tips at the rotor's radius, one up; hub and nacelle closed too."""
    rna = oc6.rna
    assert rna.kind == "rotor_nacelle"
    drawn = rna_meshes(rna, tower_diameter=5.5)
    assert list(drawn) == ["nacelle", "hub", "blade_1", "blade_2", "blade_3"]
    apex, shaft = rotor_apex(rna)
    for mesh in drawn.values():
        assert open_edges(mesh) == 0
        assert mesh.volume > 1
    reach = rna.hub_radius + rna.blade.length
    for name in ("blade_1", "blade_2", "blade_3"):
        out = drawn[name].vertices - apex
        tip = np.linalg.norm(out, axis=1).max()
        assert tip == pytest.approx(reach, rel=1e-3)
        # The cone leans the blade by the sine of its angle out of the rotor plane.
        lean = out[np.argmax(np.linalg.norm(out, axis=1))] @ shaft / tip
        assert lean == pytest.approx(np.sin(np.radians(rna.precone)), abs=0.01)
    top = {name: mesh.vertices[:, 2].max() for name, mesh in drawn.items()}
    assert top["blade_1"] == pytest.approx(apex[2] + reach, rel=0.01)
    assert max(top["blade_2"], top["blade_3"]) < top["nacelle"]


def test_nacelle_alone_where_no_rotor_is_known() -> None:
    """A plain rigid body is a box about its centre of mass."""
    rna = RigidBodyRNA(
        kind="rigid_body",
        mass=3e5,
        center_of_mass=(-0.4, 0.1, 2.0),
        inertia=((4e7, 0, 0), (0, 2e7, 0), (0, 0, 2.5e7)),
    )
    drawn = rna_meshes(rna, tower_diameter=4.0)
    assert list(drawn) == ["nacelle"]
    assert_allclose(drawn["nacelle"].vertices.mean(axis=0), [-0.4, 0.1, 2.0])


def test_view_holds_the_whole_structure(distributed_wet: ow.System) -> None:
    """From below the toe to the highest blade tip."""
    low, high, breadth = view_extent(distributed_wet)
    assert low < distributed_wet.chain.base
    assert high > distributed_wet.chain.top + 95
    assert breadth > 80


# Springs


def test_springs_of_each_foundation(
    clamped_dry: ow.System, coupled_wet: ow.System, distributed_wet: ow.System
) -> None:
    """None where clamped; four pairs' ends and a foot at the mudline; pairs at soil nodes."""
    x = np.array([1.0, 0.0, 0.0])
    assert foundation_springs(clamped_dry, x) == []
    coupled = foundation_springs(coupled_wet, x)
    assert len(coupled) == 5
    mudline = coupled_wet.turbine.site.mudline
    assert [spring.anchor[2] for spring in coupled[:4]] == [mudline] * 4
    drawn = foundation_springs(distributed_wet, x)
    soil = soil_springs(distributed_wet)
    assert soil is not None
    nodes = soil.height
    heights = sorted({float(spring.anchor[2]) for spring in drawn if spring.name != "vertical"})
    assert set(heights) <= set(nodes.tolist())
    assert heights[0] == nodes.min()
    assert heights[-1] == nodes.max()
    chain = distributed_wet.chain
    assert (len(nodes) - 1) % node_step(soil, chain.top - chain.base) == 0
    assert len(drawn) == 2 * len(heights) + 1


def test_springs_reach_from_anchor_to_structure(
    distributed_wet: ow.System, distributed_modes: ow.ModalResult
) -> None:
    """At every frame a stretched symbol ends on the body it holds; at rest it is unstretched."""
    motion = mode_motion(distributed_wet, distributed_modes, "FA2")
    for spring in foundation_springs(distributed_wet, np.array([1.0, 0.0, 0.0])):
        rotation, length = spring.stretch(motion.poses)
        assert length[0] == pytest.approx(spring.rest_length, rel=1e-12)
        assert_allclose(
            rotation @ rotation.transpose(0, 2, 1), np.tile(np.eye(3), (61, 1, 1)), atol=1e-12
        )
        assert_allclose(np.linalg.det(rotation), 1)
        end = spring.anchor + length[:, None] * rotation[:, :, 0]
        pose = motion.poses[:, spring.body]
        assert_allclose(end, pose[:, :3, :3] @ spring.tip + pose[:, :3, 3], atol=1e-9)
    symbol = zigzag(8.0, 2.0, 0.2)
    assert open_edges(symbol) == 0
    assert np.ptp(symbol.vertices[:, 0]) == pytest.approx(8.0, rel=0.05)


# Commands and page


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

    modes = ow.modes(coupled_wet, 3)
    monkeypatch.setattr(meshcat.visualizer, "start_zmq_server_as_subprocess", refuse)
    monkeypatch.setattr(meshcat.visualizer.ViewerWindow, "connect_zmq", refuse)
    for name in ("bind", "listen", "connect"):
        monkeypatch.setattr(socket.socket, name, refuse)
    assert animate(coupled_wet, modes, "FA1").startswith("<!DOCTYPE html>")
    # Negative control: meshcat's own window would have been caught.
    with pytest.raises(AssertionError, match="listens"):
        meshcat.visualizer.Visualizer()


def test_page_draws_and_moves_every_body(
    fa2_page: str, distributed_wet: ow.System, distributed_modes: ow.ModalResult
) -> None:
    """Each body has an object of its amplitude's colour and an endless clip of its poses."""
    commands = commands_of(fa2_page)
    motion = mode_motion(distributed_wet, distributed_modes, "FA2")
    names = list(body_meshes(distributed_wet.turbine, distributed_wet.chain))
    objects = {c["path"]: c["object"] for c in commands if c["type"] == "set_object"}
    for name, share in zip(names, motion.share, strict=True):
        material = objects[f"/meshcat/turbine/{name}/wall"]["materials"][0]
        expected = mpl.colors.to_hex(mpl.colormaps["viridis"](float(share)))
        assert f"#{material['color']:06x}" == expected
    (animation,) = (c for c in commands if c["type"] == "set_animation")
    assert animation["options"] == {"play": True, "repetitions": np.inf}
    clips = {item["path"]: item["clip"] for item in animation["animations"]}
    for k, name in enumerate(names):
        tracks = {t["name"]: t["keys"] for t in clips[f"/meshcat/turbine/{name}"]["tracks"]}
        assert [key["time"] for key in tracks[".position"]] == list(range(FRAMES + 1))
        drawn = [key["value"] for key in tracks[".position"]]
        assert_allclose(drawn, motion.poses[:, k, :3, 3], rtol=0, atol=1e-4)
        assert_allclose(
            np.linalg.norm([key["value"] for key in tracks[".quaternion"]], axis=1), 1, rtol=1e-6
        )


def test_page_stands_alone_and_stays_small(fa2_page: str) -> None:
    """Nothing is fetched: every source and link is data; and the file is below 3 MB."""
    assert len(fa2_page.encode()) < 3e6
    markup = re.sub(r"<script>.*?</script>", "", fa2_page, flags=re.DOTALL)
    references = re.findall(r"(?:src|href|action|url)\s*[=(]\s*[\"']?([^\"')\s>]+)", markup)
    assert references == ["data:,"]
    assert "default-src 'none'" in markup
    assert "Permission is hereby granted, free of charge" in fa2_page


def test_page_tells_what_it_shows(
    fa2_page: str, coupled_wet: ow.System, distributed_modes: ow.ModalResult
) -> None:
    """Mode, frequency, damping and exaggeration; a surrogate soil is named, and only then."""
    index = distributed_modes.index("FA2")
    text = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", fa2_page))
    assert "oc6_phase2, distributed springs, in still water" in text
    assert "second fore-aft mode" in text
    assert f"{distributed_modes.frequency_hz[index]:.4g} Hz" in text
    assert f"{100 * distributed_modes.damping_ratio[index]:.3g} %" in text
    assert "Amplitude exaggerated" in text
    assert "The soil is a surrogate" in text
    other = animate(coupled_wet, ow.modes(coupled_wet, 3), "FA1")
    assert "surrogate" not in other.partition("<section")[2].partition("</section>")[0]


def test_names_cannot_break_the_page(coupled_wet: ow.System) -> None:
    """What a file calls a turbine is text, not markup."""
    turbine = coupled_wet.turbine.model_copy(update={"name": "<script>alert(1)</script>"})
    page = animate(replace(coupled_wet, turbine=turbine), ow.modes(coupled_wet, 2), "FA1")
    assert "<script>alert(1)" not in page
    assert "&lt;script&gt;alert(1)" in page


def test_unknown_mode_is_refused(
    distributed_wet: ow.System, distributed_modes: ow.ModalResult
) -> None:
    """The message lists what there is."""
    with pytest.raises(ow.InputError, match=r"FA9.*FA2"):
        animate(distributed_wet, distributed_modes, "FA9")
