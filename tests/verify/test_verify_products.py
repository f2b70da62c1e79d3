"""Verification notices what is wrong in each thing that people take away: every test plants a fault in one of them."""

import pathlib
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from sympy import Abs, cos, sin

import built_in
import lagrangian as lg
from lagrangian import compiled, dynamics
from lagrangian.cli import main
from lagrangian.compiled import Compiled
from lagrangian.dynamics import programs
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.export import targets
from lagrangian.graph import Output, Program
from lagrangian.linear import jacobians
from lagrangian.page.formula import Check, text
from lagrangian.verify import exports, poles, products, recorded_runs, slopes
from lagrangian.verify.changes import changes
from lagrangian.verify.on_rows import OnRows
from lagrangian.verify.states import random_states
from lagrangian.write import tables

FORMULAS = "every compiled function equals the slow evaluation of its formulas, singly and in batches"
FORWARD = "the compiled accelerations solve Lagrange's equations"
HESSIAN = "the compiled M is the Hessian of T* in the rates"
PYTHON, C = "the exported Python gives the same numbers", "the exported C gives the same numbers"
JAVASCRIPT = "the exported JavaScript gives the same numbers"
SLOPES = "A and B of the linearization, also along a run, equal difference quotients of ẋ"
POLES = "the poles have the traces of powers of A, and modes are motions of the linear system"
DERIVED_FORWARD = "the compiled accelerations solve the equations"
DERIVED_MASS = "the compiled M is that of the equations, and the Hessian of T* in the rates"
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
    monkeypatch.setattr(products, "slopes", lambda *given: (passed, passed))


FAULTS = {
    "a_q": "the compiled derivatives of the accelerations, also by parameters, equal difference quotients",
    "a_p": "the compiled derivatives of the accelerations, also by parameters, equal difference quotients",
    "r_v": "the compiled derivatives of the inverse dynamics equal difference quotients",
    "r_p": "the compiled derivatives of the inverse dynamics equal difference quotients",
    "M": "the compiled derivatives of the inverse dynamics equal difference quotients",
    "Minv": "the compiled ∂a/∂Xi fits M, and pullback gives weighted sums of the derivatives",
    "w_p": "the compiled ∂a/∂Xi fits M, and pullback gives weighted sums of the derivatives",
    "w_q": "the compiled ∂a/∂Xi fits M, and pullback gives weighted sums of the derivatives",
    "h_q": "the compiled hessian_product equals difference quotients of pullback",
    "h_p": "the compiled hessian_product equals difference quotients of pullback",
    "linear": "the compiled A and B of linearized equal difference quotients of ẋ",
    "step": "the compiled steps by rk4, midpoint and euler follow the textbook, with slowly evaluated ẋ",
    "A": "the compiled A and B of a step equal difference quotients of the step",
    "variations": "the variational equations, which give the sensitivities of runs, equal difference quotients",
}


def off_by_a_thousandth(functions: Compiled, wanted: str, patched: pytest.MonkeyPatch) -> None:
    """Plant one fault: a single entry of what a function returns."""

    def result(name: str, keys: dict[str, str]) -> None:
        plain = getattr(functions, name)

        def wrong(*given: Any, **named: Any) -> Any:
            found = plain(*given, **named)
            if wanted in keys and keys[wanted] in found._values:
                found._values[keys[wanted]][..., -1] *= 1.001
            return found

        patched.setattr(functions, name, wrong)

    result("derivatives", {"a_q": "a_q", "a_p": "a_p", "r_v": "r_v", "r_p": "r_p", "M": "M", "Minv": "Minv"})
    result("pullback", {"w_q": "w_q", "w_p": "w_p"})
    result("hessian_product", {"h_q": "w_q", "h_p": "w_p"})
    step, linearized = functions.step, functions.linearized

    def wrong_step(*given: Any, **named: Any) -> Any:
        found = step(*given, **named)
        if named.get("derivatives"):
            return (found[0], found[1] * (1 + 1e-3 * (wanted == "A")), found[2])
        return found + 1e-6 * (wanted == "step")

    def wrong_linear(*given: Any, **named: Any) -> Any:
        A, B = linearized(*given, **named)
        A[-1, 1] *= 1 + 1e-3 * (wanted == "linear")
        return A, B

    patched.setattr(functions, "step", wrong_step)
    patched.setattr(functions, "linearized", wrong_linear)
    if wanted == "variations":
        made = dynamics.variational

        def wrong_rates(*given: Any) -> Any:
            found = made(*given)
            g, ids = found.rates.graph, found.rates.outputs["xdot"].ids
            last = (*ids[:-1], g.mul(g.const(1.001), ids[-1]))
            return replace(found, rates=replace(found.rates, outputs={"xdot": Output(last, (len(last),))}))

        patched.setattr(dynamics, "variational", wrong_rates)
        functions._model._memo.pop("variations", None)  # made before


