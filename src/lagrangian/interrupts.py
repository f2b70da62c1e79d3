"""Ctrl-C ends the command at any moment, also during imports and in machine code: one line, exit code 130, no
traceback.

A signal raises `KeyboardInterrupt` in the main thread, so that unfinished files are removed. But Python raises it only
between its own instructions, and libraries sometimes catch it. A second thread therefore receives the signal as well,
and ends the process if it has not ended by itself in time.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from types import FrameType
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from collections.abc import Callable

    Hook = Callable[[Any], object]

CODE = 130
"""The exit code of an interrupted command: 128 plus the number of the signal."""

GRACE = 1.0
"""The time [s] that an interrupted command has to remove unfinished files."""

_BACK = "\r\x1b[K"
"""Moves to the beginning of the terminal's line and clears it: it may show ^C or the progress line."""


class Interrupts:
    """The state of one command: whether it was interrupted, and what to print then."""

    def __init__(self) -> None:
        self.came = False
        self.advice = ""
        self._said = False

    def listen(self) -> None:
        """Listen for Ctrl-C from now on; a signal that is ignored, as in a background job of a shell, stays ignored."""
        if signal.getsignal(signal.SIGINT) not in (signal.default_int_handler, signal.SIG_DFL):
            return
        signal.signal(signal.SIGINT, self._heard)
        sys.unraisablehook = self._unraisable(sys.unraisablehook)
        if os.name == "posix":  # on other systems only sockets can wake the thread, and they take long to import
            ours, theirs = os.pipe()
            os.set_blocking(theirs, False)
            signal.set_wakeup_fd(theirs, warn_on_full_buffer=False)
            threading.Thread(target=self._watch, args=(ours,), daemon=True, name="interrupts").start()

    def hand_over(self) -> None:
        """Leave the signal to somebody else from now on: a server ends by it in good order."""
        if signal.getsignal(signal.SIGINT) == self._heard:
            signal.signal(signal.SIGINT, signal.default_int_handler)
            if os.name == "posix":
                signal.set_wakeup_fd(-1)

    def finish(self) -> None:
        """Leave the signal to the operating system from now on: nothing can be lost any more, and Python would complain
        at exit."""
        if signal.getsignal(signal.SIGINT) == self._heard:
            signal.signal(signal.SIGINT, signal.SIG_DFL)

    def say(self) -> int:
        """Print once that the command was interrupted; return its exit code."""
        if not self._said and sys.stderr is not None:
            self._said = True
            start = _BACK if sys.stderr.isatty() else ""
            line = f"{start}interrupted{self.advice and '; '}{self.advice}\n"
            os.write(2, line.encode("utf-8", "backslashreplace"))
        return CODE

    def _heard(self, number: int, frame: FrameType | None) -> None:
        if self.came:
            self._leave()
        self.came = True
        raise KeyboardInterrupt

    def _watch(self, wakeups: int) -> None:
        while os.read(wakeups, 1) != bytes([signal.SIGINT]):
            pass
        threading.Event().wait(GRACE)
        self._leave()

    def _leave(self) -> NoReturn:
        os._exit(self.say())

    def _unraisable(self, before: Hook) -> Hook:
        """Silence an interrupt that is raised where no exception can propagate; the watching thread ends the
        process."""

        def hook(found: Any) -> None:
            if not (self.came and issubclass(found.exc_type, KeyboardInterrupt)):
                before(found)

        return hook


interrupts = Interrupts()
"""The one object of this process."""
