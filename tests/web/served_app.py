"""An app that serves in this process, on a port of its own, and what asks it."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import httpx
import uvicorn

from lagrangian.web.app import Desk
from lagrangian.web.pool import PoolLimits
from lagrangian.web.serve import bound, settings

TOKEN = "a" * 32


class Served:
    """A running app: its port, and requests to it as its own page makes them."""

    def __init__(self, port: int, desk: Desk) -> None:
        self.port, self.desk = port, desk
        self.address = f"http://127.0.0.1:{port}"
        self.headers = {"x-lagrangian-token": TOKEN, "content-type": "application/json"}

    def ask(self, verb: str, data: Any = None, **options: Any) -> httpx.Response:
        headers = {**self.headers, **options.pop("headers", {})}
        return httpx.post(f"{self.address}/api/{verb}", json=data or {}, headers=headers, timeout=None, **options)

    def raw(self, *pieces: bytes) -> bytes:
        """Send bytes as they are, and return what comes back until the other side closes."""
        with socket.create_connection(("127.0.0.1", self.port)) as connection:
            for piece in pieces:
                connection.sendall(piece)
            found = b""
            while chunk := connection.recv(65536):
                found += chunk
        return found


@contextmanager
def served(limits: PoolLimits | None = None, **options: Any) -> Iterator[Served]:
    """Serve an app until the block ends."""
    desk = Desk(limits=limits, **options)
    with bound(0) as listening:
        port = int(listening.getsockname()[1])
        server = uvicorn.Server(settings(desk, TOKEN, port))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
        thread.start()
        while not server.started and thread.is_alive():
            thread.join(0.01)
        try:
            yield Served(port, desk)
        finally:
            server.should_exit = True
            thread.join()
