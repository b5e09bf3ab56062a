"""Tower-top load histories from files: selected channels, moved to the yaw bearing, superposed."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import check_times
from offwind_pin.definitions.rotor_nacelle import RigidBody, lump_rna, rotor_apex
from offwind_pin.definitions.turbine import RigidBodyRNA, RotorNacelleRNA
from offwind_pin.formats.openfast.output import OpenFastOutput
from offwind_pin.formats.openfast.units import ANGLE, FORCE, MOMENT
from offwind_pin.loads.tower_top.load_history import COMPONENTS, LARGEST_LOAD, LoadHistory

_log = logging.getLogger(__name__)

YAW_BEARING = {c: f"YawBr{c}p" for c in COMPONENTS}
"""ElastoDyn's load on the yaw bearing in the frame of the tower top: what rotor and nacelle exert
on it, weight and inertia included."""

ROTOR_APEX = {c: f"RtAero{c}h" for c in COMPONENTS}
"""AeroDyn's load on the rotor, in the hub's frame, which turns with it."""

AZIMUTH = "Azimuth"

_COARSE = 1 / (8 * 1.5)
"""s; interpolation between samples an eighth of a period apart flattens it by 5 %, and the highest
band of interest ends at 1.5 Hz."""


def from_channels(output: OpenFastOutput, channels: Mapping[str, str]) -> LoadHistory:
    """A load history of selected channels; components without a channel are zero.

    channels : by component Fx, Fy, Fz, Mx, My, Mz

    Raises
    ------
    InputError
        An unknown channel or unit; times that do not rise, or leave a gap; loads larger than those
        of any turbine.
    """
    check_times(output.path, output.time, output.place, output.counted)
    load = np.zeros((len(output.time), 6))
    for i, component in enumerate(COMPONENTS):
        if component in channels:
            load[:, i] = output.channel(channels[component], FORCE if i < 3 else MOMENT)
    beyond = np.argwhere(np.abs(load) > LARGEST_LOAD)
    if len(beyond):
        row, column = beyond[0]
        raise InputError(
            f"{output.path}, {output.counted} {output.place[row]}, {COMPONENTS[column]}",
            float(load[row, column]),
            f"loads below {LARGEST_LOAD:g} N or N m",
            "Did the run diverge?",
        )
    names = " ".join(channels[c] for c in COMPONENTS if c in channels)
    origin = f"{output.path.name} ({names}; SHA-256 {output.digest})"
    return LoadHistory(output.time, load, origin)


def from_rotor_apex(
    output: OpenFastOutput, channels: Mapping[str, str], azimuth: str | None, rna: RotorNacelleRNA
) -> LoadHistory:
    """The same for a load at the rotor apex in the hub's frame, moved to the yaw bearing.

    The hub's frame rotates by the azimuth about the tilted shaft; the nacelle faces upwind.
    azimuth : its channel, not needed if only Fx and Mx are given

    Raises
    ------
    InputError
        As :func:`from_channels`; or components across the shaft without an azimuth.
    """
    history = from_channels(output, channels)
    force, moment = history.load[:, :3], history.load[:, 3:]
    if set(channels) - {"Fx", "Mx"}:
        if azimuth is None:
            raise InputError(
                f"{output.path}, channels at the rotor apex",
                ", ".join(sorted(set(channels) - {"Fx", "Mx"})),
                "Fx and Mx, or an azimuth channel as well",
                "The hub's frame rotates about the shaft: give azimuth_channel.",
            )
        angle = output.channel(azimuth, ANGLE)
        force, moment = _turned_back(force, angle), _turned_back(moment, angle)
    apex, shaft = rotor_apex(rna)
    upright = np.array([-shaft[2], 0.0, shaft[0]])
    frame = np.column_stack([shaft, [0.0, 1.0, 0.0], upright])
    force, moment = force @ frame.T, moment @ frame.T
    load = np.hstack([force, moment + np.cross(apex, force)])
    return LoadHistory(history.time, load, history.origin)


def _turned_back(vector: Array, angle: Array) -> Array:
    """(t, 3) components in the shaft's frame of vectors given in a frame rotated about x."""
    cosine, sine = np.cos(angle), np.sin(angle)
    across = cosine * vector[:, 1] - sine * vector[:, 2]
    upright = sine * vector[:, 1] + cosine * vector[:, 2]
    return np.column_stack([vector[:, 0], across, upright])


