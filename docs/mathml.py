"""Equations as MathML, which browsers draw by themselves: no script, no font from elsewhere."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.util import logging

_log = logging.getLogger(__name__)

_FUNCTION = re.compile(r"(\\(?:cosh|cos|ln|sinh|sin|tanh)(?:\^\w|\^\{[^}]*\})?)(?= +[\w\\])")
"""Before an argument without brackets; TeX puts a thin space there, the converter does not."""


def _mathml(tex: str, node: nodes.Node, *, block: bool) -> str:
    """A ``<math>`` element; TeX that cannot be read is a warning, which ends the build."""
    try:
        return tex2mathml(_FUNCTION.sub(r"\1 \\,", tex), as_block=block)
    except Exception as error:  # docutils raises SyntaxError, and others from within
        _log.warning("equation cannot be read: %s in %s", error, tex, location=node)
        return ""


def _inline(self: Any, node: nodes.math) -> None:
    self.body.append(_mathml(node.astext(), node, block=False))
    raise nodes.SkipNode


def _block(self: Any, node: nodes.math_block) -> None:
    tex = node.astext()
    if r"\\" in tex and r"\begin" not in tex:
        tex = rf"\begin{{aligned}}{tex}\end{{aligned}}"
    self.body.append(f'<div class="equation">{_mathml(tex, node, block=True)}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer as ``mathml``."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
