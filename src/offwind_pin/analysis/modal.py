"""Natural modes about a static state, labelled by direction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from offwind_pin.analysis.engines import check_engine, pencil
from offwind_pin.analysis.static import StaticResult, static
from offwind_pin.base.arguments import checked
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import cut, html_table
from offwind_pin.base.errors import InputError, SolverError
from offwind_pin.base.mode_labels import DAMPING_PARTS, FAMILIES, mode_name
from offwind_pin.definitions.engine import Engine
from offwind_pin.dynamics.acting_loads import part_of_loads
from offwind_pin.dynamics.system import System

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from offwind_pin.dynamics.compiled.pencil import CompiledPencil
    from offwind_pin.dynamics.reference.dense_pencil import DensePencil

_FAMILY_OF_JOINT = {"px": "FA", "ry": "FA", "py": "SS", "rx": "SS", "rz": "T", "pz": "V"}
_MOSTLY = 0.5
"""Share of the potential energy in springs of tuned mass dampers above which a mode is theirs."""
_EQUAL = 1e-6
"""Relative difference of squared frequencies below which two modes form a pair."""
_STILL = 1e-9
"""Motion of the axis over the largest joint displacement that counts as rounding error."""
_OF_EACH_MODE = (
    "frequency_hz",
    "damping_ratio",
    "damping_parts",
    "damping_asked",
    "participation",
    "damper_share",
    "shape",
    "mass_normalised",
    "shape_peak_height_ratio",
)
_SHOWN = {"FA": 0, "SS": 1, "V": 2, "T": 5}


@dataclass(frozen=True, eq=False)
class ModalResult:
    """Natural modes of a system about a static state, in order of frequency.

    Attributes
    ----------
    frequency_hz : (n,) array
        Undamped natural frequencies.
    damping_ratio : (n,) array
        phi' D phi / (2 omega), of critical; exact for light damping.
    damping_parts : (n, 4) array
        What structure, soil, water and the rest (loads, tuned mass dampers) contribute to it.
    damping_asked : (n,) array
        Structural damping ratio that the turbine file asks for; NaN for none.
    label : list of str
        Labels FA1, SS1, T1, V1, ..., numbered by frequency within each family. Modes of tuned mass
        dampers are TMD1, TMD2, ...: in each plane up to the number of dampers that slide in it,
        those with the largest share of the potential energy in damper springs, at least half.
    participation : (n, 4) array
        Share of the potential energy in FA, SS, T, V; dampers' springs count in their plane.
    damper_share : (n,) array
        Share of the potential energy in the springs of tuned mass dampers.
    height : (m,) array, m
        Heights of the element boundaries.
    shape : (n, m, 6) array
        Displacements (m) and rotations (rad) of the axis, unit peak in the mode's own direction
        (translation, or rotation about z for torsion), positive there.
    mass_normalised : (n, m, 6) array
        The same, with unit modal mass.
    vector : (nv, n) array
        Mass-normalised joint displacements.
    shape_peak_height_ratio : (n,) array
        Height of the peak from mudline (0) to yaw bearing (1).
    engine : {"compiled", "pinocchio"}
        Engine that evaluated the equations.
    """

    frequency_hz: Array
    damping_ratio: Array
    damping_parts: Array
    damping_asked: Array
    label: list[str]
    participation: Array
    damper_share: Array
    height: Array
    shape: Array
    mass_normalised: Array
    vector: Array
    shape_peak_height_ratio: Array
    engine: Engine = "compiled"

    def __repr__(self) -> str:
        found = [
            f"{label} {frequency:.4g} Hz"
            for label, frequency in zip(self.label, self.frequency_hz, strict=True)
        ]
        return cut(f"ModalResult({', '.join(found)})")

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        rows = [
            (label, mode_name(label), f"{f:.4f}", f"{100 * zeta:.2f}", f"{peak:.2f}")
            for label, f, zeta, peak in zip(
                self.label,
                self.frequency_hz,
                self.damping_ratio,
                self.shape_peak_height_ratio,
                strict=True,
            )
        ]
        columns = ("mode", "", "frequency (Hz)", "damping ratio (%)", "peak over height")
        return html_table("Natural modes", columns, rows)

    def index(self, label: str) -> int:
        """Index of a mode.

        Parameters
        ----------
        label : str
            Label such as ``"FA1"``.

        Returns
        -------
        int
            Index of the mode in the arrays.

        Raises
        ------
        InputError
            No mode of that label among those computed.
        """
        if label not in self.label:
            raise InputError(
                "mode", label, ", ".join(self.label), "Choose one of them, or compute more modes."
            )
        return self.label.index(label)

    def to_dataset(self) -> xr.Dataset:
        """The modes as a labelled dataset.

        Returns
        -------
        Dataset
        """
        from offwind_pin.results.states import modal_dataset

        return modal_dataset(
            self.height,
            self.label,
            frequency_hz=self.frequency_hz,
            damping_ratio=self.damping_ratio,
            damping_parts=self.damping_parts,
            damping_asked=self.damping_asked,
            shape=self.shape,
            mass_normalised=self.mass_normalised,
            participation=self.participation,
            families=list(FAMILIES),
            damper_share=self.damper_share,
            vector=self.vector,
            peak_height_ratio=self.shape_peak_height_ratio,
            engine=self.engine,
        )

    @staticmethod
    def from_dataset(data: xr.Dataset) -> ModalResult:
        """Modes read back from :meth:`to_dataset`.

        Parameters
        ----------
        data : Dataset
            From :meth:`to_dataset`.

        Returns
        -------
        ModalResult
        """
        return ModalResult(
            frequency_hz=data["frequency"].to_numpy(),
            damping_ratio=data["damping_ratio"].to_numpy(),
            damping_parts=data["damping_parts"].to_numpy(),
            damping_asked=data["damping_asked"].to_numpy(),
            label=[str(label) for label in data["mode"].to_numpy()],
            participation=data["participation"].to_numpy(),
            damper_share=data["damper_share"].to_numpy(),
            height=data["height"].to_numpy(),
            shape=data["shape"].to_numpy(),
            mass_normalised=data["mass_normalised"].to_numpy(),
            vector=data["joint_shape"].to_numpy(),
            shape_peak_height_ratio=data["peak_height_ratio"].to_numpy(),
            engine=data.attrs["engine"],
        )

    def to_dataframe(self) -> pd.DataFrame:
        """Table with one row per mode: frequency, damping, peak and participations.

        Returns
        -------
        DataFrame
        """
        import pandas as pd

        columns = {
            "frequency_hz": self.frequency_hz,
            "damping_ratio": self.damping_ratio,
            "damping_ratio_asked": self.damping_asked,
            **{
                f"damping_ratio_{name}": self.damping_parts[:, i]
                for i, name in enumerate(DAMPING_PARTS)
            },
            "shape_peak_height_ratio": self.shape_peak_height_ratio,
            **{f"share_{name}": self.participation[:, i] for i, name in enumerate(FAMILIES)},
            "share_dampers": self.damper_share,
        }
        return pd.DataFrame(columns, index=pd.Index(self.label, name="mode"))

    def subset(self, kept: Sequence[int]) -> ModalResult:
        """Some of the modes.

        Parameters
        ----------
        kept : sequence of int
            Their indices.

        Returns
        -------
        ModalResult
        """
        rows = list(kept)
        return replace(
            self,
            label=[self.label[i] for i in rows],
            vector=self.vector[:, rows],
            **{name: getattr(self, name)[rows] for name in _OF_EACH_MODE},
        )

    def direction(self, label: str) -> str:
        """Direction in which a mode moves.

        Parameters
        ----------
        label : str
            Label such as ``"FA1"``.

        Returns
        -------
        str
        """
        return list(FAMILIES)[int(np.argmax(self.participation[self.index(label)]))]


@checked
def modes(
    system: System,
    n: int = 8,
    about: StaticResult | None = None,
    *,
    engine: Engine = "compiled",
) -> ModalResult:
    """Natural modes with added mass, soil tangent and geometric stiffness of a static state.

    Parameters
    ----------
    system : System
    n : int
        Number of modes.
    about : StaticResult, optional
        Static state; by default that under gravity alone.
    engine : {"compiled", "pinocchio"}
        Implementation of the equations of motion.

    Returns
    -------
    ModalResult

    Raises
    ------
    InputError
        n outside 1 ... number of degrees of freedom, or an unknown engine.
    SolverError
        The static state was not found, or the modes were not.
    """
    check_engine(engine)
    if not 1 <= n <= system.nv:
        raise InputError("n", n, f"1 to {system.nv}", "Use fewer modes or more elements.")
    state = about or static(system, engine=engine)
    if state.q.shape != (system.nv,):
        allowed = f"a static state of this system, with {system.nv} degrees of freedom"
        raise InputError(
            "about",
            f"a state with {len(state.q)} degrees of freedom",
            allowed,
            "Solve the static state again.",
        )
    linear = pencil(system, state, engine)
    # One mode more than requested, so that no pair of equal frequency is split, and more with
    # dampers, so that labels do not depend on the number of modes.
    count = n + 1 + 2 * (system.nv - system.chain.axis_joints)
    found = _lowest(system, linear, min(count, system.nv))
    vectors = _separate_planes(system, linear, *found)
    work = vectors * linear.stiffness_times(vectors)
    participation = _participation(system, work)
    share = _damper_share(system, vectors, work)
    label, family = (part[:n] for part in _labels(participation, share, _sliding(system)))
    vectors = vectors[:, :n]
    omega = np.sqrt(found[0][:n])
    dissipation = np.sum(vectors * linear.damping_times(vectors), axis=0)
    parts = _dissipation_by_part(system, state, linear.dissipation(vectors), vectors)
    asked = system.turbine.structural_damping
    height = system.chain.boundary
    shape = np.array([linear.axis_shape(vector, height) for vector in vectors.T])
    peak = np.empty(n)
    unit = np.empty_like(shape)
    normalised = np.empty_like(shape)
    above_mudline = np.flatnonzero(height >= system.turbine.site.mudline - 1e-9)
    for i in range(n):
        if np.abs(shape[i]).max() <= _STILL * np.abs(vectors[:, i]).max():
            shape[i] = 0.0  # a damper on a clamped base does not move the axis
        shown = shape[i, :, _SHOWN[family[i]]]
        at = above_mudline[np.argmax(np.abs(shown[above_mudline]))]
        size = float(shown[at]) or 1.0
        normalised[i] = shape[i] * np.sign(size)
        vectors[:, i] *= np.sign(size)
        unit[i] = shape[i] / size
        peak[i] = _peak_height(height, np.abs(shown), int(at))
    mudline, top = system.turbine.site.mudline, system.chain.top
    return ModalResult(
        frequency_hz=omega / (2 * np.pi),
        damping_ratio=dissipation / (2 * omega),
        damping_parts=(parts / (2 * omega)).T,
        damping_asked=np.array(
            [
                np.nan if asked is None else asked.ratio_of(mode, w / (2 * np.pi))
                for mode, w in zip(label, omega, strict=True)
            ]
        ),
        label=label,
        participation=participation[:n],
        damper_share=share[:n],
        height=height,
        shape=unit,
        mass_normalised=normalised,
        vector=vectors,
        shape_peak_height_ratio=(peak - mudline) / (top - mudline),
        engine=engine,
    )


def _dissipation_by_part(
    system: System, state: StaticResult, of_loads: Array, vectors: Array
) -> Array:
    """(4, n) power that each of :data:`DAMPING_PARTS` dissipates at joint velocities (nv, n).

    of_loads : (L + 1, n) of each load and, last, of the root
    """
    joints = system.joint_damping[:, None] * vectors**2
    powers = dict.fromkeys(DAMPING_PARTS, np.zeros(vectors.shape[1]))
    powers["structural"] = joints[: system.chain.axis_joints].sum(axis=0)
    powers["other"] = joints[system.chain.axis_joints :].sum(axis=0)
    owners = [*part_of_loads(system, state.acting_loads()), "soil"]
    for owner, power in zip(owners, of_loads, strict=True):
        powers[owner] = powers[owner] + power
    return np.array(list(powers.values()))


def _lowest(
    system: System, linear: CompiledPencil | DensePencil, count: int
) -> tuple[Array, Array]:
    """Squares of the lowest circular frequencies (count,) and their modes (nv, count).

    Raises
    ------
    SolverError
        They were not found, or are not positive.
    """
    reason = "a square of a frequency is not positive"
    try:
        squares, vectors = linear.lowest(count)
    except np.linalg.LinAlgError as error:
        reason = str(error)
    else:
        if np.all(np.isfinite(squares) & (squares > 0)) and np.all(np.isfinite(vectors)):
            return squares, vectors
    stiffest = int(np.argmax(system.joint_stiffness))
    raise SolverError(
        f"natural modes: {reason}; are the stiffness of the joint below ("
        f"{system.joint_stiffness[stiffest]:.3g} N m/rad) and the masses in proportion?",
        step=count,
        joint=system.chain.joint_name[stiffest],
        residual=float("nan"),
    )


def _participation(system: System, work: Array) -> Array:
    """(n, 4) share of each family's joints in the potential energy of each mode.

    work : (nv, n) of each joint in each mode
    """
    kind = _family_of_joints(system)
    energy = np.array([work[kind == family].sum(axis=0) for family in FAMILIES]).T
    return energy / energy.sum(axis=1, keepdims=True)


def _damper_share(system: System, vectors: Array, work: Array) -> Array:
    """(n,) share of the tuned mass dampers' springs in the potential energy of each mode."""
    springs = system.joint_stiffness[system.chain.axis_joints :, None]
    stored = np.sum(springs * vectors[system.chain.axis_joints :] ** 2, axis=0)
    return np.asarray(stored / work.sum(axis=0))


