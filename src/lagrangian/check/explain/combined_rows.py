"""Finds the one wrong term of an equation that is a sum of right ones: a body's own balance with a force put in.

P = Σ c_i W_i + (1 − f)·t, where t is one of its own terms, f·t is right, and the factors c_i and f depend on the place
alone. At one place the right rows W_i span a space of few dimensions among the values at many motions; what of P and of
t lies outside it are one multiple of each other, 1 − f.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.cleared import cleared
from lagrangian.check.held import OnConstraints, held
from lagrangian.check.reference import Reference, terms
from lagrangian.check.verdict import AnsweredLine, Finding, Status, TermDifference, Verdict, inserted
from lagrangian.derive.sampling import PLACES, SETS, Array, CompiledExpressions
from lagrangian.page.formula import text
from lagrangian.read.letters import key
from lagrangian.records import dataclass

MOST_TERMS, MOST_LETTERS = 60, 12
"""The most terms of a line that are tried, and the most letters that may be a factor."""
MOST_ANGLES = 8
"""The most angles of which a sine or a cosine may be a factor."""
MOST_IN_GROUP = 14
"""The most terms of an equation in which a group with one wrong factor is sought."""
MOST_PRODUCTS = 400
"""The most products of a term and an arm that a line may lack."""
NEAR = 1e-8
"""The relative difference of values that is rounding."""
NUMBERS: tuple[tuple[float, sp.Expr], ...] = (
    (0.0, sp.S.Zero),
    (-1.0, sp.S.NegativeOne),
    (2.0, sp.Integer(2)),
    (0.5, sp.S.Half),
)
"""What a term may have to be multiplied by."""


def with_combined_rows(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on an answer without an explanation, in which an equation that is a sum of right ones but for one of
    its terms differs in this term alone.

    A term that was put in from a definition is wrong there, and the same term further down follows from it.
    """
    on = held(truth) if truth.derivation.multipliers else truth
    if verdict.mistakes or on is None or on.n < 2 or not np.isfinite(on.W).all():
        return verdict
    findings, told = list(verdict.findings), list[WrongTerm]()
    for finding in verdict.findings:
        rows = finding.status is Status.WRONG and finding.line.kind == "equation" and len(finding.differences) != 1
        exprs = [finding.line.expr, as_written(lines, finding.line).expr] if rows else []
        found = (one_wrong_term(on, cleared(x)) for x in exprs)
        if not rows or (wrong := next((x for x in found if x is not None), None)) is None:
            continue
        k = next(k for k, f in enumerate(findings) if f is finding)
        if any(wrong.factor == x.factor and _quotient(on, wrong.term, x.term) for x in told):
            findings[k] = replace(finding, differences=(), follows=True)
            continue
        told.append(wrong)
        if (above := _put_in_from(on, lines, finding.line, wrong)) is not None:
            findings[k] = replace(finding, differences=(), follows=True)
            findings = inserted(findings, above)
            continue
        note = (
            finding.note
            if wrong.factor == sp.oo or stands_in(wrong.term, finding.line)
            else text("after substituting what other lines say of its names")
        )
        differences = (difference(on, wrong, finding.coordinate),)
        findings[k] = replace(finding, differences=differences, coordinate=None, note=note)
    return replace(verdict, findings=tuple(findings))


def as_written(lines: Sequence[AnsweredLine], line: AnsweredLine) -> AnsweredLine:
    """A line as the answer has it, without the multiplier with which it was compared with others."""
    same = [x for x in lines if (x.kind, x.number, x.text, x.name) == (line.kind, line.number, line.text, line.name)]
    return same[0] if len(same) == 1 else line


def denominator_of(expr: sp.Expr) -> sp.Expr | None:
    """The one sum by which an equation is divided."""
    found = {x.base for x in expr.atoms(sp.Pow) if x.exp == -1 and isinstance(x.base, sp.Add)}
    return cast("sp.Expr", found.pop()) if len(found) == 1 else None


def terms_of(expr: sp.Expr) -> tuple[sp.Expr, ...]:
    """The terms of a sum, multiplied out."""
    return tuple(cast("sp.Expr", x) for x in sp.Add.make_args(bounded.expand(expr)))


