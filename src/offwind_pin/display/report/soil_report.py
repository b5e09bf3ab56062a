"""Soil of a turbine as a self-contained HTML page, in the style of the reports."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from offwind_pin.display.figures import soil as soil_plots
from offwind_pin.display.figures.style import to_svg
from offwind_pin.display.report.headline import Card
from offwind_pin.display.report.templates import environment
from offwind_pin.display.wording import DASH, TIMES, fixed, number, quantity

if TYPE_CHECKING:
    from offwind_pin.analysis.foundation.study.study import Fixity, SoilOverview
    from offwind_pin.base.definition import Array

MEGA = 1e6
STIFFNESS_NAMES = {
    "tangent_unloaded": "Tangent, unloaded",
    "tangent_loaded": "Tangent, under load",
    "secant_loaded": "Secant, under load",
}
_DAMPING_COLUMNS = {
    "secant_dashpot": "Secant",
    "initial_dashpot": "Constant",
    "sliders": "Sliders",
}
_SPRING_NAMES = {
    "soil_rocking": "rotation of the sections",
    "soil_friction": "rotation, by friction",
    "soil_base_shear": "shear at the toe",
    "soil_base_moment": "moment at the toe",
    "soil_bearing": "end bearing",
    "soil_shaft": "skin friction",
    "soil_torsion": "torsion",
}
_ROWS = 26
"""Largest number of nodes in the table."""
_SHOWN_AMPLITUDES = 7
_NEGLIGIBLE = 1e-6
"""Entry ij over the root of ii times jj below which it is shown as zero."""


def render_soil_page(soil: SoilOverview) -> str:
    """The HTML text of the page."""
    titles = {
        "curves": "Curves at the nodes",
        "state": "State along the pile",
        "pushover": "Pushover",
        "stiffness": "Stiffness at the mudline",
        "fixity": "Apparent fixity",
        "damping": "Equivalent damping",
    }
    absent = {
        "state": soil.state is None,
        "fixity": soil.fixity is None,
        "damping": not soil.damping,
    }
    pictures = {
        name: Markup(to_svg(figure, f"soil-{name}"))  # noqa: S704 (matplotlib has escaped it)
        for name, figure in figures(soil).items()
    }
    columns, rows = damping_rows(soil)
    return (
        environment()
        .get_template("soil.html.j2")
        .render(
            soil=soil,
            titles={name: title for name, title in titles.items() if not absent.get(name)},
            figures=pictures,
            cards=_cards(soil),
            notes=[*soil.foundation.cautions, *soil.remarks],
            nodes=node_rows(soil),
            node_step=_node_step(soil),
            others=other_rows(soil),
            state_origin="" if soil.state is None else soil.state.origin,
            pushover=pushover_facts(soil),
            ended_early=soil.ended_early,
            matrices=[
                (STIFFNESS_NAMES[name], matrix_rows(matrix))
                for name, matrix in soil.stiffness.items()
            ],
            fixity=fixity_facts(soil.fixity),
            damping_columns=columns,
            damping_rows=rows,
            damping_depth=soil.damping_depth,
        )
    )


def figures(soil: SoilOverview) -> dict[str, Figure]:
    """Figures by section."""
    lateral, state = soil.lateral, soil.state
    reached = None if state is None else state.displacement
    made = {
        "curves": soil_plots.curves_by_depth(
            lateral, soil.turbine.site.mudline, soil.head_diameter, reached
        ),
        "pushover": soil_plots.pushover_curves(
            soil.pushover, soil.stiffness["tangent_unloaded"], soil.macro_element
        ),
    }
    if state is not None:
        initial = lateral.curves.secant(np.zeros(len(soil.depth)))
        made["state"] = soil_plots.state_over_depth(
            soil.depth, state.displacement, state.secant, initial, state.utilisation
        )
    if soil.damping:
        at = None
        if reached is not None:
            at = float(reached[np.argmin(np.abs(soil.depth - soil.damping_depth))])
        made["damping"] = soil_plots.damping_over_amplitude(soil.damping, soil.damping_model, at)
    return made


def soil_tables(soil: SoilOverview) -> list[tuple[str, list[str], list[list[str]]]]:
    """Titles, headings and rows of the tables for a terminal."""
    nodes = ["depth, m", "z, m", "D, m", "length, m", "curve", "initial, MN/m²", "ultimate, MN/m"]
    if soil.state is not None:
        nodes += ["y, mm", "secant, MN/m²", "utilised, %"]
    tables = [("Curves at the nodes", nodes, node_rows(soil))]
    others = other_rows(soil)
    if others:
        headings = ["other springs", "nodes", "initial stiffness", "ultimate", "unit"]
        tables.append(("", headings, others))
    plain = ["", ""]
    tables.append(("Pushover", plain, [list(row) for row in pushover_facts(soil)]))
    order = ["x", "y", "z", "rx", "ry", "rz"]
    for name, matrix in soil.stiffness.items():
        title = f"6{TIMES}6 at the mudline, {STIFFNESS_NAMES[name].lower()} (MN, m, rad)"
        tables.append((title, order, matrix_rows(matrix)))
    if soil.fixity is not None:
        rows = [list(row) for row in fixity_facts(soil.fixity)]
        tables.append(("Apparent fixity", plain, rows))
    columns, rows = damping_rows(soil)
    if rows:
        title = f"Equivalent damping in % at {number(soil.damping_depth, 3)} m depth"
        tables.append((title, ["amplitude, mm", *columns], rows))
    return tables


def node_rows(soil: SoilOverview) -> list[list[str]]:
    """Cells of the table of nodes, evenly thinned if there are many."""
    step = _node_step(soil)
    shown = sorted({*range(0, len(soil.depth), step), len(soil.depth) - 1})
    nodes = soil.nodes()
    rows = []
    for node in (nodes[i] for i in shown):
        cells = [
            fixed(node["depth_m"], 2),
            fixed(node["height_m"], 2),
            fixed(node["diameter_m"], 2),
            fixed(node["tributary_length_m"], 3),
            node["model"].replace("_", " "),
            number(node["initial_modulus_n_per_m2"] / MEGA, 4),
            _over_mega(node["ultimate_resistance_n_per_m"]),
        ]
        if soil.state is not None:
            used = node["utilisation"]
            cells += [
                number(1e3 * node["displacement_m"], 3),
                number(node["secant_stiffness_n_per_m2"] / MEGA, 4),
                DASH if used is None else fixed(100 * used, 1),
            ]
        rows.append(cells)
    return rows


def _node_step(soil: SoilOverview) -> int:
    """Number of nodes from one row of the table to the next."""
    return -(-(len(soil.depth) - 1) // (_ROWS - 1))


def other_rows(soil: SoilOverview) -> list[list[str]]:
    """Name, nodes, ranges of initial stiffness and ultimate resistance, and unit of other
    springs."""
    rows = []
    for load in soil.as_dict()["other_springs"]:
        ultimate = [value for value in load["ultimate"] if value is not None]
        unit, per = load["resistance_unit"], load["deflection_unit"]
        rows.append(
            [
                _SPRING_NAMES.get(load["name"], load["name"]),
                str(len(load["depth_m"])),
                _range(load["initial_stiffness"]),
                _range(ultimate) if ultimate else "∞",
                f"{unit} per {per}; {unit}",
            ]
        )
    for name, value, unit in (
        ("toe, vertical", soil.springs.toe_vertical_stiffness, "N/m"),
        ("toe, torsional", soil.springs.toe_torsional_stiffness, "N m/rad"),
    ):
        if value:
            rows.append([name, "1", number(value, 4), "∞", unit])
    return rows


def pushover_facts(soil: SoilOverview) -> list[tuple[str, str]]:
    """State at the end of the pushover."""
    push = soil.pushover
    facts = [
        ("largest load", quantity(push.load[-1] / MEGA, "MN")),
        ("moment at the mudline", quantity(push.moment[-1] / MEGA, "MN m")),
        ("mudline displacement", quantity(push.displacement[-1], "m")),
        ("mudline rotation", quantity(float(np.degrees(push.rotation[-1])), "°")),
    ]
    if soil.macro_element is not None:
        load, turned = soil.macro_element[-1]
        facts += [
            ("macro-element load there", quantity(load / MEGA, "MN")),
            ("macro-element rotation there", quantity(float(np.degrees(turned)), "°")),
        ]
    return facts


def matrix_rows(matrix: Array) -> list[list[str]]:
    """Cells of a 6x6 in MN, m and rad; entries negligible against the diagonal are zero."""
    size = np.sqrt(np.abs(np.diag(matrix)))
    kept = np.where(np.abs(matrix) < _NEGLIGIBLE * np.outer(size, size), 0.0, matrix)
    return [[number(value / MEGA, 5) for value in row] for row in kept]


def fixity_facts(fixity: Fixity | None) -> list[tuple[str, str]]:
    """The cantilever, and its stiffness compared with the 6x6."""
    if fixity is None:
        return []
    off = 100 * fixity.difference
    return [
        ("depth of fixity below the mudline", quantity(fixity.length, "m")),
        ("bending stiffness EI", quantity(fixity.bending_stiffness / 1e9, "GN m²")),
        ("exact for a load at", f"{quantity(fixity.load_arm, 'm')} above the mudline"),
        *(
            (f"stiffness {place} relative to the 6{TIMES}6", f"{fixed(value, 1, sign=True)} %")
            for place, value in (("x, x", off[0, 0]), ("x, ry", off[0, 1]), ("ry, ry", off[1, 1]))
        ),
    ]


def damping_rows(soil: SoilOverview) -> tuple[list[str], list[list[str]]]:
    """Headings and cells of the table of damping in % of critical, over amplitude in mm."""
    columns, values = [], []
    amplitude: Array = np.zeros(0)
    for name, data in soil.damping.items():
        amplitude, ratio = 1e3 * data.amplitude.values, 100 * data.damping_ratio.values
        model = _DAMPING_COLUMNS[name]
        if soil_plots.by_amplitude_only(data):
            columns.append(f"{model}, any frequency")
            values.append(ratio[:, 0])
            continue
        columns += [f"{model}, {frequency:g} Hz" for frequency in data.frequency.values]
        values += list(ratio.T)
    shown = np.unique(np.linspace(0, len(amplitude) - 1, _SHOWN_AMPLITUDES).round().astype(int))
    rows = [
        [number(amplitude[i], 3), *(fixed(float(column[i]), 2) for column in values)]
        for i in shown
        if len(amplitude)
    ]
    return columns, rows


def _cards(soil: SoilOverview) -> list[Card]:
    push = soil.pushover
    share = push.displacement[-1] / soil.head_diameter
    cards = [
        Card(
            number(push.load[-1] / MEGA, 3),
            "MN",
            f"load {number(push.arm, 4)} m above the mudline that moves it by {number(share, 2)} D",
        )
    ]
    if soil.state is not None:
        cards.append(
            Card(
                number(1e3 * float(soil.state.displacement.max()), 3),
                "mm",
                "largest displacement of the pile",
            )
        )
        if np.any(np.isfinite(soil.state.utilisation)):
            worst = 100 * float(np.nanmax(soil.state.utilisation))
            cards.append(Card(number(worst, 3), "%", "largest share of the ultimate resistance"))
    if soil.fixity is not None:
        diameters = soil.fixity.length / soil.head_diameter
        cards.append(
            Card(number(soil.fixity.length, 3), "m", f"apparent fixity, {number(diameters, 2)} D")
        )
    return cards


def _range(values: list[float]) -> str:
    low, high = min(values), max(values)
    return number(low, 3) if low == high else f"{number(low, 3)} {DASH} {number(high, 3)}"


def _over_mega(value: float | None) -> str:
    return "∞" if value is None else number(value / MEGA, 4)
