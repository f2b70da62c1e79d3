"""Guards of pivots are known to the integrators: no kinks, no jumps."""

from __future__ import annotations

import built_in
from lagrangian import dynamics
from lagrangian.dynamics.guard import UNBOUNDED as GIVEN
from lagrangian.graph import reached
from lagrangian.integrate.guards import UNBOUNDED, guards


def test_what_stands_for_no_divisor_is_known_as_such() -> None:
    """`dynamics` and `integrate` do not import each other: the number is said in both."""
    assert UNBOUNDED == GIVEN


def test_every_guard_of_a_linkage_is_found() -> None:
    program = dynamics.rhs(built_in.system("double-parallelogram").model)
    found, conditions = guards(program)
    selects = {i for i in reached(program.graph, program.ids) if program.graph.nodes[i][0] == "select"}
    assert found and selects == found and len(conditions) <= len(found)
