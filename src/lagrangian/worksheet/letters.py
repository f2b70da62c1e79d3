"""Other letters for the symbols of a variant, as a textbook would choose them, and other values of parameters."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence

from sympy.core.alphabets import greeks

from lagrangian.derive.coordinates import measured
from lagrangian.model import Model, Parameter
from lagrangian.quantities.quantity import unit_factor
from lagrangian.worksheet.dice import Dice

ANGLES = ("theta", "phi", "alpha", "psi", "gamma")
LENGTHS = ("x", "y", "s", "z", "u", "w")
"""The letters of coordinates."""

POOLS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (r"kg", ("m", "M", "mu")),
    (r"k?g\*?\s*m\^?2|kg m2", ("J", "Theta", "J_c")),
    (r"N/m", ("k", "c", "kappa")),
    (r"N\*?m(/rad)?", ("k", "c", "kappa")),
    (r"N\*?s/m|N\*?m\*?s(/rad)?|kg/s", ("b", "d", "beta")),
    (r"[cmd]?m", ("l", "a", "h", "r", "d")),
)
"""The letters of parameters by unit."""

INPUTS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (r"N", ("F", "P", "f")),
    (r"N\*?m", ("tau", "u")),
)
"""The letters of inputs by unit; M, C and G are the matrices of every derivation."""

GREEK = frozenset(greeks)

KEPT = {"g"}
"""Letters that everybody knows and no variant changes."""

FACTORS = (0.4, 0.5, 0.6, 0.8, 1.2, 1.25, 1.5, 2.0, 2.5, 3.0)
"""The factors between the values of a variant and those of the original."""

_SPLIT = re.compile(r"([A-Za-z]+?)(_?\d+[a-z]?|_[A-Za-z0-9_]+|r)?")


def _split(name: str) -> tuple[str, str]:
    """The letter of a name and its index: x2r → x, 2r; L_a → L, _a; theta1 → theta, 1."""
    found = _SPLIT.fullmatch(name)
    return (found[1], found[2] or "") if found is not None else (name, "")


def new_letters(names: Sequence[tuple[str, Sequence[str]]], taken: Iterable[str], dice: Dice) -> dict[str, str]:
    """Return a new name for each of the names, from its pool of letters; an index stays.

    Names with the same letter keep one letter in common, and no two symbols share a name.
    """
    used = {n.casefold() for n in taken}
    bases: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for name, pool in names:
        bases.setdefault((_split(name)[0], tuple(pool)), []).append(name)
    found: dict[str, str] = {}
    for (base, pool), group in bases.items():
        for letter in [x for x in dice.shuffled(pool) if x != base] + [base]:
            made = {name: letter + _split(name)[1] for name in group}
            if not {x.casefold() for x in made.values()} & used and len(set(made.values())) == len(group):
                found.update(made)
                used |= {x.casefold() for x in made.values()}
                break
        else:
            found.update({name: name for name in group})
            used |= {name.casefold() for name in group}
    return found


def coordinate_letters(model: Model, dice: Dice) -> dict[str, str]:
    """Return a new name for every coordinate; floating frames, charges and names of several words keep theirs."""
    kinds = measured(model)
    floating = {c.name for f in model.floating if f.floating is not None for c in f.floating.coordinates}
    kept = floating | {c.name for c in model.charges}
    names = [(c.name, ANGLES if kinds[c.symbol].angle else LENGTHS) for c in model.coordinates if c.name not in kept]
    others = [*(x.name for x in (*model.parameters, *model.inputs, *model.definitions)), *kept]
    return new_letters(names, [*others, "t", "e"], dice)


def parameter_letters(model: Model, dice: Dice) -> dict[str, str]:
    """Return a new name for every parameter and input whose unit has letters of its own."""
    names = [(p.name, _pool(p.unit, POOLS)) for p in model.parameters if p.name not in KEPT]
    names += [(u.name, _pool(u.unit, INPUTS)) for u in model.inputs]
    known = [(name, pool) for name, pool in names if pool]
    mine = {name for name, _ in known}
    rest = [x.name for x in (*model.parameters, *model.inputs) if x.name not in mine]
    others = [x.name for x in (*model.coordinates, *model.definitions)]
    return new_letters(known, [*rest, *others, "t", "e", "g"], dice)


def relabelled(description: str, names: Mapping[str, str | None], *, other_values: bool = False) -> str:
    """A description with the new names of its letters; a part with a letter whose new name is None is left out.

    A letter is one character, a Greek name, has an index, or stands in a formula; other words stay, as do a, A and I.
    With ``other_values`` an equality of letters, or with a number other than 0, may not hold any more and is left out.
    """
    parts = [_relabelled(part, names, other_values) for part in re.split(r"(?=[,;:])", description)]
    return "".join(x for x in parts if x is not None).lstrip(",;: ")


def _relabelled(part: str, names: Mapping[str, str | None], other_values: bool) -> str | None:
    formula = any(x in part for x in "*^=/+")
    words = set(re.findall(r"\w+", part))
    told = {w for w in words if w in names and (formula or _is_letter(w))}
    if any(names[w] is None for w in told) or (other_values and "=" in part and (told or re.search("[1-9]", part))):
        return None
    return re.sub(r"(?<!\d )(?<!\w)\w+", lambda found: str(names[found[0]]) if found[0] in told else found[0], part)


def _is_letter(word: str) -> bool:
    return word not in ("a", "A", "I") and (len(word) == 1 or not word.isalpha() or word in GREEK)


def _pool(unit: str | None, pools: Sequence[tuple[str, tuple[str, ...]]]) -> tuple[str, ...]:
    bare = (unit or "").replace("·", "*").replace(" ", "*")
    return next((letters for pattern, letters in pools if re.fullmatch(pattern, bare)), ())


def new_value(parameter: Parameter, dice: Dice) -> float | None:
    """Return another value [SI] for a parameter: a simple number in its unit, of the same size; None if it has none.

    g, numbers without a unit and 0 keep their value; an angle changes by a few degrees.
    """
    value, unit = parameter.value, parameter.unit
    factor = dice.one(FACTORS)
    if value is None or value == 0 or parameter.name in KEPT or not unit:
        return value
    scale = unit_factor(unit)
    if unit in ("deg", "rad"):
        factor = 0.5 + factor / 4
    return _rounded(value / scale * factor) * scale


def _rounded(value: float) -> float:
    """A number with two digits."""
    size = 10 ** (math.floor(math.log10(abs(value))) - 1)
    return float(f"{round(value / size) * size:.6g}")
