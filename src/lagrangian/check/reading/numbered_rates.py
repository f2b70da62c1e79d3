"""Reads which names are the velocities and accelerations of masses with the same numbers, told by enumeration.

v2 and v3 are the velocities of masses 2 and 3, and a1, ..., a5 the accelerations of the masses.

It is sure only if mass k is at coordinate k, so that no other velocity can be meant.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import sympy as sp

from lagrangian.model import Model
from lagrangian.read.letters import key

_NAME = r"[^\W\d_]{1,3}_?\d{1,2}(?!\w)"
_DOTS = r"(?:\.\.\.|…)"
_GAP = r"[ \t]{0,3}"
_JOINED = rf"(?:{_GAP},{_GAP}(?:{_DOTS}{_GAP},?{_GAP})?(?:and[ ]+)?|{_GAP}{_DOTS}{_GAP}|[ ]and[ ])"
_BODIES = r"(?:mass(?:es)?|carts?|bod(?:y|ies)|blocks?|particles?)"
_SAID = re.compile(
    rf"(?<![\w.*/^+=−-])(?P<names>{_NAME}(?:{_JOINED}{_NAME}){{0,30}})[ ](?:(?:is|are|be|being|denotes?)[ ])?the[ ]"
    rf"(?P<rate>velocit(?:y|ies)|speeds?|accelerations?)[ ]of[ ](?:the[ ])?{_BODIES}"
    rf"(?:[ ](?P<numbers>\d{{1,2}}(?:{_JOINED}\d{{1,2}}){{0,30}}))?(?={_GAP}(?:[,.;:)\n]|and[ ]|\Z))"
)
_PART = re.compile(rf"(?P<stem>[^\W\d]{{0,4}})(?P<number>\d{{1,2}})|(?P<dots>{_DOTS})")


def numbered_rates(text: str, unknown: Sequence[str], model: Model) -> dict[str, str]:
    """Return the rates, v2 = x2', of the ``unknown`` names that sentences of plain text call those of masses."""
    places = _places(model)
    names = {key(x): x for x in unknown}
    found: dict[str, str] = {}
    for match in _SAID.finditer(text) if places else ():
        listed, masses = _listed(match["names"]), _listed(match["numbers"] or "")
        numbers = [number for _, number in listed]
        if len({stem for stem, _ in listed}) != 1 or (masses and [n for _, n in masses] != numbers):
            continue
        if all(n in places for n in numbers):
            primes = "''" if match["rate"].startswith("acc") else "'"
            said = {f"{stem}{n}": f"{places[n]}{primes}" for stem, n in listed}
            if any(found.get(names[key(x)], v) != v for x, v in said.items() if key(x) in names):
                return {}  # two things are said of one name
            found |= {names[key(x)]: v for x, v in said.items() if key(x) in names}
    return found


def _listed(text: str) -> list[tuple[str, int]]:
    """The stems and numbers in an enumeration, with those that dots stand for; empty if that is not clear."""
    found: list[tuple[str, int]] = []
    dots = False
    for match in _PART.finditer(re.sub(r"\band\b", ",", text)):
        if match["dots"]:
            dots = True
            continue
        stem, number = match["stem"], int(match["number"])
        if dots:
            if not found or found[-1][0] != stem or found[-1][1] >= number:
                return []
            found += [(stem, k) for k in range(found[-1][1] + 1, number)]
        found.append((stem, number))
        dots = False
    return found


def _places(model: Model) -> dict[int, str]:
    """The coordinate of each number, if each is the place of the one mass with its number; otherwise nothing."""
    found: dict[int, str] = {}
    for c in model.coordinates:
        number = _number(c.name)
        there = [b for b in model.bodies if any(x.has(c.symbol) for x in model.position(b.at))]
        moved = [x for b in there for x in model.velocity(b.at) if x != 0]
        if number is None or number in found or moved != [c.rate]:
            return {}
        mass: sp.Expr = there[0].mass
        if not isinstance(mass, sp.Symbol) or _number(mass.name) != number:
            return {}
        found[number] = c.name
    return found if len(model.bodies) == len(found) else {}


def _number(name: str) -> int | None:
    """The number at the end of a name."""
    match = re.search(r"\d{1,3}\Z", name)
    return None if match is None else int(match[0])
