"""Input errors from pydantic's validation errors."""

from __future__ import annotations

import difflib
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from offwind_pin.base.errors import InputError, brief

Schema = dict[str, Any]
Place = tuple[int | str, ...]


def input_error(
    where: str, data: object, error: ValidationError, model: type[BaseModel], *, by_alias: bool
) -> InputError:
    """Input error for the first fault that pydantic found, with the fields of the others.

    Parameters
    ----------
    where : str
        File or class with the fault.
    data : object
        The given data.
    by_alias : bool
        Whether fields are named as in a file, or as in Python.
    """
    found = sorted(
        error.errors(include_url=False), key=lambda item: item["type"] != "extra_forbidden"
    )
    first = found[0]
    cause = first.get("ctx", {}).get("error")
    if isinstance(cause, InputError):  # of another file that this one names
        cause_of = _dotted(first["loc"]) if first["loc"] else ""
        return cause.within(f"{where}, field {cause_of}" if cause_of else where)
    names = {} if by_alias else {_alias(model, name): name for name in model.model_fields}
    places = [_place(item, data, names) for item in found]
    location = places[0]
    others = [_dotted(place) for place in places[1:] if place != location]
    more = f" (Other faults: {_enumerate(others)}.)" if others else ""
    where = f"{where}, field {_dotted(location)}" if location else where
    if first["type"] == "extra_forbidden":
        known = _known_keys(model, location[:-1], data, by_alias=by_alias)
        near = difflib.get_close_matches(str(location[-1])[:100], known, n=1, cutoff=0.5)
        remedy = f"Did you mean {near[0]!r}?" if near else "Remove it."
        return InputError(where, "an unknown key", ", ".join(known), remedy + more)
    if first["type"] == "missing":
        return InputError(where, "a required key is missing", "", "Add it." + more)
    message = _message(first)
    if first["type"] == "value_error":
        fault, _, remedy = message.partition("; ")
        return InputError(where, fault, "", _sentence(remedy) + more)
    context = first.get("ctx", {})
    if first["type"].startswith("union_tag"):
        where += f".{str(context['discriminator']).strip(chr(39))}"
        if "tag" not in context:
            return InputError(where, "a required key is missing", "", "Add it." + more)
        allowed = context["expected_tags"].replace("'", "")
        return InputError(where, context["tag"], allowed, "Choose one of them." + more)
    remedy = "Check the unit." if {"ge", "gt", "le", "lt"} & set(context) else ""
    alternatives = [
        _message(item) for item, place in zip(found, places, strict=True) if place == location
    ]
    allowed = ", or: ".join(dict.fromkeys([message, *alternatives]))
    return InputError(where, first["input"], allowed, (remedy or "Correct the value.") + more)


def _message(item: ErrorDetails) -> str:
    return item["msg"].removeprefix("Value error, ").removeprefix("Input should be ")


def _alias(model: type[BaseModel], name: str) -> str:
    alias = model.model_fields[name].validation_alias
    return alias if isinstance(alias, str) else name


def _dotted(place: Place) -> str:
    return ".".join(
        part if isinstance(part, str) and len(part) <= 80 else brief(part, 80) for part in place
    )


def _sentence(remedy: str) -> str:
    return f"{remedy[:1].upper()}{remedy[1:]}." if remedy else "Correct it."


def _enumerate(places: list[str], most: int = 5) -> str:
    shown = list(dict.fromkeys(places))
    rest = f" and {len(shown) - most} more" if len(shown) > most else ""
    return ", ".join(shown[:most]) + rest


def _place(error: ErrorDetails, data: object, names: dict[str, str]) -> Place:
    """Location of an error without pydantic's tags for the chosen member of a union.

    The tags are not in the user's data. A missing key, the last part of its location, is not
    either.
    """
    location = error["loc"]
    end = len(location) - (error["type"] == "missing")
    kept: list[int | str] = []
    entered = False
    for i, part in enumerate(location):
        if entered and isinstance(data, dict) and part in (data.get("kind"), data.get("model")):
            entered = False
            continue
        present = (isinstance(data, dict) and part in data) or (
            isinstance(data, list | tuple) and isinstance(part, int) and part < len(data)
        )
        if not present and i < end:
            continue
        kept.append(part)
        if present:
            data = data[part]  # type: ignore[index]
            entered = True
    if kept and isinstance(kept[0], str):
        kept[0] = names.get(kept[0], kept[0])
    return tuple(kept)


def _known_keys(
    model: type[BaseModel], location: Place, data: object, *, by_alias: bool
) -> list[str]:
    """Keys that are accepted at a location in a definition.

    For a union they are those of the member chosen by the kind in the data, otherwise of all
    members.
    """
    schema = model.model_json_schema(by_alias=by_alias)
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
    """Schemas of an item or a key."""
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
    """Alternatives of a schema that have a key, with references and unions resolved."""
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
