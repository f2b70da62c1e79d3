"""Judges lines that state one quantity: T*, V, L, D, a Ξ, ∂L/∂ξ̇ or ∂L/∂ξ; harmless differences are allowed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.all_forces import holds_potential, whole_force
from lagrangian.check.coordinates.chart import OF_COORDINATES, chart, system_coordinates
from lagrangian.check.difference import differences, likeness
from lagrangian.check.held import OnConstraints, held, vanishes_on_constraints
from lagrangian.check.reading import OwnCoordinates
from lagrangian.check.reference import Reference
from lagrangian.check.rows import DOUBLE_TOLERANCE, zero_everywhere
from lagrangian.check.terms.constants import without_constants
from lagrangian.check.verdict import OWN_DERIVATIVES, AnsweredLine, Finding, Status
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.graph import jvp, vjp
from lagrangian.model import time
from lagrangian.page.formula import Name, Text, text
from lagrangian.read.letters import key
from lagrangian.records import dataclass


@dataclass(frozen=True)
class StatedQuantity:
    """The quantities that an answer states: its own T*, V, L, D, and its own Ξ by coordinate; None for those not
    stated."""

    T: sp.Expr | None = None
    V: sp.Expr | None = None
    L: sp.Expr | None = None
    D: sp.Expr | None = None
    Xi: tuple[sp.Expr | None, ...] = ()

    @property
    def stated(self) -> bool:
        """Whether it states an energy, Rayleigh's function or a force."""
        return any(x is not None for x in (self.T, self.V, self.L, self.D, *self.Xi))

    def lagrangian(self, truth: Reference) -> sp.Expr:
        """The answer's Lagrangian: as stated, or its T* − V with the right T* or V for one that is not stated."""
        if self.L is not None:
            return self.L
        return (self.T if self.T is not None else truth.T) - (self.V if self.V is not None else truth.V)

    def rows(self, truth: Reference) -> list[Array]:
        """The equations that follow from what the answer states, d/dt ∂L/∂ξ̇ − ∂L/∂ξ − Ξ − Aᵀλ, at every state.

        Twice: with its Ξ as the whole, and with its Ξ without the dampers, which D adds.
        """
        forces = [m.symbol for m in truth.derivation.multipliers.values()]
        of_constraints = [sp.Add(*[x * bounded.diff(row, x) for x in forces]) for row in truth.rows]
        whole = [truth.Xi[i] if (mine := self.Xi[i]) is None else mine for i in range(truth.n)]
        D = self.D if self.D is not None else dissipation(truth)
        driven = [driving(truth, i) if (mine := self.Xi[i]) is None else mine for i in range(truth.n)]
        damped = [x - bounded.diff(D, c.rate) for x, c in zip(driven, truth.model.coordinates, strict=True)]
        left = left_values(truth, self.lagrangian(truth))
        found: list[Array] = []
        for Xi in (whole, damped):
            efforts = [x - y for x, y in zip(Xi, of_constraints, strict=True)]
            found.append(left - CompiledExpressions(efforts).at(truth.states))
        return found


def given(truth: Reference, lines: Sequence[AnsweredLine]) -> StatedQuantity:
    """The quantities that the lines state; if one is given twice, the last counts."""
    energies = {line.kind: line.expr for line in lines if line.kind in ("T", "V", "L", "D")}
    forces = {line.name: line.expr for line in lines if line.kind == "Xi"}
    Xi = tuple(forces.get(c.name) for c in truth.model.coordinates)
    T, V, L, D = (energies.get(kind) for kind in ("T", "V", "L", "D"))
    return StatedQuantity(T, V, L, D, Xi)


def left_values(truth: Reference, L: sp.Expr) -> Array:
    """d/dt ∂L/∂ξ̇_i − ∂L/∂ξ_i at every state, (n, size), differentiated on the graph."""
    compiled = CompiledExpressions([])
    coordinates, g = truth.model.coordinates, compiled.graph
    q = [compiled.input(c.symbol) for c in coordinates]
    v = [compiled.input(c.rate) for c in coordinates]
    a = [compiled.input(c.acceleration) for c in coordinates]
    slopes = vjp(g, [compiled.node(L)], [g.one], [*q, *v])
    moving = dict(zip((*q, *v), (*v, *a), strict=True)) | {compiled.input(time): g.one}
    rates = jvp(g, slopes[truth.n :], moving)
    compiled.ids = [g.sub(rates[i], slopes[i]) for i in range(truth.n)]
    return compiled.at(truth.states)


