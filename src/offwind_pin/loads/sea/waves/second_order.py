"""Irregular waves to second order: bound components of pairs of linear waves.

Two free waves of elevation Re a exp(i (sigma t - k.x)) force the boundary conditions of second
order at the mean water level, on a depth d,

    eta2_t - phi2_z = -div(eta1 grad phi1),   phi2_t + g eta2 = -eta1 phi1_zt - |grad phi1|^2 / 2,

at the sum (s = 1) and the difference (s = -1) of their frequencies, Omega = sigma_n + s sigma_m,
with the wave vector K = k_n + s k_m and kappa = |K|. The solution is

    phi2 = -i q a_n a_m cosh kappa (z + d) / cosh kappa d,
    q    = f/2 (2 Omega D + Z_n + s Z_m) / (g kappa tanh kappa d - Omega^2),
    eta2 = (f/2 (sigma_n^2 + sigma_m^2 - D) - Omega q) a_n a_m / g,
    D    = g^2 k_n.k_m / (sigma_n sigma_m) - s sigma_n sigma_m,
    Z    = g^2 k^2 / sigma - sigma^3 = g^2 k^2 / (sigma cosh^2 k d),

with the conjugate of a_m for differences, and f = 1, or 1/2 for a wave with itself. It is that of
Longuet-Higgins and Stewart (J. Fluid Mech. 13, 1962, 481) and of Sharma and Dean (Soc. Petroleum
Eng. J. 21, 1981, 129), derived independently here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.base.errors import InputError
from offwind_pin.base.kernels import kernel
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.wave_field import WaveField

_STEP = 0.08
"""Spacing of the nodes of log(1 + kappa d) on which pairs are accumulated.

Each pair is distributed to six of them, by Lagrange polynomials of fifth degree."""
_NOTHING = 1e-14
"""Fraction of a pair's convective acceleration that is rounding error of its directional factor."""
_WHERE = "second-order waves"


