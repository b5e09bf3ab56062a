"""Running a load case: solve, then write results, summary and report."""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.drawing_data import (
    damping_dataset,
    modes_dataset,
    soil_dataset,
    static_dataset,
    structure_dataset,
)
from offwind_pin.analysis.foundation.study.state import soil_displacement_reached, soil_springs
from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.sea_data import waves_dataset
from offwind_pin.analysis.simulate import simulate
from offwind_pin.analysis.static import StaticResult, static
from offwind_pin.base.errors import InterruptedSimulation, SolverError
from offwind_pin.base.whole_files import add_groups, write_json, write_netcdf, write_text
from offwind_pin.cases.case import (
    Case,
    ModalAnalysis,
    StaticAnalysis,
    TransientAnalysis,
    load_case,
)
from offwind_pin.cases.earthquake import CaseEarthquake, earthquake_dataset
from offwind_pin.cases.identification import identify
from offwind_pin.cases.output_directory import check_writable
from offwind_pin.cases.report import report as render
from offwind_pin.cases.settling import settle
from offwind_pin.cases.tower_top import tower_top, wind_dataset
from offwind_pin.cases.tree_summary import summary, summary_head
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.results.dataset import versions
from offwind_pin.results.inventory import add_inventory
from offwind_pin.results.manifest import REPORT, RESULTS, SUMMARY, State
from offwind_pin.results.reading import analysed, open_case
from offwind_pin.results.run_folder import RunFolder
from offwind_pin.results.save_at import SaveAt
from offwind_pin.results.tree import prefixed
from offwind_pin.signal.moment_spectrum import moment_spectrum

_log = logging.getLogger(__name__)

Progress = Callable[[float, float], None]
Groups = dict[str, xr.Dataset | None]


@dataclass(frozen=True)
class _Solved:
    """Results of a solve.

    Attributes
    ----------
    root : Dataset or None
        Main dataset; None for time histories, which are already in their file.
    groups : Groups
        Datasets by path in the tree; None where the case has none.
    simulated : float, s
    """

    root: xr.Dataset | None
    groups: Groups
    simulated: float = 0.0


