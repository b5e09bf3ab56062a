"""Reading of YAML definitions; errors name file, field, value, what is allowed and the remedy."""

from __future__ import annotations

import difflib
from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import ValidationError

from offwind_pin.base.definition import Definition
from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import is_file
from offwind_pin.base.validation import input_error
from offwind_pin.definitions.shipped import shipped_turbines
from offwind_pin.definitions.turbine import Turbine

Kind = TypeVar("Kind", bound=Definition)


def load_turbine(name_or_path: str | Path) -> Turbine:
    """Turbine definition by shipped name or from a YAML file.

    Parameters
    ----------
    name_or_path : str or Path
        A shipped name (``"oc6_phase2"``) or the path of a YAML file.

    Raises
    ------
    InputError
        The name is unknown, or the file cannot be read or understood.
    """
    path = find_definition(name_or_path, shipped_turbines(), "turbine")
    return read_definition(path, Turbine)


def find_definition(name_or_path: str | Path, shipped: list[str], kind: str) -> Path:
    """Path of a shipped turbine or case by name, or of the user's own file."""
    text = str(name_or_path)
    if text in shipped:
        folder = {"turbine": "definitions/library", "case": "cases/oc6_phase2"}[kind]
        with resources.as_file(resources.files("offwind_pin")) as package:
            return Path(package) / folder / f"{text.removeprefix('oc6-')}.yaml"
    path = Path(text)
    if is_file(path):
        return path
    near = difflib.get_close_matches(text, shipped, n=1)
    hint = f"Did you mean {near[0]!r}?" if near else "Check the path."
    raise InputError(
        kind, text, f"a shipped name ({', '.join(shipped)}) or the path of a YAML file", hint
    )


def read_definition(path: Path, kind: type[Kind]) -> Kind:
    """A definition from a YAML file; relative paths in it start at its folder.

    Raises
    ------
    InputError
        The file is empty, not YAML, or does not fit the definition.
    """
    data = _read_yaml(path)
    try:
        return kind.model_validate(data, context={"folder": path.parent})
    except ValidationError as error:
        raise input_error(str(path), data, error, kind, by_alias=True) from None


class _UniqueKeyLoader(yaml.SafeLoader):
    """Safe loader that refuses a key given twice (YAML would keep the last in silence)."""


def _mapping(loader: _UniqueKeyLoader, node: yaml.MappingNode) -> dict[Any, Any]:
    seen: dict[Any, Any] = {}
    for key_node, value_node in node.value:
        key = loader.construct_object(key_node, deep=True)
        if isinstance(key, list | dict):
            raise yaml.MarkedYAMLError(problem="a key must be a name", problem_mark=node.start_mark)
        if key in seen:
            raise yaml.MarkedYAMLError(
                problem=f"key {key!r} is given twice", problem_mark=key_node.start_mark
            )
        seen[key] = loader.construct_object(value_node, deep=True)
    return seen


_UniqueKeyLoader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)


def _read_yaml(path: Path) -> dict[str, Any]:
    try:
        data = yaml.load(path.read_text(encoding="utf-8"), Loader=_UniqueKeyLoader)  # noqa: S506
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(
            str(path), str(error), "a readable UTF-8 text file", "Check the file and its encoding."
        ) from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{path}, line {mark.line + 1}" if mark else str(path)
        problem = getattr(error, "problem", None) or "not YAML"
        raise InputError(
            place, problem, "valid YAML", "Correct the line; is the file complete?"
        ) from None
    except (ValueError, TypeError, RecursionError) as error:
        raise InputError(
            str(path), str(error), "valid YAML of numbers, texts, lists and mappings", "Correct it."
        ) from None
    if data is None:
        raise InputError(str(path), "an empty file", "a YAML mapping", "Fill in the definition.")
    if not isinstance(data, dict):
        raise InputError(
            str(path), data, "a YAML mapping of keys to values", "Start from a shipped file."
        )
    return data
