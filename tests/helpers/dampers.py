"""Turbines with tuned mass dampers."""

from typing import Any

import offwind_pin as ow
from offwind_pin.definitions.tuned_mass_damper import TunedMassDamper


def damper(name: str, z: float, direction: str, mass: float = 2e5, **keys: Any) -> TunedMassDamper:
    """A damper, by default of 0.25 Hz and a tenth of critical."""
    tuning = keys or {"frequency_hz": 0.25, "damping_ratio": 0.1}
    return TunedMassDamper.model_validate(
        {"name": name, "z_m": z, "mass_kg": mass, "direction": direction, **tuning}
    )


def with_dampers(turbine: ow.Turbine, *dampers: TunedMassDamper) -> ow.Turbine:
    """A copy that carries dampers, validated."""
    copy = turbine.model_copy(update={"tuned_mass_dampers": dampers})
    return ow.Turbine.model_validate(dict(copy))


def several(turbine: ow.Turbine) -> ow.Turbine:
    """Dampers at the yaw bearing, at 20 m two in one body, and at the mudline, listed upwards."""
    return with_dampers(
        turbine,
        damper("deep", turbine.site.mudline, "fore_aft", frequency_hz=0.6, damping_ratio=0.0),
        damper("middle", 20.0, "side_side"),
        damper("guide", 20.0, "both", 3e5, stiffness_n_per_m=8e5, damping_n_s_per_m=2e4),
        damper("nacelle", turbine.yaw_bearing, "both"),
    )
