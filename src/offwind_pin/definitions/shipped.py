"""Turbines that come with the package."""

from __future__ import annotations

from importlib import resources


def shipped_turbines() -> list[str]:
    """Names of the turbines that come with the package.

    Returns
    -------
    list of str
    """
    library = resources.files("offwind_pin.definitions") / "library"
    return sorted(
        entry.name.removesuffix(".yaml")
        for entry in library.iterdir()
        if entry.name.endswith(".yaml")
    )
