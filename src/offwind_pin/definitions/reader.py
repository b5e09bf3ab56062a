"""Reading of YAML definitions; errors name file, field, value, what is allowed and the remedy."""

from __future__ import annotations

import difflib
from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from offwind_pin.base.definition import Definition
from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import is_file
from offwind_pin.base.validation import input_error
from offwind_pin.base.yaml_files import read_yaml
from offwind_pin.definitions.shipped import shipped_turbines
from offwind_pin.definitions.turbine import Turbine

Kind = TypeVar("Kind", bound=Definition)


def load_turbine(name_or_path: str | Path) -> Turbine:
    """Turbine definition by shipped name or from a YAML file.

    Parameters
    ----------
    name_or_path : str or Path
        A shipped name (``"oc6_phase2"``) or the path of a YAML file.

    Returns
    -------
    Turbine

    Raises
    ------
    InputError
        An unknown name, or a file that cannot be read or is not a valid definition.
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
    """A definition from a YAML file; paths in it are relative to its folder.

    Raises
    ------
    InputError
        The file is empty, not YAML, or does not fit the definition.
    """
    return definition_of(read_yaml(path), path, kind)


def definition_of(data: dict[str, Any], path: Path, kind: type[Kind]) -> Kind:
    """A definition from the content of a file.

    Raises
    ------
    InputError
        The content does not fit the definition.
    """
    try:
        return kind.model_validate(data, context={"folder": path.parent})
    except ValidationError as error:
        raise input_error(str(path), data, error, kind, by_alias=True) from None
