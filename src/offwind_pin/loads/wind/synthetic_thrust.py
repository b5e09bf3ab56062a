"""A synthetic tower-top load for below-rated wind, where no load file is available.

It replaces a prescribed history: it does not depend on the motion and keeps the benchmark's
blade-passing frequency; ``rotor_effective_wind`` derives the wind of an operating rotor. It is
marked as a surrogate: mean thrust and torque from momentum theory at the given rotor speed,
turbulence averaged over the rotor, and the blade-passing harmonics due to rotational sampling of
shear, tower shadow and turbulence.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from pydantic import Field

from offwind_pin.base.definition import Array, Definition, NonNegative, Positive, Seed, key
from offwind_pin.base.errors import InputError
from offwind_pin.base.seeds import random_stream
from offwind_pin.definitions.rotor_nacelle import rotor_apex, rotor_radius
from offwind_pin.definitions.turbine import RotorNacelleRNA
from offwind_pin.loads.tower_top.load_history import LoadHistory

_HIGHEST_FREQUENCY = 5.0
"""Hz, above which turbulence and harmonics are negligible."""

AIR_DENSITY = 1.225
"""kg/m3, the standard atmosphere at sea level."""

KAIMAL_LENGTH = 340.2
"""m, the longitudinal integral scale 8.1 x 42 m of IEC 61400-1 Eq. B.14 above 60 m height."""


@dataclass(frozen=True)
class RotorOperation:
    """Steady state of the rotor in a mean wind, from one-dimensional momentum theory.

    Attributes
    ----------
    wind_speed, rotor_speed : float, m/s and rad/s
    radius, swept_area : float, m and m2
    power_coefficient, induction, thrust_coefficient : float
        Dimensionless.
    thrust, torque : float, N and N m
        Along and about the shaft.
    """

    wind_speed: float
    rotor_speed: float
    radius: float
    swept_area: float
    power_coefficient: float
    induction: float
    thrust_coefficient: float
    thrust: float
    torque: float

    @property
    def tip_speed_ratio(self) -> float:
        return self.rotor_speed * self.radius / self.wind_speed


def operate_rotor(
    rna: RotorNacelleRNA,
    wind_speed: float,
    blade_passing_frequency: float,
    lift_to_drag: float = 100.0,
) -> RotorOperation:
    """Thrust and torque of a well-designed rotor at its tip-speed ratio.

    1. The blade-passing frequency gives the rotor speed, and with the radius the tip-speed ratio.
    2. Manwell, McGowan and Rogers (Wind Energy Explained, 2nd ed., Eq. 3.109) give the largest
       power coefficient of a rotor with that ratio, number of blades and lift-to-drag ratio; its
       first term is the aerodynamic power (wake rotation and tip losses included), its second the
       profile drag.
    3. Momentum theory, Cp = 4 a (1 - a)^2, gives the induction a (below 1/3) for the first term,
       and the thrust coefficient is 4 a (1 - a).
    4. Thrust = Ct rho A U^2 / 2 and torque = Cp rho A U^3 / 2 / Omega, with the whole Cp.

    wind_speed in m/s, blade_passing_frequency in Hz.
    """
    from scipy.optimize import brentq

    rotor_speed = 2 * np.pi * blade_passing_frequency / rna.blades
    radius = rotor_radius(rna)
    ratio = rotor_speed * radius / wind_speed
    tip = (1.32 + ((ratio - 8) / 20) ** 2) / rna.blades ** (2 / 3)
    from_air = 16 / 27 * ratio / (ratio + tip)
    drag = 0.57 * ratio**2 / (lift_to_drag * (ratio + 1 / (2 * rna.blades)))
    induction = float(brentq(lambda a: 4 * a * (1 - a) ** 2 - from_air, 0, 1 / 3))
    area = np.pi * radius**2
    pressure = AIR_DENSITY * area * wind_speed**2 / 2
    thrust_coefficient = 4 * induction * (1 - induction)
    power = (from_air - drag) * pressure * wind_speed
    return RotorOperation(
        wind_speed=wind_speed,
        rotor_speed=rotor_speed,
        radius=radius,
        swept_area=area,
        power_coefficient=from_air - drag,
        induction=induction,
        thrust_coefficient=thrust_coefficient,
        thrust=thrust_coefficient * pressure,
        torque=power / rotor_speed,
    )


class SyntheticWind(Definition, kw_only=False):
    """Settings of the generator; values without a stated derivation are assumptions.

    Attributes
    ----------
    wind_speed : float, m/s
        Mean at hub height.
    blade_passing_frequency : float, Hz
        3P.
    turbulence_intensity : float
        Standard deviation of the wind over its mean.
    harmonics : tuple of float
        Standard deviation of the thrust at 3P, 6P, 9P over the mean thrust.
    coherent_fraction : float
        Fraction of the variance at 3P in a pure tone (shear and tower shadow); its square applies
        at 6P, its cube at 9P; the rest is turbulence sampled by the blades.
    seed : int or None
        Seed of the phases; by default that of the load case, or 1.
    """

    kind: Literal["synthetic"] = Field(default="synthetic", kw_only=True)
    wind_speed: Annotated[Positive, Field(ge=1, le=25)] = key("wind_speed_m_per_s")
    blade_passing_frequency: Annotated[Positive, Field(le=5)] = key("blade_passing_frequency_hz")
    turbulence_intensity: Annotated[NonNegative, Field(le=1)] = 0.10
    harmonics: tuple[NonNegative, ...] = (0.05, 0.02, 0.012)
    coherent_fraction: Annotated[NonNegative, Field(le=1)] = 0.3
    seed: Seed | None = None

    surrogate: ClassVar[str] = (
        "synthetic: the benchmark's own tower-top load history is not available"
    )

    def completed(self, seed: int) -> Self:
        """The same settings, with the seed of a load case if there is none of its own.

        Parameters
        ----------
        seed : int
            Seed of the case.

        Returns
        -------
        SyntheticWind
        """
        return self if self.seed is not None else self.replace(seed=seed)

    def generate(
        self, rna: RotorNacelleRNA, *, duration: float, repeat_period: float, dt: float = 0.02
    ) -> LoadHistory:
        """A history from 0 to ``duration``, periodic in ``repeat_period``.

        Its mean over any whole period is exactly the mean load. Samples are at most dt apart, a
        whole number per period.

        The wind varies with a Kaimal spectrum, averaged over the rotor by Vickery's aerodynamic
        admittance 1 / (1 + (2 f sqrt(A) / U)^(4/3)); thrust and torque follow it quasi-steadily at
        constant tip-speed ratio, both with the square of the wind. The turbulence at harmonic n is
        a Lorentzian band about its frequency, of half width n U / (2 pi R): eddies that form a
        pattern of n waves around the rotor have the size R / n and pass in R / (n U).

        Parameters
        ----------
        rna : RotorNacelleRNA
        duration : float, s
            Length of the history.
        repeat_period : float, s
            After which it repeats.
        dt : float, s
            Largest distance of samples.

        Returns
        -------
        LoadHistory

        Raises
        ------
        InputError
            A dt too coarse for the harmonics, or a period that is not positive.
        """
        _check_sampling(dt, repeat_period)
        rotor = operate_rotor(rna, self.wind_speed, self.blade_passing_frequency)
        rng = random_stream(self.wind_seed, "synthetic_wind")
        count = int(np.ceil(repeat_period / dt - 1e-9))
        interval = repeat_period / count
        frequency = np.arange(1, int(_HIGHEST_FREQUENCY * repeat_period) + 1) / repeat_period
        gust = _realise(self._rotor_wind_spectrum(frequency, rotor), frequency, count, rng)
        ratio = 2 * gust / self.wind_speed
        time = np.arange(count) * interval
        for order, sigma in enumerate(self.harmonics, start=1):
            center = order * self.blade_passing_frequency
            half_width = order * self.wind_speed / (2 * np.pi * rotor.radius)
            band = half_width / np.pi / ((frequency - center) ** 2 + half_width**2)
            coherent = self.coherent_fraction**order
            stochastic = (1 - coherent) * sigma**2 * band
            ratio += _realise(stochastic, frequency, count, rng)
            tone = max(1, round(center * repeat_period)) / repeat_period
            amplitude = np.sqrt(2 * coherent) * sigma
            ratio += amplitude * np.cos(2 * np.pi * tone * time - rng.uniform(0, 2 * np.pi))
        samples = np.arange(int(np.ceil(duration / interval - 1e-9)) + 1)
        steady = steady_load(rna, rotor)
        load = steady * (1 + ratio[samples % count, None])
        return LoadHistory(
            samples.astype(np.float64) * interval,
            load,
            origin=self._describe(),
            surrogate=self.surrogate,
        )

    def _rotor_wind_spectrum(self, frequency: Array, rotor: RotorOperation) -> Array:
        """One-sided spectrum of the rotor-averaged wind in (m/s)^2/Hz."""
        sigma = self.turbulence_intensity * self.wind_speed
        reduced = KAIMAL_LENGTH / self.wind_speed
        kaimal = sigma**2 * 4 * reduced / (1 + 6 * frequency * reduced) ** (5 / 3)
        size = 2 * frequency * np.sqrt(rotor.swept_area) / self.wind_speed
        return kaimal / (1 + size ** (4 / 3)) ** 2

    @property
    def wind_seed(self) -> int:
        """Seed of the phases: its own, or 1."""
        return 1 if self.seed is None else self.seed

    def _describe(self) -> str:
        return f"synthetic wind load, {self.wind_speed} m/s, seed {self.wind_seed}"


def steady_load(rna: RotorNacelleRNA, rotor: RotorOperation) -> Array:
    """(6,) load at the yaw bearing in N and N m of thrust and torque along the tilted shaft."""
    apex, shaft = rotor_apex(rna)
    force = rotor.thrust * shaft
    moment = np.cross(apex, force) + rotor.torque * shaft
    return np.concatenate([force, moment])


def _check_sampling(dt: float, repeat_period: float) -> None:
    if not 0 < dt < 0.5 / _HIGHEST_FREQUENCY:
        limits = f"more than 0 and less than {0.5 / _HIGHEST_FREQUENCY} s"
        raise InputError("synthetic wind, dt", dt, limits, "Refine it.")
    if not (np.isfinite(repeat_period) and repeat_period > 0):
        positive = "a positive number of seconds"
        raise InputError("synthetic wind, repeat_period", repeat_period, positive, "Correct it.")


def _realise(spectrum: Array, frequency: Array, count: int, rng: np.random.Generator) -> Array:
    """(count,) zero-mean periodic signal, random phases on harmonics 1, 2, ... of its period."""
    lines = np.zeros(count // 2 + 1, dtype=complex)
    amplitude = np.sqrt(2 * spectrum * frequency[0])
    phase = rng.uniform(0, 2 * np.pi, len(frequency))
    lines[1 : len(frequency) + 1] = count / 2 * amplitude * np.exp(1j * phase)
    return np.fft.irfft(lines, n=count)
