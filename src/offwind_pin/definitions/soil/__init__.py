"""Soil as a user describes it: layers, springs, PISA parameters, plausible ranges."""
