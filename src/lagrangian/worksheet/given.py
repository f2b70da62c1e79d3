"""What a question sheet gives, in words and letters, and the seven steps that it asks for."""

from __future__ import annotations

import re
from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import listed
from lagrangian.look.phrases import called, said
from lagrangian.model import (
    Body,
    Capacitor,
    Constraint,
    Damper,
    Element,
    Force,
    Gravity,
    Inductor,
    Input,
    Kinetic,
    Model,
    MutualInductance,
    Parameter,
    Potential,
    Resistor,
    RigidBody,
    Spring,
    Torque,
    Transducer,
    VelocityConstraint,
    VoltageSource,
)
from lagrangian.page.formula import Item, Left, Name, Table, Text, text
from lagrangian.page.plain import plain
from lagrangian.worksheet.directions import along, positive_sense
from lagrangian.worksheet.worded import typeset
from lagrangian.write.numerals import measured, unit

STEPS: tuple[tuple[str | Left, ...], ...] = (
    ("Is the system holonomic? Count the generalized coordinates and the degrees of freedom.",),
    ("The generalized coordinates: are those of the table complete and independent? Absolute or relative?",),
    (
        "The kinetic co-energy ",
        Name("T*"),
        ": the position and the velocity of every mass, then its share.",
    ),
    (
        "The potential energy ",
        Name("V"),
        " of everything that stores energy by where it is.",
    ),
    (
        "The Lagrangian ",
        Name("L"),
        " and, for every coordinate, its derivatives.",
    ),
    ("The left-hand sides of Lagrange's equations.",),
    (
        "The generalized forces ",
        Name("Xi"),
        " of everything that is not in ",
        Name("V"),
        ", each with its reason.",
    ),
)
"""The seven steps of the lecture, as questions."""

COILS: tuple[str | Left, ...] = (
    "The kinetic co-energy ",
    Name("T*"),
    ": the velocity of every mass and the flux linkage of every coil, then its share.",
)
"""Step 2 of a system with coils."""


def given(model: Model, seen: str) -> Iterator[Item]:
    """What the picture shows, where springs are relaxed, which way forces are positive, and the tables of letters."""
    if seen:
        yield text(_quoted(model, seen))
    for element in model.elements:
        if isinstance(element, Spring):
            yield from _deflected(model, element, seen)
            yield from _relaxed(model, element)
        elif isinstance(element, Damper):
            yield from _deflected(model, element, seen)
        elif isinstance(element, Force | Torque):
            yield from _positive(model, element)
        elif isinstance(element, Constraint | VelocityConstraint):
            named = f" '{element.name}'" if element.name else ""
            distance = getattr(element, "distance", None)
            if element.expression is not None:
                yield text(f"The constraint{named} is ", element.expression, " = 0.")
            elif distance is not None:
                yield text(f"The constraint{named} holds two points at the distance ", distance, ".")
        elif isinstance(element, Kinetic | Potential):
            what = "kinetic co-energy" if isinstance(element, Kinetic) else "potential energy"
            yield text(f"The {what} '{element.name}' is given: ", element.value, ".")
    yield _coordinates(model)
    if rows := [*_letters(model)]:
        yield Table((text("letter"), text("what it is"), text("value")), tuple(rows))
    for d in (d for d in model.definitions if not d.expression.is_Symbol and not d.expression.is_Function):
        yield text(d.symbol, " stands for ", d.expression, ".")


def _quoted(model: Model, words: str) -> str:
    """A sentence in which letters that name elements are quoted, so that they are set as letters."""
    letters = {x.name for x in (*model.parameters, *model.inputs)} & {e.name for e in model.elements} - {"a", "I"}
    return re.sub(r"\w+", lambda found: f"'{found[0]}'" if found[0] in letters else found[0], words)


def _capital(element: Element) -> str:
    words = said(element) if said(element).startswith("the ") else element.title
    return words[:1].upper() + words[1:]


def _deflected(model: Model, element: Spring | Damper, seen: str) -> Iterator[Item]:
    """What a spring or damper joins and its deflection, unless the picture shows between what it is."""
    shown = seen.casefold()
    phrase = said(element).casefold()
    if element.deflection is None or any(f"{phrase} {word} " in shown for word in ("between", "at")):
        return
    joined = _joined(model, element.deflection)
    if len(joined) == 2:
        yield text(f"{_capital(element)} joins {listed([called(b) for b in joined])}.")
    if isinstance(element, Spring):
        yield text(f"The extension of {said(element)} is ", element.deflection, ".")
    else:
        yield text(f"{_capital(element)} resists the rate of ", element.deflection, ".")