def left_sides(truth: Reference, L: sp.Expr) -> list[sp.Expr]:
    """d/dt ∂L/∂ξ̇_i − ∂L/∂ξ_i of every coordinate."""
    return [bounded.diff(L, c.rate, time) - bounded.diff(L, c.symbol) for c in truth.model.coordinates]


def judge(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    k: int,
    change: OwnCoordinates | None = None,
    *,
    compared: bool = True,
) -> Finding | None:
    """The finding for line number ``k``, which may follow from lines above it; None for a coordinate of which nothing
    says what it replaces.

    ``change`` are the coordinates that all lines are in, if these do not say so themselves. Unless it is ``compared``,
    it is not said in which terms a wrong line differs.
    """
    line = lines[k]
    i = index_of(truth, line.name)
    stated_for = _stated_for(truth, lines, line, change)
    own = line.kind in OWN_DERIVATIVES
    stated = own and any(x.kind in (line.kind[0], "L") for x in lines)
    rights = [_of_coordinate(line.kind, by, truth.L, _forces(truth, truth.Xi)) for by in stated_for]
    right = rights[0] if rights else right_value(truth, line, None)
    if right is None:
        return None
    coordinate = truth.model.coordinates[i].name if i is not None else None
    rest = line.expr - right
    if zero_everywhere(truth, rest):
        return Finding(line, Status.RIGHT, text("it follows from the energies above") if stated else None, coordinate)
    if line.kind == "identity" and line.name is not None:
        return Finding(line, Status.WRONG)
    if own:
        note = text("it is not the derivative of what is stated above") if stated else None
        return Finding(line, Status.WRONG, note, coordinate)
    if (note := harmless(truth, line, rest)) is not None:
        return Finding(line, Status.EQUIVALENT, note, coordinate)
    on = _on_constraints(truth)
    if line.kind in ("T", "V", "L", "D") and truth.derivation.multipliers:
        left = rest if on is None else on.put_in(rest)
        held_so = zero_everywhere(truth, left) or harmless(truth, line, left) is not None
        if held_so or (on is None and vanishes_on_constraints(truth, rest)):
            return Finding(line, Status.EQUIVALENT, text("with the constraint put in"), coordinate)
    if any(zero_everywhere(truth, x if on is None else on.put_in(x)) for x in (line.expr - r for r in rights[1:])):
        return Finding(line, Status.EQUIVALENT, _in_own(truth, stated_for[-1][0]), coordinate)
    undamped = [_undamped(truth, line, by, lines) for by in stated_for]
    if any(x is not None and zero_everywhere(truth, line.expr - x) for x in undamped):
        apart = any(x.kind == "D" for x in lines)
        note = text("without the dampers, which stand in ", *((Name("D"),) if apart else ("the equation",)))
        return Finding(line, Status.EQUIVALENT, note, coordinate)
    right = undamped[0] if undamped and undamped[0] is not None else right
    if line.kind == "Xi" and i is not None and not any(x.kind in ("V", "L") for x in lines):
        right = whole_force(truth, i) if holds_potential(truth, i, line.expr) else right
    follows = bool(stated_for) and _follows(truth, line, stated_for[0], given(truth, lines[:k]))
    follows = follows or (line.kind == "L" and _follows_from_parts(truth, line, given(truth, lines[:k])))
    follows = follows or _stands_above(truth, line, lines[:k])
    if not compared:
        return Finding(line, Status.WRONG, None, coordinate, (), follows)
    mine, own = truth.form(line.expr), truth.form(right)
    differing = differences(truth, mine, own, sp.S.One, i, line.expr) if mine is not None and own is not None else ()
    differing = tuple(without_constants(truth, differing)) if line.kind in ("T", "V", "L") else differing
    return Finding(line, Status.WRONG, None, coordinate, differing, follows)


