"""Balances of bodies whose errors cancel are not called right line by line.

Oracle: a cart with a rod by Newton and Euler; a weight, or a mass, of one body stands in the line of the other.
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


@pytest.mark.sampled(4)
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


@pytest.mark.sampled(4)
@pytest.mark.parametrize("more", ["m g", "2 m g"])
@pytest.mark.parametrize("results", [True, False])
def test_balances_that_cancel_are_not_called_right(more: str, results: bool) -> None:
    up = f"{UP} + {more}" if more == "2 m g" else UP.replace(" - m g", "")
    turning = TURNING.replace("N", "(N + m g)") if more == "m g" else TURNING.replace("N", "(N + 2 m g)")
    verdict = rod().check(written({UP: up, TURNING: turning}, results=results))
    assert verdict.right
    assert not right_lines(verdict) & {3, 4}
    assert any("one by one: together they are right" in str(n) for n in verdict.notes)


def test_a_force_at_the_joint_may_be_counted_to_either_body() -> None:
    change = {CART: "M x'' = F + H", ACROSS: f"{ACROSS} - b x'", TURNING: TURNING.replace("H", "(H + b x')")}
    verdict = rod().check(written(change))
    assert verdict.right
    assert not any("one by one" in str(n) for n in verdict.notes)


def test_a_mass_in_the_line_of_the_other_body_is_not_right() -> None:
    change = {CART: CART.replace("M", "m"), ACROSS: ACROSS.replace("m (x'' +", "M x'' + m (")}
    verdict = rod().check(written(change))
    assert not verdict.right
    assert not right_lines(verdict) & {1, 2}
