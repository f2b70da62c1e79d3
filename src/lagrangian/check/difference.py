"""The smallest difference of terms between a line of an answer and the right one, with the element of each term."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference, terms
from lagrangian.check.rows import ratio
from lagrangian.check.terms.alike import entries
from lagrangian.check.terms.groupings import groupings
from lagrangian.check.terms.own_form import in_own_form
from lagrangian.check.terms.scales import scales
from lagrangian.check.terms.told import Pair, pairs
from lagrangian.check.verdict import TermDifference, TermOrigin
from lagrangian.derive.algebra import Form
from lagrangian.derive.algebra.form import Key
from lagrangian.records import dataclass

MAX_DIFFERENCES = 12
"""The largest number of differences that are reported; an answer with more of them is a different answer."""
NEAR = 0.5
"""The fraction of terms of an equation that must agree with one that another line already states."""
MOST_ALIKE = 20_000
"""The most terms of a line, multiplied out, whose functions are compared in any form."""
Coefficients = dict[tuple[object, object], Fraction]
LONGEST_FACTOR = 40
"""Terms times a factor with more operations, such as the inverse of a long determinant, can no longer be compared."""


@dataclass(frozen=True)
class Likeness:
    """How similar a line is to a right one: which one, times what factor, and the fraction of terms that agree."""

    index: int
    factor: sp.Expr
    score: float


def likeness(form: Form | None, rights: Sequence[Form | None]) -> list[Likeness]:
    """The similarity of a form to each right form, in the order of the right ones; the factor is 1 if nothing is
    similar."""
    found: list[Likeness] = []
    for i, right in enumerate(rights):
        voted = ratio(form, right, unlike=0.5) if form is not None and right is not None else None
        if voted is None or form is None or right is None or voted[0].has(sp.Derivative):
            found.append(Likeness(i, sp.S.One, 0.0))
        else:
            factor, count = voted
            found.append(Likeness(i, factor, count / (form.size + right.size - count)))
    return found


def paired(likes: Sequence[Sequence[Likeness]], taken: Iterable[int]) -> list[Likeness | None]:
    """The best assignment of lines to right equations that are not yet taken, the most similar pair first."""
    used = set(taken)
    out: list[Likeness | None] = [None] * len(likes)
    pairs = sorted(
        ((like.score, -abs(i - j), i, j) for j, row in enumerate(likes) for i, like in enumerate(row)), reverse=True
    )
    for _, _, i, j in pairs:
        if out[j] is None and i not in used:
            used.add(i)
            out[j] = likes[j][i]
    return out


def nearest(likes: Sequence[Likeness]) -> Likeness | None:
    """The right equation that one more line than there are equations resembles most; None if none is near."""
    best = max(likes, key=lambda x: x.score, default=None)
    return best if best is not None and best.score >= NEAR else None


def differences(
    truth: Reference, form: Form, right: Form, factor: sp.Expr, index: int | None, expr: sp.Expr | None = None
) -> tuple[TermDifference, ...]:
    """The terms in which ``form`` differs from ``factor`` times ``right``; ``index`` is the coordinate of the equation.

    They are given in the scale of the answer, that is, times the factor; as they are written in ``expr``, if that is
    given.
    """
    if expr is not None and (told := _in_own_terms(truth, expr, right, factor, index)) is not None:
        return tuple(_as_written(truth, told, index))
    scale = truth.form(factor) if bounded.size(factor) <= LONGEST_FACTOR else None
    if scale is None or scale.is_zero:
        return ()
    inverse = truth.form(1 / factor)
    mine = form * inverse if inverse is not None else form
    lacking = right - mine
    if lacking.is_zero:
        return ()
    name = truth.model.coordinates[index].name if index is not None else None
    if lacking.opaque():
        return _in_any_form(truth, mine, right, factor, index, name)
    found: list[TermDifference] = []
    for keys in _groups(lacking):
        ours, theirs = right.restricted(keys), mine.restricted(keys)
        difference = lacking.restricted(keys)
        if theirs.is_zero:
            kind, term, written = "missing", ours, theirs
        elif ours.is_zero:
            kind, term, written = "extra", theirs, theirs
        else:
            term, written = _alone(ours, theirs, difference)
            kind = "sign" if (term + written).is_zero else "missing" if written.is_zero else "coefficient"
            if term.is_zero:
                kind, term = "extra", written
        as_written, written_so = (_scaled(x, factor) for x in (term, written))
        if kind == "coefficient" and (number := _number(written, term)) is not None:
            written_so = number * as_written  # in the same form, so that the factor is seen
        found.append(TermDifference(kind, as_written, written_so, name, _origins(truth, term, index)))
        if len(found) == MAX_DIFFERENCES:
            break
    return tuple(found)


def _in_own_terms(
    truth: Reference, expr: sp.Expr, right: Form, factor: sp.Expr, index: int | None
) -> list[Pair] | None:
    """The differences in the terms of the answer, against the grouping of the right terms in which they are fewest."""
    best: list[Pair] | None = None
    for listed in groupings(truth, right, index):
        found = pairs(truth, expr, listed, factor)
        if found is None or len(found) < 2:
            return [_of_whole_term(expr, x) for x in found] if found else found
        best = found if best is None or len(found) < len(best) else best
    return best


def _of_whole_term(expr: sp.Expr, pair: Pair) -> Pair:
    """A piece of a term that is too much, ⅛ m l² φ̇² of ½ m (ż² + ¼ l² φ̇²), told of the one written term that is like
    it, if that is more: ⅙ m l² φ̇² should be (1/24) m l² φ̇²."""
    whole = sp.Add.make_args(expr)
    if pair.right != 0 or pair.written in whole:
        return pair
    alike = [(t, number) for t in whole if (number := bounded.cancel(pair.written / t)).is_Rational]
    if len(alike) != 1 or not 0 < alike[0][1] < 1:
        return pair
    term, number = alike[0]
    right: sp.Expr = (1 - number) * term
    return Pair(term, right, bounded.cancel(right * pair.unscaled / pair.written))


def _as_written(truth: Reference, told: Sequence[Pair], index: int | None) -> Iterator[TermDifference]:
    name = truth.model.coordinates[index].name if index is not None else None
    for pair in told[:MAX_DIFFERENCES]:
        own = truth.form(pair.unscaled)
        origins = _origins(truth, own, index) if own is not None else ()
        term = in_own_form(truth, pair.written, pair.right) if pair.kind != "extra" else pair.written
        kind = "sign" if term == -pair.written else pair.kind
        yield TermDifference(kind, term, pair.written, name, origins)


def _in_any_form(
    truth: Reference, mine: Form, right: Form, factor: sp.Expr, index: int | None, name: str | None
) -> tuple[TermDifference, ...]:
    """The same for functions that have several forms, 1 + tan² θ and 1/cos² θ; none of lines that are very long."""
    found: list[TermDifference] = []
    belongs, written_so = right.expr(), mine.expr()
    if max(map(terms, (belongs, written_so))) > MOST_ALIKE:
        return ()
    for kind, term, written, whole in islice(entries(truth, belongs, written_so), MAX_DIFFERENCES):
        own = truth.form(whole) if kind != "extra" else None
        scaled = [x if abs(factor) == 1 else bounded.expand(factor * x) for x in (term, written)]
        found.append(
            TermDifference(kind, scaled[0], scaled[1], name, _origins(truth, own, index) if own is not None else ())
        )
    return tuple(found)


def _scaled(term: Form, factor: sp.Expr) -> sp.Expr:
    """A term of the right line in the scale of the answer; a term that was only moved to the other side is
    unchanged."""
    return term.expr() if abs(factor) == 1 else bounded.expand(factor * term.expr())


def _alone(ours: Form, theirs: Form, difference: Form) -> tuple[Form, Form]:
    """Of terms with the same motion, only the monomials that differ: for m₁ẍ + m₂ẍ and m₁ẍ, the m₂ẍ."""
    monomials = {(h, m) for h, p in difference.parts.items() for m in p}

    def kept(form: Form) -> Form:
        parts = {h: {m: c for m, c in p.items() if (h, m) in monomials} for h, p in form.parts.items()}
        return Form(form.algebra, parts, form.den)

    return kept(ours), kept(theirs)


def voted(truth: Reference, expr: sp.Expr, right: Form | None, like: Likeness) -> Likeness:
    """A likeness with the factor for which most terms of ``expr`` speak, one by one."""
    if right is None or (abs(like.factor) == 1 and like.score >= NEAR):
        return like
    found = scales(truth, expr, [t.expr for t in right.terms()])
    return replace(like, factor=found[0].factor) if found and found[0].votes > 1 else like


def _coefficients(form: Form) -> Coefficients:
    """The coefficient of every monomial of every harmonic."""
    return {(h, m): Fraction(c, form.den) for h, p in form.parts.items() for m, c in p.items()}


def _number(form: Form, other: Form) -> sp.Expr | None:
    """The number by which one form is a multiple of another; None if it is none."""
    mine, theirs = (_coefficients(f) for f in (form, other))
    if not theirs or mine.keys() != theirs.keys():
        return None
    (first, *more) = {mine[k] / theirs[k] for k in mine}
    return None if more else sp.Rational(first.numerator, first.denominator)


def _groups(form: Form) -> list[frozenset[Key]]:
    """The keys of a form, grouped by readable term: one group for each motion."""
    return [frozenset({k}) for k in sorted(form.keys(), key=str)]


def _origins(truth: Reference, term: Form, index: int | None) -> tuple[TermOrigin, ...]:
    """The elements that add a term to equation ``index``, or to an energy, each once, with its step.

    An element whose terms have the same motion and other letters adds nothing to it. Where those of some elements are
    the term itself, it comes from these: in numbers, 0.1 cos θ is none of the −2 cos θ that others add.
    """
    shares: list[tuple[TermOrigin, sp.Expr]] = []
    if index is None:
        for element in truth.model.elements:
            lost = element.dissipation(truth.model) or sp.S.Zero
            for energy, step in ((element.kinetic(truth.model), 2), (element.potential(truth.model), 3), (lost, 6)):
                shares += [(TermOrigin(element.title, step), truth.expand(energy))] if energy != 0 else []
    for origin in truth.derivation.shares.where(term.expr()) if index is not None else ():
        if origin.coordinate == truth.model.coordinates[index or 0].name:
            shares.append((TermOrigin(origin.element.title, origin.step), truth.put(origin.share)))
    wanted = _coefficients(term)
    found = [(origin, own) for origin, share in shares if (own := _shared(truth, share, wanted))]
    whole = [origin for origin, own in found if own in (wanted, {k: -x for k, x in wanted.items()})]
    return tuple(dict.fromkeys(whole or (origin for origin, _ in found)))


def _shared(truth: Reference, share: sp.Expr, wanted: Coefficients) -> Coefficients:
    """What an element adds, in the monomials of a term."""
    form = truth.form(share)
    return {} if form is None else {k: x for k, x in _coefficients(form).items() if k in wanted}
