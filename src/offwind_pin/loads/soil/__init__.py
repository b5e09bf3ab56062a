"""Foundations, macro-element, soil profile."""
