"""Foundations by name, equivalent foundations, pushover, condensation."""
