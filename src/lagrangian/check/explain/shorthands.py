"""Which value a shorthand of constants should have for the first wrong line to be right: μ = (m l − M d) g; and which
one a product that moves, as the arm of a force: sin α = h cos θ/s.

The line, with the name in place of its value, is linear in it, or in its square where ω² = k/M is what is written. The
value is sought among those that one slip would turn into what is written: a sign, a factor 2, a letter too few or too
many in one term, one mass for two.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.apart import told_apart
from lagrangian.check.explain.combined_rows import is_mass
from lagrangian.check.explain.in_own_names import OwnName, with_names
from lagrangian.check.explain.quantities import Effect, Sayable, quantities_of
from lagrangian.check.explain.said_wrongly import InWords, SaidWrongly
from lagrangian.check.held import held
from lagrangian.check.reference import Reference
from lagrangian.check.stated import index_of, right_value
from lagrangian.check.terms.pieces import partner
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import Name, text
from lagrangian.read.letters import key

MOST_TERMS, MOST_LETTERS = 6, 20
"""The most terms of a shorthand, and the most letters that may be missing in one."""
NUMBERS = (sp.S.NegativeOne, sp.Integer(2), sp.S.Half)
"""By what number a term may be wrong."""
NEAR = 1e-8
"""The relative size of what is rounding."""
INVERSE: dict[Any, Any] = {sp.sin: sp.asin, sp.cos: sp.acos, sp.tan: sp.atan}
KIND = "shorthand"
WHY = text("Go through it term by term: its sign, its factors, its powers and its unit.")


def is_shorthand(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a definition is made of constants of the system alone, of at least two."""
    letters = bounded.letters(line.expr)
    own: set[sp.Basic] = {p.symbol for p in truth.model.parameters}
    if line.kind != "definition" or len(letters) < 2 or line.name in truth.model.symbols:
        return False
    return letters <= own or _is_moving_product(truth, line.expr)


def _is_moving_product(truth: Reference, expr: sp.Expr) -> bool:
    """Whether a value is a product of letters, functions and powers that moves, and has no rates and no inputs."""
    known = {p.symbol for p in truth.model.parameters} | {c.symbol for c in truth.model.coordinates}
    moves = expr.has(*(c.symbol for c in truth.model.coordinates)) and not expr.has(sp.Derivative)
    return isinstance(expr, sp.Mul) and moves and bounded.letters(expr) <= known | {time}


def right_values(
    truth: Reference, line: AnsweredLine, first: AnsweredLine, symbol: sp.Expr
) -> Iterator[tuple[sp.Expr, list[SaidWrongly]]]:
    """The values of a shorthand ``line`` with which the ``first`` wrong line, that has its ``symbol``, may be right."""
    power = 2 if line.of_square else 1
    of = line.of_function(symbol)
    still = not _is_moving_product(truth, line.expr)
    found = _linear(truth, first, cast("sp.Expr", of**power), symbol, still=still)
    if found is None:
        return
    values, (slope, rest) = [*_slips(truth, line.expr)], found
    on = held(truth) if truth.derivation.multipliers else truth
    if on is None or not values:
        return
    compiled = CompiledExpressions([slope, rest, *values]).at(on.states, on.accelerations)
    scale = np.abs(compiled[0] * compiled[2]) + np.abs(compiled[1])
    if not np.isfinite(compiled).all() or np.abs(compiled[0]).max() <= NEAR:
        return
    for value, own in zip(values, compiled[2:], strict=True):
        if (np.abs(compiled[0] * own + compiled[1]) <= NEAR * np.maximum(scale, scale.max() * NEAR)).all():
            put = cast("sp.Expr", value ** sp.Rational(1, power))
            yield INVERSE[of.func](put) if of.func in INVERSE else put, [_said(truth, line, value)]


def _linear(
    truth: Reference, line: AnsweredLine, of: sp.Expr, symbol: sp.Expr, *, still: bool
) -> tuple[sp.Expr, sp.Expr] | None:
    """The slope of left minus right by a symbol or its square, and the rest; None if it is not linear in it.

    ``still``: it is constant, so that d/dt[(I + m s²) θ̇] has no rate of it.
    """
    expr = line.expr
    if line.kind != "equation":
        right = right_value(truth, line, index_of(truth, line.name))
        if right is None:
            return None
        expr = cast("sp.Expr", expr - right)
    if still:
        rates = (d for d in expr.atoms(sp.Derivative) if isinstance(d, sp.Derivative) and d.expr == symbol)
        expr = cast("sp.Expr", expr.xreplace(dict.fromkeys(rates, sp.S.Zero)))
    mark = sp.Dummy()
    put = cast("sp.Expr", expr.xreplace({of: mark}))
    slope = bounded.diff(put, mark)
    if slope == 0 or put.has(symbol) or slope.has(mark):
        return None
    return slope, cast("sp.Expr", put.xreplace({mark: sp.S.Zero}))


def _slips(truth: Reference, written: sp.Expr) -> Iterator[sp.Expr]:
    """What a shorthand may have been meant to be."""
    own = sp.Add.make_args(bounded.expand(written))
    if len(own) > MOST_TERMS:
        return
    letters = [p.symbol for p in truth.model.parameters if p.symbol not in truth.values][:MOST_LETTERS]
    held = bounded.letters(written)
    for k, term in enumerate(own):
        others = sp.Add(*own[:k], *own[k + 1 :])
        for factor in (*NUMBERS, *(y for x in letters for y in (x, 1 / x))):
            if len(own) > 1 or factor.is_number or factor.free_symbols <= held:
                yield cast("sp.Expr", others + factor * term)
    if _is_moving_product(truth, written):
        plain = [x for x in sp.Mul.make_args(written) if x in letters]
        yield from (cast("sp.Expr", written * y / x) for x in plain for y in letters if y != x)
        turned = [x for x in sp.Mul.make_args(written) if isinstance(x, sp.sin | sp.cos)]
        yield from (cast("sp.Expr", written * partner(x) / x) for x in turned)
    masses = [x for x in letters if is_mass(truth, x)]
    for x in (x for x in masses if x in held):
        yield from (cast("sp.Expr", written.xreplace({x: x + y})) for y in masses if y != x)
    for whole in (x for x in written.atoms(sp.Add) if x != written and x.free_symbols <= set(masses)):
        yield from (cast("sp.Expr", written.xreplace({whole: whole - x})) for x in whole.args)


def _said(truth: Reference, line: AnsweredLine, value: sp.Expr) -> SaidWrongly:
    return SaidWrongly(line, Effect(), partial(_words, truth, line, value), right=value)


def _words(truth: Reference, line: AnsweredLine, value: sp.Expr) -> InWords:
    """What is right and what is written, in the form in which this is written."""
    s = quantities_of(truth).of
    shown = cast("sp.Expr", sp.factor_terms(value) if not line.expr.is_Add else value)
    symbol = cast("sp.Expr", sp.Symbol(str(line.name)))
    whole = symbol**2 if line.of_square else line.of_function(symbol)
    name = Name(str(line.name)) if whole == symbol else cast("sp.Expr", whole)
    of = Sayable(KIND, None, ("value of ", name), value, lambda _: Effect())
    letters: frozenset[sp.Basic] = frozenset(bounded.letters(value) | bounded.letters(line.expr))
    names = [OwnName(d.symbol, truth.expand(d.symbol)) for d in truth.model.definitions if key(d.name) in line.names]
    right, written = (with_names(x, names) for x in (shown, line.expr))
    return InWords(of, (right,), (written,), letters, told_apart(s, value, line.expr), WHY)
