"""Finds a cut force that is taken as if its body stood still: Z = m g for Z = m (g − a), and then J φ″ = τ + Z r.

Put in, it makes the balance that uses it wrong, which is right as it stands. So the force is read as unknown, and what
is said of it is one of the balances: it is the mistake where it alone would be right with one plain term.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian import bounded
from lagrangian.check.all_forces import letters_of_gravity
from lagrangian.check.explain.known_forces import known_parts
from lagrangian.check.explain.right_balances import Judge
from lagrangian.check.explain.solved_forces import place_of
from lagrangian.check.explain.wrong_balance import ENERGIES, ReadWithout, with_wrong_balance
from lagrangian.check.lines import filled
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.errors import ParseError
from lagrangian.read.letters import key

MOST_NAMES = 3
"""The most forces that are read as unknown in turn."""
WEIGHTS = ("G", "W")
"""How names of weights begin: a weight is m g, whatever moves."""


def with_wrong_cut_force(
    truth: Reference, lines: Sequence[AnsweredLine], read: ReadWithout, verdict: Verdict, judge: Judge | None = None
) -> Verdict:
    """The verdict on an answer by Newton's laws in which a force is said to be what it is at rest, and all balances are
    right that use it by its name."""
    if verdict.status is not Status.WRONG or verdict.hint == 0 or any(x.kind in ENERGIES for x in lines):
        return verdict
    resting = [x for x in lines if _is_at_rest(truth, x)]
    for line in resting[:MOST_NAMES]:
        if (found := _blamed(truth, line, lines, read, verdict, judge)) is not None:
            return found
    return verdict


def _is_at_rest(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a definition is a weight, or a sum with one, without any acceleration, and is not named as a weight."""
    if line.kind != "definition" or not line.name or str(line.name).startswith(WEIGHTS):
        return False
    moving = line.expr.has(*(c.acceleration for c in truth.model.coordinates))
    return not moving and bool(bounded.letters(line.expr) & letters_of_gravity(truth))


def _blamed(
    truth: Reference,
    line: AnsweredLine,
    lines: Sequence[AnsweredLine],
    read: ReadWithout,
    verdict: Verdict,
    judge: Judge | None,
) -> Verdict | None:
    """The verdict with a definition as the one wrong line; None if it is not, or a balance with its name is no body's
    as it stands."""
    name = key(str(line.name))
    if [x.number for x in lines if x.kind == "definition" and key(str(x.name)) == name] != [line.number]:
        return None
    try:
        again, unknown = read(frozenset([line.number]))
    except ParseError:
        return None
    own = next((symbol for x, symbol in unknown.items() if key(str(x)) == name), None)
    if own is None:
        return None
    said = replace(line, kind="equation", expr=own - line.expr, sides=(own, line.expr))
    listed = filled(truth, [*again, said])
    users = [x for x in listed if x.kind == "equation" and x.expr.has(own) and place_of(x) != place_of(line)]
    parts = known_parts(truth, users, [s for s in unknown.values() if any(x.expr.has(s) for x in users)])
    if not users or not all(k in parts and parts[k].right for k in range(len(users))):
        return None
    asked = replace(verdict, mistakes=(), alternatives=())  # one for the definition is of what it is not meant to be
    found = with_wrong_balance(truth, listed, asked, judge=judge)
    roots = {place_of(f.line) for f in found.open_findings}
    return found if roots == {place_of(line)} and found.mistakes else None
