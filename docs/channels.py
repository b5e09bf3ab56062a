"""The table of channels of the page on case files, from the declarations of the channels.

``python docs/channels.py`` writes it into the page again.
"""

from __future__ import annotations

import re
from pathlib import Path

from offwind_pin.loads.sea.forces.morison import WAVE_ELEVATION
from offwind_pin.loads.tower_top.load_history import TOWER_TOP_LOAD
from offwind_pin.results.channels import CHANNELS

PAGE = Path(__file__).parent / "case_file.md"
_PLACE = re.compile(r"(?<=<!-- channels -->\n).*?(?=<!-- end of channels -->)", re.DOTALL)


def table() -> str:
    """One row per channel that a run may have without loads of the user's own."""
    rows = [
        "| channel | dimensions besides time | units | in the file | content | in OpenFAST |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for channel in (*CHANNELS, TOWER_TOP_LOAD, WAVE_ELEVATION):
        cells = [
            f"`{channel.name}`",
            ", ".join(f"`{dim}`" for dim in channel.dims),
            channel.units,
            channel.dtype,
            channel.long_name,
            " ".join(f"`{name}`" for name in channel.openfast_alias.split()),
        ]
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows) + "\n"


def page() -> str:
    """The page with the table as it should be."""
    return _PLACE.sub(lambda _: table(), PAGE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
