"""What is imported, and when: the start of the package and of the command waits for nothing that it does not use."""

import inspect
import pathlib
import subprocess
import sys
from importlib import import_module

import pytest
import typer

import lagrangian
from lagrangian.cli.app import app
from lagrangian.cli.verbs import VERBS
from lagrangian.integrate import METHODS
from lagrangian.integrate.method_names import MACHINE

HEAVY = {"sympy", "numpy", "scipy", "llvmlite", "pint", "pydantic", "lark", "rich", "typer", "matplotlib", "mpmath"}


def imported(code: str, *arguments: str) -> set[str]:
    """The packages among HEAVY that are imported once ``code`` has run in a fresh interpreter."""
    ending = "\nimport sys as _s; _s.stderr.write('|'.join({m.partition('.')[0] for m in _s.modules}))"
    done = subprocess.run([sys.executable, "-c", code + ending, *arguments], capture_output=True, text=True, check=True)
    return HEAVY & set(done.stderr.splitlines()[-1].split("|"))


def command(*arguments: str) -> str:
    return f"from lagrangian.cli import main\nmain({list(arguments)!r})"


def test_importing_the_package_imports_nothing_heavy() -> None:
    assert imported("import lagrangian; lagrangian.__version__; dir(lagrangian)") == set()


LATER = ("codegen", "dynamics", "export", "fit", "graph", "integrate", "look", "optimize", "simulate", "verify", "web")
"""The rooms of which touching the public names needs nothing."""


@pytest.mark.slow
def test_touching_the_public_names_imports_no_room_that_answers_questions() -> None:
    code = "import lagrangian as lg; lg.System, lg.load, lg.example, lg.System.fit, lg.System.optimize"
    ending = "\nimport sys; print(*(m.split('.')[1] for m in sys.modules if m.startswith('lagrangian.')))"
    done = subprocess.run([sys.executable, "-c", code + ending], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert {"model", "system"} <= loaded
    assert loaded.isdisjoint(LATER)


PENDULUM = """
import sys
sys.modules.update(dict.fromkeys({blocked!r}))  # as if they were not installed
import lagrangian as lg
from sympy import cos, sin
pendulum = lg.System("pendulum")
theta = pendulum.coordinates("theta")
m, L = pendulum.parameters("m L")
pendulum.particle(m, at=pendulum.origin + (L * sin(theta), -L * cos(theta)))
pendulum.gravity(direction=(0, -1))
"""


def test_describing_a_system_imports_sympy_alone() -> None:
    assert imported(PENDULUM.format(blocked=())) == {"sympy", "mpmath"}


@pytest.mark.slow
def test_a_derivation_needs_no_machine_code_units_or_files() -> None:
    """From a blank page to the text, on a machine where nothing but SymPy and NumPy is installed."""
    blocked = sorted(HEAVY - {"sympy", "mpmath", "numpy"})
    last = "assert 'm L² θ̈ + m g L sin θ = 0' in pendulum.derive().to_text()"
    assert "numpy" in imported(PENDULUM.format(blocked=blocked) + last)


@pytest.mark.slow
def test_source_code_is_written_without_llvm_and_its_absence_is_reported() -> None:
    ending = """
import pathlib, tempfile
with tempfile.TemporaryDirectory() as folder:
    made = pendulum.export(pathlib.Path(folder) / "pendulum.c") + pendulum.export(pathlib.Path(folder) / "pendulum.py")
    assert "this file does nothing" in made[-1].read_text()  # its start needs machine code
assert len(made) == 3
for verb in (pendulum.compile, lambda: pendulum.simulate(1.0, params={{"m": 1, "L": 1}})):
    try:
        verb()
    except lg.MissingExtra as missing:
        assert "'llvmlite', which is not installed" in str(missing)
    else:
        raise AssertionError("machine code without LLVM")
"""
    imported((PENDULUM + ending).format(blocked=["llvmlite", "llvmlite.binding"]))


@pytest.mark.parametrize("room", ["read", "write", "codegen", "integrate"])
def test_a_lazy_room_has_all_its_names_and_no_file_of_that_name(room: str) -> None:
    package = import_module(f"lagrangian.{room}")
    assert package.__file__ is not None
    files = {path.stem for path in pathlib.Path(package.__file__).parent.glob("*.py")}
    for name in package.__all__:
        assert not inspect.ismodule(getattr(package, name)), name
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        getattr(package, "nothing")  # noqa: B009
    assert not files & set(package.__all__)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("arguments", [["version"], ["examples"], ["new", "pendulum"], ["--help"], ["nonsense"], []])
def test_what_describes_the_command_imports_no_mathematics(arguments: list[str]) -> None:
    reads = {"new", "nonsense"} & set(arguments)
    assert imported(command(*arguments)) <= {"typer", "rich"} | ({"pydantic"} if reads else set())  # Typer reads by it


def test_the_help_of_every_verb_imports_no_mathematics() -> None:
    asking = """
from lagrangian.cli.app import app
from lagrangian.cli.verbs import VERBS
import typer
group = typer.main.get_command(app)
for name in VERBS:
    try:
        group.main([name, "--help"])
    except SystemExit as stop:
        assert stop.code == 0
"""
    assert imported(asking) <= {"typer", "rich"}


def test_the_help_names_the_methods_that_there_are() -> None:
    assert tuple(METHODS) == MACHINE


def test_public_names_are_all_and_no_more() -> None:
    shown = {name for name in dir(lagrangian) if not name.startswith("__")}
    assert shown == set(lagrangian.__all__)
    for name in lagrangian.__all__:
        assert getattr(lagrangian, name).__name__ == name
    with pytest.raises(AttributeError, match="no attribute 'Systm'"):
        getattr(lagrangian, "Systm")  # noqa: B009  (the type checker would refuse the name)


def test_the_list_of_verbs_says_what_the_verbs_say() -> None:
    for name, (file, function, line) in VERBS.items():
        module = file if "." in file else f"lagrangian.cli.{file}"
        found = getattr(import_module(module), function)
        assert (inspect.getdoc(found) or "").splitlines()[0] == line, name


def test_a_verb_shows_its_own_options_once_asked() -> None:
    group = typer.main.get_command(app)
    context = typer.Context(group)
    for name, verb in group.commands.items():  # type: ignore[attr-defined]
        assert "help" in {option.name for option in verb.get_params(context)}, name
