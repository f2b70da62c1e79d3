"""Step 1: generalized coordinates, complete and independent, absolute or relative."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.circuits import carried, kirchhoff, what_is_known, what_moves, without
from lagrangian.derive.context import Context, xi
from lagrangian.derive.derived import Step
from lagrangian.derive.wiggle import depends
from lagrangian.errors import listed
from lagrangian.model import Coordinate, Element, Frame, Model, Point
from lagrangian.page.formula import Check, Formula, Item, Left, Table, Text, formula, text
from lagrangian.records import dataclass


@dataclass(frozen=True)
class MeasuredFrom:
    """How a coordinate is measured: an angle or a length, absolute (``to`` is None) or relative to another one, or a
    charge."""

    angle: bool
    to: sp.Expr | None
    known: bool = True
    charge: bool = False


def coordinates(context: Context) -> Step:
    """Show that the coordinates are complete and independent, and which are absolute and which are relative."""
    model, wiggle = context.model, context.wiggle
    n = len(model.coordinates)
    kinds = measured(model)
    items: list[Item] = []
    rows: list[tuple[Text | Formula, ...]] = []
    for i, c in enumerate(model.coordinates):
        items.append(formula(xi(i), c.symbol, note=_note(c, kinds[c.symbol]), brief=True))
        rows.append((text(c.symbol), text(*_kind_words(kinds[c.symbol])), text(*_wiggle_words(context, i))))
    header = (text("coordinate"), text("measured"), text("wiggle it alone"))
    items.append(Table(header, tuple(rows)))
    items.append(
        text(f"Complete: the coordinates (and t) determine {what_is_known(model)}; nothing else in the system moves.")
    )
    items += kirchhoff(model)
    counted = " and the rows of the constraints" if wiggle.rows else ""
    if tied := len(model.constraints):
        items.append(
            text(
                f"{'One constraint ties' if tied == 1 else f'{tied} constraints tie'} the coordinates together. Step 1 "
                + ("leaves it aside; its force comes" if tied == 1 else "leaves them aside; their forces come")
                + " in after step 4, with multipliers."
            )
        )
    items.append(
        text(
            f"Independent: each of them can wiggle while the others stay fixed. As linear functions of the {n} rates, "
            f"{what_moves(model)}{counted} have rank {wiggle.rank}, so no combination of the coordinates wiggles "
            f"{without(model)}."
            if n > 1
            else "Independent: there is no other coordinate that it could depend on, and "
            f"{'a current flows through a coil' if model.charges else 'a mass moves'} when it wiggles."
        )
    )
    if n > 1 or kinds[context.symbols[0]].to is not None:
        items.append(text("The choice is not unique: any complete and independent set is right, absolute or relative."))
    reasons = tuple(text(c, ": ", *_kind_words(k)) for c, k in kinds.items())
    return Step(
        1,
        "Generalized coordinates",
        text("Chose the generalized coordinates and checked that they are complete and independent."),
        text(
            "A complete set says where every mass is, so that both energies can be written down; in an independent set "
            "each coordinate can be wiggled alone, which gives it an equation of its own."
        ),
        tuple(items),
        {
            "coordinates": context.symbols,
            "rank": wiggle.rank,
            "relative": {c: k.to for c, k in kinds.items()},
            "lengths": {c: k.known and not k.angle for c, k in kinds.items()},
        },
        reasons,
        (Check(text("rank of the velocities in the rates"), wiggle.rank == n, f"{wiggle.rank} of {n}"),),
    )


def _note(coordinate: Coordinate, kind: MeasuredFrom) -> Text | None:
    """The note beside ξ_i on the checklist: the user's description, and what a relative coordinate is measured from."""
    parts: list[str | Left] = [coordinate.description] if coordinate.description else []
    if kind.to is not None:
        parts += ["; relative to " if parts else "relative to ", kind.to]
    elif kind.known:
        parts.append("; absolute" if parts else "absolute")
    return text(*parts) if parts else None


