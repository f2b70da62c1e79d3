"""Energies and forces in parts: T (cart) = … and T (pole) = …, W_m = ½ L i² beside T*, W_e = q²/(2 C) beside V."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence, Set
from dataclasses import replace
from itertools import combinations, permutations
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading import generalized_force
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine
from lagrangian.errors import listed as listed_in_words
from lagrangian.model import Gravity, Inductor, RigidBody, Spring, time
from lagrangian.model.elements.branch import CircuitBranch
from lagrangian.page.formula import Name, Text, text

MOST_PARTS, MOST_ADDED = 8, 3
"""The most definitions that are tried, and the most that are added up."""
FEWEST_WORDS = 2
"""The words that make a sentence."""
_WORD = re.compile(r"[^\W\d_]{2,}")
_WHOLE = re.compile(
    r"systems?|total|whole|sum|all|everything|entire|overall|altogether|together|gesamt\w*|ganze[nrs]?|insgesamt|summe"
    r"|zusammen|alle[srnm]?|tout|totale?|système|ensemble"
)
MOST_PERMUTED = 4
"""The largest number of coordinates for which all orders of equations are tried."""


def with_energies_apart(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The lines, with several T* or V of different parts added up, with the energy of all coils added to a T* without
    any, and that of all capacitors to a V without any, where a name of the answer has exactly this value, or a sum of
    names; and notes that say so."""
    elements = [e for e in truth.model.elements if isinstance(e, CircuitBranch)]
    found, notes = _added_up(truth, lines)
    for kind, words, energies in (
        ("T", "magnetic co-energy", [e.kinetic(truth.model) for e in elements]),
        ("V", "electric energy", [e.potential(truth.model) for e in elements]),
    ):
        stored = truth.expand(sp.Add(*energies))
        moving = [c.rate if kind == "T" else c.symbol for c in truth.model.coordinates]
        moving = [x for x in moving if stored.has(x)]
        lacking = [line for line in found if line.kind == kind and not line.expr.has(*moving)] if moving else []
        if lacking and (names := _names(truth, found, stored, moving)):
            found = tuple(replace(x, expr=x.expr + stored) if x in lacking else x for x in found)
            notes.append(
                text(f"The {words}, which is stated apart as {' + '.join(names)}, was added to {_CALLED[kind]}.")
            )
    return found, tuple(notes)


