"""
Modes of the OC6 monopile
=========================

Natural frequencies of the whole structure about its static state on three foundations, and the
shapes of the first two fore-aft modes. The foundations differ most in the second mode: its antinode
is halfway up the tower, and the soil determines how far the pile below the water moves with it.
"""

import matplotlib.pyplot as plt

import offwind_pin as ow
from offwind_pin.display.figures.style import PALETTE, mark_levels, styled

FOUNDATIONS = ("clamped", "coupled_springs", "distributed_springs")


@styled
def main() -> dict[str, float]:
    """Frequencies in Hz by foundation and mode."""
    turbine = ow.load_turbine("oc6_phase2")
    _, panes = plt.subplots(1, 2, figsize=(7.2, 4.5), sharey=True)
    found = {}
    for foundation, color in zip(FOUNDATIONS, PALETTE, strict=False):
        system = ow.build(turbine, foundation, ow.StillWater())
        modes = ow.modes(system, n=8)
        for label, axes in zip(("FA1", "FA2"), panes, strict=True):
            i = modes.index(label)
            found[f"{foundation} {label}"] = float(modes.frequency_hz[i])
            name = f"{foundation}, {modes.frequency_hz[i]:.3f} Hz".replace("_", " ")
            axes.plot(modes.shape[i, :, 0], modes.height, color=color, label=name)
    for label, axes in zip(("FA1", "FA2"), panes, strict=True):
        axes.set(title=label, xlabel="displacement over its peak")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14))
        mark_levels(axes, turbine.site.mudline, water=True)
    panes[0].set_ylabel("height above still water, m")
    return found


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.4f} Hz")
