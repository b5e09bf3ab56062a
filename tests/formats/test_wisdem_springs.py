"""Pile springs for WISDEM: an independent frame, round trips, limits, refusals."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.foundation.equivalent import condensed_stiffness
from offwind_pin.analysis.foundation.pile_only import wisdem_pile
from offwind_pin.formats.wisdem import WisdemPile, read_wisdem, write_wisdem

PILE = WisdemPile(length=30.0, bending=8e11, shear=6e10, axial=1.6e11, torsional=6e11)


def _frame(pile: WisdemPile, z_soil: np.ndarray, k_soil: np.ndarray) -> np.ndarray:
    """(6, 6) at the mudline of four nodes in space, assembled by flexibility and inverted whole.

    Each element is the inverse of its tip's flexibility under load, moved to its foot by
    equilibrium; nothing of the module is used.
    """
    length = pile.length / 3
    flexibility = np.zeros((6, 6))
    sway = length**3 / (3 * pile.bending) + length / pile.shear
    for u, r, sign in ((0, 4, 1), (1, 3, -1)):
        flexibility[u, u] = sway
        flexibility[u, r] = flexibility[r, u] = sign * length**2 / (2 * pile.bending)
        flexibility[r, r] = length / pile.bending
    flexibility[2, 2], flexibility[5, 5] = length / pile.axial, length / pile.torsional
    tip = np.linalg.inv(flexibility)
    # Motion of the tip relative to the foot carried along rigidly.
    rigid = np.eye(6)
    rigid[0, 4], rigid[1, 3] = length, -length
    relative = np.hstack([-rigid, np.eye(6)])
    element = relative.T @ tip @ relative
    whole = np.zeros((24, 24))
    for e in range(3):
        part = slice(6 * e, 6 * e + 12)
        whole[part, part] += element
    for node in range(4):
        z = -pile.length * (1 - node / 3)
        kx, ktx, ky, kty, kz, ktz = (float(np.interp(z, z_soil, column)) for column in k_soil.T)
        springs = [kx, ky, kz if node == 0 else 0.0, ktx, kty, ktz]
        whole[6 * node : 6 * node + 6, 6 * node : 6 * node + 6] += np.diag(springs)
    return np.linalg.inv(np.linalg.inv(whole)[18:, 18:])


def _stiffness() -> np.ndarray:
    """The condensed stiffness of a pile on plausible springs, different in its two planes."""
    z = np.linspace(-PILE.length, 0.0, 10)
    lateral, rocking = 4e8 - 1e7 * z, 2e9 + 0 * z
    springs = np.transpose(
        [lateral, rocking, 1.3 * lateral, 2 * rocking, 3e9 + 0 * z, 4e9 - 1e8 * z]
    )
    return _frame(PILE, z, springs)


def _difference(found: np.ndarray, wanted: np.ndarray) -> float:
    """Largest difference of entries over the root of their diagonal entries."""
    size = np.sqrt(np.diag(wanted))
    return float(np.max(np.abs(found - wanted) / np.outer(size, size)))


@pytest.mark.parametrize("shear", [PILE.shear, np.inf])
def test_round_trip_and_an_independent_frame(tmp_path: Path, shear: float) -> None:
    """The 6x6 comes back, both by the reader and by a frame assembled another way."""
    path, pile, wanted = tmp_path / "wisdem.json", replace(PILE, shear=shear), _stiffness()
    write_wisdem(path, wanted, pile, note="of a\ntest")
    data = json.loads(path.read_text())
    z_soil, k_soil = np.array(data["z_soil"]), np.array(data["k_soil"])
    assert data["note"][0] == "of a test"
    assert z_soil.shape == (10,)
    assert (z_soil[0], z_soil[-1]) == (-30.0, 0.0)
    assert k_soil.shape == (10, 6)
    assert np.all(k_soil >= 0)
    assert _difference(_frame(pile, z_soil, k_soil), wanted) < 1e-8
    assert _difference(read_wisdem(path, pile), wanted) < 1e-8
    other = replace(pile, bending=0.9 * pile.bending)
    assert _difference(read_wisdem(path, other), wanted) > 1e-3


def test_reader_against_the_frame_and_rigid_pile(tmp_path: Path) -> None:
    """Any springs; on a rigid pile they add up with their arms, the vertical one at the foot."""
    path, z = tmp_path / "wisdem.json", np.linspace(-30.0, 0.0, 10)
    springs = np.random.default_rng(4).uniform(1e8, 1e9, (10, 6))
    path.write_text(json.dumps({"z_soil": z.tolist(), "k_soil": springs.tolist()}))
    assert _difference(read_wisdem(path, PILE), _frame(PILE, z, springs)) < 1e-10
    nodes = springs[::3]
    rigid = replace(PILE, bending=1e17, shear=1e17, axial=1e17, torsional=1e17)
    found, arm = read_wisdem(path, rigid), z[::3]
    assert found[0, 0] == pytest.approx(nodes[:, 0].sum(), rel=1e-3)
    assert found[0, 4] == pytest.approx(nodes[:, 0] @ arm, rel=1e-3)
    assert found[4, 4] == pytest.approx(nodes[:, 0] @ arm**2 + nodes[:, 3].sum(), rel=1e-3)
    assert found[1, 3] == pytest.approx(-nodes[:, 2] @ arm, rel=1e-3)
    assert found[3, 3] == pytest.approx(nodes[:, 2] @ arm**2 + nodes[:, 1].sum(), rel=1e-3)
    assert found[2, 2] == pytest.approx(nodes[0, 4], rel=1e-3)
    assert found[5, 5] == pytest.approx(nodes[:, 5].sum(), rel=1e-3)


def test_oc6(tmp_path: Path, oc6: ow.Turbine) -> None:
    """The benchmark's 6x6 and its condensed springs; the latter not on a pile soft in shear."""
    path = tmp_path / "wisdem.json"
    springs = oc6.soil.coupled_springs
    assert springs is not None
    given, condensed = np.array(springs.stiffness), condensed_stiffness(oc6)
    for wanted, shear in ((given, True), (given, False), (condensed, False)):
        pile = wisdem_pile(oc6, shear=shear)
        write_wisdem(path, wanted, pile)
        assert _difference(read_wisdem(path, pile), wanted) < 1e-6
    path.unlink()
    with pytest.raises(ow.InputError, match="shear: False"):
        write_wisdem(path, condensed, wisdem_pile(oc6))
    assert not path.exists()


