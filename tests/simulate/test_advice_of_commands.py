"""Commands advise their own options, not Python."""

from __future__ import annotations

import ast
import pathlib
from typing import Any

import pytest
import typer

import lagrangian
from lagrangian.advice import Advice, Argument, Verb
from lagrangian.cli import main
from lagrangian.cli.app import app
from lagrangian.cli.verbs import VERBS
from lagrangian.cli.wording import in_options

BARE = """name = "bare"
[coordinates]
x = "place"
[parameters]
m = {}
[[particle]]
mass = "m"
at = ["x", "0"]
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("argv", "advice"),
    [
        (["simulate", "FILE", "--set", "m=1"], "Fix: --duration 10"),
        (["simulate", "FILE", "-d", "1"], "Fix: give --set m=…"),
        (["simulate", "FILE", "-d", "1", "--set", "m=1", "--method", "rk4"], "Fix: give --step 0.01"),
        (["sweep", "FILE", "x=0:1:3", "-d", "1"], "Fix: give --set m=…"),
        (["sweep", "FILE", "m=1:2:3"], "Fix: --duration 10"),
        (["sweep", "FILE", "-d", "1", "--set", "m=1"], "its values: k=10:100:50"),
        (["sweep", "FILE", "m~normal(1,0.1)", "-d", "1"], "Fix: --draws 1000"),
        (["simulate", "FILE", "-d", "1", "--set", "m=1", "--step", "1"], "Fix: give --rtol and --atol, or --max-step"),
        (
            ["simulate", "FILE", "-d", "9", "--set", "m=1", "--max-steps", "3"],
            "a larger --max-steps, or --method Radau",
        ),
        (
            ["linearize", "-e", "cart-pole", "--at", "theta=1"],
            "`lagrangian equilibria` finds equilibria; --operating-point",
        ),
        (["linearize", "FILE"], "Fix: give --set m=…"),
    ],
)
def test_advice_is_in_options(argv: list[str], advice: str, tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "bare.toml"
    file.write_text(BARE, encoding="utf-8")
    assert main([str(file) if word == "FILE" else word for word in argv]) != 0
    assert advice in capsys.readouterr().err


def test_a_mass_and_a_missed_balance_are_said(tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "spring.toml"
    file.write_text(BARE + '[[spring]]\nk = "4*m"\ndeflection = "x"\n', encoding="utf-8")
    assert main(["simulate", str(file), "-d", "1", "--set", "m=-1"]) != 0
    assert "E102" in capsys.readouterr().err
    run = ["simulate", str(file), "-d", "20", "--set", "m=1", "--init", "x=0.1", "--method", "rk4", "--step", "0.5"]
    assert main([*run, "--samples", "21"]) == 0
    said = capsys.readouterr()
    assert "energy balance missed by" in said.err
    assert "energy balance missed by" in said.out


@pytest.mark.slow
def test_what_advice_names_is_there() -> None:
    """Every argument named in advice anywhere is an option of some verb, and every verb is one of the command."""
    group: Any = typer.main.get_command(app)
    options = {o for name in VERBS for p in group.get_command(None, name).verb.params for o in p.opts}
    calls = [
        node
        for file in pathlib.Path(lagrangian.__file__).parent.rglob("*.py")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("Argument", "Verb")
    ]
    named = {(c.func.id, *(a.value for a in c.args[:1] if isinstance(a, ast.Constant))) for c in calls}  # type: ignore[attr-defined]
    assert len(named) > 20 and all(len(n) == 2 for n in named)
    assert {name for kind, name in named if kind == "Verb"} <= set(VERBS)
    said = {in_options(Advice(Argument(name))) for kind, name in named if kind == "Argument" and name != "grid"}
    assert said <= options


def test_the_same_advice_is_python_or_options() -> None:
    advice = Advice("use ", Verb("simulate"), " with ", Argument("step", "0.01"), " and ", Argument("params", "2", "k"))
    assert advice == "use system.simulate() with step=0.01 and params={'k': 2}"
    assert in_options(advice) == "use `lagrangian simulate` with --step 0.01 and --set k=2"
