"""Exports a Program as a function of Julia, generic in the type of its numbers.

A root of a negative number is an error in Julia, also where its value is not wanted. The few functions with such an end
have a version of our own in the module, which gives NaN there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .arguments import is_scalar
from .expressions import (
    BOTH_OR_EITHER,
    COMPARISONS,
    PRODUCTS,
    SUMS,
    Infix,
    SourceNotation,
    arguments_of,
    assignments,
    signature,
)
from .labels import comment

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lagrangian.graph import Program

INFIX: Infix = SUMS | PRODUCTS | COMPARISONS | BOTH_OR_EITHER | {"neg": ("-{0}", 6, (7,)), "not": ("!{0}", 6, (8,))}
LIMITED = {"sqrt": "x < 0", "log": "x < 0", "asin": "abs(x) > 1", "acos": "abs(x) > 1", "acosh": "x < 1",
           "atanh": "abs(x) > 1"}  # fmt: skip
"""Functions that end, and where."""

CALLS = (
    {kind: kind for kind in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "asinh", "exp", "abs", "sign", "atan")}
    | {kind: f"real_{kind}" for kind in LIMITED}
    | {"atan2": "atan", "pow": "real_power", "min": "min", "max": "max", "select": "ifelse"}
)

JULIA = SourceNotation(
    INFIX,
    CALLS,
    ("{0}^{1}", 7, 8),
    element="{0}[{1}]",
    first=1,
    nan="NaN",
    infinity="Inf",
    assignment="{0} = {1}",
    remark="  # {0}",
)

JULIA_HELPERS = "\n".join(
    [f"real_{kind}(x) = {where} ? NaN*x : {kind}(x)" for kind, where in LIMITED.items()]
    + ["real_power(a, b) = (a < 0) & (b != round(b)) ? NaN*a : a^b"]
)
"""Functions that the module of `to_julia` contains."""


def to_julia(program: Program, *, name: str, units: Mapping[str, str] | None = None) -> str:
    """The text of a function of one vector for each group, time a number, to stand in a module.

    The module contains `JULIA_HELPERS`, and ``PARAMETERS`` if all declared values are known. One output is returned as
    it is, several as a tuple. ``units`` of entries, by name, are for the docstring. Raises `ValueError` for a name that
    is none.
    """
    if not (name.isascii() and name.isidentifier()):
        raise ValueError(f"{name!r} cannot name a function of Julia")
    groups = arguments_of(program)
    lines = ['"""', f"{comment(program.name)}, in SI units.", ""]
    for g in groups:
        lines.append(f"{g.word}: {g.described(units or {})}".rstrip())
    for title, output in program.outputs.items():
        lines.append(f"returns {comment(title)}: {' x '.join(str(n) for n in output.shape) or 'one number'}")
    lines += ['"""', f"function {name}({signature(program, groups, joined=' = ')})"]
    for g in groups:
        if not is_scalar(g.group, g.entries):
            lines.append(f"    length({g.word}) == {len(g.entries)} ||")
            lines.append(f'        throw(DimensionMismatch("{g.word} must have {len(g.entries)} entries"))')
    places = {(g.group, 0): g.word for g in groups if is_scalar(g.group, g.entries)}
    body, names = assignments(program, JULIA, places=places)
    lines += ["    " + line for line in body]
    for k, (title, output) in enumerate(program.outputs.items()):
        values = [names[i] for i in output.ids]
        if not output.shape:
            lines.append(f"    out{k} = {values[0]}")
        elif len(output.shape) == 2:  # a literal of a matrix would be read with blanks between its entries
            listed = ", ".join(values)
            lines.append(f"    out{k} = permutedims(reshape([{listed}], {output.shape[1]}, {output.shape[0]}))")
        else:
            lines.append(f"    out{k} = {'[' + ', '.join(values) + ']' if values else 'Float64[]'}")
        lines.append(f'    all(isfinite, out{k}) || throw(DomainError("{comment(title)} is not finite"))')
    answers = [f"out{k}" for k in range(len(program.outputs))]
    return "\n".join([*lines, f"    return {', '.join(answers)}", "end"]) + "\n"
