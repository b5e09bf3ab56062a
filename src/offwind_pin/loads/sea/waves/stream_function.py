"""A steady wave of finite height (stream function wave) as harmonics at the structure's axis."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.fourier_wave import SteadyWave, depth_functions
from offwind_pin.loads.sea.waves.wave_field import WaveField


class StreamFunctionWaves(WaveField):
    """A :class:`SteadyWave` that passes x = y = 0 with a crest at ``crest_time``.

    The velocity excludes the mean Eulerian velocity of the solution, which belongs to the current
    that carries the wave. The acceleration is the total particle acceleration Du/Dt; its products
    of N harmonics have 2 N, so the field has harmonics 0 ... 2 N.

    Parameters
    ----------
    direction : float, rad
        Towards which the wave travels, from +x towards +y.
    crest_time : float, s
    total_acceleration : bool
        Whether the acceleration includes the convective term.
    """

    exact_surface = True

    def __init__(
        self,
        wave: SteadyWave,
        *,
        direction: float = 0.0,
        crest_time: float = 0.0,
        total_acceleration: bool = True,
    ) -> None:
        self.wave = wave
        self.direction = direction
        self.total_acceleration = total_acceleration
        self.period = wave.period
        self.depth = wave.depth
        self.gravity = wave.gravity
        self.harmonic = np.arange(2 * wave.order + 1, dtype=float)
        self._shift = np.exp(-1j * self.omega * crest_time)
        self.elevation = self._from_cosines(np.concatenate([[0.0], wave.surface])[None])[0]
        self.wave_number = np.zeros(len(self.harmonic))
        self.wave_number[1:] = wave_number(self.omega[1:], wave.depth, wave.gravity)

    def velocity(self, height: Array) -> ComplexArray:
        along, up = self._amplitudes(height)
        along[:, 0] = 0.0
        return self._turned(self._from_cosines(along), 1j * self._from_cosines(up))

    def acceleration(self, height: Array) -> ComplexArray:
        if not self.total_acceleration:
            return super().acceleration(height)
        along, up = self._amplitudes(height)
        order = self.wave.order
        # more points than harmonics of the products make the transform exact
        angle = 2 * np.pi * np.arange(4 * order + 2) / (4 * order + 2)
        j = np.arange(order + 1)
        cos, sin = np.cos(np.outer(j, angle)), np.sin(np.outer(j, angle))
        number = j * self.wave.wave_number
        # in the frame of the crest the motion is steady: D/Dt = u d/dx + w d/dz, with u_x = -w_z
        u, w = along @ cos, up @ sin
        u_by_x, u_by_z = -(number * along) @ sin, (number * up) @ cos
        w_by_x, w_by_z = u_by_z, -u_by_x
        return self._turned(
            self._from_points(u * u_by_x + w * u_by_z), self._from_points(u * w_by_x + w * w_by_z)
        )

    def _amplitudes(self, height: Array) -> tuple[Array, Array]:
        """(n, N + 1) of cos j k x along the wave, of sin j k x upwards, in the frame of the
        crest."""
        height = np.asarray(height, dtype=float)
        number = np.arange(1.0, self.wave.order + 1) * float(self.wave.wave_number)
        cosh, sinh = depth_functions(number, height[:, None], self.wave.depth)
        along = np.empty((len(height), self.wave.order + 1))
        up = np.zeros_like(along)
        along[:, 0] = -self.wave.mean_speed
        along[:, 1:] = number * self.wave.stream * cosh
        up[:, 1:] = number * self.wave.stream * sinh
        return along, up

    def _from_cosines(self, amplitude: Array) -> ComplexArray:
        """(n, m) from amplitudes of cos j k x; at x = 0, k x is -omega t in the frame of the
        crest."""
        result = np.zeros((len(amplitude), len(self.harmonic)), dtype=complex)
        result[:, : amplitude.shape[1]] = amplitude
        return result * self._shift

    def _from_points(self, value: Array) -> ComplexArray:
        """(n, m) from values over one wave, at equal steps of k x from the crest."""
        amplitude = np.fft.rfft(value, axis=1)[:, : len(self.harmonic)] * (2 / value.shape[1])
        amplitude[:, 0] /= 2
        return np.conj(amplitude) * self._shift

    def _turned(self, along: ComplexArray, up: ComplexArray) -> ComplexArray:
        return np.stack([np.cos(self.direction) * along, np.sin(self.direction) * along, up])
