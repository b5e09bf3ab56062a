"""Measured or published responses as targets, and the responses of a model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from offwind_pin.analysis.build import build
from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.static import StaticResult, static
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.structure.chain import Elements

_MODES = 12
"""Number of modes among which the labels of targets are sought."""
_SHOWN = {"FA": 0, "SS": 1, "V": 2, "T": 5}


class Responses:
    """Responses of a turbine without structural damping, computed when first used."""

    def __init__(
        self,
        turbine: Turbine,
        foundation: str,
        sea: Sea | None,
        element: Element,
        elements: Elements,
    ) -> None:
        self._turbine = turbine.model_copy(update={"structural_damping": None})
        self._sea, self._element, self._elements = sea, element, elements
        self.system = build(self._turbine, foundation, sea, elements=elements, element=element)
        self._states: dict[tuple[bool, tuple[float, ...] | None], StaticResult] = {}

    @cached_property
    def modes(self) -> ModalResult:
        """Modes about the state under gravity."""
        count = min(_MODES, self.system.nv)
        return modes(self.system, count, about=self.state(None))

    @cached_property
    def clamped(self) -> System:
        """The structure above the mudline, clamped there."""
        above = self._elements
        if isinstance(above, Mapping):
            above = {name: n for name, n in above.items() if name != "pile"}
        elif above is not None:
            above = None
        return build(self._turbine, "clamped", self._sea, elements=above, element=self._element)

    def state(self, load: tuple[float, ...] | None, *, clamped: bool = False) -> StaticResult:
        """Static state under gravity and a load (6,) at the yaw bearing."""
        key = (clamped, load)
        if key not in self._states:
            acting = None if load is None else np.array(load)
            self._states[key] = static(self.clamped if clamped else self.system, acting)
        return self._states[key]


class Target(Protocol):
    """A response to be met."""

    @property
    def name(self) -> str:
        """Short name."""

    @property
    def uncertainty(self) -> float:
        """One standard deviation, in the unit of the response."""

    @property
    def wanted(self) -> Array:
        """(k,) response to be met."""

    def found(self, responses: Responses) -> Array:
        """Response of the model.

        Parameters
        ----------
        responses : Responses
            Responses of the model.

        Returns
        -------
        (k,) array
        """


@dataclass(frozen=True)
class FrequencyTarget:
    """Natural frequency of a mode about the static state under gravity.

    Attributes
    ----------
    label : str
        Label of the mode, such as ``"FA1"``.
    value : float, Hz
    uncertainty : float, Hz
        One standard deviation.
    """

    label: str
    value: float
    uncertainty: float

    __repr__ = one_line

    def __post_init__(self) -> None:
        _check(self.name, self.uncertainty, self.value)

    @property
    def name(self) -> str:
        """Short name."""
        return f"{self.label} frequency"

    @property
    def wanted(self) -> Array:
        """(1,) frequency to be met, in Hz."""
        return np.array([self.value])

    def found(self, responses: Responses) -> Array:
        """Frequency of the model.

        Parameters
        ----------
        responses : Responses
            Responses of the model.

        Returns
        -------
        (1,) array, Hz
        """
        result = responses.modes
        return result.frequency_hz[[result.index(self.label)]]


@dataclass(frozen=True)
class DeflectionTarget:
    """Static displacement along x under gravity and a load at the yaw bearing.

    Attributes
    ----------
    value, uncertainty : float, m
        Displacement and one standard deviation; with ``over_clamped`` the relative increase.
    height : float or None, m
        Height of the point on the axis; by default the yaw bearing.
    tower_top_load : tuple of float or None, N and N m
        Fx, Fy, Fz, Mx, My, Mz; none by default.
    over_clamped : bool
        Whether the target is the relative increase over the structure clamped at the mudline, such
        as 0.143 for 14.3 %.
    """

    value: float
    uncertainty: float
    height: float | None = None
    tower_top_load: tuple[float, ...] | None = None
    over_clamped: bool = False

    __repr__ = one_line

    def __post_init__(self) -> None:
        _check(self.name, self.uncertainty, self.value)

    @property
    def name(self) -> str:
        """Short name."""
        where = "tower top" if self.height is None else f"z = {self.height:g} m"
        load = "" if self.tower_top_load is None else " under load"
        return f"{'increase' if self.over_clamped else 'displacement'} at {where}{load}"

    @property
    def wanted(self) -> Array:
        """(1,) displacement or increase to be met."""
        return np.array([self.value])

    def found(self, responses: Responses) -> Array:
        """Displacement or increase of the model.

        Parameters
        ----------
        responses : Responses
            Responses of the model.

        Returns
        -------
        (1,) array
        """
        moved = self._displacement(responses.state(self.tower_top_load))
        if self.over_clamped:
            held = self._displacement(responses.state(self.tower_top_load, clamped=True))
            moved = moved / held - 1
        return np.array([moved])

    def _displacement(self, state: StaticResult) -> float:
        at = state.height[-1] if self.height is None else self.height
        if not state.height[0] <= at <= state.height[-1]:
            allowed = f"{state.height[0]:g} to {state.height[-1]:g} m"
            raise InputError(f"target {self.name!r}, height", at, allowed, "Choose one of these.")
        return float(np.interp(at, state.height, state.displacement[:, 0]))


@dataclass(frozen=True)
class ShapeTarget:
    """Mode shape at given heights, in the mode's own direction (rotations for torsion).

    The model's shape is scaled to fit best before it is compared, so the scale of the values does
    not matter.

    Attributes
    ----------
    label : str
        Label of the mode.
    height : tuple of float, m
    value : tuple of float
        Shape at each height, of any scale.
    uncertainty : float
        One standard deviation, in the unit of the values.
    """

    label: str
    height: tuple[float, ...]
    value: tuple[float, ...]
    uncertainty: float

    __repr__ = one_line

    def __post_init__(self) -> None:
        _check(self.name, self.uncertainty, *self.height, *self.value)
        if len(self.height) != len(self.value) or len(self.height) < 2 or not any(self.value):
            sizes = f"{len(self.height)} heights and {len(self.value)} values"
            allowed = "two heights or more, one value per height, not all zero"
            raise InputError(f"target {self.name!r}", sizes, allowed, "Give one value per height.")

    @property
    def name(self) -> str:
        """Short name."""
        return f"{self.label} shape"

    @property
    def wanted(self) -> Array:
        """(k,) shape to be met."""
        return np.array(self.value)

    def found(self, responses: Responses) -> Array:
        """Shape of the model, scaled to the wanted one.

        Parameters
        ----------
        responses : Responses
            Responses of the model.

        Returns
        -------
        (k,) array
        """
        result = responses.modes
        shape = result.shape[result.index(self.label), :, _SHOWN[result.direction(self.label)]]
        at = np.interp(self.height, result.height, shape)
        return at * float(at @ self.wanted) / float(at @ at)


def _check(name: str, uncertainty: float, *numbers: float) -> None:
    if not np.all(np.isfinite(numbers)):
        raise InputError(f"target {name!r}", list(numbers), "finite numbers", "Correct them.")
    if not 0 < uncertainty < np.inf:
        allowed = "a standard deviation above zero"
        raise InputError(f"target {name!r}, uncertainty", uncertainty, allowed, "Give one.")
