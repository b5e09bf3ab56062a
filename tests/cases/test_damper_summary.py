"""What the summary of a case says of tuned mass dampers."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from offwind_pin.cases.tree_summary import summarise_dampers


def test_the_farthest_slide_counts_in_both_directions() -> None:
    """3 m along x and 4 m along y at one instant are 5 m; at two instants they are 4 m."""
    slid = np.zeros((3, 2, 2))
    slid[1, 0] = (3.0, -4.0)
    slid[1, 1], slid[2, 1] = (3.0, 0.0), (0.0, -4.0)
    data = xr.Dataset(
        {
            "tuned_mass_displacement": (("time", "damper", "across"), slid),
            "tuned_mass_travel": ("damper", np.array([2.5, np.inf])),
        },
        coords={"damper": ["first", "second"]},
    )
    first, second = summarise_dampers(data)["tuned_mass_dampers"]
    assert first == {"name": "first", "largest_displacement_m": pytest.approx(5.0), "travel_m": 2.5}
    assert second == {"name": "second", "largest_displacement_m": pytest.approx(4.0)}


def test_without_dampers_there_is_nothing_to_say() -> None:
    assert summarise_dampers(xr.Dataset()) == {}
