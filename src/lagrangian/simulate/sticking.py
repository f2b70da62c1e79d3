"""Finds which force, torque or other element makes a run stick, and a smooth law that would not."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from lagrangian.advice import Advice, Argument
from lagrangian.model import Model
from lagrangian.model.names import time
from lagrangian.page.plain import plain
from lagrangian.records import dataclass

if TYPE_CHECKING:
    from lagrangian.integrate.scipy_methods import Outcome
    from lagrangian.simulate.integrating import Task

Array = NDArray[np.float64]

WIDTH = "0.001"
"""The suggested width of the smooth law, in the unit of the argument of the sign."""


def stuck(task: Task, outcome: Outcome) -> tuple[str, str]:
    """The element that prevents a run from leaving its last state, and the remedy."""
    values, steps = _values(task, outcome), "get ever shorter" if task.step is None else "jump to and fro"
    rates = {v.symbol for v in task.model.velocities}  # a force that jumps acts immediately only on what it moves
    found: list[tuple[bool, float, _Law]] = []
    for law in _laws(task):
        here: Any = law.surface.xreplace(values)
        if here.is_number and here.is_real:
            found.append((not rates & law.surface.atoms(AppliedUndef, sp.Derivative), abs(float(here)), law))
    if not found:
        return (
            f"[E505] a force jumps here and drives the motion back from both sides: it sticks, and steps {steps}",
            f"a law that passes smoothly through the jump: tanh(x/{WIDTH}) for sign(x)",
        )
    law = min(found, key=lambda each: each[:2])[2]
    eps = sp.Symbol(next(n for n in ("eps", "eps1", "eps2", "eps_smooth") if n not in task.model.symbols))
    soft, zero = sp.tanh(law.surface / eps), plain(law.surface)
    smooth: dict[Any, Any] = {sp.sign: soft, sp.Heaviside: (1 + soft) / 2}
    if type(law.jump) in smooth:
        written = f"{law.key} = {plain(law.expr.xreplace({law.jump: smooth[type(law.jump)]}))}"
    else:
        written = f"{plain(soft)} for the sign of {zero}"
    return (
        f"[E505] {law.who} jumps where {zero} = 0 and drives the motion back there from both sides: "
        f"it sticks, and steps {steps}",
        Advice(
            f"a law that passes smoothly through zero, {written}, with a small parameter {eps}, such as {WIDTH} in the "
            f"unit of {zero}; ",
            Argument("method", "'Radau'"),
            " is fast then",
        ),
    )


@dataclass(frozen=True)
class _Law:
    """A law that jumps where ``surface`` is 0, in the expression ``key`` of an element or an input."""

    who: str
    key: str
    expr: sp.Expr
    jump: sp.Basic
    surface: sp.Expr


def _values(task: Task, outcome: Outcome) -> dict[sp.Basic, sp.Float]:
    """The values of all symbols at the last state, including rates."""
    model, x = task.model, outcome.final
    n = len(model.coordinates)
    u = task.drive.at(np.array([outcome.reached]), x[np.newaxis, : task.size])[0]
    pairs = [
        *zip([v.symbol for v in model.velocities], x[n : task.size], strict=True),
        *zip([c.symbol for c in model.coordinates], x[:n], strict=True),
        *zip([p.symbol for p in model.parameters], task.p, strict=True),
        *zip([f.symbol for f in task.drive.free], u, strict=True),
        (time, outcome.reached),
    ]
    return {symbol: sp.Float(float(value)) for symbol, value in pairs}


def _laws(task: Task) -> Iterator[_Law]:
    """All jumps in the elements and in the inputs that are expressions, with definitions written out."""
    model: Model = task.model
    listed: list[tuple[str, str, sp.Expr]] = []
    for element in model.elements:
        where = f" ({element.place})" if element.place is not None else ""
        listed.extend((f"{element.title}{where}", use.key, use.expr) for use in element.uses())
    for symbol, expr in task.drive.feedback.items():
        name = next(u.name for u in model.inputs if u.symbol == symbol)
        listed.append((f"input '{name}'", name, expr))
    for who, key, expr in listed:
        full = model.expand(expr, constants=True)
        for jump, surface in _jumps(full):
            yield _Law(who, key, full, jump, surface)


def _jumps(expr: sp.Expr) -> Iterator[tuple[Any, Any]]:
    """The jumps in an expression, each with the expression that is zero there."""
    for jump in expr.atoms(sp.sign, sp.Heaviside, sp.Abs):
        yield jump, jump.args[0]
    for piece in expr.atoms(sp.Piecewise):
        relations: set[Any] = piece.atoms(Relational)
        yield from ((piece, relation.lhs - relation.rhs) for relation in relations)
