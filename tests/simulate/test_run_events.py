"""Events: when they are found, what they change, and how runs end by them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp
from run_systems import ball, oscillator

import lagrangian as lg

METHODS = ["dop853", "taylor", "tsit5", "DOP853", "Radau"]
FALL = np.sqrt(2 / 9.81)


def bounce(s: lg.System) -> lg.Event:
    y = s["y"]
    return lg.event(y, direction=-1, reset={y.diff(): -s["e"] * y.diff()}, name="bounce")


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_a_ball_bounces_when_it_should(method: str) -> None:
    s = ball(e=0.5)
    run = s.simulate(1.3, y=1.0, events=bounce(s), method=method, samples=14)
    assert run.success
    assert run.events["bounce"].t == pytest.approx(FALL * np.array([1, 2, 2.5, 2.75, 2.875]), rel=1e-9)
    assert run.events["bounce"].y[0] == pytest.approx(np.zeros(5), abs=1e-9)
    assert run.events["bounce"].y[1] == pytest.approx(-9.81 * FALL * 0.5 ** np.arange(5), rel=1e-8)
    assert float(run.audit) < 1e-9  # what the impacts take is accounted for
    assert run.energy[-1] < 0.02 * run.energy[0]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_a_ball_that_never_stops_bouncing_ends_the_run(method: str) -> None:
    s = ball(e=0.5)
    run = s.simulate(2.0, y=1.0, events=bounce(s), method=method)
    assert not run.success and run.status == -4
    assert "event 'bounce' repeats itself without end" in run.message
    assert run.t[-1] == pytest.approx(3 * FALL, rel=1e-6)
    assert np.all(np.isfinite(run.y))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_a_terminal_event_ends_the_run_there(method: str) -> None:
    s = ball()
    half = lg.event(s["y"] - 0.5, terminal=True, name="half")
    run = s.simulate(1.0, y=1.0, events=[half], method=method, samples=11)
    assert run.success and run.status == 1
    assert "event 'half' ended the run" in run.message
    assert run.t[-1] == pytest.approx(np.sqrt(1 / 9.81), rel=1e-10)
    assert run["y"][-1] == pytest.approx(0.5, abs=1e-10)


@pytest.mark.sampled(16)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("direction", "wanted"), [(0, [1, 3, 5]), (1, [3]), (-1, [1, 5])])
def test_crossings_are_found_in_the_direction_asked_for(method: str, direction: int, wanted: list[int]) -> None:
    s = oscillator(m=1.0, k=1.0, b=0.0)
    run = s.simulate(9.0, q=1.0, events=lg.event(s["q"], direction, name="zero"), method=method, rtol=1e-10)
    assert run.events["zero"].t == pytest.approx(np.array(wanted) * np.pi / 2, rel=1e-6)


def test_events_may_read_inputs_parameters_and_time() -> None:
    s = oscillator(m=1.0, k=1.0, b=0.0)
    asked = [
        lg.event(s["F"] - 1, name="pushed"),
        lg.event(s.t - 0.25, name="alarm"),
        lg.event(s["k"] * s["q"] - 0.5, name="soft"),
    ]
    run = s.simulate(2.0, q=1.0, events=asked, inputs={"F": "2*t"})
    assert run.events["alarm"].t == pytest.approx([0.25])
    assert run.events["pushed"].t == pytest.approx([0.5])
    assert np.interp(run.events["soft"].t, run.t, run["q"]) == pytest.approx(
        0.5 * np.ones(len(run.events["soft"])), abs=1e-4
    )


def test_a_run_may_change_coordinates_too() -> None:
    """A point that is put back to the start whenever it arrives."""
    s = lg.System("conveyor")
    x = s.coordinate("x")
    s.particle(s.parameter("m", 1.0), at=s.origin + (x, 0))
    back = lg.event(x - 1, direction=1, reset={x: 0 * x}, name="back")
    run = s.simulate(3.5, initial={"x'": 1.0}, events=back, times=None, samples=36)
    assert run.events["back"].t == pytest.approx([1.0, 2.0, 3.0])
    assert run["x"][-1] == pytest.approx(0.5)


def test_symplectic_runs_have_events_and_resets() -> None:
    s = ball(e=0.5)
    run = s.simulate(1.0, y=1.0, events=bounce(s), method="gauss4", step=1e-3, samples=11)
    assert run.success
    assert run.events["bounce"].t == pytest.approx(FALL * np.array([1, 2]), abs=1e-6)
    assert run.events["bounce"].y[1] == pytest.approx(-9.81 * FALL * np.array([1, 0.5]), rel=1e-5)


def test_events_that_make_no_sense_are_refused() -> None:
    s = ball()
    y = s["y"]
    for make, words in (
        (lambda: lg.event(y, direction=2), "direction of an event is"),
        (lambda: lg.event(3), "never changes"),
        (lambda: lg.event(" "), "text of an event is empty"),
        (lambda: s.simulate(1, y=1, events=lg.event("y.x")), "attribute access"),
        (lambda: s.simulate(1, y=1, events=lg.event("2*3")), "never changes"),
        (lambda: lg.event(y, reset=[1]), "reset must be a mapping"),
        (lambda: s.simulate(1, y=1, events=[y]), "made with lagrangian.event"),
        (lambda: s.simulate(1, y=1, events=[lg.event(y), lg.event(y)]), "two events are called 'y'"),
        (lambda: s.simulate(1, y=1, events=lg.event(y, reset={s["m"]: 2})), "sets 'm', which is not a state"),
        (lambda: s.simulate(1, y=1, events=lg.event(lg.System("other").coordinate("z"))), "unknown symbol 'z'"),
    ):
        with pytest.raises((lg.ModelError, lg.RunError), match=words):
            make()


@pytest.mark.parametrize("method", METHODS)
def test_what_the_last_impact_takes_is_accounted_for(method: str) -> None:
    """A terminal event that changes the state as well: the last sample is the state after it."""
    s = ball(e=0.5)
    y = s["y"]
    last = lg.event(y, direction=-1, terminal=True, reset={y.diff(): -s["e"] * y.diff()}, name="last")
    run = s.simulate(2.0, y=1.0, events=last, method=method, samples=14)
    assert run.t[-1] == pytest.approx(FALL, rel=1e-9)
    assert run["y'"][-1] == pytest.approx(0.5 * 9.81 * FALL, rel=1e-8)
    assert run.events["last"].y[1] == pytest.approx([-9.81 * FALL], rel=1e-8)
    assert float(run.audit) < 1e-9


@pytest.mark.sampled(12)
@pytest.mark.parametrize("method", [*METHODS, "LSODA", "BDF", "RK23", "gauss4", "rk4"])
def test_no_crossing_between_the_places_a_step_is_judged_at_is_lost(method: str) -> None:
    """sin(30 t) has 28 zeros in (0, 3]; the amplitude less 1e-5 is passed twice within 9 ms of a step of some 0.5 s."""
    s = oscillator(m=1.0, k=1.0, b=0.0)
    q, t = s["q"], s.t
    options: dict[str, Any] = {"step": 0.05} if method in ("gauss4", "rk4") else {"rtol": 1e-7}
    beat = lg.event(sp.sin(30 * t), name="beat")
    peak = lg.event(q - (1 - 1e-5), name="peak")
    run = s.simulate(3.0, initial={"q'": 1.0}, events=[beat, peak], method=method, **options)
    assert run.events["beat"].t == pytest.approx(np.arange(1, 29) * np.pi / 30, abs=1e-12)
    half = np.arccos(1 - 1e-5)
    assert run.events["peak"].t == pytest.approx(np.pi / 2 + np.array([-half, half]), abs=1e-3)
    top = lg.event(q - (1 - 1e-5), direction=1, terminal=True, name="top")
    ended = s.simulate(3.0, initial={"q'": 1.0}, events=top, method=method, **options)
    assert ended.status == 1 and ended.t[-1] == pytest.approx(np.pi / 2 - half, abs=1e-3)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_what_dips_through_zero_is_found_and_what_stays_short_of_it_is_not(method: str) -> None:
    """(q − 1/2)² ∓ 1e-8 along q = sin t: two crossings at each of two places, 2e-4 apart, or none."""
    s = oscillator(m=1.0, k=1.0, b=0.0)
    dip = (s["q"] - 0.5) ** 2
    events = [lg.event(dip - 1e-8, name="through"), lg.event(dip + 1e-8, name="short")]
    run = s.simulate(3.0, initial={"q'": 1.0}, events=events, method=method)
    exact = [np.arcsin(0.5 - 1e-4), np.arcsin(0.5 + 1e-4)]
    exact = [*exact, np.pi - exact[1], np.pi - exact[0]]
    assert run.events["through"].t == pytest.approx(np.array(exact), abs=1e-6)
    assert not len(run.events["short"].t)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_a_rise_right_after_a_fall_is_found(method: str) -> None:
    """A condition that counts rising only has fallen before within the same step: cos 40 t in 3 s."""
    s = oscillator(m=1.0, k=1.0, b=0.0)
    run = s.simulate(3.0, q=1.0, events=lg.event(sp.cos(40 * s.t), direction=1, name="up"), method=method)
    assert run.events["up"].t == pytest.approx((np.arange(19) * 2 + 1.5) * np.pi / 40, abs=1e-12)


@pytest.mark.parametrize("method", ["dop853", "Radau"])
def test_a_condition_that_stays_zero_is_no_event(method: str) -> None:
    """A force that is zero throughout, and a state that rests."""
    s = oscillator(m=1.0, k=1.0, b=0.0)
    still = [lg.event(s["F"], name="force"), lg.event(s["q"] * s["q"].diff(), name="rest")]
    run = s.simulate(3.0, events=still, method=method)
    assert run.success and not len(run.events["force"].t) and not len(run.events["rest"].t)


@pytest.mark.slow
def test_ten_thousand_crossings_are_found_in_one_run() -> None:
    s = oscillator(m=1.0, k=1.0, b=0.0)
    crossing = lg.event(sp.cos(3300 * s.t) - s["q"] / 2, name="crossing")
    run = s.simulate(10.0, q=1.0, events=crossing)
    assert run.success, run.message
    t = np.linspace(0, 10, 2_000_001)  # 190 places between two crossings
    value = np.cos(3300 * t) - np.cos(t) / 2
    assert len(run.events["crossing"].t) == np.count_nonzero(value[1:] * value[:-1] < 0) > 10_000


@pytest.mark.slow
@pytest.mark.parametrize("method", ["DOP853", "LSODA"])
def test_a_thousand_crossings_in_a_step_of_scipys_are_found(method: str) -> None:
    s = oscillator(m=1.0, k=1.0, b=0.0)
    run = s.simulate(1.5, q=1.0, events=lg.event(sp.cos(3300 * s.t), name="crossing"), method=method)
    assert run.events["crossing"].t == pytest.approx((np.arange(1576) + 0.5) * np.pi / 3300, abs=1e-12)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_many_events_are_not_called_accumulating(method: str) -> None:
    s = oscillator(m=1.0, k=1.0, b=0.0)
    events = lg.event(sp.sin(7 * s.t), name="beat")
    run = s.simulate(10.0, q=1.0, events=events, method=method, rtol=1e-6, max_events=5)
    assert run.status == -9 and not run.success
    assert "gave up after 5 events, the last of them 'beat'" in run.message and "max_events" in run.message
    assert run.events["beat"].t == pytest.approx(np.arange(1, 6) * np.pi / 7)


ALL = [*METHODS, "LSODA", "BDF", "RK23", "RK45", "gauss4", "rk4"]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("method", ALL)
def test_a_condition_that_becomes_no_number_ends_the_run_by_name(method: str) -> None:
    """sqrt(q) − 1/2 along q = cos t: it falls at arccos(1/4), and has no value from π/2 on."""
    s = oscillator(m=1.0, k=1.0, b=0.0)
    root = lg.event(sp.sqrt(s["q"]) - sp.Rational(1, 2), name="root")
    options: dict[str, Any] = {"step": 0.02} if method in ("gauss4", "rk4") else {}
    run = s.simulate(10.0, q=1.0, events=root, method=method, **options)
    assert not run.success and run.status == -10
    assert run.events["root"].t == pytest.approx([np.arccos(0.25)], abs=1e-4)
    assert run.t[-1] == pytest.approx(np.pi / 2, abs=1e-4) and abs(run["q"][-1]) < 1e-12
    assert "[E503] the condition of event 'root', sqrt(q) - 1/2, is not a number a moment later" in run.message
    assert "derivative" not in run.message
    below = s.simulate(10.0, q=-1.0, events=root, method=method, **options)
    assert below.status == -10 and below.t[-1] == 0.0
    assert "'root', sqrt(q) - 1/2, is not a number there" in below.message


@pytest.mark.sampled(4)
@pytest.mark.parametrize("method", ALL)
def test_a_gap_between_two_numbers_inside_a_step_is_no_crossing(method: str) -> None:
    """q sqrt(q² − 1e-4) is above 0 before q = 0.01, below after −0.01, and no number between."""
    s = oscillator(m=1.0, k=1.0, b=0.0)
    q = s["q"]
    gap = lg.event(q * sp.sqrt(q**2 - sp.Rational(1, 10000)) - sp.Rational(1, 10**9), name="gap", direction=-1)
    options: dict[str, Any] = {"step": 0.1} if method in ("gauss4", "rk4") else {"rtol": 1e-6}
    run = s.simulate(2.0, q=1.0, events=gap, method=method, **options)
    assert run.status == -10 and run["q"][-1] == pytest.approx(0.01, abs=1e-4)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("method", ALL)
def test_an_event_at_the_edge_comes_before_what_has_no_value_beyond_it(method: str) -> None:
    s = oscillator(m=1.0, k=1.0, b=0.0)
    events = [lg.event(sp.sqrt(s["q"]) - 2, name="root"), lg.event(s["q"], terminal=True, name="edge")]
    options: dict[str, Any] = {"step": 0.02} if method in ("gauss4", "rk4") else {}
    run = s.simulate(10.0, q=1.0, events=events, method=method, **options)
    assert run.status == 1 and run.t[-1] == pytest.approx(np.pi / 2, abs=1e-4)


def test_each_run_of_an_ensemble_says_that_a_condition_is_no_number() -> None:
    s = oscillator(m=1.0, k=1.0, b=0.0)
    root = lg.event(sp.sqrt(s["q"] + 1.5) - 1, name="root")
    runs = s.ensemble(3.0, initial={"q": np.linspace(0.5, 3.0, 11)}, events=root)
    assert runs.status.tolist() == [0] * 4 + [0 if q <= 1.5 else -10 for q in np.linspace(0.5, 3.0, 11)[4:]]
    assert "the condition of an event is not a number" in str(runs.failures()[0])
