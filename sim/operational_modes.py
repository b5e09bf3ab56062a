"""LC 2.3 as the paper ran it: white noise, 13 accelerations, frequency domain decomposition.

Rahman et al. (MECC 2025) shake the turbine on its soil in still water with white noise, and take
frequencies and shapes out of the accelerations at 13 nodes from the seabed to the yaw bearing. Here
the same is done, and laid beside the modes of the eigenanalysis.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.campaign.case import load_case
from offwind_pin.display.style import BLUE, FULL_WIDTH, MUTED, VERMILLION, styled

Array = NDArray[np.float64]

OUT = Path(__file__).resolve().parents[1] / "out" / "operational_modes"
LABELS = ("FA1", "FA2")
NODES = 13
DURATION, RAMP = 10_800.0, 200.0
"""s. The paper does not print the length. The damping of the first mode sets ours: its ratio
scatters by about 20 % in three hours. The start is left out."""
STEP = 0.02
"""s; generalised-alpha lengthens the period of the second mode by (omega dt)^2 / 12, 0.2 %."""
SEGMENT = 250.0
"""s; 0.4 / (zeta f) of the first mode, 7 / (zeta f) of the second."""
FORCE, MOMENT = 20e3, 1e6
"""Standard deviations of Fx in N and My in N m at the yaw bearing. So small that the soil stays
linear; the moment reaches the second mode, which hardly moves there but turns."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """Identified modes beside those of the eigenanalysis, FA1 and FA2 in rows.

    Attributes
    ----------
    height : (13,) heights of the nodes in m
    identified : out of the accelerations
    frequency_hz, damping_ratio : (2,) of the eigenanalysis
    shape : (2, 13) of the eigenanalysis at the nodes, unit peak among them
    assurance : (2,) modal assurance of identified and computed shapes
    peak_height_ratio : (2,) height of the identified peak, mudline 0, yaw bearing 1; between nodes
        by a parabola
    """

    height: Array
    identified: ow.OperationalModes
    frequency_hz: Array
    damping_ratio: Array
    shape: Array
    assurance: Array
    peak_height_ratio: Array


def main(duration: float = DURATION, seed: int = 1, out: Path | None = None) -> Comparison:
    """Shake, identify and compare; with a folder, write table and picture there.

    Parameters
    ----------
    duration : recorded time in s, after the ramp
    seed : of the white noise
    """
    case, _ = load_case("oc6-lc2.3")
    turbine = ow.load_turbine(case.turbine)
    system = ow.build(turbine, "distributed_springs", ow.StillWater())
    height = np.linspace(turbine.site.mudline, system.chain.top, NODES)
    data = shaken(system, height, duration, seed)
    record = data["acceleration"].sel(direction="x").sel(height=height, method="nearest")
    height = record["height"].values
    modes = ow.modes(system)
    rows = [modes.index(label) for label in LABELS]
    identified = ow.operational_modes(
        record.values[data["time"].values >= RAMP],
        1 / STEP,
        SEGMENT,
        near=modes.frequency_hz[rows].tolist(),
        names=[f"z {z:.4g} m" for z in height],
    )
    shape = np.array([np.interp(height, modes.height, modes.shape[row, :, 0]) for row in rows])
    shape /= np.max(np.abs(shape), axis=1, keepdims=True)
    result = Comparison(
        height=height,
        identified=identified,
        frequency_hz=modes.frequency_hz[rows],
        damping_ratio=modes.damping_ratio[rows],
        shape=shape,
        assurance=ow.modal_assurance(identified.shape, shape).diagonal(),
        peak_height_ratio=np.array([_peak(row) for row in identified.shape]) / (NODES - 1),
    )
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        draw(result).savefig(out / "operational_modes.svg", metadata={"Date": None})
        (out / "index.md").write_text(page(result), encoding="utf-8")
    return result


def shaken(system: ow.System, height: Array, duration: float, seed: int) -> xr.Dataset:
    """Time history under white noise in Fx and My at the yaw bearing."""
    steps = round((RAMP + duration) / STEP)
    noise = np.random.default_rng(seed).normal(size=(steps + 1, 2)) * [FORCE, MOMENT]
    load = np.zeros((steps + 1, 6))
    load[:, [0, 4]] = noise
    history = ow.LoadHistory(
        np.linspace(0.0, steps * STEP, steps + 1), load, f"white noise, seed {seed}"
    )
    return ow.simulate(
        system,
        steps * STEP,
        STEP,
        [history],
        ramp=20.0,
        spectral_radius=1.0,  # no numerical damping, which would be identified too
        heights=height.tolist(),
        segments=[],
    )


def _peak(shape: Array) -> float:
    """Number of the node at the peak, and the part of a step to the vertex of a parabola there."""
    at = int(np.argmax(shape))
    if at in (0, len(shape) - 1):
        return float(at)
    left, middle, right = shape[at - 1 : at + 2]
    return float(at + 0.5 * (left - right) / (left - 2 * middle + right))


def page(result: Comparison) -> str:
    """Table in Markdown."""
    found = result.identified
    rows = [
        "| mode | frequency, Hz | eigenanalysis | damping, % | eigenanalysis | scatter at least "
        "| MAC | height of the peak |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    rows += [
        f"| {label} | {found.frequency_hz[i]:.4f} | {result.frequency_hz[i]:.4f} "
        f"| {100 * found.damping_ratio[i]:.3f} | {100 * result.damping_ratio[i]:.3f} "
        f"| {100 * found.damping_scatter[i]:.3f} | {result.assurance[i]:.5f} "
        f"| {result.peak_height_ratio[i]:.2f} |"
        for i, label in enumerate(LABELS)
    ]
    return "\n".join([*rows, "", *found.cautions, ""])


@styled
def draw(result: Comparison) -> Figure:
    """Singular values over frequency, and the normalised shapes over height."""
    figure = Figure(figsize=(FULL_WIDTH, 0.5 * FULL_WIDTH), layout="constrained")
    values, shapes = figure.subplots(1, 2, width_ratios=[1.5, 1])
    found = result.identified
    inside = (found.frequencies > 0.05) & (found.frequencies < 3.0)
    for number, color in ((0, BLUE), (1, MUTED)):
        level = 10 * np.log10(found.singular_values[inside, number])
        values.plot(found.frequencies[inside], level, color=color, linewidth=0.8)
    for i, (label, color) in enumerate(zip(LABELS, (BLUE, VERMILLION), strict=True)):
        values.axvline(found.frequency_hz[i], color=color, linewidth=0.6, linestyle=":")
        shapes.plot(result.shape[i], result.height, color=color, linewidth=1.0, label=label)
        shapes.plot(found.shape[i], result.height, "o", color=color, markersize=3.5)
    values.set_xlabel("frequency, Hz")
    values.set_ylabel("singular values 1 and 2, dB of (m/s²)²/Hz")
    shapes.axhline(0.0, color=MUTED, linewidth=0.5)
    shapes.set_xlabel("shape, unit peak")
    shapes.set_ylabel("height, m")
    shapes.set_title("identified (dots), eigenanalysis (lines)", fontsize="small")
    shapes.legend()
    return figure


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--duration", type=float, default=DURATION, help="s")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print(page(main(options.duration, options.seed, OUT)))
