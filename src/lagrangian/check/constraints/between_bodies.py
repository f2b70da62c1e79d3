"""Other forms of a right answer for a system with constraints: coordinates counted together, and forces between bodies.

By Newton's laws, M x″ = A − … and m x″ = H − A − … have a force A of an axle that is none of a constraint of the
system. It is written out, as where there are no constraints, if an equation of motion remains where it stood.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import sympy as sp

from lagrangian.check.constraints.answer_on_rows import AnswerOnRows
from lagrangian.check.constraints.counted_together import counted_together
from lagrangian.check.constraints.determined import SMALL, in_span
from lagrangian.check.constraints.eliminated import Eliminated, without_forces
from lagrangian.check.constraints.in_rates import in_coordinates
from lagrangian.check.names.own_accelerations import own_accelerations
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model.rows import pressing_rows
from lagrangian.page.formula import Text

STATES = 3
"""Random states at which it is seen whether a line says more than the constraints."""

Form = tuple[Sequence[AnsweredLine], tuple[Text, ...]]
"""The lines in another form, and what to say about it."""


def other_forms(truth: Reference, lines: Sequence[AnsweredLine]) -> Iterator[Form]:
    """The lines with coordinates counted together, without the forces between bodies, and both."""
    yield from counted_together(truth, lines)
    if (forces := _without_forces_between(truth, lines)) is not None:
        yield forces.lines, (forces.note,)
        yield from ((put, (forces.note, *told)) for put, told in counted_together(truth, forces.lines))


def _without_forces_between(truth: Reference, lines: Sequence[AnsweredLine]) -> Eliminated | None:
    """The lines without the forces between bodies, if an answer has more forces than there are constraints.

    What takes up the mistakes of its equation leaves nothing but the constraints when it is written out; it is kept,
    and judged as the force of one.
    """
    found = None if pressing_rows(truth.model) else without_forces(truth, lines)
    if found is None or len(found.names) + _stated(truth, lines) <= len(truth.derivation.multipliers):
        return None
    moving = [has for line, has in zip(found.lines, found.held, strict=True) if has and _says_more(truth, line)]
    kept = frozenset[sp.Basic]().union(*found.held) - frozenset[sp.Basic]().union(*moving)
    kept -= frozenset[sp.Basic]().union(*_confirmed(truth, lines, found)) if kept else kept
    return without_forces(truth, lines, kept) if kept else found


def _confirmed(truth: Reference, lines: Sequence[AnsweredLine], found: Eliminated) -> Iterator[frozenset[sp.Basic]]:
    """The forces of lines in which another one stands that the answer gives a value, and that stands in an equation of
    motion as well: J z″/r = (S₂ − S₁) r beside S₁ = … and m s″ = m g − S₁."""
    stated = own_accelerations(truth.model, lines)
    for line, has in zip(found.lines, found.held, strict=True):
        own = stated & line.names
        if has and own:
            others = (x for x in found.lines if x is not line and own & x.names and x.kind == "equation")
            if any(_says_more(truth, x) for x in others):
                yield has


def _stated(truth: Reference, lines: Sequence[AnsweredLine]) -> int:
    """How many names with accelerations in them the answer gives a value, as H = τ/R − J x″/R²."""
    return len(own_accelerations(truth.model, lines))


def _says_more(truth: Reference, line: AnsweredLine) -> bool:
    """Whether an equation asks of the accelerations what the constraints do not."""
    if line.kind != "equation":
        return False
    answer = AnswerOnRows(truth, in_coordinates(truth, [line]), [])
    places = map(answer.at, answer.states(STATES, given=False))
    slopes = ((p.by_acceleration[0], p.rows, p.size[0]) for p in places)
    return any(np.abs(a).max() > SMALL * (1.0 + size) and not in_span(a, rows) for a, rows, size in slopes)
