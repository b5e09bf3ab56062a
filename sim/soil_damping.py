"""What each description of the soil damps in LC 5.1: the mudline moment's spectrum, and heat.

Eight descriptions of the benchmark's ground under the same waves and wind, for several seeds, and
one of them without the water's added mass. The paper (Rahman et al., MECC 2025) reports an order of
them; the table shows ours.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.cases.case import (
    Case,
    TransientAnalysis,
    load_case,
)
from offwind_pin.definitions.soil.springs import DistributedSprings, Hysteresis
from offwind_pin.definitions.turbine import RotorNacelleRNA
from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    GREEN,
    MUTED,
    VERMILLION,
    styled,
)
from offwind_pin.signal.moment_spectrum import BANDS_HZ, moment_spectrum

Array = NDArray[np.float64]

OUT = Path(__file__).resolve().parents[1] / "out" / "soil_damping"
SEEDS = (1, 2, 3)
SLIDERS = 20


@dataclass(frozen=True)
class Model:
    """One description of the ground: a foundation, what the turbine becomes, and how it damps."""

    name: str
    foundation: str
    change: Callable[[ow.Turbine], ow.Turbine] = lambda turbine: turbine
    damping: str = "none"


def condensed(turbine: ow.Turbine) -> ow.Turbine:
    """With the 6x6 that small motions of the unloaded pile see, in place of the published one."""
    system = ow.build(turbine, "distributed_springs")
    return ow.condense(system, ow.static(system)).replacing_soil(turbine)


def undamped(turbine: ow.Turbine) -> ow.Turbine:
    """The springs alone."""
    return with_springs(turbine, dashpot=None)


def constant(turbine: ow.Turbine) -> ow.Turbine:
    """Dashpots of the initial stiffness."""
    dashpot = springs_of(turbine).dashpot
    assert dashpot is not None  # noqa: S101 - of the shipped turbine
    return with_springs(turbine, dashpot=dashpot.model_copy(update={"stiffness": "initial"}))


def hysteretic(turbine: ow.Turbine) -> ow.Turbine:
    """The same curves as sliders that follow Masing's rules."""
    return with_springs(turbine, dashpot=None, hysteretic=Hysteresis(sliders=SLIDERS))


def without_added_mass(turbine: ow.Turbine) -> ow.Turbine:
    """As shipped, but the water neither moves with the structure nor adds to the waves' inertia."""
    water = turbine.hydrodynamics.model_copy(update={"added_mass_coefficient": 0.0})
    return turbine.model_copy(update={"hydrodynamics": water})


def springs_of(turbine: ow.Turbine) -> DistributedSprings:
    springs = turbine.soil.distributed_springs
    assert springs is not None  # noqa: S101 - of the shipped turbine
    return springs


def with_springs(turbine: ow.Turbine, **changes: object) -> ow.Turbine:
    """The turbine with some fields of its distributed springs changed."""
    springs = springs_of(turbine).model_copy(update=changes)
    soil = turbine.soil.model_copy(update={"distributed_springs": springs})
    return turbine.model_copy(update={"soil": soil})


UNDAMPED = "springs, undamped"
"""What the others are compared with, seed by seed."""
MODELS = (
    Model("6x6, published", "coupled_springs"),
    Model("6x6, condensed", "coupled_springs", condensed),
    Model("apparent fixity", "apparent_fixity"),
    Model(UNDAMPED, "distributed_springs", undamped),
    Model("springs, secant dashpots", "distributed_springs", damping="dashpots"),
    Model("springs, constant dashpots", "distributed_springs", constant, "dashpots"),
    Model("secant dashpots, no added mass", "distributed_springs", without_added_mass, "dashpots"),
    Model("springs, hysteretic", "distributed_springs", hysteretic, "hysteresis"),
    Model("macro-element", "macro_element", damping="hysteresis"),
)
COLORS = {"none": VERMILLION, "dashpots": BLUE, "hysteresis": GREEN}
MARKERS = {"none": "s", "dashpots": "o", "hysteresis": "D"}

QUANTITIES = (*BANDS_HZ, "ratio", "soil_heat_j", "FA1_soil_damping", "mudline_x_std_m")
"""Numbers of a run: PSD sums of the fore-aft moment in (N m)^2 and the first over the second; heat
in the soil after the ramp, and the damping ratio that it is worth; how much the mudline sways."""


