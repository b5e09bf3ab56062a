"""Meshes of bodies and rotor: closed, of the right volume and extent."""

from __future__ import annotations

import itertools
from collections import Counter

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.definitions.rotor_nacelle import rotor_apex
from offwind_pin.definitions.turbine import RigidBodyRNA
from offwind_pin.structure import meshes
from offwind_pin.structure.frustum import Frustum
from offwind_pin.structure.meshes import body_meshes
from offwind_pin.structure.rotor import rna_meshes

# A polygon of n sides in a circle has this share of its area.
FACETED = np.sin(2 * np.pi / meshes.FACETS) / (2 * np.pi / meshes.FACETS)


@pytest.fixture(params=["clamped_dry", "coupled_wet", "distributed_wet"])
def system(request: pytest.FixtureRequest) -> ow.System:
    found: ow.System = request.getfixturevalue(request.param)
    return found


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
