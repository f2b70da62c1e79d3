"""A, B, C, D against difference quotients of 50 digits, python-control and published figures."""

import json
import re
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from built_in import FREE, SOME
from built_in import system as built_in
from lagrangian import dynamics
from lagrangian.cli import main
from lagrangian.errors import ModelError, RunError
from lagrangian.graph import evaluate
from lagrangian.page.figures import complex_figure, figure

DIGITS = 50
STEP = mpmath.mpf(10) ** -15


def quotient(program, groups: dict[str, list[float]], by: str) -> np.ndarray:
    """∂ẋ/∂(group) by central differences of 50-digit evaluations: error of the order 1e-30."""
    columns = []
    with mpmath.workdps(DIGITS):
        for k in range(len(groups[by])):
            ends = []
            for sign in (1, -1):
                moved = [mpmath.mpf(x) for x in groups[by]]
                moved[k] += sign * STEP
                ends.append(evaluate(program, {**groups, by: moved}, digits=DIGITS)["xdot"])
            columns.append([float((a - b) / (2 * STEP)) for a, b in zip(*ends, strict=True)])
    return np.array(columns).T.reshape(len(program.inputs["x"]), len(groups[by]))


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", FREE)
def test_a_and_b_are_the_difference_quotient_of_the_motion(name: str) -> None:
    system = built_in(name)
    program = dynamics.rhs(system.model)
    source = np.random.default_rng(3)
    x = source.uniform(0.4, 1.2, len(program.inputs["x"]))
    u = source.uniform(-1, 1, len(program.inputs["u"]))
    found = system.linearize(
        dict(zip(program.inputs["x"], x, strict=True)),
        inputs=dict(zip(program.inputs["u"], u, strict=True)),
        operating_point=True,
        time=0.3,
    )
    groups = {"x": x.tolist(), "u": u.tolist(), "p": [p.value for p in system.model.parameters], "t": [0.3]}
    for got, by in ((found.A, "x"), (found.B, "u")):
        wanted = quotient(program, groups, by)
        assert np.abs(got - wanted).max(initial=0.0) <= 1e-10 * max(1.0, np.abs(wanted).max(initial=0.0))
    rates = np.array([float(r) for r in evaluate(program, groups)["xdot"]])
    assert np.allclose(found.drift, rates, rtol=1e-13, atol=1e-13)
    assert found.states == tuple(program.inputs["x"])


def test_the_cart_pole_of_the_michigan_tutorial() -> None:
    """Control Tutorials for MATLAB and Simulink (University of Michigan), Inverted Pendulum: System Modeling.

    M = 0.5 kg, m = 0.2 kg, b = 0.1 N/m/s, l = 0.3 m, I = 0.006 kg m²; their states are x, ẋ, φ, φ̇ with φ from upright.
    https://ctms.engin.umich.edu/CTMS/?example=InvertedPendulum&section=SystemModeling
    """
    found = built_in("cart-pole").linearize(params={"M": 0.5, "g": 9.8}, outputs=["x", "theta"])
    published_A = [[0, 1, 0, 0], [0, -0.1818, 2.6727, 0], [0, 0, 0, 1], [0, -0.4545, 31.1818, 0]]
    published_B = [[0], [1.8182], [0], [4.5455]]
    order = [found.states.index(s) for s in ("x", "x'", "theta", "theta'")]
    turn = np.diag([1, 1, -1, -1])  # the tutorial counts the pole's angle the other way
    assert np.allclose(turn @ found.A[np.ix_(order, order)] @ turn, published_A, atol=5e-5)
    assert np.allclose(turn @ found.B[order], published_B, atol=5e-5)
    assert found.stable is False


def test_a_point_that_is_no_equilibrium_is_refused() -> None:
    with pytest.raises(RunError, match=r"not an equilibrium.*theta'' = "):
        built_in("pendulum").linearize({"theta": 1.0})


def test_a_rest_typed_with_few_digits_is_moved_onto_it_and_says_so() -> None:
    found = built_in("pendulum").linearize({"theta": 3.14159})
    assert found.at["theta"] == pytest.approx(np.pi, abs=1e-15)
    assert "moved by" in found.notes[0]
    assert found.stable is False


