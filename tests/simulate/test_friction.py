"""Dry friction that sticks, against solutions that are closed piece by piece."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import quad
from scipy.optimize import brentq

import lagrangian as lg
from size import rest_slow

TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-13}
G = 9.81


def root(f: Callable[[float], float], a: float, b: float) -> float:
    """The root of f between a and b."""
    found: Any = brentq(f, a, b, xtol=1e-15)
    return float(found)


def first_root(f: Callable[[float], float], start: float, end: float, pieces: int = 20_000) -> float | None:
    """The first change of sign after ``start``; f may be 0 there."""
    grid = np.linspace(start, end, pieces + 1)[1:]
    values = np.array([f(t) for t in grid])
    at = np.flatnonzero(values[1:] * values[:-1] <= 0)
    return None if not len(at) else root(f, float(grid[at[0]]), float(grid[at[0] + 1]))


class SwingingBelt:
    """m ẍ + k x = friction on a belt with the velocity A cos(ω t), each piece in closed form (ẍ = −ω₀² (x ∓ F/k))."""

    m, k, F, A, w = 1.0, 40.0, 2.0, 0.5, 3.0

    def __init__(self, x: float, v: float, end: float) -> None:
        self.sticks: list[float] = []
        self.slips: list[float] = []
        self.pieces: list[tuple[float, Callable[[float], float]]] = []
        t, stuck = 0.0, abs(v - self.A) == 0
        while t < end:
            t, x, v, stuck = self.stick(t, x, end) if stuck else self.slip(t, x, v, end)

    def belt(self, t: float) -> tuple[float, float, float]:
        """Position, velocity and acceleration of the belt."""
        A, w = self.A, self.w
        return A / w * np.sin(w * t), A * np.cos(w * t), -A * w * np.sin(w * t)

    def hold(self, t: float, x: float) -> float:
        """The force that holds the block on the belt."""
        return self.k * x + self.m * self.belt(t)[2]

    def stick(self, t: float, x: float, end: float) -> tuple[float, float, float, bool]:
        """Ride along until the force reaches its limit."""

        def place(s: float, t: float = t, x: float = x) -> float:
            return x + self.belt(s)[0] - self.belt(t)[0]

        if t > 0:
            self.sticks.append(t)
        self.pieces.append((t, place))
        after = first_root(lambda s: abs(self.hold(s, place(s))) - self.F, t, end + 1)
        if after is None or after > end:
            return end, 0.0, 0.0, True
        self.slips.append(after)
        return after, place(after), self.belt(after)[1], False

    def slip(self, t: float, x: float, v: float, end: float) -> tuple[float, float, float, bool]:
        """Vibrate about ∓F/k until the velocities are equal."""
        w0 = np.sqrt(self.k / self.m)
        difference = v - self.belt(t)[1]
        sense = np.sign(difference) if abs(difference) > 1e-9 else -np.sign(self.hold(t, x))
        centre = -sense * self.F / self.k

        def place(s: float) -> float:
            return centre + (x - centre) * np.cos(w0 * (s - t)) + v / w0 * np.sin(w0 * (s - t))

        def speed(s: float) -> float:
            return -(x - centre) * w0 * np.sin(w0 * (s - t)) + v * np.cos(w0 * (s - t))

        self.pieces.append((t, place))
        after = first_root(lambda s: speed(s) - self.belt(s)[1], t, end + 1)
        if after is None or after > end:
            return end, 0.0, 0.0, False
        stuck = abs(self.hold(after, place(after))) <= self.F
        if not stuck:  # the slip changes its sense
            self.slips.append(after)
        return after, place(after), self.belt(after)[1], stuck

    def __call__(self, t: float) -> float:
        """The block's position."""
        return [place for start, place in self.pieces if start <= t][-1](t)


def on_belt(**values: float) -> lg.System:
    s = lg.System("belt")
    x = s.coordinates("x")
    b = SwingingBelt
    m, k, F, A, w = s.parameters("m k F A w", **{"m": b.m, "k": b.k, "F": b.F, "A": b.A, "w": b.w, **values})
    s.particle(m, s.point("P", (x, 0)))
    s.spring(k, deflection=x)
    s.friction(limit=F, deflection=x - A * sp.sin(w * s.t) / w, name="belt")
    return s


