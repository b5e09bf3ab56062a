"""An exclusive lock on a directory."""

from __future__ import annotations

import errno
import fcntl
import json
import logging
import os
import socket
from datetime import UTC, datetime
from pathlib import Path

from offwind_pin.base.errors import InputError

LOCK = ".offwind-pin.lock"
_NO_LOCKS = {errno.ENOLCK, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS}

_log = logging.getLogger(__name__)


class FolderLock:
    """A lock on a directory, which the operating system releases when the process ends.

    The directory is created if necessary, and removed again on release if nothing is in it.

    Parameters
    ----------
    directory : Path

    Raises
    ------
    InputError
        Another run has the lock.
    """

    def __init__(self, directory: Path) -> None:
        self._path = directory / LOCK
        self._created = _missing(directory)
        directory.mkdir(parents=True, exist_ok=True)
        self._file = self._open()
        # The run that had the lock may have removed the file after it was opened here.
        while not self.intact:
            os.close(self._file)
            self._file = self._open()
        owner = {
            "process": os.getpid(),
            "host": socket.gethostname(),
            "since": datetime.now(UTC).isoformat(timespec="seconds"),
        }
        os.ftruncate(self._file, 0)
        os.pwrite(self._file, json.dumps(owner).encode(), 0)

    @property
    def intact(self) -> bool:
        """Whether the directory is the one that was locked."""
        try:
            return os.path.samestat(os.fstat(self._file), self._path.stat())
        except (FileNotFoundError, NotADirectoryError):
            return False

    def release(self) -> None:
        if self.intact:
            self._path.unlink()
        os.close(self._file)
        for directory in self._created:
            try:
                directory.rmdir()
            except OSError:  # something is in it
                break

    def _open(self) -> int:
        file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            owner = os.pread(file, 1000, 0).decode(errors="replace")
            os.close(file)
            raise InputError(
                str(self._path.parent),
                f"a directory that another run is writing to ({_in_words(owner)})",
                "a directory that no run uses",
                "Wait until that run has ended, or name another directory.",
            ) from None
        except OSError as error:
            if error.errno not in _NO_LOCKS:
                os.close(file)
                raise
            _log.warning(
                "the file system of %s has no locks; make sure that no other run writes there",
                self._path.parent,
            )
        return file


def _missing(directory: Path) -> list[Path]:
    """The directories that have to be created, the deepest first."""
    found = []
    while not directory.exists():
        found.append(directory)
        directory = directory.parent
    return found


def _in_words(owner: str) -> str:
    try:
        about = json.loads(owner)
        return f"process {about['process']} on {about['host']} since {about['since']}"
    except (json.JSONDecodeError, KeyError, TypeError):  # it is being written
        return "just started"