class SecondOrderWaves(WaveField):
    """Linear waves with bound sum- and difference-frequency components of all pairs.

    Harmonics run from 0, the set-down, up to the highest sum. Pairs are accumulated on nodes of the
    wave number, which changes velocities by less than 1e-6 of the largest.

    Conventions. Elevations are measured from the still water level: the mean of a wave is its
    set-down -|a|^2 k / (2 sinh 2kd). There is no mean velocity with it: the return current belongs
    to the current of the sea. The mean is that at the axis; with waves of one frequency in
    different directions it varies in space.

    The acceleration is the total particle acceleration to second order, Du/Dt = du/dt + (u1 . grad)
    u1, as for stream function waves. Second-order terms are constant above the mean water level;
    the linear ones are completed to second order by stretching by extrapolation.

    Third order, which changes the wave length, is omitted. The theory requires second order to be
    small compared with first, and fails for steep waves and for long ones in shallow water. In
    diffraction, bound waves are treated as free waves of their frequency.

    Attributes
    ----------
    linear : LinearWaves
        The free waves.
    cutoff : float or None, rad/s
        Components above it stay linear and form no pairs.
    total_acceleration : bool
        Whether the acceleration includes the convective term.
    bound : (m,) complex array, m
        Second-order part of the elevation.
    """

    def __init__(
        self,
        linear: LinearWaves,
        *,
        cutoff: float | None = None,
        total_acceleration: bool = True,
    ) -> None:
        """The cutoff is sqrt(2 g / Hs) by default, with the significant height Hs of these waves.

        Without it the interaction of short waves with the long waves that carry them would be
        treated as bound components (Stansberg, Gudmestad and Haver, J. Offshore Mech. Arct. Eng.
        130, 2008, 021010). The set-up time is proportional to the square of the number of
        components below it, some seconds for three hours.

        Raises
        ------
        InputError
            Waves that a current carries, or no component below the cutoff.
        """
        _check(linear)
        self.linear = linear
        self.cutoff = _cutoff(linear) if cutoff is None else cutoff
        self.total_acceleration = total_acceleration
        self.period, self.depth, self.gravity = linear.period, linear.depth, linear.gravity
        taking = np.flatnonzero(linear.omega <= self.cutoff)
        if len(taking) == 0:
            allowed = f"from the slowest component up ({np.min(linear.omega):.4g} rad/s)"
            remedy = "Raise it." if cutoff is not None else "Lower the waves: they would break."
            raise InputError(f"{_WHERE}, field cutoff", self.cutoff, allowed, remedy)
        order = taking[np.argsort(linear.harmonic[taking], kind="stable")]
        number, k = linear.harmonic[order].astype(np.int64), linear.wave_number[order]
        size = 1 + int(max(2 * number[-1], np.max(linear.harmonic)))
        self.harmonic = np.arange(size, dtype=float)
        self.wave_number = np.zeros(size)
        self.wave_number[1:] = wave_number(self.omega[1:], self.depth, self.gravity)
        nodes = max(int(np.ceil(np.log1p(2 * np.max(k) * self.depth) / _STEP)) + 4, 6)
        self._node = np.expm1(_STEP * np.arange(nodes)) / self.depth
        self.bound = np.zeros(size, dtype=complex)
        self._potential = np.zeros((nodes, size, 3), dtype=complex)
        self._convected = np.zeros((nodes if total_acceleration else 0, size, 3), dtype=complex)
        _pairs(
            number,
            _columns(linear.omega[order], k, linear.direction[order], self.depth, self.gravity),
            np.asarray(linear.elevation[order], dtype=complex),
            self.depth,
            self.gravity,
            _STEP,
            self.bound,
            self._potential,
            self._convected,
        )
        self.elevation = self.bound + self._placed(linear.elevation)

    @property
    def first_order(self) -> LinearWaves:
        return self.linear

    def velocity(self, height: Array) -> ComplexArray:
        bound = -self._gradient(self._potential, height)
        bound[2] *= 1j
        return bound + self._placed(self.linear.velocity(height))

    def acceleration(self, height: Array) -> ComplexArray:
        """(3, n, m) in m/s2, total or local."""
        local = super().acceleration(height)
        if not self.total_acceleration:
            return local
        convective = self._gradient(self._convected, height)
        convective[:2] *= -1j
        return local + convective

    def _gradient(self, amplitude: ComplexArray, height: Array) -> ComplexArray:
        """(3, n, m) sums over nodes (nodes, m, 3) of cosh kappa (z + d) / cosh kappa d; sinh up."""
        z, kappa = np.minimum(height, 0.0), self._node
        grow = np.exp(np.multiply.outer(z, kappa)) / (1 + np.exp(-2 * kappa * self.depth))
        decay = np.exp(-2 * np.multiply.outer(z + self.depth, kappa))
        cosh, sinh = grow * (1 + decay), grow * (1 - decay)
        along_x, along_y, up = (amplitude[:, :, axis] for axis in range(3))
        return np.stack([cosh @ along_x, cosh @ along_y, sinh @ up])

    def _placed(self, amplitude: ComplexArray) -> ComplexArray:
        """(..., m) amplitudes by harmonic from (..., l) of the linear components."""
        result = np.zeros((*amplitude.shape[:-1], len(self.harmonic)), dtype=complex)
        np.add.at(result.T, self.linear.harmonic.astype(np.intp), amplitude.T)
        return result


def _check(linear: WaveField) -> None:
    """Reject waves to which the theory does not apply."""
    if not isinstance(linear, LinearWaves):
        received, allowed = type(linear).__name__, "LinearWaves"
        raise InputError(
            _WHERE, received, allowed, "Use stream function theory for steep regular waves."
        )
    if np.any(np.asarray(linear.carried) != 0):
        fastest = float(np.max(np.abs(linear.carried)))
        allowed = "waves on water at rest"
        remedy = "Leave out doppler, or use order 1."
        raise InputError(f"{_WHERE}, field carried", fastest, allowed, remedy)
    number = linear.harmonic
    if len(number) == 0 or np.any(number < 1) or np.any(number % 1 != 0):
        allowed = "whole numbers from 1, at least one"
        raise InputError(f"{_WHERE}, field harmonic", number, allowed, "Correct them.")
    if not np.all(np.isfinite(linear.elevation)):
        raise InputError(
            f"{_WHERE}, field elevation", "NaN or infinity", "finite numbers", "Correct them."
        )


def _cutoff(linear: LinearWaves) -> float:
    """sqrt(2 g / Hs) in rad/s, infinite without waves."""
    height = 4 * np.sqrt(np.sum(np.abs(linear.elevation) ** 2) / 2)
    return float(np.sqrt(2 * linear.gravity / height)) if height > 0 else np.inf


def _columns(sigma: Array, k: Array, direction: Array, depth: float, gravity: float) -> Array:
    """(n, 7) sigma, k, k_x, k_y, tanh k d, velocity g k / sigma at the surface, and Z of
    components."""
    e = np.exp(-2 * k * depth)
    speed = gravity * k / sigma
    # g^2 k^2 / (sigma cosh^2 k d), without overflow
    decayed = sigma * speed**2 * 4 * e / (1 + e) ** 2
    x, y = k * np.cos(direction), k * np.sin(direction)
    return np.column_stack([sigma, k, x, y, (1 - e) / (1 + e), speed, decayed])


