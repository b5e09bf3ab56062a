"""Every public object prints as one short line, whatever it holds; tables for notebooks."""

from __future__ import annotations

import dataclasses
import html
import inspect
import re
from typing import Any

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.base.descriptions import LONGEST, html_table, one_line
from offwind_pin.base.mode_labels import mode_name

NAMESPACES = (ow, ow.sea, ow.soil, ow.wind, ow.signal)
RESULTS = {"ModalResult", "StaticResult", "System"}
"""Classes that describe themselves by what they found; they are made by solving below."""

DATACLASSES = {
    name: thing
    for space in NAMESPACES
    for name in space.__all__
    if dataclasses.is_dataclass(thing := getattr(space, name)) and not inspect.isabstract(thing)
}


INPUTS = {
    "CurrentSum",
    "CurrentTable",
    "IrregularWaves",
    "JonswapSpectrum",
    "LoadHistory",
    "MeasuredWaves",
    "RegularWaves",
    "RotorWind",
    "Spreading",
    "StillWater",
    "StreamWaves",
    "SurfaceRecord",
    "SyntheticWind",
    "TmaSpectrum",
    "TowerWind",
    "WindSeries",
}
"""Inputs of seas and winds, which print what they were made of."""


class Long:
    """Something of a user's own that prints over many lines."""

    def __repr__(self) -> str:
        return "many\nlines " * 100


def stuffing(annotation: str) -> Any:
    """A large value for a field."""
    for begin, value in {
        "Array": np.linspace(0, 1, 3000).reshape(-1, 3),
        "ComplexArray": np.linspace(0, 1j, 3000),
        "tuple": tuple(np.linspace(0, 1, 1000).tolist()),
        "list": ["FA1"] * 1000,
        "dict": {f"key {i}": np.linspace(0, 1, 1000) for i in range(3)},
        "str": "line\n" * 200,
        "float": 1 / 3,
        "int": 123456789,
    }.items():
        if annotation.startswith(begin):
            return value
    return Long()


def stuffed(kind: type) -> Any:
    """An object whose fields are large; no check of the class is run."""
    thing = object.__new__(kind)
    for item in dataclasses.fields(kind):
        object.__setattr__(thing, item.name, stuffing(str(item.type)))
    return thing


def is_one_short_line(text: str) -> bool:
    return len(text) < 300 and "\n" not in text and not re.search(r"array\(|(\d\.\d+,? +){5}", text)


@pytest.mark.parametrize("name", sorted(DATACLASSES.keys() - RESULTS - INPUTS))
def test_repr_is_one_short_line(name: str) -> None:
    text = repr(stuffed(DATACLASSES[name]))
    assert is_one_short_line(text)
    assert text.startswith(f"{name}(")


def test_long_reprs_are_found() -> None:
    """Negative control: the checks refuse what NumPy and dataclasses print by themselves."""

    @dataclasses.dataclass
    class Plain:
        values: Any

    assert not is_one_short_line(repr(Plain(np.zeros((30, 3)))))
    assert not is_one_short_line(repr(np.linspace(0, 1, 30)))
    assert not is_one_short_line(repr(Plain(Long())))


def test_one_line_gives_what_differs_from_the_defaults() -> None:
    @dataclasses.dataclass
    class Made:
        height: float
        kind: str = "plain"
        series: Any = None

    assert one_line(Made(2.0)) == "Made(height=2.0)"
    assert one_line(Made(np.float64(2.0), "steep")) == "Made(height=2.0, kind='steep')"
    assert (
        one_line(Made(2.0, series=np.zeros((7, 3)))) == "Made(height=2.0, series=<7 x 3 ndarray>)"
    )
    assert len(one_line(Made(2.0, series=[Long()] * 4))) <= LONGEST


def test_reprs_of_what_was_solved(clamped_dry: ow.System) -> None:
    """Structure, state and modes print the facts that a person looks for."""
    state = ow.static(clamped_dry)
    modes = ow.modes(clamped_dry, 8, about=state)
    for thing in (clamped_dry, clamped_dry.turbine, state, modes):
        assert is_one_short_line(repr(thing))
    assert "oc6_phase2" in repr(clamped_dry.turbine)
    assert f"{clamped_dry.nv} degrees of freedom" in repr(clamped_dry)
    assert f"{state.mudline_load[4] / 1e6:.4g} MN m" in repr(state)
    assert f"{modes.label[0]} {modes.frequency_hz[0]:.4g} Hz" in repr(modes)


def cells(page: str) -> list[list[str]]:
    """Texts of the cells of an HTML table, row by row."""
    return [
        [html.unescape(cell) for cell in re.findall(r"<t[dh]>(.*?)</t[dh]>", row)]
        for row in re.findall(r"<tr>(.*?)</tr>", page)
    ]


def test_tables_in_notebooks(clamped_dry: ow.System) -> None:
    """A row for each mode, height, member; the numbers are those of the results."""
    state = ow.static(clamped_dry)
    modes = ow.modes(clamped_dry, 8, about=state)
    head, *rows = cells(modes._repr_html_())
    assert len(rows) == 8
    assert [row[0] for row in rows] == modes.label
    assert [row[1] for row in rows] == [mode_name(label) for label in modes.label]
    assert {len(row) for row in rows} == {len(head)}
    np.testing.assert_allclose([float(row[2]) for row in rows], modes.frequency_hz, atol=1e-4)
    head, *rows = cells(state._repr_html_())
    table = np.array(rows, dtype=float)
    assert {len(row) for row in rows} == {len(head)}
    np.testing.assert_allclose(table[::-1, 0], state.height, atol=0.01)
    np.testing.assert_allclose(table[::-1, 6:] * 1e6, state.section_load, rtol=1e-3)
    turbine = clamped_dry.turbine
    assert len(cells(turbine._repr_html_())) == 1 + len(turbine.members)
    assert ["elements", str(clamped_dry.chain.elements)] in cells(clamped_dry._repr_html_())


def test_tables_escape_what_they_are_given() -> None:
    page = html_table("a < b", ["<script>"], [["<b>&", 1]])
    assert "<script>" not in page
    assert cells(page) == [["<script>"], ["<b>&", "1"]]
