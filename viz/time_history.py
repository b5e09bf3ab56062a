"""Results of a run in motion in the browser, in Meshcat, served from this computer only."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import offwind_pin as ow


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the results and serve their page until Ctrl-C."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", help="directory of `offwind run`, or its results.nc")
    parser.add_argument("--start", type=float, help="of the part shown, in s")
    parser.add_argument("--duration", type=float, help="of the part shown, in s")
    parser.add_argument("--port", type=int, default=0, help="by default any that is free")
    parser.add_argument("--no-browser", action="store_true", help="print the address only")
    given = parser.parse_args(arguments)

    page = ow.viewer.time_history(given.results, given.start, given.duration)
    ow.viewer.serve(page, given.port, browser=not given.no_browser)


if __name__ == "__main__":
    main()
