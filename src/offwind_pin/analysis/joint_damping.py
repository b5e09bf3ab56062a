"""Stiffness-proportional joint damping calibrated on modes of the supported structure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.mode_labels import mode_family
from offwind_pin.dynamics.system import System
from offwind_pin.structure.chain import Chain

PLANES = ("SS", "FA", "T")

_STILL = 0.01
"""Share of a mode's potential energy in all joints below which they cannot damp it."""
_SMALL = 1e-3
"""The same of a region, below which its factor is not to be found from a mode."""
_EVENNESS = 1e-4
"""Weight of equal factors in all regions, where the ratios asked for leave a choice."""


@dataclass(frozen=True)
class JointDamping:
    """Stiffness-proportional joint damping by region and plane.

    Attributes
    ----------
    factor : dict of str to (float, float, float), s
        Damping over stiffness, by region: (side-side, fore-aft, torsion).
    """

    factor: dict[str, tuple[float, float, float]]

    def of(self, chain: Chain) -> Array:
        """(N, d) damping of a chain's joints in N m s/rad and N s/m.

        The embedded pile has none: the springs at the mudline that stand for it in a calibration
        have none either, and its soil has dashpots of its own.
        """
        rows = np.array([self.factor.get(region, (0.0, 0.0, 0.0)) for region in chain.region])
        side_side, fore_aft, torsion = rows.T
        plane = {"px": fore_aft, "ry": fore_aft, "py": side_side, "rx": side_side, "rz": torsion}
        return chain.joint_stiffness * np.column_stack([plane[j] for j in chain.node_joints])


def calibrate(system: System, result: ModalResult, ratios: Mapping[str, float]) -> JointDamping:
    """Factors by region and plane that bring the named modes as near to their ratios as they can.

    Non-negative least squares on phi' D phi = 2 zeta omega, which is linear in the factors. A plane
    in which no mode is named has the factors of the other plane, or of torsion if only that is
    named; torsion has the mean of the planes unless it is named. Where several regions can give the
    same ratios, their factors are as equal as possible.

    Parameters
    ----------
    system : System
        Undamped.
    result : ModalResult
        Its modes.
    ratios : mapping of str to float
        Damping ratios by label, of critical.

    Raises
    ------
    InputError
        Ratios of modes that do not bend or twist the structure.
    """
    regions = sorted({region for region in system.chain.region if region != "pile"})
    spread = _spread({mode_family(label) for label in ratios})
    index = [result.index(label) for label in ratios]
    columns, owner = [], []
    for region in regions:
        for unknown, planes in spread.items():
            factor = JointDamping({region: (planes[0], planes[1], planes[2])})
            columns.append(joint_ratios(system, result, factor.of(system.chain).ravel())[index])
            owner.append(unknown)
    matrix = np.array(columns).T
    share = matrix / (np.pi * result.frequency_hz[index])[:, None]
    still = [label for label, of in zip(ratios, share.sum(axis=1), strict=True) if of < _STILL]
    if still:
        raise InputError(
            f"turbine {system.turbine.name}, field structural_damping.ratios_of_critical",
            ", ".join(still),
            "modes that bend or twist the structure",
            "Dampers in the joints do not move in the others; leave them out.",
        )
    wanted = np.array(list(ratios.values()))
    distinct = bool(np.all(share.max(axis=0) > _SMALL))
    factors = _fitted(matrix / wanted[:, None], np.array(owner), distinct=distinct)
    per_region = factors.reshape(len(regions), len(spread))
    weights = np.array(list(spread.values()))
    return JointDamping(
        {
            region: (float(row[0]), float(row[1]), float(row[2]))
            for region, row in zip(regions, per_region @ weights, strict=True)
        }
    )


def joint_ratios(system: System, result: ModalResult, damping: Array) -> Array:
    """(n,) damping ratios that dampers (j,) in the joints of the nodes alone give to the modes."""
    rates = result.vector[system.chain.roots : system.chain.axis_joints]
    omega = 2 * np.pi * result.frequency_hz
    return np.asarray(np.sum(damping[:, None] * rates**2, axis=0) / (2 * omega))


def _spread(named: set[str]) -> dict[str, tuple[float, float, float]]:
    """Unknown factors of a region, and how each enters (side-side, fore-aft, torsion)."""
    torsion = 0.0 if "T" in named else 0.5
    if {"SS", "FA"} <= named:
        spread = {"SS": (1.0, 0.0, torsion), "FA": (0.0, 1.0, torsion)}
    elif named & {"SS", "FA"}:
        spread = {"both": (1.0, 1.0, 2 * torsion)}
    else:
        return {"all": (1.0, 1.0, 1.0)}
    return spread | ({"T": (0.0, 0.0, 1.0)} if "T" in named else {})


def _fitted(
    matrix: Array, owner: np.ndarray[tuple[int], np.dtype[np.str_]], *, distinct: bool
) -> Array:
    """Non-negative factors for which the products with the matrix are nearest to 1.

    A unique unconstrained solution that is not negative is the answer, where all factors matter.
    SciPy's optimisers, which are slow to import, are needed otherwise only. There equal factors of
    one owner have a small weight, which decides what the modes leave open.
    """
    wanted = np.ones(len(matrix))
    if distinct:
        free, _, rank, _ = np.linalg.lstsq(matrix, wanted)
        if rank == matrix.shape[1] and np.all(free >= 0):
            return np.asarray(free)
    from scipy.optimize import nnls

    size = 1 / matrix.sum(axis=1).max()  # in s, of a factor
    pairs = [
        (i, j)
        for i, name in enumerate(owner)
        for j in np.flatnonzero(owner[i + 1 :] == name)[:1] + i + 1
    ]
    even = np.zeros((len(pairs), matrix.shape[1]))
    for row, (i, j) in zip(even, pairs, strict=True):
        row[i], row[j] = _EVENNESS, -_EVENNESS
    whole = np.vstack([size * matrix, even])
    return np.asarray(size * nnls(whole, np.concatenate([wanted, np.zeros(len(pairs))]))[0])