@pytest.mark.parametrize("start", rest_slow([(0.0, 0.5), (0.2, 0.0), (-0.1, 1.0)], ()))
def test_a_block_on_a_swinging_belt(start: tuple[float, float]) -> None:
    run = on_belt().simulate(duration=6, initial={"x": start[0], "x'": start[1]}, **TIGHT)
    exact = SwingingBelt(*start, 6.0)
    assert len(exact.sticks) > 3 and len(exact.slips) > 3
    assert run.events["belt sticks"].t == pytest.approx(exact.sticks, abs=1e-9)
    assert run.events["belt slips"].t == pytest.approx(exact.slips, abs=1e-9)
    begins = [0.0, *exact.sticks] if start == (0.0, 0.5) else exact.sticks  # 0.5 is the speed of the belt
    until = [min((end for end in exact.slips if end > begin), default=6.0) for begin in begins]
    assert run.stuck["belt"] == pytest.approx(np.transpose([begins, until]), abs=1e-9)
    assert run["x"] == pytest.approx([exact(t) for t in run.t], abs=1e-9)
    assert float(run.audit) < 1e-10


@pytest.mark.slow
def test_accelerations_and_modes_are_those_of_the_regime() -> None:
    run = on_belt().simulate(duration=6, initial={"x": 0.0, "x'": 0.5}, **TIGHT)
    b, modes = SwingingBelt, run.modes["belt"]
    assert set(modes) == {-1, 0, 1}
    sliding = -b.k * run["x"] - modes * b.F
    riding = -b.A * b.w * np.sin(b.w * run.t)
    assert run["x''"] == pytest.approx(np.where(modes == 0, riding, sliding) / b.m, abs=1e-8)
    assert run["x'"][modes == 0] == pytest.approx(b.A * np.cos(b.w * run.t[modes == 0]), abs=1e-12)


@pytest.mark.slow
def test_a_mass_on_a_spring_loses_an_amplitude_each_half_cycle() -> None:
    """Each half cycle is a cosine about ∓F/k: the amplitude falls by 2 F/k, until |k x| ≤ F."""
    s = lg.System("block")
    x = s.coordinates("x")
    m, k, F = s.parameters("m k F", m=1, k=100, F=3)
    s.particle(m, s.point("P", (x, 0)))
    s.spring(k, deflection=x)
    s.friction(limit=F, deflection=x, name="floor")
    run = s.simulate(duration=3, initial={"x": 0.5}, **TIGHT)
    turns = np.array([(-1) ** n * (0.5 - 0.06 * n) for n in range(9)])  # 0.5 - 0.48 = 0.02 < F/k
    times = np.arange(1, 9) * np.pi / 10
    assert run.events["floor sticks"].t == pytest.approx(times[-1:], abs=1e-9)
    assert run.events["floor slips"].t == pytest.approx(times[:-1], abs=1e-9)
    assert run["x"][-1] == pytest.approx(turns[-1], abs=1e-9) and run["x'"][-1] == 0
    assert run.supplied[-1] == pytest.approx(-F_path(turns, 3.0), abs=1e-9)


def F_path(turns: Any, F: float) -> float:
    """The energy lost along a path from turn to turn."""
    return float(F * np.abs(np.diff(turns)).sum())


def pendulum(c: float = 0.5) -> lg.System:
    s = lg.System("pendulum")
    theta = s.coordinates("theta")
    m, L, torque = s.parameters("m L c", m=1, L=1, c=c)
    s.particle(m, s.point("bob", (L * sp.sin(theta), -L * sp.cos(theta))))
    s.gravity()
    s.friction(limit=torque, deflection=theta, name="pivot")
    return s


