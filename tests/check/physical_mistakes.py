"""Physical mistakes in derivations: an oracle for the naming of mistakes that knows nothing of the checker.

They are made where people make them: in a position, in an angular velocity, in a deflection, in the arm of a force, in
a step of Lagrange's operator; the wrong equations follow by SymPy alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import sympy as sp
from physical import Link, Mechanism, Steps

from lagrangian.model import time as t


@dataclass(frozen=True, eq=False)
class Planted:
    """A mistake: what was done, to which elements, in which sort of words it is told, and the wrong derivation.

    ``steps`` are the wrong energies, where the mistake is made in these, and otherwise ``own`` the wrong equations.
    """

    kind: str
    elements: tuple[str, ...]
    words: str
    own: list[Any] | None = None
    steps: Steps | None = None

    @cached_property
    def rows(self) -> list[Any]:
        """The wrong equations, which are derived when they are first asked for."""
        if self.own is not None:
            return self.own
        assert self.steps is not None
        return self.steps.rows()

    def __str__(self) -> str:
        return f"{self.kind} of {' or '.join(self.elements)}"


GONE = r"missing|left out|forgotten|without|does not|is not counted|no share|lacks|ignored|not squared|counts? 0"
GONE += "|only|alone"
SIGN = r"sign|minus|negative|against|subtract|opposite|direction"
NUMBER = r"half|twice|½|number|times|counts|factor|quarter|squared"
OTHER = r"in place of|exchanged|stands|instead|taken|taken as|not the|belongs|as if|is not|another|relative|absolute"


MIXED = ((0, "no", GONE), (-1, "sign of the", SIGN), (sp.S.Half, "half the", NUMBER))
MOVED = OTHER + "|counted in|equation of|where it does no work"
RULE = GONE + "|product rule|chain rule|not differentiated"
LOST = GONE + "|arm|projection|counted whole, whatever its direction|" + OTHER


def put(d: Mapping[Any, Any], key: Any, value: Any) -> dict[Any, Any]:
    """The same with another value under a key."""
    return {**d, key: value}


def planted(m: Mechanism) -> Iterator[Planted]:
    """All mistakes in a mechanism."""
    for make in (_of_bodies, _of_motion, _of_springs, _of_dampers, _of_forces, _of_operator):
        yield from make(m)


def _spec(m: Mechanism, kind: str, name: str, words: str) -> Planted:
    steps = m.steps()
    return Planted(kind, (name,), words, steps=steps)


def _step(s: Steps, kind: str, name: str, words: str) -> Planted:
    return Planted(kind, (name,), words, steps=s)


def _of_bodies(m: Mechanism) -> Iterator[Planted]:
    s = m.steps()
    for n, b in m.bodies.items():
        if len(m.bodies) > 1 or b.inertia is not None:
            yield _step(s.put("moving", n, sp.S.Zero), "½mv² left out", n, GONE)
        yield _step(s.put("moving", n, 2 * s.moving[n]), "½ of ½mv² forgotten", n, NUMBER)
        if b.inertia is not None:
            yield _step(s.put("turning", n, sp.S.Zero), "½Jω² left out", n, GONE)
            yield _step(s.put("turning", n, 2 * s.turning[n]), "½ of ½Jω² forgotten", n, NUMBER)
            J = [x for x in sp.sympify(b.inertia).atoms(sp.Number) if x not in (0, 1, 2)]
            for x in J:
                other = {"1/2": sp.Rational(2, 5)}.get(str(x), 2 * x)
                turned = replace(b, inertia=sp.sympify(b.inertia).subs(x, other))
                yield _spec(m.put("bodies", n, turned), f"{other} for {x} in J", n, NUMBER + "|inertia")
        if m.g is not None and s.heights[n].has(*m.q):
            yield _step(s.put("heights", n, sp.S.Zero), "weight left out", n, GONE)
            yield _step(s.put("heights", n, -s.heights[n]), "sign of the weight", n, SIGN)
            for f in sorted(s.heights[n].atoms(sp.sin, sp.cos), key=str):
                if f.has(*m.q):
                    h = s.heights[n].xreplace({f: _partner(f)})
                    yield _step(
                        s.put("heights", n, h),
                        f"{_partner(f)} for {f} in the height",
                        n,
                        OTHER + "|sine",
                    )


def _partner(f: Any) -> Any:
    return sp.cos(*f.args) if isinstance(f, sp.sin) else sp.sin(*f.args)


def _of_motion(m: Mechanism) -> Iterator[Planted]:
    s = m.steps()
    rates = [sp.diff(p, t) for p in m.q]
    for n, b in m.bodies.items():
        for p, v in zip(m.q, rates, strict=True):
            if s.moving[n].has(v) and sum(s.moving[n].has(w) for w in rates) > 1:
                less = s.moving[n].xreplace({v: sp.S.Zero})
                yield _step(s.put("moving", n, less), f"velocity without {p}'", n, GONE + "|relative")
            if n in s.turning and s.turning[n].has(v) and sum(s.turning[n].has(w) for w in rates) > 1:
                less = s.turning[n].xreplace({v: sp.S.Zero})
                yield _step(s.put("turning", n, less), f"ω without {p}'", n, GONE + "|" + OTHER)
                turned = s.turning[n].xreplace({v: -v})
                yield _step(s.put("turning", n, turned), f"sign of {p}' in ω", n, SIGN + "|" + OTHER)
        whole = sp.expand(s.moving[n])
        mixed = sp.Add(*[x for x in sp.Add.make_args(whole) if sum(x.has(w) for w in rates) > 1])
        if mixed != 0:
            for k, kind, words in MIXED:
                new = whole + (k - 1) * mixed
                yield _step(s.put("moving", n, new), f"{kind} mixed products in v²", n, words + "|" + SIGN)
        pieces = [(c, x) for c in (0, 1) for x in sp.Add.make_args(sp.expand(b.at[c])) if x.has(*m.q)]
        for c, x in pieces:
            for new, kind, words in _wrong_pieces(m, x, len(pieces)):
                at = list(b.at)
                at[c] = sp.expand(b.at[c]) - x + new
                moved = m.put("bodies", n, replace(b, at=tuple(at)))
                yield _spec(moved, f"{kind} {x} in the position", n, words)
        for angle in sorted({f.args[0] for x in b.at for f in sp.sympify(x).atoms(sp.sin, sp.cos)}, key=str):
            if isinstance(angle, sp.Add):
                for x in angle.args:
                    at = tuple(
                        sp.sympify(y).xreplace({sp.sin(angle): sp.sin(angle - x), sp.cos(angle): sp.cos(angle - x)})
                        for y in b.at
                    )
                    yield _spec(
                        m.put("bodies", n, replace(b, at=at)),
                        f"{angle - x} for {angle} in the position",
                        n,
                        OTHER + "|angle|" + GONE,
                    )


def _wrong_pieces(m: Mechanism, x: Any, count: int) -> Iterator[tuple[Any, str, str]]:
    if count > 1:
        yield -x, "sign of", SIGN
        yield sp.S.Zero, "without", GONE
    for f in sorted(x.atoms(sp.sin, sp.cos), key=str):
        if f.has(*m.q):
            yield x.xreplace({f: _partner(f)}), "sine and cosine in", OTHER + "|sine|component"
    number = x.as_coeff_Mul()[0]
    if number not in (1, -1):
        yield x / abs(number), "number of", NUMBER + "|" + OTHER
    for p in sorted(x.free_symbols - {t}, key=str):
        others = [y for y in m.system.parameters_named if y != p and str(y)[0].lower() == str(p)[0].lower()]
        for y in others[:1]:
            yield x.xreplace({p: y}), f"{y} for {p} in", OTHER


def _of_springs(m: Mechanism) -> Iterator[Planted]:
    s = m.steps()
    right = s.rows()
    for n, k in m.springs.items():
        yield _step(s.put("springs", n, sp.S.Zero), "spring left out", n, GONE)
        yield _step(s.put("springs", n, -s.springs[n]), "sign of the spring", n, SIGN)
        yield _step(s.put("springs", n, 2 * s.springs[n]), "½ of ½kδ² forgotten", n, NUMBER)
        pieces = sp.Add.make_args(sp.expand(k.along))
        for x in pieces if len(pieces) > 1 else ():
            for new, kind, words in ((sp.S.Zero, "without", GONE + "|" + OTHER), (-x, "sign of", SIGN + "|" + OTHER)):
                along = sp.expand(k.along) - x + new
                if along.has(*m.q):
                    yield _spec(
                        m.put("springs", n, Link(k.size, along)),
                        f"{kind} {x} in the deflection",
                        n,
                        words,
                    )
        arms = [x for x in sp.sympify(k.along).free_symbols - {t} if sp.diff(k.along, x).has(*m.q)]
        for x in sorted(arms, key=str):
            along = k.along.xreplace({x: sp.S.One})
            yield _spec(
                m.put("springs", n, Link(k.size, along)),
                f"{x} lost in the deflection",
                n,
                GONE + "|" + OTHER,
            )
            for i, p in enumerate(m.q):  # k δ without ∂δ/∂ξ's arm
                share = sp.expand(k.size * k.along * sp.diff(k.along, p))
                if sp.diff(k.along, p).has(x):
                    rows = list(right)
                    rows[i] = sp.expand(
                        rows[i] - share + k.size * k.along * sp.diff(k.along, p).xreplace({x: sp.S.One})
                    )
                    yield Planted(f"∂δ/∂{p} without {x}", (n,), GONE + "|" + OTHER + "|squared|derivative", rows)
        for i, p in enumerate(m.q):
            force = sp.expand(sp.diff(s.springs[n], p))
            if force != 0 and sum(sp.diff(s.springs[n], x) != 0 for x in m.q) > 1:
                for j, kind, words in ((1, "reaction left out for", GONE), (2, "sign of the reaction for", SIGN)):
                    rows = list(right)
                    rows[i] = sp.expand(rows[i] - j * force)
                    yield Planted(f"{kind} {p}", (n,), words, rows)


def _of_dampers(m: Mechanism) -> Iterator[Planted]:
    s = m.steps()
    for n, b in m.dampers.items():
        yield _step(s.put("shares", n, {}), "damper left out", n, GONE)
        yield _step(s.put("shares", n, {p: -x for p, x in s.shares[n].items()}), "sign of the damper", n, SIGN)
        half = {p: x / 2 for p, x in s.shares[n].items()}
        yield _step(s.put("shares", n, half), "half the damper", n, NUMBER)
        pieces = sp.Add.make_args(sp.expand(b.along))
        for x in pieces if len(pieces) > 1 else ():
            for new, kind, words in ((sp.S.Zero, "without", GONE + "|" + OTHER), (-x, "sign of", SIGN + "|" + OTHER)):
                along = sp.expand(b.along) - x + new
                yield _spec(m.put("dampers", n, Link(b.size, along)), f"{kind} {x} in the rate", n, words)
        if len(pieces) == 1:
            for p in m.q:
                if not b.along.has(p):
                    along = b.along.xreplace({next(x for x in m.q if b.along.has(x)): p})
                    yield _spec(m.put("dampers", n, Link(b.size, along)), f"on {p}", n, OTHER)
        for x in sorted(sp.sympify(b.along).free_symbols - {t}, key=str):
            along = b.along.xreplace({x: sp.S.One})
            yield _spec(
                m.put("dampers", n, Link(b.size, along)),
                f"{x} lost in the rate",
                n,
                GONE + "|" + OTHER,
            )
            once = {p: sp.expand(y / x) for p, y in s.shares[n].items()}
            if len(pieces) == 1:
                yield _step(s.put("shares", n, once), f"{x} once for {x}²", n, GONE + "|" + OTHER)


def _of_forces(m: Mechanism) -> Iterator[Planted]:
    s = m.steps()
    for n, F in m.forces.items():
        own = s.shares[n]
        held = [p for p in m.q if own[p] != 0]
        yield _step(s.put("shares", n, {p: -x for p, x in own.items()}), "sign of the force", n, SIGN)
        if len(held) > 1:
            for p in held:
                yield _step(s.put("shares", n, put(own, p, 0)), f"nothing for {p}", n, GONE)
                yield _step(s.put("shares", n, put(own, p, -own[p])), f"sign for {p}", n, SIGN)
        else:
            for p in m.q:
                if p not in held:
                    both = put(own, p, own[held[0]])
                    yield _step(
                        s.put("shares", n, both),
                        f"also for {p}",
                        n,
                        OTHER + "|where it does no work|counted in",
                    )
                    moved = put(put(own, p, own[held[0]]), held[0], 0)
                    yield _step(
                        s.put("shares", n, moved),
                        f"for {p} instead",
                        n,
                        OTHER + "|counted in|equation of",
                    )
        for p in held:
            arm = sp.diff(F.along, p)
            for x in sorted(arm.free_symbols - {t}, key=str):
                yield _step(
                    s.put("shares", n, put(own, p, own[p].xreplace({x: sp.S.One}))),
                    f"arm {x} for {p} lost",
                    n,
                    LOST,
                )
            for f in sorted(arm.atoms(sp.sin, sp.cos), key=str):
                turned = put(own, p, own[p].xreplace({f: _partner(f)}))
                yield _step(
                    s.put("shares", n, turned),
                    f"{_partner(f)} for {f} for {p}",
                    n,
                    OTHER + "|sine|projection",
                )
                lost = put(own, p, own[p].xreplace({f: sp.S.One}))
                yield _step(
                    s.put("shares", n, lost),
                    f"{f} for {p} lost",
                    n,
                    LOST,
                )


def _of_operator(m: Mechanism) -> Iterator[Planted]:
    s = m.steps()
    right = s.rows()
    T = sp.expand(s.T)
    names = (*m.bodies,)
    for i, p in enumerate(m.q):
        slope = sp.expand(sp.diff(T, p))
        if slope != 0:
            for k, kind, words in ((1, "∂T/∂ξ forgotten for", GONE), (2, "sign of ∂T/∂ξ for", SIGN)):
                rows = list(right)
                rows[i] = sp.expand(rows[i] + k * slope)
                yield Planted(f"{kind} {p}", names, words, rows)
        momentum = sp.expand(sp.diff(T, sp.diff(p, t)))
        for x in m.q:
            part = sp.expand(sp.diff(momentum, x) * sp.diff(x, t))
            if part != 0:
                rows = list(right)
                rows[i] = sp.expand(rows[i] - part)
                yield Planted(
                    f"d/dt ∂T/∂{p}' without what {x}' adds",
                    names,
                    RULE,
                    rows,
                )