def whole_forces(truth: Reference, lines: Sequence[AnsweredLine], line: AnsweredLine) -> list[sp.Expr]:
    """What a line of a Ξ may state as a whole: Ξ by each coordinate of its name, and Ξ without the dampers where it may
    be meant so."""
    stated_for = _stated_for(truth, lines, line, None)
    whole = [own.along(name, _forces(truth, truth.Xi)) for own, name in stated_for]
    undamped = (_undamped(truth, line, by, lines) for by in stated_for)
    return [*whole, *(x for x in undamped if x is not None)]


By = tuple[OwnCoordinates, str]
"""Coordinates, and the key of one of them."""


def _stated_for(
    truth: Reference, lines: Sequence[AnsweredLine], line: AnsweredLine, change: OwnCoordinates | None
) -> list[By]:
    """What a line states a quantity for: a coordinate of the system, and one of the answer's with the same name."""
    if line.kind not in OF_COORDINATES:
        return []
    i, name = index_of(truth, line.name), key(line.name or "")
    found = [(system_coordinates(truth), name)] if i is not None and change is None else []
    own = change if change is not None else chart(truth, tuple(lines))
    if own is not None and name in own.columns:
        found.append((own, name))
    elif change is not None and i is not None and i < len(change.order):
        found.append((change, change.order[i]))
    return found


def _in_own(truth: Reference, own: OwnCoordinates) -> Text:
    """In which coordinates a line is right."""
    system = {key(c.name): c.symbol for c in truth.model.coordinates}
    new = [x for name in own.columns if name not in system for x in (Name(name), ", ")]
    gone = [x for name, q in system.items() if name not in own.columns for x in (q, ", ")]
    return text("with ", *new[:-1], " in place of ", *gone[:-1]) if new else text("with the constraint put in")


def _on_constraints(truth: Reference) -> OnConstraints | None:
    """The reference at states on the constraints; None for a system without any."""
    return held(truth) if truth.derivation.multipliers else None


def without_dampers(
    truth: Reference, line: AnsweredLine, i: int | None, lines: Sequence[AnsweredLine]
) -> sp.Expr | None:
    """Ξ_i without the dampers where a line may be meant so: it holds none, and a D is stated, right or wrong, or the
    equation of ξ_i holds what they add.

    None if it is meant as the whole.
    """
    return None if i is None else _undamped(truth, line, (system_coordinates(truth), key(str(line.name))), lines)


def _undamped(truth: Reference, line: AnsweredLine, by: By, lines: Sequence[AnsweredLine]) -> sp.Expr | None:
    """The same for a coordinate of the system or of the answer."""
    if line.kind != "Xi":
        return None
    own, name = by
    places = {c.symbol: k for k, c in enumerate(truth.model.coordinates)}
    drive = own.along(name, lambda x: driving(truth, places[x]))
    damping = bounded.expand(own.along(name, _forces(truth, truth.Xi)) - drive)
    added = damping.free_symbols | damping.atoms(sp.Derivative)
    letters = damping.free_symbols - drive.free_symbols - {time}  # not the ratio of a gear, unless it is all they have
    rates = damping.atoms(sp.Derivative) - drive.atoms(sp.Derivative)
    if (letters - truth.L.free_symbols or letters) & line.expr.free_symbols or rates & line.expr.atoms(sp.Derivative):
        return None  # −g φ̇ is meant as the damper's −c φ̇
    i = index_of(truth, line.name)

    def holds(other: AnsweredLine) -> bool:
        if other.kind != "equation" or not added <= other.expr.free_symbols | other.expr.atoms(sp.Derivative):
            return other.kind == "D"
        return i is None or _resembled(truth, other.expr) in (i, None)

    return drive if any(map(holds, lines)) else None


@lru_cache(maxsize=64)
def _resembled(truth: Reference, expr: sp.Expr) -> int | None:
    """The coordinate, by its place, whose equation one resembles most; None if it resembles none."""
    found = likeness(truth.form(expr), truth.forms)
    best = max(found, key=lambda x: x.score, default=None)
    return best.index if best is not None and best.score > 0 else None


