"""The last gate before a mistake is told: nothing that the lines of the answer refute.

A mistake that leads to the same equations may not be what was done. It is refuted if it blames a line that is right, or
a quantity that a right line states, or if it says that something which is written is wrong where terms are only
missing. Then another mistake that explains as much is told or, if there is none, the terms that differ.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.certain_first import MOST, with_certain_terms
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.second_choices import (
    MADE_IN,
    SECOND,
    STATED,
    is_of_what_is_there,
    is_stated,
    right_notes,
)
from lagrangian.check.explain.spoken import in_lagrangian
from lagrangian.check.explain.term_said import REASON, parted
from lagrangian.check.explain.terms_alone import MOST_TOLD, term_mistake, with_terms_of_own_forces
from lagrangian.check.terms.pieces import partner
from lagrangian.check.terms.sides import WRONG_SIGN
from lagrangian.check.verdict import DERIVED, IS_MISSING, Finding, Mistake, Status, TermDifference, Verdict
from lagrangian.model import time
from lagrangian.page.formula import text

COUNTING = ("element_forgotten", "gravity_forgotten", "translation_forgotten", "rotation_forgotten", "element_twice")
"""Names of mistakes by which one of several equal bodies counts no time or twice."""
HALF = ("half_forgotten", "spring_half_forgotten")
"""Names of mistakes by which there is no ½ in an energy."""
SIGNS = ("spring_sign", "gravity_sign")
"""Names of mistakes in the sign of an energy."""
OF_LETTERS = (
    "not_squared",
    "squared",
    "lost",
    "letter",
    "exchanged",
    "factor_missing",
    "divided_by",
    "divisor_missing",
)
"""Names of mistakes in the powers of letters and rates."""
OF_NUMBERS = ("wrong_number", "factor_of_a_term")
"""Names of mistakes in a number."""
WHY_DOUBLE = text("T* has the square of a whole velocity, and (a + b)² has the double product 2 a b, too.")
WHY_DOUBLE_V = text("V has the square of a whole deflection, and (a − b)² has the double product −2 a b, too.")
WHY_DERIVED = text("Differentiate it once more, term by term, with the inner derivatives.")
MADE_IN_STEPS = {2: ("T", "kinetic"), 3: ("V", "potential")}
"""The kind of the line that states what is made in a step, and which energies its parts are."""
ARMS = ("force_arm", "damper_arm", "gravity_arm")
"""Names of mistakes in what multiplies a force that is there."""
STANDS = " stands once"
"""What is said of what is there."""
SAID = ("definition", "identity")
"""Lines that say what a quantity is."""
NOT = ", not "
"""What stands between what is right and what is written."""
BESIDE = (NOT, " is not ", " should be ", " stands where ")
"""What stands between what is written and what belongs there, in either order."""
EITHER = " or "
"""What stands between the names of several equal bodies in one of which a mistake is."""
_BLAMES = re.compile(r"(?:Line|In line) (?P<number>\d+)\b")
"""How words begin that blame a line."""
_OF_ENERGY = re.compile(r"\b(?:in V|energy|height|position)\b")
"""What words on V say, and words on an equation do not."""
_OF_AN_ENERGY = re.compile(r"\b(?:[Ii]n|of) (?:the )?(?:V|T\*|ℒ|(?:kinetic |potential )?energy)\b|\bof the height\b")
"""What words say that speak of a mistake in an energy."""
_IN_A_DERIVATIVE = re.compile(r"∂|d/dt|\bequations?\b|\b[Ll]ine \d")
"""What words say on a derivative of it, or on a line."""
_TAKEN = re.compile(r"The (?P<what>[^:,.]{1,60} of [^:,]{1,60}'[^']{1,60}') (?:is|are) taken as ")
"""How words begin that blame a quantity."""


def told_truly(verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, with mistakes that no line refutes."""
    if verdict.status is not Status.WRONG or verdict.hint == 0 or not verdict.mistakes:
        return verdict
    return with_certain_terms(with_terms_of_own_forces(_unrefuted(verdict)))


