"""Tables of numbers: what is read, how, and what is refused."""

from __future__ import annotations

import math
import os
import stat
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import offwind_pin as ow
from offwind_pin.base import number_tables
from offwind_pin.base.input_files import check_file, read_text
from offwind_pin.base.number_tables import (
    RowReader,
    parse_number,
    read_csv,
    read_numbers,
    read_time_columns,
)
from offwind_pin.loads.sea.waves.surface_record import read_surface_record


def table(folder: Path, text: str | bytes) -> Path:
    path = folder / "table.txt"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


@pytest.mark.parametrize(
    ("text", "value"),
    [("1", 1.0), ("-.5", -0.5), ("5.", 5.0), ("+1.5e-3", 1.5e-3), ("2E5", 2e5), ("007", 7.0)],
)
def test_numbers(text: str, value: float) -> None:
    assert parse_number(text) == value


@pytest.mark.parametrize(
    "text",
    [
        "4_0e5",
        "4_0",
        "\u0664\u0660",
        "\uff11",
        "nan",
        "inf",
        "1e999",
        "0x10",
        "1,5",
        "",
        " 1",
        "1e",
        "1d3",
        "--1",
        "1.2.3",
        "true",
        "1 2",
    ],
)
def test_what_is_no_number(text: str) -> None:
    """Python takes some of these."""
    assert parse_number(text) is None


CELLS = st.sampled_from(
    ["1", "-2.5", "3e4", ".5", "7.", "4_0", "nan", "x", "", "1e", "1-2", "+", "e5"]
)


@given(
    rows=st.lists(st.lists(CELLS, min_size=1, max_size=4), min_size=1, max_size=5),
    separator=st.sampled_from([" ", "\t", ",", ", ", ";", " ; ", " ,"]),
    asked=st.sampled_from([None, ",", " "]),
)
def test_both_parsers_agree(rows: list[list[str]], separator: str, asked: str | None) -> None:
    """Whatever NumPy's parser takes, the rules take as the same numbers in the same lines."""
    text = "\n".join(separator.join(row) for row in rows) + "\n"
    reader = RowReader(Path("table"), 3, asked)
    at_once = reader._at_once(text)
    if at_once is None:
        return
    lines = [(i, line) for i, line in enumerate(text.split("\n")) if line.strip()]
    assert np.array_equal(at_once, [reader._one(i, line) for i, line in lines])


def test_parser_of_whole_pieces_is_used() -> None:
    """Negative control of the comparison: plain tables do not go line by line."""
    for text, asked in (("1 2 3\n4 5 6\n", None), ("1, 2,3\n4,5 ,6\n", None), ("1,2,3\n", ",")):
        at_once = RowReader(Path("table"), 3, asked)._at_once(text)
        assert at_once is not None
        assert at_once[0].tolist() == [1, 2, 3]


@pytest.mark.parametrize("piece", [7, 23, 10_000])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_pieces(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, piece: int, end: str) -> None:
    """Rows and line numbers do not depend on where the file is cut, nor on the ends of its lines."""
    monkeypatch.setattr(number_tables, "_PIECE", piece)
    lines = [
        "# Kr\u00e4fte",
        "time [s] eta",
        "",
        *(f"{i} {i**2}.25" for i in range(40)),
        "! end",
        "40 7",
    ]
    path = table(tmp_path, "\ufeff" + end.join(lines))
    found = read_time_columns(path, 2, coarsest=0.1, header=True)
    assert found.values[:, 0].tolist() == list(range(41))
    assert found.values[39, 1] == 39**2 + 0.25
    assert found.lines.tolist() == [*range(4, 44), 45]


def test_quoted_cells(tmp_path: Path) -> None:
    """A CSV file may put its cells in quotes, and each row keeps its line."""
    path = table(tmp_path, 'a,b\n"1","2"\n# note\n3,4\n')
    found = read_numbers(path, ("a", "b"))
    assert found.values.tolist() == [[1, 2], [3, 4]]
    assert found.lines.tolist() == [2, 4]
    assert read_csv(path, lambda cells, _: tuple(cells)).names == ("a", "b")