def test_values_may_have_units_and_keys_may_be_symbols() -> None:
    system = built_in("pendulum")
    theta = system["theta"]
    found = system.linearize({theta: "180 deg", theta.diff(): 0})
    assert found.at == {"theta": pytest.approx(np.pi), "theta'": 0.0}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"thet": 0}, "Did you mean 'theta'"),
        ({"theta": 1j}, "real number"),
        ({"theta": float("nan")}, "nan"),
        ({"theta": "3 kg"}, "unit"),
        ({"theta": "three"}, "three"),
    ],
)
def test_bad_values_are_named(given: dict[str, object], message: str) -> None:
    with pytest.raises((RunError, ModelError), match=message):
        built_in("pendulum").linearize(given)


def test_a_parameter_without_a_value_is_listed() -> None:
    system = lg.System("s")
    x = system.coordinates("x")
    m, k, _ = system.parameters("m k c")
    system.particle(m, at=system.origin + (x, 0))
    system.spring(k, deflection=x)
    with pytest.raises(RunError, match="Missing: m, k, c"):
        system.linearize()


def test_a_singular_mass_matrix_is_said() -> None:
    with pytest.raises(RunError, match="mass matrix"):
        built_in("spherical-pendulum").linearize()


def test_outputs_may_be_any_expression() -> None:
    system = built_in("two-carts")
    x1, x2, F = system["x1"], system["x2"], system["F"]
    found = system.linearize(outputs={"far": x1 + x2, "push": 2 * F, "a": x1.diff().diff()})
    assert found.outputs == ("far", "push", "a")
    assert found.C[0].tolist() == [1, 1, 0, 0]
    assert found.D.T.tolist() == [[0, 2, found.B[2, 0]]]
    assert np.allclose(found.C[2], found.A[2], atol=1e-14)


@pytest.mark.slow
def test_a_drone_hovers_with_its_quaternion() -> None:
    """A floating body: twelve states, three small turns among them; thrust m g balances, tilt moves it at v̇ = g·θ."""
    system = lg.System("drone")
    base = system.floating_frame("base")
    system.rigid_body(2, (1, 2, 3), at=base.origin, frame=base)
    system.gravity(direction=(0, 0, -1))
    F = system.input("F")
    system.force((0, 0, F), at=base.origin, axes=base)
    found = system.linearize(inputs={"F": 2 * 9.81})
    assert found.kind == "rest" and found.A.shape == (12, 12)
    row = found.A[found.states.index("base_vx")]
    assert row[found.states.index("base_ry")] == pytest.approx(9.81)
    assert found.B[found.states.index("base_vz"), 0] == pytest.approx(0.5)
    assert found.mass is None
    with pytest.raises(RunError, match="symbolic matrices are available only at an equilibrium"):
        _ = found.symbolic
    with pytest.raises(RunError, match=r"base_vz' = -9\.81") as caught:
        system.linearize()
    assert caught.value.fix is not None and "equilibria" not in caught.value.fix
    assert system.linearize(operating_point=True).A.shape == (12, 12)  # what it advises works
    assert not system.equilibria()  # it falls
    with pytest.raises(ModelError, match="floating frame"):
        system.conserved_quantities()


