"""Pages name what is there: functions beside equations, public names, commands, and each other."""

from __future__ import annotations

import ast
import re
import runpy
import shlex
from collections.abc import Iterator, Set
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from helpers.doc_pages import ROOT, blocks

import offwind_pin as ow
from offwind_pin import plots
from offwind_pin.cases import case as case_module
from offwind_pin.cases.case import Case, ModalAnalysis, TransientAnalysis, load_case
from offwind_pin.cases.shipped import shipped_cases

DOCS = ROOT / "docs"
PACKAGE = ROOT / "src" / "offwind_pin"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]
PLACEHOLDERS = {"TURBINE", "CASE", "DIR"}
COMMANDS = {
    "animate", "modes", "report", "run", "show", "soil", "static", "urdf", "verify", "view",
}  # fmt: skip


def _names_of(module: Path) -> Iterator[str]:
    """Functions, classes, constants, and what classes hold: ``f``, ``C``, ``C.method``."""
    for node in ast.parse(module.read_text()).body:
        if isinstance(node, ast.ClassDef):
            yield node.name
            for part in ast.walk(node):
                if isinstance(part, ast.FunctionDef):
                    yield f"{node.name}.{part.name}"
                elif isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name):
                    yield f"{node.name}.{part.target.id}"
        elif isinstance(node, ast.FunctionDef):
            yield node.name


@cache
def _known() -> frozenset[str]:
    """Every way in which a page may name a part of the package, from its last name upwards."""
    known: set[str] = set()
    for path in PACKAGE.rglob("*.py"):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        for name in (*_names_of(path), ""):
            whole = [*parts, *name.split(".")] if name else [*parts]
            known |= {".".join(whole[i:]) for i in range(len(whole))}
    return frozenset(known)


def unknown_names(page: str, known: Set[str]) -> list[str]:
    """Inline literals of a page that look like a part of the package and are none."""
    found = []
    for literal in re.findall(r"(?<!`)`([^`\n]+)`(?!`)", page):
        if literal.endswith("/") or "/" in literal:
            if not (PACKAGE / literal).exists():
                found.append(literal)
        elif literal.endswith(".py"):
            if not any(path.name == literal for path in PACKAGE.rglob("*.py")):
                found.append(literal)
        elif re.fullmatch(r"[A-Za-z_][\w.]*", literal) and literal not in known:
            found.append(literal)
    return found


LOCAL = {"da_dq", "dv_dq", "rnea"}
"""Names within a function, and Pinocchio's, that a page of the theory explains."""


@pytest.mark.parametrize("page", sorted((DOCS / "theory").glob("*.md")), ids=lambda p: p.stem)
def test_functions_beside_equations(page: Path) -> None:
    """Every function that a page of the theory names is in the package."""
    assert unknown_names(page.read_text(), _known() | LOCAL) == []


def test_the_search_for_names_can_fail() -> None:
    """Negative control, and every kind of literal that is read."""
    known = _known()
    good = "`frustum.Frustum.lump` `analysis.modal.modes` `SteadyWave` `loads/` `buoyancy.py`"
    assert unknown_names(good + ' `element="timoshenko"`', known) == []
    bad = "`frustum.Frustum.weigh` `modal.nodes` `loads/rain.py` `rain.py`"
    assert len(unknown_names(bad, known)) == 4


def test_reference_lists_every_public_name_once() -> None:
    """A name that two namespaces share is listed in one of them."""
    listed = [
        getattr(import_module(module), name)
        for page in sorted((DOCS / "api").glob("*.md"))
        for module, names in re.findall(
            r"^\.\. currentmodule:: (\S+)\n(.*?)^```", page.read_text(), re.M | re.S
        )
        for name in re.findall(r"^\.\. auto(?:function|class):: (\w+)", names, re.M)
    ]
    spaces = (ow, ow.sea, ow.signal, ow.soil, ow.viewer, ow.wind, plots)
    public = {
        id(thing): name
        for space in spaces
        for name in space.__all__
        if not isinstance(thing := getattr(space, name), ModuleType)
    }
    assert sorted(map(id, listed)) == sorted(public)


def test_formulas_in_docstrings_are_plain_text() -> None:
    """Literals and roles are markup, and names of arguments are left as they are."""
    escape = runpy.run_path(str(DOCS / "docstrings.py"))["escape"]
    assert escape("A |w| w of ``x_`` by :func:`f`, phi' D_ phi * 2.") == (
        r"A \|w\| w of ``x_`` by :func:`f`, phi' D\_ phi \* 2."
    )
    assert escape("dt_s, *more : float, |s|") == r"dt_s, *more : float, \|s\|"
    assert escape(">>> a_b * c") == ">>> a_b * c"


