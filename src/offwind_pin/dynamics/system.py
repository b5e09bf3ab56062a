"""Chain, foundation and sea of a turbine as one system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import html_table
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.soil.foundation import Foundation
from offwind_pin.loads.structural.inertial_damping import InertialDamping
from offwind_pin.structure.chain import Chain

if TYPE_CHECKING:
    import pinocchio as pin

    from offwind_pin.dynamics.reference.equations import Equations
    from offwind_pin.structure.pinocchio_model import Scratch


@dataclass(frozen=True, eq=False)
class System:
    """A turbine on its foundation in its sea, as a system of equations.

    Attributes
    ----------
    turbine : Turbine
        Definition of the turbine.
    foundation : Foundation
        The foundation.
    chain : Chain
        Bodies and joints of the structure.
    sea : Sea or None
        None for a dry structure.
    joint_stiffness, joint_damping : (nv,) array
        Coefficients of the chain's joint springs and dampers, zero at the root.
    damping_ratios : dict of str to float
        Achieved ratios of the named modes by label, for the record.
    structural_loads : tuple of InertialDamping
        Structural damping that acts between the structure and the inertial frame.
    damping_cautions : tuple of str
        Sentences about structural damping that differs from what was asked for.
    """

    turbine: Turbine
    foundation: Foundation
    chain: Chain
    sea: Sea | None
    joint_stiffness: Array
    joint_damping: Array
    damping_ratios: dict[str, float]
    structural_loads: tuple[InertialDamping, ...] = ()
    damping_cautions: tuple[str, ...] = ()

    def __repr__(self) -> str:
        sea = "dry" if self.sea is None else type(self.sea).__name__
        return (
            f"System({self.turbine.name}, {self.foundation.name}, {sea}, "
            f"{self.chain.elements} elements, {self.nv} degrees of freedom)"
        )

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        rows = [
            ("foundation", self.foundation.name),
            ("sea", "dry" if self.sea is None else repr(self.sea)),
            ("elements", self.chain.elements),
            ("degrees of freedom", self.nv),
            ("base (m)", f"{self.chain.base:.2f}"),
            ("yaw bearing (m)", f"{self.chain.top:.2f}"),
            ("mass (t)", f"{self.chain.mass / 1e3:.1f}"),
            *(
                (f"damping ratio of {label} (%)", f"{100 * ratio:.3g}")
                for label, ratio in self.damping_ratios.items()
            ),
        ]
        return html_table(f"System of {self.turbine.name}", (), rows)

    @property
    def nv(self) -> int:
        """Number of degrees of freedom."""
        return len(self.chain.joint_name)

    @cached_property
    def pin_model(self) -> pin.Model:
        """The ``pinocchio.Model``, read from the URDF on first use; must not be changed."""
        from offwind_pin.structure.pinocchio_model import build_model

        return build_model(self.turbine, self.chain)

    @cached_property
    def scratch(self) -> Scratch:
        """Pinocchio's scratch data, one per thread."""
        from offwind_pin.structure.pinocchio_model import Scratch

        return Scratch(self.pin_model)

    def __getstate__(self) -> dict[str, Any]:
        """Everything but Pinocchio's objects, which a copy creates on first use."""
        return {k: v for k, v in vars(self).items() if k not in {"pin_model", "scratch"}}

    @cached_property
    def hydrodynamics(self) -> HydrodynamicModel | None:
        """Hydrodynamic model of the realised sea; None for a dry structure."""
        return None if self.sea is None else HydrodynamicModel.of(self.turbine, self.sea)

    def with_damping(
        self,
        joint_damping: Array,
        ratios: dict[str, float],
        structural_loads: tuple[InertialDamping, ...] = (),
        cautions: tuple[str, ...] = (),
    ) -> System:
        """The same system with other structural damping.

        Parameters
        ----------
        joint_damping : (nv,) array
        ratios : dict of str to float
            Achieved damping ratios by mode label.
        structural_loads : tuple of InertialDamping, optional
        cautions : tuple of str, optional

        Returns
        -------
        System
        """
        return replace(
            self,
            joint_damping=joint_damping,
            damping_ratios=ratios,
            structural_loads=structural_loads,
            damping_cautions=cautions,
        )

    def equations(
        self,
        loads: Sequence[PointLoad] = (),
        ramp_time: float | None = 0.0,
        memory: Array | None = None,
        ground_motion: GroundMotion | None = None,
    ) -> Equations:
        """Equations of motion under loads, by Pinocchio.

        Parameters
        ----------
        loads : sequence of PointLoad
            Further loads.
        ramp_time : float or None, s
            Length of the ramp; None for the mean loads alone, as in statics and modes.
        memory : (M,) array, optional
            Memory of soil and foundation, as in :class:`StaticResult`; zero by default.
        ground_motion : GroundMotion, optional
            Earthquake; root joints then move relative to the ground.

        Returns
        -------
        Equations
        """
        from offwind_pin.dynamics.reference.equations import Equations

        return Equations(self, loads, ramp_time, memory, ground_motion)
