"""Random number streams by name, so that what one seed draws never depends on other draws."""

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
"""How each stream follows from a seed. These four are kept for the sake of published draws; a new
stream is spawned, ``SeedSequence(seed, spawn_key=(n,))`` with an n of its own."""


def random_stream(seed: int, stream: Stream) -> np.random.Generator:
    """Generator of one named stream of a seed, independent of all other streams."""
    return np.random.default_rng(_SEQUENCES[stream](seed))
