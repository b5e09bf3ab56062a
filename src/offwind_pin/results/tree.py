"""A case's results as one tree in one NetCDF file.

The root is the main dataset of a case: time histories, a static state or natural modes. Child
groups contain everything else. The dimensions of a group begin with the name of the group, since
xarray refuses a child that reuses a dimension of its parent with other values; :func:`part` removes
the prefix again.
"""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr

from offwind_pin.base.errors import InputError

TITLES = {
    "histories": "offwind-pin time histories",
    "static": "offwind-pin static state",
    "modes": "offwind-pin natural modes",
}
"""Title of the dataset of each part that may be the root of a tree."""


def prefixed(data: xr.Dataset, group: str) -> xr.Dataset:
    """A dataset with the dimensions that it has inside a group."""
    prefix = group.split("/")[0]
    return data.rename({name: f"{prefix}_{name}" for name in data.dims})


def make_tree(root: xr.Dataset, groups: Mapping[str, xr.Dataset]) -> xr.DataTree:
    """A tree in memory.

    Parameters
    ----------
    root : Dataset
    groups : mapping of str to Dataset
        Datasets by path, such as ``modes`` or ``static/clamped``, with plain dimensions.
    """
    children = {f"/{name}": prefixed(data, name) for name, data in groups.items()}
    return xr.DataTree.from_dict({"/": root, **children})


def part(tree: xr.DataTree, name: str) -> xr.Dataset | None:
    """One part of a tree with plain dimensions, or None if the tree does not have it.

    Parameters
    ----------
    name : str
        Name of a group; the root if it is that part.
    """
    if _is_root(tree, name):
        return tree.to_dataset(inherit=False)
    return _plain(tree.children[name], name) if name in tree.children else None


def required(tree: xr.DataTree, name: str) -> xr.Dataset:
    """As :func:`part`, for a required part.

    Raises
    ------
    InputError
        The tree does not have it.
    """
    found = part(tree, name)
    if found is None:
        raise InputError(
            "results", f"no group {name}", "results of `offwind run`", "Run the case again."
        )
    return found


def parts(tree: xr.DataTree, name: str) -> list[xr.Dataset]:
    """The root, if it is that part, and the children of a group, such as all static states."""
    found = [tree.to_dataset(inherit=False)] if _is_root(tree, name) else []
    if name in tree.children:
        found += [_plain(node, name) for node in tree.children[name].children.values()]
    return found


def _is_root(tree: xr.DataTree, name: str) -> bool:
    return name in TITLES and tree.attrs.get("title") == TITLES[name]


def _plain(node: xr.DataTree, prefix: str) -> xr.Dataset:
    data = node.to_dataset(inherit=False)
    return data.rename({name: str(name).removeprefix(f"{prefix}_") for name in data.dims})
