"""Arguments of the wrong type are input errors that name them; the right ones pass."""

from __future__ import annotations

import inspect
import pickle
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.base.arguments import checked


@checked
def example(
    number: float = 1.0,
    count: int | None = None,
    flag: bool = False,
    name: Literal["a", "b"] = "a",
    path: str | Path = "",
    array: NDArray[np.float64] | None = None,
    several: Sequence[float] = (),
    pairs: Sequence[tuple[float, float]] = (),
    mapping: Mapping[str, float] | None = None,
    call: Callable[[float], None] | None = None,
    system: ow.System | None = None,
    anything: Any = None,
) -> str:
    """Takes one of each."""
    return "taken"


RIGHT: dict[str, list[Any]] = {
    "number": [2, 2.5, np.float32(1), np.int64(3), np.array(4.0), float("nan")],
    "count": [3, None, np.int64(3)],
    "flag": [True, np.bool_(False)],
    "name": ["a", "z"],
    "path": ["x", Path("x")],
    "array": [np.zeros(3), [1, 2], [[1.0], [2.0]], None],
    "several": [[1, 2.0], (1,), np.zeros(2)],
    "pairs": [[(1, 2)], ((1.0, 2.0),), [[1, 2]]],
    "mapping": [{"a": 1.0}, None],
    "call": [print, None],
    "system": [None],
    "anything": [object()],
}
WRONG: dict[str, list[Any]] = {
    "number": ["1", True, None, [1.0], 1j, np.zeros(2), {}],
    "count": ["3", 3.0, True, np.float64(3), []],
    "flag": [1, "yes", None],
    "name": [1, None],
    "path": [3, b"x", None, []],
    "array": ["x", ["a"], [[1], [1, 2]], {}, object()],
    "several": ["12", 1.0, ["a"], {1: 2}, None, {1.0}],
    "pairs": [[1, 2], [(1,)], [("a", "b")]],
    "mapping": [[("a", 1.0)], "a"],
    "call": ["print", 1],
    "system": ["oc6_phase2", 1],
}


@pytest.mark.parametrize("argument", RIGHT)
def test_right_types(argument: str) -> None:
    assert all(example(**{argument: value}) == "taken" for value in RIGHT[argument])


@pytest.mark.parametrize("argument", WRONG)
def test_wrong_types(argument: str) -> None:
    for value in WRONG[argument]:
        with pytest.raises(ow.InputError, match=rf"example\(\), argument {argument}"):
            example(**{argument: value})


def test_calls_that_python_refuses() -> None:
    """A missing or an unknown argument is a fault of the call, as everywhere in Python."""
    with pytest.raises(TypeError, match="unknown"):
        example(unknown=1)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="missing"):
        ow.build()  # type: ignore[call-arg]


NAMESPACES = {"ow": ow, "soil": ow.soil, "wind": ow.wind, "signal": ow.signal, "viewer": ow.viewer}
OTHERS = {"shipped_turbines", "register_family", "register_foundation"}
"""Without arguments, and decorators of classes."""


def public_functions() -> dict[str, Callable[..., Any]]:
    return {
        name: getattr(space, name)
        for space in NAMESPACES.values()
        for name in getattr(space, "__all__", dir(space))
        if inspect.isfunction(getattr(space, name))
        and getattr(space, name).__module__.startswith("offwind_pin")
        and name not in OTHERS
    }


class Foreign:
    """Of no type that any function takes."""


@pytest.mark.parametrize("name", public_functions())
def test_public_functions(name: str) -> None:
    """Arguments of each are looked at; pickling finds the same function."""
    function = public_functions()[name]
    assert pickle.loads(pickle.dumps(function)) is function
    _, *rest = inspect.signature(function).parameters.values()
    needed = [one for one in rest if one.default is one.empty and one.kind is not one.VAR_KEYWORD]
    with pytest.raises(ow.InputError, match="argument "):
        function(Foreign(), **{one.name: Foreign() for one in needed})


CLASSES: dict[str, Callable[[], object]] = {
    "LoadHistory": lambda: ow.LoadHistory("a", "b", "c"),  # type: ignore[arg-type]
    "GroundMotion": lambda: ow.GroundMotion("a", "b"),  # type: ignore[arg-type]
    "FixedStep": lambda: ow.FixedStep("0.1"),  # type: ignore[arg-type]
    "AdaptiveStep": lambda: ow.AdaptiveStep(tolerance="1"),  # type: ignore[arg-type]
    "GeneralizedAlpha": lambda: ow.GeneralizedAlpha(ow.FixedStep(0.1), "0.9"),  # type: ignore[arg-type]
    "SaveAt": lambda: ow.SaveAt(output_dt="1"),  # type: ignore[arg-type]
    "RegularWaves": lambda: ow.RegularWaves("3", 8),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("name", CLASSES)
def test_classes(name: str) -> None:
    with pytest.raises(ow.InputError):
        CLASSES[name]()
