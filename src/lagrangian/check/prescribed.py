"""What an answer says of motions that the system prescribes, z = a sin Ωt and its rates: no equations of motion."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.model import time
from lagrangian.page.formula import text

WHY = text("Differentiate by time with the chain rule: the inner derivative, such as Ω in sin Ωt, is a factor.")


def as_prescribed(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """An equation that only says what a prescribed motion of the system or its rate is, as an identity with the name of
    this, z or z', which is the right less what is written; as a statement if it is right. Others as they are."""
    own = [d.symbol for d in truth.model.definitions if d.moving and line.expr.has(d.symbol)]
    if line.kind != "equation" or len(own) != 1:
        return line
    z: Any = own[0]
    rest = truth.expand(line.expr)
    others = (*truth.model.coordinates, *truth.model.inputs)
    if rest.has(*(x.symbol for x in others)) or rest.free_symbols - truth.names:
        return line
    order = max((d.derivative_count for d in line.expr.atoms(sp.Derivative) if d.expr == z), default=0)
    rate = sp.diff(z, (time, order)) if order else z
    number = _number_of(line.expr, rate)
    if zero_everywhere(truth, rest):
        return replace(line, kind="statement", expr=sp.S.Zero)
    if number is None:
        return line
    return replace(line, kind="identity", expr=rest / number, name=str(z.func) + order * "'")


def _number_of(expr: sp.Expr, rate: Any) -> sp.Expr | None:
    """The number that multiplies a rate in a sum; None if there is none."""
    held = [t for t in sp.Add.make_args(expr) if t.has(rate)]
    number = cast("sp.Expr", held[0] / rate) if len(held) == 1 else sp.S.Zero
    return number if number.is_number and number != 0 else None


def of_prescribed(truth: Reference, line: AnsweredLine) -> Mistake | None:
    """What is wrong in a line on a prescribed motion; None for any other line."""
    if line.kind != "identity" or line.name is None:
        return None
    base, order = line.name.rstrip("'"), line.name.count("'")
    symbols: list[Any] = [d.symbol for d in truth.model.definitions if str(d.symbol.func) == base]
    if not symbols:
        return None
    rate = sp.diff(symbols[0], (time, order)) if order else symbols[0]
    right = truth.expand(rate)
    what = text(rate, " is ", right, ", not ", right - line.expr, ".")
    return Mistake("prescribed_motion", what, WHY, 2, None, None, text("A prescribed motion is not right."))
