"""Pushover: a pile under an increasing horizontal load, up to a displacement or a load."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.analysis.assemble import assemble
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.analysis.static import axis_rotation, load_scale
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError, SolverError
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.soil.foundation import distributed_springs
from offwind_pin.loads.tower_top.load_history import constant_load
from offwind_pin.solvers.newton import NewtonResult, newton
from offwind_pin.structure.chain import Elements
from offwind_pin.structure.section import outer_diameter

_SHARE_OF_DIAMETER = 0.1
"""Mudline displacement over diameter at which a monopile counts as failed, as in the PISA tests
(Byrne et al., Geotechnique 70 (2020), 970-985)."""
_RELATIVE_TOLERANCE = 1e-10
"""Largest residual over the size of the loads."""
_LARGEST_STEP = 0.2
"""Largest change of a joint in rad or m, and of the load in its unit, in one iteration."""
_MOST_ITERATIONS = 25
_HALVINGS = 8
"""How often a step is halved for which Newton's method does not converge."""


@dataclass(frozen=True, eq=False)
class Pushover:
    """Monotonic response of a pile at the mudline.

    Attributes
    ----------
    arm : float, m
        Height of the load above the mudline.
    load : (n,) array, N
        Horizontal load H, the first zero.
    moment : (n,) array, N m
        H times the arm.
    displacement : (n,) array, m
        Displacement of the axis at the mudline along the load.
    rotation : (n,) array, rad
        Rotation of the axis at the mudline in the direction of the load.
    """

    arm: float
    load: Array
    moment: Array
    displacement: Array
    rotation: Array

    __repr__ = one_line


def pushover(
    turbine: Turbine,
    arm: float,
    *,
    until_displacement: float | None = None,
    until_load: float | None = None,
    displacements: Array | None = None,
    points: int = 20,
    elements: Elements = None,
    element: Element = "euler_bernoulli",
) -> Pushover:
    """Push the bare pile of a turbine at the mudline along x.

    Load and moment keep their directions; the pile's weight acts on the deflected axis. Points are
    evenly spaced in the prescribed quantity, starting with the unloaded state.

    Parameters
    ----------
    turbine : Turbine
    arm : float, m
        Height above the mudline at which the load acts.
    until_displacement : float, m, optional
        Mudline displacement at which to stop; by default, without a load, a tenth of the diameter
        there.
    until_load : float, N, optional
        Horizontal load at which to stop.
    displacements : (n,) array, m, optional
        Increasing mudline displacements at which to find the load.
    points : int
        Number of states after the unloaded one.
    elements : int, dict of str to int, or None
        As for :func:`build`, for the pile alone.
    element : {"euler_bernoulli", "timoshenko"}
        As for :func:`build`.

    Returns
    -------
    Pushover

    Raises
    ------
    InputError
        An invalid argument, or a turbine without a pile or soil.
    SolverError
        No equilibrium at a load; ``results`` contains the :class:`Pushover` so far.
    """
    ends = {
        "until_displacement": until_displacement,
        "until_load": until_load,
        "displacements": displacements,
    }
    given = [name for name, value in ends.items() if value is not None]
    if len(given) > 1:
        raise InputError(", ".join(given), "all of them", "one of them", "Leave the others out.")
    for name, value in (("until_displacement", until_displacement), ("until_load", until_load)):
        if value is not None and not 0 < value < np.inf:
            raise InputError(name, value, "a finite number above zero", "Correct it.")
    if not np.isfinite(arm):
        raise InputError("arm", arm, "a finite height in m", "Give the height of the load.")
    if points < 1:
        raise InputError("points", points, "1 or more", "Correct it.")
    pile = pile_only(turbine)
    system = assemble(pile, distributed_springs(pile), elements=elements, element=element)
    if displacements is not None:
        if not np.all(np.diff(displacements, prepend=0.0) > 0):
            allowed = "displacements in m that rise from zero"
            raise InputError("displacements", list(displacements), allowed, "Sort them.")
        return _Press(system, arm, by_load=False).through(np.append(0.0, displacements))
    if until_load is not None:
        return _Press(system, arm, by_load=True).through(np.linspace(0, until_load, points + 1))
    if until_displacement is None:
        diameter = outer_diameter(pile, np.array([pile.site.mudline]))[0]
        until_displacement = _SHARE_OF_DIAMETER * float(diameter)
    press = _Press(system, arm, by_load=False)
    return press.through(np.linspace(0, until_displacement, points + 1))


