"""Input files: checked before they are opened, and read as a whole."""

from __future__ import annotations

import stat
from pathlib import Path

from offwind_pin.base.errors import InputError

_KINDS = {
    stat.S_IFDIR: "a directory",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}


def is_file(path: Path) -> bool:
    """Whether a path is a regular file; False for an invalid path."""
    try:
        return path.is_file()
    except (OSError, ValueError):  # too long a name; a NUL in it
        return False


def check_file(path: Path) -> int:
    """Size in bytes of a regular file; pipes and devices, which could block, are rejected.

    Raises
    ------
    InputError
        There is no such file, or it is of another kind.
    """
    try:
        found = path.stat()
    except FileNotFoundError:
        raise InputError(str(path), "no such file", "an existing file", "Check the path.") from None
    except (OSError, ValueError) as error:
        raise _unreadable(path, error) from None
    if not stat.S_ISREG(found.st_mode):
        kind = _KINDS.get(stat.S_IFMT(found.st_mode), "no regular file")
        raise InputError(
            str(path), kind, "a regular file", "Give a file; write a stream to a file first."
        )
    return found.st_size


def read_bytes(path: Path, most: int | None = None) -> bytes:
    """Content of a file.

    Parameters
    ----------
    most : int, optional
        Largest size in bytes.

    Raises
    ------
    InputError
        It is missing, too large, or cannot be read.
    """
    size = check_file(path)
    if most is not None and size > most:
        raise InputError(
            str(path),
            f"{size / 1e6:.3g} MB",
            f"at most {most / 1e6:.3g} MB",
            "Is it the right file? Use separate files for long tables.",
        )
    try:
        return path.read_bytes()
    except OSError as error:
        raise _unreadable(path, error) from None


def read_text(path: Path, most: int | None = None) -> str:
    """A UTF-8 text file, with or without a byte-order mark, with line feeds as line ends.

    Parameters
    ----------
    most : int, optional
        Largest size in bytes.

    Raises
    ------
    InputError
        It is missing, too large, cannot be read, or is not text.
    """
    content = read_bytes(path, most)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            str(path), str(error), "a UTF-8 text file", "Save it as UTF-8; is it a text file?"
        ) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _unreadable(path: Path, error: OSError | ValueError) -> InputError:
    reason = getattr(error, "strerror", None) or str(error)
    return InputError(str(path), reason, "a readable file", "Check the path and its permissions.")
