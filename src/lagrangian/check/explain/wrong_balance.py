"""Finds the one wrong line among balances of single bodies with unknown forces: that without which the others hold.

m z″ = m g − S₁ − S₂, J φ″ = (S₁ − S₂) a, …: k lines, linear in forces that the system has no names for. Along the right
motion there are forces with which all right lines hold. If there are none for all k lines, but for all without one of
them, then this line is wrong, and the forces of the others tell which of its terms.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.balance_terms import Laws, Mend, mends, plainest
from lagrangian.check.explain.combined_rows import WrongTerm, difference, is_mass, term_to_blame
from lagrangian.check.explain.either_sign import sign_in_one_of_two
from lagrangian.check.explain.known_forces import KnownPart, known_parts, right_laws, weighs, with_wrong_law
from lagrangian.check.explain.pieces_shared import wrong_share
from lagrangian.check.explain.reaction_not_drawn import with_reaction
from lagrangian.check.explain.right_balances import Judge, marked, with_right_balances
from lagrangian.check.explain.solved import NAME as SOLVED
from lagrangian.check.explain.solved_forces import (
    Balances,
    balances_of,
    hold,
    is_true,
    left_out,
    place_of,
    primes_as_names,
    used_elsewhere,
    without_derived,
)
from lagrangian.check.explain.terms_alone import LEFT_OVER, term_mistake, with_terms_of_a_balance
from lagrangian.check.explain.two_wrong_balances import with_second_balance
from lagrangian.check.held import held
from lagrangian.check.lines import filled
from lagrangian.check.names.own_accelerations import own_accelerations
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict
from lagrangian.derive.sampling import Array
from lagrangian.errors import ParseError, listed
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.read.letters import key
from lagrangian.records import dataclass

NAME = "wrong_balance"
"""The name of the mistake."""
MOST_TOLD = 3
"""The most lines of which one is said to be wrong."""
MOST_VALUES = 2
"""How often a force may be said: for each of two bodies between which it acts."""
MOST_TERMS = 2
"""The most terms of an equation above that are told."""
MOMENT = 0.4
"""By how much likelier an arm or a sign is wrong in a moment than in a sum of forces."""
WHY = text("Draw a free-body diagram of the body of this line: every force with its sign, every moment with its arm.")
WHY_APART = text("Draw a free-body diagram of each body: every force with its sign, every moment with its arm.")
WHY_SOLVED = text("The lines from which this was solved are right: solve them once more, term by term.")
ENERGIES = ("T", "V", "L")
"""Lines that an answer by Newton's laws does not have."""

ReadWithout: TypeAlias = Callable[[frozenset[int]], tuple[Sequence[AnsweredLine], Mapping[str, sp.Expr]]]
"""The lines of an answer without some, by number, and the symbols of the names in them that nothing says."""


