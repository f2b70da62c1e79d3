"""Verification notices what is wrong in each thing that people take away: every test plants a fault in one of them."""

import pathlib
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from sympy import Abs, cos, sin

import lagrangian as lg
from lagrangian import compiled
from lagrangian.cli import main
from lagrangian.compiled import Compiled
from lagrangian.dynamics import programs
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.export import targets
from lagrangian.graph import Program
from lagrangian.linear import jacobians
from lagrangian.page.formula import Check, text
from lagrangian.verify import exports, products, slopes
from lagrangian.verify.changes import changes
from lagrangian.verify.states import random_states

FORMULAS = "every compiled function equals the slow evaluation of its formulas, singly and in batches"
FORWARD = "the compiled accelerations solve Lagrange's equations"
HESSIAN = "the compiled M is the Hessian of T* in the rates"
PYTHON, C = "the exported Python gives the same numbers", "the exported C gives the same numbers"
JAVASCRIPT = "the exported JavaScript gives the same numbers"
SLOPES = "the linearization's A and B equal difference quotients of these rates"
DERIVED_FORWARD = "the compiled accelerations solve the equations"
DERIVED_MASS = "the compiled M is the one above, and the Hessian of T* in the rates"
DERIVED_ENERGIES = "the compiled energies are T* and V"


def crane(name: str = "crane") -> lg.System:
    s = lg.System(name)
    x, a = s.coordinates("x a")
    m1, m2, L, b = (s.parameter(n, v) for n, v in (("m1", 2.0), ("m2", 1.5), ("L", 0.8), ("b", 0.3)))
    F = s.input("F")
    cart = s.origin + (x, 0)
    s.particle(m1, at=cart)
    s.particle(m2, at=cart + (L * sin(a), -L * cos(a)))
    s.gravity()
    s.damper(b, deflection=a)
    s.force((F, 0), at=cart)
    return s


def said(checks: tuple[Check, ...]) -> dict[str, bool | None]:
    return {str(check.what): check.holds for check in checks}


def failing(checks: tuple[Check, ...]) -> set[str]:
    return {what for what, holds in said(checks).items() if holds is False}


def wheel() -> lg.System:
    """Balanced, so that the terms of its weight cancel to rounding."""
    s = lg.System("wheel")
    a = s.coordinates("a")
    m, R, M, r = (s.parameter(n, v) for n, v in (("m", 1.3), ("R", 0.7), ("M", 2.6), ("r", 0.35)))
    s.particle(m, at=s.origin + (R * cos(a), R * sin(a)))
    s.particle(M, at=s.origin + (-r * cos(a), -r * sin(a)))
    s.gravity()
    return s


def ring() -> lg.System:
    """A bead that nothing accelerates: all terms of its equation cancel."""
    s = lg.System("ring")
    a = s.coordinates("a")
    R, e = s.parameter("R", 0.7), s.parameter("e", 0.3)
    s.particle(s.parameter("m", 1.3), at=s.origin + (R * cos(a) + e * sin(a), R * sin(a) - e * cos(a)))
    return s


@pytest.mark.sampled(2)
@pytest.mark.parametrize("made", [wheel, ring])
def test_rounding_where_all_terms_cancel_is_no_failure(made: Callable[[], lg.System]) -> None:
    checks = made().verify(states=5)
    assert not failing(checks)
    assert said(checks)[FORMULAS] and said(checks)[FORWARD] and said(checks)[PYTHON]


@pytest.fixture(scope="module")
def sound() -> tuple[Check, ...]:
    return crane().verify(states=5)


@pytest.mark.slow
def test_all_products_of_a_sound_system_hold(sound: tuple[Check, ...]) -> None:
    assert not failing(sound)
    assert {FORMULAS, FORWARD, HESSIAN, PYTHON, C, SLOPES} <= said(sound).keys()
    unchecked = [check for check in sound if check.holds is None]
    assert all("no C compiler was found" in check.figure for check in unchecked)


