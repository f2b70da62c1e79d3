"""Runs that fail on their way keep what they reached and say why; what is wrong before the run is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp
from run_systems import ball, oscillator

import built_in
import lagrangian as lg
from lagrangian.errors import Error

REFUSED = [
    ({"duration": -1.0}, "duration is negative"),
    ({"duration": None}, "no duration is given"),
    ({"duration": "3 kg"}, "has the unit kg"),
    ({"duration": float("nan")}, "duration is nan"),
    ({"duration": 1.0, "qq": 1.0}, "no option or state 'qq'"),
    ({"duration": 1.0, "k": 1.0}, "no option or state 'k'"),
    ({"duration": 1.0, "F": 1.0}, "no option or state 'F'"),
    ({"duration": 1.0, "initial": {"p": 1.0}}, "there is no state 'p'"),
    ({"duration": 1.0, "initial": {"q": 1.0}, "q": 2.0}, "given twice"),
    ({"duration": 1.0, "initial": [1.0]}, "1 values for 2"),
    ({"duration": 1.0, "initial": {"q": "3 kg"}}, "has the unit kg"),
    ({"duration": 1.0, "initial": {"q": 1j}}, "must be a real number"),
    ({"duration": 1.0, "initial": {"q": float("inf")}}, "is inf"),
    ({"duration": 1.0, "params": {"kk": 1.0}}, "there is no parameter 'kk'"),
    ({"duration": 1.0, "params": {"k": float("nan")}}, "is nan"),
    ({"duration": 1.0, "method": "rk5"}, "there is no method 'rk5'"),
    ({"duration": 1.0, "method": "radau"}, "there is no method 'radau'"),
    ({"duration": 1.0, "method": "rk4"}, "uses a constant step size"),
    ({"duration": 1.0, "method": "rk4", "step": 0.0}, "step must be above 0"),
    ({"duration": 1.0, "step": 0.1}, "chooses its step size itself"),
    ({"duration": 1.0, "rtol": 0.0}, "rtol must be above 0"),
    ({"duration": 1.0, "atol": -1e-9}, "atol must be above 0"),
    ({"duration": 1.0, "samples": 1}, "samples must be a whole number"),
    ({"duration": 1.0, "samples": 10**9}, "more than a run can store"),
    ({"duration": 1.0, "max_steps": 0}, "max_steps must be"),
    ({"duration": 1.0, "timeout": 0.0}, "timeout must be above 0"),
    ({"duration": 1e-20, "start": 1e3}, "too short to change the time"),
    ({"times": [0.0, 2.0, 1.0]}, "times are out of order"),
    ({"times": [0.0, 1.0], "duration": 2.0}, "together with a duration or samples"),
    ({"times": [-1.0, 1.0]}, "before the start"),
    ({"times": [[0.0, 1.0]]}, "one row of numbers"),
    ({"times": [0.0, float("nan")]}, "time number 2 is not finite"),
    ({"times": "abc"}, "times must be real numbers"),
]


@pytest.mark.parametrize(("options", "words"), REFUSED, ids=[w for _, w in REFUSED])
def test_what_is_wrong_is_refused_before_the_run(options: dict, words: str) -> None:
    with pytest.raises((lg.RunError, lg.ModelError), match=words):
        oscillator().simulate(**options)


def test_parameters_without_a_value_are_listed() -> None:
    s = lg.System("bare")
    q = s.coordinate("q")
    m, k = s.parameters("m k")
    s.particle(m, at=s.origin + (q, 0))
    s.spring(k, deflection=q)
    with pytest.raises(lg.RunError, match=r"parameter 'm' has no value. Missing: m, k"):
        s.simulate(1.0)
    assert s.simulate(1.0, params={"m": 1, k: 4}, q=1.0)["q"][-1] == pytest.approx(np.cos(2.0), abs=1e-9)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("method", ["dop853", "taylor", "DOP853", "LSODA"])
def test_a_mass_matrix_that_becomes_singular_is_named(method: str) -> None:
    """A bead whose position is cos q: pushed to q = 0 it would have no mass left."""
    s = lg.System("cosine")
    q = s.coordinate("q")
    s.particle(s.parameter("m", 1.0), at=s.origin + (sp.cos(q), 0))
    s.potential(-2.0 * sp.cos(q))
    run = s.simulate(5.0, q=1.0, method=method)
    assert not run.success
    assert "[E203] the mass matrix is singular there: 'q' moves no mass" in run.message
    assert 0 < run.t[-1] < 5.0 and np.all(np.isfinite(run.y))
    assert f"t = {run.t[-1]:.9g}" in run.message


def light_arm() -> lg.System:
    """A Furuta pendulum whose arm weighs nothing: upright and hanging, two rates together move no mass."""
    s = lg.System("light arm")
    a, b = s.coordinates("alpha theta")
    m, L, l = s.parameters("m L l", m=0.1, L=0.25, l=0.15)
    bob = (L * sp.cos(a) - l * sp.sin(b) * sp.sin(a), L * sp.sin(a) + l * sp.sin(b) * sp.cos(a), l * sp.cos(b))
    s.particle(m, at=s.origin + bob)
    s.gravity(direction=(0, 0, -1))
    return s


@pytest.mark.slow
def test_rates_that_together_move_no_mass_are_named_with_their_ratio() -> None:
    """L α̇ + l θ̇ = 0 leaves the bob where it is."""
    s = light_arm()
    upright = "moving 'alpha' and 'theta' together, 1 : -1.667, moves no mass"
    with pytest.raises(lg.RunError, match=r"mass matrix is singular at alpha = 0, theta = 0: " + upright) as refused:
        s.linearize()
    assert refused.value.code == "E203" and "division" not in str(refused.value)
    text = " ".join(str(s.equilibria()).split())
    assert "moving α and θ together, 1 : -1.667, moves no mass" in text and "no other equilibrium in the box" in text
    still = s.simulate(0.1)
    assert upright in str(still.notices[0]) and not s.simulate(0.1, theta=1.0).notices
    run = s.simulate(1.0, theta=1.0)
    hanging = "the mass matrix is all but singular there: moving 'alpha' and 'theta' together, 1 : 1.667, moves no mass"
    assert not run.success and hanging in run.message
    assert np.isfinite(s.linearize(at={"theta": 1.0}, operating_point=True).A).all()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("method", ["dop853", "taylor", "tsit5", "Radau"])
def test_a_state_that_blows_up_keeps_what_was_reached(method: str) -> None:
    """q̈ = 2 q³ with q = 1, q̇ = 1: q = 1/(1 − t) is infinite at t = 1."""
    s = lg.System("blow-up")
    q = s.coordinate("q")
    s.particle(s.parameter("m", 1.0), at=s.origin + (q, 0))
    s.potential(-(q**4) / 2)
    run = s.simulate(2.0, q=1.0, initial={"q'": 1.0}, method=method)
    assert not run.success and run.status < 0
    assert run.t[-1] == pytest.approx(1.0, abs=1e-3)
    early = run.t < 0.9
    assert run["q"][early] == pytest.approx(1 / (1 - run.t[early]), rel=1e-6)
    assert "q = " in run.message and "Fix:" in run.message


@pytest.mark.parametrize("method", ["dop853", "taylor", "DOP853"])
def test_a_force_that_leaves_its_domain_is_told(method: str) -> None:
    s = lg.System("root")
    q = s.coordinate("q")
    s.particle(s.parameter("m", 1.0), at=s.origin + (q, 0))
    s.force(-sp.sqrt(q), deflection=q)
    run = s.simulate(10.0, q=1.0, method=method)
    assert not run.success
    assert run.t[-1] < 10.0 and np.all(np.isfinite(run.y))
    assert "E503" in run.message or "E504" in run.message


@pytest.mark.slow
def test_bounds_on_steps_and_time_end_a_run() -> None:
    s = oscillator()
    for method in ("dop853", "DOP853"):
        run = s.simulate(1000.0, q=1.0, max_steps=20, method=method)
        assert run.status == -3 and "gave up after 20 steps" in run.message
        assert 0 < run.t[-1] < 1000.0
    slow = s.simulate(1e7, q=1.0, timeout=0.2, samples=3)
    assert slow.status == -6 and "time allowed" in slow.message
    assert not slow.success and "FAILED" in repr(slow)


def test_a_failed_run_can_still_be_asked() -> None:
    s = ball()
    run = s.simulate(1.0, y=1.0, max_steps=2, method="RK45")
    assert not run.success
    assert run["y"] == pytest.approx(1 - 9.81 * run.t**2 / 2, abs=1e-6)
    assert len(run.to_csv().splitlines()) == len(run.t) + 1


def test_an_energy_that_is_not_finite_does_not_hide_the_run() -> None:
    """V = ln |q| has no value at q = 0, where the run starts."""
    s = lg.System("edge")
    q = s.coordinate("q")
    s.particle(s.parameter("m", 1.0), at=s.origin + (q, 0))
    s.potential(sp.log(sp.Abs(q)))
    run = s.simulate(0.5, q=0.0)
    assert not run.success and "the rate of 'q'' is nan" in run.message
    assert "no energy balance" in repr(run)
    with pytest.raises(lg.RunError, match="-inf"):
        np.sum(run.potential)


@pytest.mark.parametrize("method", ["dop853", "Radau"])
def test_samples_closer_than_doubles_can_tell_are_refused(method: str) -> None:
    with pytest.raises(lg.RunError, match="are too close to each other at t = 1e"):
        oscillator().simulate(1e-5, start=1e9, method=method)


def test_a_run_is_asked_by_name_and_not_by_number() -> None:
    run = oscillator().simulate(0.1, q=1.0, samples=3)
    with pytest.raises(lg.ModelError, match="takes a name or an expression") as refused:
        run[0]
    assert refused.value.code == "E406"
    assert np.array_equal(run["q"], run.y[0])


@pytest.mark.parametrize("events", [None, 3, ["x"]])
def test_what_is_no_event_is_refused(events: object) -> None:
    with pytest.raises(lg.RunError, match="an event is made with"):
        oscillator().simulate(0.1, events=events)
    with pytest.raises(lg.RunError, match="an event is made with"):
        oscillator().ensemble(0.1, initial={"q": [1.0, 2.0]}, events=events)


def test_numbers_with_an_imaginary_part_are_refused() -> None:
    values = np.array([1.0 + 1.0j, 2.0])
    with pytest.raises(lg.RunError, match="values must be real numbers"):
        oscillator().simulate(0.1, inputs={"F": (np.array([0.0, 1.0]), values)})
    with pytest.raises(lg.RunError, match="times must be real numbers"):
        oscillator().simulate(times=values)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"initial": {"q": [[1.0, 2.0], [3.0]]}}, "'q' is ragged"),
        ({"initial": {"q": [1.0]}, "reduce": 3}, "there is no reduction 3"),
        ({"initial": {"q": [1.0]}, "outputs": 3}, "an output is text or an expression"),
    ],
)
def test_ensembles_of_nonsense_are_refused(options: dict, words: str) -> None:
    with pytest.raises(lg.RunError, match=words):
        oscillator().ensemble(0.1, **options)


@pytest.mark.parametrize(
    ("asked", "attribute"),
    [
        ("energy", "energy"),
        ("energies", "energy"),
        ("kinetic energy", "kinetic"),
        ("T*", "kinetic"),
        ("V", "potential"),
    ],
)
def test_energies_that_are_asked_by_name_are_shown_where_they_are(asked: str, attribute: str) -> None:
    run = built_in.system("pendulum").simulate(0.01, samples=2)
    for ask in (lambda: run[asked], lambda: run.plot(asked)):
        with pytest.raises(Error, match=rf"run\.{attribute}; run\.plot\(energy=True\)"):
            ask()
    assert getattr(run, attribute).shape == (2,)


@pytest.mark.parametrize(
    ("given", "example"), [({"duration": "ten"}, "10 s"), ({"theta": "ten"}, "0.3"), ({"params": {"L": "ten"}}, "10 m")]
)
def test_a_word_for_a_number_is_answered_by_a_quantity_of_that_kind(given: dict[str, Any], example: str) -> None:
    with pytest.raises(Error) as caught:
        built_in.system("pendulum").simulate(**{"duration": 0.1, **given})
    assert f"such as {example}" in str(caught.value) and "40 N/m" not in str(caught.value)
