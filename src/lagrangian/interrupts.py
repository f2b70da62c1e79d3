"""Ctrl-C: one line and exit code 130 at any moment, in imports and in machine code too, without a traceback.

A signal raises `KeyboardInterrupt` in the main thread, so that files that were begun are cleared away. Python raises it
only between its own instructions, and libraries sometimes catch it; a second thread therefore hears the signal too, and
ends the process where it has not ended by itself in time.
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
"""The exit code of an interrupted command, 128 and the number of the signal."""

GRACE = 1.0
"""Seconds that an interrupted command has to clear away what it began."""

_BACK = "\r\x1b[K"
"""To the beginning of the terminal's line, which is emptied: ^C or what shows progress may stand there."""


class Interrupts:
    """What one command knows of interrupts: whether one came, and what is said then."""

    def __init__(self) -> None:
        self.came = False
        self.advice = ""
        self._said = False

    def listen(self) -> None:
        """Hear Ctrl-C from now on; one that is ignored, as in a shell's background, stays ignored."""
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            return
        signal.signal(signal.SIGINT, self._heard)
        sys.unraisablehook = self._unraisable(sys.unraisablehook)
        if os.name == "posix":  # elsewhere only sockets wake up, and they take long to import
            ours, theirs = os.pipe()
            os.set_blocking(theirs, False)
            signal.set_wakeup_fd(theirs, warn_on_full_buffer=False)
            threading.Thread(target=self._watch, args=(ours,), daemon=True, name="interrupts").start()

    def finish(self) -> None:
        """Let the system end the process from now on: nothing can be lost, and Python on its way out would complain."""
        if signal.getsignal(signal.SIGINT) == self._heard:
            signal.signal(signal.SIGINT, signal.SIG_DFL)

    def say(self) -> int:
        """Say once that the command was interrupted; return its exit code."""
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
        """A hook that is silent on an interrupt in a place that cannot raise; the watching thread ends the process."""

        def hook(found: Any) -> None:
            if not (self.came and issubclass(found.exc_type, KeyboardInterrupt)):
                before(found)

        return hook


interrupts = Interrupts()
"""Those of this process."""
