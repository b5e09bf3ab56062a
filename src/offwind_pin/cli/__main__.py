"""``python -m offwind_pin.cli``."""

from offwind_pin.cli.main import main

main()
