"""
Wind and waves: time history and spectrum
=========================================

Three minutes of a running rotor in turbulent wind and irregular waves, starting from the static
state under the mean thrust. The mudline moment follows the slow wind variations, the waves, and the
blade passing. The peak of the first mode, which the rotor damps, is broad and no higher than that
of the waves.
"""

import matplotlib.pyplot as plt

import offwind_pin as ow
from offwind_pin.display.figures.style import BLUE, GREEN, VERMILLION, styled
from offwind_pin.signal.spectra import power_spectral_density

RAMP, DURATION, DT = 30.0, 180.0, 0.05


@styled
def main() -> dict[str, float]:
    """Mean and standard deviation of the moment in MN m, first mode in Hz, area check."""
    turbine = ow.load_turbine("oc6_phase2")
    sea = ow.IrregularWaves(2.5, 8.0, seed=1, repeat_period=DURATION)
    system = ow.build(turbine, "distributed_springs", sea, elements=24)
    disc = ow.rotor_disc(turbine)
    settings = ow.RotorWind(9.0, turbulence_intensity=0.14, seed=1)
    wind = settings.generate(disc, repeat_period=DURATION - RAMP)
    history = ow.simulate(system, DURATION, DT, [ow.RotorThrust(disc, wind)], ramp=RAMP)
    moment = history["mudline_moment"].sel(direction="y") / 1e6
    analysed = moment.sel(time=slice(RAMP, None)).values
    frequency, density = power_spectral_density(analysed, DT, segment=75.0)
    modes = ow.modes(system, n=4)
    first = float(modes.frequency_hz[modes.index("FA1")])
    _, (above, below) = plt.subplots(2, 1, figsize=(7.2, 5.2))
    above.plot(moment.time, moment, color=BLUE, lw=0.9)
    above.set(xlabel="time, s", ylabel="moment, MN m", title="Fore-aft moment at the mudline")
    below.semilogy(frequency, density, color=BLUE)
    passing = settings.of_rotor(disc).blade_passing_frequency
    marks = {"waves": (1 / 8.0, GREEN), "FA1": (first, VERMILLION), "3P": (passing, "0.4")}
    for name, (at, color) in marks.items():
        below.axvline(at, color=color, lw=0.9, ls="--", label=f"{name}, {at:.3f} Hz")
    below.set(xlim=(0, 0.8), ylim=(1e-3, None), xlabel="frequency, Hz", ylabel="(MN m)²/Hz")
    below.legend()
    return {
        "mean moment, MN m": float(analysed.mean()),
        "standard deviation, MN m": float(analysed.std()),
        "first fore-aft mode, Hz": first,
        "area of the spectrum over the variance": float(
            density.sum() * frequency[1] / analysed.var()
        ),
    }


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.4g}")