def _joined(model: Model, deflection: sp.Expr) -> list[Body]:
    """The bodies whose coordinates a deflection has, if each of these coordinates moves one body only."""
    found: list[Body] = []
    for c in model.coordinates:
        if not model.expand(deflection).has(c.symbol):
            continue
        moved = [b for b in model.bodies if any(model.expand(x).has(c.symbol) for x in model.position(b.at))]
        if len(moved) != 1:
            return []
        found += [b for b in moved if b not in found]
    return found


def _relaxed(model: Model, spring: Spring) -> Iterator[Item]:
    """Where a spring is relaxed, and its law if it is not linear."""
    if spring.deflection is not None:
        side = _sign(spring.deflection) if spring.rest == 0 else 1
        yield text(
            f"{_capital(spring)} is relaxed where ", side * spring.deflection, " = ", sp.sympify(spring.rest), "."
        )
    elif spring.rest != 0:
        yield text(f"The length of {spring.title} is ", spring.rest, " where it is relaxed.")
    else:
        yield text(f"{_capital(spring)} is relaxed where its ends meet.")
    for what, law in (("pulls with", spring.law), ("stores the energy", spring.energy)):
        if law is not None:
            yield text(f"At an extension δ it {what} ", law.xreplace({sp.Symbol("delta"): sp.Symbol("δ")}), ".")
            return


def _positive(model: Model, element: Force | Torque) -> Iterator[Item]:
    """Which way a force or torque is positive, and how it depends on its letter."""
    if isinstance(element.value, sp.Expr):
        turned = _sign(element.value) < 0
        named = _named(element, -element.value if turned else element.value)
        along_it = element.on if isinstance(element, Torque) else element.deflection
        if isinstance(along_it, sp.Expr):
            if not along_it.is_Add and _sign(along_it) < 0:
                along_it, turned = -along_it, not turned
            yield text(*named, " in the sense in which ", along_it, " falls." if turned else " grows.")
        elif isinstance(element, Force):
            yield text(*named, f" where it {'pulls its two ends together' if turned else 'pushes its two ends apart'}.")
        elif model.dimension == 2:
            yield text(*named, f" {'clockwise' if turned else 'counter-clockwise'}{_turned_body(model, element)}.")
        return
    if isinstance(element, Torque):
        return
    values = [x for x in element.value if x != 0]
    known = along([sp.S.One * _sign(x) if x != 0 else x for x in element.value])
    if known is not None and element.axes is None:
        yield text(*_named(element, values[0] * _sign(values[0])), f" {known}{_where(model, element)}.")
    else:
        parts = [x for value in element.value for x in (value, ", ")][:-1]
        frame = f" in the axes of {element.axes.name}" if element.axes is not None else ""
        yield text(f"{_capital(element)} has the components ", *parts, f"{frame}.")


def _where(model: Model, force: Force) -> str:
    """Where a force acts on a body that is not a point."""
    found = next((b for b in model.bodies if b.at is force.at and isinstance(b, RigidBody)), None)
    return "" if found is None else f"; it acts at the centre of mass of {found.title}"


def _turned_body(model: Model, torque: Torque) -> str:
    """What a torque on a frame turns."""
    found = next((b for b in model.bodies if getattr(b, "frame", None) is torque.on), None)
    return "" if found is None else f"; it turns {found.title}"


def _named(element: Element, value: sp.Expr) -> tuple[str | Left, ...]:
    """The beginning of a sentence: "Force F is positive", or "Force 'hoist' is −F_h, positive"."""
    if plain(value) == element.name:
        return (f"{_capital(element)} is positive",)
    return (f"{_capital(element)} is ", value, ", positive")


def _sign(value: sp.Expr) -> int:
    return -1 if value.could_extract_minus_sign() else 1


def _coordinates(model: Model) -> Table:
    rows: list[tuple[Text, ...]] = []
    for c in model.coordinates:
        sense = positive_sense(model, c)
        known = sense is None or "positive" in c.description or sense in c.description
        words = typeset(model, c.description or "a coordinate")
        rows.append((text(c.symbol), text(*words, *([] if known else [f"; positive {sense}"]))))
    return Table((text("coordinate"), text("what it measures")), tuple(rows))


def _letters(model: Model) -> Iterator[tuple[Text, ...]]:
    """The parameters with their values and the inputs with their units."""
    for p in model.parameters:
        value = "" if p.value is None else measured(p.value, p.unit)
        yield text(p.symbol), text(*_meaning(model, p.symbol, p)), text(value)
    for u in model.inputs:
        measure = f"[{unit(u.unit)}]" if u.unit else ""
        yield text(u.symbol), text(*_meaning(model, u.symbol, u)), text(measure)


