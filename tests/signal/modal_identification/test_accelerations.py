"""Measured accelerations out of CSV files: what is read, and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from helpers.white_noise import THREE_FORCES, three_modes
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.accelerations import read_accelerations

STEP = 0.05
VALUES = np.random.default_rng(1).normal(size=(80, 2))
TIME = STEP * np.arange(80) + 3.0


def rows(time: Array = TIME, values: Array = VALUES) -> list[str]:
    return [f"{t!r},{a!r},{b!r}" for t, (a, b) in zip(time.tolist(), values.tolist(), strict=True)]


def write(path: Path, lines: list[str], header: str = "time_s,top_x,mid_x") -> Path:
    file = path / "measured.csv"
    file.write_text("\n".join([header, *lines]) + "\n")
    return file


def test_round_trip(tmp_path: Path) -> None:
    """Every digit comes back; comments, blank lines and a byte-order mark do not matter."""
    plain = write(tmp_path, rows())
    found = read_accelerations(plain)
    assert np.array_equal(found.values, VALUES)
    assert np.array_equal(found.time, TIME)
    assert found.names == ("top_x", "mid_x")
    assert found.sample_rate == pytest.approx(20.0, rel=1e-12)
    lines = rows()
    lines[5:5] = ["# the crew left", ""]
    write(tmp_path, lines, "\ufeff# site A\ntime_s , top_x, mid_x")
    assert np.array_equal(read_accelerations(plain).values, VALUES)


def test_quoted_cells_and_blanks(tmp_path: Path) -> None:
    """What a spreadsheet writes is read, too."""
    lines = [", ".join(f'"{cell}"' for cell in row.split(",")) for row in rows()]
    file = write(tmp_path, [line.replace(", ", ",") for line in lines])
    assert np.array_equal(read_accelerations(file).values, VALUES)


def test_factor_and_choice(tmp_path: Path) -> None:
    """A unit is turned by its factor; channels are chosen by name, in the order asked for."""
    file = write(tmp_path, rows(), "time,top_g,mid_g")
    found = read_accelerations(file, factor=9.80665)
    assert_allclose(found.values, 9.80665 * VALUES, rtol=1e-15)
    chosen = found.select(["mid_g"])
    assert np.array_equal(chosen.values[:, 0], found.values[:, 1])
    assert read_accelerations(file, factor=1).values[0, 0] == VALUES[0, 0]
    for names in (["low_g"], []):
        with pytest.raises(InputError, match="names"):
            found.select(names)


def test_gravity_in_si_is_no_g(tmp_path: Path) -> None:
    """A mean of 9.81 is an upright sensor in m/s2, and is read; so is noise about 1 with a large
    spread."""
    upright = VALUES * 0.01 + [9.81, 0.0]
    assert read_accelerations(write(tmp_path, rows(values=upright))).values.shape == (80, 2)
    assert read_accelerations(write(tmp_path, rows(values=VALUES + 1.0))).values.shape == (80, 2)


def _broken(at: int, row: str) -> list[str]:
    lines = rows()
    lines[at] = row
    return lines


FAULTS: list[tuple[list[str], str, str]] = [
    (_broken(9, "3.45,bad,0.2"), "time_s,a,b", "line 11, column 2.*bad"),
    (_broken(9, "3.45,nan,0.2"), "time_s,a,b", "line 11, column 2.*nan"),
    (_broken(9, "3.45,,0.2"), "time_s,a,b", "line 11, column 2"),
    (_broken(9, "3.45,0.2"), "time_s,a,b", "line 11.*2 cells"),
    ([row + ",1.0" for row in rows()], "time_s,a,b", "line 2.*4 cells"),
    (rows()[:20] + rows()[23:], "time_s,a,b", "line 22.*without gaps"),
    (rows()[:20] + rows()[19:], "time_s,a,b", "line 22.*increasing times"),
    (_broken(9, "3.451,0.1,0.2"), "time_s,a,b", "line 11.*equal to within 1 %"),
    (rows()[:63], "time_s,a,b", "63 rows"),
    ([], "time_s,a,b", "0 rows"),
    (rows(values=VALUES * [1.0, 0.0]), "time_s,a,b", "channel b.*0 at all times"),
    (rows(values=VALUES * 0.01 + [0.0, -1.0]), "time_s,a,b", "channel b.*gravity.*factor"),
    (rows(), "time_s,a,b (g)", "channel b.*name that says g"),
    (rows(), "time_s,a,b_mg", "name that says g"),
    (rows(), "time_s,a,a", "a more than once"),
    (rows()[1:], rows()[0], "names time and channels"),
    (rows(), "time_s,a,", "names time and channels"),
    (rows(), "time_s;a;b", "with commas"),
    ([], "# nothing", "no rows"),
]


@pytest.mark.parametrize(("lines", "header", "message"), FAULTS)
def test_bad_files(tmp_path: Path, lines: list[str], header: str, message: str) -> None:
    """Each fault is told with its place."""
    with pytest.raises(InputError, match=message):
        read_accelerations(write(tmp_path, lines, header))


def test_missing_file_and_bad_factor(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_accelerations(tmp_path / "nowhere.csv")
    file = write(tmp_path, rows())
    for factor in (0.0, -1.0, float("nan")):
        with pytest.raises(InputError, match="factor"):
            read_accelerations(file, factor=factor)


def test_from_file_to_modes(tmp_path: Path) -> None:
    """A record in g through the file: the shapes of the same record in m/s2."""
    values = three_modes().accelerations(THREE_FORCES, 0.05, 20_000, seed=5)
    table: Any = np.column_stack([0.05 * np.arange(len(values)), values / 9.80665])
    file = tmp_path / "record.csv"
    np.savetxt(file, table, delimiter=",", header="time_s,a_g,b_g,c_g,d_g,e_g", comments="")
    read = ow.read_accelerations(file, factor=9.80665)
    found = ow.operational_modes(read.values, read.sample_rate, 50.0, names=read.names)
    direct = ow.operational_modes(values, 20.0, 50.0)
    assert_allclose(found.frequency_hz, direct.frequency_hz, rtol=1e-6)
    assert_allclose(found.shape, direct.shape, atol=1e-6)
    assert found.names == ("a_g", "b_g", "c_g", "d_g", "e_g")
