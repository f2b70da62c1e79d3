"""Finds the one wrong line among balances of single bodies with unknown forces: that without which the others hold.

m z″ = m g − S₁ − S₂, J φ″ = (S₁ − S₂) a, …: k lines, linear in forces that the system has no names for. Along the right
motion there are forces with which all right lines hold. If there are none for all k lines, but for all without one of
them, then this line is wrong, and the forces of the others tell which of its terms.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias, cast

import numpy as np
import sympy as sp

from lagrangian.check.constraints.eliminated import slope_of, unknown_in
from lagrangian.check.explain.balance_terms import Mend, mends, plainest
from lagrangian.check.explain.combined_rows import WrongTerm, difference, term_to_blame
from lagrangian.check.explain.known_forces import KnownPart, known_parts, weighs, with_wrong_law
from lagrangian.check.explain.primed_forces import primes_as_names
from lagrangian.check.explain.terms_alone import LEFT_OVER, term_mistake, with_terms_of_a_balance
from lagrangian.check.held import held
from lagrangian.check.lines import filled
from lagrangian.check.reference import Reference
from lagrangian.check.rows import small
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict, inserted
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.errors import ParseError
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.read.letters import key
from lagrangian.records import dataclass

NAME = "wrong_balance"
"""The name of the mistake."""
MOST_LINES, MOST_FORCES = 12, 6
"""The most lines, and the most forces in them, that are compared."""
MOST_TOLD = 3
"""The most lines of which one is said to be wrong."""
NEAR = 1e-8
"""The relative size of what is rounding."""
MOMENT = 0.4
"""By how much likelier an arm or a sign is wrong in a moment than in a sum of forces."""
WHY = text("Draw a free-body diagram of the body of this line: every force with its sign, every moment with its arm.")
WHY_SOLVED = text("The lines from which this was solved are right: solve them once more, term by term.")
ENERGIES = ("T", "V", "L")
"""Lines that an answer by Newton's laws does not have."""

ReadWithout: TypeAlias = Callable[[frozenset[int]], tuple[Sequence[AnsweredLine], Mapping[str, sp.Expr]]]
"""The lines of an answer without some, by number, and the symbols of the names in them that nothing says."""


@dataclass(frozen=True, eq=False)
class Balances:
    """Lines A u + b = 0 with forces u, and their values along the right motion: A (S, k, m), b (S, k)."""

    lines: tuple[AnsweredLine, ...]
    forces: tuple[sp.Basic, ...]
    A: Array
    b: Array

    def solved(self, rows: Sequence[int]) -> Array | None:
        """The forces (S, m) with which some of the lines hold; None if there are none."""
        A, b = self.A[:, rows], self.b[:, rows]
        u = -(np.linalg.pinv(A) @ b[:, :, None])[:, :, 0]
        scale = (np.abs(A) * np.abs(u[:, None, :])).sum(axis=2) + np.abs(b)
        left = np.abs((A @ u[:, :, None])[:, :, 0] + b)
        return u if (left <= NEAR * np.maximum(scale, 1e-300)).all() else None

    def forces_without(self, k: int) -> dict[sp.Basic, Array] | None:
        """The forces that the lines without one determine; None if one of its own is not among these."""
        rows = [i for i in range(len(self.lines)) if i != k]
        if (u := self.solved(rows)) is None:
            return None
        found: dict[sp.Basic, Array] = {}
        for j, force in enumerate(self.forces):
            alone = np.zeros((len(self.A), 1, len(self.forces)))
            alone[:, 0, j] = 1
            both = np.linalg.matrix_rank(np.concatenate([self.A[:, rows], alone], axis=1))
            if (both == np.linalg.matrix_rank(self.A[:, rows])).all():
                found[force] = u[:, j]
            elif self.A[:, k, j].any():
                return None
        return found

    def compared(self, rows: Sequence[int]) -> bool:
        """Whether each of some lines is compared with the rest: the others determine all forces, too."""
        whole = self.rank(range(len(self.lines)))
        return all(self.rank([i for i in rows if i != j]) == whole for j in rows)

    def rank(self, rows: Sequence[int]) -> int:
        """How many forces some of the lines determine, at most states."""
        return int(np.median(np.linalg.matrix_rank(self.A[:, rows]))) if rows else 0


