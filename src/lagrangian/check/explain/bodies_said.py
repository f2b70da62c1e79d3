"""What an answer says of single bodies, v_A = l φ̇ sin φ or J = m r², and the energy that follows from it.

A line that follows exactly from such a definition has its mistake there, whatever else would lead to the same line.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import combinations
from typing import Any, TypeAlias, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import LARGEST
from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.changes.ring import SumRing, TooLong, minus
from lagrangian.check.explain.line_mistakes import without_constant
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.misconceptions.inertia_about_pivot import arms
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.search import SMALL, Explanation
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import Gravity, RigidBody
from lagrangian.page.formula import Left, Text, text
from lagrangian.records import dataclass

MOST_DEFINITIONS = 16
"""The largest number of definitions that are compared with the bodies."""
MOST_TOGETHER = 3
"""The largest number of wrong definitions from which one line follows."""
MOST_PARTS, MOST_FOR_THREE = 60, 16
"""The most quantities of bodies that are tried, and the most of which three are tried together."""
NOT_OF_BODIES = (
    "half_forgotten",
    "mass_swapped",
    "child_mass_forgotten",
    "translation_forgotten",
    "rotation_forgotten",
)
"""Mistakes that are not made in the speed, the position or the inertia of a body."""
LEFT_OUT = ("left_out_of_a_sum", "lost", "lost_in_a_sum", "not_squared")
MOST_LACKING = 2
"""The most terms that are added to what is written, to say what is right."""
LONGEST = 60
"""The largest number of operations of such a definition."""

WHY = {
    "speed": text("The velocity is the derivative of the position; every coordinate that moves the body adds to it."),
    "turning": text("ω is how fast the body itself turns against the fixed axes."),
    "inertia": text("Take the moment of inertia that is given, about the centre of mass."),
    "axis": text(
        "About a parallel axis it is larger, by the mass times the square of the distance of this axis from the centre "
        "of mass."
    ),
    "position": text("Go along the way from the fixed point to the body: every piece of it counts."),
}


@dataclass(frozen=True, eq=False)
class SaidOfBody:
    """One quantity of a body that a definition has wrong, and what this adds to T* and to V."""

    body: Any
    kind: str
    number: int
    """The line in which it is said."""
    what: Text
    letters: frozenset[sp.Basic]
    """The letters, coordinates and rates in what is right and in what is written."""
    written: sp.Expr
    T: sp.Expr
    V: sp.Expr

    @property
    def mistake(self) -> Mistake:
        """The mistake in words."""
        step = 3 if self.T == 0 else 2
        words = {"turning": "angular velocity", "inertia": "moment of inertia", "axis": "moment of inertia"}.get(
            self.kind, self.kind
        )
        brief = text(f"The {words} of {self.body.title} is not right.")
        return Mistake(f"{self.kind}_of_body", self.what, WHY[self.kind], step, self.body.title, None, brief)


def agrees(explanation: Explanation, said: Sequence[SaidOfBody]) -> bool:
    """Whether an explanation may be what the definitions have wrong: it quotes no other letters than these.

    A number, a whole part that is left out, or masses that are exchanged would not show in them.
    """
    known = frozenset[Any]().union(*(p.letters for p in said))
    for t in explanation.told:
        change, wrong = t.mistake.change, t.mistake.wrong
        if wrong is not None:
            quoted = {x for part in wrong.variant.what.parts if isinstance(part, sp.Symbol) for x in letters_in(part)}
            if wrong.name in NOT_OF_BODIES or not quoted <= known:
                return False
        if change is not None:
            exprs = (change.right, change.written)
            right, written = (letters_in(x) if isinstance(x, sp.Expr) else set[Any]() for x in exprs)
            lost = change.kind in LEFT_OUT and right and all(right <= letters_in(p.written) for p in said)
            if change.kind == "part" or lost or not right | written <= known:
                return False
    return True


class BodiesSaid:
    """The wrong definitions of an answer that may be of bodies, ready to be compared with its lines."""

    def __init__(self, truth: Reference, lines: Sequence[AnsweredLine]) -> None:
        self.truth, self.lines = truth, lines

    @cached_property
    def parts(self) -> list[SaidOfBody]:
        """What the definitions may have wrong."""
        told = [x for x in self.lines if x.kind == "definition" and bounded.operations(x.expr) <= LONGEST]
        every = (part for x in told[:MOST_DEFINITIONS] for part in _parts(self.truth, x))
        return [p for p in every if p.T != 0 or p.V != 0][:MOST_PARTS]

    def of_line(self, line: AnsweredLine) -> list[SaidOfBody]:
        """The wrong definitions from which a line of T*, V or L follows; none if it follows from none."""
        truth = self.truth
        if line.kind not in ("T", "V", "L") or not self.parts:
            return []
        right = {"T": truth.T, "V": truth.V, "L": truth.L}[line.kind]
        values = CompiledExpressions([line.expr - right, *self._exprs(line.kind)]).at(truth.states)
        level = values if line.kind == "T" else without_constant(values)
        return self._named(level[0], level[1:])

    def borne_out(self, pool: Pool, group: Sequence[Explanation]) -> list[Explanation]:
        """Of explanations of equations, those that change T* as a wrong definition does; all if no definition does."""
        parts = [p for p in self.parts if p.T != 0 and p.V == 0] if len(group) > 1 else []
        if not parts:
            return list(group)
        found: list[Explanation] = []
        for part, values in zip(parts, CompiledExpressions([p.T for p in parts]).at(self.truth.states), strict=True):
            size = np.abs(values).max()
            if not np.isfinite(values).all() or not 1e-12 < size < LARGEST:
                continue
            for e in group:
                made = np.sum([float(t.times) * pool.T[pool.places[id(t.mistake)]] for t in e.told], axis=0)
                if e not in found and agrees(e, [part]) and np.abs(made - values).max() <= SMALL * size:
                    found.append(e)
        return found or list(group)

    def _exprs(self, kind: str) -> list[sp.Expr]:
        """What each definition adds to an energy."""
        return [{"T": p.T, "V": p.V}.get(kind, p.T - p.V) for p in self.parts]

    def _named(self, rest: Array, effects: Array) -> list[SaidOfBody]:
        """The fewest definitions whose effects add up to what is wrong; none if it is nothing."""
        size = np.abs(rest).max(initial=0.0)
        if not np.isfinite(rest).all() or not 1e-12 < size < LARGEST:
            return []
        good = [k for k, x in enumerate(effects) if np.isfinite(x).all() and np.abs(x).max() > 1e-12]
        for count in range(1, MOST_TOGETHER + 1 if len(good) <= MOST_FOR_THREE else 3):
            for chosen in combinations(good, count):
                said = [self.parts[k] for k in chosen]
                if len({p.number for p in said}) < count:
                    continue
                if np.abs(effects[list(chosen)].sum(axis=0) - rest).max() <= SMALL * size:
                    return sorted(said, key=lambda p: p.number)
        return []


def _parts(truth: Reference, line: AnsweredLine) -> Iterator[SaidOfBody]:
    """What a definition may say wrongly of each body."""
    s, said = ingredients_of(truth.derivation), truth.expand(line.expr)
    moving = [x for c in truth.model.coordinates for x in (c.rate, c.acceleration)]
    if said.free_symbols - truth.names or said.has(*moving[1::2]):
        return
    find = _inertias if not s.moves(said) and not said.has(*moving) else _speeds if said.has(*moving) else _positions
    for b in s.bodies:
        for kind, words, T, V in find(s, b, said) if letters_in(said) else ():
            quoted = frozenset(x for part in words if isinstance(part, sp.Expr) for x in letters_in(part))
            effects = (truth.put(sp.sympify(x)) for x in (T, V))
            yield SaidOfBody(b, kind, line.number, text(*words), quoted, said, *effects)


Found: TypeAlias = Iterator[tuple[str, "tuple[str | Left, ...]", sp.Expr, Any]]
"""The kind of a quantity, the words, and what it adds to T* and to V."""


def _turning(s: Ingredients, b: Any) -> tuple[sp.Expr, sp.Expr] | None:
    """J and ω of a rigid body in the plane; None for any other."""
    omega = s.omega(b) if isinstance(b, RigidBody) else ()
    return (s.expand(b.inertia[0]), omega[0]) if len(omega) == 1 else None


def _inertias(s: Ingredients, b: Any, said: sp.Expr) -> Found:
    if (turning := _turning(s, b)) is not None:
        J, w = turning
        yield "inertia", (f"The moment of inertia of {b.title} is ", J, ", not ", said, "."), (said - J) * w**2 / 2, 0
        for square in arms(s, b) if J.free_symbols and J.free_symbols <= said.free_symbols else ():
            right = J + s.expand(b.mass) * square
            words = (f"The moment of inertia of {b.title} about its pivot is ", right, ", not ", said, ".")
            yield "axis", words, (said - right) * w**2 / 2, 0


def _speeds(s: Ingredients, b: Any, said: sp.Expr) -> Found:
    m, v = s.expand(b.mass), s.velocity(b)
    right = sp.Add(*[x**2 for x in v])
    for square in (said**2, said):
        words = (f"The square of the speed of {b.title} is ", _beside(s, right, square), ", not ", square, ".")
        yield "speed", words, m * (square - right) / 2, 0
    for x in v:
        if x != 0:
            words = (f"One component of the velocity of {b.title} is ", x, ", not ", said, ".")
            yield "speed", words, m * (said**2 - x**2) / 2, 0
    if (turning := _turning(s, b)) is not None:
        J, w = turning
        words = (f"The angular velocity of {b.title} is ", w, ", not ", said, ".")
        yield "turning", words, J * (said**2 - w**2) / 2, 0


def _beside(s: Ingredients, right: sp.Expr, written: sp.Expr) -> sp.Expr:
    """What is right, as what is written and the few terms that this lacks, if these are few: (h θ̇ + ṡ)² + s² θ̇²."""
    ring: SumRing = s.kept("ring", lambda: SumRing(s.model))
    try:
        lacking = ring.fold(minus(ring.of(bounded.expand(right)), ring.of(bounded.expand(written))))
    except TooLong:
        return right
    found = cast("sp.Expr", written + ring.expr(lacking))
    shorter = len(lacking) == 1 or bounded.operations(found) < bounded.operations(right)
    return found if len(lacking) <= MOST_LACKING and shorter else right


def _positions(s: Ingredients, b: Any, said: sp.Expr) -> Found:
    m, v = s.expand(b.mass), s.velocity(b)
    for c, x in enumerate(s.position(b)):
        if s.moves(x):
            lifted = [e.g * e.direction[c] for e in s.model.elements if isinstance(e, Gravity)]
            words = (f"The {'xyz'[c]} coordinate of {b.title} is ", x, ", not ", said, ".")
            V = -m * s.expand(sp.Add(*lifted)) * (said - x)
            yield "position", words, m * (s.rate(said) ** 2 - v[c] ** 2) / 2, V
