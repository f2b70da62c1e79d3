"""Leaves out of second choices what only repeats a mistake that is told, in other words, and what cannot be.

"The weight of the bob has the wrong sign" says nothing new beside "The weight of the bob has the wrong sign in V", and
"In V, R stands in place of r" nothing beside "R stands in place of r in the energy of the spring". No sign is wrong
where only terms are missing, and no mistake was made in T* if the line that states it is right.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.verdict import Mistake, Status, Verdict
from lagrangian.page.formula import text

FAMILIES = (
    ("sign", ("sign", "xi_sign", "plus_potential")),
    ("left out", ("forgotten", "left_out", "missing", "lost", "no_arm", "not_squared", "without", "_arm")),
    ("number", ("half", "twice", "number", "factor_of", "energy_for")),
    ("letter", ("swapped", "letter", "exchanged", "wrong_angle", "angle")),
    ("function", ("sine", "function", "turned", "direction")),
    ("rate", ("relative_rate", "omega")),
)
"""What was done, by parts of the names of mistakes."""
ANOTHER_FACTOR = "arm"
"""A factor that a force or a damper has in one equation in place of another: it says no more than how that came."""
OF_WHAT_IS_THERE = ("small_angle", "angle", "exchanged", "damper_other_velocity", "deflection")
"""Further mistakes in what is written, besides signs and functions."""
STATED = {2: ("T", "L"), 3: ("V", "L")}
"""The lines that state what is made in a step."""
SAME = frozenset(
    {
        ("share_moved", "force_wrong_equation"),
        ("velocity_part_left_out", "one_component"),
        ("piece_left_out", "one_component"),
    }
)
"""Names of mistakes in one element of which the first says no more than the second."""
MADE_IN = re.compile(r"\bIn the (?P<what>height|position|velocity) of (?P<of>[^,:]{1,80}'[^']{1,60}')")
"""Where a mistake was made, in words: the height of particle 'bob'."""
SECOND = " Or: "
"""What stands before a second reason."""


def distinct(others: Sequence[Mistake], told: Sequence[Mistake]) -> tuple[Mistake, ...]:
    """The second choices that name another cause than what is told, and than each other."""
    kept: list[Mistake] = []
    for m in others:
        if not any(_repeats(m, x) for x in (*told, *kept)):
            kept.append(m)
    return tuple(kept)


def fitting(verdict: Verdict) -> Verdict:
    """The verdict with the second choices that may be true, and that repeat no mistake which is told."""
    open_ones = verdict.open_findings
    kinds = {d.kind for f in open_ones for d in f.differences}
    missing = kinds == {"missing"} or (not kinds and all(_family(m) == "left out" for m in verdict.mistakes))
    wrong = {f.line.kind for f in verdict.findings if f.status is Status.WRONG}
    right = {f.line.kind for f in verdict.findings if f.status.right} - wrong
    signs = any(_family(m) == "sign" for m in verdict.mistakes)
    notes = right_notes(verdict)
    others = [
        m
        for m in verdict.alternatives
        if not (missing and is_of_what_is_there(m))
        and not (signs and is_of_what_is_there(m) and _family(m) != "sign")
        and not (right.intersection(STATED.get(m.step, ())) and _is_of_energy(m))
        and not is_stated(str(m.what), notes)
    ]
    told = (_without_right(m, verdict) for m in verdict.mistakes)
    return replace(verdict, mistakes=tuple(told), alternatives=distinct(others, verdict.mistakes))


def _without_right(mistake: Mistake, verdict: Verdict) -> Mistake:
    """A mistake without a second reason in what a right line states: Or: In the velocity of …"""
    notes = right_notes(verdict)
    parts = mistake.what.parts
    place = parts.index(SECOND) if SECOND in parts else len(parts) - 1
    reason = str(parts[place + 1]) if place + 1 < len(parts) else ""
    contradicts = any(reason.startswith(f"In {note}") for note in notes)
    return replace(mistake, what=text(*parts[:place])) if contradicts else mistake


def right_notes(verdict: Verdict) -> list[str]:
    """What the right definitions of an answer are: the speed of the bob."""
    return [str(f.note) for f in verdict.findings if f.line.kind == "definition" and f.status.right and f.note]


def is_stated(said: str, notes: Sequence[str]) -> bool:
    """Whether the position or the velocity in which a mistake is said to be is stated by right lines."""
    if (found := MADE_IN.search(said)) is None:
        return False
    of = [note.removesuffix(f" of {found['of']}") for note in notes if note.endswith(f" of {found['of']}")]
    if found["what"] == "velocity":
        return any(x in ("the speed", "the square of the speed") for x in of) or len(_axes(of, "component")) > 1
    return "the height" in of or len(_axes(of, "coordinate")) > 1


def _axes(notes: Sequence[str], what: str) -> set[str]:
    """The axes along which lines state a coordinate, or a component of a velocity."""
    return {x for x in notes if x.split(" ")[2:3] == [what]}


def _is_of_energy(mistake: Mistake) -> bool:
    """Whether a mistake of step 2 is made in T*, where one in a position shows in V alone."""
    return mistake.step != 2 or any(word in str(mistake.what) for word in ("T*", "kinetic", "velocity", "speed"))


def is_of_what_is_there(mistake: Mistake) -> bool:
    """Whether something that is written is said to be wrong, and not that something is missing."""
    return _family(mistake) in ("sign", "function", "letter") or mistake.name in OF_WHAT_IS_THERE


def _repeats(mistake: Mistake, other: Mistake) -> bool:
    """Whether both say that the same was done, to the same letters or to the same element.

    x + y in place of y - x, and x + y where it is y - x, is the same, whatever it is called.
    """
    if str(other.what).startswith(str(mistake.what)):  # without the reason
        return True
    one, two = _written(mistake), _written(other)
    quoted, others = _quoted(mistake), _quoted(other)
    replaced = len(one) > 1 and len(two) > 1 and mistake.element in (other.element, None)
    if replaced and (one == two or (len(quoted) > 1 and quoted == others)):
        return True
    if mistake.name == ANOTHER_FACTOR and mistake.element == other.element:
        return True
    made = MADE_IN.match(str(mistake.what)) if other.name == "gravity_forgotten" else None
    if made is not None and made["what"] == "height":
        return f"he weight of {made['of']} " in str(other.what)  # no height was written
    if (mistake.name, other.name) in SAME and mistake.element == other.element:
        return True
    if _family(mistake) != _family(other):
        return False
    same = _of_same(mistake, other)
    if quoted and others:
        quoted, others = (x - _functions(x) for x in (quoted, others))
        letters, told = _letters(quoted), _letters(others)
        letters, told = (letters, told) if letters and told else (quoted, others)
        if same and _without_rates(quoted) == _without_rates(others):
            return True
        return quoted == others or (same and (letters <= told or told <= letters))
    return same


def _of_same(mistake: Mistake, other: Mistake) -> bool:
    """Whether both are about the same element, or one of them about none."""
    one, two = mistake.element, other.element
    if one is None or two is None or one == two or one in two.split(" or "):
        return True
    return _family(mistake) == "function" and one in str(other.what)


def _written(mistake: Mistake) -> set[sp.Expr]:
    """The formulas in the words, of two signs the same one."""
    exprs = (x for x in mistake.what.parts if isinstance(x, sp.Expr))
    return {-x if x.could_extract_minus_sign() else x for x in exprs}


def _family(mistake: Mistake) -> str:
    """What was done, in a word; the name itself if it is of no family."""
    return next((f for f, parts in FAMILIES if any(p in mistake.name for p in parts)), mistake.name)


def _quoted(mistake: Mistake) -> set[sp.Basic]:
    """The letters, coordinates and rates that the words quote."""
    exprs = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
    return {atom for x in exprs for atom in (x.free_symbols | x.atoms(sp.Function, sp.Derivative)) - {sp.Symbol("t")}}


def _functions(quoted: set[sp.Basic]) -> set[sp.Basic]:
    """The sines and cosines among them."""
    return {x for x in quoted if isinstance(x, sp.Function) and not isinstance(x, AppliedUndef)}


def _letters(quoted: set[sp.Basic]) -> set[sp.Basic]:
    """Those that stand for constants."""
    return {x for x in quoted if isinstance(x, sp.Symbol)}


def _without_rates(quoted: set[sp.Basic]) -> set[sp.Basic]:
    """What is quoted, with coordinates in place of their rates: J φ̈ of an equation is ½ J φ̇² of T*."""
    return {x.expr if isinstance(x, sp.Derivative) else x for x in quoted}
