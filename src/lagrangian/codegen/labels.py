"""Names in generated source: identifiers are our own, and names given by users appear only in comments.

A coordinate may be called ``x``, ``int`` or ``*/ system("…")``; in a comment it can neither collide nor end the
comment.
"""

from __future__ import annotations

import re

WORD = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}", re.ASCII)
QUIET = re.compile(r"[^A-Za-z0-9_'.,:;+=()\[\]^ -]", re.ASCII)


def comment(text: str) -> str:
    """``text`` in characters that have no meaning in comments of any language; letters beyond ASCII become
    ``U+03B8``."""
    quiet = QUIET.sub(lambda match: f"U+{ord(match[0]):04X}" if ord(match[0]) > 126 else "_", text)
    return quiet if len(quiet) <= 60 else quiet[:57] + "..."


def identifier(prefix: str, name: str, index: int) -> str:
    """``prefix`` with ``name`` if this is a plain word, otherwise with ``index``; distinct names give distinct
    results."""
    return f"{prefix}{name}" if WORD.fullmatch(name) else f"{prefix}{index}"


def word(text: str) -> str:
    """``text`` as part of an identifier: everything except letters and digits becomes an underscore."""
    return re.sub(r"[^A-Za-z0-9]+", "_", text)[:40].strip("_") or "program"


def unit(text: str) -> str:
    """A unit in a comment that ends with its line, where a stroke has no meaning."""
    return "/".join(comment(part) for part in text.split("/"))


def quoted(text: str) -> str:
    """``text`` as in `comment`, between single quotes in which a quote is written twice."""
    return "'" + comment(text).replace("'", "''") + "'"