def _kind_words(kind: MeasuredFrom) -> list[str | Left]:
    if kind.charge:
        return ["a charge: its rate is a current"]
    if not kind.known:
        return ["as given, with the energies"]
    what = "an angle" if kind.angle else "a displacement"
    if kind.to is None:
        return [f"absolute: {what} from a fixed direction" if kind.angle else f"absolute: {what} from a fixed place"]
    return [f"relative: {what} measured from what ", kind.to, " moves"]


def _wiggle_words(context: Context, index: int) -> list[str | Left]:
    moved = context.wiggle.moved[index]
    still = [b for b in context.model.bodies if b not in moved]
    coordinate = context.model.coordinates[index]
    if coordinate in context.model.charges and not any(b in context.model.bodies for b in moved):
        return [f"a current flows through {carried(context.model, coordinate)}; nothing else changes"]
    if not moved:
        return ["its momentum changes: it moves mass"]
    parts = [f"{_listed(moved)} move{'s' if len(moved) == 1 else ''}"]
    if still:
        parts.append(f"; {_listed(still)} stay{'s' if len(still) == 1 else ''}")
    return list(parts)


def _listed(elements: Sequence[Element]) -> str:
    titles = [e.title for e in elements]
    if len(titles) > 6:
        return f"{titles[0]}, …, {titles[-1]}"
    return listed(titles)


# -- absolute or relative, from the geometry ------------------------------------------------------------------------


def measured(model: Model) -> dict[sp.Expr, MeasuredFrom]:
    """Determine how every coordinate is measured.

    Angles occur in the directions of the system (arguments of sine and cosine, angles of frames): if every direction
    that contains ξ_i also contains other coordinates, ξ_i is measured from them. Lengths occur in positions: ξ_i is
    relative to ξ_j if ξ_j carries along the body that ξ_i moves, together with another that ξ_i does not move.
    """
    symbols: list[sp.Expr] = [c.symbol for c in model.coordinates]
    directions, carriers = _directions(model, symbols), _carriers(model, symbols)
    reach = {s: sum(any(depends(model, x, s) for x in _where(model, b)) for b in model.bodies) for s in symbols}
    found: dict[sp.Expr, MeasuredFrom] = {}
    lengths, turns = _lengths(model, symbols), _turns(model, symbols)
    number = {s: i for i, s in enumerate(symbols)}
    containing: dict[sp.Expr, list[tuple[sp.Expr, ...]]] = {s: [] for s in symbols}
    for direction in directions:
        for s in direction:
            containing[s].append(direction)
    charges = {c.symbol for c in model.charges}
    for s in symbols:
        holding = containing[s]
        if s in charges:
            found[s] = MeasuredFrom(False, None, known=False, charge=True)
        elif s in carriers:
            found[s] = MeasuredFrom(True, carriers[s])
        elif s in lengths:
            to = _carried_by(model, s, symbols, reach)
            found[s] = MeasuredFrom(to is None and s in turns, to)
        elif holding:
            smallest = min(holding, key=lambda d: (len(d), [number[x] for x in d]))
            others = [x for x in smallest if x is not s]
            later = [x for x in others if number[x] > number[s]]
            # of two coordinates that only ever appear together, the first one declared is the one measured from
            rest = others if len(holding) > 1 or not later else [x for x in others if x not in later]
            if len(rest) and all(set(smallest) <= set(d) for d in holding):
                found[s] = MeasuredFrom(True, min(rest, key=lambda x: (reach[x], -number[x])))
            else:
                found[s] = MeasuredFrom(True, None)
        else:
            found[s] = MeasuredFrom(False, None, known=False)
    return found


def _where(model: Model, body: Element) -> tuple[sp.Expr, ...]:
    return tuple(model.expand(x) for x in model.position(body.at))  # type: ignore[attr-defined]


def _chain(point: Point) -> list[Point]:
    chain: list[Point] = []
    at: Point | None = point
    while at is not None and not at.is_origin:
        chain.append(at)
        at = at.parent
    return chain


