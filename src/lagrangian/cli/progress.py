"""What shows that long work goes on: a line on the terminal after two seconds, nothing in a pipe.

The rooms below say what they do through the standard `logging` ("lagrangian", level INFO); the last that was said is
shown.
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
"""Seconds of silence before the line appears."""

EVERY = 0.1
"""Seconds from one picture of the line to the next."""

_TURNING = "⠋⠙⠹⠸⠼⠴⠦⠧⠇⠏"
_EMPTY = "\r\x1b[K"


class StatusLine(logging.Handler):
    """A line on standard error that says what is being done, for how long, and turns; it goes as others write."""

    def __init__(self) -> None:
        super().__init__(logging.INFO)
        self.words = ""
        self._shown = self._counting = False
        self._over = threading.Event()
        self._screen = threading.RLock()

    def emit(self, record: logging.LogRecord) -> None:
        """Take what is being done from the log; a count says more than the parts it is made of."""
        if not self._counting:
            self.words = record.getMessage()

    def line(self, elapsed: float, columns: int) -> str:
        """The line after so many seconds, no longer than the terminal is wide."""
        sign = _TURNING[int(elapsed / EVERY) % len(_TURNING)]
        tail = f" … {elapsed:.0f} s"
        words = "".join(c if c.isprintable() else " " for c in self.words)
        return f"{sign} {words[: max(columns - len(tail) - 4, 0)]}{tail}"

    @contextlib.contextmanager
    def showing(self, words: str) -> Iterator[None]:
        """Show what is being done within the block, where standard error is a terminal."""
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
        """A listener that shows how many of all things are done."""

        def listen(done: int, count: int) -> None:
            self._counting = True
            self.words = f"{things}: {done} of {count}"

        return listen

    def hide(self) -> None:
        """Take the line away for good: what was worked for is written now."""
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
    """Columns of the terminal that standard error is."""
    try:
        return os.get_terminal_size(sys.stderr.fileno()).columns or 80
    except (OSError, ValueError):
        return 80


status = StatusLine()
"""That of this process."""
