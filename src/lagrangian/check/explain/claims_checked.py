"""What is said to be missing is absent, and what is said to be left out stood nowhere; else what is certain is said.

The terms with m g sin α of the weight of the bob are missing     not where m g l sin θ sin α is written: not all are
                                                                  there, m g x sin α is missing
In what the rider adds to the equation of β, R is left out        not where the terms with R are: they are missing
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.term_said import parted
from lagrangian.check.explain.without_energies import WHOLE
from lagrangian.check.verdict import Finding, Mistake, Status, TermDifference, Verdict
from lagrangian.page.formula import Left, Verbatim, text
from lagrangian.records import dataclass

Parts: TypeAlias = "Sequence[str | Verbatim | Left]"
NO_GRAVITY, NONE = "gravity_forgotten", "Gravity is missing"
"""The name of what is said of missing weights, and how it begins where all are."""
MOST_TERMS = 200
"""The most terms of a line that are searched."""
MOST_LISTED = 3
"""The most terms that are said to be missing in one sentence."""
_BEFORE = re.compile(r"[Tt]he terms with \Z")
"""What stands before the factor of terms."""
_BEHIND = re.compile(r" of (?P<of>.{1,120}?) are missing\.\Z")
"""What stands behind it."""
_KINDS = {"the kinetic energy": ("T", "L"), "the weight": ("V", "L"), "the energy": ("V", "L")}
"""The lines in which terms of such a part stand."""
_ADDS = re.compile(r"In what [^,]{1,100} adds? to the equation of \Z")
"""How words begin that speak of what an element adds to an equation."""
_OF_ENERGY = re.compile(r"In the (?:kinetic energy|weight) of ")
_SIGN = re.compile(r"has the wrong sign\.?\Z")


@dataclass(frozen=True)
class _MissingTerms:
    """That terms with a factor, of a part of an energy, are missing."""

    factor: sp.Expr
    of: str


def with_claims_checked(verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, with mistakes that say no more than what its lines show."""
    if verdict.status is not Status.WRONG or verdict.hint == 0:
        return verdict
    mistakes = tuple(
        _checked(_without_untrue_reason(m, verdict), verdict)
        for m in verdict.mistakes
        if not (m.name == NO_GRAVITY and str(m.what).startswith(NONE) and _one_weight_lacks(verdict.mistakes, m))
    )
    others = tuple(m for m in verdict.alternatives if _checked(m, verdict) is m and not _is_idle(m, verdict))
    return replace(verdict, mistakes=mistakes, alternatives=others)


def _checked(mistake: Mistake, verdict: Verdict) -> Mistake:
    """A mistake as far as it is true."""
    parts = mistake.what.parts
    claim = _claim(parts)
    if claim is not None and _is_there(verdict, claim):
        lacking = _lacking(verdict, claim.factor)
        head = ("Not all terms with ", claim.factor, f" of {claim.of} are there")
        return replace(mistake, what=text(*head, *_listed(lacking), "."))
    if len(parts) != 5 or parts[2] != ", " or parts[4] != " is left out." or not _ADDS.match(str(parts[0])):
        return mistake
    letter = parts[3]
    differing = [d for _, d in _differing(mistake, verdict)]
    if not differing or not isinstance(letter, sp.Expr) or not all(_lacks_terms(d, letter) for d in differing):
        return mistake
    return replace(mistake, what=text(*parts[:3], "the terms with ", letter, " are missing."))


