"""A tape as statements of a language with C's operators: C itself, and JavaScript."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

from lagrangian.records import dataclass

from .emit import Chunk, Plan
from .tape import FLAGS, LEAVES, Op, Tape, operands


@dataclass(frozen=True)
class Dialect:
    """A language: how numbers and truth values are declared, operators and functions, and what has no digits."""

    number: str
    flag: str
    infix: Mapping[str, str]
    library: Mapping[str, str]
    nan: str
    infinity: str

    def literal(self, x: float) -> str:
        """A literal that is read back exactly as the same double; negative ones are in parentheses."""
        if math.isnan(x):
            return self.nan
        text = self.infinity if math.isinf(x) else repr(float(abs(x)))
        return f"(-{text})" if math.copysign(1.0, x) < 0 else text


class Statements:
    """Prints a tape chunk by chunk; values that a later chunk needs are passed on in the array ``w``.

    ``places`` are the texts for the input slots, ``targets`` those to which the outputs are assigned.
    """

    def __init__(
        self, dialect: Dialect, tape: Tape, cut: Plan, *, places: Sequence[str], targets: Sequence[str]
    ) -> None:
        self.dialect, self.tape, self.cut, self.places = dialect, tape, cut, places
        self.targets: dict[int, list[str]] = {}
        for i, target in zip(tape.outputs, targets, strict=True):
            self.targets.setdefault(i, []).append(target)

    def statements(self, chunk: Chunk) -> list[str]:
        """The assignments of one chunk."""
        ops, lines, here = self.tape.ops, [], set(chunk.members)
        for i in chunk.members:
            op = ops[i]
            kind = self.dialect.flag if op[0] in FLAGS else self.dialect.number
            lines.append(f"  {kind} x{i} = {self.expression(op, here)};")
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

    def expression(self, op: Op, here: Collection[int]) -> str:
        """One operation."""
        kind: str = op[0]
        words = [self.operand(k, here) for k in operands(op)]
        if kind in self.dialect.library:
            return f"{self.dialect.library[kind]}({', '.join(words)})"
        return self.dialect.infix[kind].format(*words)

    def operand(self, i: int, here: Collection[int]) -> str:
        """An entry as an operand: a local variable, an element of an argument, a number, or a value passed on."""
        op = self.tape.ops[i]
        if op[0] == "const":
            return self.dialect.literal(op[1])
        if op[0] == "in":
            return str(self.places[op[1]])
        if i in here:
            return f"x{i}"
        kept = f"w[{self.cut.slots[i]}]"
        return f"({kept} != 0.0)" if op[0] in FLAGS else kept
