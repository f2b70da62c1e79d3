"""Balances of bodies whose errors cancel are not called right line by line.

Oracle: a cart with a rod by Newton and Euler; a known force, or a mass, of one body stands in the line of the other.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg

CART = "M x'' = F - b x' + H"
ACROSS = "m (x'' + l theta'' cos(theta) - l theta'^2 sin(theta)) = -H"
UP = "m (l theta'' sin(theta) + l theta'^2 cos(theta)) = N - m g"
TURNING = "J theta'' = H l cos(theta) - N l sin(theta)"
BALANCES = "\n".join((CART, ACROSS, UP, TURNING))
RESULTS = """(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F
(J + m l^2) theta'' + m l x'' cos(theta) + m g l sin(theta) = 0"""
MOVED = {CART: "M x'' = F + H", ACROSS: f"{ACROSS} - b x'"}
"""The damper of the cart in the line of the rod."""
NOTE = "were not judged"


@cache
def rod() -> lg.Derivation:
    """A cart with a damper, and a rod that hangs from it."""
    s = lg.System("cart with a rod")
    x, th = s.coordinates("x theta")
    M, m, l_, g, b, J = s.parameters("M m l g b J")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    tip = s.point("P", (x + l_ * sp.sin(th), -l_ * sp.cos(th)))
    s.rigid_body(mass=m, inertia=J, at=tip, frame=s.frame(th, name="rod"), name="rod")
    s.gravity((0, -1), g)
    s.damper(b, deflection=x)
    s.force(s.input("F"), deflection=x)
    return s.derive()


def written(*changes: dict[str, str], results: bool = True) -> str:
    """The answer with some balances changed."""
    answer = f"{BALANCES}\n{RESULTS}" if results else BALANCES
    for change in changes:
        for old, new in change.items():
            answer = answer.replace(old, new)
    return answer


def right_lines(verdict: lg.CheckedAnswer) -> set[int]:
    return {f.line.number for f in verdict.findings if f.status.right}


@pytest.mark.parametrize(
    "change",
    [
        {},
        {"-N": "N", " N": " -N"},
        {"+ H": "- H", "= -H": "= H", "= H l cos": "= -H l cos"},
        {"H": "2*H", "= H": "= 2*H"},
    ],
)
def test_right_balances_in_either_sense_are_judged(change: dict[str, str]) -> None:
    verdict = rod().check(written(change))
    assert verdict.right, str(verdict)
    assert not any("one by one" in str(n) for n in verdict.notes)


@pytest.mark.parametrize(
    ("change", "lines"),
    [
        ({**MOVED, TURNING: TURNING.replace("H", "(H + b x')")}, {1, 2, 4}),
        ({UP: UP.replace(" - m g", ""), TURNING: TURNING.replace("N", "(N + m g)")}, {3, 4}),
    ],
)
@pytest.mark.parametrize("results", [True, False])
def test_balances_that_cancel_are_not_called_right(change: dict[str, str], lines: set[int], results: bool) -> None:
    verdict = rod().check(written(change, results=results))
    assert verdict.right
    assert not right_lines(verdict) & lines
    assert any("one by one: together they are right" in str(n) for n in verdict.notes)


def test_two_balances_that_cancel_are_not_right_beside_one_that_does_not_fit() -> None:
    verdict = rod().check(written(MOVED))
    assert not verdict.right
    assert right_lines(verdict) == {3, 5, 6}
    assert "Lines 1, 2 and 4, which have H, N, do not agree" in str(verdict.mistakes[0].what)


def test_a_mass_in_the_line_of_the_other_body_is_not_right() -> None:
    change = {CART: CART.replace("M", "m"), ACROSS: ACROSS.replace("m (x'' +", "M x'' + m (")}
    verdict = rod().check(written(change))
    assert not verdict.right
    assert not right_lines(verdict) & {1, 2}
