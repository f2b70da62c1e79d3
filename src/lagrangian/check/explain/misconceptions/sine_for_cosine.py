"""Sine and cosine are exchanged in a height, a deflection or a force."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, partner, put
from lagrangian.model import Element, Gravity, Spring
from lagrangian.page.formula import Name, text

STEP = 3
WHY = text(
    "Look where the angle is measured from: the component along that line has the cosine, the one across it the sine. "
    "Try a special position, such as an angle of zero."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Exchange sin and cos, with both signs, in every weight, every spring, all of V and every force.

    Components of velocities are left to the local changes: in v², their sines and cosines are those of other angles.
    """
    pieces = [(gravity, V, f"the weight of {body.title}", body.title) for gravity, body, V in s.weights()]
    pieces += [(spring, V, f"the energy of {spring.title}", None) for spring, _, V in s.springs()]
    for element, V, words, body in pieces:
        what = text(f"Sine and cosine are exchanged in {words}.")
        for other in _swapped(V):
            yield Variant(what=what, V=other - V, element=element, body=body)
    turned = [element for element, V, *_ in pieces if V.has(sp.sin, sp.cos)]
    weights = all(isinstance(x, Gravity) for x in turned)
    where = "the weights" if weights else "the energies of the springs" if _are_springs(turned) else Name("V")
    for other in _swapped(s.V) if len(turned) != 1 else ():
        yield Variant(what=text("Sine and cosine are exchanged in ", where, "."), V=other - s.V)
    yield from _in_components(s)
    yield from _in_rows(s)
    for element in s.acting:
        shares = s.shares(element)
        for k in (0, 1):
            turned = {i: _swapped(x)[k] - x for i, x in shares.items() if _swapped(x)}
            if turned:
                what = text(f"Sine and cosine are exchanged in what {element.title} adds to ", Name("Xi"), ".")
                yield Variant(what=what, Xi=turned, element=element)


def _are_springs(elements: Sequence[Element]) -> bool:
    """Whether all elements are springs."""
    return all(isinstance(x, Spring) for x in elements)


def _in_components(s: Ingredients) -> Iterator[Variant]:
    """Exchange them in all components of one weight, which then are those of no height: m g sin θ and m g r cos θ."""
    for gravity, body, V in s.weights():
        shares = {i: bounded.diff(V, q) for i, q in enumerate(s.q)}
        turned = {i: _swapped(x)[0] - x for i, x in shares.items() if _swapped(x)}
        if len(turned) > 1:
            what = text(f"Sine and cosine are exchanged in the components of the weight of {body.title}.")
            yield Variant(what=what, rows=turned, element=gravity, body=body.title, stated=frozenset(), doubt=1)


def _in_rows(s: Ingredients) -> Iterator[Variant]:
    """Exchange them in one term of one equation; what comes from V alone belongs to step 3, from Ξ alone to step 6."""
    ledgers = {e.title: e.ledger for e in s.model.elements}
    for i, row in enumerate(s.derivation.terms):
        for term in row:
            expr = s.expand(term.expr) * (-1 if term.kind == "input" else 1)
            for other in _swapped(expr) if s.moves(expr) else ():
                what = text(
                    "Sine and cosine are exchanged in the term ", term.expr, " of the equation of ", s.q[i], "."
                )
                from_ = {ledgers.get(e, "T*") for e in term.elements}
                step = {"V": 3, "Ξ": 6}.get(from_.pop(), 5) if len(from_) == 1 else 5
                yield Variant(what=what, rows={i: other - expr}, coordinate=i, stated=frozenset(), step=step)


def _swapped(expr: sp.Expr) -> tuple[sp.Expr, ...]:
    """The expression with sine and cosine exchanged, also with the opposite sign; nothing if it contains neither."""
    functions = expr.atoms(sp.sin, sp.cos)
    changed = put(expr, {f: partner(f) for f in functions})
    return (changed, put(expr, {f: -partner(f) for f in functions})) if changed != expr else ()
