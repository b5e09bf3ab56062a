"""Results read back from their files."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from offwind_pin.base.errors import InputError

_TITLE = "offwind-pin"


def open_results(source: Path) -> xr.Dataset:
    """A dataset that a run wrote, read channel by channel as they are asked for.

    Parameters
    ----------
    source : a directory of a run, or the file ``results.nc`` itself

    Raises
    ------
    InputError : no results there, or a file that is something else
    """
    path = source / "results.nc" if source.is_dir() else source
    remedy = "Name the directory of a finished `offwind run`, or a results.nc."
    if not path.is_file():
        raise InputError("results", str(path), "a file that is there", remedy)
    try:
        data = xr.open_dataset(path, engine="netcdf4")
    except (OSError, ValueError) as error:
        allowed = f"results of this program as NetCDF ({error})"
        raise InputError("results", str(path), allowed, remedy) from None
    title = str(data.attrs.get("title", ""))
    if not title.startswith(_TITLE):
        data.close()
        allowed = f"a title that begins with {_TITLE!r} (found {title!r})"
        raise InputError("results", str(path), allowed, remedy)
    return data


def analysed(histories: xr.Dataset) -> xr.Dataset:
    """The part after the ramp."""
    return histories.sel(time=histories.time >= float(histories.attrs.get("ramp_s", 0.0)))
