"""Counts the calls of Python functions within a routine, and ends it when too many were made.

Counting makes a routine two to three times slower.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from inspect import CO_GENERATOR
from pathlib import Path
from types import FrameType
from typing import Any, TypeVar

import sympy as sp
from sympy.core.cache import clear_cache

T = TypeVar("T")
Hook = Callable[[FrameType, Any, Any], object]

_SYMPY = str(Path(sp.__file__).parent)
_running = threading.local()


class SpentError(BaseException):
    """All calls are spent. Not an `Exception`, so that no routine on the way catches it."""


class CallCount:
    """The calls that are left to a routine; one that runs inside another has at most what the other has left."""

    def __init__(self, calls: int, *, anywhere: bool) -> None:
        self.outer: CallCount | None = getattr(_running, "count", None)
        self.former: Hook | None = None if self.outer is None else self.outer.former
        self.limit = self.left = calls if self.outer is None else min(calls, self.outer.left)
        self.anywhere = anywhere

    def called(self, frame: FrameType, event: str, argument: object) -> None:
        """Count a call; raise `SpentError` where an exception does no harm if none are left."""
        if event == "call":
            self.left -= 1
            # an exception raised while a generator is closed is lost, and Python would stop counting; our own objects
            # are changed in several steps, which must not be interrupted
            if (
                self.left < 0
                and not frame.f_code.co_flags & CO_GENERATOR
                and (self.anywhere or frame.f_code.co_filename.startswith(_SYMPY))
            ):
                raise SpentError

    def _told(self, frame: FrameType, event: str, argument: object) -> None:
        """Tell a profiler of what happens, and count."""
        if self.former is not None:
            self.former(frame, event, argument)
        self.called(frame, event, argument)

    def run(self, routine: Callable[[], T]) -> T:
        """Return the result of a routine; raise `SpentError` if it makes too many calls."""
        before = sys.getprofile()
        if self.outer is None and callable(before):
            self.former = before  # whoever profiles goes on seeing every call
        _running.count = self
        sys.setprofile(self.called if self.former is None else self._told)  # most events are of no call: each costs
        try:
            return routine()
        except SpentError:
            clear_cache()  # unfinished results in SymPy's cache must not be used later
            raise
        finally:
            _running.count = self.outer
            if self.outer is not None:
                self.outer.left -= self.limit - self.left
            if before is None or callable(before):
                sys.setprofile(before)
            else:  # the standard library's profiler is not a function, and starts itself again
                sys.setprofile(None)
                before.enable()


def count_operations(operations: int) -> None:
    """Add operations on terms, each as a call, to the count of the question under way, if it is counted."""
    running: CallCount | None = getattr(_running, "count", None)
    if running is not None:
        running.left -= operations
        if running.left < 0:
            raise SpentError


def uncounted(routine: Callable[[], T]) -> T:
    """Return the result of a routine that is surely short, whose calls do not count."""
    running: CallCount | None = getattr(_running, "count", None)
    if running is None:
        return routine()
    left, running.left = running.left, sys.maxsize
    try:
        return routine()
    finally:
        running.left = left


def is_counted() -> bool:
    """Whether calls are being counted."""
    return getattr(_running, "count", None) is not None
