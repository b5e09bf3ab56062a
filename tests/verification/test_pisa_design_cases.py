"""Piles of the PISA project at field scale, on its soil reactions.

Byrne et al. (2020): monopiles in Cowden till, the lateral load at which the pile has moved by a tenth of
its diameter at the mudline. The published one-dimensional model gives 14.5 and 22.5 MN, the finite
elements in three dimensions 13.7 and 21.8 MN (read off figures, +-0.3 MN).
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from helpers.soils import with_springs

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.definitions.soil.springs import DistributedSprings
from offwind_pin.definitions.turbine import Member, Station
from offwind_pin.loads.soil.curves.layered import (
    base_moment_curve,
    base_shear_curve,
    lateral_curves,
    rocking_curves,
)
from offwind_pin.loads.soil.soil_profile import PileNodes

TILL = LayeredGround.model_validate(
    {
        "kind": "layers",
        "loading": "static",
        "layers": [
            {
                "top_m": 0.0,
                "model": "pisa",
                "calibration": "cowden_till",
                "undrained_shear_strength_pa": {
                    "depth_m": [0, 11, 35],
                    "values": [80e3, 140e3, 200e3],
                },
                "shear_modulus_pa": {"depth_m": [0, 11, 35], "values": [20e6, 200e6, 400e6]},
                "submerged_unit_weight_n_per_m3": 11e3,
            }
        ],
    }
)
YOUNG, POISSON = 210e9, 0.3
ELEMENTS = 90


def beam_stiffness(diameter: float, thickness: float, length: float) -> Array:
    """Timoshenko beam from the mudline down; at each node displacement and rotation v' (bending)."""
    inner = diameter - 2 * thickness
    inertia = math.pi * (diameter**4 - inner**4) / 64
    area = math.pi * (diameter**2 - inner**2) / 4
    shear = YOUNG / (2 * (1 + POISSON)) * area / 2
    h = length / ELEMENTS
    phi = 12 * YOUNG * inertia / (shear * h**2)
    element = (
        YOUNG
        * inertia
        / (h**3 * (1 + phi))
        * np.array(
            [
                [12, 6 * h, -12, 6 * h],
                [6 * h, (4 + phi) * h**2, -6 * h, (2 - phi) * h**2],
                [-12, -6 * h, 12, -6 * h],
                [6 * h, (2 - phi) * h**2, -6 * h, (4 + phi) * h**2],
            ]
        )
    )
    stiffness = np.zeros((2 * ELEMENTS + 2, 2 * ELEMENTS + 2))
    for i in range(ELEMENTS):
        stiffness[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += element
    return stiffness


def load_at_a_tenth(
    diameter: float, thickness: float, length: float, arm: float, *, all_reactions: bool = True
) -> float:
    """Lateral load in N at a height ``arm`` above the mudline that moves the pile there by D / 10."""
    depth = np.linspace(0.0, length, ELEMENTS + 1)
    ground = PileNodes(depth, np.full(ELEMENTS + 1, diameter), length)
    tributary = np.full(ELEMENTS + 1, length / ELEMENTS)
    tributary[[0, -1]] /= 2
    lateral, rocking = lateral_curves(TILL, ground), rocking_curves(TILL, ground)
    shear, moment = base_shear_curve(TILL, ground), base_moment_curve(TILL, ground)
    assert rocking is not None
    nodes, moments = rocking
    assert len(nodes) == ELEMENTS + 1
    assert shear is not None
    assert moment is not None
    beam = beam_stiffness(diameter, thickness, length)
    load = np.zeros(len(beam))
    # depth counts downwards: the moment of the load turns the pile towards smaller v with depth
    load[:2] = 1.0, -arm
    shape, force = np.zeros(len(beam)), 0.0
    for _ in range(400):
        v, psi = np.abs(shape[0::2]), np.abs(shape[1::2])
        springs = np.zeros(len(beam))
        springs[0::2] = lateral.secant(v) * tributary
        if all_reactions:
            springs[1::2] = moments.curves.secant(psi) * tributary
            springs[-2] += shear.secant(v[-1:])[0]
            springs[-1] += moment.secant(psi[-1:])[0]
        unit = np.linalg.solve(beam + np.diag(springs), load)
        new, before = diameter / 10 / unit[0], force
        shape, force = unit * new, float(new)
        if abs(force - before) < 1e-9 * force:
            return force
    raise AssertionError("the secants do not settle")


CASES = {"D1": ((7.5, 0.068, 22.5, 37.5), 14.5e6), "D2": ((8.75, 0.091, 35.0, 87.5), 22.5e6)}


@pytest.mark.parametrize("case", CASES)
def test_published_load(case: str) -> None:
    """The published one-dimensional model within the reading of its figure."""
    pile, published = CASES[case]
    assert load_at_a_tenth(*pile) == pytest.approx(published, abs=0.3e6)


def test_each_reaction_counts() -> None:
    """Negative control: with lateral springs alone a short pile carries clearly less."""
    pile, published = CASES["D1"]
    assert load_at_a_tenth(*pile, all_reactions=False) < published - 1e6


def turbine_on(oc6: ow.Turbine, diameter: float, thickness: float, length: float) -> ow.Turbine:
    """A turbine whose pile stands in the till, 61 nodes along it."""
    mudline = oc6.site.mudline
    ends = (mudline - length, mudline + 1.0)
    stations = [Station(z_m=z, diameter_m=diameter, thickness_m=thickness) for z in ends]
    springs = DistributedSprings.model_validate(
        {
            "nodes": 61,
            "curve": TILL.model_dump(),
            "toe_vertical_stiffness_n_per_m": 1e10,
            "toe_torsional_stiffness_nm_per_rad": 1e11,
        }
    )
    pile = Member(name="monopile", material="steel", stations=tuple(stations))
    return with_springs(oc6.model_copy(update={"members": (pile,)}), springs)


@pytest.mark.parametrize("case", CASES)
def test_the_chain_meets_the_published_load(oc6: ow.Turbine, case: str) -> None:
    """The package's own pushover, elements that shear: within 5 % of the published model, and within
    1 % of the beam above."""
    (diameter, thickness, length, arm), published = CASES[case]
    turbine = turbine_on(oc6, diameter, thickness, length)
    push = ow.pushover(turbine, arm, elements=45, element="timoshenko", points=8)
    assert push.displacement[-1] == pytest.approx(diameter / 10, rel=1e-6)
    assert push.load[-1] == pytest.approx(published, rel=0.05)
    assert push.load[-1] == pytest.approx(
        load_at_a_tenth(diameter, thickness, length, arm), rel=0.01
    )
