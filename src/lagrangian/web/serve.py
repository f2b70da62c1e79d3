"""Starts the server on a free port of 127.0.0.1, and prints the address with the token."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
import socket
import sys
import time
import webbrowser
from collections.abc import Callable
from typing import TypeAlias

import uvicorn

from lagrangian.errors import Error
from lagrangian.interrupts import interrupts
from lagrangian.web.app import Desk
from lagrangian.web.guard import MAX_HEAD

ADDRESS = "127.0.0.1"
"""The only address that the server listens on."""

CONNECTIONS = 32
"""Connections at a time; more are answered 503."""

TOKEN_BYTES = 24

Say: TypeAlias = Callable[[str], None]

IDLE = 8 * 3600.0
"""After this time [s] without a request, the app asks to be ended."""


def bound(port: int) -> socket.socket:
    """Return a socket that is bound to a port of this computer alone; port 0 chooses a free one."""
    made = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    if sys.platform != "win32":  # there the option would let others take the port
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        made.bind((ADDRESS, port))
    except OSError as error:
        made.close()
        what = f"cannot listen on port {port}: {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="leave --port out, and a free port is chosen", code="E801") from None
    return made


def serve(desk: Desk, port: int, tell: Say, say: Say, *, browser: bool) -> None:
    """Serve until Ctrl-C; ``tell`` receives the address, ``say`` everything else."""
    with bound(port) as listening:
        number = int(listening.getsockname()[1])
        token = secrets.token_urlsafe(TOKEN_BYTES)
        address = f"http://{ADDRESS}:{number}/#{token}"
        server = uvicorn.Server(settings(desk, token, number))
        interrupts.hand_over()
        with contextlib.suppress(KeyboardInterrupt):  # Ctrl-C is the way to end it
            asyncio.run(_serve(server, desk, listening, address, tell, say, browser))
        say("ended")


def settings(desk: Desk, token: str, port: int) -> uvicorn.Config:
    """Return the settings of the server: no log of addresses, small heads, few connections, no web sockets."""
    return uvicorn.Config(
        desk.application(token, port),
        http="h11",
        ws="none",
        loop="asyncio",
        lifespan="on",
        log_level="warning",
        access_log=False,
        server_header=False,
        date_header=False,
        proxy_headers=False,
        limit_concurrency=CONNECTIONS,
        h11_max_incomplete_event_size=MAX_HEAD,
        timeout_keep_alive=5,
        timeout_graceful_shutdown=1,
    )


async def _serve(
    server: uvicorn.Server,
    desk: Desk,
    listening: socket.socket,
    address: str,
    tell: Say,
    say: Say,
    browser: bool,
) -> None:
    serving = asyncio.create_task(server.serve(sockets=[listening]))
    while not (server.started or serving.done()):
        await asyncio.sleep(0.02)
    if server.started:
        say("The app runs at this address, which is for you alone:")
        tell(address)
        say("Ctrl-C ends it.")
        if browser:
            await asyncio.to_thread(webbrowser.open, address)
    watching = asyncio.create_task(idle(desk, say))
    try:
        await serving
    finally:
        watching.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await watching


async def idle(desk: Desk, say: Say, after: float = IDLE) -> None:
    """Ask to be ended after every long time without a request, and end the processes that wait."""
    while True:
        await asyncio.sleep(max(desk.asked + after - time.monotonic(), 1.0))
        if time.monotonic() - desk.asked >= after:
            say(f"Nothing was asked for {after / 3600:g} hours. If you are done, end the app with Ctrl-C.")
            await desk.pool.rest()
            await asyncio.sleep(after)
