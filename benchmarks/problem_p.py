"""Problem P: the case on which integrators, elements and other codes are compared.

OC6 Phase II with its pile in still water, and a tower-top force that is put on at t = 0 to the
structure at rest under gravity alone. Soil: p = k y_u tanh(y / y_u) with constant dashpots at 61
nodes, springs at the toe. Added mass up to still water level, no drag. Stiffness-proportional
damping in every joint. The motion is planar.

Run as a script it prints the peak of the seabed moment over the step.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

import offwind_pin as ow
from offwind_pin.analysis.integrators import Integrator
from offwind_pin.base.definition import Array
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.soil.springs import DistributedSprings
from offwind_pin.loads.root_restraint import LinearRestraint
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.structure.chain import Elements

ELEMENTS = {"pile": 60, "monopile": 6, "tower": 14}

SOIL_NODES = 61
SOIL_MODULUS = 2.0e8
"""Initial modulus k in N/m2, the same at every depth."""
SOIL_DISPLACEMENT = 0.01
"""y_u in m; the ultimate resistance is k y_u."""
TOE_VERTICAL_STIFFNESS, TOE_TORSIONAL_STIFFNESS = 1.12e10, 2.55e11
"""In N/m and N m/rad. They have no dashpots."""
DASHPOT_FACTOR, DASHPOT_FREQUENCY = 0.1, 0.236
"""c = k l_s 0.1 / (pi 0.236 Hz)."""

JOINT_DAMPING_TIME = 0.02 / (2 * np.pi * 0.24)
"""Damping over stiffness of every joint in s: 1 % of critical at 0.24 Hz."""

FORCE_MEAN = 0.9e6
FORCE_SINES = ((0.1e6, 0.388), (0.03e6, 0.775), (0.02e6, 1.163))
"""Amplitudes in N and frequencies in Hz."""
FORCE_SAMPLING = 1e-3
"""In s. Between samples the force is linear, 0.3 N from the sines at most; at steps that are whole
multiples of it, it is exact."""

DURATION = 100.0


def turbine() -> ow.Turbine:
    """OC6 Phase II with the soil of problem P, without drag and structural damping."""
    oc6 = ow.load_turbine("oc6_phase2")
    springs = DistributedSprings.model_validate(
        {
            "nodes": SOIL_NODES,
            "curve": {
                "kind": "tanh",
                "initial_modulus_n_per_m2": {"at_mudline": SOIL_MODULUS},
                "ultimate_resistance_n_per_m": {"at_mudline": SOIL_MODULUS * SOIL_DISPLACEMENT},
            },
            "toe_vertical_stiffness_n_per_m": TOE_VERTICAL_STIFFNESS,
            "toe_torsional_stiffness_nm_per_rad": TOE_TORSIONAL_STIFFNESS,
            "dashpot": {
                "stiffness": "initial",
                "damping_factor": DASHPOT_FACTOR,
                "load_frequency_hz": DASHPOT_FREQUENCY,
            },
        }
    )
    return oc6.model_copy(
        update={
            "soil": oc6.soil.model_copy(update={"distributed_springs": springs}),
            "hydrodynamics": oc6.hydrodynamics.model_copy(update={"drag_coefficient": 0.0}),
            "structural_damping": None,
        }
    )


def system(elements: Elements = None, element: Element = "euler_bernoulli") -> ow.System:
    """Problem P's structure; its own 80 elements unless given a total or numbers by region."""
    bare = ow.build(
        turbine(),
        "distributed_springs",
        ow.StillWater(),
        elements=ELEMENTS if elements is None else elements,
        element=element,
    )
    toe = bare.foundation.root
    if not isinstance(toe, LinearRestraint):
        raise TypeError(f"the toe is held by {toe}, not by springs")
    # The package gives springs at the toe dashpots in proportion to those along the pile.
    springs = replace(toe, damping=np.zeros((6, 6)))
    bare = replace(bare, foundation=replace(bare.foundation, root=springs))
    return bare.with_damping(JOINT_DAMPING_TIME * bare.joint_stiffness, {})


def force(time: Array) -> Array:
    """(t,) fore-aft force at the yaw bearing in N at times (t,) in s."""
    sines = [size * np.sin(2 * np.pi * frequency * time) for size, frequency in FORCE_SINES]
    return np.asarray(FORCE_MEAN + np.sum(sines, axis=0), dtype=np.float64)


def load(structure: ow.System, duration: float = DURATION) -> TowerTopLoad:
    """The force as a history of no mean: statics see nothing of it, motion all of it from t = 0.

    ``simulate`` must not be given a ramp, which would let it rise.
    """
    time: Array = FORCE_SAMPLING * np.arange(round(duration / FORCE_SAMPLING) + 1.0)
    samples = np.zeros((len(time), 6))
    samples[:, 0] = force(time)
    history = ow.LoadHistory(time, samples, origin="problem P")
    return TowerTopLoad(structure.chain.top, history, mean=np.zeros(6))


def run(
    dt: float,
    duration: float = DURATION,
    structure: ow.System | None = None,
    *,
    output_dt: float | None = None,
    spectral_radius: float = 0.9,
    integrator: Integrator | None = None,
    directory: Path | None = None,
) -> xr.Dataset:
    """Time histories of problem P; the arguments are those of :func:`offwind_pin.simulate`."""
    structure = structure or system()
    return ow.simulate(
        structure,
        duration,
        loads=[load(structure, duration)],
        save_at=ow.SaveAt(output_dt, heights=(structure.turbine.site.mudline,)),
        integrator=integrator or ow.GeneralizedAlpha(ow.FixedStep(dt), spectral_radius),
        directory=directory,
    )


def seabed_moment(data: xr.Dataset) -> Array:
    """(t,) fore-aft moment at the mudline in N m, positive for a force downwind."""
    return np.asarray(data["mudline_moment"].sel(direction="y").to_numpy(), dtype=np.float64)


def main(argv: list[str] | None = None) -> dict[float, float]:
    """Peak of the seabed moment in N m by step in s."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=DURATION, help="simulated time")
    parser.add_argument("--steps", type=float, nargs="+", default=[0.04, 0.02, 0.01, 0.005])
    arguments = parser.parse_args(argv)
    structure = system()
    peaks = {}
    for dt in arguments.steps:
        peaks[dt] = float(seabed_moment(run(dt, arguments.seconds, structure)).max())
        print(f"dt {dt:8.4f} s: peak seabed moment {peaks[dt]:.6e} N m")
    return peaks


if __name__ == "__main__":
    main()
