"""Motion in time: order, energy, damping, and a second integrator."""

from __future__ import annotations

import json
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from offwind_pin.analysis.aerodynamic_damping import aerodynamic_damping
from offwind_pin.analysis.build import build
from offwind_pin.analysis.integrators import GeneralizedAlpha, SciPyIVP
from offwind_pin.analysis.simulate import simulate
from offwind_pin.base.definition import Array
from offwind_pin.cases.case import TransientAnalysis, load_case
from offwind_pin.cases.run import run_case
from offwind_pin.cases.tower_top import tower_top
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.irregular_waves import IrregularWaves
from offwind_pin.loads.tower_top.load_history import LoadHistory
from offwind_pin.loads.wind.history import constant_wind
from offwind_pin.loads.wind.rotor_thrust import Control, RotorThrust
from offwind_pin.results.save_at import SaveAt
from offwind_pin.signal.moment_spectrum import moment_spectrum
from offwind_pin.solvers.steps import FixedStep
from offwind_pin.verification.ledger import Found
from offwind_pin.verification.orders import fitted_order


@cache
def _pushed_structure() -> System:
    waves = IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    return build(load_turbine("oc6_phase2"), "distributed_springs", waves, elements=10)


def _pushed(integrator: GeneralizedAlpha | SciPyIVP) -> Array:
    """Seabed moment in N m over 8 s under waves and a smooth push; samples every 1/160 s."""
    time = np.linspace(0.0, 8.0, 1281)
    swell = (1 - np.cos(2 * np.pi * time / 8)) / 2
    load = np.zeros((len(time), 6))
    load[:, 0] = 5e5 + 1e6 * swell * np.sin(0.8 * np.pi * time)
    load[:, 1] = 4e5 * swell * np.sin(1.4 * np.pi * time)
    data = simulate(
        _pushed_structure(),
        8.0,
        loads=[LoadHistory(time, load, "smooth")],
        ramp=4.0,
        save_at=SaveAt(0.2, heights=(0.0,)),
        integrator=integrator,
    )
    return data["mudline_moment"].to_numpy()


@cache
def _by_steps(dt: float) -> Array:
    return _pushed(GeneralizedAlpha(FixedStep(dt), 0.9, 1e-11, 1e-12))


def order_in_time() -> float:
    """Order of convergence of the seabed moment in waves, against two finer steps extrapolated."""
    fine, finest = _by_steps(0.0125), _by_steps(0.00625)
    exact, steps = finest + (finest - fine) / 3, [0.1, 0.05, 0.025]
    return fitted_order(steps, [float(np.abs(_by_steps(dt) - exact).max()) for dt in steps])


def radau() -> float:
    """Largest difference of the seabed moment from SciPy's Radau on Pinocchio's equations.

    At a step of 0.00625 s, over the largest moment.
    """
    other = _pushed(SciPyIVP("Radau", 1e-7, 1e-9))
    return float(np.abs(_by_steps(0.00625) - other).max() / np.abs(other).max())


@cache
def _load_case(name: str) -> dict[str, Any]:
    """Summary of a shipped load case, run as a user runs it."""
    case = load_case(name)
    with tempfile.TemporaryDirectory() as out:
        run_case(case, Path(out), report=False)
        summary: dict[str, Any] = json.loads((Path(out) / "summary.json").read_text())
    return summary


def load_case_settled(name: str) -> float:
    """Largest distance in m between the settled structure in time and its static state."""
    return float(_load_case(name)["settled_difference_m"])


def load_case_identified(name: str, mode: str, quantity: str) -> Found:
    """Frequency or damping ratio of a mode from accelerations, and from the eigenanalysis."""
    row = _identified(name, mode)
    return Found(float(row[quantity]), float(row[f"eigenanalysis_{quantity}"]))


def load_case_assurance(name: str, mode: str) -> float:
    """Modal assurance criterion of a shape from accelerations and the computed one."""
    return float(_identified(name, mode)["modal_assurance"])


def _identified(name: str, mode: str) -> dict[str, Any]:
    rows = _load_case(name)["identified_modes"]
    return next(row for row in rows if row["label"] == mode)


def load_case_peak(name: str, peak: str) -> Found:
    """Peak of the moment's spectrum near a mode in Hz, and the mode's own frequency."""
    summary = _load_case(name)
    near, natural = summary["psd_peaks_near_hz"], summary["natural_frequencies_hz"]
    return Found(float(near[peak]), float(natural[peak]))


def load_case_wave_peak(name: str) -> float:
    """Peak of the moment's spectrum near the waves' in Hz."""
    return float(_load_case(name)["psd_peaks_near_hz"]["wave"])


def load_case_decades(name: str) -> float:
    """Decades by which the band of the first mode exceeds that of the second."""
    summary = _load_case(name)
    return float(np.log10(summary["psd_sum_0p2_0p3"] / summary["psd_sum_1p0_1p5"]))


