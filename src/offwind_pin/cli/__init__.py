"""The ``offwind`` command."""

from offwind_pin.cli.main import main

__all__ = ["main"]
