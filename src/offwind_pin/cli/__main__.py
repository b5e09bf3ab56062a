"""``python -m offwind_pin.cli``."""

from offwind_pin.cli.main import main

if __name__ == "__main__":
    main()