def load_case_mean(name: str) -> Found:
    """Mean seabed moment in N m, and that of statics under the mean loads."""
    summary = _load_case(name)
    static = summary["mudline_moment_y_static_under_mean_loads_Nm"]
    return Found(float(summary["mudline_moment_y_mean_Nm"]), float(static))


@cache
def _undamped_bands() -> tuple[float, float]:
    """PSD sums of LC 5.1's moment about FA1 and FA2 in (N m)^2 on springs without dashpots."""
    case = load_case("oc6-lc5.1")
    analysis, turbine = case.analysis, case.turbine
    springs = turbine.soil.distributed_springs
    if not isinstance(analysis, TransientAnalysis) or springs is None:
        raise RuntimeError("LC 5.1 is not a time history on distributed springs")
    ground = {"distributed_springs": springs.model_copy(update={"dashpot": None})}
    bare = turbine.soil.model_copy(update=ground)
    turbine = turbine.model_copy(update={"soil": bare})
    data = simulate(
        case.replace(turbine=turbine).build(),
        analysis.duration,
        analysis.dt,
        tower_top(case, turbine, analysis).loads,
        ramp=analysis.ramp,
        save_at=SaveAt(analysis.output_dt, heights=(0.0,)),
    )
    first, second = moment_spectrum(data, analysis.psd_segment, {}).bands
    return first.area, second.area


def soil_damping_share(mode: str) -> float:
    """PSD sum about a mode with the shipped secant dashpots over that of undamped springs."""
    place = ("FA1", "FA2").index(mode)
    shipped = _load_case("oc6-lc5.1")[("psd_sum_0p2_0p3", "psd_sum_1p0_1p5")[place]]
    return float(shipped) / _undamped_bands()[place]


@cache
def _energies() -> tuple[float, float]:
    """Largest imbalance of LC 5.1's energies over 60 s in J, and what was dissipated."""
    waves = IrregularWaves(1.25, 5.5, seed=1, repeat_period=600.0)
    system = build(load_turbine("oc6_phase2"), "distributed_springs", waves, elements=20)
    time = np.linspace(0.0, 60.0, 6001)
    load = np.zeros((len(time), 6))
    load[:, 0] = 1e6 * (1 - np.cos(2 * np.pi * time / 7.0))
    data = simulate(system, 60.0, 0.01, [LoadHistory(time, load, "gusts")], ramp=20.0)
    imbalance = float(np.abs(data["energy_balance"].to_numpy()).max())
    return imbalance, float(data["energy_dissipated"].isel(time=-1).sum())


def energy_balance() -> float:
    """Largest imbalance over what was dissipated."""
    imbalance, dissipated = _energies()
    return imbalance / dissipated


@cache
def _rotor_structure() -> System:
    turbine = load_turbine("oc6_phase2").model_copy(update={"structural_damping": None})
    return build(turbine, "clamped", elements=8)


def aerodynamic_decay(wind_speed: float, control: Control) -> Found:
    """Damping ratio of FA1 in a free decay in a steady wind, and the linearised one."""
    system = _rotor_structure()
    told = aerodynamic_damping(system, wind_speed, control, count=3)
    thrust = RotorThrust(rotor_disc(system.turbine), constant_wind(wind_speed), control)
    ratio, _ = decay_after_a_kick(system, thrust)
    return Found(ratio, float(told.ratio[told.label.index("FA1")]))


def decay_after_a_kick(
    system: System, thrust: RotorThrust, spectral_radius: float = 1.0
) -> tuple[float, float]:
    """Damping ratio and frequency in Hz of FA1's free decay after a short push.

    A decaying harmonic about a mean is fitted; a misfit of more than 1 % of the motion is refused.
    """
    kick = np.zeros((5, 6))
    kick[1:3, 0] = 2e4
    history = LoadHistory(np.array([0.0, 0.5, 1.0, 1.5, 50.0]), kick, "kick")
    data = simulate(
        system,
        40.0,
        loads=[thrust, history],
        integrator=GeneralizedAlpha(FixedStep(0.02), spectral_radius),
        save_at=SaveAt(heights=(system.chain.top,)),
    )
    time = data["time"].to_numpy()
    x = data["tower_top_displacement"].sel(direction="x").to_numpy()
    x, time = (x - x[0])[time > 3], time[time > 3]

    def misfit(p: Array) -> Array:
        swing = p[2] * np.cos(p[1] * time) + p[3] * np.sin(p[1] * time)
        return np.asarray(p[4] + np.exp(-p[0] * time) * swing - x)

    size = float(np.std(x))
    start = [0.0, 2 * np.pi * 0.274, size, size, 0.0]
    fit = least_squares(misfit, start, x_scale=[0.01, 0.01, size, size, size])
    if np.std(fit.fun) >= 0.01 * size:
        raise RuntimeError("the free decay is not that of a single mode")
    ratio = float(fit.x[0] / np.hypot(fit.x[0], fit.x[1]))
    return ratio, float(fit.x[1] / (2 * np.pi))
