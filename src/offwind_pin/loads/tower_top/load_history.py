"""Load histories at the yaw bearing: six components over time, from a file or generated."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from offwind_pin.base.channels import Channel
from offwind_pin.base.definition import Array, origin_of
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import read_time_columns
from offwind_pin.loads.point_load import KernelLoad, force_kernel, no_tangents

COMPONENTS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
LARGEST_LOAD = 1e10
"""N or N m, larger than the loads of any turbine."""
_COARSEST, _SAMPLED = 0.99, 1000
"""Step in s beyond which files of more than so many rows are more likely in ms."""

TOWER_TOP_LOAD = Channel(
    "tower_top_load", ("component",), "N for F, N m for M", "load applied at the yaw bearing"
)


@dataclass(frozen=True, eq=False)
class LoadHistory:
    """Samples of a load at the yaw bearing.

    Attributes
    ----------
    time : (t,) array, s
        Rising.
    load : (t, 6) array, N and N m
        Fx, Fy, Fz, Mx, My, Mz in the inertial frame.
    origin : str
        Where the numbers come from.
    surrogate : str or None
        Why they replace the proper ones; None for a user's own history.
    """

    time: Array
    load: Array
    origin: str
    surrogate: str | None = None

    def __post_init__(self) -> None:
        time, load = np.asarray(self.time, dtype=float), np.asarray(self.load, dtype=float)
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "load", load)
        if time.ndim != 1 or load.shape != (len(time), 6) or len(time) == 0:
            shapes = f"time {time.shape}, load {load.shape}"
            raise InputError("load history", shapes, "time (t,) and load (t, 6)", "Reshape them.")
        if not (np.all(np.isfinite(time)) and np.all(np.isfinite(load))):
            raise InputError("load history", "NaN or infinity", "finite numbers", "Correct them.")
        if np.any(np.diff(time) <= 0):
            raise InputError("load history, time", time.tolist(), "rising times", "Sort them.")

    def mean(self, start: float, end: float) -> Array:
        """Time average of the linearly interpolated history.

        Parameters
        ----------
        start, end : float, s
            Ends of the interval.

        Returns
        -------
        (6,) array, N and N m
        """
        inside = self.time[(self.time > start) & (self.time < end)]
        nodes = np.concatenate([[start], inside, [end]])
        return np.trapezoid(self.at(nodes), nodes, axis=0) / (end - start)

    def at(self, time: Array | float) -> Array:
        """Load by linear interpolation, constant beyond both ends.

        Parameters
        ----------
        time : (t,) array or float, s

        Returns
        -------
        (t, 6) or (6,) array, N and N m
        """
        if len(self.time) == 1:
            return self.load[np.zeros(np.shape(time), dtype=np.intp)]
        upper = np.clip(np.searchsorted(self.time, time), 1, len(self.time) - 1)
        start, end = self.time[upper - 1], self.time[upper]
        share = np.clip((np.asarray(time) - start) / (end - start), 0.0, 1.0)[..., None]
        return (1 - share) * self.load[upper - 1] + share * self.load[upper]

    def acting(self, yaw_bearing: float, start: float, end: float) -> TowerTopLoad:
        """The history as a load on a structure.

        Parameters
        ----------
        yaw_bearing : float, m
            Height of the yaw bearing.
        start, end : float, s
            Interval over which the mean is taken.

        Returns
        -------
        TowerTopLoad

        Raises
        ------
        InputError
            Samples that do not cover the time from 0 to the end.
        """
        if self.time[0] > 0 or self.time[-1] < end - 1e-9:
            raise InputError(
                f"load history {self.origin!r}, time",
                f"{self.time[0]} to {self.time[-1]} s",
                f"samples from 0 to at least {end} s",
                "Shorten the simulation or extend the file.",
            )
        return TowerTopLoad(yaw_bearing, self, self.mean(start, end))


@force_kernel
def _forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    for j in range(6):
        force[0, j] = time_inputs[j]
    return 0.0


@dataclass(frozen=True, eq=False)
class TowerTopLoad(KernelLoad):
    """A load history applied at the yaw bearing; its departure from the mean is ramped.

    yaw_bearing : height in m
    mean : (6,) load that acts fully from the start, in N and N m
    """

    yaw_bearing: float
    history: LoadHistory
    mean: Array
    name: str = "tower_top"

    force_kernel = _forces
    tangent_kernel = no_tangents

    @property
    def height(self) -> Array:
        return np.array([self.yaw_bearing])

    @property
    def constants(self) -> Array:
        return np.zeros((1, 0))

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 6) applied load."""
        return self.mean + ramp_factor[:, None] * (self.history.at(time) - self.mean)

    @property
    def surrogate(self) -> str | None:
        return self.history.surrogate

    @property
    def channels(self) -> tuple[Channel, ...]:
        return (TOWER_TOP_LOAD,)

    def outputs(self, time: Array, ramp_factor: Array) -> dict[str, Array]:
        return {TOWER_TOP_LOAD.name: self.time_inputs(time, ramp_factor)}

    def attributes(self) -> dict[str, str]:
        return {"tower_top_load_origin": self.history.origin}


def constant_load(yaw_bearing: float, load: Array) -> TowerTopLoad:
    """A constant load (6,) Fx, Fy, Fz, Mx, My, Mz in N and N m.

    Raises
    ------
    InputError
        Not six finite numbers.
    """
    load = np.asarray(load, dtype=float)
    if load.shape != (6,) or not np.all(np.isfinite(load)):
        raise InputError(
            "tower-top load",
            load.tolist(),
            "six finite numbers Fx, Fy, Fz, Mx, My, Mz in N and N m",
            "Give all six.",
        )
    history = LoadHistory(np.array([0.0]), load[None, :], origin="constant")
    return TowerTopLoad(yaw_bearing, history, load)


def read_load_history(path: Path) -> LoadHistory:
    """Read a file of seven columns t, Fx, Fy, Fz, Mx, My, Mz in s, N and N m.

    This is the format of OpenFAST's prescribed forces; for separators see
    :func:`read_time_columns`. Between samples the load is interpolated linearly.

    Parameters
    ----------
    path : Path

    Returns
    -------
    LoadHistory

    Raises
    ------
    InputError
        Missing, empty or truncated file; a cell that is not a number; times that do not rise, leave
        a gap, or are not in s; loads beyond those of any turbine.
    """
    table = read_time_columns(path, 7, coarsest=_COARSEST, sampled=_SAMPLED)
    load = table.values[:, 1:]
    beyond = np.flatnonzero(np.max(np.abs(load), axis=1) > LARGEST_LOAD)
    if len(beyond):
        row = load[beyond[0]]
        raise InputError(
            f"{path}, line {table.lines[beyond[0]]}",
            row[np.argmax(np.abs(row))],
            f"loads below {LARGEST_LOAD:g} N or N m",
            "Are the units N and N m?",
        )
    return LoadHistory(table.values[:, 0], load, origin_of(path))
