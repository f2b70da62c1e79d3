"""What is shown of an answer: every line as mathematics, as it was read, and the report on it in pieces of HTML."""

from __future__ import annotations

from typing import Any, cast

import sympy as sp

from lagrangian.check.reading import Answer, generalized_force
from lagrangian.check.reading.answer import AnswerLine
from lagrangian.model import Model
from lagrangian.page.formula import Formula, Left, Minus, Name, Partial, Terms, Total
from lagrangian.page.report import Report
from lagrangian.write.html_page import inline, pieces
from lagrangian.write.quantities import Quantities
from lagrangian.write.report import lay_out_report

ENERGIES = {"T": "T*", "V": "V", "L": "L", "D": "D"}


def lines_of_answer(model: Model, answer: Answer) -> list[dict[str, Any]]:
    """Return the lines of an answer: number, kind, text, and the formula in MathML, None for a general statement."""
    write = Quantities(model, "lecture")
    return [
        {
            "line": line.place.line or 1,
            "kind": line.kind,
            "text": line.text,
            "html": _formula(model, write, line) if line.kind != "statement" else None,
        }
        for line in answer.lines
    ]


def _formula(model: Model, write: Quantities, line: AnswerLine) -> str:
    """A line as a formula, with the letters of the lecture."""
    forces: dict[sp.Basic, sp.Symbol] = {
        generalized_force(c.name): sp.Symbol(f"Xi_{i}") for i, c in enumerate(model.coordinates, 1)
    }
    left = _left(model, line)
    if isinstance(left, sp.Expr):
        left = cast("sp.Expr", left.xreplace(forces))
    sides = write.formula(Formula((left, cast("sp.Expr", line.rhs.xreplace(forces)))))
    words: list[Any] = [sides[0]]
    for side in sides[1:]:
        words += [" = ", side]
    return inline(tuple(words))


def _left(model: Model, line: AnswerLine) -> Left:
    """The left-hand side of a line, or the quantity that it names."""
    if line.lhs is not None:
        return line.lhs
    if line.kind in ENERGIES:
        return Name(ENERGIES[line.kind])
    if line.kind == "definition":
        own = {c.name: c.symbol for c in model.coordinates}
        return own.get(str(line.name), sp.Symbol(str(line.name)))
    number, symbol = next((i, c.symbol) for i, c in enumerate(model.coordinates, 1) if c.name == line.name)
    if line.kind == "Xi":
        return Name("Xi", str(number))
    slope = Partial(Name("L"), symbol)
    momentum = Partial(Name("L"), sp.Derivative(symbol, sp.Symbol("t")))
    match line.kind:
        case "p":
            return momentum
        case "p-rate":
            return Total(momentum)
        case "slope":
            return slope
        case _:
            return Terms((Total(momentum), Minus(slope)))


def report_pieces(report: Report[Model]) -> list[dict[str, str]]:
    """Return the parts of a report as pieces of HTML."""
    return pieces(lay_out_report(report, details=True))
