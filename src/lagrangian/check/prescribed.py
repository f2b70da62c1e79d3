"""What an answer says of names that the system defines, z = a sin Ωt and its rates, or δ = φ/n − x/R: no equations of
motion. Where it says of δ what is wrong, it means that by δ in all of its lines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rounded import is_right_rounded
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.model import time
from lagrangian.page.formula import text

WHY = text("Differentiate by time with the chain rule: the inner derivative, such as Ω in sin Ωt, is a factor.")
WHY_FUNCTIONS = text(
    "The derivative of a sine is the cosine, that of a cosine minus the sine, times the inner derivative."
)
LOST = ("lost", "lost_in_a_sum", "factor_missing")
"""The names of mistakes that say which factor is missing."""
OF_OWN = ("T-p", "T-slope", "V-slope", "D-slope")
"""The kinds of lines that give derivatives of the answer's own energies by a coordinate or its rate."""
FUNCTIONS = "functions of time"
"""The name of a line that equates them."""
WHY_TWICE = text("Differentiate the velocity term by term: by the product rule each factor that moves has its turn.")
WHY_SPEED = text(
    "Every coordinate that moves the point adds to its velocity, with its direction: what carries it counts."
)
WHY_DEFINED = text("Move one coordinate alone and hold the others: by how much does it change, and in which direction?")


