"""Figures of results, in one style with colours for any kind of colour vision.

Each function takes the result of an analysis and returns a ``matplotlib.figure.Figure``, which
:func:`save` writes.

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
    """Unit-peak mode shapes over height, one panel per family.

    Parameters
    ----------
    system : System
    modes : ModalResult
        Modes of the system.

    Returns
    -------
    Figure
    """
    return pictures.mode_shapes(modes, system.turbine.site.mudline, water=_water(system))


def static_states(system: System, states: Mapping[str, StaticResult]) -> Figure:
    """Deflected shapes and section moments of static states over height, by name.

    Parameters
    ----------
    system : System
    states : mapping of str to StaticResult
        States by name in the legend.

    Returns
    -------
    Figure
    """
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
        Length of Welch's windows.

    Returns
    -------
    Figure

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
    """Smallest, mean and largest section loads over height after the ramp.

    Parameters
    ----------
    results : Dataset
        Of :func:`simulate`.

    Returns
    -------
    Figure
    """
    return pictures.section_load_envelope(results)


def time_histories(results: xr.Dataset) -> Figure:
    """Waves, tower top and moment at the mudline over time.

    Parameters
    ----------
    results : Dataset
        Of :func:`simulate`.

    Returns
    -------
    Figure
    """
    return pictures.time_histories(results)


def p_y_utilisation(system: System, state: StaticResult | xr.Dataset) -> Figure:
    """Displacement, secant stiffness and utilisation of the p-y springs along the pile.

    Parameters
    ----------
    system : System
    state : StaticResult or Dataset
        Static state, or time histories, of which the largest displacements are used.

    Returns
    -------
    Figure

    Raises
    ------
    InputError
        The system has no p-y springs, or the run has no records along the pile.
    """
    soil = soil_springs(system)
    if soil is None:
        raise InputError(
            "p_y_utilisation, system",
            f"foundation {system.foundation.name}",
            "distributed_springs",
            "Build the turbine on distributed_springs.",
        )
    if isinstance(state, StaticResult):
        reached = reached_statically(system, soil, state)
    elif float(state["height"].min()) <= float(soil.height.min()) + 1e-6:
        reached = soil_displacement_reached(state, soil)
    else:
        low = float(state["height"].min())
        allowed = f"heights down to the toe (z = {soil.height.min():g} m)"
        raise InputError(
            "p_y_utilisation, state",
            f"a run recorded down to z = {low:g} m",
            allowed,
            "Add heights.",
        )
    found = SoilState.of(soil.curves, reached, "")
    initial = soil.curves.secant(np.zeros(len(reached)))
    depth = system.turbine.site.mudline - soil.height
    return soil_plots.state_over_depth(
        depth, found.displacement, found.secant, initial, found.utilisation
    )


def singular_values(modes: OperationalModes, *, highest: float | None = None) -> Figure:
    """All singular values of the accelerations' cross-spectra over frequency.

    Parameters
    ----------
    modes : OperationalModes
    highest : float, Hz, optional
        End of the frequency axis; by default three times the highest identified frequency.

    Returns
    -------
    Figure
    """
    return singular_value_plot(modes, highest)


def save(figure: Figure, path: Path | str) -> None:
    """Write a figure atomically, as ``.svg``, ``.pdf`` or ``.png``.

    Parameters
    ----------
    figure : Figure
    path : Path or str
        File with the ending of a format, such as ``.png``.

    Raises
    ------
    InputError
        Another suffix.
    """
    target = Path(path)
    if target.suffix.lower() not in FORMATS:
        raise InputError(
            "save, path", target.name, f"a name ending in {', '.join(FORMATS)}", "Rename it."
        )
    with whole_file(target) as temporary:
        save_figure(figure, temporary)


def _water(system: System) -> float | None:
    return None if system.sea is None else system.sea.water_level
