"""What is loaded: nothing before it is needed. Modules are counted, not seconds."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import offwind_pin as ow
from offwind_pin.analysis.foundation.registry import FOUNDATIONS

HEAVY = {
    "jinja2",
    "matplotlib",
    "meshcat",
    "netCDF4",
    "numba",
    "numpy",
    "pandas",
    "pinocchio",
    "pydantic",
    "scipy",
    "xarray",
    "yaml",
}
"""Packages that take long to import, or that no help text can need."""

RUN = "from offwind_pin.cli import main; main()"

DRAWING = {"jinja2", "matplotlib", "meshcat", "netCDF4", "pandas", "xarray"}
PINOCCHIO = {"pinocchio"}
OPTIMISERS = {"scipy.interpolate", "scipy.optimize", "scipy.signal", "scipy.special", "scipy.stats"}


def loaded(code: str, *arguments: str) -> set[str]:
    """Modules in memory after a new interpreter has run some code."""
    program = (
        f"import sys\nsys.argv = {['offwind', *arguments]!r}\n"
        f"try:\n    {code}\nexcept SystemExit as stop:\n    assert not stop.code, stop.code\n"
        "import json\nprint('modules', json.dumps(sorted(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return set(json.loads(done.stdout.rpartition("modules ")[2]))


def command(*arguments: str) -> set[str]:
    return loaded(RUN, *arguments)


def test_importing_the_package_loads_none_of_its_dependencies() -> None:
    assert not loaded("import offwind_pin") & HEAVY


@pytest.mark.parametrize(
    "arguments",
    [("--help",), ("--version",), ("modes", "--help"), ("run", "--help"), ("view", "--help")],
    ids=" ".join,
)
def test_help_loads_no_analysis(arguments: tuple[str, ...]) -> None:
    modules = command(*arguments)
    assert not modules & (HEAVY - {"pydantic"})  # Typer checks the types of options with it


def test_modes_draw_nothing() -> None:
    """Natural frequencies need neither figures nor data sets, optimisers or Pinocchio."""
    modules = command("modes", "oc6_phase2", "--json", "--elements", "8")
    assert not modules & (DRAWING | OPTIMISERS | PINOCCHIO)
    assert "numba" in modules  # negative control: what is used is found


def test_show_draws_nothing() -> None:
    assert not command("show", "oc6_phase2", "--json") & (DRAWING | PINOCCHIO)


def test_help_names_every_foundation() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "offwind_pin", "modes", "--help"], capture_output=True, text=True
    )
    words = re.findall(r"\w+", done.stdout)
    assert set(words) >= FOUNDATIONS.keys()


def test_command_and_package_state_one_version(offwind: object) -> None:
    code, out, _ = offwind("--version")  # type: ignore[operator]
    assert (code, out.split()) == (0, ["offwind", ow.__version__])


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("offwind modes oc6", {"oc6_phase2"}),
        ("offwind run oc6-lc2", {"oc6-lc2.1", "oc6-lc2.3"}),
        ("offwind modes oc6_phase2 --foundation c", {"clamped", "coupled_springs"}),
    ],
)
def test_shell_completes_names(words: str, expected: set[str]) -> None:
    """Output to a shell when the last word is completed."""
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.argv = ['offwind']\n{RUN}"],
        capture_output=True,
        text=True,
        env={
            "PATH": "",
            "PYTHONPATH": str(Path(ow.__file__).parents[1]),
            "_OFFWIND_COMPLETE": "complete_bash",
            "COMP_WORDS": words,
            "COMP_CWORD": str(len(words.split()) - 1),
        },
    )
    assert set(done.stdout.split()) == expected, done.stderr
