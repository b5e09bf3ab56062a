"""Results read back from their files."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from offwind_pin.base.errors import InputError
from offwind_pin.results.channels import channel_fault
from offwind_pin.results.manifest import RESULTS
from offwind_pin.results.tree import TITLES

_TITLE = "offwind-pin"
_REMEDY = "Name the output directory of `offwind run`, or a results.nc."


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
        No results found, a file of another origin, or channels other than those declared.
    """
    given = Path(source)
    path = given / RESULTS if given.is_dir() else given
    if not path.is_file():
        raise InputError("results", str(path), "an existing file", _REMEDY)
    try:
        tree = xr.open_datatree(path, engine="netcdf4")
    except (OSError, ValueError) as error:
        allowed = f"results of this program as NetCDF ({error})"
        raise InputError("results", str(path), allowed, _REMEDY) from None
    title = str(tree.attrs.get("title", ""))
    if not title.startswith(_TITLE):
        tree.close()
        allowed = f"a title that begins with {_TITLE!r} (found {title!r})"
        raise InputError("results", str(path), allowed, _REMEDY)
    if title == TITLES["histories"]:
        fault = channel_fault(tree.to_dataset(inherit=False))
        if fault is not None:
            tree.close()
            raise InputError(
                str(path),
                fault,
                "time histories as this version writes them",
                "Run the case again.",
            )
    return tree


def open_case(source: Path | str) -> xr.DataTree:
    """As :func:`open_results`, of a file that a case was written to with all its groups.

    Raises
    ------
    InputError
        As there; or only the main dataset is present.
    """
    tree = open_results(source)
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


def analysed(histories: xr.Dataset) -> xr.Dataset:
    """The part after the ramp."""
    return histories.sel(time=histories.time >= float(histories.attrs.get("ramp_s", 0.0)))
