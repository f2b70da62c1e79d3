"""What drives a run: constants, text, expressions, feedback, tables, Python functions; and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
from run_systems import example, held_values, oscillator

import lagrangian as lg
from lagrangian.integrate import METHODS


def test_a_constant_a_text_with_a_unit_and_a_symbol_are_one() -> None:
    s = oscillator()
    runs = [
        s.simulate(2.0, inputs=i, samples=5)
        for i in ({"F": 3.0}, {s["F"]: "3 N"}, {"F": "300 cN"}, {"F": sp.Integer(3)})
    ]
    for run in runs:
        assert run["q"] == pytest.approx(runs[0]["q"], rel=1e-12)
        assert run["F"] == pytest.approx(np.full(5, 3.0))


def test_feedback_of_the_state_is_compiled_in() -> None:
    """F = −K q on m q̈ + k q = F is a stiffer spring."""
    s = oscillator(m=2.0, k=8.0, b=0.0)
    q = s["q"]
    for law in (-10 * q, "-10*q", lambda t, x: -10 * x[0]):
        run = s.simulate(2.0, q=1.0, inputs={"F": law}, samples=9)
        assert run["q"] == pytest.approx(np.cos(3 * run.t), abs=1e-9)
        assert run["F"] == pytest.approx(-10 * run["q"], abs=1e-9)
        assert float(run.audit) < 1e-9  # the feedback's work is counted as supplied
    assert "Python function" in run.message and run.method == "DOP853"


@pytest.mark.parametrize("method", ["dop853", "tsit5", "rk4", "DOP853", "LSODA"])
def test_a_held_table_jumps_where_it_says(method: str) -> None:
    """A unit mass alone: q̈ = F, in two pieces of constant force."""
    s = lg.System("mass")
    q, F = s.coordinate("q"), s.input("F")
    s.particle(s.parameter("m", 1.0), at=s.origin + (q, 0))
    s.force(F, deflection=q)
    step = {"step": 0.05} if method in METHODS and not METHODS[method].adaptive else {}
    run = s.simulate(2.0, inputs={F: ([0.0, 0.5], [1.0, -2.0], "hold")}, samples=9, method=method, **step)
    after = np.maximum(run.t - 0.5, 0.0)
    before = np.minimum(run.t, 0.5)
    wanted = 0.5 * before**2 + 0.5 * after - after**2
    assert run["q"] == pytest.approx(wanted, abs=1e-10)
    assert run["F"] == pytest.approx([held_values(t) for t in run.t])
    assert float(run.audit) < 1e-9


def test_a_linear_table_is_joined_by_lines() -> None:
    s = lg.System("mass")
    q, F = s.coordinate("q"), s.input("F")
    s.particle(s.parameter("m", 1.0), at=s.origin + (q, 0))
    s.force(F, deflection=q)
    run = s.simulate(1.0, inputs={F: ([-1.0, 0.0, 1.0, 2.0], [5.0, 0.0, 6.0, 0.0])}, samples=5)
    assert run["q"] == pytest.approx(run.t**3, abs=1e-12)  # q̈ = 6 t
    two = s.simulate(1.0, inputs={F: ([0.0, 0.3, 1.0], [0.0, 0.3, 1.0])}, samples=5, method="rk4", step=0.1)
    assert two["q"] == pytest.approx(two.t**3 / 6, abs=1e-14)


def test_inputs_of_different_kinds_run_together() -> None:
    s = example("crane")
    run = s.simulate(
        1.0, inputs={"F": "-2*x' + 0.1*F_h", "F_h": ([0.0, 0.4], [-1.0, -3.0], "hold")}, samples=6, method="dop853"
    )
    slow = s.simulate(
        1.0,
        inputs={
            "F": lambda t, x: -2 * x[3] + 0.1 * (-1.0 if t < 0.4 else -3.0),
            "F_h": ([0.0, 0.4], [-1.0, -3.0], "hold"),
        },
        samples=6,
    )
    assert run.success and slow.success
    assert run.y == pytest.approx(slow.y, abs=1e-8)
    assert run["F"] == pytest.approx(-2 * run["x'"] + 0.1 * run["F_h"])


@pytest.mark.slow
def test_a_potential_that_reads_an_input_is_in_the_balance() -> None:
    """A spring whose end is moved: m q̈ = −k (q − w)."""
    s = lg.System("pulled")
    q, w = s.coordinate("q"), s.input("w")
    m, k = s.parameters("m k", m=1.0, k=4.0)
    s.particle(m, at=s.origin + (q, 0))
    s.spring(k, deflection=q - w)
    for law in ("0.5*t", ([0.0, 2.0], [0.0, 1.0])):
        run = s.simulate(2.0, inputs={w: law}, samples=9)
        assert run["q"] == pytest.approx(0.5 * run.t - 0.25 * np.sin(2 * run.t), abs=1e-9)
        assert float(run.audit) < 1e-9


REFUSED = [
    ({"G": 1.0}, "there is no input 'G'"),
    ({"F": "3*qq"}, "unknown symbol 'qq'"),
    ({"F": "3 kg"}, "has the unit kg, but N is needed"),
    ({"F": "__import__('os')"}, "E70"),
    ({"F": float("nan")}, "input 'F' is nan"),
    ({"F": ([0, 1], [1.0])}, "times have shape"),
    ({"F": ([0, 1, 1], [1.0, 2.0, 3.0])}, "do not increase"),
    ({"F": ([0, 1], [1.0, float("inf")])}, "value number 2 is inf"),
    ({"F": ([0.5, 5], [1.0, 2.0])}, "the table covers 0.5 to 5 s"),
    ({"F": ([0, 0.5], [1.0, 2.0])}, "the table covers 0 to 0.5 s"),
    ({"F": ([0, 5], [1.0, 2.0], "cubic")}, "a table is"),
    ({"F": lambda t: t}, "cannot be called with"),
    ({"F": 1j}, "must be a real number"),
    ([1.0], "inputs must be a mapping"),
]


@pytest.mark.parametrize(("inputs", "words"), REFUSED)
def test_inputs_that_do_not_fit_are_refused_before_the_run(inputs: object, words: str) -> None:
    with pytest.raises((lg.RunError, lg.ModelError), match=words):
        oscillator().simulate(1.0, inputs=inputs)


def test_accelerations_cannot_be_fed_back() -> None:
    s = oscillator()
    with pytest.raises(lg.ModelError, match="depends on an acceleration"):
        s.simulate(1.0, inputs={"F": s["q"].diff().diff()})


def test_a_python_function_does_not_go_with_machine_code() -> None:
    with pytest.raises(lg.RunError, match="cannot call the Python function of input 'F'"):
        oscillator().simulate(1.0, inputs={"F": lambda t, x: 0.0}, method="rk4", step=0.1)


def test_a_function_that_gives_nan_ends_the_run_and_is_named() -> None:
    run = oscillator().simulate(1.0, q=1.0, inputs={"F": lambda t, x: np.nan if t > 0.5 else 0.0})
    assert not run.success
    assert "input 'F' is nan at t = 0.5" in run.message
    assert 0.4 < run.t[-1] <= 0.5 and np.all(np.isfinite(run.y))
    with pytest.raises(lg.RunError, match="gave an array of shape"):
        oscillator().simulate(1.0, inputs={"F": lambda t, x: x})


def test_a_function_sees_the_states_and_cannot_change_them() -> None:
    seen: list[int] = []

    def spoil(t: float, x: np.ndarray) -> float:
        seen.append(len(x))
        x[:] = 1e6
        return 0.0

    run = oscillator(b=0.0).simulate(1.0, q=1.0, inputs={"F": spoil}, samples=5)
    assert run["q"] == pytest.approx(np.cos(2 * run.t), abs=1e-9)
    assert set(seen) == {2}  # q and q', not the energy that is carried along
