"""Labels of modes: FA1, SS2, T1, V1, TMD1."""

from __future__ import annotations

import re

FAMILIES = {"FA": "fore-aft", "SS": "side-side", "T": "torsion", "V": "vertical"}

DAMPING_PARTS = ("structural", "soil", "water", "other")
"""What contributes to the damping of a mode; other: loads and tuned mass dampers."""

_DAMPERS = {"TMD": "tuned mass damper"}


_ORDINALS = {1: "first", 2: "second", 3: "third", 4: "fourth", 5: "fifth", 6: "sixth"}


def mode_family(label: str) -> str:
    """Family of a label: FA, SS, T, V or TMD."""
    return label.rstrip("0123456789")


def mode_name(label: str) -> str:
    """Description of a label: ``FA2`` is "second fore-aft"."""
    family = mode_family(label)
    order = int(label.removeprefix(family))
    return f"{_ORDINALS.get(order, f'{order}th')} {(FAMILIES | _DAMPERS)[family]}"


def is_mode(name: str) -> bool:
    """Whether a name is a mode's label."""
    return re.fullmatch(rf"({'|'.join((*FAMILIES, 'TMD'))})[1-9]\d*", name) is not None