def _unrefuted(verdict: Verdict) -> Verdict:
    """The verdict with mistakes that its lines do not refute, each once."""
    mistakes = [_of_lagrangian(_without_refuted_reasons(m, verdict), verdict) for m in verdict.mistakes]
    refuted = [_is_refuted(m, verdict) for m in mistakes]
    possible = tuple(m for m in verdict.alternatives if not _is_refuted(m, verdict))
    if not any(refuted):
        return replace(verdict, mistakes=tuple(_once(mistakes, verdict)), alternatives=possible)
    either = set((mistakes[0].element or "").split(EITHER)) if EITHER in (mistakes[0].element or "") else set[str]()
    others = [m for m in possible if m.element not in either]
    kept: list[Mistake] = []
    for k, (m, false) in enumerate(zip(mistakes, refuted, strict=True)):
        if not false:
            kept.append(m)
        elif k == 0 and others:
            kept.append(others[0])
        else:
            why = WHY_DOUBLE_V if _is_there(m, verdict) else m.why if m.name in ARMS else None
            kept += [x if why is None else replace(x, why=why) for x in _terms_of(m, verdict)]
    told = tuple(_once(kept, verdict))
    texts = {str(m.what) for m in told}
    return replace(verdict, mistakes=told, alternatives=tuple(m for m in others if str(m.what) not in texts))


def _once(mistakes: Sequence[Mistake], verdict: Verdict) -> Iterator[Mistake]:
    """The mistakes without those that say again what is not what it should be, ẏ is −r φ̇ sin φ, not −r φ̇ cos φ, and
    without those in an equation that only follows from wrong lines."""
    told = set[object]()
    for k, m in enumerate(mistakes):
        parts = m.what.parts
        pair = next(((a, b) for a, x, b in zip(parts, parts[1:], parts[2:], strict=False) if x == NOT), None)
        said = {str(m.what), pair} - {None}
        if k and (said & told or _only_follows(m, verdict) or any(_says_again(m, x) for x in mistakes[:k])):
            continue
        told |= said
        yield m


def _says_again(mistake: Mistake, said: Mistake) -> bool:
    """Whether a mistake sets the same sum right as a line above that is not right: y − r φ, not y + r φ."""
    if not _BLAMES.match(str(said.what)) or mistake.element is None or mistake.element != said.element:
        return False
    own, theirs = (
        {y for x in m.what.parts if isinstance(x, sp.Expr) for y in x.atoms(sp.Add)} for m in (mistake, said)
    )
    return len(own) > 1 and all(x in theirs or -x in theirs for x in own)


