"""The manifest of a directory of results: what run it is of, and which files are the run's own."""

from __future__ import annotations

import json
import sys
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from offwind_pin.base.errors import InputError
from offwind_pin.base.fingerprint import package_digest

MANIFEST = "manifest.json"
BLOCKS = "blocks"
"""Folder of the blocks of a time history."""

FileName = Literal["results.nc", "summary.json", "report.html"]
RESULTS: FileName = "results.nc"
SUMMARY: FileName = "summary.json"
REPORT: FileName = "report.html"
State = Literal["running", "interrupted", "failed", "solved", "complete"]
Values = dict[str, Any]
Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]

_PROGRAMS = {"numpy": "numpy", "scipy": "scipy", "numba": "numba", "pinocchio": "pin"}


class _Entry(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class BlockEntry(_Entry):
    """A block of a time history.

    Attributes
    ----------
    file : str
        Name in the folder of blocks.
    begin_s, end_s : float, s
        Simulated time of the first and of the last record.
    sha256 : str
        Of the file.
    """

    file: Annotated[str, Field(pattern=r"^block_\d{6,}\.npz$")]
    begin_s: float
    end_s: float
    sha256: Digest


class Simulation(_Entry):
    """What determines a time history; a stopped one is resumed only if all of it is the same.

    Attributes
    ----------
    settings : dict of str to object
        Of the simulation, with seeds.
    inputs : dict of str to str or None
        Fingerprints of loads, foundation, structure and recorded heights by name; None for a load
        that has none.
    environment : dict of str to str
        Versions of the programs that may change a result, if only in its last digits.
    """

    settings: Values
    inputs: dict[str, str | None]
    environment: dict[str, str]


class Manifest(_Entry):
    """Content of ``manifest.json``.

    Attributes
    ----------
    run_id : str
        Drawn when the run begins.
    run : dict of str to object
        What identifies the run: the name of the case, its content hash, the version.
    state : {"running", "interrupted", "failed", "solved", "complete"}
        ``solved`` if ``results.nc`` has everything, and report and summary are still to be written.
    files : dict of str to str or None
        SHA-256 of the files of the run; None for one that is being written.
    simulation : Simulation or None
        None for a run without a time history.
    blocks : tuple of BlockEntry or None
        None if there is no folder of blocks.
    """

    format: Literal["offwind-pin run 1"] = "offwind-pin run 1"
    run_id: str
    run: Values
    state: State
    files: dict[FileName, Digest | None]
    simulation: Simulation | None = None
    blocks: tuple[BlockEntry, ...] | None = None


def read_manifest(directory: Path) -> Manifest | None:
    """The manifest of a directory, or None if it has none.

    Raises
    ------
    InputError
        A file of this name that cannot be read, or is not a manifest.
    """
    path = directory / MANIFEST
    try:
        return Manifest.model_validate_json(path.read_bytes())
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as error:
        fault = error.strerror if isinstance(error, OSError) else error.errors()[0]["msg"]
        raise InputError(
            str(path),
            f"a file that is not a manifest ({fault})",
            f"no {MANIFEST}, or the one that offwind run wrote",
            "Restore it, or name another directory; files without a manifest are not replaced.",
        ) from None


@cache
def environment() -> dict[str, str]:
    """Versions of the programs that may change a result, if only in its last digits."""
    return {
        "offwind_pin": metadata.version("offwind-pin"),
        "offwind_pin_sources": package_digest(),
        **{name: metadata.version(package) for name, package in _PROGRAMS.items()},
        "python": f"{sys.version_info.major}.{sys.version_info.minor}",
    }


def plain(values: Values) -> Values:
    """Values as they are after a way through JSON."""
    return dict(json.loads(json.dumps(values)))
