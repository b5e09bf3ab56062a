"""A run in a process that ends itself at a chosen file operation, and can be started again."""

import os
import resource
import signal
import sys
from pathlib import Path
from typing import Any

import offwind_pin as ow

DT, OUTPUT, DURATION = 0.05, 1.0, 400.0

INTEGRATORS = {
    "fixed": ow.GeneralizedAlpha(ow.FixedStep(DT)),
    "adaptive": ow.GeneralizedAlpha(ow.AdaptiveStep(1e-5, largest=0.5)),
}


def run(directory: Path, steps: str, duration: float = DURATION) -> None:
    """On soil in waves, so that the state at the end of a block has all its parts."""
    turbine = ow.load_turbine("oc6_phase2").model_copy(update={"structural_damping": None})
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=DURATION)
    system = ow.build(turbine, "distributed_springs", waves, elements=4)
    ow.simulate(
        system,
        duration,
        ramp=10.0,
        save_at=ow.SaveAt(OUTPUT, heights=[0.0]),
        integrator=INTEGRATORS[steps],
        directory=directory,
    ).close()


class Operations:
    """Counts what Python does to the files of a folder, and ends the process at one of them.

    Between two operations a run leaves nothing behind, so that a kill before each of them is a kill
    at any moment, except in the middle of a write: with a ``limit`` the process goes on until a
    file is opened, and dies at its next write beyond so many bytes.

    Parameters
    ----------
    folder : whose files are counted, at any depth
    last : the operation at which the process ends, counted from one; zero for none
    limit : bytes; zero ends the process before the operation
    """

    EVENTS = frozenset({"open", "os.mkdir", "os.remove", "os.rename", "os.rmdir"})

    def __init__(self, folder: Path, last: int = 0, limit: int = 0) -> None:
        self.folder, self.last, self.limit = str(folder), last, limit
        self.count = 0

    def __call__(self, event: str, arguments: tuple[Any, ...]) -> None:
        """An audit hook of the interpreter."""
        if event not in self.EVENTS or not isinstance(arguments[0], str | Path):
            return
        if not str(arguments[0]).startswith(self.folder):
            return
        self.count += 1
        if not self.last or self.count < self.last:
            return
        if not self.limit:
            os.kill(os.getpid(), signal.SIGKILL)
        elif event == "open":
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_FSIZE, (self.limit, self.limit))


def run_and_die(directory: Path, steps: str, last: int, limit: int) -> None:
    """In a process of its own: hooks of an interpreter cannot be removed."""
    sys.addaudithook(Operations(directory, last, limit))
    run(directory, steps)


def run_and_count(directory: Path, steps: str, counted: Any) -> None:
    """A whole run; the number of its operations goes to a queue."""
    operations = Operations(directory)
    sys.addaudithook(operations)
    run(directory, steps)
    counted.put(operations.count)
