"""Names such as Q_1 that an answer uses for what stands on the right of its equations, and not for a Ξ."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.all_forces import whole_force
from lagrangian.check.reading import generalized_force, of_coordinate
from lagrangian.check.reading.placeholders import ENERGIES
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key
from lagrangian.records import dataclass

LONGEST = 60
"""The most characters of a line that is quoted."""


@dataclass(frozen=True)
class OwnForces:
    """An answer in which such names are its own, as it was read and with names written out, and what to say of them."""

    lines: tuple[AnsweredLine, ...]
    written: tuple[AnsweredLine, ...]
    note: Text
    sure: bool


def with_own_forces(
    truth: Reference, lines: Sequence[AnsweredLine], written: Sequence[AnsweredLine], verdict: Verdict
) -> OwnForces | None:
    """The answer with each wrong Ξ that its equations use as a name of its own, if nothing else is wrong in it.

    Q_1 = τ − 2 m r r′ ψ′ and ψ″ = Q_1/J: as Ξ it is wrong, but the equation says what it is used for. It is ``sure``
    that it is no Ξ if it has terms of the left-hand side, with their signs on the right: weights and springs in Q of
    M q″ + h = Q.
    """
    wrong = [f.line for f in verdict.findings if f.status is Status.WRONG]
    equations = [line for line in lines if line.kind == "equation"]
    applied = _hold_all_forces(truth, lines, written)
    stated = [x for x in wrong if x.kind == "Xi" and "Ξ" not in x.text]
    forces = [x for x in stated if applied or _is_used(x, equations)]
    if verdict.status is not Status.WRONG or not forces:
        return None
    moved = [x for x in forces if _has_moved_terms(truth, x)]
    if len(forces) < len(wrong):
        forces = moved
    names = {str(x.name) for x in forces}

    def own(given: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
        return tuple(replace(x, kind="definition") if x.kind == "Xi" and str(x.name) in names else x for x in given)

    sure = bool(moved) and len(moved) == len(forces)
    note = text(f"{_listed(forces)} was read as all forces, with those of V.") if applied else _read_as_own(forces)
    return OwnForces(own(lines), own(written), note, sure) if forces else None


def _hold_all_forces(truth: Reference, read: Sequence[AnsweredLine], lines: Sequence[AnsweredLine]) -> bool:
    """Whether every Q_i of an answer is Ξ_i − ∂V/∂ξ_i, as with T alone, Gibbs's function or virtual work, and nothing
    else accounts for V: no L, and a V above them only where a statement says what they are equal to."""
    mine = [x for x in lines if x.kind == "Xi"]
    places = {c.name: i for i, c in enumerate(truth.model.coordinates)}
    if not mine or truth.derivation.multipliers or any(x.name not in places for x in mine):
        return False
    if any(x.kind in ("L", "slope") or _names_lagrangian(x.expr) for x in (*read, *lines)):
        return False
    equal = any(x.kind == "statement" and x.expr.has(generalized_force(str(y.name))) for x in read for y in mine)
    if not equal and any(x.kind == "V" and x.number < min(y.number for y in mine) for x in lines):
        return False
    return all(zero_everywhere(truth, x.expr - whole_force(truth, places[str(x.name)])) for x in mine)


def _names_lagrangian(expr: sp.Expr) -> bool:
    """Whether an expression has the placeholder of L, or one of its derivatives."""
    lagrangian = ENERGIES["L"].func.__name__
    return any(lagrangian in x.func.__name__ for x in bounded.atoms(expr, AppliedUndef))


def without_own_names(
    truth: Reference, lines: Sequence[AnsweredLine], findings: Sequence[Finding]
) -> tuple[list[Finding], tuple[Text, ...]]:
    """The findings without those of each wrong Ξ_z of a coordinate z of the answer's own that equations use, where
    their value is written out, if nothing else is wrong; with what to say of them."""
    wrong = [f.line for f in findings if f.status is Status.WRONG]
    system = {c.name for c in truth.model.coordinates}
    used = {of_coordinate(x) for line in lines if line.kind == "equation" for x in line.names}
    mine = [x for x in wrong if x.kind == "Xi" and x.name not in system and ("Xi", key(str(x.name))) in used]
    if not wrong or len(mine) < len(wrong):
        return list(findings), ()
    return [f for f in findings if f.line not in wrong], (_read_as_own(wrong),)


def _read_as_own(lines: Sequence[AnsweredLine]) -> Text:
    return text(f"{_listed(lines)} was read as a name of your own; as Ξ it would be wrong.")


def _listed(lines: Sequence[AnsweredLine]) -> str:
    return ", ".join(dict.fromkeys(f"'{x.text}'" if len(x.text) <= LONGEST else f"Line {x.number}" for x in lines))


def _is_used(line: AnsweredLine, equations: Sequence[AnsweredLine]) -> bool:
    """Whether an equation of the answer uses a Ξ, or the column of which it is an entry."""
    letter = line.text.partition("=")[0].strip()
    alone = re.compile(rf"(?<![\w\\]){re.escape(letter)}(?!\w)") if letter else None
    used = (x for x in equations if x.expr.has(generalized_force(str(line.name))) or (alone and alone.search(x.text)))
    return any(used)


def _has_moved_terms(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a Ξ has terms of the left-hand side too much, with their signs on the right."""
    names = [c.name for c in truth.model.coordinates]
    if line.name not in names:
        return False
    k = names.index(line.name)
    more = bounded.expand(truth.expand(line.expr) - truth.expand(truth.Xi[k]))
    left = bounded.expand(-truth.expand(truth.rows[k]) - truth.expand(truth.Xi[k]))
    return more != 0 and not set(sp.Add.make_args(more)).isdisjoint(sp.Add.make_args(left))
