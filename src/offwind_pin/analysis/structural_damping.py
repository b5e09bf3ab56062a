"""Structural damping calibrated on modes of the supported structure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.turbine import DampingCalibration
from offwind_pin.dynamics.system import System
from offwind_pin.structure.chain import Chain

_SEARCHED_MODES = 12


@dataclass(frozen=True)
class StructuralDamping:
    """Stiffness-proportional joint damping by region and plane.

    Attributes
    ----------
    factor : dict of str to (float, float), s
        Damping over stiffness by region, (side-side, fore-aft); torsion has their mean.
    achieved : dict of str to float
        Damping ratio of the calibrated modes on the calibration system.
    """

    factor: dict[str, tuple[float, float]]
    achieved: dict[str, float]

    def of(self, chain: Chain) -> Array:
        """(N, d) damping of a chain's joints in N m s/rad and N s/m.

        The embedded pile has none: neither have the springs at the mudline that replace it in the
        calibration, and the soil has its own dashpots.
        """
        pairs = np.array([self.factor.get(region, (0.0, 0.0)) for region in chain.region])
        side_side, fore_aft = pairs.T
        torsion = pairs.mean(axis=1)
        plane = {"px": fore_aft, "ry": fore_aft, "py": side_side, "rx": side_side, "rz": torsion}
        return chain.joint_stiffness * np.column_stack([plane[j] for j in chain.node_joints])


def calibrate_damping(undamped: System, calibration: DampingCalibration) -> StructuralDamping:
    """Factors by region and plane that give the named modes their damping ratios.

    Non-negative least squares on phi' D phi = 2 zeta omega, which is linear in the factors. The
    achieved ratios are reported; they equal the requested ones where the factors allow.

    Raises
    ------
    InputError
        A named mode is not among the first twelve.
    """
    result = modes(undamped, n=min(_SEARCHED_MODES, undamped.nv))
    regions = sorted({region for region in undamped.chain.region if region != "pile"})
    labels = list(calibration.ratios)
    index = [_find(result, label) for label in labels]
    unit = np.eye(2 * len(regions))
    columns = []
    for row in unit:
        factor = {region: (row[2 * i], row[2 * i + 1]) for i, region in enumerate(regions)}
        damping = StructuralDamping(factor, {}).of(undamped.chain).ravel()
        columns.append(_modal_ratios(undamped, result, index, damping))
    matrix = np.array(columns).T
    wanted = np.array([calibration.ratios[label] for label in labels])
    factors = _non_negative_least_squares(matrix / wanted[:, None], np.ones(len(wanted)))
    achieved = matrix @ factors
    return StructuralDamping(
        {
            region: (float(factors[2 * i]), float(factors[2 * i + 1]))
            for i, region in enumerate(regions)
        },
        dict(zip(labels, achieved.tolist(), strict=True)),
    )


def _non_negative_least_squares(matrix: Array, wanted: Array) -> Array:
    """Least squares with non-negative unknowns.

    A unique, non-negative unconstrained solution is the answer; only otherwise are SciPy's
    optimisers needed, which are slow to import.
    """
    free, _, rank, _ = np.linalg.lstsq(matrix, wanted)
    if rank == matrix.shape[1] and np.all(free >= 0):
        return np.asarray(free)
    from scipy.optimize import nnls

    return np.asarray(nnls(matrix, wanted)[0])


def _modal_ratios(system: System, result: ModalResult, index: list[int], damping: Array) -> Array:
    """(n,) damping ratios of the chosen modes due to joint dampers alone."""
    rates = result.vector[system.chain.roots : system.chain.axis_joints, index]
    omega = 2 * np.pi * result.frequency_hz[index]
    return np.sum(damping[:, None] * rates**2, axis=0) / (2 * omega)


def _find(result: ModalResult, label: str) -> int:
    if label not in result.label:
        raise InputError(
            f"structural_damping.ratios_of_critical.{label}",
            label,
            ", ".join(result.label),
            "Use labels of modes of the supported structure.",
        )
    return result.label.index(label)
