"""Meshcat pages, stills and frames."""
