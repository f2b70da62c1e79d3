"""All output of the command goes through this module, which escapes control characters.

The texts of a model may come from anywhere. Characters that would control the terminal are printed as escapes.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

from lagrangian.cli.progress import status

NARROWEST, WIDEST, USUAL = 40, 400, 80
"""The smallest and the largest width of text in columns, and the default if there is no terminal."""

_OBEYED = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f"  # control characters except tab and line feed
    "\u2028\u2029\ufeff"  # other line separators, and the byte order mark
    "\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"  # characters that change the direction of writing
    "\ud800-\udfff]"  # bytes of a file name that are not valid characters
)


def put(text: str | Sequence[str], output: Path | None = None) -> None:
    """Write text, or lines, to a file (completely or not at all) or to standard output; on a terminal titles are
    bold."""
    if output is None:
        _through(sys.stdout, text)
    else:
        from lagrangian.write.files import write_file

        write_file(output, _whole(text))


def say(words: str) -> None:
    """Write a message, one line, to standard error."""
    if sys.stderr is not None:  # the shell closed it, as in `lagrangian … 2>&-`
        _through(sys.stderr, words)


def fail(words: str) -> None:
    """Write an error message, which always begins with ``error:``."""
    say(f"error: {words}")


def ask(question: str) -> str | None:
    """Ask on the terminal and return the answer in small letters; None without a terminal to ask on."""
    if not (sys.stdin is not None and sys.stdin.isatty() and sys.stderr is not None and sys.stderr.isatty()):
        return None
    status.hide()
    sys.stderr.write(visible(question))
    sys.stderr.flush()
    return sys.stdin.readline().strip().lower()


class StandardOutput:
    """Standard output as a file object for writers that write in pieces; every piece is escaped."""

    def write(self, text: str, /) -> int:
        """Write a piece of text; return its length."""
        status.hide()
        sys.stdout.write(visible(text))
        return len(text)


def _through(stream: TextIO, text: str | Sequence[str]) -> None:
    if not isinstance(text, str) and styled(stream):
        from lagrangian.write import Title

        text = [f"\x1b[1m{visible(x)}\x1b[22m" if isinstance(x, Title) else visible(x) for x in text]
        text = "\n".join(text) + "\n"
    else:
        text = visible(_whole(text))
    status.hide()
    stream.write(text)
    stream.flush()


def _whole(text: str | Sequence[str]) -> str:
    text = text if isinstance(text, str) else "\n".join(text)
    return text if text.endswith("\n") else text + "\n"


def visible(text: str) -> str:
    """Return the text with control characters, and those that change the direction of writing, escaped as in JSON."""
    return _OBEYED.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


# -- the terminal ---------------------------------------------------------------------------------------------------


def width(given: int | None = None, output: Path | None = None) -> int:
    """The width of the text in columns: the one given, else that of the terminal or of COLUMNS, else 80."""
    if given is not None:
        return given
    found = USUAL
    if output is None and (sys.stdout.isatty() or os.environ.get("COLUMNS")):
        found = shutil.get_terminal_size((USUAL, 24)).columns
    return min(max(found, NARROWEST), WIDEST)


def styled(stream: TextIO) -> bool:
    """Whether bold text is written to a stream: it is a terminal that can show it, and NO_COLOR is not set."""
    dumb = os.environ.get("TERM") == "dumb" or (os.name == "nt" and "WT_SESSION" not in os.environ)
    return stream.isatty() and not dumb and not os.environ.get("NO_COLOR")


def prepare() -> None:
    """Make both streams use UTF-8, whatever the locale."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure") and (stream.encoding or "").lower().replace("-", "") != "utf8":
            stream.reconfigure(encoding="utf-8", errors="replace")  # type: ignore[union-attr]


def drop() -> None:
    """Discard what is left in the buffer, so that Python does not try to write it at exit and complain."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
