"""Peak memory of a run in a process of its own: ``python memory_of_a_run.py SECONDS FOLDER``."""

import resource
import sys
from pathlib import Path

import numpy as np

import offwind_pin as ow

HEIGHTS = 25
"""Enough that three hours of records would not go unnoticed if they stayed in memory."""


def main() -> None:
    duration, folder = float(sys.argv[1]), Path(sys.argv[2])
    turbine = ow.load_turbine("oc6_phase2").model_copy(update={"structural_damping": None})
    # the same sea for all durations, so that it is not what memory grows with
    waves = ow.IrregularWaves(1.25, 5.5, seed=1, repeat_period=10800.0)
    system = ow.build(turbine, "distributed_springs", waves, elements=4)
    heights = np.linspace(system.chain.base, system.chain.top, HEIGHTS)
    data = ow.simulate(
        system,
        duration,
        0.05,
        ramp=60.0,
        save_at=ow.SaveAt(0.1, heights=heights.tolist()),
        directory=folder,
    )
    in_memory = sum(variable.size * 8 for variable in data.variables.values())
    sys.stdout.write(f"{peak()} {in_memory}")


def peak() -> int:
    """Largest memory of this process so far in bytes.

    Linux counts what a process was before it became this program in ``ru_maxrss``, so that a large
    parent would hide the child; the high-water mark of the program itself is in its status.
    """
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
        return next(1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM"))
    except OSError:
        size = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return size if sys.platform == "darwin" else 1024 * size


if __name__ == "__main__":
    main()
