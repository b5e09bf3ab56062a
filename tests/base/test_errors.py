"""Errors: what their messages show of a value, and that another process can be handed them."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest
import xarray as xr

import offwind_pin as ow

PARTIAL = xr.Dataset({"x": ("time", [1.0, 2.0])})

ERRORS: list[ow.OffwindError] = [
    ow.InputError("case.yaml, field seed", -1, "0 or more", "Correct it."),
    ow.InputError("case.yaml, field name", "a required key is missing", "", "Add it."),
    ow.SolverError("no convergence", step=3, joint="e1_ry", residual=0.2, time=1.5),
    ow.SolverError("static", step=3, joint="e1_ry", residual=0.2, results=PARTIAL),
    ow.InterruptedSimulation(2.5, PARTIAL),
]


def test_numbers_of_numpy_are_shown_as_numbers() -> None:
    """A reader of a case file has not heard of np.float64."""
    for value, shown in ((np.float64(18.0), "18.0"), (np.int64(3), "3"), (18.0, "18.0")):
        assert f"got {shown};" in str(ow.InputError("field", value, "less", "Lower it."))


def pickled(error: ow.OffwindError) -> ow.OffwindError:
    found: ow.OffwindError = pickle.loads(pickle.dumps(error))
    return found


@pytest.mark.parametrize("through", [pickled, copy.copy, copy.deepcopy])
@pytest.mark.parametrize("error", ERRORS, ids=str)
def test_errors_are_copied_whole(
    error: ow.OffwindError, through: Callable[[ow.OffwindError], ow.OffwindError]
) -> None:
    """Type, message and every field; notes stay as well."""
    error.add_note("in case 7")
    found = through(error)
    assert type(found) is type(error)
    assert str(found) == str(error)
    assert vars(found).keys() == vars(error).keys()
    for name, value in vars(error).items():
        same = getattr(found, name)
        assert same.identical(value) if isinstance(value, xr.Dataset) else same == value


def test_what_cannot_be_pickled_is_reported_in_words() -> None:
    """A received value that no other process can have comes as its text, the message unchanged."""
    error = ow.InputError("loads", lambda: 0, "a load", "Give one.")
    found = pickled(error)
    assert isinstance(found, ow.InputError)
    assert str(found) == str(error)
    assert isinstance(found.received, str)
    assert "lambda" in found.received


def test_a_worker_hands_its_error_on() -> None:
    """A pool goes on after a task of it was refused; definitions come back whole."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        refused = pool.submit(ow.PowerLaw, -3.0).exception()
        assert isinstance(refused, ow.InputError)
        assert refused.received == -3.0
        assert pool.submit(ow.PowerLaw, 0.2).result() == ow.PowerLaw(0.2)
