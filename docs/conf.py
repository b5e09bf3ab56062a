"""Sphinx configuration. ``make docs`` builds the pages in out/docs, without a network."""

from __future__ import annotations

import re
import sys
from importlib import metadata
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

sys.path.insert(0, str(Path(__file__).parent))

project = "offwind-pin"
author = "The offwind-pin developers"
release = metadata.version("offwind-pin")
html_title = f"{project} {release}"
html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["pages.css"]
html_copy_source = False
html_show_copyright = False
exclude_patterns = ["docs/contents.md", "docs/gallery/*", "sim", "src"]

extensions = [
    "docstrings",
    "mathml",
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx_gallery.gen_gallery",
]
html_math_renderer = "mathml"
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4

autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_typehints = "none"
autodoc_class_signature = "mixed"
python_display_short_literal_types = True

sphinx_gallery_conf = {
    "examples_dirs": [str(Path(__file__).parent / "gallery")],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r"\.py$",
    "within_subsection_order": "FileNameSortKey",
    "image_srcset": ["2x"],
    "abort_on_example_error": True,
    "download_all_examples": False,
    "show_signature": False,
    "min_reported_time": 0,
    "write_computation_times": False,
    "remove_config_comments": True,
}


def _without_links_to_folders(app: Sphinx, name: str, source: list[str]) -> None:
    """Replace links to repository folders, which are not pages, by their text."""
    here = Path(app.env.doc2path(name)).parent

    def replace(found: re.Match[str]) -> str:
        return found[1] if (here / found[2]).is_dir() else found[0]

    source[0] = re.sub(r"\[([^\]]+)\]\(([^)#:\s]+)\)", replace, source[0])


_LOADED = re.compile(
    r'<(?:script|img|iframe|source)\b[^>]*\bsrc="(?:https?:)?//[^"]*"'
    r'|<link\b[^>]*\brel="(?:stylesheet|preload|icon)"[^>]*href="(?:https?:)?//'
)


def _refuse_the_network(app: Sphinx, failure: Exception | None) -> None:
    """Fail if a page loads anything from the network: the site must work offline."""
    if failure is None and app.builder.format == "html":
        for page in Path(app.outdir).rglob("*.html"):
            loaded = _LOADED.search(page.read_text())
            if loaded:
                raise ExtensionError(f"{page} loads from the network: {loaded[0]}")


def setup(app: Sphinx) -> None:
    """Register the lexer and connect the handlers above."""
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", _without_links_to_folders)
    app.connect("build-finished", _refuse_the_network)
