"""Ground motions for tests, all of them made."""

import numpy as np
from numpy.typing import NDArray

import offwind_pin as ow

Array = NDArray[np.float64]


def shaking(
    duration: float = 12.0,
    step: float = 0.01,
    seed: int = 1,
    peak: tuple[float, float, float] = (3.0, 2.0, 1.0),
    band: tuple[float, float] = (0.3, 6.0),
) -> ow.GroundMotion:
    """Noise in a band of frequencies in Hz under an envelope, of given peaks in m/s2.

    It is the derivative of an enveloped velocity: acceleration and velocity begin and end at zero.
    """
    rng = np.random.default_rng(seed)
    time = step * np.arange(round(duration / step) + 1)
    rate = 2 * np.pi * np.linspace(*band, 60)[:, None]
    angle = rate * time + rng.uniform(0, 2 * np.pi, (3, len(rate), 1))
    turn = np.pi / time[-1]
    envelope, its_rate = np.sin(turn * time) ** 2, turn * np.sin(2 * turn * time)
    velocity, slope = (np.sin(angle) / rate).sum(axis=1), np.cos(angle).sum(axis=1)
    record = envelope * slope + its_rate * velocity
    record *= np.array(peak)[:, None] / np.max(np.abs(record), axis=1)[:, None]
    return ow.GroundMotion(time, record.T)


def by_depth(system: ow.System, levels: int = 3, seed: int = 4) -> ow.GroundMotion:
    """Another motion at each of several levels from below the base to above the mudline."""
    low, high = system.chain.base - 3.0, system.turbine.site.mudline + 2.0
    parts = [shaking(6.0, 0.05, seed + k) for k in range(levels)]
    acceleration = np.array([part.acceleration for part in parts])
    return ow.GroundMotion(parts[0].time, acceleration, np.linspace(low, high, levels))
