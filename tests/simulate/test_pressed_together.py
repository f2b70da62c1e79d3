"""Friction pressed by the size of two multipliers, √(λ₁² + λ₂²): collars and pins, against their free bodies."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import lagrangian as lg
from lagrangian.integrate import RunStatus

TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-13}
G = 9.81
Array = NDArray[np.float64]


def collar(along: tuple[int, ...] = (3, 0, 4)) -> lg.System:
    """A collar on a straight rod in space, pulled sideways by 5 N."""
    s = lg.System("collar")
    x, y, z = s.coordinates("x y z")
    m, mu = s.parameters("m mu", m=2, mu=0.3)
    P = s.point("P", (x, y, z))
    s.particle(m, P)
    s.gravity(direction=(0, 0, -1), g=G)
    s.force((0, 5, 0), at=P)
    s.slider((P, s.origin), along=along, name="rod")
    way = sum(a * c for a, c in zip(along, (x, y, z), strict=True)) / sp.sqrt(sum(a * a for a in along))
    s.friction(mu, pressed_by=["rod.across1", "rod.across2"], deflection=way, name="dry")
    return s


@pytest.mark.slow
def test_a_collar_slides_up_a_rod_with_the_size_of_the_force_across_it() -> None:
    """N = √((m g cos α)² + 5²), whatever the length of the vector that gives the direction."""
    run = collar().simulate(1.0, initial={"x'": 1.8, "z'": 2.4}, **TIGHT)
    normal = np.hypot(2 * G * 0.6, 5.0)
    up, down = (G * 0.8 + sign * 0.15 * normal for sign in (1, -1))
    stop = 3 / up
    early, late = np.minimum(run.t, stop), np.maximum(run.t - stop, 0.0)
    assert run.events["dry slips"].t == pytest.approx([stop], abs=1e-9)
    assert run["z"] / 0.8 == pytest.approx(3 * early - up * early**2 / 2 - down * late**2 / 2, abs=1e-9)
    assert np.hypot(run["rod.across1"], run["rod.across2"]) == pytest.approx(normal, abs=1e-9)
    assert float(run.audit) < 1e-12


def journal(radius: float) -> lg.System:
    """A pendulum in x, y, theta on a pin with dry friction: the torque is μ r √(λx² + λy²)."""
    s = lg.System("journal")
    x, y, theta = s.coordinates("x y theta")
    m, J, a, r, mu = s.parameters("m J a r mu", m=2, J=0.3, a="0.5 m", r=f"{radius} m", mu=0.4)
    body = s.frame(theta, origin=s.point("C", (x, y)))
    s.rigid_body(m, J, at=body.point(0, 0), frame=body)
    s.gravity(g=G)
    s.pin((body.point(0, a), s.origin), name="pin")
    s.friction(mu * r, pressed_by=("pin.x", "pin.y"), deflection=theta, name="dry")
    return s


def angular(theta: float, rate: float, drag: float) -> float:
    """θ̈ of (J + m a²) θ̈ = −m g a sin θ − drag N sign θ̇ with N² = m² ((g cos θ + a θ̇²)² + (a θ̈ + g sin θ)²)."""
    m, J, a = 2.0, 0.3, 0.5
    whole, sense = J + m * a * a, np.sign(rate)
    along, weight = m * (G * np.cos(theta) + a * rate * rate), m * G * np.sin(theta)
    # (whole α + a w)² = drag² (along² + (m a α + w)²), and −sense (whole α + a w) > 0
    second = whole**2 - (drag * m * a) ** 2
    half = whole * a * weight - drag**2 * m * a * weight
    rest = (a * weight) ** 2 - drag**2 * (along**2 + weight**2)
    return float((-half - sense * np.sqrt(half * half - second * rest)) / second)


@pytest.mark.slow
def test_a_pin_with_dry_friction_agrees_with_the_quadratic_equation_of_its_free_body() -> None:
    run = journal(0.15).simulate(0.6, initial={"y": -0.5, "theta'": 5.0, "x'": 2.5}, **TIGHT)
    assert run.success and float(run.audit) < 1e-11
    assert set(run.modes["dry"][:-1]) >= {1}
    turned: Any = solve_ivp(
        lambda _, z: [z[1], angular(z[0], z[1], 0.06)], (0, 0.6), [0.0, 5.0], "DOP853", rtol=1e-12, atol=1e-13,
        events=lambda _, z: z[1], dense_output=True,
    )  # fmt: skip
    rest = turned.t_events[0][0]
    assert 0.1 < rest < 0.5
    before = run.t < rest
    assert run["theta"][before] == pytest.approx(turned.sol(run.t[before])[0], abs=1e-9)
    assert run.events["dry slips"].t == pytest.approx([rest], abs=1e-9)
    for k in range(0, int(before.sum()), 20):
        assert run["theta''"][k] == pytest.approx(angular(run["theta"][k], run["theta'"][k], 0.06), abs=1e-8)


@pytest.mark.slow
def test_a_rough_pin_holds_a_pendulum_inside_the_circle_of_friction() -> None:
    """At rest the weight passes the pin's centre at the distance a sin θ, which may be as large as μ r."""
    limit = float(np.arcsin(0.06 / 0.5))
    for theta, moves in ((limit - 1e-6, False), (limit + 1e-6, True)):
        start = {"x": 0.5 * np.sin(theta), "y": -0.5 * np.cos(theta), "theta": theta}
        run = journal(0.15).simulate(0.2, initial=start, **TIGHT)
        assert (run.modes["dry"][-1] != 0) == moves


