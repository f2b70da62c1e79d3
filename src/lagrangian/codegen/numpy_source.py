"""Exports a Program as a Python function that uses only NumPy and is vectorized over leading dimensions."""

from __future__ import annotations

import keyword
from typing import TYPE_CHECKING

from .arguments import is_scalar
from .expressions import (
    BOTH_OR_EITHER,
    COMPARISONS,
    PRODUCTS,
    SUMS,
    Infix,
    SourceNotation,
    assignments,
    declared_values,
)
from .labels import comment, identifier, word

if TYPE_CHECKING:
    from lagrangian.graph import Program

INFIX: Infix = (
    SUMS
    | PRODUCTS
    | COMPARISONS
    | BOTH_OR_EITHER
    | {
        "neg": ("-{0}", 6, (6,)),
        "pow": ("{0}**{1}", 7, (8, 8)),
        "not": ("~{0}", 6, (8,)),
    }
)
CALLS = {
    "sqrt": "sqrt", "sin": "sin", "cos": "cos", "tan": "tan", "asin": "arcsin", "acos": "arccos", "atan": "arctan",
    "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "asinh": "arcsinh", "acosh": "arccosh", "atanh": "arctanh",
    "exp": "exp", "log": "log", "abs": "abs", "sign": "sign", "atan2": "arctan2", "min": "minimum", "max": "maximum",
    "select": "where",
}  # fmt: skip
POWER = ("{0}**{1}", 7, 8)

NUMPY = SourceNotation(
    INFIX,
    {kind: f"np.{name}" for kind, name in CALLS.items()},
    POWER,
    element="{0}[..., {1}]",
    first=0,
    nan="np.nan",
    infinity="np.inf",
    assignment="{0} = {1}",
    remark="  # {0}",
)


def to_numpy(program: Program, *, name: str | None = None) -> str:
    """Python source of ``program`` as a function of one array per group, each of shape (..., n).

    ``name`` is the name of the function; by default the program's name.
    """
    function = name if name is not None else word(program.name)
    if not function.isidentifier() or not function.isascii() or keyword.iskeyword(function):
        if name is not None:
            raise ValueError(f"{name!r} cannot name a Python function")
        function = "evaluate"
    groups = [(identifier("in_", g, k), g, tuple(entries)) for k, (g, entries) in enumerate(program.inputs.items())]
    lines = [f'"""{comment(program.name)}, as a function of NumPy arrays."""', "", "import numpy as np", ""]
    parameters = declared_values(program)
    lines += [
        *parameters,
        *([""] if parameters else ()),
        "",
        f"def {function}({_arguments(groups, bool(parameters))}):",
    ]
    lines += _docstring(program, groups)
    lines += _preparation(program, groups)
    lines += [
        '    with np.errstate(all="ignore"):  # both sides of a condition are computed; results are checked below'
    ]
    body, names = assignments(program, NUMPY)
    lines += ["        " + line for line in body]
    for k, output in enumerate(program.outputs.values()):
        lines.append(f"        out{k} = np.empty((*lead, {len(output.ids)}))")
        lines += [f"        out{k}[..., {j}] = {names[i]}" for j, i in enumerate(output.ids)]
    answers = []
    for k, (title, output) in enumerate(program.outputs.items()):
        lines.append(f"    if not np.isfinite(out{k}).all():")
        lines.append(f'        raise FloatingPointError("{comment(title)} is not finite")')
        answers.append(f"out{k}.reshape((*lead, {', '.join(str(n) for n in output.shape)}))".replace(", ))", ",))"))
    lines.append(f"    return {', '.join(answers)}")
    return "\n".join(lines) + "\n"


def _arguments(groups: list[tuple[str, str, tuple[str, ...]]], parameters: bool) -> str:
    """The parameters of the function; the last ones have a default if they may be omitted."""
    words: list[str] = []
    optional = True
    for c, group, entries in reversed(groups):
        default = {"p": "PARAMETERS" if parameters else None, "t": "0.0"}.get(group) if entries else "()"
        optional = optional and default is not None
        words.append(f"{c}={default}" if optional else c)
    return ", ".join(reversed(words))


def _docstring(program: Program, groups: list[tuple[str, str, tuple[str, ...]]]) -> list[str]:
    lines = ['    """Arrays of shape (..., n); leading dimensions are broadcast.', ""]
    for c, group, entries in groups:
        shown = ", ".join(comment(e) for e in entries[:20]) + (", ..." if len(entries) > 20 else "")
        shape = "(...)" if is_scalar(group, entries) else f"(..., {len(entries)})"
        lines.append(f"    {c}: {shape} {shown}".rstrip())
    for title, output in program.outputs.items():
        lines.append(f"    returns {comment(title)}: (...{''.join(f', {n}' for n in output.shape)})")
    return [*lines, '    """']


def _preparation(program: Program, groups: list[tuple[str, str, tuple[str, ...]]]) -> list[str]:
    """Conversion to float arrays, a check of the last axis, and the common leading shape."""
    lines, leads = [], []
    for c, group, entries in groups:
        lines.append(f"    {c} = np.asarray({c}, dtype=float)")
        if is_scalar(group, entries):
            lines.append(f"    {c} = {c}[..., np.newaxis]")
        lines.append(f"    if {c}.shape[-1:] != ({len(entries)},):")
        lines.append(f'        raise ValueError(f"{c} must have shape (..., {len(entries)}), not {{{c}.shape}}")')
        leads.append(f"{c}.shape[:-1]")
    lines.append(f"    lead = np.broadcast_shapes({', '.join(leads)})")
    return lines
