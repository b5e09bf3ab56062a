"""The rooms of the package: who may import whom, and no circles."""

from __future__ import annotations

import ast
import graphlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import offwind_pin

PACKAGE = Path(offwind_pin.__file__).parent

ALLOWED: dict[str, set[str]] = {
    "base": set(),
    "definitions": {"base"},
    "structure": {"base", "definitions"},
    "solvers": {"base"},
    "signal": {"base"},
    "results": {"base"},
    "loads": {"base", "definitions", "structure", "signal"},
    "dynamics": {"base", "definitions", "structure", "loads", "solvers"},
    "formats": {"base", "definitions", "structure", "loads", "dynamics"},
    "analysis": {
        "base",
        "definitions",
        "structure",
        "loads",
        "dynamics",
        "solvers",
        "results",
        "signal",
        "formats",
    },
}
"""What each room may import of the package, from the bottom up."""

ABOVE = ["display", "plots", "cases", "viewer", "verification", "cli"]
"""Rooms above the analyses: each may import those, and the ones before it in this list."""

ALLOWED |= {room: set(ALLOWED) | set(ABOVE[:place]) for place, room in enumerate(ABOVE)}

PINOCCHIO = {"structure", "dynamics"}
"""Rooms that may import Pinocchio."""

NAMESPACES = {"sea", "soil", "wind"}
"""Lists of public names; a stub beside each, which is imported name by name, may use every room."""

ALLOWED |= {room: {"base"} for room in NAMESPACES}

FACE = {"__init__", "__main__"}
"""Top-level files that may import every room."""


@cache
def _modules() -> dict[str, Path]:
    """Every module of the package by its full name."""
    return {
        ".".join(("offwind_pin", *path.relative_to(PACKAGE).with_suffix("").parts)): path
        for path in sorted(PACKAGE.rglob("*.py"))
    }


def _imports(tree: ast.AST) -> set[str]:
    """Full names of everything that code imports, at any depth."""
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            assert node.level == 0, "relative import"
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def _run_on_import(tree: ast.Module) -> ast.Module:
    """The part of a module that runs when it is imported."""
    kept = [
        node
        for node in tree.body
        if not isinstance(node, ast.FunctionDef | ast.ClassDef)
        and not (isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test))
    ]
    return ast.Module(kept, [])


def _forbidden(room: str, imports: set[str]) -> set[str]:
    """The imports that a room may not have."""
    wrong = set()
    for name in imports:
        parts = name.split(".")
        if parts[0] in {"sim", "viz", "tests", "benchmarks"}:
            wrong.add(name)
        if parts[0] == "pinocchio" and room not in PINOCCHIO:
            wrong.add(name)
        inside = parts[0] == "offwind_pin" and len(parts) > 1 and room not in FACE
        if inside and parts[1] not in ALLOWED[room] | {room}:
            wrong.add(name)
    return wrong


def _depends(imports: dict[str, set[str]]) -> dict[str, set[str]]:
    """Which modules each module needs, of the names that it imports."""
    return {
        name: {
            other
            for needed in wanted
            for other in (needed, needed.rpartition(".")[0])
            if other in imports and other != name
        }
        for name, wanted in imports.items()
    }


def _room(name: str) -> str:
    return name.split(".")[1]


@pytest.mark.parametrize("name", _modules())
def test_imports_go_downwards(name: str) -> None:
    """Each file imports its own room and those below it."""
    tree = ast.parse(_modules()[name].read_text())
    assert _forbidden(_room(name), _imports(tree)) == set()


def test_no_import_circle() -> None:
    """The files can be put in an order in which each needs only earlier ones."""
    imports = {
        name: _imports(_run_on_import(ast.parse(path.read_text())))
        for name, path in _modules().items()
    }
    tuple(graphlib.TopologicalSorter(_depends(imports)).static_order())


def test_upward_imports_are_found() -> None:
    """Negative control of the order of rooms."""
    assert _forbidden("loads", {"pinocchio.rnea"})
    assert _forbidden("solvers", {"offwind_pin.definitions.turbine.Turbine"})
    assert _forbidden("structure", {"offwind_pin.dynamics.system.System"})
    assert _forbidden("display", {"offwind_pin.cases.run"})
    assert _forbidden("base", {"offwind_pin.loads.point_load"})
    assert not _forbidden("solvers", {"offwind_pin.base.kernels.kernel"})
    assert not _forbidden("dynamics", {"pinocchio.rnea", "offwind_pin.loads.point_load"})


def test_import_circles_are_found() -> None:
    """Negative control: a circle of two files, and one through a name of a package."""
    direct = {"a.x": {"a.y.f"}, "a.y": {"a.x.g"}}
    through = {"a.x": {"a.y"}, "a.y": {"a.x"}}
    for imports in (direct, through):
        with pytest.raises(graphlib.CycleError):
            tuple(graphlib.TopologicalSorter(_depends(imports)).static_order())


def _rooms() -> Iterator[str]:
    for path in PACKAGE.iterdir():
        if path.name != "__pycache__" and (path.is_dir() or path.suffix == ".py"):
            yield path.stem


def test_every_room_has_a_rule() -> None:
    """A new room must be given its place."""
    assert set(_rooms()) <= ALLOWED.keys() | FACE