def with_wrong_balance(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    verdict: Verdict,
    later: Sequence[AnsweredLine] = (),
    judge: Judge | None = None,
) -> Verdict:
    """The verdict on an answer by Newton's laws in which one line alone is wrong and the others are right, among these
    the forces of springs and dampers that have names.

    ``later`` lines were solved from them: if all balances are right, one of these may be wrong. ``judge`` judges
    other lines than these alone.
    """
    if verdict.status is not Status.WRONG or verdict.hint == 0 or any(x.kind in ENERGIES for x in lines):
        return verdict
    if (law := with_wrong_law(truth, lines, verdict)) is not None:
        return law
    on, lines = held(truth) if truth.derivation.multipliers else truth, primes_as_names(truth, lines)
    if on is None or (balances := balances_of(on, lines)) is None:
        return _without_reaction(truth, lines, verdict) or verdict
    if len(balances.forces) <= len(truth.derivation.multipliers):
        return verdict  # multipliers
    balances, derived = without_derived(on, balances, lines)
    later = (*later, *derived)
    parts = known_parts(truth, balances.lines, balances.forces, own_accelerations(truth.model, lines))
    solved = _one_blamed(on, balances, later, parts, right_laws(truth, lines))
    if solved is None:
        notes = (*(x for x in verdict.notes if not _is_of(x, balances)), _read(balances.forces))
        beside = with_right_balances(on, balances, lines, later, replace(verdict, notes=notes), judge)
        if beside is None and (sign := sign_in_one_of_two(on, balances)) is not None:
            verdict = replace(verdict, mistakes=(sign,), alternatives=(), sure=True)
        return _without_invented(balances, parts, verdict if beside is None else beside)
    every, k, line, false = range(len(balances.lines)), solved.k, solved.line, solved.false
    plain = solved.few or on is not truth or (solved.term is not None and solved.term.term.has(*balances.forces))
    blamed = Finding(
        line, Status.WRONG, differences=() if solved.term is None else (difference(on, solved.term, None),)
    )
    own = balances.lines
    causes = [own] if k is not None else [(*own[:i], *own[i + 1 :], line) for i in every]
    below = [x for x in lines if x.kind == "equation" and not x.expr.has(*balances.forces)]
    below = [x for x in below if bounded.expand(x.expr) != 0]  # l = r + s says what l is
    below += [x for x in false if x is not line]
    holds = np.any([hold(on, rows, balances.forces, below) for rows in causes], axis=0)
    follow = [x for x, follows in zip(below, holds, strict=True) if follows]
    used = used_elsewhere(balances, None if solved.term is None else solved.term.term)
    right = [x for x in (*used.lines, *later) if x is not line and x not in false]
    roots = {place_of(f.line) for f in verdict.open_findings}
    theirs = solved.known is not None or (solved.term is not None and solved.term.term.has(*balances.forces))
    plain &= theirs or k is None or k in parts or on is not truth
    if verdict.mistakes and roots == {place_of(line)} and not plain:
        return verdict  # it is explained, and no other line is called wrong
    notes = (*(x for x in verdict.notes if not _is_of(x, used)), *([_read(used.forces)] if used.forces else []))
    findings = marked(verdict.findings, right, [blamed], follow)
    why = None if solved.known is None else solved.known.why
    mistake = _mistake(blamed, WHY_SOLVED if k is None else why or WHY)
    if solved.term is None and solved.known is not None and solved.known.said is not None:
        title = None if solved.known.element is None else solved.known.element.title
        mistake = replace(mistake, what=solved.known.said, element=title)
    told = (*_above(findings, line), mistake)
    return replace(verdict, findings=findings, mistakes=told, alternatives=(), notes=notes, sure=True)


