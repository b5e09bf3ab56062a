"""Prescribed loads at the tower top."""
