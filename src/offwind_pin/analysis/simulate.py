"""Time histories."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
import xarray as xr

from offwind_pin.analysis.drawing_data import drawing_attributes, drawing_data
from offwind_pin.analysis.engines import engine_of, moving_chain
from offwind_pin.analysis.integrators import (
    GeneralizedAlpha,
    Integrator,
    MotionState,
    Records,
    Sections,
    StepFailed,
    first_record,
)
from offwind_pin.analysis.static import static
from offwind_pin.analysis.wave_checks import check_waves, wave_facts
from offwind_pin.base.channels import Channel
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError, InterruptedSimulation, SolverError
from offwind_pin.base.fingerprint import NoFingerprintError, content_hash
from offwind_pin.definitions.engine import Engine
from offwind_pin.dynamics.acting_loads import smooth_ramp
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.ground_motion import GroundMotion, ground_motion_cautions
from offwind_pin.loads.point_load import PointLoad, joined_attributes
from offwind_pin.loads.sea.forces.morison import WAVE_ELEVATION
from offwind_pin.loads.tower_top.load_history import TOWER_TOP_LOAD, LoadHistory, constant_load
from offwind_pin.results.blocks import Block, BlockStore, FolderStore, MemoryStore
from offwind_pin.results.channels import CHANNELS
from offwind_pin.results.dataset import HistoryWriter, versions
from offwind_pin.results.manifest import RESULTS, Simulation, environment, plain
from offwind_pin.results.run_folder import RunFolder
from offwind_pin.results.save_at import SaveAt
from offwind_pin.solvers.steps import MOST_OUTPUTS, FixedStep

_log = logging.getLogger(__name__)

Progress = Callable[[float], None]
Start = Literal["static", "undeformed"]

_DT = 0.02
"""Time step in s."""
_INERTIAL_SHARE = 0.01
"""Of a section load, that structural damping against the inertial frame may have unsaid."""
_BLOCK_SECONDS = 20.0
_BLOCK_STEPS = 2000
"""A block ends with an output and is no longer than either; a killed run loses at most one."""


def simulate(
    system: System,
    duration: float,
    dt: float | None = None,
    loads: Sequence[PointLoad | LoadHistory | Array] = (),
    *,
    ramp: float = 0.0,
    start: Start = "static",
    ground_motion: GroundMotion | None = None,
    integrator: Integrator | None = None,
    engine: Engine | None = None,
    save_at: SaveAt | None = None,
    directory: Path | str | RunFolder | None = None,
    overwrite: bool = False,
    provenance: dict[str, Any] | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Time history under waves and loads, by default by generalised-alpha with a fixed step.

    By default the simulation starts at rest from the static state under the mean loads. During the
    ramp, waves and the departures of the loads from their means increase to their full values.

    Parameters
    ----------
    system : System
    duration : float, s
        Simulated time, the ramp included.
    dt : float, s, optional
        Time step of generalised-alpha, by default 0.02; None with an ``integrator``, which has its
        own steps.
    loads : sequence of PointLoad, LoadHistory or array
        Applied loads: at the yaw bearing a constant load (6,) Fx, Fy, Fz, Mx, My, Mz in N and N m,
        or a history, whose mean is taken over the time after the ramp; or point loads of your own.
    ramp : float
        Duration in s over which waves and fluctuations increase.
    start : {"static", "undeformed"}
        Initial state; with ``"undeformed"`` gravity and mean loads are applied at t = 0.
    ground_motion : GroundMotion, optional
        An earthquake, at its own times whatever the ramp; displacements and accelerations are
        recorded as they are absolutely, not relative to the ground.
    integrator : Integrator, optional
        Method in time with its step policy, by default ``GeneralizedAlpha(FixedStep(dt))``.
    engine : {"compiled", "pinocchio"}, optional
        What evaluates the equations of motion: ``"compiled"``, the default, or ``"pinocchio"``, the
        only one for :class:`SciPyIVP`. What is recorded is evaluated from joint displacements,
        velocities and accelerations by compiled code with either.
    save_at : SaveAt, optional
        What is recorded and when, by default everything at every step.
    directory : Path or str, optional
        Where the results are kept as they come, ``results.nc`` in the end, so that memory does not
        grow with the duration. The same call after a stop resumes the simulation, with bitwise the
        same results; after the end it returns them. A directory with other results, or that another
        process is writing to, is refused.
    overwrite : bool
        Whether earlier results in the directory are replaced instead.
    provenance : dict of str to object, optional
        Additional attributes of the dataset.
    progress : callable, optional
        Called with the simulated time in s.

    Returns
    -------
    Dataset
        ``displacement``, ``acceleration``, ``section_force`` and ``section_moment`` over time and
        height, mudline and tower-top channels, applied load, ``soil_force`` at the soil nodes,
        waves, ground motion, displacements of tuned mass dampers, energies, solver statistics, and
        data for drawing; ``attrs`` has versions, seeds and settings. With a ``directory`` channels
        are read from the file when they are used.

    Raises
    ------
    InputError
        An invalid argument, a history that is too short, waves that would repeat, or a time step
        that is too long for the waves.
    SolverError
        A step did not converge; ``results`` is the dataset so far.
    InterruptedSimulation
        The user stopped the run; ``results`` is the dataset so far.
    """
    save_at = SaveAt() if save_at is None else save_at
    _check_settings(duration, dt, ramp, integrator)
    if start not in get_args(Start):
        raise InputError("start", start, ", ".join(get_args(Start)), "Choose one.")
    if not isinstance(ground_motion, GroundMotion | None):
        raise InputError(
            "ground_motion",
            type(ground_motion).__name__,
            "a GroundMotion or None",
            "Create a GroundMotion.",
        )
    method = integrator or GeneralizedAlpha(FixedStep(_DT if dt is None else dt))
    interval = save_at.output_dt or method.time_step
    if interval is None:
        raise InputError(
            "save_at",
            "no interval of the output",
            f"one in s, as the steps of {type(method).__name__} are not fixed",
            "Give SaveAt(output_dt=...).",
        )
    engine = engine_of(method, engine)
    if duration / interval > MOST_OUTPUTS:
        allowed = f"{MOST_OUTPUTS:.3g} outputs at most"
        raise InputError("output_dt", interval, allowed, "Choose a longer one.")
    outputs = round(duration / interval)
    if abs(outputs * interval - duration) > 1e-6 * duration:
        raise InputError(
            "duration", duration, f"a multiple of the output interval, {interval} s", "Adjust it."
        )
    acting = [_point_load(system, load, ramp, duration) for load in loads]
    chain = moving_chain(system, acting, ramp, ground_motion, engine)
    parts = _segments(system, save_at)
    sections = chain.sections(_recorded_heights(system, save_at, parts), parts)
    q = np.zeros(system.nv)
    if start == "static":
        resting = static(system, loads=acting, engine=engine)
        q, chain.memory = resting.q, resting.memory
    state = method.begin(chain, q, interval)
    check_waves(system, duration, ramp, method.time_step)
    attributes = _provenance(system, chain.acting, ramp, interval, method)
    attributes |= {"engine": engine, "start": start}
    if ground_motion is not None:
        attributes |= _earthquake_attributes(ground_motion, method.time_step or interval, duration)
    attributes |= provenance or {}
    run = {
        **attributes,
        **versions(),
        "duration_s": duration,
    }
    writer = HistoryWriter(
        system.turbine.site.mudline,
        sections[0].height,
        parts,
        [load.name for load in chain.acting],
        np.array([parts[0].stores_energy for parts in chain.parts], dtype=np.bool_),
        attributes,
        drawing_data(system) | _travel(system),
        _ground_levels(system, ground_motion),
        [mass.name for mass in system.chain.tuned_masses],
        chain.soil.height,
        _load_channels(chain.acting),
        save_at.channels,
        inertial_damping=bool(system.structural_loads),
    )
    channels = [channel.name for channel in writer.channels]
    with _run_folder(directory, overwrite=overwrite) as folder:
        store: BlockStore = MemoryStore()
        if folder is not None:
            store = _folder_store(folder, run, chain, sections, channels)
            if folder.state == "complete":
                folder.finish()  # a kill may have left blocks
                return xr.open_dataset(folder.directory / RESULTS, engine="netcdf4")
        if len(store) == 0:
            state, records = first_record(chain, sections, state)
            store.append(_block(chain, writer, state, records))
        try:
            _advance(chain, sections, method, interval, outputs, writer, store, progress)
        except StepFailed as failure:
            if failure.advanced is not None:
                store.append(_block(chain, writer, *failure.advanced))
            joint, size = chain.worst_joint(failure.residual)
            raise SolverError(
                f"the time step did not converge: {failure.reason} (a smaller dt may help)",
                time=failure.time,
                step=failure.number,
                joint=joint,
                residual=size,
                results=writer.write(store, "failed", folder),
            ) from None
        except KeyboardInterrupt:
            raise InterruptedSimulation(
                _state(store.last()).time, writer.write(store, "interrupted", folder)
            ) from None
        if system.structural_loads:
            attributes |= _inertial_share(store, sections[0].height)
        data = writer.write(store, "complete", folder)
        if folder is not None and folder is not directory:
            folder.finish()
    return data


