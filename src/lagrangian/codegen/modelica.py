"""Prints a Program as equations of Modelica, one for each name, so that tools can sort and differentiate them.

Conditions stand where they are read: a relation with a name of its own would be an event. All of them are within
``noEvent``, because the right-hand side of a mechanical system is computed as it is, without a switch.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from .expressions import COMPARISONS, PRODUCTS, SUMS, Infix, SourceNotation, assignments
from .tape import FLAGS

if TYPE_CHECKING:
    from lagrangian.graph import Program

LARGEST = "1.7976931348623157e308"

INFIX: Infix = (
    SUMS
    | PRODUCTS
    | COMPARISONS
    | {
        "neg": ("-{0}", 3, (5,)),
        "pow": ("{0}^{1}", 7, (8, 8)),
        "eq": ("{0} <= {1} and {0} >= {1}", 0, (2, 2)),  # reals cannot be compared by ==
        "and": ("{0} and {1}", 0, (1, 1)),
        "or": ("{0} or {1}", 0, (1, 1)),
        "not": ("not {0}", 0, (9,)),
        "select": ("if noEvent({0}) then {1} else {2}", -1, (-1, 0, 0)),
        "abs": ("noEvent(abs({0}))", 9, (-1,)),
        "sign": ("noEvent(sign({0}))", 9, (-1,)),
    }
)
CALLS = {
    kind: kind
    for kind in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "atan2",
                 "min", "max")
} | {"asinh": "inverse_sinh", "acosh": "inverse_cosh", "atanh": "inverse_tanh"}  # fmt: skip

MODELICA = SourceNotation(
    INFIX,
    CALLS,
    ("{0}^{1}", 7, 8),
    element="{0}[{1}]",
    first=1,
    nan="(0.0/0.0)",
    infinity=LARGEST,
    assignment="{0} = {1};",
    remark="",
)

_LOG1P = "(if noEvent(abs({0}) < 1e-5) then {0} - {0}^2/2 + {0}^3/3 else log(1 + {0}))"
FUNCTIONS = {
    "asinh": """\
  function inverse_sinh "the inverse of sinh, also where it is small"
    input Real x;
    output Real y;
  protected
    Real a = abs(x);
    Real b = a + a^2/(1 + sqrt(1 + a^2));
  algorithm
    y := sign(x)*""" + _LOG1P.format("b") + """;
    annotation(Inline = true);
  end inverse_sinh;
""",
    "acosh": """\
  function inverse_cosh "the inverse of cosh, for x from 1 on"
    input Real x;
    output Real y;
  algorithm
    y := log(x + sqrt((x - 1)*(x + 1)));
    annotation(Inline = true);
  end inverse_cosh;
""",
    "atanh": """\
  function inverse_tanh "the inverse of tanh, also where it is small"
    input Real x;
    output Real y;
  protected
    Real b = 2*x/(1 - x);
  algorithm
    y := 0.5*""" + _LOG1P.format("b") + """;
    annotation(Inline = true);
  end inverse_tanh;
""",
}  # fmt: skip
"""Functions that Modelica has no name for, to stand in the model."""


def to_modelica(
    program: Program, places: Mapping[tuple[str, int], str], prefix: str = "x"
) -> tuple[list[str], dict[str, list[str]], list[str]]:
    """Return the names that are defined, the texts of the outputs by name, and the equations, in order.

    ``places``: what each input is called, by group and number. The names are ``prefix`` and a number.
    """
    lines, texts = assignments(program, MODELICA, places=places, named=prefix, inline=FLAGS)
    defined = [line.split(" = ", 1)[0] for line in lines]
    outputs = {name: [texts[i] for i in output.ids] for name, output in program.outputs.items()}
    return defined, outputs, lines


def needed_functions(programs: Sequence[Program]) -> list[str]:
    """The texts of the functions that equations call and Modelica does not have."""
    used = {node[0] for program in programs for node in program.graph.nodes}
    return [text for kind, text in FUNCTIONS.items() if kind in used]
