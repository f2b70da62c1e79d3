"""Exports a Program as C99: one source file and its header, without allocation, using only ``math.h``."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .emit import Chunk, Plan, plan
from .labels import comment, identifier, word
from .tape import FLAGS, LEAVES, Op, Tape, lower, operands

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
LIBRARY = frozenset({"sqrt", "sin", "cos", "exp", "log", "asin", "acos", "atan", "atan2", "pow"}) | {
    kind + "h" for kind in ("sin", "cos", "tan", "asin", "acos", "atan")
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
    writer = _Writer(
        tape,
        plan(tape),
        function,
        places=[f"{c}[{k}]" for c, _, entries in inputs for k in range(len(entries))],
        targets=[f"{c}[{k}]" for c, _, out in outputs for k in range(len(out.ids))],
        arguments=(arguments, [c for c, _, _ in inputs] + [c for c, _, _ in outputs]),
    )
    source = [f"/* {comment(program.name)} */", f'#include "{function}.h"', "", "#include <math.h>", ""]
    source += writer.functions(signature)
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


class _Writer:
    """Prints a tape as C statements, in several functions if it is long; these pass values on in an array."""

    def __init__(
        self,
        tape: Tape,
        cut: Plan,
        function: str,
        *,
        places: list[str],
        targets: list[str],
        arguments: tuple[list[str], list[str]],
    ) -> None:
        self.tape, self.cut, self.function, self.places = tape, cut, function, places
        self.declared, self.passed = arguments
        self.targets: dict[int, list[str]] = {}
        for i, target in zip(tape.outputs, targets, strict=True):
            self.targets.setdefault(i, []).append(target)

    def functions(self, signature: str) -> list[str]:
        """The whole source after its includes."""
        unused = [f"  (void){name};" for name in self.passed]
        chunks = self.cut.chunks
        if len(chunks) == 1:
            return [signature, "{", *unused, *self.statements(chunks[0]), *self.leaves(), "}"]
        lines: list[str] = []
        calls = [f"  double w[{max(1, self.cut.scratch)}];"]
        for k, chunk in enumerate(chunks):
            head = f"static void part_{k}({', '.join([*self.declared, 'double *w'])})"
            lines += [head, "{", *unused, "  (void)w;", *self.statements(chunk), "}", ""]
            calls.append(f"  part_{k}({', '.join([*self.passed, 'w'])});")
        return [*lines, signature, "{", *calls, *self.leaves(), "}"]

    def statements(self, chunk: Chunk) -> list[str]:
        """The assignments of one chunk."""
        ops, lines, here = self.tape.ops, [], set(chunk.members)
        for i in chunk.members:
            op = ops[i]
            kind = "int" if op[0] in FLAGS else "double"
            lines.append(f"  const {kind} x{i} = {self.expression(op, here)};")
            if i in chunk.written:
                lines.append(f"  w[{chunk.written[i]}] = x{i};")
            lines += [f"  {target} = x{i};" for target in self.targets.get(i, ())]
        return lines

    def leaves(self) -> list[str]:
        """Outputs that are inputs or constants."""
        found = []
        for i, targets in self.targets.items():
            if self.tape.ops[i][0] in LEAVES:
                found += [f"  {target} = {self.operand(i, frozenset())};" for target in targets]
        return found

    def expression(self, op: Op, here: set[int] | frozenset[int]) -> str:
        """One operation."""
        words = [self.operand(k, here) for k in operands(op)]
        if op[0] in LIBRARY:
            return f"{op[0]}({', '.join(words)})"
        return INFIX[op[0]].format(*words)

    def operand(self, i: int, here: set[int] | frozenset[int]) -> str:
        """An entry as an operand: a local variable, an element of an argument, a number, or a value passed on."""
        op = self.tape.ops[i]
        if op[0] == "const":
            return literal(op[1])
        if op[0] == "in":
            return self.places[op[1]]
        if i in here:
            return f"x{i}"
        kept = f"w[{self.cut.slots[i]}]"
        return f"({kept} != 0.0)" if op[0] in FLAGS else kept


def literal(x: float) -> str:
    """A literal that is read back exactly as the same double; negative ones are in parentheses."""
    if math.isnan(x):
        return "NAN"
    text = "INFINITY" if math.isinf(x) else repr(float(abs(x)))
    return f"(-{text})" if math.copysign(1.0, x) < 0 else text
