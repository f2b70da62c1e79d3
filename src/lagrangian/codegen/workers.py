"""Distributes ranges of states over the cores of the machine.

Kernels release the interpreter's lock, so threads are sufficient. The result of a state does not depend on the range in
which it is computed.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

GRAIN = 200_000  # operations that are worth a thread: some tens of microseconds
PARTS = 4  # ranges per thread, so that an interrupted one does not delay all

_pool: ThreadPoolExecutor | None = None
_lock = threading.Lock()


def cores() -> int:
    """The number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def alone(count: int, cost: int, threads: int | None) -> bool:
    """Whether this many states of this cost are computed by one thread only."""
    return threads == 1 or count * max(1, cost) // GRAIN < 2


def over(count: int, step: int, cost: int, threads: int | None, task: Callable[[int, int], int]) -> int:
    """Call ``task(start, stop)`` over ranges that cover 0 … count − 1; return the smallest result other than −1, else
    −1.

    Ranges begin at multiples of ``step``. ``cost`` is the number of operations per state; ``threads`` None means all
    cores.
    """
    if alone(count, cost, threads):
        return task(0, count)
    wanted = min(threads or cores(), count * max(1, cost) // GRAIN)
    blocks = -(-count // step)
    size = max(1, -(-blocks // (wanted * PARTS))) * step
    starts = range(0, count, size)
    queue = iter(starts)
    answers: list[int] = []

    def work() -> None:
        while True:
            with turn:
                start = next(queue, None)
            if start is None:
                return
            answer = task(start, min(count, start + size))
            if answer != -1:
                answers.append(answer)

    turn = threading.Lock()
    others = [_executor().submit(work) for _ in range(wanted - 1)]
    work()
    for other in others:
        other.result()
    return min(answers, default=-1)


def _executor() -> ThreadPoolExecutor:
    global _pool
    with _lock:
        if _pool is None:
            _pool = ThreadPoolExecutor(max(1, cores() - 1), thread_name_prefix="lagrangian")
        return _pool


def _forget() -> None:
    """After a fork, the child has the record of the pool but none of its threads."""
    global _pool, _lock
    _pool, _lock = None, threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)
