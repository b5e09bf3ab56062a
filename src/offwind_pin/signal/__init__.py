"""Signals: cross-spectra, operational modal analysis, free decays, modal assurance."""

from offwind_pin.base.public_names import public_names

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
