"""Output directories, checked before a long solve."""

from __future__ import annotations

import os
from pathlib import Path

from offwind_pin.base.errors import InputError


def check_writable(directory: Path) -> None:
    """Check that files can be written to a directory, existing or not.

    Raises
    ------
    InputError
        Part of the path is a file, or is not writable.
    """
    nearest = directory.absolute()
    while not os.path.lexists(nearest):
        nearest = nearest.parent
    if not nearest.is_dir():
        raise InputError(
            "--out", str(directory), f"a directory; {nearest} is not one", "Choose another."
        )
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise InputError("--out", str(directory), "a writable directory", "Choose another.")
