"""Exports a Program as a Python function that uses only NumPy and is vectorized over leading dimensions."""

from __future__ import annotations

import keyword
import math
from typing import TYPE_CHECKING

from lagrangian.graph import operands, reached

from .arguments import is_scalar
from .labels import comment, identifier, word
from .tape import Op

if TYPE_CHECKING:
    from lagrangian.graph import Program

WIDTH = 88  # a node that is used once is written inside the expression that uses it if the line stays this short

# operation → (text, its precedence, the precedence that each operand needs); 9 is an atom
INFIX: dict[str, tuple[str, int, tuple[int, ...]]] = {
    "add": ("{0} + {1}", 4, (4, 5)),
    "sub": ("{0} - {1}", 4, (4, 5)),
    "mul": ("{0}*{1}", 5, (5, 6)),
    "div": ("{0}/{1}", 5, (5, 6)),
    "neg": ("-{0}", 6, (6,)),
    "pow": ("{0}**{1}", 7, (8, 8)),
    "lt": ("{0} < {1}", 1, (2, 2)),
    "le": ("{0} <= {1}", 1, (2, 2)),
    "eq": ("{0} == {1}", 1, (2, 2)),
    "and": ("{0} & {1}", 2, (3, 3)),
    "or": ("{0} | {1}", 2, (3, 3)),
    "not": ("~{0}", 6, (8,)),
}
CALLS = {
    "sqrt": "sqrt", "sin": "sin", "cos": "cos", "tan": "tan", "asin": "arcsin", "acos": "arccos", "atan": "arctan",
    "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "asinh": "arcsinh", "acosh": "arccosh", "atanh": "arctanh",
    "exp": "exp", "log": "log", "abs": "abs", "sign": "sign", "atan2": "arctan2", "min": "minimum", "max": "maximum",
    "select": "where",
}  # fmt: skip


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
    parameters = _parameters(program)
    lines += [*parameters, "", f"def {function}({_arguments(groups, bool(parameters))}):"]
    lines += _docstring(program, groups)
    lines += _preparation(program, groups)
    lines += [
        '    with np.errstate(all="ignore"):  # both sides of a condition are computed; results are checked below'
    ]
    body, names = _body(program)
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


def _parameters(program: Program) -> list[str]:
    """The declared values of the parameters as a constant, if all are known."""
    entries = program.inputs.get("p", ())
    values = [program.defaults.get(e) for e in entries]
    if not entries or None in values:
        return []
    rows = [f"    {float(x)!r},  # {comment(e)}" for e, x in zip(entries, values, strict=True) if x is not None]
    return ["PARAMETERS = (", *rows, ")", ""]


def _arguments(groups: list[tuple[str, str, tuple[str, ...]]], parameters: bool) -> str:
    """The parameters of the function; the last ones have a default if they may be omitted."""
    words: list[str] = []
    optional = True
    for c, group, entries in reversed(groups):
        default = "()" if not entries else "PARAMETERS" if group == "p" and parameters else None
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


def _body(program: Program) -> tuple[list[str], dict[int, str]]:
    """The assignments, and the text for each output node."""
    nodes = program.graph.nodes
    wanted = program.ids
    uses: dict[int, int] = {}
    order = reached(program.graph, wanted)
    for i in (*wanted, *(k for j in order for k in operands(nodes[j]))):
        uses[i] = uses.get(i, 0) + 1
    letters = {g: identifier("in_", g, k) for k, g in enumerate(program.inputs)}
    text: dict[int, tuple[str, int]] = {}
    lines: list[str] = []
    for i in order:
        node = nodes[i]
        words = _expression(node, text, letters)
        remark = ""
        if node[0] == "input":
            remark = f"  # {comment(program.inputs[node[1]][node[2]])}"
        elif node[0] == "const" or (uses[i] == 1 and len(words[0]) <= WIDTH // 2):
            text[i] = words
            continue
        lines.append(f"x{i} = {words[0]}{remark}")
        text[i] = (f"x{i}", 9)
    return lines, {i: text[i][0] for i in wanted}


def _expression(node: Op, text: dict[int, tuple[str, int]], letters: dict[str, str]) -> tuple[str, int]:
    """The text of a node, and its precedence."""
    kind = node[0]
    if kind == "const":
        return _literal(node[1])
    if kind == "input":
        return f"{letters[node[1]]}[..., {node[2]}]", 9
    if kind == "powi":
        return f"{_within(text[node[1]], 8)}**{node[2]}", 7
    if kind in CALLS:
        return f"np.{CALLS[kind]}({', '.join(text[k][0] for k in node[1:])})", 9
    form, tightness, needs = INFIX[kind]
    return form.format(*(_within(text[k], need) for k, need in zip(node[1:], needs, strict=True))), tightness


def _within(words: tuple[str, int], need: int) -> str:
    return words[0] if words[1] >= need else f"({words[0]})"


def _literal(x: float) -> tuple[str, int]:
    if math.isnan(x):
        return "np.nan", 9
    words = "np.inf" if math.isinf(x) else repr(float(abs(x)))
    return (f"-{words}", 6) if math.copysign(1.0, x) < 0 else (words, 9)