def _separate_planes(
    system: System, linear: CompiledPencil | DensePencil, squares: Array, vectors: Array
) -> Array:
    """Rotate pairs of equal frequency so that one moves fore-aft and the other side-side.

    On an axisymmetric structure any two orthogonal directions are modes.
    """
    fore_aft = _family_of_joints(system) == "FA"
    turned = vectors.copy()
    for i in range(len(squares) - 1):
        if abs(squares[i + 1] - squares[i]) <= _EQUAL * abs(squares[i + 1]):
            pair = turned[:, i : i + 2]
            energy = pair[fore_aft].T @ linear.stiffness_times(pair)[fore_aft]
            _, rotation = np.linalg.eigh((energy + energy.T) / 2)
            turned[:, i : i + 2] = pair @ rotation
    return turned


def _family_of_joints(system: System) -> np.ndarray[tuple[int], np.dtype[np.str_]]:
    return np.array([_FAMILY_OF_JOINT[name[-2:]] for name in system.chain.joint_name])


def _sliding(system: System) -> dict[str, int]:
    """Number of tuned mass dampers that slide in the plane of each family."""
    joints = _family_of_joints(system)[system.chain.axis_joints :].tolist()
    return {family: joints.count(family) for family in FAMILIES}


def _labels(
    participation: Array, damper_share: Array, sliding: dict[str, int]
) -> tuple[list[str], list[str]]:
    """Labels, and the families in whose direction the axis moves."""
    families = list(FAMILIES)
    family = [families[i] for i in np.argmax(participation, axis=1)]
    mode_of = list(family)
    for name, count in sliding.items():
        theirs = [i for i in np.argsort(-damper_share, kind="stable") if family[i] == name]
        for i in theirs[:count]:
            if damper_share[i] >= _MOSTLY:
                mode_of[i] = "TMD"
    label = [f"{name}{mode_of[: i + 1].count(name)}" for i, name in enumerate(mode_of)]
    return label, family


def _peak_height(height: Array, size: Array, at: int) -> float:
    """Height of a maximum, refined by the parabola through it and its neighbours."""
    if at in (0, len(height) - 1):
        return float(height[at])
    curve = np.polyfit(height[at - 1 : at + 2], size[at - 1 : at + 2], 2)
    return float(-curve[1] / (2 * curve[0])) if curve[0] < 0 else float(height[at])
