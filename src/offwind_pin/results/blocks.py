"""Blocks of a time history: arrays by name, in memory, or in files that a killed run leaves.

Each block contains the state at its end, so that a run is resumed after the last one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import file_digest
from offwind_pin.base.errors import InputError
from offwind_pin.base.whole_files import whole_file
from offwind_pin.results.manifest import BLOCKS, BlockEntry, Simulation
from offwind_pin.results.run_folder import RunFolder

Array = NDArray[np.float64]
Block = dict[str, Array]


class BlockStore(Protocol):
    """Storage of the blocks of a run."""

    def append(self, block: Block) -> None:
        """Store a block."""

    def __iter__(self) -> Iterator[Block]:
        """All blocks in order."""

    def __len__(self) -> int:
        """Number of blocks."""

    def last(self) -> Block:
        """The last block."""


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
    """Blocks as files of a run's directory.

    Parameters
    ----------
    folder : RunFolder
    simulation : Simulation
        What determines the time history.

    Raises
    ------
    InputError
        The directory contains a time history that is determined by something else.
    """

    def __init__(self, folder: RunFolder, simulation: Simulation) -> None:
        self._folder = folder
        self._simulation = simulation
        manifest = folder.manifest
        if manifest is not None and manifest.simulation is not None:
            self._check_same(manifest.simulation)

    def append(self, block: Block) -> None:
        """Write a block.

        Its entry in the manifest comes before the file, so that there never is a file which the
        manifest does not list.
        """
        manifest = self._folder.begin()
        if manifest.simulation is None:
            self._folder.update(simulation=self._simulation, blocks=())
        index = self._index
        path = self._path(f"block_{len(index):06d}.npz")
        self._folder.check()
        with whole_file(path) as temporary:
            with temporary.open("wb") as file:
                np.savez(file, allow_pickle=False, **block)
            entry = BlockEntry(
                file=path.name,
                begin_s=float(block["time"][0]),
                end_s=float(block["time"][-1]),
                sha256=file_digest(temporary),
            )
            self._folder.update(blocks=(*index, entry))

    def __iter__(self) -> Iterator[Block]:
        return (self._read(entry) for entry in self._index)

    def __len__(self) -> int:
        return len(self._index)

    def last(self) -> Block:
        return self._read(self._index[-1])

    @property
    def _index(self) -> tuple[BlockEntry, ...]:
        """An interruption in the midst of :meth:`append` leaves an entry without a file."""
        manifest = self._folder.manifest
        if manifest is None or not manifest.blocks:
            return ()
        *before, last = manifest.blocks
        return manifest.blocks if self._path(last.file).exists() else tuple(before)

    def _path(self, name: str) -> Path:
        return self._folder.directory / BLOCKS / name

    def _read(self, entry: BlockEntry) -> Block:
        path = self._path(entry.file)
        self._folder.check()
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}

    def _check_same(self, found: Simulation) -> None:
        """Of a complete run, only the version of this package has to be the same."""
        asked = self._simulation
        differs = _differences(found.settings, asked.settings)
        differs += _differences(found.inputs, asked.inputs)
        if self._folder.state != "complete":
            differs += _differences(found.environment, asked.environment)
        if differs:
            raise InputError(
                str(self._folder.directory),
                f"results of another simulation (other {', '.join(differs)})",
                "results of this simulation, or a directory without results",
                "Name another directory, or start again with --overwrite (overwrite=True in "
                "Python).",
            )


def _differences(found: Mapping[str, object], asked: Mapping[str, object]) -> list[str]:
    return [name for name in {**asked, **found} if found.get(name) != asked.get(name)]
