"""What people write at first, and what they are told: what is wrong and what would be right."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from typing import Any

import pytest
import sympy as sp

import lagrangian as lg
from built_in import SOME
from lagrangian import Error, examples


def swing(**values: float) -> lg.System:
    s = lg.System("swing")
    x, theta = s.coordinates("x theta")
    m, L = s.parameters("m L", m=1, L=1)
    bob = s.point("P", (x + L * sp.sin(theta), -L * sp.cos(theta)))
    s.particle(m, at=bob)
    s.particle(2, at=s.origin + (x, 0))
    s.gravity()
    return s


@pytest.fixture(scope="module")
def known() -> dict[str, Any]:
    s = swing()
    return {"s": s, "run": s.simulate(0.1, samples=3), "dyn": s.compile(), "d": s.derive()}


FIRST: dict[str, tuple[Callable[[dict[str, Any]], Any], str]] = {
    "constraint": (lambda k: k["s"].add_constraint(0), "constraint(between=(P, Q))"),
    "no slip": (lambda k: k["s"].no_slip(0), "rolling(body, at=P, along=…)"),
    "eom": (lambda k: k["s"].eom, "derive().equations"),
    "run": (lambda k: k["s"].run(10), "simulate(10.0"),
    "point mass": (lambda k: k["s"].point_mass(1), "particle(mass, at=P)"),
    "misspelled": (lambda k: k["s"].simulat(1), "Did you mean 'simulate'?"),
    "derivation": (lambda k: k["d"].M, "mass_matrix"),
    "a state as an attribute": (lambda k: k["run"].theta, 'run["theta"]'),
    "time": (lambda k: k["run"].time, "Fix: t"),
    "accelerations": (lambda k: k["dyn"].accelerations([0, 0], [0, 0]), "forward(q, v, u)"),
    "pos": (lambda k: k["s"].particle(1, pos=k["s"].origin), "Did you mean 'at'?"),
    "no at": (lambda k: k["s"].particle(1), "particle needs 'at'"),
    "stiffness": (lambda k: k["s"].spring(stiffness=1, deflection=k["s"]["x"]), "Did you mean 'k'?"),
    "length": (lambda k: k["s"].spring(1, deflection=k["s"]["x"], length=1), "Did you mean 'rest'?"),
    "c": (lambda k: k["s"].damper(c=1, deflection=k["s"]["x"]), "Did you mean 'b'?"),
    "I": (lambda k: k["s"].rigid_body(1, I=1, at=k["s"]["P"], frame=k["s"]["theta"]), "Did you mean 'inertia'?"),
    "two by position": (lambda k: k["s"].coordinates("a", "b"), "takes 1 argument by position (got 2)"),
    "ends by position": (lambda k: k["s"].spring(1, k["s"].origin, k["s"]["P"]), "between=None"),
    "no name": (lambda k: lg.System(), "System needs 'name'"),  # type: ignore[call-arg]
    "gravity of a number": (lambda k: k["s"].gravity(9.81), "gravity(direction=(0, -1), g=9.81)"),
    "a span": (lambda k: k["s"].simulate((0, 10)), "one number, not a span"),
    "t_span": (lambda k: k["s"].simulate(t_span=(0, 10)), "give the duration as the first argument"),
    "y0": (lambda k: k["s"].simulate(1, y0=[0, 0, 0, 0]), "initial={'x': 0.2}"),
    "dt": (lambda k: k["s"].simulate(1, dt=0.1), 'step=0.01 with method="rk4"'),
    "theta_dot": (lambda k: k["s"].simulate(1, theta_dot=1), "the rate of theta is theta'"),
    "metres for an angle": (lambda k: k["s"].simulate(1, theta="10 m"), "has the unit m, but rad"),
    "a parameter of a sweep": (lambda k: k["s"].sweep(1, m=[1, 2]), "params={'m': …}"),
    "a point's name for a point": (lambda k: k["s"].point("A", k["s"]["P"]), "relative_to=P"),
    "a file's name for its text": (lambda k: lg.loads("arm.toml"), "load('arm.toml')"),
    "a slice of a system": (lambda k: k["s"][1:2], '[E402] system[…] takes a name (got slice)\nFix: system["theta"]'),
    "a number in brackets": (lambda k: k["s"][0], "system[…] takes a name (got int)"),
    "a typed expression": (lambda k: k["run"]["x + thet"], "[E402] quantity asked of the run, column 5: unknown"),
    "a typed value": (lambda k: k["s"].simulate("10 ss"), "[E408] duration, column 4: unknown unit"),
    "a typed answer": (lambda k: k["d"].check("V = 0\nT = )"), "[E701] the answer, line 2, column 5: this ')' has no"),
    "constraint in a file": (
        lambda k: lg.loads(examples.text("pendulum") + '\n[[constraint]]\nvalue = "x"\n'),
        "known: name, expression, between, distance, axes",
    ),
}


@pytest.mark.parametrize("case", FIRST)
def test_a_first_try_is_answered_with_what_is_meant(case: str, known: dict[str, Any]) -> None:
    call, said = FIRST[case]
    with pytest.raises(Error) as caught:
        call(known)
    assert said in str(caught.value), str(caught.value)


def test_python_still_knows_what_kind_of_mistake_it_is(known: dict[str, Any]) -> None:
    assert not hasattr(known["s"], "eom")
    assert getattr(known["run"], "theta", None) is None
    with pytest.raises(TypeError):
        known["s"].particle(1)
    with pytest.raises(AttributeError):
        known["s"].__wrapped__  # noqa: B018 - the look-up is what is tested


def test_a_mistake_inside_a_function_that_was_called_rightly_stays(known: dict[str, Any]) -> None:
    with pytest.raises(Error, match="cannot take a symbol"):
        known["s"].spring(law=lambda: 1, deflection=known["s"]["x"])


def test_copies_are_whole(known: dict[str, Any]) -> None:
    assert copy.copy(known["s"]).name == "swing"
    assert copy.deepcopy(known["run"]).success
    assert pickle.loads(pickle.dumps(known["d"].verified)) == known["d"].verified


def test_gravity_that_was_left_out_is_noted() -> None:
    s = lg.System("swing without weight")
    theta = s.coordinates("theta")
    s.particle(1, at=s.origin + (sp.sin(theta), -sp.cos(theta)))
    assert [n.code for n in s.notices] == ["E107"]
    s.gravity()
    assert s.notices == ()
    sleigh = lg.System("seen from above")
    x, y, psi = sleigh.coordinates("x y psi")
    knife = sleigh.point("K", (x, y))
    frame = sleigh.frame(psi, origin=knife)
    sleigh.rigid_body(1, 1, at=frame.point(1, 0), frame=frame)
    sleigh.velocity_constraint(y.diff() * sp.cos(psi) - x.diff() * sp.sin(psi), name="knife edge")
    assert sleigh.notices == ()
    t = lg.System("a g without gravity")
    x = t.coordinates("x")
    t.parameter("g", 9.81)
    t.particle(1, at=t.origin + (x, 0))
    t.spring(1, deflection=x)
    assert "no gravity uses it" in t.notices[0].text


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", examples.names())
def test_the_examples_give_no_cause_for_notices(name: str) -> None:
    assert lg.loads(examples.text(name)).notices == ()
