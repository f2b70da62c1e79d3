"""Lines of virtual work, δW = F δx − b ẋ δx: the generalized forces that they state are judged."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.all_forces import holds_potential, whole_force
from lagrangian.check.lines import filled
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reading.placeholders import displacements, variation
from lagrangian.check.reference import Reference
from lagrangian.check.rows import Kind, compare, zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import time
from lagrangian.model.names import moving_symbol
from lagrangian.page.formula import text
from lagrangian.read.letters import key

MOST, MOST_TERMS = 4, 24
"""The most lines of virtual work of an answer, and the most terms of a force, that are judged."""

ALIKE = 0.5
"""The share of factors that a wrong term has in common with the right one in whose place it stands."""

FACTORS = text(
    "The virtual displacements are independent: what multiplies each of them was judged as an equation of motion."
)

_OF_WORK = re.compile(r"[WA](?:_?\w{0,8})")


def judged_with_work(
    truth: Reference, lines: Sequence[AnsweredLine], judge: Callable[[Sequence[AnsweredLine]], Verdict]
) -> Verdict:
    """The verdict on an answer in which a virtual work states generalized forces.

    A line may be about some of the forces, and the forces with a potential may be among them. Wrong equations of motion
    are judged in d'Alembert's principle, (F − m ẍ) δx + … = 0, and right ones where no others are stated.
    """
    alone = not any(line.kind == "equation" and accelerates(line.expr) for line in lines)
    every = [(x, _equations_of(truth, _in_coordinates(truth, lines, x), right=alone)) for x in lines]
    lines = [x for line, found in every for x in found or [line]]
    if alone and any(len(found) > 1 for _, found in every):
        verdict = judge(lines)
        return replace(verdict, notes=(*verdict.notes, FACTORS))
    works = [k for k, line in enumerate(lines) if _is_work(truth, line)]
    written = filled(truth, lines) if 0 < len(works) <= MOST else []
    if len(written) != len(lines):
        return judge(lines)
    right = {k: found for k in works if (found := _right_forces(truth, written[k]))}
    verdict = judge([x for k, line in enumerate(lines) for x in right.get(k, [line])])
    if verdict.status is Status.OTHER_COORDINATES or len(right) == len(works):
        return verdict
    apart = any(line.kind in ("V", "L") for line in lines)
    if apart and not any(x.kind in ("equation", "Xi") for x in lines) and (whole := _all_forces(truth, written, works)):
        return judge([*(x for k, x in enumerate(lines) if k not in works), *whole])
    wrong = {k: found for k in works if (found := list(_wrong_forces(truth, written[k], apart=apart)))}
    wrong = wrong or {k: found for k in works if (found := _copied_forces(truth, written, written[k]))}
    return judge([x for k, line in enumerate(lines) for x in (right | wrong).get(k, [line])]) if wrong else verdict


def _in_coordinates(truth: Reference, lines: Sequence[AnsweredLine], line: AnsweredLine) -> AnsweredLine:
    """A line of d'Alembert's principle with the virtual displacements of quantities that the answer defines, δe of the
    elongation e, in those of the coordinates, and with these quantities written out; any other line as it is."""
    claims = line.kind == "statement" and "=" in line.text and accelerates(line.expr)
    places = {key(c.name) for c in truth.model.coordinates}
    own = {x: name for x, name in displacements(line.expr).items() if key(name) not in places} if claims else {}
    if not 0 < len(own) <= MOST or any(_OF_WORK.fullmatch(name) for name in own.values()):
        return line
    defined = {x.name: x.expr for x in lines if x.kind == "definition"}
    asked = [replace(line, expr=defined.get(name, moving_symbol(name))) for name in own.values()]
    written = filled(truth, [*lines, line, *asked])[len(lines) :]
    if len(written) != 1 + len(asked) or any(not _is_place(truth, x.expr) for x in written[1:]):
        return line
    moved = {
        x: sp.Add(*[bounded.diff(v.expr, c.symbol) * variation(c.name) for c in truth.model.coordinates])
        for x, v in zip(own, written[1:], strict=True)
    }
    return replace(line, expr=cast("sp.Expr", written[0].expr.xreplace(moved)))


def _is_place(truth: Reference, expr: sp.Expr) -> bool:
    """Whether an expression depends on coordinates and parameters alone."""
    known = {time, *(c.symbol for c in truth.model.coordinates), *(p.symbol for p in truth.model.parameters)}
    return not expr.has(sp.Derivative) and bounded.letters(expr) <= known


def _equations_of(truth: Reference, line: AnsweredLine, *, right: bool) -> list[AnsweredLine]:
    """The wrong ones of the equations of motion that d'Alembert's principle holds: what multiplies each δξ is 0; with
    ``right``, also the right ones."""
    claims = line.kind == "statement" and "=" in line.text and accelerates(line.expr)
    moved = displacements(line.expr) if claims else {}
    places = {key(c.name) for c in truth.model.coordinates}
    if not moved or truth.derivation.multipliers or any(key(name) not in places for name in moved.values()):
        return []
    factors = _linear(line.expr, moved)
    if factors is None or any(not bounded.letters(f) <= truth.names for f in factors.values()):
        return []
    rows = compare(truth, list(factors.values())).rows
    each = zip(factors.values(), rows, strict=True)
    wrong = [f for f, row in each if (right or not row.true) and row.kind is not Kind.NOTHING]
    return [replace(line, kind="equation", name=None, expr=f) for f in wrong]


def _is_work(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line states δW."""
    return line.kind == "statement" and bool(_works_in(truth, line.expr))


