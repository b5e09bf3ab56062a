"""The tower-top load of a case: the load that is applied, and its description as data."""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.aerodynamic_damping import thrust_damping
from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.cases.case import Case, TransientAnalysis
from offwind_pin.cases.schema.tower_top import LoadFile, TowerTopLoadFile
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.definitions.turbine import RotorNacelleRNA, Turbine
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
from offwind_pin.loads.wind.synthetic_thrust import AIR_DENSITY, SyntheticWind, operate_rotor
from offwind_pin.loads.wind.thrust_table import ThrustTable, inflow_time

_log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class TowerTop:
    """The load at the tower top.

    Attributes
    ----------
    acting : LoadHistory, RotorThrust or None
        A history, a rotor, or nothing.
    mean : (6,) array or None, N and N m
        Load at the yaw bearing that acts from the start, or None.
    blade_passing_frequency : float or None, Hz
        None where no blades pass.
    notes, cautions : list of str
        Changes made to the user's numbers, and their possible faults.
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
        """Attributes for the histories."""
        attributes = {}
        if isinstance(self.acting, RotorThrust):
            thrust = self.acting
            source = thrust.disc.rotor.thrust_coefficient.source or thrust.disc.rotor.source
            attributes["tower_top_load_origin"] = (
                f"rotor thrust, {thrust.control} control; {thrust.wind.origin}; thrust "
                f"coefficient: {source or 'the user'}"
            )
            attributes["tower_top_load_holds"] = (
                "prescribed loads, which exclude the thrust of the rotor"
            )
        if self.notes or self.cautions:
            attributes["tower_top_load_notes"] = " | ".join([*self.notes, *self.cautions])
        return attributes

    def dataset(self) -> xr.Dataset | None:
        """Mean load, and the changes made to the user's numbers; None without a load."""
        if self.mean is None:
            return None
        component = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"]
        about = {"long_name": "mean load at the yaw bearing", "units": "N for F, N m for M"}
        return xr.Dataset(
            {"mean_load": ("component", self.mean, about)},
            {"component": ("component", component, {"long_name": "component of a load"})},
            {"notes": json.dumps(self.notes), "cautions": json.dumps(self.cautions)},
        )

    def rotor_dataset(
        self, system: System, found: ModalResult, state: StaticResult
    ) -> xr.Dataset | None:
        """The operating point of a running rotor and its damping; None for another load.

        Parameters
        ----------
        found : ModalResult
            Modes about the mean load.
        state : StaticResult
            Static state under the mean load.
        """
        if not isinstance(self.acting, RotorThrust) or self.mean is None:
            return None
        thrust, mean = self.acting, self.acting.wind.mean
        ratio = thrust_damping(system, thrust, found, state)
        for label, aerodynamic, own in zip(found.label, ratio, found.damping_ratio, strict=True):
            if aerodynamic + own < 0:
                _log.warning(
                    "mode %s is unstable: its damping ratio is %.4f, of which %.4f is "
                    "aerodynamic, so its amplitude will grow",
                    label,
                    aerodynamic + own,
                    aerodynamic,
                )
        disc = thrust.disc
        values = {
            "mean_wind": (mean, "mean wind at the hub", "m/s"),
            "wind_standard_deviation": (
                float(np.std(thrust.wind.speed)),
                "standard deviation of the rotor-effective wind",
                "m/s",
            ),
            "thrust_coefficient": (
                ThrustTable(disc).coefficient(mean)[0],
                "thrust coefficient",
                "1",
            ),
            "mean_thrust": (float(np.linalg.norm(self.mean[:3])), "mean thrust", "N"),
            "blade_passing_frequency": (
                self.blade_passing_frequency or 0.0,
                "blade-passing frequency",
                "Hz",
            ),
        }
        if thrust.control == "lagged":
            lag = "time constant of the controller"
            values["control_time"] = (thrust.control_time, lag, "s")
        if thrust.inflow_lag:
            values["wake_time"] = (inflow_time(disc, mean), "time constant of the wake", "s")
        return xr.Dataset(
            {
                name: ((), value, {"long_name": text, "units": unit})
                for name, (value, text, unit) in values.items()
            }
            | {
                "aerodynamic_damping": (
                    "mode",
                    ratio,
                    {"long_name": "aerodynamic damping ratio, of critical", "units": "1"},
                )
            },
            {"mode": ("mode", found.label, {"long_name": "label of the mode"})},
            {"control": thrust.control, "wind": thrust.wind.origin},
        )


