"""FMUs of both versions: valid for FMPy, and their runs are those of `simulate`."""

import io
import pathlib
import shutil
import subprocess
import xml.etree.ElementTree as ET
import zipfile
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from foreign import holds

import built_in
import lagrangian as lg
from lagrangian import dynamics, examples
from lagrangian.export import exported_files
from lagrangian.export.fmu import archive, description
from lagrangian.export.start import start_of
from lagrangian.verify.foreign.checks import foreign_checks
from lagrangian.verify.states import random_states

needs_fmpy = pytest.mark.skipif(
    find_spec("fmpy") is None or shutil.which("cc") is None, reason="FMPy or a C compiler is not installed"
)
VERSIONS = ("fmu2", "fmu3")
STIFF = {
    "andrews-squeezer": 0.004,
    "dc-motor": 0.02,
    "kapitza-pendulum": 0.1,
    "two-disk-shaft": 0.1,
    "lecture-3b": 0.1,
    "two-carts": 0.1,
    "spring-net": 0.1,
}
"""Shorter runs of systems with high frequencies, for which CVode takes more steps than FMPy allows, or loses digits."""

SMALL = ("capacitive-actuator",)
"""Systems whose states are so small that CVode, whose absolute tolerance is for states near 1, loses a digit."""


def exported_to(folder: pathlib.Path, name: str, version: str) -> pathlib.Path:
    (path,) = built_in.system(name).export(folder / f"{version}.fmu", to=version)
    return path


def run(path: pathlib.Path, kind: str, duration: float, names: list[str], **more: Any) -> np.ndarray:
    """The states at the end of a run by FMPy."""
    import fmpy

    found = fmpy.simulate_fmu(
        str(path), fmi_type=kind, start_time=0, stop_time=duration, output_interval=duration / 20, output=names,
        relative_tolerance=1e-12, **more,
    )  # fmt: skip
    return np.array([found[name][-1] for name in names])


def compare_runs(name: str, version: str, folder: pathlib.Path) -> None:
    s = built_in.system(name)
    start = start_of(s.model)
    duration = min(STIFF.get(name, 0.5), start.duration / 10)
    names = [c.name for c in s.model.coordinates] + [v.name for v in s.model.velocities]
    inputs = {u.name: x for u, x in zip(s.model.inputs, start.u, strict=True)}
    ours = s.simulate(
        duration, samples=11, inputs=inputs, method="dop853", rtol=1e-13, atol=1e-18 if name in SMALL else 1e-14
    )
    assert ours.success, ours.message
    path = exported_to(folder, name, version)
    for kind in ("CoSimulation", "ModelExchange"):
        theirs = run(path, kind, duration, names)
        tolerance = 1e-8 if name in SMALL and kind == "ModelExchange" else 1e-9
        np.testing.assert_allclose(theirs, ours.y[:, -1], rtol=0, atol=tolerance * np.abs(ours.y).max(), err_msg=kind)


@pytest.mark.slow
@needs_fmpy
def test_an_fmu_is_valid_and_runs_as_ours(tmp_path: pathlib.Path) -> None:
    from fmpy.validation import validate_fmu

    compare_runs("cart-pole", "fmu2", tmp_path)
    assert validate_fmu(str(tmp_path / "fmu2.fmu")) == []


@pytest.mark.thinned(4)
@needs_fmpy
@pytest.mark.slow
@pytest.mark.parametrize("name", examples.names())
def test_fmus_of_all_examples_are_valid_and_run_as_ours(name: str, tmp_path: pathlib.Path) -> None:
    """One version each in turn: what they compute is the same text."""
    version = VERSIONS[examples.names().index(name) % 2]
    compare_runs(name, version, tmp_path)
    holds(name, version, tmp_path)  # derivatives, energies and multipliers, and the validation


@needs_fmpy
@pytest.mark.slow
@pytest.mark.parametrize("version", VERSIONS)
def test_the_standards_own_headers_agree_with_ours(version: str, tmp_path: pathlib.Path) -> None:
    """A compiler holds every function against its declaration, and finds nothing else to say."""
    import fmpy

    for name in ("cart-pole", "four-bar"):
        (content,) = exported_files(built_in.system(name).model, version, "s").values()
        assert isinstance(content, bytes)
        with zipfile.ZipFile(io.BytesIO(content)) as packed:
            packed.extract("sources/s.c", tmp_path)
        headers = pathlib.Path(fmpy.__file__).parent / "c-code"
        flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
        source = str(tmp_path / "sources" / "s.c")
        subprocess.run(["cc", *flags, source], check=True)
        subprocess.run(
            ["cc", *flags[:3], "-Werror", "-fsyntax-only", "-DFMI_HEADERS", f"-I{headers}", source], check=True
        )


@needs_fmpy
@pytest.mark.slow
def test_starts_parameters_and_inputs_can_be_set(tmp_path: pathlib.Path) -> None:
    s = built_in.system("cart-pole")
    names = ["x", "theta", "x'", "theta'"]
    signal = np.array([(0.0, 0.5), (1.0, 0.5)], dtype=[("time", float), ("F", float)])
    ours = s.simulate(0.5, samples=2, theta=0.3, params={"m": 0.4}, inputs={"F": 0.5}, rtol=1e-12, atol=1e-13)
    for version in VERSIONS:
        path = exported_to(tmp_path, "cart-pole", version)
        for kind in ("CoSimulation", "ModelExchange"):
            found = run(path, kind, 0.5, names, start_values={"theta": 0.3, "m": 0.4}, input=signal)
            np.testing.assert_allclose(found, ours.y[:, -1], rtol=0, atol=1e-9 * np.abs(ours.y).max(), err_msg=kind)


