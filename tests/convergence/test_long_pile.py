"""A long pile in a uniform Winkler bed against Hetenyi's closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.numerics import fitted_order

import offwind_pin as ow
from offwind_pin.analysis.foundation.condensation import condense
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.structure.chain import ELEMENT_LENGTH
from offwind_pin.verification.long_pile import Array, LongPile

PILE = LongPile()
LOADS = {"force": (1e5, 0.0), "moment": (0.0, 1e6), "both": (1e5, 2e6)}


def _errors(elements: int, force: float, moment: float) -> tuple[float, float]:
    """Largest errors of deflection and bending moment over the largest exact values."""
    pile = pile_only(PILE.turbine(nodes=elements + 1))
    system = ow.build(pile, "distributed_springs", elements=elements)
    state = ow.static(system, np.array([force, 0, 0, 0, moment, 0]))
    depth = state.mudline - state.height
    y = PILE.deflection(depth, force, moment)
    bending = PILE.moment(depth, force, moment)
    return _largest(state.displacement[:, 0], y), _largest(state.section_load[:, 4], bending)


def _largest(found: Array, exact: Array) -> float:
    return float(np.max(np.abs(found - exact)) / np.max(np.abs(exact)))


@pytest.mark.parametrize("load", LOADS)
def test_second_order_in_the_element_length(load: str) -> None:
    """Elements and soil nodes refined alike: deflection and moment converge with order two."""
    counts = [60, 90, 150, 270]
    errors = np.array([_errors(n, *LOADS[load]) for n in counts])
    lengths = 1 / np.array(counts)
    assert fitted_order(lengths, errors[:, 0]) == pytest.approx(2.0, abs=0.1)
    assert fitted_order(lengths, errors[:, 1]) == pytest.approx(2.0, abs=0.1)
    assert np.all(errors[-1] < 1e-3)


def test_accuracy_of_the_default_elements() -> None:
    """With elements of the default length, 0.2 of the pile's own, the error is below 2 %."""
    default = round(PILE.length / ELEMENT_LENGTH["pile"])
    deflection, moment = _errors(default, *LOADS["both"])
    assert deflection < 2e-2
    assert moment < 2e-2


def _condensed(pile: LongPile, elements: int) -> Array:
    system = ow.build(
        pile.turbine(nodes=elements + 1), "distributed_springs", elements={"pile": elements}
    )
    return condense(system, ow.static(system)).stiffness


def test_condensed_head_is_hetenyis() -> None:
    """The 6x6 of a straight pile holds Hetenyi's stiffness in both planes, and no other coupling.

    Extrapolated from two numbers of elements, whose own errors are of second order.
    """
    coarse, fine = _condensed(PILE, 40), _condensed(PILE, 80)
    stiffness = fine + (fine - coarse) / 3
    exact = PILE.stiffness
    assert fine[0, 0] == pytest.approx(exact[0, 0], rel=2e-2)
    assert stiffness[np.ix_([0, 4], [0, 4])] == pytest.approx(exact, rel=1e-3)
    # Leaning about x moves the axis along minus y.
    sideways = exact * np.array([[1, -1], [-1, 1]])
    assert stiffness[np.ix_([1, 3], [1, 3])] == pytest.approx(sideways, rel=1e-3)
    scale = np.sqrt(np.diag(stiffness))
    scaled = stiffness / np.outer(scale, scale)
    assert np.max(np.abs(scaled[np.ix_([0, 4], [1, 2, 3, 5])])) < 1e-6
    assert stiffness[2, 2] == pytest.approx(1e10, rel=1e-6)


def test_a_short_pile_is_not_hetenyis() -> None:
    """Negative control: with the toe within reach the closed forms no longer hold."""
    short = LongPile(length=30.0)
    assert _condensed(short, 60)[0, 0] != pytest.approx(short.stiffness[0, 0], rel=1e-2)
