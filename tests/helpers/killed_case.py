"""A case in a process that is killed at a chosen moment, or has little room on its disk."""

import os
import resource
import signal
import sys
from pathlib import Path
from typing import Any

import offwind_pin as ow
from helpers.killed_run import Operations
from offwind_pin.cases.run import run_case

CASE: dict[str, Any] = {
    "name": "waves",
    "turbine": "oc6_phase2",
    "foundation": "distributed_springs",
    "elements": 4,
    "sea": {"kind": "irregular_waves", "significant_height_m": 2.0, "peak_period_s": 6.0},
    "analysis": {
        "kind": "transient",
        "duration_s": 65.0,
        "ramp_s": 5.0,
        "dt_s": 0.1,
        "output_dt_s": 0.2,
        "psd_segment_s": 10.0,
    },
}

STATIC: dict[str, Any] = CASE | {
    "name": "static",
    "foundation": "clamped",
    "sea": {"kind": "dry"},
    "analysis": {"kind": "static"},
}


def run(directory: Path, case: dict[str, Any] = CASE) -> None:
    run_case(ow.Case.model_validate(case), directory)


class Events:
    """Counts what the interpreter reports of itself, and kills the process at one of them.

    There are such events while input is checked, code is loaded and compiled, results are written,
    and the report is drawn.
    """

    def __init__(self, last: int = 0) -> None:
        self.last = last
        self.count = 0

    def __call__(self, event: str, arguments: tuple[Any, ...]) -> None:
        """An audit hook of the interpreter."""
        self.count += 1
        if self.count == self.last:
            os.kill(os.getpid(), signal.SIGKILL)


def run_and_die(directory: Path, last: int, case: dict[str, Any] = CASE) -> None:
    """In a process of its own: hooks of an interpreter cannot be removed."""
    sys.addaudithook(Events(last))
    run(directory, case)


def run_and_die_at_a_file(directory: Path, last: int) -> None:
    """At an operation on a file of the run."""
    sys.addaudithook(Operations(directory, last))
    run(directory)


def run_and_count(directory: Path, counted: Any, case: dict[str, Any] = CASE) -> None:
    """A whole run; the number of its events goes to a queue."""
    events = Events()
    sys.addaudithook(events)
    run(directory, case)
    counted.put(events.count)


def run_in_little_room(directory: Path, limit: int) -> None:
    """Exit code 1 where a file grows beyond a limit in bytes."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    try:
        run(directory)
    except OSError as error:
        if not error.filename:
            raise
        sys.exit(1)
