"""
Shear deformation of a monopile
===============================

The same structure with elements that only bend (Euler-Bernoulli) and with elements that also shear
(Timoshenko). A pile of 9 m diameter with 45 m embedment is short enough for shear to affect its
modes.
"""

import matplotlib.pyplot as plt
import numpy as np

import offwind_pin as ow
from offwind_pin.display.figures.style import BLUE, VERMILLION, styled

MODES = ("FA1", "SS1", "FA2", "SS2")


@styled
def main() -> dict[str, float]:
    """Change of frequencies due to shear in percent, clamped and on the soil."""
    turbine = ow.load_turbine("oc6_phase2")
    _, axes = plt.subplots(figsize=(6.4, 3.2))
    found: dict[str, float] = {}
    for k, foundation in enumerate(("clamped", "distributed_springs")):
        by_element = []
        for element in ("euler_bernoulli", "timoshenko"):
            modes = ow.modes(ow.build(turbine, foundation, ow.StillWater(), element=element))
            by_element.append([modes.frequency_hz[modes.index(label)] for label in MODES])
        change = 100 * (np.array(by_element[1]) / np.array(by_element[0]) - 1)
        place = np.arange(len(MODES)) + 0.4 * k - 0.2
        name = foundation.replace("_", " ")
        bars = axes.bar(place, change, 0.38, color=(BLUE, VERMILLION)[k], label=name)
        axes.bar_label(bars, fmt="%.2f", padding=2)
        found |= {f"{name}, {label}, %": float(c) for label, c in zip(MODES, change, strict=True)}
    axes.set_xticks(range(len(MODES)), MODES)
    axes.axhline(0, color="0.4", lw=0.8)
    axes.margins(y=0.15)
    axes.set(ylabel="change of frequency, %", title="Shear in the OC6 monopile")
    axes.legend(loc="lower left")
    return found


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.3f}")
