"""Steps 2, 3 and 4: kinetic co-energy T*, potential energy V, Lagrangian L = T* − V."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Algebra, Form
from lagrangian.derive.circuits import by_current, capacitor, nothing_stored, reason_of, step_three, step_two
from lagrangian.derive.context import Context, fit, fit_terms
from lagrangian.derive.derived import Step
from lagrangian.model import (
    Body,
    Capacitor,
    Element,
    Gravity,
    Inductor,
    Model,
    MutualInductance,
    Spring,
    time,
)
from lagrangian.model.elements.vectors import diagonal
from lagrangian.page.formula import (
    Formula,
    Heading,
    Item,
    Left,
    Minus,
    Name,
    Product,
    Square,
    Terms,
    Text,
    formula,
    text,
)
from lagrangian.records import dataclass

AXES = ("x", "y", "z")


@dataclass(frozen=True, eq=False)
class Share:
    """A part of T* or V that belongs to one element (and, for gravity, to the body on which it acts)."""

    element: Element
    name: Name
    column: str
    expr: sp.Expr
    form: Form
    body: Body | None = None


def indices(model: Model) -> dict[Body, str]:
    """The subscript of each body's quantities: its number, or its name if the number would mean a coordinate."""
    bodies = model.bodies
    numbers = {b: _number_of(b, i) for i, b in enumerate(bodies, 1)}
    if len(bodies) == 1:
        numbers = {bodies[0]: ""}
    if len(set(numbers.values())) < len(bodies):
        numbers = {b: str(i) for i, b in enumerate(bodies, 1)}
    taken = {c.name: c.symbol for c in model.coordinates}
    for body, index in numbers.items():
        for axis, x in zip(AXES, model.position(body.at), strict=False):
            clash = taken.get(axis + index, taken.get(f"{axis}_{index}"))
            if clash is not None and model.expand(x) != clash:
                return {b: b.name for b in bodies}
    return numbers


def _number_of(body: Body, position: int) -> str:
    name = body.mass.name if isinstance(body.mass, sp.Symbol) else ""
    digits = name[1:].lstrip("_")
    return digits if name[:1] in ("m", "M") and digits.isdigit() else str(position)


def shares(model: Model, algebra: Algebra) -> tuple[Share, ...]:
    """The parts of T* and V of every element, each with its normal form."""
    index = indices(model)
    found: list[Share] = []
    for element in model.elements:
        for name, expr, body in _pieces(model, element, index):
            found.append(Share(element, name, element.ledger, expr, algebra.form(expr), body))
    return tuple(found)


def _pieces(model: Model, element: Element, index: dict[Body, str]) -> Iterator[tuple[Name, sp.Expr, Body | None]]:
    letter = element.ledger
    for body, energy in element.portions(model) if letter in ("T*", "V") else ():
        if body is not None:
            yield Name(letter, index[body] if index[body] else "g"), energy, body
        elif isinstance(element, Body):
            alone = sum(e.ledger == "T*" for e in model.elements) == 1
            yield Name(letter, index[element] or ("" if alone else element.name)), energy, None
        else:
            yield Name(letter, element.name if element.name != letter else ""), energy, None


# -- step 2 ---------------------------------------------------------------------------------------------------------


def kinetic(context: Context, pieces: tuple[Share, ...]) -> Step:
    """T* = Σ ½ m v² + ½ J ω², for each body with the velocity of its own centre of mass."""
    model = context.model
    index = indices(model)
    mine = [s for s in pieces if s.column == "T*"]
    items: list[Item] = []
    for share in mine:
        body = share.element
        if isinstance(body, Body):
            items.append(Heading(text(_capital(body.title))))
            items += _motion(context, body, index)
            items += _rotation(context, body, index)
            items.append(_energy(context, body, share, index))
        elif isinstance(body, Inductor | MutualInductance):
            items += [Heading(text(_capital(body.title))), *by_current(context, body, share.name)]
        else:
            items.append(_plain(context, share))
    total = _sum(mine, "T*")
    readable = context.algebra.total([s.form for s in mine]).expr()
    if isinstance(last := items[-1] if items else None, Formula) and total == Name("T*") and last.sides[0] == total:
        items[-1] = replace(last, brief=True)
    else:
        items.append(formula(*_chain(Name("T*"), total, _added(context, mine)), brief=True))
    reasons = tuple(text(s.name, f": {s.element.title} {reason_of(s.element)}") for s in mine)
    what, why = step_two(model)
    return Step(
        2,
        "Kinetic co-energy",
        what,
        why,
        tuple(items),
        {"T": readable},
        reasons,
    )


def _plain(context: Context, share: Share) -> Formula:
    """An energy that is given directly, with the note of its kind."""
    note = text(share.element.note) if share.element.note else None
    return formula(share.name, fit(context.readable(share.expr)), note=note)


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _chain(*sides: Left) -> tuple[Left, ...]:
    """The sides without repetitions, such as T* = T* for a single body."""
    kept: list[Left] = []
    for side in sides:
        if not kept or side != kept[-1]:
            kept.append(side)
    return tuple(kept)


