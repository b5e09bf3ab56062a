"""What every definition is made of: numbers with their ranges, and the frozen base class."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


def _reject_bool(value: Any) -> Any:
    if isinstance(value, bool):
        raise ValueError("a number is needed, not true or false")
    return value


Number = Annotated[float, BeforeValidator(_reject_bool), Field(allow_inf_nan=False)]
Positive = Annotated[Number, Field(gt=0)]
NonNegative = Annotated[Number, Field(ge=0)]
Vector3 = tuple[Number, Number, Number]
Vector6 = tuple[Number, Number, Number, Number, Number, Number]


class Definition(BaseModel):
    """Base of every definition: frozen, unknown keys rejected, file keys carry units."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", validate_by_name=True, validate_by_alias=True
    )

    source: str | None = Field(default=None, description="where the numbers come from")


Kind = TypeVar("Kind", bound=Definition)


def with_paths(definition: Kind, change: Callable[[Path], Path]) -> Kind:
    """A copy with every path in it, at whatever depth, changed."""
    changed = {}
    for name in type(definition).model_fields:
        old = new = getattr(definition, name)
        if isinstance(old, Path):
            new = change(old)
        elif isinstance(old, Definition):
            new = with_paths(old, change)
        if new is not old:
            changed[name] = new
    return definition.model_copy(update=changed) if changed else definition
