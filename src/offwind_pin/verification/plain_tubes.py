"""Plain structures with known answers: clamped tubes with a negligible assembly on top."""

from collections.abc import Sequence

import numpy as np

from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.definition import Array
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.tower_top.load_history import constant_load
from offwind_pin.solvers.eigen import natural_modes
from offwind_pin.solvers.newton import newton

YOUNG, SHEAR, DENSITY = 2.0e11, 8.0e10, 8000.0
LENGTH, DIAMETER, THICKNESS = 100.0, 6.0, 0.06


def tube(
    *,
    length: float = LENGTH,
    bottom: tuple[float, float] = (DIAMETER, THICKNESS),
    top: tuple[float, float] = (DIAMETER, THICKNESS),
    young: float = YOUNG,
    density: float = DENSITY,
    gravity: float = 0.0,
    top_mass: float = 1e-3,
    embedded: float = 0.0,
) -> Turbine:
    """A tube of one member, its diameter and wall (m) linear in height, mudline at z = -20 m.

    The body on top weighs 1 g by default, 1e-9 of the tube, and is a ball of 1 cm.
    ``model_copy`` does not validate, so that gravity may be zero or huge, which no turbine file can
    ask for.
    """
    low = -20.0 - embedded
    high = -20.0 + length
    turbine = Turbine.model_validate(
        {
            "name": "tube",
            "site": {
                "water_depth": 20.0,
                "water_density": 1000.0,
                "gravity": 1.0,
            },
            "materials": {
                "steel": {"youngs_modulus": young, "shear_modulus": SHEAR, "density": density}
            },
            "members": [
                {
                    "name": "tower",
                    "material": "steel",
                    "stations": [
                        {"z": low, "diameter": bottom[0], "thickness": bottom[1]},
                        {"z": high, "diameter": top[0], "thickness": top[1]},
                    ],
                }
            ],
            "rna": {
                "kind": "rigid_body",
                "mass": top_mass,
                "center_of_mass": (0.0, 0.0, 0.0),
                "inertia": np.diag([1e-4 * top_mass] * 3).tolist(),
            },
            "hydrodynamics": {"added_mass_coefficient": 1.0, "drag_coefficient": 1.0},
            "soil": {},
        }
    )
    site = turbine.site.model_copy(update={"gravity": gravity})
    return turbine.model_copy(update={"site": site})


def bending_stiffness(diameter: float = DIAMETER, thickness: float = THICKNESS) -> float:
    """EI in N m2 of a tube, by an independent formula."""
    inner = diameter - 2 * thickness
    return YOUNG * np.pi / 64 * (diameter**4 - inner**4)


def mass_per_length(diameter: float = DIAMETER, thickness: float = THICKNESS) -> float:
    """kg/m of a tube."""
    inner = diameter - 2 * thickness
    return DENSITY * np.pi / 4 * (diameter**2 - inner**2)


def polar_inertia(diameter: float = DIAMETER, thickness: float = THICKNESS) -> float:
    """Polar second moment of area of a tube in m4."""
    inner = diameter - 2 * thickness
    return np.pi / 32 * (diameter**4 - inner**4)


def equilibrium(
    system: System, top_load: Sequence[float] | Array | None = None, *, scale: float
) -> StaticResult:
    """Static state of a structure whose load scale vanishes with its top mass or gravity."""
    loads: list[PointLoad] = []
    if top_load is not None:
        loads = [constant_load(system.chain.top, np.asarray(top_load, dtype=float))]
    equations = system.equations(loads, ramp_time=None)
    rest = np.zeros(system.nv)
    found = newton(
        lambda q: equations.residual(0.0, q, rest, rest),
        lambda q, r: np.asarray(np.linalg.solve(equations.tangents(0.0, q, rest)[0], r)),
        rest,
        scale=scale,
        relative_tolerance=1e-12,
    )
    if not found.converged:
        raise RuntimeError("the plain tube has no equilibrium under this load")
    points = equations.chain_motion(found.x, rest).points_at(system.chain.boundary)
    return StaticResult(
        q=found.x,
        height=system.chain.boundary,
        displacement=points.displacement,
        rotation=np.zeros_like(points.displacement),
        section_load=np.zeros((len(system.chain.boundary), 6)),
        iterations=found.iterations,
        residual=0.0,
        mudline=system.turbine.site.mudline,
        memory=np.zeros(0),
        loads=tuple(loads),
        engine="pinocchio",
    )


FORE_AFT, TORSION = 1, 2
"""Joint of each node that turns about y, about z."""


def frequencies(system: System, count: int, joint: int = FORE_AFT) -> Array:
    """(count,) natural frequencies in rad/s of one family about the straight, upright state.

    The families are uncoupled in the upright state; solved one by one, a slender tube's torsion, a
    thousand times faster, does not reduce the accuracy of its bending.
    """
    rest = np.zeros(system.nv)
    equations = system.equations((), ramp_time=None)
    stiffness, _ = equations.tangents(0.0, rest, rest)
    mass = equations.mass(rest)
    family = np.arange(joint, system.nv, 3)
    others = np.setdiff1d(np.arange(system.nv), family)
    if np.abs(mass[np.ix_(family, others)]).max() > 1e-12 * np.abs(mass).max():
        raise RuntimeError("the families of joints are coupled; is the tube upright?")
    block = np.ix_(family, family)
    squares, _ = natural_modes(stiffness[block], mass[block], count)
    return np.asarray(np.sqrt(squares))
