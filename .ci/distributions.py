"""Build the wheel and the sdist, check what is in them, and run the wheel on its own.

The wheel is installed without extras in a new environment, with the versions of requirements.lock.
"""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[1]
OUT = ROOT / "out" / "dist"
PACKAGE = ROOT / "src" / "offwind_pin"
FA1_HZ = 0.2426
"""Of the shipped turbine on its springs in still water."""


def main() -> None:
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    run(sys.executable, "-m", "build", "--no-isolation", "--outdir", str(OUT), str(ROOT))
    (wheel,), (sdist,) = OUT.glob("*.whl"), OUT.glob("*.tar.gz")
    with zipfile.ZipFile(wheel) as archive:
        check_wheel(archive.namelist())
    with tarfile.open(sdist) as archive:
        check_sdist([member.name for member in archive.getmembers() if member.isfile()])
    run(sys.executable, "-m", "pip", "check")
    run_alone(wheel)


def package_files() -> set[str]:
    """Modules, stubs and data of the package, as paths in a wheel."""
    return {
        path.relative_to(PACKAGE.parent).as_posix()
        for path in PACKAGE.rglob("*")
        if path.is_file() and path.suffix != ".pyc"
    }


def check_wheel(names: list[str]) -> None:
    """The package with all its data, the licence and the command; nothing else."""
    metadata = {name for name in names if name.partition("/")[0].endswith(".dist-info")}
    same("wheel", set(names) - metadata, package_files())
    kinds = {"LICENSE", "METADATA", "RECORD", "WHEEL", "entry_points.txt"}
    same("metadata of the wheel", {PurePosixPath(name).name for name in metadata}, kinds)


def check_sdist(names: list[str]) -> None:
    """What the wheel is built from, and the licence; neither tests nor documentation."""
    inside = {name.partition("/")[2] for name in names}
    besides = {"LICENSE", "PKG-INFO", "README.md", "pyproject.toml"}
    same("sdist", inside, besides | {f"src/{name}" for name in package_files()})


def same(what: str, found: set[str], expected: set[str]) -> None:
    if found != expected:
        missing, surplus = sorted(expected - found), sorted(found - expected)
        sys.exit(f"{what}: missing {missing}, surplus {surplus}")


def run_alone(wheel: Path) -> None:
    """Natural modes from the command of the wheel, away from this folder."""
    folder = OUT / "alone"
    venv.create(folder, with_pip=True)
    python, offwind = folder / "bin" / "python", folder / "bin" / "offwind"
    versions = OUT / "versions.txt"
    lock = (ROOT / "requirements.lock").read_text()
    versions.write_text("\n".join(re.findall(r"^(\S+==.*?) *\\$", lock, re.MULTILINE)))
    pip = [python, "-m", "pip", "--disable-pip-version-check"]
    run(*pip, "install", "--quiet", "--constraint", versions, wheel)
    run(*pip, "check")
    modes = json.loads(run(offwind, "modes", "oc6_phase2", "--json"))["modes"]
    found = {mode["label"]: mode["frequency_hz"] for mode in modes}
    if [*found][:2] != ["SS1", "FA1"] or not math.isclose(found["FA1"], FA1_HZ, rel_tol=1e-3):
        sys.exit(f"the wheel, installed alone, gives the modes {found}")
    print("the wheel, installed alone, gives FA1 at", found["FA1"], "Hz")


def run(*command: str | Path) -> str:
    """Standard output of a program that must succeed, in an environment without this checkout."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        command, cwd=OUT, env=environment, stdout=subprocess.PIPE, text=True, check=True
    )
    return done.stdout


if __name__ == "__main__":
    main()
