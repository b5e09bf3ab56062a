"""The package's docstrings as reStructuredText.

They are in numpydoc's form, with formulas as they are typed: of their text only literals between
double backquotes and roles such as ``:func:`` are markup.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_MARKUP = re.compile(r"(``.*?``|:\w+:`.*?`)")
_SPECIAL = re.compile(r"([\\*|_`])")
_ENTRY = re.compile(r"\*{0,2}\w+(, \*{0,2}\w+)* : ")


def escape(line: str) -> str:
    """A line with every character escaped that reStructuredText would read as markup.

    Names of arguments are left to napoleon.
    """
    if line.startswith(">>>"):
        return line
    entry = _ENTRY.match(line)
    start = entry.end() if entry else 0
    pieces = _MARKUP.split(line[start:])
    escaped = (p if i % 2 else _SPECIAL.sub(r"\\\1", p) for i, p in enumerate(pieces))
    return line[:start] + "".join(escaped)


def _process(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    from sphinx.ext.napoleon import Config, NumpyDocstring

    config = Config(napoleon_use_rtype=False)
    text = [escape(line) for line in lines]
    lines[:] = NumpyDocstring(text, config, app, what, name, obj, options).lines()


def setup(app: Sphinx) -> dict[str, bool]:
    """Let autodoc read the package's docstrings this way.

    Napoleon as an extension would also look at members of classes, which pydantic's do not bear.
    """
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("autodoc-process-docstring", _process)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
