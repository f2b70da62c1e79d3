"""Step 0 for systems with constraints: independent rows, holonomic or nonholonomic, and integrals of the rows.

`pfaffian` converts rows to nodes of the graph, `spans` decides ranks there, `elimination` solves rows for rates, `rows`
finds redundant and contradictory rows, `brackets` counts the directions that brackets add, `integrals` looks for
surfaces f = constant, and `verdict` combines all this.
"""

from lagrangian.derive.constraints.verdict import Holonomy, Integral, RedundantRow, judge

__all__ = ["Holonomy", "Integral", "RedundantRow", "judge"]
