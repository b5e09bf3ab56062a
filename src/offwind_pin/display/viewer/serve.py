"""One page for this computer only: served on 127.0.0.1 until Ctrl-C."""

from __future__ import annotations

import sys
from http import HTTPStatus
from http.client import HTTP_PORT
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from offwind_pin.base.errors import InputError
from offwind_pin.display.report.templates import POLICY

ADDRESS = "127.0.0.1"


def page_server(page: str, port: int = 0) -> ThreadingHTTPServer:
    """Server of one page at ``/``, bound to 127.0.0.1 and not yet running; port 0 takes a free one.

    Raises
    ------
    InputError
        A port that cannot be used.
    """
    content = page.encode()
    names: list[list[str]] = []

    class Handler(BaseHTTPRequestHandler):
        timeout = 60  # s, of a client that has connected and asks for nothing

        def do_GET(self) -> None:
            # A page of another site whose name is made to resolve to this computer asks by its own.
            if self.headers.get_all("Host") not in names:
                self.send_error(HTTPStatus.FORBIDDEN, f"Only {ADDRESS} and localhost are served")
                return
            if self.path.partition("?")[0] != "/":
                self.send_error(HTTPStatus.NOT_FOUND, "There is one page, at /")
                return
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(content)))
            self.send_header("X-Content-Type-Options", "nosniff")
            self.end_headers()
            self.wfile.write(content)

        def end_headers(self) -> None:
            self.send_header("Content-Security-Policy", f"{POLICY}; frame-ancestors 'none'")
            super().end_headers()

        def log_message(self, *_: object) -> None:
            """Keep the terminal for the address."""

    class Server(ThreadingHTTPServer):
        daemon_threads = True  # a client that keeps its connection does not keep the process

        def handle_error(self, request: Any, client_address: Any) -> None:
            """Say nothing of a client that has gone away."""
            if not isinstance(sys.exception(), ConnectionError | TimeoutError):
                super().handle_error(request, client_address)

    try:
        server = Server((ADDRESS, port), Handler)
    except (OSError, OverflowError) as error:
        raise InputError(
            "--port", port, f"a free port ({error})", "Leave it out to use any free port."
        ) from None
    names += [[f"{host}:{server.server_port}"] for host in (ADDRESS, "localhost")]
    if server.server_port == HTTP_PORT:
        names += [[ADDRESS], ["localhost"]]
    return server


def address(server: ThreadingHTTPServer) -> str:
    """URL of its page."""
    return f"http://{ADDRESS}:{server.server_port}/"
