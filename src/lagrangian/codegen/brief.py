"""A Program as JavaScript in few characters, for pages: what is used once stands where it is used, and the other values
share short variables, each of which is free again after its last reader.

The operations are those of `to_javascript`, so the numbers are the same.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import chain, product
from string import ascii_letters
from typing import TYPE_CHECKING

from .arguments import is_scalar
from .emit import Chunk, Plan, plan
from .javascript import JAVASCRIPT, POWER, RESERVED, names_function, not_finite
from .statements import Statements
from .tape import Op, Tape, lower, operands

if TYPE_CHECKING:
    from lagrangian.graph import Program

LOOSE, SUM, PRODUCT, TIGHT = range(4)
"""How tightly an expression holds together."""

NEEDED = {
    "add": (SUM, PRODUCT), "sub": (SUM, PRODUCT), "mul": (PRODUCT, TIGHT), "div": (PRODUCT, TIGHT), "neg": (TIGHT,),
    "fma": (PRODUCT, TIGHT, PRODUCT), "fms": (PRODUCT, TIGHT, PRODUCT), "fnma": (PRODUCT, TIGHT, SUM),
    "select": (TIGHT, TIGHT, TIGHT), "lt": (SUM, SUM), "le": (SUM, SUM), "eq": (SUM, SUM),
    "and": (TIGHT, TIGHT), "or": (TIGHT, TIGHT), "not": (TIGHT,),
} | dict.fromkeys(JAVASCRIPT.library, (LOOSE, LOOSE))  # fmt: skip
"""How tightly operands have to hold together without parentheses. The operations that are missing repeat operands."""

HOLDS = (
    {"mul": PRODUCT, "div": PRODUCT}
    | dict.fromkeys(("add", "sub", "fma", "fms", "fnma"), SUM)
    | dict.fromkeys(JAVASCRIPT.library, TIGHT)
)
"""How tightly operations hold together; the others are loose."""

LARGEST = 30
"""The most operations in one expression."""

SHORT = replace(JAVASCRIPT, infix={kind: text.replace(" ", "") for kind, text in JAVASCRIPT.infix.items()})


def brief_javascript(program: Program, *, name: str, checked: bool = True) -> str:
    """JavaScript source of ``program`` with the arguments and results of `to_javascript`, without comments."""
    if not names_function(name):
        raise ValueError(f"{name!r} cannot name a function of JavaScript")
    tape = lower(program, hoist=()).body
    names = list(_names())
    out, *arguments = names[: len(program.inputs) + 1]
    given = list(zip(arguments, program.inputs.items(), strict=True))
    places = [c if is_scalar(g, x) else f"{c}[{k}]" for c, (g, x) in given for k in range(len(x))]
    targets = [f"{out}[{k}]" for k in range(len(tape.outputs))]
    writer = _Brief(tape, plan(tape), places, targets, names[len(given) + 1 :])
    lines = [f"function {name}({','.join(arguments)},{out}=new Float64Array({len(targets)})){{"]
    if any(op[0] == "pow" for op in tape.ops):
        lines.append(POWER)
    chunks = writer.cut.chunks
    if len(chunks) == 1:
        lines += writer.statements(chunks[0])
    else:
        lines.append(f"const w=new Float64Array({max(1, writer.cut.scratch)});")
        for chunk in chunks:  # functions within: engines compile short ones better
            lines += ["(()=>{", *writer.statements(chunk), "})();"]
    lines += writer.leaves()
    if checked:
        lines.append(not_finite(program, out))
    return "\n".join([*lines, f"return {out}}}"]) + "\n"


def _names() -> Iterator[str]:
    """Short names of variables; ``w`` is the array of what is passed on."""
    both = chain(ascii_letters, (a + b for a, b in product(ascii_letters, repeat=2)))
    return (name for name in chain(both, (f"x{k}" for k in range(10_000))) if name not in RESERVED | {"w"})


class _Brief(Statements):
    """Prints chunk by chunk, as `Statements`, with the variables ``names``."""

    def __init__(
        self, tape: Tape, cut: Plan, places: Sequence[str], targets: Sequence[str], names: Sequence[str]
    ) -> None:
        super().__init__(SHORT, tape, cut, places=places, targets=targets)
        self.names = names
        self.within: set[int] = set()
        """What stands where it is used."""
        self.variables: dict[int, str] = {}

    def statements(self, chunk: Chunk) -> list[str]:
        """The variables of one chunk, and its assignments."""
        here = set(chunk.members)
        self.within = self._used_once(chunk, here)
        steps = [i for i in chunk.members if i not in self.within]
        reads = {i: dict.fromkeys(self._reads(i, here)) for i in steps}
        last = {k: i for i in steps for k in reads[i]}
        lines, free, used = list[str](), list[str](), 0
        for i in steps:
            text = self.expression(self.tape.ops[i], here)
            free += [self.variables.pop(k) for k in reads[i] if last[k] == i]
            targets = [*([f"w[{chunk.written[i]}]"] if i in chunk.written else []), *self.targets.get(i, ())]
            if i in last:
                if not free:
                    free.append(self.names[used])
                    used += 1
                self.variables[i] = free.pop()
                targets.insert(0, self.variables[i])
            lines.append("=".join([*targets, text]) + ";")
        return [f"let {','.join(self.names[:used])};", *lines] if used else lines

    def leaves(self) -> list[str]:
        return [line.strip().replace(" = ", "=") for line in super().leaves()]

    def _used_once(self, chunk: Chunk, here: Collection[int]) -> set[int]:
        """What one operation reads once, and nothing else, unless an expression would be too long."""
        ops, found, sizes = self.tape.ops, set[int](), dict[int, int]()
        uses = Counter(k for i in chunk.members for k in operands(ops[i]) if k in here)
        for i in chunk.members:
            sizes[i] = 1
            for k in operands(ops[i]) if ops[i][0] in NEEDED else ():
                if uses[k] == 1 and k not in chunk.written and k not in self.targets and sizes[i] + sizes[k] <= LARGEST:
                    found.add(k)
                    sizes[i] += sizes[k]
        return found

    def _reads(self, i: int, here: Collection[int]) -> Iterator[int]:
        """The variables in the expression of an entry."""
        for k in operands(self.tape.ops[i]):
            if k in self.within:
                yield from self._reads(k, here)
            elif k in here:
                yield k

    def expression(self, op: Op, here: Collection[int]) -> str:
        kind: str = op[0]
        needed = NEEDED.get(kind, (TIGHT,) * 3)
        words = [self._word(k, need, here) for k, need in zip(operands(op), needed, strict=False)]
        if kind in self.dialect.library:
            return f"{self.dialect.library[kind]}({','.join(words)})"
        return self.dialect.infix[kind].format(*words)

    def _word(self, i: int, need: int, here: Collection[int]) -> str:
        """An entry as an operand, in parentheses where it does not hold together as tightly as needed."""
        op = self.tape.ops[i]
        if i in self.within:
            text = self.expression(op, here)
            return text if HOLDS.get(op[0], LOOSE) >= need else f"({text})"
        return self.operand(i, here)

    def operand(self, i: int, here: Collection[int]) -> str:
        if i in here:
            return self.variables[i]
        text = super().operand(i, here)
        return re.sub(r"\.0(?!\d)|\b0(?=\.(?!0\b))", "", text) if self.tape.ops[i][0] == "const" else text
