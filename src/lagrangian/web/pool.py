"""The processes that do the jobs: two at a time, a warm one in reserve, a short queue, and an end to everything.

A process does one job at a time. One that takes too long, grows too large, dies, or works for a request that was given
up is killed and replaced; since another is ready by then, nobody waits for its imports.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys
from collections.abc import Awaitable, Callable
from typing import Any, TypeAlias

from lagrangian.records import dataclass
from lagrangian.web import worker as process_of
from lagrangian.web.frames import HEAD, MAX_FRAME, packed, unpacked
from lagrangian.web.limits import MEMORY, size_of

OnPart: TypeAlias = Callable[[Any], Awaitable[None]]

WATCH = 0.1
"""The time [s] between two looks at the size of a process at work."""

START = 120.0
"""The time [s] that a process may take to start."""

JOBS_EACH = 200
"""A process that did so many jobs is replaced: caches of its libraries grow."""

STARTS = 3
"""Processes may fail to start so many times in a row."""


class Refused(Exception):
    """A job that was not done: the status of HTTP, what happened, and what can be done about it."""

    def __init__(self, status: int, what: str, fix: str | None = None) -> None:
        super().__init__(what)
        self.status, self.what, self.fix = status, what, fix


class _Ended(Exception):
    """The process ended, or wrote what is not a message."""


@dataclass(frozen=True)
class PoolLimits:
    """How many jobs run and wait at a time, and the memory [bytes] that each may take above its start."""

    workers: int = 2
    spare: int = 1
    waiting: int = 8
    memory: int = MEMORY
    module: str = "lagrangian.web.worker"


class WorkerProcess:
    """A process, from its start to its end."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self.process, self.start_size, self.done = process, 0, 0

    @classmethod
    async def started(cls, module: str, memory: int) -> WorkerProcess:
        """Start a process and wait until it is ready. Raises `Refused` if it does not start."""
        environment = {
            **os.environ,
            process_of.PARENT: str(os.getpid()),
            process_of.MEMORY: str(memory),
            "LAGRANGIAN_CACHE_DIR": "",  # no file may be written
            "PYTHONDONTWRITEBYTECODE": "1",
            "MALLOC_ARENA_MAX": "2",  # arenas take address space, which is limited
        }
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-P",  # the working directory is not a place to import from
            "-m",
            module,
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            env=environment,
            start_new_session=os.name == "posix",  # Ctrl-C is for the server, which ends it
        )
        made = cls(process)
        try:
            async with asyncio.timeout(START):
                await made.read()
        except (TimeoutError, _Ended):
            await made.kill()
            raise Refused(500, "a process of the app does not start", "see the terminal for the reason") from None
        except BaseException:
            await made.kill()
            raise
        made.start_size = size_of(process.pid) or 0
        return made

    @property
    def alive(self) -> bool:
        """Whether the process runs."""
        return self.process.returncode is None

    async def read(self) -> dict[str, Any]:
        """Return its next message. Raises `_Ended`."""
        stream = self.process.stdout
        assert stream is not None
        try:
            (length,) = HEAD.unpack(await stream.readexactly(HEAD.size))
            if length > MAX_FRAME:
                raise _Ended
            return unpacked(await stream.readexactly(length))
        except (asyncio.IncompleteReadError, OSError, ValueError):
            raise _Ended from None

    async def work(self, job: dict[str, Any], on_part: OnPart | None) -> dict[str, Any]:
        """Do a job; return the last message about it. Raises `_Ended`."""
        stream = self.process.stdin
        assert stream is not None
        self.done += 1
        try:
            stream.write(packed(job))
            await stream.drain()
        except OSError:
            raise _Ended from None
        while "part" in (message := await self.read()):
            if on_part is not None:
                await on_part(message["part"])
        return message

    async def outgrown(self, memory: int) -> None:
        """Return when the process is larger than at its start by more than ``memory`` bytes."""
        while True:
            await asyncio.sleep(WATCH)
            size = await asyncio.to_thread(size_of, self.process.pid) if sys.platform == "darwin" else self.size()
            if size is not None and size > self.start_size + memory:
                return

    def size(self) -> int | None:
        """The memory of the process in bytes."""
        return size_of(self.process.pid)

    async def kill(self) -> None:
        """Kill the process and wait for its end."""
        with contextlib.suppress(ProcessLookupError):
            self.process.kill()
        if self.process.stdin is not None:
            self.process.stdin.close()
        await self.process.wait()