def _only_follows(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether the equation in which a term is said to be wrong needs no correction of its own."""
    if mistake.coordinate is None or not str(mistake.what).startswith(("The term ", "In line ")):
        return False
    wrong = [f for f in verdict.findings if f.coordinate == mistake.coordinate and f.status is Status.WRONG]
    return bool(wrong) and all(f.follows for f in wrong)


def _is_refuted(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether the lines of an answer speak against a mistake."""
    said = str(mistake.what)
    if _says_nothing(mistake) or _is_there(mistake, verdict):
        return True
    if (blamed := _BLAMES.match(said)) is not None:
        own = [f for f in verdict.findings if f.line.number == int(blamed["number"])]
        return bool(own) and all(f.status.right for f in own)
    if _is_of_right_slope(mistake, verdict) or _is_of_numbers(mistake, verdict) or _has_its_sign(mistake, verdict):
        return True
    if _is_of_one_in_a_sum(mistake, verdict):
        return True
    if mistake.name in HALF and any(_has_its_half(f, d) for f, d in _differing(mistake, verdict)):
        return True
    if (
        EITHER in (mistake.element or "")
        and mistake.name not in COUNTING
        and len(_differing(mistake, verdict)) <= MOST_TOLD
    ):
        return True  # which of several equal bodies moves otherwise than the others is written nowhere
    return parted(mistake) is None and _is_refuted_reason(mistake, verdict)


def _says_nothing(mistake: Mistake) -> bool:
    """Whether the same is written as belongs there: 14400 sin θ cos θ should be 14400 sin θ cos θ."""
    parts = mistake.what.parts
    pairs = ((a, b) for a, x, b in zip(parts, parts[1:], parts[2:], strict=False) if x in BESIDE)
    return any(isinstance(a, sp.Expr) and isinstance(b, sp.Expr) and bounded.expand(a - b) == 0 for a, b in pairs)


def _of_lagrangian(mistake: Mistake, verdict: Verdict) -> Mistake:
    """A mistake in an energy that the answer states right, as one that is made in ℒ, where the answer goes wrong."""
    if mistake.step not in MADE_IN_STEPS or {f.line.kind for f in verdict.open_findings} != {"L"}:
        return mistake
    kind, part = MADE_IN_STEPS[mistake.step]
    told = [f for f in verdict.findings if f.line.kind == kind]
    parts = [x for x in right_notes(verdict) if f"{part} energy of" in x and (mistake.element or "?") in x]
    if not (parts or told) or not all(f.status.right for f in told):
        return mistake
    return in_lagrangian(replace(mistake, brief=None), verdict.open_findings[0].line)


def _is_there(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether a letter is said to be missing that stands in a constant term of the wrong V or ℒ, as ½ k s₀² without
    the double product of (s − s₀)²."""
    lacking = str(mistake.what).endswith(f"{IS_MISSING}.")
    letters = {x for x in mistake.what.parts if isinstance(x, sp.Symbol)} if lacking else set[sp.Symbol]()
    wrong = [f.line for f in verdict.open_findings if f.line.kind in ("V", "L")]
    terms = (x for line in wrong for x in sp.Add.make_args(bounded.expand(line.expr)))
    constants = (x for x in terms if not x.has(AppliedUndef, time))
    return any(letters & x.free_symbols for x in constants)


def _is_of_right_slope(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether V is said to be wrong beside right ∂ℒ/∂ξ of all coordinates whose equations are wrong."""
    wrong = verdict.open_findings
    roots = {f.coordinate for f in wrong if f.line.kind == "equation"}
    right = {f.line.name for f in verdict.findings if f.line.kind == "slope" and f.status.right}
    others = any(f.line.kind != "equation" for f in wrong)
    said = _OF_ENERGY.search(str(mistake.what)) is not None
    return mistake.step == 3 and said and bool(roots) and not others and roots <= right


def _is_of_numbers(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether a power or a letter is said to be wrong where one number of an equation without parameters is."""
    wrong = verdict.open_findings
    differing = [d for f in wrong for d in f.differences]
    if mistake.name not in OF_LETTERS or len(differing) != 1 or differing[0].kind != "coefficient":
        return False
    return not any(f.line.expr.free_symbols - {time} for f in wrong)


def _is_of_one_in_a_sum(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether a number is said to be wrong that one of several elements has, where a line in numbers has their sum."""
    told = _differing(mistake, verdict) if mistake.name in OF_NUMBERS else []
    summed = (d.kind == "coefficient" and len({o.element for o in d.origins}) > 1 for _, d in told)
    return bool(told) and all(summed) and not any(f.line.expr.free_symbols - {time} for f, _ in told)


def _has_its_sign(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether a sign of V is said to be wrong where V has the terms of this element with their signs, and sin² in
    place of cos²: that is the same but for a constant, and it is not what was written."""
    if mistake.name not in SIGNS:
        return False
    told = [d for f, d in _differing(mistake, verdict) if f.line.kind == "V"]
    return bool(told) and all(d.kind == "coefficient" and _turned(d) for d in told)


def _turned(difference: TermDifference) -> bool:
    """Whether a term has the sine of what should be the cosine, or the other way, and is else as it should be."""
    functions = difference.term.atoms(sp.sin, sp.cos)
    return bool(functions) and difference.written == difference.term.xreplace({x: partner(x) for x in functions})


def _has_its_half(finding: Finding, difference: TermDifference) -> bool:
    """Whether a term that is twice what it should be was written with its ½: 2·½ k s²."""
    letters = letters_in(difference.written)
    for ways in finding.line.summands:
        for factors in ways:
            halved = any(x.is_Rational and x.q % 2 == 0 for x in factors)  # type: ignore[attr-defined]
            if halved and letters_in(sp.Mul(*factors)) == letters and difference.written == 2 * difference.term:
                return True
    return False


def _is_of_right_quantity(said: str, verdict: Verdict) -> bool:
    """Whether a sentence blames a quantity that a right line states."""
    notes = right_notes(verdict)
    if (made := MADE_IN.match(said)) is not None:
        return is_stated(made[0], notes)
    taken = _TAKEN.match(said)
    return taken is not None and f"the {taken['what']}" in notes


def _without_refuted_reasons(mistake: Mistake, verdict: Verdict) -> Mistake:
    """A mistake without the possible reasons that the lines refute: the term is certain, the reasons are not."""
    if (said := parted(mistake)) is None:
        return mistake
    certain, reason = said
    reasons: list[list[Any]] = [[]]
    for x in reason.parts:
        if x == SECOND:
            reasons.append([])
        else:
            reasons[-1].append(x)
    kept = [x for x in reasons if not _is_refuted_reason(replace(mistake, what=text(*x)), verdict)]
    if len(kept) == len(reasons):
        return mistake
    behind = [x for parts in kept for x in (SECOND, *parts)]
    return replace(mistake, what=text(*certain.parts, REASON, *behind[1:]) if behind else certain)


def _is_refuted_reason(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether the lines of an answer speak against words that are a reason, or the whole mistake."""
    said = str(mistake.what)
    if _is_of_right_quantity(said, verdict) or _is_of_right_sign(mistake, verdict):
        return True
    claims = STANDS in said or mistake.name in ARMS or is_of_what_is_there(mistake)
    return (claims and _only_lacks(mistake, verdict)) or _is_of_right_energy(mistake, verdict)


def _is_of_right_sign(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether the sign of a piece of a velocity or of a way is said to be wrong that has one sign in all lines, and in
    a right one."""
    parts = mistake.what.parts
    pairs = pairwise(parts)
    pieces = [x for x, behind in pairs if isinstance(x, sp.Expr) and str(behind).startswith(WRONG_SIGN)]
    if len(pieces) != 1 or MADE_IN.match(str(mistake.what)) is None:
        return False
    (piece,) = pieces
    every = {x for f in verdict.findings for x in _summands(f)}
    right = {x for f in verdict.findings if f.status.right and f.line.kind in SAID for x in _summands(f)}
    return (piece in right and -piece not in every) or (-piece in right and piece not in every)


def _summands(finding: Finding) -> Iterator[sp.Expr]:
    """The terms of a line, and those of the sums in it."""
    if finding.line.sides is not None and finding.line.kind == "identity":
        yield from sp.Add.make_args(finding.line.sides[1])  # type: ignore[misc]
    for ways in finding.line.summands[:MOST]:
        for factors in ways:
            yield sp.Mul(*factors)
            yield from (x for y in factors for z in y.atoms(sp.Add) for x in z.args)  # type: ignore[misc]


def _is_of_right_energy(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether a mistake is said to be in an energy that has all terms of its element, where the equations have not."""
    said = str(mistake.what)
    kinds = STATED.get(mistake.step)
    if kinds is None or mistake.element is None or _OF_AN_ENERGY.search(said) is None or _IN_A_DERIVATIVE.search(said):
        return False
    stated = [f for f in verdict.findings if f.line.kind in kinds]
    part = MADE_IN_STEPS[mistake.step][1]
    if not stated:
        return any(x.endswith(f"{part} energy of {mistake.element}") for x in right_notes(verdict))
    origins = [(f, [o for d in f.differences for o in d.origins]) for f in stated if not f.status.right]
    return all(
        f.differences and all(d.origins for d in f.differences) and mistake.element not in {o.element for o in own}
        for f, own in origins
    )


def _only_lacks(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether the lines in which a mistake shows lack terms, and differ in nothing else."""
    kinds = {d.kind for _, d in _differing(mistake, verdict)}
    open_ones = verdict.open_findings
    compared = {f.line.title for f in open_ones if f.differences}
    return kinds == {"missing"} and all(f.line.title in compared for f in open_ones)


def _differing(mistake: Mistake, verdict: Verdict) -> list[tuple[Finding, TermDifference]]:
    """The terms that differ in the lines that follow from none, and that come from the element of a mistake."""
    titles = set((mistake.element or "").replace(" and ", EITHER).split(EITHER))
    every = [(f, d) for f in verdict.open_findings for d in f.differences]
    return [(f, d) for f, d in every if mistake.element is None or titles & {o.element for o in d.origins}]


def _terms_of(mistake: Mistake, verdict: Verdict) -> list[Mistake]:
    """The terms that differ where a mistake was said to be, or what is certain of them if they are many."""
    terms = _differing(mistake, verdict) or _differing(replace(mistake, element=None), verdict)
    rows = [f.line.title for f in verdict.open_findings if f.line.kind in ("equation", "slope", *DERIVED)]
    if not terms and rows and _is_of_right_energy(mistake, verdict):
        said = f"The energy of {mistake.element} is right; what it adds to {' and '.join(rows)} is not."
        return [replace(mistake, name="terms_alone", what=text(said), why=WHY_DERIVED, step=5, brief=text(said))]
    if len(terms) <= MOST_TOLD:
        return [_term(f, d) for f, d in terms]
    titles = " and ".join(dict.fromkeys(f.line.title for f, _ in terms))
    said = f"In {titles}, the terms that come from {mistake.element} are not right."
    return [replace(mistake, name="terms_alone", what=text(said), brief=text(said))] if mistake.element else []


def _term(finding: Finding, difference: TermDifference) -> Mistake:
    """A term that differs, as a mistake; one that only has letters which are there is a double product."""
    told = term_mistake(finding, difference)
    double = finding.line.kind in ("T", "L") and difference.written == 0
    letters = letters_in(difference.term) <= letters_in(finding.line.expr)
    return replace(told, why=WHY_DOUBLE) if double and letters else told
