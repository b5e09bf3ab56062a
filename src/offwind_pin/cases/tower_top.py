"""From a case's tower-top load to what acts in the simulation, and what is told about it."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from offwind_pin.analysis.aerodynamic_damping import thrust_damping
from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.cases.case import Case, TransientAnalysis
from offwind_pin.cases.schema.tower_top import LoadFile, TowerTopLoadFile
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.definitions.turbine import RotorNacelleRNA, Turbine
from offwind_pin.display.wording import number, quantity
from offwind_pin.dynamics.system import System
from offwind_pin.formats.openfast.output import read_openfast_output
from offwind_pin.formats.openfast.warnings import load_cautions
from offwind_pin.formats.openfast.yaw_bearing_load import (
    AZIMUTH,
    ROTOR_APEX,
    YAW_BEARING,
    changed,
    from_channels,
    from_rotor_apex,
    resampling_notes,
    superpose,
    weight_at_yaw_bearing,
)
from offwind_pin.loads.tower_top.load_history import LoadHistory, read_load_history
from offwind_pin.loads.wind.rotor_load import RotorLoad
from offwind_pin.loads.wind.rotor_thrust import RotorThrust
from offwind_pin.loads.wind.thrust_table import ThrustTable, inflow_time

_log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class TowerTop:
    """What acts at the tower top.

    Attributes
    ----------
    acting : a history, a rotor, or nothing
    mean : (6,) load at the yaw bearing that acts from the start, in N and N m, or None
    blade_passing_frequency : in Hz, or None
    notes, cautions : what was done to the user's numbers, and what looks wrong with them
    """

    acting: LoadHistory | RotorThrust | None = None
    mean: Array | None = None
    blade_passing_frequency: float | None = None
    notes: list[str] = field(default_factory=list)
    cautions: list[str] = field(default_factory=list)

    @property
    def loads(self) -> list[Any]:
        """For :func:`simulate`."""
        return [] if self.acting is None else [self.acting]

    @property
    def provenance(self) -> dict[str, Any]:
        """Attributes for the results."""
        told = {}
        if isinstance(self.acting, RotorThrust):
            thrust = self.acting
            source = thrust.disc.rotor.thrust_coefficient.source or thrust.disc.rotor.source
            told["tower_top_load_origin"] = (
                f"rotor thrust, {thrust.control} control; {thrust.wind.origin}; thrust "
                f"coefficient: {source or 'the user'}"
            )
            told["tower_top_load_holds"] = "prescribed loads; a rotor's thrust is not among them"
        if self.notes or self.cautions:
            told["tower_top_load_notes"] = " | ".join([*self.notes, *self.cautions])
        return told

    @property
    def facts(self) -> tuple[tuple[str, str], ...]:
        """Name and value of what a report tells of a running rotor."""
        if not isinstance(self.acting, RotorThrust) or self.mean is None:
            return ()
        thrust, mean = self.acting, self.acting.wind.mean
        disc = thrust.disc
        control = f"{thrust.control}"
        if thrust.control == "lagged":
            control += f", time constant {quantity(thrust.control_time, 's')}"
        wake = "in equilibrium"
        if thrust.inflow_lag:
            wake = f"lags, time constant {quantity(inflow_time(disc, mean), 's', 3)}"
        coefficient = ThrustTable(disc).coefficient(mean)[0]
        return (
            ("mean wind at the hub", quantity(mean, "m/s")),
            (
                "standard deviation of the rotor-effective wind",
                quantity(float(np.std(thrust.wind.speed)), "m/s", 3),
            ),
            ("thrust coefficient", number(coefficient, 3)),
            ("mean thrust", quantity(float(np.linalg.norm(self.mean[:3])) / 1e6, "MN")),
            ("blade-passing frequency", quantity(self.blade_passing_frequency or 0.0, "Hz", 3)),
            ("controller", control),
            ("wake", wake),
            ("wind", thrust.wind.origin),
        )

    def summary(self, system: System, found: ModalResult, state: StaticResult) -> dict[str, Any]:
        """Keys for ``summary.json``; the modes are those about the mean load."""
        told: dict[str, Any] = {}
        if self.notes or self.cautions:
            told |= {"tower_top_load_notes": self.notes, "tower_top_load_cautions": self.cautions}
        if not isinstance(self.acting, RotorThrust) or self.mean is None:
            return told
        ratio = thrust_damping(system, self.acting, found, state)
        for label, aerodynamic, own in zip(found.label, ratio, found.damping_ratio, strict=True):
            if aerodynamic + own < 0:
                _log.warning(
                    "mode %s is fed by the thrust: its damping ratio is %.4f, of which %.4f is "
                    "aerodynamic; it will grow",
                    label,
                    aerodynamic + own,
                    aerodynamic,
                )
        return told | {
            "mean_thrust_N": float(np.linalg.norm(self.mean[:3])),
            "aerodynamic_damping": [
                {"label": label, "ratio": float(value)}
                for label, value in zip(found.label, ratio, strict=True)
            ],
        }


def tower_top(case: Case, turbine: Turbine, analysis: TransientAnalysis) -> TowerTop:
    """What acts at the tower top in a case.

    Raises
    ------
    InputError : a file, or a part of the turbine, that cannot be used
    """
    load = case.tower_top_load
    if load is None:
        return TowerTop()
    if isinstance(load, RotorLoad):
        return _rotor(case, load, turbine, analysis)
    if isinstance(load, TowerTopLoadFile):
        return _files(load, turbine, analysis)
    history = load.completed(case.seed).generate(
        rotor_of(turbine),
        duration=analysis.duration,
        repeat_period=analysis.duration - analysis.ramp,
    )
    mean = history.mean(analysis.ramp, analysis.duration)
    return TowerTop(history, mean, load.blade_passing_frequency)


def _rotor(case: Case, load: RotorLoad, turbine: Turbine, analysis: TransientAnalysis) -> TowerTop:
    disc = rotor_disc(turbine)
    settings = load.completed(case.seed)
    wind = settings.generate(disc, repeat_period=analysis.duration - analysis.ramp)
    thrust = RotorThrust(disc, wind, load.control, load.control_time, load.inflow_lag)
    passing = settings.of_rotor(disc).blade_passing_frequency
    return TowerTop(thrust, thrust.steady_load(), passing)


def _files(load: TowerTopLoadFile, turbine: Turbine, analysis: TransientAnalysis) -> TowerTop:
    histories, cautions = [], []
    gravity = turbine.site.gravity
    for entry in load.entries:
        if load.reads_openfast(entry):
            read = _read_openfast(entry, turbine)
        else:
            read = read_load_history(entry.file)
        weight = weight_at_yaw_bearing(turbine.rna, gravity) if entry.subtract_weight else None
        history = changed(read, entry.factor, entry.shift, weight)
        cautions += load_cautions(history, turbine.rna, gravity)
        histories.append(history)
    history, notes = superpose(histories)
    more, coarse = resampling_notes(history, analysis.dt)
    notes, cautions = notes + more, cautions + coarse
    for note in notes:
        _log.info("tower-top load %s", note)
    for caution in cautions:
        _log.warning("tower-top load %s", caution)
    mean = history.mean(analysis.ramp, analysis.duration)
    return TowerTop(history, mean, None, notes, cautions)


def _read_openfast(entry: LoadFile, turbine: Turbine) -> LoadHistory:
    output = read_openfast_output(entry.file)
    channels: Mapping[Any, str] | None = entry.channels
    if entry.frame == "yaw_bearing":
        return from_channels(output, channels or YAW_BEARING)
    azimuth = entry.azimuth_channel
    if azimuth is None and entry.channels is None:
        azimuth = AZIMUTH
    return from_rotor_apex(output, channels or ROTOR_APEX, azimuth, rotor_of(turbine))


def rotor_of(turbine: Turbine) -> RotorNacelleRNA:
    """The turbine's rotor and nacelle by their parts.

    Raises
    ------
    InputError : they are given as one rigid body
    """
    if not isinstance(turbine.rna, RotorNacelleRNA):
        raise InputError(
            f"turbine {turbine.name}, field rna.kind",
            turbine.rna.kind,
            "rotor_nacelle, whose rotor this load needs",
            "Give rotor and nacelle inputs, or a load at the yaw bearing (frame: yaw_bearing).",
        )
    return turbine.rna
