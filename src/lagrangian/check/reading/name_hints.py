"""Suggestions for names that a system does not have."""

from __future__ import annotations

import re

from lagrangian.errors import did_you_mean
from lagrangian.read.letters import spelled
from lagrangian.read.scope import Scope


def hint_for(base: str, scope: Scope) -> str | None:
    """A suggestion for an unknown name: a product without *, a longer spelling, or a similar name."""
    if len(parts := factors_of(base, scope)) > 1:
        return f"Write {'*'.join(parts)} for a product."
    head, digits = re.fullmatch(r"(.*?)_?(\d*)", spelled(base), re.DOTALL).groups()  # type: ignore[union-attr]
    longer = [n for n in scope if spelled(n).startswith(head) and re.fullmatch(rf".*?{digits}", n)]
    if len(head) >= 2 and len(longer) == 1:
        return f"Did you mean '{longer[0]}'?"
    return scope.hint(base) or did_you_mean(spelled(base).swapcase(), scope)


def factors_of(base: str, scope: Scope) -> list[str]:
    """The known names of which a word consists, the longest first; empty if it does not."""
    parts: list[str] = []
    at = 0
    while at < len(base):
        part = next((base[at:end] for end in range(len(base), at, -1) if base[at:end] in scope), None)
        if part is None:
            return []
        parts.append(part)
        at += len(part)
    return parts