def test_a_command_writes_text_and_data(capsys: pytest.CaptureFixture[str]) -> None:
    argv = [
        "linearize",
        "-e",
        "cart-pole",
        "--at",
        "theta=180 deg",
        "--set",
        "M=2 kg",
        "--output-of",
        "tip=x+l*sin(theta)",
    ]
    assert main([*argv, "--symbols"]) == 0
    text = capsys.readouterr().out
    assert "Verdict: marginal" in text and "In symbols" in text and "tip" in text
    assert main([*argv, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["outputs"] == ["tip"] and found["parameters"]["M"] == 2
    assert np.array(found["A"]).shape == (4, 4)


@pytest.mark.parametrize(
    ("argv", "message"),
    [
        (["--at", "theta"], "name=value"),
        (["--at", "theta=1", "--at", "theta=2"], "twice"),
        (["--at", "theta=1"], "not an equilibrium"),
        (["--at", "thta=1"], "Did you mean 'theta'"),
        (["--output-of", "x +"], "output"),
        (["--output-of", "__import__('os')"], "output"),
    ],
)
def test_a_mistake_in_a_command_is_one_message(
    capsys: pytest.CaptureFixture[str], argv: list[str], message: str
) -> None:
    assert main(["linearize", "-e", "cart-pole", *argv]) == 2
    captured = capsys.readouterr()
    assert captured.out == "" and message in captured.err and "Traceback" not in captured.err


def sliding(law: Any) -> lg.System:
    system = lg.System("sliding")
    x = system.coordinates("x")
    system.particle(2, at=system.origin + (x, 0))
    system.damper(deflection=x, law=law)
    return system


def test_a_point_at_a_kink_or_a_jump_is_refused_and_a_smooth_law_is_not() -> None:
    with pytest.raises(RunError, match="kink or a jump"):
        sliding(lambda rate: 3 * sp.sign(rate)).linearize()
    beside = sliding(lambda rate: 3 * sp.sign(rate)).linearize({"x'": 1}, operating_point=True)
    assert beside.drift.tolist() == [1, -1.5]
    smooth = sliding(lambda rate: 3 * rate * abs(rate)).linearize()
    assert smooth.A.tolist() == [[0, 1], [0, 0]]
    with pytest.raises(RunError, match="an output has a kink"):
        built_in("pendulum").linearize(outputs=["abs(theta)"])


def test_a_mass_that_is_negative_at_the_given_values_is_refused() -> None:
    with pytest.raises(RunError, match="not positive definite"):
        built_in("cart-pole").linearize(params={"M": -5})


@pytest.mark.slow
def test_python_control_linearizes_the_same_motion_to_its_own_accuracy() -> None:
    """control.linearize takes difference quotients of the compiled right-hand side."""
    import control  # two seconds for the processes that need none of it

    for name, at in (("cart-pole", {}), ("acrobot", {}), ("lecture-2", {"theta1": -np.pi / 2})):
        system = built_in(name)
        found, dyn = system.linearize(at), system.compile()
        motion = control.nlsys(
            lambda t, x, u, params, dyn=dyn: dyn.rhs(t, x, u),
            inputs=len(found.inputs),
            outputs=list(found.states),
            states=list(found.states),
        )
        x0 = list(found.at.values())
        theirs = control.linearize(motion, x0, [0.0] * len(found.inputs), eps=1e-7)
        assert np.allclose(found.A, theirs.A, atol=1e-5) and np.allclose(found.B, theirs.B, atol=1e-5)


def test_a_point_that_rests_at_one_moment_only_is_no_rest() -> None:
    """A force A sin(3t) is 0 at t = 0 and nowhere near 0 a moment later."""
    system = lg.System("shaken")
    x = system.coordinates("x")
    m, k, b, A = system.parameters("m k b A", m=1.0, k=1.0, b=1.0, A=0.1)
    system.particle(m, at=system.origin + (x, 0))
    system.spring(k, deflection=x)
    system.damper(b, deflection=x)
    system.generalized_force(x, A * sp.sin(3 * system.t))
    with pytest.raises(RunError, match="at rest at t = 0 s only") as refused:
        system.linearize()
    assert refused.value.code == "E521"
    found = system.linearize(operating_point=True)
    assert found.kind == "operating point"
    assert found.stable is None
    assert np.allclose(found.poles, [-0.5 + 0.75**0.5 * 1j, -0.5 - 0.75**0.5 * 1j])


def test_what_pushes_weakly_in_small_units_still_pushes() -> None:
    """A force c ẋ³ feeds energy in, however small mass and stiffness are: a minimum of energy does not help."""
    for size in (1.0, 1e-14):
        system = lg.System("driven")
        x = system.coordinates("x")
        m, k, c = system.parameters("m k c", m=size, k=size, c=size / 100)
        system.particle(m, at=system.origin + (x, 0))
        system.spring(k, deflection=x)
        system.generalized_force(x, c * x.diff() ** 3)
        assert system.linearize().stability.verdict == "marginal"


def test_nothing_is_said_to_die_out_where_there_is_nothing_else() -> None:
    system = lg.System("free")
    x = system.coordinates("x")
    system.particle(system.parameter("m", 1.0), at=system.origin + (x, 0))
    assert "nothing brings x back" in system.linearize().stability.reason
    assert "decays" not in system.linearize().stability.reason
    system.damper(system.parameter("b", 1.0), deflection=x)
    assert "everything else decays" in system.linearize().stability.reason


def held_pendulum(damping: float, twist: bool = False) -> lg.System:
    system = lg.System("held")
    theta, phi = system.coordinates("theta phi")
    m, l, g, k = system.parameters("m l g k", m=1, l=1, g=9.81, k=2)
    tau = system.input("tau", "torque", unit="N m")
    system.kinetic(m * l**2 * (theta.diff() ** 2 + phi.diff() ** 2) / 2)
    system.potential(-m * g * l * sp.cos(theta) + k * phi**2 / 2)
    system.force(tau, deflection=theta)
    if damping:
        system.damper(damping, deflection=phi)
    if twist:
        c = system.parameters("c", c="1 N m")
        system.force(c * phi, deflection=theta)
        system.force(-c * theta, deflection=phi)
    return system


def test_a_constant_torques_potential_counts_in_the_minimum() -> None:
    """V − τ θ has its minimum at sin θ = τ/(m g l): stable by Lagrange–Dirichlet, beyond π/2 a maximum."""
    at = float(np.arcsin(4 / 9.81))
    for damping in (0, 0.3):
        found = held_pendulum(damping).linearize({"theta": at}, inputs={"tau": 4})
        assert found.stability.verdict == "stable", found.stability
    assert held_pendulum(0).linearize({"theta": np.pi - at}, inputs={"tau": 4}).stable is False


def test_forces_without_a_potential_do_not_count() -> None:
    """Circulatory forces τ = (φ, −θ): no potential, so that energy decides nothing."""
    found = held_pendulum(0, twist=True).linearize({}, inputs={"tau": 0})
    assert found.stability.verdict != "stable"


def test_a_spring_whose_end_an_input_holds_is_stable() -> None:
    system = lg.System("held spring")
    x = system.coordinates("x")
    m, k = system.parameters("m k", m=1, k=4)
    z = system.input("z", "road", unit="m")
    system.particle(m, at=system.origin + (x, 0))
    system.spring(k, deflection=x - z)
    assert system.linearize({"x": 0.2}, inputs={"z": 0.2}).stability.verdict == "stable"


def test_small_numbers_stand_as_powers_of_ten() -> None:
    assert (figure(2e-5), figure(-1.5e12), figure(0.25), figure(0.0)) == ("2·10⁻⁵", "−1.5·10¹²", "0.25", "0")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("command", ["linearize", "equilibria", "conserved"])
def test_commands_write_every_format(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    starts = {"text": "pendulum: ", "markdown": "# pendulum: ", "latex": "\\documentclass", "html": "<!DOCTYPE"}
    for format, start in starts.items():
        assert main([command, "-e", "pendulum", "--format", format]) == 0
        assert capsys.readouterr().out.startswith(start)
    assert main([command, "-e", "pendulum", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["system"] == "pendulum"


def test_a_regulator_writes_itself() -> None:
    """Riccati's equation for ẍ = u with Q = 1, R = 1 by hand: K = (1, √3), poles (−√3 ± i)/2."""
    system = lg.System("double integrator")
    x = system.coordinates("x")
    system.particle(system.parameters("m", m=1), at=system.origin + (x, 0))
    F = system.input("F", "force", unit="N")
    system.force(F, deflection=x)
    found = system.linearize().lqr(1, 1)
    shown = str(found)
    assert "1.73205" in shown and "−0.866025 + 0.5i" in shown and "Regulator(" not in shown
    assert np.allclose(found.to_dict()["K"], [[1, np.sqrt(3)]])
    assert found.to_html().startswith("<!DOCTYPE html>")
    assert repr(found) == "<double integrator: linear-quadratic regulator>"


def test_a_pole_in_a_sentence_has_the_minus_sign_of_the_tables() -> None:
    told = built_in("pendulum").linearize(params={"b": 0.1}).stability
    assert told.reason == "all poles have negative real parts, the slowest is −0.2 ± 4.42493i"


def test_what_is_written_of_a_linearization_is_what_was_computed() -> None:
    """Data, the matrices of the page and the table of poles, read back: no entry transposed, no sign lost."""
    found = built_in("cart-pole").linearize({"theta": 0})
    data = found.to_dict()
    for name, key in (("A", "A"), ("B", "B"), ("C", "C"), ("D", "D"), ("mass", "mass"), ("stiffness", "stiffness")):
        assert data[key] == getattr(found, name).tolist(), key
    assert [complex(z["re"], z["im"]) for z in data["poles"]] == found.poles.tolist()
    modes = [(m["frequency"], complex(m["pole"]["re"], m["pole"]["im"])) for m in data["modes"]]
    assert modes == [(m.frequency, m.pole) for m in found.modes]
    page = found.to_latex()
    for name in ("A", "B", "C"):
        (rows,) = re.findall(rf"mathbf{{{name}}} = \\begin{{bmatrix}} (.*?) \\end{{bmatrix}}", page, flags=re.S)
        read = [[float(x) for x in row.split("&")] for row in rows.split(r"\\")]
        assert np.allclose(read, getattr(found, name), rtol=1e-5, atol=1e-12), name
    for z in (-3.5 + 0j, 2j, -1.25 - 0.5j, 0.125 + 8j, 0j):
        shown = complex_figure(z).replace("−", "-").replace(" ", "").replace("i", "j")
        assert complex(shown) == z
