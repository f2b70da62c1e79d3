"""The progress line: on a terminal, it appears after two seconds of work; in a pipe, nothing is written.

The packages below report what they do through the standard `logging` ("lagrangian", level INFO); the line shows the
latest message.
"""

from __future__ import annotations

import contextlib
import logging
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator

AFTER = 2.0
"""The time [s] before the line appears."""

EVERY = 0.1
"""The time [s] between two updates of the line."""

_TURNING = "⠋⠙⠹⠸⠼⠴⠦⠧⠇⠏"
_EMPTY = "\r\x1b[K"


class StatusLine(logging.Handler):
    """A line on standard error with the current task, the time it has taken, and a turning sign; other output hides
    it."""

    def __init__(self) -> None:
        super().__init__(logging.INFO)
        self.words = ""
        self._shown = self._counting = False
        self._over = threading.Event()
        self._screen = threading.RLock()

    def emit(self, record: logging.LogRecord) -> None:
        """Take the current task from a log record; a count is shown rather than the tasks that it consists of."""
        if not self._counting:
            self.words = record.getMessage()

    def line(self, elapsed: float, columns: int) -> str:
        """Return the line after a number of seconds, cut to the width of the terminal."""
        sign = _TURNING[int(elapsed / EVERY) % len(_TURNING)]
        tail = f" … {elapsed:.0f} s"
        words = "".join(c if c.isprintable() else " " for c in self.words)
        return f"{sign} {words[: max(columns - len(tail) - 4, 0)]}{tail}"

    @contextlib.contextmanager
    def showing(self, words: str) -> Iterator[None]:
        """Show the progress line within a ``with`` block, if standard error is a terminal."""
        if sys.stderr is None or not sys.stderr.isatty():
            yield
            return
        self.words, self._counting = words, False
        self._over = threading.Event()
        log = logging.getLogger("lagrangian")
        level = log.level
        log.addHandler(self)
        log.setLevel(logging.INFO)
        turning = threading.Thread(target=self._turn, args=(self._over,), daemon=True, name="progress")
        turning.start()
        try:
            yield
        finally:
            self.hide()
            log.removeHandler(self)
            log.setLevel(level)

    def counted(self, things: str) -> Callable[[int, int], None]:
        """Return a callback ``progress(done, all)`` that shows how much is done."""

        def listen(done: int, count: int) -> None:
            self._counting = True
            self.words = f"{things}: {done} of {count}"

        return listen

    @contextlib.contextmanager
    def aside(self) -> Iterator[None]:
        """Keep the line away within a ``with`` block, for a question to the user."""
        with self._screen:
            if self._shown:
                self._shown = False
                sys.stderr.write(_EMPTY)
            yield

    def hide(self) -> None:
        """Remove the line for good, because the result is about to be written."""
        with self._screen:
            self._over.set()
            if self._shown:
                self._shown = False
                sys.stderr.write(_EMPTY)
                sys.stderr.flush()

    def _turn(self, over: threading.Event) -> None:
        begun = time.monotonic()
        wait = AFTER
        while not over.wait(wait):
            wait = EVERY
            with self._screen:
                if not over.is_set():
                    sys.stderr.write(f"{_EMPTY}{self.line(time.monotonic() - begun, _columns())}")
                    sys.stderr.flush()
                    self._shown = True


def _columns() -> int:
    """The width in columns of the terminal on standard error."""
    try:
        return os.get_terminal_size(sys.stderr.fileno()).columns or 80
    except (OSError, ValueError):
        return 80


status = StatusLine()
"""The one progress line of this process."""
