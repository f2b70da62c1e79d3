"""Tells a factor 2 of a term that stands once by the ½ that is lost in it: it is counted once, with twice its value.
So is one of which nothing says where the 2 comes from: not an element that is counted twice, but perhaps another arm.

D = b ẋ²               The ½ of damper 'b' in D is missing.
m g R for ½ m g R      The weight of the block stands with twice its value: m g R should be ½ m g R.
2 F b                  Force 'F' stands with twice its value: 2 F b should be F b.
k (x − R θ)            k (x − R θ) should be k (x − ½ R θ): one term of the bracket has twice its value
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.spoken import in_dissipation
from lagrangian.check.explain.without_energies import silent_energies
from lagrangian.check.reading.answer import Summands
from lagrangian.check.terms.sides import on_side
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, TermDifference, Verdict
from lagrangian.page.formula import text

COUNTED, COUNTS, HALVED = " is counted twice", " counts twice", "damper_half"
TWICE = " stands with twice its value"
WHY_LOST = text(
    "A ½ is lost: look for it in the arm, in how far its end moves with the coordinate, and before a square."
)
WHY_DOUBLED = text(
    "Look for the 2: an arm may be another, as the whole length for half of it, or the same may act at two places."
)
WHY_BRACKET = text("Put in once more what moves with this coordinate: how far does each end move?")
WHY_DAMPER = text("A damper pulls with its constant times its rate, and its force counts as far as its end moves.")


def with_twice_said(lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict, in which what stands once with twice its value is not said to be counted twice."""
    roots = verdict.open_findings
    places = [(f, d) for f in roots for d in f.differences if d.kind == "coefficient"]
    if not places:
        return verdict
    silent = len(silent_energies(lines)) == 2 and not any(x.kind in ("D", "Xi") for x in lines)
    told = tuple(_said(m, places, silent=silent) for m in verdict.mistakes)
    others = tuple(_said(m, places, silent=silent) for m in verdict.alternatives)
    return replace(verdict, mistakes=told, alternatives=others)


def _said(mistake: Mistake, places: Sequence[tuple[Finding, TermDifference]], *, silent: bool) -> Mistake:
    """A mistake in words that fit how often its term stands in the answer."""
    own = [
        (f, d) for f, d in places if _is_of(mistake, f, d) and f.coordinate in (mistake.coordinate, None, d.coordinate)
    ]
    if mistake.name == HALVED:
        return _halved(mistake, own) if silent else mistake
    if mistake.name == "element_twice":
        return _doubled(mistake, own)
    if not own or not all(_lost_half(f.line, d) for f, d in own):
        return mistake
    finding, difference = own[0]
    if finding.line.kind == "D" and (said := in_dissipation(mistake)) is not mistake:
        return said
    first, *more = mistake.what.parts
    counts = [k for k, x in enumerate(more) if isinstance(x, str) and x.endswith(f"{COUNTS}.")]
    if not (first == "The term " and counts and more and isinstance(more[0], sp.Expr)):
        return mistake
    sign = _sign(difference.term, more[0])
    if not sign:
        return mistake
    if (bracket := _bracket(finding.line, difference)) is not None:
        where = text(f"In {finding.line.title}, ", bracket[0], " stands where ", bracket[1], " belongs.")
        return replace(mistake, what=where, why=WHY_BRACKET)
    end = cast("str", more[counts[0]]).removesuffix(f"{COUNTS}.")
    words = (*more[1 : counts[0]], f"{end}{TWICE}: it should be ", more[0], *more[counts[0] + 1 :], ".")
    return replace(mistake, what=text(first, 2 * more[0], *words))