class WorkerPool:
    """Does jobs in processes, within limits."""

    def __init__(self, limits: PoolLimits | None = None) -> None:
        self.limits = limits or PoolLimits()
        self._free = asyncio.Semaphore(self.limits.workers)
        self._ready: asyncio.Queue[WorkerProcess] = asyncio.Queue()
        self._starting: set[asyncio.Task[None]] = set()
        self._all: set[WorkerProcess] = set()
        self._waiting = self._failed = self._busy = 0
        self._closed = False

    @property
    def busy(self) -> int:
        """The number of jobs at work."""
        return self._busy

    @property
    def waiting(self) -> int:
        """The number of jobs in the queue."""
        return self._waiting

    def fill(self) -> None:
        """Start as many processes as are missing."""
        wanted = self.limits.workers + self.limits.spare - len(self._all) - len(self._starting)
        for _ in range(0 if self._closed else wanted):
            task = asyncio.create_task(self._start())
            self._starting.add(task)
            task.add_done_callback(self._starting.discard)

    async def _start(self) -> None:
        try:
            made = await WorkerProcess.started(self.limits.module, self.limits.memory)
        except Refused:
            self._failed += 1
            return
        self._failed = 0
        self._all.add(made)
        self._ready.put_nowait(made)

    async def run(
        self, verb: str, arguments: dict[str, Any], *, seconds: float, on_part: OnPart | None = None
    ) -> dict[str, Any]:
        """Return the last message of a job: its answer, its error or its fault.

        Raises `Refused` if too many wait (429), if it takes longer than ``seconds`` once it has begun (408), or if it
        takes too much memory or its process dies (507). If the caller is cancelled, the job ends with it.
        """
        if self._waiting >= self.limits.waiting and self._free.locked():
            raise Refused(429, "too many requests at a time", "wait a moment")
        self._waiting += 1
        try:
            await self._free.acquire()
        finally:
            self._waiting -= 1
        try:
            self._busy += 1
            worker = await self._taken()
            return await self._within(worker, {"verb": verb, "arguments": arguments}, seconds, on_part)
        finally:
            self._busy -= 1
            self._free.release()

    async def _taken(self) -> WorkerProcess:
        """The next process that is ready."""
        while True:
            self.fill()
            while not self._ready.empty():
                worker = self._ready.get_nowait()
                if worker.alive:
                    return worker
                await self._drop(worker)
            if self._closed or self._failed >= STARTS:
                self._failed = 0
                raise Refused(500, "the processes of the app do not start", "see the terminal for the reason")
            starting = list(self._starting)
            got = asyncio.create_task(self._ready.get())
            try:
                await asyncio.wait([got, *starting], return_when=asyncio.FIRST_COMPLETED)
            finally:
                if got.done():
                    self._ready.put_nowait(got.result())
                else:
                    got.cancel()

    async def _within(
        self, worker: WorkerProcess, job: dict[str, Any], seconds: float, on_part: OnPart | None
    ) -> dict[str, Any]:
        """Let a process do a job within the limits; kill it if it does not keep to them, otherwise keep it."""
        answer = asyncio.create_task(worker.work(job, on_part))
        large = asyncio.create_task(worker.outgrown(self.limits.memory))
        kept = False
        try:
            done, _ = await asyncio.wait({answer, large}, timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
            if not done:
                raise Refused(408, f"this takes longer than {seconds:g} s", "try a smaller model, or the command")
            if answer not in done:
                raise Refused(507, "this takes more memory than the app allows", "try a smaller model, or the command")
            try:
                message = answer.result()
            except _Ended:
                raise Refused(507, "the process that worked on this has ended", "try a smaller model") from None
            kept = self._is_fit(worker) and message.get("status") is None
            return message
        finally:
            large.cancel()
            answer.cancel()
            await asyncio.gather(large, answer, return_exceptions=True)
            if kept:
                self._ready.put_nowait(worker)
            else:
                await self._drop(worker)
                self.fill()

    def _is_fit(self, worker: WorkerProcess) -> bool:
        """Whether a process may do another job: it runs, is not too large, and did not do too many."""
        size = worker.size() if sys.platform != "darwin" else None
        small = size is None or size < worker.start_size + self.limits.memory // 2
        return worker.alive and worker.done < JOBS_EACH and small

    async def _drop(self, worker: WorkerProcess) -> None:
        self._all.discard(worker)
        await worker.kill()

    async def rest(self) -> None:
        """End the processes that have nothing to do; they start again with the next job."""
        while not self._ready.empty():
            await self._drop(self._ready.get_nowait())

    async def close(self) -> None:
        """End all processes."""
        self._closed = True
        for task in list(self._starting):
            task.cancel()
        await asyncio.gather(*self._starting, return_exceptions=True)
        for worker in list(self._all):
            await self._drop(worker)
