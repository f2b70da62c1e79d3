"""Modules of JAX and CasADi: their numbers, and their derivatives, against the compiled code."""

import json
import pathlib
import subprocess
import sys
from importlib.util import find_spec

import numpy as np
import pytest
from foreign import compare, holds, states_of

import built_in
import lagrangian as lg
from lagrangian import examples
from lagrangian.codegen.casadi_source import to_casadi
from lagrangian.export import exported_files
from lagrangian.export.programs import exported, program_of
from lagrangian.verify.foreign.python_modules import all_casadi_answers, all_jax_answers

needs = {
    name: pytest.mark.skipif(find_spec(name) is None, reason=f"{name} is not installed") for name in ("jax", "casadi")
}
DIFFERENTIATED = ("cart-pole", "furuta-pendulum", "kapitza-pendulum", "quarter-car", "bead-on-hoop", "robot-arm")


def run(code: str, folder: pathlib.Path) -> list[list[float]]:
    """What a script prints, as lists of numbers."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code], cwd=folder, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return [json.loads(line) for line in done.stdout.splitlines()]


@pytest.mark.slow
@needs["casadi"]
def test_casadi_gives_the_numbers_of_the_compiled_code(tmp_path: pathlib.Path) -> None:
    holds("cart-pole", "casadi", tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(
    "target", [pytest.param("jax", marks=needs["jax"]), pytest.param("casadi", marks=needs["casadi"])]
)
def test_all_examples_give_the_numbers_of_the_compiled_code(target: str, tmp_path: pathlib.Path) -> None:
    jobs = []
    for k, name in enumerate(examples.names()):
        model = built_in.system(name).model
        programs = {x: program_of(model, x) for x in exported(model, whole=True)}
        jobs.append((f"example{k}", programs, exported_files(model, target, f"example{k}"), states_of(name)))
    found = (all_jax_answers if target == "jax" else all_casadi_answers)(jobs, tmp_path)
    for name, (_, programs, _, _), numbers in zip(examples.names(), jobs, found, strict=True):
        compare(name, programs, numbers)


@pytest.mark.slow
@needs["jax"]
def test_functions_of_jax_are_compiled_mapped_and_differentiated(tmp_path: pathlib.Path) -> None:
    """jit, vmap and jacfwd of accelerations, grad of energies: the derivatives are those of the compiled code."""
    lines = ["import jax, json, numpy as np", 'jax.config.update("jax_enable_x64", True)']
    for k, name in enumerate(DIFFERENTIATED):
        built_in.system(name).export(tmp_path / f"s{k}.py", to="jax")
        q, v, u, p, t = (states_of(name)[0][group] for group in "qvupt")
        given = f"*map(np.array, [{q}, {v}, {u}, {p}]), {t[0]}"
        lines += [
            f"import s{k}",
            f"slopes = jax.jit(jax.jacfwd(s{k}.s{k}_forward, (0, 1, 3)))({given})",
            "print(json.dumps([x for J in slopes for x in np.ravel(J).tolist()]))",
            f"V = lambda q, v, u, p, t: s{k}.s{k}_energy(q, v, u, p, t)[1]",
            f"print(json.dumps(jax.grad(V)({given}).tolist()))",
            f"many = jax.vmap(s{k}.s{k}_forward, (0, None, None, None, None))(np.array([{q}, {q}]), *[{given}][1:])",
            "print(json.dumps(np.ravel(many).tolist()))",
        ]
    answers = iter(run("\n".join(lines), tmp_path))
    for name in DIFFERENTIATED:
        state, dyn = states_of(name)[0], built_in.system(name).compile()
        q, v, u, p, t = (np.array(state[group]) for group in "qvupt")
        d = dyn.derivatives(q, v, u, p, t[0], wrt=("q", "v", *dyn.parameters))
        a_p = np.stack([d.a_p[x] for x in dyn.parameters], axis=-1)
        expected = np.concatenate([np.ravel(d.a_q), np.ravel(d.a_v), np.ravel(a_p)])
        np.testing.assert_allclose(next(answers), expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())
        G = dyn.potential_force(q, u, p, t[0])
        np.testing.assert_allclose(next(answers), G, rtol=1e-12, atol=1e-12 * np.abs(G).max())
        np.testing.assert_allclose(next(answers), np.ravel([dyn.forward(q, v, u, p, t[0])] * 2), rtol=1e-12)


@needs["casadi"]
def test_functions_of_casadi_have_derivatives(tmp_path: pathlib.Path) -> None:
    s = built_in.system("cart-pole")
    s.export(tmp_path / "cart.py", to="casadi")
    q, v, u, p, t = (states_of("cart-pole")[0][group] for group in "qvupt")
    code = f"""
import casadi as ca, json, numpy as np, cart
f, q = cart.cart_forward(), ca.SX.sym("q", 2)
J = ca.Function("J", [q], [ca.jacobian(f(q, {v}, {u}, {p}, {t}), q)])
print(json.dumps(np.ravel(J({q})).tolist()))
print(json.dumps([f.size_in("p")[0], len(cart.PARAMETERS)]))
"""
    slopes, sizes = run(code, tmp_path)
    d = s.compile().derivatives(q, v, u, p, t[0], wrt=("q",))
    np.testing.assert_allclose(slopes, np.ravel(d.a_q), rtol=1e-12)
    assert sizes == [len(p), len(p)]


def test_a_name_that_casadi_does_not_take_is_refused() -> None:
    program = program_of(built_in.system("pendulum").model, "forward")
    for name in ("_f", "a__b", "1x"):
        with pytest.raises(ValueError, match="cannot name"):
            to_casadi(program, name=name)


def test_the_target_is_said_where_an_ending_has_several(tmp_path: pathlib.Path) -> None:
    s = built_in.system("pendulum")
    (path,) = s.export(tmp_path / "p.py", to="casadi")
    assert "import casadi as ca" in path.read_text(encoding="utf-8")
    with pytest.raises(lg.ModelError, match=r"does not end in \.py"):
        s.export(tmp_path / "p.m", to="jax")
    with pytest.raises(lg.ModelError, match="no export to 'rust'"):
        s.export(tmp_path / "p.rs", to="rust")


@pytest.mark.parametrize(
    ("target", "file"), [("jax", "jax.py"), ("casadi", "numpy.py"), ("modelica", "model.mo"), ("simulink", "int.c")]
)
def test_names_with_another_meaning_are_refused(target: str, file: str, tmp_path: pathlib.Path) -> None:
    with pytest.raises(lg.ModelError, match="it has a meaning there"):
        built_in.system("pendulum").export(tmp_path / file, to=target)
    assert not list(tmp_path.iterdir())


def test_exported_python_runs_as_it_is(tmp_path: pathlib.Path) -> None:
    """The declared parameters and t = 0 are defaults, and the file prints the accelerations where the model starts."""
    system = lg.example("cart-pole")
    path = tmp_path / "cart.py"
    system.export(path)
    printed = subprocess.run([sys.executable, str(path)], capture_output=True, text=True, check=True).stdout
    known = system.compile().forward([0.0, 0.1], [0.0, 0.0], [0.0], [p.value for p in system.model.parameters])
    assert [float(x) for x in printed.strip(" []\n").split()] == pytest.approx(list(known), rel=1e-6)
    assert "def cart_forward(in_q, in_v, in_u, in_p=PARAMETERS, in_t=0.0):" in path.read_text(encoding="utf-8")
