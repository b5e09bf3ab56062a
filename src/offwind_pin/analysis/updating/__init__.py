"""Fitting soil parameters to measurements."""
