"""The server of one page: who may ask, what is sent, and clients that go away."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from http.server import ThreadingHTTPServer

import pytest

from offwind_pin.display.viewer.serve import page_server

PAGE = "<p>page</p>" * 100_000


@pytest.fixture
def server() -> Iterator[ThreadingHTTPServer]:
    with page_server(PAGE) as made:
        thread = threading.Thread(target=made.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield made
        made.shutdown()
        thread.join()


def ask(
    server: ThreadingHTTPServer, *lines: str, path: str = "/"
) -> tuple[int, dict[str, str], str]:
    """Status, headers and body of the answer to a request with these header lines."""
    with socket.create_connection(("127.0.0.1", server.server_port)) as connection:
        request = "\r\n".join([f"GET {path} HTTP/1.1", *lines, "Connection: close", "", ""])
        connection.sendall(request.encode())
        answer = b"".join(iter(lambda: connection.recv(65536), b"")).decode()
    head, _, body = answer.partition("\r\n\r\n")
    status, *rows = head.split("\r\n")
    headers = dict(row.split(": ", 1) for row in rows)
    return int(status.split()[1]), headers, body


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost"])
def test_page_and_its_policy(server: ThreadingHTTPServer, host: str) -> None:
    """Either name of this computer gets the page; it may load nothing and be framed by nobody."""
    status, headers, body = ask(server, f"Host: {host}:{server.server_port}")
    assert (status, body) == (200, PAGE)
    policy = headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "frame-ancestors 'none'" in policy


@pytest.mark.parametrize(
    "lines",
    [
        ["Host: example.org:{port}"],
        ["Host: 127.0.0.1.example.org:{port}"],
        ["Host: localhost:1"],
        ["Host: 127.0.0.1"],
        ["Host: "],
        [],
        ["Host: 127.0.0.1:{port}", "Host: example.org"],
    ],
)
@pytest.mark.parametrize("path", ["/", "/other"])
def test_other_names_are_refused(server: ThreadingHTTPServer, lines: list[str], path: str) -> None:
    """A name that is made to resolve to this computer does not get the page."""
    named = [line.format(port=server.server_port) for line in lines]
    status, headers, body = ask(server, *named, path=path)
    assert status == 403
    assert PAGE not in body
    assert "Content-Security-Policy" in headers


def test_clients_that_go_away(
    server: ThreadingHTTPServer, capsys: pytest.CaptureFixture[str]
) -> None:
    """One that resets the connection in the middle of the page leaves no trace."""
    for _ in range(5):
        connection = socket.create_connection(("127.0.0.1", server.server_port))
        linger = b"\x01\x00\x00\x00\x00\x00\x00\x00"  # close with a reset
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
        connection.sendall(
            f"GET / HTTP/1.1\r\nHost: localhost:{server.server_port}\r\n\r\n".encode()
        )
        connection.recv(100)
        connection.close()
    assert ask(server, f"Host: localhost:{server.server_port}")[0] == 200
    assert capsys.readouterr().err == ""