def _is_idle(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether a second choice is that something is in V, which is right, or says of one element more what a mistake
    says."""
    parts = mistake.what.parts
    if any(isinstance(x, str) and x.endswith(" is counted in ") for x in parts) and "V" in map(str, parts):
        stated = [f for f in verdict.findings if f.line.kind == "V"]
        return bool(stated) and all(f.status.right for f in stated)
    if str(parts[0]).startswith(f"In {WHOLE['V']}") and len(_elements(verdict)) == 1:
        return True  # of several, where one differs
    formulas = {x for x in parts if isinstance(x, sp.Expr)}
    coordinates = {x for x in formulas if isinstance(x, AppliedUndef)}
    return any(
        m.name == mistake.name
        and m.element is not None
        and m.element in str(mistake.what)
        and formulas - coordinates == {x for x in m.what.parts if isinstance(x, sp.Expr)} - coordinates
        for m in verdict.mistakes
    )


def _one_weight_lacks(mistakes: Sequence[Mistake], whole: Mistake) -> bool:
    """Whether another mistake says that one weight is missing: then the others are there."""
    return any(m is not whole and m.name == NO_GRAVITY and m.element == whole.element for m in mistakes)


def _elements(verdict: Verdict) -> set[str]:
    """The elements of which terms differ in lines that follow from none."""
    return {o.element for f in verdict.open_findings for d in f.differences for o in d.origins}


def _claim(parts: Parts) -> _MissingTerms | None:
    """What words say to be missing, if they say no more."""
    if len(parts) != 3 or not isinstance(parts[1], sp.Expr) or not _BEFORE.match(str(parts[0])):
        return None
    behind = _BEHIND.match(str(parts[2]))
    return _MissingTerms(parts[1], behind["of"]) if behind is not None else None


def _without_untrue_reason(mistake: Mistake, verdict: Verdict) -> Mistake:
    """A mistake without a possible reason that is not true, or that only says again what sign is wrong."""
    if (said := parted(mistake)) is None:
        return mistake
    certain, reason = said
    claim, why = _claim(reason.parts), str(reason)
    again = _SIGN.search(str(certain).rstrip()) and _SIGN.search(why) and _OF_ENERGY.match(why)
    if not again and (claim is None or not _is_there(verdict, claim)):
        return mistake
    return replace(mistake, what=certain)


def _is_there(verdict: Verdict, claim: _MissingTerms) -> bool:
    """Whether a wrong line has a term with the factor of terms that are said to be missing in a part of an energy."""
    kinds = next((kinds for words, kinds in _KINDS.items() if claim.of.startswith(words)), ())
    for f in verdict.findings:
        if f.status is Status.WRONG and f.line.kind in kinds:
            moving = "T" in kinds
            own = (t for t in _terms(f) if f.line.kind != "L" or t.has(sp.Derivative) == moving)
            if any(_has(t, claim.factor) for t in own):
                return True
    return False


def _terms(finding: Finding) -> Iterator[sp.Expr]:
    """The terms of a line, multiplied out."""
    yield from sp.Add.make_args(bounded.expand(finding.line.expr))[:MOST_TERMS]  # type: ignore[misc]


def _has(term: sp.Expr, factor: sp.Expr) -> bool:
    """Whether a term, or one of those that it is multiplied out, has all factors of another."""
    own: dict[sp.Expr, sp.Expr] = {x: e for x, e in _powers(factor).items() if not x.is_number}
    pieces = (_powers(piece) for piece in sp.Add.make_args(bounded.expand(term)))
    return any(all(x in there and (there[x] - e).is_nonnegative for x, e in own.items()) for there in pieces)


def _powers(product: sp.Basic) -> dict[sp.Expr, sp.Expr]:
    """The factors of a product with their exponents."""
    return dict(x.as_base_exp() for x in sp.Mul.make_args(product))  # type: ignore[union-attr]


def _lacks_terms(difference: TermDifference, letter: sp.Expr) -> bool:
    """Whether all that is missing has a letter, and nothing that is written in its place has it."""
    lacking = sp.Add.make_args(bounded.expand(difference.term - difference.written))
    return not _has(difference.written, letter) and all(_has(t, letter) for t in lacking)


def _lacking(verdict: Verdict, factor: sp.Expr) -> list[sp.Expr]:
    """The terms with a factor that the lines which follow from none lack."""
    found = [d.term for f in verdict.open_findings for d in f.differences if d.kind == "missing"]
    listed = list(dict.fromkeys(t for t in found if _has(t, factor)))
    return listed if len(listed) <= MOST_LISTED else []


def _listed(terms: Sequence[sp.Expr]) -> list[str | sp.Expr]:
    """Terms in a sentence that says that they are missing; nothing for none."""
    said: list[str | sp.Expr] = [": "] if terms else []
    for k, t in enumerate(terms):
        said += [t, " and " if k == len(terms) - 2 else ", " if k < len(terms) - 2 else ""]
    return [*said, f" {'is' if len(terms) == 1 else 'are'} missing"] if terms else []


def _differing(mistake: Mistake, verdict: Verdict) -> list[tuple[Finding, TermDifference]]:
    """The terms that differ in the equation of a mistake, in lines that follow from none, from its element."""
    every = [(f, d) for f in verdict.open_equations for d in f.differences]
    return [(f, d) for f, d in every if mistake.element is None or mistake.element in {o.element for o in d.origins}]
