"""Who may ask: checks every request before anything looks at it, and sets the headers of every answer.

A page of another site must not reach the app, whatever it tries: it has another Origin, cannot set the header with the
token, cannot send JSON without being asked for permission first, which nobody gives, and with a name that it points at
127.0.0.1 (DNS rebinding) it has the wrong Host.
"""

from __future__ import annotations

import hmac
import json
from collections.abc import Iterable
from typing import TypeAlias

from starlette.types import ASGIApp, Message, Receive, Scope, Send

Headers: TypeAlias = "list[tuple[bytes, bytes]]"

HOSTS = ("127.0.0.1", "localhost", "[::1]")
"""The names under which the app can be reached."""

TOKEN = b"x-lagrangian-token"
"""The header of every POST with the token that stands after # in the address."""

MAX_HEAD = 16 * 1024
"""The largest size of the head of a request in bytes."""

MAX_BODY = 2**20
"""The largest size of the body of a request in bytes."""

POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""The Content-Security-Policy of the app: its own files, and nothing inline."""

SECURE: Headers = [
    (b"content-security-policy", POLICY.encode()),
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"referrer-policy", b"no-referrer"),
    (b"cache-control", b"no-store"),
]
"""The headers of every answer, unless its route sets them itself."""


class Gate:
    """An application that lets only the app's own page through to another application."""

    def __init__(self, app: ASGIApp, token: str, port: int) -> None:
        self._app, self._token = app, token.encode()
        self._hosts = {f"{name}:{port}".encode() for name in HOSTS}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or pass it on."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":  # no route has a web socket
            await send({"type": "websocket.close", "code": 1008})
            return
        refusal = self._refused(scope["method"], scope["headers"])
        if refusal is None:
            await self._app(scope, receive, _securely(send))
        else:
            await _answer(_securely(send), *refusal)

    def _refused(self, method: str, headers: Headers) -> tuple[int, str] | None:
        """The status and the reason if a request is not one of the app's own page."""
        if sum(len(name) + len(value) + 4 for name, value in headers) > MAX_HEAD:
            return 431, "the head of the request is too large"
        hosts = _all(headers, b"host")
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            return 421, "this app answers only at the address that it printed"
        if any(origin.lower() != b"http://" + hosts[0].lower() for origin in _all(headers, b"origin")):
            return 403, "only the page of this app may ask it"
        own = (b"same-origin",) if method == "POST" else (b"same-origin", b"none")
        if any(site not in own for site in _all(headers, b"sec-fetch-site")):
            return 403, "only the page of this app may ask it"
        if method != "POST":
            return None
        tokens = _all(headers, TOKEN)
        if len(tokens) != 1 or not hmac.compare_digest(tokens[0], self._token):
            return 401, "the token is missing or wrong: open the address that the app printed"
        types = _all(headers, b"content-type")
        if len(types) != 1 or types[0].lower().replace(b" ", b"") not in _JSON:
            return 415, "a request is application/json"
        lengths = _all(headers, b"content-length")
        if any(not length.isdigit() for length in lengths):
            return 400, "the length of the request is not a number"
        if any(int(length) > MAX_BODY for length in lengths):
            return 413, f"a request has at most {MAX_BODY >> 20} MiB"
        return None


_JSON = (b"application/json", b"application/json;charset=utf-8")


def _all(headers: Iterable[tuple[bytes, bytes]], name: bytes) -> list[bytes]:
    return [value.strip() for key, value in headers if key.lower() == name]


def _securely(send: Send) -> Send:
    """Add the headers of every answer."""

    async def with_headers(message: Message) -> None:
        if message["type"] == "http.response.start":
            own = {name.lower() for name, _ in message["headers"]}
            message["headers"] = [*message["headers"], *(pair for pair in SECURE if pair[0] not in own)]
        await send(message)

    return with_headers


async def _answer(send: Send, status: int, what: str) -> None:
    body = json.dumps({"error": {"what": what}}).encode()
    headers = [(b"content-type", b"application/json"), (b"content-length", str(len(body)).encode())]
    if status in (413, 431):  # what is left of the request is not read
        headers.append((b"connection", b"close"))
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