def swings(start: float, c: float) -> tuple[list[float], list[float]]:
    """Where and when a pendulum turns: ½ θ̇² = G (cos θ − cos θ₀) − c |θ − θ₀|, and t = ∫ dθ/θ̇."""
    times, angles = [0.0], [start]
    while G * abs(np.sin(angles[-1])) > c:
        a = angles[-1]
        sense = -np.sign(a)

        def square(x: float, a: float = a) -> float:
            return 4 * G * np.sin((x + a) / 2) * np.sin((a - x) / 2) - 2 * c * abs(x - a)

        lowest = sense * np.arcsin(c / G) * -1  # where it is fastest
        b = root(square, lowest, -a)
        middle, half = (a + b) / 2, (b - a) / 2

        def slowness(z: float, middle: float = middle, half: float = half, square: Any = square) -> float:
            return abs(half) * np.cos(z) / np.sqrt(square(middle + half * np.sin(z)))

        total = quad(slowness, -np.pi / 2, np.pi / 2, epsabs=1e-12, epsrel=1e-12, limit=200)[0]
        times.append(times[-1] + total)
        angles.append(b)
    return times, angles


@pytest.mark.slow
def test_a_pendulum_with_a_dry_pivot() -> None:
    run = pendulum().simulate(duration=20, initial={"theta": 1.0}, **TIGHT)
    times, angles = swings(1.0, 0.5)
    assert len(angles) > 6
    assert run.events["pivot slips"].t == pytest.approx(times[1:-1], abs=1e-9)
    assert run.events["pivot slips"].y[0] == pytest.approx(angles[1:-1], abs=1e-9)
    assert run.events["pivot sticks"].t == pytest.approx(times[-1:], abs=1e-9)
    assert run["theta"][-1] == pytest.approx(angles[-1], abs=1e-9)
    assert float(run.audit) < 1e-10


@pytest.mark.slow
def test_the_same_pendulum_with_its_pivot_as_a_constraint() -> None:
    """A rod in x, y, θ that a pin holds at one end; friction sticks and slips on the constraint."""
    s = lg.System("pinned rod")
    x, y, theta = s.coordinates("x y theta")
    m, J, a, c = s.parameters("m J a c", m=1, J=0.25, a=0.5, c=0.25)  # J + m a² = 0.5: half of the other pendulum
    frame = s.frame(theta, origin=s.point("C", (x, y)), name="rod")
    s.rigid_body(m, J, frame.origin, frame)
    s.gravity()
    s.pin((frame.point(0, a, name="top"), s.origin), name="pin")
    s.friction(limit=c, deflection=theta, name="pivot")
    start = {"theta": 1.0, "x": 0.5 * np.sin(1.0), "y": -0.5 * np.cos(1.0)}
    run = s.simulate(duration=20, initial=start, fixed=["theta"], **TIGHT)
    times, angles = swings(1.0, 0.5)
    assert run.events["pivot slips"].t == pytest.approx(times[1:-1], abs=1e-9)
    assert run.events["pivot sticks"].t == pytest.approx(times[-1:], abs=1e-9)
    assert run["theta"][-1] == pytest.approx(angles[-1], abs=1e-9)
    assert run["pin.y"][-1] == pytest.approx(G, abs=1e-8)  # at rest the pin holds the weight
    assert float(run.audit) < 1e-10


def rotor() -> lg.System:
    s = lg.System("rotor")
    phi = s.coordinates("phi")
    J, c, b = s.parameters("J c b", J=0.2, c=0.3, b=0.1)
    s.rigid_body(1, J, s.origin, s.frame(phi))
    s.friction(limit=c, viscous=b, deflection=phi, name="bearing")
    return s


