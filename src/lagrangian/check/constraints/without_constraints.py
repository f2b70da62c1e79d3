"""A system with constraints in coordinates of an answer's own that satisfy these: there it has none.

x = X + l sin θ and y = −l cos θ make (x − X)² + y² = l² hold. In X and θ the system is one without constraints, and the
mistakes of its energies and equations are named as in any other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.constraints.counted_together import integrated, ways_together
from lagrangian.check.coordinates.chart import OF_COORDINATES
from lagrangian.check.coordinates.relations import solutions
from lagrangian.check.coordinates.stated import InStatedCoordinates
from lagrangian.check.coordinates.tried import ProposedChange
from lagrangian.check.reference import Reference
from lagrangian.check.rows import differs_somewhere, zero_everywhere
from lagrangian.check.verdict import OWN_DERIVATIVES, AnsweredLine
from lagrangian.coordinates import Carrier, Change
from lagrangian.derive import derive
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.errors import ModelError
from lagrangian.model import Coordinate, Element, time
from lagrangian.model.rows import rows_of
from lagrangian.page.formula import text

SMALL = 1e-9
"""The size, relative to 1, below which the value of a constraint is rounding."""
NEARER = (0.4, 0.4, 0.4)
"""By what coordinates are multiplied, one after the other, until roots are real."""


def without_constraints(truth: Reference, lines: Sequence[AnsweredLine]) -> InStatedCoordinates | None:
    """The answer in its own coordinates, in which the constraints hold by themselves; None if it has no such.

    The answer says what they are, x = X + l sin θ, or they are angles that step 0 proposes.
    """
    own = {c.symbol for c in truth.model.coordinates}
    turned = {d.expr for line in lines for d in _second(line.expr)}
    new = sorted((x for x in turned - own if isinstance(x, AppliedUndef)), key=str)
    if any(integrated(truth, row) is None for row in rows_of(truth.model)):
        return None
    for table in _tables(truth, lines, new):
        kept = [c for c in truth.model.coordinates if c.symbol not in table]
        change = ProposedChange(table, _words(table), True)
        moving = [line.expr for line in lines if any(d.expr in table for d in _second(line.expr))]
        if not new and not all(_is_zero(truth, change.put(expr)) for expr in moving):
            continue  # equations of motion with multipliers, or with a constraint put in here and there
        if len(kept) + len(new) != truth.n - len(rows_of(truth.model)):
            continue
        other = _reference(truth, table, [*kept, *(Coordinate(str(x.func), x) for x in new)])
        if other is not None:
            every = {x for line in lines for x in bounded.letters(line.expr)}
            unknown = every - other.names - own
            return InStatedCoordinates(other, tuple(_moved(truth, lines, change, table, unknown)), change)
    return None


def _tables(
    truth: Reference, lines: Sequence[AnsweredLine], new: Sequence[sp.Expr]
) -> Iterator[dict[sp.Expr, sp.Expr]]:
    """What the coordinates that go are in the others: as the answer says, or as step 0 proposes."""
    named = {c.name: c.symbol for c in truth.model.coordinates}
    said = {named[str(x.name)]: x.expr for x in lines if x.kind == "definition" and str(x.name) in named}
    said = {q: value for q, value in said.items() if value.has(*(new or named.values())) and not value.has(q)}
    if said:
        yield cast("dict[sp.Expr, sp.Expr]", said)
    if not said and not new:
        yield from (way for way in ways_together(truth) if way)
    constraints = truth.derivation.constraints
    if constraints is not None and not new:
        yield _of_unwritten(truth, lines, {q: x for w in constraints.proposals if w.new is None for q, x in w.written})
    if not said and not new and (solved := _solved(truth, lines)):
        yield solved
    if constraints is None or len(new) != 1:
        return
    for way in constraints.proposals:
        if way.new is not None:
            proposed = {q: cast("sp.Expr", value.xreplace({way.new: new[0]})) for q, value in way.written}
            yield _of_unwritten(truth, lines, proposed)


def _solved(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[sp.Expr, sp.Expr]:
    """The coordinates that a line gives by others, h = √(l² − d²), and that no line accelerates."""
    moved = {d.expr for line in lines for d in _second(line.expr)}
    found: dict[sp.Expr, sp.Expr] = {}
    for line in lines:
        if line.kind != "equation" or line.expr.has(sp.Derivative) or bounded.letters(line.expr) - truth.names:
            continue
        for q in (c.symbol for c in truth.model.coordinates if c.symbol not in moved and line.expr.has(c.symbol)):
            value = bounded.expand(q - line.expr / slope) if (slope := bounded.diff(line.expr, q)) in (1, -1) else q
            if not value.has(q, *found):
                found.setdefault(q, value)
    return found


def _of_unwritten(
    truth: Reference, lines: Sequence[AnsweredLine], table: dict[sp.Expr, sp.Expr]
) -> dict[sp.Expr, sp.Expr]:
    """A table for coordinates that no line accelerates: of X = x − l sin θ, x = X + l sin θ if X″ is written."""
    moved = {d.expr for line in lines for d in _second(line.expr)}
    found: dict[sp.Expr, sp.Expr] = {}
    for q, value in table.items():
        others = [c.symbol for c in truth.model.coordinates if value.has(c.symbol) and c.symbol not in moved]
        solved = solutions(value - q, others[0]) if q in moved and others else []
        found |= {others[0]: solved[0]} if solved else {q: value}
    return found


def _second(expr: sp.Expr) -> list[Any]:
    """The second derivatives in an expression."""
    return [d for d in expr.atoms(sp.Derivative) if d.derivative_count > 1]


def _reference(truth: Reference, table: dict[sp.Expr, sp.Expr], coordinates: Sequence[Coordinate]) -> Reference | None:
    """The reference in these coordinates, made once; None if the constraints do not hold in them."""
    key = tuple(table.items())
    known = truth.others
    if key not in known:
        known[key] = _made(truth, table, coordinates)
    return known[key]


def breaking_constraints(truth: Reference, lines: Sequence[AnsweredLine]) -> InStatedCoordinates | None:
    """The answer in as many new coordinates as there are freedoms, x = l cos θ, if the constraints do not hold with
    what it says that the system's are; None if it says no such thing, or what is right."""
    own = {c.symbol for c in truth.model.coordinates}
    new = sorted({d.expr for x in lines for d in _second(x.expr)} - own, key=str)
    rows = rows_of(truth.model)
    named = {c.name: c.symbol for c in truth.model.coordinates}
    said = {named[str(x.name)]: x.expr for x in lines if x.kind == "definition" and str(x.name) in named}
    freedoms = len(new) == truth.n - len(rows) and len(said) == truth.n
    if not freedoms or any(integrated(truth, row) is None for row in rows):
        return None
    if not all(bounded.letters(value) - truth.names <= set(new) for value in said.values()):
        return None
    table = cast("dict[sp.Expr, sp.Expr]", said)
    other = _carried(truth, table, [Coordinate(str(x.func), x) for x in new])
    if other is None or _hold(truth, table, other):
        return None
    change = ProposedChange(table, _words(table), True)
    unknown = {x for line in lines for x in bounded.letters(line.expr)} - other.names - own
    return InStatedCoordinates(other, tuple(_moved(truth, lines, change, table, unknown)), change)


