"""
Envelope of section loads
=========================

Maximum and minimum fore-aft moment and shear force at every height of tower and pile, in a run with
waves and a prescribed tower-top load. Below the mudline the moment continues to grow until the soil
has taken up the shear force.
"""

import matplotlib.pyplot as plt
import numpy as np

import offwind_pin as ow
from offwind_pin.display.figures.style import BLUE, mark_levels, styled

RAMP, DURATION = 20.0, 100.0


def load() -> ow.LoadHistory:
    """A thrust oscillating about a mean at 0.1 Hz."""
    time = np.arange(0.0, DURATION + 0.5, 0.5)
    thrust = 1.1e6 + 2.0e5 * np.sin(2 * np.pi * 0.1 * time)
    six = np.zeros((len(time), 6))
    six[:, 0], six[:, 4] = thrust, 3.0 * thrust
    return ow.LoadHistory(time, six, origin="an example's own")


@styled
def main() -> dict[str, float]:
    """Extremes in MN and MN m, and the depth of the largest moment in m."""
    turbine = ow.load_turbine("oc6_phase2")
    sea = ow.IrregularWaves(3.0, 9.0, seed=2, repeat_period=DURATION)
    system = ow.build(turbine, "distributed_springs", sea)
    history = ow.simulate(system, DURATION, 0.05, [load()], ramp=RAMP, save_at=ow.SaveAt(0.1))
    kept = history.sel(time=slice(RAMP, None))
    bands = {
        "fore-aft moment, MN m": kept["section_moment"].sel(direction="y") / 1e6,
        "shear force, MN": kept["section_force"].sel(direction="x") / 1e6,
    }
    _, panes = plt.subplots(1, 2, figsize=(7.6, 4.6), sharey=True)
    for axes, (name, values) in zip(panes, bands.items(), strict=True):
        low, high = values.min("time"), values.max("time")
        axes.fill_betweenx(history.height, low, high, color=BLUE, alpha=0.25, lw=0)
        axes.plot(values.mean("time"), history.height, color=BLUE)
        axes.set_xlabel(name)
        mark_levels(axes, turbine.site.mudline, water=True)
    panes[0].set_ylabel("height above still water, m")
    largest = bands["fore-aft moment, MN m"].max("time")
    return {
        "largest moment, MN m": float(largest.max()),
        "its depth below the mudline, m": float(turbine.site.mudline - largest.idxmax("height")),
        "largest moment at the mudline, MN m": float(
            kept["mudline_moment"].sel(direction="y").max() / 1e6
        ),
        "moment at the toe over the largest": float(
            np.abs(bands["fore-aft moment, MN m"][:, 0]).max() / largest.max()
        ),
    }


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.4g}")
