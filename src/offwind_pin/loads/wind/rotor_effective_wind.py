"""Rotor-effective wind: turbulence, shear and tower shadow as sampled by the rotating blades.

On the blades' path u(r, psi, t) is a sum over harmonics n of the azimuth. B equal blades retain the
harmonics whose n is a multiple of B and shift their spectra by n times the rotor speed: energy at
low frequencies moves to 3P, 6P, 9P (Kristensen and Frandsen 1982; Sorensen, Hansen and Rosas 2002).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import (
    Array,
    ComplexArray,
    Definition,
    Flag,
    NonNegative,
    Positive,
    Seed,
    key,
)
from offwind_pin.base.errors import InputError
from offwind_pin.base.seeds import random_stream
from offwind_pin.definitions.rotor_disc import RotorDisc
from offwind_pin.loads.wind.history import WindHistory

TURBULENCE_CLASSES = {"A": 0.16, "B": 0.14, "C": 0.12}
"""Expected turbulence intensity at 15 m/s (IEC 61400-1 ed. 3, Table 1)."""

HIGHEST_ORDER = 4
"""Multiples of the blade-passing frequency that are included; higher ones have less than 1 % of the
variance."""

_COHERENCE_DECAY = 12.0
_COHERENCE_OFFSET = 0.12
_ROOT_SHARE = 0.05
"""Fraction of the radius at which the blades begin to carry thrust."""
_RADII, _DISTANCES, _ANGLES = 12, 16, 80
"""Points of the quadratures; they resolve harmonics up to the twentieth."""
_LINES = 80
"""Frequencies at which the rotor's averaging is computed; its logarithm is a cubic spline in that
of the frequency."""


@dataclass(frozen=True)
class Turbulence:
    """Longitudinal turbulence at one height: Kaimal's spectrum and an exponential coherence.

    Attributes
    ----------
    wind_speed : float, m/s
        Mean.
    deviation : float, m/s
        Standard deviation.
    scale : float, m
        Lambda_1, the turbulence scale parameter.
    """

    wind_speed: float
    deviation: float
    scale: float

    @property
    def length(self) -> float:
        """Integral scale 8.1 Lambda_1 in m."""
        return 8.1 * self.scale

    def spectrum(self, frequency: Array) -> Array:
        """One-sided spectrum in (m/s)^2/Hz at frequencies in Hz (IEC 61400-1 ed. 3, Eq. B.14)."""
        reduced = self.length / self.wind_speed
        return self.deviation**2 * 4 * reduced / (1 + 6 * frequency * reduced) ** (5 / 3)

    def coherence(self, frequency: Array | float, distance: Array) -> Array:
        """Coherence of two points a distance in m apart across the wind (IEC 61400-1 ed. 3,
        B.16)."""
        passing = frequency * distance / self.wind_speed
        apart = _COHERENCE_OFFSET * distance / self.length
        return np.exp(-_COHERENCE_DECAY * np.hypot(passing, apart))


def scale_parameter(height: float) -> float:
    """Lambda_1 in m at a height above the sea (IEC 61400-1 ed. 3, Eq. 5)."""
    return 0.7 * min(height, 60.0)


def normal_turbulence(wind_speed: float, turbulence_class: str) -> float:
    """Standard deviation in m/s of the normal turbulence model (IEC 61400-1 ed. 3, Eq. 11).

    Raises
    ------
    InputError
        A class other than A, B and C.
    """
    if turbulence_class not in TURBULENCE_CLASSES:
        raise InputError(
            "turbulence class",
            turbulence_class,
            "A, B or C",
            "Choose a class, or give turbulence_intensity.",
        )
    return TURBULENCE_CLASSES[turbulence_class] * (0.75 * wind_speed + 5.6)


@dataclass(frozen=True)
class RotorTurbulence:
    """How a rotor averages turbulence.

    Attributes
    ----------
    turbulence : Turbulence
        Turbulence of the wind.
    radius : float, m
    blades : int
        Number of blades.
    rotor_speed : float, rad/s
    root : float, m
        Radius where the blades begin to carry thrust.
    """

    turbulence: Turbulence
    radius: float
    blades: int
    rotor_speed: float
    root: float

    @property
    def blade_passing_frequency(self) -> float:
        """Blade-passing frequency in Hz."""
        return self.blades * self.rotor_speed / (2 * np.pi)

    def averaging(self, frequency: Array, order: int) -> Array:
        """(f,) fraction of the point spectrum in one harmonic of the azimuth, at frequencies in Hz.

        F_n = int int w(r) w(s) 1/pi int_0^pi coh(f, d) cos(n psi) dpsi dr ds, with d the distance
        of (r, 0) and (s, psi). Each blade's thrust is distributed over its radius like r (a disc
        under uniform pressure), so that w(r) = 2 r / (R^2 - r0^2). Points are densest where d is
        small.
        """
        r, s, psi, weight = self._points()
        distance = np.sqrt((r - s) ** 2 + 4 * r * s * np.sin(psi / 2) ** 2)
        weight = weight * np.cos(order * psi)
        return np.array(
            [np.sum(weight * self.turbulence.coherence(f, distance)) for f in frequency]
        )

    def harmonic_spectrum(self, frequency: Array, order: int) -> Array:
        """(f,) one-sided spectrum S_n = S F_n of a harmonic in the rotating frame, (m/s)^2/Hz."""
        from scipy.interpolate import CubicSpline

        lowest = 1e-3 * self.turbulence.wind_speed / self.turbulence.length
        highest = 1e3 * self.turbulence.wind_speed / self.radius
        lines = np.geomspace(lowest, highest, _LINES)
        share = CubicSpline(np.log(lines), np.log(self.averaging(lines, order)))
        inside = np.clip(frequency, lowest, highest)
        return np.asarray(self.turbulence.spectrum(frequency) * np.exp(share(np.log(inside))))

    def thrust_spectrum(self, frequency: Array, orders: int = HIGHEST_ORDER) -> Array:
        """(f,) one-sided spectrum of the rotor-effective wind, (m/s)^2/Hz.

        S(f) = S_0(f) + sum over k of S_kB(|f - k fB|) + S_kB(f + k fB), with fB the blade-passing
        frequency.
        """
        total = self.harmonic_spectrum(frequency, 0)
        for k in range(1, orders + 1):
            shift = k * self.blade_passing_frequency
            both = np.concatenate([np.abs(frequency - shift), frequency + shift])
            total += self.harmonic_spectrum(both, k * self.blades).reshape(2, -1).sum(axis=0)
        return total

    def _points(self) -> tuple[Array, Array, Array, Array]:
        """Radii r > s and angles of pairs of points, and their weights, each pair counted twice."""
        x, u = _gauss(_RADII)
        y, v = _gauss(_DISTANCES)
        z, w = _gauss(_ANGLES)
        r, y, z = x[:, None, None], y[None, :, None], z[None, None, :]
        span = self.radius - self.root
        r = self.root + span * r
        s = r - (r - self.root) * y**3
        psi = np.pi * z**2
        thrust = 4 * r * s / (self.radius**2 - self.root**2) ** 2
        weight = u[:, None, None] * v[None, :, None] * w[None, None, :]
        weight = weight * 2 * span * (r - self.root) * 3 * y**2 * 2 * z
        return r, s, psi, thrust * weight


def _gauss(count: int) -> tuple[Array, Array]:
    """Gauss-Legendre points and weights from 0 to 1."""
    points, weights = np.polynomial.legendre.leggauss(count)
    return (points + 1) / 2, weights / 2


class RotorWind(Definition, kw_only=False):
    """Settings of the wind at a rotor.

    Attributes
    ----------
    wind_speed : float, m/s
        Mean at the hub.
    turbulence_intensity : float or None
        Standard deviation over the mean.
    shear_exponent : float
        Of the power law; 0.14 offshore, 0.2 on land (IEC 61400-3 ed. 1, 6.3.1.2; 61400-1 ed. 3,
        6.3.1.2).
    tower_shadow : bool
        Whether the tower slows the wind in front of it.
    seed : int or None
        Seed of the phases; by default that of the load case, or 1.
    turbulence_class : {"A", "B", "C"} or None
        IEC 61400-1's A, B or C, in place of the turbulence intensity.
    """

    wind_speed: Annotated[Positive, Field(ge=1, le=60)] = key("wind_speed_m_per_s")
    turbulence_intensity: Annotated[NonNegative, Field(le=1)] | None = None
    shear_exponent: Annotated[NonNegative, Field(le=1)] = 0.14
    tower_shadow: Flag = True
    seed: Seed | None = None
    turbulence_class: Literal["A", "B", "C"] | None = Field(default=None, kw_only=True)

    @model_validator(mode="after")
    def _one_turbulence(self) -> Self:
        if (self.turbulence_class is None) == (self.turbulence_intensity is None):
            raise ValueError(
                "turbulence_class and turbulence_intensity are both given, or neither is; give one "
                "of them"
            )
        return self

    @property
    def intensity(self) -> float:
        """Standard deviation of the wind over its mean."""
        if self.turbulence_class is not None:
            return normal_turbulence(self.wind_speed, self.turbulence_class) / self.wind_speed
        return self.turbulence_intensity or 0.0

    def completed(self, seed: int) -> Self:
        """The same wind, with the seed of a load case if it has none of its own.

        Parameters
        ----------
        seed : int
            Seed of the case.

        Returns
        -------
        RotorWind
        """
        return self if self.seed is not None else self.replace(seed=seed)

    def turbulence(self, disc: RotorDisc) -> Turbulence:
        """Turbulence of this wind at hub height.

        Parameters
        ----------
        disc : RotorDisc
            The rotor.

        Returns
        -------
        Turbulence
        """
        deviation = self.intensity * self.wind_speed
        return Turbulence(self.wind_speed, deviation, scale_parameter(disc.hub_height))

    def of_rotor(self, disc: RotorDisc) -> RotorTurbulence:
        """How a rotor averages this wind.

        Parameters
        ----------
        disc : RotorDisc
            The rotor.

        Returns
        -------
        RotorTurbulence
        """
        return RotorTurbulence(
            self.turbulence(disc),
            disc.radius,
            disc.blades,
            disc.speed(self.wind_speed),
            _ROOT_SHARE * disc.radius,
        )

    def generate(self, disc: RotorDisc, *, repeat_period: float, dt: float = 0.02) -> WindHistory:
        """A rotor-effective wind history, periodic in ``repeat_period`` seconds.

        Its mean is exactly the mean wind: the effect of shear and shadow on the mean is omitted,
        since tables of the thrust coefficient are over the wind at the hub. Turbulence has random
        phases on the harmonics of the period; rotor speed is rounded so that the blades pass a
        whole number of times in it. Samples are at most dt apart.

        Parameters
        ----------
        disc : RotorDisc
            The rotor.
        repeat_period : float, s
            After which the wind repeats.
        dt : float, s
            Largest distance of samples.

        Returns
        -------
        WindHistory

        Raises
        ------
        InputError
            A dt too coarse for the highest multiple of the blade-passing frequency, a period that
            is not positive, or a turbine without a table of the rotor speed.
        """
        rotor = self.of_rotor(disc)
        passing = rotor.blade_passing_frequency
        highest = (HIGHEST_ORDER + 1) * passing
        if not (np.isfinite(repeat_period) and repeat_period > 1 / passing):
            allowed = f"more than {1 / passing:.3g} s, the time between two blades"
            raise InputError("rotor wind, repeat_period", repeat_period, allowed, "Lengthen it.")
        if not 0 < dt < 0.5 / highest:
            limits = f"more than 0 and less than {0.5 / highest:.3g} s"
            raise InputError("rotor wind, dt", dt, limits, "Refine it.")
        count = int(np.ceil(repeat_period / dt - 1e-9))
        time = np.arange(count) * repeat_period / count
        order = np.arange(1, int(highest * repeat_period) + 1)
        rng = random_stream(self.wind_seed, "rotor_wind")
        lines = np.zeros(count // 2 + 1, dtype=complex)
        if self.intensity > 0:
            spectrum = rotor.thrust_spectrum(order / repeat_period)
            phase = rng.uniform(0, 2 * np.pi, len(order))
            lines[order] = count / 2 * np.sqrt(2 * spectrum / repeat_period) * np.exp(1j * phase)
        speed = self.wind_speed + np.fft.irfft(lines, n=count)
        rounded = round(passing * repeat_period) / repeat_period
        for k, amplitude in enumerate(self.tones(disc), start=1):
            speed += np.real(amplitude * np.exp(2j * np.pi * k * rounded * time))
        return WindHistory(repeat_period / count, speed, self.wind_speed, self._describe())

    def tones(self, disc: RotorDisc) -> ComplexArray:
        """Complex amplitudes at multiples of the blade-passing frequency.

        One blade points upwards at time 0.

        Parameters
        ----------
        disc : RotorDisc
            The rotor.

        Returns
        -------
        (HIGHEST_ORDER,) complex array, m/s
        """
        azimuth = 2 * np.pi * np.arange(720) / 720
        steady = self._steady(disc, azimuth) - self.wind_speed
        harmonics = 2 * np.fft.fft(steady) / len(azimuth)
        # A real signal of amplitude c at order n is Re(c exp(i n psi)).
        return harmonics[disc.blades * np.arange(1, HIGHEST_ORDER + 1)]

    def _steady(self, disc: RotorDisc, azimuth: Array) -> Array:
        """(a,) mean wind in m/s over a blade at an azimuth, 0 upwards."""
        root = _ROOT_SHARE * disc.radius
        x, weight = _gauss(64)
        r = root + (disc.radius - root) * x
        weight = weight * 2 * r / (disc.radius + root)
        up = r * np.cos(azimuth)[:, None] * np.cos(disc.tilt)
        across = -r * np.sin(azimuth)[:, None]
        ahead = disc.overhang * np.cos(disc.tilt) - r * np.cos(azimuth)[:, None] * np.sin(disc.tilt)
        wind = self.wind_speed * (1 + up / disc.hub_height) ** self.shear_exponent
        if self.tower_shadow:
            # Potential flow about a cylinder, u = U (1 - (D/2)^2 (x^2 - y^2) / (x^2 + y^2)^2).
            height = disc.hub_height + up
            radius = np.interp(height, disc.tower_height, disc.tower_diameter, right=0.0) / 2
            wind = wind * (1 - radius**2 * (ahead**2 - across**2) / (ahead**2 + across**2) ** 2)
        return np.asarray(wind @ weight)

    @property
    def wind_seed(self) -> int:
        """Seed of the phases: its own, or 1."""
        return 1 if self.seed is None else self.seed

    def _describe(self) -> str:
        return (
            f"rotor-effective wind, {self.wind_speed:g} m/s, turbulence intensity "
            f"{self.intensity:.4g}, shear exponent {self.shear_exponent:g}, seed {self.wind_seed}"
        )
