"""Lumping of rotor and nacelle into one rigid body."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.definitions.rotor_nacelle import RigidBody, lump_rna, rotor_apex

# Independently lumped from the same OpenFAST inputs (r-test OC6_phaseII), about the yaw bearing.
MASS = 839652.7544217189
CENTER_OF_MASS = [-5.79854468, 0.0, 3.188847]
INERTIA = [
    [182397958.24060923, 0.0, -7008590.46558656],
    [0.0, 100062356.82519546, 0.0],
    [-7008590.46558656, 0.0, 106150322.50864987],
]


def test_assembly_meets_the_reference(oc6: ow.Turbine) -> None:
    """Mass, centre and inertia of the benchmark's assembly to 1e-6."""
    body = lump_rna(oc6.rna)
    assert body.mass == pytest.approx(MASS, rel=1e-6)
    assert_allclose(body.center_of_mass, CENTER_OF_MASS, rtol=1e-6, atol=1e-9)
    # Entries that vanish by symmetry: 1 kg m2 is 1e-8 of the others.
    assert_allclose(body.inertia, INERTIA, rtol=1e-6, atol=1.0)


def test_rotor_is_upwind_and_above_the_bearing(oc6: ow.Turbine) -> None:
    """The apex lies upwind, where overhang and tilt of the inputs put it."""
    apex, shaft = rotor_apex(oc6.rna)
    assert_allclose(apex, [-9.984005307602095, 0.0, 4.009361242743973], rtol=1e-12, atol=1e-12)
    assert np.linalg.norm(shaft) == pytest.approx(1.0, rel=1e-15)
    assert shaft[0] > 0


def test_more_blades_of_the_same_total_mass_change_nothing(oc6: ow.Turbine) -> None:
    """Three blades or more are dynamically a disc: six half-weight blades have the same inertia."""
    blade = oc6.rna.blade
    light = blade.model_copy(update={"mass_density": tuple(m / 2 for m in blade.mass_density)})
    six = oc6.rna.model_copy(update={"blades": 6, "blade": light})
    assert_allclose(lump_rna(six).inertia, lump_rna(oc6.rna).inertia, rtol=1e-12, atol=1e-6)


def test_two_blades_are_not_a_disc(oc6: ow.Turbine) -> None:
    """Negative control of the last test: with two blades the inertia about y and z differs."""
    blade = oc6.rna.blade
    heavy = blade.model_copy(update={"mass_density": tuple(1.5 * m for m in blade.mass_density)})
    two = oc6.rna.model_copy(update={"blades": 2, "blade": heavy})
    assert lump_rna(two).mass == pytest.approx(lump_rna(oc6.rna).mass, rel=1e-12)
    assert lump_rna(two).inertia[1, 1] > 1.2 * lump_rna(oc6.rna).inertia[1, 1]


def test_dumbbell_by_the_parallel_axis_theorem() -> None:
    """Two point masses m at +-a have 2 m a^2 about any axis across their line and 0 along it."""
    ends = [RigidBody(3.0, np.array([x, 1.0, 2.0]), np.zeros((3, 3))) for x in (-2.0, 2.0)]
    body = RigidBody.combine(ends)
    assert_allclose(body.center_of_mass, [0, 1, 2], rtol=1e-15)
    assert_allclose(body.inertia, np.diag([0, 24.0, 24.0]), rtol=1e-15)