def main(
    seeds: Sequence[int] = SEEDS, duration: float | None = None, out: Path | None = None
) -> dict[str, dict[str, list[float]]]:
    """Run every model under the same seeds; with a folder, write table and picture there.

    Parameters
    ----------
    seeds : of waves and wind
    duration : in s, by default the case's 660 s

    Returns
    -------
    By model, each of ``QUANTITIES`` by seed, and ``FA1_hz``, ``FA2_hz``, ``FA1_damping``,
    ``FA2_damping`` of small motions about the state under the mean load
    """
    case = load_case("oc6-lc5.1")
    numbers = {model.name: study(model, case.turbine, case, seeds, duration) for model in MODELS}
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        draw(numbers).savefig(out / "soil_damping.svg", metadata={"Date": None})
        (out / "index.md").write_text(page(numbers, seeds), encoding="utf-8")
    return numbers


def study(
    model: Model, turbine: ow.Turbine, case: Case, seeds: Sequence[int], duration: float | None
) -> dict[str, list[float]]:
    """Numbers of one model, by seed."""
    analysis = case.analysis
    if not isinstance(analysis, TransientAnalysis):
        raise TypeError("the case is no time history")
    if duration is not None:
        analysis = analysis.model_copy(update={"duration": duration})
    changed = model.change(turbine)
    found: dict[str, list[float]] = {name: [] for name in QUANTITIES}
    for seed in seeds:
        waves, history = environment(case, changed, analysis, seed)
        system = ow.build(changed, model.foundation, waves)
        if not found["ratio"]:
            mean = history.mean(analysis.ramp, analysis.duration)
            modes = ow.modes(system, about=ow.static(system, mean))
            for label in ("FA1", "FA2"):
                at = modes.index(label)
                found[f"{label}_hz"] = [float(modes.frequency_hz[at])]
                found[f"{label}_damping"] = [float(modes.damping_ratio[at])]
        data = ow.simulate(
            system,
            analysis.duration,
            analysis.dt,
            [history],
            ramp=analysis.ramp,
            save_at=ow.SaveAt(analysis.output_dt),
        )
        for name, value in measure(data, analysis, found["FA1_hz"][0]).items():
            found[name].append(value)
    return found


def environment(
    case: Case, turbine: ow.Turbine, analysis: TransientAnalysis, seed: int
) -> tuple[ow.IrregularWaves, ow.LoadHistory]:
    """Waves and tower-top load of a case for another seed."""
    sea, load = case.sea, case.tower_top_load
    if not isinstance(sea, ow.IrregularWaves) or not isinstance(load, ow.SyntheticWind):
        raise TypeError("the case has no irregular waves or no synthetic wind")
    if not isinstance(turbine.rna, RotorNacelleRNA):
        raise TypeError("the turbine has no rotor")
    waves = sea.completed(seed, analysis.duration)
    history = load.completed(seed).generate(
        turbine.rna,
        duration=analysis.duration,
        repeat_period=analysis.duration - analysis.ramp,
    )
    return waves, history


def measure(data: xr.Dataset, analysis: TransientAnalysis, first_hz: float) -> dict[str, float]:
    """Sums of the spectrum, heat, and what the heat is worth as damping of the first mode.

    A mode of kinetic energy T(t) loses 4 zeta omega T a second; nearly all of the motion is the
    first mode's.
    """
    spectrum = moment_spectrum(data, min(analysis.psd_segment, analysis.duration / 2), {})
    low, high = (band.area for band in spectrum.bands)
    after = data.where(data["time"] >= analysis.ramp, drop=True)
    soil = [
        name for name in after["sink"].values if name == "foundation" or name.startswith("soil")
    ]
    heat = after["energy_dissipated"].sel(sink=soil).sum("sink")
    taken = float(heat[-1] - heat[0])
    kinetic = float(after["energy_stored"].sel(holder="kinetic").mean())
    mudline = after["displacement"].sel(height=data.attrs["mudline_m"], direction="x")
    power = taken / float(after["time"][-1] - after["time"][0])
    return {
        **dict(zip(BANDS_HZ, (low, high), strict=True)),
        "ratio": low / high,
        "soil_heat_j": taken,
        "mudline_x_std_m": float(mudline.std()),
        "FA1_soil_damping": power / (4 * 2 * np.pi * first_hz * kinetic),
    }


def page(numbers: dict[str, dict[str, list[float]]], seeds: Sequence[int]) -> str:
    """Table and picture as Markdown."""
    return "\n".join(
        [
            "# Soil damping in LC 5.1",
            "",
            f"Means over seeds {', '.join(map(str, seeds))}, with the standard deviation of one "
            "seed where it is random.",
            "",
            *table(numbers),
            "",
            "![Sums of the spectrum and heat in the soil](soil_damping.svg)",
            "",
        ]
    )


