"""The coordinates in which an answer states momenta, derivatives of energies and generalized forces.

They are those that its motion is written in: of the system, and of its own, z = x2 − x1, in place of others; what
constraints determine may be put in, s = x + R φ.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, cast
from unicodedata import normalize

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.held import OnConstraints, held
from lagrangian.check.reading import OwnCoordinates, named, of_coordinate, replaced_by
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key

_BARE = re.compile(r"[\s$]*\\?(?:Q|Ξ|Xi|p)[\s&]*=")
"""A generalized force or a momentum without an index."""
_NUMBERED = re.compile(r"[\s$&]*(?:\\?Xi|Ξ|[QFp])\s?_?\s?\{?\s?\d\s?\}?\s*&?=")
"""A force or a momentum that is called by the number of its coordinate."""

MOST_REPLACED = 4
"""The most coordinates of which such a determinant is computed."""
OF_COORDINATES = ("Xi", "p", "p-rate", "slope", "left")
"""What lines state for one coordinate."""


@lru_cache(maxsize=32)
def chart(truth: Reference, lines: tuple[AnsweredLine, ...]) -> OwnCoordinates | None:
    """The coordinates of an answer, whose definitions say what its own are; None if they are those of the system, or
    if it is not clear which ones its own replace."""
    coordinates = [c.symbol for c in truth.model.coordinates]
    on = held(truth) if truth.derivation.multipliers else None
    table = on.table if on is not None else {}
    rows = tuple(q - table[q] for q in coordinates if q in table)
    stated, gone = replaced(truth, [x for x in lines if on is None or not _is_kinematic(x, on)])
    if len(gone) <= len(rows):  # the constraints say what became of these: other names are abbreviations
        asked = _names_of_quantities(lines)
        stated = [x for x in stated if key(str(x.name)) in asked]
    own = tuple((key(str(line.name)), line.expr) for line in stated)
    return replaced_by(own, gone, tuple(coordinates), rows) if gone else None


def region(truth: Reference, lines: Sequence[AnsweredLine]) -> sp.Expr | None:
    """det ∂η/∂ξ of the coordinates η of an answer's own, x = l cos φ, whose sign is constant where they determine the
    motion: there √(l² − x²) is l sin φ. None if it is constant, or if there are none."""
    stated, gone = replaced(truth, lines)
    if not 0 < len(stated) == len(gone) <= MOST_REPLACED or truth.derivation.multipliers:
        return None
    J = sp.Matrix([[bounded.diff(truth.expand(x.expr), q) for q in gone] for x in stated])
    det = bounded.expand(cast("sp.Expr", J.det()))
    return det if det.has(*truth.derivation.coordinates) else None


def replaced(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[list[AnsweredLine], tuple[Any, ...]]:
    """The definitions of the coordinates of an answer's own, and the coordinates of the system that it does not use.

    It uses those that its equations of motion name, and those for which it states a quantity; a definition may be one
    of the system.
    """
    coordinates = truth.model.coordinates
    moving = [x for x in lines if x.kind == "equation" and _has_any(x, [c.acceleration for c in coordinates])]
    moving = moving or [x for x in lines if x.kind != "definition" and _has_any(x, [c.rate for c in coordinates])]
    used = {name for x in moving for name in x.names or map(named, x.expr.atoms(AppliedUndef))}
    used |= _names_of_quantities(lines)
    own = {key(c.name) for c in coordinates}
    of_system = (AnsweredLine("definition", truth.expand(d.symbol), 0, d.name) for d in truth.model.definitions)
    defined = (x for x in (*of_system, *lines) if x.kind == "definition" and _is_place(truth, x))
    said = {key(str(x.name)): x for x in defined}
    stated = [x for name, x in said.items() if name in used and name not in own]
    gone = tuple(c.symbol for c in coordinates if key(c.name) not in used)
    if len(stated) > len(gone):  # A = J + m x² beside x = r φ: one that has no rate only abbreviates
        stated = [x for x in stated if any(_is_rated(str(x.name), line.text) for line in moving)]
    return stated, gone


def _is_rated(name: str, written: str) -> bool:
    """Whether a name has a mark of a rate in a line as it is written."""
    bare = re.escape(name.lstrip("\\"))
    form = rf"(?<!\w){bare}(?:['’′″\u0307\u0308]|_?d?dot(?!\w)|dd?(?!\w))|\\d?dot[ ]?\{{?[ ]?\\?{bare}(?!\w)"
    return re.search(form, normalize("NFD", written)) is not None


def _names_of_quantities(lines: Sequence[AnsweredLine]) -> set[str]:
    """The coordinates for which an answer states a quantity."""
    named = {key(str(x.name)) for x in lines if x.kind in OF_COORDINATES and not of_place(x)}
    return named | {key(found[1]) for line in lines if (found := _stated(line)) is not None}


def _is_kinematic(line: AnsweredLine, on: OnConstraints) -> bool:
    """Whether a line only says what constraints do, φ'' = x''/R: it is no equation of motion in φ."""
    if line.kind != "equation" or not line.expr.has(*on.table):
        return False
    return zero_everywhere(on, on.put_in(line.expr))


def system_coordinates(truth: Reference) -> OwnCoordinates:
    """The coordinates of the system."""
    names = {key(c.name): ((c.symbol, sp.S.One),) for c in truth.model.coordinates}
    return OwnCoordinates(names, tuple(names))


def with_own_quantities(
    truth: Reference, lines: Sequence[AnsweredLine], own: OwnCoordinates | None
) -> tuple[AnsweredLine, ...]:
    """The lines, in which Q_z and p_z of a coordinate z of the answer's are no names that it defines, and Q_1 is that
    of the coordinate in the first place, as is Q alone of the only one."""
    if own is None:
        return tuple(lines)
    coordinates = [c.name for c in truth.model.coordinates]
    names = {key(str(x.name)): str(x.name) for x in lines if x.kind == "definition"}
    names |= {key(name): name for name in coordinates}
    stated = Counter(x.name for x in lines if x.kind == "definition")
    found: list[AnsweredLine] = []
    for line in lines:
        quantity = _stated(line)
        once = quantity is not None and (stated[line.name] == 1 or quantity[0] == "Xi")  # forces may be listed in parts
        if quantity is not None and key(quantity[1]) in own.columns and once:
            line = replace(line, kind=quantity[0], name=names.get(key(quantity[1]), quantity[1]))
        elif of_place(line) and line.name in coordinates and key(line.name) not in own.columns:
            k = coordinates.index(line.name)
            place = own.order[k] if k < len(own.order) else ""
            line = replace(line, name=names.get(place, line.name))
        found.append(line)
    return tuple(found)


def of_unknown(line: AnsweredLine) -> Text:
    """What to say of a line that states a quantity for a coordinate that is neither the system's nor explained."""
    return text(f"'{line.text}' was not judged: nothing says which coordinate {line.name} replaces.")


def of_place(line: AnsweredLine) -> bool:
    """Whether a line states the force or the momentum of a coordinate that it calls by its number, or of the only one
    without its name, Q = …"""
    return line.kind in ("Xi", "p") and any(form.match(line.text) is not None for form in (_NUMBERED, _BARE))


def _stated(line: AnsweredLine) -> tuple[str, str] | None:
    """Of which name a definition states a generalized force or a momentum, Q_z or p_z."""
    return of_coordinate(str(line.name)) if line.kind == "definition" else None


def _has_any(line: AnsweredLine, symbols: Sequence[sp.Expr]) -> bool:
    return line.expr.has(*symbols)


def _is_place(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line defines a name by positions alone."""
    c = truth.model.coordinates
    return line.expr.has(*(x.symbol for x in c)) and not line.expr.has(sp.Derivative)
