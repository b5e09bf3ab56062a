"""Operational modal analysis."""
