"""``python -m offwind_pin`` is the ``offwind`` command."""

from offwind_pin.cli.main import main

if __name__ == "__main__":
    main()
