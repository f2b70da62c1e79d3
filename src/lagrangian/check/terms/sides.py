"""On which side of an equation a term is told to stand, so that its sign is the one that belongs in what was written.

x'' = (F - k x)/m     on the right-hand side, the term −d ẋ/m is missing
m x'' = F - k x       on the right-hand side, the term −d ẋ is missing
m x'' + k x = F       the term d ẋ is missing
m x'' - F = -k x      with everything on the left-hand side, the term d ẋ is missing
"""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.verdict import AnsweredLine, TermDifference
from lagrangian.model import time
from lagrangian.page.formula import Left
from lagrangian.read.letters import key

LEFT, RIGHT = "with everything on the left-hand side", "on the right-hand side"
_EQUALS = re.compile(r"(?<![<>=!:])={1,2}(?![=>])")
_SIGN = re.compile(r"(?<![\d.][eE])(?<![\^_{(*/])[-+−±]")
_RATE = re.compile(r"['’′″\u0307\u0308]|dot|\bd\w{0,9}\s?/\s?dt|[dD]iff|Derivative|[ẋẍẏÿżṙṁ]")
_ACCELERATION = re.compile(r"\w(?:dd|ddot)\b")
"""An acceleration as programs call it."""
_NAME = re.compile(r"[^\W\d]\w*")
_DIFFERENTIAL = re.compile(r"\bd(\w{1,12})\s?/\s?dt\b")
_NO_NAMES = frozenset(["t", "diff", "Derivative", "dt"])
LONGEST = 2_000
"""A longer line is not looked at."""


def on_side(line: AnsweredLine, difference: TermDifference) -> tuple[str, TermDifference]:
    """Where a term of an equation is told to stand ("" where that is clear), and the difference with its signs there.

    The difference is given with everything on the left.
    """
    sides = _EQUALS.split(line.text) if len(line.text) <= LONGEST else []
    if line.kind != "equation" or len(sides) != 2:
        return "", difference
    flipped = RIGHT, replace(difference, term=-difference.term, written=-difference.written)
    names = _names_in(difference.written if difference.written != 0 else difference.term)
    moved = any(d.derivative_count > 1 for d in difference.term.atoms(sp.Derivative))
    if moved and _ACCELERATION.search(sides[0]) and not _ACCELERATION.search(sides[1]):
        return "", difference  # on the side of the accelerations, M qdd = f - K q
    here, there = (sum(_names(x) == names for x in _terms(side)) for side in sides)
    if there and not here:
        return flipped
    right = sides[1].strip()
    signed = len(_terms(sides[0])) == 1 and right.startswith(("-", "−"))
    if (here and not there) or not (signed or _SIGN.search(right.lstrip("-+−"))):
        return "", difference
    if len(_terms(sides[0])) > 1:
        return LEFT, difference
    accelerates = _RATE.search(sides[0]) is not None
    return ("", difference) if accelerates and _accelerates(difference.term, difference.coordinate) else flipped


def differs(d: TermDifference) -> tuple[str | Left, ...]:
    """How a term differs, in words."""
    match d.kind:
        case "missing":
            return ("the term ", d.term, " is missing")
        case "extra":
            return ("the term ", d.term, " does not belong there")
        case "sign":
            return (d.written, " has the wrong sign")
        case _:
            return (d.written, " should be ", d.term)


def _terms(side: str) -> list[str]:
    """The terms of one side, split at the signs outside brackets."""
    depth, cuts = 0, [0]
    first = len(side) - len(side.lstrip("-+−&> \t"))
    for at in range(first, len(side)):
        depth += (side[at] in "([{") - (side[at] in ")]}")
        if depth <= 0 and _SIGN.match(side, at):
            cuts.append(at)
    return [side[a:b] for a, b in pairwise([*cuts, len(side)])]


def _names(written: str) -> frozenset[str]:
    """The names in a term of plain text, without rates and what is no name of a system."""
    return frozenset(key(x) for x in _NAME.findall(_DIFFERENTIAL.sub(r"\1", written)) if x not in _NO_NAMES)


def _names_in(term: sp.Expr) -> frozenset[str]:
    """The names in a term."""
    moving = {x.func.__name__ for x in term.atoms(AppliedUndef)}
    return frozenset(map(key, moving | {str(x) for x in term.free_symbols if x != time})) | {
        str(f.func) for f in term.atoms(sp.sin, sp.cos)
    }


def _accelerates(term: sp.Expr, coordinate: str | None) -> bool:
    """Whether a term holds the acceleration of a coordinate."""
    found = (d for d in term.atoms(sp.Derivative) if d.derivative_count > 1)
    return any(getattr(d.expr.func, "__name__", None) == coordinate for d in found)