def _doubled(mistake: Mistake, own: Sequence[tuple[Finding, TermDifference]]) -> Mistake:
    """An element that stands with twice its value in terms that stand once: why is open, the arm may be another."""
    first, *more = mistake.what.parts
    if not own or not isinstance(first, str) or COUNTED not in first or not all(_is_doubled(f.line, d) for f, d in own):
        return mistake
    finding, difference = own[0]
    lost = all(_lost_half(f.line, d) for f, d in own)
    if lost and finding.line.kind == "D" and (said := in_dissipation(mistake)) is not mistake:
        return said
    place = [x.rstrip(".") if isinstance(x, str) else x for x in more]
    begin, _, of = first.rstrip(".").partition(COUNTED)
    what = text(begin, TWICE, of, *place, ": ", *_pair(finding, difference), ".")
    return replace(mistake, what=what, why=WHY_LOST if lost else WHY_DOUBLED)


def _halved(mistake: Mistake, own: Sequence[tuple[Finding, TermDifference]]) -> Mistake:
    """What a damper adds half of, where no D and no Ξ is written."""
    if len(own) != 1 or bounded.expand(own[0][1].term - 2 * own[0][1].written) != 0 or mistake.element is None:
        return mistake
    title = f"{mistake.element[:1].upper()}{mistake.element[1:]}"
    return replace(mistake, what=text(title, " stands with half its value: ", *_pair(*own[0]), "."), why=WHY_DAMPER)


def _pair(finding: Finding, difference: TermDifference) -> tuple[sp.Expr, str, sp.Expr]:
    """What stands and what should, on its side of the line."""
    _, said = on_side(finding.line, difference)
    return said.written, " should be ", said.term


def _is_of(mistake: Mistake, finding: Finding, difference: TermDifference) -> bool:
    """Whether a term that differs comes from the element of a mistake alone."""
    if finding.line.kind == "D" and mistake.step == 6 and not difference.origins:
        return len(finding.differences) == 1
    return [o.element for o in difference.origins] == [mistake.element]


def _lost_half(line: AnsweredLine, d: TermDifference) -> bool:
    """Whether a term stands once, with twice its value, without a 2 that the right one lacks."""
    right, own = (cast("sp.Rational", x.as_coeff_Mul()[0]) for x in (d.term, d.written))
    return bool(right.is_Rational and own == 2 * right and right.q % 2 == 0) and _is_doubled(line, d)


def _is_doubled(line: AnsweredLine, d: TermDifference) -> bool:
    """Whether a term stands once, with twice its value."""
    return bounded.expand(d.written - 2 * d.term) == 0 and _count(line.summands, d.written) < 2


def _count(listed: Summands, written: sp.Expr) -> int:
    """In how many terms, as they are written, the letters of a term stand together."""
    letters = bounded.letters(written)
    products = [{x for f in product for x in bounded.letters(f)} for term in listed for product in term[-1:]]
    return sum(letters == own for own in products)


def _sign(right: sp.Expr, term: sp.Expr) -> int:
    """The sign with which a right term is another one; 0 if it is not."""
    return next((s for s in (1, -1) if bounded.expand(right - s * term) == 0), 0)


def _bracket(line: AnsweredLine, d: TermDifference) -> tuple[sp.Expr, sp.Expr] | None:
    """The product with a bracket, as it is written, in which one term has twice its value, and the right product."""
    found = list(_brackets(line.summands, d))
    return found[0] if len(found) == 1 else None


def _brackets(listed: Summands, d: TermDifference) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    for whole, *inner in listed:
        if not any(bounded.expand(sp.Mul(*x) - d.written) == 0 for x in inner):
            continue
        sums = [f for f in whole if isinstance(f, sp.Add)]
        if len(sums) == 1:
            others = sp.Mul(*(f for f in whole if f is not sums[0]))
            right = _corrected(sums[0], others, d)
            others = -others if others.could_extract_minus_sign() else others
            yield others * sums[0], others * right


def _corrected(bracket: sp.Add, others: sp.Expr, d: TermDifference) -> sp.Expr:
    """A bracket with the right term in it, where ``others`` are the factors before it."""
    held = [t for t in bracket.args if _is_same(t * others, d.written)]
    right = bounded.cancel(d.term / others)
    return cast("sp.Expr", sp.Add(*(right if t in held else t for t in bracket.args)))


def _is_same(one: sp.Expr, other: sp.Expr) -> bool:
    return bounded.expand(one - other) == 0
