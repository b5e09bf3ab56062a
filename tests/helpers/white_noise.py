"""Systems of springs and masses under white noise, sampled exactly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import linalg
from scipy.signal import lfilter

from offwind_pin.base.definition import Array


@dataclass(frozen=True, eq=False)
class ModalSystem:
    """Modes frequency_hz (m,), damping_ratio (m,), shape (m, c) of unit modal mass."""

    frequency_hz: Array
    damping_ratio: Array
    shape: Array

    def accelerations(self, force: Array, dt: float, count: int, seed: int) -> Array:
        """(count, c) stationary accelerations (m/s2) under independent white forces.

        Over each step the displacement, velocity and momentum that the noise leaves in a mode are
        Gaussian with the covariance of Van Loan (1978): nothing is discretised. White noise gives no
        finite acceleration, so what is returned is its mean over a step, the change of the velocity
        over dt, in which only the mean of the noise over that step appears.

        force : (m, k) of k independent white noises of unit two-sided density on the modes
        """
        modes = len(self.frequency_hz)
        omega = 2 * np.pi * self.frequency_hz
        a = np.zeros((2 * modes, 2 * modes))
        a[:modes, modes:] = np.eye(modes)
        a[modes:, :modes] = -np.diag(omega**2)
        a[modes:, modes:] = -np.diag(2 * self.damping_ratio * omega)
        b = np.vstack([np.zeros_like(force), force])
        block = np.zeros((4 * modes, 4 * modes))
        block[: 2 * modes, : 2 * modes] = -a
        block[: 2 * modes, 2 * modes :] = b @ b.T
        block[2 * modes :, 2 * modes :] = a.T
        grown = linalg.expm(block * dt)
        step = grown[2 * modes :, 2 * modes :].T
        covariance = step @ grown[: 2 * modes, 2 * modes :]
        stationary = linalg.solve_continuous_lyapunov(a, -b @ b.T)
        draw = np.random.default_rng(seed)
        start = _root(stationary) @ draw.standard_normal(2 * modes)
        noise = draw.standard_normal((count, 2 * modes)) @ _root(covariance).T
        velocity = np.empty((count + 1, modes))
        for i in range(modes):
            # Each mode is two numbers x, v by their own 2x2 step, noise coupled through covariance.
            own = step[np.ix_([i, modes + i], [i, modes + i])]
            trace, determinant = np.trace(own), np.linalg.det(own)
            # v[n+1] - trace v[n] + det v[n-1] = w2[n] - own11 w2[n-1] + own21 w1[n-1]
            w1, w2 = noise[:, i], noise[:, modes + i]
            x, v = start[i], start[modes + i]
            drive = w2.copy()
            drive[1:] += own[1, 0] * w1[:-1] - own[0, 0] * w2[:-1]
            first = own[1, 0] * x + own[1, 1] * v + w2[0]
            velocity[0, i], velocity[1, i] = v, first
            state = np.array([trace * first - determinant * v, -determinant * first])
            velocity[2:, i], _ = lfilter([1.0], [1.0, -trace, determinant], drive[1:], zi=state)
        return np.diff(velocity, axis=0) / dt @ self.shape


def _root(covariance: Array) -> Array:
    """A square root of a covariance that may be singular."""
    values, vectors = np.linalg.eigh((covariance + covariance.T) / 2)
    return vectors * np.sqrt(np.maximum(values, 0.0))


def three_modes() -> ModalSystem:
    """Three modes at five sensors over a height, with shapes that are not normal to each other."""
    height = np.linspace(0.2, 1.0, 5)
    return ModalSystem(
        frequency_hz=np.array([0.8, 2.1, 4.4]),
        damping_ratio=np.array([0.015, 0.01, 0.02]),
        shape=np.array(
            [height**2, np.sin(1.3 * np.pi * height), np.sin(2.2 * np.pi * height) + 0.1]
        ),
    )


THREE_FORCES = np.array([[1.0, 0.3, 0.2], [0.4, 2.0, 0.5], [0.3, -0.6, 3.0]])
"""Three white noises on the three modes."""
