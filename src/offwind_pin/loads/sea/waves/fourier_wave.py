"""Steady waves of finite height by Fourier approximation of the full equations of motion.

Sources: Rienecker & Fenton (1981), J. Fluid Mech. 104; Fenton (1988), Computers & Geosciences 14,
for the unknowns and equations; the highest wave is Fenton's (1990) fit to the computations of
Williams (1981).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.loads.sea.waves.dispersion import wave_number

_ORDERS = (16, 32, 64)
"""Tried in turn if no order is given."""
_SMALL_TAIL = 1e-5
"""Last coefficient of the surface that counts as small, as a fraction of the height."""
_FIRST_HEIGHT = 0.25
"""First step of the height, as a fraction of the highest wave's."""
_FIRST_URSELL = 50.0
"""Largest Ursell number H L^2 / d^3 of the first step: long waves are not sinusoidal."""
_SMALLEST_STEP = 1e-3
"""Smallest step of the height, as a fraction of the first step."""
_ITERATIONS = 30
_TOLERANCE = 1e-12
_RIPPLE = 0.02
_CONVERGED = 1e-9
"""Largest residual accepted where rounding keeps it above the tolerance."""


def highest_wave(length: float, depth: float) -> float:
    """Height in m of the highest steady wave of a length, both in m: Fenton (1990), eq. 32."""
    ratio = length / depth
    above = ratio * (0.141063 + ratio * (0.0095721 + ratio * 0.0077829))
    below = 1 + ratio * (0.0788340 + ratio * (0.0317567 + ratio * 0.0093407))
    return depth * above / below


@dataclass(frozen=True, eq=False)
class SteadyWave:
    """A wave of permanent form over a flat bed; x moves with it, and its crest is at x = 0.

    In the frame that travels with the crest, z upwards from the mean level,

        psi = -mean_speed (z + d) + sum_j stream_j sinh(j k (z + d)) / cosh(j k d) cos(j k x)
        eta = sum_j surface_j cos(j k x)

    Attributes
    ----------
    height, depth, gravity : float, m and m/s2
    wave_number : float, rad/m
        k.
    speed : float, m/s
        Of the crest over the ground.
    mean_speed : float, m/s
        Mean speed of the water relative to the crest at a fixed height; the mean velocity over the
        ground (Eulerian current) is speed - mean_speed.
    volume_flux : float, m2/s
        In the frame of the crest; the mean transport velocity over the ground (Stokes current) is
        speed - volume_flux / depth.
    bernoulli : float, m2/s2
        Constant, with the height counted from the mean level.
    surface : (N,) array, m
        Coefficients of j = 1 ... N.
    stream : (N,) array, m2/s
        Coefficients of j = 1 ... N.
    """

    height: float
    depth: float
    gravity: float
    wave_number: float
    speed: float
    mean_speed: float
    volume_flux: float
    bernoulli: float
    surface: Array
    stream: Array

    @staticmethod
    def solve(
        height: float,
        *,
        depth: float,
        gravity: float,
        period: float | None = None,
        length: float | None = None,
        eulerian_current: float | None = None,
        stokes_current: float | None = None,
        order: int | None = None,
    ) -> SteadyWave:
        """The wave of a height and a period over the ground, or of a length.

        Parameters
        ----------
        height, depth : float, m
        gravity : float, m/s2
        period : float, s, optional
            As a fixed observer sees it.
        length : float, m, optional
            Given in place of the period.
        eulerian_current : float, m/s, optional
            Mean velocity along the wave at heights that are always wet; 0 without a current.
        stokes_current : float, m/s, optional
            Mean transport velocity over the depth, in its place.
        order : int, optional
            Number N of coefficients; by default 16, and twice as many, up to 64, until the last one
            of the surface is below 1e-5 of the height.

        Raises
        ------
        InputError
            A number is out of its range, both or neither of period and length are given, or both
            currents; the wave is higher than the highest; the solution does not converge.
        """
        _check(height, depth, gravity, period, length, order)
        if eulerian_current is not None and stokes_current is not None:
            raise InputError(
                "stream function wave, field stokes_current",
                stokes_current,
                "one of eulerian_current and stokes_current",
                "Leave one out.",
            )
        current = eulerian_current if stokes_current is None else stokes_current
        problem = _Problem.of(
            height,
            depth,
            gravity,
            period,
            length,
            0.0 if current is None else current,
            by_transport=stokes_current is not None,
        )
        if order is not None:
            return problem.solve(order, None)
        wave = problem.solve(_ORDERS[0], None)
        for number in _ORDERS[1:]:
            if abs(wave.surface[-1]) <= _SMALL_TAIL * height:
                break
            wave = problem.solve(number, wave)
        return wave

    @property
    def order(self) -> int:
        return len(self.surface)

    @property
    def length(self) -> float:
        """Wave length in m."""
        return 2 * np.pi / self.wave_number

    @property
    def period(self) -> float:
        """Period over the ground in s."""
        return self.length / self.speed

    @property
    def eulerian_current(self) -> float:
        """Mean velocity in m/s at heights that are always wet."""
        return self.speed - self.mean_speed

    @property
    def stokes_current(self) -> float:
        """Mean transport velocity over the depth in m/s."""
        return self.speed - self.volume_flux / self.depth

    @property
    def crest(self) -> float:
        """Height of the crest above the mean level in m."""
        return float(np.sum(self.surface))


