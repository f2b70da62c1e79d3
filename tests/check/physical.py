"""Mechanisms that are described twice by the same few lines: as a `System`, and as energies and virtual work in SymPy.

The second description knows nothing of the package's derivation.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp

import lagrangian as lg
from lagrangian.model import time as t

Exprs = Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Body:
    """A body: its mass, where it is, its moment of inertia and the angle by which it is turned."""

    mass: Any
    at: tuple[Any, Any]
    inertia: Any = None
    angle: Any = None


@dataclass(frozen=True, eq=False)
class Link:
    """A spring, damper, force or torque: its constant or value and what it is deflected by."""

    size: Any
    along: Any


@dataclass(frozen=True, eq=False)
class Mechanism:
    """The same mechanism for both descriptions; the names of the elements are the keys."""

    name: str
    q: tuple[Any, ...]
    bodies: Mapping[str, Body] = field(default_factory=dict)
    springs: Mapping[str, Link] = field(default_factory=dict)
    dampers: Mapping[str, Link] = field(default_factory=dict)
    forces: Mapping[str, Link] = field(default_factory=dict)
    g: Any = None
    system: Any = None

    def model(self) -> lg.Derivation:
        """The mechanism, as the package derives it."""
        s = self.system
        for name, b in self.bodies.items():
            at = s.origin + b.at
            if b.inertia is None:
                s.particle(b.mass, at=at, name=name)
            else:
                s.rigid_body(b.mass, b.inertia, at=at, frame=b.angle, name=name)
        if self.g is not None:
            s.gravity((0, -1), self.g)
        for name, x in self.springs.items():
            s.spring(x.size, deflection=x.along, name=name)
        for name, x in self.dampers.items():
            s.damper(x.size, deflection=x.along, name=name)
        for name, x in self.forces.items():
            s.force(x.size, deflection=x.along, name=name)
        return s.derive()

    def put(self, part: str, name: str, value: Any) -> Mechanism:
        """The same with another element."""
        return replace(self, **{part: {**getattr(self, part), name: value}})  # type: ignore[arg-type]

    def steps(self) -> Steps:
        """The energies and generalized forces, element by element."""
        moving: dict[str, Any] = {}
        turning: dict[str, Any] = {}
        heights: dict[str, Any] = {}
        for name, b in self.bodies.items():
            moving[name] = b.mass / 2 * sum(sp.diff(x, t) ** 2 for x in b.at)
            if b.inertia is not None:
                turning[name] = b.inertia / 2 * sp.diff(b.angle, t) ** 2
            if self.g is not None:
                heights[name] = b.mass * self.g * b.at[1]
        springs = {n: x.size / 2 * x.along**2 for n, x in self.springs.items()}
        shares: dict[str, dict[Any, Any]] = {}
        for n, x in self.dampers.items():
            shares[n] = {p: -x.size * sp.diff(x.along, t) * sp.diff(x.along, p) for p in self.q}
        for n, x in self.forces.items():
            shares[n] = {p: x.size * sp.diff(x.along, p) for p in self.q}
        return Steps(self, moving, turning, heights, springs, shares)


@dataclass(frozen=True, eq=False)
class Steps:
    """The steps of a derivation: ½mv², ½Jω² and mgh of every body, ½kδ² of every spring, the shares of every force."""

    of: Mechanism
    moving: Exprs
    turning: Exprs
    heights: Exprs
    springs: Exprs
    shares: Mapping[str, Mapping[Any, Any]]

    def put(self, part: str, name: str, value: Any) -> Steps:
        """The same with another part of one element."""
        return replace(self, **{part: {**getattr(self, part), name: value}})  # type: ignore[arg-type]

    @property
    def T(self) -> Any:
        return sp.Add(*self.moving.values(), *self.turning.values())

    @property
    def V(self) -> Any:
        return sp.Add(*self.heights.values(), *self.springs.values())

    def Xi(self, p: Any) -> Any:
        return sp.Add(*[s.get(p, 0) for s in self.shares.values()])

    def parts(self, p: Any) -> dict[str, Any]:
        """The terms of Lagrange's equation of one coordinate."""
        T, V, v = sp.expand(self.T), self.V, sp.diff(p, t)
        return {"dt": sp.diff(sp.diff(T, v), t), "slope": -sp.diff(T, p), "V": sp.diff(V, p), "Xi": -self.Xi(p)}

    def rows(self) -> list[Any]:
        """All equations, left minus right."""
        return [sp.expand(sp.Add(*self.parts(p).values())) for p in self.of.q]