def without_first_parts(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The lines, without a Ξ that another one below goes on with, Q = F, then Q = F − b v; an energy where it says so.

    It was what one element adds, and is not the whole, unless it is right; so is an energy that a wrong one below goes
    on with. With notes that say so.
    """
    lines = list(_with_forces_above(lines))
    often = Counter((line.kind, line.name) for line in lines if line.kind in ("Xi", "T", "V", "L"))
    stated = [(line, _terms(truth, line.expr)) for line in lines if often[line.kind, line.name] > 1]
    right: dict[tuple[str, str | None], sp.Expr] = {
        ("Xi", c.name): x for c, x in zip(truth.model.coordinates, truth.Xi, strict=True)
    }
    right |= {("T", None): truth.T, ("V", None): truth.V, ("L", None): truth.L}

    def is_right(line: AnsweredLine) -> bool:
        return zero_everywhere(truth, truth.expand(line.expr) - right.get((line.kind, line.name), line.expr))

    whole: dict[int, AnsweredLine] = {}
    for k, (line, own) in enumerate(stated):
        of = line.kind, line.name
        after = [other for other, more in stated[k + 1 :] if (other.kind, other.name) == of and own < more]
        after = [x for x in after if x.kind == "Xi" or _names_itself(x) or not is_right(x)]
        if after and not is_right(line):
            whole[id(line)] = after[-1]
    notes = [f"'{x.text}' was not judged: {y.title} goes on with it." for x in lines if (y := whole.get(id(x)))]
    of_one = _of_one_element(truth, lines)
    notes += (f"'{x.text}' was read as the energy of '{name}' alone." for x in lines if (name := of_one.get(id(x))))
    return tuple(x for x in lines if id(x) not in {*whole, *of_one}), tuple(map(text, dict.fromkeys(notes)))


def _of_one_element(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[int, str]:
    """The names of the elements whose energies are what lines call T or V in sentences of words that speak of these
    alone, beside right equations: the wheels roll, so T = ½ (I/r²) ẋ²."""
    said = [x for x in lines if x.kind in ("T", "V") and len(_WORD.findall(x.words)) >= FEWEST_WORDS]
    if not said or truth.derivation.multipliers:
        return {}
    moving = [c.acceleration for c in truth.model.coordinates]
    rows = [truth.expand(x.expr) for x in lines if x.kind == "equation" and x.expr.has(*moving)]
    if not rows:
        return {}

    def is_row(expr: sp.Expr, row: sp.Expr) -> bool:
        return any(zero_everywhere(truth, expr - sign * row) for sign in (1, -1))

    found: dict[int, str] = {}
    own_words = {e.name: {x.lower() for x in _WORD.findall(e.name)} for e in truth.model.elements}
    for line in said:
        words = {x.lower() for x in _WORD.findall(line.words)}
        if any(map(_WHOLE.fullmatch, words)):
            continue
        for e in truth.model.elements:
            named = bool(words & own_words[e.name])
            others = set[str]().union(*(x for name, x in own_words.items() if name != e.name)) - own_words[e.name]
            if not named or words & others:
                continue
            own = truth.expand(e.kinetic(truth.model) if line.kind == "T" else e.potential(truth.model))
            if own == 0:
                continue
            if zero_everywhere(truth, own - truth.energies[line.kind]):
                continue  # the only one
            if zero_everywhere(truth, truth.expand(line.expr) - own):
                found[id(line)] = e.name
    if not found:
        return {}
    right = [[is_row(x, row) for row in truth.rows] for x in rows]
    return found if all(map(any, right)) and all(map(any, zip(*right, strict=True))) else {}


def _names_itself(line: AnsweredLine) -> bool:
    """Whether a line says what its name is by that name: V = V + m g y."""
    name, _, value = line.text.partition("=")
    name = name.strip(" \t$&")
    return bool(name) and re.search(rf"(?<![\w\\]){re.escape(name)}(?!\w)", value) is not None


def _with_forces_above(lines: Sequence[AnsweredLine]) -> Iterator[AnsweredLine]:
    """The lines, in which Q = Q − b v has the Q that stands above."""
    above: dict[str, sp.Expr] = {}
    for line in lines:
        if line.kind == "Xi" and (name := line.name) is not None:
            if name in above:
                own = cast("sp.Expr", line.expr.xreplace({generalized_force(name): above[name]}))
                line = replace(line, expr=own)
            above[name] = line.expr
        yield line


def with_forces_apart(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The lines, with left-hand sides d/dt ∂L/∂ξ̇ − ∂L/∂ξ that are written without "=", beside every Ξ, as equations.

    They are such if there is one for every coordinate, and no letter in them that only Ξ has. With a note that says so.
    """
    model, n = truth.model, truth.n
    bare = [x for x in lines if x.kind == "equation" and x.text and not re.search("[=≈≡]", x.text)]
    if len(bare) != n:
        return tuple(lines), ()
    acting = {c.name for c, own in zip(model.coordinates, truth.Xi, strict=True) if own != 0}
    forces = sp.Tuple(*truth.Xi).atoms(sp.Symbol, AppliedUndef) - sp.Tuple(truth.T, truth.V).atoms(
        sp.Symbol, AppliedUndef
    )
    stated = {x.name for x in lines if x.kind == "Xi"}
    if n > MOST_PERMUTED or truth.derivation.multipliers or not forces or not acting <= stated:
        return tuple(lines), ()
    if any(x.expr.has(*forces) for x in bare) or not all(
        x.expr.has(*(c.acceleration for c in model.coordinates)) for x in bare
    ):
        return tuple(lines), ()
    left = [cast("sp.Expr", row + own) for row, own in zip(truth.rows, truth.Xi, strict=True)]
    same = [[zero_everywhere(truth, truth.expand(x.expr) - own) for own in left] for x in bare]
    order = max(permutations(range(n)), key=lambda p: sum(same[j][i] for j, i in enumerate(p)))
    names = {id(x): model.coordinates[i].name for x, i in zip(bare, order, strict=True)}
    read = (replace(x, expr=x.expr - generalized_force(names[id(x)])) if id(x) in names else x for x in lines)
    told = f"{listed_in_words([x.title for x in bare])} were read as left-hand sides: what they are equal to is "
    return tuple(read), (text(told[:1].upper() + told[1:], Name("Xi"), "."),)


def _terms(truth: Reference, expr: sp.Expr) -> frozenset[sp.Basic]:
    """The terms of a sum that is written out."""
    return frozenset(sp.Add.make_args(bounded.expand(truth.expand(expr)))) - {sp.S.Zero}


def _added_up(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[tuple[AnsweredLine, ...], list[Text]]:
    """The lines, with all lines of T*, or of V, as one if no two have a mass, a moment of inertia or a stiffness in
    common: each is the energy of a part of the system. It stands in place of the one that is wrong, or of the first.
    With notes that say so."""
    found, notes = list(lines), list[Text]()
    for kind, letters in (("T", _inertias(truth)), ("V", _stiffnesses(truth))):
        own = [line for line in found if line.kind == kind]
        held = [truth.expand(line.expr).free_symbols & letters for line in own]
        if len(own) < 2 or not all(held) or sum(map(len, held)) > len(set[sp.Basic]().union(*held)):
            continue
        at = _only_wrong(truth, own, held)
        whole = replace(own[at], expr=sp.Add(*[line.expr for line in own]))
        rest = cast("sp.Expr", own[-1].expr - whole.expr)  # a derivative was compared with that of the last part
        found = [_of_the_whole(truth, x, kind, rest) if x.number > own[-1].number else x for x in found]
        found = [whole if x is own[at] else x for x in found if x is own[at] or not any(x is y for y in own)]
        numbers = list(dict.fromkeys(str(line.number) for line in own))
        where = f"lines {listed_in_words(numbers)}" if len(numbers) > 1 else f"line {numbers[0]}"
        notes.append(text(f"{_CALLED[kind]} is stated in parts; those in {where} were added up."))
    return tuple(found), notes


def _only_wrong(truth: Reference, parts: Sequence[AnsweredLine], letters: Sequence[Set[sp.Basic]]) -> int:
    """Which part of an energy is wrong, by the terms of the right one that have its ``letters``; the first if it is not
    one alone."""
    terms = _terms(truth, truth.energies[parts[0].kind])
    right = [sp.Add(*[cast("sp.Expr", x) for x in terms if x.free_symbols & own]) for own in letters]
    own = [bounded.expand(truth.expand(line.expr) - x) for line, x in zip(parts, right, strict=True)]
    moving = {x for c in truth.model.coordinates for x in (c.symbol, c.rate)}
    wrong = [k for k, x in enumerate(own) if x.has(*moving) and not zero_everywhere(truth, x)]
    return wrong[0] if len(wrong) == 1 else 0


def _of_the_whole(truth: Reference, line: AnsweredLine, kind: str, rest: sp.Expr) -> AnsweredLine:
    """A line that gives a derivative of an energy, less that of the last part, with that of the whole instead."""
    c = next((x for x in truth.model.coordinates if x.name == line.name), None)
    if c is None or line.kind not in (f"{kind}-slope", f"{kind}-p", f"{kind}-rate"):
        return line
    slope = bounded.diff(rest, c.symbol if line.kind == f"{kind}-slope" else c.rate)
    slope = bounded.diff(slope, time) if line.kind == "T-rate" else slope
    return replace(line, expr=line.expr - slope if line.kind in ("T-p", "T-slope") else line.expr + slope)


def _inertias(truth: Reference) -> set[sp.Basic]:
    """The masses, moments of inertia and inductances that are single letters."""
    bodies = truth.model.bodies
    listed = [b.mass for b in bodies] + [x for b in bodies if isinstance(b, RigidBody) for x in b.inertia.flat()]
    listed += [e.L for e in truth.model.elements if isinstance(e, Inductor)]
    return {x for x in listed if isinstance(x, sp.Symbol)}


def _stiffnesses(truth: Reference) -> set[sp.Basic]:
    """The stiffnesses, and the masses that have weights, that are single letters."""
    listed = [e.k for e in truth.model.elements if isinstance(e, Spring)]
    if any(isinstance(e, Gravity) for e in truth.model.elements):
        listed += [b.mass for b in truth.model.bodies]
    return {x for x in listed if isinstance(x, sp.Symbol)}


_CALLED = {"T": "T*", "V": "V"}


def _names(
    truth: Reference, lines: Sequence[AnsweredLine], stored: sp.Expr, moving: Sequence[sp.Expr]
) -> tuple[str, ...]:
    """The names of the answer whose values add up to an energy; none if there are none."""
    told = {line.name: truth.expand(line.expr) for line in lines if line.kind == "definition" and line.name}
    parts = [(name, value) for name, value in told.items() if value.has(*moving)][:MOST_PARTS]
    for count in range(1, min(MOST_ADDED, len(parts)) + 1):
        for chosen in combinations(parts, count):
            if zero_everywhere(truth, sp.Add(*[value for _, value in chosen]) - stored):
                return tuple(name for name, _ in chosen)
    return ()
