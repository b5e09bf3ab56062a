"""Soil reaction curves, one file per family."""
