"""What is recorded of a time history, and when."""

from __future__ import annotations

from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, Number, Numbers, Positive


class SaveAt(Definition, kw_only=False):
    """What a time history records.

    Attributes
    ----------
    output_dt : float, s, optional
        Interval of the output, a multiple of the time step; by default every step.
    heights : tuple of float, m, optional
        Where motion and section loads are recorded, by default the element boundaries; mudline and
        yaw bearing are added.
    segments : tuple of (float, float), m, optional
        Lower and upper ends of the parts whose equilibrium is recorded as ``segment_imbalance``, by
        default the whole structure and its parts above and below the mudline.
    channels : tuple of str, optional
        Names of the channels that are kept; all unless given.
    """

    output_dt: Positive | None = None
    heights: Numbers | None = Field(default=None, kw_only=True)
    segments: tuple[tuple[Number, Number], ...] | None = Field(default=None, kw_only=True)
    channels: tuple[str, ...] | None = Field(default=None, kw_only=True)

    @model_validator(mode="after")
    def _segments_rise(self) -> SaveAt:
        for low, high in self.segments or ():
            if not low < high:
                raise ValueError(f"segments: ({low}, {high}) needs a lower end before a higher one")
        return self