def index_of(truth: Reference, name: str | None) -> int | None:
    """The index of the coordinate with a name."""
    return next((i for i, c in enumerate(truth.model.coordinates) if c.name == name), None)


def right_value(truth: Reference, line: AnsweredLine, i: int | None) -> sp.Expr | None:
    """The right value for the line in the system's coordinates; None if there is nothing to compare with."""
    if line.kind in ("T", "V", "L"):
        return truth.energies[line.kind]
    if line.kind == "D":
        return dissipation(truth)
    if line.kind in ("identity", *OWN_DERIVATIVES):
        return sp.S.Zero
    if i is None or line.kind not in OF_COORDINATES:
        return None
    by = system_coordinates(truth), key(truth.model.coordinates[i].name)
    return _of_coordinate(line.kind, by, truth.L, _forces(truth, truth.Xi))


def _of_coordinate(kind: str, by: By, L: sp.Expr, force: Callable[[Any], sp.Expr]) -> sp.Expr:
    """A generalized force, or a derivative of L, by a coordinate."""
    own, name = by
    if kind == "Xi":
        return own.along(name, force)
    slope = partial(bounded.diff, L)
    if kind == "slope":
        return own.slope(name, 0, slope)
    momentum = own.slope(name, 1, slope)
    if kind == "p":
        return momentum
    rate = bounded.diff(momentum, time)
    return rate if kind == "p-rate" else rate - own.slope(name, 0, slope)


def _forces(truth: Reference, Xi: Sequence[sp.Expr]) -> Callable[[Any], sp.Expr]:
    return dict(zip((c.symbol for c in truth.model.coordinates), Xi, strict=True)).__getitem__


def dissipation(truth: Reference) -> sp.Expr:
    """The sum of Rayleigh's functions of all dampers that have one."""
    parts = [e.dissipation(truth.model) for e in truth.model.elements]
    return sp.Add(*[truth.expand(d) for d in parts if d is not None])


def driving(truth: Reference, i: int) -> sp.Expr:
    """Ξ_i without the dampers."""
    total: sp.Expr = sp.S.Zero
    for element in truth.model.elements:
        if element.ledger == "Ξ" and not element.resists:
            rate = truth.model.coordinates[i].rate
            total += truth.expand(sp.Add(*[a.effort * bounded.diff(a.rate, rate) for a in element.works(truth.model)]))
    return total


def _grows(truth: Reference, rest: sp.Expr) -> bool:
    """Whether an expression has a slope by a coordinate, in doubles."""
    compiled = CompiledExpressions([])
    q = [compiled.input(c.symbol) for c in truth.model.coordinates]
    compiled.ids = vjp(compiled.graph, [compiled.node(rest)], [compiled.graph.one], q)
    slopes = np.abs(compiled.at(truth.states))
    return bool(np.isfinite(slopes).all() and slopes.max(initial=0.0) > 1e-6 * (1 + np.median(slopes)))


def harmless(truth: Reference, line: AnsweredLine, rest: sp.Expr) -> Text | None:
    """Why a difference in an energy does not change the equations, in words; None if it does."""
    coordinates = truth.model.coordinates
    if line.kind == "V" and _grows(truth, rest):
        return None
    if line.kind == "V" and unmoved(truth, rest):
        return text("V may differ by a constant")
    if line.kind not in ("L", "T", "D"):
        return None
    if line.kind != "D":
        values = np.abs(left_values(truth, rest))
        if np.isnan(values).all() or np.nanmax(values) > 1e-6:
            return None
    if line.kind in ("L", "T") and all(zero_everywhere(truth, row) for row in left_sides(truth, rest)):
        if (constant := _said_of_unmoved(truth, line, rest)) is not None or line.kind == "T":
            return constant
        return text(f"{line.kind} may differ by the time derivative of a function: no equation changes")
    if line.kind == "D" and all(zero_everywhere(truth, bounded.diff(rest, c.rate)) for c in coordinates):
        return text("up to what no rate changes")
    return text("with the forces that resist as dampers do") if line.kind == "D" and _resists(truth, rest) else None


