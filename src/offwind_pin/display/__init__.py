"""Figures, reports and viewers of results."""
