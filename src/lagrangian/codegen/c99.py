"""Exports a Program as C99: one source file and its header, without allocation, using only ``math.h``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .emit import plan
from .labels import comment, identifier, word
from .statements import Dialect, Statements
from .tape import lower

if TYPE_CHECKING:
    from lagrangian.graph import Program

INFIX = {
    "add": "{0} + {1}",
    "sub": "{0} - {1}",
    "mul": "{0} * {1}",
    "div": "{0} / {1}",
    "neg": "-{0}",
    "fma": "{0} * {1} + {2}",
    "fms": "{0} * {1} - {2}",
    "fnma": "{2} - {0} * {1}",
    "abs": "fabs({0})",
    "min": "({0} <= {1} || {0} != {0}) ? {0} : {1}",
    "max": "({0} >= {1} || {0} != {0}) ? {0} : {1}",
    "sign": "{0} > 0.0 ? 1.0 : ({0} < 0.0 ? -1.0 : {0})",
    "select": "{0} ? {1} : {2}",
    "lt": "{0} < {1}",
    "le": "{0} <= {1}",
    "eq": "{0} == {1}",
    "and": "{0} && {1}",
    "or": "{0} || {1}",
    "not": "!{0}",
}
# C's own names
LIBRARY = {name: name for name in ("sqrt", "sin", "cos", "exp", "log", "asin", "acos", "atan", "atan2", "pow")} | {
    kind + "h": kind + "h" for kind in ("sin", "cos", "tan", "asin", "acos", "atan")
}


def to_c(program: Program, *, name: str | None = None) -> tuple[str, str]:
    """Return C source and header of ``program``: ``void name(const double *in_q, …, double *out_a, …)``.

    There is one argument for each group of inputs, in the program's order, then one for each output, row by row.
    ``name`` is that of the function and the header (``name.h``); by default ``lg_`` and the program's name.
    """
    function = name if name is not None else "lg_" + word(program.name)
    if not (function.isascii() and function.isidentifier()):
        raise ValueError(f"{function!r} is not a plain C identifier")
    tape = lower(program, hoist=()).body
    inputs = [(identifier("in_", g, k), g, entries) for k, (g, entries) in enumerate(program.inputs.items())]
    outputs = [(identifier("out_", o, k), o, out) for k, (o, out) in enumerate(program.outputs.items())]
    arguments = [f"const double *{c}" for c, _, _ in inputs] + [f"double *{c}" for c, _, _ in outputs]
    signature = f"void {function}({', '.join(arguments) or 'void'})"
    writer = Statements(
        _C,
        tape,
        plan(tape),
        places=[f"{c}[{k}]" for c, _, entries in inputs for k in range(len(entries))],
        targets=[f"{c}[{k}]" for c, _, out in outputs for k in range(len(out.ids))],
    )
    source = [f"/* {comment(program.name)} */", f'#include "{function}.h"', "", "#include <math.h>", ""]
    source += _functions(writer, function, signature, arguments, [c for c, _, _ in inputs] + [c for c, _, _ in outputs])
    return "\n".join(source) + "\n", _header(program, function, signature, inputs, outputs)


def _header(program: Program, function: str, signature: str, inputs: list, outputs: list) -> str:
    guard = f"{function.upper()}_H"
    lines = [f"/* {comment(program.name)} */", f"#ifndef {guard}", f"#define {guard}", ""]
    for c, group, entries in inputs:
        lines.append(f"/* {c}: {comment(group)}, {len(entries)} entries")
        for k, entry in enumerate(entries):
            default = program.defaults.get(entry)
            value = f" = {default!r} unless you choose otherwise" if default is not None else ""
            lines.append(f"   [{k}] {comment(entry)}{value}")
        lines[-1] += " */"
    for c, output, out in outputs:
        shape = " x ".join(str(n) for n in out.shape) or "one number"
        lines.append(f"/* {c}: {comment(output)}, {shape}, row by row */")
    lines += [
        "/* The arrays must not overlap. */",
        "",
        "#ifdef __cplusplus",
        'extern "C" {',
        "#endif",
        "",
        f"{signature};",
        "",
    ]
    lines += ["#ifdef __cplusplus", "}", "#endif", "", "#endif"]
    return "\n".join(lines) + "\n"


def _functions(writer: Statements, function: str, signature: str, declared: list[str], passed: list[str]) -> list[str]:
    """The whole source after its includes, in several functions if it is long."""
    unused = [f"  (void){name};" for name in passed]
    chunks = writer.cut.chunks
    if len(chunks) == 1:
        return [signature, "{", *unused, *writer.statements(chunks[0]), *writer.leaves(), "}"]
    lines: list[str] = []
    calls = [f"  double w[{max(1, writer.cut.scratch)}];"]
    for k, chunk in enumerate(chunks):
        head = f"static void {function}_part_{k}({', '.join([*declared, 'double *w'])})"
        lines += [head, "{", *unused, "  (void)w;", *writer.statements(chunk), "}", ""]
        calls.append(f"  {function}_part_{k}({', '.join([*passed, 'w'])});")
    return [*lines, signature, "{", *calls, *writer.leaves(), "}"]


_C = Dialect("const double", "const int", INFIX, LIBRARY, "NAN", "INFINITY")
