"""Running a load case: solve, summarise, write results and report."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import xarray as xr

from offwind_pin.analysis.build import build
from offwind_pin.analysis.drawing_data import outline, told
from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.settling import Settling
from offwind_pin.analysis.simulate import simulate
from offwind_pin.analysis.static import StaticResult, static
from offwind_pin.analysis.tower_drag import tower_drag
from offwind_pin.analysis.wave_checks import wave_facts
from offwind_pin.base.errors import InterruptedSimulation, SolverError
from offwind_pin.base.whole_files import write_json, write_netcdf
from offwind_pin.cases.case import (
    Case,
    ModalAnalysis,
    StaticAnalysis,
    TransientAnalysis,
)
from offwind_pin.cases.identification import (
    identified_variables,
    identify,
    summarise_identified,
)
from offwind_pin.cases.output_directory import check_writable
from offwind_pin.cases.schema.earthquake import Shaking
from offwind_pin.cases.schema.tower_top import SyntheticTowerTopLoad
from offwind_pin.cases.settling import settle, settling_variables, summarise_settling
from offwind_pin.cases.summary import (
    summarise_dampers,
    summarise_damping,
    summarise_modes,
    summarise_run_s_waves,
    summarise_spectrum,
    summarise_static,
)
from offwind_pin.cases.tower_top import generator, rotor_of, tower_top
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.display.report.case_report import write_report
from offwind_pin.display.report.contents import CaseReport, Published, WindDescription
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.description import EarthquakeDescription
from offwind_pin.loads.wind.synthetic_thrust import operate_rotor
from offwind_pin.results.blocks import time_reached
from offwind_pin.results.dataset import versions
from offwind_pin.results.states import modal_dataset, static_dataset
from offwind_pin.signal.modal_identification.identify import IdentifiedModes
from offwind_pin.signal.moment_spectrum import MomentSpectrum, moment_spectrum
from offwind_pin.structure.urdf import definition_hash

Progress = Callable[[float, float], None]


@dataclass(frozen=True)
class CaseResult:
    """What a case gave: the summary, the dataset for NetCDF, and what the report shows."""

    summary: dict[str, Any]
    data: xr.Dataset
    system: System
    modes: ModalResult | None = None
    statics: dict[str, StaticResult] = field(default_factory=dict)
    spectrum: MomentSpectrum | None = None
    rotor: tuple[tuple[str, str], ...] = ()
    earthquake: EarthquakeDescription | None = None
    identified: IdentifiedModes | None = None
    settling: Settling | None = None


def run_case(
    case: Case, folder: Path, out: Path, *, progress: Progress | None = None
) -> dict[str, Any]:
    """Solve a case and write ``summary.json``, ``results.nc`` and ``report.html``.

    Everything the user gave is checked before anything is written. A transient case that was
    stopped goes on where it left off.

    Parameters
    ----------
    folder : where relative paths inside the case start
    out : directory for the results, made if it is not there
    progress : called with simulated time and duration in s

    Returns
    -------
    The summary.

    Raises
    ------
    InputError : something in the case cannot be used
    SolverError, InterruptedSimulation : the solve stopped; the results so far are in ``out``
    """
    check_writable(out)
    turbine = _turbine(case, folder)
    begun = time_reached(out)
    clock = time.perf_counter()
    try:
        result = _solve(case, turbine, folder, out, progress)
    except (SolverError, InterruptedSimulation) as stopped:
        _write_partial(case, out, stopped, time.perf_counter() - clock, begun)
        raise
    wall = time.perf_counter() - clock
    summary = _head(case, "complete", wall, result.summary.pop("simulated_s", 0.0), begun)
    summary |= result.summary | {"structural_damping": summarise_damping(result.system)}
    _write(case, turbine, out, replace(result, summary=summary))
    return summary


def _solve(
    case: Case, turbine: Turbine, folder: Path, out: Path, progress: Progress | None
) -> CaseResult:
    if isinstance(case.analysis, StaticAnalysis):
        return _solve_static(case, turbine, case.analysis, folder, progress)
    if isinstance(case.analysis, ModalAnalysis):
        return _solve_modes(case, turbine, case.analysis, folder, progress)
    return _solve_transient(case, turbine, case.analysis, folder, out, progress)


def _solve_static(
    case: Case,
    turbine: Turbine,
    analysis: StaticAnalysis,
    folder: Path,
    progress: Progress | None,
) -> CaseResult:
    system = _build(case, turbine, case.foundation, folder)
    state = static(system, engine=analysis.engine)
    summary = summarise_static(state) | {"foundation": case.foundation}
    statics: dict[str, StaticResult] = {case.foundation: state}
    if analysis.compare_with is not None:
        other = static(_build(case, turbine, analysis.compare_with, folder), engine=analysis.engine)
        reference = float(other.tower_top_displacement[0])
        statics[analysis.compare_with] = other
        summary[f"{analysis.compare_with}_tower_top_x_m"] = reference
        if reference != 0:
            increase = float(state.tower_top_displacement[0]) / reference - 1
            summary[f"increase_over_{analysis.compare_with}_percent"] = 100 * increase
    data = static_to_dataset(system, state)
    settling = None
    if analysis.settle is not None:
        settling = settle(system, state, analysis.settle, progress)
        summary |= summarise_settling(settling)
        data = data.assign(settling_variables(settling))
    return CaseResult(summary, data, system, None, statics, settling=settling)


def _solve_modes(
    case: Case,
    turbine: Turbine,
    analysis: ModalAnalysis,
    folder: Path,
    progress: Progress | None,
) -> CaseResult:
    system = _build(case, turbine, case.foundation, folder)
    state = static(system, engine=analysis.engine)
    result = modes(system, analysis.count, state, engine=analysis.engine)
    table = summarise_modes(result)
    summary: dict[str, Any] = {"foundation": case.foundation, "modes": table}
    summary |= _frequencies(result)
    summary |= {
        f"{row['label']}_peak_height_ratio": row["shape_peak_height_ratio"] for row in table
    }
    summary |= summarise_static(state)
    data = modes_to_dataset(system, result)
    identified = None
    if analysis.identify is not None:
        identified = identify(system, result, analysis.identify, case.seed, progress)
        summary |= summarise_identified(identified)
        data = data.assign(identified_variables(identified))
    statics = {case.foundation: state}
    return CaseResult(summary, data, system, result, statics, identified=identified)


def _solve_transient(
    case: Case,
    turbine: Turbine,
    analysis: TransientAnalysis,
    folder: Path,
    out: Path,
    progress: Progress | None,
) -> CaseResult:
    system = _build(case, turbine, case.foundation, folder, analysis.duration)
    top = tower_top(case, turbine, analysis, folder)
    shaking = None
    if case.earthquake is not None:
        gravity = turbine.site.gravity
        shaking = Shaking.of(case.earthquake, folder, gravity, analysis.dt, analysis.duration)
    wind = [] if case.tower_wind is None else [tower_drag(system, case.tower_wind.wind())]
    data = simulate(
        system,
        analysis.duration,
        analysis.dt,
        [*top.loads, *wind],
        ramp=analysis.ramp,
        ground_motion=None if shaking is None else shaking.motion,
        engine=analysis.engine,
        output_dt=analysis.output_dt,
        directory=out,
        provenance={"case": case.name, "seed": case.seed, **top.provenance},
        progress=None if progress is None else lambda now: progress(now, analysis.duration),
    )
    state = static(system, top.mean, loads=wind, engine=analysis.engine)
    result = modes(system, min(8, system.nv), state, engine=analysis.engine)
    marked = _marked(case, result, top.blade_passing_frequency)
    spectrum = moment_spectrum(data, analysis.psd_segment, marked)
    summary = summarise_spectrum(data, spectrum)
    summary |= {
        "simulated_s": analysis.duration,
        "foundation": case.foundation,
        "seed": case.seed,
        "mudline_moment_y_static_under_mean_loads_Nm": float(state.mudline_load[4]),
        "natural_frequencies_hz": dict(
            zip(result.label, result.frequency_hz.tolist(), strict=True)
        ),
        "modes": summarise_modes(result),
        **_frequencies(result),
        "steps": round(analysis.duration / analysis.dt),
        "mean_iterations": float(data["solver_iterations"][1:].mean()),
        "largest_residual": float(data["solver_residual"].max()),
        **summarise_dampers(data),
        **top.summary(system, result, state),
        **({} if shaking is None else {"earthquake": shaking.summary(result)}),
    }
    waves = wave_facts(system)
    if waves:
        summary["waves"] = waves | summarise_run_s_waves(data)
    described = None if shaking is None else shaking.description(result)
    statics = {case.foundation: state}
    return CaseResult(summary, data, system, result, statics, spectrum, top.facts, described)


def _frequencies(result: ModalResult) -> dict[str, float]:
    """Natural frequencies by keys such as ``FA1_hz``, for published values to name."""
    return {
        f"{label}_hz": float(frequency)
        for label, frequency in zip(result.label, result.frequency_hz, strict=True)
    }


def _build(
    case: Case, turbine: Turbine, foundation: str, folder: Path, duration: float = 0.0
) -> System:
    """The case's system on a foundation; only distributed springs have a pile to divide."""
    elements = case.elements
    if isinstance(elements, dict) and foundation != "distributed_springs":
        elements = {region: count for region, count in elements.items() if region != "pile"}
    sea = case.sea.sea(case.seed, duration, folder)
    return build(turbine, foundation, sea, elements=elements, element=case.element)