def summarise_tower_top(load: xr.Dataset | None, rotor: xr.Dataset | None) -> dict[str, Any]:
    """Keys for ``summary.json``."""
    summary: dict[str, Any] = {}
    if load is not None:
        notes, cautions = (json.loads(load.attrs[name]) for name in ("notes", "cautions"))
        if notes or cautions:
            summary |= {"tower_top_load_notes": notes, "tower_top_load_cautions": cautions}
    if rotor is not None:
        damping = rotor["aerodynamic_damping"]
        summary |= {
            "mean_thrust_N": float(rotor["mean_thrust"]),
            "aerodynamic_damping": [
                {"label": str(label), "ratio": float(ratio)}
                for label, ratio in zip(rotor["mode"].to_numpy(), damping.to_numpy(), strict=True)
            ],
        }
    return summary


def wind_dataset(case: Case, turbine: Turbine) -> xr.Dataset | None:
    """As :func:`synthetic_dataset`, for a case; None for another load."""
    load = case.tower_top_load
    if not isinstance(load, SyntheticWind):
        return None
    return synthetic_dataset(load.completed(case.seed), rotor_of(turbine))


def synthetic_dataset(made: SyntheticWind, rna: RotorNacelleRNA) -> xr.Dataset:
    """Settings of the generator of a synthetic load, and the operating point of the rotor."""
    rotor = operate_rotor(rna, made.wind_speed, made.blade_passing_frequency)
    scalars = {
        "wind_speed": (rotor.wind_speed, "mean wind at the hub", "m/s"),
        "turbulence_intensity": (made.turbulence_intensity, "turbulence intensity", "1"),
        "blade_passing_frequency": (made.blade_passing_frequency, "blade-passing frequency", "Hz"),
        "rotor_speed": (rotor.rotor_speed, "rotor speed", "rad/s"),
        "radius": (rotor.radius, "rotor radius", "m"),
        "swept_area": (rotor.swept_area, "swept area", "m2"),
        "tip_speed_ratio": (rotor.tip_speed_ratio, "tip-speed ratio", "1"),
        "power_coefficient": (rotor.power_coefficient, "power coefficient", "1"),
        "induction": (rotor.induction, "axial induction factor", "1"),
        "thrust_coefficient": (rotor.thrust_coefficient, "thrust coefficient", "1"),
        "thrust": (rotor.thrust, "mean thrust", "N"),
        "torque": (rotor.torque, "mean torque", "N m"),
        "air_density": (AIR_DENSITY, "density of the air", "kg/m3"),
    }
    about = {
        "long_name": "standard deviation of the thrust at a multiple of the blade-passing "
        "frequency over the mean thrust",
        "units": "1",
    }
    return xr.Dataset(
        {
            name: ((), value, {"long_name": text, "units": unit})
            for name, (value, text, unit) in scalars.items()
        }
        | {"harmonics": ("harmonic", np.array(made.harmonics), about)},
        attrs={"seed": made.wind_seed, "blades": rna.blades, "surrogate": made.surrogate},
    )


def tower_top(case: Case, turbine: Turbine, analysis: TransientAnalysis) -> TowerTop:
    """The tower-top load of a case.

    Raises
    ------
    InputError
        A file, or a part of the turbine, that cannot be used.
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
    InputError
        They are given as one rigid body.
    """
    if not isinstance(turbine.rna, RotorNacelleRNA):
        raise InputError(
            f"turbine {turbine.name}, field rna.kind",
            turbine.rna.kind,
            "rotor_nacelle, whose rotor this load needs",
            "Define rotor and nacelle, or use a load at the yaw bearing (frame: yaw_bearing).",
        )
    return turbine.rna
