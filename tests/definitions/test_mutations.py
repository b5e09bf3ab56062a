"""Every leaf and key of every shipped and documented definition, spoilt: refused, or valid."""

from __future__ import annotations

import logging
import random
from pathlib import Path

import numpy as np
import pytest
from helpers.mutations import Mutant, Seed, files, mutant, mutants, outcome, seeds

SAMPLE, SHARES = 60, 20
"""Mutants of one run of the suite; parts of the whole, one for each round of ``make soak``."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("mutants")
    files(path)
    return path


@pytest.fixture(scope="module")
def originals(folder: Path) -> list[Seed]:
    return seeds(folder)


def test_originals_are_valid(originals: list[Seed], folder: Path) -> None:
    """Negative control: what the mutants are made of is accepted."""
    assert len(originals) > 15
    found = {
        seed.name: outcome(Mutant(seed, ("name",), "none", seed.data), folder) for seed in originals
    }
    assert set(found.values()) == {"valid"}, found


@pytest.mark.seeded
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_mutants(originals: list[Seed], folder: Path, campaign_seed: int) -> None:
    """No exception but an InputError that names the file, and a SolverError.

    The suite draws a sample; twenty seeds in a row, as in ``make soak``, take every mutant once.
    """
    logging.disable(logging.CRITICAL)
    everyone = mutants(originals)
    random.Random(0).shuffle(everyone)
    chosen = everyone[:SAMPLE] if campaign_seed == 1 else everyone[campaign_seed % SHARES :: SHARES]
    faults = []
    try:
        for chosen_one in chosen:
            one = mutant(*chosen_one)
            try:
                outcome(one, folder)
            except Exception as error:
                faults.append(f"{one.seed.name}, {one.place}, {one.change}: {error!r}"[:500])
    finally:
        logging.disable(logging.NOTSET)
    assert not faults, "\n".join(faults)


def test_numbers_beyond_any_unit_are_refused(originals: list[Seed], folder: Path) -> None:
    """Every number of every schema has a bound above: none takes 1e308, and none an infinity."""
    taken = []
    once = {
        (seed.kind, tuple("*" if isinstance(part, int) else part for part in place)): (seed, place)
        for seed, place, _ in mutants(originals)
    }
    for seed, place in once.values():
        value: object = seed.data
        for part in place:
            value = value[part]  # type: ignore[index]
        if isinstance(value, int | float) and not isinstance(value, bool):
            for spoilt in (1e308, -np.inf):
                one = mutant(seed, place, 0)
                target = one.data
                for part in place[:-1]:
                    target = target[part]  # type: ignore[index]
                target[place[-1]] = spoilt  # type: ignore[index]
                try:
                    one.seed.kind.model_validate(one.data, context={"folder": folder})
                except ValueError:
                    continue
                taken.append((seed.name, place, spoilt))
    assert not taken
