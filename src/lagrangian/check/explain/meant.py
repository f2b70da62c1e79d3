"""Which quantities a name may mean by its letters: v_S the speed of the body at S, T_2 the kinetic energy of body 2."""

from __future__ import annotations

import re
from typing import Any

import sympy as sp

from lagrangian.check.reading.said.quantity_words import kinds_of_words
from lagrangian.model import Body, Model, RigidBody
from lagrangian.read.letters import spelled, unaccented

STEMS = {
    "omega": ("turning",),
    "Omega": ("turning",),
    "w": ("turning",),
    "om": ("turning",),
    "v": ("speed", "component", "along", "rate"),
    "T": ("kinetic",),
    "K": ("kinetic",),
    "Ek": ("kinetic",),
    "Ekin": ("kinetic",),
    "V": ("potential",),
    "U": ("potential",),
    "Ep": ("potential",),
    "Epot": ("potential",),
    "J": ("inertia", "axis", "mass"),
    "I": ("inertia", "axis", "mass"),
    "Theta": ("inertia", "axis", "mass"),
    "Q": ("Xi",),
    "Xi": ("Xi",),
}
"""The kinds of quantities that letters are used for; any other letter may be of any kind."""
TRIVIAL = ("turning", "speed", "component", "along", "kinetic", "Xi")
"""Kinds that are said of a name with such a letter even where the value is nothing but a letter: ω = φ̇, Q_φ = M."""
CENTRES = ("S", "G", "cm", "CM", "com", "CoM")
"""The indices that centres of mass have where no point of the system is called so."""
PART_OF = {"rotation": "kinetic", "translation": "kinetic"}
"""Kinds that are part of others, of which a name with the letter of these may be."""
FIXED = ("x", "y", "z")
"""What names of fixed axes begin or end with."""
_GREEK = ("omega", "Omega", "Theta", "Xi", "Delta", "delta", "theta", "phi", "psi", "alpha", "beta", "gamma", "rho")
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"})
_ENTRY = re.compile(r"[^\W\d_]{1,4}_?\{?(?P<at>[1-9]{2})\}?")
_DIGITS = re.compile(r"\d+$")
_WORD = re.compile(r"[^\W\d_]{3,}")


def kinds_of(name: str) -> tuple[str, ...] | None:
    """The kinds that a name may be of by its letter, or by its words; None if it may be of any."""
    if " " in name:
        return kinds_of_words(name)
    return STEMS.get(_split(name)[0])


def is_meant(kind: str, name: str) -> bool:
    """Whether a name may be of a kind that only certain names are of: T_rot of a rotation, v_r of no fixed axis."""
    if " " in name:
        return True
    if kind in ("rotation", "translation"):
        return kind[:3] in name.lower()
    return kind not in ("along", "apart") or not _is_along_fixed_axes(name)


def is_along(axis: int | None, name: str) -> bool:
    """Whether a name may be that of a component along the ``axis`` of a body: w1 or ω_x is along no other than 0."""
    ends = _split(name)[1][-1:]
    return axis is None or not ends or ends not in "123xyz" or ends in ("123"[axis], "xyz"[axis])


def is_entry(place: str, name: str) -> bool:
    """Whether a name may be that of what stands in a ``place`` of a matrix: M_12 or m12 is in no other than "12"."""
    found = _ENTRY.fullmatch(name) if place else None
    return not place or (found is not None and found["at"] == place)


def _is_along_fixed_axes(name: str) -> bool:
    """Whether a name is that of a component along x, y or z: v_x, v_Sy, x_S."""
    stem, index = _split(name)
    return stem in FIXED or (index not in ("xi", "zeta") and (index[:1] in FIXED or index[-1:] in FIXED))


def axis_of(name: str) -> str | None:
    """The fixed axis of which a name is, by its letter or by one at either end of its index; None for others."""
    if " " in name:
        return None
    stem, index = _split(name)
    if stem in FIXED:
        return stem
    if stem not in ("v", "a") or not _is_along_fixed_axes(name):
        return None
    return index[0] if index[0] in FIXED else index[-1]


def axes_of(name: str) -> str | None:
    """What a velocity's component along x, y or z belongs to, its letter and the rest of its index; None for others."""
    stem, index = _split(name)
    if "component" not in STEMS.get(stem, ()) or not _is_along_fixed_axes(name):
        return None
    return f"{stem}_{index[1:] if index[:1] in FIXED else index[:-1]}"


def owner_of(name: str, model: Model) -> Body | None:
    """The only body that the index of a name may mean: that of its point, its mass, its number or its own name; T_R
    of a body with the mass m_R. In words, that of which they hold the name."""
    if " " in name:
        named = [
            b for b in model.bodies if re.search(rf"\b{re.escape(b.name.replace('_', ' '))}\b", name, re.IGNORECASE)
        ]
        named = named or _by_a_word(name, model)
        return named[0] if len(named) == 1 else None
    index = _split(name)[1]
    if not index:
        return None
    for fits in (_is_at, _is_called, _has_index):
        found = [b for b in model.bodies if fits(index, b)]
        if found:
            return found[0] if len(found) == 1 else None
    return None


def _by_a_word(words: str, model: Model) -> list[Body]:
    """The bodies of whose names the words hold one that no other body has: the lower centre of the lower link."""
    said = {x.lower() for x in _WORD.findall(words)}
    own = [{x.lower() for x in _WORD.findall(b.name)} for b in model.bodies]
    alone = [x - set().union(*(y for y in own if y is not x)) for x in own]
    return [b for b, x in zip(model.bodies, alone, strict=True) if x & said]


def is_about_centre(name: str, body: Body, model: Model) -> bool:
    """Whether the index of a moment of inertia means the body's centre of mass, J_S, and no pivot of it."""
    index = _split(name)[1]
    named = {b.at.name for b in model.bodies} | {p.name for p in model.points}
    return bool(index) and (index == body.at.name or (index in CENTRES and index not in named))


def is_about_point(name: str, body: Body, model: Model) -> bool:
    """Whether the index of a moment of inertia means a point of the system other than the body's centre of mass."""
    index = _split(name)[1]
    return bool(index) and index != body.at.name and index in {p.name for p in model.points}


def _split(name: str) -> tuple[str, str]:
    """The letter of a name and its index: v_S, vS, ω₁, T_cyl."""
    plain = spelled(name).replace("vec_", "")
    plain = plain.removesuffix("_vec")
    stem, _, index = plain.partition("_")
    if index or stem in STEMS:
        return stem, index.replace("_", "")
    greek = next((x for x in _GREEK if stem.startswith(x)), stem[:1])
    return greek, stem[len(greek) :]


def _is_at(index: str, body: Any) -> bool:
    mass = spelled(str(body.mass)).replace("_", "") if isinstance(body.mass, sp.Symbol) else ""
    number = _DIGITS.search(mass) or _DIGITS.search(body.name)
    return index in (body.at.name, mass) or (number is not None and index == number[0])


def _is_called(index: str, body: Any) -> bool:
    called = index.lower()
    words = body.name.lower().replace("_", " ").split()
    spelt = (form for w in words for form in (w, unaccented(w), unaccented(w.translate(_UMLAUTS))))
    return len(index) > 1 and any(w.startswith(called) for w in spelt)


def _has_index(index: str, body: Any) -> bool:
    """Whether a mass or a moment of inertia in those of a body has this index: m_w or J_w of four wheels, 4 m_w."""
    letters = sp.sympify(body.mass).free_symbols
    letters |= body.inertia.free_symbols if isinstance(body, RigidBody) else set()
    return any(_split(str(x))[1] == index for x in letters)