def with_wrong_balance(
    truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict, later: Sequence[AnsweredLine] = ()
) -> Verdict:
    """The verdict on an answer by Newton's laws in which one line alone is wrong and the others are right, among these
    the forces of springs and dampers that have names.

    ``later`` lines were solved from them: if all balances are right, one of these may be wrong.
    """
    if verdict.status is not Status.WRONG or truth.n < 2 or verdict.hint == 0 or any(x.kind in ENERGIES for x in lines):
        return verdict
    if (law := with_wrong_law(truth, lines, verdict)) is not None:
        return law
    on, lines = held(truth) if truth.derivation.multipliers else truth, primes_as_names(truth, lines)
    if on is None or (balances := _balances(on, lines)) is None:
        return verdict
    if len(balances.forces) <= len(truth.derivation.multipliers):
        return verdict  # multipliers
    parts = known_parts(truth, balances.lines, balances.forces)
    if (solved := _one_blamed(on, balances, later, parts)) is None:
        return _without_invented(balances, verdict)
    every, k, line, false = range(len(balances.lines)), solved.k, solved.line, solved.false
    plain = solved.few or on is not truth or (solved.term is not None and solved.term.term.has(*balances.forces))
    blamed = Finding(
        line, Status.WRONG, differences=() if solved.term is None else (difference(on, solved.term, None),)
    )
    own = balances.lines
    causes = [own] if k is not None else [(*own[:i], *own[i + 1 :], line) for i in every]
    below = [x for x in lines if x.kind == "equation" and not x.expr.has(*balances.forces)]
    below += [x for x in false if x is not line]
    holds = np.any([_hold(on, rows, balances.forces, below) for rows in causes], axis=0)
    follow = [x for x, follows in zip(below, holds, strict=True) if follows]
    right = [x for x in (*balances.lines, *later) if x is not line and x not in false]
    roots = {_at(f.line) for f in verdict.findings if f.status is Status.WRONG and not f.follows}
    theirs = solved.known is not None or (solved.term is not None and solved.term.term.has(*balances.forces))
    plain &= theirs or k is None or k in parts or on is not truth
    if verdict.mistakes and roots == {_at(line)} and not plain:
        return verdict  # it is explained, and no other line is called wrong
    notes = (*(x for x in verdict.notes if not _is_of(x, balances.forces)), _read(balances.forces))
    findings = _marked(verdict.findings, right, blamed, follow)
    mistake = _mistake(blamed, WHY_SOLVED if k is None else WHY)
    if solved.term is None and solved.known is not None and solved.known.said is not None:
        title = None if solved.known.element is None else solved.known.element.title
        mistake = replace(mistake, what=solved.known.said, element=title)
    return replace(verdict, findings=findings, mistakes=(mistake,), alternatives=(), notes=notes, sure=True)


def balances_agree(truth: Reference, lines: Sequence[AnsweredLine]) -> bool:
    """Whether there are forces of the answer's own with which all its balances hold along the right motion."""
    on, lines = held(truth) if truth.derivation.multipliers else truth, primes_as_names(truth, lines)
    balances = None if on is None else _balances(on, lines)
    return balances is not None and balances.solved(range(len(balances.lines))) is not None


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


