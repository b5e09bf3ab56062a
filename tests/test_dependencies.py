"""What is imported is declared, and what is declared is imported and bounded."""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
REQUIRED = PROJECT["project"]["dependencies"]
EXTRAS = [item for group in PROJECT["project"]["optional-dependencies"].values() for item in group]
NAMES = {"pinocchio": "pin", "umsgpack": "u-msgpack-python", "yaml": "pyyaml"}
"""Distributions by the modules they bring, where the names differ."""

GROUPS = [item for group in PROJECT["dependency-groups"].values() for item in group]


def name(requirement: str) -> str:
    """Of a distribution, as package indices compare names."""
    found = re.match(r"[\w.-]+", requirement)
    assert found
    return re.sub(r"[-_.]+", "-", found[0]).lower()


def imported(folder: str) -> set[str]:
    """Top-level names of other packages that code imports, at any depth."""
    found: set[str] = set()
    for path in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                found |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module:
                found.add(node.module.partition(".")[0])
    return found - set(sys.stdlib_module_names) - {"offwind_pin"}


def distribution(module: str) -> str:
    """That brings a module."""
    return NAMES.get(module, name(module))


def test_every_import_is_declared() -> None:
    declared = {name(item) for item in [*REQUIRED, *EXTRAS, *GROUPS]}
    assert {distribution(module) for module in imported("src")} - declared == set()


def test_every_requirement_is_imported() -> None:
    used = {distribution(module) for module in imported("src")}
    assert {name(item) for item in REQUIRED} - used == set()


@pytest.mark.parametrize("requirement", [*REQUIRED, *EXTRAS, *GROUPS])
def test_requirements_are_bounded(requirement: str) -> None:
    assert ">=" in requirement
    assert "<" in requirement.partition(">=")[2]
