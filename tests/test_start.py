"""What is imported, and when: the start of the package and of the command waits for nothing that it does not use."""

import inspect
import subprocess
import sys
from importlib import import_module

import pytest
import typer

import lagrangian
from lagrangian.cli import app
from lagrangian.commands.verbs import VERBS

HEAVY = {"sympy", "numpy", "scipy", "llvmlite", "pint", "pydantic", "lark", "rich", "typer", "matplotlib", "mpmath"}


def imported(code: str, *arguments: str) -> set[str]:
    """The packages among HEAVY that are imported once ``code`` has run in a fresh interpreter."""
    ending = "\nimport sys as _s; _s.stderr.write('|'.join({m.partition('.')[0] for m in _s.modules}))"
    done = subprocess.run(
        [sys.executable, "-c", code + ending, *arguments], capture_output=True, text=True, timeout=120, check=True
    )
    return HEAVY & set(done.stderr.split("|"))


def command(*arguments: str) -> str:
    return f"from lagrangian.cli import main\nmain({list(arguments)!r})"


def test_importing_the_package_imports_nothing_heavy() -> None:
    assert imported("import lagrangian; lagrangian.__version__; dir(lagrangian)") == set()


@pytest.mark.parametrize("arguments", [["version"], ["examples"], ["new", "pendulum"], ["--help"], ["nonsense"], []])
def test_what_describes_the_command_imports_no_mathematics(arguments: list[str]) -> None:
    assert imported(command(*arguments)) <= {"typer", "rich", "pydantic"}  # Typer itself reads options by pydantic


def test_public_names_are_all_and_no_more() -> None:
    shown = {name for name in dir(lagrangian) if not name.startswith("__")}
    assert shown == set(lagrangian.__all__)
    for name in lagrangian.__all__:
        assert getattr(lagrangian, name).__name__ == name
    with pytest.raises(AttributeError, match="no attribute 'Systm'"):
        getattr(lagrangian, "Systm")  # noqa: B009  (the type checker would refuse the name)


def test_the_list_of_verbs_says_what_the_verbs_say() -> None:
    for name, (file, function, line) in VERBS.items():
        found = getattr(import_module(f"lagrangian.commands.{file}"), function)
        assert (inspect.getdoc(found) or "").splitlines()[0] == line, name


def test_a_verb_shows_its_own_options_once_asked() -> None:
    group = typer.main.get_command(app)
    context = typer.Context(group)
    for name, verb in group.commands.items():  # type: ignore[attr-defined]
        assert "help" in {option.name for option in verb.get_params(context)}, name