FAULTS: dict[str, tuple[str, int, str]] = {
    "decimal commas and blanks": ("0 1,5 2,5 3,5\n1 1,5 2,5 3,5\n", 7, "line 1.*decimal commas"),
    "decimal commas and semicolons": ("0,0;1,5\n1,0;2,5\n", 2, "line 1.*decimal commas"),
    "decimal commas and tabs": ("0,0\t1,5\n1,0\t2,5\n", 4, "line 1.*decimal commas"),
    "decimal commas between commas": ("0,0,1,5\n1,0,2,5\n", 2, "line 1.*4 cells.*decimal commas"),
    "one decimal comma": ("0 1\n1 2,5\n", 2, "line 2.*decimal commas"),
    "underscores": ("0 1\n1 4_0e5\n", 2, "line 2, column 2.*4_0e5"),
    "digits of another script": ("0 1\n1 \u0664\n", 2, "line 2, column 2"),
    "stars": ("0 1\n1 ****\n", 2, r"line 2, column 2.*\*\*\*\*"),
    "NaN": ("0 1\n1 nan\n", 2, "line 2, column 2.*nan"),
    "infinity by overflow": ("0 1\n1 1e999\n", 2, "line 2, column 2.*1e999"),
    "an empty cell": ("0,1,2\n1,,2\n", 3, "line 2, column 2"),
    "a NUL": ("0 1\n1 \0\n", 2, "not text"),
    "times in ms by name": ("# time [ms], force\n0 1\n1 2\n", 2, r"time \[ms.*convert|Convert"),
    "times in ms by header": ("t_ms eta\n0 1\n1 2\n", 2, "t_ms"),
    "times in minutes": ("# time (min)\n0 1\n1 2\n", 2, "time in s"),
    "times in ms by scale": ("\n".join(f"{20 * i} 1" for i in range(50)), 2, "times in ms"),
    "times beyond any run": ("\n".join(f"{0.9 * i} 1" for i in range(200_000)), 2, "times in ms"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_faults(tmp_path: Path, fault: str) -> None:
    text, count, message = FAULTS[fault]
    with pytest.raises(ow.InputError, match=message) as caught:
        read_time_columns(table(tmp_path, text), count, coarsest=1.0, header=True)
    assert "table.txt" in caught.value.where


@pytest.mark.parametrize("unit", ["# time [s]", "# time in seconds", "t_s eta", "! t (s), eta (m)"])
def test_coarse_times_that_are_named(tmp_path: Path, unit: str) -> None:
    """Steps that look like ms are s where the file says so; short tables are not judged."""
    rows = "\n".join(f"{20 * i} 1" for i in range(50))
    named = table(tmp_path, f"{unit}\n{rows}\n")
    assert read_time_columns(named, 2, coarsest=1.0, header=True).values[-1, 0] == 980
    short = table(tmp_path, "0 1\n600 1\n")
    assert read_time_columns(short, 2, coarsest=1.0).values[-1, 0] == 600


def test_elevations_in_ms(tmp_path: Path) -> None:
    """The same rows are a sea in s and none in ms; a name of the unit decides."""
    rows = [f"{50 * i} {math.sin(0.3 * i)}" for i in range(100)]
    with pytest.raises(ow.InputError, match="in ms"):
        read_surface_record(table(tmp_path, "\n".join(rows)))
    seconds = [f"{0.05 * i} {math.sin(0.3 * i)}" for i in range(100)]
    with pytest.raises(ow.InputError, match="Convert the times to s"):
        read_surface_record(table(tmp_path, "\n".join(["time_ms,eta_m", *seconds])))
    assert read_surface_record(table(tmp_path, "\n".join(seconds))).dt == pytest.approx(0.05)


def test_closing_line_of_openfast_modules(tmp_path: Path) -> None:
    """HydroDyn and SubDyn end their text files with a line that is no row."""
    text = "0 1\n1 2\n\nThis output file was closed on 01-Jan-2024 at 12:00:00.\n"
    assert len(read_time_columns(table(tmp_path, text), 2, coarsest=1.0).values) == 2


READERS: dict[str, Callable[[Path], object]] = {
    "columns": lambda path: read_time_columns(path, 2, coarsest=1.0),
    "load history": ow.read_load_history,
    "text": read_text,
    "turbine": ow.load_turbine,
    "accelerations": ow.signal.read_accelerations,
}


@pytest.mark.parametrize("reader", READERS)
def test_pipes_and_devices(tmp_path: Path, reader: str) -> None:
    """A pipe without a writer, a device and a directory are refused at once."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    paths = [pipe, tmp_path, Path("/dev/zero"), tmp_path / ("n" * 5000), tmp_path / "a\0b"]
    for path in paths:
        with pytest.raises(ow.InputError):
            READERS[reader](path)
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_sizes_are_bounded(tmp_path: Path) -> None:
    path = table(tmp_path, "x" * 1000)
    assert check_file(path) == 1000
    with pytest.raises(ow.InputError, match="at most"):
        read_text(path, 999)