def _put_in_from(
    truth: Reference, lines: Sequence[AnsweredLine], line: AnsweredLine, wrong: WrongTerm
) -> Finding | None:
    """The finding for the definition from which a wrong term was put in: its name stands in the line, in which a letter
    of the term does not. None if there is none, or several."""
    if wrong.factor == sp.oo or stands_in(wrong.term, line):
        return None
    found: list[Finding] = []
    for x in lines:
        if x.kind != "definition" or x.name is None or key(x.name) not in key(line.text):
            continue
        value = truth.expand(x.expr)
        own = own_terms_of(value) if terms(value) <= MOST_TERMS else []
        there = [t for t in own if _quotient(truth, wrong.term, t)]
        found += [
            Finding(x, Status.WRONG, differences=(difference(truth, replace(wrong, term=t), None),)) for t in there
        ]
    return found[0] if len(found) == 1 else None


def stands_in(term: sp.Expr, line: AnsweredLine) -> bool:
    """Whether the text of a line has all letters of a term, also within words: m₃ae."""
    written = key(line.text)
    return all(key(str(x)) in written for x in bounded.letters(term) if isinstance(x, sp.Symbol))


def _quotient(truth: Reference, one: sp.Expr, other: sp.Expr) -> bool:
    """Whether a term is another one times a factor that depends on the place alone."""
    values = CompiledExpressions([one, other]).at(truth.states).reshape(2, SETS * PLACES, -1)
    return multiple_of(values[0], values[1]) is not None


@dataclass(frozen=True)
class WrongTerm:
    """A term that is wrong, and by what it would have to be multiplied: ∞ if it is missing."""

    term: sp.Expr
    factor: sp.Expr


def difference(truth: Reference, wrong: WrongTerm, coordinate: str | None) -> TermDifference:
    """What a wrong term has in place of the right one."""
    if wrong.factor == sp.oo:
        return TermDifference("missing", wrong.term, sp.S.Zero, coordinate)
    kind = {sp.S.Zero: "extra", sp.S.NegativeOne: "sign"}.get(wrong.factor, "coefficient")
    tangents = {x: sp.sin(x.args[0]) / sp.cos(x.args[0]) for x in wrong.factor.atoms(sp.tan)}
    right = wrong.term if kind == "extra" else cast("sp.Expr", wrong.term * wrong.factor.xreplace(tangents))
    moving = (c.name for c in truth.model.coordinates if wrong.term.has(c.acceleration))
    return TermDifference(kind, right, wrong.term, next(moving, coordinate))


def one_wrong_term(truth: Reference, expr: sp.Expr) -> WrongTerm | None:
    """The term of an equation that is wrong, if all others are right.

    The plainest factor counts, and of equal ones none: it would be a guess. None where there is none.
    """
    if terms(expr) > MOST_TERMS:
        return None
    own = own_terms_of(expr)
    if not 2 < len(own) <= MOST_TERMS:
        return None
    powers = [(t, f) for t in own for c in truth.model.coordinates for f in _powers(t, c.rate)]
    values = CompiledExpressions([expr, *own, *(t * f for t, f in powers)]).at(truth.states)
    if not np.isfinite(values).all():
        return None
    outside = outside_rows(truth, values)
    wrong, across = outside[0], dict(zip(own, outside[1:], strict=False))
    found = in_factors(truth, wrong, across)
    for (term, factor), right in zip(powers, outside[1 + len(own) :], strict=True):
        share = multiple_of(wrong, across[term] - right)
        if share is not None and np.allclose(share, 1, rtol=NEAR):
            found.append((1, WrongTerm(term, factor)))
    found.sort(key=lambda x: x[0])
    if not found:
        right = _right_terms(truth)
        values = CompiledExpressions(right).at(truth.states) if right else np.empty((0, truth.states.size))
        lacking = _lacking(right, wrong, outside_rows(truth, values)) if right else None
        return lacking or _group_in_factor(truth, expr, wrong)
    return None if len(found) > 1 and found[0][0] == found[1][0] else found[0][1]


