"""Named streams of random numbers: their draws stay, and are independent of each other."""

from __future__ import annotations

from typing import get_args

import numpy as np

from offwind_pin.base.seeds import Stream, random_stream

STREAMS = get_args(Stream)


def test_draws_stay() -> None:
    """To the last bit those of seed and number, which published results were drawn with."""
    entropy = {
        "identification": 7,
        "waves": (7, 1),
        "synthetic_wind": (7, 2),
        "rotor_wind": (7, 3),
    }
    assert entropy.keys() == set(STREAMS)
    for name, words in entropy.items():
        expected = np.random.default_rng(words).normal(size=9)
        assert np.array_equal(random_stream(7, name).normal(size=9), expected)


def test_streams_are_independent() -> None:
    """No two of a seed, and no two seeds of a stream, are correlated."""
    draws = [random_stream(seed, name).normal(size=4000) for seed in (1, 2) for name in STREAMS]
    correlation = np.corrcoef(draws) - np.eye(len(draws))
    assert np.max(np.abs(correlation)) < 0.08
    again = random_stream(1, STREAMS[0]).normal(size=4000)
    assert np.array_equal(again, draws[0])
