"""Work in calls of Python functions: the same on a slow machine, a busy one and a fast one."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType

import pytest


@dataclass
class Effort:
    """``calls`` of Python functions so far."""

    calls: int = 0


@contextmanager
def at_most(calls: int) -> Iterator[Effort]:
    """Fail as soon as more than so many Python functions were called within.

    Garbage is left until the end: what is called when it is collected belongs to whoever made it.
    """
    effort = Effort()

    def called(frame: FrameType, event: str, argument: object) -> None:
        effort.calls += 1
        if effort.calls > calls:
            sys.settrace(None)
            pytest.fail(f"more than {calls} calls, the last of {frame.f_code.co_name}")

    before, collects = sys.gettrace(), gc.isenabled()
    gc.disable()
    sys.settrace(called)
    try:
        yield effort
    finally:
        sys.settrace(before)
        if collects:
            gc.enable()
