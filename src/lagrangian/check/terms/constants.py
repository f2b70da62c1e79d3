"""Leaves out of differences of an energy what is constant, or moves as prescribed alone: it changes no equation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import TermDifference


def without_constants(truth: Reference, differing: Sequence[TermDifference]) -> Iterator[TermDifference]:
    """The differences of an energy but for constants, which are nobody's mistake: −m g l cos ψ is m g (h − l cos ψ)."""
    moving = [x for c in truth.model.coordinates for x in (c.symbol, c.rate)]
    for d in differing:
        right, written = (bounded.expand(x) for x in (sp.S.Zero if d.kind == "extra" else d.term, d.written))
        if not bounded.expand(right - written).has(*moving):
            continue
        if d.kind == "coefficient" and not written.has(
            *moving
        ):  # m g l of m g l (1 − cos θ), for a term that is missing
            yield replace(d, kind="missing", written=sp.S.Zero)
            continue
        constant = sp.Add(*[x for x in sp.Add.make_args(right) if not x.has(*moving)])
        kept = written != 0 and not all(x.has(*moving) for x in sp.Add.make_args(written))
        if constant != 0 and (term := _without_addend(d, moving)) is not None:
            yield _with_term(d, term)
            continue
        if constant in (0, right) or kept or any(isinstance(x.base, sp.Add) for x in d.term.atoms(sp.Pow)):
            yield d  # ½ k (s − s₀)² stays as it is
            continue
        yield _with_term(d, cast("sp.Expr", sp.factor_terms(right - constant)))


def _with_term(d: TermDifference, term: sp.Expr) -> TermDifference:
    """The difference with another right term: of the kind "sign" if what was written is its negative."""
    return replace(d, term=term, kind="sign" if bounded.expand(term + d.written) == 0 else d.kind)


def _without_addend(d: TermDifference, moving: Sequence[sp.Basic]) -> sp.Expr | None:
    """A product of letters with a sum, without what does not move in this sum and what was written has neither:
    ½ m ((ẋ + e Ω cos Ωt)² + e² Ω² sin² Ωt)."""
    factors = sp.Mul.make_args(d.term)
    sums = [x for x in factors if isinstance(x, sp.Add)]
    others = [x for x in factors if not isinstance(x, sp.Add)]
    if len(sums) != 1 or any(x.has(*moving) for x in others):
        return None
    still = [x for x in sums[0].args if not x.has(*moving)]
    if not still or len(still) == len(sums[0].args) or any(d.written.has(x) for x in still):
        return None
    return cast("sp.Expr", sp.Mul(*others, sp.Add(*[x for x in sums[0].args if x not in still])))