def _without_invented(balances: Balances, verdict: Verdict) -> Verdict:
    """The verdict without explanations by Lagrange's derivatives, which an answer with balances has not; the lines that
    do not agree in their place."""
    if not any(_of_derivatives(m) for m in verdict.mistakes):
        return verdict
    told, others = (tuple(m for m in x if not _of_derivatives(m)) for x in (verdict.mistakes, verdict.alternatives))
    left_out = _left_out(balances)
    if not told and 1 < len(left_out) <= MOST_TOLD:
        numbers = sorted({balances.lines[i].number for i in left_out})
        listed = f"{', '.join(map(str, numbers[:-1]))} and {numbers[-1]}"
        names = [cast("sp.Expr", f) for f in balances.forces if any(balances.lines[i].expr.has(f) for i in left_out)]
        force = text(*[x for f in names for x in (f, ", ")][:-1])
        what = text(f"Lines {listed}, which have ", *force.parts, ", do not agree: one of them is wrong.")
        brief = text(f"Lines {listed} do not agree: one of them is wrong.")
        told, others = (Mistake(NAME, what, WHY, 5, brief=brief),), ()
    verdict = replace(verdict, mistakes=told, alternatives=others)
    return verdict if told or left_out else with_terms_of_a_balance(verdict)


def _of_derivatives(mistake: Mistake) -> bool:
    """Whether a mistake is told in derivatives of energies."""
    return any(x in str(told) for told in (mistake.what, mistake.why) for x in ("∂L", "∂ℒ", "∂T", "T*"))


def _one_blamed(
    truth: Reference, balances: Balances, later: Sequence[AnsweredLine], parts: Mapping[int, KnownPart]
) -> WrongBalance | None:
    """The line that is wrong; None if it may be several, and none of them would be right with a plain term.

    One with a known force that is wrong comes first; in one whose known ``parts`` are right its own forces are wrong.
    """
    every, left_out = range(len(balances.lines)), _left_out(balances)
    told = [i for i in every if i in parts and parts[i].said is not None and (not left_out or i in left_out)]
    for i in told:
        u = balances.forces_without(i) if left_out else None
        if u is not None and _is_true(truth, balances.lines[i], truth.accelerations | u, parts[i].excess):
            values = truth.accelerations | u
            false = tuple(x for x in later if not _is_true(truth, x, values))
            return WrongBalance(i, balances.lines[i], parts[i].term, false, few=True, known=parts[i])
    k = left_out[0] if len(left_out) == 1 else None
    rest = [i for i in every if i != k]
    if len(left_out) <= 1 and balances.compared(rest) and (u := balances.solved(rest)) is not None:
        values = truth.accelerations | dict(zip(balances.forces, u.T, strict=True))
        false = [x for x in later if not _is_true(truth, x, values)]
        if k is None and len(false) != 1:
            return None
        line = false[0] if k is None else balances.lines[k]
        term = term_to_blame(truth, line.expr, values)
        if term is None and (best := plainest({0: mends(truth, line.expr, values, balances.forces)})) is not None:
            term = best[1]
        return WrongBalance(k, line, term, tuple(false))
    listed: dict[int, list[Mend]] = {}
    given: dict[int, dict[sp.Basic, Array]] = {}
    for i in left_out:
        if (u := balances.forces_without(i)) is not None:
            given[i] = truth.accelerations | u
            found = mends(truth, balances.lines[i].expr, given[i], list(u))
            if (part := parts.get(i)) is not None and part.right:
                found = [m for m in found if _may_be(truth, part, m.term, balances.forces)]
            if part is not None and part.moment:
                found = [replace(m, cost=m.cost - MOMENT) for m in found]
            listed[i] = found
    if (best := plainest(listed)) is None:
        i = next((i for i in told if not parts[i].tentative), None)
        return None if i is None else WrongBalance(i, balances.lines[i], parts[i].term, few=True, known=parts[i])
    i, term = best
    false = tuple(x for x in later if not _is_true(truth, x, given[i]))
    return WrongBalance(i, balances.lines[i], term, false, few=True)


def _may_be(truth: Reference, part: KnownPart, wrong: WrongTerm, forces: Sequence[sp.Basic]) -> bool:
    """Whether a term may be wrong in a line whose known forces are right: one with forces of the answer's own."""
    return wrong.term.has(*forces) or (wrong.factor == sp.oo and part.may_lack(truth, wrong.term))