class _Press:
    """Equilibrium of a pushed pile. Unknowns are the joints and the load."""

    def __init__(self, system: System, arm: float, *, by_load: bool) -> None:
        self.system = system
        self._height = np.array([system.chain.top])
        self.arm = arm
        self.by_load = by_load
        self.direction = np.array([1.0, 0.0, 0.0, 0.0, arm, 0.0])
        self.scale = load_scale(system)
        self.rest = np.zeros(system.nv)
        self._chain = CompiledChain(system, [constant_load(system.chain.top, np.zeros(6))])
        self._unloaded = self._chain.mean_inputs()
        self.unit = self._linear_stiffness()
        """Scale of the load in N, which makes the unknowns similar in size."""

    def through(self, targets: Array) -> Pushover:
        """Follow displacements in m or loads in N, with the longest steps that converge."""
        found: list[Array] = []
        x = np.zeros(self.system.nv + 1)
        reached = 0.0
        for target in targets:
            halvings = 0
            while True:
                goal = reached + (target - reached) / 2**halvings
                result = self._solve(x, goal)
                if result.converged:
                    x, reached = result.x, goal
                    if halvings == 0:
                        break
                    halvings -= 1
                elif halvings < _HALVINGS:
                    halvings += 1
                else:
                    raise self._failure(result, goal, found)
            found.append(x)
        return self._result(found)

    def _solve(self, start: Array, goal: float) -> NewtonResult:
        """Equilibrium at a displacement or a load.

        One equation is added to those of the joints. It prescribes the load, or the displacement
        times the scale per metre, which makes it comparable with a force.
        """

        def residual(x: Array) -> Array:
            lack = self._evaluate(x)
            if self.by_load:
                return np.append(lack, self.unit * x[-1] - goal)
            return np.append(lack, (self._head().displacement[0, 0] - goal) * self.scale)

        def correction(x: Array, lack: Array) -> Array:
            pulled, jacobian = self._factorise(x)
            moved = self._chain.correction(lack[:-1])
            if self.by_load:
                more = lack[-1] / self.unit
            else:
                more = (lack[-1] / self.scale - jacobian[0] @ moved) / (jacobian[0] @ pulled)
            return np.append(moved + more * pulled, more)

        moments = abs(self.unit * start[-1]) * (1 + abs(self.arm))
        return newton(
            residual,
            correction,
            start,
            scale=self.scale + moments,
            relative_tolerance=_RELATIVE_TOLERANCE,
            largest_step=_LARGEST_STEP,
            max_iterations=_MOST_ITERATIONS,
        )

    def _linear_stiffness(self) -> float:
        """Load in N that would move the head by a metre if the soil stayed linear."""
        self.unit = 1.0
        moved, jacobian = self._factorise(np.zeros(self.system.nv + 1))
        return float(1 / (jacobian[0] @ moved))

    def _factorise(self, x: Array) -> tuple[Array, Array]:
        """(nv,) motion of the joints per unit of load, and the head's Jacobian (6, nv)."""
        self._chain.factorise(self._inputs(x), x[:-1], self.rest, self.rest, 0.0, 0.0)
        jacobian = self._chain.top_jacobian()
        return self._chain.correction(self.unit * (self.direction @ jacobian)), jacobian

    def _evaluate(self, x: Array) -> Array:
        """(nv,) residual of the joints."""
        return self._chain.residual(self._inputs(x), x[:-1], self.rest, self.rest)

    def _inputs(self, x: Array) -> Array:
        """Time inputs of the chain; those of the load come last."""
        return np.append(self._unloaded[:-6], self.unit * x[-1] * self.direction)

    def _head(self) -> PointMotion:
        """In the state last evaluated."""
        return self._chain.points_at(self._height)

    def _head_at(self, x: Array) -> PointMotion:
        self._evaluate(x)
        return self._head()

    def _result(self, found: list[Array]) -> Pushover:
        load = np.array([self.unit * x[-1] for x in found])
        heads = [self._head_at(x) for x in found]
        return Pushover(
            arm=self.arm,
            load=load,
            moment=load * self.arm,
            displacement=np.array([head.displacement[0, 0] for head in heads]),
            rotation=np.array([axis_rotation(head.axis)[0, 1] for head in heads]),
        )

    def _failure(self, result: NewtonResult, goal: float, found: list[Array]) -> SolverError:
        so_far = self._result(found)
        joint, size = self._chain.worst_joint(result.residual[:-1])
        what = f"under {goal:.6g} N" if self.by_load else f"at {goal:.6g} m"
        last = f"{so_far.load[-1]:.6g} N and {so_far.displacement[-1]:.6g} m at the mudline"
        return SolverError(
            f"the soil fails: no equilibrium {what}; the last equilibrium is at {last}",
            step=len(found),
            joint=joint,
            residual=size,
            results=so_far,
        )
