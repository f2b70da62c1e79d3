"""The terms of a right line, as they are displayed and one by one, with what each comes from and its values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian.check.align import LARGEST
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.changes.ring import Sum
from lagrangian.check.explain.changes.sites import MOST_TERMS
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import Element
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class RightTerm:
    """A term of a right line, for an equation of its left-hand side; ``element`` if it comes from one alone.

    ``cost`` is how unlikely it is that just this was treated otherwise than the rest.
    """

    expr: sp.Expr
    step: int
    cost: float
    element: Element | None = None


@dataclass(frozen=True, eq=False)
class RightTerms:
    """The terms of a right line with their values, (terms, S)."""

    terms: tuple[RightTerm, ...]
    values: Array


def right_terms(pool: Pool, kind: str, i: int | None) -> RightTerms:
    """The terms of equation ``i``, of T*, V, L or Ξ_i, each once, the likeliest first."""
    return pool.kept(("right terms", kind, i), lambda: _different(pool, list(_listed(pool, kind, i))))


def _different(pool: Pool, listed: Sequence[RightTerm]) -> RightTerms:
    """Those whose values can be computed and differ from those of all before them."""
    ordered = sorted(listed, key=lambda t: t.cost)
    values = CompiledExpressions([pool.truth.put(t.expr) for t in ordered]).at(pool.truth.states)
    kept: dict[tuple[float, ...], int] = {}
    for k, v in enumerate(values):
        if np.isfinite(v).all() and 1e-12 < np.abs(v).max() < LARGEST:
            kept.setdefault(tuple(np.round(v[:: max(1, len(v) // 8)], 9)), k)
    chosen = list(kept.values())
    return RightTerms(tuple(ordered[k] for k in chosen), values[chosen])


def _listed(pool: Pool, kind: str, i: int | None) -> Iterator[RightTerm]:
    if kind == "equation":
        assert i is not None
        yield from _of_equation(pool, i)
        return
    sites = pool.sites
    sums: list[tuple[Element, int, Sum]] = []
    if kind in ("T", "L"):
        sums += [(e, 2, x) for e, x in (*sites.kinetic.items(), *sites.others.items())]
    if kind in ("V", "L"):
        sums += [(g, 3, x) for g, x in sites.weights.values()]
        sums += [(e, 3, x) for e, x in sites.energies.items()]
    if kind == "Xi" and i is not None:
        sums += [(e, 6, x[i]) for e, x in sites.shares.items() if i in x]
    shown = {"T": pool.truth.derivation.T, "V": pool.truth.derivation.V}
    for term in sp.Add.make_args(shown[kind]) if kind in shown else ():
        yield RightTerm(sites.of.expand(term), 2 if kind == "T" else 3, 0.1)
    negative = -1 if kind == "L" else 1
    for element, step, x in sums:
        number = negative if step == 3 else 1
        for value in (x, *({m: c} for m, c in x.items() if 1 < len(x) <= MOST_TERMS)):
            yield RightTerm(cast("sp.Expr", number * sites.ring.expr(value)), step, 0.0, element)


def _of_equation(pool: Pool, i: int) -> Iterator[RightTerm]:
    """What it is displayed as, its monomials, what each element adds, and the parts of T*, V and Ξ."""
    truth, sites = pool.truth, pool.sites
    titles: dict[str, Element] = {e.title: e for e in truth.model.elements}
    for term in truth.derivation.terms[i]:
        element = titles.get(term.elements[0]) if len(term.elements) == 1 else None
        expr = cast("sp.Expr", sites.of.expand(term.expr) * (-1 if term.kind == "input" else 1))
        yield RightTerm(expr, 6 if element is not None and element.ledger == "Ξ" else 5, 0.0, element)
    row = sites.rows[i]
    for m, c in row.items() if len(row) <= MOST_TERMS else ():
        element = sites.element_of(i, m)
        yield RightTerm(sites.ring.expr({m: c}), sites.step_of(element), 0.3, element)
    ledgers: dict[Any, list[sp.Expr]] = {}
    for element, rows in sites.element_rows.items():
        if (own := rows.get(i)) and len(own) <= MOST_TERMS:
            whole = sites.ring.expr(own)
            ledgers.setdefault(element.ledger, []).append(whole)
            yield RightTerm(whole, sites.step_of(element), 0.1, element)
    for ledger, parts in ledgers.items():
        if len(ledgers) > 1:
            yield RightTerm(cast("sp.Expr", sp.Add(*parts)), 6 if ledger == "Ξ" else 5, 0.2)