def table(numbers: dict[str, dict[str, list[float]]]) -> list[str]:
    """Rows of the table in Markdown."""
    rows = [
        "| soil | FA1, FA2 in Hz | damping of small motions in FA1, FA2, % | sum 0.2-0.3 Hz, "
        "(MN m)^2 | over undamped | sum 1.0-1.5 Hz, (MN m)^2 | over undamped | ratio of the sums "
        "| heat in the soil, kJ | its worth in FA1, % of critical |",
        "| --- " * 10 + "|",
    ]
    for name, found in numbers.items():
        sums = [
            with_spread(values)
            for band in BANDS_HZ
            for values in (np.array(found[band]) / 1e12, shares(numbers, name, band))
        ]
        cells = [
            name,
            f"{found['FA1_hz'][0]:.3f}, {found['FA2_hz'][0]:.3f}",
            f"{100 * found['FA1_damping'][0]:.2f}, {100 * found['FA2_damping'][0]:.2f}",
            *sums,
            with_spread(np.array(found["ratio"])),
            with_spread(np.array(found["soil_heat_j"]) / 1e3),
            with_spread(100 * np.array(found["FA1_soil_damping"])),
        ]
        rows.append(f"| {' | '.join(cells)} |")
    return rows


def shares(numbers: dict[str, dict[str, list[float]]], name: str, quantity: str) -> Array:
    """A quantity over that of the undamped springs under the same seed."""
    return np.array(numbers[name][quantity]) / np.array(numbers[UNDAMPED][quantity])


def with_spread(values: Array) -> str:
    """Mean and standard deviation, to three figures of the mean."""
    mean = float(values.mean())
    if mean == 0:
        return "0"
    digits = max(0, 2 - int(np.floor(np.log10(abs(mean)))))
    spread = f" ± {values.std(ddof=1):.{digits}f}" if len(values) > 1 else ""
    return f"{mean:.{digits}f}{spread}"


@styled
def draw(numbers: dict[str, dict[str, list[float]]]) -> Figure:
    """A dot for each seed and a mark for the mean, of both sums and of the heat."""
    figure = Figure(figsize=(FULL_WIDTH, 3.8))
    panels: Any = figure.subplots(1, 3, sharey=True)
    shown = (
        ("psd_sum_0p2_0p3", 1e12, "PSD sum 0.2-0.3 Hz", "(MN m)²"),
        ("psd_sum_1p0_1p5", 1e12, "PSD sum 1.0-1.5 Hz", "(MN m)²"),
        ("soil_heat_j", 1e3, "Heat in the soil", "kJ"),
    )
    for axes, (quantity, unit, title, label) in zip(panels, shown, strict=True):
        for place, model in enumerate(MODELS):
            values = np.array(numbers[model.name][quantity]) / unit
            color, marker = COLORS[model.damping], MARKERS[model.damping]
            if not values.any():
                axes.text(0.03, place, "none", transform=axes.get_yaxis_transform(), va="center")
                continue
            axes.plot(values, np.full(len(values), place), "o", color=color, ms=3, alpha=0.6)
            axes.plot(values.mean(), place, marker, color=color, ms=8, mec="white", zorder=3)
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 4, 6)))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.grid(visible=True, axis="x")
        axes.set_title(title)
        axes.set_xlabel(label)
    panels[2].xaxis.set_major_locator(LogLocator(subs=(1, 3)))
    for axes in panels[1:]:
        axes.tick_params(left=False)
    panels[0].set_yticks(range(len(MODELS)), [model.name for model in MODELS])
    panels[0].set_ylim(len(MODELS) - 0.5, -0.5)
    handles = [
        Line2D([], [], color=COLORS[kind], marker=MARKERS[kind], ms=8, mec="white", ls="none")
        for kind in COLORS
    ]
    handles.append(Line2D([], [], color=MUTED, marker="o", ms=3, ls="none"))
    labels = ["no soil damping, mean", "dashpots, mean", "hysteresis, mean", "one seed"]
    figure.legend(handles, labels, loc="outside lower center", ncols=4)
    return figure


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT)
    parser.add_argument("--seeds", type=int, nargs="+", default=SEEDS)
    given = parser.parse_args()
    print("\n".join(table(main(given.seeds, out=given.out))))
    print(f"Wrote {given.out / 'index.md'}")
