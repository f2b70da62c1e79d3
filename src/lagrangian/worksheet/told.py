"""Words that stay true when elements are attached elsewhere: what a description says of a place is left out."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Coordinate, Damper, Element, Force, Model, Spring, Torque
from lagrangian.model.names import time
from lagrangian.worksheet.directions import says_direction, turned_words
from lagrangian.worksheet.letters import index_of
from lagrangian.worksheet.worded import parts_of, values_of

NAMES: tuple[tuple[type[Element], str], ...] = (
    (Spring, r"springs?|relaxed|unstretched|undeformed|stretch\w*|extension|elongation|natural length"),
    (Damper, r"dampers?|dashpots?"),
    (Force, r"forces?"),
    (Torque, r"torques?|motors?"),
)
"""What elements are called in descriptions, beside their names."""

MOVABLE = (Spring, Damper, Force, Torque)
"""The elements that a variant attaches elsewhere."""

_STRETCH = re.compile(r"stretch|extension|elongation", re.IGNORECASE)
_PUSHES = re.compile(r"pull|push|lift|press|brak|tension|driv|thrust", re.IGNORECASE)
_RELAXED = re.compile(r"relaxed|unstretched|undeformed", re.IGNORECASE)
_RESTS = re.compile(r"\b(?:rests?|equilibrium|balances?|balanced)\b", re.IGNORECASE)
_ORIGIN = re.compile(r" ?(?:measured )?\bfrom (?:where|when|the place where|the position where)\b[^,;:]*")
_HELD = r"\b(?:on|by|from|between|at|under|over|through)\b[^,]*"


def told(model: Model, elements: Mapping[int, Element]) -> dict[str, str] | None:
    """Return the new descriptions, by name, of what elements that have moved make untrue.

    None if a description says too little without that, or the name of the system tells the old place.
    """
    moved = [(e, elements[id(e)]) for e in model.elements if id(e) in elements]
    own = {n for e, _ in moved for n in letters_of(e)}
    found: dict[str, str] = {}
    if any(_titled(model, e) or _indexed(model, e, own) for e, _ in moved) or not _rests_as_before(model, elements):
        return None
    others = {n for e in model.elements if isinstance(e, MOVABLE) and id(e) not in elements for n in letters_of(e)}
    for x in (*model.coordinates, *model.parameters, *model.inputs):
        if x.name in others - own:
            continue  # it says where that element is
        words = x.description
        for old, new in moved:
            words = _without(words, _mentions(model, old), x if isinstance(x, Coordinate) else None, new)
        if x.name in own:
            words = "" if x.name in _bare(e for e, _ in moved) else words
        elif not words and x.description:
            return None
        if words != x.description:
            found[x.name] = words
    return found


def told_turned(model: Model, element: Element) -> dict[str, str]:
    """The descriptions of the letters of a force or torque that acts the other way round."""
    found: dict[str, str] = {}
    for x in (*model.parameters, *model.inputs):
        if x.name in letters_of(element):
            directed = says_direction(x.description) or _PUSHES.search(x.description)
            found[x.name] = turned_words(x.description) or ("" if directed else x.description)
    return found


def letters_of(element: Element) -> set[str]:
    """The parameters and inputs in the constants or the value of an element."""
    return {getattr(s, "name", None) or s.func.__name__ for x in _values(element) for s in _symbols(x)}


def from_outside(model: Model, element: Element) -> bool:
    """Whether a force or torque depends on nothing that moves, as a drag does on the velocity."""
    own = [c.symbol for c in model.coordinates]
    return not any(model.expand(x).has(sp.Derivative, *own) for x in _values(element))


def _bare(elements: Iterable[Element]) -> set[str]:
    """The letters that are, but for a sign, the value of an element."""
    alone = [x for e in elements for x in _values(e) if len(_symbols(x)) == 1 and x.as_coeff_Mul()[1] in _symbols(x)]
    return {getattr(s, "name", None) or s.func.__name__ for x in alone for s in _symbols(x)}


def _values(element: Element) -> list[sp.Expr]:
    values = [getattr(element, key, None) for key in ("k", "b", "value", "g")]
    return [x for v in values for x in (v if isinstance(v, tuple) else (v,)) if isinstance(x, sp.Expr)]


def _symbols(expr: sp.Expr) -> set[Any]:
    return bounded.letters(expr) - {time}


def named_by_words(model: Model, element: Element) -> bool:
    """Whether an element has a name of words, "bearing", which is not the name of a body as well."""
    name = element.name
    bodies = {b.name for b in model.bodies}
    return len(name) > 2 and all(w.isalpha() for w in name.split()) and name not in bodies | letters_of(element)


def _mentions(model: Model, element: Element) -> re.Pattern[str]:
    known = next((words for kind, words in NAMES if isinstance(element, kind)), element.kind)
    name = rf"|{re.escape(element.name)}" if named_by_words(model, element) else ""
    return re.compile(rf"\b(?:{known}{name})\b", re.IGNORECASE)


def _without(words: str, mentioned: re.Pattern[str], coordinate: Coordinate | None, new: Element) -> str:
    """A description without what it says of an element that has moved, unless this is true at its new place, too."""
    kept: list[str] = []
    for part in parts_of(words):
        if mentioned.search(part) and not _still(part, coordinate, new):
            part = _ORIGIN.sub("", part)
            if mentioned.search(part):
                continue
        kept.append(part if re.search(r"\w", part) else "")
    return "".join(kept).strip(" ,;:")


def _still(part: str, coordinate: Coordinate | None, new: Element) -> bool:
    """Whether a coordinate is the extension of a spring at its new place, or at least 0 where the spring is relaxed."""
    if coordinate is None or not isinstance(new, Spring) or new.deflection is None or new.rest != 0:
        return False
    if _STRETCH.search(part):
        return new.deflection == coordinate.symbol
    return bool(_RELAXED.search(part)) and bool((new.deflection / coordinate.symbol).is_number)


def _titled(model: Model, element: Element) -> bool:
    """Whether the name of the system names an element, or something that the element holds."""
    if named_by_words(model, element) and element.name != element.kind and element.name in model.name:
        return True
    return bool(re.search(_HELD + rf"\b{element.kind}s?\b", model.name, re.IGNORECASE))


def _indexed(model: Model, element: Any, own: set[str]) -> bool:
    """Whether a length in the deflection of an element is named after it, L_k after k, or its letter after its name."""
    if any(len(index_of(n)) > 1 and index_of(n) in element.name.split() for n in own):
        return True
    deflection = getattr(element, "deflection", None)
    letters = {str(s) for s in deflection.free_symbols} if isinstance(deflection, sp.Expr) else set[str]()
    return any(index_of(p.name) in own for p in model.parameters if p.name in letters)


def _rests_as_before(model: Model, elements: Mapping[int, Element]) -> bool:
    """Whether the springs hold at rest what they held before, if a description says that something rests."""
    if not any(_RESTS.search(c.description) for c in model.coordinates):
        return True
    springs = [e for e in model.elements if isinstance(e, Spring)]
    return _held(model, springs) <= _held(model, [elements.get(id(e), e) for e in springs])


def _held(model: Model, springs: list[Any]) -> int:
    """How many independent extensions some springs have near the place where all coordinates are 0."""
    own = [c.symbol for c in model.coordinates]
    values = values_of(model)
    rows = [[bounded.diff(model.expand(s.deflection), q) for q in own] for s in springs if s.deflection is not None]
    if not rows:
        return 0
    return int(sp.Matrix(rows).subs(dict.fromkeys(own, 0)).xreplace(values).rank())
