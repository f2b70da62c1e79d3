"""The ways in which the terms of a right line may be grouped: as they are displayed, or by the elements they come from.

(k₁ + k₂) x₁ − k₂ x₂ is k₁ x₁ + k₂ (x₁ − x₂) by its springs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive.algebra import Form
from lagrangian.derive.algebra.form import Ring

LONGEST = 60
"""What an element adds is not used with more operations."""


MOST_KEPT = 200
"""The number of right lines of a system of which the displayed terms are kept."""


def groupings(truth: Reference, right: Form, index: int | None) -> Iterator[list[sp.Expr]]:
    """The terms of a right line, whose sum is ``right``, in every grouping; ``index`` is the coordinate of a row."""
    yield list(_displayed(right))
    for whole, terms in _of_elements(truth, index):
        if (whole - right).is_zero:
            yield list(_as_products(truth, terms))
            return


def _displayed(right: Form) -> tuple[sp.Expr, ...]:
    """The terms as they are displayed; they are sought once, as many lines are compared with the same right one."""
    kept = _of_algebra(right.algebra)
    known = right.den, frozenset((h, frozenset(p.items())) for h, p in right.parts.items())
    if known not in kept:
        if len(kept) >= MOST_KEPT:
            kept.clear()
        kept[known] = tuple(t.expr for t in right.terms())
    return kept[known]


@lru_cache(maxsize=32)
def _of_algebra(algebra: Ring) -> dict[object, tuple[sp.Expr, ...]]:
    return {}


@lru_cache(maxsize=64)
def _of_elements(truth: Reference, index: int | None) -> tuple[tuple[Form, tuple[sp.Expr, ...]], ...]:
    """What the elements add, in every sum of several, with that sum."""
    sums = [tuple(terms) for terms in _by_elements(truth, index) if len(terms) > 1]
    forms = [truth.form(cast("sp.Expr", sp.Add(*terms))) for terms in sums]
    return tuple((form, terms) for form, terms in zip(forms, sums, strict=True) if form is not None)


@lru_cache(maxsize=64)
def _as_products(truth: Reference, terms: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
    return tuple(x for t in terms for x in _products(truth, t))


def _by_elements(truth: Reference, index: int | None) -> Iterator[Sequence[sp.Expr]]:
    """What the elements add to an energy, or to the equation or the force of a coordinate, if all of it is short."""
    if index is None:
        model = truth.model
        for of in ("potential", "kinetic", "dissipation"):
            found = [truth.expand(x) for e in model.elements if (x := getattr(e, of)(model)) is not None and x != 0]
            if sum(bounded.size(x) for x in found) <= LONGEST * len(found):
                yield found
        return
    name = truth.model.coordinates[index].name
    origins = truth.derivation.shares.where(truth.rows[index])
    own = [(o.step, truth.put(o.share)) for o in origins if o.coordinate == name]
    yield [-x if step == 6 else x for step, x in own]
    yield [x for step, x in own if step == 6]
    yield list(_slopes(truth, index))


def _slopes(truth: Reference, index: int) -> Iterator[sp.Expr]:
    """What the elements add to ∂ℒ/∂ξ, if their energies are short."""
    model = truth.model
    q = model.coordinates[index].symbol
    for e in model.elements:
        for sign, energy in ((1, e.kinetic(model)), (-1, e.potential(model))):
            if energy is not None and bounded.size(energy) <= LONGEST and energy.has(q):
                yield sign * bounded.diff(truth.expand(energy), q)


def _products(truth: Reference, term: sp.Expr) -> Sequence[sp.Expr]:
    """What an element adds as a product if it is one: k₂ a (a sin θ − y) cos θ, or its terms."""
    form = truth.form(term)
    short = min((term, form.expr() if form is not None else term), key=bounded.operations)
    product = bounded.factored(short) if isinstance(short, sp.Add) else None
    if product is not None and bounded.operations(product) < bounded.operations(short):
        return [cast("sp.Expr", product)]
    return cast("Sequence[sp.Expr]", sp.Add.make_args(short))