def _group_in_factor(truth: Reference, expr: sp.Expr, wrong: Array) -> WrongTerm | None:
    """Two or three terms of an equation, as they are written, that have the same wrong factor, as a force that was put
    in has with a wrong arm, if all others are right. None if there are none, or several."""
    listed = [cast("sp.Expr", t) for t in sp.Add.make_args(expr)]
    if not 4 < len(listed) <= MOST_IN_GROUP or not truth.derivation.multipliers:
        return None
    outside = outside_rows(truth, CompiledExpressions(listed).at(truth.states))
    for count in (2, 3):
        groups = {
            cast("sp.Expr", sp.Add(*(listed[k] for k in chosen))): outside[list(chosen)].sum(axis=0)
            for chosen in combinations(range(len(listed)), count)
        }
        found = [x for _, x in in_factors(truth, wrong, groups) if x.factor != 0]
        if found:
            return found[0] if len(found) == 1 else None
    return None


def term_to_blame(truth: Reference, expr: sp.Expr, values: Mapping[sp.Basic, Array]) -> WrongTerm | None:
    """The term of a line that is wrong along the right motion, if all others are right there.

    ``values`` are those of the accelerations and of the forces in it. Of two sides that differ by a sign or a letter,
    that without accelerations is wrong: a moment or a force. By a number, it may be either.
    """
    own = own_terms_of(expr) if terms(expr) <= MOST_TERMS else []
    if not 1 < len(own) <= MOST_TERMS:
        return None
    found = CompiledExpressions([expr, *own]).at(truth.states, values).reshape(len(own) + 1, SETS * PLACES, -1)
    if not np.isfinite(found).all():
        return None
    listed = sorted(in_factors(truth, found[0], dict(zip(own, found[1:], strict=True))), key=lambda x: x[0])
    if not listed:
        return _missing(truth, found[0], values)
    best = [x for rank, x in listed if rank == listed[0][0]]
    moving = [c.acceleration for c in truth.model.coordinates]
    still = [x for _, x in listed if not x.term.has(*moving) and any(x.factor * y.factor == 1 for y in best)]
    if len(still) == 1 and any(x.term.has(*moving) for x in best):
        return None if still[0].factor in (2, sp.S.Half) else still[0]
    return best[0] if len(best) == 1 else None


def _missing(truth: Reference, wrong: Array, values: Mapping[sp.Basic, Array]) -> WrongTerm | None:
    """The term of a right equation, or all those with one parameter, that a line lacks along the right motion."""
    right = _right_terms(truth)
    for some in (right, _with_arms(truth, right, values)) if right else ():
        found = _lacking(some, wrong, CompiledExpressions(some).at(truth.states, values))
        if found is not None:
            return found
    return None


def _right_terms(truth: Reference) -> list[sp.Expr]:
    """The terms of the right equations, and all those with one parameter together; none if there are many."""
    listed: set[sp.Expr] = set()
    for row in (*truth.rows, *_reduced(truth)):
        own = sp.Add.make_args(bounded.expand(row)) if terms(row) <= MOST_TERMS else ()
        groups = [[cast("sp.Expr", t) for t in own if t.has(p.symbol)] for p in truth.model.parameters]
        listed.update(t for group in groups if group for t in (*group, _together(group)))
    return sorted(listed, key=sp.default_sort_key) if len(listed) <= MOST_TERMS else []


def _reduced(truth: Reference) -> list[sp.Expr]:
    """The right equations without multipliers where constraints hold: Σ_i W_i ∂ξ̇_i/∂ξ̇_j, in the other coordinates."""
    if not isinstance(truth, OnConstraints):
        return []
    coordinates = truth.model.coordinates
    forces = dict.fromkeys((m.symbol for m in truth.derivation.multipliers.values()), sp.S.Zero)
    rows = [cast("sp.Expr", truth.put_in(cast("sp.Expr", row.xreplace(forces)))) for row in truth.rows]
    return [
        sp.Add(
            *[
                row * bounded.diff(truth.table.get(c.rate, c.rate), own.rate)
                for row, c in zip(rows, coordinates, strict=True)
            ]
        )
        for own in coordinates
        if own.rate not in truth.table
    ]


