"""Public names of a module, imported when they are first used.

The names are listed once, in the stub beside the module (``__init__.pyi``), which type checkers and
editors also read. Importing the package therefore loads only what a script uses.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple


class PublicNames(NamedTuple):
    """``__getattr__``, ``__dir__`` and ``__all__`` of a module."""

    get: Callable[[str], Any]
    listing: Callable[[], list[str]]
    shown: list[str]


def public_names(module: str, file: str) -> PublicNames:
    """Names of the stub beside a module.

    Parameters
    ----------
    module, file : str
        ``__name__`` and ``__file__`` of the module.

    Returns
    -------
    PublicNames
        All imports of the stub are available; ``dir`` shows those of the stub's ``__all__``.
    """
    homes: dict[str, tuple[str, str]] = {}
    shown: list[str] = []
    for node in ast.parse(Path(file).with_suffix(".pyi").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom) and node.module:
            homes |= {alias.asname or alias.name: (node.module, alias.name) for alias in node.names}
        elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            shown = ast.literal_eval(node.value)

    def get(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        home, original = homes[name]
        if home == module:
            return import_module(f"{module}.{original}")
        found = getattr(import_module(home), original)
        setattr(sys.modules[module], name, found)
        return found

    return PublicNames(get, lambda: list(shown), shown)
