"""Words and phrases of pictures: names at a readable length, elements by kind and name, lists."""

from __future__ import annotations

import re

from lagrangian.model import Element

MOST = 14
"""At most so many bodies, ties and coordinates are named; the rest is counted."""

LONGEST_NAME = 48


def short(name: str, most: int = LONGEST_NAME) -> str:
    """A name in one line, cut where it is too long."""
    text = " ".join(name.split())
    return text if len(text) <= most else text[: most - 1] + "…"


def capital(text: str) -> str:
    """A sentence with a capital letter at its start, unless it starts with a symbol such as m1."""
    first = re.split(r"[ ,;]", text, maxsplit=1)[0]
    return text[:1].upper() + text[1:] if first.isalpha() or "-" in first else text


def said(element: Element) -> str:
    """An element by its kind and name: ``spring k``, ``the damper`` where these are the same."""
    kind, name = element.kind.replace("_", " "), short(element.name)
    if name.endswith(f" {kind}"):
        return f"the {name}"
    if name.startswith(kind):
        return name if name != kind else f"the {kind}"
    return f"{kind} {name}" if name else f"a {kind}"


def called(body: Element) -> str:
    """A body as it is mentioned: ``the spool``, ``particle m1``."""
    name = short(body.name)
    return f"the {name}" if len(name) > 2 and all(w.isalpha() for w in name.split()) else body.title


def cut(words: list[str], rest: str) -> list[str]:
    """At most `MOST` phrases; of further ones their number is told."""
    return words if len(words) <= MOST else [*words[: MOST - 1], f"and {len(words) - MOST + 1} {rest}"]
