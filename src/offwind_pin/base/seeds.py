"""Random number streams by name, independent of each other for the same seed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np

Stream = Literal["identification", "waves", "synthetic_wind", "rotor_wind"]

_SEQUENCES: dict[Stream, Callable[[int], np.random.SeedSequence]] = {
    "identification": lambda seed: np.random.SeedSequence(seed),
    "waves": lambda seed: np.random.SeedSequence((seed, 1)),
    "synthetic_wind": lambda seed: np.random.SeedSequence((seed, 2)),
    "rotor_wind": lambda seed: np.random.SeedSequence((seed, 3)),
}
"""Seed sequence of each stream. These four keep their published draws; a new stream is spawned as
``SeedSequence(seed, spawn_key=(n,))`` with its own n."""


def random_stream(seed: int, stream: Stream) -> np.random.Generator:
    """Generator of one named stream of a seed, independent of all other streams."""
    return np.random.default_rng(_SEQUENCES[stream](seed))
