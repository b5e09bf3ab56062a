"""What a report of a case is made from."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import xarray as xr

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.settling import Settling
from offwind_pin.analysis.static import StaticResult
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.description import EarthquakeDescription
from offwind_pin.loads.wind.synthetic_thrust import RotorOperation, SyntheticWind
from offwind_pin.results.reading import analysed as without_ramp
from offwind_pin.signal.modal_identification.identify import IdentifiedModes
from offwind_pin.signal.moment_spectrum import MomentSpectrum


@dataclass(frozen=True)
class Published:
    """A published number and ours.

    Attributes
    ----------
    quantity : in plain words
    value, unit : published; the unit is empty for a pure number
    source : where it is printed
    ours : the same quantity from this case, or None where it was not computed
    mode : label of the mode whose frequency it is, for the table of modes; a quantity in Hz named
        like a mode ("FA1" or "first fore-aft") is put there without it
    """

    quantity: str
    value: float
    unit: str
    source: str
    ours: float | None = None
    mode: str | None = None


@dataclass(frozen=True)
class WindDescription:
    """The generator of a synthetic wind load, and the rotor's steady state that it starts from."""

    generator: SyntheticWind
    rotor: RotorOperation


@dataclass(frozen=True)
class CaseReport:
    """Everything a report shows; what is None or empty leaves its section out.

    Attributes
    ----------
    name, title, description : of the case
    system : what was solved
    summary : what goes into ``summary.json``; ``wall_s``, ``simulated_s``, ``realtime_factor`` and
        ``status`` are shown among the solver's account
    modes : of the system
    statics : by name of the foundation; others are compared with the clamped one, or the first
    histories : from :func:`offwind_pin.simulate`
    published : numbers to compare with
    wind : how the tower-top load was made, where it is synthetic
    psd : of the fore-aft moment at the mudline
    rotor : name and value of what is to be told of a rotor that runs, or nothing
    earthquake : that moves the ground, or None
    identified : modes out of accelerations, or None
    settling : the static state reached in time, or None
    """

    name: str
    title: str
    description: str
    system: System
    summary: dict[str, Any]
    modes: ModalResult | None = None
    statics: dict[str, StaticResult] = field(default_factory=dict)
    histories: xr.Dataset | None = None
    published: tuple[Published, ...] = ()
    wind: WindDescription | None = None
    psd: MomentSpectrum | None = None
    rotor: tuple[tuple[str, str], ...] = ()
    earthquake: EarthquakeDescription | None = None
    identified: IdentifiedModes | None = None
    settling: Settling | None = None

    @property
    def analysed(self) -> xr.Dataset | None:
        """The histories after the ramp, or None where fewer than two samples are left."""
        if self.histories is None:
            return None
        rest = without_ramp(self.histories)
        return rest if rest.sizes["time"] > 1 else None
