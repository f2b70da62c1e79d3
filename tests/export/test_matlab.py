"""Function files of MATLAB, run by Octave."""

import pathlib
import shutil
import subprocess

import numpy as np
import pytest
from foreign import holds, states_of

import built_in
import lagrangian as lg
from lagrangian import examples
from lagrangian.cli import main
from lagrangian.codegen import to_matlab
from lagrangian.export import exported_files, steps
from lagrangian.graph import Graph, Output, Program, evaluate
from lagrangian.graph.graph import UNARY
from lagrangian.verify.foreign import checks

OCTAVE = shutil.which("octave-cli") or shutil.which("octave")
needs_octave = pytest.mark.skipif(OCTAVE is None, reason="Octave is not installed")


def octave(code: str, folder: pathlib.Path) -> str:
    (folder / "run_it.m").write_text(code, encoding="utf-8")
    command = [OCTAVE or "octave", "--no-gui", "-q", "--norc", "run_it.m"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


QUICK = ("cart-pole",)


@pytest.mark.slow
@needs_octave
@pytest.mark.parametrize("name", QUICK)
def test_functions_give_the_numbers_of_the_compiled_code(name: str, tmp_path: pathlib.Path) -> None:
    holds(name, "matlab", tmp_path)


@pytest.mark.thinned(3)
@needs_octave
@pytest.mark.slow
@pytest.mark.parametrize("name", [n for n in examples.names() if n not in QUICK])
def test_functions_of_all_examples_do(name: str, tmp_path: pathlib.Path) -> None:
    holds(name, "matlab", tmp_path)


ODD = (0.0, 1.0, -1.0, 0.3, -2.5, 3.0, np.inf, -np.inf, np.nan)


@needs_octave
def test_every_operation_where_numbers_are_odd(tmp_path: pathlib.Path) -> None:
    """Roots of negative numbers are NaN and not complex, and NaN stays NaN in the smaller of two."""
    g = Graph()
    a, b = g.input("q", 0), g.input("q", 1)
    rows = [g.unary(name, a) for name in UNARY]
    rows += [g.mul(g.sqrt(a), g.sqrt(b)), g.mul(g.log(a), g.log(b))]
    rows += [getattr(g, name)(a, b) for name in ("add", "sub", "mul", "div", "min", "max", "pow", "atan2")]
    rows += [g.neg(g.neg(a)), g.sub(a, g.neg(b)), g.neg(g.powi(a, 2)), g.powi(g.neg(a), 3), g.powi(a, -3)]
    flags = [g.lt(a, b), g.le(a, b), g.eq(a, b)]
    flags += [g.and_(flags[0], g.le(a, g.const(1.0))), g.or_(flags[0], flags[2]), g.not_(flags[1])]
    rows += [g.select(flag, a, g.const(-7.0)) for flag in flags] + [g.abs(a), g.sign(a)]
    made = Program("odd", g, {"q": ("a", "b")}, {"r": Output(tuple(rows), (len(rows),))}, {})
    (tmp_path / "odd.m").write_text(to_matlab(made, name="odd", checked=False), encoding="utf-8")
    pairs = [(x, y) for x in ODD for y in ODD]
    words = "; ".join(f"{x!r}, {y!r}".replace("nan", "NaN").replace("inf", "Inf") for x, y in pairs)
    lines = octave(f"r = odd([{words}].');\nassert(isreal(r));\nprintf('%.17g\\n', r);\n", tmp_path)
    found = np.array([float(x) for x in lines.split()]).reshape(len(pairs), len(rows))
    for pair, got in zip(pairs, found, strict=True):
        expected = np.array(evaluate(made, {"q": list(pair)})["r"])
        words = [made.graph.nodes[i][0] for i in rows]
        same = np.isclose(got, expected, rtol=4e-15, atol=0, equal_nan=True)
        assert same.all(), (pair, [(w, x, y) for w, x, y, ok in zip(words, got, expected, same, strict=True) if not ok])


@needs_octave
def test_many_states_defaults_and_shapes(tmp_path: pathlib.Path) -> None:
    s = built_in.system("cart-pole")
    s.export(tmp_path / "cart.m")
    lines = octave(
        "printf('%.17g ', cart_forward([0 1 2; 3 4 5], [0; 1]), cart_mass_matrix([0; 0.3], [0; 0]));\n disp('');\n"
        "try\n  cart_forward([0 1 2], [0; 1]);\ncatch e\n  disp(e.message);\nend\n"
        "try\n  cart_forward([0; NaN], [0; 1]);\ncatch e\n  disp(e.message);\nend\n",
        tmp_path,
    )
    numbers, shape, finite = lines.rstrip().rsplit("\n", 2)
    dyn = s.compile()
    expected = [*dyn.forward([[0, 3], [1, 4], [2, 5]], [0, 1]).ravel(), *dyn.mass_matrix([0, 0.3]).ravel()]
    np.testing.assert_allclose([float(x) for x in numbers.split()], expected, rtol=1e-14)
    assert "in_q must have 2 rows and a column for each state, not 1 x 3" in shape
    assert "a is not finite" in finite


@needs_octave
@pytest.mark.slow
def test_the_script_of_the_steps_runs(tmp_path: pathlib.Path) -> None:
    """It shows every step, and its run with ode45 ends where ours does."""
    s = built_in.system("crane")
    s.export(tmp_path / "pendulum.m")
    script = (tmp_path / "pendulum_steps.m").read_text(encoding="utf-8")
    for heading in ("0  Holonomic?", "2  Kinetic co-energy", "4  Lagrangian", "6  Non-conservative forces", "Result"):
        assert f"%% {heading}\n" in script
    out = octave("pendulum_steps;\nprintf('\\n@');\nprintf('%.17g ', left, final);\n", tmp_path)
    left, *final = (float(x) for x in out.split("@")[1].split())
    run = s.simulate(samples=2)
    assert left < 1e-12
    np.testing.assert_allclose(final, run.y[:, -1], rtol=1e-5, atol=1e-6)


def test_names_that_matlab_would_cut_are_refused(tmp_path: pathlib.Path) -> None:
    with pytest.raises(lg.ModelError, match="use at most 50"):
        built_in.system("pendulum").export(tmp_path / f"{'a' * 51}.m")
    with pytest.raises(ValueError, match="cannot name a function"):
        to_matlab(Program("x", Graph(), {}, {}, {}), name="a" * 64)


def test_a_floating_frame_has_rates_and_its_steps(tmp_path: pathlib.Path) -> None:
    s = lg.System("satellite")
    hull = s.floating_frame("hull")
    s.rigid_body(500, (80, 90, 120), at=hull.origin, frame=hull)
    names = [p.name for p in s.export(tmp_path / "satellite.m")]
    assert {"satellite_rates.m", "satellite_rhs.m", "satellite_steps.m"} <= set(names)
    text = (tmp_path / "satellite_steps.m").read_text(encoding="utf-8")
    assert "%% 2  Kinetic" in text and "∂ℒ/∂π_ω" in text  # in quasi-velocities


def test_where_there_is_no_derivation_the_script_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(model: object) -> str:
        raise lg.ModelError("the equations are too long to write")

    monkeypatch.setattr(steps, "_derived", refuse)
    text = str(exported_files(built_in.system("crane").model, "matlab", "crane")["crane_steps.m"])
    assert "% The steps are not shown: the equations are too long to write." in text
    assert "a = crane_forward(q, v, u, p, t)" in text


@needs_octave
@pytest.mark.slow
def test_verify_runs_the_export_and_notices_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    model, states = built_in.system("cart-pole").model, states_of("cart-pole")
    (sound,) = checks.foreign_checks(model, states, ["matlab"])
    assert sound.holds and "Octave" in str(sound.what)
    right = checks.targets.exported_files
    for old, new, said in (("sin(", "cos(", "largest relative difference"), ("end\n", "ende\n", "refuses")):
        monkeypatch.setattr(
            checks.targets,
            "exported_files",
            lambda m, to, stem, old=old, new=new: {k: str(x).replace(old, new) for k, x in right(m, to, stem).items()},
        )
        (flawed,) = checks.foreign_checks(model, states, ["matlab"])
        assert flawed.holds is False and said in flawed.figure
    monkeypatch.setattr(checks.targets, "exported_files", right)
    monkeypatch.setattr("shutil.which", lambda name: None)
    (missing,) = checks.foreign_checks(model, states, ["matlab"])
    assert missing.holds is None and "Octave was not found" in missing.figure


@pytest.mark.slow
def test_the_command_verifies_exports(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify", "-e", "cart-pole", "--exports", "--states", "3"]) == 0
    assert "the export to matlab" in capsys.readouterr().out
