"""Step 0 for systems with constraints: which rows say something, holonomic or not, and which integrals they have.

`pfaffian` takes rows into the graph, `spans` decides ranks there, `elimination` solves rows for rates, `rows` finds
what is redundant or contradictory, `brackets` counts the directions that brackets add, `integrals` looks for f = c,
`verdict` puts it together.
"""

from lagrangian.derive.constraints.verdict import Holonomy, Integral, RedundantRow, judge

__all__ = ["Holonomy", "Integral", "RedundantRow", "judge"]
