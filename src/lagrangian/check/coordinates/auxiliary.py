"""Coordinates, speeds and momenta that an answer has beside the system's, and that its own lines determine.

X - x - e cos φ = 0      X = x + e cos φ        a constraint of its own, with multipliers in its equations
ẋ = R φ̇                  φ = x/R                rolling: the constant does not matter where only rates of φ stand
θ̇ = p/(m l²)             p = m l² θ̇             a momentum that only Hamilton's equations explain
r ω = R φ̇                ω = R φ̇/r              rolling, told by speeds

The line is then a definition, and the others are judged with the name written out.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast
from unicodedata import normalize

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading import is_placeholder
from lagrangian.check.reading.placeholders import called
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.read.letters import key

MOST, LONGEST = 8, 80
"""The largest number of such names, and of operations of a line that determines one."""
_RATE = re.compile(r"(.{1,24})['’′]|([^\u0307]\u0307.{0,24})|\\dot(?![a-z])(.{1,24})|d(.{1,24})/ ?dt|(.{1,24}?)_?dot")
"""The left side of a line that is the rate of a name."""
_SPEED = re.compile(r"(?:v|w|[oO]mega)(?:_?\w{1,2})?")
"""The name of a speed, which may have an index."""
_SET = re.compile(r"[\s\\{}$\u0307]")


def with_auxiliary(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines with every name written out that a line without accelerations determines, and that others use.

    Each name must be one that changes with time, alone in its line, and linear there.
    """
    found = {x for line in lines for x in bounded.atoms(line.expr, AppliedUndef) if x.args == (time,)}
    known = truth.names | {d.symbol for d in truth.model.definitions}
    unknown: set[Any] = {x for x in found if x not in known and not is_placeholder(x)}
    unknown |= {x for line in lines for x in bounded.symbols(line.expr) - known if _SPEED.fullmatch(key(str(x)))}
    if truth.derivation.multipliers or len(unknown) > MOST:
        return tuple(lines)
    while True:
        out, solved = _written_out(lines, unknown)
        idle = {x for x in solved.keys() - _needed(lines, out, solved, unknown) if x.is_Symbol}
        idle -= {x for x in idle if _turns(truth, x, out[solved[x]].expr)}
        if not idle:
            return tuple(out)
        unknown -= idle


def _written_out(lines: Sequence[AnsweredLine], unknown: set[Any]) -> tuple[list[AnsweredLine], dict[Any, int]]:
    """The lines with the names written out that can be, and the place of the line that determines each of these."""
    out, solved = list(lines), dict[Any, int]()
    while True:
        found = next(
            (x for k in range(len(out)) if (x := _determined(out, k, unknown - solved.keys())) is not None), None
        )
        if found is None:
            return out, solved
        k, name, value = found
        solved[name] = k
        rate = sp.Derivative(name, time)
        out = [replace(x, kind="equation", name=None, expr=rate - x.expr) if _rated(x, name) else x for x in out]
        out[k] = replace(out[k], kind="definition", name=called(name), expr=value)
        out = [
            x if j == k or not x.expr.has(name) else replace(x, expr=_put(x.expr, name, value))
            for j, x in enumerate(out)
        ]


def _needed(
    lines: Sequence[AnsweredLine], out: Sequence[AnsweredLine], solved: dict[Any, int], unknown: set[Any]
) -> set[Any]:
    """The names that lines need which still say something when all are written out, directly or through others."""
    left = unknown - solved.keys()
    says = [x.kind != "definition" and x.expr != 0 and not bounded.letters(x.expr) & left for x in out]
    needed: set[Any] = set()
    for _ in range(len(solved) + 1):
        at = {k for k, x in enumerate(says) if x} | {k for name, k in solved.items() if name in needed}
        needed |= {x for x, k in solved.items() if any(j != k and lines[j].expr.has(x) for j in at)}
    return needed


def turning_alone(lines: Sequence[AnsweredLine], out: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The lines that became definitions of angular velocities which no other line needs."""
    solved = {
        name: k
        for k, (x, y) in enumerate(zip(lines, out, strict=True))
        for name in bounded.symbols(x.expr)
        if x.kind != y.kind == "definition" and str(name) == y.name
    }
    return [lines[solved[x]] for x in solved.keys() - _needed(lines, out, solved, set())]


def _turns(truth: Reference, name: Any, value: sp.Expr) -> bool:
    """Whether a name is that of an angular velocity and its value one, which is judged as one of a body's."""
    rates = {c.rate: sp.S.Zero for c in truth.model.coordinates}
    linear = all(not bounded.diff(value, x).atoms(sp.Derivative) for x in value.atoms(sp.Derivative))
    inputs = {u.symbol for u in truth.model.inputs}
    return (
        key(str(name)) in ("omega", "Omega")
        and linear
        and value.xreplace(rates) == 0
        and not bounded.letters(value) & inputs
    )


def _rated(line: AnsweredLine, name: Any) -> bool:
    """Whether a line states the rate of a name, which was not known when it was read: p' = -k x."""
    if line.kind != "definition" or line.name != called(name):
        return False
    rate = _RATE.fullmatch(normalize("NFD", line.text.partition("=")[0]).strip())
    return rate is not None and key(_SET.sub("", next(filter(None, rate.groups())))) == key(str(line.name))


def _put(expr: sp.Expr, name: Any, value: sp.Expr) -> sp.Expr:
    return cast("sp.Expr", expr.xreplace({name: value}).doit())


def _determined(lines: Sequence[AnsweredLine], k: int, unknown: set[Any]) -> tuple[int, Any, sp.Expr] | None:
    """The name that a line determines, and its value."""
    line = lines[k]
    inside = bounded.letters(line.expr) & unknown
    rates = bounded.atoms(line.expr, sp.Derivative)
    if line.kind not in ("equation", "identity") or len(inside) != 1 or bounded.operations(line.expr) > LONGEST:
        return None
    name: Any = inside.pop()
    others = [x.expr for j, x in enumerate(lines) if j != k]
    if any(d.derivative_count > 1 for d in rates):
        return None
    if name.is_Symbol:
        value = _solved(line.expr, name) if rates else None
        return None if value is None else (k, name, value)
    if not any(x.has(name) for x in others) and not any(_rated(x, name) for x in lines):
        return None
    rate = sp.Derivative(name, time)
    if rate not in rates:
        value = _solved(line.expr, name)
        return None if value is None else (k, name, value)
    stands = any(x.xreplace(dict.fromkeys(x.atoms(sp.Derivative), sp.S.Zero)).has(name) for x in (line.expr, *others))
    value = None if stands else _solved(line.expr, rate)
    held = {} if value is None else {d: d.args[0] for d in value.atoms(sp.Derivative)}
    if value is None or not held:
        return None
    place = cast("sp.Expr", value.xreplace(held))
    return (k, name, place) if bounded.expand(bounded.diff(place, time) - value) == 0 else None


def _solved(expr: sp.Expr, name: sp.Expr) -> sp.Expr | None:
    """The value of what an expression that is zero is a linear function of; None if it is not."""
    mark = sp.Dummy()
    put = cast("sp.Expr", expr.xreplace({name: mark}))
    slope = bounded.diff(put, mark)
    if slope == 0 or slope.has(mark):
        return None
    rest: Any = put.xreplace({mark: sp.S.Zero})
    return cast("sp.Expr", -rest / slope)
