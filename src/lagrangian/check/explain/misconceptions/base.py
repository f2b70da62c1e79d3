"""The definition of a misconception: one deliberate mistake, and what it adds to energies, forces and equations.

Lagrange's equations are linear in T*, V and Ξ. Therefore a system that is derived with a mistake differs from the right
one only by the contribution of the mistake: wrong row i = right row i + d/dt ∂ΔT/∂ξ̇_i − ∂ΔT/∂ξ_i + ∂ΔV/∂ξ_i − ΔΞ_i +
Δrow_i.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, Protocol, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.terms.pieces import partner as partner
from lagrangian.derive import Derived
from lagrangian.derive.algebra import Algebra
from lagrangian.errors import ModelError
from lagrangian.model import Action, Body, Coordinate, Element, Gravity, Model, RigidBody, Spring, time
from lagrangian.page.formula import Text
from lagrangian.records import dataclass, field
from lagrangian.values.dimensions import NONE, check_dimensions

ENERGIES = frozenset({"T", "V", "L", "Xi", "D"})
NO_D = ENERGIES - {"D"}
"""For what is done to forces of pairs or to single equations: D has neither."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Variant:
    """One way to make a mistake in one system: what it adds, and a description of what was done.

    ``T`` and ``V`` are added to the energies, in the equations ``only`` (all unless given). ``Xi`` is added to the
    generalized forces and ``rows`` to the left-hand sides, by the index of the coordinate. ``stated`` are the kinds of
    lines in which it is visible besides the equations. If two variants explain an answer, the one with less ``doubt``
    is reported. ``step`` is where it was made, if that is not the step of the misconception, and ``why`` why it is
    wrong, if that is not what holds for its other variants.
    """

    what: Text
    T: sp.Expr = sp.S.Zero
    V: sp.Expr = sp.S.Zero
    Xi: Mapping[int, sp.Expr] = field(default_factory=dict)
    rows: Mapping[int, sp.Expr] = field(default_factory=dict)
    only: frozenset[int] | None = None
    element: Element | None = None
    coordinate: int | None = None
    stated: frozenset[str] = ENERGIES
    doubt: int = 0
    step: int | None = None
    why: Text | None = None
    body: str | None = None
    """The body whose weight it is, where the element is gravity."""


class Misconception(Protocol):
    """A module in this folder: the step to which the mistake belongs, why it is wrong, and its variants in a system."""

    STEP: int
    WHY: Text

    @property
    def wrong(self) -> Callable[[Ingredients], Iterator[Variant]]:
        """Yield every way to make this mistake in a system."""
        ...


