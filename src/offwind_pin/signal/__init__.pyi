"""Modal identification from measured or simulated signals."""

from offwind_pin.signal.modal_identification.accelerations import Accelerations, read_accelerations
from offwind_pin.signal.modal_identification.cross_spectra import (
    CrossSpectra,
    cross_spectral_matrix,
)
from offwind_pin.signal.modal_identification.free_decay import FreeDecay, free_decay
from offwind_pin.signal.modal_identification.identify import OperationalModes, operational_modes
from offwind_pin.signal.modal_identification.modal_assurance import modal_assurance

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
