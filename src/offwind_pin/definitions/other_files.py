"""What a file is that was given as a turbine or a case, and is neither."""

from __future__ import annotations

import re
from pathlib import Path

_LOOKED_AT = 1_000_000
"""Bytes from the start of a file."""
_HEAD = 5
"""Lines in which OpenFAST and BModes say what a file is."""

_BY_HAND = (
    "There is no importer yet: copy site, materials, members and rotor-nacelle data into a turbine "
    "file (docs/turbine_file.md, which maps the keys of ElastoDyn), and compare the masses of "
    "offwind show"
)
_OPENFAST = re.compile(
    r"OpenFAST|FAST v?\d|SeaState|InflowWind"
    r"|(?:Elasto|Sub|Hydro|Aero|Servo|Beam|Moor|Soil|Struct)Dyn",
    re.IGNORECASE,
)


def other_kind(path: Path, wanted: str) -> tuple[str, str] | None:
    """What a file is, and what to do with it; None for one that is not recognised.

    Parameters
    ----------
    wanted : {"turbine", "case"}
        What it was given as.
    """
    try:
        with path.open("rb") as file:
            text = file.read(_LOOKED_AT).decode("latin-1")
    except OSError:
        return None
    head = "\n".join(text.splitlines()[:_HEAD])
    keys = set(re.findall(r"^([A-Za-z]\w*)[ \t]*:", text, re.MULTILINE))
    if "BModes" in head:
        return "an input file of BModes", _BY_HAND
    if _OPENFAST.search(head) and not {"site", "analysis"} & keys:
        return "an input file of OpenFAST", _BY_HAND
    if "windIO_version" in keys or {"components", "assembly"} <= keys:
        return "a turbine in windIO's ontology, as WISDEM has it", _BY_HAND
    if "WISDEM" in keys or "General" in keys:
        return "a file of options of WISDEM", _BY_HAND
    if re.search(r"^\s*begin\s+(?:simulation|new_htc_structure)", text, re.MULTILINE):
        return "an input file of HAWC2", _BY_HAND
    if wanted == "turbine" and {"turbine", "analysis"} <= keys:
        return "a case file", "Give the turbine that it names, or run it with offwind run"
    if wanted == "case" and {"site", "members"} <= keys:
        return "a turbine file", "Write a case file that names it under turbine"
    return None
