"""The directory of one run, locked while the run writes to it.

Only files that the manifest lists, with the checksums that they had when they were written, are
replaced or removed.
"""

from __future__ import annotations

import errno
import re
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, Self, cast

from offwind_pin.base.definition import file_digest
from offwind_pin.base.errors import InputError
from offwind_pin.base.whole_files import write_json
from offwind_pin.results.folder_lock import FolderLock
from offwind_pin.results.manifest import (
    BLOCKS,
    MANIFEST,
    REPORT,
    RESULTS,
    SUMMARY,
    BlockEntry,
    FileName,
    Manifest,
    State,
    Values,
    plain,
    read_manifest,
)

_TEMPORARY = re.compile(
    r"\.(results|summary|report|manifest|block_\d+)\.[0-9a-f]{32}\.(nc|json|html|npz)"
)
"""Names of files that a killed process was writing."""


class RunFolder:
    """A directory of results, locked until :meth:`close`.

    Parameters
    ----------
    directory : Path
        Created if necessary.
    run : dict of str to object, or None
        What identifies the run; None for whichever run is in the directory.
    overwrite : bool
        Whether the files of an earlier run are replaced, once this one has results.

    Attributes
    ----------
    manifest : Manifest or None
        None before the run has begun.

    Raises
    ------
    InputError
        Another run is writing there; or the directory contains results of another run, or files
        that are not a run's own.
    """

    def __init__(self, directory: Path, run: Values | None, *, overwrite: bool = False) -> None:
        self.directory = directory
        self._run = run
        self._lock = FolderLock(directory)
        try:
            self._earlier = read_manifest(directory)
            self.manifest = None if overwrite else self._earlier
            if run is not None:
                self._check_run(plain(run))
                self._check_files()
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Release the lock."""
        self._lock.release()

    @property
    def state(self) -> State | None:
        """How far the run is; None before it has begun."""
        return None if self.manifest is None else self.manifest.state

    @property
    def time_reached(self) -> float:
        """Simulated time in s that the blocks reach, or zero."""
        blocks = None if self.manifest is None else self.manifest.blocks
        return blocks[-1].end_s if blocks else 0.0

    def begin(self) -> Manifest:
        """Write the manifest of the run, if it has none yet; files of an earlier run are removed.

        Raises
        ------
        FileNotFoundError
            As :meth:`check`.
        """
        if self.manifest is None:
            self.check()
            if self._earlier is not None:
                self._remove_files(self._earlier)
            run = plain(self._run or {})
            self._write(Manifest(run_id=uuid.uuid4().hex, run=run, state="running", files={}))
        return cast("Manifest", self.manifest)

    def update(self, **changed: Any) -> None:
        """Change fields of the manifest.

        Raises
        ------
        FileNotFoundError
            As :meth:`check`.
        """
        self._write(self.begin().model_copy(update=changed))

    def check(self) -> None:
        """Make sure that the directory is still there.

        Raises
        ------
        FileNotFoundError
            It was removed or replaced.
        """
        if not self._lock.intact:
            raise FileNotFoundError(
                errno.ENOENT,
                "the directory of the run was removed or replaced while the run was writing to "
                "it; the run has stopped, and its results are lost",
                str(self.directory),
            )

    @contextmanager
    def replacing(self, name: FileName) -> Iterator[Path]:
        """Path of a file of the run, which the block writes.

        Raises
        ------
        InputError
            There is such a file, and it is not the run's own.
        """
        files = self._own_files(name)
        self.update(files=files | {name: None})
        yield self.directory / name
        self.check()
        self.update(files=files | {name: file_digest(self.directory / name)})

    def remove(self, name: FileName) -> None:
        """Remove a file of the run, if it exists.

        Raises
        ------
        InputError
            As :meth:`replacing`.
        """
        files = self._own_files(name)
        (self.directory / name).unlink(missing_ok=True)
        files.pop(name, None)
        self.update(files=files)

    def finish(self) -> None:
        """Mark the run as complete; remove blocks, and what killed processes left half written."""
        if self.state != "complete":
            self.update(state="complete")
        manifest = self.begin()
        if manifest.blocks is not None:
            self._remove_blocks(manifest)
            self.update(blocks=None)
        _remove_temporary(self.directory)

    def _write(self, manifest: Manifest) -> None:
        self.check()
        write_json(self.directory / MANIFEST, manifest.model_dump(mode="json"))
        self.manifest = manifest

    def _own_files(self, name: FileName) -> dict[FileName, str | None]:
        manifest = self.begin()
        if not self._is_own(manifest, name):
            raise self._foreign([name])
        return dict(manifest.files)

    def _is_own(self, manifest: Manifest | None, name: FileName) -> bool:
        """Whether a file does not exist, or is as a run wrote it."""
        path = self.directory / name
        if not path.exists() and not path.is_symlink():
            return True
        if manifest is None or name not in manifest.files or not path.is_file():
            return False
        digest = manifest.files[name]
        return digest is None or digest == file_digest(path)

    def _check_run(self, run: Values) -> None:
        if self.manifest is None or self.manifest.run == run:
            return
        found = self.manifest.run
        name = next(key for key in (*run, *found) if found.get(key) != run.get(key))
        raise InputError(
            str(self.directory),
            f"results of another run, with {name} {found.get(name, 'none')}",
            f"results with {name} {run.get(name, 'none')}, or a directory without results",
            "Name another directory, or replace these results with --overwrite (overwrite=True in "
            "Python).",
        )

    def _check_files(self) -> None:
        """Refuse a directory where files that are not the run's own have the names of its files."""
        complete = self.state == "complete"
        names: tuple[FileName, ...] = (RESULTS, SUMMARY)
        if not complete:
            names = (*names, REPORT)
        foreign: list[str] = [name for name in names if not self._is_own(self._earlier, name)]
        if not complete:
            foreign += self._foreign_blocks()
        if foreign:
            raise self._foreign(foreign)
        if complete and not (self.directory / RESULTS).exists():
            self.manifest = None
        if self.manifest is not None and self.manifest.blocks and not complete:
            self._check_blocks(self.manifest, self.manifest.blocks)

    def _foreign_blocks(self) -> list[str]:
        """What is where the blocks are, and was not written by a run."""
        folder = self.directory / BLOCKS
        if not folder.exists() and not folder.is_symlink():
            return []
        blocks = None if self._earlier is None else self._earlier.blocks
        if blocks is None or not folder.is_dir():
            return [BLOCKS]
        listed = {entry.file for entry in blocks}
        found = sorted(path.name for path in folder.glob("block_*.npz"))
        return [f"{BLOCKS}/{name}" for name in found if name not in listed]

    def _check_blocks(self, manifest: Manifest, blocks: tuple[BlockEntry, ...]) -> None:
        """Refuse blocks that are missing or changed. A kill may leave the last entry alone."""
        folder = self.directory / BLOCKS
        if not (folder / blocks[-1].file).exists():
            blocks = blocks[:-1]
            self.manifest = manifest.model_copy(update={"blocks": blocks})
        for entry in blocks:
            path = folder / entry.file
            if not path.is_file() or file_digest(path) != entry.sha256:
                raise InputError(
                    str(path),
                    "a block that is missing, or was changed since the run wrote it",
                    f"the file with the checksum in {MANIFEST}",
                    "Restore it, or start again with --overwrite (overwrite=True in Python).",
                )

    def _foreign(self, names: list[str]) -> InputError:
        return InputError(
            str(self.directory),
            f"files that offwind run did not write, or that were changed since: {', '.join(names)}",
            f"files that are listed in {MANIFEST} with their checksums",
            "Move them away, or name another directory.",
        )

    def _remove_files(self, manifest: Manifest) -> None:
        """The summary first and the manifest last, so that a kill leaves no complete run."""
        for name in (SUMMARY, REPORT, RESULTS):
            if name in manifest.files:
                (self.directory / name).unlink(missing_ok=True)
        if manifest.blocks is not None:
            self._remove_blocks(manifest)
        _remove_temporary(self.directory)
        (self.directory / MANIFEST).unlink()

    def _remove_blocks(self, manifest: Manifest) -> None:
        """The newest first; the folder as well, unless something else is in it."""
        folder = self.directory / BLOCKS
        for entry in reversed(manifest.blocks or ()):
            (folder / entry.file).unlink(missing_ok=True)
        if folder.is_dir():
            _remove_temporary(folder)
            if not any(folder.iterdir()):
                folder.rmdir()


def _remove_temporary(folder: Path) -> None:
    for path in folder.iterdir():
        if _TEMPORARY.fullmatch(path.name) and path.is_file():
            path.unlink()
