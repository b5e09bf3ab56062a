"""Seas: water at rest or in waves, spectra, currents."""

from offwind_pin.loads.sea.current import (
    Current,
    CurrentSum,
    CurrentTable,
    PowerLawCurrent,
    SurfaceCurrent,
    UniformCurrent,
)
from offwind_pin.loads.sea.irregular_waves import Crest, IrregularWaves
from offwind_pin.loads.sea.measured_waves import MeasuredWaves
from offwind_pin.loads.sea.sea import LinearSea, RegularWaves, Sea, StillWater, StreamWaves
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.spectra import (
    JonswapSpectrum,
    TableSpectrum,
    TmaSpectrum,
    WaveSpectrum,
    WhiteNoise,
)
from offwind_pin.loads.sea.waves.spreading import Spreading
from offwind_pin.loads.sea.waves.surface_record import SurfaceRecord
from offwind_pin.loads.sea.waves.wave_field import WaveField

__all__ = [
    "Crest",
    "Current",
    "CurrentSum",
    "CurrentTable",
    "IrregularWaves",
    "JonswapSpectrum",
    "LinearSea",
    "LinearWaves",
    "MeasuredWaves",
    "PowerLawCurrent",
    "RegularWaves",
    "Sea",
    "Spreading",
    "StillWater",
    "StreamWaves",
    "SurfaceCurrent",
    "SurfaceRecord",
    "TableSpectrum",
    "TmaSpectrum",
    "UniformCurrent",
    "WaveField",
    "WaveSpectrum",
    "WhiteNoise",
]
