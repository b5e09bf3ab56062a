"""A macro-element: pile and soil as kinematic-hardening plasticity at the mudline.

Parallel elements (Iwan, 1966), each elastic inside its own ellipse in forces and moments of both
planes, and yielding in the direction of its force beyond. Their sum follows a backbone on first
loading and Masing's rule afterwards. Translation and rotation are taken where they are decoupled,
at the depth at which a force only translates the pile (as in Page et al., Marine Structures 59,
2018).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.kernels import inner
from offwind_pin.base.records import clear, stack_matrix, stack_row
from offwind_pin.loads.root_restraint import KernelRestraint, restraint_commit, restraint_kernel

_ARM, _COUNT, _ELEMENTS = 36, 37, 38
"""Indices of the constants after the additional 6x6: arm of the decoupled translation, number of
elements, their stiffnesses in translation and rotation, and their limits."""

_X, _Y, _Z, _RX, _RY, _RZ = range(6)
_ROUNDING = 1e-10
"""Relative excess of a squared limit below which an element has not yielded."""
_SOFTENED = 0.05
"""Relative departure of a path's first secant stiffness from that of small motions."""
_EQUAL = 1e-6
"""Relative difference of two planes' stiffness that counts as rounding error."""


@inner
def _decoupled(displacement: Array, arm: float) -> tuple[float, float, float, float]:
    """Translations x, y at the decoupling depth, and rotations about y and x."""
    return (
        displacement[_X] + arm * displacement[_RY],
        displacement[_Y] - arm * displacement[_RX],
        displacement[_RY],
        displacement[_RX],
    )


