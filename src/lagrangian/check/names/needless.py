"""Lines with names that nothing explains, where the equations of motion beside them do without these names.

"The pulley turns with φ′ = x′/R" says what φ is. If every coordinate has its equation in names of the system, nothing
follows from φ, and such a line is neither right nor wrong. Two that say different things of one name contradict each
other, x = R φ and x = R φ + 1; what they say together of the system is judged.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reading.placeholders import called
from lagrangian.check.reading.prose.remarks import CONSTANT
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass

MOST = 8
"""The largest number of relations between which contradictions are sought."""

WITHOUT = " was not judged: the equations do without its names."
"""What is said of such a line, behind its text."""

LONGEST = 60
"""The largest number of operations of such a relation."""

_STATES = frozenset(
    ["equation", "identity", "T", "V", "L", "D", "Xi", "p", "p-rate", "slope", "left", "T-p", "given", "definition"]
)


@dataclass(frozen=True)
class Needed:
    """The lines that decide, what to say about the others, and whether these say something together that is judged."""

    lines: tuple[AnsweredLine, ...]
    notes: tuple[Text, ...] = ()
    together: bool = False


def without_constants(lines: Sequence[AnsweredLine], unknown: Collection[sp.Basic]) -> tuple[AnsweredLine, ...]:
    """The lines, with energies without a constant that is only called so: T = ½ m ẋ² + const."""
    named = [x for x in unknown if x.is_Symbol and str(x).lower() in CONSTANT]
    return tuple(replace(x, expr=_without(x.expr, named)) if x.kind in ("T", "V", "L") else x for x in lines)


def _without(expr: sp.Expr, names: Sequence[sp.Basic]) -> sp.Expr:
    """An expression without the terms that are nothing but one of some names."""
    parts = sp.Add.make_args(expr)
    kept = [x for x in parts if x not in names]
    return sp.Add(*kept) if 0 < len(kept) < len(parts) else expr


def needed(lines: Sequence[AnsweredLine], unknown: Collection[sp.Basic], count: int) -> Needed | None:
    """The lines without those that hold ``unknown`` names, and what these say together.

    None if there are none, or if the others have fewer than ``count`` equations of motion.
    """
    aside = [line for line in lines if line.kind in _STATES and line.expr.has(*unknown)] if unknown else []
    energies = {(line.kind, line.number) for line in lines if line.kind in ("T", "V", "L", "D")}
    told = [(x.kind, x.number) for x in aside if x.kind in ("T", "V", "L", "D")]
    if any(sum((x.kind, x.number) == at for x in lines) > told.count(at) for at in energies & set(told)):
        return None  # one side of a chain: T = 99 Z = ½ m x′²
    kept = [line for line in lines if not any(line is x for x in aside)]
    if not aside or sum(line.kind == "equation" and accelerates(line.expr) for line in kept) < count:
        return None
    more = tuple(_contradictions([*aside, *_values(lines, unknown)], unknown))
    judged = {(line.number, line.text) for line in more}
    others = [line for line in aside if (line.number, line.text) not in judged]
    told = [text(f"'{line.text}'{WITHOUT}") for line in others]
    rates = {id(line): x for line in others if (x := _rate_said(line, unknown)) is not None}
    said = [rates.get(id(line), line) for line in lines if id(line) in rates or any(line is x for x in kept)]
    return Needed(_in_order((*said, *more)), tuple(dict.fromkeys(told)), bool(more))


def _in_order(lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines as they stand in the answer: what is wrong above is the cause of what is wrong below."""
    return tuple(sorted(lines, key=lambda x: x.number))


def _rate_said(line: AnsweredLine, unknown: Collection[sp.Basic]) -> AnsweredLine | None:
    """A line that says what the rate of an unknown place or angle is, ẋ_C = s θ̇ cos θ, as a definition of it."""
    rates = [d for d in bounded.atoms(line.expr, sp.Derivative) if d.args[0] in unknown]
    if line.kind not in ("equation", "identity") or len(rates) != 1 or accelerates(line.expr):
        return None
    slope = _slope(line.expr, rates[0])
    value = None if slope is None else bounded.expand(rates[0] - line.expr / slope)
    if value is None or not cast("sp.Expr", slope).is_number or value.has(*unknown):
        return None
    return replace(line, kind="definition", name=str(rates[0].args[0].func), expr=value)


def unused_in_motion(
    lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic], coordinates: Collection[str]
) -> list[sp.Basic]:
    """The ``unknown`` names that stand beside no accelerations and are no results, and virtual displacements δx, δy.

    A result is what a line alone determines: λ = m g cos θ. It may be the force of a constraint and is judged.
    """
    virtual = {f"delta{name}" for name in coordinates}
    named = [x for x in unknown if called(x).replace("_", "") in virtual]
    for x in unknown:
        held = [line.expr for line in lines if line.expr.has(x)]
        others = [y for y in unknown if y != x and not isinstance(y, AppliedUndef)]  # no angles
        alone = (e for e in held if not any(map(e.has, others)))
        if not any(map(accelerates, held)) and all(_slope(e, x) is None for e in alone):
            named.append(x)
    return named


def _values(lines: Sequence[AnsweredLine], unknown: Collection[sp.Basic]) -> Iterator[AnsweredLine]:
    """That two values of one name are equal, where an unknown name stands in one of them."""
    given: dict[str, AnsweredLine] = {}
    for line in lines:
        if line.kind == "definition" and line.name is not None:
            above = given.setdefault(line.name, line)
            if above is not line and (above.expr - line.expr).has(*unknown):
                yield replace(line, kind="equation", expr=above.expr - line.expr, name=None)


def _contradictions(aside: Sequence[AnsweredLine], unknown: Collection[sp.Basic]) -> Iterator[AnsweredLine]:
    """What relations say of the system, once each unknown name has been eliminated; those that become too long say
    nothing."""
    waiting = [line for line in aside if line.kind == "equation" and bounded.operations(line.expr) <= LONGEST]
    waiting = waiting[:MOST]
    while waiting:
        first, *waiting = waiting
        name = next((x for x in _forms(first.expr, unknown) if _slope(first.expr, x) is not None), None)
        if name is None:
            continue
        slope = cast("sp.Expr", _slope(first.expr, name))
        value = name - first.expr / slope
        put = [replace(x, expr=cast("sp.Expr", x.expr.xreplace({name: value}))) for x in waiting]
        put = [replace(x, expr=bounded.expand(x.expr)) for x in put if bounded.operations(x.expr) <= 4 * LONGEST]
        waiting = [x for x in put if x.expr.has(*unknown)]
        found = [x for x in put if not x.expr.has(*unknown)]
        yield from (x for x in found if bounded.operations(x.expr) <= 4 * LONGEST and bounded.expand(x.expr) != 0)


def _forms(expr: sp.Expr, unknown: Collection[sp.Basic]) -> list[Any]:
    """The unknown names in an expression, and their rates."""
    rates = [d for d in expr.atoms(sp.Derivative) if d.args[0] in unknown]
    atoms = [x for x in bounded.letters(expr) if x in unknown and x != time]
    return sorted(rates, key=str) or sorted(atoms, key=str)


def _slope(expr: sp.Expr, name: Any) -> sp.Expr | None:
    """The factor of a name of which an expression is a linear function; None if it is not."""
    mark = sp.Dummy()
    put = cast("sp.Expr", expr.xreplace({name: mark}))
    slope = bounded.diff(put, mark)
    return None if slope == 0 or slope.has(mark) else slope
