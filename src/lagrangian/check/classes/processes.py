"""Judges answers in several processes, with the same results as in one; a process that is killed is told.

Every process derives the system once. They are plain Python processes that talk by lines of JSON, so nothing depends
on how an operating system starts processes, and nothing of a user's script runs twice.
"""

from __future__ import annotations

import base64
import contextlib
import json
import os
import queue
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from lagrangian.check.classes.judge import Judging, Record, untold
from lagrangian.errors import Error, ModelError

PER_PROCESS = 25
"""The number of answers from which another process is worth its start."""

ALONE = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Small products of matrices are not worth threads, which would only wait for each other's core."""

KEPT = {"SYMPY_CACHE_SIZE": "20000"}
"""How many results of each of its functions SymPy keeps, unless a user says otherwise: answers of a class need the same
ones."""

PATIENCE = 10
"""The time [s] for a process to end whose output has ended."""

Task: TypeAlias = tuple[int, str, bytes]
"""An answer that waits: its index, its file, its content."""


def process_count(wanted: int | None, answers: int) -> int:
    """The number of processes: as many as wanted, otherwise as many as there are cores and work for.

    Raises `ModelError` for a number below 1.
    """
    if wanted is not None:
        if isinstance(wanted, bool) or not isinstance(wanted, int) or wanted < 1:
            raise ModelError(f"processes is a number from 1 (got {wanted!r})", fix="processes=2", code="E406")
        return max(min(wanted, answers), 1)
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(min(cores, answers // PER_PROCESS), 1)


def judged_by_processes(
    model: str, judging: Judging, tasks: Sequence[Task], count: int
) -> Iterator[tuple[int, Record, bool]]:
    """Yield index, record and whether it is final for every task, in the order in which they are done.

    ``model`` is the text of the model file. A record is not final if the process was killed before it was made. Raises
    `Error` if the model cannot be derived.
    """
    waiting = deque(tasks)
    done: queue.SimpleQueue[tuple[int, Record, bool] | Exception | None] = queue.SimpleQueue()
    opening = json.dumps({"model": model, "judging": judging.to_dict()})
    teams = [_Team(opening, waiting.popleft(), waiting, done) for _ in range(count)]
    try:
        for team in teams:
            team.start()
        left = count
        while left:
            item = done.get()
            if item is None:
                left -= 1
            elif isinstance(item, Exception):
                raise item
            else:
                yield item
    finally:
        for team in teams:
            team.stop()


class _Team(threading.Thread):
    """A thread that gives tasks to a process, one at a time, and starts another if it ends too early."""

    def __init__(
        self,
        opening: str,
        first: Task,
        waiting: deque[Task],
        done: queue.SimpleQueue[tuple[int, Record, bool] | Exception | None],
    ) -> None:
        super().__init__(daemon=True, name="judging")
        self._opening, self._first, self._waiting, self._done = opening, first, waiting, done
        self._process: subprocess.Popen[str] | None = None
        self._stopped = False

    def run(self) -> None:
        """Do tasks until none is left."""
        try:
            task: Task | None = self._first
            while task is not None and not self._stopped:
                self._do(task)
                try:
                    task = self._waiting.popleft()
                except IndexError:
                    task = None
            self._done.put(None)
        except Exception as error:  # told by the thread that waits
            self._done.put(error)
        finally:
            self.stop()

    def _do(self, task: Task) -> None:
        index, file, content = task
        if self._process is None:
            self._process = self._opened()
        asked = {"file": file, "content": base64.b64encode(content).decode("ascii")}
        record = _exchanged(self._process, asked)
        if record is not None:
            self._done.put((index, record, True))
            return
        ended = _ended(self._process)
        self._process = None
        self._done.put((index, untold(file, f"the process that judged it {ended}; check it again", read=True), False))

    def _opened(self) -> subprocess.Popen[str]:
        command = [sys.executable, "-c", "from lagrangian.check.classes.worker import main; main()"]
        process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            encoding="utf-8",
            env={**KEPT, **os.environ, **ALONE, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        )
        self._process = process
        answer = _exchanged(process, json.loads(self._opening))
        if answer is None:
            raise Error(f"a process for judging {_ended(process)} before it began", fix="processes=1", code="E801")
        if "error" in answer:
            raise Error(answer["error"])
        return process

    def stop(self) -> None:
        """End the process, whatever it does."""
        self._stopped = True
        process = self._process
        if process is None:
            return
        process.kill()
        process.wait()
        for stream in (process.stdin, process.stdout):
            if stream is not None:
                with contextlib.suppress(OSError):
                    stream.close()


def _exchanged(process: subprocess.Popen[str], message: Mapping[str, Any]) -> dict[str, Any] | None:
    """The answer to a message; None if the process ended instead."""
    assert process.stdin is not None and process.stdout is not None
    try:
        process.stdin.write(json.dumps(message) + "\n")
        process.stdin.flush()
        line = process.stdout.readline()
    except OSError:
        return None
    return json.loads(line) if line.endswith("\n") else None


def _ended(process: subprocess.Popen[str]) -> str:
    """How a process ended, in words."""
    try:
        code = process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        code = process.wait()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with contextlib.suppress(OSError):
                stream.close()
    return f"was killed (signal {-code})" if code < 0 else f"ended (exit code {code})"
