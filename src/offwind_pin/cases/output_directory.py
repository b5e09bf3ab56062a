"""Places for results, checked before a long solve and not after it."""

from __future__ import annotations

import os
from pathlib import Path

from offwind_pin.base.errors import InputError


def check_writable(directory: Path) -> None:
    """Make sure that files can be written into a directory, there already or to be made.

    Raises
    ------
    InputError
        Something on the way is a file, or must not be written to.
    """
    nearest = directory.absolute()
    while not os.path.lexists(nearest):
        nearest = nearest.parent
    if not nearest.is_dir():
        raise InputError(
            "--out", str(directory), f"a directory, but {nearest} is none", "Name another."
        )
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise InputError(
            "--out", str(directory), "a directory that you may write to", "Name another."
        )
