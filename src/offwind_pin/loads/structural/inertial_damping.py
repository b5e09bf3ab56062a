"""What dampers between the structure and the inertial frame have in common."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar

from offwind_pin.loads.point_load import KernelLoad


class InertialDamping(KernelLoad):
    """Structural damping that is not in joints: a load on velocities relative to the ground."""

    moves_with_ground: ClassVar[bool] = True
    records_soil_force: ClassVar[bool] = False

    @abstractmethod
    def describe(self) -> dict[str, Any]:
        """Plain data for the sidecar."""