def _made(truth: Reference, table: dict[sp.Expr, sp.Expr], coordinates: Sequence[Coordinate]) -> Reference | None:
    other = _carried(truth, table, coordinates)
    return other if other is not None and _hold(truth, table, other) else None


def _carried(truth: Reference, table: dict[sp.Expr, sp.Expr], coordinates: Sequence[Coordinate]) -> Reference | None:
    """The reference in other coordinates, without its constraints."""
    model = truth.model
    whole: dict[Any, sp.Expr] = {c.symbol: table.get(c.symbol, c.symbol) for c in model.coordinates}
    try:
        found = _Free(model, Change(model.coordinates, tuple(coordinates), whole), model.name).built().model()
        other = Reference(derive(found), truth.values)
    except ModelError:
        return None
    _keep_in_reach(other, [x for value in table.values() for x in value.atoms(sp.Pow) if x.exp == sp.S.Half])
    return other


def _hold(truth: Reference, table: dict[sp.Expr, sp.Expr], other: Reference) -> bool:
    """Whether the constraints hold in other coordinates."""
    places = (integrated(truth, row) for row in rows_of(truth.model))
    rows = [cast("sp.Expr", place.xreplace(table)) for place in places if place is not None]
    values = CompiledExpressions(rows).at(other.states)
    return bool(np.isfinite(values).all() and np.abs(values).max(initial=0.0) <= SMALL)


