"""The modes of a turbine in motion, in a browser.

    python viz/mode_shapes.py oc6_phase2 --foundation distributed_springs --mode FA2

Each mode has a page (``/FA1``, ``/SS1``, ...) with links to the others. The pages are served to
this computer only, until Ctrl-C.
"""

from __future__ import annotations

import argparse
import threading
import webbrowser
from collections.abc import Sequence
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import offwind_pin as ow
from offwind_pin.display.animation import animate

ADDRESS = "127.0.0.1"


class ModePages:
    """Pages of the modes of one system by their path, made when first asked for."""

    def __init__(self, system: ow.System, modes: ow.ModalResult, first: str) -> None:
        modes.index(first)  # an unknown mode is an error now, not once the browser asks
        self.modes, self.first = modes, first
        self._system = system
        self._pages: dict[str, bytes] = {}
        self._lock = threading.Lock()

    def page(self, path: str) -> bytes | None:
        """The page at a path: that of the first mode at ``/``, None where there is none."""
        label = path.removeprefix("/") or self.first
        if label not in self.modes.label:
            return None
        with self._lock:
            if label not in self._pages:
                text = animate(self._system, self.modes, label, links=True)
                self._pages[label] = text.encode()
            return self._pages[label]


def make_server(pages: ModePages, port: int = 0) -> ThreadingHTTPServer:
    """Server of the pages, bound to 127.0.0.1 and not yet running; port 0 takes a free one."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            page = pages.page(self.path.partition("?")[0])
            if page is None:
                self.send_error(HTTPStatus.NOT_FOUND, "No such mode")
                return
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(page)))
            self.end_headers()
            self.wfile.write(page)

        def log_message(self, *_: object) -> None:
            """Keep the terminal for the address."""

    return ThreadingHTTPServer((ADDRESS, port), Handler)


def main(argv: Sequence[str] | None = None) -> dict[str, float]:
    """Serve the modes until Ctrl-C; returns their frequencies in Hz by label."""
    parser = _parser()
    options = parser.parse_args(argv)
    try:
        turbine = ow.load_turbine(options.turbine)
        system = ow.build(turbine, options.foundation, sea=None if options.dry else ow.StillWater())
        modes = ow.modes(system, n=options.n)
        server = make_server(ModePages(system, modes, options.mode), options.port)
    except (ow.OffwindError, OSError, OverflowError) as error:
        parser.exit(2, f"{parser.prog}: {error}\n")
    with server:
        url = f"http://{ADDRESS}:{server.server_port}/{options.mode}"
        print(f"{url}   (Ctrl-C ends)", flush=True)
        if options.browser:
            webbrowser.open(url)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()
    return dict(zip(modes.label, modes.frequency_hz.tolist(), strict=True))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="mode_shapes", description="Show the modes of a turbine in motion, in a browser."
    )
    parser.add_argument(
        "turbine", nargs="?", default="oc6_phase2", help="shipped name, or path to a YAML file"
    )
    parser.add_argument("--foundation", default="distributed_springs")
    parser.add_argument("--mode", default="FA2", help="the mode to start with (default: FA2)")
    parser.add_argument("-n", type=int, default=10, help="number of modes (default: 10)")
    parser.add_argument("--dry", action="store_true", help="without the water's added mass")
    parser.add_argument("--port", type=int, default=0, help="by default any that is free")
    parser.add_argument("--no-browser", dest="browser", action="store_false", help="open none")
    return parser


if __name__ == "__main__":
    main()
