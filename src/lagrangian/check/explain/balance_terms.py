"""What one term of a body's balance may have to be, with how far-fetched each is: N sin α is missing, 2 Z for Z.

The forces of the other lines and the right motion give by how much a line is wrong at every state. A term is one that
explains it if it is that, or a multiple of it by a plain factor, for all values of the parameters.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations_with_replacement
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.all_forces import letters_of_gravity
from lagrangian.check.explain.combined_rows import MOST_TERMS, WrongTerm, in_factors, is_mass, own_terms_of
from lagrangian.check.reference import Reference, terms
from lagrangian.check.rows import same_values
from lagrangian.derive.sampling import PLACES, SETS, Array, CompiledExpressions
from lagrangian.model import Damper, Spring
from lagrangian.records import dataclass

MOST_LETTERS = 14
"""The most letters of masses and lengths that are tried in a missing term."""
MOST_LAWS = 6
"""The most springs and dampers whose whole forces are tried in one."""
NEAR = 1e-8
"""The relative size of what is rounding."""
COSTS: dict[sp.Expr, float] = {sp.S.NegativeOne: 1.0, sp.Integer(2): 1.0, sp.S.Zero: 1.6, sp.S.Half: 1.6}
"""How far-fetched it is that a term has to be multiplied by a number: a factor is forgotten rather than invented."""
LETTER, INVERSE, RATIO, MOVING = 2.0, 2.5, 3.0, 0.5
"""The same for a letter or an angle, for what a term is divided by, for both; more for a term with an acceleration."""
EXCHANGED = 1.2
"""What a sine for a cosine costs."""
MISSING, BODY, FOREIGN = 1.5, 0.2, 0.8
"""What a missing force costs, and more for mass times acceleration, a mass or coordinate that the line has not."""
CUT = 1.0
"""What it costs more that it is another body's mass times its acceleration: the forces between them stand for it."""
NEW_ANGLE = 0.4
"""What it costs more to lack a component along an angle that the line has not."""
OTHER_INERTIA = 1.7
"""What a moment of inertia about another point costs."""
OF_LAW = 1.5
"""What it costs more that the force of a spring or damper is wrong under its name, which is its right law."""
CLEAR = 0.3
"""By how much one has to be plainer than all others."""


@dataclass(frozen=True)
class Mend:
    """A term with which a line would be right, and how far-fetched it is."""

    cost: float
    term: WrongTerm


@dataclass(frozen=True)
class Laws:
    """The right laws of springs and dampers, by name, that a line has, those that only other balances have, and the
    letters that only others have."""

    here: tuple[sp.Expr, ...] = ()
    elsewhere: tuple[sp.Expr, ...] = ()
    letters: frozenset[sp.Basic] = frozenset()


NO_LAWS = Laws()


def mends(
    truth: Reference,
    expr: sp.Expr,
    values: Mapping[sp.Basic, Array],
    forces: Sequence[sp.Basic],
    laws: Laws = NO_LAWS,
) -> list[Mend]:
    """The terms with which a line would be right along the right motion, the plainest first.

    ``values`` are those of the accelerations and of the ``forces`` of the answer's own.
    """
    own = own_terms_of(expr) if terms(expr) <= MOST_TERMS else []
    if not 1 < len(own) <= MOST_TERMS:
        return []
    held = [t for t in own if t.has(*forces)] if forces else []
    own += [cast("sp.Expr", sp.Add(*held))] if 1 < len(held) < len(own) else []
    found = CompiledExpressions([expr, *own]).at(truth.states, values)
    if not np.isfinite(found).all() or not np.abs(found[0]).max():
        return []
    shaped = found.reshape(len(own) + 1, SETS * PLACES, -1)
    across = dict(zip(own, shaped[1:], strict=True))
    listed = [
        Mend(_cost(truth, w), w) for _, w in in_factors(truth, shaped[0], across) if not _is_of_centre(truth, expr, w)
    ]
    listed += _other_inertias(truth, expr, found[0], values)
    lacking = _missing(truth, expr, found[0], values, forces, laws)
    listed += [replace(m, term=WrongTerm(-m.term.term, sp.S.Zero)) if -m.term.term in own else m for m in lacking]
    listed = [replace(m, cost=m.cost + OF_LAW) if _is_law(m.term, laws.here) else m for m in listed]
    return sorted(listed, key=lambda x: x.cost)


def _is_law(wrong: WrongTerm, laws: Sequence[sp.Expr]) -> bool:
    """Whether a term that is wrong by a number is nothing but the force of a name."""
    return wrong.factor.is_number and any(bounded.expand(wrong.term - s * x) == 0 for x in laws for s in (1, -1))


