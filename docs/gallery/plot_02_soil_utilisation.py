"""
Soil utilisation under load
===========================

A storm thrust and its moment applied to the structure on distributed springs: the displacement of
each node, the fraction of the ultimate soil resistance that is mobilised, and the position of the
load on the pushover curve of the pile.
"""

import matplotlib.pyplot as plt
import numpy as np

import offwind_pin as ow
from offwind_pin.display.figures.style import BLUE, VERMILLION, styled

LOAD = np.array([3.0e6, 0, 0, 0, 9.0e6, 0])  # at the yaw bearing, N and N m


@styled
def main() -> dict[str, float]:
    """Mudline displacement in m, largest utilisation, and pushover loads in MN."""
    soil = ow.soil_overview(ow.load_turbine("oc6_phase2"), load=LOAD)
    state, push = soil.state, soil.pushover
    if state is None:
        raise ValueError("the overview has a state where a load is given")
    _, (left, middle, right) = plt.subplots(1, 3, figsize=(9.0, 3.8))
    left.plot(1e3 * state.displacement, -soil.depth, color=BLUE)
    left.set(title="Nodes", xlabel="displacement, mm", ylabel="height above mudline, m")
    middle.plot(100 * state.utilisation, -soil.depth, color=VERMILLION)
    middle.set(title="Utilisation", xlabel="p over ultimate, %")
    right.plot(push.displacement, push.load / 1e6, color=BLUE)
    stiffness = (push.load[1] - push.load[0]) / push.displacement[1]
    right.plot(state.displacement[0], LOAD[0] / 1e6, "o", color=VERMILLION, label="this load")
    right.set(title="Pushover", xlabel="mudline displacement, m", ylabel="horizontal load, MN")
    right.legend()
    return {
        "displacement of the mudline, m": float(state.displacement[0]),
        "largest utilisation": float(np.nanmax(state.utilisation)),
        "load at a tenth of the diameter, MN": float(push.load[-1] / 1e6),
        "secant stiffness of the first step, MN/m": float(stiffness / 1e6),
    }


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.4g}")
