"""Entry point: errors become one message and an exit code."""

from __future__ import annotations

import logging
import sys

from offwind_pin.base.errors import InputError, InterruptedSimulation, SolverError
from offwind_pin.cli.commands import app
from offwind_pin.cli.exit_codes import EXIT_INPUT, EXIT_INTERRUPTED, EXIT_SOLVER, EXIT_SYSTEM


def main() -> None:
    """Entry point of the ``offwind`` command."""
    logging.basicConfig(level=logging.WARNING, format="offwind: %(message)s")
    logging.getLogger("offwind_pin").setLevel(logging.INFO)
    try:
        app()
    except InputError as error:
        complain(f"offwind: {error}")
        sys.exit(EXIT_INPUT)
    except SolverError as error:
        complain(f"offwind: {error}")
        sys.exit(EXIT_SOLVER)
    except InterruptedSimulation as stopped:
        complain(f"offwind: {stopped}; the results so far are kept")
        sys.exit(EXIT_INTERRUPTED)
    except OSError as error:
        complain(f"offwind: {error.strerror or error}: {error.filename or 'while writing'}")
        sys.exit(EXIT_SYSTEM)


def complain(message: str) -> None:
    print(message, file=sys.stderr)  # noqa: T201
