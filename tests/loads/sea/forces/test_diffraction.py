"""MacCamy and Fuchs' diffraction against Bessel functions of their own and known limits."""

import numpy as np
import pytest
from helpers.hydrodynamics import RegularWater, upright
from scipy.special import jv, yv

import offwind_pin as ow
from offwind_pin.loads.sea.forces.maccamy_fuchs import SMALLEST, inertia_factor, maccamy_fuchs
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.loads.sea.waves.dispersion import wave_number

SIZES = np.array([0.05, 0.1, 0.3, 0.7, 1.0, 1.5, 2.0, 3.0])
"""Radius times wave number."""


def closed_form(size: float) -> tuple[float, float]:
    """Amplitude and lag of the force over rho pi a^2 times the acceleration at the axis.

    The force is 4 rho g A / k |.| cos(omega t - alpha) with tan alpha = J1'/Y1' (MacCamy and Fuchs,
    1954); the acceleration -g k A sin(omega t), both times the depth's factor.
    """
    j = (jv(0, size) - jv(2, size)) / 2
    y = (yv(0, size) - yv(2, size)) / 2
    return 4 / (np.pi * size**2 * np.hypot(j, y)), np.arctan2(j, y)


@pytest.mark.parametrize("size", SIZES.tolist())
def test_amplitude_and_phase(size: float) -> None:
    found = maccamy_fuchs(np.array([2.0]), np.array([size]))[0, 0]
    amplitude, lag = closed_form(size)
    assert abs(found) == pytest.approx(amplitude, rel=1e-12)
    time = np.linspace(0.0, 2 * np.pi, 33)
    force = (found * 1j * np.exp(1j * time)).real
    assert force == pytest.approx(-amplitude * np.sin(time - lag), abs=1e-12 * amplitude)


def test_long_waves_are_morison_s() -> None:
    """The limit is 2, met with the square of the size, and kept where waves have no length."""
    wave_number = np.array([0.0, 1e-9, SMALLEST * 1.01, 1e-3, 1e-2])
    ratio = maccamy_fuchs(np.array([2.0]), wave_number)[0]
    assert np.all(ratio[:2] == 2)
    assert abs(ratio[2] - 2) < 1e-9
    assert abs(ratio[3] - 2) < 1e-4
    assert 1e-4 < abs(ratio[4] - 2) < 1e-2


def test_short_waves_lose_their_force() -> None:
    """|H1'| goes as sqrt(2 / (pi ka)), the ratio as its inverse over (ka)^2."""
    size = np.array([50.0, 200.0])
    ratio = maccamy_fuchs(np.array([2.0]), size)[0]
    assert np.abs(ratio) == pytest.approx(
        4 / (np.pi * size**2) * np.sqrt(np.pi * size / 2), rel=1e-3
    )


def test_shapes() -> None:
    """(n, m) of n diameters and m wave numbers; only their product counts."""
    ratio = maccamy_fuchs(np.array([1.0, 2.0, 9.0]), np.array([0.2, 0.4]))
    assert ratio.shape == (3, 2)
    assert ratio[0, 1] == ratio[1, 0]


RADIUS, DEPTH, GRAVITY, DENSITY, AMPLITUDE, ADDED = 20.0, 60.0, 9.80665, 1025.0, 1.0, 0.8


@pytest.mark.parametrize("size", SIZES.tolist())
def test_force_on_a_rigid_cylinder_in_time(size: float) -> None:
    """4 rho g A tanh(kh) / (k^2 |H1'|), with its phase, from the strips' forces over a period."""
    k = size / RADIUS
    omega = np.sqrt(GRAVITY * k * np.tanh(k * DEPTH))
    height, length = Strips.between(-DEPTH, 0.0)
    diameter = np.full(len(height), 2 * RADIUS)
    factor = inertia_factor(diameter, np.array([k]), np.full(len(height), ADDED))
    assert np.all(factor == factor[0])
    water = RegularWater(height, DEPTH, AMPLITUDE, omega, k, inertia_factor=complex(factor[0, 0]))
    load = MorisonForce(Strips(height, length, diameter), water, DENSITY, ADDED, 0.0)
    phase = 2 * np.pi * np.arange(32) / 32
    motion = upright(height)
    force = np.array([load.forces(p / omega, motion, 1.0).force[:, 0].sum() for p in phase])
    found = 2 * np.mean(force * np.exp(-1j * phase))
    assert force == pytest.approx((found * np.exp(1j * phase)).real, abs=1e-9 * abs(found))
    relative, lag = closed_form(size)
    amplitude = DENSITY * GRAVITY * AMPLITUDE * np.pi * RADIUS**2 * np.tanh(k * DEPTH) * relative
    assert abs(found) == pytest.approx(amplitude, rel=1e-3)
    assert np.angle(found / (1j * np.exp(-1j * lag))) == pytest.approx(0.0, abs=1e-3)


def test_without_diffraction_short_waves_are_overstated() -> None:
    """Negative control: Morison's own force is far off the closed form at ka = 1.5."""
    assert 2 / closed_form(1.5)[0] > 1.5


def diffracted(oc6: ow.Turbine, name: str) -> HydrodynamicModel:
    keys = {"diffraction": name, "added_mass_coefficient": ADDED}
    turbine = oc6.model_copy(update={"hydrodynamics": oc6.hydrodynamics.model_copy(update=keys)})
    return HydrodynamicModel.of(turbine, ow.IrregularWaves(2.0, 6.0, seed=4, repeat_period=300.0))


def test_a_sea_s_harmonics_are_each_diffracted(oc6: ow.Turbine) -> None:
    """Spectra of the force on every strip: with diffraction over without, at each frequency."""
    time = np.arange(3000) / 10.0
    spectra = []
    for name in ("maccamy_fuchs", "none"):
        hydrodynamics = diffracted(oc6, name)
        n = len(hydrodynamics.strips.height)
        rows = hydrodynamics.wave_force().time_inputs(time, np.ones(len(time)))
        pushed = rows[:, 1 + 3 * n :].reshape(-1, n, 3)[:, :, [0, 2]]
        spectra.append(np.fft.rfft(pushed, axis=0))
        assert np.all(hydrodynamics.wave_force().time_inputs(time[:1], np.zeros(1)) == 0)
    harmonic = np.arange(21, 240)
    omega = 2 * np.pi * harmonic / 300.0
    k = wave_number(omega, 30.0, GRAVITY)
    expected = maccamy_fuchs(np.array([9.0]), k)[0] / (1 + ADDED)
    for strip in (10, 40, 59):
        ratio = spectra[0][harmonic, strip, 0] / spectra[1][harmonic, strip, 0]
        strong = np.abs(spectra[1][harmonic, strip, 0]) > 1e-4
        assert np.count_nonzero(strong) > 50
        assert ratio[strong] == pytest.approx(expected[strong], rel=1e-5)
    assert np.abs(spectra[0][harmonic, 59, 1] / spectra[1][harmonic, 59, 1]) == pytest.approx(
        np.abs(expected), rel=1e-6
    )


def test_velocities_are_those_of_the_undisturbed_wave(oc6: ow.Turbine) -> None:
    time = np.linspace(0.0, 7.0, 5)
    rows = [
        diffracted(oc6, name).wave_force().time_inputs(time, np.ones(5))[:, : 1 + 3 * 60]
        for name in ("maccamy_fuchs", "none")
    ]
    assert np.array_equal(*rows)
