"""Small second-order systems r(t, q, v, a) = 0 with known motion."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Oscillator:
    """m a + c v + k q = p cos(w t), one degree of freedom."""

    mass_: float = 2.0
    damping: float = 0.4
    stiffness: float = 8.0
    load: float = 3.0
    omega: float = 1.3

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        applied = self.load * np.cos(self.omega * time)
        return self.mass_ * a + self.damping * v + self.stiffness * q - applied

    def mass(self, q: Array) -> Array:
        return np.array([[self.mass_]])

    def tangents(self, time: float, q: Array, v: Array) -> tuple[Array, Array]:
        return np.array([[self.stiffness]]), np.array([[self.damping]])

    def exact(self, time: Array, q: float, v: float) -> tuple[Array, Array, Array]:
        """Displacement, velocity and acceleration from a start (q, v)."""
        m, c, k = self.mass_, self.damping, self.stiffness
        steady = self.load / (k - m * self.omega**2 + 1j * c * self.omega)
        root = (-c + np.sqrt(complex(c**2 - 4 * m * k))) / (2 * m)
        # q(t) = Re(free exp(root t) + steady exp(i w t))
        real = q - steady.real
        rate = v - (1j * self.omega * steady).real
        free = real - 1j * (rate - root.real * real) / root.imag
        parts = [(free, root), (steady, 1j * self.omega)]
        value = [sum((z * s**n * np.exp(s * time)).real for z, s in parts) for n in range(3)]
        return value[0], value[1], value[2]


class ElasticPendulum:
    """A mass on a spring that swings: stretch r and angle theta, mass matrix diag(1, r^2)."""

    gravity, stiffness, rest = 9.81, 40.0, 1.0

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        (r, angle), (stretching, turning) = q, v
        return np.array(
            [
                a[0]
                - r * turning**2
                - self.gravity * np.cos(angle)
                + self.stiffness * (r - self.rest),
                r**2 * a[1] + 2 * r * stretching * turning + self.gravity * r * np.sin(angle),
            ]
        )

    def mass(self, q: Array) -> Array:
        return np.diag([1.0, q[0] ** 2])

    def tangents(self, time: float, q: Array, v: Array) -> tuple[Array, Array]:
        """Without the terms that depend on velocity: an iteration matrix may be approximate."""
        r, angle = q
        g = self.gravity
        stiffness = np.array(
            [[self.stiffness, g * np.sin(angle)], [g * np.sin(angle), g * r * np.cos(angle)]]
        )
        return stiffness, np.zeros((2, 2))

    def energy(self, q: Array, v: Array) -> float:
        r, angle = q
        kinetic = (v[0] ** 2 + (r * v[1]) ** 2) / 2
        return float(
            kinetic - self.gravity * r * np.cos(angle) + self.stiffness * (r - self.rest) ** 2 / 2
        )
