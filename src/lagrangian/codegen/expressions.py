"""Prints a Program as assignments of expressions, for languages in which people read and change the source.

A node that is used once is written inside the expression that uses it, as long as the line stays short; every other
node has a name of its own. A `SourceNotation` says how a language writes operators, functions, numbers and inputs.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from lagrangian.graph import operands, reached
from lagrangian.records import dataclass

from .labels import comment, identifier, unit
from .tape import Op

if TYPE_CHECKING:
    from lagrangian.graph import Program

WIDTH = 88
"""The length of a line up to which a node that is used once is written inside an expression."""

ATOM = 9
"""The precedence of a name, a number or a call."""

Written = tuple[str, int]
"""The text of a node, and its precedence."""

Infix = dict[str, tuple[str, int, tuple[int, ...]]]
"""Operation → its text, its precedence, and the precedence that each operand needs."""

SUMS: Infix = {"add": ("{0} + {1}", 4, (4, 5)), "sub": ("{0} - {1}", 4, (4, 5))}
PRODUCTS: Infix = {"mul": ("{0}*{1}", 5, (5, 6)), "div": ("{0}/{1}", 5, (5, 6))}
COMPARISONS: Infix = {
    "lt": ("{0} < {1}", 1, (2, 2)),
    "le": ("{0} <= {1}", 1, (2, 2)),
    "eq": ("{0} == {1}", 1, (2, 2)),
}
BOTH_OR_EITHER: Infix = {"and": ("{0} & {1}", 2, (3, 3)), "or": ("{0} | {1}", 2, (3, 3))}
"""What several languages write alike."""


@dataclass(frozen=True)
class SourceNotation:
    """How a language writes expressions.

    ``calls``: operation → the name of a function. ``power``: a whole power, with its precedence and that of the base.
    ``element`` is the text of an input, of the group's identifier and the entry's number, which counts from ``first``.
    """

    infix: Infix
    calls: Mapping[str, str]
    power: tuple[str, int, int]
    element: str
    first: int
    nan: str
    infinity: str
    assignment: str
    remark: str

    def literal(self, x: float) -> Written:
        """A literal that is read back exactly as the same double."""
        if math.isnan(x):
            return self.nan, ATOM
        words = self.infinity if math.isinf(x) else repr(float(abs(x)))
        return (f"-{words}", self.infix["neg"][1]) if math.copysign(1.0, x) < 0 else (words, ATOM)


def assignments(
    program: Program,
    notation: SourceNotation,
    *,
    places: Mapping[tuple[str, int], str] | None = None,
    named: str = "x",
    inline: Collection[str] = (),
) -> tuple[list[str], dict[int, str]]:
    """Return the assignments, and the text for each output node.

    ``places``: texts for single inputs, by group and number, instead of the notation's ``element``. ``named``: what the
    names begin with. ``inline``: operations that stand where they are read.
    """
    nodes, wanted = program.graph.nodes, program.ids
    uses: dict[int, int] = {}
    order = reached(program.graph, wanted)
    for i in (*wanted, *(k for j in order for k in operands(nodes[j]))):
        uses[i] = uses.get(i, 0) + 1
    letters = {g: identifier("in_", g, k) for k, g in enumerate(program.inputs)}
    text: dict[int, Written] = {}
    lines: list[str] = []
    for i in order:
        node = nodes[i]
        remark = ""
        if node[0] == "input":
            place = (places or {}).get((node[1], node[2]))
            if place is not None:
                text[i] = place, ATOM
                continue
            words = notation.element.format(letters[node[1]], node[2] + notation.first), ATOM
            remark = notation.remark.format(comment(program.inputs[node[1]][node[2]]))
        else:
            words = expression(node, text, notation)
            short = uses[i] == 1 and len(words[0]) <= WIDTH // 2
            if node[0] == "const" or node[0] in inline or short:
                text[i] = words
                continue
        lines.append(notation.assignment.format(f"{named}{i}", words[0]) + remark)
        text[i] = (f"{named}{i}", ATOM)
    return lines, {i: text[i][0] for i in wanted}


def expression(node: Op, text: Mapping[int, Written], notation: SourceNotation) -> Written:
    """The text of a node that is no input, and its precedence."""
    kind = node[0]
    if kind == "const":
        return notation.literal(node[1])
    if kind == "powi":
        form, tightness, need = notation.power
        exponent = str(node[2]) if node[2] >= 0 else f"({node[2]})"
        return form.format(_within(text[node[1]], need), exponent), tightness
    if kind in notation.calls:
        return f"{notation.calls[kind]}({', '.join(text[k][0] for k in node[1:])})", ATOM
    form, tightness, needs = notation.infix[kind]
    return form.format(*(_within(text[k], need) for k, need in zip(node[1:], needs, strict=True))), tightness


def _within(words: Written, need: int) -> str:
    return words[0] if words[1] >= need else f"({words[0]})"


@dataclass(frozen=True)
class SourceArgument:
    """An argument of an exported function: its identifier, its group, and the names of the entries."""

    word: str
    group: str
    entries: tuple[str, ...]

    def described(self, units: Mapping[str, str]) -> str:
        """The first entries with their units."""
        shown = [comment(e) + (f" [{unit(units[e])}]" if units.get(e) else "") for e in self.entries[:20]]
        return ", ".join(shown) + (", ..." if len(self.entries) > 20 else "")


def arguments_of(program: Program) -> tuple[SourceArgument, ...]:
    """One argument for each group of inputs, in the program's order."""
    return tuple(
        SourceArgument(identifier("in_", g, k), g, tuple(x)) for k, (g, x) in enumerate(program.inputs.items())
    )


def signature(program: Program, arguments: Sequence[SourceArgument], joined: str = "=") -> str:
    """The list of arguments; from the end on they may be omitted: inputs and time are 0, parameters as declared."""
    words: list[str] = []
    optional = True
    for x in reversed(arguments):
        default = None
        if x.group == "t" and len(x.entries) == 1:
            default = "0.0"
        elif x.group == "p" and x.entries and None not in [program.defaults.get(e) for e in x.entries]:
            default = "PARAMETERS"
        elif x.group == "u" or not x.entries:
            default = f"({'0.0, ' * len(x.entries)})".replace(", )", ",)" if len(x.entries) == 1 else ")")
        optional = optional and default is not None
        words.append(f"{x.word}{joined}{default}" if optional else x.word)
    return ", ".join(reversed(words))


def declared_values(program: Program) -> list[str]:
    """The declared values of the parameters as a constant, for a language that writes tuples as Python does."""
    entries = program.inputs.get("p", ())
    values = [program.defaults.get(e) for e in entries]
    if not entries or None in values:
        return []
    rows = [f"    {float(x)!r},  # {comment(e)}" for e, x in zip(entries, values, strict=True) if x is not None]
    return ["PARAMETERS = (", *rows, ")"]
