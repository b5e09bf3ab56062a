"""Exit codes of the ``offwind`` command."""

from __future__ import annotations

EXIT_SYSTEM, EXIT_INPUT, EXIT_SOLVER, EXIT_INTERRUPTED = 1, 2, 3, 130
