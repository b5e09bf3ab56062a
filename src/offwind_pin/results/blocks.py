"""Blocks of a time history: arrays by name, kept in memory, or as files that a killed run leaves.

Each file is written whole and holds the state at its end, so that a run goes on from the last one.
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.errors import InputError
from offwind_pin.base.whole_files import whole_file, write_json

Array = NDArray[np.float64]
Block = dict[str, Array]


BLOCK_FOLDER = "blocks"
"""Folder of a run's blocks inside the directory of its results."""


class BlockStore(Protocol):
    """Where the blocks of a run go."""

    def append(self, block: Block) -> None:
        """Keep a block."""

    def __iter__(self) -> Iterator[Block]:
        """The blocks from the first on."""

    def __len__(self) -> int:
        """Number of blocks kept."""

    def last(self) -> Block:
        """The newest block."""


class MemoryStore:
    """Blocks in memory."""

    def __init__(self) -> None:
        self._blocks: list[Block] = []

    def append(self, block: Block) -> None:
        self._blocks.append(block)

    def __iter__(self) -> Iterator[Block]:
        return iter(self._blocks)

    def __len__(self) -> int:
        return len(self._blocks)

    def last(self) -> Block:
        return self._blocks[-1]


class FolderStore:
    """Blocks as files of a folder, which belongs to one run.

    Parameters
    ----------
    folder : Path
        Made if it is not there.
    run : dict of str to object
        Plain data that tell this run from every other.

    Raises
    ------
    InputError
        The folder holds another run's blocks, or something else.
    """

    def __init__(self, folder: Path, run: dict[str, object]) -> None:
        self.folder = folder
        self._label = folder / "run.json"
        if self._label.exists() or self._path(0).exists():
            self._check_owner(run)
        else:
            write_json(self._label, run)
        self._count = 0
        while self._path(self._count).is_file():
            self._count += 1

    def append(self, block: Block) -> None:
        with whole_file(self._path(self._count)) as temporary, temporary.open("wb") as file:
            np.savez(file, allow_pickle=False, **block)
        self._count += 1

    def __iter__(self) -> Iterator[Block]:
        return (self._read(i) for i in range(self._count))

    def __len__(self) -> int:
        return self._count

    def last(self) -> Block:
        return self._read(self._count - 1)

    def remove(self) -> None:
        """Delete the folder, once its blocks stand elsewhere.

        The label goes last, so that what a kill leaves is still known for this run's.
        """
        for number in reversed(range(self._count)):
            self._path(number).unlink()
        for path in self.folder.iterdir():
            if path != self._label:
                path.unlink()
        self._label.unlink()
        self.folder.rmdir()

    def _path(self, number: int) -> Path:
        return self.folder / f"block_{number:06d}.npz"

    def _read(self, number: int) -> Block:
        return _read_block(self._path(number))

    def _check_owner(self, run: dict[str, object]) -> None:
        try:
            found = json.loads(self._label.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError, json.JSONDecodeError):
            found = None
        if found != json.loads(json.dumps(run)):
            differs = (
                [key for key in run if found.get(key) != json.loads(json.dumps(run[key]))]
                if isinstance(found, dict)
                else ["run.json"]
            )
            raise InputError(
                str(self.folder),
                f"blocks of another run (other {', '.join(differs) or 'keys'})",
                "blocks of this run, to go on from",
                "Delete the folder to start again, or name another directory.",
            )


def time_reached(directory: Path) -> float:
    """Simulated time in s that a stopped run's blocks in a directory of results reach, or zero."""
    files = sorted((directory / BLOCK_FOLDER).glob("block_*.npz"))
    if not files:
        return 0.0
    return float(_read_block(files[-1])["time"][-1])


def _read_block(path: Path) -> Block:
    try:
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except (OSError, ValueError, zipfile.BadZipFile) as error:
        remedy = "Delete the folder to start again."
        raise InputError(str(path), str(error), "a whole block of results", remedy) from None