def _resists(truth: Reference, rest: sp.Expr) -> bool:
    """Whether the slopes by the rates are what elements that are no dampers add to all Ξ because of the rates."""
    still = {c.rate: sp.S.Zero for c in truth.model.coordinates}
    drives = [driving(truth, i) for i in range(truth.n)]
    resisting = [x - x.xreplace(still) for x in drives]
    slopes = [bounded.diff(rest, c.rate) for c in truth.model.coordinates]
    return all(zero_everywhere(truth, a + b) for a, b in zip(slopes, resisting, strict=True))


def unmoved(truth: Reference, rest: sp.Expr) -> bool:
    """Whether no coordinate and no rate changes an expression, however it is written."""
    moving = [x for c in truth.model.coordinates for x in (c.symbol, c.rate)]
    return all(zero_everywhere(truth, bounded.diff(rest, x)) for x in moving)


def _said_of_unmoved(truth: Reference, line: AnsweredLine, rest: sp.Expr) -> Text | None:
    """What is said of a difference in T* or L that no coordinate and no rate changes, as ½ m a² Ω² of what is carried
    around at a given rate; None if one does."""
    if not unmoved(truth, rest):
        return None
    moving = [x for c in truth.model.coordinates for x in (c.symbol, c.rate)]
    form = truth.form(rest)
    value = bounded.expand(rest if form is None else form.expr())
    if not value.free_symbols or value.has(*moving):
        return text(f"{line.kind} may differ by a constant: no equation changes")
    value = -value if value.could_extract_minus_sign() else value
    return text(f"{line.kind} may differ by ", value, ", which no coordinate and no rate changes: no equation changes")


def _follows(truth: Reference, line: AnsweredLine, by: By, above: StatedQuantity) -> bool:
    """Whether a derivative of L is one of the L that stands above it, with the right T* or V if only one does."""
    if line.kind == "Xi" or not above.stated:
        return False
    own = _of_coordinate(line.kind, by, above.lagrangian(truth), lambda _: sp.S.Zero)
    return zero_everywhere(truth, line.expr - own)


def _follows_from_parts(truth: Reference, line: AnsweredLine, above: StatedQuantity) -> bool:
    """Whether an L is that of the T* and V above it, or of one of these and the right other one."""
    if above.T is None and above.V is None:
        return False
    return zero_everywhere(truth, line.expr - replace(above, L=None).lagrangian(truth))


def _stands_above(truth: Reference, line: AnsweredLine, above: Sequence[AnsweredLine]) -> bool:
    """Whether a line above says the same of the same quantity."""
    same = (x for x in above if (x.kind, x.name) == (line.kind, line.name) and x.number < line.number)
    return any(zero_everywhere(truth, line.expr - x.expr) for x in same)


def spanned(P: Array, W: Array) -> bool:
    """Whether all rows of P (k, s) are combinations of the rows of W (n, s) with constant factors."""
    scale = np.abs(W).max(axis=1, keepdims=True)
    unit = W / np.where(scale > 0, scale, 1.0)
    left = np.abs(P - P @ np.linalg.pinv(unit, rcond=1e-10) @ unit).max(axis=1)
    return bool((left <= DOUBLE_TOLERANCE * np.abs(P).max(axis=1)).all())


def equations_follow(truth: Reference, exprs: Sequence[sp.Expr], above: StatedQuantity) -> list[bool]:
    """Which equations follow from the answer's own energies and forces."""
    if not above.stated or not exprs:
        return [False] * len(exprs)
    rows = [W for W in above.rows(truth) if np.isfinite(W).all()]
    P = CompiledExpressions(exprs).at(truth.states)
    half = truth.states.size // 2
    parts = (slice(0, half), slice(half, 2 * half))
    finite: list[bool] = [bool(np.isfinite(p).all()) for p in P]
    return [
        good and any(all(spanned(p[None, s], W[:, s]) for s in parts) for W in rows)
        for p, good in zip(P, finite, strict=True)
    ]
