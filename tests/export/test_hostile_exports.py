"""Texts of a model in exports: none becomes code, ends a comment or a string, or turns what follows."""

import ast
import io
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
import zipfile

import pytest
from typer.testing import CliRunner

import lagrangian as lg
from lagrangian.cli.app import app
from lagrangian.export import TARGETS, exported_files
from lagrangian.export.fmu import archive
from lagrangian.verify.foreign.checks import NOT_RUN, RUNNERS, not_run

ATTACK = (
    '\x1b[31mred\x1b]0;t\x07 <script>alert(1)</script> %{ } ... \\input{x} */ // # """ \' " $(x) end end; '
    "\u202egnp\u202c \u2066a\u2069\u2028system('x')"
)
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\u200e\u200f]")


@pytest.fixture(scope="module")
def hostile() -> lg.System:
    system = lg.System(ATTACK)
    x = system.coordinate("x", ATTACK)
    m = system.parameter("m", 1.0, description=ATTACK + "\nsecond line")
    F = system.input("F", ATTACK)
    system.particle(m, at=system.origin + (x, 0), name="<b>'\"\\body{}$%&#_^~</b> alert(1)")
    system.spring(2, deflection=x, name="*/ %} ]]> -->")
    system.force(F, deflection=x)
    return system


def texts(system: lg.System, target: str) -> dict[str, str]:
    """All texts of an export, those of archives included."""
    found: dict[str, str] = {}
    for name, content in exported_files(system.model, target, "s").items():
        if isinstance(content, str):
            found[name] = content
        elif name.endswith(".fmu"):
            with zipfile.ZipFile(io.BytesIO(content)) as packed:
                found |= {n: packed.read(n).decode() for n in packed.namelist() if not n.startswith("binaries/")}
    return found


@pytest.mark.parametrize("target", sorted(set(TARGETS) - {"c", "python", "javascript", "wasm"}))
def test_no_text_of_a_model_is_code(
    hostile: lg.System, target: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if target.startswith("fmu"):
        monkeypatch.setattr(archive.shutil, "which", lambda name: None)
    for name, text in texts(hostile, target).items():
        assert not CONTROL.search(text), (name, CONTROL.search(text))
        if name.endswith(".xml"):
            ET.fromstring(text)
        elif name.endswith(".m"):
            code = [line for line in text.splitlines() if not line.lstrip().startswith("%")]
            found = [line for line in code if re.search(r"alert|\bsystem|input\{", line.split("  %")[0])]
            assert not found
        else:
            ignored = {".mo": r'"[^"\n]*"', ".c": r"/\*.*?\*/"}.get(pathlib.Path(name).suffix, "$^")
            bare = re.sub(ignored, "", text, flags=re.S)  # without strings or comments, which nothing has ended
            assert text.isascii() and "alert(1)" not in bare and "system('x')" not in bare
        if name.endswith(".py"):
            ast.parse(text)
    if target == "matlab" and shutil.which("octave-cli"):
        for name, text in texts(hostile, target).items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        subprocess.run(["octave-cli", "-qf", "s_steps.m"], cwd=tmp_path, check=True, capture_output=True)


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler on this machine")
@pytest.mark.slow
@pytest.mark.parametrize("target", ["fmu2", "fmu3"])
def test_hostile_fmus_compile(hostile: lg.System, target: str) -> None:
    (content,) = exported_files(hostile.model, target, "s").values()
    assert isinstance(content, bytes) and b"binaries/" in content


@pytest.mark.parametrize(
    ("name", "another"),
    [("numpy.py", "numpy_system"), ("class.py", "class_system"), ("json.py", "json_system"), ("math.c", "math_system")],
)
def test_a_name_that_breaks_what_it_names_is_refused(name: str, another: str, tmp_path: pathlib.Path) -> None:
    """``import numpy`` in numpy.py finds the file itself, nothing can be imported from class, and math.h is C's."""
    with pytest.raises(lg.ModelError, match=f"has a meaning there\nFix: use another name, such as {another}"):
        lg.example("pendulum").export(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_every_target_is_run_by_something_or_is_said_to_be_run_by_nothing() -> None:
    """`verify` runs C, Python and JavaScript always, and the others where their programs are."""
    always = {"c", "python", "javascript"}
    assert always | set(RUNNERS) | set(NOT_RUN) == set(TARGETS)
    assert not set(RUNNERS) & set(NOT_RUN)
    for check in not_run():
        assert check.holds is None
        assert check.figure.startswith("not checked: ")


@pytest.mark.parametrize(
    ("target", "said"),
    [("c", "lagrangian verify runs"), ("jax", "lagrangian verify --exports runs"), ("simulink", "in Simulink alone")],
)
def test_the_command_says_that_an_export_is_not_checked(target: str, said: str, tmp_path: pathlib.Path) -> None:
    made = CliRunner().invoke(app, ["export", "-e", "pendulum", "--to", target, "-o", str(tmp_path)])
    assert made.exit_code == 0
    assert said in made.stderr
    assert "not checked" in made.stderr
