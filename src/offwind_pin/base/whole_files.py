"""Files written atomically."""

from __future__ import annotations

import errno
import json
import shutil
import uuid
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr


_CHUNK = 256
"""Instants per chunk of a file."""
_SMALL = 500
"""Number of values below which compression would enlarge a variable."""
_CACHE_BYTES = 2**20
"""Chunk cache of each variable while a file is written; the default is 16 times this."""


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A temporary path beside ``path`` that replaces it when the block succeeds.

    If the block fails, ``path`` is not changed.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.stem}.{uuid.uuid4().hex}{path.suffix}")
    try:
        yield temporary
        temporary.replace(path)
    except OSError as error:
        if error.filename in (None, str(temporary)):  # a failed write names no file
            error.filename = str(path)
        raise
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: Path, data: dict[str, Any]) -> None:
    write_text(path, json.dumps(data, indent=2, allow_nan=False) + "\n")


def write_netcdf(path: Path, data: xr.Dataset) -> None:
    """Compressed NetCDF."""
    append_netcdf(path, iter([data]))


def append_netcdf(
    path: Path, parts: Iterator[xr.Dataset], dtypes: Mapping[str, str] | None = None
) -> None:
    """The same from datasets that follow one another along ``time``, one at a time in memory.

    Parameters
    ----------
    dtypes : types of the numbers in the file, by variable, where they differ from those in memory
    """
    import netCDF4

    with whole_file(path) as temporary, _netcdf_errors():
        first = next(parts)
        unlimited = ["time"] if "time" in first.sizes else []
        encoding = _encoding(first, dtypes or {})
        first.to_netcdf(temporary, engine="netcdf4", encoding=encoding, unlimited_dims=unlimited)
        with netCDF4.Dataset(temporary, "a") as file:
            for kept in file.variables.values():
                kept.set_var_chunk_cache(size=_CACHE_BYTES)
            for part in parts:
                begin = len(file.dimensions["time"])
                for name, variable in part.variables.items():
                    if "time" in variable.dims:
                        file[str(name)][begin : begin + part.sizes["time"]] = variable.values


def add_groups(
    path: Path,
    groups: Mapping[str, xr.Dataset],
    complete: Callable[[Path], None] = lambda _: None,
) -> None:
    """Add datasets as groups to an existing NetCDF file, which is replaced as a whole.

    Parameters
    ----------
    complete : what is done last to the new file
    """
    with whole_file(path) as temporary, _netcdf_errors():
        shutil.copyfile(path, temporary)
        for name, data in groups.items():
            data.to_netcdf(
                temporary, mode="a", group=name, engine="netcdf4", encoding=_encoding(data, {})
            )
        complete(temporary)


@contextmanager
def _netcdf_errors() -> Iterator[None]:
    """Errors of the NetCDF library, such as those on a full disk, as OSError."""
    try:
        yield
    except RuntimeError as error:
        raise OSError(
            errno.EIO, f"the file cannot be written ({error}); is the disk full?"
        ) from error


def _encoding(data: xr.Dataset, dtypes: Mapping[str, str]) -> dict[Any, dict[str, Any]]:
    encoding = {}
    for name, variable in data.variables.items():
        how: dict[str, Any] = {}
        if variable.dtype.kind in "UO":
            # Strings of variable length crash HDF5 2.0 when it opens one such file after another.
            how["dtype"] = "S1"
        if "time" in variable.dims:
            # By default the file has one chunk per instant.
            how["chunksizes"] = [_CHUNK if d == "time" else data.sizes[d] for d in variable.dims]
        if name in data.data_vars:
            if variable.size > _SMALL or "time" in variable.dims:
                how |= {"zlib": True, "complevel": 1}
            if name in dtypes:
                how["dtype"] = dtypes[str(name)]
        encoding[name] = how
    return encoding
