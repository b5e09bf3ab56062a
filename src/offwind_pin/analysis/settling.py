"""How a structure that gravity meets undeformed comes to rest."""

from __future__ import annotations

from dataclasses import dataclass

from offwind_pin.base.definition import Array


@dataclass(frozen=True, eq=False)
class Settling:
    """How a structure came to rest, beside its static state.

    Attributes
    ----------
    time : (t,) in s
    tower_top : (t, 3) displacement of the yaw bearing in m
    difference : (t,) largest distance of any recorded height from its static place in m
    static : (3,) displacement of the yaw bearing in the static state in m
    """

    time: Array
    tower_top: Array
    difference: Array
    static: Array
