"""Tells a term as the answer has it: (½ M + m) g s cos θ as it stands there, and not g (½ M a + ½ M b + …) cos θ.

"In the term …" is told of the term that stands in the answer: m r Ω² cos ψ, and not m r Ω² sin ψ in its place.
Mistakes are found in terms of the right equations, which have the signs and the factors of our own form; what differs
is compared with what was written.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.sides_said import THE_TERM
from lagrangian.check.explain.term_said import OF_A_SUM
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.terms.sides import differs
from lagrangian.check.verdict import Finding, Mistake, TermDifference, Verdict
from lagrangian.page.formula import Left, Verbatim, text

ENERGIES = {"T": 2, "V": 3}
"""The step in which each energy is written down."""
IN_PLACE = " stands in place of "
SINGLE = ("missing", "sign")
"""The kinds of differences that say all of a letter that is left out of a sum, or has the other sign there."""
CONTRIBUTES = " contributes"
"""What is said of a moment of inertia, of which more is known than its letter."""
LONGEST = 120
"""A term with more operations is told as it is."""
OPENINGS = ("In the term ", "in the term ")
"""How the words end behind which the right term of a difference stands."""
TOLD = (THE_TERM, THE_TERM.lower(), " should be ", " stands where ")
"""How the words end after which a term is told."""
SIGN = 1
"""How many more operations a term may have with the sums of what is written."""


def with_terms_as_written(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict, in which sentences on what is wrong in a term name it as it stands in a wrong line."""
    roots = verdict.open_findings
    differences = [d for f in roots for d in f.differences if d.written != 0 and d.kind not in ("missing", "extra")]
    if not differences:
        return verdict
    told, others = (tuple(_quoted(truth, m, differences) for m in x) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, mistakes=told, alternatives=others)


def _quoted(truth: Reference, mistake: Mistake, differences: Sequence[TermDifference]) -> Mistake:
    """A mistake whose first term is the right one of a difference, with the one that was written."""
    first, *more = mistake.what.parts
    term = more[0] if more else None
    if not (isinstance(first, str) and first.endswith(OPENINGS) and isinstance(term, sp.Expr)):
        return mistake
    own = [d for d in differences if mistake.coordinate in (None, d.coordinate)]
    signs = (sp.S.One, sp.S.NegativeOne)
    if any(zero_everywhere(truth, d.written - s * term) for d in differences for s in signs):
        return mistake
    found = [cast("sp.Expr", s * d.written) for d in own for s in signs if zero_everywhere(truth, d.term - s * term)]
    return replace(mistake, what=text(first, found[0], *more[1:])) if len(found) == 1 else mistake


def with_terms_as_they_stand(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict, with the terms of its mistakes in the form in which they are written where they differ."""
    roots = [f for f in verdict.open_findings if f.differences]
    if not roots:
        return verdict
    told = (tuple(_told(truth, m, roots) for m in every) for every in (verdict.mistakes, verdict.alternatives))
    mistakes, others = told
    return replace(verdict, mistakes=mistakes, alternatives=tuple(m for m in others if m not in mistakes))


def without_shared_signs(verdict: Verdict) -> Verdict:
    """The verdict, in which cos θ stands in place of sin θ, and not −cos θ in place of −sin θ."""
    mistakes, others = (tuple(map(_unsigned, x)) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, mistakes=mistakes, alternatives=others)


def _told(truth: Reference, mistake: Mistake, roots: Sequence[Finding]) -> Mistake:
    """A mistake with the one term that differs in an energy, or with the terms of its sentence as they stand."""
    energies = [f for f in roots if ENERGIES.get(f.line.kind) == mistake.step]
    if _is_of_letter(mistake) and len(energies) == 1 and len(energies[0].differences) == 1:
        (d,) = energies[0].differences
        if d.kind in SINGLE:
            return replace(mistake, what=text(f"In {energies[0].line.title}, ", *differs(d), "."))
    return replace(mistake, what=text(*_as_they_stand(truth, mistake, [d for f in roots for d in f.differences])))


def _is_of_letter(mistake: Mistake) -> bool:
    """Whether all that is said is that a letter is left out of terms, or has the other sign there."""
    formulas = [x for x in mistake.what.parts if not isinstance(x, str)]
    alone = len(formulas) == 1 and isinstance(formulas[0], sp.Symbol)
    return mistake.name in OF_A_SUM and alone and CONTRIBUTES not in str(mistake.what)


def _as_they_stand(
    truth: Reference, mistake: Mistake, every: Sequence[TermDifference]
) -> Iterator[str | Left | Verbatim]:
    """The words of a mistake, with the terms that differ in the form of the answer."""
    before: str | Left | Verbatim = ""
    for part in mistake.what.parts:
        after_term = isinstance(before, str) and before.endswith(TOLD)
        yield _form(truth, part, every) if after_term and isinstance(part, sp.Expr) else part
        before = part


def _form(truth: Reference, term: sp.Expr, every: Sequence[TermDifference]) -> sp.Expr:
    """A term as it is written where it differs, or as it should be there; as it is if it is none of these."""
    if term.is_Atom or bounded.operations(term) > LONGEST:
        return term
    letters, longest = truth.expand(term).free_symbols, bounded.operations(term)
    own = [(d.written, SIGN) for d in every if d.written != 0]
    own += [(d.term, SIGN if d.term.atoms(sp.Add) <= d.written.atoms(sp.Add) else -1) for d in every]
    for x in (x for x, more in own if x != term and bounded.operations(x) <= longest + more):
        if truth.expand(x).free_symbols == letters and zero_everywhere(truth, truth.expand(cast("sp.Expr", x - term))):
            return x
    return term


def _unsigned(mistake: Mistake) -> Mistake:
    """A mistake without the sign that two functions have of which one stands in place of the other."""
    parts = list(mistake.what.parts)
    for k, part in enumerate(parts[1:-1], start=1):
        pair = parts[k - 1], parts[k + 1]
        if part != IN_PLACE or not all(isinstance(x, sp.Mul) and x.args[0] == -1 for x in pair):
            continue
        one, other = (-cast("sp.Expr", x) for x in pair)
        if isinstance(one, (sp.sin, sp.cos)) and isinstance(other, (sp.sin, sp.cos)):
            parts[k - 1], parts[k + 1] = one, other
    return replace(mistake, what=text(*parts))
