"""Calls a generalized force as the answer does: Ξ_r, or Q_psi, and not Ξ₁."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Mistake, Verdict
from lagrangian.page.formula import Left, Name, Verbatim, text

_NAMED = re.compile(r"[^\W\d_]_?[^\W\d_]\w{0,10}")
"""A name with letters behind its own: no number says of which coordinate it is."""


def with_forces_named(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict, with every Ξ of which mistakes speak called as the answer calls it."""
    own = {x.name: x.text.partition("=")[0].strip() for x in lines if x.kind == "Xi" and x.name is not None}
    called = {
        str(k): Verbatim(own[c.name])
        for k, c in enumerate(truth.model.coordinates, 1)
        if _NAMED.fullmatch(own.get(c.name, ""))
    }
    if not called:
        return verdict
    told, others = (tuple(_said(m, called) for m in x) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, mistakes=told, alternatives=others)


def _said(mistake: Mistake, called: Mapping[str, Verbatim]) -> Mistake:
    """A mistake with these names."""
    return replace(mistake, what=text(*(_name(x, called) for x in mistake.what.parts)))


def _name(part: str | Verbatim | Left, called: Mapping[str, Verbatim]) -> str | Verbatim | Left:
    """A part of a sentence, or the name for it."""
    is_force = isinstance(part, Name) and part.base == "Xi" and part.dots == 0
    return called.get(part.index, part) if is_force and isinstance(part, Name) else part