def plainest(listed: Mapping[int, Sequence[Mend]]) -> tuple[int, WrongTerm] | None:
    """The line, by its key, and the term of it, that are clearly the plainest; None if there is none."""
    every = sorted(((m.cost, k, m.term) for k, found in listed.items() for m in found), key=lambda x: x[:2])
    if not every:
        return None
    best, k, term = every[0]
    near = [(at, x) for cost, at, x in every if cost < best + CLEAR]
    own = [x for at, x in near if at == k and x.factor != sp.oo]
    alike = [x for x in own if x.term / term.term in (2, -2)]  # 2 M g for M g, not M g more
    near = [x for x in near if x[0] != k or x[1] not in (term, *alike)]
    return None if near else (k, alike[0] if term.factor == sp.oo and alike else term)


def _cost(truth: Reference, wrong: WrongTerm) -> float:
    """How far-fetched a factor of a term is."""
    factor = wrong.factor
    more = MOVING if wrong.term.has(*(c.acceleration for c in truth.model.coordinates)) else 0.0
    if factor in COSTS:
        return COSTS[factor] + more
    if (tangent := next(iter(factor.atoms(sp.tan)), None)) is not None:
        there = sp.cos if factor == tangent else sp.sin
        return more + (EXCHANGED if wrong.term.has(there(tangent.args[0])) else RATIO)
    above, below = factor.as_numer_denom()
    if _are_legs(wrong.term, above, below):
        return more + EXCHANGED
    return more + (LETTER if below == 1 else INVERSE if above == 1 else RATIO)


def _are_legs(term: sp.Expr, right: sp.Expr, written: sp.Expr) -> bool:
    """Whether a term has one leg of a right triangle over its hypotenuse, h/√(h² + y²), the sine for the cosine."""
    powers = term.as_powers_dict()
    slanted = (x for x, n in powers.items() if n == -sp.S.Half)
    return powers.get(written) == 1 and any(bounded.expand(x - right**2 - written**2) == 0 for x in slanted)


# -- moments of inertia -----------------------------------------------------------------------------------------------


def _inertias(truth: Reference) -> list[sp.Expr]:
    """The moments of inertia of the bodies in the plane, about their centres of mass."""
    found = [getattr(e, "inertia", None) for e in truth.model.elements]
    return [truth.expand(x[0, 0]) for x in found if isinstance(x, sp.MatrixBase) and x.shape == (1, 1)]


def _has_weight(truth: Reference, expr: sp.Expr) -> bool:
    """Whether a line has a weight, of any body."""
    return bool(bounded.letters(expr) & letters_of_gravity(truth))


def _is_of_centre(truth: Reference, expr: sp.Expr, wrong: WrongTerm) -> bool:
    """Whether a mend is the inertia about the centre of mass in a moment to which the weight adds: about another."""
    if wrong.factor in (sp.oo, sp.S.Zero) or not _has_weight(truth, expr):
        return False
    right = bounded.expand(wrong.term * wrong.factor)
    return any(_is_inertia(truth, right, J) for J in _inertias(truth))


def _is_inertia(truth: Reference, term: sp.Expr, J: sp.Expr) -> bool:
    """Whether a term is ± a moment of inertia times the acceleration of a coordinate."""
    turned = [bounded.expand(J * c.acceleration) for c in truth.model.coordinates]
    return any(term in (x, -x) for x in turned)


def _other_inertias(truth: Reference, expr: sp.Expr, wrong: Array, values: Mapping[sp.Basic, Array]) -> Iterator[Mend]:
    """The moment of inertia about the centre of mass for one of the same letters about another point."""
    if _has_weight(truth, expr):
        return
    for J in dict.fromkeys(_inertias(truth)):
        for c in truth.model.coordinates:
            for t in own_terms_of(expr):
                if not t.has(c.acceleration):
                    continue
                number = cast("sp.Expr", bounded.cancel(J * c.acceleration / t))
                if number in (1, -1) or not number.is_Rational:
                    continue
                factor = sp.Abs(number)
                missing = CompiledExpressions([t * (1 - factor)]).at(truth.states, values)[0]
                if same_values(missing, wrong, NEAR):
                    yield Mend(OTHER_INERTIA, WrongTerm(t, cast("sp.Expr", factor)))


# -- terms that are missing -------------------------------------------------------------------------------------------