@kernel
def _pairs(
    number: NDArray[np.int64],
    waves: Array,
    amplitude: ComplexArray,
    depth: float,
    gravity: float,
    step: float,
    elevation: ComplexArray,
    potential: ComplexArray,
    convected: ComplexArray,
) -> None:
    """Add all pairs of components (n,), in increasing order of their harmonics.

    elevation (m,) gets the amplitudes of the surface; potential (nodes, m, 3) those of i phi2, by
    node of kappa and harmonic, times K_x, K_y and kappa; convected (nodes, m, 3), unless it is
    empty, those of |grad phi1|^2 / 2 times K_x, K_y and the wave number of the profile
    """
    total = len(convected) > 0
    for n in range(len(number)):
        for m in range(n + 1):
            for s in (1, -1):
                harmonic = number[n] + s * number[m]
                both = amplitude[n] * (amplitude[m] if s == 1 else np.conj(amplitude[m]))
                both *= 0.25 if n == m else 0.5
                node = potential[:, harmonic]
                surface = _bind(s, waves[n], waves[m], both, depth, gravity, step, node)
                elevation[harmonic] += surface if harmonic > 0 else surface.real
                if total:
                    _convect(s, waves[n], waves[m], both, depth, step, convected[:, harmonic])


@kernel
def _bind(
    s: int,
    one: Array,
    two: Array,
    both: complex,
    depth: float,
    gravity: float,
    step: float,
    node: ComplexArray,
) -> complex:
    """Add the potential of a pair, with the product f/2 a_n a_m; the amplitude of its surface."""
    sigma, x, y = one[0] + s * two[0], one[2] + s * two[2], one[3] + s * two[3]
    dot = (one[2] * two[2] + one[3] * two[3]) / (one[1] * two[1]) * one[5] * two[5]
    d = dot - s * one[0] * two[0]
    raised = one[0] ** 2 + two[0] ** 2 - d
    if sigma == 0:
        # the pair drives no potential
        return raised / gravity * both
    kappa = np.sqrt(x * x + y * y)
    e = np.exp(-2 * kappa * depth)
    detuning = gravity * kappa * (1 - e) / (1 + e) - sigma * sigma
    q = (2 * sigma * d + one[6] + s * two[6]) / detuning
    _spread(node, kappa, depth, step, x, y, q * both)
    return (raised - sigma * q) / gravity * both


@kernel
def _convect(
    s: int, one: Array, two: Array, both: complex, depth: float, step: float, node: ComplexArray
) -> None:
    """Add a pair's |grad phi1|^2 / 2.

    Products of cosh and of sinh are halves of cosh of the sum plus or minus of the difference of
    wave numbers.
    """
    x, y, size = one[2] + s * two[2], one[3] + s * two[3], one[5] * two[5]
    cosine = (one[2] * two[2] + one[3] * two[3]) / (one[1] * two[1])
    tanh = one[4] * two[4]
    added = (cosine - s) * (1 + tanh) / 2
    taken = (cosine + s) * (1 - tanh) / 2
    if abs(added) > _NOTHING:
        _spread(node, one[1] + two[1], depth, step, x, y, added * size * both)
    if abs(taken) > _NOTHING:
        _spread(node, abs(one[1] - two[1]), depth, step, x, y, taken * size * both)


@kernel
def _spread(
    node: ComplexArray,
    kappa: float,
    depth: float,
    step: float,
    x: float,
    y: float,
    value: complex,
) -> None:
    """Add a value times x, y and kappa to (nodes, 3), so that they interpolate at kappa."""
    place = np.log1p(kappa * depth) / step
    first = min(max(int(place) - 2, 0), len(node) - 6)
    a = place - first
    b, c, d, e, f = a - 1, a - 2, a - 3, a - 4, a - 5
    ab, cd, ef = a * b, c * d, e * f
    share = (
        -b * cd * ef / 120,
        a * cd * ef / 24,
        -ab * d * ef / 12,
        ab * c * ef / 12,
        -ab * cd * f / 24,
        ab * cd * e / 120,
    )
    for j in range(6):
        part = share[j] * value
        node[first + j, 0] += x * part
        node[first + j, 1] += y * part
        node[first + j, 2] += kappa * part