@pytest.mark.slow
def test_a_pin_as_wide_as_the_pendulum_is_a_paradox() -> None:
    """(μ r m a)² < (J + m a²)² is needed: the root of the quadratic equation is unique no more."""
    run = journal(0.799 / 0.4).simulate(0.01, initial={"y": -0.5, "theta'": 5.0, "x'": 2.5})
    assert run.success
    run = journal(0.801 / 0.4).simulate(0.01, initial={"y": -0.5, "theta'": 5.0, "x'": 2.5})
    assert run.status == RunStatus.PARADOX


def chain() -> lg.System:
    """Two rods in absolute coordinates; both pins are rough."""
    s = lg.System("chain")
    m, J, a, mu = s.parameters("m J a mu", m=1.5, J=0.2, a="0.4 m", mu="0.05 m")
    above: Any = s.origin
    angles: list[Any] = []
    for k in (1, 2):
        x, y, theta = s.coordinates(f"x{k} y{k} theta{k}")
        body = s.frame(theta, origin=s.point(f"C{k}", (x, y)))
        s.rigid_body(m, J, at=body.point(0, 0), frame=body)
        s.pin((body.point(0, a), above), name=f"pin{k}")
        turned = theta - angles[-1] if angles else theta
        s.friction(mu, pressed_by=[f"pin{k}.x", f"pin{k}.y"], deflection=turned, name=f"dry{k}")
        angles.append(theta)
        above = body.point(0, -a)
    s.gravity(g=G)
    return s


def hanging(first: float, second: float, rate: float = 0.0) -> dict[str, float]:
    """The chain at two angles, the lower rod turning."""
    knee = 0.8 * np.array([np.sin(first), -np.cos(first)])
    arm = 0.4 * np.array([np.sin(second), -np.cos(second)])
    start = {"x1": knee[0] / 2, "y1": knee[1] / 2, "theta1": first, "theta2": second, "theta2'": rate}
    return start | {"x2": knee[0] + arm[0], "y2": knee[1] + arm[1], "x2'": -arm[1] * rate, "y2'": arm[0] * rate}


@pytest.mark.slow
def test_two_rough_pins_are_solved_together() -> None:
    """Newton's and Euler's laws of both rods, with μ √(λx² + λy²) as the friction torque of each pin."""
    run = chain().simulate(0.65, initial=hanging(0.9, -0.6, 3.0), **TIGHT)
    assert run.success and float(run.audit) < 1e-11
    assert {tuple(pair) for pair in zip(run.modes["dry1"], run.modes["dry2"], strict=True)} >= {(-1, 1), (-1, -1)}
    m, J, a = 1.5, 0.2, 0.4
    two = np.array([m * run["x2''"], m * (run["y2''"] + G)])
    one = np.array([m * run["x1''"], m * (run["y1''"] + G)]) + two
    torques: list[Array] = []
    for k, force in ((1, one), (2, two)):
        assert run[f"pin{k}.x"] == pytest.approx(force[0], abs=1e-7)
        assert run[f"pin{k}.y"] == pytest.approx(force[1], abs=1e-7)
        slips = run.modes[f"dry{k}"]
        torques.append(-0.05 * np.hypot(*force) * slips)
    for k, own, below in ((1, one, two), (2, two, 0 * two)):
        c, z = np.cos(run[f"theta{k}"]), np.sin(run[f"theta{k}"])
        pins = -a * (c * (own[0] + below[0]) + z * (own[1] + below[1]))
        friction = torques[k - 1] - (torques[1] if k == 1 else 0.0)
        slips = (run.modes["dry1"] != 0) & (run.modes["dry2"] != 0)
        assert (J * run[f"theta{k}''"])[slips] == pytest.approx((pins + friction)[slips], abs=1e-7)


