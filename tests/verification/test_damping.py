"""Structural damping: what was asked for, what modes report, what a free decay shows."""

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.solvers.generalized_alpha import start
from offwind_pin.solvers.steps import FixedStep

RATIOS = {"FA1": 0.005, "SS1": 0.005, "FA2": 0.0127, "SS2": 0.0133}


def test_calibration_reaches_its_ratios(coupled_wet: ow.System) -> None:
    """0.5 % in the first modes, 1.27 and 1.33 % in the second, as OpenFAST's free decays show."""
    assert coupled_wet.damping_ratios == pytest.approx(RATIOS, rel=1e-6)


def test_modes_report_the_calibrated_ratios(coupled_wet: ow.System) -> None:
    """The modal analysis of the system that was calibrated finds the same ratios."""
    result = ow.modes(coupled_wet, 8)
    for label, ratio in RATIOS.items():
        assert result.damping_ratio[result.index(label)] == pytest.approx(ratio, rel=1e-6)


def test_ratios_against_complex_eigenvalues(coupled_wet: ow.System) -> None:
    """phi' D phi / 2 omega against -Re(s) / |s| of the damped system's own eigenvalues."""
    state = ow.static(coupled_wet)
    rest = np.zeros(coupled_wet.nv)
    equations = coupled_wet.equations((), np.inf)
    stiffness, damping = equations.tangents(0.0, state.q, rest)
    inverse = np.linalg.inv(equations.mass(state.q))
    n = coupled_wet.nv
    first_order = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -inverse @ damping]]
    )
    roots = np.linalg.eigvals(first_order)
    roots = roots[roots.imag > 0]
    roots = roots[np.argsort(np.abs(roots))][:4]
    result = ow.modes(coupled_wet, 4)
    # Light damping couples modes in second order of the ratios.
    assert np.abs(roots) / (2 * np.pi) == pytest.approx(result.frequency_hz, rel=1e-3)
    assert -roots.real / np.abs(roots) == pytest.approx(result.damping_ratio, rel=1e-2)


def test_free_decay(undamped: ow.Turbine, oc6: ow.Turbine) -> None:
    """The logarithmic decrement of the first fore-aft mode is 2 pi zeta.

    Small enough for drag, which is quadratic, not to show; without numerical damping.
    """
    system = ow.build(oc6, "coupled_springs", ow.StillWater(), elements=12)
    state = ow.static(system)
    result = ow.modes(system, 4, state)
    mode = result.index("FA1")
    period, ratio = 1 / result.frequency_hz[mode], result.damping_ratio[mode]
    shape = result.vector[:, mode]
    velocity = 1e-4 * shape / np.abs(result.mass_normalised[mode, -1, 0])
    count, steps = 12, 60
    method = GeneralizedAlpha(
        FixedStep(period / steps), 1.0, relative_tolerance=1e-12, increment_tolerance=1e-12
    )
    chain = CompiledChain(system)
    vectors = start(chain, chain.time_inputs(np.zeros(1))[0], state.q, velocity)
    begin = method.begin(chain, state.q, period)._replace(vectors=vectors)
    times = period * np.arange(1, count + 1)
    end, _ = method.advance(chain, chain.sections(system.chain.boundary), begin, times)
    mass = system.equations().mass(state.q)
    first, last = (float(shape @ mass @ v) for v in (velocity, end.vectors[1]))
    # The period of the method is longer by (omega dt)^2 / 12, a thousandth, in phase alone.
    decrement = np.log(first / last) / count
    assert decrement == pytest.approx(2 * np.pi * ratio, rel=0.02)
    assert ratio == pytest.approx(0.005, rel=0.05)


def test_undamped_turbine_has_no_damping(undamped: ow.Turbine) -> None:
    """Negative control: without structural damping, at rest in water, the ratios are zero."""
    result = ow.modes(ow.build(undamped, "coupled_springs", ow.StillWater()), 4)
    assert np.all(result.damping_ratio == 0)
