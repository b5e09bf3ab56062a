"""A simulation that another process can be asked for."""

import numpy as np
import xarray as xr

import offwind_pin as ow
from offwind_pin.definitions.engine import Engine

ENGINES: tuple[Engine, ...] = ("compiled", "pinocchio")
DURATION: dict[Engine, float] = {"compiled": 20.0, "pinocchio": 1.0}
"""s; long enough for two of them to overlap."""


def move(system: ow.System, engine: Engine, size: float) -> xr.Dataset:
    """Histories under a push that takes the soil past its first yielding."""
    duration = DURATION[engine]
    time = np.linspace(0.0, duration, 201)
    push = np.outer(size * np.sin(np.pi * time / duration) ** 2, [3e6, 6e5, 0, 0, 2e7, 1e6])
    return ow.simulate(
        system,
        duration,
        0.05,
        [ow.LoadHistory(time, push, "push")],
        ramp=0.5,
        save_at=ow.SaveAt(heights=[0.0, 80.0]),
        engine=engine,
    )