def _marked(case: Case, result: ModalResult, passing: float | None) -> dict[str, float]:
    """Frequencies in Hz that a reader looks for in the spectrum, by name."""
    marked = {}
    if case.sea.marked_frequency is not None:
        marked["wave"] = case.sea.marked_frequency
    for label in ("FA1", "FA2"):
        if label in result.label:
            marked[label] = float(result.frequency_hz[result.index(label)])
    if passing is not None:
        for order in (1, 2, 3):
            marked[f"{3 * order}P"] = order * passing
    return marked


def static_to_dataset(system: System, state: StaticResult) -> xr.Dataset:
    """A static state with its provenance."""
    return static_dataset(
        state.height,
        displacement=state.displacement,
        rotation=state.rotation,
        section_load=state.section_load,
        attributes=_attributes(system)
        | {
            "engine": state.engine,
            "iterations": state.iterations,
            "residual": state.residual,
        },
    )


def modes_to_dataset(system: System, result: ModalResult) -> xr.Dataset:
    """Natural modes with their provenance, and what a picture of them needs."""
    return modal_dataset(
        result.height,
        result.label,
        frequency_hz=result.frequency_hz,
        damping_ratio=result.damping_ratio,
        shape=result.shape,
        mass_normalised=result.mass_normalised,
        attributes=_attributes(system) | told(system) | {"engine": result.engine},
        constants=outline(system),
    )


