"""Names of the foundations, for help and completion without importing the foundations."""

from __future__ import annotations

FOUNDATION_NAMES = (
    "clamped",
    "apparent_fixity",
    "coupled_springs",
    "distributed_springs",
    "macro_element",
)
