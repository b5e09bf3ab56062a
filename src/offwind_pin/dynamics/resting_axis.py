"""The axis of a structure at rest."""

from __future__ import annotations

from typing import NamedTuple

from offwind_pin.base.definition import Array


class RestingAxis(NamedTuple):
    """Displacement, direction and section loads of the axis at m heights.

    displacement : (m, 3) in m; direction : (m, 3) unit vectors along the axis, upwards;
    section_load : (m, 6) force (N) and moment (N m) that the part above exerts on the part below
    """

    displacement: Array
    direction: Array
    section_load: Array
