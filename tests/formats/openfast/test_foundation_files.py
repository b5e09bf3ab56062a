"""Foundation files of other codes: round trips to the last digit, places of the entries, refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.formats.openfast.subdyn_soildyn import (
    read_soildyn,
    read_subdyn_ssi,
    write_soildyn,
    write_subdyn_ssi,
)


@pytest.fixture(scope="module")
def stiffness(oc6: ow.Turbine) -> np.ndarray:
    springs = oc6.soil.coupled_springs
    assert springs is not None
    return np.array(springs.stiffness)


def _symmetric(seed: int) -> np.ndarray:
    half = np.random.default_rng(seed).standard_normal((6, 6)) * 1e10
    return half @ half.T


def test_subdyn_round_trip(tmp_path: Path) -> None:
    """What is read is what was written, to the last bit."""
    path = tmp_path / "ssi.dat"
    write_subdyn_ssi(path, _symmetric(1), _symmetric(2), note="a\nnote")
    stiffness, mass = read_subdyn_ssi(path)
    assert np.array_equal(stiffness, _symmetric(1))
    assert np.array_equal(mass, _symmetric(2))


def test_subdyn_names_each_entry(tmp_path: Path, stiffness: np.ndarray) -> None:
    """21 entries of either matrix; sway and rocking couple with the signs of the benchmark's file."""
    path = tmp_path / "ssi.dat"
    write_subdyn_ssi(path, stiffness)
    entries = {}
    for line in path.read_text().splitlines():
        if not line.startswith("!"):
            value, name = line.split()
            entries[name] = float(value)
    assert len(entries) == 42
    assert sum(name.startswith("K") for name in entries) == 21
    assert entries["Kxx"] == entries["Kyy"] == 6.336198e9
    assert entries["Kxty"] == -5.015421e10
    assert entries["Kytx"] == 5.015421e10
    assert entries["Ktztz"] == 2.552673e11
    assert all(entries[name] == 0 for name in entries if name.startswith("M"))


def test_subdyn_reads_what_a_person_wrote(tmp_path: Path) -> None:
    """Any order, comments, Fortran's exponents, entries left out."""
    path = tmp_path / "ssi.dat"
    path.write_text("# by hand\n 2.5D9 kxx  ! sway\n\n-1e10 Kxty\n7e5 Mzz\n")
    stiffness, mass = read_subdyn_ssi(path)
    assert stiffness[0, 0] == 2.5e9
    assert stiffness[0, 4] == stiffness[4, 0] == -1e10
    assert np.count_nonzero(stiffness) == 3
    assert mass[2, 2] == 7e5


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("1e9 Kxx\n2e9 Kxq\n", "line 2"),
        ("1e9 Kxx\n2e9 Kxx\n", "Kxx once"),
        ("much Kxx\n", "finite number"),
        ("nan Kxx\n", "finite number"),
        ("1e9\n", "Complete the line"),
    ],
)
def test_subdyn_faults(tmp_path: Path, text: str, fault: str) -> None:
    path = tmp_path / "ssi.dat"
    path.write_text(text)
    with pytest.raises(ow.InputError, match=fault):
        read_subdyn_ssi(path)


def test_soildyn_round_trip(tmp_path: Path) -> None:
    """Neither matrix need be symmetric."""
    rng = np.random.default_rng(3)
    stiffness, damping = 1e10 * rng.standard_normal((2, 6, 6))
    path = tmp_path / "soildyn.dat"
    write_soildyn(path, stiffness, (0.0, 0.1, -30.0), damping, note="round trip")
    found = read_soildyn(path)
    assert np.array_equal(found.stiffness, stiffness)
    assert np.array_equal(found.damping, damping)
    assert np.array_equal(found.location, [0.0, 0.1, -30.0])


def test_soildyn_lines_are_where_it_reads_them(tmp_path: Path, stiffness: np.ndarray) -> None:
    """SoilDyn reads by line: option, place, matrices, empty tables, and END in the first columns."""
    path = tmp_path / "soildyn.dat"
    write_soildyn(path, stiffness, (0.0, 0.0, -30.0))
    lines = path.read_text().splitlines()
    assert [line.split()[1] for line in lines[3:6]] == ["Echo", "DT", "CalcOption"]
    assert lines[5].split()[0] == "1"
    assert np.array([line.split() for line in lines[9:15]], dtype=float) == pytest.approx(stiffness)
    assert lines[23].split()[:2] == ["0", "PY_numPts"]
    assert [line.split()[1] for line in lines[26:29]] == [
        "DLL_model",
        "DLL_FileName",
        "DLL_NumPoints",
    ]
    assert lines[31].split()[1] == "SumPrint"
    assert lines[-1][:3] == "END"


def test_soildyn_faults(tmp_path: Path, stiffness: np.ndarray) -> None:
    path = tmp_path / "soildyn.dat"
    with pytest.raises(ow.InputError, match="no such file"):
        read_soildyn(path)
    with pytest.raises(ow.InputError, match="location"):
        write_soildyn(path, stiffness, (0.0, -30.0))
    with pytest.raises(ow.InputError, match="six by six"):
        write_soildyn(path, stiffness[:3], (0.0, 0.0, -30.0))
    write_soildyn(path, stiffness, (0.0, 0.0, -30.0))
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:20]))
    with pytest.raises(ow.InputError, match="20 lines"):
        read_soildyn(path)
    path.write_text("\n".join(lines[:8] + lines[9:]))
    with pytest.raises(ow.InputError, match="line"):
        read_soildyn(path)


def test_an_unsymmetric_matrix_is_refused(tmp_path: Path, stiffness: np.ndarray) -> None:
    """SubDyn takes a triangle: what the other one holds must not be lost in silence."""
    path = tmp_path / "ssi.dat"
    skew = stiffness.copy()
    skew[0, 4] *= 1.001
    with pytest.raises(ow.InputError, match=r"at xty and .* at tyx.*symmetric part"):
        write_subdyn_ssi(path, skew)
    with pytest.raises(ow.InputError, match="mass"):
        write_subdyn_ssi(path, stiffness, np.full((6, 6), np.nan))
    assert not path.exists()


def test_condensed_springs_go_to_file_and_back(tmp_path: Path, undamped: ow.Turbine) -> None:
    """From the distributed springs of a turbine to SubDyn's file."""
    system = ow.build(undamped, "distributed_springs")
    condensed = ow.condense(system, ow.static(system, np.array([2e6, 0, 0, 0, 0, 0])))
    path = tmp_path / "ssi.dat"
    write_subdyn_ssi(path, condensed.symmetric)
    assert np.array_equal(read_subdyn_ssi(path)[0], condensed.symmetric)
