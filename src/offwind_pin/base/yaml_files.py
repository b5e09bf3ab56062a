"""YAML files, by the core schema of YAML 1.2.

``045`` is 45, ``1e5`` a number, and ``yes``, ``on``, ``1:30`` and ``2020-01-01`` are text.
Duplicate keys, other tags, deep nesting, and aliases that expand to many values are rejected.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import yaml

from offwind_pin.base.errors import InputError, brief
from offwind_pin.base.input_files import read_text

if TYPE_CHECKING:
    _Base = yaml.SafeLoader
else:
    _Base = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

_LARGEST = 2_000_000
"""Bytes of a file."""
_DEEPEST = 50
_MOST_VALUES = 200_000
"""With aliases counted as often as they are used."""

_TAG = "tag:yaml.org,2002:"
_SCALARS = {
    "null": r"~|null|Null|NULL|",
    "bool": r"true|True|TRUE|false|False|FALSE",
    "int": r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+",
    "float": r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?"
    r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)",
}


class _Loader(_Base):
    """Loader of the core schema; its tables are its own."""

    yaml_implicit_resolvers: ClassVar[dict[str, Any]] = {}  # type: ignore[misc]
    yaml_constructors: ClassVar[dict[str | None, Any]] = {}


def _refused(problem: str, node: Any) -> yaml.MarkedYAMLError:
    return yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark)


def _mapping(loader: _Loader, node: yaml.MappingNode) -> dict[Any, Any]:
    found: dict[Any, Any] = {}
    for key_node, value_node in node.value:
        if not isinstance(key_node, yaml.ScalarNode):
            raise _refused("a key that is not a string", key_node)
        key = loader.construct_object(key_node, deep=True)
        if key in found:
            raise _refused(f"key {brief(key)} is given twice", key_node)
        found[key] = loader.construct_object(value_node, deep=True)
    return found


def _sequence(loader: _Loader, node: yaml.SequenceNode) -> list[Any]:
    return [loader.construct_object(child, deep=True) for child in node.value]


def _text(_: _Loader, node: yaml.ScalarNode) -> str:
    return str(node.value)


def _scalar(_: _Loader, node: yaml.ScalarNode) -> bool | int | float | None:
    kind, text = node.tag.removeprefix(_TAG), node.value
    if re.fullmatch(_SCALARS[kind], text) is None:  # a tag on something else
        raise _refused(f"{brief(text)} is not a valid {kind}", node)
    if kind == "null":
        return None
    if kind == "bool":
        return bool(text.lower() == "true")
    if kind == "float":
        return float(text.lower().replace(".inf", "inf").replace(".nan", "nan"))
    if len(text) > 400:
        raise _refused(f"an integer of {len(text)} digits", node)
    return int(text, {"0x": 16, "0o": 8}.get(text[:2], 10))


for _name, _form in _SCALARS.items():
    _Loader.add_implicit_resolver(f"{_TAG}{_name}", re.compile(f"(?:{_form})$"), None)
    _Loader.add_constructor(f"{_TAG}{_name}", _scalar)
_Loader.add_constructor(f"{_TAG}str", _text)
_Loader.add_constructor(f"{_TAG}seq", _sequence)
_Loader.add_constructor(f"{_TAG}map", _mapping)


def parse_yaml(text: str, path: Path) -> object:
    """Parse the text of a YAML file.

    Raises
    ------
    InputError
        The text is not YAML, or exceeds the limits on nesting and size.
    """
    try:
        _check_nesting(text)
        loader = _Loader(text)
        try:
            node = loader.get_single_node()
            if node is None:
                return None
            _check_size(node, {})
            return loader.construct_document(node)
        finally:
            loader.dispose()
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"{path}, line {mark.line + 1}" if mark else str(path)
        problem = getattr(error, "problem", None) or getattr(error, "reason", None) or "not YAML"
        raise InputError(
            where, problem, "valid YAML", "Correct the line; is the file complete?"
        ) from None


def read_yaml(path: Path) -> dict[str, Any]:
    """Read a YAML file that contains a mapping.

    Raises
    ------
    InputError
        The file cannot be read, is not YAML, or is not a mapping.
    """
    data = parse_yaml(read_text(path, _LARGEST), path)
    if data is None:
        raise InputError(str(path), "an empty file", "a YAML mapping", "Fill in the definition.")
    if not isinstance(data, dict):
        raise InputError(
            str(path), data, "a YAML mapping of keys to values", "Start from a shipped file."
        )
    return data


def _check_nesting(text: str) -> None:
    """Reject deep nesting event by event, before any recursion."""
    depth = 0
    for event in yaml.parse(text, Loader=_Loader):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if depth > _DEEPEST:
                raise _refused(f"more than {_DEEPEST} levels of nesting", event)
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1


def _check_size(node: yaml.Node, known: dict[int, tuple[int, int] | None]) -> tuple[int, int]:
    """Number of values and of levels of a node, its aliases expanded.

    Parameters
    ----------
    known : dict
        Result for the nodes before, by their identity; None while they are being counted.
    """
    if id(node) in known:
        counted = known[id(node)]
        if counted is None:
            raise _refused("an alias within its own anchor", node)
        return counted
    if node.tag not in _Loader.yaml_constructors:
        raise _refused(f"the tag {brief(node.tag)}", node)
    known[id(node)] = None
    size, depth = 1, 0
    if isinstance(node, yaml.CollectionNode):
        for child in node.value:
            for part in child if isinstance(child, tuple) else (child,):
                below = _check_size(part, known)
                size, depth = size + below[0], max(depth, 1 + below[1])
                if size > _MOST_VALUES or depth > _DEEPEST:
                    limits = f"{_MOST_VALUES} values or {_DEEPEST} levels"
                    raise _refused(f"aliases that expand to more than {limits}", node)
    known[id(node)] = size, depth
    return size, depth
