"""A system's Pinocchio model is made on first use, and left out of copies."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pinocchio as pin
import pytest
from helpers.states import random_state

import offwind_pin as ow
from offwind_pin.analysis.foundation.pile_only import pile_part


@pytest.fixture
def system(undamped: ow.Turbine) -> ow.System:
    return ow.build(undamped, "distributed_springs", ow.StillWater(), elements=7)


def test_the_model_has_the_joints_of_the_chain(system: ow.System) -> None:
    """The number of degrees of freedom is known without it."""
    names = system.chain.joint_name
    assert "pin_model" not in vars(system)
    assert system.nv == len(names)
    assert "pin_model" not in vars(system)
    assert (system.nv, names) == (system.pin_model.nv, tuple(system.pin_model.names)[1:])
    assert system.pin_model is system.pin_model
    assert system.scratch is system.scratch


@pytest.mark.parametrize("copied", [lambda s: pickle.loads(pickle.dumps(s)), copy.copy])
def test_copies_make_their_own(system: ow.System, copied: object) -> None:
    """Once used, a system can still be copied and sent to another process."""
    state = random_state(system)
    residual = system.equations().residual(0.0, state.q, state.v, state.a)
    again = copied(system)  # type: ignore[operator]
    assert not {"pin_model", "scratch"} & vars(again).keys()
    assert np.array_equal(again.equations().residual(0.0, state.q, state.v, state.a), residual)
    assert again.pin_model is not system.pin_model
    assert again.pin_model == system.pin_model


def test_the_model_is_that_of_the_changed_chain(system: ow.System) -> None:
    """A system made from another has a model of its own chain, not the one already made."""
    whole = pin.computeTotalMass(system.pin_model)
    pile = pile_part(system)
    assert pile.pin_model.nv == pile.nv < system.nv
    assert pin.computeTotalMass(pile.pin_model) < whole


COMPILED_ONLY = """
import sys
import offwind_pin as ow
turbine = ow.load_turbine("oc6_phase2").model_copy(update={"structural_damping": None})
import offwind_pin.dynamics.compiled.chain
system = ow.build(turbine, "clamped", elements=2)
assert system.nv == 6
assert "pinocchio" not in sys.modules, "the compiled engine imports Pinocchio"
system.pin_model
assert "pinocchio" in sys.modules
"""


def test_the_compiled_engine_does_not_import_pinocchio() -> None:
    """Neither the package, nor building a system, nor the compiled chain does."""
    subprocess.run([sys.executable, "-c", COMPILED_ONLY], check=True)