def _sum(mine: list[Share], base: str) -> Left:
    return mine[0].name if len(mine) == 1 else Terms(tuple(s.name for s in mine)) if mine else Name(base)


def _added(context: Context, mine: list[Share], sign: int = 1) -> Left:
    """The parts written out one after another, as in a lecture before differentiation."""
    return fit_terms(tuple(x for s in mine for x in sp.Add.make_args(sign * context.readable(s.expr)) if x != 0))


def _motion(context: Context, body: Body, index: dict[Body, str]) -> list[Item]:
    """Positions and their rates; a point that is given relative to another body is shown relative to it."""
    model = context.model
    lines: list[Item] = []
    velocity = model.velocity(body.at)
    base, steps = _from_body(model, body)
    for axis, x, v, step in zip(AXES, model.position(body.at), velocity, steps, strict=False):
        if v == 0:
            continue
        here = Name(axis, index[body])
        # a coordinate of the other body that never changes has no line of its own to refer to
        there = base if base is not None and model.velocity(base.at)[AXES.index(axis)] != 0 else None
        shown: list[Left] = [here, *([Terms((Name(axis, index[there]), *_terms(step)))] if there is not None else [x])]
        if there is None and model.expand(x) != x:
            shown.append(fit(context.readable(model.expand(x))))
        if str(here) != str(shown[-1]):
            lines.append(formula(*shown))
        speed = Name(axis, index[body], 1)
        if there is not None:
            rate = bounded.diff(model.expand(step), time)
            lines.append(formula(speed, Terms((Name(axis, index[there], 1), *_terms(context.readable(rate))))))
        else:
            lines.append(formula(speed, fit(context.readable(v))))
    if not any(v != 0 for v in velocity):
        lines.append(text("Its centre of mass stays where it is."))
    return lines


def _terms(expr: sp.Expr) -> tuple[sp.Expr, ...]:
    return tuple(sp.Add.make_args(expr)) if expr != 0 else ()


def _from_body(model: Model, body: Body) -> tuple[Body | None, tuple[sp.Expr, ...]]:
    """Return the body relative to which this one's position is given, and the vector between them in fixed axes."""
    origin = model.position(body.at)
    for other in model.bodies:
        if other is not body and body.at.parent is other.at and not other.at.is_origin:
            before = model.position(other.at)
            return other, tuple(a - b for a, b in zip(origin, before, strict=True))
    return None, origin


def _rotation(context: Context, body: Body, index: dict[Body, str]) -> list[Item]:
    omega = body.angular_velocity(context.model)
    if not omega:
        return []
    if len(omega) == 1:
        return [formula(Name("omega", index[body]), context.readable(omega[0]))]
    lines: list[Item] = [text("Angular velocity in the body's own axes:")]
    for axis, w in zip(AXES, omega, strict=True):
        name = Name("omega", f"{axis}{index[body]}" if len(index[body]) <= 2 else f"{axis} {index[body]}")
        lines.append(formula(name, fit(context.readable(w))))
    return lines


def _energy(context: Context, body: Body, share: Share, index: dict[Body, str]) -> Formula:
    """½ m (ẋ² + ẏ²) + ½ J ω² = … for one body."""
    model = context.model
    moving = [(axis, v) for axis, v in zip(AXES, model.velocity(body.at), strict=False) if v != 0]
    pieces: list[Left] = []
    if moving and body.mass != 0:
        pieces.append(Square(body.mass / 2, tuple(Name(axis, index[body], 1) for axis, _ in moving)))
    omega, inertia = body.angular_velocity(model), body.tensor
    if len(omega) == 1:
        pieces += [Square(inertia[0][0] / 2, (Name("omega", index[body]),))] if omega[0] != 0 else []
    elif inertia == diagonal(moments := [row[k] for k, row in enumerate(inertia)]):
        for axis, w, moment in zip(AXES, omega, moments, strict=False):
            name = Name("omega", f"{axis}{index[body]}" if len(index[body]) <= 2 else f"{axis} {index[body]}")
            if w != 0 and moment != 0:
                pieces.append(Square(moment / 2, (name,)))
    else:
        pieces.append(Name("½ωᵀIω", ""))
    shown: Left = pieces[0] if len(pieces) == 1 else Terms(tuple(pieces))
    return formula(*_chain(share.name, shown, fit(context.readable(share.expr))))


# -- step 3 ---------------------------------------------------------------------------------------------------------


