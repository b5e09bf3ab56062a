"""How many files of the package know one of its parts by name: those that adding such a part touches."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import offwind_pin

PACKAGE = Path(offwind_pin.__file__).parent


def mentions(tree: ast.AST, names: set[str]) -> bool:
    """Whether code uses one of the names, as an identifier or as a whole text; prose does not count."""
    for node in ast.walk(tree):
        used = {getattr(node, part, None) for part in ("id", "attr", "name", "arg", "value")}
        if {item for item in used if isinstance(item, str)} & names:
            return True
    return False


def files(*names: str) -> list[str]:
    """Files that mention one of the names, those of the ledger's checks left out."""
    return [
        path.relative_to(PACKAGE).as_posix()
        for path in sorted(PACKAGE.rglob("*.py"))
        if "verification" not in path.parts and mentions(ast.parse(path.read_text()), set(names))
    ]


@pytest.mark.parametrize(
    ("part", "names", "most"),
    [
        ("load: its file, its key in cases", ("TowerDrag", "tower_drag", "TowerWind"), 2),
        ("wave model: its class and its schema", ("StreamWaves",), 2),
        (
            "foundation: its function, its kind, its parameters, the soil report that compares it",
            ("apparent_fixity",),
            4,
        ),
        (
            "soil family: curves, schema, one line in layered.py",
            ("MatlockClay", "MatlockClayFamily"),
            3,
        ),
        ("soil law", ("PowerCurves",), 2),
        ("step policy", ("AdaptiveStep",), 1),
    ],
    ids=lambda value: value.partition(":")[0] if isinstance(value, str) else "",
)
def test_few_files_know_a_part(part: str, names: tuple[str, ...], most: int) -> None:
    """A new type switch somewhere else shows here; the number may only fall."""
    found = files(*names)
    assert 0 < len(found) <= most, found


def test_mentions_are_distinguished_from_prose() -> None:
    """Negative control."""
    assert mentions(ast.parse("x = Thing(3)"), {"Thing"})
    assert mentions(ast.parse("kind = 'thing'"), {"thing"})
    assert mentions(ast.parse("from a import thing"), {"thing"})
    assert not mentions(ast.parse("'''About a thing.'''\nx = 1  # thing"), {"thing"})
