"""Pictures in one call each, in one style with colours that colour-blind eyes tell apart.

Each takes what the analyses return and gives a ``matplotlib.figure.Figure``, which :func:`save`
writes.

    from offwind_pin import plots
    plots.save(plots.mode_shapes(system, ow.modes(system)), "modes.svg")
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from offwind_pin.analysis.foundation.study.state import (
    SoilState,
    reached_statically,
    soil_displacement_reached,
    soil_springs,
)
from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.errors import InputError
from offwind_pin.base.whole_files import whole_file
from offwind_pin.display.figures import results as pictures
from offwind_pin.display.figures import soil as soil_plots
from offwind_pin.display.figures.operational_modes import singular_value_plot
from offwind_pin.display.figures.style import save_figure
from offwind_pin.dynamics.system import System
from offwind_pin.signal.modal_identification.identify import OperationalModes
from offwind_pin.signal.moment_spectrum import moment_spectrum

__all__ = [
    "mode_shapes",
    "p_y_utilisation",
    "psd",
    "save",
    "section_load_envelope",
    "singular_values",
    "static_states",
    "time_histories",
]

FORMATS = (".svg", ".pdf", ".png")


def mode_shapes(system: System, modes: ModalResult) -> Figure:
    """Unit-peak shapes over height, a panel for each family."""
    return pictures.mode_shapes(modes, system.turbine.site.mudline, water=_water(system))


def static_states(system: System, states: Mapping[str, StaticResult]) -> Figure:
    """Deflected shapes and section moments of static states over height, by name."""
    return pictures.statics(states, water=_water(system))


def psd(
    results: xr.Dataset,
    marked: Mapping[str, float] | None = None,
    *,
    segment: float = 100.0,
) -> Figure:
    """PSD of the fore-aft moment at the mudline after the ramp, with frequencies marked.

    Parameters
    ----------
    results : Dataset
        Of :func:`simulate`.
    marked : mapping of str to float, Hz, optional
        Frequencies by name: FA1, 3P, wave, ...
    segment : float, s
        Of Welch's windows.

    Raises
    ------
    InputError
        The run after the ramp is shorter than a segment.
    """
    length = float(results["time"][-1]) - float(results.attrs["ramp_s"])
    if not 0 < segment <= length:
        allowed = f"up to the {length:g} s after the ramp"
        raise InputError("psd, segment", segment, allowed, "Shorten it.")
    found = moment_spectrum(results, segment, dict(marked or {}))
    return pictures.moment_psd(found.frequency, found.density, found.marked, peaks=found.peaks)


def section_load_envelope(results: xr.Dataset) -> Figure:
    """Smallest, mean and largest section loads over height after the ramp."""
    return pictures.section_load_envelope(results)


def time_histories(results: xr.Dataset) -> Figure:
    """Panel of the waves, the tower top and the moment at the mudline over time."""
    return pictures.time_histories(results)


def p_y_utilisation(system: System, state: StaticResult | xr.Dataset) -> Figure:
    """Displacement, secant stiffness and utilisation of the p-y springs along the pile.

    state : a static one, or a run's results, of which the largest displacements are taken

    Raises
    ------
    InputError
        The system has no p-y springs, or the run recorded nothing along its pile.
    """
    soil = soil_springs(system)
    if soil is None:
        raise InputError(
            "p_y_utilisation, system",
            f"foundation {system.foundation.name}",
            "distributed_springs",
            "Build the turbine on them.",
        )
    if isinstance(state, StaticResult):
        reached = reached_statically(system, soil, state)
    elif float(state["height"].min()) <= float(soil.height.min()) + 1e-6:
        reached = soil_displacement_reached(state, soil)
    else:
        low = float(state["height"].min())
        allowed = f"heights down to the toe (z = {soil.height.min():g} m)"
        raise InputError(
            "p_y_utilisation, state", f"a run recorded down to z = {low:g} m", allowed, "Add them."
        )
    found = SoilState.of(soil.curves, reached, "")
    initial = soil.curves.secant(np.zeros(len(reached)))
    depth = system.turbine.site.mudline - soil.height
    return soil_plots.state_over_depth(
        depth, found.displacement, found.secant, initial, found.utilisation
    )


def singular_values(modes: OperationalModes, *, highest: float | None = None) -> Figure:
    """All singular values of the accelerations' cross-spectra, one below another over frequency.

    highest : end of the frequency axis in Hz, by default three times the highest mode found
    """
    return singular_value_plot(modes, highest)


def save(figure: Figure, path: Path | str) -> None:
    """Write a picture, whole or not at all: ``.svg`` and ``.pdf`` in lines, ``.png`` in dots.

    Raises
    ------
    InputError
        Another ending.
    """
    target = Path(path)
    if target.suffix.lower() not in FORMATS:
        raise InputError("save, path", target.name, f"a name in {', '.join(FORMATS)}", "Rename it.")
    with whole_file(target) as temporary:
        save_figure(figure, temporary)


def _water(system: System) -> float | None:
    return None if system.sea is None else system.sea.water_level