def potential(context: Context, pieces: tuple[Share, ...]) -> Step:
    """V = Σ ½ k (δ − δ₀)² + Σ m g h."""
    model = context.model
    mine = [s for s in pieces if s.column == "V"]
    items: list[Item] = []
    for element in model.elements:
        if element.ledger != "V":
            continue
        items.append(Heading(text(_capital(element.title))))
        own = [s for s in mine if s.element is element]
        if isinstance(element, Spring):
            items += _spring(context, element, own[0])
        elif isinstance(element, Gravity):
            items += _gravity(context, element, own)
        elif isinstance(element, Capacitor):
            items += capacitor(context, element, own[0].name)
        else:
            items += [_plain(context, share) for share in own]
    whole = context.algebra.total([s.form for s in mine])
    readable = whole.expr() if mine else sp.S.Zero
    if mine:
        live = [s for s in mine if s.expr != 0] or mine
        items.append(formula(*_chain(Name("V"), _sum(live, "V"), _added(context, live)), brief=True))
    else:
        items.append(nothing_stored(model))
        items.append(formula(Name("V"), sp.S.Zero, brief=True))
    reasons = tuple(text(s.name, f": {s.element.title} ", _stored(s)) for s in mine)
    return potential_step(model, items, readable, reasons)


def potential_step(model: Model, items: Sequence[Item], V: sp.Expr, reasons: Sequence[Text]) -> Step:
    """Step 3 with its items, V and the reason for each of its parts."""
    what, why = step_three(model)
    return Step(
        3,
        "Potential energy",
        what,
        why,
        tuple(items),
        {"V": V},
        tuple(reasons),
    )


def _stored(share: Share) -> str:
    if share.body is not None:
        return f"pulls on {share.body.title}: mgh"
    return share.element.stored


def _spring(context: Context, spring: Spring, share: Share) -> list[Item]:
    model = context.model
    extension = spring.extension(model)
    shown = context.readable(extension)
    name = Name("delta", share.name.index)
    lines: list[Item] = []
    how = text("extension, from its rest length" if spring.rest != 0 else "deflection from its neutral point")
    lines.append(formula(name, fit(shown), note=how))
    if spring.k is not None:
        squared: Left = Square(spring.k / 2, (shown,))
        lines.append(formula(*_chain(share.name, Square(spring.k / 2, (name,)), squared, *_distinct(context, share))))
    else:
        lines.append(text("Its energy is the work of its law from rest to the extension:"))
        lines.append(formula(share.name, fit(context.readable(share.expr))))
    return lines


def _distinct(context: Context, share: Share) -> tuple[Left, ...]:
    """The simplified energy, if it looks different from ½ k (…)²."""
    readable = context.readable(share.expr)
    return (fit(readable),) if isinstance(readable, sp.Add) or (readable.is_Mul and _plain_square(readable)) else ()


def _plain_square(expr: sp.Expr) -> bool:
    return not any(isinstance(f, sp.Pow) and isinstance(f.base, sp.Add) for f in sp.Mul.make_args(expr))


def _gravity(context: Context, gravity: Gravity, own: list[Share]) -> list[Item]:
    model = context.model
    where = "the origin" if gravity.datum is None else model.point_words(gravity.datum)
    if gravity.datum is not None and gravity.datum.name:
        where = f"point '{gravity.datum.name}'"
    lines: list[Item] = [
        text(f"h is the height above the datum, {where} (any fixed one would do: a constant in V changes nothing).")
    ]
    for share in own:
        body = share.body
        assert body is not None
        height = context.readable(gravity.height(model, body.at))
        h = Name("h", share.name.index if share.name.index != "g" else "")
        lines.append(formula(h, fit(height), note=text(body.title)))
        weight = body.mass * gravity.g
        lines.append(formula(*_chain(share.name, Product((weight, h)), fit(context.readable(share.expr)))))
    return lines


# -- step 4 ---------------------------------------------------------------------------------------------------------


def lagrangian(context: Context, pieces: tuple[Share, ...]) -> Step:
    """L = T* − V."""
    readable = context.algebra.total([s.form if s.column == "T*" else -s.form for s in pieces]).expr()
    signed = [x for s in pieces if s.column == "T*" for x in sp.Add.make_args(context.readable(s.expr))]
    signed += [-x for s in pieces if s.column == "V" for x in sp.Add.make_args(context.readable(s.expr))]
    return lagrangian_step(readable, fit_terms(tuple(x for x in signed if x != 0)))


def lagrangian_step(L: sp.Expr, *written: Left) -> Step:
    """Step 4: L = T* − V, and what it is as ``written``, if it is shown."""
    return Step(
        4,
        "Lagrangian",
        text("Subtracted the potential energy from the kinetic co-energy."),
        text(
            "Inertia and all conservative forces follow from this one scalar by differentiation; no force between two "
            "bodies has to be found."
        ),
        (formula(Name("L"), Terms((Name("T*"), Minus(Name("V")))), *written, brief=True),),
        {"L": L},
        (text(Name("L"), " = ", Name("T*"), " − ", Name("V"), ": kinetic co-energy minus potential energy"),),
    )