def _without_reaction(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict | None:
    """The verdict with the force that is missing in the balance of a body, and acts on another one; None if none is."""
    if (found := with_reaction(truth, lines, verdict)) is None:
        return None
    return replace(found[0], mistakes=(_mistake(found[1], WHY),), alternatives=(), sure=True)


def _above(findings: Sequence[Finding], line: AnsweredLine) -> list[Mistake]:
    """The mistakes in equations above a wrong balance that differ from right ones in few terms: nothing in it is their
    cause."""
    wrong = [f for f in findings if f.is_open and not f.clash]
    own = [f for f in wrong if f.line.kind == "equation" and f.line.number < line.number]
    few = [(f, d) for f in own if len(f.differences) <= MOST_TERMS for d in f.differences]
    return [replace(term_mistake(f, d), why=WHY) for f, d in few]


def balances_agree(truth: Reference, lines: Sequence[AnsweredLine]) -> bool:
    """Whether there are forces of the answer's own with which all its balances hold along the right motion."""
    on, lines = held(truth) if truth.derivation.multipliers else truth, primes_as_names(truth, lines)
    balances = None if on is None else balances_of(on, lines)
    return balances is not None and balances.solved(range(len(balances.lines))) is not None


OF_DERIVATIVES = frozenset(["coupling_forgotten", "gradient_forgotten", "product_rule"])
"""Mistakes of Lagrange's derivatives, in whatever words."""


@dataclass(frozen=True, eq=False)
class WrongBalance:
    """The line that is wrong, its place among the balances (None for a later one), the term of it that is, and the
    later lines that are; ``few``: its term alone tells it from others; ``known``: what it has wrong that is known."""

    k: int | None
    line: AnsweredLine
    term: WrongTerm | None
    false: tuple[AnsweredLine, ...] = ()
    few: bool = False
    known: KnownPart | None = None


def _without_invented(balances: Balances, parts: Mapping[int, KnownPart], verdict: Verdict) -> Verdict:
    """The verdict without explanations by Lagrange's derivatives, which an answer with balances has not; the lines that
    do not agree in their place.

    Where one of these was not judged or is called right, no other is blamed alone, but for a single term, or with an
    explanation beside one whose known ``parts`` are right.
    """
    told, others = (tuple(m for m in x if not _of_derivatives(m)) for x in (verdict.mistakes, verdict.alternatives))
    places = left_out(balances)
    apart = [balances.lines[i] for i in places] if 1 < len(places) <= MOST_TOLD else []
    wrong = {place_of(f.line) for f in verdict.findings if f.status is Status.WRONG}
    roots = {place_of(f.line) for f in verdict.open_findings}
    spared = [i for i in places if place_of(balances.lines[i]) not in wrong]
    doubtful = any(not told or i not in parts or not parts[i].right for i in spared)
    own = {place_of(x) for x in apart}
    plain = any(place_of(f.line) in own & roots and len(f.differences) == 1 for f in verdict.findings)
    alone = doubtful and bool(own & roots) and not (plain and not told)
    if told == verdict.mistakes and not alone:
        return verdict
    if apart and not told:
        verdict, told, others = replace(verdict, sure=True), (disagreeing(apart, balances.forces),), ()
    findings = marked(verdict.findings, (), [clashing(x, apart) for x in apart] if alone else (), ())
    verdict = replace(verdict, findings=findings, mistakes=told, alternatives=others)
    return verdict if told or places else with_terms_of_a_balance(verdict)


def disagreeing(apart: Sequence[AnsweredLine], forces: Sequence[sp.Basic]) -> Mistake:
    """That some lines do not hold together, with whatever forces."""
    titles = f"Lines {_listed(apart)}"
    names = [cast("sp.Expr", f) for f in forces if any(x.expr.has(f) for x in apart)]
    held = text(*[x for f in names for x in (f, ", ")][:-1])
    what = text(f"{titles}, which have ", *held.parts, ", do not agree: at least one of them is wrong.")
    return Mistake(NAME, what, WHY_APART, 5, brief=text(f"{titles} do not agree: at least one of them is wrong."))


def clashing(line: AnsweredLine, apart: Sequence[AnsweredLine]) -> Finding:
    """The finding of a line that does not agree with others."""
    others = [x for x in apart if x.number != line.number]
    return Finding(line, Status.WRONG, clash=f"line{'s' * (len(others) > 1)} {_listed(others)}" if others else "")


def _listed(lines: Sequence[AnsweredLine]) -> str:
    """The numbers of lines in words: 2, 3 and 5."""
    return listed([str(k) for k in sorted({x.number for x in lines})])


def _of_derivatives(mistake: Mistake) -> bool:
    """Whether a mistake is told in derivatives of energies, or is one of these."""
    return mistake.name in OF_DERIVATIVES or any(
        x in str(told) for told in (mistake.what, mistake.why) for x in ("∂L", "∂ℒ", "∂T", "T*")
    )


def _one_blamed(
    truth: Reference,
    balances: Balances,
    later: Sequence[AnsweredLine],
    parts: Mapping[int, KnownPart],
    named: Mapping[str, sp.Expr],
) -> WrongBalance | None:
    """The line that is wrong; None if it may be several, and none of them would be right with a plain term.

    One with a known force that is wrong comes first; in one whose known ``parts`` are right its own forces are wrong,
    or it lacks a force that others have by its name. ``named`` are the right laws of such.
    """
    every, apart = range(len(balances.lines)), left_out(balances)
    told = [i for i in every if i in parts and parts[i].said is not None and (not apart or i in apart)]
    laws = [_laws_in(balances, i, named) for i in every]
    told = [i for i in told if not (parts[i].shared and laws[i].here)]
    for i in told:
        u = balances.forces_without(i) if apart else None
        if u is not None and is_true(truth, balances.lines[i], truth.accelerations | u, parts[i].excess):
            values = truth.accelerations | u
            false = tuple(x for x in later if not is_true(truth, x, values))
            return WrongBalance(i, balances.lines[i], parts[i].term, false, few=True, known=parts[i])
    k = apart[0] if len(apart) == 1 else None
    rest = [i for i in every if i != k]
    if len(apart) <= 1 and balances.compared(rest) and (u := balances.solved(rest)) is not None:
        values = truth.accelerations | dict(zip(balances.forces, u.T, strict=True))
        false = [x for x in later if not is_true(truth, x, values)]
        if k is None and len(false) != 1:
            return None
        line = false[0] if k is None else balances.lines[k]
        term = term_to_blame(truth, line.expr, values)
        if term is None and (best := plainest({0: mends(truth, line.expr, values, balances.forces)})) is not None:
            term = best[1]
        return WrongBalance(k, line, term, tuple(false))
    listed: dict[int, list[Mend]] = {}
    given: dict[int, dict[sp.Basic, Array]] = {}
    for i in apart:
        if (u := balances.forces_without(i)) is not None:
            given[i] = truth.accelerations | u
            found = mends(truth, balances.lines[i].expr, given[i], list(u), laws[i])
            if (part := parts.get(i)) is not None and part.right:
                found = [m for m in found if _may_be(truth, part, m.term, balances.forces)]
            if part is not None and part.moment and all(j in parts for j in apart):
                found = [replace(m, cost=m.cost - MOMENT) for m in found]
            listed[i] = found
    if (best := plainest(listed)) is None:
        share = wrong_share(truth, balances) if len(apart) > 1 else None
        if share is not None and (u := balances.forces_without(share[0])) is not None:
            false = tuple(x for x in later if not is_true(truth, x, truth.accelerations | u))
            return WrongBalance(share[0], balances.lines[share[0]], share[1], false, few=True)
        i = next((i for i in told if not parts[i].tentative), None)
        return None if i is None else WrongBalance(i, balances.lines[i], parts[i].term, few=True, known=parts[i])
    i, term = best
    false = tuple(x for x in later if not is_true(truth, x, given[i]))
    return WrongBalance(i, balances.lines[i], term, false, few=True)


def _laws_in(balances: Balances, i: int, named: Mapping[str, sp.Expr]) -> Laws:
    """The right laws that a line has by name, those that only others have, and the stiffnesses only in others."""
    own = balances.lines[i].names
    used = set[str]().union(*(x.names for x in balances.lines))
    here, elsewhere = (tuple(x for name, x in named.items() if name in some) for some in (own, used - own))
    letters = [bounded.letters(x.expr) for x in balances.lines]
    return Laws(here, elsewhere, frozenset(set[sp.Basic]().union(*letters) - letters[i]))


def _may_be(truth: Reference, part: KnownPart, wrong: WrongTerm, forces: Sequence[sp.Basic]) -> bool:
    """Whether a term may be wrong in a line whose known forces are right: one with forces of the answer's own."""
    return wrong.term.has(*forces) or (wrong.factor == sp.oo and part.may_lack(truth, wrong.term))


def with_forces_of_below(
    truth: Reference, lines: Sequence[AnsweredLine], read: ReadWithout, verdict: Verdict, judge: Judge | None = None
) -> Verdict:
    """The verdict on an answer with forces that it says itself, S₁ = m g − m z″ − S₂, above or below other balances.

    Such a line is one of the balances if no other above it has the force, or if the balance that it was solved from
    stands in it; otherwise it was solved from these.
    """
    if verdict.status is not Status.WRONG or any(x.kind in ENERGIES for x in lines):
        return verdict
    definitions = all(f.line.kind == "definition" for f in verdict.open_findings)
    if definitions and any(m.name == SOLVED for m in verdict.mistakes):
        return verdict  # of a determinant: the lines that are divided by it are right as they are written
    solved = [x for x in lines if x.kind == "definition" and x.name and _is_force(truth, x, lines)]
    solved = [x for x in solved if not _is_shorthand(truth, x, verdict)]
    names_of = Counter(x.name for x in solved)
    if not solved or max(names_of.values()) > MOST_VALUES:
        return verdict
    numbers = frozenset(x.number for x in solved)
    names = {key(str(x.name)) for x in solved}
    beside = [x for x in lines if x.number in numbers and not any(x is y for y in solved)]
    dropped = {x.number for x in beside if _holds_force(x, numbers, names)}
    beside = [x for x in beside if not x.names & names]
    try:
        again, unknown = read(numbers)
    except ParseError:
        return verdict
    symbols = {key(str(name)): symbol for name, symbol in unknown.items()}
    if any(key(str(x.name)) not in symbols for x in solved):
        return verdict
    pairs = [(symbols[key(str(x.name))], x) for x in solved]
    said = [replace(x, kind="equation", expr=name - x.expr, sides=(name, x.expr)) for name, x in pairs]
    from_above = [_stands_above(d, lines) and not _has_own_mass(truth, d, lines, names) for d in solved]
    later = [x for x, below in zip(said, from_above, strict=True) if below and x.number not in dropped]
    own = [*again, *beside, *(x for x in said if x not in later)]
    kept = tuple(f for f in verdict.findings if not (f.status.right and _holds_force(f.line, numbers, names)))
    asked = replace(verdict, findings=kept)  # a balance says no more than the force that was solved from it beside it
    found = with_wrong_balance(truth, filled(truth, own), asked, filled(truth, later), judge)
    return with_second_balance(truth, filled(truth, own), asked, verdict, names) if found is asked else found


def _holds_force(line: AnsweredLine, numbers: Collection[int], names: set[str]) -> bool:
    """Whether a line is a balance in which a force stands that is solved from it beside it."""
    return line.kind == "equation" and line.number in numbers and bool(line.names & names)


def _is_force(truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> bool:
    """Whether a definition was solved from an equation of motion: it has accelerations, or stands below such.

    An acceleration a_x = l θ″ was not, and neither was the law of a spring or damper, F = k (y − s).
    """
    if not weighs(truth, line):
        return False
    moving = line.expr.has(*(c.acceleration for c in truth.model.coordinates))
    return moving or _stands_above(line, lines)


def _is_shorthand(truth: Reference, line: AnsweredLine, verdict: Verdict) -> bool:
    """Whether a definition is of a side of equations above it that are right with it: A x″ + B φ″ = P, P = F − k x."""
    own, accelerations = key(str(line.name)), [c.acceleration for c in truth.model.coordinates]
    above = [f for f in verdict.findings if f.line.kind == "equation" and f.line.number < line.number]
    using = [f.status.right for f in above if own in f.line.names]
    return bool(using) and all(using) and not line.expr.has(*accelerations)


def _stands_above(line: AnsweredLine, lines: Sequence[AnsweredLine]) -> bool:
    """Whether an equation above a definition has its name."""
    own = key(str(line.name))
    return any(x.kind == "equation" and x.number < line.number and own in x.names for x in lines)


def _has_own_mass(truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine], names: set[str]) -> bool:
    """Whether a definition has a mass that no equation with forces above it has: it is the balance of another body."""
    above = [x.names for x in lines if x.kind == "equation" and x.number < line.number and x.names & names]
    own = (p.symbol for p in truth.model.parameters if key(p.name) in line.names.difference(*above))
    return any(is_mass(truth, x) for x in own)


def _read(forces: Sequence[sp.Basic]) -> Text:
    """The note on how forces were read."""
    names = ", ".join(f"'{plain(x)}'" for x in forces)
    read = "was taken as an unknown force" if len(forces) == 1 else "were taken as unknown forces"
    return text(f"{names} {read} and eliminated.")


def _is_of(note: Text, balances: Balances) -> bool:
    """Whether a note is about forces that were read otherwise, about a balance that was compared without them, or about
    mistakes that are told no more."""
    said = str(note)
    untrue = any(said.startswith(f"'{x.text}' is not true") for x in balances.lines)
    return untrue or said.endswith(LEFT_OVER) or any(f"'{plain(x)}'" in said for x in balances.forces)


def _mistake(blamed: Finding, why: Text) -> Mistake:
    """What is said of the line that is wrong: its term or, if none was found, that it is the one."""
    brief = text(f"Line {blamed.line.number} does not agree with the other lines that have these forces.")
    if blamed.differences:
        return replace(term_mistake(blamed, blamed.differences[0]), name=NAME, why=why, brief=brief)
    what = text(
        f"Line {blamed.line.number} does not agree with the other lines that have these forces, and those are right."
    )
    return Mistake(NAME, what, why, 5, brief=brief)
