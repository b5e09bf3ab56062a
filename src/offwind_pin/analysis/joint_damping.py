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

_NO_SHARE = 1e-6
"""Share of a mode's stiffness below which a factor is rounding for it."""
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
    omega = 2 * np.pi * result.frequency_hz[index]
    seen = (2 * matrix / omega[:, None]).max(axis=0) > _NO_SHARE
    if not np.all(matrix[:, seen].any(axis=1)):
        missed = [
            label for label, row in zip(ratios, matrix[:, seen], strict=True) if not row.any()
        ]
        raise InputError(
            f"turbine {system.turbine.name}, field structural_damping.ratios_of_critical",
            ", ".join(missed),
            "modes that bend or twist the structure",
            "Dampers in the joints do not move in the others; leave them out.",
        )
    wanted = np.array(list(ratios.values()))
    factors = np.zeros(len(owner))
    factors[seen] = _fitted(matrix[:, seen] / wanted[:, None], np.array(owner)[seen])
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


def _fitted(matrix: Array, owner: np.ndarray[tuple[int], np.dtype[np.str_]]) -> Array:
    """Non-negative factors for which the products with the matrix are nearest to 1.

    A unique unconstrained solution that is not negative is the answer. SciPy's optimisers, which
    are slow to import, are needed otherwise only.
    """
    wanted = np.ones(len(matrix))
    free, _, rank, _ = np.linalg.lstsq(matrix, wanted)
    if rank == matrix.shape[1] and np.all(free >= 0):
        return np.asarray(free)
    from scipy.optimize import nnls

    size = 1 / matrix.sum(axis=1).max()  # in s, of a factor
    if rank < matrix.shape[1]:
        pairs = [
            (i, j)
            for i, name in enumerate(owner)
            for j in np.flatnonzero(owner[i + 1 :] == name)[:1] + i + 1
        ]
        even = np.zeros((len(pairs), matrix.shape[1]))
        for row, (i, j) in zip(even, pairs, strict=True):
            row[i], row[j] = _EVENNESS / size, -_EVENNESS / size
        matrix = np.vstack([matrix, even])
        wanted = np.concatenate([wanted, np.zeros(len(pairs))])
    return np.asarray(nnls(matrix * size, wanted)[0] * size)
