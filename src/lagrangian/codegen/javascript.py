"""Exports a Program as JavaScript: one function on arrays, without imports, for browsers, workers and Node.

Identifiers are our own, and names given by users appear only in comments, in characters that can neither end a comment
nor a script element of a page.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from .arguments import is_scalar
from .c99 import INFIX
from .emit import plan
from .labels import comment, identifier, word
from .statements import Dialect, Statements
from .tape import lower

if TYPE_CHECKING:
    from lagrangian.graph import Program

LIBRARY = {
    name: f"Math.{name}"
    for name in (
        "sqrt", "sin", "cos", "exp", "log", "asin", "acos", "atan", "atan2",
        "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "abs",
    )
} | {"pow": "power"}  # fmt: skip

RESERVED = frozenset((
    "arguments", "await", "break", "case", "catch", "class", "const", "continue", "debugger", "default",
    "delete", "do", "else", "enum", "eval", "export", "extends", "false", "finally", "for", "function", "if",
    "implements", "import", "in", "instanceof", "interface", "let", "new", "null", "package", "private",
    "protected", "public", "return", "static", "super", "switch", "this", "throw", "true", "try", "typeof",
    "undefined", "var", "void", "while", "with", "yield",
))  # fmt: skip
"""Words that cannot name a function."""

POWER = (
    "const power = (x, y) => "
    "(x === 1 || (x === -1 && Math.abs(y) === Infinity) ? 1 : Math.pow(x, y)); // as in C, also where y is NaN"
)


def to_javascript(
    program: Program, *, name: str | None = None, checked: bool = True, units: Mapping[str, str] | None = None
) -> str:
    """JavaScript source of ``program``: ``function name(in_q, in_v, …, out) → out``.

    There is one array for each group of inputs in the program's order (time is a number), and ``out`` is a Float64Array
    that holds all outputs, one after another, row by row; without it a new one is made. ``name`` is that of the
    function; by default ``lg_`` and the program's name. ``checked``: the function throws a RangeError if an output is
    not finite. ``units``: the units of entries, by name, for the comment.
    """
    function = name if name is not None else "lg_" + word(program.name)
    if not names_function(function):
        raise ValueError(f"{function!r} cannot name a function of JavaScript")
    tape = lower(program, hoist=()).body
    inputs = [(identifier("in_", g, k), g, entries) for k, (g, entries) in enumerate(program.inputs.items())]
    total = len(tape.outputs)
    places = [c if is_scalar(g, entries) else f"{c}[{k}]" for c, g, entries in inputs for k in range(len(entries))]
    writer = Statements(JAVASCRIPT, tape, plan(tape), places=places, targets=[f"out[{k}]" for k in range(total)])
    arguments = [c for c, _, _ in inputs]
    head = f"function {function}({', '.join([*arguments, f'out = new Float64Array({total})'])}) {{"
    lines = [*_comment(program, inputs, units or {})]
    body, chunks = [], writer.cut.chunks
    if any(op[0] == "pow" for op in tape.ops):
        body.append("  " + POWER)
    if len(chunks) == 1:
        body += writer.statements(chunks[0])
    else:
        body.append(f"  const w = new Float64Array({max(1, writer.cut.scratch)});")
        for k, chunk in enumerate(chunks):  # functions within: engines compile short ones better
            body += [f"  const part_{k} = () => {{", *("  " + x for x in writer.statements(chunk)), "  };"]
        body += [f"  part_{k}();" for k in range(len(chunks))]
    body += writer.leaves()
    if checked:
        body.append("  " + not_finite(program, "out"))
    return "\n".join([*lines, head, *body, "  return out;", "}"]) + "\n"


def not_finite(program: Program, out: str) -> str:
    """The statement that throws an error if an entry of the array ``out`` is not finite."""
    return (
        f'if (!{out}.every(Number.isFinite)) throw new RangeError("{comment(program.name)}: a result is not finite");'
    )


def names_function(name: str) -> bool:
    """Whether a function can have this name: letters, digits and underscores, and not a word of the language."""
    return name.isascii() and name.isidentifier() and name not in RESERVED


def _comment(program: Program, inputs: list[tuple[str, str, tuple[str, ...]]], units: Mapping[str, str]) -> list[str]:
    """What the function computes, and the order of its arguments and results."""
    lines = [f"/* {comment(program.name)}"]
    for c, group, entries in inputs:
        if is_scalar(group, entries):
            lines.append(f"   {c}: time, a number [s]")
            continue
        lines.append(f"   {c}: {comment(group)}, {len(entries)} {'entry' if len(entries) == 1 else 'entries'}")
        for k, entry in enumerate(entries):
            default = program.defaults.get(entry)
            value = f" = {default!r} unless you choose otherwise" if default is not None else ""
            unit = f" [{comment(units[entry])}]" if units.get(entry) else ""
            lines.append(f"     [{k}] {comment(entry)}{unit}{value}")
    at = 0
    for title, output in program.outputs.items():
        shape = " x ".join(str(n) for n in output.shape)
        what = f"{shape}, row by row" if len(output.shape) > 1 else f"{shape} numbers" if shape else "one number"
        lines.append(f"   out[{at}]{f' to out[{at + len(output.ids) - 1}]' if shape else ''}: {comment(title)}, {what}")
        at += len(output.ids)
    return [*lines[:-1], lines[-1] + " */"]


JAVASCRIPT = Dialect("const", "const", {k: v for k, v in INFIX.items() if k != "abs"}, LIBRARY, "NaN", "Infinity")