def _keep_in_reach(other: Reference, roots: Sequence[sp.Expr]) -> None:
    """Bring the coordinates under roots, d of √(l² − d²), so near to 0 that the roots are real at every state."""
    inside = [c.symbol for c in other.model.coordinates if any(x.has(c.symbol) for x in roots)]
    for nearer in NEARER if inside else ():
        if np.isfinite(CompiledExpressions(list(roots)).at(other.states)).all():
            return
        for q, values in zip(inside, CompiledExpressions(inside).at(other.states), strict=True):
            other.states.fix(q, nearer * values)


class _Free(Carrier):
    """Carries a model over without its constraints and settings of runs."""

    def elements(self, element: Element) -> Iterator[Element]:
        """The element in the new coordinates, nothing for a constraint."""
        if element.ledger != "λ":
            yield from super().elements(element)

    def settle(self) -> None:
        """Nothing: no run starts here."""


def _moved(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    change: ProposedChange,
    table: dict[sp.Expr, sp.Expr],
    unknown: set[Any],
) -> Iterator[AnsweredLine]:
    """The lines with the coordinates that go written out; what says nothing then, or has a multiplier, is none."""
    gone = {str(cast("AppliedUndef", q).func) for q in table}
    for line in lines:
        if line.kind == "statement" or (line.kind == "definition" and line.name in gone):
            continue
        slopes = {x for d in line.expr.atoms(sp.Derivative) for x in d.variables} - {time}
        names = bounded.letters(line.expr)
        if slopes or names & unknown or (line.kind in OF_COORDINATES and line.name in gone):
            if line.kind != "definition":
                yield replace(line, kind="statement")
            continue
        moved = replace(line, expr=change.put(line.expr))
        if line.kind in OWN_DERIVATIVES and not _is_zero(truth, moved.expr):
            moved = replace(line, expr=change.put(_as_put_in(truth, lines, line, table)))
        holds = line.kind in ("equation", "identity") and _is_zero(truth, moved.expr)
        if not holds and line.kind == "equation" and _relates(line.expr, table):
            moved = replace(moved, kind="identity")  # cos θ = -sin γ where θ = 90° - γ is about no position
        yield replace(moved, kind="statement", expr=sp.S.Zero) if holds else moved


def _relates(expr: sp.Expr, table: dict[sp.Expr, sp.Expr]) -> bool:
    """Whether an equation of positions holds a coordinate that goes beside what it is given in."""
    inside = {x for value in table.values() for x in value.atoms(AppliedUndef)}
    return not expr.has(sp.Derivative) and expr.has(*table) and expr.has(*inside)


def _as_put_in(
    truth: Reference, lines: Sequence[AnsweredLine], line: AnsweredLine, table: dict[sp.Expr, sp.Expr]
) -> sp.Expr:
    """A derivative of the answer's own T* or V as one of what it is with the coordinates that go put in: below
    V = … − M g z and z = l − s − r θ, ∂V/∂θ has M g r."""
    energies = {x.kind: x.expr for x in lines if x.kind in ("T", "V")}
    own = energies.get("V" if line.kind == "V-slope" else "T")
    c = next((c for c in truth.model.coordinates if c.name == line.name), None)
    if own is None or c is None or line.kind == "D-slope":
        return line.expr
    more: sp.Expr = sp.S.Zero
    for gone in (x for x in truth.model.coordinates if x.symbol in table):
        value = table[gone.symbol]
        rate = bounded.diff(value, time)
        by_rate = bounded.diff(own, gone.rate)
        if line.kind in ("T-p", "T-rate"):
            more += by_rate * bounded.diff(rate, c.rate)
        else:
            more += bounded.diff(own, gone.symbol) * bounded.diff(value, c.symbol) + by_rate * bounded.diff(
                rate, c.symbol
            )
    more = bounded.diff(more, time) if line.kind == "T-rate" else more
    return line.expr + more if line.kind in ("T-p", "T-slope") else line.expr - more


def _is_zero(truth: Reference, expr: sp.Expr) -> bool:
    """Whether an expression is 0 when it is written out, or everywhere, as h/cos² θ − h − h tan² θ."""
    if differs_somewhere(truth, expr):
        return False
    if sp.expand_trig(expr).expand() == 0:
        return True
    return not _others(truth, expr) and zero_everywhere(truth, expr)


def _others(truth: Reference, expr: sp.Expr) -> set[Any]:
    """The names that the system does not have."""
    return bounded.letters(expr) - truth.names


def _words(table: dict[sp.Expr, sp.Expr]) -> Any:
    parts: list[Any] = []
    for q, value in table.items():
        parts += [q, " = ", value, ", "]
    return text("with ", *parts[:-1])
