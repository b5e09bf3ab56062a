"""Rows of modes, statics and damping for ``summary.json`` and standard output."""

from __future__ import annotations

import math
from typing import Any

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.mode_labels import DAMPING_PARTS
from offwind_pin.dynamics.system import System


def summarise_modes(result: ModalResult) -> list[dict[str, Any]]:
    """One row for each mode, as in ``offwind modes --json``."""
    return [
        {
            "label": label,
            "frequency_hz": float(result.frequency_hz[i]),
            "damping_ratio": float(result.damping_ratio[i]),
            "damping_ratio_asked": _or_none(float(result.damping_asked[i])),
            **{
                f"damping_ratio_{name}": float(result.damping_parts[i, j])
                for j, name in enumerate(DAMPING_PARTS)
            },
            "shape_peak_height_ratio": float(result.shape_peak_height_ratio[i]),
        }
        for i, label in enumerate(result.label)
    ]


def _or_none(value: float) -> float | None:
    return None if math.isnan(value) else value


def summarise_damping(system: System) -> dict[str, Any]:
    """Structural damping as requested, and as achieved on the system that the ratios refer to."""
    asked = system.turbine.structural_damping
    if asked is None:
        return {"kind": None, "asked": {}, "achieved": {}, "cautions": []}
    return {
        "kind": asked.kind,
        "asked": dict(asked.ratios or {}),
        "achieved": system.damping_ratios,
        "cautions": list(system.damping_cautions),
    }


def summarise_static(state: StaticResult) -> dict[str, Any]:
    """As in ``offwind static --json``."""
    return {
        "tower_top_x_m": float(state.tower_top_displacement[0]),
        "tower_top_z_m": float(state.tower_top_displacement[2]),
        "tower_top_rotation_y_rad": float(state.tower_top_rotation[1]),
        "mudline_displacement_x_m": float(state.mudline_displacement[0]),
        "mudline_moment_y_Nm": float(state.mudline_load[4]),
        "iterations": state.iterations,
        "residual": state.residual,
    }