def _with_arms(truth: Reference, right: Sequence[sp.Expr], values: Mapping[sp.Basic, Array]) -> list[sp.Expr]:
    """Terms without accelerations, and forces, times a letter, a sine or a cosine: b ṡ r, N sin α."""
    moving = [c.acceleration for c in truth.model.coordinates]
    forces = [cast("sp.Expr", x) for x in values if x not in moving]
    angles = {f for row in truth.rows for f in row.atoms(sp.sin, sp.cos)}
    arms = [*(p.symbol for p in truth.model.parameters), *sorted(angles, key=sp.default_sort_key)]
    bare = [t for t in right if not t.has(*moving)][: MOST_TERMS // 2]
    products = [t * a for t in (*bare, *forces) for a in arms if not t.has(a)]
    return [*forces, *cast("list[sp.Expr]", products)][:MOST_PRODUCTS]


def _lacking(right: Sequence[sp.Expr], wrong: Array, values: Array) -> WrongTerm | None:
    """The only one of some terms, given with their values, that is, but for its sign, what a line lacks."""
    found = values.reshape(len(right), *wrong.shape)
    shares = ((t, multiple_of(wrong, x)) for t, x in zip(right, found, strict=True))
    signed = [(t, share.mean()) for t, share in shares if share is not None and np.allclose(abs(share), 1, rtol=NEAR)]
    lacking = {cast("sp.Expr", -t if sign > 0 else t) for t, sign in signed}
    return WrongTerm(lacking.pop(), sp.oo) if len(lacking) == 1 else None


def _together(group: Sequence[sp.Expr]) -> sp.Expr:
    """Several terms as one product, k (x − y); the one alone, if it is."""
    return cast("sp.Expr", sp.factor_terms(sp.Add(*group))) if len(group) > 1 else group[0]


Factors = Iterable[tuple[sp.Expr, Any]]


def in_factors(
    truth: Reference, wrong: Array, across: Mapping[sp.Expr, Array], factors: Factors = ()
) -> list[tuple[int, WrongTerm]]:
    """The terms that are wrong by a factor, if all others are right, each with how far-fetched the factor is."""
    listed = list(factors) or list(_factors(truth))
    found: list[tuple[int, WrongTerm]] = []
    for term, values in across.items():
        if (share := multiple_of(wrong, values)) is None:
            continue
        near = (k for k, (_, x) in enumerate(listed) if np.allclose(1 - share, x, rtol=NEAR, atol=NEAR))
        if (k := next(near, None)) is not None:
            found.append((max(0, k + 1 - len(NUMBERS)), WrongTerm(term, listed[k][0])))
    return found


def _powers(term: sp.Expr, rate: sp.Expr) -> list[sp.Expr]:
    """A rate by which a term may have to be multiplied or divided: θ̇ in place of θ̇², or the other way round."""
    power = term.as_powers_dict().get(rate, 0)
    return [rate] if power == 1 else [1 / rate] if power == 2 else []


def own_terms_of(expr: sp.Expr) -> list[sp.Expr]:
    """The terms of an equation: multiplied out, as they are written, and those of sums in them, each once."""
    found: dict[sp.Expr, sp.Expr] = {}
    written = [cast("sp.Expr", t) for t in sp.Add.make_args(expr)]
    for term in written:
        sums = [f for f in sp.Mul.make_args(term) if isinstance(f, sp.Add)][:1]
        rest = term / sums[0] if sums else sp.S.One
        whole = (term,) if not sums or len(written) > 1 else ()  # of a product, the line itself is no term
        for t in (*whole, *(x * rest for s in sums for x in s.args)):
            found.setdefault(bounded.expand(t), cast("sp.Expr", t))
    for t in sp.Add.make_args(bounded.expand(expr)):
        found.setdefault(cast("sp.Expr", t), cast("sp.Expr", t))
    return [t for whole, t in found.items() if whole != 0]


def outside_rows(truth: Reference, values: Array) -> Array:
    """What of values (k, S) lies outside the right rows, at every place; (k, places, motions)."""
    places = SETS * PLACES
    shaped = values.reshape(len(values), places, -1)
    rows = truth.W.reshape(truth.n, places, -1)
    found = np.empty_like(shaped)
    for p in range(places):
        basis, _ = np.linalg.qr((rows[:, p] / np.maximum(np.abs(rows[:, p]).max(axis=1, keepdims=True), 1e-300)).T)
        found[:, p] = shaped[:, p] - (shaped[:, p] @ basis) @ basis.T
    scale = np.abs(shaped).max(axis=2, keepdims=True)
    return np.where(np.abs(found) <= NEAR * scale, 0.0, found)


def multiple_of(wrong: Array, term: Array) -> Array | None:
    """By which multiple of a term something is wrong, at every place; None if it is none, or nothing is wrong."""
    size = (term * term).sum(axis=1)
    if (size == 0).any() or not np.abs(wrong).max():
        return None
    share = (wrong * term).sum(axis=1) / size
    left = np.abs(wrong - share[:, None] * term).max(axis=1)
    return share if (left <= 1e-6 * np.abs(wrong).max(axis=1)).all() else None


def _is_way(row: sp.Expr, q: sp.Expr) -> bool:
    """Whether a coordinate is a factor of a term, as a length is, and not only in sines and cosines."""
    return any(q in t.as_powers_dict() for t in sp.Add.make_args(bounded.expand(row)))


def _factors(truth: Reference) -> Iterator[tuple[sp.Expr, Any]]:
    """What a term may have to be multiplied by, with its values at every place, the plainest first."""
    places = SETS * PLACES
    for number, factor in NUMBERS:
        yield factor, np.full(places, number)
    letters = [p.symbol for p in truth.model.parameters if p.symbol not in truth.values][:MOST_LETTERS]
    listed: list[sp.Expr] = [*letters, *(1 / x for x in letters), *(x / y for x in letters for y in letters if x != y)]
    ways = [c.symbol for c in truth.model.coordinates if any(_is_way(row, c.symbol) for row in truth.rows)]
    fixed = {f for row in truth.rows for f in row.atoms(sp.sin, sp.cos) if not f.has(*truth.derivation.coordinates)}
    listed += [x for q in (*ways, *sorted(fixed, key=sp.default_sort_key)[:4]) for x in (q, 1 / q)]
    angles = {x.args[0] for row in truth.rows for x in row.atoms(sp.sin, sp.cos)} | {
        c.symbol for c in truth.model.coordinates
    }
    for angle in sorted(angles, key=sp.default_sort_key)[:MOST_ANGLES]:
        listed += [sp.tan(angle), 1 / sp.tan(angle), sp.sin(angle), sp.cos(angle)]
    lengths = [*ways, *_roots(truth)][:MOST_ANGLES]
    listed += [f for q in lengths for x in letters for f in (q / x, x / q)]
    masses = [x for x in letters if is_mass(truth, x)]
    listed += [f for x in masses for y in masses if x != y for f in ((x + y) / x, x / (x + y))]
    yield from at_places(truth, listed)


def at_places(truth: Reference, listed: Sequence[sp.Expr]) -> Factors:
    """Quantities that depend on the place alone, with their values at every place."""
    values = CompiledExpressions(listed).at(truth.states).reshape(len(listed), SETS * PLACES, -1)[:, :, 0]
    return zip(listed, values, strict=True)


def is_mass(truth: Reference, letter: sp.Symbol) -> bool:
    """Whether the kinetic energy is linear in a letter: a mass or a moment of inertia."""
    return truth.T.has(letter) and not bounded.diff(truth.T, letter).has(letter)


def _roots(truth: Reference) -> list[sp.Expr]:
    """The lengths of slanting ropes and springs in the right equations: √(h² + y²)."""
    powers = (x for row in truth.rows for x in row.atoms(sp.Pow))
    bases = {cast("sp.Expr", x.base) for x in powers if x.exp.is_Rational and not x.exp.is_Integer}
    return [sp.sqrt(x) for x in sorted(bases, key=sp.default_sort_key)]