@pytest.fixture
def functions_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither exports nor linearization: the compiled functions are what a test is about."""
    passed = Check(text("left out"), None, "by this test")
    monkeypatch.setattr(products, "exported", lambda *given: (passed,))
    monkeypatch.setattr(products, "slopes", lambda *given: passed)


FAULTS = {
    "a_q": "the compiled derivatives of the accelerations equal difference quotients",
    "Minv": "those by Xi fit M, and those pulled back are weighted sums of them",
    "step": "compiled steps by rk4, midpoint and euler are those of these rates",
    "A": "the A and B of a step equal its difference quotients",
}


def test_a_fault_in_derivatives_and_in_steps_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each fault is one entry that is off by a thousandth; all other checks pass."""
    model = crane().model
    functions = Compiled(model)
    rhs, states = functions.program("rhs"), list(random_states(model, functions.program("forward"), 3, 1))
    derivatives, step = functions.derivatives, functions.step

    def found() -> tuple[Check, ...]:
        return tuple(changes(functions, rhs, states))

    def off(name: str) -> Callable[..., Any]:
        def wrong(*given: Any, **named: Any) -> Any:
            d = derivatives(*given, **named)
            getattr(d, name)[..., -1, -1] *= 1.001
            return d

        return wrong

    def wrong_step(*given: Any, **named: Any) -> Any:
        result = step(*given, **named)
        if named.get("derivatives"):
            return (result[0], result[1] * (1 + 1e-3 * (wanted == "A")), result[2])
        return result + 1e-6 * (wanted == "step")

    wanted = ""
    assert said(found()) == dict.fromkeys(FAULTS.values(), True)
    for wanted in FAULTS:
        with monkeypatch.context() as patched:
            if wanted in ("A", "step"):
                patched.setattr(functions, "step", wrong_step)
            else:
                patched.setattr(functions, "derivatives", off(wanted))
                patched.setattr(functions, "step", step)
            failed = failing(found())
        further = {FAULTS["Minv"], FAULTS["A"]} if wanted == "a_q" else set()  # what is made of these derivatives
        assert failed == {FAULTS[wanted], *further}