def _advance(
    chain: CompiledChain,
    sections: Sections,
    method: Integrator,
    interval: float,
    outputs: int,
    writer: HistoryWriter,
    store: BlockStore,
    progress: Progress | None,
) -> None:
    """Add blocks until there are so many outputs at an interval in s."""
    cautioned: set[str] = set()
    state = _state(store.last())
    per_block = _outputs_per_block(method, interval)
    done = round(state.time / interval)
    while done < outputs:
        until = min(done + per_block - done % per_block, outputs)
        times = interval * np.arange(done + 1, until + 1, dtype=float)
        state, records = method.advance(chain, sections, state, times)
        store.append(_block(chain, writer, state, records))
        _caution_of_travel(chain.system, records, cautioned)
        done = until
        if progress is not None:
            progress(state.time)


def _caution_of_travel(system: System, records: Records, cautioned: set[str]) -> None:
    """Warn once for each tuned mass damper that exceeds its travel."""
    for d, mass in enumerate(system.chain.tuned_masses):
        way = np.linalg.norm(records["stroke"][:, d], axis=1)
        if mass.name not in cautioned and np.any(way > mass.travel):
            cautioned.add(mass.name)
            first = int(np.argmax(way > mass.travel))
            _log.warning(
                "tuned mass damper %s slides %.3g m at t = %.6g s, more than its travel of %.3g "
                "m; end stops are not modelled",
                mass.name,
                way[first],
                records["time"][first],
                mass.travel,
            )