def with_forces_of_below(
    truth: Reference, lines: Sequence[AnsweredLine], read: ReadWithout, verdict: Verdict
) -> Verdict:
    """The verdict on an answer with forces that it says itself, S₁ = m g − m z″ − S₂, above or below other balances.

    Such a line is one of the balances if no other above it has the force; otherwise it was solved from these.
    """
    if verdict.status is not Status.WRONG or any(x.kind in ENERGIES for x in lines):
        return verdict
    solved = [x for x in lines if x.kind == "definition" and x.name and _is_force(truth, x, lines)]
    if not solved or len({x.name for x in solved}) < len({x.number for x in solved}):
        return verdict
    numbers = frozenset(x.number for x in solved)
    if any(x.number in numbers and not any(x is y for y in solved) for x in lines):
        return verdict
    try:
        again, unknown = read(numbers)
    except ParseError:
        return verdict
    symbols = {key(str(name)): symbol for name, symbol in unknown.items()}
    if any(key(str(x.name)) not in symbols for x in solved):
        return verdict
    said = [replace(x, kind="equation", expr=symbols[key(str(x.name))] - x.expr) for x in solved]
    later = [x for x, d in zip(said, solved, strict=True) if _stands_above(d, lines)]
    own = [*again, *(x for x in said if x not in later)]
    return with_wrong_balance(truth, filled(truth, own), verdict, filled(truth, later))


