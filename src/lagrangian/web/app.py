"""The server of the app: files of the page, and one route a verb, which passes the request on to a process."""

from __future__ import annotations

import asyncio
import contextlib
import json
import secrets
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from importlib.resources import files
from typing import Any

from starlette.applications import Starlette
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Route

from lagrangian import __version__, examples
from lagrangian.web.guard import MAX_BODY, Gate
from lagrangian.web.pool import PoolLimits, Refused, WorkerPool

SECONDS = 10.0
"""The time [s] that a job may take."""

SWEEP_SECONDS = 300.0
"""The time [s] that a sweep may take."""

BODY_SECONDS = 10.0
"""The time [s] in which the body of a request must arrive."""

JOBS = ("derive", "look", "check", "preview", "simulate")
"""The routes that pass a request on to a process."""

TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
}

PAGE_POLICY = (
    "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; "
    "style-src 'unsafe-inline'; img-src data:; worker-src blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'self'"
)
"""The Content-Security-Policy of a page that moves. It is shown in a frame, has an origin of its own that is nobody's,
and cannot reach the app: it has neither the token nor a way to connect."""

PAGES = 4
"""So many pages that move are kept, the newest; they are found by a random name."""

GONE = 499
"""The status of a request that was given up; nobody receives it."""


class Desk:
    """The routes of one app, with what they share."""

    def __init__(
        self,
        model: tuple[str, str] | None = None,
        *,
        limits: PoolLimits | None = None,
        seconds: float = SECONDS,
        sweep_seconds: float = SWEEP_SECONDS,
        body_seconds: float = BODY_SECONDS,
    ) -> None:
        self.model, self.seconds, self.body_seconds = model, seconds, body_seconds
        self.sweep_seconds = sweep_seconds
        self.pool = WorkerPool(limits)
        self.asked = time.monotonic()
        """When the last request came [s]."""
        self._pages: dict[str, bytes] = {}

    def application(self, token: str, port: int) -> Gate:
        """Return the app as an ASGI application."""
        routes = [Route(f"/api/{verb}", self._job(verb), methods=["POST"]) for verb in JOBS]
        routes.append(Route("/api/page", self._page, methods=["POST"]))
        routes.append(Route("/page/{name}", self._shown, methods=["GET"]))
        routes.append(Route("/api/sweep", self._sweep, methods=["POST"]))
        routes.append(Route("/api/models", self._models, methods=["POST"]))
        routes += [Route(path, _file(*found), methods=["GET"]) for path, found in _files().items()]
        app = Starlette(routes=routes, lifespan=self._lifespan, exception_handlers={Refused: _refused})
        return Gate(app, token, port)

    @contextlib.asynccontextmanager
    async def _lifespan(self, app: Starlette) -> AsyncIterator[None]:
        self.pool.fill()
        try:
            yield
        finally:
            await self.pool.close()

    def _job(self, verb: str) -> Callable[[Request], Awaitable[Response]]:
        """A route that passes the arguments on to a process, and kills it if the request is given up."""

        async def respond(request: Request) -> Response:
            message = await self._worked(request, verb)
            return JSONResponse(message["answer"] if "answer" in message else {"error": message["error"]})

        return respond

    async def _worked(self, request: Request, verb: str) -> dict[str, Any]:
        """The message of a process about a request."""
        arguments = await self._arguments(request)
        try:
            message = await _unless_gone(request, self.pool.run(verb, arguments, seconds=self.seconds))
        except asyncio.CancelledError:  # only the end of the server cancels a request
            raise Refused(503, "the app has ended") from None
        if "fault" in message:
            raise Refused(int(message["status"]), str(message["fault"]))
        return message

    async def _page(self, request: Request) -> Response:
        """Make the page of a model that moves, and say where it is."""
        message = await self._worked(request, "page")
        if "answer" not in message:
            return JSONResponse({"error": message["error"]})
        name = secrets.token_urlsafe(24)
        self._pages[name] = str(message["answer"]).encode()
        for old in list(self._pages)[:-PAGES]:
            del self._pages[old]
        return JSONResponse({"address": f"/page/{name}"})

    async def _shown(self, request: Request) -> Response:
        """A page that was made."""
        found = self._pages.get(request.path_params["name"])
        if found is None:
            return Response("There is no such page.", 404)
        own = {"content-security-policy": PAGE_POLICY, "x-frame-options": "SAMEORIGIN"}
        return Response(found, headers={"content-type": TYPES[".html"], **own})

    async def _sweep(self, request: Request) -> Response:
        """The route of a sweep: parts of the answer as they are found, a line of JSON each, and the answer last."""
        return StreamingResponse(self._lines(await self._arguments(request)), media_type="application/x-ndjson")

    async def _lines(self, arguments: dict[str, Any]) -> AsyncIterator[bytes]:
        lines: asyncio.Queue[dict[str, Any]] = asyncio.Queue()

        async def take(part: Any) -> None:
            await lines.put({"part": part})

        async def work() -> None:
            try:
                message = await self.pool.run("sweep", arguments, seconds=self.sweep_seconds, on_part=take)
                if "fault" in message:
                    raise Refused(int(message["status"]), str(message["fault"]))
                await lines.put(message)
            except Refused as refused:
                await lines.put({"error": {"what": refused.what, "fix": refused.fix, "status": refused.status}})

        working = asyncio.create_task(work())
        try:
            message: dict[str, Any] = {"part": None}
            while "part" in message:
                message = await lines.get()
                yield json.dumps(message).encode() + b"\n"
        finally:  # also if nobody listens any more
            working.cancel()
            await asyncio.gather(working, return_exceptions=True)

    async def _arguments(self, request: Request) -> dict[str, Any]:
        """Return the body of a request as an object of JSON, within the limits on time and size."""
        self.asked = time.monotonic()
        body = bytearray()
        try:
            async with asyncio.timeout(self.body_seconds):
                async for chunk in request.stream():
                    body += chunk
                    if len(body) > MAX_BODY:
                        raise Refused(413, f"a request has at most {MAX_BODY >> 20} MiB")
        except TimeoutError:
            raise Refused(408, "the request did not arrive in time") from None
        except ClientDisconnect:
            raise Refused(GONE, "the request was given up") from None
        try:
            found = json.loads(bytes(body).decode("utf-8"), parse_constant=_no_number)
        except (ValueError, RecursionError):
            raise Refused(400, "the request is not JSON in UTF-8") from None
        if not isinstance(found, dict):
            raise Refused(400, "the request is not an object of JSON")
        return found

    async def _models(self, request: Request) -> Response:
        """The built-in examples with their texts, and the model that the app was started with."""
        await self._arguments(request)
        listed = [{"name": n, "description": examples.describe(n), "text": examples.text(n)} for n in examples.names()]
        opened = None if self.model is None else {"name": self.model[0], "text": self.model[1]}
        return JSONResponse({"version": __version__, "examples": listed, "opened": opened})


