"""Results read back from their files."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from offwind_pin.base.definition import file_digest
from offwind_pin.base.errors import InputError
from offwind_pin.results.inventory import fault_of
from offwind_pin.results.manifest import RESULTS, read_manifest
from offwind_pin.results.root import root_fault
from offwind_pin.results.tree import TITLES

_REMEDY = "Name the output directory of `offwind run` or its results.nc, or run the case again."


def open_results(source: Path | str) -> xr.DataTree:
    """The results of a run as a tree, read channel by channel on demand.

    Parameters
    ----------
    source : Path or str
        Output directory of a run, or the file ``results.nc`` itself.

    Returns
    -------
    DataTree
        Close it after use, or use it in a ``with`` statement.

    Raises
    ------
    InputError
        No results found; or a file that is damaged, or of other origin or version.
    """
    path = _results_file(Path(source))
    try:
        tree = xr.open_datatree(path, engine="netcdf4")
    except Exception as error:  # whatever a file that is something else makes the libraries raise
        raise _unreadable(path, str(error)) from None
    _check(tree, path, histories=False)
    return tree


def open_checked(source: Path | str) -> xr.DataTree:
    """As :func:`open_results`, with all values checked, which takes reading the file once.

    Raises
    ------
    InputError
        As there.
    """
    tree = open_results(source)
    _check(tree, _results_file(Path(source)), histories=True)
    return tree


def open_case(source: Path | str) -> xr.DataTree:
    """As :func:`open_checked`, of a file that a case was written to with all its groups.

    Raises
    ------
    InputError
        As for :func:`open_results`; or only the main dataset is present.
    """
    tree = open_checked(source)
    if "case" not in tree.children:
        tree.close()
        raise InputError(
            "results",
            str(source),
            "results of `offwind run` of this version, with the groups case, structure, ...",
            "Run the case again: this file is from an older version, from ow.simulate, or from a "
            "run that was killed before it had finished.",
        )
    return tree


def _results_file(given: Path) -> Path:
    """The file to read; in the directory of a run, as the run wrote it."""
    path = given / RESULTS if given.is_dir() else given
    if not path.is_file():
        raise InputError("results", str(path), "an existing file", _REMEDY)
    manifest = read_manifest(path.parent) if path.name == RESULTS else None
    digest = None if manifest is None else manifest.files.get(RESULTS)
    if digest is not None and digest != file_digest(path):
        raise _unreadable(path, "a file that was damaged or changed since the run wrote it")
    return path


def _check(tree: xr.DataTree, path: Path, *, histories: bool) -> None:
    """Close a tree and refuse it if it is not as this version writes one."""
    try:
        fault = _fault(tree, histories=histories)
    except Exception as error:  # as in open_results, of a value
        fault = f"{type(error).__name__}: {error}"
    if fault is not None:
        tree.close()
        raise _unreadable(path, fault)


def _fault(tree: xr.DataTree, *, histories: bool) -> str | None:
    title = str(tree.attrs.get("title", ""))
    if title not in TITLES.values():
        return f"title {title!r}, not one of {', '.join(map(repr, TITLES.values()))}"
    if "case" in tree.children:
        return fault_of(tree, histories=histories)
    if tree.children:
        return "groups without the group case"
    return root_fault(tree.to_dataset(inherit=False), values=histories)


def _unreadable(path: Path, fault: str) -> InputError:
    allowed = "results of this program as NetCDF, as this version writes them"
    return InputError(str(path), fault, allowed, _REMEDY)


def analysed(histories: xr.Dataset) -> xr.Dataset:
    """The part after the ramp."""
    return histories.sel(time=histories.time >= float(histories.attrs.get("ramp_s", 0.0)))
