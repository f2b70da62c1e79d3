"""Guards: where a divisor is nothing but rounding, one beyond all numbers stands for it, ``select(c, d, 1e150)``.

They are no kinks and no jumps. Where the motion satisfies its rows, a result changes at a guard by rounding alone, and
within a step its condition c does not change.
"""

from __future__ import annotations

from lagrangian.graph import Program, reached

UNBOUNDED = 1e150
"""Divisors from here on stand for none: the quotient is 0 to every purpose."""


def guards(program: Program) -> tuple[set[int], set[int]]:
    """The nodes of a program that guard a divisor, and their conditions."""
    g = program.graph
    live = [i for i in reached(g, program.ids) if g.nodes[i][0] == "select" and g.nodes[g.nodes[i][1]][0] == "lt"]
    found = {i for i in live if abs(g.value(g.nodes[i][3]) or 0.0) >= UNBOUNDED}
    return found, {g.nodes[i][1] for i in found}