def _linear(expr: sp.Expr, moved: Iterable[AppliedUndef]) -> dict[AppliedUndef, sp.Expr] | None:
    """The factors of virtual displacements in a sum of these; None if it is no such sum."""
    value = bounded.expand(expr)
    factors = {x: cast("sp.Expr", value.coeff(x)) for x in moved}
    return factors if bounded.expand(value - sp.Add(*[x * f for x, f in factors.items()])) == 0 else None


def _works_in(truth: Reference, expr: sp.Expr) -> list[AppliedUndef]:
    """The virtual works among these: δW, and no δA of a coordinate A."""
    coordinates = {key(c.name) for c in truth.model.coordinates}
    found = displacements(expr).items()
    return [x for x, name in found if _OF_WORK.fullmatch(name) and key(name) not in coordinates]


def _stated_forces(truth: Reference, line: AnsweredLine) -> dict[int, sp.Expr]:
    """The factor of the virtual displacement of each coordinate in a virtual work; none if it is in others."""
    moved = displacements(line.expr)
    works = _works_in(truth, line.expr)
    places = {key(c.name): i for i, c in enumerate(truth.model.coordinates)}
    if len(works) != 1 or any(key(name) not in places for x, name in moved.items() if x not in works):
        return {}
    factors = _linear(line.expr, moved)
    if factors is None or (sign := factors[works[0]]) not in (1, -1):
        return {}
    found = {places[key(name)]: -sign * factors[x] for x, name in moved.items() if x not in works}
    return dict(sorted(found.items()))


def _right_forces(truth: Reference, line: AnsweredLine) -> list[AnsweredLine]:
    """The generalized forces that a virtual work states, if it is that of all forces and every one of them is right.

    None beside multipliers: a coordinate that a constraint gives may be put in below.
    """
    if truth.derivation.multipliers:
        return []
    stated = _stated_forces(truth, line)
    exact = list(_exact(truth, line, stated)) if all(_known(truth, x) for x in stated.values()) else []
    return exact if stated and len(exact) == truth.n else []


def _exact(truth: Reference, line: AnsweredLine, stated: Mapping[int, sp.Expr]) -> Iterator[AnsweredLine]:
    """The generalized forces that are right; one on a coordinate without a virtual displacement is 0."""
    for i, c in enumerate(truth.model.coordinates):
        if zero_everywhere(truth, stated.get(i, sp.S.Zero) - truth.Xi[i]):
            yield replace(line, kind="Xi", name=c.name, expr=truth.Xi[i])


def _all_forces(truth: Reference, lines: Sequence[AnsweredLine], works: Sequence[int]) -> list[AnsweredLine]:
    """Every generalized force, by the virtual works of an answer that states it nowhere else, on the last of their
    lines; none if one of these is not understood."""
    stated = [_stated_forces(truth, lines[k]) for k in works]
    if truth.derivation.multipliers or not all(stated):
        return []
    if any(not _known(truth, x) or holds_potential(truth, i, x) for found in stated for i, x in found.items()):
        return []
    sums = [sp.Add(*[found.get(i, sp.S.Zero) for found in stated]) for i in range(truth.n)]
    coordinates = truth.model.coordinates
    return [replace(lines[works[-1]], kind="Xi", name=c.name, expr=x) for c, x in zip(coordinates, sums, strict=True)]