@pytest.mark.slow
def test_runs_of_an_ensemble_stop_where_they_should() -> None:
    """J ω̇ = −c − b ω stops at (J/b) ln(1 + b ω₀/c), after the angle (J/b)(ω₀ − (c/b) ln(1 + b ω₀/c))."""
    J, b, speed = 0.2, 0.1, 4.0
    c = np.array([0.1, 0.3, 0.9])
    runs = rotor().ensemble(initial={"phi'": [speed] * 3}, params={"c": c}, duration=20, times=3, **TIGHT)
    log = np.log(1 + b * speed / c)
    assert runs["final phi"] == pytest.approx(J / b * (speed - c / b * log), abs=1e-9)
    assert runs.success
    run = rotor().simulate(duration=5, initial={"phi'": speed}, params={"c": 0.9}, **TIGHT)
    assert run.events["bearing sticks"].t == pytest.approx([J / b * log[2]], abs=1e-9)


@pytest.mark.slow
def test_a_block_on_an_incline_sticks_below_the_angle_of_friction() -> None:
    s = lg.System("incline")
    x = s.coordinates("x")
    m, alpha, mu, g = s.parameters("m alpha mu g", m=2, alpha=0.3, mu=0.4, g=9.81)
    s.particle(m, s.point("P", (x * sp.cos(alpha), -x * sp.sin(alpha))))
    s.gravity(g=g)
    s.friction(mu, normal=m * g * sp.cos(alpha), static=mu * 1.2, deflection=x, name="plane")
    for angle in (0.3, np.arctan(0.48) - 1e-6):
        run = s.simulate(duration=2, params={"alpha": angle}, **TIGHT)
        assert np.abs(run["x"]).max() == 0 and set(run.modes["plane"]) == {0}
    for angle in (np.arctan(0.48) + 1e-6, 0.7):
        run = s.simulate(duration=2, params={"alpha": angle}, **TIGHT)
        slide = 9.81 * (np.sin(angle) - 0.4 * np.cos(angle))
        assert run["x"] == pytest.approx(slide * run.t**2 / 2, abs=1e-9)


@pytest.mark.slow
def test_two_blocks_one_on_the_other() -> None:
    """A force r t pulls the lower one: both rest, then ride together, then the upper one is left behind."""
    s = lg.System("stack")
    x, y = s.coordinates("x y")
    m, M, mu1, mu2, r = s.parameters("m M mu1 mu2 r", m=1, M=3, mu1=0.2, mu2=0.3, r=5)
    P = s.point("P", (x, 0))
    s.particle(M, P)
    s.particle(m, s.point("Q", (y, 0)))
    s.force((r * s.t, 0), at=P)
    s.friction(mu1, normal=(m + M) * 9.81, deflection=x, name="ground")
    s.friction(mu2, normal=m * 9.81, between=(P, s.model.points[1]), name="between")
    run = s.simulate(duration=8, **TIGHT)
    F1, a2 = 0.2 * 4 * G, 0.3 * G
    t1 = F1 / 5
    t2 = (F1 + 4 * a2) / 5
    assert run.events["ground slips"].t == pytest.approx([t1], abs=1e-9)
    assert run.events["between slips"].t == pytest.approx([t2], abs=1e-9)
    t = run.t
    together = np.where(t > t1, 5 * (t - t1) ** 3 / 24, 0.0)
    x2, v2, late = 5 * (t2 - t1) ** 3 / 24, 5 * (t2 - t1) ** 2 / 8, t - t2
    upper = np.where(late > 0, x2 + v2 * late + a2 * late**2 / 2, together)
    a1 = (5 * t2 - F1 - 1 * a2) / 3
    lower = np.where(late > 0, x2 + v2 * late + a1 * late**2 / 2 + 5 * late**3 / 18, together)
    assert run["x"] == pytest.approx(lower, rel=1e-9, abs=1e-9)
    assert run["y"] == pytest.approx(upper, rel=1e-9, abs=1e-9)
    assert float(run.audit) < 1e-10


