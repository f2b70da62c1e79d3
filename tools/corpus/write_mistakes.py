"""The mistakes that are planted: each one makes a person's energies, forces and equations wrong in one way.

The names are those of the checker's misconceptions; how each is made here is SymPy alone and knows nothing of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import sympy as sp
from write_systems import System, g, kinetic, t


@dataclass(frozen=True)
class Wrong:
    """What a person with one mistake has: T*, V, Ξ, the rows; ``where`` it shows: "T", "V", "Xi" or "rows"."""

    name: str
    where: str
    rows: list[sp.Expr]
    T: sp.Expr | None = None
    V: sp.Expr | None = None
    Xi: list[sp.Expr] | None = None


MISTAKES: dict[str, Callable[[System], Iterator[Wrong]]] = {}


def mistake(make: Callable[[System], Iterator[Wrong]]) -> Callable[[System], Iterator[Wrong]]:
    MISTAKES[make.__name__] = make
    return make


def in_T(s: System, name: str, T: sp.Expr) -> Wrong:
    return Wrong(name, "T", s.rows(T=T), T=T)


def in_V(s: System, name: str, V: sp.Expr) -> Wrong:
    return Wrong(name, "V", s.rows(V=V), V=V)


def in_Xi(s: System, name: str, Xi: list[sp.Expr]) -> Wrong:
    return Wrong(name, "Xi", s.rows(Xi=Xi), Xi=Xi)


def in_row(s: System, name: str, i: int, row: sp.Expr) -> Wrong:
    rows = s.rows()
    rows[i] = row
    return Wrong(name, "rows", rows)


# -- T* --------------------------------------------------------------------------------------------------------------


@mistake
def relative_speed(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.parent is not None:
            own = tuple(x - y for x, y in zip(b.at, b.parent, strict=True))
            yield in_T(s, "relative_speed", s.T() - kinetic(b) + kinetic(replace(b, at=own)))


@mistake
def carried_mass_forgotten(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.parent is not None:
            wrong = s.rows(T=s.T() - kinetic(b))
            for i, v in enumerate(s.v):
                if any(x.diff(t).has(v) for x in b.parent):
                    yield in_row(s, "carried_mass_forgotten", i, wrong[i])


@mistake
def cross_term_forgotten(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.cross is not None:
            yield in_T(s, "cross_term_forgotten", s.T() - b.m * b.cross)


@mistake
def one_component(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        moving = [x for x in b.at if x.diff(t) != 0]
        if len(moving) == 2:
            yield in_T(s, "one_component", s.T() - b.m * moving[1].diff(t) ** 2 / 2)


@mistake
def half_forgotten(s: System) -> Iterator[Wrong]:
    for b in s.bodies[-2:]:
        if b.speed2() != 0:
            yield in_T(s, "half_forgotten", s.T() + b.m * b.speed2() / 2)


@mistake
def inertia_about_pivot(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.pivot is not None:
            J, w, _ = b.turns[0]
            yield in_T(s, "inertia_about_pivot", s.T() + b.m * b.pivot**2 * w**2 / 2 + 0 * J)


@mistake
def rotation_forgotten(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.turns and b.m != 0:
            yield in_T(s, "rotation_forgotten", s.T() - kinetic(b) + kinetic(replace(b, turns=())))


@mistake
def translation_forgotten(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.turns and b.speed2() != 0:
            yield in_T(s, "translation_forgotten", s.T() - b.m * b.speed2() / 2)


@mistake
def relative_rate(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.turns and b.turns[0][2] != 0:
            J, w, w0 = b.turns[0]
            yield in_T(s, "relative_rate", s.T() + J * ((w - w0) ** 2 - w**2) / 2)


@mistake
def mass_swapped(s: System) -> Iterator[Wrong]:
    masses = [b.m for b in s.bodies if b.m != 0]
    if len(masses) >= 2:
        swap = {masses[0]: masses[1], masses[1]: masses[0]}
        T, V = (x.xreplace(swap) for x in (s.T(), s.V()))
        yield Wrong("mass_swapped", "T", s.rows(T=T, V=V), T=T, V=V)


# -- V ---------------------------------------------------------------------------------------------------------------


@mistake
def spring_sign(s: System) -> Iterator[Wrong]:
    for k in s.springs:
        yield in_V(s, "spring_sign", s.V() - k.k * k.delta**2)


@mistake
def spring_half_forgotten(s: System) -> Iterator[Wrong]:
    for k in s.springs[:2]:
        yield in_V(s, "spring_half_forgotten", s.V() + k.k * k.delta**2 / 2)


@mistake
def spring_square_forgotten(s: System) -> Iterator[Wrong]:
    for k in s.springs[:1]:
        yield in_V(s, "spring_square_forgotten", s.V() - k.k * k.delta**2 / 2 + k.k * k.delta / 2)


@mistake
def spring_to_ground(s: System) -> Iterator[Wrong]:
    for k in s.springs:
        if k.ground is not None:
            yield in_V(s, "spring_to_ground", s.V() - k.k * k.delta**2 / 2 + k.k * k.ground**2 / 2)


@mistake
def spring_other_pair(s: System) -> Iterator[Wrong]:
    for k in s.springs:
        if k.other is not None:
            yield in_V(s, "spring_other_pair", s.V() - k.k * k.delta**2 / 2 + k.k * k.other**2 / 2)


@mistake
def rest_forgotten(s: System) -> Iterator[Wrong]:
    for k in s.springs:
        if k.unstretched is not None:
            yield in_V(s, "rest_forgotten", s.V() - k.k * k.delta**2 / 2 + k.k * k.unstretched**2 / 2)


@mistake
def gravity_sign(s: System) -> Iterator[Wrong]:
    if s.weight() != 0:
        yield in_V(s, "gravity_sign", s.V() - 2 * s.weight())


@mistake
def gravity_forgotten(s: System) -> Iterator[Wrong]:
    if s.weight() != 0:
        yield in_V(s, "gravity_forgotten", s.V() - s.weight())


@mistake
def gravity_arm(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.pivot is not None and b.height is not None:
            yield in_V(s, "gravity_arm", s.V() + b.m * g * (b.height.xreplace({b.pivot: 2 * b.pivot}) - b.height))


@mistake
def height_relative(s: System) -> Iterator[Wrong]:
    for b in s.bodies:
        if b.parent is not None and b.height is not None and b.parent[-1] != 0:
            yield in_V(s, "height_relative", s.V() - b.m * g * b.parent[-1])


@mistake
def sine_for_cosine(s: System) -> Iterator[Wrong]:
    W = s.weight()
    swapped = W.replace(lambda x: isinstance(x, (sp.sin, sp.cos)) and x.has(t), _swap)
    if swapped != W:
        yield in_V(s, "sine_for_cosine", s.V() - W + swapped)


def _swap(x: sp.Expr) -> sp.Expr:
    return sp.cos(x.args[0]) if isinstance(x, sp.sin) else sp.sin(x.args[0])


@mistake
def plus_potential(s: System) -> Iterator[Wrong]:
    if s.V() != 0:
        yield Wrong("plus_potential", "rows", s.rows(V=-s.V()))


@mistake
def potential_forgotten(s: System) -> Iterator[Wrong]:
    if s.springs and s.weight() != 0:
        yield Wrong("potential_forgotten", "rows", s.rows(V=sp.S.Zero))


@mistake
def element_forgotten(s: System) -> Iterator[Wrong]:
    for k in s.springs:
        yield in_V(s, "element_forgotten", s.V() - k.k * k.delta**2 / 2)
    for d in s.dampers:
        yield in_Xi(s, "element_forgotten", replace(s, dampers=tuple(x for x in s.dampers if x is not d)).Xi())
    for p in s.inputs:
        yield in_Xi(s, "element_forgotten", replace(s, inputs=tuple(x for x in s.inputs if x is not p)).Xi())


@mistake
def element_twice(s: System) -> Iterator[Wrong]:
    for d in s.dampers[:1]:
        yield in_Xi(s, "element_twice", replace(s, dampers=(*s.dampers, d)).Xi())


# -- Ξ ---------------------------------------------------------------------------------------------------------------


@mistake
def damper_sign(s: System) -> Iterator[Wrong]:
    for d in s.dampers:
        Xi = [x + 2 * d.f * d.rate * d.rate.diff(v) for x, v in zip(s.Xi(), s.v, strict=True)]
        yield in_Xi(s, "damper_sign", Xi)


@mistake
def damper_half(s: System) -> Iterator[Wrong]:
    for d in s.dampers[:1]:
        Xi = [x + d.f * d.rate * d.rate.diff(v) / 2 for x, v in zip(s.Xi(), s.v, strict=True)]
        yield in_Xi(s, "damper_half", Xi)


@mistake
def damper_arm(s: System) -> Iterator[Wrong]:
    for d in s.dampers:
        for length in sorted(d.rate.free_symbols - {t}, key=str):
            short = d.rate / length
            Xi = [
                x + d.f * (d.rate * d.rate.diff(v) - d.rate * short.diff(v)) for x, v in zip(s.Xi(), s.v, strict=True)
            ]
            yield in_Xi(s, "damper_arm", Xi)


@mistake
def damper_to_ground(s: System) -> Iterator[Wrong]:
    for d in s.dampers:
        if d.reaction != 0:
            changed = replace(d, reaction=sp.S.Zero)
            yield in_Xi(
                s, "damper_to_ground", replace(s, dampers=tuple(changed if x is d else x for x in s.dampers)).Xi()
            )


@mistake
def damper_rate_not_relative(s: System) -> Iterator[Wrong]:
    for d in s.dampers:
        if d.reaction != 0:
            Xi = [x + d.f * (d.rate - d.on) * d.rate.diff(v) for x, v in zip(s.Xi(), s.v, strict=True)]
            yield in_Xi(s, "damper_rate_not_relative", Xi)


@mistake
def force_sign(s: System) -> Iterator[Wrong]:
    for p in s.inputs:
        Xi = [x - 2 * p.f * p.rate.diff(v) for x, v in zip(s.Xi(), s.v, strict=True)]
        yield in_Xi(s, "force_sign", Xi)


@mistake
def force_wrong_equation(s: System) -> Iterator[Wrong]:
    for p in s.inputs:
        share = [p.f * p.rate.diff(v) for v in s.v]
        held = [i for i, x in enumerate(share) if x != 0]
        if len(held) == 1 and len(s.q) > 1:
            other = (held[0] + 1) % len(s.q)
            Xi = s.Xi()
            Xi[held[0]] -= share[held[0]]
            Xi[other] += share[held[0]]
            yield in_Xi(s, "force_wrong_equation", Xi)


@mistake
def reaction_forgotten(s: System) -> Iterator[Wrong]:
    for p in s.inputs:
        if p.reaction != 0:
            changed = replace(p, reaction=sp.S.Zero)
            yield in_Xi(
                s, "reaction_forgotten", replace(s, inputs=tuple(changed if x is p else x for x in s.inputs)).Xi()
            )


@mistake
def reaction_sign(s: System) -> Iterator[Wrong]:
    for p in s.inputs:
        if p.reaction != 0:
            changed = replace(p, reaction=-p.reaction)
            yield in_Xi(s, "reaction_sign", replace(s, inputs=tuple(changed if x is p else x for x in s.inputs)).Xi())


@mistake
def input_everywhere(s: System) -> Iterator[Wrong]:
    if len(s.inputs) == 1 and len(s.q) > 1:
        (p,) = s.inputs
        yield in_Xi(s, "input_everywhere", [x + p.f for x in s.damping()])


@mistake
def counted_without_work(s: System) -> Iterator[Wrong]:
    for p in s.inputs:
        if p.parent is not None and p.rate.diff(s.v[p.parent]) == 0:
            Xi = s.Xi()
            Xi[p.parent] -= p.f
            yield in_Xi(s, "counted_without_work", Xi)


@mistake
def force_arm(s: System) -> Iterator[Wrong]:
    for p in s.inputs:
        for length in sorted(p.rate.free_symbols - {t}, key=str):
            Xi = s.Xi()
            for i, v in enumerate(s.v):
                share = p.f * p.rate.diff(v)
                if share.has(length):
                    Xi[i] += share.xreplace({length: sp.S.One}) - share
            yield in_Xi(s, "force_arm", Xi)


@mistake
def xi_sign(s: System) -> Iterator[Wrong]:
    if any(x != 0 for x in s.driving()) and len(s.inputs) == 1 and not s.dampers:
        yield Wrong("xi_sign", "rows", s.rows(Xi=[-x for x in s.Xi()]))


# -- the equations ---------------------------------------------------------------------------------------------------


@mistake
def product_rule(s: System) -> Iterator[Wrong]:
    """d/dt of M(ξ) ξ̇ taken as M(ξ) ξ̈."""
    T = sp.expand(s.T())
    for i, (v, row) in enumerate(zip(s.v, s.rows(), strict=True)):
        momentum = sp.expand(T.diff(v))
        full = momentum.diff(t)
        short = sum((momentum.diff(w) * a for w, a in zip(s.v, s.a, strict=True)), sp.S.Zero)
        yield in_row(s, "product_rule", i, row - full + short)


@mistake
def gradient_forgotten(s: System) -> Iterator[Wrong]:
    for i, (x, row) in enumerate(zip(s.q, s.rows(), strict=True)):
        yield in_row(s, "gradient_forgotten", i, row + s.T().diff(x))


@mistake
def gradient_sign(s: System) -> Iterator[Wrong]:
    for i, (x, row) in enumerate(zip(s.q, s.rows(), strict=True)):
        yield in_row(s, "gradient_sign", i, row + 2 * s.T().diff(x))


def _fast(s: System, row: sp.Expr) -> sp.Expr:
    """What is left of a row when nothing accelerates, damps or pushes: the products of rates."""
    rest = sp.expand(row).xreplace(dict.fromkeys(s.a, sp.S.Zero))
    dummies = {v: sp.Dummy() * sp.Symbol("eps") for v in s.v}
    powers = sp.Poly(sp.expand(rest.xreplace(dummies)), sp.Symbol("eps"))
    back = {d.args[0] if d.args[0] != sp.Symbol("eps") else d.args[1]: v for v, d in dummies.items()}
    return powers.coeff_monomial(sp.Symbol("eps") ** 2).xreplace(back)


@mistake
def velocity_terms_forgotten(s: System) -> Iterator[Wrong]:
    for i, row in enumerate(s.rows()):
        yield in_row(s, "velocity_terms_forgotten", i, row - _fast(s, row))


@mistake
def coriolis_half(s: System) -> Iterator[Wrong]:
    for i, row in enumerate(s.rows()):
        mixed = [x for x in sp.Add.make_args(sp.expand(_fast(s, row))) if sum(x.has(v) for v in s.v) == 2]
        if mixed:
            yield in_row(s, "coriolis_half", i, row - sp.Add(*mixed) / 2)


@mistake
def small_angle(s: System) -> Iterator[Wrong]:
    if s.weight().has(sp.cos) and not s.springs:
        V = s.V().replace(sp.cos, lambda x: 1 - x**2 / 2 if x.has(t) else sp.cos(x))
        if s.V() != V:
            yield in_V(s, "small_angle", V)


def _tidy(s: System) -> list[sp.Expr]:
    """The rows as a person has them: sin² + cos² is 1."""
    return [sp.expand(sp.trigsimp(sp.expand(row))) for row in s.rows()]


@mistake
def sign_of_a_term(s: System) -> Iterator[Wrong]:
    for i, row in enumerate(_tidy(s)):
        terms = sp.Add.make_args(row)
        if len(terms) > 2:
            yield in_row(s, "sign_of_a_term", i, row - 2 * terms[len(terms) // 2])


@mistake
def term_forgotten(s: System) -> Iterator[Wrong]:
    for i, row in enumerate(_tidy(s)):
        terms = sp.Add.make_args(row)
        if len(terms) > 2:
            yield in_row(s, "term_forgotten", i, row - terms[-1])


@mistake
def coupling_forgotten(s: System) -> Iterator[Wrong]:
    for i, row in enumerate(s.rows()):
        for j, a in enumerate(s.a):
            share = sp.expand(row).diff(a) * a
            if i != j and share != 0:
                yield in_row(s, "coupling_forgotten", i, row - share)


@mistake
def parameter_swapped(s: System) -> Iterator[Wrong]:
    lengths = sorted({x for x in s.T().free_symbols if str(x)[0] in "Ll"}, key=str)
    if len(lengths) >= 2:
        swap = {lengths[0]: lengths[1], lengths[1]: lengths[0]}
        T, V = s.T().xreplace(swap), s.V().xreplace(swap)
        yield Wrong("parameter_swapped", "T", s.rows(T=T, V=V), T=T, V=V)
