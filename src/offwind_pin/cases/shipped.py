"""Load cases that come with the package."""

from __future__ import annotations

from importlib import resources


def shipped_cases() -> list[str]:
    """Names of the cases that come with the package."""
    folder = resources.files("offwind_pin.cases") / "oc6_phase2"
    names = [entry.name for entry in folder.iterdir() if entry.name.endswith(".yaml")]
    return sorted(f"oc6-{name.removesuffix('.yaml')}" for name in names)
