"""One run of one peer in a process of its own, which may print, crash or lack its package.

Usage: python worker.py MODULE DT DURATION OUT.npz
"""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from problem import PeerRun

NOT_INSTALLED = 3
"""Exit code of a peer whose package is missing; the last line it prints says which."""

_ARRAYS = ("time", "seabed_moment", "section_moment")


class NotInstalledError(RuntimeError):
    """The peer's package is not there."""


class FailedRunError(RuntimeError):
    """The peer ran and gave no result."""


def run_apart(module: str, dt: float, duration: float) -> PeerRun:
    """A peer's run in a new process.

    Raises
    ------
    NotInstalledError : its package is missing
    FailedRunError : it crashed, diverged or did not converge
    """
    with TemporaryDirectory() as folder:
        out = Path(folder) / "run.npz"
        script = str(Path(__file__).resolve())
        command = [sys.executable, script, module, repr(dt), repr(duration), str(out)]
        # Some peers write logs where they run.
        done = subprocess.run(  # noqa: S603
            command, capture_output=True, text=True, check=False, cwd=folder
        )
        reason = (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]
        if done.returncode == NOT_INSTALLED:
            raise NotInstalledError(reason)
        if done.returncode or not out.exists():
            raise FailedRunError(last_error(done.stderr) or reason)
        with np.load(out) as stored:
            text = json.loads(str(stored["plain"]))
            return PeerRun(**text, **{name: stored[name] for name in _ARRAYS})


def last_error(text: str) -> str | None:
    """The last line that names an exception."""
    lines = [line for line in text.splitlines() if "Error: " in line]
    return lines[-1] if lines else None


def main(argv: list[str]) -> int:
    """Run and store; the exit code says whether the package is missing."""
    module, dt, duration, out = argv
    try:
        peer = importlib.import_module(module)
    except ModuleNotFoundError as error:
        print(f"no module {error.name}", file=sys.stderr)
        return NOT_INSTALLED
    result: PeerRun = peer.run(float(dt), float(duration))
    plain = {f.name: getattr(result, f.name) for f in fields(result) if f.name not in _ARRAYS}
    arrays = {name: getattr(result, name) for name in _ARRAYS}
    np.savez(out, plain=np.array(json.dumps(plain)), **arrays)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
