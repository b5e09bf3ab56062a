"""Peak memory of a case of three hours beside one of ten minutes, streamed to a directory.

Each runs in a process of its own; peak memory is the largest that the process ever held.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import measuring
from operational_case import operational_case

SECONDS = (600.0, 10800.0)
GROWTH_ALLOWED = 300.0
"""MB that the longest case may take beyond the shortest."""


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Measure every duration in a process of its own, and write the results."""
    parser = measuring.options("memory", __doc__, repeats=1)
    parser.add_argument("--seconds", type=float, nargs="+", default=SECONDS)
    parser.add_argument("--elements", type=int)
    parser.add_argument("--one", type=float, help="simulated time in s; measures this process")
    given = parser.parse_args(argv)
    if given.one is not None:
        row = measure(given.one, given.elements)
        print(json.dumps(row))
        return row
    rows = [in_new_process(seconds, given.elements) for seconds in given.seconds]
    growth = (rows[-1]["peak_bytes"] - rows[0]["peak_bytes"]) / 1e6
    return measuring.write(
        given.out,
        {
            "rows": rows,
            "growth_mb": growth,
            "targets": [
                measuring.target(
                    f"peak memory of {rows[-1]['simulated_s']:g} s beyond that of "
                    f"{rows[0]['simulated_s']:g} s, MB",
                    GROWTH_ALLOWED,
                    growth,
                    at_least=False,
                )
            ],
        },
    )


def measure(seconds: float, elements: int | None) -> dict[str, Any]:
    """Run LC 5.1 for so many seconds, streamed; waves repeat after them. Peaks in bytes."""
    case = operational_case(seconds, elements=elements)
    before = peak_bytes()
    with tempfile.TemporaryDirectory() as folder:
        taken = measuring.wall(lambda: case.simulate(directory=folder).close())
        size = (Path(folder) / "results.nc").stat().st_size
    return {
        "simulated_s": seconds,
        "elements": case.system.chain.elements,
        "output_dt_s": case.output_dt,
        "wall_s": taken,
        "results_bytes": size,
        "peak_before_bytes": before,
        "peak_bytes": peak_bytes(),
    }


def peak_bytes() -> int:
    """Largest resident size of this process so far."""
    size = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return size if sys.platform == "darwin" else size * 1024


def in_new_process(seconds: float, elements: int | None) -> dict[str, Any]:
    """The row of one duration, measured by this script in a fresh process."""
    command = [sys.executable, __file__, "--one", str(seconds)]
    if elements is not None:
        command += ["--elements", str(elements)]
    done = subprocess.run(  # noqa: S603
        command, check=True, capture_output=True, text=True, env=dict(os.environ)
    )
    row: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return row


if __name__ == "__main__":
    main()