ROLES: tuple[tuple[type[Element], str, str, str], ...] = (
    (Body, "mass", "mass", "mass of {}"),
    (Body, "inertia", "moment of inertia about the centre of mass", "moment of inertia of {} about its centre of mass"),
    (Spring, "k", "stiffness", "stiffness of {}"),
    (Damper, "b", "damping", "damping of {}"),
    (Inductor, "L", "inductance", "inductance of {}"),
    (MutualInductance, "M", "mutual inductance", "mutual inductance of two coils"),
    (Capacitor, "C", "capacitance", "capacitance of {}"),
    (Resistor, "R", "resistance", "resistance of {}"),
    (VoltageSource, "value", "voltage", "voltage of a source"),
    (Transducer, "k", "constant", "constant of {}: effort per current, and voltage per speed"),
    (Gravity, "g", "gravitational acceleration", "gravitational acceleration"),
    (Force, "value", "force", "{}"),
    (Torque, "value", "torque", "{}"),
)
"""What a letter is: the kind of element, its field, the role beside a description, and the words without one."""


LENGTHS_AND_ANGLES = ((r"[mcdµu]?m", "length"), (r"deg|rad", "angle"))
"""What a letter without a description is that stands only in the geometry, by its unit."""


def _meaning(model: Model, symbol: sp.Expr, letter: Parameter | Input) -> list[str | Left]:
    """What a letter is: its description with its role, "pole (mass)", or the elements that have it."""
    description = letter.description
    uses = [
        (role, alone, element)
        for element in model.elements
        for kind, key, role, alone in ROLES
        if isinstance(element, kind) and _holds(getattr(element, key, None), symbol)
    ]
    if not description:
        words = [
            _of_all(alone, [e for _, a, e in uses if a == alone]) for alone in dict.fromkeys(a for _, a, _ in uses)
        ]
        return ["; ".join(words)] if words else [_kind_of(letter)]
    parts = typeset(model, description)
    if uses and (roles := [r for r in dict.fromkeys(r for r, _, _ in uses) if not _says(description, r)]):
        parts.append(f" ({' and '.join(roles)})")
    others = [(alone, e) for _, alone, e in uses if not _named_in(e, description)]
    if len(uses) > len(others) > 0:  # it names one of the elements that have the letter, and not the others
        kinds = dict.fromkeys(alone for alone, _ in others)
        parts.append(f"; also {' and '.join(_of_all(a, [e for b, e in others if a == b]) for a in kinds)}")
    return parts


def _of_all(alone: str, elements: list[Element]) -> str:
    """What a letter is to several elements: "mass of rigid body 'drum' and particle 'load'"."""
    if len(elements) > 1 and alone.endswith("its centre of mass"):
        alone = alone.replace(" about its", ", each about its")
    return alone.format(listed(list(dict.fromkeys(e.title for e in elements))))


def _named_in(element: Element, description: str) -> bool:
    """Whether a description names an element."""
    return bool(re.search(rf"\b{re.escape(element.name)}\b", description)) and len(element.name) > 2


def _kind_of(letter: Parameter | Input) -> str:
    """What a letter is that no element has, from its unit."""
    if isinstance(letter.symbol, AppliedUndef):
        return "input"
    return next((what for unit, what in LENGTHS_AND_ANGLES if re.fullmatch(unit, letter.unit or "")), "constant")


def _holds(value: object, symbol: sp.Expr) -> bool:
    """Whether a value is a letter, or a vector or matrix with that letter as an entry."""
    entries = value.flat() if isinstance(value, sp.MatrixBase) else value if isinstance(value, tuple) else (value,)
    return any(x in (symbol, -symbol) for x in entries)


def _says(description: str, role: str) -> bool:
    return any(word in description.casefold() for word in role.split() if len(word) > 4) or role in description


def asked(model: Model) -> Iterator[Item]:
    """The seven steps, and the result."""
    yield text("Derive the equations of motion by the Lagrangian approach, every step with its reason.")
    steps = (*STEPS[:2], COILS, *STEPS[3:]) if any(e.ledger == "T*" for e in model.branches) else STEPS
    yield Table((text("step"), text("what is asked")), tuple((text(str(k)), text(*s)) for k, s in enumerate(steps)))
    count = len(model.coordinates)
    what = "the equation of motion" if count == 1 else f"the {count} equations of motion"
    held = " with the forces of the constraints" if model.constraints else ""
    yield text(f"Result: {what}{held}.")