def _is_force(truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> bool:
    """Whether a definition was solved from an equation of motion: it has accelerations, or stands below such.

    An acceleration a_x = l θ″ was not, and neither was the law of a spring or damper, F = k (y − s).
    """
    if not weighs(truth, line):
        return False
    moving = line.expr.has(*(c.acceleration for c in truth.model.coordinates))
    return moving or _stands_above(line, lines)


def _stands_above(line: AnsweredLine, lines: Sequence[AnsweredLine]) -> bool:
    """Whether an equation above a definition has its name."""
    own = key(str(line.name))
    return any(x.kind == "equation" and x.number < line.number and own in x.names for x in lines)


def _balances(truth: Reference, lines: Sequence[AnsweredLine]) -> Balances | None:
    """The lines of an answer with forces of its own; None if these are not linear, or too many or too few."""
    forces = sorted(unknown_in(truth, lines), key=str)
    rows = tuple(x for x in lines if x.kind == "equation" and x.expr.has(*forces)) if forces else ()
    if not 0 < len(forces) <= MOST_FORCES or not len(forces) < len(rows) <= MOST_LINES:
        return None
    slopes: list[sp.Expr] = []
    for x in rows:
        own = [slope_of(x.expr, f) if x.expr.has(f) else sp.S.Zero for f in forces]
        if any(s is None or s.has(*forces) for s in own):
            return None
        slopes += [s for s in own if s is not None]
    without = dict.fromkeys(forces, np.zeros(truth.states.size))
    values = CompiledExpressions([*slopes, *(x.expr for x in rows)]).at(truth.states, truth.accelerations | without)
    if not np.isfinite(values).all():
        return None
    A = values[: len(slopes)].reshape(len(rows), len(forces), -1).transpose(2, 0, 1)
    return Balances(rows, tuple(forces), A, values[len(slopes) :].T)


def _left_out(balances: Balances) -> list[int]:
    """The places of the lines without which all others hold; none if all hold together."""
    every = list(range(len(balances.lines)))
    if balances.solved(every) is not None:
        return []
    return [k for k in every if balances.solved([i for i in every if i != k]) is not None]


def _is_true(
    truth: Reference, line: AnsweredLine, values: Mapping[sp.Basic, Array], excess: Array | None = None
) -> bool:
    """Whether a line, without an ``excess``, holds along the right motion."""
    compiled = CompiledExpressions([line.expr])
    found = compiled.at(truth.states, values)[0]
    return small(found - (0 if excess is None else excess), float(np.abs(compiled.at(truth.states)[0]).max()))


def _hold(
    truth: Reference, rows: Sequence[AnsweredLine], forces: Sequence[sp.Basic], below: Sequence[AnsweredLine]
) -> list[bool]:
    """Whether each of some lines holds for the motion that the balances give, the wrong one as it is."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    wanted, none = [*accelerations, *forces], [False] * len(below)
    exprs, k, size = [x.expr for x in (*rows, *below)], len(rows), truth.states.size
    compiled, still = CompiledExpressions(exprs), dict.fromkeys(wanted, np.zeros(size))
    A = compiled.slopes(wanted).at(truth.states, still).reshape(len(exprs), len(wanted), size).transpose(2, 0, 1)
    b = compiled.at(truth.states, still).T
    if not (np.isfinite(A).all() and np.isfinite(b).all()):
        return none
    used = list(range(k))
    for i, x in enumerate(below, k):  # what the balances do not say: the equation of a body without these forces
        if np.linalg.matrix_rank(A[0, [*used, i]]) > np.linalg.matrix_rank(A[0, used]) and _is_true(
            truth, x, truth.accelerations
        ):
            used.append(i)
    if (np.linalg.matrix_rank(A[:, used]) < len(wanted)).any():
        return none
    motion = -(np.linalg.pinv(A[:, used]) @ b[:, used, None])
    scale = (np.abs(A) * np.abs(motion.transpose(0, 2, 1))).sum(axis=2) + np.abs(b)
    holds = (np.abs((A @ motion)[:, :, 0] + b) <= 1e-6 * np.maximum(scale, 1e-300)).all(axis=0)
    return [bool(x) for x in holds[k:]] if holds[used].all() else none


def _marked(
    findings: Sequence[Finding], right: Sequence[AnsweredLine], blamed: Finding, follow: Sequence[AnsweredLine]
) -> tuple[Finding, ...]:
    """The findings with one line blamed, others right, and what follows from it marked so."""
    note = text("right with the forces that the other lines give")
    said = {_at(x): Finding(x, Status.WRONG, follows=True) for x in follow}
    held = {_at(f.line) for f in findings if f.status is not Status.WRONG and f.line.kind != "definition"}
    said = {at: x for at, x in said.items() if at not in held}
    said |= {_at(x): Finding(x, Status.RIGHT, note) for x in right} | {_at(blamed.line): blamed}
    found = [f for f in findings if _at(f.line) not in said]
    for new in sorted(said.values(), key=lambda f: f.line.number):
        found = inserted(found, new)
    return tuple(found)


def _read(forces: Sequence[sp.Basic]) -> Text:
    """The note on how forces were read."""
    names = ", ".join(f"'{plain(x)}'" for x in forces)
    read = "was taken as an unknown force" if len(forces) == 1 else "were taken as unknown forces"
    return text(f"{names} {read} and eliminated.")


def _is_of(note: Text, forces: Sequence[sp.Basic]) -> bool:
    """Whether a note is about forces that were read otherwise, or about mistakes that are told no more."""
    said = str(note)
    return said.endswith(LEFT_OVER) or any(f"'{plain(x)}'" in said for x in forces)


def _at(line: AnsweredLine) -> tuple[int, str]:
    return line.number, line.text


def _mistake(blamed: Finding, why: Text) -> Mistake:
    """What is said of the line that is wrong: its term or, if none was found, that it is the one."""
    brief = text(f"Line {blamed.line.number} does not agree with the other lines that have these forces.")
    if blamed.differences:
        return replace(term_mistake(blamed, blamed.differences[0]), name=NAME, why=why, brief=brief)
    what = text(
        f"Line {blamed.line.number} does not agree with the other lines that have these forces, and those are right."
    )
    return Mistake(NAME, what, why, 5, brief=brief)
