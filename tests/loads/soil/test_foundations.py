"""The foundations' interface: what the shipped ones answer, and that others fit it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.base.definition import Array
from offwind_pin.loads.root_restraint import LinearRestraint, RootRestraint
from offwind_pin.loads.soil import foundation as foundations
from offwind_pin.loads.soil.foundation import Foundation


@dataclass(frozen=True)
class HardeningRestraint(RootRestraint):
    """A nonlinear restraint: springs that harden with the cube of the displacement."""

    stiffness: Array
    hardening: Array

    def reaction(self, displacement: Array, velocity: Array) -> Array:
        return np.asarray(self.stiffness @ displacement + self.hardening * displacement**3)

    def tangents(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        return self.stiffness + np.diag(3 * self.hardening * displacement**2), np.zeros((6, 6))

    def describe(self) -> dict[str, object]:
        return {"hardening": self.hardening.tolist()}


@pytest.fixture
def hardening(oc6: ow.Turbine, monkeypatch: pytest.MonkeyPatch) -> ow.Turbine:
    """A foundation of somebody else's, registered by name."""
    assert oc6.soil.coupled_springs is not None
    stiffness = np.array(oc6.soil.coupled_springs.stiffness)
    restraint = HardeningRestraint(stiffness, np.full(6, 1e17))

    class Hardening(ow.soil.FoundationKind):
        name = "hardening"
        description = "hardening springs"

        def make(self, turbine: ow.Turbine) -> Foundation:
            return Foundation("hardening", turbine.site.mudline, restraint)

    monkeypatch.setitem(FOUNDATIONS, "hardening", Hardening())
    return oc6


def test_clamped_holds_the_mudline(clamped_dry: ow.System) -> None:
    """A clamped base does not move, and takes the whole weight."""
    state = ow.static(clamped_dry)
    assert np.all(state.mudline_displacement == 0)
    mass = sum(body.mass for body in clamped_dry.chain.body) + clamped_dry.chain.rna.mass
    assert state.mudline_load[2] == pytest.approx(-mass * 9.80665, rel=1e-12)


def test_coupled_springs_deflect_by_their_flexibility(
    coupled_wet: ow.System, oc6: ow.Turbine
) -> None:
    """Mudline displacement and rotation are the 6x6's flexibility times the mudline load."""
    state = ow.static(coupled_wet, np.array([1e6, 0, 0, 0, 0, 0]))
    assert oc6.soil.coupled_springs is not None
    moved = np.linalg.solve(np.array(oc6.soil.coupled_springs.stiffness), state.mudline_load)
    assert state.mudline_displacement[0] == pytest.approx(moved[0], rel=2e-3)
    assert state.mudline_displacement[2] == pytest.approx(moved[2], rel=2e-3)


def test_soil_reaction_balances_the_mudline_load(distributed_wet: ow.System) -> None:
    """What the section at the mudline brings down, the springs of the pile take up."""
    load = np.array([1.2e6, 0, 0, 0, 3e6, 0])
    state = ow.static(distributed_wet, load)
    soil = distributed_wet.foundation.soil[0]
    equations = distributed_wet.equations(state.loads, ramp_time=np.inf)
    rest = np.zeros(distributed_wet.nv)
    forces = equations.evaluate(0.0, state.q, rest, rest).forces.force
    loads = np.repeat(
        [load.name for load in equations.loads], [len(load.height) for load in equations.loads]
    )
    reaction = forces[loads == soil.name].sum(axis=0)
    assert reaction[0] == pytest.approx(-state.mudline_load[0], rel=1e-9)
    assert state.mudline_load[0] == pytest.approx(1.2e6, rel=1e-9)


def test_another_foundation_fits_the_interface(hardening: ow.Turbine) -> None:
    """A nonlinear restraint runs statics, modes and time; it stiffens under load."""
    system = ow.build(hardening, "hardening", ow.StillWater())
    load = np.array([1.2e6, 0, 0, 0, 0, 0])
    state = ow.static(system, load)
    linear = ow.static(ow.build(hardening, "coupled_springs", ow.StillWater()), load)
    assert 0 < state.mudline_displacement[0] < 0.99 * linear.mudline_displacement[0]
    free, loaded = ow.modes(system), ow.modes(system, about=state)
    assert loaded.frequency_hz[loaded.index("FA1")] > 1.0005 * free.frequency_hz[free.index("FA1")]
    history = ow.simulate(system, 1.0, 0.05)
    assert float(history["solver_residual"].max()) <= 1e-8


def test_a_lower_base_fits_the_interface(oc6: ow.Turbine) -> None:
    """A chain held rigidly below the mudline, as apparent fixity is, is softer than a clamped one."""
    deeper = ow.modes(ow.build(oc6, Foundation("deeper", -45.0)))
    clamped = ow.modes(ow.build(oc6, "clamped"))
    assert deeper.frequency_hz[0] < 0.95 * clamped.frequency_hz[0]


def test_toe_springs_hold_what_nothing_else_does(
    oc6: ow.Turbine, distributed_wet: ow.System
) -> None:
    """Vertical settlement is the weight over the toe's vertical stiffness."""
    state = ow.static(distributed_wet)
    springs = oc6.soil.distributed_springs
    assert springs is not None
    mass = sum(body.mass for body in distributed_wet.chain.body) + distributed_wet.chain.rna.mass
    settled = -mass * 9.80665 / springs.toe_vertical_stiffness
    assert state.displacement[0, 2] == pytest.approx(settled, rel=1e-9)


def test_a_turbine_without_numbers_is_refused(oc6: ow.Turbine) -> None:
    """A foundation whose numbers the turbine lacks is refused by the field's name."""
    bare = oc6.model_copy(update={"soil": oc6.soil.model_copy(update={"coupled_springs": None})})
    bare = bare.model_copy(update={"structural_damping": None})
    with pytest.raises(ow.InputError, match=r"soil\.coupled_springs"):
        ow.build(bare, "coupled_springs")


def test_dashpots_damp_the_toe_springs_alike(oc6: ow.Turbine) -> None:
    """The toe's dashpots stand to its springs as those along the pile do."""
    root = foundations.distributed_springs(oc6).root
    assert isinstance(root, LinearRestraint)
    springs = oc6.soil.distributed_springs
    assert springs is not None
    assert springs.dashpot is not None
    time = springs.dashpot.damping_factor / (np.pi * springs.dashpot.load_frequency)
    assert np.allclose(root.damping, time * root.stiffness, rtol=1e-14)


def test_without_dashpots_the_soil_does_not_damp(oc6: ow.Turbine) -> None:
    """Negative control: removing the dashpots lowers the damping of the first mode."""
    springs = oc6.soil.distributed_springs
    assert springs is not None
    quiet = oc6.soil.model_copy(
        update={"distributed_springs": springs.model_copy(update={"dashpot": None})}
    )
    damped = ow.modes(ow.build(oc6, "distributed_springs", ow.StillWater()))
    bare = ow.modes(
        ow.build(oc6.model_copy(update={"soil": quiet}), "distributed_springs", ow.StillWater())
    )
    first = damped.index("FA1")
    assert bare.damping_ratio[first] < 0.8 * damped.damping_ratio[first]
    assert bare.frequency_hz[first] == pytest.approx(damped.frequency_hz[first], rel=1e-9)