@restraint_kernel
def _reaction(
    displacement: Array,
    velocity: Array,
    constants: Array,
    memory: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> tuple[float, float]:
    arm, count = constants[_ARM], int(constants[_COUNT])
    now = _decoupled(displacement, arm)
    force, pull, stretch, tangent = stack_row(4), stack_row(4), stack_row(4), stack_matrix(4, 4)
    clear(force)
    clear(tangent)
    stored = 0.0
    for j in range(count):
        a, b = constants[_ELEMENTS + j], constants[_ELEMENTS + count + j]
        limit = constants[_ELEMENTS + 2 * count + j]
        square = 0.0
        for i in range(4):
            stretch[i] = now[i] - memory[4 * j + i]
            pull[i] = (a if i < 2 else b) * stretch[i]
            square += pull[i] * stretch[i]
        share = 1.0
        if square > limit**2 * (1 + _ROUNDING):
            size = np.sqrt(square)
            share = limit / size
            for i in range(4):
                for k in range(4):
                    tangent[i, k] -= share * pull[i] * pull[k] / square
        for i in range(4):
            force[i] += share * pull[i]
            tangent[i, i] += share * (a if i < 2 else b)
        stored += min(square, limit**2) / 2
    _to_mudline(force, tangent, arm, reaction, stiffness)
    for i in range(6):
        elastic = 0.0
        for k in range(6):
            beside = constants[6 * i + k]
            elastic += beside * displacement[k]
            stiffness[i, k] += beside
            damping[i, k] = 0.0
        reaction[i] += elastic
        stored += elastic * displacement[i] / 2
    return 0.0, stored


@inner
def _to_mudline(
    force: Array, tangent: Array, arm: float, reaction: Array, stiffness: Array
) -> None:
    """Reaction (6,) and stiffness (6, 6) at the mudline from those of the decoupled motions."""
    shape = stack_matrix(4, 6)
    clear(shape)
    shape[0, _X], shape[0, _RY] = 1.0, arm
    shape[1, _Y], shape[1, _RX] = 1.0, -arm
    shape[2, _RY] = shape[3, _RX] = 1.0
    for i in range(6):
        reaction[i] = 0.0
        for k in range(6):
            stiffness[i, k] = 0.0
            for m in range(4):
                for n in range(4):
                    stiffness[i, k] += shape[m, i] * tangent[m, n] * shape[n, k]
        for m in range(4):
            reaction[i] += shape[m, i] * force[m]


@restraint_commit
def _commit(displacement: Array, constants: Array, memory: Array) -> float:
    count = int(constants[_COUNT])
    now = _decoupled(displacement, constants[_ARM])
    dissipated = 0.0
    for j in range(count):
        a, b = constants[_ELEMENTS + j], constants[_ELEMENTS + count + j]
        limit = constants[_ELEMENTS + 2 * count + j]
        square = 0.0
        for i in range(4):
            square += (a if i < 2 else b) * (now[i] - memory[4 * j + i]) ** 2
        if square > limit**2 * (1 + _ROUNDING):
            size = np.sqrt(square)
            slip = 1 - limit / size
            dissipated += limit * slip * size
            for i in range(4):
                memory[4 * j + i] += slip * (now[i] - memory[4 * j + i])
    return dissipated


@dataclass(frozen=True, eq=False)
class MacroElement(KernelRestraint):
    """Kinematic-hardening plasticity in forces and moments of both planes at the mudline.

    Attributes
    ----------
    stiffness : (6, 6) array, N, m, rad
        Stiffness for small motions; the same in both planes.
    translation, rotation : (j,) array, N/m, N m/rad
        Stiffness of the elements at the decoupling depth; their sums equal that of ``stiffness``.
    limit : (j,) array
        Square root of twice the largest stored energy of an element, in sqrt(J); infinite for one
        that never yields.
    departure : float
        Largest relative departure from the path to which the element was fitted.
    """

    stiffness: Array
    translation: Array
    rotation: Array
    limit: Array
    departure: float = 0.0

    reaction_kernel = _reaction
    commit_kernel = _commit

    @property
    def memory_size(self) -> int:
        """Number of slips of the elements, four each."""
        return 4 * len(self.limit)

    @property
    def arm(self) -> float:
        """The decoupled translation is x + arm ry: minus its depth below the mudline, in m."""
        return float(self.stiffness[_X, _RY] / self.stiffness[_X, _X])

    @cached_property
    def constants(self) -> Array:
        beside = self.stiffness - _of_elements(
            self.arm, float(np.sum(self.translation)), float(np.sum(self.rotation))
        )
        head = np.concatenate([beside.ravel(), [self.arm, len(self.limit)]])
        return np.concatenate([head, self.translation, self.rotation, self.limit])

    def describe(self) -> dict[str, object]:
        finite = np.isfinite(self.limit)
        return {
            "stiffness": self.stiffness.tolist(),
            "decoupling_depth_m": -self.arm,
            "translation_stiffness": self.translation.tolist(),
            "rotation_stiffness": self.rotation.tolist(),
            "departure_from_path": self.departure,
            "largest_energy_j": [
                float(value**2 / 2) if ends else None
                for value, ends in zip(self.limit, finite, strict=True)
            ],
        }

    @staticmethod
    def along(
        stiffness: Array, displacement: Array, rotation: Array, force: Array, moment: Array
    ) -> MacroElement:
        """The macro-element that follows a monotonic loading of the mudline in one plane.

        Two elements yield at each point of the path, one of them in translation alone. They are
        fitted to the decoupled force and moment by non-negative least squares, with exactly the
        given stiffness for small motions; beyond the last point the remaining stiffness is
        constant.

        Parameters
        ----------
        stiffness : (6, 6) array
            Stiffness for small motions.
        displacement, rotation : (t,) array
            Motion of the mudline along x in m and about y in rad, increasing.
        force, moment : (t,) array, N and N m
            Force and moment at these motions.

        Raises
        ------
        InputError
            Planes of different stiffness; a path that does not rise, or does not start with the
            stiffness of the 6x6.
        """
        check_planes(stiffness)
        arm = stiffness[_X, _RY] / stiffness[_X, _X]
        shift = displacement + arm * rotation
        turning = moment - arm * force
        whole = stiffness[_X, _X], stiffness[_RY, _RY] - arm**2 * stiffness[_X, _X]
        for name, values in (("translation", shift), ("rotation", rotation)):
            if not np.all(np.diff(values, prepend=0.0) > 0):
                raise InputError(
                    "macro-element's path",
                    f"a decoupled {name} of {values.tolist()}",
                    "values that increase from zero",
                    "Give a monotonic loading whose moment has the sign of the force.",
                )
        for secant in (force[0] / shift[0] / whole[0], turning[0] / rotation[0] / whole[1]):
            if not abs(secant - 1) < _SOFTENED:
                raise InputError(
                    "macro-element's path",
                    f"a first point {secant:.3g} times as stiff as the 6x6",
                    f"1 within {_SOFTENED}: a path that starts with the stiffness for small "
                    "motions",
                    "Use the same soil for 6x6 and path, start with a smaller load, and check "
                    "units.",
                )
        a, b, limit, departure = _fitted(
            _Path(shift, rotation, force, turning), float(whole[0]), float(whole[1])
        )
        kept = (a > 0) | (b > 0)
        return MacroElement(stiffness, a[kept], b[kept], limit[kept], departure)


class _Path(NamedTuple):
    """(t,) decoupled deflections, with their force and moment."""

    shift: Array
    rotation: Array
    force: Array
    moment: Array


def _fitted(path: _Path, translation: float, rotation: float) -> tuple[Array, Array, Array, float]:
    """Stiffnesses (j,) with given sums, and limits, of elements that yield along a path.

    At each point of the path two elements yield: one that resists both motions, and one that
    resists translation alone, which softens earlier. The share of its force that an element retains
    depends on the ratio of its two stiffnesses, so the linear fit is repeated with the shares of
    the previous one. The last result is the largest relative departure of force and moment.
    """
    count = len(path.shift)
    onset = np.tile(path.shift, 2), np.tile(path.rotation, 2)
    both = np.arange(2 * count) < count
    reluctance = np.where(both, 0.0, _RELUCTANCE)
    a, b = np.full(2 * count, translation), np.where(both, rotation, 0.0)
    for repeat in range(_REPEATS):
        pull, twist = _first_loading(path, a, b)
        new = _SHARE_OF_NEW if repeat else 1.0
        a = (1 - new) * a + new * _parallel(pull, path.force, translation, reluctance)
        b[both] = (1 - new) * b[both] + new * _parallel(twist[:, both], path.moment, rotation)
    pull, twist = _first_loading(path, a, b)
    off = [np.max(np.abs(pull @ a / path.force - 1)), np.max(np.abs(twist @ b / path.moment - 1))]
    limit = np.sqrt(a * onset[0] ** 2 + b * onset[1] ** 2)
    limit[count - 1 :: count] = np.inf
    return a, b, limit, float(max(off))


_REPEATS, _SHARE_OF_NEW = 60, 0.3
_RELUCTANCE = 0.1
"""Weight of translation alone against relative errors: force and moment share yield surfaces where
they can, at the cost of a departure of a thousandth on the benchmark's pile."""


def _first_loading(path: _Path, a: Array, b: Array) -> tuple[Array, Array]:
    """Stretches (t, j) in both motions of elements that yield at the points of a path."""
    count = len(path.shift)
    # For an element without stiffness so far only the ratio of the two matters.
    a = np.where((a == 0) & (b == 0), 1.0, a)
    limit = np.sqrt(a * np.tile(path.shift, 2) ** 2 + b * np.tile(path.rotation, 2) ** 2)
    limit[count - 1 :: count] = np.inf
    slip = np.zeros((2, len(a)))
    stretches = np.zeros((2, count, len(a)))
    for i, (shift, rotation) in enumerate(zip(path.shift, path.rotation, strict=True)):
        stretch = np.array([[shift], [rotation]]) - slip
        size = np.sqrt(a * stretch[0] ** 2 + b * stretch[1] ** 2)
        share = np.divide(limit, size, out=np.ones_like(size), where=size > limit)
        slip += (1 - share) * stretch
        stretches[:, i] = share * stretch
    return stretches[0], stretches[1]


def _parallel(
    stretch: Array, force: Array, stiffness: float, reluctance: Array | None = None
) -> Array:
    """(j,) springs with a given sum that, stretched by (t, j), best fit forces (t,).

    A reluctance (j,) weighs a spring's part of the sum against relative errors of the force.
    """
    from scipy.optimize import nnls

    weight, count = 1e4, stretch.shape[1]
    rows = [stretch / force[:, None] * stiffness, np.full((1, count), weight)]
    aims = [np.ones(len(force)), np.full(1, weight)]
    if reluctance is not None:
        rows.append(np.diag(reluctance))
        aims.append(np.zeros(count))
    found, _ = nnls(np.vstack(rows), np.concatenate(aims), maxiter=100 * count)
    return np.asarray(found / np.sum(found) * stiffness)


def _of_elements(arm: float, translation: float, rotation: float) -> Array:
    """(6, 6) stiffness at the mudline of decoupled springs, alike in both planes."""
    result = np.zeros((6, 6))
    result[_X, _X] = result[_Y, _Y] = translation
    result[_X, _RY] = result[_RY, _X] = arm * translation
    result[_Y, _RX] = result[_RX, _Y] = -arm * translation
    result[_RX, _RX] = result[_RY, _RY] = rotation + arm**2 * translation
    return result


def check_planes(stiffness: Array) -> None:
    """Check that fore-aft and side-side stiffness are equal, as for a round pile."""
    pairs = (
        (stiffness[_X, _X], stiffness[_Y, _Y]),
        (stiffness[_RX, _RX], stiffness[_RY, _RY]),
        (stiffness[_X, _RY], -stiffness[_Y, _RX]),
    )
    for one, other in pairs:
        if abs(one - other) > _EQUAL * abs(one):
            raise InputError(
                "6x6 stiffness at the mudline",
                f"{one:.7g} in one plane and {other:.7g} in the other",
                "the same in both planes, as for a round pile",
                "Use coupled_springs for a foundation that is not round.",
            )