def _attributes(system: System) -> dict[str, Any]:
    return {
        "turbine": system.turbine.name,
        "definition_sha256": definition_hash(system.turbine),
        "foundation": system.foundation.name,
        "sea": repr(system.sea) if system.sea else "dry",
        "surrogates": system.foundation.surrogate or "none",
        "elements": system.chain.elements,
    }


def _head(case: Case, status: str, wall: float, simulated: float, begun: float) -> dict[str, Any]:
    """First keys of a summary; a run that went on from ``begun`` seconds did the rest only."""
    return {
        "case": case.name,
        "status": status,
        "wall_s": wall,
        "simulated_s": simulated,
        "realtime_factor": max(simulated - begun, 0.0) / wall,
        **({"resumed_at_s": begun} if begun > 0 else {}),
        **versions(),
    }


def _write(case: Case, turbine: Turbine, out: Path, result: CaseResult) -> None:
    histories = result.data if isinstance(case.analysis, TransientAnalysis) else None
    report = CaseReport(
        name=case.name,
        title=case.title or case.name,
        description=case.description,
        system=result.system,
        summary=result.summary,
        modes=result.modes,
        statics=result.statics,
        histories=histories,
        published=tuple(
            Published(row.quantity, row.value, row.unit, row.source or "", _ours(result, row.key))
            for row in case.published
        ),
        wind=_wind_report(case, turbine),
        psd=result.spectrum,
        rotor=result.rotor,
        earthquake=result.earthquake,
        identified=result.identified,
        settling=result.settling,
    )
    # The summary is written last, so that where it stands the other files belong to it.
    (out / "summary.json").unlink(missing_ok=True)
    if histories is None:
        write_netcdf(out / "results.nc", result.data.assign_attrs(case=case.name))
    write_report(out / "report.html", report)
    write_json(out / "summary.json", result.summary)


def _wind_report(case: Case, turbine: Turbine) -> WindDescription | None:
    load = case.tower_top_load
    if not isinstance(load, SyntheticTowerTopLoad):
        return None
    rotor = operate_rotor(rotor_of(turbine), load.wind_speed, load.blade_passing_frequency)
    return WindDescription(generator(case, load), rotor)


def _write_partial(
    case: Case,
    out: Path,
    stopped: SolverError | InterruptedSimulation,
    wall: float,
    begun: float,
) -> None:
    """A summary that says so of a stopped run; its histories so far stand in ``results.nc``."""
    status = "failed" if isinstance(stopped, SolverError) else "interrupted"
    (out / "report.html").unlink(missing_ok=True)
    if stopped.results is None:
        (out / "results.nc").unlink(missing_ok=True)
    reached = 0.0 if stopped.results is None else float(stopped.results["time"][-1])
    head = _head(case, status, wall, reached, begun)
    write_json(out / "summary.json", head | {"message": str(stopped)})


def _turbine(case: Case, folder: Path) -> Turbine:
    """The case's turbine; a relative path starts at the case file."""
    local = folder / case.turbine
    return load_turbine(local if local.is_file() else case.turbine)


def _ours(result: CaseResult, key: str) -> float | None:
    """A number of the summary; None where there is none of that key."""
    value = result.summary.get(key)
    return float(value) if isinstance(value, int | float) else None