def test_every_page_is_in_the_contents() -> None:
    """No page of the docs is left out of the site's contents, and none there is missing."""
    entries = re.findall(r"^(?:docs/[\w/]+|[A-Z]+)$", (DOCS / "contents.md").read_text(), re.M)
    listed = {ROOT / f"{entry}.md" for entry in entries}
    pages = {page for page in DOCS.rglob("*.md") if page.name != "contents.md"}
    assert pages <= listed
    assert all(page.is_file() for page in listed)


def test_docs_run_on_what_the_tests_ran_on() -> None:
    """A package that both lock files hold has one version in them."""
    tests, docs = (
        dict(re.findall(r"^([\w.-]+)==(\S+)", path.read_text(), re.M))
        for path in (ROOT / "requirements.lock", DOCS / "requirements.lock")
    )
    both = tests.keys() & docs.keys()
    assert {"numpy", "numba", "matplotlib"} <= both
    assert "sphinx" in docs.keys() - tests.keys()
    assert {name: docs[name] for name in both} == {name: tests[name] for name in both}


def _commands() -> Iterator[tuple[str, str]]:
    """Page and text of every command of the package that a page shows."""
    for page in PAGES:
        text = page.read_text()
        for literal in re.findall(r"(?<!`)`(offwind [^`\n]+)`(?!`)", text):
            yield page.name, literal
        if page.parent.name == "howto":
            continue  # test_howto.py runs them in their order
        for block in blocks(page):
            for line in block.text.splitlines():
                if block.language in {"console", "bash"} and line.startswith("offwind "):
                    yield page.name, line


def _whole(words: list[str]) -> bool:
    """Whether a command can be run as it stands; otherwise a page only speaks of it."""
    return len(words) > 2 and words[1] != "verify" and not set(words) & PLACEHOLDERS


SHOWN = sorted(set(_commands()), key=lambda shown: shown[1])
WHOLE = sorted({text for _, text in SHOWN if _whole(shlex.split(text))})


def test_pages_speak_of_commands_that_are_there(offwind: Any) -> None:
    """Commands that are only spoken of, ``offwind verify`` among them, exist with their options."""
    spoken = [(page, shlex.split(text)) for page, text in SHOWN if text not in WHOLE]
    assert {words[1] for _, words in spoken} >= {"run", "verify", "soil"}
    helps = {}
    for name in COMMANDS:
        code, helps[name], _ = offwind(name, "--help")
        assert code == 0
    for page, words in spoken:
        assert words[1] in COMMANDS, f"{page}: {words}"
        for option in (word for word in words if word.startswith("--")):
            assert option in helps[words[1]], f"{page}: {words}"


@pytest.mark.parametrize("text", WHOLE)
def test_command(text: str, offwind: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A command that a page shows runs as it stands, with the files of the pages beside it."""
    for page, language, name in (
        ("turbine_file", "yaml", "my_turbine.yaml"),
        ("case_file", "yaml", "my_case.yaml"),
        ("case_file", "text", "my_load.txt"),
    ):
        found = [b.text for b in blocks(DOCS / f"{page}.md") if b.language == language]
        (tmp_path / name).write_text(found[0])
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(case_module, "load_case", _shortened)
    code, _, err = offwind(*shlex.split(text)[1:])
    assert code == 0, err


def _shortened(name: str) -> Case:
    """A case; of a shipped one a few minutes, because tests/verification has run it as it is."""
    case = load_case(name)
    if name in shipped_cases():
        if isinstance(case.analysis, TransientAnalysis):
            case = case.replace(analysis=case.analysis.replace(duration=120.0, psd_segment=50.0))
        elif isinstance(case.analysis, ModalAnalysis) and case.analysis.identify is not None:
            record = case.analysis.identify.replace(duration=1000.0, segment=100.0)
            case = case.replace(analysis=case.analysis.replace(identify=record))
    return case


def test_make_targets_and_scripts_are_there() -> None:
    """``make`` and ``python`` are shown with targets and scripts that the repository has."""
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.M))
    made = set()
    for page in PAGES:
        if page.parent.name == "howto":
            continue
        text = page.read_text()
        made |= set(re.findall(r"(?:`|^)make\s+([a-z]+)", text, re.M))
        scripts = re.findall(r"(?:`|^)python ([\w/]+\.py)", text, re.M)
        assert all((ROOT / script).is_file() for script in scripts)
    assert {"demo", "docs", "lock", "test"} <= made <= targets


def test_commands_are_found() -> None:
    """The pages show every command that can be run as it stands; ``report`` needs a run's results,
    and tests/verification runs ``verify`` row by row."""
    assert {shlex.split(text)[1] for text in WHOLE} == COMMANDS - {"report", "verify"}
