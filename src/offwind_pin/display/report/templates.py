"""Template environment of the pages, with its filters."""

from __future__ import annotations

from jinja2 import Environment, PackageLoader, StrictUndefined

from offwind_pin.base.mode_labels import mode_name
from offwind_pin.display.wording import as_given, foundation_name, number, sentence

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'"
)
"""What a page may load: nothing but what it contains."""


def environment() -> Environment:
    """Templates of pages; all values are escaped, and a missing value is an error."""
    made = Environment(
        loader=PackageLoader("offwind_pin.display"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    words = (as_given, mode_name, number, sentence)
    made.filters |= {word.__name__: word for word in words}
    made.globals |= {"foundation_name": foundation_name, "policy": POLICY}
    return made
