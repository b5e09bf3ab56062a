"""
Thrust curve and aerodynamic damping
====================================

A running rotor damps the tower, because motion into the wind increases the thrust. The damping
depends on how fast the controller follows. With constant rotor speed and pitch the ratio is
positive at all wind speeds; along the steady thrust curve it is negative above rated.
"""

import matplotlib.pyplot as plt
import numpy as np

import offwind_pin as ow
from offwind_pin.display.figures.style import BLUE, GREEN, VERMILLION, styled
from offwind_pin.loads.wind.rotor_thrust import Control

WINDS = np.arange(4.0, 25.0, 1.0)
CONTROLS: tuple[Control, ...] = ("lagged", "instant")


@styled
def main() -> dict[str, float]:
    """Largest thrust in MN, its wind speed in m/s, and damping ratios of FA1."""
    turbine = ow.load_turbine("oc6_phase2")
    system = ow.build(turbine, "clamped", elements=24)
    thrust = ow.thrust_curve(turbine, WINDS) / 1e6
    _, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.4))
    left.plot(WINDS, thrust, color=BLUE)
    left.set(title="Steady thrust", xlabel="wind at the hub, m/s", ylabel="MN")
    found = {"largest thrust, MN": float(thrust.max()), "at, m/s": float(WINDS[thrust.argmax()])}
    for control, color in zip(CONTROLS, (GREEN, VERMILLION), strict=True):
        ratio = []
        for wind in WINDS:
            damping = ow.aerodynamic_damping(system, wind, control, count=4)
            ratio.append(damping.ratio[damping.label.index("FA1")])
        right.plot(WINDS, 100 * np.array(ratio), color=color, label=control)
        for wind in (9.0, 14.0):
            found[f"{control}, {wind:g} m/s"] = float(ratio[int(wind - WINDS[0])])
    right.axhline(0, color="0.4", lw=0.8)
    right.set(title="Damping of FA1", xlabel="wind at the hub, m/s", ylabel="% of critical")
    right.legend()
    return found


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.4g}")
