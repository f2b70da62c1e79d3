"""Friction that a row presses on where a smooth system is needed: refused with the regimes that help, which then do."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg

G = 9.81


def bead(mu: Any = 0.3, *, unit: str | None = None, angle: bool = False) -> lg.System:
    """A bead on a straight rough rod, in x and y; the slope is 0.6."""
    s = lg.System("bead")
    x, y = (s.coordinate(name, unit=unit) for name in "xy")
    m, a, k = s.parameters("m alpha mu", m="2 kg", alpha="0.6 rad", mu=mu)
    s.particle(m, s.point("P", (x, y)))
    s.gravity(g=s.parameter("g", "9.81 m/s^2"))
    s.constraint(x * sp.sin(a) - y * sp.cos(a), name="rod")
    way = x * sp.cos(a) + y * sp.sin(a)
    s.friction(k, pressed_by="rod", deflection=way / s.parameter("R", "1 m") if angle else way, name="rough")
    return s


QUESTIONS: dict[str, Callable[[lg.System], Any]] = {
    "check": lambda s: s.check("m*x'' = lam*sin(alpha); m*y'' = -m*g - lam*cos(alpha)"),
    "compare": lambda s: lg.compare(s, s),
    "conserved": lambda s: s.conserved_quantities(),
    "linearize": lambda s: s.linearize(operating_point=True),
    "compile": lambda s: s.compile(),
    "equilibria": lambda s: s.equilibria(),
}


@pytest.mark.parametrize("question", QUESTIONS)
def test_what_needs_a_smooth_system_says_which_regimes_are_smooth(question: str) -> None:
    with pytest.raises(lg.Error, match=r"friction 'rough'[\s\S]*regime\(\{'rough': 1, 'rod': 1\}\)") as caught:
        QUESTIONS[question](bead())
    assert caught.value.code == "E311" and "regime({'rough': 0})" in str(caught.value)


@pytest.mark.slow
def test_in_a_regime_answers_are_checked_with_the_multiplier_in_the_friction() -> None:
    """Down the rod: λ < 0 and δ̇ < 0, so the friction along (cos α, sin α) is −μ λ."""
    slipping = bead().regime(rough=-1, rod=-1)
    right = "m*x'' = lam*sin(alpha) - mu*lam*cos(alpha); m*y'' = -m*g - lam*cos(alpha) - mu*lam*sin(alpha)"
    assert slipping.check(right).right
    assert slipping.check("x''*cos(alpha) + y''*sin(alpha) = g*(mu*cos(alpha) - sin(alpha)); "
                          "x''*sin(alpha) = y''*cos(alpha)").right  # fmt: skip
    assert not slipping.check(right.replace("- mu*lam*cos", "+ mu*lam*cos")).right
    size = "m*x'' = N*sin(alpha) + mu*abs(N)*cos(alpha); m*y'' = -m*g - N*cos(alpha) + mu*abs(N)*sin(alpha)"
    assert slipping.check(size).right
    assert not slipping.check(size.replace("+ mu*abs", "- mu*abs")).right


def test_in_a_regime_the_acceleration_is_the_drift_of_a_linearization_and_no_energy_is_conserved() -> None:
    slipping = bead().regime(rough=-1, rod=-1)
    found = slipping.linearize(operating_point=True)  # in the states x, x'
    assert found.drift == pytest.approx([0.0, -G * (np.sin(0.6) - 0.3 * np.cos(0.6)) * np.cos(0.6)], abs=1e-9)
    assert not slipping.conserved_quantities().found


@pytest.mark.slow
def test_a_bead_that_slips_and_one_that_is_pushed_are_the_same_motion_and_one_that_sticks_has_none() -> None:
    pushed = lg.System("pushed bead")
    z = pushed.coordinates("s")
    m, a, mu, g = pushed.parameters("m alpha mu g", m=2, alpha=0.6, mu=0.3, g=G)
    pushed.particle(m, pushed.point("P", (z * sp.cos(a), z * sp.sin(a))))
    pushed.gravity(g=g)
    pushed.generalized_force(z, mu * m * g * sp.cos(a))
    way = {"x": "s*cos(alpha)", "y": "s*sin(alpha)"}
    assert lg.compare(bead().regime(rough=-1, rod=-1), pushed, way).same
    assert not lg.compare(bead().regime(rough=1, rod=-1), pushed, way).same
    stuck = bead().regime(rough=0)
    assert lg.compare(stuck, stuck).same


@pytest.mark.slow
def test_the_unit_of_mu_follows_from_the_row_that_presses() -> None:
    """mu λ is energy / δ: a number along a rod, a length for an angle."""
    bead("0.3", unit="m").simulate(0.01)
    bead("0.3 m", unit="m", angle=True).simulate(0.01)
    for wrong in (bead("0.3 m", unit="m"), bead("0.3 kg", unit="m", angle=True)):
        with pytest.raises(lg.Error, match="coefficient mu has the unit") as caught:
            wrong.derive()
        assert caught.value.code == "E408" and "friction 'rough'" in str(caught.value)


def test_rows_that_press_together_are_all_forces() -> None:
    s = lg.System("door")
    x, y, z, turn = s.coordinates("x y z turn")
    door = s.frame(turn, axis=(1, 0, 0), origin=s.point("C", (x, y, z)))
    s.rigid_body(2, (1, 2, 3), at=door.point(0, 0, 0), frame=door)
    s.pin((door.point(0, 0, 0), s.origin), axis=(1, 0, 0), bodies=door, name="hinge")
    s.friction(0.1, pressed_by=["hinge.y", "hinge.axis_1"], deflection=turn, name="dry")
    with pytest.raises(lg.Error, match="some of the rows that press are forces, others torques") as caught:
        s.simulate(0.1)
    assert caught.value.code == "E412"
