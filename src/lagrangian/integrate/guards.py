"""Guards: where a divisor is nothing but rounding, one beyond all numbers stands for it, ``select(c, d, 1e150)``.

They are no kinks and no jumps. Where the motion satisfies its rows, a result changes at a guard by rounding alone, and
within a step its condition c does not change.
"""

from __future__ import annotations

from lagrangian.graph import Graph, Program, operands, reached

UNBOUNDED = 1e150
"""Divisors from here on stand for none: the quotient is 0 to every purpose."""


def guards(program: Program) -> tuple[set[int], set[int]]:
    """The nodes of a program that guard a divisor, and the nodes that only decide their conditions."""
    g = program.graph
    live = [i for i in reached(g, program.ids) if g.nodes[i][0] == "select" and g.nodes[g.nodes[i][1]][0] in DECIDES]
    found = {i for i in live if abs(g.value(g.nodes[i][3]) or 0.0) >= UNBOUNDED}
    return found, set[int]().union(*(_deciding(g, g.nodes[i][1]) for i in found))


DECIDES = frozenset({"lt", "select"})
"""The kinds of nodes that a condition begins with."""


def _deciding(g: Graph, condition: int) -> set[int]:
    """A condition and the conditions that it is chosen by, counts of conditions among them."""
    found, waiting = set[int](), [condition]
    while waiting:
        i = waiting.pop()
        node = g.nodes[i]
        if i not in found and (node[0] in DECIDES or (node[0] == "add" and _counts(g, i))):
            found.add(i)
            waiting += [k for k in operands(node) if node[0] != "lt" or _counts(g, k)]
    return found


def _counts(g: Graph, i: int) -> bool:
    """Whether a node is a number of conditions that hold."""
    node = g.nodes[i]
    if node[0] == "select":
        return all(g.value(k) is not None for k in node[2:])
    return node[0] == "add" and all(g.value(k) is not None or _counts(g, k) for k in operands(node))
