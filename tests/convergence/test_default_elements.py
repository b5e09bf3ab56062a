"""The default number of elements against converged frequencies of the benchmark."""

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.structure.chain import Chain


def doubled(chain: Chain) -> dict[str, int]:
    """Twice the default number in every region."""
    return {name: 2 * chain.region.count(name) for name in set(chain.region)}


@pytest.mark.parametrize("foundation", ["clamped", "coupled_springs", "distributed_springs"])
def test_first_five_frequencies(undamped: ow.Turbine, foundation: str) -> None:
    """Within 0.1 % of the converged ones, extrapolated with order 2 from twice the elements."""
    default = ow.build(undamped, foundation, ow.StillWater())
    fine = ow.build(undamped, foundation, ow.StillWater(), elements=doubled(default.chain))
    coarse, better = ow.modes(default, 5), ow.modes(fine, 5)
    assert coarse.label == better.label
    converged = better.frequency_hz + (better.frequency_hz - coarse.frequency_hz) / 3
    assert np.abs(coarse.frequency_hz / converged - 1).max() < 1e-3


def test_few_elements_are_not_enough(undamped: ow.Turbine, clamped_dry: ow.System) -> None:
    """Negative control: with a fifth of the elements a frequency is off by more than 0.1 %."""
    few = ow.modes(ow.build(undamped, "clamped", elements=7), 5).frequency_hz
    assert np.abs(few / ow.modes(clamped_dry, 5).frequency_hz - 1).max() > 1e-3
