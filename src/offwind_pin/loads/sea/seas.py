"""All sea states of a load case."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from offwind_pin.loads.sea.irregular_waves import IrregularWaves
from offwind_pin.loads.sea.measured_waves import MeasuredWaves
from offwind_pin.loads.sea.sea import DrySea, RegularWaves, StillWater, StreamWaves

SeaChoice = Annotated[
    DrySea | StillWater | RegularWaves | StreamWaves | IrregularWaves | MeasuredWaves,
    Field(discriminator="kind"),
]
