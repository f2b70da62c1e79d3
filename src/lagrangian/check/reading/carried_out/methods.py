"""SymPy's LagrangesMethod and KanesMethod, carried out on symbols: the equations that they form."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.mechanics import Mass, SymbolicFrame, SymbolicPoint, Vector, masses
from lagrangian.check.reading.carried_out.values import (
    TIME,
    UNKNOWN,
    AbandonedError,
    BoundMethod,
    Mechanical,
    Outside,
    Value,
    checked,
    listed,
    scalar,
    slope,
)
from lagrangian.records import dataclass, field

_SOLVED = frozenset(["rhs", "mass_matrix", "forcing", "mass_matrix_full", "forcing_full"])
"""What a method is asked for in place of its equations."""

Load = tuple[Any, Vector]
"""A force at a point, or a torque on a frame."""


def _loads(value: Value) -> list[Load]:
    if value is None or isinstance(value, Outside):
        return []
    found = [tuple(listed(x)) for x in listed(value)]
    if not all(
        len(x) == 2 and isinstance(x[0], (SymbolicPoint, SymbolicFrame)) and isinstance(x[1], Vector) for x in found
    ):
        raise AbandonedError
    return found  # type: ignore[return-value]  # pairs


def _velocity(of: SymbolicPoint | SymbolicFrame) -> Vector:
    return of.moving() if isinstance(of, SymbolicPoint) else of.rate()


def _columns(value: Value) -> list[Value]:
    return listed(value) if isinstance(value, (list, tuple, MatrixBase)) else [value]


@dataclass(eq=False)
class MechanicsMethod(Mechanical):
    """A method of SymPy's mechanics. ``told`` are equations that its results say and the program may not show."""

    coordinates: list[Any]
    told: list[MatrixBase] = field(default_factory=list)
    hidden: list[MatrixBase] = field(default_factory=list)
    """The parts of the equations that say nothing alone: F_r and F_r*."""

    formed: list[MatrixBase] = field(default_factory=list)
    """What the program formed."""

    def equations(self) -> MatrixBase:
        """The left-hand sides of the equations, which are 0."""
        raise NotImplementedError

    def attribute(self, name: str) -> Value:
        """The equations, or a method."""
        if name == "eom":
            return self.equations()
        if name in _SOLVED and name != "rhs":
            self.told.append(self.equations())
            return UNKNOWN
        return BoundMethod(self, name)

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """What a method forms."""
        if name == "form_lagranges_equations":
            self.formed.append(self.equations())
            return self.formed[-1]
        if name in _SOLVED:
            self.told.append(self.equations())
        return UNKNOWN


@dataclass(eq=False)
class OfLagrange(MechanicsMethod):
    """Lagrange's equations with the forces of a list and with multipliers."""

    lagrangian: sp.Expr = sp.S.Zero
    loads: list[Load] = field(default_factory=list)
    rows: list[list[sp.Expr]] = field(default_factory=list)

    def equations(self) -> MatrixBase:
        """d/dt ∂L/∂q̇ − ∂L/∂q − Q + Aᵀλ."""
        found: list[sp.Expr] = []
        for k, q in enumerate(self.coordinates):
            rate = q.diff(TIME)
            left = slope(slope(self.lagrangian, rate), TIME) - slope(self.lagrangian, q)
            work = [force.dot(_velocity(of).slope(rate)) for of, force in self.loads]
            pushed = [sp.Function(f"lam{j}")(TIME) * row[k] for j, row in enumerate(self.rows, 1)]
            found.append(checked(left - sp.Add(*work) + sp.Add(*pushed)))
        return sp.Matrix(found)


