"""What shear changes in a stocky monopile: frequencies and lean with either element."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

import offwind_pin as ow
from offwind_pin.definitions.element import Element
from offwind_pin.display.figures.style import BLUE, PALETTE, styled

CASES = {
    "clamped, dry": ("clamped", None),
    "coupled springs, still water": ("coupled_springs", ow.StillWater()),
    "distributed springs, still water": ("distributed_springs", ow.StillWater()),
}
MODES = ("FA1", "SS1", "FA2", "SS2", "T1")
ELEMENTS: tuple[Element, ...] = ("euler_bernoulli", "timoshenko")
PICTURE = Path(__file__).resolve().parents[1] / "docs" / "images" / "shear.svg"


def main(picture: Path | None = None) -> dict[str, dict[str, dict[str, float]]]:
    """Frequencies in Hz and tower-top lean under gravity in m, by case, quantity and element."""
    turbine = ow.load_turbine("oc6_phase2")
    table: dict[str, dict[str, dict[str, float]]] = {}
    for case, (foundation, sea) in CASES.items():
        table[case] = {quantity: {} for quantity in (*MODES, "lean")}
        for element in ELEMENTS:
            system = ow.build(turbine, foundation, sea, element=element)
            state = ow.static(system)
            result = ow.modes(system, n=8, about=state)
            for mode in MODES:
                frequency = result.frequency_hz[result.index(mode)]
                table[case][mode][element] = float(frequency)
            table[case]["lean"][element] = float(state.tower_top_displacement[0])
    if picture is not None:
        draw(table).savefig(picture)
    return table


@styled
def draw(table: dict[str, dict[str, dict[str, float]]]) -> Figure:
    """Change of each quantity by shear in percent, for the three foundations."""
    figure = Figure(figsize=(7.2, 2.8))
    axes: Any = figure.subplots()
    names = [*MODES, "lean"]
    width = 0.8 / len(table)
    for i, (case, rows) in enumerate(table.items()):
        change = [100 * (rows[n]["timoshenko"] / rows[n]["euler_bernoulli"] - 1) for n in names]
        place = [k + (i - 1) * width for k in range(len(names))]
        bars = axes.bar(place, change, 0.92 * width, color=PALETTE[i], label=case)
        axes.bar_label(bars, fmt="%.1f", padding=2, fontsize=8)
    axes.axhline(0, color=BLUE, linewidth=0.5)
    axes.margins(y=0.15)
    axes.set_xticks(range(len(names)), [*MODES, "tower-top lean"])
    axes.set_ylabel("change by shear, %")
    axes.set_title("Shear in the OC6 monopile and tower")
    axes.legend(loc="lower right", fontsize=8)
    return figure


if __name__ == "__main__":
    for case, rows in main(PICTURE).items():
        print(case)
        for name, values in rows.items():
            print(f"  {name:5s}", *(f"{values[element]:9.4f}" for element in ELEMENTS))
