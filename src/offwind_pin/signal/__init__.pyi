"""Modal identification from measured or simulated signals."""

from offwind_pin.signal.operational_modes.accelerations import Accelerations, read_accelerations
from offwind_pin.signal.operational_modes.cross_spectra import CrossSpectra, cross_spectral_matrix
from offwind_pin.signal.operational_modes.free_decay import FreeDecay, free_decay
from offwind_pin.signal.operational_modes.identify import OperationalModes, operational_modes
from offwind_pin.signal.operational_modes.modal_assurance import modal_assurance

__all__ = [
    "Accelerations",
    "CrossSpectra",
    "FreeDecay",
    "OperationalModes",
    "cross_spectral_matrix",
    "free_decay",
    "modal_assurance",
    "operational_modes",
    "read_accelerations",
]
