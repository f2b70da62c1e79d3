"""Runs in WebAssembly, in Node, against runs in machine code and closed forms; and what a page gets with them."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser_runs import in_node, needs_node
from run_systems import ball, oscillator
from test_drift import RELEASED, START, growing, plate_on_cranks
from test_sticking import FILE, last_stop
from test_switching import pushed, travelled

import built_in
import lagrangian as lg
from lagrangian.errors import Error, RunError
from lagrangian.integrate import METHODS
from lagrangian.simulate.browser import browser_module
from size import rest_slow

pytestmark = needs_node

EVERY = (
    "double-pendulum", "elastic-pendulum", "furuta-pendulum", "kapitza-pendulum", "spherical-pendulum", "acrobot",
    "crane", "cart-pole", "quarter-car", "segway", "robot-arm", "lecture-1", "lecture-3b", "two-disk-shaft",
    "four-bar", "slider-crank", "rolling-disc", "car", "stewart-platform", "whipple-bicycle", "ladder", "spinning-top",
)  # fmt: skip
"""Chaos, feedback and driven pivots; closed loops, rolling and floating frames from the four-bar on."""

CASES = [f"{name} {method}" for name in EVERY for method in METHODS]
QUICK = {*(f"{n} dop853" for n in EVERY[:12]), *(f"double-pendulum {m}" for m in METHODS), "four-bar rk4"}
STEP = {"rk4": 0.005, "gauss4": 0.005}


def refused(system: lg.System, method: str) -> str:
    """Why a run in machine code cannot be made, empty if it can."""
    try:
        system.simulate(0.01, samples=2, method=method, **({"step": 0.005} if method in STEP else {}))
    except Error as error:
        return error.what
    return ""


@pytest.mark.thinned(7)
@pytest.mark.sampled(20)
@pytest.mark.parametrize("case", rest_slow(CASES, QUICK))
def test_a_run_is_that_of_machine_code(case: str, tmp_path: Path) -> None:
    name, method = case.split()
    system = built_in.system(name)
    step: Any = {"step": STEP[method]} if method in STEP else {}
    if why := refused(system, method):
        with pytest.raises(Error) as caught:
            browser_module(system, method)
        assert caught.value.what == why
        return
    module = browser_module(system, method, **step)
    (found,) = in_node(module, "show(compiled().solve({t1: 1, samples: 11}));", tmp_path)
    run = system.simulate(1.0, samples=11, method=method, **step)
    assert found["status"] == run.status
    n = len(found["t"])  # a run that fails stores its last state besides
    assert n == len(run.t) - (run.status != 0) and found["reached"] == pytest.approx(run.t[-1], rel=1e-9)
    np.testing.assert_allclose(found["t"], run.t[:n], rtol=1e-15)
    np.testing.assert_allclose(np.array(found["states"]).T, run.y[:, :n], rtol=1e-9, atol=1e-9)
    assert abs(found["steps"] - run.steps) <= 0.1 * run.steps + 2


# Parameters, inputs, starts ----------------------------------------------------------------------------------------


def test_parameters_inputs_and_starts_are_changed_by_name_or_order(tmp_path: Path) -> None:
    system = built_in.system("cart-pole")
    module = browser_module(system)
    shown = in_node(
        module,
        """const s = compiled(), m = physics.layout.parameters.map((p) => (p.name === "m" ? 0.5 : p.value));
        show(s.solve({t1: 1, samples: 5, params: {m: 0.5}, inputs: {F: 2}, state: {theta: 0.3}}));
        show(s.solve({t1: 1, samples: 5, params: m, inputs: [2], state: [0, 0.3, 0, 0]}));
        for (const o of [{params: {q: 1}}, {state: [1]}, {inputs: {F: NaN}}, {t1: 0}, {samples: 1}, {rtol: -1}])
          show(refused(() => s.solve(o)));""",
        tmp_path,
    )
    start = {"x": 0.0, "theta": 0.3, "x'": 0.0, "theta'": 0.0}
    run = system.simulate(1.0, samples=5, params={"m": 0.5}, inputs={"F": 2.0}, initial=start)
    np.testing.assert_allclose(np.array(shown[1]["states"]).T, run.y, rtol=1e-9, atol=1e-10)
    by_name = system.simulate(1.0, samples=5, params={"m": 0.5}, inputs={"F": 2.0}, theta=0.3)
    np.testing.assert_allclose(np.array(shown[0]["states"]).T, by_name.y, rtol=1e-9, atol=1e-10)
    said = ["there is no 'q'; known: M, m", "state: 1 values, needed are 4", "'F' is NaN", "times must increase",
            "samples must be", "rtol must be a number above 0"]  # fmt: skip
    assert all(x.startswith("RangeError") and y in x for x, y in zip(shown[2:], said, strict=True))


def test_a_live_run_is_the_whole_run_and_can_be_changed(tmp_path: Path) -> None:
    system = built_in.system("pendulum")
    (live, changed, many) = in_node(
        browser_module(system),
        """const s = compiled().start({state: {theta: 1}});
        let r; for (let k = 0; k < 60; k++) r = s.advance(1 / 60);
        show(r);
        s.change({params: {L: 2}, t: 0});
        show(s.advance(0.5));
        show(s.many({states: [1, 0, 0.5, 0, 0.25, 0], count: 3, t1: 1}));""",
        tmp_path,
    )
    run = system.simulate(1.0, samples=2, theta=1.0)
    assert live["status"] == 0 and live["t"] == pytest.approx(1.0, rel=1e-14)
    np.testing.assert_allclose(live["state"], run.y[:, -1], atol=1e-9)
    longer = system.simulate(0.5, samples=2, initial=run.y[:, -1], params={"L": 2.0})
    np.testing.assert_allclose(changed["state"], longer.y[:, -1], atol=1e-9)
    ends = [system.simulate(1.0, samples=2, theta=x).y[:, -1] for x in (1.0, 0.5, 0.25)]
    np.testing.assert_allclose(np.reshape(many["final"], (3, 2)), ends, atol=1e-9)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("method", ["dop853", "rk4"])
def test_two_lanes_give_the_numbers_of_one(method: str, tmp_path: Path) -> None:
    system = built_in.system("double-pendulum")
    script = """const n = 7, states = Float64Array.from({length: 4 * n}, (_, k) => (k % 4 < 2 ? 0.1 * k : 0));
    show(compiled().many({states, t1: 1}));"""
    one, two = (in_node(browser_module(system, method, lanes=lanes), script, tmp_path)[0] for lanes in (1, 2))
    assert one["status"] == two["status"] == [0] * 7
    np.testing.assert_allclose(two["final"], one["final"], rtol=1e-9, atol=1e-9)


# Events, tables, conditions ----------------------------------------------------------------------------------------


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", ["dop853", "taylor", "gauss4"])
def test_a_ball_bounces_when_it_should(method: str, tmp_path: Path) -> None:
    s = ball(e=0.5)
    y = s["y"]
    events = [
        lg.event(y, direction=-1, reset={y.diff(): -s["e"] * y.diff()}, name="bounce"),
        lg.event(y - 0.1, direction=1, name="up"),
    ]
    module = browser_module(s, method, events=events, initial={"y": 1.0})
    (found, endless) = in_node(
        module, "const s = compiled(); show(s.solve({t1: 1.3, samples: 14})); show(s.solve({t1: 2}));", tmp_path
    )
    fall = np.sqrt(2 / 9.81)
    bounces = [e for e in found["events"] if e["name"] == "bounce"]
    assert found["status"] == 0
    np.testing.assert_allclose([e["t"] for e in bounces], fall * np.array([1, 2, 2.5, 2.75, 2.875]), rtol=1e-9)
    np.testing.assert_allclose([e["state"][1] for e in bounces], -9.81 * fall * 0.5 ** np.arange(5), rtol=1e-8)
    assert [e["name"] for e in found["events"]].count("up") == 1  # the second rebound rises to 1/16 m
    assert endless["status"] == s.simulate(2.0, y=1.0, events=events[:1]).status == -4
    assert "accumulate" in endless["message"] and endless["reached"] == pytest.approx(3 * fall, rel=1e-6)


def test_a_terminal_event_ends_the_run_there(tmp_path: Path) -> None:
    s = ball()
    half = lg.event(s["y"] - 0.5, terminal=True, name="half")
    module = browser_module(s, events=half, initial={"y": 1.0})
    (found, live) = in_node(
        module, "const s = compiled(); show(s.solve({t1: 1, samples: 11})); s.start(); show(s.advance(1));", tmp_path
    )
    for run, state in ((found, found["final"]), (live, live["state"])):
        assert run["status"] == 1 and [e["name"] for e in run["events"]] == ["half"]
        assert state[0] == pytest.approx(0.5, abs=1e-10)
    assert found["reached"] == live["t"] == pytest.approx(np.sqrt(1 / 9.81), rel=1e-10)
    assert found["t"] == pytest.approx([0.0, 0.1, 0.2, 0.3])


PULSES = {
    "a condition": "piecewise(t < t1, 0, t < t2, 30, 0)",
    "a sign": "15*(sign(t - 5) - sign(t - 5.01))",
    "a table": ([0.0, 5.0, 5.01, 10.0], [0.0, 30.0, 0.0, 0.0], "hold"),
}


@pytest.mark.sampled(10)
@pytest.mark.parametrize("method", ["dop853", "rk4"])
@pytest.mark.parametrize("kind", PULSES)
def test_a_short_pulse_is_not_jumped_over(kind: str, method: str, tmp_path: Path) -> None:
    module = browser_module(pushed(), method, inputs={"F": PULSES[kind]}, step=0.1 if method == "rk4" else None)
    more = "show(compiled().solve({t1: 10, samples: 2, params: {t1: 3, t2: 3.01}}));" if kind == "a condition" else ""
    script = "for (const s of [compiled(), fallback()]) show(s.solve({t1: 10, samples: 2, step: 0.1}));" + more
    if method == "dop853":
        script = script.replace(", step: 0.1", "")
    for k, found in enumerate(in_node(module, script, tmp_path)):
        first = 3.0 if k == 2 else 5.0
        assert found["final"] == pytest.approx([travelled(30.0, first, first + 0.01, 10.0), 0.15], rel=1e-7)


@pytest.mark.parametrize("kind", ["compiled", "fallback"])
def test_the_energy_supplied_is_told(kind: str, tmp_path: Path) -> None:
    """2 N on 2 kg: after 3 s they move at 3 m/s, and have 9 J."""
    script = f"""const s = {kind}(); show(physics.layout.supply); show(s.solve({{t1: 3, samples: 4}}));
    show(s.start().advance(3));"""
    supply, run, live = in_node(browser_module(pushed(), inputs={"F": 2.0}), script, tmp_path)
    assert supply is True
    np.testing.assert_allclose(run["supplied"], [0.0, 1.0, 4.0, 9.0], rtol=1e-12)
    assert live["supplied"] == pytest.approx(9.0, rel=1e-12)


def test_a_table_of_straight_lines_is_followed(tmp_path: Path) -> None:
    """F rises to 4 N in 2 s and falls to 0 in 1 s: 2 kg gain (4 + 2)/2 m/s."""
    module = browser_module(pushed(), inputs={"F": ([0.0, 2.0, 3.0], [0.0, 4.0, 0.0])})
    for found in in_node(module, "for (const s of [compiled(), fallback()]) show(s.solve({t1: 3}));", tmp_path):
        assert found["final"][1] == pytest.approx(3.0, rel=1e-12)


def test_a_narrow_pulse_in_time_limits_the_steps(tmp_path: Path) -> None:
    """The area under a bell of width w is w √π: this force pushes 2 kg to 10 · 0.001 √π / 2."""
    module = browser_module(pushed(), inputs={"F": "10*exp(-((t - 5)/0.001)^2)"})
    assert module.layout["defaults"]["maxStep"] < 0.01
    (found,) = in_node(module, "show(compiled().solve({t1: 10, samples: 2}));", tmp_path)
    assert found["final"][1] == pytest.approx(0.005 * np.sqrt(np.pi), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("method", ["dop853", "rk4"])
def test_a_run_that_sticks_says_so(method: str, tmp_path: Path) -> None:
    pendulum = lg.loads(FILE)
    module = browser_module(pendulum, method, initial={"theta": 1.0})
    (found,) = in_node(module, "show(compiled().solve({t1: 20, samples: 201}));", tmp_path)
    run = pendulum.simulate(20.0, theta=1.0, method=method, samples=201, **({"step": 1e-3} if method == "rk4" else {}))
    assert found["status"] == run.status == -8
    stop, angle = last_stop(1.0)
    assert found["reached"] == pytest.approx(stop, abs=0.11 if method == "rk4" else 1e-5)
    assert found["final"][0] == pytest.approx(angle, abs=1e-3)


@pytest.mark.slow
def test_a_reset_that_breaks_a_constraint_ends_the_run(tmp_path: Path) -> None:
    s = built_in.system("four-bar")
    angle = s.model.coordinates[0]
    event = lg.event(angle.symbol - angle.start - 0.1, reset={angle.symbol: angle.symbol + 1.0}, name="jump")
    module = browser_module(s, events=event)
    (found,) = in_node(module, "show(compiled().solve({t1: 1, samples: 11}));", tmp_path)
    run = s.simulate(1.0, samples=11, events=event)
    assert found["status"] == run.status == -11


@pytest.mark.slow
def test_rows_that_follow_from_others_are_left_out_as_long_as_they_do(tmp_path: Path) -> None:
    """The plate has a spare row all the time; the growing rod contradicts the other one after a while."""
    plate, rods = plate_on_cranks(), growing()
    script = "const s = compiled(); show(s.solve({t1: 2, samples: 201})); show(s.start().advance(2).status);"
    turned, status = in_node(browser_module(plate, initial=START), script, tmp_path)
    run = plate.simulate(2.0, initial=START, samples=201)
    assert turned["status"] == run.status == status == 0
    np.testing.assert_allclose(np.array(turned["states"]).T, run.y, rtol=1e-7, atol=1e-7)
    found, status = in_node(browser_module(rods, initial=RELEASED), script, tmp_path)
    run = rods.simulate(2.0, samples=201, **RELEASED)
    assert found["status"] == run.status == status == -13
    assert found["reached"] == pytest.approx(run.t[-1], abs=0.011)


@pytest.mark.parametrize("kind", ["compiled", "fallback"])
def test_a_mass_that_cannot_be_ends_a_run_where_it_begins(kind: str, tmp_path: Path) -> None:
    script = f"""const s = {kind}(), params = {{m2: 0}};
    show(s.solve({{t1: 1, params}})); show(s.start({{params}}).advance(1));
    show(s.change({{params: {{m2: 1}}}}).advance(1).status);
    const many = () => s.many({{states: physics.layout.start, t1: 1, params: [1, -1, 1, 1, 9.81]}});
    show(s.many ? refused(many) : "run 0: a mass");"""
    module = browser_module(built_in.system("double-pendulum"))
    run, live, healed, many = in_node(module, script, tmp_path)
    assert run["status"] == live["status"] == -7 and "a mass is not above 0" in run["message"]
    assert run["states"] == [module.layout["start"]] and live["state"] == module.layout["start"]
    assert healed == 0 and "run 0: a mass" in many


def test_limits_end_runs(tmp_path: Path) -> None:
    shown = in_node(
        browser_module(built_in.system("double-pendulum")),
        """const s = compiled(), f = fallback();
        for (const x of [s, f]) show(x.solve({t1: 10, maxSteps: 5}));
        for (const x of [s, f]) show(x.solve({t1: 1e6, samples: 2, maxSteps: 1e9, seconds: 1e-3}));
        for (const x of [s, f]) show(x.solve({t1: 1, state: {"theta1'": 1e200}, samples: 5}));""",
        tmp_path,
    )
    assert [run["status"] for run in shown] == [-3, -3, -6, -6, -2, -2]
    assert all(run["message"] for run in shown)


# The fallback, and what is refused ---------------------------------------------------------------------------------


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["double-pendulum", "four-bar", "crane", "rolling-disc"])
def test_without_webassembly_steps_are_fixed_and_less_exact(name: str, tmp_path: Path) -> None:
    system = built_in.system(name)
    (found,) = in_node(browser_module(system), "show(fallback().solve({t1: 1, samples: 11}));", tmp_path)
    run = system.simulate(1.0, samples=11)
    np.testing.assert_allclose(np.array(found["states"]).T, run.y, atol=1e-6)


@pytest.mark.slow
def test_the_fallback_is_taken_where_webassembly_is_forbidden(tmp_path: Path) -> None:
    forbidden = "WebAssembly.compile = () => Promise.reject(new WebAssembly.CompileError('CSP'));"
    module = browser_module(built_in.system("pendulum"))
    script = "physics.solver().then((s) => { show(s.kind); show(s.solve({t1: 1}).status); });"
    assert in_node(module, script, tmp_path) == ["wasm", 0]
    assert in_node(module, forbidden + script, tmp_path) == ["javascript", 0]
    bare = browser_module(built_in.system("pendulum"), fallback=False)
    assert in_node(bare, script, tmp_path) == ["wasm", 0]
    said = in_node(bare, forbidden + "physics.solver().catch((e) => show(e.message));", tmp_path)
    assert said == ["without WebAssembly, runs need the function 'rhs', which is left out"]


def test_what_a_browser_cannot_run_is_refused_with_the_reason() -> None:
    system = oscillator(m=1.0, k=1.0, b=0.0)
    with pytest.raises(RunError, match="'Radau' does not run in a browser"):
        browser_module(system, "Radau")
    with pytest.raises(RunError, match="cannot name a function"):
        browser_module(system, functions={"class": {"q": system["q"]}})
    with pytest.raises(RunError, match="is a Python function"):
        browser_module(built_in.system("cart-pole"), inputs={"F": lambda t, x: 0.0})


# What a page gets ---------------------------------------------------------------------------------------------------


def test_functions_give_energies_and_what_the_page_asked_for(tmp_path: Path) -> None:
    system = built_in.system("double-pendulum")
    bob = next(p for p in system.model.points if p.name)
    module = browser_module(system, functions={"anchors": {"bob": bob, "sum": system["theta1"] + system["theta2"]}})
    script = """const at = [Float64Array.of(0.3, -0.4, 1, 2), physics.layout.parameters.map((p) => p.value), [], 0];
    show([...physics.functions.energy(...at), ...physics.functions.anchors(...at)]);"""
    (found,) = in_node(module, script, tmp_path)
    dyn, q, v = system.compile(), [0.3, -0.4], [1.0, 2.0]
    wanted = [*dyn.energies(q, v), *dyn.point(bob, q)["r"], -0.1]
    np.testing.assert_allclose(found, wanted, rtol=1e-12)


def test_no_text_of_a_model_ends_a_script_element() -> None:
    s = lg.System("</script><script>alert(1)</script><!--")
    s.particle(s.parameter("m", 1.0, description="</script>"), at=s.origin + (s.coordinate("x", "</script>"), 0))
    script = browser_module(s).script()
    assert script.isascii() and "</" not in script and "<!--" not in script
    assert "alert" in json.loads(browser_module(s).layout_text)["name"]


def test_the_layout_is_plain_data_with_names_units_and_values() -> None:
    layout = json.loads(browser_module(built_in.system("cart-pole")).layout_text)
    assert [(s["name"], s["unit"]) for s in layout["states"]] == [
        ("x", "m"), ("theta", "rad"), ("x'", "m/s"), ("theta'", "rad/s"),
    ]  # fmt: skip
    assert {"name": "F", "unit": "N", "value": 0.0} in layout["inputs"] or layout["driven"] == ["F"]
    assert {"name": "M", "unit": "kg", "value": 1.0} in layout["parameters"]
    assert layout["statuses"]["-3"] == "the limit on the number of steps was reached"


@pytest.mark.slow
def test_the_python_of_the_manual_runs(tmp_path: Path) -> None:
    manual = (Path(__file__).parents[2] / "docs" / "browser.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", manual, re.DOTALL)
    names: dict[str, Any] = {}
    exec(compile(code, "docs/browser.md", "exec"), names)
    script = """const p = physics.layout.parameters.map((x) => x.value);
    show(physics.functions.bobs(Float64Array.of(0.5, 0.25, 0, 0), p, [], 0)); show(compiled().solve({t1: 5}).events);"""
    (total,), events = in_node(names["module"], script, tmp_path)
    assert total == 0.75 and {e["name"] for e in events} == {"through"}
