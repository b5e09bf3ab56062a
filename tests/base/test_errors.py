"""What messages of errors show of a value."""

from __future__ import annotations

import numpy as np

import offwind_pin as ow


def test_numbers_of_numpy_are_shown_as_numbers() -> None:
    """A reader of a case file has not heard of np.float64."""
    for value, shown in ((np.float64(18.0), "18.0"), (np.int64(3), "3"), (18.0, "18.0")):
        assert f"got {shown};" in str(ow.InputError("field", value, "less", "Lower it."))
