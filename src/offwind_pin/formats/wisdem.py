"""A 6x6 foundation as the pile springs of WISDEM's monopile, and the reverse.

WISDEM (``wisdem/fixed_bottomse/monopile.py``, ``MonopileFrame`` with ``soil_springs: True``) has no
input for a 6x6. It supports the embedded pile by diagonal springs ``k_soil`` (10, 6), in the order
kx, ktheta_x, ky, ktheta_y, kz, ktheta_z, at the heights ``z_soil`` (10,) from minus the embedded
length at the foot up to 0 at the mudline, and interpolates them to the four nodes of its pile
(``NREFINE`` + 1, equally spaced, three Frame3DD elements); kz acts at the foot alone. So the 6x6 is
expressed as springs with which that pile, condensed to the mudline, has this 6x6. The pile itself
gives the coupling of sway and rocking.

In the group ``MonopileSE`` both inputs are connected to ``soil.z_k`` and ``soil.k`` of
``TowerSoil`` (``wisdem/commonse/environment.py``), which recomputes them at each run; its own
override ``k_usr`` is one value for all nodes. Values set there by name are overwritten: see
docs/pile.md for a component in its place. In a problem of ``MonopileFrame`` alone they are free
inputs, ``prob["z_soil"]`` and ``prob["k_soil"]``. The stiffness of axial load, ``geom`` of
WISDEM's Frame3DD options, is not part of this.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import read_text
from offwind_pin.base.whole_files import write_json
from offwind_pin.formats.openfast.subdyn_soildyn import symmetric_matrix

Array = NDArray[np.float64]

_LARGEST_FILE = 1_000_000
_HEIGHTS, _ELEMENTS = 10, 3
"""``NPTS_SOIL`` and ``NREFINE`` of WISDEM."""
_EXACT = 1e-9
"""Relative error of an entry below which the springs count as found."""
_LEFT_OUT = 1e-3
"""Entry over the root of its diagonal entries below which a coupling that no spring represents is
omitted: the weight of an off-centre nacelle causes such couplings."""
_STARTS = 20
_SMALLEST, _LARGEST = -25.0, 6.0
"""Range of the logarithms of the springs over the stiffness at the mudline in the search."""


@dataclass(frozen=True)
class WisdemPile:
    """The embedded pile of WISDEM, of one section.

    Attributes
    ----------
    length : float, m
        Embedded, WISDEM's ``suctionpile_depth``.
    bending : float, N m2
        EI.
    shear : float, N
        G times the shear area ``section_Asx``; infinite for WISDEM's ``shear: False``.
    axial : float, N
        EA.
    torsional : float, N m2
        GJ.

    Raises
    ------
    InputError
        A number that is not positive, or not finite but for the shear stiffness.
    """

    length: float
    bending: float
    shear: float
    axial: float
    torsional: float

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            if not value > 0 or (math.isinf(value) and name != "shear"):
                raise InputError(f"pile.{name}", value, "a positive number", "Correct it.")


def write_wisdem(path: Path, stiffness: ArrayLike, pile: WisdemPile, *, note: str = "") -> None:
    """Write ``z_soil`` and ``k_soil`` as JSON, which is also YAML, with explanations.

    The lateral and the rocking springs of the four nodes are sought for each plane by least squares
    of the three entries, in logarithms so that they are positive, from a fixed set of starts. There
    are eight for three entries: of the sets found to 1e-9, the one with the softest largest spring
    is taken. The torsional spring is the same at every node.

    Parameters
    ----------
    stiffness : (6, 6) array_like
        At the mudline, order x, y, z, rx, ry, rz, N, m, rad; symmetric, with couplings of sway and
        rocking in the same plane only; others below a thousandth of the root of their diagonal
        entries are omitted, and the file states how large they are.
    note : str
        One line for the head of the file.

    Raises
    ------
    InputError
        Another matrix, or one that no such springs give.
    """
    matrix = symmetric_matrix(stiffness, "stiffness")
    left_out = _left_out(matrix)
    nodes = np.zeros((_ELEMENTS + 1, 6))
    nodes[:, 0], nodes[:, 3] = _lateral(matrix[0, 0], matrix[0, 4], matrix[4, 4], pile, "x")
    nodes[:, 2], nodes[:, 1] = _lateral(matrix[1, 1], -matrix[1, 3], matrix[3, 3], pile, "y")
    nodes[:, 4] = _foot(matrix[2, 2], pile)
    nodes[:, 5] = _torsional(matrix[5, 5], pile)
    heights = np.linspace(-pile.length, 0.0, _HEIGHTS)
    at = np.linspace(-pile.length, 0.0, _ELEMENTS + 1)
    shear = "shear: False" if math.isinf(pile.shear) else f"shear: True, G Asx {pile.shear:.6g} N"
    data = {
        "note": [
            *([" ".join(note.split())] if note.strip() else []),
            "Pile springs for WISDEM's MonopileFrame with soil_springs: True",
            "z_soil in m from the mudline; columns of k_soil: kx, ktheta_x, ky, ktheta_y, kz, "
            "ktheta_z in N/m and N m/rad",
            f"For suctionpile_depth {pile.length:.6g} m, EI {pile.bending:.6g} N m2, {shear}, "
            f"EA {pile.axial:.6g} N, GJ {pile.torsional:.6g} N m2; valid for this pile only",
            f"Couplings omitted: up to {left_out:.2g} of the root of their diagonal entries",
        ],
        "z_soil": heights.tolist(),
        "k_soil": np.transpose([np.interp(heights, at, column) for column in nodes.T]).tolist(),
    }
    write_json(path, data)


def read_wisdem(path: Path, pile: WisdemPile) -> Array:
    """(6, 6) at the mudline of the springs of a file on a pile, condensed as WISDEM sees them.

    Raises
    ------
    InputError
        A missing file, or one without ten heights from the pile's foot to the mudline and their
        springs.
    """
    heights, springs = _read(path)
    if not np.isclose(heights[0], -pile.length, rtol=1e-6) or abs(heights[-1]) > 1e-6 * pile.length:
        allowed = f"heights from {-pile.length:.6g} to 0, the length of the pile"
        raise InputError(f"{path}, z_soil", heights.tolist(), allowed, "Give the file's own pile.")
    at = np.linspace(-pile.length, 0.0, _ELEMENTS + 1)
    nodes = np.transpose([np.interp(at, heights, column) for column in springs.T])
    stiffness = np.zeros((6, 6))
    planes = (0, 4, 1.0, nodes[:, 0], nodes[:, 3]), (1, 3, -1.0, nodes[:, 2], nodes[:, 1])
    for sway, rocking, sign, lateral, turning in planes:
        plane = _plane(lateral, turning, pile)
        stiffness[sway, sway], stiffness[rocking, rocking] = plane[0, 0], plane[1, 1]
        stiffness[sway, rocking] = stiffness[rocking, sway] = sign * plane[0, 1]
    stiffness[2, 2] = _bar(np.array([nodes[0, 4], 0, 0, 0]), pile.axial, pile.length)
    stiffness[5, 5] = _bar(nodes[:, 5], pile.torsional, pile.length)
    return stiffness


def _lateral(
    sway: float, coupling: float, rocking: float, pile: WisdemPile, plane: str
) -> tuple[Array, Array]:
    """Lateral and rocking springs (4,) of the nodes, foot first, for the terms of one plane."""
    from scipy.optimize import least_squares

    wanted = np.array([sway, coupling, rocking])
    if sway <= 0 or rocking <= 0 or coupling >= 0 or coupling**2 >= sway * rocking:
        allowed = "a matrix at the mudline that is positive definite in each plane"
        raise InputError(
            f"stiffness, plane of {plane}", wanted.tolist(), allowed, "Check the signs."
        )

    def springs(logarithms: Array) -> tuple[Array, Array]:
        ratios = np.exp(logarithms)
        return sway * ratios[: _ELEMENTS + 1], rocking * ratios[_ELEMENTS + 1 :]

    def error(logarithms: Array) -> Array:
        found = _plane(*springs(logarithms), pile)
        return np.array([found[0, 0], found[0, 1], found[1, 1]]) / wanted - 1

    rng = np.random.default_rng(0)
    starts = rng.uniform(-5.0, 2.0, (_STARTS, 2 * (_ELEMENTS + 1)))
    bounds = (_SMALLEST, _LARGEST)
    found = [least_squares(error, start, bounds=bounds, ftol=1e-14, gtol=1e-14) for start in starts]
    exact = [one.x for one in found if np.max(np.abs(one.fun)) < _EXACT]
    if exact:
        return springs(min(exact, key=np.max))
    least = min((one.fun for one in found), key=lambda fun: float(np.max(np.abs(fun))))
    raise InputError(
        f"stiffness, plane of {plane}",
        f"{wanted.tolist()}; the closest springs found differ from it by "
        f"{', '.join(f'{100 * e:.2g} %' for e in least)}",
        "sway, coupling and rocking stiffness that springs at WISDEM's four nodes can give",
        "Its elements may be too soft in shear: use shear: False in WISDEM and an infinite shear "
        "stiffness here, or give a pile of another length.",
    )


def _foot(vertical: float, pile: WisdemPile) -> float:
    """Spring at the foot in series with the pile."""
    most = pile.axial / pile.length
    if not 0 <= vertical < most:
        allowed = f"from 0 to the {most:.6g} N/m of the pile on a rigid foot"
        raise InputError("stiffness, z", vertical, allowed, "Give WISDEM a stiffer pile.")
    return 1 / (1 / vertical - 1 / most) if vertical else 0.0


def _torsional(wanted: float, pile: WisdemPile) -> float:
    """Torsional spring, the same at each node; the total stiffness exceeds the one at the
    mudline."""
    from scipy.optimize import brentq

    if wanted < 0:
        raise InputError("stiffness, rz", wanted, "zero or more", "Check the sign.")

    def excess(ratio: float) -> float:
        springs = np.full(_ELEMENTS + 1, ratio * wanted)
        return _bar(springs, pile.torsional, pile.length) / wanted - 1

    return wanted * float(brentq(excess, 0.0, 1.0, xtol=1e-15)) if wanted else 0.0


def _bar(springs: Array, stiffness: float, length: float) -> float:
    """Stiffness at the top of a bar on springs at its nodes, foot first: in series, in parallel."""
    element = stiffness * _ELEMENTS / length
    total = springs[0]
    for spring in springs[1:]:
        total = spring + total * element / (total + element)
    return float(total)


def _plane(lateral: Array, rocking: Array, pile: WisdemPile) -> Array:
    """(2, 2) of sway and rotation at the top of the beam on springs at its nodes, foot first."""
    element = _beam(pile.length / _ELEMENTS, pile)
    top = np.diag([lateral[0], rocking[0]])
    for sway, turn in zip(lateral[1:], rocking[1:], strict=True):
        # One node after the other is condensed into the next, like springs in series.
        carried = np.linalg.solve(element[:2, :2] + top, element[:2, 2:])
        top = element[2:, 2:] - element[2:, :2] @ carried + np.diag([sway, turn])
    return top


def _beam(length: float, pile: WisdemPile) -> Array:
    """(4, 4) Timoshenko element: displacement and rotation below, then above.

    Przemieniecki, Theory of Matrix Structural Analysis, McGraw-Hill 1968, section 5.6, as Frame3DD.
    """
    shear = 12 * pile.bending / (pile.shear * length**2)
    near, far, arm = (4 + shear) * length**2, (2 - shear) * length**2, 6 * length
    rows = [
        [12, arm, -12, arm],
        [arm, near, -arm, far],
        [-12, -arm, 12, -arm],
        [arm, far, -arm, near],
    ]
    return pile.bending / ((1 + shear) * length**3) * np.array(rows)


def _left_out(matrix: Array) -> float:
    """Largest coupling that diagonal springs on a straight pile do not make, if it is small."""
    size = np.sqrt(np.abs(np.diag(matrix)))
    other = np.abs(matrix - np.diag(np.diag(matrix)))
    for i, j in ((0, 4), (1, 3)):
        other[i, j] = other[j, i] = 0.0
    scale = np.outer(size, size)
    other = np.divide(other, scale, out=np.where(other > 0, np.inf, 0.0), where=scale > 0)
    i, j = divmod(int(np.argmax(other)), 6)
    if other[i, j] > _LEFT_OUT:
        raise InputError(
            "stiffness",
            f"{matrix[i, j]:.6g} in row {i + 1}, column {j + 1}",
            "couplings of x with ry and of y with rx only",
            "Condense a state with less horizontal load, or set the entry to zero if it is "
            "negligible.",
        )
    return float(other[i, j])


def _read(path: Path) -> tuple[Array, Array]:
    text = read_text(path, _LARGEST_FILE)
    try:
        data = json.loads(text)
        heights, springs = np.array(data["z_soil"]), np.array(data["k_soil"])
        if not {heights.dtype.kind, springs.dtype.kind} <= set("if"):
            raise TypeError("something else than numbers")
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        allowed = "a JSON file with numbers in z_soil and k_soil"
        raise InputError(str(path), repr(error), allowed, "Write it with write_wisdem.") from None
    shapes = heights.shape == (_HEIGHTS,) and springs.shape == (_HEIGHTS, 6)
    if (
        not shapes
        or not np.all(np.diff(heights) > 0)
        or not np.all((springs >= 0) & np.isfinite(springs))
    ):
        raise InputError(
            str(path),
            f"z_soil {heights.shape} and k_soil {springs.shape}",
            f"{_HEIGHTS} rising heights and {_HEIGHTS} by 6 springs of zero or more",
            "Write it with write_wisdem.",
        )
    return heights.astype(float), springs.astype(float)