def _missing(
    truth: Reference,
    expr: sp.Expr,
    wrong: Array,
    values: Mapping[sp.Basic, Array],
    forces: Sequence[sp.Basic],
    laws: Laws,
) -> Iterator[Mend]:
    """Forces, or mass times acceleration, that a line lacks: at an arm, in a component, or as they are. A spring's
    force is lacking where the rest of it stands."""
    apart = {x for own, _ in _efforts(truth) for x in own} & laws.letters
    bases = [(cost + FOREIGN * bool(bounded.letters(x) & apart), x) for cost, x in _bases(truth, expr, forces)]
    masses = {p.symbol for p in truth.model.parameters if is_mass(truth, p.symbol)} & laws.letters
    bases = [(cost + CUT * (_moves(truth, x) and bool(bounded.letters(x) & masses)), x) for cost, x in bases]
    bases += [(MISSING, x) for x in laws.elsewhere]
    levers = list(arms(truth, expr))
    exprs = [x for _, x in (*bases, *levers)]
    found = CompiledExpressions(exprs).at(truth.states, values)
    if not np.isfinite(found[: len(bases)]).all():
        return
    one, other = found[: len(bases)], found[len(bases) :]
    for i, (cost, base) in enumerate(bases):
        products = one[i] * other
        size = np.abs(wrong).max()
        for sign in (1, -1):
            for j in np.flatnonzero(np.abs(wrong - sign * products).max(axis=1) <= NEAR * size):
                yield Mend(cost + levers[j][0], WrongTerm(-sign * base * levers[j][1], sp.oo))


def _bases(truth: Reference, expr: sp.Expr, forces: Sequence[sp.Basic]) -> Iterator[tuple[float, sp.Expr]]:
    """Forces of the answer's own and of the system, and masses times accelerations of one kind."""
    model = truth.model
    masses = [p.symbol for p in model.parameters if is_mass(truth, p.symbol)][:MOST_LETTERS]
    rates = [c.rate for c in model.coordinates]
    kinds = [c.acceleration for c in model.coordinates]
    kinds += [2 * a * b if a != b else a * b for a, b in combinations_with_replacement(rates, 2)]
    found: dict[sp.Expr, float] = {cast("sp.Expr", f): MISSING for f in forces}
    for row in truth.rows:
        own = sp.Add.make_args(bounded.expand(row)) if terms(row) <= MOST_TERMS else ()
        for t in own:
            powers = t.as_powers_dict()
            inert = t.has(*kinds[: len(rates)]) or sum(int(powers.get(x, 0)) for x in rates) > 1
            foreign = any(t.has(c.symbol) and not expr.has(c.symbol) for c in model.coordinates)
            foreign |= any(t.has(m) and not expr.has(m) for m in masses)
            signed = cast("sp.Expr", -t if t.could_extract_minus_sign() else t)
            found.setdefault(signed, MISSING + BODY * inert + FOREIGN * foreign)
    for own, whole in _efforts(truth):
        apart = bounded.expand(whole)
        if 1 < terms(apart) <= MOST_TERMS:
            found.setdefault(whole, MISSING)
            for t in sp.Add.make_args(apart) if own & bounded.letters(expr) else ():
                found.setdefault(cast("sp.Expr", -t if t.could_extract_minus_sign() else t), MISSING)
    for m in masses:
        for kind in kinds:
            found.setdefault(cast("sp.Expr", m * kind), MISSING + BODY + (0 if expr.has(m) else FOREIGN))
    yield from ((cost, x) for x, cost in found.items())


def _moves(truth: Reference, term: sp.Expr) -> bool:
    """Whether a term has an acceleration or a product of rates."""
    rates = [c.rate for c in truth.model.coordinates]
    powers = term.as_powers_dict()
    return term.has(*(c.acceleration for c in truth.model.coordinates)) or sum(int(powers.get(x, 0)) for x in rates) > 1


def _efforts(truth: Reference) -> Iterator[tuple[set[sp.Basic], sp.Expr]]:
    """The letters of linear springs and dampers, and their whole forces: where one is a sum, c (θ′ + x′/R), it stands
    in a balance of one end as it is."""
    model = truth.model
    for e in [x for x in model.elements if isinstance(x, (Spring, Damper))][:MOST_LAWS]:
        if isinstance(e, Spring) and e.k is not None:
            yield bounded.letters(truth.expand(e.k)), truth.expand(e.k * e.extension(model))
        elif isinstance(e, Damper) and e.b is not None:
            yield bounded.letters(truth.expand(e.b)), truth.expand(e.b * e.rate(model))


def arms(truth: Reference, expr: sp.Expr) -> Iterator[tuple[float, sp.Expr]]:
    """What a force may be multiplied by: nothing, an arm, a ratio, the sine or cosine of an angle, two of these."""
    model = truth.model
    lengths = [p.symbol for p in model.parameters if p.symbol not in truth.values][:MOST_LETTERS]
    lengths += [c.symbol for c in model.coordinates]
    angles = sorted(
        set[sp.Expr]().union(*(cast("set[sp.Expr]", row.atoms(sp.sin, sp.cos)) for row in truth.rows)), key=str
    )[:8]
    yield 0.0, sp.S.One
    yield from ((0.5, x) for x in lengths)
    yield from ((0.5 + (0 if expr.has(x) else NEW_ANGLE), x) for x in angles)
    yield from ((1.0, 1 / x) for x in lengths)
    yield from ((1.0, cast("sp.Expr", x * y)) for x in lengths for y in angles)
    yield from ((1.0, cast("sp.Expr", x * y)) for x, y in combinations_with_replacement(lengths, 2))
