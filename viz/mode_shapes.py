"""Mode shapes of a turbine in the browser, in Meshcat, served from this computer only."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import offwind_pin as ow


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute the modes and serve their page until Ctrl-C."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "turbine", nargs="?", default="oc6_phase2", help="shipped name or YAML file"
    )
    parser.add_argument("--foundation", default="distributed_springs")
    parser.add_argument("--modes", help="shown first, up to four: FA1,SS1,FA2,T1")
    parser.add_argument("--port", type=int, default=0, help="by default any that is free")
    parser.add_argument("--no-browser", action="store_true", help="print the address only")
    given = parser.parse_args(arguments)

    system = ow.build(ow.load_turbine(given.turbine), given.foundation, ow.StillWater())
    modes = ow.modes(system, n=10)
    labels = None if given.modes is None else given.modes.upper().split(",")
    page = ow.viewer.mode_shapes(system, modes, labels)
    ow.viewer.serve(page, given.port, browser=not given.no_browser)


if __name__ == "__main__":
    main()
