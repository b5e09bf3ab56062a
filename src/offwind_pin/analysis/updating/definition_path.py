"""Numbers of a turbine definition by dotted path, read or replaced."""

from __future__ import annotations

import difflib
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from offwind_pin.base.errors import InputError

Model = TypeVar("Model", bound=BaseModel)


def number_at(definition: BaseModel, path: str) -> float:
    """The number at a path such as ``soil.distributed_springs.curve.modulus.gradient``.

    A step is a field by its name in Python or in files, a key of a mapping, or the index of an item
    from 0.

    Raises
    ------
    InputError
        An unknown step, with the closest known one; or a value that is not a number.
    """
    node: Any = definition
    steps = path.split(".")
    for i, step in enumerate(steps):
        node = _below(node, _key(node, step, path, i))
    if isinstance(node, bool) or not isinstance(node, int | float):
        kind = "an empty block" if node is None else f"a {type(node).__name__}"
        remedy = _hint(node)
        raise InputError(f"path {path!r}", kind, "the path of a number", remedy)
    return float(node)


def with_number(definition: Model, path: str, value: float) -> Model:
    """A copy with another number at a path, with every block on the path validated again.

    Raises
    ------
    InputError
        An unknown step, or a number that the definition does not allow.
    """
    try:
        return _replaced(definition, path.split("."), value, path, 0)
    except ValidationError as error:
        message = error.errors()[0]["msg"].removeprefix("Value error, ")
        raise InputError(f"path {path!r}", value, message, "Narrow the bounds.") from None


def _replaced(node: Any, steps: list[str], value: float, path: str, depth: int) -> Any:
    if depth == len(steps):
        return value
    key = _key(node, steps[depth], path, depth)
    new = _replaced(_below(node, key), steps, value, path, depth + 1)
    if isinstance(node, BaseModel):
        return type(node).model_validate({**dict(node), key: new})
    if isinstance(node, dict):
        return {**node, key: new}
    return (*node[:key], new, *node[key + 1 :])


def _key(node: Any, step: str, path: str, depth: int) -> Any:
    """Field name, mapping key or index of a step."""
    steps = _steps(node)
    if step in steps:
        return steps[step]
    where = f"path {path!r}, step {depth + 1}"
    known = list(steps)
    near = difflib.get_close_matches(step, known, n=1, cutoff=0.4)
    hint = f"Did you mean {near[0]!r}?" if near else "Choose one of them."
    if not known:
        place = ".".join(path.split(".")[:depth])
        hint = f"{place!r} has no further steps: end the path there, or fill in that block first."
    raise InputError(where, step, ", ".join(known) or "no further step", hint)


def _steps(node: Any) -> dict[str, Any]:
    """Possible next steps of a node, by their text."""
    if isinstance(node, BaseModel):
        fields = type(node).model_fields
        names: dict[str, Any] = {name: name for name in fields}
        return names | {f.alias: name for name, f in fields.items() if f.alias}
    if isinstance(node, dict):
        return {str(key): key for key in node}
    if isinstance(node, tuple):
        return {str(i): i for i in range(len(node))}
    return {}


def _below(node: Any, key: Any) -> Any:
    return getattr(node, key) if isinstance(node, BaseModel) else node[key]


def _hint(node: Any) -> str:
    steps = ", ".join(_steps(node))
    return f"Continue to one of {steps}." if steps else "Choose another path."
