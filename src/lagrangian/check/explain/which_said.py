"""Of which body, and along which axis, an answer says a quantity to be: "vertical velocity of the bob: v_y = …"."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import permutations
from typing import Any, TypeAlias

import sympy as sp

from lagrangian.check.explain.meant import axis_of, is_about_centre, is_about_point, owner_of
from lagrangian.check.explain.quantities import Sayable, quantities_of
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import Gravity, RigidBody

Axes: TypeAlias = frozenset[int]
PLACED = frozenset(
    ["speed", "component", "along", "apart", "position", "height", "place", "velocity", "acceleration", "turning"]
)
"""Kinds of quantities that are said of one body."""
INERTIAS = ("inertia", "axis", "mass")
"""Kinds of what a moment of inertia may be: about the centre of mass, about a pivot, of all that moves."""
_ALONG = re.compile(
    r"\b(?:(?P<before>[xyz])(?:[ -](?:component|coordinate|direction|axis|part)|-?(?:komponente|richtung|achse))"
    r"|(?:in|along)[ ](?:the[ ])?(?P<behind>[xyz])(?![\w'’′(=^])(?![ ]*[=+*/^])"
    r"|(?P<level>horizontal)|(?P<upright>vertical|vertikal|senkrecht))",
    re.IGNORECASE,
)
_LETTER = re.compile(
    r"\b(?:of|von)[ ](?:(?:the|der|des)[ ])?(?:(?:mass|point|body|masse|punkts?|körpers?)[ ])?"
    r"(?P<letter>[^\W\d_]_?\d{0,2})\b",
    re.IGNORECASE,
)
_ABOUT = re.compile(
    r"\b(?:about|around|with[ ]respect[ ]to|relative[ ]to|um|bezüglich|bzgl\.?)[ ][^=:,;\n]{0,24}?\b(?:"
    r"(?:hinge|pivot|joint|support|suspension|bearing|contact|hook|instant|gelenk|drehpunkt|lager|aufhäng|momentanpol"
    r"|cent(?:re|er)[ ]of[ ]rotation)|(?P<centre>cent(?:re|er)|schwerpunkt|massenmittelpunkt|com\b))",
    re.IGNORECASE,
)
_BETWEEN = re.compile(
    r"\b(?:damp|dashpot|brak|spring|relativ|between|against|rope|slip|deflect|elongat|stretch|dämpf|feder|gegen|zwischen|seil)",
    re.IGNORECASE,
)
"""What begins words of what acts between bodies."""
_FIXED = re.compile(r"(?P<axis>[xyz]) (?:component|coordinate) of the \w|(?P<place>[xyz]) coordinate of ")


def as_said(
    truth: Reference, line: AnsweredLine, found: Sequence[Sayable], letters: Mapping[str, int]
) -> list[Sayable]:
    """Those of the quantities that a definition has right that are what it says: of the body and along the axis that
    its name or the words before it name. ``letters``: which axes x, y and z are."""
    axes = _axes_said(truth, line, letters)
    kept = of_owner_said(truth, line, found)
    kept = [q for q in kept if axes is None or (axis := fixed_axis(q)) is None or axis in axes]
    return [q for q in kept if q.kind not in INERTIAS or _is_about(truth, line, q)]


def _is_about(truth: Reference, line: AnsweredLine, q: Sayable) -> bool:
    """Whether a moment of inertia is about the point that is said: the centre of mass, or a hinge that is none."""
    name, body = line.name or "", q.owner
    bodies = [body] if isinstance(body, RigidBody) else [b for b in truth.model.bodies if isinstance(b, RigidBody)]
    said = _ABOUT.search(f"{line.words} {name if ' ' in name else ''}")
    if any(is_about_centre(name, b, truth.model) for b in bodies) or (said is not None and said["centre"]):
        return q.kind == "inertia"
    moving = isinstance(body, RigidBody) and any(x != 0 for x in quantities_of(truth).of.velocity(body))
    return q.kind != "inertia" or not moving or not (said is not None or is_about_point(name, body, truth.model))


def of_owner_said(truth: Reference, line: AnsweredLine, found: Sequence[Sayable]) -> list[Sayable]:
    """Those of some quantities that are of the body that a definition says; all if it says none.

    The rate of a damper is none of a body's, unless the words speak of what is between bodies.
    """
    owner = owner_said(truth, line)
    if owner is None:
        return list(found)
    kinds = PLACED if _BETWEEN.search(f"{line.words} {line.name}") else PLACED | {"rate"}
    return [q for q in found if q.kind not in kinds or owner is q.owner or owner.title in q.also]


def owner_said(truth: Reference, line: AnsweredLine) -> Any:
    """The body that a name or the words before it name, by its own name or by the letter of its mass or point."""
    name = line.name or ""
    if (owner := owner_of(name, truth.model)) is not None:
        return owner
    words = f"{line.words} {name if ' ' in name else ''}"
    if (owner := owner_of(f" {words}", truth.model)) is not None:
        return owner
    found = {owner_of(f"v_{x['letter']}", truth.model) for x in _LETTER.finditer(words)}
    return found.pop() if len(found) == 1 else None


def letters_meant(said: Sequence[tuple[AnsweredLine, Sequence[Sayable]]], truth: Reference) -> dict[str, int]:
    """Which axes x, y and z of an answer are: ours, or the same in another order if no quantity is right along ours and
    every one is along these, and no coordinate of the system is called so."""
    own = dict(zip("xyz", range(3), strict=True))
    named: list[tuple[str, set[int]]] = []
    for line, found in said:
        axes = {a for q in found if (a := fixed_axis(q)) is not None}
        if (letter := axis_of(line.name or "")) is not None and axes:
            named.append((letter, axes))
    used = {letter for letter, _ in named}
    coordinates = {c.name for c in truth.model.coordinates}
    if len(used) < 2 or used & coordinates or any(own[letter] in axes for letter, axes in named):
        return own
    for order in permutations(range(truth.model.dimension)):
        other = dict(zip("xyz", order, strict=False))
        if all(letter in other and other[letter] in axes for letter, axes in named):
            return other
    return own


def fixed_axis(q: Sayable) -> int | None:
    """The fixed axis along which a quantity is a component; None for what is along none, or along one that turns."""
    found = _FIXED.match(q.words[0]) if q.words and isinstance(q.words[0], str) else None
    return None if found is None else "xyz".index(found["axis"] or found["place"])


def _axes_said(truth: Reference, line: AnsweredLine, letters: Mapping[str, int]) -> Axes | None:
    """The axes of which a name or the words before it may be; None if they say none."""
    if (letter := axis_of(line.name or "")) is not None:
        return frozenset([letters[letter]]) if letter in letters else None
    said = {x.lastgroup: x for x in _ALONG.finditer(f"{line.words} {line.name if ' ' in (line.name or '') else ''}")}
    if len(said) != 1:
        return None
    ((how, found),) = said.items()
    if how in ("before", "behind"):
        return frozenset([letters[found[how].lower()]])
    upright = _upright(truth)
    if upright is None:
        return None
    return frozenset([upright]) if how == "upright" else frozenset(range(truth.model.dimension)) - {upright}


def _upright(truth: Reference) -> int | None:
    """The axis along which weights act; None if it is none of the fixed ones, or not known."""
    ways = {tuple(sp.sympify(x) for x in e.direction) for e in truth.model.elements if isinstance(e, Gravity)}
    found = [[k for k, x in enumerate(way) if x != 0] for way in ways]
    return found[0][0] if len(found) == 1 and len(found[0]) == 1 else None
