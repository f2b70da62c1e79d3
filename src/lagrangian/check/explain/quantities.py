"""What a name of an answer may stand for: a speed, an ω, a deflection, a part of T*, …, and what a wrong one adds.

ω = φ̇ (R − r)/r where a body turns with (R ψ̇ − (R − r) φ̇)/r, d = φ − x where a spring is longer by R φ − x: each is
one mistake, from which the energies and the equations with this name follow.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.accelerations_said import sayable_accelerations
from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.changes.deflections import struts
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.misconceptions.inertia_about_pivot import arms
from lagrangian.check.explain.sayable import Adds, Effect, Sayable, pushing
from lagrangian.check.explain.shafts import shafts
from lagrangian.check.explain.turned_axes import turned_places, turned_velocities
from lagrangian.check.explain.twins import twins
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import Body, Damper, Force, Gravity, RigidBody

SIGNED = frozenset(
    [
        "component", "along", "apart", "turning", "height", "deflection", "rate", "force", "damping", "restoring",
        "acceleration",
    ]
)  # fmt: skip
"""Kinds that an answer may count in the other sense."""
LEVEL = frozenset(["position", "height", "deflection", "potential"])
"""Kinds that a constant does not change."""
EACH = frozenset(
    [
        "speed", "component", "along", "apart", "turning", "height", "kinetic", "translation", "rotation", "potential",
        "inertia",
    ]
)  # fmt: skip
"""Kinds of quantities that are said of each of two equal bodies at once."""
MOST = 100
"""The largest number of quantities of a system."""
AXES = ("first", "second", "third")
"""What the axes of a body are called, in which its moments of inertia are given."""


class Sayables:
    """The quantities of a system, or the accelerations in it, with their values at every state."""

    def __init__(self, truth: Reference, *, accelerations: bool = False) -> None:
        s = ingredients_of(truth.derivation)
        self.of = s
        every: tuple[Sayable, ...] = tuple(sayable_accelerations(s)) if accelerations else _all_of(s)
        own = [q for q in every if q.right != 0]
        self.all = [*own[:MOST], *of_twins(s, own)][: MOST + MOST // 2]
        self.rights = [truth.put(q.right) for q in self.all]
        self.values: Array = CompiledExpressions(self.rights).at(truth.states)


@lru_cache(maxsize=16)
def quantities_of(truth: Reference) -> Sayables:
    """The quantities of a system, collected once for the systems that were checked most recently."""
    return Sayables(truth)


@lru_cache(maxsize=16)
def accelerations_of(truth: Reference) -> Sayables:
    """The accelerations of the bodies of a system, collected where an answer says one."""
    return Sayables(truth, accelerations=True)


def _all_of(s: Ingredients) -> tuple[Sayable, ...]:
    every = (*_of_bodies(s), *_of_springs(s), *_of_dampers(s), *_of_shafts(s), *_of_energies(s))
    return (*every, *_of_coordinates(s), *_turned(s))


def of_twins(s: Ingredients, every: Sequence[Sayable]) -> Iterator[Sayable]:
    """The quantities of two equal bodies that are the same for both, but for a sense: "of a panel" is said of each."""
    for one, other in twins(s):
        seen: Counter[tuple[str, sp.Expr]] = Counter()
        for q in (x for x in every if x.owner is one and x.kind in EACH):
            same = [x for x in every if x.owner is other and x.kind == q.kind and x.right in (q.right, -q.right)]
            if same:
                senses = same[min(seen[q.kind, q.right], len(same) - 1) :]  # a distance is a place, or an arm
                words = tuple(
                    x.replace(one.title, f"{one.title} and {other.title}") if isinstance(x, str) else x for x in q.words
                )
                seen[q.kind, q.right] += 1
                yield replace(q, words=words, adds=partial(_of_both, q, senses[0]), also=(other.title,))


def _of_both(one: Sayable, other: Sayable, said: sp.Expr) -> Effect:
    """What another value adds in both of two bodies."""
    a, b = one.adds(said), other.adds(said if one.right == other.right else -said)
    Xi, left = (tuple(x + y for x, y in zip(p, q, strict=True)) for p, q in ((a.Xi, b.Xi), (a.left, b.left)))
    return Effect(a.T + b.T, a.V + b.V, Xi, left, a.D + b.D)


def _of_bodies(s: Ingredients) -> Iterator[Sayable]:
    for b in s.bodies:
        yield from _speeds(s, b)
        yield from _inertias(s, b)
        yield from _positions(s, b)


def _speeds(s: Ingredients, b: Any) -> Iterator[Sayable]:
    m, v = s.expand(b.mass), s.velocity(b)
    square = sp.Add(*[x**2 for x in v])
    words = (f"square of the speed of {b.title}",)
    yield Sayable("speed", b, words, square, lambda said: Effect(T=m * (said - square) / 2))
    for c, x in enumerate(v):
        words = (f"{'xyz'[c]} component of the velocity of {b.title}",)
        yield Sayable("component", b, words, x, lambda said, x=x: Effect(T=m * (said**2 - x**2) / 2))


def _turned(s: Ingredients) -> Iterator[Sayable]:
    """The components of velocities and positions along axes that turn."""
    for b in s.bodies:
        m = s.expand(b.mass)
        every = list(turned_velocities(s, b))
        for axes, x, placed in turned_places(s, b):
            words = (f"component of the position of {b.title}", *axes)
            yield Sayable("apart", b, words, x, partial(_elsewhere, s, b, placed))
            for w in _turning_with(s, x, [v for _, v in every]):
                yield Sayable("apart", b, words, x, lambda said, f=m * w**2, x=x: Effect(T=f * (said**2 - x**2) / 2))
        for axes, x in every:
            words = (f"component of the velocity of {b.title}", *axes)
            yield Sayable("along", b, words, x, lambda said, m=m, x=x: Effect(T=m * (said**2 - x**2) / 2))


def _turning_with(s: Ingredients, arm: sp.Expr, velocities: Sequence[sp.Expr]) -> Iterator[sp.Expr]:
    """The rates at which a distance turns: φ̇ of the velocity ρ φ̇ across it."""
    names = {v: sp.Dummy() for v in s.v}
    for v in velocities:
        rate = bounded.cancel(cast("sp.Expr", v.xreplace(names)) / arm)
        if rate.has(*names.values()) and not s.moves(rate) and not sp.fraction(rate)[1].has(*names.values()):
            yield cast("sp.Expr", rate.xreplace({x: v for v, x in names.items()}))


def _elsewhere(s: Ingredients, b: Any, placed: Callable[[sp.Expr], list[sp.Expr]], said: sp.Expr) -> Effect:
    """What a body adds that is at another place."""
    there, here = placed(said), s.position(b)
    squares = sp.Add(*[s.rate(x) ** 2 for x in there], *[-(x**2) for x in s.velocity(b)])
    lifted = [weight_along(s, b, c) * (x - y) for c, (x, y) in enumerate(zip(there, here, strict=True))]
    return Effect(T=s.expand(b.mass) * squares / 2, V=-sp.Add(*lifted))


def _inertias(s: Ingredients, b: Any) -> Iterator[Sayable]:
    omega = s.omega(b) if isinstance(b, RigidBody) else ()
    for k, w in enumerate(omega if len(omega) > 1 else ()):
        words = (f"component of the angular velocity of {b.title} along its {AXES[k]} axis",)
        yield Sayable("turning", b, words, w, partial(_turning, s, b, k), axis=k)
    if len(omega) != 1:
        return
    J, w, words = s.expand(b.inertia[0]), omega[0], f"moment of inertia of {b.title}"
    turning = (f"angular velocity of {b.title}",)
    yield Sayable("turning", b, turning, w, lambda said: Effect(T=J * (said**2 - w**2) / 2))
    yield Sayable("inertia", b, (words,), J, lambda said: Effect(T=(said - J) * w**2 / 2))
    for square in arms(s, b) if J.free_symbols else ():
        whole = J + s.expand(b.mass) * square
        about = (f"{words} about its pivot",)
        yield Sayable("axis", b, about, whole, lambda said, whole=whole: Effect(T=(said - whole) * w**2 / 2))


def _turning(s: Ingredients, b: Any, k: int, said: sp.Expr) -> Effect:
    """What a body adds that has another component of its angular velocity."""
    omega = tuple(said if i == k else w for i, w in enumerate(s.omega(b)))
    return Effect(T=s.rotating(b, omega) - s.rotation(b))


def _positions(s: Ingredients, b: Any) -> Iterator[Sayable]:
    m, v = s.expand(b.mass), s.velocity(b)
    for c, x in enumerate(s.position(b)):
        if s.rate(x) == 0:
            continue
        weight, push = weight_along(s, b, c), _push_along(s, b, c)

        def place(said: sp.Expr, x: sp.Expr = x, v: sp.Expr = v[c], weight: sp.Expr = weight) -> Effect:
            return Effect(T=m * (s.rate(said) ** 2 - v**2) / 2, V=-weight * (said - x))

        def height(said: sp.Expr, x: sp.Expr = x, weight: sp.Expr = weight) -> Effect:
            return Effect(V=-weight * (said - x))

        def pushed(said: sp.Expr, x: sp.Expr = x, push: sp.Expr = push, place: Adds = place) -> Effect:
            return replace(place(said), Xi=tuple(push * bounded.diff(sp.Add(said, -x), q) for q in s.q))

        words = (f"{'xyz'[c]} coordinate of {b.title}",)
        yield Sayable("position", b, words, x, place)
        if push != 0:
            yield Sayable("position", b, words, x, pushed)
        if weight != 0:
            yield Sayable("height", b, words, x, height)


def _push_along(s: Ingredients, b: Any, axis: int) -> sp.Expr:
    """The forces at the centre of a body along a fixed axis."""
    acting = [e for e in s.acting if isinstance(e, Force) and e.at is not None and e.at == b.at]
    return sp.Add(*[s.expand(e.components(s.model)[axis]) for e in acting])


def weight_along(s: Ingredients, b: Any, axis: int) -> sp.Expr:
    """The weight of a body along a fixed axis."""
    g = sp.Add(*[e.g * e.direction[axis] for e in s.model.elements if isinstance(e, Gravity)])
    return s.expand(b.mass) * s.expand(g)


def _of_springs(s: Ingredients) -> Iterator[Sayable]:
    for strut in struts(s):
        k = sp.Add(*[s.expand(e.k) for e in strut.springs])
        b = sp.Add(*[s.expand(d.b) for d in strut.dampers])
        way, rate = strut.deflection, s.rate(strut.deflection)
        slopes = [bounded.diff(way, q) for q in s.q]

        def stored(said: sp.Expr, k: sp.Expr = k, b: sp.Expr = b, way: sp.Expr = way) -> Effect:
            V = k * (said**2 - way**2) / 2
            return replace(damped(s, b, s.rate(said), s.rate(way)), V=V) if b != 0 else Effect(V=V)

        def pulled(said: sp.Expr, k: sp.Expr = k, b: sp.Expr = b, way: sp.Expr = way, slopes: Any = slopes) -> Effect:
            more = sp.Add(said, -way)
            return pushing(k * more + b * s.rate(more), slopes)

        words, whole = (f"deflection of {strut.title}",), k * way + b * rate
        yield Sayable("deflection", strut.spring, words, way, stored)
        yield Sayable("deflection", strut.spring, words, way, pulled)
        parts: Any = [(e, s.expand(e.k) * way) for e in strut.springs]
        parts += [(d, s.expand(d.b) * rate) for d in strut.dampers]
        own = (f"force of {strut.title}",)
        yield Sayable("force", strut.spring, own, whole, _force(whole, slopes), None, tuple(parts))


def _of_dampers(s: Ingredients) -> Iterator[Sayable]:
    for d in (e for e in s.acting if isinstance(e, Damper) and e.b is not None):
        b, rate = s.expand(d.b), s.expand(d.rate(s.model))
        slopes = [bounded.diff(rate, v) for v in s.v]

        def worked(said: sp.Expr, b: sp.Expr = b, rate: sp.Expr = rate) -> Effect:
            return damped(s, b, _rate(s, said), rate)

        def pulled(said: sp.Expr, b: sp.Expr = b, rate: sp.Expr = rate, slopes: Any = slopes) -> Effect:
            return pushing(b * (_rate(s, said) - rate), slopes)

        words = (f"velocity of {d.title}",)
        yield Sayable("rate", d, words, rate, worked)
        yield Sayable("rate", d, words, rate, pulled)
        yield Sayable("force", d, (f"force of {d.title}",), b * rate, _force(b * rate, slopes))


def _of_shafts(s: Ingredients) -> Iterator[Sayable]:
    """The rates at which something turns together with what drives and brakes it."""
    for owner, w, J, same in shafts(s):

        def turned(said: sp.Expr, w: sp.Expr = w, J: sp.Expr = J, same: Any = same) -> Effect:
            braked = [damped(s, b, said, w) for e, b in same if isinstance(e, Damper)]
            pushed = sp.Add(*[effort for e, effort in same if not isinstance(e, Damper)])
            Xi = [pushed * (bounded.diff(said, v) - bounded.diff(w, v)) for v in s.v]
            Xi = [sp.Add(x, *[b.Xi[i] for b in braked]) for i, x in enumerate(Xi)]
            return Effect(T=J * (said**2 - w**2) / 2, Xi=tuple(Xi), D=sp.Add(*[b.D for b in braked]))

        yield Sayable("turning", owner, (f"angular velocity of {owner.title.replace('kinetic ', '')}",), w, turned)


def _force(right: sp.Expr, slopes: Sequence[sp.Expr], by: sp.Expr = sp.S.One) -> Adds:
    return lambda said: pushing(said * by - right, slopes)


def _half_square(right: sp.Expr, rate: sp.Expr) -> Adds:
    return lambda said: Effect(T=(said - right) * rate**2 / 2)


def _pulling(right: sp.Expr, only: Sequence[sp.Expr]) -> Adds:
    return lambda said: Effect(Xi=tuple((said - right) * x for x in only))


def _rate(s: Ingredients, said: sp.Expr) -> sp.Expr:
    """What is said of a rate, or the rate of what is said of a deflection."""
    return said if said.has(*s.v) else s.rate(said)


def damped(s: Ingredients, b: sp.Expr, rate: sp.Expr, right: sp.Expr) -> Effect:
    """What another rate of dampers adds to every Ξ_i, −b δ̇ ∂δ̇/∂ξ̇_i, and to D."""
    Xi = tuple(-b * (rate * bounded.diff(rate, v) - right * bounded.diff(right, v)) for v in s.v)
    return Effect(Xi=Xi, D=b * (rate**2 - right**2) / 2)


def _of_energies(s: Ingredients) -> Iterator[Sayable]:
    """The kinetic energies of bodies and of other elements, and the potential energies of weights and springs."""
    for e in s.model.elements:
        moving = isinstance(e, Body) or e.kind == "kinetic"
        of = f"kinetic energy of {e.title}" if moving else f"energy of {e.title}"
        words = (of.replace(" of kinetic", ""),)
        T = s.kinetic(e)
        yield Sayable("kinetic", e, words, T, lambda said, T=T: Effect(T=said - T))
        yield from () if isinstance(e, Body) else _velocities_of(s, e)
        parts = (("translation", s.translation(e)), ("rotation", s.rotation(e))) if isinstance(e, RigidBody) else ()
        for part, x in parts if all(x != 0 for _, x in parts) else ():
            words = (f"kinetic energy of the {part} of {e.title}",)
            yield Sayable(part, e, words, x, lambda said, x=x: Effect(T=said - x))
    stored = [(b, f"the weight of {b.title}", V) for _, b, V in s.weights()]
    stored += [(e, e.title, V) for e, _, V in s.springs()]
    for owner, of, V in stored:
        yield Sayable("potential", owner, (f"potential energy of {of}",), V, lambda said, V=V: Effect(V=said - V))


def _velocities_of(s: Ingredients, e: Any) -> Iterator[Sayable]:
    """What is squared in a kinetic energy that is given as it is: ṡ of ½ m ṡ²."""
    for square in sp.Add.make_args(s.kinetic(e)):
        powers = [f.as_base_exp() for f in sp.Mul.make_args(square)]
        rates = [base for base, exponent in powers if exponent == 2 and base.has(*s.v)]
        for w in rates if len(rates) == 1 else ():
            factor = cast("sp.Expr", square / w**2)
            turns = _turns(s, w)
            words = (
                f"angular velocity of {e.title.removeprefix('kinetic ')}"
                if turns
                else f"rate that is squared in {e.title}",
            )
            kind = "turning" if turns else "component"
            yield Sayable(kind, e, words, w, lambda said, f=factor, w=w: Effect(T=f * (said**2 - w**2)))


def _turns(s: Ingredients, w: sp.Expr) -> bool:
    """Whether a rate is one of angles alone: of coordinates in rad, or with a sine, a cosine or a frame."""
    places = [f for b in s.bodies for x in s.position(b) for f in x.atoms(sp.sin, sp.cos)]
    angles = [*places, *(f.total_angle for f in s.model.frames if f.floating is None and s.model.dimension == 2)]
    own = [c for c in s.coordinates if w.has(c.rate)]
    plain = all(bounded.diff(w, c.rate).is_number for c in own)
    return plain and all(c.unit == "rad" or any(s.expand(x).has(c.symbol) for x in angles) for c in own)


def _of_coordinates(s: Ingredients) -> Iterator[Sayable]:
    """Generalized forces and momenta, what multiplies each acceleration, and what dampers, springs and weights add."""
    for i, c in enumerate(s.coordinates):
        mass, only = s.expand(s.derivation.mass_matrix[i, i]), [sp.Integer(int(j == i)) for j in range(s.n)]
        words = ("factor of ", c.acceleration, " in the equation of ", c.symbol)
        for adds in (_half_square(mass, c.rate), _force(mass * c.acceleration, only, c.acceleration)):
            yield Sayable("mass", None, words, mass, adds, c.name)
        for j, other in enumerate(s.coordinates):
            entry = s.expand(s.derivation.mass_matrix[i, j])
            if i != j and entry != 0:
                words = ("factor of ", other.acceleration, " in the equation of ", c.symbol)
                adds = _force(entry * other.acceleration, only, other.acceleration)
                yield Sayable("mass", None, words, entry, adds, c.name, entry=f"{i + 1}{j + 1}")
        words = ("generalized momentum of ", c.symbol)
        yield Sayable("momentum", None, words, bounded.diff(s.T, c.rate), lambda _: Effect(), c.name)
        damping = -sp.Add(*[s.shares(d).get(i, sp.S.Zero) for d in s.acting if isinstance(d, Damper)])
        restoring = bounded.diff(s.V, c.symbol)
        words = ("generalized force of ", c.symbol)
        for Xi in dict.fromkeys((s.Xi[i], s.Xi[i] + damping)):
            yield Sayable("Xi", None, words, Xi, _pulling(Xi, only), c.name)
        words = ("damping in the equation of ", c.symbol)
        yield Sayable("damping", None, words, damping, _force(damping, only), c.name)
        words = ("derivative of the potential energy by ", c.symbol)
        yield Sayable("restoring", None, words, restoring, _force(restoring, only), c.name)