@dataclass(eq=False)
class OfKane(MechanicsMethod):
    """Kane's equations in rates of coordinates."""

    speeds: list[Any] = field(default_factory=list)
    kinematic: list[sp.Expr] = field(default_factory=list)
    bodies: list[Mass] = field(default_factory=list)
    loads: list[Load] = field(default_factory=list)

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """F_r and F_r* of bodies and loads, in either order."""
        if name != "kanes_equations":
            return super().call(name, given, options)
        for x in (*given, *options.values()):
            if found := masses([x]):
                self.bodies = found
            else:
                self.loads = _loads(x)
        parts = self._parts()
        self.told.append(parts[0] + parts[1])
        self.hidden += parts
        return list(parts)

    def equations(self) -> MatrixBase:
        """The sum of both."""
        fr, star = self._parts()
        return fr + star

    def _rates(self) -> dict[Any, sp.Expr]:
        """The rates of the coordinates in the speeds."""
        return self._solved([q.diff(TIME) for q in self.coordinates])

    def _meanings(self) -> dict[Any, sp.Expr]:
        """The speeds in rates of the coordinates; none where the speeds are these rates."""
        found = self._solved([u for u in self.speeds if not isinstance(u, sp.Derivative)])
        return {u.diff(TIME): slope(x, TIME) for u, x in found.items()} | found

    def _solved(self, unknowns: Sequence[Any]) -> dict[Any, sp.Expr]:
        """What the kinematic equations say of unknowns, whose factors in these are numbers."""
        if not unknowns or not self.kinematic:
            return {}
        A = sp.Matrix([[slope(x, u) for u in unknowns] for x in self.kinematic])
        rest = sp.Matrix([x.xreplace(dict.fromkeys(unknowns, sp.S.Zero)) for x in self.kinematic])
        if A.shape[0] != A.shape[1] or A.atoms(sp.Symbol, AppliedUndef) or A.det() == 0:
            raise AbandonedError
        return dict(zip(unknowns, (-A.inv() * rest).flat(), strict=True))

    def _parts(self) -> tuple[MatrixBase, MatrixBase]:
        own = any(not isinstance(u, sp.Derivative) for u in self.speeds)
        rates, meanings = self._rates() if own else {}, self._meanings()
        fr, star = [sp.S.Zero] * len(self.speeds), [sp.S.Zero] * len(self.speeds)
        for of, force in self.loads:
            v = _velocity(of).put(rates)
            fr = [x + force.dot(v.slope(u)) for x, u in zip(fr, self.speeds, strict=True)]
        for body in self.bodies:
            v = body.at.moving().put(rates)
            pulls = [(v, v.moved().put(rates).scaled(body.mass))]
            if body.frame is not None and body.inertia is not None:
                w = body.frame.rate().put(rates)
                spun = body.inertia.along(w)
                pulls.append((w, spun.moved().put(rates)))
            for x, pull in pulls:
                star = [y - pull.dot(x.slope(u)) for y, u in zip(star, self.speeds, strict=True)]
        put = [sp.Matrix([checked(x.xreplace(meanings)) for x in column]) for column in (fr, star)]
        return put[0], put[1]


def method(name: str, given: Sequence[Value], options: Mapping[str, Value]) -> MechanicsMethod | None:
    """The method that a program sets up; None for any other routine."""
    if name == "LagrangesMethod" and len(given) > 1:
        qs = _columns(given[1])
        rows: list[list[sp.Expr]] = []
        for f in _columns(options.get("hol_coneqs", [])):
            rows.append([slope(scalar(f), q) for q in qs])
        for f in _columns(options.get("nonhol_coneqs", [])):
            rows.append([slope(scalar(f), q.diff(TIME)) for q in qs])
        return OfLagrange(qs, lagrangian=scalar(given[0]), loads=_loads(options.get("forcelist")), rows=rows)
    if name == "KanesMethod" and len(given) + len(options) > 2:
        if any("dependent" in x or "constraint" in x for x in options):
            raise AbandonedError
        named = dict(zip(("frame", "q_ind", "u_ind", "kd_eqs"), given, strict=False)) | dict(options)
        kinematic = [scalar(x) for x in _columns(named.get("kd_eqs", []))]
        bodies, loads = masses([named.get("bodies", [])]), _loads(named.get("forcelist"))
        return OfKane(
            _columns(named["q_ind"]), speeds=_columns(named["u_ind"]), kinematic=kinematic, bodies=bodies, loads=loads
        )
    return None
