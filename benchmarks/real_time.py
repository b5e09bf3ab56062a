"""LC 5.1 of OC6 Phase II in real time: ``simulate`` alone, and the command ``offwind run`` whole.

The command reads the case, solves, writes results and report; its time is that of a new process,
with machine code kept from an earlier run.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import measuring
from operational_case import NAME, operational_case

ALLOWED = 100.0


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Measure both and write the results."""
    parser = measuring.options("real_time", __doc__)
    parser.add_argument("--seconds", type=float, help="simulated time, by default the case's own")
    parser.add_argument("--no-command", action="store_true", help="leave offwind run out")
    given = parser.parse_args(argv)
    build = measuring.wall(lambda: operational_case(given.seconds))
    case = operational_case(given.seconds)
    data = case.simulate()
    runs = [measuring.wall(case.simulate) for _ in range(given.repeats)]
    factor = case.duration / statistics.median(runs)
    command = [] if given.no_command else [run_command() for _ in range(given.repeats)]
    whole = operational_case().duration / statistics.median(command) if command else None
    return measuring.write(
        given.out,
        {
            "case": NAME,
            "elements": case.system.chain.elements,
            "degrees_of_freedom": case.system.nv,
            "simulated_s": case.duration,
            "dt_s": case.dt,
            "output_dt_s": case.output_dt,
            "repeats": given.repeats,
            "mean_corrections": float(data["solver_iterations"][1:].mean()),
            "build_s": build,
            "simulate_s": runs,
            "simulate_real_time_factor": factor,
            "command_s": command,
            "command_real_time_factor": whole,
            "targets": [
                measuring.target(
                    f"real-time factor of simulate, {NAME}", ALLOWED, factor, at_least=True
                )
            ],
        },
    )


def run_command() -> float:
    """Wall time of ``offwind run`` on the case in s."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [sys.executable, "-m", "offwind_pin.cli", "run", NAME, "--out", folder]
        script = Path(sys.executable).parent / "offwind"
        if script.is_file():
            arguments = [str(script), *arguments[3:]]
        return measuring.wall(
            lambda: subprocess.run(arguments, check=True, capture_output=True)  # noqa: S603
        )


if __name__ == "__main__":
    main()
