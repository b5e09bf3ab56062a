"""What a file of results contains, recorded in the file itself when it is written.

A file is read only if its groups, variables and attributes are those of its inventory: it is
neither damaged, nor changed, nor written by another program or an older version.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

FORMAT = 1
"""Counts up with every change of groups, variables or attributes that readers notice."""

_ATTRIBUTE = "inventory"
_TIMES_OF_THE_RUN = ("wall_s", "resumed_at_s")
"""Attributes of the group ``case`` that differ between runs of the same case."""
_CHUNK = 2048
"""Rows of a variable in memory at once."""

Listed = dict[str, Any]


def add_inventory(path: Path) -> None:
    """Record the content of a file with a group ``case`` in an attribute of this group."""
    with xr.open_datatree(path, engine="netcdf4") as tree:
        groups = {node.path: _listed(node) for node in tree.subtree}
    text = json.dumps({"format": FORMAT, "groups": groups}, sort_keys=True)
    with netCDF4.Dataset(path, "a") as file:
        file["case"].setncattr(_ATTRIBUTE, text)


def fault_of(tree: xr.DataTree, *, histories: bool) -> str | None:
    """What in a tree differs from its inventory; None where nothing does.

    Parameters
    ----------
    tree : DataTree
        With a group ``case``.
    histories : bool
        Whether the values of variables over time are compared, which takes reading all of them.
    """
    attributes = tree["case"].attrs
    if _ATTRIBUTE not in attributes:
        return "no inventory in the group case: it is of an older version or another program"
    recorded = json.loads(str(attributes[_ATTRIBUTE]))
    if recorded["format"] != FORMAT:
        return f"format {recorded['format']}, while this version reads format {FORMAT}"
    groups: dict[str, Listed] = recorded["groups"]
    found = {node.path: node for node in tree.subtree}
    for path in sorted(found.keys() ^ groups.keys()):
        return f"group {path} {'is missing' if path in groups else 'was added'}"
    for path, listed in groups.items():
        for fault in _faults(found[path], listed, histories=histories):
            return f"group {path}, {fault}"
    for name in _TIMES_OF_THE_RUN:
        if not math.isfinite(float(attributes[name])):
            return f"group /case, attribute {name} is not a number"
    return None


def _listed(node: xr.DataTree) -> Listed:
    data = node.to_dataset(inherit=False)
    return {
        "attributes": {str(name): _short_digest(value) for name, value in _kept(data)},
        "variables": {
            str(name): [*_form(variable), _digest(variable)]
            for name, variable in data.variables.items()
        },
    }


def _faults(node: xr.DataTree, listed: Listed, *, histories: bool) -> Iterator[str]:
    data = node.to_dataset(inherit=False)
    attributes = {str(name): _short_digest(value) for name, value in _kept(data)}
    for name, digest in listed["attributes"].items():
        if attributes.get(name) != digest:
            yield f"attribute {name} {'was changed' if name in attributes else 'is missing'}"
    expected: dict[str, Any] = listed["variables"]
    for name in sorted({str(name) for name in data.variables} ^ expected.keys()):
        yield f"variable {name} {'is missing' if name in expected else 'was added'}"
    for name, (*form, digest) in expected.items():
        variable = data.variables[name]
        for what, is_there, should_be in zip(
            ("dimensions", "shape", "type"), _form(variable), form, strict=True
        ):
            if is_there != should_be:
                yield f"variable {name}, {what} {is_there}, not {should_be}"
        if (histories or "time" not in variable.dims or name == "time") and (
            _digest(variable) != digest
        ):
            yield f"variable {name} was changed"


def _kept(data: xr.Dataset) -> list[tuple[Any, Any]]:
    skipped = (_ATTRIBUTE, *_TIMES_OF_THE_RUN)
    return [(name, value) for name, value in data.attrs.items() if name not in skipped]


def _form(variable: xr.Variable) -> list[Any]:
    kind = "text" if variable.dtype.kind in "OSU" else str(variable.dtype)
    units = str(variable.attrs.get("units", ""))
    return [[*map(str, variable.dims)], list(variable.shape), f"{kind} {units}".strip()]


def _digest(variable: xr.Variable) -> str:
    """SHA-256 of the values, read part by part."""
    digest = hashlib.sha256()
    if variable.dtype.kind in "OSU":
        digest.update(json.dumps(variable.values.tolist()).encode())
    elif variable.ndim == 0:
        digest.update(variable.values.tobytes())
    else:
        for begin in range(0, variable.shape[0], _CHUNK):
            part = variable[begin : begin + _CHUNK].values
            digest.update(np.ascontiguousarray(part).tobytes())
    return digest.hexdigest()


def _short_digest(value: object) -> str:
    plain = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
    return hashlib.sha256(json.dumps(plain).encode()).hexdigest()[:16]
