"""One page for this computer only: served on 127.0.0.1 until Ctrl-C."""

from __future__ import annotations

from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from offwind_pin.base.errors import InputError

ADDRESS = "127.0.0.1"


def page_server(page: str, port: int = 0) -> ThreadingHTTPServer:
    """Server of one page at ``/``, bound to 127.0.0.1 and not yet running; port 0 takes a free one.

    Raises
    ------
    InputError
        A port that cannot be had.
    """
    content = page.encode()

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            if self.path.partition("?")[0] != "/":
                self.send_error(HTTPStatus.NOT_FOUND, "There is one page, at /")
                return
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: object) -> None:
            """Keep the terminal for the address."""

    try:
        return ThreadingHTTPServer((ADDRESS, port), Handler)
    except (OSError, OverflowError) as error:
        raise InputError(
            "--port", port, f"a port that is free ({error})", "Leave it out, and one is found."
        ) from None


def address(server: ThreadingHTTPServer) -> str:
    """URL of its page."""
    return f"http://{ADDRESS}:{server.server_port}/"