@pytest.mark.slow
@needs_fmpy
def test_an_fmu_that_says_other_values_of_parameters_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    model, plain = built_in.system("pendulum").model, description._attributes2
    monkeypatch.setattr(description, "_attributes2", lambda v: plain(replace(v, start=v.start and 1.5 * v.start)))
    (check,) = foreign_checks(model, list(random_states(model, dynamics.forward(model), 1, 1)), ["fmu2"])
    assert check.holds is False and "parameters start at other values" in check.figure


@needs_fmpy
@pytest.mark.slow
def test_a_start_off_the_constraints_is_moved_onto_them_or_refused(tmp_path: pathlib.Path) -> None:
    s = built_in.system("four-bar")
    names = [c.name for c in s.model.coordinates]
    path = exported_to(tmp_path, "four-bar", "fmu2")
    moved = run(path, "CoSimulation", 1e-6, names, start_values={"theta1": 1.1})
    assert all(abs(x) < 1e-9 for x in s.compile().residual(moved)["position"].values())
    with pytest.raises(Exception, match="fmi2ExitInitializationMode"):
        run(path, "CoSimulation", 1e-6, names, start_values={"d": 100.0})


@needs_fmpy
@pytest.mark.slow
def test_a_state_of_an_fmu_can_be_kept_and_taken_up_again(tmp_path: pathlib.Path) -> None:
    import fmpy

    path = exported_to(tmp_path, "cart-pole", "fmu2")
    description, folder = fmpy.read_model_description(str(path)), fmpy.extract(str(path))
    fmu: Any = fmpy.instantiate_fmu(folder, description, "CoSimulation")
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    kept = fmu.serializeFMUState(fmu.getFMUState())
    fmu.doStep(0.0, 0.5)
    first = fmu.getReal([1, 2, 3, 4])
    fmu.setFMUState(fmu.deserializeFMUState(kept))
    fmu.doStep(0.0, 0.5)
    assert fmu.getReal([1, 2, 3, 4]) == first
    fmu.reset()
    assert fmu.getReal([0, 1]) == [0.0, start_of(built_in.system("cart-pole").model).x[0]]
    fmu.terminate()
    fmu.freeInstance()


def test_without_a_compiler_the_fmu_is_its_source(monkeypatch: pytest.MonkeyPatch) -> None:
    model = built_in.system("cart-pole").model
    monkeypatch.setattr(archive.shutil, "which", lambda name: None)
    (two,), (three,) = (exported_files(model, version, "cart").values() for version in VERSIONS)
    assert isinstance(two, bytes) and isinstance(three, bytes)
    with zipfile.ZipFile(io.BytesIO(two)) as packed:
        assert packed.namelist() == ["modelDescription.xml", "sources/cart.c"]
        root = ET.fromstring(packed.read("modelDescription.xml"))
    assert [x.get("name") for x in root.iter("File")] == ["cart.c", "cart.c"]
    variables = {x.get("name"): x for x in root.iter("ScalarVariable")}
    assert {"x", "theta", "x'", "der(theta')", "F", "m", "energy.kinetic"} <= set(variables)
    assert variables["theta"].find("Real").attrib == {"unit": "rad", "start": "0.0"} or variables["theta"][0].get(
        "start"
    )  # type: ignore[union-attr]
    with zipfile.ZipFile(io.BytesIO(three)) as packed:
        assert packed.namelist() == ["modelDescription.xml", "sources/cart.c", "sources/buildDescription.xml"]
    assert exported_files(model, "fmu3", "cart")["cart.fmu"] == three  # equal FMUs have equal bytes


@needs_fmpy
@pytest.mark.slow
def test_a_source_fmu_is_built_by_fmpy(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from fmpy.build import build_platform_binary

    if shutil.which("cmake") is None or shutil.which("make") is None:
        pytest.skip("no CMake and make")
    import fmpy

    which = shutil.which
    monkeypatch.setattr(archive.shutil, "which", lambda name: None)
    path = exported_to(tmp_path, "cart-pole", "fmu3")
    monkeypatch.setattr(archive.shutil, "which", which)
    folder = pathlib.Path(fmpy.extract(str(path), str(tmp_path / "unpacked")))
    (tmp_path / "built").mkdir()
    build_platform_binary(folder, tmp_path / "built")
    assert run(folder, "CoSimulation", 0.1, ["x", "theta"]).shape == (2,)


def test_a_parameter_without_a_value_is_refused(tmp_path: pathlib.Path) -> None:
    s = lg.System("spring")
    x, k = s.coordinates("x"), s.parameter("k")
    s.particle(1, at=s.origin + (x, 0))
    s.spring(k, deflection=x)
    with pytest.raises(lg.ModelError, match="parameter 'k' has no value, and an FMU needs"):
        s.export(tmp_path / "spring.fmu")
    assert not list(tmp_path.iterdir())
