"""An earthquake's figures: response spectrum, intensities, modal periods."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from offwind_pin.base.definition import Array
from offwind_pin.signal.response_spectrum import ResponseSpectrum


@dataclass(frozen=True, eq=False)
class EarthquakeDescription:
    """What a report shows of an earthquake.

    Attributes
    ----------
    time, acceleration : (n,) in s, (n, 3) in m/s2
    spectrum : of the three components
    periods : of the structure's modes in s, by label
    facts : name and value of what else is to be told
    """

    time: Array
    acceleration: Array
    spectrum: ResponseSpectrum
    periods: Mapping[str, float]
    facts: tuple[tuple[str, str], ...] = ()
