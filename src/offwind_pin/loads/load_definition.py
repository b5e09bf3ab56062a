"""Loads as case files name them."""

from __future__ import annotations

from abc import abstractmethod
from typing import Protocol

from offwind_pin.base.definition import Definition
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.structure.chain import Chain


class Structure(Protocol):
    """What a load is made for: a system, as far as loads know it."""

    @property
    def turbine(self) -> Turbine: ...

    @property
    def chain(self) -> Chain: ...

    @property
    def hydrodynamics(self) -> HydrodynamicModel | None: ...


class LoadDefinition(Definition):
    """A load as a case file names it; it acts in time, its mean also in statics and modes."""

    @abstractmethod
    def on(self, structure: Structure) -> PointLoad:
        """Create the load on a structure.

        Parameters
        ----------
        structure : Structure
            Turbine, chain and hydrodynamic model, such as a :class:`System`.

        Returns
        -------
        PointLoad

        Raises
        ------
        InputError
            The load cannot act on the structure.
        """