def _frames(model: Model) -> list[Frame]:
    found: list[Frame] = []
    starts = [f for b in model.bodies for _, f in b.frames()]
    starts += [p.frame for b in model.bodies for p in _chain(b.at) if p.frame is not None]
    for start in starts:
        at: Frame | None = start
        while at is not None and at not in found:
            found.append(at)
            at = at.parent
    return found


def _directions(model: Model, symbols: list[sp.Expr]) -> list[tuple[sp.Expr, ...]]:
    """The sets of coordinates that occur in each direction of the system."""
    arguments: list[sp.Expr] = []
    for body in model.bodies:
        for point in _chain(body.at):
            for x in point.offset:
                arguments += [cast("sp.Expr", f.args[0]) for f in model.expand(x).atoms(sp.sin, sp.cos)]
    for frame in _frames(model):
        arguments.append(model.expand(frame.total_angle if frame.axis is None else frame.angle))
    sets = {tuple(s for s in symbols if a.has(s)) for a in arguments}
    return sorted((s for s in sets if s), key=lambda s: (len(s), [symbols.index(x) for x in s]))


def _carriers(model: Model, symbols: list[sp.Expr]) -> dict[sp.Expr, sp.Expr]:
    """In space: a coordinate of a frame with a rotating parent is measured from the nearest coordinate that turns
    it."""
    carried: dict[sp.Expr, sp.Expr] = {}
    for frame in _frames(model):
        if frame.axis is None:
            continue
        own = [s for s in symbols if model.expand(frame.angle).has(s)]
        at = frame.parent
        while at is not None and own:
            turning = [s for s in symbols if model.expand(at.angle).has(s) and s not in own]
            if turning:
                carried.update({s: turning[-1] for s in own if s not in carried})
                break
            at = at.parent
    return carried


def _lengths(model: Model, symbols: list[sp.Expr]) -> set[sp.Expr]:
    """The coordinates that occur in a position outside any sine or cosine."""
    known, outside = set(symbols), set[sp.Basic]()
    waiting: list[sp.Basic] = [x for body in model.bodies for x in _where(model, body)]
    while waiting:
        part = waiting.pop()
        if part in outside or isinstance(part, (sp.sin, sp.cos)):
            continue
        outside.add(part)
        if part not in known:
            waiting += part.args
    return {s for s in symbols if s in outside}


def _turns(model: Model, symbols: list[sp.Expr]) -> set[sp.Expr]:
    """The coordinates that are the angle of a frame: these are angles, even if something rolls along by R φ."""
    known, found = set(symbols), set[sp.Expr]()
    for frame in _frames(model):
        angle = model.expand(frame.total_angle if frame.axis is None else frame.angle)
        there = (known - found) & bounded.names(angle)
        found |= {s for s in there if bounded.diff(angle, s) in (1, -1)}
    return found


def _carried_by(model: Model, s: sp.Expr, symbols: list[sp.Expr], reach: dict[sp.Expr, int]) -> sp.Expr | None:
    """The nearest coordinate that carries along everything that ``s`` moves, and something that ``s`` does not move."""
    places = [_where(model, b) for b in model.bodies]
    mine = [p for p in places if any(depends(model, x, s) for x in p)]
    others = [p for p in places if p not in mine]
    candidates: list[sp.Expr] = []
    for other in symbols:
        if other is s or not all(any(depends(model, x, other) for x in p) for p in mine):
            continue
        if any(any(depends(model, x, other) for x in p) for p in others):
            candidates.append(other)
    return min(candidates, key=lambda x: (reach[x], -symbols.index(x)), default=None)


def chain_of(relative: Mapping[sp.Expr, sp.Expr | None], symbol: sp.Expr) -> list[sp.Expr]:
    """The coordinates that are measured from ``symbol``, directly or through others: its children."""
    children = [s for s, to in relative.items() if to == symbol]
    return children + [g for c in children for g in chain_of(relative, c)]