def depth_functions(number: Array, height: Array, depth: float) -> tuple[Array, Array]:
    """cosh and sinh of number (height + depth), over cosh of number depth; broadcast.

    number : wave number in rad/m, above 0; height above the mean level and depth in m
    """
    grow = np.exp(number * height)
    fall = np.exp(-number * (2 * depth + height))
    full = 1 + np.exp(-2 * number * depth)
    return (grow + fall) / full, (grow - fall) / full


def _check(
    height: float,
    depth: float,
    gravity: float,
    period: float | None,
    length: float | None,
    order: int | None,
) -> None:
    if (period is None) == (length is None):
        raise InputError(
            "stream function wave, fields period and length",
            (period, length),
            "one of the two",
            "Give one.",
        )
    numbers: dict[str, float | None] = {"height": height, "depth": depth, "gravity": gravity}
    numbers |= {"period": period} if length is None else {"length": length}
    for name, value in numbers.items():
        if value is None or not (np.isfinite(value) and value > 0):
            where = f"stream function wave, field {name}"
            raise InputError(where, value, "a positive number", "Correct it.")
    if order is not None and not (isinstance(order, int) and 2 <= order <= 128):
        where = "stream function wave, field order"
        raise InputError(where, order, "a whole number from 2 to 128", "Correct it.")