@pytest.mark.slow
def test_what_presses_together_has_no_side_and_is_read_from_files() -> None:
    s = collar()
    text = s.to_toml()
    assert 'pressed_by = ["rod.across1", "rod.across2"]' in text
    made = lg.loads(text)
    assert made.simulate(0.1, initial={"x'": 1.8, "z'": 2.4})["z"][-1] > 0.1
    slipping = made.regime(dry=1)  # one sign is known: that of the slip
    acceleration = slipping.compile().forward([0, 0, 0], [1.8, 0, 2.4])[0]
    assert acceleration == pytest.approx(-0.6 * (G * 0.8 + 0.15 * np.hypot(2 * G * 0.6, 5.0)), abs=1e-12)


def test_the_derivation_holds_the_size_of_both_multipliers() -> None:
    d = journal(0.15).derive()
    assert all(check.holds for check in d.verified) and len(d.verified) > 10
    said = d.to_text(width=400)
    assert "√(λ_pin.x² + λ_pin.y²)" in said or "√(λ_pin_x² + λ_pin_y²)" in said
    assert "the constraints 'pin.x' and 'pin.y'" in said


@pytest.mark.parametrize(
    ("rows", "code", "said"),
    [
        ("pin", "E412", "pressed_by=['pin.x', 'pin.y'] for the size of their force"),
        (["pin.x", "pin.z"], "E402", "pin.y"),
        (["pin.x", "pin.x"], "E412", "different"),
        ([], "E406", "pressed_by"),
        (["pin.x", 3], "E406", "list of rows"),
    ],
)
def test_mistakes(rows: Any, code: str, said: str) -> None:
    s = journal(0.15)
    with pytest.raises(lg.Error) as caught:
        s.friction(0.1, pressed_by=rows, deflection=s["theta"], name="other")
        s.simulate(0.1)
    assert caught.value.code == code and said in str(caught.value)


@pytest.mark.slow
def test_the_reaction_of_a_joint_without_rows_holds_the_friction_that_rows_press_on() -> None:
    """A pendulum on a rough pin hangs on a cart: the rail carries both weights and the masses' vertical motion."""
    s = lg.System("cart")
    w, x, y, theta = s.coordinates("w x y theta")
    cart = s.point("cart", (w, 0))
    s.rigid_body(3, 1, at=cart, frame=s.frame(0), name="trolley")
    body = s.frame(theta, origin=s.point("C", (x, y)))
    s.rigid_body(2, 0.3, at=body.point(0, 0), frame=body)
    s.gravity(g=G)
    s.pin((body.point(0, 0.5), cart), name="pin")
    s.friction(0.05, pressed_by=["pin.x", "pin.y"], deflection=theta, name="dry")
    run = s.simulate(0.1, initial={"y": -0.5, "theta'": 5.0, "x'": 2.5}, **TIGHT)
    rail = run.reaction("cart").force
    assert rail[:, 1] == pytest.approx(3 * G + 2 * (run["y''"] + G), abs=1e-9)
    assert 3 * run["w''"] == pytest.approx(-run["pin.x"], abs=1e-9)


@pytest.mark.slow
def test_answers_may_hold_the_size_of_their_multipliers() -> None:
    """X and Y of any common scale, and any sign each; the friction must oppose the slip, and its size must be right."""
    slipping = journal(0.15).regime(dry=1)
    moving = "m*x'' = X; m*y'' = Y - 9.81*m; J*theta'' = -a*cos(theta)*X - a*sin(theta)*Y"
    right = moving + " - mu*r*sqrt(X^2 + Y^2)"
    assert slipping.check(right).right
    assert slipping.check(moving.replace("X", "-2*X").replace("Y", "2*Y") + " - 2*mu*r*sqrt(X^2 + Y^2)").right
    assert not slipping.check(moving + " + mu*r*sqrt(X^2 + Y^2)").right
    assert not slipping.check(moving + " - 2*mu*r*sqrt(X^2 + Y^2)").right
