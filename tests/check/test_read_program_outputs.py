"""What programs print of known equations is read back.

Oracle: the equations of built-in systems, printed by SymPy in the spelling of each program. Each has a wrong twin.
"""

from __future__ import annotations

from collections.abc import Sequence

import pytest
import sympy as sp
from program_outputs import SHAPES, drawings, solutions

from built_in import derivation


def equations(name: str, factor: int) -> tuple[list[sp.Eq], list[sp.Expr]]:
    """The equations of a system and its accelerations; the first term of the last has a ``factor``."""
    own = derivation(name)
    found = [sp.Eq(e.lhs, e.rhs, evaluate=False) for e in own.equations]
    more = (factor - 1) * sp.Add.make_args(sp.expand(found[-1].lhs))[0]
    found[-1] = sp.Eq(found[-1].lhs + more, found[-1].rhs, evaluate=False)
    return found, [c.symbol.diff(sp.Symbol("t"), 2) for c in own.model.coordinates]


def are_read(name: str, right: str, wrong: str) -> None:
    judge = derivation(name)
    assert judge.check(right, hint=0).right, right
    assert not judge.check(wrong, hint=0).right, wrong


def printed(shape: str, name: str, factor: int) -> str:
    write, together = SHAPES[shape]
    rows: Sequence[str] = [write(e) for e in equations(name, factor)[0]]
    return together(rows)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("shape", SHAPES)
def test_equations_that_a_program_prints_are_read(shape: str) -> None:
    are_read("cart-pole", printed(shape, "cart-pole", 1), printed(shape, "cart-pole", 3))


@pytest.mark.slow
def test_solutions_and_matrices_that_a_program_prints_are_read() -> None:
    right, wrong = (solutions(*equations("cart-pole", factor)) for factor in (1, 3))
    for shape, text in right.items():
        are_read("cart-pole", text, wrong[shape])


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["pendulum", "cart-pole"])
def test_equations_that_a_program_draws_in_a_session_are_read(name: str) -> None:
    right, wrong = (drawings(equations(name, factor)[0]) for factor in (1, 3))
    for program, text in right.items():
        are_read(name, text, wrong[program])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["double-pendulum", "lecture-3b", "elastic-pendulum", "atwood"])
def test_equations_of_others_are_read(name: str) -> None:
    for shape in SHAPES:
        are_read(name, printed(shape, name, 1), printed(shape, name, 3))
