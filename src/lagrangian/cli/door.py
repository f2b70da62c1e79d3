"""The one door to the terminal: whatever a command prints goes through here, cleaned.

A model's texts come from anywhere; what a terminal would obey rather than show is written out instead.
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
"""Columns of text: the fewest and the most, and those where no terminal says how many there are."""

_OBEYED = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f"  # control characters but the tab and the end of a line
    "\u2028\u2029\ufeff"  # other ends of lines, a byte order mark
    "\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"  # what turns the direction of writing
    "\ud800-\udfff]"  # bytes of a file's name that are no character
)


def put(text: str | Sequence[str], output: Path | None = None) -> None:
    """Write text, or lines, to a file (whole or not at all) or to standard output; a terminal shows titles bold."""
    if output is None:
        _through(sys.stdout, text)
    else:
        from lagrangian.write.files import write_file

        write_file(output, _whole(text))


def say(words: str) -> None:
    """Talk: a line on standard error."""
    if sys.stderr is not None:  # closed by the shell, as in `lagrangian … 2>&-`
        _through(sys.stderr, words)


def fail(words: str) -> None:
    """Say what is wrong, with the one word that every such message begins with."""
    say(f"error: {words}")


class StandardOutput:
    """Standard output for what writes into a file piece by piece; every piece is cleaned."""

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
    """The text with control characters and those that turn the direction of writing written out, as JSON does."""
    return _OBEYED.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


# -- the terminal that there is ---------------------------------------------------------------------------------------


def width(given: int | None = None, output: Path | None = None) -> int:
    """Columns of a text: those given, else the terminal's or what COLUMNS says, else 80."""
    if given is not None:
        return given
    found = USUAL
    if output is None and (sys.stdout.isatty() or os.environ.get("COLUMNS")):
        found = shutil.get_terminal_size((USUAL, 24)).columns
    return min(max(found, NARROWEST), WIDEST)


def styled(stream: TextIO) -> bool:
    """Whether a stream shows bold letters: a terminal that can, unless NO_COLOR is set."""
    dumb = os.environ.get("TERM") == "dumb" or (os.name == "nt" and "WT_SESSION" not in os.environ)
    return stream.isatty() and not dumb and not os.environ.get("NO_COLOR")


def prepare() -> None:
    """Have both streams speak UTF-8, whatever the locale."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure") and (stream.encoding or "").lower().replace("-", "") != "utf8":
            stream.reconfigure(encoding="utf-8", errors="replace")  # type: ignore[union-attr]


def drop() -> None:
    """Send what is left in the buffer nowhere, so that Python does not try again, and complain, on its way out."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
