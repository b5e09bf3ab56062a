"""The package without what it does not depend on: peers, tools of its tests and of its docs."""

import json
import subprocess
import sys
import tomllib
from pathlib import Path

from offwind_pin.verification.ledger import read_ledger

PROJECT = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))

MODULES = {
    "example-robot-data": "example_robot_data",
    "flit-core": "flit_core",
    "myst-parser": "myst_parser",
    "pyoma-2": "pyoma2",
    "pytest-xdist": "xdist",
    "sphinx-gallery": "sphinx_gallery",
}
"""Of distributions whose module has another name."""

NEEDED = {"pygments"}
"""Named for the docs, and needed by Rich."""

WITHOUT = """
import contextlib, importlib, io, json, pkgutil, sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {absent!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
import offwind_pin
from offwind_pin.cli import main

walked = pkgutil.walk_packages(offwind_pin.__path__, "offwind_pin.")
imported = [module.name for module in walked if not module.name.endswith("__main__")]
for name in imported:
    importlib.import_module(name)
printed = []
for row in {rows!r}:
    sys.argv = ["offwind", "verify", "--only", row, "--json"]
    with contextlib.redirect_stdout(io.StringIO()) as out:
        try:
            main()
        except SystemExit as ended:
            assert not ended.code, ended.code
    printed += json.loads(out.getvalue())["rows"]
print(json.dumps([len(imported), printed]))
"""


def test_all_modules_import_and_absent_peers_are_named() -> None:
    """Rows of a program that is not installed neither pass nor fail, and say which it is."""
    extras = PROJECT["project"]["optional-dependencies"] | PROJECT["dependency-groups"]
    named = {entry.partition(">")[0] for entries in extras.values() for entry in entries}
    absent = {MODULES.get(name, name) for name in named} - NEEDED
    needing = {row.id: row.needs for row in read_ledger() if row.needs}
    assert {"hypothesis", "sphinx"} | {
        need.partition(".")[0] for need in needing.values()
    } <= absent

    program = WITHOUT.format(absent=absent, rows=["beam-twist", *needing])
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    imported, rows = json.loads(done.stdout.splitlines()[-1])
    assert imported > 200
    outcomes = {row["id"]: (row["pass"], row["reason"]) for row in rows}
    assert outcomes.pop("beam-twist") == (True, None)  # negative control
    assert outcomes == {name: (None, f"{need} is not installed") for name, need in needing.items()}
