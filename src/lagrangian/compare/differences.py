"""Finds where two systems differ, step by step and element by element: T*, V, then each Ξ_i."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Literal, cast

import sympy as sp

from lagrangian.compare.rows import Difference, ParameterDifference
from lagrangian.compare.shared import Shared
from lagrangian.compare.zero import Zero
from lagrangian.model import Element, Model

Quantity = Literal["T*", "V", "Xi"]
STEPS: dict[Quantity, int] = {"T*": 2, "V": 3, "Xi": 6}
LEDGER: dict[Quantity, str] = {"T*": "T*", "V": "V", "Xi": "Ξ"}
VALUE_TOLERANCE = 1e-12


def parameter_differences(a: Model, b: Model) -> tuple[ParameterDifference, ...]:
    """Parameters with two different values, and parameters that only one system has."""
    left, right = ({p.name: p for p in m.parameters} for m in (a, b))
    found = []
    for name in dict.fromkeys([*left, *right]):
        p, q = left.get(name), right.get(name)
        if p is None or q is None:
            value = [x.value if x is not None else None for x in (p, q)]
            found.append(ParameterDifference(name, value[0], value[1], "A" if p is None else "B"))
        elif p.value is not None and q.value is not None and _apart(p.value, q.value):
            found.append(ParameterDifference(name, p.value, q.value))
    return tuple(found)


def _apart(x: float, y: float) -> bool:
    return abs(x - y) > VALUE_TOLERANCE * max(abs(x), abs(y))


def unmatched(a: Model, b: Model) -> tuple[Difference, ...]:
    """Elements that only one system has, matched by name and kind, if the coordinates cannot be matched."""
    found = []
    for quantity, step in STEPS.items():
        mine = [e.title for e in a.elements if e.ledger == LEDGER[quantity]]
        theirs = [e.title for e in b.elements if e.ledger == LEDGER[quantity]]
        nothing = (sp.S.Zero, sp.S.Zero, sp.S.Zero)
        found += [Difference(step, quantity, None, *nothing, t, None) for t in mine if t not in theirs]
        found += [Difference(step, quantity, None, *nothing, None, t) for t in theirs if t not in mine]
    return tuple(found)


def differing(zero: Zero, shared: Shared, *, turned: bool) -> tuple[Difference, ...]:
    """All contributions that differ, in the order of the steps; ``turned`` if the first system is (B)."""
    found: list[Difference] = []
    forces: list[tuple[Quantity, int | None]] = [("Xi", i) for i in range(len(shared.b.coordinates))]
    energies: list[tuple[Quantity, int | None]] = [("T*", None), ("V", None)]
    for quantity, index in energies + forces:
        pairs = list(_pairs(zero, shared, quantity, index))
        total = [(sp.S.One, x) for _, x, _, _ in pairs] + [(sp.S.NegativeOne, y) for _, _, _, y in pairs]
        if not pairs or zero.vanishes(total).holds:
            continue
        for one, x, other, y in pairs:
            if _matters(zero, shared, quantity, x - y):
                name = shared.b.coordinates[index].name if index is not None else None
                ends = [(x, one.title if one else None), (y, other.title if other else None)]
                (p, e), (q, f) = reversed(ends) if turned else ends
                term = first_term(zero, p - q)
                p, q = zero.readable(p), zero.readable(q)
                found.append(Difference(STEPS[quantity], quantity, name, p, q, term, e, f))
    return tuple(found)


def _matters(zero: Zero, shared: Shared, quantity: Quantity, gap: sp.Expr) -> bool:
    if quantity == "V":  # a different datum is not a difference
        return any(not zero.vanishes([(sp.S.One, sp.diff(gap, c.symbol))]).holds for c in shared.b.coordinates)
    return not zero.vanishes([(sp.S.One, gap)]).holds


def first_term(zero: Zero, expr: sp.Expr) -> sp.Expr:
    """The first readable term of an expression."""
    form = zero.form(expr)
    if form is None:
        return cast("sp.Expr", sp.Add.make_args(expr)[0])
    return form.terms()[0].expr if not form.is_zero else expr


Given = tuple[Element, sp.Expr]
Pair = tuple[Element | None, sp.Expr, Element | None, sp.Expr]


def _pairs(zero: Zero, shared: Shared, quantity: Quantity, index: int | None) -> Iterator[Pair]:
    """Pairs of elements of the two systems, with their contributions.

    Elements of the same name are paired, then those with the same contribution, then those of the same kind, in order;
    the remaining ones are listed alone.
    """
    left, right = (
        [(e, shared.share(e, quantity, index, first=first)) for e in m.elements if e.ledger == LEDGER[quantity]]
        for m, first in ((shared.a, True), (shared.b, False))
    )
    tests: tuple[Callable[[Given, Given], bool], ...] = (
        lambda p, q: p[0].title == q[0].title,
        lambda p, q: p[1] != 0 and q[1] != 0 and zero.vanishes([(sp.S.One, p[1]), (sp.S.NegativeOne, q[1])]).holds,
        lambda p, q: p[0].kind == q[0].kind,
    )
    for alike in tests:
        for p in list(left):
            q = next((q for q in right if alike(p, q)), None)
            if q is not None:
                left.remove(p)
                right.remove(q)
                yield (*p, *q)
    for e, x in left:
        yield e, x, None, sp.S.Zero
    for f, y in right:
        yield None, sp.S.Zero, f, y
