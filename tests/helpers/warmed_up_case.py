"""For a server of processes to load at its start: what it forks has everything compiled already."""

import tempfile
from pathlib import Path

from helpers.killed_case import run

with tempfile.TemporaryDirectory() as folder:
    run(Path(folder) / "out")
