"""Answers that solve a constraint for a coordinate with a root, z = a sin θ + √(l² − (c − a cos θ)²).

The constraint allows z = a sin θ − √… as well. Which of both an answer is about it may choose; it is judged at the
states where its own line holds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import islice

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.answer_on_rows import AnswerOnRows
from lagrangian.check.constraints.constrained import expanded, verdict_at_states
from lagrangian.check.constraints.new_angles import where_held
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.derive.sample import Sampler
from lagrangian.page.formula import text
from lagrangian.verify.on_rows import Groups, State

CLOSE = 1e-9
"""The largest value of a line that holds at a state."""
MORE = 4
"""How many states are drawn for each that is asked for."""


def on_branch(truth: Reference, lines: Sequence[AnsweredLine], hint: int) -> Verdict | None:
    """The verdict on an answer that is right where its roots are positive; None for another."""
    roots = [line.expr for line in lines if _is_solved(truth, line)]
    if not roots:
        return None
    held = [where_held(truth, line) for line in lines]
    compared = replace(expanded(truth), answer=partial(_OnBranch, truth, roots))
    found = verdict_at_states(compared, held, hint, given=False)
    if not found.right:
        return None
    written = {id(x): line for x, line in zip(held, lines, strict=True)}
    note = text("with the constraint put in")
    findings = []
    for f in found.findings:
        line = written.get(id(f.line), f.line)
        findings.append(f if line is f.line else replace(f, line=line, status=Status.EQUIVALENT, note=note))
    said = text("Read where the roots of your lines are as you write them; the constraint allows others.")
    return replace(found, findings=tuple(findings), notes=(*found.notes, said))


def _is_solved(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line gives a coordinate in a root of others."""
    coordinates = [c.symbol for c in truth.model.coordinates]
    if line.kind != "equation" or line.expr.has(sp.Derivative) or line.expr.free_symbols - truth.names:
        return False
    solved = [q for q in coordinates if bounded.diff(line.expr, q) in (1, -1)]
    roots = [x for x in line.expr.atoms(sp.Pow) if (2 * x.exp).is_odd and x.has(*coordinates)]
    return bool(solved and roots)


class _OnBranch(AnswerOnRows):
    """The equations of an answer at states on the constraints where ``roots`` are 0."""

    def __init__(
        self, truth: Reference, roots: Sequence[sp.Expr], lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic]
    ) -> None:
        super().__init__(truth, lines, unknown)
        self.roots = Sampler(truth.model, list(roots))

    def states(self, count: int, *, given: bool) -> Iterator[tuple[State, Groups]]:
        """Up to ``count`` random states on this branch."""
        found = super().states(MORE * count, given=given)
        yield from islice((x for x in found if all(abs(v) <= CLOSE for v in self.roots.at(x[0]))), count)
