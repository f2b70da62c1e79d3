"""Friction whose normal force is the multiplier of a constraint, against closed solutions and free-body sums."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import brentq

import lagrangian as lg
from lagrangian.integrate import RunStatus

TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-13}
G = 9.81


def bead(alpha: float, mu: float = 0.3) -> lg.System:
    """A bead on a straight rough rod, in x and y."""
    s = lg.System("bead")
    x, y = s.coordinates("x y")
    m, a, k = s.parameters("m alpha mu", m=2, alpha=alpha, mu=mu)
    s.particle(m, s.point("P", (x, y)))
    s.gravity(g=G)
    s.constraint(x * sp.sin(a) - y * sp.cos(a), name="rod")
    s.friction(k, pressed_by="rod", deflection=x * sp.cos(a) + y * sp.sin(a), name="rough")
    return s


@pytest.mark.sampled(2)
@pytest.mark.parametrize("alpha", [0.2, 0.6])
@pytest.mark.slow
def test_a_bead_on_a_rough_rod_goes_up_and_stops_or_comes_back(alpha: float) -> None:
    """Up with −g (sin α + μ cos α), then at rest if tan α < μ, else down with −g (sin α − μ cos α)."""
    run = bead(alpha).simulate(1.0, initial={"x'": 3 * np.cos(alpha), "y'": 3 * np.sin(alpha)}, **TIGHT)
    up, down = (G * (np.sin(alpha) + sign * 0.3 * np.cos(alpha)) for sign in (1, -1))
    stop, high = 3 / up, 9 / (2 * up)
    late = np.maximum(run.t - stop, 0.0)
    early = np.minimum(run.t, stop)
    exact = 3 * early - up * early**2 / 2 - max(down, 0.0) * late**2 / 2
    word = "slips" if down > 0 else "sticks"
    assert run.events[f"rough {word}"].t == pytest.approx([stop], abs=1e-9)
    assert run["x"] / np.cos(alpha) == pytest.approx(exact, abs=1e-9)
    assert exact.max() == pytest.approx(high, abs=1e-4)
    assert run["rod"] == pytest.approx(-2 * G * np.cos(alpha), abs=1e-9)
    assert float(run.audit) < 1e-12
    assert run.powers["rough"][0] == pytest.approx(-0.3 * 2 * G * np.cos(alpha) * 3, abs=1e-9)


@pytest.mark.slow
def test_a_block_on_an_incline_sticks_up_to_the_angle_of_friction_at_rest() -> None:
    for over, moves in ((-1e-6, False), (1e-6, True)):
        s = bead(float(np.arctan(0.3)) + over)
        run = s.simulate(1.0, **TIGHT)
        assert (run.modes["rough"][-1] != 0) == moves
        assert np.abs(run["x"]).max() < 1e-5


def squared_speed(theta: float, start: float, w: float, side: int, mu: float) -> float:
    """θ̇² on a rough hoop: dw/dθ = −2 G sin θ − 2 μ σ (w + G cos θ), from ``w`` at ``start``; g/R is G."""
    k = 2 * mu * side
    b = (2 - k * k) * G / (1 + k * k)
    a = -k * G - k * b

    def forced(x: float) -> float:
        return a * np.sin(x) + b * np.cos(x)

    return float((w - forced(start)) * np.exp(-k * (theta - start)) + forced(theta))


@pytest.mark.slow
def test_a_bead_on_a_rough_hoop_is_pressed_outwards_then_inwards() -> None:
    """N = m R (θ̇² + g/R cos θ) changes its sign high up; the friction is μ |N| on both sides."""
    s = lg.System("hoop")
    r, theta = s.coordinates("r theta")
    mu = s.parameters("mu", mu=0.1)
    s.particle(1.5, s.point("P", (r * sp.sin(theta), -r * sp.cos(theta))))
    s.gravity(g=G)
    s.constraint(r - 1, name="radius")
    s.friction(mu, pressed_by="radius", deflection=theta, name="rough")
    w0 = 33.0
    run = s.simulate(0.9, initial={"r": 1.0, "theta'": np.sqrt(w0)}, **TIGHT)
    assert run.success and float(run.audit) < 1e-11
    turn: Any = brentq(lambda z: squared_speed(z, 0.0, w0, 1, 0.1) + G * np.cos(z), 1.0, 3.0, xtol=1e-15)
    there = squared_speed(turn, 0.0, w0, 1, 0.1)
    stop: Any = brentq(lambda z: squared_speed(z, turn, there, -1, 0.1), turn, turn + 0.99, xtol=1e-15)
    angle, rate = run["theta"], run["theta'"]
    upwards = angle[: int(np.argmax(angle))]
    assert upwards[-1] > turn + 0.05
    exact = [squared_speed(z, 0.0, w0, 1, 0.1) if z < turn else squared_speed(z, turn, there, -1, 0.1) for z in upwards]
    assert rate[: len(upwards)] ** 2 == pytest.approx(exact, abs=1e-9 * w0)
    assert run.events["rough slips"].y[1, 0] == pytest.approx(stop, abs=1e-9)
    normal = 1.5 * (rate**2 + G * np.cos(angle))
    assert np.abs(run["radius"]) == pytest.approx(np.abs(normal), abs=1e-8)


def ladder(mu: float, wall: float) -> lg.System:
    """A rod of length 2 that leans on a floor and a wall, with friction at its lower and upper end."""
    s = lg.System("ladder")
    x, y, theta = s.coordinates("x y theta")
    m, J, below, above = s.parameters("m J mu nu", m=3, J=1.1, mu=mu, nu=wall)
    s.rigid_body(m, J, at=s.point("C", (x, y)), frame=s.frame(sp.pi - theta))
    s.gravity(g=G)
    c, z = sp.cos(theta), sp.sin(theta)
    s.constraint(y - z, name="floor")
    s.constraint(x - c, name="wall")
    s.friction(below, pressed_by="floor", deflection=x + c, name="foot")
    if wall:
        s.friction(above, pressed_by="wall", deflection=y + z, name="top")
    return s


def leaning(theta: float, rate: float = 0.0) -> dict[str, float]:
    """The state of the rod at an angle."""
    c, z = float(np.cos(theta)), float(np.sin(theta))
    return {"x": c, "y": z, "theta": theta, "x'": -z * rate, "y'": c * rate, "theta'": rate}


@pytest.mark.slow
def test_a_rod_slides_down_a_rough_wall_with_the_forces_of_its_free_body() -> None:
    """m ẍ = N_w − μ N_f,  m ÿ = N_f + ν |N_w| − m g,  and moments about the centre."""
    m, J, mu, nu = 3.0, 1.1, 0.25, 0.2
    run = ladder(mu, nu).simulate(0.6, initial=leaning(1.1, -1.0), **TIGHT)
    assert run.success and float(run.audit) < 1e-11
    theta, w = run["theta"], run["theta'"] ** 2
    sides = np.sign(run["wall"])
    assert set(sides) == {1.0, -1.0}  # the wall pulls in the end: the row holds both ways
    for k in range(0, len(theta), 25):
        c, z, side = np.cos(theta[k]), np.sin(theta[k]), sides[k]
        system = np.array(
            [
                [m * z, -mu, 1.0],
                [-m * c, 1.0, nu * side],
                [J, c - mu * z, -(z + nu * side * c)],
            ]
        )
        angular, floor, wall = np.linalg.solve(system, [-m * c * w[k], m * G - m * z * w[k], 0.0])
        assert run["theta''"][k] == pytest.approx(angular, abs=1e-8)
        assert run["floor"][k] == pytest.approx(floor, abs=1e-8)
        assert run["wall"][k] == pytest.approx(wall, abs=1e-8)


@pytest.mark.slow
def test_a_ladder_on_a_smooth_wall_slips_below_the_angle_whose_tangent_is_half_of_one_over_mu() -> None:
    """tan θ = 1/(2 μ): statics of a ladder on a rough floor and a smooth wall (any textbook of statics)."""
    angle = float(np.arctan(1 / (2 * 0.4)))
    run = ladder(0.4, 0.0).simulate(0.5, initial=leaning(angle + 1e-6), **TIGHT)
    assert set(run.modes["foot"]) == {0} and run["wall"][0] == pytest.approx(3 * G / 2 / np.tan(angle + 1e-6), abs=1e-9)
    run = ladder(0.4, 0.0).simulate(0.5, initial=leaning(angle - 1e-6), **TIGHT)
    assert set(run.modes["foot"]) == {1}


@pytest.mark.slow
def test_at_rest_two_rough_ends_share_the_load_in_a_way_that_nobody_knows() -> None:
    with pytest.raises(lg.Error, match="cannot be told") as caught:
        ladder(0.8, 0.8).simulate(0.5, initial=leaning(1.2), **TIGHT)
    assert caught.value.code == "E310"


def rods(mu: float) -> lg.System:
    """Two sliders in parallel guides, joined by a rod at the angle 1 rad; one guide is rough (Painlevé, Klein)."""
    s = lg.System("sliders")
    x1, y1, x2, y2 = s.coordinates("x1 y1 x2 y2")
    k, F = s.parameters("mu F", mu=mu, F=3)
    P, Q = s.point("P", (x1, y1)), s.point("Q", (x2, y2))
    s.particle(1, P)
    s.particle(2, Q)
    guide = s.constraint(y1, name="lower")
    s.constraint(y2 - 1, name="upper")
    s.constraint(between=(P, Q), distance=1 / np.sin(1.0), name="rod")
    s.force((F, 0), at=P)
    s.force((-1, 0), at=Q)
    s.friction(k, pressed_by=guide, deflection=x1, name="dry")
    return s


@pytest.mark.slow
def test_friction_and_what_presses_on_it_are_solved_together_until_they_jam() -> None:
    """λ cot φ + μ (m₂/M) s |λ| = (m₂ F₁ − m₁ F₂)/M has one solution as long as μ (m₂/M) tan φ < 1 (Painlevé 1895)."""
    r, cot = 2.0 * np.array([3.0, -3.0]) / 3 + 1 / 3, 1 / np.tan(1.0)
    starts = {"x2": cot, "y2": 1.0, "x1'": [1.0, -1.0] * 2, "x2'": [1.0, -1.0] * 2}
    for k, force in enumerate((3.0, -3.0)):
        for speed in (1.0, -1.0):
            start = {**starts, "x1'": speed, "x2'": speed}
            run = rods(0.9).simulate(0.02, initial=start, params={"F": force}, **TIGHT)
            lam = r[k] / (cot + np.sign(r[k]) * np.sign(speed) * 0.6)
            assert run["lower"] == pytest.approx(lam, abs=1e-9)
            assert run["x1''"] == pytest.approx((force - 1 - 0.9 * abs(lam) * speed) / 3, abs=1e-9)
    run = rods(0.97).simulate(0.02, initial={**starts, "x1'": 1.0, "x2'": 1.0})
    assert run.status == RunStatus.PARADOX and "Painlevé" in run.message
    runs = rods(0.9).ensemble(0.02, params={"mu": [0.9, 0.97]}, initial={**starts, "x1'": 1.0, "x2'": 1.0})
    assert runs.status.tolist() == [0, RunStatus.PARADOX]


@pytest.mark.slow
def test_the_derivation_shows_both_regimes_and_agrees_with_what_is_compiled() -> None:
    d = ladder(0.25, 0.2).derive()
    assert all(check.holds for check in d.verified) and len(d.verified) > 10
    assert [check.holds for check in d.verify(states=2)][-1] is None  # no compiled functions
    assert d.minimal is None and "λ" not in str(d.no_minimal)
    said = d.to_text(width=400)
    assert "|λ_floor|" in said and "it slips or it sticks" in said and "depends on the friction in its turn" in said


def test_files_and_mistakes() -> None:
    s = bead(0.6)
    text = s.to_toml()
    assert 'pressed_by = "rod"' in text
    run = lg.loads(text).simulate(0.5, **TIGHT)
    down = G * (np.sin(0.6) - 0.3 * np.cos(0.6))
    assert run["x"][-1] == pytest.approx(-np.cos(0.6) * down / 8, abs=1e-9)
    for wrong, code, said in (
        ({"mu": 0.1, "pressed_by": "rid"}, "E402", "rod"),
        ({"mu": 0.1, "normal": "rod"}, "E406", "pressed_by='rod'"),
        ({"limit": 0.1, "pressed_by": "rod"}, "E412", "mu"),
        ({"mu": 0.1, "pressed_by": 3}, "E406", "constraint"),
    ):
        made = bead(0.6)
        with pytest.raises(lg.Error) as caught:
            made.friction(deflection=made["x"], name="other", **wrong)
            made.simulate(0.1)
        assert caught.value.code == code and said in str(caught.value)


@pytest.mark.slow
def test_ensembles_observe_forces_in_the_regime_of_each_sample() -> None:
    """The bead goes up, stops and stays: λ of the rod, accelerations and their extremes are those of single runs."""
    s, up = bead(0.2), {"x'": 3 * np.cos(0.2), "y'": 3 * np.sin(0.2)}
    asked = ["max rod", "min x''", "final x''"]
    runs = s.ensemble(1.0, params={"mu": [0.3, 0.5]}, initial=up, outputs=asked, times=51)
    for k, mu in enumerate((0.3, 0.5)):
        assert runs["max rod"][k] == pytest.approx(-2 * G * np.cos(0.2), abs=1e-9)
        assert runs["min x''"][k] == pytest.approx(-G * (np.sin(0.2) + mu * np.cos(0.2)) * np.cos(0.2), abs=1e-9)
        assert runs["final x''"][k] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.slow
def test_ensembles_observe_reactions_in_the_regime_of_each_sample() -> None:
    s = lg.System("pendulum")
    theta = s.coordinates("theta")
    frame = s.frame(theta)
    c = s.parameters("c", c=1.0)
    s.particle(1, frame.point(0, -1))
    s.gravity(g=G)
    s.friction(limit=c, deflection=theta, name="pivot")
    runs = s.ensemble(3.0, params={"c": [1.0, 3.0]}, theta=1.0, outputs="reaction origin", reduce=None, times=31)
    for k, limit in enumerate((1.0, 3.0)):
        run = s.simulate(3.0, params={"c": limit}, theta=1.0, samples=31)
        force = np.linalg.norm(run.reaction("origin").force, axis=1)
        assert runs["reaction origin"][k] == pytest.approx(force, abs=1e-6)
