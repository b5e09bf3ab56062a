"""The package's docstrings as reStructuredText.

They are plain text: sections underlined by dashes, entries ``name : what it is``, formulas as they
are typed. Only literals between double backquotes and roles such as ``:func:`` are markup.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_MARKUP = re.compile(r"(``.*?``|:\w+:`.*?`)")
_ENTRY = re.compile(r"(\w+(?:, \w+)*) : (.*)")
_SPECIAL = re.compile(r"([\\*|_`])")


def _plain(text: str) -> str:
    """Text with every character that reStructuredText would read as markup escaped."""
    pieces = _MARKUP.split(text)
    return "".join(p if i % 2 else _SPECIAL.sub(r"\\\1", p) for i, p in enumerate(pieces))


def to_rest(lines: list[str]) -> list[str]:
    """A docstring's lines as reStructuredText: entries become definitions, sections bold."""
    found: list[str] = []
    i, entry = 0, False
    while i < len(lines):
        line = lines[i]
        underlined = i + 1 < len(lines) and bool(re.fullmatch(r"-{3,}", lines[i + 1].strip()))
        match = _ENTRY.fullmatch(line)
        if underlined:
            found += ["", f"**{line.strip()}**", ""]
            i, entry = i + 1, False
        elif match:
            names = ", ".join(f"``{name}``" for name in match[1].split(", "))
            found += ["", names, f"    {_plain(match[2])}"]
            entry = True
        elif entry and line.startswith("    "):
            found.append(f"    {_plain(line.strip())}")
        elif line.startswith(">>>") or (found and found[-1].startswith(">>>") and line.strip()):
            found.append(line)
        else:
            if entry and line.strip():
                found.append("")
                entry = False
            found.append(_plain(line.strip()))
        i += 1
    return found


def _process(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    lines[:] = to_rest(lines)


def setup(app: Sphinx) -> dict[str, bool]:
    """Let autodoc read the package's docstrings this way."""
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("autodoc-process-docstring", _process)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