def run_case(
    case: Case | str | Path,
    out: Path | str,
    *,
    report: bool = True,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> dict[str, Any]:
    """Solve a case and write ``results.nc``, ``report.html`` and ``summary.json``.

    All input is checked before anything is written. If ``out`` contains the finished results of the
    same case from the same version, nothing is solved. A transient case that was stopped is
    continued from the last block in ``out``.

    Parameters
    ----------
    case : Case, str or Path
        A case, the name of a shipped one, or the path of a YAML file.
    out : Path or str
        Directory for the results, created if necessary.
    report : bool
        Whether to write ``report.html``; ``offwind report`` makes it later.
    overwrite : bool
        Whether earlier results in ``out`` are replaced.
    progress : callable, optional
        Called with simulated time and duration, in s.

    Returns
    -------
    dict of str to object
        The content of ``summary.json``.

    Raises
    ------
    InputError
        Something in the case cannot be used; or ``out`` contains results of another case or files
        of other origin with the names of the results, or another run is writing to it.
    SolverError, InterruptedSimulation
        The solve stopped; the results so far are in ``out``.
    OSError
        The disk is full, or ``out`` was removed.
    """
    out = Path(out)
    check_writable(out)
    if not isinstance(case, Case):
        case = load_case(case)
    run = {
        "kind": "case",
        "case": case.name,
        "seed": case.seed,
        "content_hash": case.content_hash,
        "offwind_pin_version": versions()["offwind_pin_version"],
    }
    with RunFolder(out, run, overwrite=overwrite) as folder:
        try:
            if folder.state == "complete":
                _log.info("%s: already complete", out)
            elif folder.state != "solved":
                _solve_and_write(case, folder, progress)
            return _finish(folder, report=report)
        except OSError:
            if folder.manifest is not None and out.is_dir():
                _log.error("results so far are kept in %s; the same run continues from them", out)
            raise


def _solve_and_write(case: Case, folder: RunFolder, progress: Progress | None) -> None:
    """Leave all groups in ``results.nc``."""
    begun = folder.time_reached
    clock = time.perf_counter()
    system = None
    try:
        system = case.build()
        solved = _solve(case, system, folder, progress)
    except (SolverError, InterruptedSimulation) as stopped:
        wall = time.perf_counter() - clock
        _write_stopped(case, system, folder, stopped, wall, begun)
        raise
    wall = time.perf_counter() - clock
    for name in (SUMMARY, REPORT):  # of this run when it was interrupted
        folder.remove(name)
    account = _case_dataset(case, "complete", wall, solved.simulated, begun)
    with folder.replacing(RESULTS) as path:
        if solved.root is not None:
            write_netcdf(path, solved.root.assign_attrs(case=case.name))
        _add_groups(path, {"case": account, **_description(case, system), **solved.groups})
    folder.update(state="solved")


def _finish(folder: RunFolder, *, report: bool) -> dict[str, Any]:
    """Write what is made of the results, and remove the blocks; returns the summary."""
    directory = folder.directory
    missing = [name for name in (SUMMARY, REPORT) if not (directory / name).exists()]
    if folder.state == "solved" or SUMMARY in missing or (report and REPORT in missing):
        with open_case(directory) as tree:
            found = summary(tree)
            page = render(tree) if report else None
        if page is not None:
            with folder.replacing(REPORT) as path:
                write_text(path, page)
        with folder.replacing(SUMMARY) as path:
            write_json(path, found)
    folder.finish()
    return dict(json.loads((directory / SUMMARY).read_bytes()))


def _solve(case: Case, system: System, folder: RunFolder, progress: Progress | None) -> _Solved:
    if isinstance(case.analysis, StaticAnalysis):
        return _solve_static(case, system, case.analysis, progress)
    if isinstance(case.analysis, ModalAnalysis):
        return _solve_modes(case, system, case.analysis, progress)
    return _solve_transient(case, system, case.analysis, folder, progress)


def _solve_static(
    case: Case, system: System, analysis: StaticAnalysis, progress: Progress | None
) -> _Solved:
    state = static(system, engine=analysis.engine)
    groups: Groups = {"soil": _soil(system, state)}
    if analysis.compare_with is not None:
        other = case.build(analysis.compare_with)
        compared = static(other, engine=analysis.engine)
        groups[f"static/{analysis.compare_with}"] = static_dataset(other, compared)
    simulated = 0.0
    if analysis.settle is not None:
        settling = settle(system, state, analysis.settle, progress)
        groups["settling"] = settling
        simulated = float(settling["time"][-1])
    return _Solved(static_dataset(system, state), groups, simulated)


def _solve_modes(
    case: Case, system: System, analysis: ModalAnalysis, progress: Progress | None
) -> _Solved:
    state = static(system, engine=analysis.engine)
    result = modes(system, analysis.count, state, engine=analysis.engine)
    groups: Groups = {
        f"static/{case.foundation}": static_dataset(system, state),
        "soil": _soil(system, state),
    }
    simulated = 0.0
    if analysis.identify is not None:
        identified = identify(system, result, analysis.identify, case.seed, progress)
        groups["identified_modes"] = identified
        simulated = float(identified.attrs["simulated_s"])
    return _Solved(modes_dataset(system, result), groups, simulated)


def _solve_transient(
    case: Case,
    system: System,
    analysis: TransientAnalysis,
    folder: RunFolder,
    progress: Progress | None,
) -> _Solved:
    turbine = case.turbine
    top = tower_top(case, turbine, analysis)
    shaking = None
    if case.earthquake is not None:
        gravity = turbine.site.gravity
        shaking = CaseEarthquake.of(case.earthquake, gravity, analysis.dt, analysis.duration)
    others = [load.on(system) for load in case.loads.values()]
    data = simulate(
        system,
        analysis.duration,
        analysis.dt,
        [*top.loads, *others],
        ramp=analysis.ramp,
        ground_motion=None if shaking is None else shaking.motion,
        engine=analysis.engine,
        save_at=SaveAt(analysis.output_dt),
        directory=folder,
        provenance={"case": case.name, "seed": case.seed, **top.provenance},
        progress=None if progress is None else lambda now: progress(now, analysis.duration),
    )
    with data:
        state = static(system, top.mean, loads=others, engine=analysis.engine)
        result = modes(system, min(8, system.nv), state, engine=analysis.engine)
        marked = _marked(system.sea, result, top.blade_passing_frequency)
        spectrum = moment_spectrum(data, analysis.psd_segment, marked)
        groups: Groups = {
            f"static/{case.foundation}": static_dataset(system, state),
            "modes": modes_dataset(system, result),
            "spectrum": spectrum.to_dataset(),
            "soil": _soil(system, state, data),
            "waves": waves_dataset(system, data, analysis.psd_segment),
            "tower_top": top.dataset(),
            "wind": wind_dataset(case, turbine),
            "rotor": top.rotor_dataset(system, result, state),
            "earthquake": None if shaking is None else earthquake_dataset(shaking, result),
        }
    return _Solved(None, groups, analysis.duration)


def _soil(
    system: System, state: StaticResult | None, histories: xr.Dataset | None = None
) -> xr.Dataset | None:
    """Soil curves with the displacements reached after the ramp, or in the static state."""
    soil = soil_springs(system)
    if soil is None:
        return None
    reached = None
    if histories is not None and analysed(histories).sizes["time"] > 1:
        reached = soil_displacement_reached(histories, soil)
    elif state is not None:
        size = np.hypot(*state.displacement[:, :2].T)
        reached = np.interp(soil.height, state.height, size)
    return soil_dataset(soil, system.turbine.site.mudline, reached)


def _marked(sea: Sea | None, result: ModalResult, passing: float | None) -> dict[str, float]:
    """Frequencies in Hz to mark in the spectrum, by name."""
    marked = {}
    if sea is not None and sea.marked_frequency is not None:
        marked["wave"] = sea.marked_frequency
    for label in ("FA1", "FA2"):
        if label in result.label:
            marked[label] = float(result.frequency_hz[result.index(label)])
    if passing is not None:
        for order in (1, 2, 3):
            marked[f"{3 * order}P"] = order * passing
    return marked


def _description(case: Case, system: System) -> Groups:
    """Description of a case, without a solve."""
    return {
        "structure": structure_dataset(system),
        "structural_damping": damping_dataset(system),
        "published": _published_dataset(case),
    }


def _case_dataset(
    case: Case, status: str, wall: float, simulated: float, begun: float
) -> xr.Dataset:
    """The definition and a record of the run, which continued from ``begun`` seconds."""
    definition = {
        "definition": json.dumps(case.model_dump(mode="json", by_alias=True)),
        "content_hash": case.content_hash,
    }
    account = {
        "status": status,
        "wall_s": wall,
        "simulated_s": simulated,
        "resumed_at_s": begun,
    }
    texts = {name: getattr(case, name) for name in ("name", "title", "description", "foundation")}
    steps = {}
    if isinstance(case.analysis, TransientAnalysis):
        steps["steps"] = round(case.analysis.duration / case.analysis.dt)
    return xr.Dataset(
        attrs={
            **texts,
            "analysis": case.analysis.kind,
            "seed": case.seed,
            **account,
            **steps,
            **versions(),
            **definition,
        }
    )


def _published_dataset(case: Case) -> xr.Dataset | None:
    """Published values and the key of the summary that each is compared with."""
    rows = case.published
    if not rows:
        return None
    texts = {
        "quantity": [row.quantity for row in rows],
        "key": [row.key for row in rows],
        "unit": [row.unit for row in rows],
        "origin": [row.source or "" for row in rows],
    }
    data = xr.Dataset(
        {name: ("row", values, {"long_name": name}) for name, values in texts.items()}
    )
    about = {"long_name": "published value", "units": "as in the variable unit"}
    return data.assign(value=("row", [row.value for row in rows], about))


def _add_groups(path: Path, groups: Groups) -> None:
    """Add all groups of the case; their dimensions are prefixed with the group's name."""
    there = {name: prefixed(data, name) for name, data in groups.items() if data is not None}
    add_groups(path, there, add_inventory)


def _write_stopped(
    case: Case,
    system: System | None,
    folder: RunFolder,
    stopped: SolverError | InterruptedSimulation,
    wall: float,
    begun: float,
) -> None:
    """Summary and results of a run that stopped; its histories so far are in ``results.nc``."""
    status: State = "failed" if isinstance(stopped, SolverError) else "interrupted"
    folder.remove(REPORT)
    histories = stopped.results if isinstance(case.analysis, TransientAnalysis) else None
    reached = 0.0 if stopped.results is None else float(stopped.results["time"][-1])
    account = _case_dataset(case, status, wall, reached, begun)
    account.attrs["message"] = str(stopped)
    if histories is None or system is None:
        folder.remove(RESULTS)
    else:
        soil = _soil(system, None, histories)
        groups = {"case": account, **_description(case, system), "soil": soil}
        with folder.replacing(RESULTS) as path:
            _add_groups(path, groups)
    with folder.replacing(SUMMARY) as path:
        write_json(path, summary_head(account.attrs))
    folder.update(state=status)
