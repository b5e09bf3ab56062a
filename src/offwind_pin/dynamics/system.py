"""Chain, foundation and sea of a turbine as one system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import pinocchio as pin

from offwind_pin.base.definition import Array
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.soil.foundation import Foundation
from offwind_pin.structure.chain import Chain
from offwind_pin.structure.pinocchio_model import Scratch

if TYPE_CHECKING:
    from offwind_pin.dynamics.reference.equations import Equations


@dataclass(frozen=True, eq=False)
class System:
    """A turbine on its foundation in its sea, ready to be solved.

    Attributes
    ----------
    turbine, foundation, chain : what was built
    sea : None for a dry structure
    pin_model : the ``pinocchio.Model``, read-only by agreement
    joint_stiffness, joint_damping : (nv,) of the chain's springs and dampers, zero at the root
    damping_ratios : achieved ratios of the calibrated modes by label, for the record
    scratch : Pinocchio's working memory, one for each thread
    """

    turbine: Turbine
    foundation: Foundation
    chain: Chain
    sea: Sea | None
    pin_model: pin.Model
    joint_stiffness: Array
    joint_damping: Array
    damping_ratios: dict[str, float]
    scratch: Scratch = field(repr=False)

    @property
    def nv(self) -> int:
        return int(self.pin_model.nv)

    @cached_property
    def waters(self) -> HydrodynamicModel | None:
        """The sea as the structure meets it, realised once; None for a dry structure."""
        return None if self.sea is None else HydrodynamicModel.of(self.turbine, self.sea)

    def with_damping(self, joint_damping: Array, ratios: dict[str, float]) -> System:
        """The same system with other joint dampers."""
        return replace(self, joint_damping=joint_damping, damping_ratios=ratios)

    def equations(
        self,
        loads: Sequence[PointLoad] = (),
        ramp_time: float | None = 0.0,
        memory: Array | None = None,
        ground_motion: GroundMotion | None = None,
    ) -> Equations:
        """Equations of motion under loads, by Pinocchio.

        ramp_time : seconds over which waves, and the loads' departures from their means, rise; None
            for the means alone, as in statics and modes
        memory : (m,) what soil and foundation keep of their past, as in :class:`StaticResult`
        ground_motion : of the ground below; root joints then move relative to it
        """
        from offwind_pin.dynamics.reference.equations import Equations

        return Equations(self, loads, ramp_time, memory, ground_motion)