@pytest.mark.slow
def test_a_bounce_and_a_step_of_an_input() -> None:
    """A block slides to a wall, comes back and stops; a force above the limit at rest moves it again at t = 3."""
    s = lg.System("wall")
    x = s.coordinates("x")
    F = s.parameters("F", F=1)
    u = s.input("u")
    P = s.point("P", (x, 0))
    s.particle(1, P)
    s.force((u, 0), at=P)
    s.friction(limit=F, static=1.5, deflection=x, name="floor")
    wall = lg.event(x - 1, direction=1, reset={x.diff(): -0.5 * x.diff()}, name="wall")
    push = ([0.0, 2.5, 3.0, 6.0], [0.0, -1.4, -1.6, -1.6], "hold")
    run = s.simulate(duration=5, initial={"x'": 2}, events=[wall], inputs={u: push}, **TIGHT)
    hit = 2 - np.sqrt(2)  # 2 t − t²/2 = 1
    back = 0.5 * (2 - hit)
    assert run.events["wall"].t == pytest.approx([hit], abs=1e-9)
    assert run.events["floor sticks"].t == pytest.approx([hit + back], abs=1e-9)
    assert run.events["floor slips"].t == pytest.approx([0.0, hit, 3.0][1:], abs=1e-9)
    rest = 1 - back**2 / 2
    assert run["x"][-1] == pytest.approx(rest - 0.6 * 4 / 2, abs=1e-9)
    assert float(run.audit) < 1e-10


@pytest.mark.parametrize("speed", rest_slow([0.1, 0.4], {0.4}))
def test_stick_slip_on_a_steady_belt_needs_a_higher_limit_at_rest(speed: float) -> None:
    """From F_s/k the block slips back about F/k: a circle in (x, ẋ/ω₀) until ẋ is the belt's again, at the mirror
    image; then it rides for the distance 2 (F_s − F)/k."""
    s = lg.System("steady belt")
    x = s.coordinates("x")
    m, k, F, Fs, V = s.parameters("m k F Fs V", m=1, k=25, F=2, Fs=3, V=speed)
    s.particle(m, s.point("P", (x, 0)))
    s.spring(k, deflection=x)
    s.friction(limit=F, static=Fs, deflection=x - V * s.t, name="belt")
    run = s.simulate(duration=25, initial={"x'": speed}, **TIGHT)
    w0, jump = 5.0, (3 - 2) / 25
    slipping = 2 * (np.pi - np.arctan(jump * w0 / speed)) / w0
    riding = 2 * jump / speed
    first = 3 / 25 / speed
    n = int((25 - first) / (slipping + riding))
    assert n > 5
    slips = first + np.arange(n) * (slipping + riding)
    assert run.events["belt slips"].t[:n] == pytest.approx(slips, abs=1e-9)
    assert run.events["belt sticks"].t[:n] == pytest.approx(slips + slipping, abs=1e-9)


@pytest.mark.slow
def test_a_file_says_the_same() -> None:
    s = pendulum()
    text = s.to_toml()
    assert "[[friction]]" in text and 'limit = "c"' in text
    run = lg.loads(text).simulate(duration=20, initial={"theta": 1.0}, **TIGHT)
    times, _ = swings(1.0, 0.5)
    assert run.events["pivot sticks"].t == pytest.approx(times[-1:], abs=1e-9)


def test_what_rests_at_the_start_sticks_from_then_on_and_what_only_slips_has_no_such_time() -> None:
    s = pendulum()
    assert s.simulate(1, theta=0.01).stuck["pivot"].tolist() == [[0.0, 1.0]]  # m g l sin θ < c
    assert s.simulate(0.1, theta=1.0).stuck["pivot"].shape == (0, 2)


def test_an_event_where_the_sense_of_a_slip_changes_occurs_once() -> None:
    """θ̇ falls from 0 at the start, and through 0 where the pendulum turns back and its friction changes its sense."""
    run = pendulum().simulate(6, theta=1.0, events=lg.event("theta'", direction=-1, name="back"))
    slips = run.events["pivot slips"]
    assert run.events["back"].t == pytest.approx([0.0, *slips.t[slips.y[0] > 0]], abs=1e-9)
    assert len(slips) > 4


@pytest.mark.parametrize("method", ["Radau", "gauss4"])
def test_a_method_that_cannot_stick_is_refused(method: str) -> None:
    with pytest.raises(lg.RunError, match=r"E501.*does not find where friction 'pivot' begins to stick"):
        pendulum().simulate(duration=1, method=method, step=0.01 if method == "gauss4" else None)


