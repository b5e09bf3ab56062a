"""For a server of processes to load at its start: what it forks has everything compiled already."""

import tempfile
from pathlib import Path

from helpers.killed_run import INTEGRATORS, run

with tempfile.TemporaryDirectory() as folder:
    for steps in INTEGRATORS:
        run(Path(folder) / steps, steps, duration=12.0)