def _wrong_forces(truth: Reference, line: AnsweredLine, *, apart: bool) -> Iterator[AnsweredLine]:
    """The wrong generalized forces that a line of virtual work states, behind the right ones; none for one that is not
    understood, or in which nothing is wrong.

    ``apart``: the answer states a V. If it does not, wrong forces with a potential are told beside the right ones.
    """
    found: list[AnsweredLine] = []
    stated = _stated_forces(truth, line)
    for i, force in stated.items():
        if not _known(truth, force) or (wrong := _wrong_part(truth, i, force)) is None:
            continue
        whole = truth.Xi[i] if apart or not holds_potential(truth, i, force) else whole_force(truth, i)
        found.append(replace(line, kind="Xi", name=truth.model.coordinates[i].name, expr=whole + wrong))
    if found:
        yield from _exact(truth, line, stated)
        yield from found


def _copied_forces(truth: Reference, lines: Sequence[AnsweredLine], work: AnsweredLine) -> list[AnsweredLine]:
    """The generalized forces that a virtual work states where the answer has the same ones below as all that act: who
    lacks a force there has forgotten it in the virtual work."""
    stated = _stated_forces(truth, work)
    below = {x.name: x.expr for x in lines if x.kind == "Xi" and x.number >= work.number}
    names = [c.name for c in truth.model.coordinates]
    if truth.derivation.multipliers or not stated or below.keys() != set(names):
        return []
    every = [stated.get(i, sp.S.Zero) for i in range(truth.n)]
    if not all(bounded.letters(x) <= truth.names for x in every):
        return []
    if not all(zero_everywhere(truth, below[name] - x) for name, x in zip(names, every, strict=True)):
        return []
    return [replace(work, kind="Xi", name=name, expr=x) for name, x in zip(names, every, strict=True)]


def _known(truth: Reference, force: sp.Expr) -> bool:
    """Whether a force is in the names of the system, and no part of the motion."""
    accelerations = {c.acceleration for c in truth.model.coordinates}
    letters = {p.symbol for p in truth.model.parameters} | {u.symbol for u in truth.model.inputs}
    own = bounded.letters(force)
    return own <= truth.names and bool(own & letters) and not force.has(*accelerations)


def _wrong_part(truth: Reference, i: int, force: sp.Expr) -> sp.Expr | None:
    """What a stated part of the forces on a coordinate is too much, with a wrong term in place of a right one; None if
    nothing is wrong in it."""
    acting = sp.Add.make_args(bounded.expand(truth.Xi[i]))
    storing = sp.Add.make_args(bounded.expand(whole_force(truth, i) - truth.Xi[i]))
    units = [x for x in (*acting, *storing) if x != 0]
    if len(units) > MOST_TERMS or ((values := _factors(truth, force, units)) is not None and set(values) <= {0, 1}):
        return None
    if values is not None:
        return sp.Add(*[(c - 1) * x for c, x in zip(values, units, strict=True) if c not in (0, 1)])
    own = sp.Add.make_args(bounded.expand(force))
    absent = [x for x in units if x not in own]
    found: sp.Expr = sp.S.Zero
    for term in own:
        if term in units:
            continue
        like, right = max(((_likeness(x, term), x) for x in absent), key=lambda pair: pair[0], default=(0.0, None))
        if right is not None and like >= ALIKE:
            absent.remove(right)
            found += term - right
        elif truth.derivation.multipliers:
            return None  # a coordinate that a constraint gives may be put in
        else:
            found += term
    return None if zero_everywhere(truth, found) else found


def _likeness(term: sp.Expr, other: sp.Expr) -> float:
    """The share of factors that two terms have in common."""
    a, b = ({x for x in sp.Mul.make_args(y) if not x.is_number} for y in (term, other))
    return len(a & b) / max(1, len(a), len(b))


def _factors(truth: Reference, force: sp.Expr, units: Sequence[sp.Expr]) -> list[sp.Expr] | None:
    """The numbers with which terms add up to a force; None if no numbers do so."""
    values = CompiledExpressions([force, *units]).at(truth.states)
    if not np.isfinite(values).all() or not units or values.shape[1] < len(units):
        return None
    found = np.linalg.lstsq(values[1:].T, values[0], rcond=None)[0]
    numbers: list[sp.Expr] = [sp.Rational(round(12 * float(x)), 12) for x in found]
    rest = force - sp.Add(*[c * x for c, x in zip(numbers, units, strict=True)])
    return numbers if zero_everywhere(truth, rest) else None
