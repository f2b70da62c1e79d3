"""Judges lines that state one quantity: T*, V, L, D, a Ξ, ∂L/∂ξ̇ or ∂L/∂ξ; harmless differences are allowed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.difference import differences, likeness
from lagrangian.check.held import OnConstraints, held
from lagrangian.check.motion_names import names_of_motion
from lagrangian.check.reference import Reference
from lagrangian.check.rows import DOUBLE_TOLERANCE, zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.graph import jvp, vjp
from lagrangian.model import time
from lagrangian.page.formula import Name, Text, text
from lagrangian.read.letters import key
from lagrangian.records import dataclass

_NUMBERED = re.compile(r"[\s$&]*(?:\\?Xi|Ξ|[QF])\s?_?\s?\{?\s?\d\s?\}?\s*&?=")
"""A force that is called by the number of its coordinate."""


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
        of_constraints = [sp.Add(*[x * row.diff(x) for x in forces]) for row in truth.rows]
        whole = [truth.Xi[i] if (mine := self.Xi[i]) is None else mine for i in range(truth.n)]
        D = self.D if self.D is not None else dissipation(truth)
        driven = [driving(truth, i) if (mine := self.Xi[i]) is None else mine for i in range(truth.n)]
        damped = [x - D.diff(c.rate) for x, c in zip(driven, truth.model.coordinates, strict=True)]
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


def judge(truth: Reference, lines: Sequence[AnsweredLine], k: int, turn: sp.Matrix | None = None) -> Finding:
    """The finding for line number ``k``, which may follow from lines above it.

    ``turn`` is (∂ψ/∂ξ)⁻¹ if the answer has its own coordinates: the quantity of one of them is then a sum of ours.
    """
    line = lines[k]
    i = index_of(truth, line.name)
    right = right_value(truth, line, i, turn)
    if right is None:
        return Finding(line, Status.RIGHT)
    coordinate = truth.model.coordinates[i].name if i is not None else None
    rest = line.expr - right
    own = line.kind == "derived" or (line.kind == "identity" and i is not None)
    if zero_everywhere(truth, rest):
        return Finding(line, Status.RIGHT, text("it follows from the energies above") if own else None, coordinate)
    if line.kind == "identity" and line.name is not None and i is None:
        return Finding(line, Status.WRONG)
    if own:
        return Finding(line, Status.WRONG, text("it is not the derivative of what is stated above"), coordinate)
    if (note := harmless(truth, line, rest)) is not None:
        return Finding(line, Status.EQUIVALENT, note, coordinate)
    if line.kind in ("T", "V", "L", "D") and (on := _on_constraints(truth)) is not None:
        left = on.put_in(rest)
        if zero_everywhere(truth, left) or harmless(truth, line, left) is not None:
            return Finding(line, Status.EQUIVALENT, text("with the constraint put in"), coordinate)
    if line.kind == "Xi" and i is not None and (note := _along_others(truth, lines, i, line)) is not None:
        return Finding(line, Status.EQUIVALENT, note, coordinate)
    undamped = without_dampers(truth, line, i, lines) if line.kind == "Xi" else None
    right = right if undamped is None else undamped
    if undamped is not None and zero_everywhere(truth, line.expr - right):
        note = text("without the dampers, which stand on the left of the equation or in ", Name("D"))
        return Finding(line, Status.EQUIVALENT, note, coordinate)
    follows = _follows(truth, line, i, given(truth, lines[:k]))
    mine, own = truth.form(line.expr), truth.form(right)
    differing = differences(truth, mine, own, sp.S.One, i) if mine is not None and own is not None else ()
    if line.kind in ("V", "L"):  # a constant is nobody's mistake
        moving = [x for c in truth.model.coordinates for x in (c.symbol, c.rate)]
        differing = tuple(d for d in differing if d.term.has(*moving) or d.written.has(*moving))
    return Finding(line, Status.WRONG, None, coordinate, differing, follows)


def _on_constraints(truth: Reference) -> OnConstraints | None:
    """The reference at states on the constraints; None for a system without any."""
    return held(truth) if truth.derivation.multipliers else None


def _along_others(truth: Reference, lines: Sequence[AnsweredLine], i: int, line: AnsweredLine) -> Text | None:
    """What to say of a Ξ_i that is right where ξ_i moves other coordinates.

    Constraints determine them, and no Ξ of these is stated; or a coordinate of the answer's own, w = f(ξ), replaces ξ_k
    in all equations: with w held, ξ_i moves ξ_k by −(∂f/∂ξ_i)/(∂f/∂ξ_k), and Ξ_w = Ξ_k/(∂f/∂ξ_k).
    """
    stated = {x.name for x in lines if x.kind == "Xi"}
    free = [c.symbol for c in truth.model.coordinates if c.name not in stated]
    symbols = [c.symbol for c in truth.model.coordinates]
    on = _on_constraints(truth)
    follows = on is not None and symbols[i] not in on.table and all(x in free for x in symbols if x in on.table)
    if on is not None and follows and zero_everywhere(truth, on.put_in(line.expr - on.force(truth.Xi, i))):
        return text("with the constraint put in")
    used = names_of_motion(truth, lines)
    gone = [k for k, c in enumerate(truth.model.coordinates) if key(c.name) not in used]
    for w in (x for x in lines if x.kind == "definition" and key(str(x.name)) in used):
        slopes = [bounded.diff(truth.expand(w.expr), x) for x in symbols]
        own = i in gone and slopes[i] != 0 and _NUMBERED.match(line.text) is not None
        if own and zero_everywhere(truth, slopes[i] * line.expr - truth.Xi[i]):  # Q_3, where w is the third coordinate
            return text("with ", Name(str(w.name)), " as a coordinate in place of ", symbols[i])
        for k in (k for k in gone if k != i and 0 not in (slopes[i], slopes[k])):
            of_w = truth.Xi[k] / slopes[k]
            others = [x.expr for x in lines if x.kind == "Xi" and index_of(truth, x.name) == k]
            if all(zero_everywhere(truth, x - of_w) for x in (*others, (truth.Xi[i] - line.expr) / slopes[i])):
                return text("with ", Name(str(w.name)), " as a coordinate in place of ", symbols[k])
    return None


def without_dampers(
    truth: Reference, line: AnsweredLine, i: int | None, lines: Sequence[AnsweredLine]
) -> sp.Expr | None:
    """Ξ_i without the dampers where a line may be meant so: it holds none, and D or the equation of ξ_i holds what they
    add.

    None if it is meant as the whole.
    """
    if i is None:
        return None
    damping = truth.Xi[i] - (drive := driving(truth, i))
    added = damping.free_symbols | damping.atoms(sp.Derivative)
    own = damping.free_symbols - drive.free_symbols - {time}
    if own & line.expr.free_symbols:
        return None
    others = [x for x in lines if x.kind in ("D", "equation")]
    holding = [x for x in others if added <= x.expr.free_symbols | x.expr.atoms(sp.Derivative)]
    return drive if any(x.kind == "D" or _resembled(truth, x.expr) in (i, None) for x in holding) else None


@lru_cache(maxsize=64)
def _resembled(truth: Reference, expr: sp.Expr) -> int | None:
    """The coordinate, by its place, whose equation one resembles most; None if it resembles none."""
    found = likeness(truth.form(expr), truth.forms)
    best = max(found, key=lambda x: x.score, default=None)
    return best.index if best is not None and best.score > 0 else None


def index_of(truth: Reference, name: str | None) -> int | None:
    """The index of the coordinate with a name."""
    return next((i for i, c in enumerate(truth.model.coordinates) if c.name == name), None)


def right_value(truth: Reference, line: AnsweredLine, i: int | None, turn: sp.Matrix | None = None) -> sp.Expr | None:
    """The right value for the line; None if there is nothing to compare with. Ξ_η = (∂ξ/∂η)ᵀ Ξ_ξ, see `judge`."""
    if line.kind in ("T", "V", "L"):
        return {"T": truth.T, "V": truth.V, "L": truth.L}[line.kind]
    if line.kind == "D":
        return dissipation(truth)
    if line.kind in ("identity", "derived"):
        return sp.S.Zero
    if i is None:
        return None
    own = [_of_coordinate(truth, line.kind, k, truth.L, truth.Xi[k]) for k in range(truth.n)]
    if turn is None or any(x is None for x in own):
        return own[i]
    return sp.Add(*[turn[k, i] * x for k, x in enumerate(own) if x is not None])


def _of_coordinate(truth: Reference, kind: str, i: int, L: sp.Expr, Xi: sp.Expr) -> sp.Expr | None:
    c = truth.model.coordinates[i]
    if kind == "Xi":
        return Xi
    if kind == "p":
        return L.diff(c.rate)
    if kind == "p-rate":
        return bounded.diff(L, c.rate, time)
    if kind == "left":
        return bounded.diff(L, c.rate, time) - L.diff(c.symbol)
    return L.diff(c.symbol) if kind == "slope" else None


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
    if line.kind == "V" and all(zero_everywhere(truth, rest.diff(c.symbol)) for c in coordinates):
        if rest.has(*[c.rate for c in coordinates]):
            return None
        return text("V may differ by a constant")
    if line.kind not in ("L", "T", "D"):
        return None
    if line.kind != "D":
        values = np.abs(left_values(truth, rest))
        if np.isnan(values).all() or np.nanmax(values) > 1e-6:
            return None
    if line.kind in ("L", "T") and all(zero_everywhere(truth, row) for row in left_sides(truth, rest)):
        held = rest.has(*[c.rate for c in coordinates]) or rest.has(*[c.symbol for c in coordinates])
        if line.kind == "T" and held:
            return None
        words = "the time derivative of a function" if held else "a constant"
        return text(f"{line.kind} may differ by {words}: no equation changes")
    if line.kind == "D" and all(zero_everywhere(truth, rest.diff(c.rate)) for c in coordinates):
        return text("up to what no rate changes")
    return None


def _follows(truth: Reference, line: AnsweredLine, i: int | None, above: StatedQuantity) -> bool:
    """Whether a line is the consequence of the lines above it, and of the right T* or V if only one is above it."""
    if line.kind == "L" and (above.T is not None or above.V is not None):
        return zero_everywhere(truth, line.expr - replace(above, L=None).lagrangian(truth))
    if i is None or line.kind not in ("p", "p-rate", "slope", "left") or not above.stated:
        return False
    own = _of_coordinate(truth, line.kind, i, above.lagrangian(truth), sp.S.Zero)
    return own is not None and zero_everywhere(truth, line.expr - own)


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