def test_what_needs_a_smooth_function_is_refused(tmp_path: Any) -> None:
    s = pendulum()
    for refused in (
        s.compile,
        s.equilibria,
        lambda: s.export(tmp_path / "pendulum.c"),
        lambda: s.linearize_along(s.simulate(duration=1, initial={"theta": 1.0})),
    ):
        with pytest.raises(lg.ModelError, match="E311"):
            refused()


def test_limits_must_make_sense() -> None:
    with pytest.raises(lg.RunError, match=r"E501.*not negative"):
        pendulum().simulate(duration=1, params={"c": -1})
    s = lg.System("block")
    x = s.coordinates("x")
    s.particle(1, s.point("P", (x, 0)))
    s.friction(limit=2, static=1, deflection=x, name="floor")
    with pytest.raises(lg.RunError, match=r"E501.*below 2 while it slips"):
        s.simulate(duration=1)


def test_frictions_that_hold_together_are_refused() -> None:
    s = lg.System("block")
    x = s.coordinates("x")
    s.particle(1, s.point("P", (x, 0)))
    s.friction(limit=2, deflection=x, name="floor")
    s.friction(limit=1, deflection=x, name="guide")
    with pytest.raises(lg.ModelError, match=r"E310.*'floor' and 'guide'"):
        s.simulate(duration=1)


@pytest.mark.slow
def test_a_derivation_shows_both_regimes() -> None:
    d = pendulum().derive()
    page = " ".join(str(d).split())
    assert "While it slips, θ̇ is not 0, and its effort on the deflection is −c sgn(θ̇)" in page
    assert (
        "θ̇ = 0 (while friction 'pivot' sticks) It then adds λ to Ξ₁. This lasts as long as |λ| is not above c." in page
    )
    assert all(check.holds for check in d.verify())


def test_frictions_that_hold_together_in_other_words_are_refused() -> None:
    s = lg.System("block")
    x = s.coordinates("x")
    s.particle(1, s.point("P", (x, 0)))
    s.friction(limit=2, deflection=sp.sin(x), name="floor")
    s.friction(limit=1, deflection=x + x**3, name="guide")
    with pytest.raises(lg.Error, match=r"E310.*'floor' and 'guide'"):
        s.simulate(duration=1)


@pytest.mark.slow
def test_in_other_coordinates_it_sticks_at_the_same_times() -> None:
    s = pendulum()
    other = s.in_coordinates({"theta": "2*phi"})
    run = other.simulate(duration=20, initial={"phi": 0.5}, **TIGHT)
    times, angles = swings(1.0, 0.5)
    assert run.events["pivot sticks"].t == pytest.approx(times[-1:], abs=1e-9)
    assert 2 * run["phi"][-1] == pytest.approx(angles[-1], abs=1e-9)


@pytest.mark.slow
def test_two_frictions_in_a_chain_keep_the_balance_of_energy() -> None:
    """h(t) − h(0) is what the forces gave less F |slip| of each friction, whatever sticks when."""
    s = lg.System("chain")
    previous: Any = 0
    for i, x in enumerate(s.coordinates("q1:3")):
        P = s.point(f"P{i}", (x, 0))
        s.particle(1 + 0.3 * i, P)
        s.spring(30, deflection=x - previous, name=f"k{i}")
        s.friction(limit=0.6 + 0.1 * i, static=0.8 + 0.1 * i, deflection=x - previous, name=f"f{i}")
        s.force((4 * sp.sin((2 + 0.7 * i) * s.t), 0), at=P, name=f"u{i}")
        previous = x
    run = s.simulate(duration=10, **TIGHT)
    assert sum(len(found) for found in run.events.values()) > 10
    assert float(run.audit) < 1e-11
    for i, slip in enumerate((run["q1'"], run["q2'"] - run["q1'"])):
        mode = run.modes[f"f{i}"]
        assert (mode * slip >= -1e-11).all() and np.abs(slip[mode == 0]).max() < 1e-11
