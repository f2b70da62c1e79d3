"""Leaves balances of bodies unjudged that are right together alone: m ẍ = −H − b ẋ, where b acts on the other body.

A line with forces of the answer's own can be put right by what these are taken to be: H may hold b ẋ. Newton's laws of
the bodies tell where a known force acts, and which inertia a body has.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.all_forces import letters_of_gravity
from lagrangian.check.constraints.eliminated import slope_of, unknown_in
from lagrangian.check.explain.free_bodies import Match, free_bodies, proportional
from lagrangian.check.explain.known_forces import plain_matches
from lagrangian.check.explain.right_balances import marked
from lagrangian.check.explain.solved_forces import MOST_FORCES, MOST_LINES, place_of
from lagrangian.check.explain.wrong_balance import NAME, clashing, disagreeing
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.errors import listed
from lagrangian.model import Damper, Element, Force, Gravity, Spring, Torque, time
from lagrangian.page.formula import text

WHY = "no single body has these masses and forces. Check on which body each force acts."


def with_balances_apart(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict without the findings that call balances right that only are so together, with a note on them.

    Two lines or more that share a force are so if the known forces of one are those of no body with its inertia, and
    those of the others are not, either.
    """
    held = {place_of(f.line) for f in verdict.findings if f.status.right and f.line.kind == "equation"}
    forces = unknown_in(truth, lines)
    rows = [x for x in lines if x.kind == "equation" and x.expr.has(*forces)] if forces else []
    if len(forces) > MOST_FORCES or not 1 < len(rows) <= MOST_LINES or not held & set(map(place_of, rows)):
        return verdict
    if any(slope_of(x.expr, f) is None for x in rows for f in forces if x.expr.has(f)):
        return verdict
    fits = _Fits(truth, rows, forces)
    own = {id(x): fits.of(x) for x in rows}
    apart = [x for x in rows if own[id(x)] is not True]
    linked = [
        x
        for x in apart
        if any(y is not x and _share(x, y, forces) and False in (own[id(x)], own[id(y)]) for y in apart)
    ]
    if len({x.number for x in linked}) < 2:
        return verdict
    blamed = {place_of(f.line) for f in verdict.findings if f.status is Status.WRONG and not f.follows}
    fitting = [x for x in rows if place_of(x) in blamed and own[id(x)] is True]
    if fitting and any(m.name == NAME for m in verdict.mistakes):
        return _all_doubtful([x for x in rows if x in (*linked, *fitting)], forces, verdict)
    if blamed & set(map(place_of, linked)) and any(m.name == NAME for m in verdict.mistakes):
        return verdict  # that line is told
    told = set(map(place_of, linked)) & held
    findings = tuple(f for f in verdict.findings if place_of(f.line) not in told)
    numbers = listed([str(k) for k in sorted({x.number for x in linked})])
    why = "one by one: together they are right, but" if verdict.right else "by themselves:"
    note = text(f"Lines {numbers} were not judged {why} {WHY}")
    return replace(verdict, findings=findings, notes=(*verdict.notes, note)) if told else verdict


def _all_doubtful(lines: Sequence[AnsweredLine], forces: set[sp.Basic], verdict: Verdict) -> Verdict:
    """The verdict with several lines of which one at least is wrong, in place of one that is the balance of a body."""
    told = (disagreeing(lines, sorted(forces, key=str)),)
    findings = marked(verdict.findings, (), [clashing(x, lines) for x in lines], ())
    return replace(verdict, findings=findings, mistakes=told, alternatives=())


def _share(one: AnsweredLine, other: AnsweredLine, forces: set[sp.Basic]) -> bool:
    return any(one.expr.has(f) and other.expr.has(f) for f in forces)


class _Fits:
    """Compares lines with the balances of the bodies."""

    def __init__(self, truth: Reference, rows: Sequence[AnsweredLine], forces: set[sp.Basic]) -> None:
        self.truth = truth
        self.bodies = free_bodies(truth)
        self.none = dict.fromkeys(forces, np.zeros(truth.states.size))
        elements = dict.fromkeys(e for b in self.bodies.balances for e in b.shared)
        self.shared = set[sp.Basic]().union(*(_letters(truth, e) for e in elements))
        self.letters = set[sp.Basic]().union(*(bounded.letters(x.expr) for x in rows)) - {time}

    def of(self, line: AnsweredLine) -> bool | None:
        """Whether a line is the balance of some bodies; None if none of these has its accelerations, or if it is not
        known on which of them a force acts."""
        if any(map(self._is_right, plain_matches(self.truth, line.expr, self.none.keys()))):
            return True
        return False if self._moved(line) and not self.shared & bounded.letters(line.expr) else None

    def _moved(self, line: AnsweredLine) -> bool:
        """Whether some bodies have the accelerations of a line."""
        compiled = CompiledExpressions([line.expr]).slopes(self.bodies.accelerations)
        slopes = compiled.at(self.truth.states, self.none)
        return bool(np.isfinite(slopes).all()) and any(proportional(b.slopes, slopes) for b in self.bodies.balances)

    def _is_right(self, match: Match) -> bool:
        """Whether the known forces are as they act; those of which no line has a letter are in the answer's own."""
        return not match.wrong and not any(self.letters & _letters(self.truth, e) for e in match.omitted)


def _letters(truth: Reference, element: Element) -> set[sp.Basic]:
    """The letters by which the force of an element is known."""
    if isinstance(element, Gravity):
        return letters_of_gravity(truth)
    if isinstance(element, (Force, Torque)):
        told = truth.expand(sp.Add(*sp.Matrix([element.value]).flat()))
        return bounded.letters(told) - {time}
    sizes = [element.k] if isinstance(element, Spring) else [element.b] if isinstance(element, Damper) else []
    return set[sp.Basic]().union(*(bounded.letters(truth.expand(sp.sympify(x))) for x in sizes if x is not None))
