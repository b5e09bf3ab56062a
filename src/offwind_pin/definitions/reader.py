"""Reading of YAML definitions; errors name file, field, value, what is allowed, remedy."""

from __future__ import annotations

import difflib
from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from offwind_pin.base.definition import with_paths
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.shipped import shipped_turbines
from offwind_pin.definitions.turbine import Turbine

Model = TypeVar("Model", bound=BaseModel)
Schema = dict[str, Any]


def load_turbine(name_or_path: str | Path) -> Turbine:
    """Turbine definition by shipped name or from a YAML file.

    Parameters
    ----------
    name_or_path : a shipped name (``"oc6_phase2"``) or the path of a YAML file

    Raises
    ------
    InputError : the name is unknown, or the file cannot be read or understood
    """
    path = find_definition(name_or_path, shipped_turbines(), "turbine")
    turbine = read_model(path, Turbine)
    return with_paths(turbine, lambda file: (path.parent / file).absolute())


def find_definition(name_or_path: str | Path, shipped: list[str], kind: str) -> Path:
    """Path of a shipped turbine or case by name, or of the user's own file."""
    text = str(name_or_path)
    if text in shipped:
        folder = {"turbine": "definitions/library", "case": "cases/oc6_phase2"}[kind]
        with resources.as_file(resources.files("offwind_pin")) as package:
            return Path(package) / folder / f"{text.removeprefix('oc6-')}.yaml"
    path = Path(text)
    if path.is_file():
        return path
    near = difflib.get_close_matches(text, shipped, n=1)
    hint = f"Did you mean {near[0]!r}?" if near else "Check the path."
    raise InputError(
        kind, text, f"a shipped name ({', '.join(shipped)}) or the path of a YAML file", hint
    )


def read_model(path: Path, model: type[Model]) -> Model:
    """A pydantic model from a YAML file.

    Raises
    ------
    InputError : the file is empty, not YAML, or does not fit the model
    """
    data = _read_yaml(path)
    try:
        return model.model_validate(data)
    except ValidationError as error:
        raise _input_error(path, data, error, model) from None


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


def _input_error(
    path: Path, data: object, error: ValidationError, model: type[BaseModel]
) -> InputError:
    """The first thing pydantic found wrong, told to a person."""
    found = sorted(error.errors(), key=lambda item: item["type"] != "extra_forbidden")
    first = found[0]
    location = _typed(first, data)
    field = ".".join(str(part) for part in location) or "the file"
    others = [
        ".".join(map(str, place))
        for place in (_typed(item, data) for item in found[1:])
        if place != location  # another alternative for the same value
    ]
    more = f" (More to mend in this file: {_enumerate(others)}.)" if others else ""
    where = f"{path}, field {field}"
    if first["type"] == "extra_forbidden":
        known = _known_keys(model, location[:-1], data)
        near = difflib.get_close_matches(str(location[-1]), known, n=1, cutoff=0.5)
        remedy = f"Did you mean {near[0]!r}?" if near else "Remove it."
        return InputError(where, "an unknown key", ", ".join(known), remedy + more)
    if first["type"] == "missing":
        return InputError(where, "nothing", "a value (the field is required)", "Add it." + more)
    message = first["msg"].removeprefix("Value error, ")
    if first["type"] == "value_error":
        fault, _, remedy = message.partition("; ")
        return InputError(where, fault, "parts that fit together", _sentence(remedy) + more)
    context = first.get("ctx", {})
    if first["type"].startswith("union_tag"):
        where += f".{str(context['discriminator']).strip(chr(39))}"
        received = context.get("tag", "nothing")
        allowed = context.get("expected_tags", "a kind").replace("'", "")
        return InputError(where, received, allowed, "Choose one of them." + more)
    remedy = "Check the unit named in the key." if {"ge", "gt", "le", "lt"} & set(context) else ""
    alternatives = [item["msg"] for item in found if _typed(item, data) == location]
    allowed = ", or: ".join(dict.fromkeys([message, *alternatives]))
    return InputError(where, first["input"], allowed, (remedy or "Correct the value.") + more)


def _sentence(remedy: str) -> str:
    return f"{remedy[:1].upper()}{remedy[1:]}." if remedy else "Correct it."


def _enumerate(places: list[str], most: int = 5) -> str:
    shown = list(dict.fromkeys(places))
    rest = f" and {len(shown) - most} more" if len(shown) > most else ""
    return ", ".join(shown[:most]) + rest


def _typed(error: ErrorDetails, data: object) -> tuple[int | str, ...]:
    """Place of an error without the tags pydantic puts in for the chosen member of a union.

    No user typed them. A missing key, the last part of its place, is not in the data either.
    """
    location = error["loc"]
    end = len(location) - (error["type"] == "missing")
    kept: list[int | str] = []
    entered = False
    for i, part in enumerate(location):
        if entered and isinstance(data, dict) and part in (data.get("kind"), data.get("model")):
            entered = False
            continue
        absent = not isinstance(data, dict | list) or (isinstance(data, dict) and part not in data)
        if absent and i < end:
            continue
        kept.append(part)
        if (isinstance(data, dict) and part in data) or (
            isinstance(data, list) and isinstance(part, int) and part < len(data)
        ):
            data = data[part]  # type: ignore[index]
            entered = True
    return tuple(kept)


def _known_keys(model: type[BaseModel], location: tuple[int | str, ...], data: object) -> list[str]:
    """Keys that are accepted at a place of a definition.

    Of a union they are those of the member that the data choose by its kind, else of every member.
    """
    schema = model.model_json_schema(by_alias=True)
    nodes = [schema]
    for part in location:
        nodes = [below for node in nodes for below in _below(schema, node, part, data)]
        try:
            data = data[part]  # type: ignore[index]
        except (KeyError, IndexError, TypeError):
            data = None
    return sorted(
        {
            name
            for node in nodes
            for choice in _choices(schema, node, data)
            for name in choice["properties"]
        }
    )


def _below(schema: Schema, node: Schema, part: int | str, data: object) -> list[Schema]:
    """The schemas of an item or a key."""
    if isinstance(part, int):
        return [choice["items"] for choice in _choices(schema, node, data, "items")]
    named = _choices(schema, node, data, "additionalProperties")
    return [
        choice["properties"][part]
        for choice in _choices(schema, node, data)
        if part in choice["properties"]
    ] + [choice["additionalProperties"] for choice in named if choice["additionalProperties"]]


def _choices(
    schema: Schema, node: Schema, data: object, having: str = "properties"
) -> list[Schema]:
    """A schema with its references and unions resolved, those alternatives that have a key."""
    if "$ref" in node:
        whole = schema["$defs"][node["$ref"].rsplit("/", 1)[-1]]
        return _choices(schema, whole, data, having)
    if "discriminator" in node and isinstance(data, dict):
        kinds = node["discriminator"]
        chosen = kinds["mapping"].get(data.get(kinds["propertyName"]))
        if chosen is not None:
            return _choices(schema, {"$ref": chosen}, data, having)
    alternatives = node.get("anyOf", []) + node.get("oneOf", [])
    found = [choice for below in alternatives for choice in _choices(schema, below, data, having)]
    return [*found, node] if having in node else found
