"""Static equilibrium under gravity, soil and mean loads."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from offwind_pin.analysis.engines import resting_chain
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import html_table
from offwind_pin.base.errors import InputError, SolverError
from offwind_pin.definitions.engine import Engine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.tower_top.load_history import constant_load
from offwind_pin.solvers.newton import newton

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

RELATIVE_TOLERANCE = 1e-10
"""Largest entry of the residual over :func:`load_scale`. Displacements of soil nodes are
differences of heights, whose rounding error alone gives 1e-12 or more where the shaft carries
weight."""


@dataclass(frozen=True, eq=False)
class StaticResult:
    """Equilibrium of a system.

    Attributes
    ----------
    q : (nv,) array, m and rad
        Joint displacements.
    height : (m,) array, m
        Heights of the element boundaries.
    displacement : (m, 3) array, m
        Displacement of the axis.
    rotation : (m, 3) array, rad
        Rotation of the axis about x and y (the third is zero).
    section_load : (m, 6) array
        Force (N) and moment (N m) that the part above exerts on the part below.
    iterations : int
        Number of Newton steps.
    residual : float
        Largest entry of the residual over the load scale.
    mudline : float, m
        Height of the mudline.
    memory : (k,) array
        Memory of soil and foundation after this load.
    loads : tuple of PointLoad or None
        Applied loads; None for a state under loads that was read from a file, which does not
        contain them.
    engine : {"compiled", "pinocchio"}
        Engine that evaluated the equations.
    """

    q: Array
    height: Array
    displacement: Array
    rotation: Array
    section_load: Array
    iterations: int
    residual: float
    mudline: float
    memory: Array = field(repr=False)
    loads: tuple[PointLoad, ...] | None = field(repr=False)
    engine: Engine = "compiled"

    def __repr__(self) -> str:
        x, z = self.tower_top_displacement[[0, 2]]
        moment = self.mudline_load[4] / 1e6
        return (
            f"StaticResult(tower top at x {x:.4g} m, z {z:.4g} m, mudline moment My {moment:.4g} "
            f"MN m, {self.iterations} iterations)"
        )

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        rows = [
            (
                f"{z:.2f}",
                *(f"{value:.4g}" for value in (*u[:3], *np.degrees(turn[:2]), *load / 1e6)),
            )
            for z, u, turn, load in zip(
                self.height, self.displacement, self.rotation, self.section_load, strict=True
            )
        ]
        columns = ("z (m)", "x (m)", "y (m)", "z displacement (m)", "rx (deg)", "ry (deg)")
        loads = ("Fx (MN)", "Fy (MN)", "Fz (MN)", "Mx (MN m)", "My (MN m)", "Mz (MN m)")
        return html_table(repr(self), columns + loads, rows[::-1])

    @property
    def tower_top_displacement(self) -> Array:
        """(3,) displacement of the yaw bearing in m."""
        return self.displacement[-1]

    @property
    def tower_top_rotation(self) -> Array:
        """(3,) rotation of the axis at the yaw bearing in rad."""
        return self.rotation[-1]

    @property
    def mudline_displacement(self) -> Array:
        """(3,) displacement of the axis at the mudline in m."""
        return self.displacement[self._mudline]

    @property
    def mudline_load(self) -> Array:
        """(6,) section load at the mudline in N and N m."""
        return self.section_load[self._mudline]

    def to_dataset(self) -> xr.Dataset:
        """The state as a labelled dataset over height.

        Returns
        -------
        Dataset
        """
        from offwind_pin.results.states import static_dataset

        return static_dataset(
            self.height,
            displacement=self.displacement,
            rotation=self.rotation,
            section_load=self.section_load,
            joint_displacement=self.q,
            memory=self.memory,
            iterations=self.iterations,
            residual=self.residual,
            mudline=self.mudline,
            engine=self.engine,
            loads=[load.name for load in self.acting_loads()],
        )

    @staticmethod
    def from_dataset(data: xr.Dataset) -> StaticResult:
        """A state read back from :meth:`to_dataset`; ``loads`` is None if there were any.

        Parameters
        ----------
        data : Dataset
            From :meth:`to_dataset`.

        Returns
        -------
        StaticResult
        """
        load = [data[name].to_numpy() for name in ("section_force", "section_moment")]
        return StaticResult(
            q=data["joint_displacement"].to_numpy(),
            height=data["height"].to_numpy(),
            displacement=data["displacement"].to_numpy(),
            rotation=data["rotation"].to_numpy(),
            section_load=np.concatenate(load, axis=1),
            iterations=int(data.attrs["iterations"]),
            residual=float(data.attrs["residual"]),
            mudline=float(data.attrs["mudline_m"]),
            memory=data["memory"].to_numpy() if "memory" in data else np.zeros(0),
            loads=None if json.loads(data.attrs["loads"]) else (),
            engine=data.attrs["engine"],
        )

    def to_dataframe(self) -> pd.DataFrame:
        """Table over height in m: displacement (m), rotation (rad), section load (N, N m).

        Returns
        -------
        DataFrame
        """
        import pandas as pd

        columns = {f"displacement_{a}": self.displacement[:, i] for i, a in enumerate("xyz")}
        columns |= {f"rotation_{a}": self.rotation[:, i] for i, a in enumerate("xyz")}
        names = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
        columns |= {name: self.section_load[:, i] for i, name in enumerate(names)}
        return pd.DataFrame(columns, index=pd.Index(self.height, name="height"))

    def acting_loads(self) -> tuple[PointLoad, ...]:
        """The applied loads.

        Returns
        -------
        tuple of PointLoad

        Raises
        ------
        InputError
            The state was read from a file, which does not contain them.
        """
        if self.loads is None:
            raise InputError(
                "static state",
                "a state read from a file, which does not contain the loads",
                "a state computed by static in this session",
                "Solve the state again.",
            )
        return self.loads

    @property
    def _mudline(self) -> int:
        return int(np.argmin(np.abs(self.height - self.mudline)))


def static(
    system: System,
    tower_top_load: Array | None = None,
    *,
    loads: Sequence[PointLoad] = (),
    after: StaticResult | None = None,
    engine: Engine = "compiled",
) -> StaticResult:
    """Static equilibrium by Newton's method with the exact tangent.

    Soil, gravity and the means of the given loads act; waves do not. Soil or a foundation with
    memory is loaded for the first time, in a single step.

    Parameters
    ----------
    system : System
    tower_top_load : (6,) array, N and N m, optional
        Fx, Fy, Fz, Mx, My, Mz at the yaw bearing, inertial frame.
    loads : sequence of PointLoad
        Further point loads.
    after : StaticResult, optional
        Previous state of the same system, for soil with memory.
    engine : {"compiled", "pinocchio"}
        Implementation of the equations of motion.

    Returns
    -------
    StaticResult

    Raises
    ------
    InputError
        A load that is not six finite numbers, or an unknown engine.
    SolverError
        No equilibrium was found, or it is unstable.
    """
    acting = [*loads]
    if tower_top_load is not None:
        acting.append(constant_load(system.chain.top, tower_top_load))
    chain = resting_chain(system, acting, engine)
    time_inputs = chain.mean_inputs()
    rest = np.zeros(system.nv)
    scale = load_scale(system)
    if after is not None:
        if after.q.shape != rest.shape or after.memory.shape != chain.memory.shape:
            allowed = "a state of the same system under loads of the same kinds"
            raise InputError(
                "after", "a state of another system", allowed, "Solve that state again."
            )
        chain.memory = after.memory

    def correction(q: Array, residual: Array) -> Array:
        chain.factorise(time_inputs, q, rest, rest, 0.0, 0.0)
        return chain.correction(residual)

    result = newton(
        lambda q: chain.residual(time_inputs, q, rest, rest),
        correction,
        rest if after is None else after.q,
        scale=scale,
        relative_tolerance=RELATIVE_TOLERANCE,
    )
    if not result.converged:
        joint, size = chain.worst_joint(result.residual)
        raise SolverError(
            "no static equilibrium found (is the soil strong enough for the load?)",
            step=result.iterations,
            joint=joint,
            residual=size,
        )
    chain.factorise(time_inputs, result.x, rest, rest, 0.0, 0.0)
    if chain.unstable_directions():
        joint, size = chain.worst_joint(result.x)
        raise SolverError(
            "the equilibrium is unstable: the structure buckles under its weight and the load",
            step=result.iterations,
            joint=joint,
            residual=float(np.max(np.abs(result.residual))),
        )
    state = chain.at_rest(time_inputs, result.x, system.chain.boundary)
    return StaticResult(
        q=result.x,
        height=system.chain.boundary,
        displacement=state.displacement,
        rotation=axis_rotation(state.direction),
        section_load=state.section_load,
        iterations=result.iterations,
        residual=float(np.max(np.abs(result.residual))) / scale,
        mudline=system.turbine.site.mudline,
        memory=chain.memory,
        loads=tuple(acting),
        engine=engine,
    )


def load_scale(system: System) -> float:
    """Size in N m of the terms in the residual.

    The total weight times a hundredth of the structure's height.
    """
    chain = system.chain
    return system.turbine.site.gravity * chain.mass * (chain.top - chain.base) / 100


def axis_rotation(axis: Array) -> Array:
    """(..., 3) rotation of upward unit vectors about x and y in rad, without torsion."""
    rotation = np.zeros_like(axis)
    rotation[..., 0] = np.arctan2(-axis[..., 1], axis[..., 2])
    rotation[..., 1] = np.arctan2(axis[..., 0], axis[..., 2])
    return rotation
