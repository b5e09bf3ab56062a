"""Entry point: errors become one message and an exit code."""

from __future__ import annotations

import errno
import logging
import sys

from offwind_pin.base.errors import InputError, InterruptedSimulation, SolverError, printable
from offwind_pin.cli.commands import app
from offwind_pin.cli.exit_codes import EXIT_INPUT, EXIT_INTERRUPTED, EXIT_SOLVER, EXIT_SYSTEM


def main() -> None:
    """Entry point of the ``offwind`` command."""
    handler = logging.StreamHandler()
    handler.setFormatter(Plain("offwind: %(message)s"))
    logging.basicConfig(level=logging.WARNING, handlers=[handler])
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
        sys.exit(EXIT_INPUT if error.errno in _BAD_NAMES else EXIT_SYSTEM)
    except MemoryError:
        complain("offwind: not enough memory; choose fewer elements, longer steps or fewer outputs")
        sys.exit(EXIT_SYSTEM)


_BAD_NAMES = (errno.ENAMETOOLONG, errno.ELOOP)
"""Of errors that a path itself makes."""


class Plain(logging.Formatter):
    """Lines of the log, in which paths cannot steer the terminal."""

    def format(self, record: logging.LogRecord) -> str:
        return "\n".join(map(printable, super().format(record).split("\n")))


def complain(message: str) -> None:
    """A line on standard error."""
    print(printable(message), file=sys.stderr)  # noqa: T201
