"""OC6 Phase II, LC 5.1 through the public functions: its system and tower-top load."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import measuring  # noqa: F401  (first: one BLAS thread)
import xarray as xr

import offwind_pin as ow
from offwind_pin.cases.case import (
    TransientAnalysis,
    load_case,
)
from offwind_pin.definitions.turbine import RotorNacelleRNA

NAME = "oc6-lc5.1"


@dataclass(frozen=True, eq=False)
class OperationalCase:
    """What ``simulate`` needs; durations and steps in s."""

    system: ow.System
    load: ow.LoadHistory
    duration: float
    ramp: float
    dt: float
    output_dt: float

    def simulate(self, **settings: Any) -> xr.Dataset:
        """The time history, with further settings of :func:`offwind_pin.simulate`."""
        return ow.simulate(
            self.system,
            self.duration,
            self.dt,
            [self.load],
            ramp=self.ramp,
            save_at=ow.SaveAt(self.output_dt),
            **settings,
        )


def operational_case(
    duration: float | None = None, *, seed: int = 1, elements: int | None = None
) -> OperationalCase:
    """The shipped case; with a duration in s, a seed or a number of elements of one's own.

    Waves and wind repeat after the duration, or 600 s where that is longer.
    """
    case = load_case(NAME)
    turbine = case.turbine
    sea, wind, analysis = case.sea, case.tower_top_load, case.analysis
    if not (
        isinstance(sea, ow.IrregularWaves)
        and isinstance(wind, ow.SyntheticWind)
        and isinstance(analysis, TransientAnalysis)
        and isinstance(turbine.rna, RotorNacelleRNA)
    ):
        raise TypeError(f"{NAME} is no longer a case in waves and synthetic wind")
    whole = analysis.duration if duration is None else duration
    ramp = min(analysis.ramp, whole / 4)
    waves = sea.completed(seed, whole)
    load = wind.completed(seed).generate(
        turbine.rna, duration=whole, repeat_period=max(whole - ramp, 540.0)
    )
    system = ow.build(turbine, case.foundation, waves, elements=elements)
    return OperationalCase(system, load, whole, ramp, analysis.dt, analysis.output_dt)
