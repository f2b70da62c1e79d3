"""All that holds the bodies, found in the geometry: rods, pins, tracks, rolling, ties, and constraints.

The names say no more than the geometry does: what stays at a constant distance from a point is held by a rod, a string
or a round track, and which of these it is makes no difference to the equations.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.derive.multipliers.rows import RowForms
from lagrangian.derive.reasons.finder import Finder
from lagrangian.derive.reasons.fixed import FixedPoints
from lagrangian.derive.reasons.holding import Holding, carried_by
from lagrangian.derive.reasons.laws import reaction
from lagrangian.derive.reasons.loads import AppliedLoads
from lagrangian.derive.reasons.motion import Moving, dot
from lagrangian.derive.reasons.ties import tied
from lagrangian.model import Body, Torque

MOST_BODIES = 12
"""With more bodies, what holds each is not looked for: pairs of them are compared."""


def holds(
    context: Context, moving: tuple[Moving, ...], applied: AppliedLoads, rows: tuple[RowForms, ...]
) -> tuple[Holding, ...]:
    """All holders, those of the first body first; a body may have several, and a holder several bodies."""
    bodies = context.model.bodies
    if len(bodies) > MOST_BODIES:
        return tuple(Holding(b, "unknown") for b in bodies)
    places = FixedPoints(context, moving)
    finder = Finder(places, moving)
    found = [hold for body in bodies if (hold := finder.of(body)) is not None]
    found += [_tie(group, found) for group in tied(context, moving, found)]
    found += _constraints(places, moving, found, rows)
    listed = [_with_force(context, moving, applied, hold, found) for hold in found]
    return tuple(sorted(listed, key=lambda hold: min(bodies.index(b) for b in hold.bodies)))


def _tie(group: tuple[Body, ...], found: list[Holding]) -> Holding:
    """What ties bodies together: a lever, if each is held by a rod and all these rods have one direction."""
    first, *others = ([h for h in found if h.body is b and h.kind == "rod" and h.along] for b in group)
    if others and first and all(h and _parallel(h[0], first[0]) for h in others):
        return Holding(group[0], "lever", along=first[0].along, others=group[1:])
    return Holding(group[0], "tie", others=group[1:])


def _parallel(one: Holding, other: Holding) -> bool:
    """Whether two holders have one direction."""
    pairs = list(zip(one.along, other.along, strict=True))
    return all((a - b).is_zero for a, b in pairs) or all((a + b).is_zero for a, b in pairs)


def _constraints(
    places: FixedPoints, moving: tuple[Moving, ...], found: list[Holding], rows: tuple[RowForms, ...]
) -> Iterator[Holding]:
    """A holder for every constraint that was stated, with the bodies on which it acts."""
    bodies = places.context.model.bodies
    for element in dict.fromkeys(row.row.element for row in rows):
        named = [b for b in (getattr(element, "body", None),) if b is not None]
        held: list[Body | None] = named or [places.body_of(p) for _, p in element.points() if not places.still(p)]
        if not held or None in held:
            moved = [j for row in rows if row.row.element is element for j, s in enumerate(row.slopes) if s.parts]
            held = [b for j in dict.fromkeys(moved) for b in _topmost(moving, found, j)]
        first, *others = sorted({b for b in held if b is not None}, key=bodies.index) or [bodies[0]]
        yield Holding(first, "constraint", others=tuple(others), element=element)


def _topmost(moving: tuple[Moving, ...], found: list[Holding], index: int) -> list[Body]:
    """The bodies that a coordinate moves, without those that are only carried along."""
    moved = {m.body for m in moving if any(x.parts for x in m.columns[index])}
    carrier = {h.body: h.carrier for h in found if h.carrier is not None}
    return [b for b in moved if carrier.get(b) not in moved]


def _apart(beside: Holding, hold: Holding, branch: tuple[Body, ...], found: list[Holding]) -> bool:
    """Whether what holds a body of a branch, too, adds nothing to the force of a holder, or to its part along a line.

    What ties one body to its coordinates acts in the ways that a rod or a track leaves it, a lever across its line.
    """
    if beside.kind == "tie":
        return bool(hold.along) and beside.bodies == branch
    if beside.kind == "lever":
        carrier = next((h.carrier for h in found if h.body is beside.body), None)
        inside = carrier in branch and set(beside.bodies) <= set(branch)
        return inside or (hold.kind == "rod" and bool(hold.along) and _parallel(beside, hold))
    return beside is hold or (beside.carrier in branch and beside.kind != "constraint")


def _with_force(
    context: Context, moving: tuple[Moving, ...], applied: AppliedLoads, hold: Holding, found: list[Holding]
) -> Holding:
    """Add the bodies whose R are together the force of this holder, and its part along a rod or across a track.

    Of all that hang on its body, nothing but this holder may hold anything from elsewhere. A torque on a part without
    mass pushes its two ends in opposite directions, another force on it does not; what acts nobody said where may act
    on any of them.
    """
    simple = all(isinstance(x.element, Torque) for x in applied.passed)
    branch = carried_by(found, hold.body)
    if hold.kind not in ("rod", "pin", "track", "rolling") or (len(branch) > 1 and not simple):
        return hold
    if any(x.through != "part" for x in applied.passed):
        return hold
    if any(set(h.bodies) & set(branch) and not _apart(h, hold, branch, found) for h in found):
        return hold
    whole = [reaction(context, applied, m) for m in moving if m.body in branch and not m.turning]
    force: Form | None = None
    if hold.along:
        along = context.algebra.total([dot(context, R, hold.along) for R in whole])
        force = -along if hold.kind == "rod" else along
    return replace(hold, force=force, branch=branch)
