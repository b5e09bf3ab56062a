"""Time and memory of reading long tables of numbers: a load history and a surface elevation.

Each is read in a process of its own; its memory is what the process grew by at its largest.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import measuring
import memory
import numpy as np

from offwind_pin.base.number_tables import read_time_columns

COLUMNS = (2, 7)
SECONDS_ALLOWED, MEGABYTES_ALLOWED = 1.0, 150.0
"""For the longest table of seven columns: processor time, and memory."""


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Write tables, read each in a new process, and write the results."""
    parser = measuring.options("table_reading", __doc__, repeats=3)
    parser.add_argument("--rows", type=int, default=1_000_000)
    parser.add_argument("--one", type=Path, help="table of which this process measures the reading")
    parser.add_argument("--columns", type=int, help="of that table")
    given = parser.parse_args(argv)
    if given.one is not None:
        row = measure(given.one, given.columns)
        print(json.dumps(row))
        return row
    with tempfile.TemporaryDirectory() as folder:
        rows = [
            in_new_process(written(Path(folder) / f"{count}.txt", given.rows, count), count)
            for count in COLUMNS
            for _ in range(given.repeats)
        ]
    widest = [row for row in rows if row["columns"] == COLUMNS[-1]]
    seconds = min(row["processor_s"] for row in widest)
    megabytes = max(row["grown_bytes"] for row in widest) / 1e6
    what = f"of reading {given.rows} rows of {COLUMNS[-1]} columns"
    targets = [
        measuring.target(f"processor time {what}, s", SECONDS_ALLOWED, seconds, at_least=False),
        measuring.target(f"memory {what}, MB", MEGABYTES_ALLOWED, megabytes, at_least=False),
    ]
    return measuring.write(given.out, {"rows": rows, "targets": targets})


def written(path: Path, rows: int, columns: int) -> Path:
    """A table of random numbers over a time of even steps."""
    if path.exists():
        return path
    random = np.random.default_rng(columns)
    with path.open("w") as file:
        for begin in range(0, rows, 10_000):
            values = random.normal(0.0, 1e6, (min(10_000, rows - begin), columns))
            values[:, 0] = 0.01 * np.arange(begin, begin + len(values))
            np.savetxt(file, values, fmt=["%.4f"] + ["%.6e"] * (columns - 1))
    return path


def measure(path: Path, columns: int) -> dict[str, Any]:
    """Read a table in this process."""
    before, begun = memory.peak_bytes(), time.process_time()
    table = read_time_columns(path, columns, coarsest=1.0)
    return {
        "rows": len(table.values),
        "columns": columns,
        "file_bytes": path.stat().st_size,
        "processor_s": time.process_time() - begun,
        "grown_bytes": memory.peak_bytes() - before,
    }


def in_new_process(path: Path, columns: int) -> dict[str, Any]:
    """The row of one table, measured by this script in a fresh process."""
    command = [sys.executable, __file__, "--one", str(path), "--columns", str(columns)]
    done = subprocess.run(  # noqa: S603
        command, check=True, capture_output=True, text=True, env=dict(os.environ)
    )
    row: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return row


if __name__ == "__main__":
    main()
