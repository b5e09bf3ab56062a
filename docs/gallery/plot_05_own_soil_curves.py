"""
Your own p-y curves from a table
================================

Curves from a site investigation as a CSV table, used in a copy of a turbine definition. The first
frequencies are computed with the tabulated soil and with soil of half the strength.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import yaml

import offwind_pin as ow
from offwind_pin.display.figures.style import BLUE, GREEN, VERMILLION, styled

SHIPPED = Path(ow.__file__).parent / "definitions" / "library" / "oc3_phase2.yaml"
DEPTHS, DISPLACEMENTS = (0.0, 12.0, 36.0), np.array([0.005, 0.02, 0.05, 0.2])


def write_table(path: Path, factor: float) -> None:
    """Write curves that soften with displacement and increase with depth, as CSV."""
    rows = ["depth_m,y_m,p_n_per_m"]
    for depth in DEPTHS:
        ultimate = factor * (3.0e5 + 4.0e5 * depth)
        for y in DISPLACEMENTS:
            rows += [f"{depth},{y},{ultimate * np.tanh(y / 0.03):.6g}"]
    path.write_text("\n".join(rows) + "\n")


def turbine_with(folder: Path, factor: float) -> ow.Turbine:
    """The OC3 monopile on springs from the table."""
    definition = yaml.safe_load(SHIPPED.read_text())
    definition["soil"]["distributed_springs"]["curve"] = {"kind": "table", "file": "curves.csv"}
    write_table(folder / "curves.csv", factor)
    (folder / "own.yaml").write_text(yaml.safe_dump(definition))
    return ow.load_turbine(folder / "own.yaml")


@styled
def main() -> dict[str, float]:
    """First two fore-aft frequencies in Hz, with the soil of the table and half of it."""
    _, axes = plt.subplots(figsize=(6.0, 3.6))
    found = {}
    with tempfile.TemporaryDirectory() as name:
        for factor, style in ((1.0, "-"), (0.5, "--")):
            turbine = turbine_with(Path(name), factor)
            soil = ow.soil_overview(turbine)
            for depth, color in zip(DEPTHS, (BLUE, GREEN, VERMILLION), strict=True):
                node = int(np.argmin(np.abs(soil.depth - depth)))
                y = np.linspace(0, 0.2, 200)
                nodes = np.ones(len(soil.depth))
                p = [soil.lateral.curves.resistance(value * nodes)[node] for value in y]
                label = f"{depth:g} m deep" if factor == 1 else None
                axes.plot(y, np.array(p) / 1e6, style, color=color, label=label)
            system = ow.build(turbine, "distributed_springs", ow.StillWater())
            modes = ow.modes(system)
            for label in ("FA1", "FA2"):
                at = modes.index(label)
                found[f"{label}, curves times {factor:g}, Hz"] = float(modes.frequency_hz[at])
    axes.set(xlabel="displacement, m", ylabel="resistance, MN/m", title="p-y curves of the table")
    axes.legend()
    return found


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value:.4f}")