@pytest.fixture(scope="module")
def compiled_crane() -> tuple[Any, ...]:
    model = crane().model
    functions = Compiled(model)
    return functions, model, list(random_states(model, functions.program("forward"), 1, 1))


@pytest.mark.sampled(18)
@pytest.mark.parametrize("wanted", FAULTS)
def test_a_fault_in_derivatives_and_in_steps_is_noticed(
    wanted: str, compiled_crane: tuple[Any, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each fault is one entry that is off by a thousandth; all other checks pass."""
    functions, model, states = compiled_crane
    further = {"a_q": ("Minv", "linear", "A"), "a_p": ("Minv",), "w_q": ("h_q",), "w_p": ("h_q",)}.get(wanted, ())
    off_by_a_thousandth(functions, wanted, monkeypatch)
    failed = failing(tuple(changes(functions, model, states)))
    model._memo.pop("variations")
    assert FAULTS[wanted] in failed and failed <= {FAULTS[name] for name in (wanted, *further)}


def test_sound_derivatives_and_steps_pass(compiled_crane: tuple[Any, ...]) -> None:
    assert said(tuple(changes(*compiled_crane))) == dict.fromkeys(FAULTS.values(), True)


@pytest.mark.slow
def test_derivatives_are_compared_along_rows_that_depend_on_each_other() -> None:
    """Three cranks of one length on a platform: beside the constraints the rows are independent, and a jumps there."""
    model = built_in.system("double-parallelogram").model
    functions, onto = Compiled(model), OnRows(model)
    drawn = random_states(model, functions.program("forward"), 50, 1)
    state = next(moved for x in drawn if (moved := onto.of(x)) is not None)
    found = said(tuple(changes(functions, model, [state])))
    assert False not in found.values()
    assert found[FAULTS["a_q"]] and found[FAULTS["linear"]] and found[FAULTS["h_q"]] is None
    assert slopes.slopes(model, functions.rhs, [state], onto.of)[0].holds


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


@pytest.mark.slow
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


@pytest.mark.slow
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
    def dust() -> lg.System:
        s = lg.System("dust")
        x = s.coordinates("x")
        k = s.parameter("k", 2.0)
        s.kinetic(x.diff() ** 2 / 10**12)
        s.potential(k * x**2 / 10**12)
        return s

    assert not failing(dust().derive().verified)
    plain = Mechanics.potential
    monkeypatch.setattr(Mechanics, "potential", lambda self: self.graph.mul(self.graph.const(1.01), plain(self)))
    assert DERIVED_ENERGIES in failing(dust().derive().verified)


@pytest.mark.sampled(9)
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


@pytest.mark.sampled(6)
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


@pytest.mark.slow
def test_a_wrong_linearization_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = jacobians.jacobian

    def wrong(graph: Any, outputs: Any, inputs: Any) -> Any:
        entries = plain(graph, outputs, inputs)
        return {k: graph.mul(graph.const(1.001), e) for k, e in entries.items()}

    monkeypatch.setattr(jacobians, "jacobian", wrong)
    assert failing(crane().verify(states=2)) == {SLOPES, POLES}  # the rates of the coordinates are wrong, too


def test_a_wrong_linearization_along_a_run_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = slopes.linearize_along
    monkeypatch.setattr(slopes, "linearize_along", lambda *given, **named: off(plain(*given, **named)))

    def off(found: Any) -> Any:
        return replace(found, A=found.A * 1.001)

    model = crane().model
    functions = Compiled(model)
    states = list(random_states(model, functions.program("forward"), 1, 1))
    assert [check.holds for check in slopes.slopes(model, functions.rhs, states)] == [False, True]


@pytest.mark.parametrize("part", ["poles", "vectors"])
def test_a_wrong_pole_and_a_wrong_mode_are_noticed(part: str) -> None:
    model = crane().model
    (state,) = random_states(model, dynamics.forward(model), 1, 1)
    found = slopes.linearized(model, state)
    assert poles.poles([found]).holds
    wrong = getattr(found.spectrum, part).copy()
    wrong[-1] = wrong[-1] * 1.001 + 1e-3
    vars(found)["spectrum"] = replace(found.spectrum, **{part: wrong})
    for kept in ("motions", "modes"):
        vars(found).pop(kept, None)
    assert poles.poles([found]).holds is False


def test_a_shape_that_is_printed_wrong_is_noticed() -> None:
    model = crane().model
    (state,) = random_states(model, dynamics.forward(model), 1, 1)
    found = slopes.linearized(model, state)
    mode = found.modes[-1]
    vars(found)["modes"] = (
        *found.modes[:-1],
        replace(mode, shape={k: x.conjugate() * 1.01 + 0.01 for k, x in mode.shape.items()}),
    )
    assert poles.poles([found]).holds is False


def run_checks(model: Any) -> list[Check]:
    (state,) = random_states(model, dynamics.forward(model), 1, 1)
    return list(recorded_runs.recorded_runs(model, Compiled(model), state))


@pytest.mark.slow
def test_a_run_and_its_files_hold() -> None:
    assert [check.holds for check in run_checks(crane().model)] == [True, True]


def test_a_wrong_run_and_wrong_energies_are_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = recorded_runs.simulate

    def bent(*given: Any, **named: Any) -> Any:
        run = plain(*given, **named)
        run.y[0, 2:] *= 1 + 1e-5
        return run

    monkeypatch.setattr(recorded_runs, "simulate", bent)
    assert [check.holds for check in run_checks(crane().model)] == [False, True]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("ending", [".csv", ".nc", ".parquet", ".npz"])
def test_a_file_of_a_run_with_a_wrong_number_is_noticed(monkeypatch: pytest.MonkeyPatch, ending: str) -> None:
    plain = tables.ENDINGS[ending]

    def rounded(path: pathlib.Path, table: Any) -> None:
        first, *others = table.columns
        plain(path, replace(table, columns=(replace(first, values=first.values.astype(np.float32) * 1.0), *others)))

    monkeypatch.setattr(tables, "ENDINGS", {**tables.ENDINGS, ending: rounded})
    _, files = run_checks(crane().model)
    assert files.holds is False and files.figure.startswith(f"{ending} differ")


def test_slopes_at_kinks_are_passed_over_and_said_where_none_is_left() -> None:
    s = lg.System("kinks")
    x = s.coordinates("x")
    s.particle(1, at=s.origin + (x, 0))
    s.force((sum(Abs(sin(1000 * x + k)) for k in range(3)), 0), at=s.origin + (x, 0))
    state = {"q": [0.3], "v": [0.1], "a": [0.0], "u": [], "p": [], "t": [0.0]}
    check, no_poles = slopes.slopes(s.model, s.compile().rhs, [state])
    assert no_poles.holds is None
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