class Ingredients:
    """The ingredients of a system's equations that misconceptions change; definitions are written out."""

    def __init__(self, derivation: Derived) -> None:
        self.derivation = derivation
        self.model: Model = derivation.model
        self.coordinates: tuple[Coordinate, ...] = self.model.coordinates
        self.n = len(self.coordinates)
        self.q: list[Any] = [c.symbol for c in self.coordinates]
        self.v: list[Any] = [c.rate for c in self.coordinates]
        self.a: list[Any] = [c.acceleration for c in self.coordinates]
        self._memo: dict[Any, Any] = {}

    def kept(self, key: Any, make: Callable[[], Any]) -> Any:
        """Return the result of ``make``, computed once for every key."""
        if key not in self._memo:
            self._memo[key] = make()
        return self._memo[key]

    def expand(self, expr: Any) -> sp.Expr:
        """An expression with its definitions written out."""
        return self.model.expand(sp.sympify(expr), constants=True)

    @cached_property
    def algebra(self) -> Algebra:
        """The ring of normal forms in the coordinates."""
        return Algebra(self.model)

    @cached_property
    def T(self) -> sp.Expr:
        """The kinetic co-energy."""
        return self.expand(self.derivation.T)

    @cached_property
    def V(self) -> sp.Expr:
        """The potential energy."""
        return self.expand(self.derivation.V)

    @cached_property
    def Xi(self) -> list[sp.Expr]:
        """The generalized forces."""
        return [self.expand(self.derivation.Xi[q]) for q in self.q]

    @cached_property
    def momenta(self) -> list[sp.Expr]:
        """∂T*/∂ξ̇_i."""
        return [bounded.diff(self.T, v) for v in self.v]

    @cached_property
    def bodies(self) -> tuple[Any, ...]:
        """Particles and rigid bodies."""
        return self.model.bodies

    def position(self, body: Any) -> tuple[sp.Expr, ...]:
        """The position of a body along the fixed axes."""
        return tuple(self.expand(x) for x in self.model.position(body.at))

    def parent(self, body: Any) -> tuple[sp.Expr, ...]:
        """The point from which the position of a body is measured."""
        zero = (sp.S.Zero,) * self.model.dimension
        if body.at.parent is None or body.at.parent.is_origin:
            return zero
        return tuple(self.expand(x) for x in self.model.position(body.at.parent))

    def velocity(self, body: Any) -> tuple[sp.Expr, ...]:
        """The velocity of a body's centre of mass along the fixed axes."""
        return self.kept(("v", body), lambda: tuple(self.rate(x) for x in self.position(body)))

    def omega(self, body: Any) -> tuple[sp.Expr, ...]:
        """The angular velocity of a rigid body; nothing for a particle."""
        if ("w", body) not in self._memo:
            self._memo["w", body] = tuple(map(self.expand, body.angular_velocity(self.model)))
        return self._memo["w", body]

    def translation(self, body: Any) -> sp.Expr:
        """½ m v²."""
        return half_square(self.expand(body.mass), self.velocity(body))

    def rotation(self, body: Any) -> sp.Expr:
        """½ ωᵀ I ω."""
        if body.axes is None:
            return sp.S.Zero
        return self.kept(("J", body), lambda: self.rotating(body, self.omega(body)))

    def rotating(self, body: RigidBody, omega: tuple[sp.Expr, ...]) -> sp.Expr:
        """½ ωᵀ I ω with a different ω."""
        inertia = cast("list[list[sp.Expr]]", body.inertia.tolist())
        turned = [sp.Add(*[J * w for J, w in zip(row, omega, strict=True) if J != 0 and w != 0]) for row in inertia]
        return self.expand(sp.Add(*[w * x for w, x in zip(omega, turned, strict=True) if w != 0]) / 2)

    def kinetic(self, element: Element) -> sp.Expr:
        """The contribution of an element to T*."""
        if isinstance(element, Body):
            return self.translation(element) + self.rotation(element)
        return self.expand(element.kinetic(self.model))

    def weights(self) -> Iterator[tuple[Gravity, Any, sp.Expr]]:
        """Gravity, body and m g h for every body on which gravity acts; constant heights are omitted."""
        if "weights" not in self._memo:
            every = [
                (element, body, self.expand(energy))
                for element in self.model.elements
                if isinstance(element, Gravity)
                for body, energy in element.portions(self.model)
            ]
            self._memo["weights"] = [w for w in every if self.moves(w[2])]
        yield from self._memo["weights"]

    def springs(self) -> Iterator[tuple[Spring, sp.Expr, sp.Expr]]:
        """The spring, its extension δ − δ₀ and its energy, for every spring."""
        for element in self.model.elements:
            if isinstance(element, Spring):
                yield (
                    element,
                    self.expand(element.extension(self.model)),
                    self.expand(element.potential(self.model)),
                )

    @cached_property
    def acting(self) -> tuple[Element, ...]:
        """Forces, torques and dampers."""
        return tuple(e for e in self.model.elements if e.ledger == "Ξ")

    @cached_property
    def resisting(self) -> tuple[Element, ...]:
        """Dampers, and forces that depend only on rates, which also damp."""
        inputs = [u.symbol for u in self.model.inputs]
        found: list[Element] = []
        for element in self.acting:
            shares = self.shares(element).values()
            drag = bool(shares) and all(x.has(*self.v) and not x.has(*inputs) for x in shares)
            if element.resists or drag:
                found.append(element)
        return tuple(found)

    def actions(self, element: Element) -> tuple[Action, ...]:
        """The actions of an element, for virtual work."""
        return element.works(self.model)

    def xi(self, actions: tuple[Action, ...], i: int) -> sp.Expr:
        """Σ effort · ∂rate/∂ξ̇_i."""
        return self.expand(sp.Add(*[a.effort * bounded.diff(a.rate, self.v[i]) for a in actions]))

    def shares(self, element: Element) -> dict[int, sp.Expr]:
        """The contribution of an element to every Ξ to which it contributes."""
        if ("Xi", element) not in self._memo:
            actions = self.actions(element)
            found = {i: self.xi(actions, i) for i in range(self.n)}
            self._memo["Xi", element] = {i: x for i, x in found.items() if x != 0}
        return self._memo["Xi", element]

    def coupling(self, body: Any, j: int, k: int) -> tuple[sp.Expr, sp.Expr]:
        """∂²T/∂ξ̇_j∂ξ̇_k of a body's translation, m ∂v/∂ξ̇_j · ∂v/∂ξ̇_k, and of its rotation, the same with I and ω."""
        slopes = self._slopes(body)
        (vj, wj), (vk, wk) = slopes[j], slopes[k]
        turned = (wj.T * body.inertia * wk)[0] if wj is not None and wk is not None else sp.S.Zero
        return self.expand(body.mass) * vj.dot(vk), self.expand(turned)

    def _slopes(self, body: Any) -> list[tuple[sp.Matrix, sp.Matrix | None]]:
        """∂v/∂ξ̇ and ∂ω/∂ξ̇ for every coordinate."""
        if ("slopes", body) not in self._memo:
            velocity, omega = sp.Matrix(self.velocity(body)), sp.Matrix(self.omega(body))
            self._memo["slopes", body] = [(_slopes(velocity, v), _slopes(omega, v) if omega else None) for v in self.v]
        return self._memo["slopes", body]

    def rate(self, expr: sp.Expr) -> sp.Expr:
        """The time derivative d/dt."""
        return bounded.diff(expr, time)

    def moves(self, expr: sp.Expr) -> bool:
        """Whether an expression contains a coordinate."""
        return expr.has(*self.q)

    @cached_property
    def dimensions(self) -> Any:
        """What is known of the dimensions; None if they contradict each other."""
        try:
            return check_dimensions(self.model)
        except ModelError:
            return None

    @cached_property
    def ratios(self) -> list[sp.Symbol]:
        """The parameters without a unit that are no angles, such as the ratio of a gear."""
        dims = self.dimensions
        if dims is None:
            return []
        angles = {x for f in (self.T + self.V).atoms(sp.sin, sp.cos) for x in f.free_symbols}
        pure = [p.symbol for p in self.model.parameters if (d := dims.of(p.symbol)) and not d.unknown and d == NONE]
        return [p for p in pure if p not in angles]

    @cached_property
    def carried(self) -> list[sp.Expr]:
        """The prescribed motions in positions of bodies, such as A sin ωt of a shaken pivot."""
        return self._prescribed(x for b in self.bodies for x in self.position(b))

    @cached_property
    def driven(self) -> list[sp.Expr]:
        """These, and those of the ends of springs, such as e sin Ωt of a crank."""
        return list(dict.fromkeys([*self.carried, *self._prescribed(x for _, x, _ in self.springs())]))

    def _prescribed(self, exprs: Iterable[sp.Expr]) -> list[sp.Expr]:
        pieces = [p for x in exprs for p in sp.Add.make_args(bounded.expand(x))]
        return list(dict.fromkeys(p for p in pieces if p.has(time) and not p.has(*self.q)))

    def angles(self, expr: sp.Expr) -> list[sp.Expr]:
        """The arguments of sines and cosines that depend on coordinates."""
        found = {cast("sp.Expr", f.args[0]) for f in expr.atoms(sp.sin, sp.cos)}
        return sorted((a for a in found if a.has(AppliedUndef)), key=sp.default_sort_key)

    def is_carried(self, angle: sp.Expr) -> bool:
        """Whether a part of an angle is given in time, such as Ω t in Ω t + ψ."""
        return any(x.has(time) and not x.has(*self.q) for x in sp.Add.make_args(bounded.expand(angle)))


def _slopes(vector: sp.Matrix, by: sp.Expr) -> sp.Matrix:
    """The derivative of every component."""
    return sp.Matrix([bounded.diff(x, by) for x in cast("Sequence[sp.Expr]", vector.flat())])


def put(expr: Any, table: Mapping[Any, Any]) -> sp.Expr:
    """Return an expression in which symbols are replaced by others, all at once."""
    return cast("sp.Expr", expr.xreplace(dict(table)))


def letters(expr: sp.Expr) -> list[Any]:
    """The constants in an expression, by name."""
    return sorted((s for s in expr.free_symbols if s != time), key=str)


def half_square(mass: sp.Expr, velocity: tuple[sp.Expr, ...]) -> sp.Expr:
    """½ m (v_x² + v_y² + …)."""
    return mass / 2 * sp.Add(*[v**2 for v in velocity])


def negative(forces: Mapping[int, sp.Expr], times: Any = 1) -> dict[int, sp.Expr]:
    """The forces with the opposite sign, times a factor."""
    return {i: -times * x for i, x in forces.items()}