@pytest.fixture
def doubled_coupling(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The fault of raw energies: inertia between two velocities counted twice on the way to M and to q̈."""
    plain = Mechanics.inertia

    def wrong(self: Mechanics, links: Any) -> Any:
        H = plain(self, links)
        for i, row in list(H.rows.items()):
            for k in [k for k in row if k > i]:
                H.add(i, k, row[k])
        return H

    monkeypatch.setattr(Mechanics, "inertia", wrong)
    yield


def test_systems_whose_parameters_have_no_values_are_verified() -> None:
    s = lg.System("without values")
    q = s.coordinate("q")
    m, k = s.parameters("m k")
    s.particle(m, s.origin + (q, 0))
    s.spring(k, deflection=q)
    assert [str(c.what) for c in s.verify(states=2) if c.holds is False] == []


def energies() -> lg.System:
    s = lg.System("energies")
    x, y = s.coordinates("x y")
    s.kinetic(2 * x.diff() ** 2 + x.diff() * y.diff() + 3 * y.diff() ** 2)
    s.potential(5 * (x - y) ** 2)
    return s


@pytest.mark.usefixtures("doubled_coupling")
def test_a_wrong_mass_matrix_is_noticed_by_derive_and_verify() -> None:
    found = energies().derive()
    assert failing(found.verified) == {DERIVED_FORWARD, DERIVED_MASS}
    assert {DERIVED_FORWARD, DERIVED_MASS, FORWARD, HESSIAN} <= failing(found.verify(states=3))


@pytest.mark.usefixtures("doubled_coupling")
def test_a_run_of_a_wrong_system_fails_and_says_what_disagrees(
    capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path
) -> None:
    s = energies()
    run = s.simulate(2.0, x=1.0)
    assert not run.success
    assert "the compiled system and its energy disagree" in run.message
    assert "smaller" not in run.message + repr(run)
    file = tmp_path / "energies.toml"
    s.save(file)
    assert main(["simulate", str(file), "--init", "x=1", "--duration", "2"]) == 1
    assert "the compiled system and its energy disagree" in capsys.readouterr().err


def test_a_missed_balance_of_a_sound_system_is_the_integrations() -> None:
    run = crane().simulate(10.0, a=2.5, method="rk4", step=0.25, samples=41)
    assert run.success and "energy balance missed" in run.message and "disagree" not in run.message


def test_wrong_energies_are_noticed_by_derive(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = Mechanics.potential
    monkeypatch.setattr(Mechanics, "potential", lambda self: self.graph.mul(self.graph.const(1.01), plain(self)))
    assert DERIVED_ENERGIES in failing(crane().derive().verified)


def test_a_wrong_number_is_noticed_however_small_the_masses_are(monkeypatch: pytest.MonkeyPatch) -> None:
    s = lg.System("dust")
    x = s.coordinates("x")
    k = s.parameter("k", 2.0)
    s.kinetic(x.diff() ** 2 / 10**12)
    s.potential(k * x**2 / 10**12)
    assert not failing(s.derive().verified)
    plain = Mechanics.potential
    monkeypatch.setattr(Mechanics, "potential", lambda self: self.graph.mul(self.graph.const(1.01), plain(self)))
    assert DERIVED_ENERGIES in failing(s.derive().verified)


@pytest.mark.sampled(3)
@pytest.mark.usefixtures("functions_alone")
@pytest.mark.parametrize(
    "name", ["forward", "inverse", "mass_matrix", "bias", "potential_force", "coriolis_matrix", "rates", "rhs"]
)
def test_a_compiled_function_with_a_wrong_number_is_noticed(
    name: str, sound: tuple[Check, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    plain = getattr(Compiled, name)

    def wrong(self: Compiled, *args: Any, **options: Any) -> Any:
        answer = np.array(plain(self, *args, **options))
        answer[..., -1] *= 1 + 1e-6
        return answer

    monkeypatch.setattr(Compiled, name, wrong)
    assert FORMULAS in failing(crane().verify(states=2))


@pytest.mark.usefixtures("functions_alone")
def test_a_function_that_is_wrong_in_batches_alone_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = Compiled.forward

    def wrong(self: Compiled, q: Any, *args: Any, **options: Any) -> Any:
        answer = plain(self, q, *args, **options)
        return answer[::-1] if np.ndim(q) > 1 else answer

    monkeypatch.setattr(Compiled, "forward", wrong)
    assert FORMULAS in failing(crane().verify(states=4))


def flawed(sources: Callable[..., dict[str, str]], old: str, new: str) -> Callable[..., dict[str, str]]:
    def wrong(*args: Any) -> dict[str, str]:
        found = sources(*args)
        assert any(old in text for text in found.values())
        return {name: text.replace(old, new) for name, text in found.items()}

    return wrong


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("language", "old", "new", "noticed"),
    [
        ("python", "np.sin(", "np.cos(", PYTHON),
        ("c", "sin(", "cos(", C),
        ("c", "double", "dubbel", C),
        ("javascript", "Math.sin(", "Math.cos(", JAVASCRIPT),
        ("javascript", "const", "konst", JAVASCRIPT),
    ],
)
def test_an_exported_source_with_a_fault_is_noticed(
    language: str, old: str, new: str, noticed: str, monkeypatch: pytest.MonkeyPatch, sound: tuple[Check, ...]
) -> None:
    if said(sound)[noticed] is None:
        pytest.skip("no C compiler, or no Node, here")
    right = targets.sources
    wrong = flawed(right, old, new)
    monkeypatch.setattr(
        targets, "sources", lambda m, to, stem: wrong(m, to, stem) if to == language else right(m, to, stem)
    )
    assert failing(crane().verify(states=2)) == {noticed}


@pytest.mark.slow
def test_the_exported_c_is_compiled_without_fused_products(
    monkeypatch: pytest.MonkeyPatch, sound: tuple[Check, ...]
) -> None:
    """Where the processor has them, a compiler may round a·b + c once, and sums that cancel lose other digits."""
    if said(sound)[C] is None:
        pytest.skip("no C compiler here")
    commands, run = [], exports.subprocess.run

    def watched(command: list[str], **how: Any) -> Any:
        commands.append(command)
        return run(command, **how)

    monkeypatch.setattr(exports.subprocess, "run", watched)
    assert not failing(crane().verify(states=1))
    compilers = [command for command in commands if "-shared" in command]
    assert compilers and all("-ffp-contract=off" in command for command in compilers)


@pytest.mark.slow
def test_without_a_compiler_the_c_source_is_said_not_to_be_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exports.shutil, "which", lambda name: None)
    (check,) = [c for c in crane().verify(states=1) if str(c.what) == C]
    assert check.holds is None and "no C compiler was found" in check.figure
    (check,) = [c for c in crane().verify(states=1) if str(c.what) == JAVASCRIPT]
    assert check.holds is None and "Node was not found" in check.figure


def test_a_wrong_linearization_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = jacobians.jacobian

    def wrong(graph: Any, outputs: Any, inputs: Any) -> Any:
        entries = plain(graph, outputs, inputs)
        return {k: graph.mul(graph.const(1.001), e) for k, e in entries.items()}

    monkeypatch.setattr(jacobians, "jacobian", wrong)
    assert failing(crane().verify(states=2)) == {SLOPES}


def test_slopes_at_kinks_are_passed_over_and_said_where_none_is_left() -> None:
    s = lg.System("kinks")
    x = s.coordinates("x")
    s.particle(1, at=s.origin + (x, 0))
    s.force((sum(Abs(sin(1000 * x + k)) for k in range(3)), 0), at=s.origin + (x, 0))
    state = {"q": [0.3], "v": [0.1], "a": [0.0], "u": [], "p": [], "t": [0.0]}
    check = slopes.slopes(s.model, s.compile().rhs, [state])
    assert check.holds is None and check.figure.startswith("not checked at any of 1 random states")


@pytest.mark.usefixtures("functions_alone")
def test_a_program_of_another_system_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A kernel from the cache that belongs to other formulas gives other numbers."""
    other = programs.forward(crane().model)
    g = other.graph
    outputs = {"a": type(other.outputs["a"])(tuple(g.neg(i) for i in other.outputs["a"].ids), (2,))}
    swapped = Program("forward", g, other.inputs, outputs, other.defaults)
    monkeypatch.setitem(compiled._PROGRAMS, "forward", lambda model: swapped)
    found = failing(crane().verify(states=2))
    assert FORWARD in found


@pytest.mark.slow
def test_energies_that_are_not_quadratic_in_the_rates_are_verified_as_they_are() -> None:
    s = lg.System("quartic")
    x = s.coordinates("x")
    s.kinetic((1 + x**2) * x.diff() ** 4 / 4 + x.diff() ** 2)
    s.potential(x**4)
    assert not failing(s.verify(states=3))
    dyn = s.compile()
    # ∂²T*/∂ẋ² = 3 (1 + x²) ẋ² + 2 at x = 1, ẋ = 2
    assert dyn.mass_matrix([1.0], v=[2.0]) == pytest.approx(np.array([[26.0]]), rel=1e-14)
    with pytest.raises(lg.RunError, match=r"M depends on the rates.*\n.*v="):
        dyn.mass_matrix([1.0])
    with pytest.raises(lg.RunError, match="not quadratic in the rates"):
        dyn.coriolis_matrix([1.0], [2.0])