def test_the_pile_of_a_turbine(oc6: ow.Turbine) -> None:
    """9 m by 0.11 m, 45 m deep; the shear area of a thin tube is near 0.6 of the whole."""
    pile = wisdem_pile(oc6)
    area = np.pi * (9.0 - 0.11) * 0.11
    assert pile.length == 45.0
    youngs, shear = oc6.materials["steel"].youngs_modulus, oc6.materials["steel"].shear_modulus
    assert pile.axial == pytest.approx(youngs * area, rel=1e-9)
    assert pile.bending == pytest.approx(youngs * area * ((9 - 0.11) ** 2 + 0.11**2) / 8, rel=1e-9)
    assert pile.torsional == pytest.approx(2 * shear / youngs * pile.bending, rel=1e-9)
    assert pile.shear == pytest.approx(shear * area / 1.64692, rel=0.01)
    assert np.isinf(wisdem_pile(oc6, shear=False).shear)


@pytest.mark.parametrize(
    ("i", "j", "factor", "fault"),
    [
        (0, 4, -1.0, "plane of"),
        (2, 2, 100.0, "rigid foot"),
        (0, 2, 1e9, "couplings of x with ry"),
        (4, 4, 0.01, "positive definite"),
    ],
)
def test_what_no_springs_give(tmp_path: Path, i: int, j: int, factor: float, fault: str) -> None:
    wanted = _stiffness()
    wanted[i, j] = wanted[j, i] = factor * (wanted[i, j] if (i, j) != (0, 2) else 1.0)
    with pytest.raises(ow.InputError, match=fault):
        write_wisdem(tmp_path / "wisdem.json", wanted, PILE)


def test_faults_of_files_and_piles(tmp_path: Path) -> None:
    path = tmp_path / "wisdem.json"
    with pytest.raises(ow.InputError, match="no such file"):
        read_wisdem(path, PILE)
    with pytest.raises(ow.InputError, match=r"pile\.axial"):
        replace(PILE, axial=np.inf)
    write_wisdem(path, _stiffness(), PILE)
    with pytest.raises(ow.InputError, match="length of the pile"):
        read_wisdem(path, replace(PILE, length=31.0))
    data = json.loads(path.read_text())
    path.write_text(json.dumps(data | {"k_soil": data["k_soil"][:4]}))
    with pytest.raises(ow.InputError, match="10 by 6"):
        read_wisdem(path, PILE)
    path.write_text("z_soil: 3")
    with pytest.raises(ow.InputError, match="JSON file"):
        read_wisdem(path, PILE)