def as_prescribed(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """An equation that only says what a prescribed motion of the system or its rate is, as an identity with the name of
    this, z or z', which is the right less what is written; as a statement if it is right. Others as they are."""
    if _equates_functions(truth, line):
        return replace(line, kind="identity", name=FUNCTIONS)
    own = [d.symbol for d in truth.model.definitions if d.moving and line.expr.has(d.symbol)]
    if line.kind != "equation" or len(own) != 1:
        return line
    z: Any = own[0]
    rest = truth.expand(line.expr)
    if _states_acceleration(truth, line, z) and not zero_everywhere(truth, rest):
        return replace(line, kind="identity", expr=rest, name=f"{z.func}''")
    others = (*truth.model.coordinates, *truth.model.inputs)
    if rest.has(*(x.symbol for x in others)) or rest.free_symbols - truth.names:
        return line
    order = max((d.derivative_count for d in line.expr.atoms(sp.Derivative) if d.expr == z), default=0)
    rate = sp.diff(z, (time, order)) if order else z
    number = _number_of(line.expr, rate)
    if _is_true(truth, rest) or (number is not None and _right_in_numbers(truth, line, rate, number)):
        return replace(line, kind="statement", expr=sp.S.Zero)
    if number is None:
        return line
    return replace(line, kind="identity", expr=rest / number, name=str(z.func) + order * "'")


def _states_acceleration(truth: Reference, line: AnsweredLine, z: Any) -> bool:
    """Whether an equation only says what the second derivative of a place is, ÿ = −r φ̈ sin φ − r φ̇² cos φ: in
    accelerations of coordinates, without forces."""
    left, right = line.sides or (sp.S.Zero, sp.S.Zero)
    inputs = [u.symbol for u in truth.model.inputs]
    moving = [c.acceleration for c in truth.model.coordinates]
    return left == sp.diff(z, (time, 2)) and right.has(*moving) and not (inputs and right.has(*inputs))


def _right_in_numbers(truth: Reference, line: AnsweredLine, rate: sp.Expr, number: sp.Expr) -> bool:
    """Whether a line without parameters is right with their values, which may be rounded: φ = 0.139626 sin 0.9 t."""
    values = {p: sp.Rational(str(v)) for p, v in truth.model.values.items() if p not in truth.values}
    if line.expr.free_symbols - {time} or not values:
        return False
    valued = truth.with_values(values)
    return is_right_rounded(valued.expand(rate - line.expr / number), valued.expand(rate))


def with_own_definitions(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines, with what an answer itself says that a name of the system is in place of this name.

    A line that says it is an identity, and no line at all if it is right or if it says the same of the rate. What holds
    in a special case alone, x = 0 (s = −R θ), is not said beside what holds always. A rate that is said, γ̇ = (R/r) β̇,
    is put in as what it is the rate of. What is said in letters and again in numbers is in numbers only where a line
    has no letters.
    """
    table: dict[Any, sp.Expr] = {}
    numbers: dict[Any, sp.Expr] = {}
    letters = {p.symbol for p in truth.model.parameters}
    out: list[AnsweredLine] = []
    values = [_value(truth, line) for line in lines]
    always = {x[0] for x, line in zip(values, lines, strict=True) if x is not None and "case" not in line.beside}
    placed = {x[0]: x[1] for x in values if x is not None and not x[2]}
    lettered = {x[0] for x in values if x is not None and x[1].free_symbols & letters}
    for line, value in zip(lines, values, strict=True):
        if value is None or ("case" in line.beside and value[0] in always):
            out.append(line)
            continue
        z, said, of_rate = value
        rest = truth.expand((sp.diff(z, time) if of_rate else z) - said)
        if of_rate and zero_everywhere(truth, rest):
            out.append(replace(line, kind="identity", expr=sp.S.Zero, name=f"{z.func}'"))
            continue
        way = integrated(truth, said) if of_rate else said
        again = of_rate and z in placed and zero_everywhere(truth, sp.diff(placed[z], time) - said)
        if way is not None and not (of_rate and z in placed) and not zero_everywhere(truth, rest):
            (numbers if z in lettered and not way.free_symbols & letters else table)[z] = way
        turned = truth.expand(z).has(sp.Derivative) and zero_everywhere(truth, truth.expand(z + said))
        if again or turned or _is_true(truth, rest):  # a speed may be counted in the other sense
            out.append(replace(line, kind="statement", expr=sp.S.Zero))
        else:
            out.append(replace(line, kind="identity", expr=rest, name=str(z.func) + of_rate * "'"))
    tables = (table if line.expr.free_symbols & letters else {**table, **numbers} for line in out)
    return tuple(
        _put(_of_own_energy(truth, line, out, own), own) if own else line for line, own in zip(out, tables, strict=True)
    )


def _of_own_energy(
    truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine], table: Mapping[Any, sp.Expr]
) -> AnsweredLine:
    """A derivative of the answer's own T*, V or D with what it has too much where the names of the system in this are
    what the answer says."""
    if line.kind not in OF_OWN:
        return line
    c = next((x for x in truth.model.coordinates if x.name == line.name), None)
    energies = [x.expr for x in lines if x.kind == line.kind[0] and x.number <= line.number and x.expr.has(*table)]
    if c is None or not energies:
        return line
    by = c.symbol if line.kind in ("T-slope", "V-slope") else c.rate
    right, own = truth.expand(energies[-1]), bounded.written_out(energies[-1], table)
    return replace(line, expr=line.expr + bounded.diff(right, by) - bounded.diff(own, by))


def _is_true(truth: Reference, rest: sp.Expr) -> bool:
    """Whether what is right less what is written is zero, perhaps with the values of the system: s = x - 0.1 theta. A
    value that is 1 may just have been forgotten."""
    values = {p: sp.Rational(str(v)) for p, v in truth.model.values.items() if v != 1}
    return zero_everywhere(truth, rest) or bounded.expand(cast("sp.Expr", rest.xreplace(values))) == 0


def _put(line: AnsweredLine, table: Mapping[Any, sp.Expr]) -> AnsweredLine:
    """A line with an answer's own definitions; a statement if it says nothing else."""
    if not line.expr.has(*table):
        return line
    put = bounded.written_out(line.expr, table)
    empty = line.kind == "equation" and bounded.expand(put) == 0
    return replace(line, kind="statement", expr=sp.S.Zero) if empty else replace(line, expr=put)


def _value(truth: Reference, line: AnsweredLine) -> tuple[Any, sp.Expr, bool] | None:
    """The name of the system, what it or its rate is in coordinates, and whether it is the rate, that a line says and
    nothing else."""
    model, expr = truth.model, line.expr
    own = [d.symbol for d in model.definitions if d.moving and expr.has(d.symbol)]
    if line.kind != "equation" or len(own) != 1:
        return None
    z: Any = own[0]
    of = next((d for d in expr.atoms(sp.Derivative) if d.has(z)), z)
    number = _number_of(expr, of) if of in (z, sp.diff(z, time)) else None
    if number is None:
        return None
    said = bounded.expand(of - expr / number)
    coordinates = [c.symbol for c in model.coordinates]
    others = [*(c.acceleration for c in model.coordinates), *(u.symbol for u in model.inputs), z]
    rates = [c.rate for c in model.coordinates]
    if of is z and truth.expand(z).has(*rates):
        moving = said.has(*rates)
    elif of is z:
        moving = said.has(*coordinates) and not said.has(*rates)
    else:
        moving = said != 0 and bounded.expand(said - _of_rates(truth, said)) == 0
    known = said.free_symbols <= truth.names and not said.has(*others)
    return (z, said, of is not z) if moving and known else None


def _of_rates(truth: Reference, said: sp.Expr) -> sp.Expr:
    """The rates in an expression, each with the factor that it has."""
    rates = [c.rate for c in truth.model.coordinates]
    factors = [bounded.diff(said, v) for v in rates]
    return sp.Add(*[f * v for f, v in zip(factors, rates, strict=True) if not f.has(*rates)])


def integrated(truth: Reference, said: sp.Expr) -> sp.Expr | None:
    """What has a rate that is a sum of rates with constant factors; None for any other rate."""
    way: Any = said.xreplace({c.rate: c.symbol for c in truth.model.coordinates})
    same = bounded.expand(bounded.diff(way, time) - said) == 0
    return way if same else None


def _number_of(expr: sp.Expr, rate: Any) -> sp.Expr | None:
    """The number that multiplies a rate in a sum; None if there is none."""
    held = [t for t in sp.Add.make_args(expr) if t.has(rate)]
    number = cast("sp.Expr", held[0] / rate) if len(held) == 1 else sp.S.Zero
    return number if number.is_number and number != 0 else None


def _equates_functions(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line wrongly equates functions of time alone, d²/dt² (a sin Ωt) = a Ω² cos Ωt; t = 0 is an instant."""
    if line.kind != "equation" or not line.expr.has(time) or bounded.atoms(line.expr, AppliedUndef):
        return False
    if line.expr.diff(time) in (1, -1):
        return False
    known = line.expr.free_symbols <= {p.symbol for p in truth.model.parameters} | {time}
    return known and not zero_everywhere(truth, line.expr)


def _of_speed(truth: Reference, z: sp.Expr, right: sp.Expr, written: sp.Expr) -> Mistake:
    """What is wrong in what an answer says of a speed that the system has a name for, in the sense in which it counts
    it."""
    away = [len(sp.Add.make_args(bounded.expand(written - sign * right))) for sign in (1, -1)]
    counted = right if away[0] <= away[1] else -right
    begins = () if counted is right else ("But for its sign, ",)
    what = text(*begins, z, " is ", counted, ", not ", written, ".")
    acts = any(e.ledger == "Ξ" and any(sp.sympify(u.expr).has(z) for u in e.uses()) for e in truth.model.elements)
    brief = text(f"What {z.func} is, is not right.")
    return Mistake("definition_wrong", what, WHY_SPEED, 6 if acts else 2, None, None, brief)


def of_prescribed(truth: Reference, line: AnsweredLine) -> Mistake | None:
    """What is wrong in a line on a prescribed motion; None for any other line."""
    if line.kind != "identity" or line.name is None:
        return None
    if line.name == FUNCTIONS:
        first, *rest = sp.Add.make_args(bounded.expand(line.expr))
        what = text(f"In line {line.number}, ", first, " is not the same as ", -sp.Add(*rest), ".")
        brief = text(f"What line {line.number} equates is not equal.")
        return Mistake("prescribed_motion", what, WHY_FUNCTIONS, 2, None, None, brief)
    base, order = line.name.rstrip("'"), line.name.count("'")
    symbols: list[Any] = [d.symbol for d in truth.model.definitions if str(d.symbol.func) == base]
    if not symbols:
        return _of_own(truth, line)
    rate = sp.diff(symbols[0], (time, order)) if order else symbols[0]
    right = truth.expand(rate)
    what = text(rate, " is ", right, ", not ", right - line.expr, ".")
    if right.has(*(c.symbol for c in truth.model.coordinates)):
        written = right - line.expr
        if order == 2:
            return Mistake(
                "prescribed_motion", what, WHY_TWICE, 5, None, None, text(f"The acceleration of {base} is not right.")
            )
        if right.has(sp.Derivative) and not order:
            return _of_speed(truth, symbols[0], right, written)
        own = not order or not any(x.has(sp.sin, sp.cos) for x in (right, written))  # −sin θ comes of the cosine
        if own and _is_negative(right) != _is_negative(written) and right + written != 0:  # a sense of its own
            what = text("But for its sign, ", rate, " is ", -right, ", not ", written, ".")
        brief = text(f"What {base} is, is not right.")
        return Mistake("definition_wrong", what, WHY_DEFINED, 1, None, None, brief)
    why = WHY_FUNCTIONS if bounded.expand(2 * right - line.expr) == 0 else WHY  # what is written is −right
    return Mistake("prescribed_motion", what, why, 2, None, None, text("A prescribed motion is not right."))


def _is_negative(expr: sp.Expr) -> bool:
    return not isinstance(expr, sp.Add) and expr.could_extract_minus_sign()


def own_rate(truth: Reference, line: AnsweredLine) -> tuple[sp.Expr, sp.Expr] | None:
    """What the derivative of a motion of the answer's own, u = A sin Ωt, is, and what a wrong line says of it."""
    if line.kind != "identity" or line.sides is None or line.name is None:
        return None
    right, written = (truth.expand(x) for x in line.sides)
    moving = [x.symbol for x in (*truth.model.coordinates, *truth.model.inputs)]
    known = all(not x.has(*moving) and x.free_symbols <= {time, *truth.names} for x in (right, written))
    rate = line.text.partition("=")[0].strip() != line.name
    differs = bounded.expand(right - written) != 0 and bounded.expand(right - written - line.expr) == 0
    return (right, written) if known and rate and differs and right.has(time) else None


def _of_own(truth: Reference, line: AnsweredLine) -> Mistake | None:
    """The same for the derivative of a motion that the answer gives itself."""
    if (sides := own_rate(truth, line)) is None:
        return None
    right, written = sides
    what = text(f"In line {line.number}, the derivative of {line.name} is ", right, ", not ", written, ".")
    why = WHY_FUNCTIONS if bounded.expand(right + written) == 0 else WHY
    return Mistake("prescribed_motion", what, why, 2, None, None, text("A prescribed motion is not right."))


def with_prescribed(
    truth: Reference, prescribed: Mapping[AnsweredLine, Mistake], told: Sequence[Mistake]
) -> tuple[Mistake, ...]:
    """The mistakes in lines on prescribed motions, and those ``told`` besides, without those that say again which
    factor a derivative of an own motion lacks."""
    sides = [x for line in prescribed if (x := own_rate(truth, line)) is not None]
    lost = [bounded.cancel(right / written) for right, written in sides if written != 0]
    more = (m for m in told if not (m.name in LOST and any(x in lost for x in m.what.parts)))
    return (*prescribed.values(), *more)
