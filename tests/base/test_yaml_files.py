"""YAML files: the core schema of YAML 1.2, within limits."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

import offwind_pin as ow
from offwind_pin.base.yaml_files import parse_yaml, read_yaml

SCALARS: dict[str, Any] = {
    "045": 45,
    "-007": -7,
    "+12": 12,
    "0o17": 15,
    "0x1F": 31,
    "1e5": 1e5,
    "1.": 1.0,
    ".5": 0.5,
    "-1.5E-3": -1.5e-3,
    ".inf": math.inf,
    "true": True,
    "False": False,
    "null": None,
    "~": None,
    "": None,
    "1:30": "1:30",
    "yes": "yes",
    "on": "on",
    "n": "n",
    "2001-01-01": "2001-01-01",
    "2001-99-99": "2001-99-99",
    "1_000": "1_000",
    "\u0664\u0660": "\u0664\u0660",
    "'045'": "045",
    "0b1": "0b1",
    "1e": "1e",
    "<<": "<<",
}


@pytest.mark.parametrize("text", SCALARS)
def test_scalars(text: str) -> None:
    """As in the core schema; YAML 1.1 has 37 for 045, 90 for 1:30 and true for yes."""
    data = parse_yaml(f"value: {text}\n", Path("a.yaml"))
    assert isinstance(data, dict)
    assert data["value"] == SCALARS[text]
    assert type(data["value"]) is type(SCALARS[text])


def test_aliases_are_taken() -> None:
    """Negative control of the bombs: a block that is used twice."""
    data = parse_yaml("a: &a {b: [1, 2]}\nc: *a\n", Path("a.yaml"))
    assert data == {"a": {"b": [1, 2]}, "c": {"b": [1, 2]}}


def test_files_of_other_programs(tmp_path: Path) -> None:
    """A byte-order mark and the line ends of Windows are read; another encoding is refused."""
    path = tmp_path / "a.yaml"
    path.write_bytes(b"\xef\xbb\xbfname: a\r\nnumber: 1\r\n")
    assert read_yaml(path) == {"name": "a", "number": 1}
    for content in ("name: \u00e4".encode("latin-1"), "name: a".encode("utf-16")):
        path.write_bytes(content)
        with pytest.raises(ow.InputError, match=r"a\.yaml.*UTF-8"):
            read_yaml(path)


@pytest.mark.parametrize(
    "value", ["045x", "1:30", "yes", "on", "true", "'30'", "1_0", "\u0663\u0660"]
)
@pytest.mark.parametrize("key", ["water_depth_m: 30", "nodes: 20"])
def test_text_for_a_number(tmp_path: Path, value: str, key: str) -> None:
    """None of these is a number in a definition, with a decimal point or whole."""
    source = Path(ow.__file__).parent / "definitions" / "library" / "oc3_phase2.yaml"
    whole = source.read_text()
    name = key.split(":")[0]
    line = next(line for line in whole.splitlines() if line.strip().startswith(f"{name}:"))
    path = tmp_path / "turbine.yaml"
    path.write_text(whole.replace(line, line.split(":")[0] + f": {value}"))
    with pytest.raises(ow.InputError, match=rf"turbine\.yaml, field [\w.]*{name}"):
        ow.load_turbine(path)


@pytest.mark.parametrize("value", ["20.0", "true", "1e1", "1000000000000"])
def test_whole_numbers(tmp_path: Path, value: str) -> None:
    """A count is written without a decimal point, and is bounded."""
    source = Path(ow.__file__).parent / "definitions" / "library" / "oc3_phase2.yaml"
    whole = source.read_text()
    line = next(line for line in whole.splitlines() if line.strip().startswith("nodes:"))
    path = tmp_path / "turbine.yaml"
    path.write_text(whole.replace(line, line.split(":")[0] + f": {value}"))
    with pytest.raises(ow.InputError, match="nodes"):
        ow.load_turbine(path)