def _inertial_share(store: BlockStore, height: Array) -> dict[str, Any]:
    """Largest share of inertial damping in a section load at its height, as attributes.

    Largest sizes over time are compared; a share that is worth a caution goes to the log.
    """
    part, whole = np.zeros((2, len(height), 2))
    for block in store:
        load = block["section_load"].reshape(-1, len(height), 2, 3)
        part = np.maximum(part, block["inertial_load"].max(axis=0))
        whole = np.maximum(whole, np.linalg.norm(load, axis=-1).max(axis=0))
    share = np.divide(part, whole, out=np.zeros_like(part), where=whole > 0)
    at, kind = np.unravel_index(np.argmax(share), share.shape)
    largest, what = float(share[at, kind]), ("force", "moment")[int(kind)]
    found: dict[str, Any] = {
        "inertial_damping_share": largest,
        "inertial_damping_share_of": f"section {what} at z = {height[at]:.4g} m",
    }
    if largest > _INERTIAL_SHARE:
        found["inertial_damping_caution"] = (
            f"{100 * largest:.2g} % of the largest {found['inertial_damping_share_of']} is "
            "structural damping against the inertial frame, which a real structure does not have"
        )
        _log.warning("structural damping: %s", found["inertial_damping_caution"])
    return found


def _outputs_per_block(method: Integrator, interval: float) -> int:
    per_output = 1 if method.time_step is None else max(1, round(interval / method.time_step))
    return max(1, min(round(_BLOCK_SECONDS / interval), _BLOCK_STEPS // per_output))


def _recorded_heights(
    system: System, save_at: SaveAt, segments: Sequence[tuple[float, float]]
) -> Array:
    """Heights of the records in increasing order: those given, mudline, top, and segment ends."""
    chain = system.chain
    asked = chain.boundary if save_at.heights is None else np.array(save_at.heights, dtype=float)
    ends = np.array([z for pair in segments for z in pair])
    everything = np.concatenate([asked, [system.turbine.site.mudline, chain.top], ends])
    outside = (everything < chain.base) | (everything > chain.top)
    if np.any(outside):
        raise InputError(
            "heights",
            float(everything[outside][0]),
            f"{chain.base} to {chain.top} m, from the base to the yaw bearing",
            "Choose heights on the structure.",
        )
    rising = np.unique(everything)
    return rising[np.concatenate([[True], np.diff(rising) > 1e-9])]


def _segments(system: System, save_at: SaveAt) -> list[tuple[float, float]]:
    """The segments asked for; by default the whole, and what is above and below the mudline."""
    if save_at.segments is not None:
        return list(save_at.segments)
    chain, mudline = system.chain, system.turbine.site.mudline
    pile = [(chain.base, mudline)] if chain.base < mudline else []
    above = [(mudline, chain.top)]
    return [(chain.base, chain.top), *above, *pile] if pile else above


def _block(
    chain: CompiledChain, writer: HistoryWriter, state: MotionState, records: Records
) -> Block:
    """Records that the writer needs, and the state at their end."""
    time = records["time"]
    shaken = {}
    if chain.ground_motion is not None:
        shaken["ground_motion"] = chain.ground_motion.motion(time)
    found = {
        **_of_whole_loads(chain, records),
        **_load_outputs(chain, time, smooth_ramp(time, chain.ramp_time)),
        **shaken,
    }
    return {name: values for name, values in found.items() if name in writer.records} | {
        f"state_{name}": np.asarray(value) for name, value in state._asdict().items()
    }


def _state(block: Block) -> MotionState:
    """The state at the end of a block."""
    values = {name: block[f"state_{name}"] for name in MotionState._fields}
    return MotionState(
        time=float(values["time"]),
        vectors=values["vectors"],
        memory=values["memory"],
        energy=values["energy"],
        power=values["power"],
        steps=int(values["steps"]),
    )


def _check_settings(
    duration: float, dt: float | None, ramp: float, integrator: Integrator | None
) -> None:
    for name, value in (("duration", duration), ("dt", dt)):
        if value is not None and not (np.isfinite(value) and value > 0):
            raise InputError(name, value, "a positive number of seconds", "Correct it.")
    if dt is not None and integrator is not None:
        raise InputError(
            "dt",
            dt,
            f"None with an integrator ({type(integrator).__name__}), which has its own steps",
            "Leave dt out; SaveAt(output_dt=...) is the interval of the output.",
        )
    if not 0 <= ramp < duration:
        raise InputError("ramp", ramp, f"0 to less than the duration ({duration} s)", "Shorten it.")


def _point_load(
    system: System, load: PointLoad | LoadHistory | Array, ramp: float, duration: float
) -> PointLoad:
    """A given load as a point load on this system."""
    if isinstance(load, np.ndarray):
        return constant_load(system.chain.top, load)
    if isinstance(load, LoadHistory):
        return load.acting(system.chain.top, ramp, duration)
    return load


def _run_folder(
    directory: Path | str | RunFolder | None, *, overwrite: bool
) -> AbstractContextManager[RunFolder | None]:
    """A directory of results, locked for the time of the block; None for results in memory."""
    if directory is None or isinstance(directory, RunFolder):
        return nullcontext(directory)
    return RunFolder(Path(directory), {"kind": "simulation"}, overwrite=overwrite)


def _folder_store(
    folder: RunFolder,
    settings: dict[str, Any],
    chain: CompiledChain,
    sections: Sections,
    channels: Sequence[str],
) -> FolderStore:
    """Blocks in a folder, with those of a stopped run if it was this one.

    Raises
    ------
    InputError
        Results of another simulation, or of one that cannot be compared.
    """
    inputs, unknown = _fingerprints(chain, sections, channels)
    simulation = Simulation(settings=plain(settings), inputs=inputs, environment=environment())
    store = FolderStore(folder, simulation)
    if unknown and len(store):
        raise InputError(
            str(folder.directory),
            "a time history under loads that cannot be compared with those of this run: "
            f"{'; '.join(unknown)}",
            "loads with a fingerprint",
            "Give their classes a method fingerprint() -> str, whose text differs where the forces "
            "differ, or start again with --overwrite (overwrite=True in Python).",
        )
    return store


def _fingerprints(
    chain: CompiledChain, sections: Sections, channels: Sequence[str]
) -> tuple[dict[str, str | None], list[str]]:
    """Hashes of everything that determines the results besides the settings, by name.

    Returns
    -------
    dict of str to str or None
        Hashes; None where there is none.
    list of str
        The reason for each of these.
    """
    root, foundation = chain.system.foundation.root, chain.system.foundation
    found: dict[str, str | None] = {
        "foundation": content_hash(foundation.describe()),
        "structure": content_hash(chain.model.stiffness, chain.model.damping),
        "recorded heights": content_hash(sections[0].height, sections[1].cut),
        "channels": content_hash(list(channels)),
        "ground motion": content_hash(chain.ground_motion),
    }
    described: dict[str, Callable[[], str]] = {
        f"load {number} {load.name}": load.fingerprint
        for number, load in enumerate(chain.acting, 1)
    }
    if root is not None:
        described["root restraint"] = root.fingerprint
    unknown = []
    for name, fingerprint in described.items():
        try:
            found[name] = fingerprint()
        except NoFingerprintError as error:
            found[name] = None
            unknown.append(f"{name} has {error} among its attributes")
    return found, unknown


def _load_channels(loads: Sequence[PointLoad]) -> list[Channel]:
    """Channels of loads, those of one name once, and the two that every run has.

    Raises
    ------
    InputError
        Two different channels of one name.
    """
    found = {channel.name: channel for channel in (TOWER_TOP_LOAD, WAVE_ELEVATION)}
    known = {channel.name: channel for channel in CHANNELS}
    for load in loads:
        for channel in load.channels:
            other = known.get(channel.name) or found.setdefault(channel.name, channel)
            if other != channel:
                raise InputError(
                    f"load {load.name!r}, channel {channel.name!r}",
                    f"{channel.units}, {channel.long_name!r}",
                    f"a name of its own: there is one in {other.units}, {other.long_name!r}",
                    "Rename it.",
                )
    return list(found.values())


def _load_outputs(chain: CompiledChain, time: Array, ramp_factor: Array) -> Block:
    """Channels of the loads that depend on time alone, those of one name summed."""
    found = {
        TOWER_TOP_LOAD.name: np.zeros((len(time), 6)),
        WAVE_ELEVATION.name: np.zeros(len(time)),
    }
    for load in chain.acting:
        for name, values in load.outputs(time, ramp_factor).items():
            found[name] = found[name] + values if name in found else values
    return found


def _of_whole_loads(chain: CompiledChain, records: Records) -> Records:
    """Records with energies summed by load, not by part of a load in compiled code."""
    counts = [len(parts) for parts in chain.parts]
    if len(counts) == sum(counts):
        return records
    begin = np.cumsum([0, *counts[:-1]])
    changed = {}
    for name in ("stored", "dissipated", "worked"):
        own = records[name].shape[1] - sum(counts)
        parts = np.add.reduceat(records[name][:, own:], begin, axis=1)
        changed[name] = np.hstack([records[name][:, :own], parts])
    return records | changed


def _travel(system: System) -> dict[str, tuple[str, Array, dict[str, str]]]:
    """Available travel of the tuned mass dampers; empty without any."""
    dampers = system.chain.tuned_masses
    if not dampers:
        return {}
    about = {"long_name": "available travel of a tuned mass damper", "units": "m"}
    return {"tuned_mass_travel": ("damper", np.array([mass.travel for mass in dampers]), about)}


def _wave_attributes(system: System) -> dict[str, Any]:
    """Attributes of the realised waves; what there is to say of them goes to the log, too."""
    facts = wave_facts(system)
    notes, cautions = facts.pop("notes", []), facts.pop("cautions", [])
    for note in notes:
        _log.info("waves: %s", note)
    for caution in cautions:
        _log.warning("waves: %s", caution)
    attributes = {f"wave_{name}": value for name, value in facts.items()}
    if notes or cautions:
        attributes["wave_notes"] = " | ".join([*notes, *cautions])
    return attributes


def _ground_levels(system: System, motion: GroundMotion | None) -> Array:
    """(D,) heights in m of the ground's recorded motion; none without an earthquake."""
    if motion is None:
        return np.zeros(0)
    return np.array([system.turbine.site.mudline]) if motion.height is None else motion.height


def _earthquake_attributes(motion: GroundMotion, dt: float, duration: float) -> dict[str, str]:
    """Attributes of an earthquake; cautions also go to the log."""
    cautions = ground_motion_cautions(motion, dt, duration)
    for caution in cautions:
        _log.warning("ground motion: %s", caution)
    return {
        "ground_motion_origin": motion.origin,
        "ground_motion_baseline": motion.baseline,
        "ground_motion_cautions": " | ".join(cautions) or "none",
    }


def _provenance(
    system: System, loads: Sequence[PointLoad], ramp: float, interval: float, method: Integrator
) -> dict[str, Any]:
    surrogates = [system.foundation.surrogate, *(load.surrogate for load in loads)]
    return {
        "turbine": system.turbine.name,
        "definition_sha256": system.turbine.content_hash,
        "foundation": system.foundation.name,
        "sea": repr(system.sea) if system.sea else "dry",
        "wave_seed": -1 if system.sea is None else system.sea.wave_seed,
        **_wave_attributes(system),
        **drawing_attributes(system),
        **({"tower_top_load_origin": "none"} | joined_attributes(loads)),
        "surrogates": " | ".join(text for text in surrogates if text) or "none",
        "elements": system.chain.elements,
        "element": "timoshenko" if "px" in system.chain.node_joints else "euler_bernoulli",
        "ramp_s": ramp,
        "output_dt_s": interval,
        **method.describe(),
    }
