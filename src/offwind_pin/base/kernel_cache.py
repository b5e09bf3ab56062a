"""Files of compiled kernels that may be damaged, missing or impossible to write.

Numba trusts the files of its cache: a truncated index raises an exception, and damaged machine code
is run. Here each file ends with a checksum. What is damaged is compiled again, and a directory that
cannot be written to is reported once.
"""

from __future__ import annotations

import hashlib
import logging
import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any

from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    UserProvidedCacheLocator,
)

_DIGEST_BYTES = hashlib.sha256().digest_size

_log = logging.getLogger(__name__)


class _Locator(UserProvidedCacheLocator):
    """The directory of this package's kernels, whether or not it can be written to."""

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> Any:
        return cls(py_func, py_file) if os.path.exists(py_file) else None  # noqa: PTH110


class _Implementation(CompileResultCacheImpl):
    _locator_classes = [_Locator]  # noqa: RUF012 (as Numba declares it)


class _Files(IndexDataCacheFile):
    """Index and machine code of one kernel."""

    def _load_index(self) -> Any:
        return super()._load_index() if _is_whole(self._index_path) else {}  # type: ignore[no-untyped-call]

    def _load_data(self, name: str) -> Any:
        path = self._data_path(name)  # type: ignore[no-untyped-call]
        if not _is_whole(path):
            raise FileNotFoundError(path)  # Numba then compiles
        return super()._load_data(name)  # type: ignore[no-untyped-call]

    @contextmanager
    def _open_for_write(self, filepath: str) -> Iterator[BytesIO]:
        buffer = BytesIO()
        yield buffer
        content = buffer.getvalue()
        with super()._open_for_write(filepath) as file:
            file.write(content + hashlib.sha256(content).digest())


class KernelCache(FunctionCache):
    """Numba's cache of one function, with checksums."""

    _impl_class = _Implementation

    def __init__(self, py_func: Any) -> None:
        super().__init__(py_func)  # type: ignore[no-untyped-call]
        self._cache_file = _Files(  # type: ignore[no-untyped-call]
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=self._impl.locator.get_source_stamp(),
        )

    def save_overload(self, sig: Any, data: Any) -> None:
        try:
            super().save_overload(sig, data)  # type: ignore[no-untyped-call]
        except OSError as error:
            _report_unwritable(str(Path(self._cache_path).parent), error.strerror or str(error))


def _is_whole(path: str) -> bool:
    """Whether a file exists and ends with its checksum; Numba ignores what follows its data."""
    try:
        data = Path(path).read_bytes()
    except OSError:
        return False
    content, digest = data[:-_DIGEST_BYTES], data[-_DIGEST_BYTES:]
    if hashlib.sha256(content).digest() == digest:
        return True
    _report_damaged(str(Path(path).parents[1]))
    return False


@cache
def _report_damaged(directory: str) -> None:
    _log.warning("damaged files of compiled code in %s are compiled again and replaced", directory)


@cache
def _report_unwritable(directory: str, reason: str) -> None:
    _log.warning(
        "compiled code cannot be kept in %s (%s), so it is compiled again in every process; make "
        "room there, or set XDG_CACHE_HOME to another directory",
        directory,
        reason,
    )
