"""A process that does one job after another: it reads a message, works within its limits, and writes the answer.

Messages to it are ``{"verb": …, "arguments": {…}}``. It writes ``{"ready": true}`` once, and then for every job any
number of ``{"part": …}`` and one of

    {"answer": …}                  what the job returns
    {"error": {…}}                 a mistake in the model or the arguments: what, where, and how to fix it
    {"fault": …, "status": …}      it could not be finished: no memory, too long an answer, or a mistake of ours
"""

from __future__ import annotations

import gc
import os
import queue
import sys
import threading
import traceback
from collections.abc import Callable, Mapping
from typing import Any, BinaryIO

from lagrangian.errors import Error
from lagrangian.web import limits
from lagrangian.web.frames import MAX_ANSWER, packed, read_frame
from lagrangian.web.requests import Task

PARENT = "LAGRANGIAN_WEB_PARENT"
"""The environment variable with the process number of the server."""


MEMORY = "LAGRANGIAN_WEB_MEMORY"
"""The environment variable with the memory [bytes] that a job may take."""


def main(load: Callable[[], Mapping[str, Task]]) -> None:
    """Do jobs until the input ends; ``load`` imports what they need, before memory is limited."""
    source, sink = _streams()
    if PARENT in os.environ:
        limits.end_with(int(os.environ[PARENT]))
    jobs = load()
    gc.collect()
    gc.freeze()
    limits.restrict(int(os.environ.get(MEMORY, limits.MEMORY)))
    sink.write(packed({"ready": True}))
    sink.flush()
    waiting: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(source, waiting), daemon=True, name="input").start()
    while True:
        message = waiting.get()
        sink.write(_answered(jobs, message, sink))
        sink.flush()
        gc.collect()


def _streams() -> tuple[BinaryIO, BinaryIO]:
    """Take the two streams for messages; what a library prints goes nowhere instead."""
    source, sink = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 0)
    os.dup2(nothing, 1)
    return source, sink


def _listen(source: BinaryIO, waiting: queue.SimpleQueue[dict[str, Any]]) -> None:
    """Pass messages on; when the server closes the stream, the process ends, whatever it is doing."""
    while (message := read_frame(source)) is not None:
        waiting.put(message)
    os._exit(0)


def _answered(jobs: Mapping[str, Task], message: dict[str, Any], sink: BinaryIO) -> bytes:
    """Do a job; return the message with its answer."""

    def part(value: Any) -> None:
        sink.write(packed({"part": value}))
        sink.flush()

    try:
        made = packed({"answer": jobs[message["verb"]](message["arguments"], part)})
    except Error as error:
        made = packed({"error": told(error)})
    except MemoryError:
        return packed({"fault": "this takes more memory than the app allows", "status": 507})
    except RecursionError:
        return packed({"fault": "this is nested too deeply", "status": 507})
    except Exception as error:
        traceback.print_exc(file=sys.stderr)
        return packed({"fault": f"a mistake in lagrangian itself ({type(error).__name__})", "status": 500})
    if len(made) > MAX_ANSWER:
        return packed({"fault": f"the answer is larger than {MAX_ANSWER >> 20} MiB", "status": 507})
    return made


def told(error: Error) -> dict[str, Any]:
    """Return an error as data: its parts, and the whole message as the command prints it."""
    from lagrangian.cli.wording import in_options

    error.fix = error.fix and in_options(error.fix)
    place = error.place
    return {
        "code": str(error.code) if error.code else None,
        "what": error.what,
        "element": error.element,
        "line": place.line if place else None,
        "column": place.column if place else None,
        "fix": error.fix,
        "message": str(error),
        "anyway": bool(getattr(error, "anyway", False)),
    }


def _jobs() -> Mapping[str, Task]:
    from lagrangian.web.jobs import JOBS
    from lagrangian.web.sweeps import sweep_job

    return {**JOBS, "sweep": sweep_job}


if __name__ == "__main__":
    main(_jobs)
