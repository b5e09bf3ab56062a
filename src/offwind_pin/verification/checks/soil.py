"""Soil springs and dashpots against closed forms."""

from __future__ import annotations

from functools import cache

import numpy as np

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.condensation import condense
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.analysis.static import static
from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.springs import SoilDashpot
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.soil.curves.laws import TanhCurves
from offwind_pin.loads.soil.springs.dashpot import Dashpot
from offwind_pin.loads.soil.springs.elastic import LATERAL, SoilSprings
from offwind_pin.verification.ledger import Found
from offwind_pin.verification.long_pile import LongPile
from offwind_pin.verification.orders import fitted_order

_PILE = LongPile()
_FORCE, _MOMENT = 1e5, 2e6


@cache
def _errors(elements: int) -> tuple[float, float]:
    """Largest errors of deflection and bending moment over the largest exact values."""
    pile = pile_only(_PILE.turbine(nodes=elements + 1))
    system = build(pile, "distributed_springs", elements=elements)
    state = static(system, np.array([_FORCE, 0, 0, 0, _MOMENT, 0]))
    depth = state.mudline - state.height
    exact = (_PILE.deflection(depth, _FORCE, _MOMENT), _PILE.moment(depth, _FORCE, _MOMENT))
    found = (state.displacement[:, 0], state.section_load[:, 4])
    deflection, moment = (
        float(np.max(np.abs(a - b)) / np.max(np.abs(b))) for a, b in zip(found, exact, strict=True)
    )
    return deflection, moment


def hetenyi_deflection() -> float:
    """Largest error over the pile, of 270 elements."""
    return _errors(270)[0]


def hetenyi_moment() -> float:
    return _errors(270)[1]


def hetenyi_order(quantity: str) -> float:
    """Of deflection or moment as elements and nodes are refined together."""
    counts, column = [60, 90, 150, 270], ("deflection", "moment").index(quantity)
    return fitted_order(1 / np.array(counts), [_errors(n)[column] for n in counts])


@cache
def _head() -> Array:
    """6x6 of the pile's head, extrapolated from two numbers of elements."""
    coarse, fine = (
        condense(system, static(system)).stiffness
        for system in (
            build(_PILE.turbine(nodes=n + 1), "distributed_springs", elements={"pile": n})
            for n in (40, 80)
        )
    )
    return np.asarray(fine + (fine - coarse) / 3)


def hetenyi_head(row: int, column: int) -> Found:
    """Entry of the condensed 6x6 for sway (0) and rocking (4)."""
    place = {0: 0, 4: 1}
    exact = _PILE.stiffness[place[row], place[column]]
    return Found(float(_head()[row, column]), float(exact))


def dashpot_cycle() -> Found:
    """Energy dissipated by a secant dashpot per circular cycle in J, and 4 pi beta K_s y^2.

    On a circle the secant of a curve is constant, and two directions take 2 pi beta K_s y^2 each.
    """
    factor, frequency, length, y, depth = 0.03, 0.236, 0.75, 0.02, np.array([-40.0])
    curves = TanhCurves(np.array([3e8]), np.array([5e6]))
    dashpot = Dashpot.of(SoilDashpot(damping_factor=factor, load_frequency_hz=frequency))
    soil = SoilSprings("soil", LATERAL, depth, np.array([length]), curves, dashpot)
    omega, count, heat = 2 * np.pi * frequency, 200, 0.0
    upright = np.array([[0.0, 0.0, 1.0]])
    for phase in 2 * np.pi * np.arange(count) / count:
        u = y * np.array([[np.cos(phase), np.sin(phase), 0.0]])
        v = omega * y * np.array([[-np.sin(phase), np.cos(phase), 0.0]])
        heat += soil.forces(0.0, PointMotion(u, u, v, upright), 1.0).dissipation / frequency / count
    secant = float(curves.secant(np.array([y]))[0]) * length
    return Found(heat, 4 * np.pi * factor * secant * y**2)
