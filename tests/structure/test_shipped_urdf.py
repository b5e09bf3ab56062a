"""The shipped URDF folders are what the code writes today, and Pinocchio and its viewers read them."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import offwind_pin as ow
from offwind_pin.structure.meshes import FACETS

SHIPPED = Path(__file__).resolve().parents[2] / "urdf"
FOUNDATIONS = ("clamped", "distributed_springs")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def _split(text: str) -> tuple[list[float], str]:
    """The numbers of a text, and the text with the numbers taken out."""
    return [float(n) for n in NUMBER.findall(text)], NUMBER.sub("#", text)


def _assert_same(text: str, other: str) -> None:
    numbers, words = _split(text)
    other_numbers, other_words = _split(other)
    assert words == other_words
    assert np.allclose(numbers, other_numbers, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("foundation", FOUNDATIONS)
def test_shipped_files_are_current(foundation: str, oc6: ow.Turbine, tmp_path: Path) -> None:
    """`make urdf` would change nothing but the last digits of floating-point numbers."""
    ow.export_urdf(ow.build(oc6, foundation), tmp_path)
    folder = SHIPPED / f"oc6_phase2_{foundation}"
    for name in ("oc6_phase2.urdf", "oc6_phase2.json"):
        _assert_same((tmp_path / name).read_text(), (folder / name).read_text())
    made = {path.name: path.read_bytes() for path in (tmp_path / "meshes").iterdir()}
    kept = {path.name: path.read_bytes() for path in (folder / "meshes").iterdir()}
    assert made.keys() == kept.keys()
    assert all(len(made[name]) == len(kept[name]) for name in made)


def test_the_comparison_can_fail() -> None:
    """Negative control: a changed number and a changed word are found."""
    with pytest.raises(AssertionError):
        _assert_same("mass 1.0", "mass 1.001")
    with pytest.raises(AssertionError):
        _assert_same("mass 1.0", "mess 1.0")


@pytest.mark.parametrize("foundation", FOUNDATIONS)
def test_pinocchio_reads_the_file_as_the_system(foundation: str, oc6: ow.Turbine) -> None:
    """The file on disk gives the model that is simulated: same joints, same inertias to rounding."""
    path = SHIPPED / f"oc6_phase2_{foundation}" / "oc6_phase2.urdf"
    model = pin.buildModelFromUrdf(str(path))
    system = ow.build(oc6, foundation)
    assert list(model.names) == list(system.pin_model.names)
    q = np.random.default_rng(1).uniform(-0.02, 0.02, model.nq)
    theirs = pin.crba(model, model.createData(), q)
    ours = pin.crba(system.pin_model, system.pin_model.createData(), q)
    assert np.allclose(np.triu(theirs), np.triu(ours), rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("foundation", FOUNDATIONS)
def test_every_body_has_a_mesh_beside_the_file(foundation: str) -> None:
    """Each visual names a file that is there, in binary STL of the right length."""
    folder = SHIPPED / f"oc6_phase2_{foundation}"
    meshes = ET.parse(folder / "oc6_phase2.urdf").getroot().findall(".//visual/geometry/mesh")
    sidecar = json.loads((folder / "oc6_phase2.json").read_text())
    assert len(meshes) == len(sidecar["nodes"]) + 2
    for mesh in meshes:
        content = (folder / str(mesh.get("filename"))).read_bytes()
        triangles = int.from_bytes(content[80:84], "little")
        assert len(content) == 84 + 50 * triangles > 84


def test_mesh_volume_is_that_of_the_steel(oc6: ow.Turbine) -> None:
    """The closed meshes hold the steel's volume, short by the polygon's share of the circle."""
    folder = SHIPPED / "oc6_phase2_clamped" / "meshes"
    bodies = [path for path in folder.iterdir() if path.name != "rna.stl"]
    volume = sum(_volume(path.read_bytes()) for path in bodies)
    system = ow.build(oc6, "clamped")
    steel = sum(body.mass for body in system.chain.body) / 8500.0
    share = np.sin(2 * np.pi / FACETS) / (2 * np.pi / FACETS)
    assert volume == pytest.approx(share * steel, rel=1e-5)


def _volume(stl: bytes) -> float:
    """Volume of a closed mesh by the divergence theorem."""
    record = np.frombuffer(
        stl[84:], dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("unused", "<u2")]
    )
    corner = record["corner"].astype(float)
    return float(np.einsum("ni,ni->", corner[:, 0], np.cross(corner[:, 1], corner[:, 2])) / 6)
