"""
Steep and linear waves
======================

The same wave height and period with linear theory up to the mean water level, and with stream
function theory up to the crest, both in the steady state. In shallow water the crest is narrow and
higher than half the wave height, the forces above the mean level have the longest arm to the
mudline, and the harmonics of the steep wave excite the first mode.
"""

import matplotlib.pyplot as plt

import offwind_pin as ow
from offwind_pin.display.figures.style import BLUE, VERMILLION, styled

HEIGHT, PERIOD, PERIODS = 10.0, 11.0, 20


@styled
def main() -> dict[str, float]:
    """Crest in m and largest mudline moment in MN m for each theory."""
    turbine = ow.load_turbine("oc3_phase2")
    crest_time = (PERIODS - 0.5) * PERIOD
    steep = ow.StreamWaves(HEIGHT, PERIOD, crest_time=crest_time)
    seas = {"linear": ow.RegularWaves(HEIGHT, PERIOD), "stream function": steep}
    _, (above, below) = plt.subplots(2, 1, figsize=(7.2, 5.0), sharex=True)
    found = {}
    for (name, sea), color in zip(seas.items(), (BLUE, VERMILLION), strict=True):
        system = ow.build(turbine, "coupled_springs", sea, elements=20)
        history = ow.simulate(system, PERIODS * PERIOD, 0.05, ramp=10 * PERIOD)
        # One period with the crest in the middle; linear waves have theirs at whole periods.
        start = (PERIODS - (1.5 if name == "linear" else 1)) * PERIOD
        last = history.sel(time=slice(start - 0.01, start + PERIOD + 0.01))
        surface = last["wave_elevation"].values
        moment = last["mudline_moment"].sel(direction="y").values / 1e6
        above.plot(last.time - start, surface, color=color, label=name)
        below.plot(last.time - start, moment, color=color, label=name)
        found[f"{name}: crest, m"] = float(surface.max())
        found[f"{name}: largest moment, MN m"] = float(moment.max())
    above.set(ylabel="surface, m", title=f"{HEIGHT:g} m high, {PERIOD:g} s, in 20 m of water")
    below.set(ylabel="moment at mudline, MN m", xlabel="time, s")
    above.legend()
    return found


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.4g}")
