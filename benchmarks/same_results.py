"""Are the results of two revisions the same?

Both solve all shipped cases, cases with every model switched on, what Python alone offers, every
command on every foundation, and the gallery. Their output is compared channel by channel, with
the bounds in ``result_differences.py``. It exits with status 1 if anything differs.

    python benchmarks/same_results.py --reference main~5
    python benchmarks/same_results.py --write before
    python benchmarks/same_results.py --reference-results before --only gallery oc6-lc2.1

``--write`` alone only keeps what this checkout gives. A reference revision is checked out in a
temporary folder, which is removed afterwards. Both run in this Python environment, each with its
own sources. Numbers count if both were written on one machine with the same packages.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

import measuring
from result_differences import Comparison, compare_group

HERE = Path(__file__).resolve().parent
COLLECT = HERE / "same_results" / "collect.py"
GROUPS = (
    "oc6-lc1.2",
    "oc6-lc2.1",
    "oc6-lc2.3",
    "oc6-lc5.1",
    *(path.stem for path in sorted(COLLECT.parent.glob("case_*.yaml"))),
    "python_api",
    "commands",
    "gallery",
)
NOTES_SHOWN = 5
EVERY_COLUMN = ("float64", "float32", "number")


def main(argv: list[str] | None = None) -> int:
    """Write what is asked for, compare it, and return the exit status."""
    given = arguments().parse_args(argv)
    checkout = given.checkout.resolve()
    with ExitStack() as stack:
        scratch = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        new = given.results
        if new is None:
            new = given.write or scratch / "new"
            write(checkout, new, given.only)
        old = given.reference_results
        if given.reference is not None:
            old = scratch / "reference"
            write(stack.enter_context(worktree(given.reference)), old, given.only)
        if old is None:
            return 0
        found = [compare_group(name, old / name, new / name, given.accept) for name in given.only]
    for comparison in found:
        show(comparison)
    table(found)
    report = {
        "passed": all(comparison.passed for comparison in found),
        "groups": [comparison.as_dict() for comparison in found],
    }
    given.json.parent.mkdir(parents=True, exist_ok=True)
    given.json.write_text(json.dumps(report, indent=2, allow_nan=False) + "\n")
    print(f"{'The results are the same.' if report['passed'] else 'FAILED'}  Report: {given.json}")
    return 0 if report["passed"] else 1


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    old = parser.add_mutually_exclusive_group()
    old.add_argument("--reference", metavar="REVISION", help="git revision to compare with")
    old.add_argument(
        "--reference-results", type=Path, metavar="DIR", help="results of an earlier --write"
    )
    new = parser.add_mutually_exclusive_group()
    new.add_argument(
        "--write", type=Path, metavar="DIR", help="keep the results of the checkout here"
    )
    new.add_argument(
        "--results", type=Path, metavar="DIR", help="results to judge instead of running"
    )
    parser.add_argument("--checkout", type=Path, default=HERE.parent, help="by default this one")
    parser.add_argument("--only", nargs="+", choices=GROUPS, default=GROUPS, metavar="GROUP")
    parser.add_argument(
        "--accept",
        nargs="+",
        default=(),
        metavar="PATTERN",
        help="differences that are meant, such as 'oc6-lc*/*definition_sha256'",
    )
    parser.add_argument("--json", type=Path, default=measuring.RESULTS / "same_results.json")
    return parser


@contextmanager
def worktree(revision: str) -> Iterator[Path]:
    """A checkout of a revision in a temporary folder."""
    git = ["git", "-C", str(HERE)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "checkout"
        subprocess.run([*git, "worktree", "add", "--detach", str(path), revision], check=True)  # noqa: S603
        try:
            yield path
        finally:
            subprocess.run([*git, "worktree", "remove", "--force", str(path)], check=True)  # noqa: S603


def write(checkout: Path, out: Path, groups: Sequence[str]) -> None:
    """Solve groups with the sources of a checkout, each in a process of its own.

    A group that fails leaves its log; the comparison then misses its results.
    """
    sources = checkout / "src"
    environment = os.environ | {"PYTHONPATH": str(sources), "PYTHONHASHSEED": "0"}
    out.mkdir(parents=True, exist_ok=True)
    for name in groups:
        begun = time.perf_counter()
        print(f"{out.name}: {name} ...", end=" ", flush=True)
        folder = out / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        log = out / f"{name}.log"
        command = [sys.executable, str(COLLECT), name, str(checkout), str(folder.resolve())]
        with log.open("w", encoding="utf-8") as words:
            done = subprocess.run(  # noqa: S603
                command, env=environment, stdout=words, stderr=subprocess.STDOUT, check=False
            )
        took = time.perf_counter() - begun
        print(f"{took:.0f} s" if done.returncode == 0 else f"failed, see {log}", flush=True)


def show(found: Comparison) -> None:
    """What a person has to look at."""
    for difference in found.failures:
        size = f"{difference.size:.2e}, allowed {difference.allowed:.0e}"
        print(f"{found.group}: {difference.name}: {difference.kind} {size}  {difference.detail}")
    for what in ("missing", "extra", "accepted"):
        for name in getattr(found, what):
            print(f"{found.group}: {what}: {name}")
    for note in found.notes[:NOTES_SHOWN]:
        print(f"{found.group}: note: {note}")
    if len(found.notes) > NOTES_SHOWN:
        print(f"{found.group}: {len(found.notes) - NOTES_SHOWN} more notes in the report")


def table(found: Sequence[Comparison]) -> None:
    """The largest difference of each kind and where it is, a line for each group."""
    print(f"{'group':16}{'compared':>9}{'failed':>8}{'missing':>9}{'extra':>7}  largest difference")
    for comparison in found:
        counts = (
            f"{len(comparison.compared):9}{len(comparison.failures):8}"
            f"{len(comparison.missing):9}{len(comparison.extra):7}"
        )
        parts = [comparison.worst(kind) for kind in EVERY_COLUMN]
        worst = [
            f"{d.kind} {d.size:.1e} ({d.name.split(': ')[-1]})" for d in parts if d is not None
        ]
        print(f"{comparison.group:16}{counts}  {'; '.join(worst)}")


if __name__ == "__main__":
    sys.exit(main())