def carried_body(rna: RigidBodyRNA | RotorNacelleRNA) -> RigidBody:
    """The rotor-nacelle assembly above the yaw bearing, without the bearing itself."""
    if isinstance(rna, RotorNacelleRNA):
        rna = rna.model_copy(update={"yaw_bearing_mass": 0.0})
    return lump_rna(rna)


def weight_at_yaw_bearing(rna: RigidBodyRNA | RotorNacelleRNA, gravity: float) -> Array:
    """(6,) load in N and N m that the weight of rotor and nacelle exerts on the yaw bearing."""
    body = carried_body(rna)
    force = np.array([0.0, 0.0, -body.mass * gravity])
    return np.concatenate([force, np.cross(body.center_of_mass, force)])


def changed(history: LoadHistory, factor: float, shift: float, less: Array | None) -> LoadHistory:
    """A history times a factor and delayed by a shift in s, less a constant load (6,)."""
    if factor == 1 and shift == 0 and less is None:
        return history
    changes = [f"times {factor:g}"] if factor != 1 else []
    changes += [f"{shift:g} s later"] if shift != 0 else []
    changes += ["less the weight of rotor and nacelle"] if less is not None else []
    load = history.load - (0.0 if less is None else less)
    origin = f"{history.origin}, {', '.join(changes)}"
    return LoadHistory(history.time + shift, factor * load, origin, history.surrogate)


def superpose(histories: Sequence[LoadHistory]) -> tuple[LoadHistory, list[str]]:
    """The sum of histories over the time that all of them cover, and notes on what was resampled.

    Where their samples differ, they are interpolated linearly at the times of the finest one.

    Raises
    ------
    InputError
        Histories that have no time in common.
    """
    if len(histories) == 1:
        return histories[0], []
    start = max(history.time[0] for history in histories)
    end = min(history.time[-1] for history in histories)
    if not start < end:
        raise InputError(
            "tower-top load files",
            f"one file starts at {start:g} s, another ends at {end:g} s",
            "files that overlap in time",
            "Check shift_s.",
        )
    finest = min(histories, key=_step)
    inside = finest.time[(finest.time >= start) & (finest.time <= end)]
    time = np.unique(np.concatenate([[start], inside, [end]]))
    notes = []
    for history in histories:
        same = history.time[(history.time >= start) & (history.time <= end)]
        if len(same) != len(time) or not np.allclose(same, time, rtol=0, atol=1e-9):
            notes.append(
                f"{history.origin}: step {_step(history):g} s, interpolated linearly at the times "
                f"of the finest file ({_step(finest):g} s)"
            )
    load = np.sum([history.at(time) for history in histories], axis=0)
    origin = " + ".join(history.origin for history in histories)
    return LoadHistory(time, load, origin), notes


def resampling_notes(history: LoadHistory, dt: float) -> tuple[list[str], list[str]]:
    """Effects of resampling a history at steps of dt s: notes and cautions."""
    step = _step(history)
    notes, cautions = [], []
    if abs(step - dt) > 1e-6 * dt:
        notes.append(
            f"{history.origin}: step {step:g} s, interpolated linearly at steps of {dt:g} s"
        )
    if step > _COARSE:
        cautions.append(
            f"{history.origin}: its step of {step:g} s is coarse; linear interpolation attenuates "
            f"frequencies above {1 / (8 * step):.2g} Hz by more than 5 %"
        )
    if step < dt / 2:
        cautions.append(
            f"{history.origin}: its step of {step:g} s is finer than dt, {dt:g} s; frequencies "
            f"above {0.5 / dt:.3g} Hz are aliased"
        )
    return notes, cautions


def _step(history: LoadHistory) -> float:
    return float(np.median(np.diff(history.time))) if len(history.time) > 1 else np.inf
