"""Calls a generalized force as the answer does, Q_psi, or as its line is called, the Ξ of ψ, and not Ξ₁."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Mistake, Verdict
from lagrangian.page.formula import Left, Name, Verbatim, text

_NAMED = re.compile(r"[^\W\d_]_?[^\W\d_]\w{0,10}")
"""A name with letters behind its own: no number says of which coordinate it is."""

_NUMBERED = re.compile(r"\\?(?:Xi|Ξ)_?\{?\d{1,3}\}?")
"""The name of a force by a number alone."""
_WORK = re.compile(r"(?:[δd∂]|delta)_?W")
"""A virtual work: it has forces on all coordinates."""


def with_forces_named(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict, with every Ξ of which mistakes speak called as the answer calls it."""
    own = {x.name: x.text.partition("=")[0].strip() for x in lines if x.kind == "Xi" and x.name is not None}
    called: dict[str, tuple[str | Verbatim | Left, ...]] = {}
    for k, c in enumerate(truth.model.coordinates, 1):
        name = own.get(c.name, "")
        of_one = _NAMED.fullmatch(name) and not _WORK.match(name) and not _NUMBERED.fullmatch(name)
        called[str(k)] = (Verbatim(name),) if of_one else ("the Ξ of ", c.symbol)
    told, others = (tuple(_said(m, called) for m in x) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, mistakes=told, alternatives=others)


def _said(mistake: Mistake, called: Mapping[str, Sequence[str | Verbatim | Left]]) -> Mistake:
    """A mistake with these names."""
    return replace(mistake, what=text(*(x for part in mistake.what.parts for x in _name(part, called))))


def _name(
    part: str | Verbatim | Left, called: Mapping[str, Sequence[str | Verbatim | Left]]
) -> Sequence[str | Verbatim | Left]:
    """A part of a sentence, or the name for it."""
    is_force = isinstance(part, Name) and part.base == "Xi" and part.dots == 0
    return called.get(part.index, (part,)) if is_force and isinstance(part, Name) else (part,)
