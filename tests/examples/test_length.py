"""The equations are as short as a person would write them."""

from __future__ import annotations

import pytest
import sympy as sp
from derived import derivation, in_plain_symbols


def operations(name: str) -> int:
    """SymPy's count over all equations, with coordinates, rates and accelerations as plain symbols."""
    d = derivation(name)
    return sum(sp.count_ops(in_plain_symbols(side, d)) for e in d.equations for side in (e.lhs, e.rhs))


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


# As a book prints them, counted by hand from the closed forms of the oracle.
@pytest.mark.parametrize(
    ("name", "limit"),
    [
        ("lecture-1", 15),
        ("lecture-3a", 10),
        ("lecture-3b", 9),
        ("pendulum", 9),
        ("cart-pole", 28),
        ("elastic-pendulum", 23),
        ("spherical-pendulum", 26),
        ("bead-on-hoop", 14),
        ("atwood", 8),
        ("swinging-atwood", 26),
        ("wedge", 14),
        ("rolling-cylinder", 7),
        ("bead-on-parabola", 18),
        ("duffing", 13),
        ("kapitza-pendulum", 19),
    ],
)
def test_textbook_systems(name: str, limit: int) -> None:
    assert operations(name) <= limit