async def _refused(request: Request, refused: Exception) -> Response:
    """The answer to a request that was not done."""
    assert isinstance(refused, Refused)
    headers = (
        {"retry-after": "1"} if refused.status == 429 else {"connection": "close"} if refused.status == 413 else {}
    )
    return JSONResponse({"error": {"what": refused.what, "fix": refused.fix}}, refused.status, headers)


def _no_number(text: str) -> float:
    raise ValueError(text)


async def _unless_gone(request: Request, job: Awaitable[dict[str, Any]]) -> dict[str, Any]:
    """Return the result of a job; cancel it if the request is given up."""
    working, leaving = asyncio.ensure_future(job), asyncio.ensure_future(_gone(request))
    try:
        await asyncio.wait([working, leaving], return_when=asyncio.FIRST_COMPLETED)
        if working.done():
            return working.result()
        raise Refused(GONE, "the request was given up")
    finally:
        for task in (working, leaving):
            task.cancel()
        await asyncio.gather(working, leaving, return_exceptions=True)


async def _gone(request: Request) -> None:
    """Return when the other side has closed the connection."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _files() -> dict[str, tuple[bytes, str]]:
    """The files of the page: address → content and type. There are no others, whatever is asked for."""
    found: dict[str, tuple[bytes, str]] = {}
    for entry in files("lagrangian.web").joinpath("static").iterdir():
        kind = "." + entry.name.rpartition(".")[2]
        if kind in TYPES:
            found["/" if entry.name == "index.html" else f"/{entry.name}"] = entry.read_bytes(), TYPES[kind]
    style = files("lagrangian.write").joinpath("page.css").read_text(encoding="utf-8")
    nested = style.replace(":root", "&").replace("body {", "& {")  # the rules of a page, for a derivation in the app
    found["/derivation.css"] = f".lagrangian {{\n{nested}}}\n".encode(), TYPES[".css"]
    return found


def _file(content: bytes, kind: str) -> Callable[[Request], Awaitable[Response]]:
    async def respond(request: Request) -> Response:
        return Response(content, headers={"content-type": kind})

    return respond
