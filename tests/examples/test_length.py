"""The equations are as short as a person would write them."""

from __future__ import annotations

import pytest
import sympy as sp
from derived import derivation, in_plain_symbols
from textbook import BOOK, sides

from built_in import SOME


def operations(name: str) -> int:
    """SymPy's count over all equations, with coordinates, rates and accelerations as plain symbols."""
    d = derivation(name)
    return sum(sp.count_ops(in_plain_symbols(side, d)) for e in d.equations for side in (e.lhs, e.rhs))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("name", "limit"),
    [
        ("double-pendulum", 50),  # SymPy's simplify: 96
        ("double-pendulum-relative", 80),  # 153
        ("triple-pendulum", 130),  # 283
        ("triple-pendulum-relative", 350),  # 704
    ],
)
def test_chains_of_point_masses(name: str, limit: int) -> None:
    assert operations(name) <= limit


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", sorted(BOOK))
def test_equations_are_as_short_as_a_books(name: str) -> None:
    book = sum(sp.count_ops(side) for equation in sides(name) for side in equation)
    assert operations(name) <= 1.3 * book