@dataclass(frozen=True)
class _Problem:
    """The required wave, in units of ``unit`` m and of gravity 1.

    beat : k c, the angular frequency over the ground, or None where the wave number is given
    number : the wave number, or that of a small wave of the period on the current
    """

    height: float
    depth: float
    beat: float | None
    number: float
    current: float
    by_transport: bool
    unit: float
    gravity: float

    @staticmethod
    def of(
        height: float,
        depth: float,
        gravity: float,
        period: float | None,
        length: float | None,
        current: float,
        *,
        by_transport: bool,
    ) -> _Problem:
        if period is None:
            free = 2 * np.pi / float(length or np.nan)
        else:
            free = _small_wave(2 * np.pi / period, depth, gravity, current)
        unit = 1 / free
        clock = np.sqrt(unit / gravity)
        return _Problem(
            height / unit,
            depth / unit,
            None if period is None else 2 * np.pi / period * clock,
            1.0,
            current * clock / unit,
            by_transport,
            unit,
            gravity,
        )

    def solve(self, order: int, coarser: SteadyWave | None) -> SteadyWave:
        """From a wave of lower order or, without one, from small heights upwards."""
        if coarser is not None:
            start = self._scaled(coarser, order)
            found = self._newton(start, self.height, order)
            if found is not None:
                return self._finished(found, order)
        return self._finished(self._raised(order), order)

    def _raised(self, order: int) -> Array:
        """The unknowns at the full height, in steps from the linear wave."""
        limit = highest_wave(2 * np.pi / self.number, self.depth)
        long = _FIRST_URSELL * self.depth**3 * (self.number / (2 * np.pi)) ** 2
        first = min(self.height, _FIRST_HEIGHT * limit, long)
        height, step = 0.0, first
        known: list[tuple[float, Array]] = []
        while height < self.height:
            target = min(height + step, self.height)
            start = self._continued(known, target, order)
            found = self._newton(start, target, order)
            if found is not None:
                limit = highest_wave(2 * np.pi / found[-5], self.depth)
                if target > limit:
                    self._refuse(limit, "below the highest steady wave", "Lower it.")
                known, height = [*known[-1:], (target, found)], target
                continue
            step /= 2
            if step < _SMALLEST_STEP * first:
                if self.height > limit:
                    self._refuse(limit, "below the highest steady wave", "Lower it.")
                remedy = "Lower it, or change order."
                self._refuse(limit, "a wave whose solution converges, below the highest", remedy)
        return known[-1][1]

    def _continued(self, known: list[tuple[float, Array]], height: float, order: int) -> Array:
        """The unknowns at a height, on the line through the last two waves; linear at first."""
        if not known:
            return self._linear(height, order)
        if len(known) == 1:
            return known[0][1]
        (low, before), (high, now) = known
        return now + (height - high) / (high - low) * (now - before)

    def _refuse(self, limit: float, what: str, remedy: str) -> None:
        text = f"{what}, {limit * self.unit:.4g} m here (Fenton 1990)"
        received = self.height * self.unit
        raise InputError("stream function wave, field height", received, text, remedy)

    def _linear(self, height: float, order: int) -> Array:
        """The small wave's unknowns: surface, stream, k, c, mean speed, flux, Bernoulli."""
        position = np.arange(order + 1) * np.pi / order
        speed = np.sqrt(np.tanh(self.number * self.depth) / self.number)
        stream = np.zeros(order)
        stream[0] = height / 2 / self.number / speed
        return np.concatenate(
            [
                height / 2 * np.cos(position),
                stream,
                [self.number, speed + self.current, speed, speed * self.depth, speed**2 / 2],
            ]
        )

    def _scaled(self, wave: SteadyWave, order: int) -> Array:
        """The unknowns of a known wave, at more points."""
        clock = np.sqrt(self.unit / self.gravity)
        position = np.arange(order + 1) * np.pi / order
        cosines = np.cos(np.outer(position, np.arange(1, wave.order + 1)))
        stream = np.zeros(order)
        stream[: wave.order] = wave.stream * clock / self.unit**2
        others = [
            wave.wave_number * self.unit,
            wave.speed * clock / self.unit,
            wave.mean_speed * clock / self.unit,
            wave.volume_flux * clock / self.unit**2,
            wave.bernoulli * (clock / self.unit) ** 2,
        ]
        return np.concatenate([cosines @ wave.surface / self.unit, stream, others])

    def _newton(self, start: Array, height: float, order: int) -> Array | None:
        unknown = start.copy()
        for _ in range(_ITERATIONS):
            with np.errstate(over="ignore", invalid="ignore"):
                residual, slope = self.equations(unknown, height, order)
            if not (np.all(np.isfinite(residual)) and np.all(np.isfinite(slope))):
                return None
            if np.abs(residual).max() <= _TOLERANCE:
                break
            try:
                step = np.linalg.solve(slope, residual)
            except np.linalg.LinAlgError:
                return None
            unknown = unknown - step
            if unknown[-5] <= 0 or unknown[-3] <= 0:
                return None
            if np.abs(step).max() <= _TOLERANCE:
                break
        with np.errstate(over="ignore", invalid="ignore"):
            residual, _ = self.equations(unknown, height, order)
        largest = np.abs(residual).max()
        # The surface falls from one crest to one trough, except for ripples of a coarse series.
        falls = np.all(np.diff(unknown[: order + 1]) < _RIPPLE * height)
        return unknown if falls and largest <= _CONVERGED else None

    def equations(self, unknown: Array, height: float, order: int) -> tuple[Array, Array]:
        """Residuals of Fenton's (1988) equations, (2 N + 6,), and their slopes."""
        eta, stream = unknown[: order + 1], unknown[order + 1 : 2 * order + 1]
        k, c, mean, flux, bernoulli = unknown[-5:]
        d = self.depth
        j = np.arange(1, order + 1)
        angle = np.outer(np.arange(order + 1), j) * np.pi / order
        cos, sin = np.cos(angle), np.sin(angle)
        cosh, sinh = depth_functions(j * k, eta[:, None], d)
        tanh = np.tanh(j * k * d)
        cosh_by_k = j * ((d + eta[:, None]) * sinh - cosh * tanh)
        sinh_by_k = j * ((d + eta[:, None]) * cosh - sinh * tanh)
        u = -mean + (cosh * cos) @ (j * k * stream)
        w = (sinh * sin) @ (j * k * stream)
        points = np.arange(order + 1)
        at_stream = slice(order + 1, 2 * order + 1)
        at_k, at_c, at_mean, at_flux, at_bernoulli = range(2 * order + 1, 2 * order + 6)

        residual = np.zeros(2 * order + 6)
        slope = np.zeros((2 * order + 6, 2 * order + 6))
        # the surface is a streamline
        rows = points
        residual[rows] = -mean * (d + eta) + (sinh * cos) @ stream + flux
        slope[rows, points] = u
        slope[rows, at_stream] = sinh * cos
        slope[rows, at_k] = (sinh_by_k * cos) @ stream
        slope[rows, at_mean] = -(d + eta)
        slope[rows, at_flux] = 1
        # and of constant pressure
        rows = points + order + 1
        residual[rows] = (u**2 + w**2) / 2 + eta - bernoulli
        u_by_z = (sinh * cos) @ ((j * k) ** 2 * stream)
        w_by_z = (cosh * sin) @ ((j * k) ** 2 * stream)
        slope[rows, points] = u * u_by_z + w * w_by_z + 1
        slope[rows, at_stream] = j * k * (u[:, None] * cosh * cos + w[:, None] * sinh * sin)
        u_by_k = (cosh * cos) @ (j * stream) + (cosh_by_k * cos) @ (j * k * stream)
        w_by_k = (sinh * sin) @ (j * stream) + (sinh_by_k * sin) @ (j * k * stream)
        slope[rows, at_k] = u * u_by_k + w * w_by_k
        slope[rows, at_mean] = -u
        slope[rows, at_bernoulli] = -1
        # mean level, height, length or period, current
        row = 2 * order + 2
        weight = np.full(order + 1, 1 / order)
        weight[[0, -1]] /= 2
        residual[row], slope[row, points] = weight @ eta, weight
        residual[row + 1] = eta[0] - eta[-1] - height
        slope[row + 1, 0], slope[row + 1, order] = 1, -1
        if self.beat is None:
            residual[row + 2], slope[row + 2, at_k] = k - self.number, 1
        else:
            residual[row + 2] = k * c - self.beat
            slope[row + 2, at_k], slope[row + 2, at_c] = c, k
        slope[row + 3, at_c] = 1
        if self.by_transport:
            residual[row + 3] = c - flux / d - self.current
            slope[row + 3, at_flux] = -1 / d
        else:
            residual[row + 3] = c - mean - self.current
            slope[row + 3, at_mean] = -1
        return residual, slope

    def _finished(self, unknown: Array, order: int) -> SteadyWave:
        eta = unknown[: order + 1]
        j = np.arange(1, order + 1)
        weight = np.full(order + 1, 2 / order)
        weight[[0, -1]] /= 2
        surface = np.cos(np.outer(j, np.arange(order + 1)) * np.pi / order) @ (weight * eta)
        surface[-1] /= 2
        k, c, mean, flux, bernoulli = unknown[-5:]
        unit, speed = self.unit, np.sqrt(self.gravity * self.unit)
        return SteadyWave(
            self.height * unit,
            self.depth * unit,
            self.gravity,
            float(k / unit),
            float(c * speed),
            float(mean * speed),
            float(flux * speed * unit),
            float(bernoulli * speed**2),
            surface * unit,
            unknown[order + 1 : 2 * order + 1] * speed * unit,
        )


def _small_wave(frequency: float, depth: float, gravity: float, current: float) -> float:
    """Wave number in rad/m of a small wave of an angular frequency over the ground, on a current.

    Solves sqrt(g k tanh k d) + k U = frequency; with too strong an opposing current there is none.
    """
    k = float(wave_number(np.array([frequency]), depth, gravity)[0])
    for _ in range(100):
        tanh = np.tanh(k * depth)
        own = np.sqrt(gravity * k * tanh)
        group = gravity * (tanh + k * depth * (1 - tanh**2)) / (2 * own)
        step = (own + k * current - frequency) / (group + current)
        if not (np.isfinite(step) and group + current > 0 and k - step > 0):
            break
        k -= step
        if abs(step) <= 1e-13 * k:
            return k
    raise InputError(
        "stream function wave, field current",
        current,
        "a current against which the wave can travel",
        "Reduce the current, or lengthen the period.",
    )
