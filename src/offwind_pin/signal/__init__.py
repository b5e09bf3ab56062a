"""Spectra and response spectra."""
