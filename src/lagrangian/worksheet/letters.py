"""Other letters for the symbols of a variant, as a textbook would choose them, and other values of parameters."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence

import sympy as sp

from lagrangian.derive.coordinates import measured
from lagrangian.model import Body, Coordinate, Model, Parameter
from lagrangian.quantities.quantity import unit_factor
from lagrangian.worksheet.dice import Dice
from lagrangian.worksheet.directions import positive_sense
from lagrangian.worksheet.worded import GREEK, is_letter, number, parts_of, relations

ANGLES = ("theta", "phi", "psi", "gamma", "alpha")
"""The letters of angles; alpha only where no parameter is an angle, such as that of a slope."""

LENGTHS: Mapping[str, tuple[str, ...]] = {
    "across": ("x", "s", "u", "w"),
    "upright": ("y", "z", "s", "u"),
    "": ("s", "u", "w"),
}
"""The letters of displacements: to the side, up or down, and in other directions."""

POOLS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (r"kg|g|t", ("m", "M")),
    (r"k?g\*?\s*m\^?2|kg m2", ("J", "Theta", "J_c")),
    (r"N/m", ("k", "c", "kappa")),
    (r"N\*?m(/rad)?", ("k", "c", "kappa")),
    (r"N\*?s/m|N\*?m\*?s(/rad)?|kg/s", ("b", "d", "beta")),
    (r"[cmd]?m", ("l", "a", "d")),
)
"""The letters of parameters by unit."""

NAMED_LENGTHS = (("radius", "Rr", ("r", "R")), ("height", "", ("h", "H")))
"""Lengths that have letters of their own: the word for it, letters that say so without it, and the letters."""

AXES = re.compile(r"(?:\b(?:along|about|axis|axes) [xyz]\b|\b[xyz](?:-axis| axis))")
"""The axes of the plane or of space in a description, which are no letters of the system."""

INPUTS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (r"N", ("F", "P", "f")),
    (r"N\*?m", ("tau", "u")),
)
"""The letters of inputs by unit; M, C and G are the matrices of every derivation."""

KEPT = {"g"}
"""Letters that everybody knows and no variant changes."""

NATURE = ((9.81, "m/s"), (8.854e-12, "F/m"), (1.2566e-6, "H/m"))
"""Constants of nature, with the end or the beginning of their unit, which keep their value, too."""

FACTORS = (0.4, 0.5, 0.6, 0.8, 1.2, 1.25, 1.5, 2.0, 2.5, 3.0)
"""The factors between the values of a variant and those of the original."""

_SPLIT = re.compile(r"([A-Za-z]+?)(_?\d+[a-z]?|_[A-Za-z0-9_]+|r)?")


def _split(name: str) -> tuple[str, str]:
    """The letter of a name and its index: x2r → x, 2r; L_a → L, _a; theta1 → theta, 1."""
    found = _SPLIT.fullmatch(name)
    return (found[1], found[2] or "") if found is not None else (name, "")


def new_letters(
    names: Sequence[tuple[str, Sequence[str]]], taken: Iterable[str], dice: Dice, tied: Collection[str] = ()
) -> dict[str, str]:
    """Return a new name for each of the names, from its pool of letters; an index stays.

    Names with the same letter keep one letter in common, and no two symbols share a name. The index of a name that is
    ``tied`` to a symbol, as L_k for the arm of spring k, follows it. No letter misleads: one that had another kind of
    meaning is not used, nor one that is an index of something else.
    """
    pools, taken = {name: tuple(pool) for name, pool in names}, tuple(taken)
    bases: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for name, pool in names:
        bases.setdefault((_split(name)[0], tuple(pool)), []).append(name)
    found: dict[str, str] = {}
    indices = {index_of(n) for n in (*pools, *taken)} - {""}
    for (base, pool), group in sorted(bases.items(), key=lambda item: any(n in tied for n in item[1])):
        foreign = {other for other, theirs in bases if theirs != pool}
        foreign |= {_split(v)[0] for n, v in found.items() if pools[n] != pool}
        kept = foreign | indices | {index_of(n) for n in found.values()} - {""}
        free = [x for x in dice.shuffled(pool) if x != base and not {x, index_of(x)} & kept]
        free = [x for x in free if index_of(x) not in found.values()]
        used = {_clash(n) for n in (*taken, *found.values())}
        for letter in [*free, base] if len(base) == 1 or base in GREEK else [base]:
            made = {name: letter + (f"_{found[index_of(name)]}" if name in tied else _split(name)[1]) for name in group}
            if not {_clash(x) for x in made.values()} & used and len(set(made.values())) == len(group):
                found.update(made)
                break
        else:
            return {name: name for name in pools}  # nothing fits beside the letters chosen before
    return found


def index_of(name: str) -> str:
    """The index of a name that has one behind a stroke: L_k → k."""
    return _split(name)[1].removeprefix("_") if "_" in name else ""


def _clash(name: str) -> str:
    """What two names must not have in common; of the letters that differ in size only, m and M go together."""
    return name if name[:1] in ("m", "M") else name.casefold()


def coordinate_letters(model: Model, dice: Dice) -> dict[str, str]:
    """Return a new name for every coordinate; floating frames, charges and names of several words keep theirs."""
    kinds = measured(model)
    floating = {c.name for f in model.floating if f.floating is not None for c in f.floating.coordinates}
    kept = floating | {c.name for c in model.charges}
    sloped = any(p.unit in ("deg", "rad") for p in model.parameters)
    angles = tuple(x for x in ANGLES if x != "alpha" or not sloped)
    names = [
        (c.name, angles if kinds[c.symbol].angle else LENGTHS[_way(model, c)])
        for c in model.coordinates
        if c.name not in kept
    ]
    others = [*(x.name for x in (*model.parameters, *model.inputs, *model.definitions)), *kept]
    return new_letters(names, [*others, "t", "e"], dice)


def _way(model: Model, c: Coordinate) -> str:
    """Which way a coordinate moves its body."""
    sense = positive_sense(model, c)
    return {"to the right": "across", "to the left": "across", "upward": "upright", "downward": "upright"}.get(
        sense or "", ""
    )


def parameter_letters(model: Model, dice: Dice) -> dict[str, str]:
    """Return a new name for every parameter and input whose unit has letters of its own."""
    names = [(p.name, _of_parameter(p)) for p in model.parameters if p.name not in KEPT]
    names += [(u.name, _pool(u.unit, INPUTS)) for u in model.inputs]
    known = [(name, pool) for name, pool in names if pool]
    mine = {name for name, _ in known}
    rest = [x.name for x in (*model.parameters, *model.inputs) if x.name not in mine]
    others = [x.name for x in (*model.coordinates, *model.definitions)]
    return new_letters(known, [*rest, *others, "t", "e", "g"], dice, _tied(model) & mine)


def _tied(model: Model) -> set[str]:
    """The parameters whose index is the letter of an element that they belong to, by their arm or description."""
    found: set[str] = set()
    for p in model.parameters:
        for element in model.elements:
            own = {getattr(getattr(element, key, None), "name", None) for key in ("k", "b", "mass")}
            words = ("mass", element.kind, element.name) if isinstance(element, Body) else (element.kind, element.name)
            arm = getattr(element, "deflection", None)
            said = any(re.search(rf"\b{re.escape(w)}\b", p.description) for w in words if len(w) > 2)
            if index_of(p.name) in own and index_of(p.name) not in KEPT:
                found |= {p.name} if said or (isinstance(arm, sp.Expr) and arm.has(p.symbol)) else set()
    return found


def _of_parameter(parameter: Parameter) -> tuple[str, ...]:
    """The letters of a parameter; a radius and a height have their own."""
    pool = _pool(parameter.unit, POOLS)
    if pool == POOLS[-1][1]:
        for word, known, letters in NAMED_LENGTHS:
            if word in parameter.description or _split(parameter.name)[0] in tuple(known):
                return letters
    return pool


def relabelled(description: str, names: Mapping[str, str | None]) -> str:
    """A description with the new names of its letters; a part with a letter whose new name is None is left out.

    A letter is one character, a Greek name, has an index, or stands in a formula; other words stay, as do a, A and I.
    """
    parts = [_relabelled(part, names) for part in parts_of(description)]
    return "".join(x for x in parts if x is not None).lstrip(",;: ")


def _relabelled(part: str, names: Mapping[str, str | None]) -> str | None:
    formula = any(x in part for x in "*^=/+")
    words = set(re.findall(r"\w+", part)) - set(re.findall(r"\b[xyz]\b", " ".join(AXES.findall(part))))
    told = {w for w in words if w in names and (formula or is_letter(w))}
    if any(names[w] is None for w in told):
        return None
    return re.sub(r"(?<!\d )(?<!\w)\w+", lambda found: str(names[found[0]]) if found[0] in told else found[0], part)


def _pool(unit: str | None, pools: Sequence[tuple[str, tuple[str, ...]]]) -> tuple[str, ...]:
    bare = (unit or "").replace("·", "*").replace(" ", "*")
    return next((letters for pattern, letters in pools if re.fullmatch(pattern, bare)), ())


def new_values(model: Model, dice: Dice) -> dict[str, float | None]:
    """Return other values [SI] of the parameters; what a description derives from others still follows from them."""
    drawn = {p.name: new_value(p, dice) for p in model.parameters}
    values = {p.symbol: v for p in model.parameters if (v := drawn[p.name]) is not None}
    for symbol, expression in relations(model).items():
        if (follows := number(expression, values)) is not None:
            values[symbol] = float(f"{follows:.4g}")
            drawn[symbol.name] = values[symbol]
    return drawn


def new_value(parameter: Parameter, dice: Dice) -> float | None:
    """Return another value [SI] for a parameter: a simple number in its unit, of the same size; None if it has none.

    g, constants of nature, numbers without a unit and 0 keep their value; an angle changes by a few degrees.
    """
    value, unit = parameter.value, parameter.unit
    factor = dice.one(FACTORS)
    if value is None or value == 0 or parameter.name in KEPT or not unit:
        return value
    if any(abs(value / known - 1) < 0.01 and u in unit for known, u in NATURE):
        return value
    scale = unit_factor(unit)
    if unit in ("deg", "rad"):
        factor = 0.5 + factor / 4
    return _rounded(value / scale * factor) * scale


def _rounded(value: float) -> float:
    """A number with two digits."""
    size = 10 ** (math.floor(math.log10(abs(value))) - 1)
    return float(f"{round(value / size) * size:.6g}")
