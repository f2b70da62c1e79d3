"""The nodes of a system's graph that people would name, in the order in which a lecture introduces them."""

from __future__ import annotations

from lagrangian.derive import QuantityKind
from lagrangian.dynamics.axes import Accelerations
from lagrangian.dynamics.description import Description
from lagrangian.dynamics.mechanics import Mechanics, Pairs
from lagrangian.dynamics.vectors import Vector, cross, plus, scaled, times
from lagrangian.model import Body
from lagrangian.records import dataclass
from lagrangian.structured.names import Indices


@dataclass(frozen=True)
class Candidate:
    """A node that may get a name: a ``letter`` with the parts of its ``index``; ``inward`` marks a sum over everything
    further out. ``words`` say what it belongs to.
    """

    node: int
    kind: QuantityKind
    letter: str
    index: tuple[str, ...]
    words: str
    inward: bool = False
    elements: tuple[str, ...] = ()
    negative: bool = False


@dataclass(frozen=True)
class BodyMotion:
    """A body with its momentum and inertial force, component by component, on the velocities they belong to."""

    body: Body
    index: str
    velocity: Vector
    omega: Vector
    P: Vector
    H: Vector
    F: Vector
    N: Vector

    def momenta(self) -> Pairs:
        """Its (velocity, momentum) pairs."""
        return [*zip(self.velocity, self.P, strict=True), *zip(self.omega, self.H, strict=True)]

    def inertial(self) -> Pairs:
        """Its (velocity, inertial force) pairs."""
        return [*zip(self.velocity, self.F, strict=True), *zip(self.omega, self.N, strict=True)]


def body_motions(d: Description, m: Mechanics, acc: Accelerations, indices: Indices) -> list[BodyMotion]:
    """P = m v, H = J ω, F = m a and N = J α + ω × H of every body, about its centre of mass.

    P and F are in the axes in which its place is given, H and N in the body's own."""
    g = d.graph
    found: list[BodyMotion] = []
    own = _indices(d, indices)
    for body, index in zip(d.model.bodies, own, strict=True):
        place, mass = d.places[body.at], d.node(body.mass)
        P, F = scaled(g, mass, place.velocity), scaled(g, mass, acc.a[place])
        J = [d.nodes(row) for row in body.tensor]
        if body.axes is None or not J:
            found.append(BodyMotion(body, index, place.velocity, [], P, [], F, []))
            continue
        axes = d.axes[body.axes]
        H, N = times(g, J, axes.omega), times(g, J, acc.alpha[axes])
        if len(J) == 3:
            N = plus(g, N, cross(g, axes.omega, H))
        found.append(BodyMotion(body, index, place.velocity, list(axes.omega), P, H, F, N))
    return found


def _indices(d: Description, indices: Indices) -> list[str]:
    """What the bodies are called: as their frames, as their places where a frame has several, otherwise by name."""
    places = [indices.places.get(d.places[body.at], body.name) for body in d.model.bodies]  # one may be at the origin
    frames = [d.axes[body.axes] if body.axes is not None else None for body in d.model.bodies]
    found = [indices.axes[f] if f is not None else place for f, place in zip(frames, places, strict=True)]
    for other in (places, [body.name for body in d.model.bodies]):
        found = [x if found.count(x) == 1 else y for x, y in zip(found, other, strict=True)]
    return found
