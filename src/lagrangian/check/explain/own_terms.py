"""Finds a term of the answer's own that is wrong: too much, with the wrong sign or number, or in place of another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from itertools import combinations
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.align import LARGEST, Alignment
from lagrangian.check.explain.changes.change import Words
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.counted_twice import TooMuch, too_much
from lagrangian.check.explain.efforts import Effort, effort_of
from lagrangian.check.explain.misconceptions.base import partner, put
from lagrangian.check.explain.powers import power_between
from lagrangian.check.explain.ratios import of_ratio
from lagrangian.check.explain.right_terms import RightTerm, RightTerms, right_terms
from lagrangian.check.explain.search import SMALL, simple_number
from lagrangian.check.reference import Reference, terms
from lagrangian.check.verdict import Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import Element, Gravity
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass

MOST_OWN_TERMS = 250
"""The largest number of terms of an expanded line that are examined."""
SUM = 0.8
"""What it costs more to take a whole sum for another."""
WHY = text("Go through ∂L/∂ξ̇, its d/dt and ∂L/∂ξ once more, term by term, and mind the signs.")
WHY_SQUARE = text("The derivative of a square is twice what is squared, and the ½ in front of it cancels this 2.")
WHY_IDLE = text(
    "Change this coordinate alone and hold the others: if the element neither moves nor deforms, it does no work."
)
WHY_ENERGY = text("Go through this line once more, term by term: what it stands for, and what it is at special angles.")
WHY_HEIGHT = text(
    "A weight is multiplied by the height of its own centre of mass: how far does that rise when the coordinate grows?"
)
WHY_FORCE = text(
    "Ξ = Σ F·∂r/∂ξ: only the part of a force along the motion does work, and only in coordinates that move its point."
)
WHY_DAMPER = text(
    "A damper feels how fast its own two ends move apart, nothing else, and acts only on coordinates that change that."
)
LINES = {"equation": 5, "T": 2, "V": 3, "L": 4, "Xi": 6}
"""The step to which a term belongs of which only the kind of its line is known."""


@dataclass(frozen=True, eq=False)
class OwnTerm:
    """A term of the answer's line that is wrong: the line less ``times``·term is right.

    1: too much, 2: wrong sign. ``forgotten``: it is not there, but one like it with sine and cosine exchanged is.
    ``instead``: what belongs in its place, in the scale of the answer, and the right term that this is. ``idle``: the
    element that such a term is of, which adds nothing to this equation. ``row`` is the equation, None for a line that
    is none. ``effort`` is the force, torque or damper with whose letters the term is written; ``because``: why one is
    too much.
    """

    row: int | None
    step: int
    term: sp.Expr
    times: Fraction = Fraction(1)
    forgotten: bool = False
    instead: tuple[sp.Expr, RightTerm] | None = None
    idle: Element | None = None
    effort: Effort | None = None
    because: TooMuch | None = None

    @property
    def cost(self) -> float:
        """How unlikely it is that this was the mistake."""
        if self.instead is not None:
            if self.term in (0, -self.instead[0]):
                return 2.2
            sums = sum(terms(x) > 1 for x in (self.term, self.instead[0]))  # then two slips are likelier
            return (3.0 if _factors(self.term, self.instead[0]) is not None else 3.3) + SUM * sums
        return 2.6 if self.forgotten or self.times in (1, 2) else 3.2

    def mistake(self, truth: Reference) -> Mistake:
        """The mistake in words."""
        name = truth.model.coordinates[self.row].name if self.row is not None else None
        where = ("the equation of ", truth.derivation.coordinates[self.row]) if self.row is not None else ("this line",)
        kind, what = self._said()
        brief, why = text("A term of ", *where, " is not right."), WHY if self.row is not None else WHY_ENERGY
        why = WHY_SQUARE if self._is_of_a_square(truth) else why
        step, element = self.step, None
        if self.instead is not None:
            step, element = self.instead[1].step, self.instead[1].element
            if self.row is None and isinstance(element, Gravity) and self.term not in (0, -self.instead[0]):
                why = WHY_HEIGHT
        if self.because is not None:
            element = self.because.element
        if self.effort is not None:
            step, element, why = 6, self.effort.element or element, WHY_DAMPER if self.effort.damper else WHY_FORCE
        if element is not None:
            brief = text(f"A term that comes from {element.title} in ", *where, " is not right.")
        if self.idle is not None:
            step, element, why = {"T*": 2, "V": 3}.get(self.idle.ledger, 6), self.idle, WHY_IDLE
            brief = text(f"{self.idle.title} does not belong in ", *where, ".")
        return Mistake(kind, what, why, step, element.title if element is not None else None, name, brief)

    def _said(self) -> tuple[str, Text]:
        t = self.term
        if self.instead is not None:
            return term_replaced(t, self.instead[0])
        if self.forgotten:
            like = " is missing: there is one like it with sine and cosine the other way round."
            return "term_forgotten", text("The term ", t, like)
        if self.times == 2:
            return "sign_of_a_term", text("The term ", t, " has the wrong sign.")
        if self.times == 1:
            why: Words = ()
            if self.because is not None:
                why = self.because.words
            elif self.idle is not None:
                why = (f": {self.idle.title} adds nothing to this equation",)
            elif self.effort is not None and self.effort.rate is not None and self.effort.element is not None:
                why = (f": {self.effort.element.title} feels ", self.effort.rate, " alone")
            return "term_too_much", text("The term ", t, " does not belong there", *why, ".")
        number = 1 - sp.Rational(self.times.numerator, self.times.denominator)
        counts = {sp.Rational(1, 2): ": it counts twice", sp.Integer(2): ": it counts half"}.get(number, "")
        return "factor_of_a_term", text("The term ", t, " should be ", number * t, counts, ".")

    def _is_of_a_square(self, truth: Reference) -> bool:
        """Whether a term of an equation counts twice that is derived from a square, ½ m v² or ½ k δ²: one without the
        letter of a weight, and with no product of two rates."""
        weights = [sp.sympify(e.g).free_symbols for e in truth.model.elements if isinstance(e, Gravity)]
        if self.row is None or self.times != Fraction(1, 2) or truth.values or not all(weights):
            return False
        return len(self.term.atoms(sp.Derivative)) < 2 and not self.term.free_symbols & set().union(*weights)


def term_replaced(term: sp.Expr, right: sp.Expr) -> tuple[str, Text]:
    """The name and the words for a term in place of another, for one that is missing, or for one too much (0)."""
    if right == 0:
        return "term_too_much", text("The term ", term, " does not belong there.")
    if term == 0:
        return "term_forgotten", text("The term ", right, " is missing.")
    if term == -right:
        return "sign_of_a_term", text("The term ", term, " has the wrong sign.")
    factors = _factors(term, right)
    if factors is None and (power := power_between(term, right)) is not None:
        if any(f.exp.is_negative and f.base == power.as_base_exp()[0] for f in right.atoms(sp.Pow)):
            return "divisor_missing", text("In the term ", term, ", one divisor ", power, " is missing.")
        return "foreign_factor", text("In the term ", term, " there is the factor ", power, " too much.")
    if factors is None:
        return "term_replaced", text("The term ", term, " stands where ", right, " belongs.")
    more, less = factors
    held = {f.as_base_exp()[0] for f in sp.Mul.make_args(sp.fraction(right)[0])}
    if less == 1 and abs(more) != 1:
        return "foreign_factor", text("In the term ", term, " there is the factor ", more, " too much.")
    if more == 1:
        undivided = less.is_number and sp.fraction(term)[1] % less != 0  # ½ m for 2 m is divided by 2, m for 2 m is not
        if not undivided and not any(f.as_base_exp()[0] in held for f in sp.Mul.make_args(less)):
            return "divided_by", text("In the term ", term, " there is the divisor ", less, " too much.")
        return "factor_missing", text("In the term ", term, ", the factor ", less, " is missing.")
    if more.is_Symbol and less.is_Symbol:
        if (ratio := of_ratio(term, right, more, less)) is not None:
            return ratio
        return "letter", text("In the term ", term, ", ", more, " stands in place of ", less, ".")
    return "factor_of_a_term", text("The term ", term, " should be ", right, ".")


def _factors(term: sp.Expr, right: sp.Expr) -> tuple[sp.Expr, sp.Expr] | None:
    """By which product of letters, sines, cosines and numbers a term is too much, and by which too little.

    None for anything else.
    """
    quotient = bounded.cancel(term / right)
    bases = [f.as_base_exp()[0] for f in sp.Mul.make_args(quotient)]
    more, less = sp.fraction(quotient)
    moving = [x for x in bases if isinstance(x, (sp.Derivative, AppliedUndef))]
    if not all(x.is_number or x.is_Symbol or x in moving or isinstance(x, (sp.sin, sp.cos)) for x in bases):
        return None
    return None if moving and 1 not in (more, less) else (more, less)


def own_terms(pool: Pool, exprs: Sequence[sp.Expr], P: Array, found: Sequence[Alignment]) -> list[OwnTerm] | None:
    """For every wrong row a term of its own that is wrong; None unless all wrong rows are explained so."""
    for a in found:
        if a.solved:
            continue
        told: list[OwnTerm] = []
        for j, i in enumerate(a.rows):
            if np.abs(a.rest[j]).max() <= 1e-9 * (1 + np.abs(pool.truth.W[i]).max()):
                continue
            scale = a.scale(pool.truth, j)
            one = own_term(pool, exprs[j], a.rest[j] * a.factors[j], "equation", i, scale, a.factors[j])
            if one is None:
                break
            told.append(one)
        else:
            if told:
                return told
    return None


def own_term(
    pool: Pool,
    expr: sp.Expr,
    rest: Array,
    kind: str,
    i: int | None,
    scale: sp.Expr | None = sp.S.One,
    factor: Array | float = 1.0,
) -> OwnTerm | None:
    """The term of a line that is wrong, if it is one: ``rest`` (S) is what the line has too much.

    The right line times ``factor``, as an expression ``scale`` if that is known, is the one that it is compared with.
    """
    if terms(expr) > MOST_OWN_TERMS:
        return None
    row = i if kind == "equation" else None
    every, count, values, usable = _written(pool.truth, expr)
    written = every[:count]
    foreign = foreign_names(pool.truth, expr)
    for k in np.flatnonzero(usable):
        t, v = every[k], values[k]
        c = float(v @ rest) / float(v @ v)
        if (
            t == expr
            or t in foreign
            or np.abs(rest - c * v).max() > SMALL * np.abs(rest).max()
            or (number := simple_number(c)) is None
        ):
            continue
        if k < count:
            idle = _idle(pool, row, t) if number == 1 else None
            effort = effort_of(pool, kind, row, t, scale)
            because = too_much(pool, kind, i, t, effort, scale) if number == 1 and idle is None else None
            return OwnTerm(row, LINES[kind], t, number, idle=idle, effort=effort, because=because)
        if number in (1, -1):
            lost = cast("sp.Expr", -number * t)
            return OwnTerm(row, LINES[kind], lost, forgotten=True, effort=effort_of(pool, kind, row, t, scale))
    if scale is None:
        return None
    listed = [(t, v) for t, v, use in zip(written, values, usable, strict=False) if use and t not in foreign]
    return in_place(pool, listed, rest, kind, i, right_terms(pool, kind, i), scale, factor)


@lru_cache(maxsize=64)
def _written(truth: Reference, expr: sp.Expr) -> tuple[list[sp.Expr], int, Array, Array]:
    """The terms of a line, their siblings, how many of both are terms, their values, and which can be compared.

    They are the same under every correspondence of the rows.
    """
    parts = (*sp.Add.make_args(expr), *sp.Add.make_args(bounded.expand(expr)))
    written = [t for t in dict.fromkeys(parts) if t != 0]
    own = [t for t in written if t != expr]
    siblings = list(dict.fromkeys(s for t in own for s in _siblings(t)))[: 4 * MOST_OWN_TERMS]
    values = CompiledExpressions([*written, *siblings]).at(truth.states)
    usable = np.isfinite(values).all(axis=1) & (np.abs(values).max(axis=1) > 1e-12)
    usable &= np.abs(values).max(axis=1) < LARGEST
    return [*written, *siblings], len(written), values, usable


def foreign_names(truth: Reference, expr: sp.Expr) -> set[sp.Basic]:
    """The names that the system does not have, with both signs: alone they are the name of a line, not its term."""
    own = truth.names | {m.symbol for m in truth.derivation.multipliers.values()}
    found: set[Any] = {x for x in bounded.letters(expr) if x not in own}
    return {y for x in found for y in (x, -x)}


def in_place(
    pool: Pool,
    written: Sequence[tuple[sp.Expr, Array]],
    rest: Array,
    kind: str,
    i: int | None,
    right: RightTerms,
    scale: sp.Expr = sp.S.One,
    factor: Array | float = 1.0,
) -> OwnTerm | None:
    """A right term that is missing or has the wrong sign, or one in whose place another stands: rest = term − right."""
    scaled = right.values * factor
    best: OwnTerm | None = None
    row = i if kind == "equation" else None
    size = np.abs(rest).max()

    def instead_of(k: int, t: sp.Expr | None = None, times: Any = 1) -> OwnTerm:
        one = right.terms[k]
        expr = scale * one.expr if scale in (1, -1) else bounded.expand(scale * one.expr)
        effort = effort_of(pool, kind, row, one.expr) if one.step == 6 else None
        written = cast("sp.Expr", times * expr) if t is None else t
        return OwnTerm(row, one.step, written, instead=(expr, one), effort=effort)

    for k, v in enumerate(scaled):
        for number in (-1, -2):
            if np.abs(rest - number * v).max() <= SMALL * size:
                near = SMALL * np.abs(v).max()
                own = next((t for t, w in written if number == -2 and np.abs(w + v).max() <= near), None)
                return instead_of(k, times=1 + number) if own is None else _turned(instead_of(k, own))
    for k, p in _multiplied(pool, scaled, rest):
        return instead_of(k, times=p)
    for t, v in written:
        missing = np.abs(scaled - (v - rest)).max(axis=1)
        for k in np.flatnonzero(missing <= SMALL * (size + np.abs(v).max())):
            found = instead_of(int(k), t)
            if best is None or found.cost < best.cost:
                best = found
    return best


def _turned(found: OwnTerm) -> OwnTerm:
    """A term with the wrong sign, and the same with the right one, both as the answer writes it."""
    assert found.instead is not None
    return replace(found, instead=(cast("sp.Expr", -found.term), found.instead[1]))


def _idle(pool: Pool, row: int | None, term: sp.Expr) -> Element | None:
    """The one element with whose letters a term is written, if it adds nothing to an equation, and none like it does.

    A rate is no letter of a damper: it may be given that of another point.
    """
    letters = cast("set[sp.Expr]", bounded.letters(term))
    ring = pool.sites.ring
    atoms = {ring.atom(x) for x in letters}
    rates = {ring.atom(v) for v in pool.sites.of.v}
    found: list[Element] = []
    acting: set[str] = set()
    for element, rows in pool.sites.element_rows.items():
        held = [{a for a, _ in m if not ring.turns(a)} for x in rows.values() for m in x]
        own = set[int].intersection(*held) if held else set[int]()
        own -= rates if element.ledger == "Ξ" else set[int]()
        if row is None or not own or not own <= atoms:
            continue
        if not rows.get(row):
            found.append(element)
        elif element.ledger == "Ξ":
            acting.add(element.ledger)
    found = [e for e in found if e.ledger not in acting]
    return found[0] if len(found) == 1 else None


def _multiplied(pool: Pool, right: Array, rest: Array) -> Iterator[tuple[int, sp.Expr]]:
    """The right terms, by their place, that a letter or its inverse multiplies too much: rest = (p − 1)·right."""
    with np.errstate(all="ignore"):
        times = rest / right + 1.0
    for q in pool.truth.model.parameters:
        if q.symbol in pool.truth.values:
            continue
        value = pool.truth.states.of(q.symbol)
        for p, v in ((q.symbol, value), (1 / q.symbol, 1 / value)):
            for k in np.flatnonzero((np.abs(times - v) <= SMALL * np.abs(v)).all(axis=1)):
                yield int(k), p


def _siblings(t: sp.Expr) -> Iterator[sp.Expr]:
    """The term with sine and cosine exchanged in one place, or in two."""
    turned: list[Any] = sorted(t.atoms(sp.sin, sp.cos), key=sp.default_sort_key)
    for count in (1, 2):
        for chosen in combinations(turned, count):
            yield put(t, {f: partner(f) for f in chosen})
