"""Every number that is shipped says where it comes from."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import BaseModel

import offwind_pin as ow
from offwind_pin.cases.case import load_case
from offwind_pin.cases.shipped import shipped_cases


def _unsourced(value: Any, place: str, sourced: bool) -> list[str]:
    """Places of numbers that neither their block nor one around it gives a source for."""
    if isinstance(value, bool):
        return []
    if isinstance(value, int | float):
        return [] if sourced else [place]
    if isinstance(value, BaseModel):
        sourced = sourced or bool(getattr(value, "source", None))
        items = {name: getattr(value, name) for name in type(value).model_fields}.items()
    elif isinstance(value, dict):
        items = value.items()
    elif isinstance(value, tuple | list):
        items = dict(enumerate(value)).items()
    else:
        return []
    return [found for key, part in items for found in _unsourced(part, f"{place}.{key}", sourced)]


@pytest.mark.parametrize("name", ow.shipped_turbines())
def test_every_number_of_a_shipped_turbine_has_a_source(name: str) -> None:
    """Each block of numbers, or a block around it, names its source."""
    assert _unsourced(ow.load_turbine(name), name, sourced=False) == []


def test_a_missing_source_is_found(oc6: ow.Turbine) -> None:
    """Negative control: without its source, the site's numbers are named."""
    bare = oc6.model_copy(update={"site": oc6.site.model_copy(update={"source": None})})
    assert _unsourced(bare, "t", sourced=False) == [
        "t.site.water_depth",
        "t.site.scour_depth",
        "t.site.water_density",
        "t.site.gravity",
    ]


def test_every_published_value_has_a_source() -> None:
    """What a case compares with says where it is printed."""
    published = [row for name in shipped_cases() for row in load_case(name).published]
    assert len(published) >= 15
    assert all(row.source for row in published)


def test_surrogates_say_so(oc6: ow.Turbine) -> None:
    """The soil that stands in for the benchmark's is marked, and the mark reaches the system."""
    springs = oc6.soil.distributed_springs
    assert springs is not None
    assert springs.surrogate
    assert ow.build(oc6, "distributed_springs").foundation.surrogate == springs.surrogate
    assert ow.build(oc6, "clamped").foundation.surrogate is None
