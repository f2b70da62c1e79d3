"""S-functions of Simulink, compiled against a stand-in of its header and run by a fixed step."""

import ctypes
import pathlib
import shutil
import subprocess

import numpy as np
import pytest

import built_in
import lagrangian as lg
from lagrangian import examples
from lagrangian.export.start import start_of

STAND_IN = pathlib.Path(__file__).parent / "simulink_stand_in"
FAST = {"andrews-squeezer": 1e-6, "dc-motor": 1e-6, "capacitive-actuator": 2e-11}
"""Systems whose time constants are short: a fixed step must be shorter."""

needs_compiler = pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler on this machine")


def built(name: str, folder: pathlib.Path) -> ctypes.CDLL:
    """The S-function as a library, without a warning of the compiler."""
    built_in.system(name).export(folder / "sys.c", to="simulink")
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O0", "-ffp-contract=off", "-shared", "-fPIC", f"-I{STAND_IN}"]
    library = folder / "sys.so"
    subprocess.run(["cc", *flags, "-o", str(library), str(folder / "sys.c"), "-lm"], check=True)
    loaded = ctypes.CDLL(str(library))
    loaded.run.restype = ctypes.c_char_p
    return loaded


def run(library, name, step, steps, *, p=(), x0=(), u=None, project=True) -> tuple[np.ndarray, np.ndarray, str | None]:
    model = built_in.system(name).model
    start = start_of(model)
    x, energy = np.zeros(len(start.x)), np.zeros(2)
    given = [np.array([*values, 0.0], float) for values in (p, x0, start.u if u is None else u)]
    pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (*given, x, energy)]
    said = library.run(
        pointers[0],
        len(p),
        pointers[1],
        len(x0),
        pointers[2],
        ctypes.c_double(step),
        steps,
        int(project),
        *pointers[3:],
    )
    return x, energy, said.decode() if said else None


def check(name: str, folder: pathlib.Path, step: float = 1e-4, steps: int = 20) -> None:
    s = built_in.system(name)
    start, library = start_of(s.model), built(name, folder)
    inputs = {u.name: x for u, x in zip(s.model.inputs, start.u, strict=True)}
    ours = s.simulate(
        step * steps, samples=2, inputs=inputs, method="dop853", rtol=1e-13, atol=1e-22 if step < 1e-9 else 1e-14
    )
    assert ours.success, ours.message
    x, energy, said = run(library, name, step, steps)
    assert said is None
    np.testing.assert_allclose(x, ours.y[:, -1], rtol=0, atol=1e-9 * np.abs(ours.y).max())
    n, dyn = len(s.model.coordinates), s.compile()
    T, V = dyn.energies(x[:n], x[n:], u=start.u, p=start.p, t=step * steps)
    np.testing.assert_allclose(energy, [T, V], rtol=1e-12, atol=1e-12)


@needs_compiler
def test_an_s_function_runs_as_ours(tmp_path: pathlib.Path) -> None:
    check("cart-pole", tmp_path)


@pytest.mark.thinned(3)
@needs_compiler
@pytest.mark.slow
@pytest.mark.parametrize("name", [n for n in examples.names() if n != "cart-pole"])
def test_s_functions_of_all_examples_do(name: str, tmp_path: pathlib.Path) -> None:
    check(name, tmp_path, FAST.get(name, 1e-4))


@pytest.mark.slow
@needs_compiler
def test_parameters_of_the_dialog_and_the_projection(tmp_path: pathlib.Path) -> None:
    s = built_in.system("four-bar")
    library, start = built("four-bar", tmp_path), start_of(s.model)
    p = np.array(start.p)
    p[4] *= 2
    heavy, _, said = run(library, "four-bar", 1e-3, 100, p=p, x0=start.x, u=[1.0])
    name = s.model.parameters[4].name
    ours = s.simulate(0.1, samples=2, params={name: p[4]}, inputs={"tau": 1.0}, rtol=1e-12, atol=1e-13)
    assert said is None
    np.testing.assert_allclose(heavy, ours.y[:, -1], rtol=1e-8, atol=1e-9)
    gaps = []
    for project in (False, True):
        x, _, _ = run(library, "four-bar", 2e-2, 100, project=project)
        gaps.append(max(abs(g) for g in s.compile().residual(x[:3], x[3:])["position"].values()))
    assert gaps[1] < 1e-12 < 1e-9 < gaps[0]
    assert "the first parameter must be []" in str(run(library, "four-bar", 1e-3, 1, p=[1.0])[2])
    assert "the second parameter must be []" in str(run(library, "four-bar", 1e-3, 1, x0=[1.0])[2])


def test_a_parameter_without_a_value_and_a_long_name_are_refused(tmp_path: pathlib.Path) -> None:
    s = lg.System("spring")
    x, k = s.coordinates("x"), s.parameter("k")
    s.particle(1, at=s.origin + (x, 0))
    s.spring(k, deflection=x)
    with pytest.raises(lg.ModelError, match="an S-function needs the start of every parameter"):
        s.export(tmp_path / "spring.c", to="simulink")
    with pytest.raises(lg.ModelError, match="use at most 50"):
        built_in.system("pendulum").export(tmp_path / f"{'a' * 51}.c", to="simulink")
    assert not list(tmp_path.iterdir())
