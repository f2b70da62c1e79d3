"""The scripts in examples/ run, and what they derive is right."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest
import sympy as sp
from derived import derivation
from sympy.physics.mechanics import dynamicsymbols

from size import rest_slow

FOLDER = Path(__file__).parents[2] / "docs" / "examples"
SCRIPTS = sorted(FOLDER.glob("*.py"))
LONG = {FOLDER / "ilqr_acrobot.py"}


def run(name: str) -> dict:
    return runpy.run_path(str(FOLDER / f"{name}.py"), run_name="example")


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "script", rest_slow(SCRIPTS, set(SCRIPTS) - {FOLDER / "ilqr_acrobot.py"}), ids=lambda path: path.stem
)
def test_a_script_prints_what_it_finds(script: Path, capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(script), run_name="__main__")
    assert len(capsys.readouterr().out) > 100


def test_the_arm_in_python_is_the_arm_in_the_file() -> None:
    script, file = run("two_link_arm")["d"], derivation("lecture-2")
    assert [(e.lhs, e.rhs) for e in script.equations] == [(e.lhs, e.rhs) for e in file.equations]
    assert script.Xi == {dynamicsymbols("theta1"): 0, dynamicsymbols("theta2"): dynamicsymbols("tau")}


def test_the_cart_in_python_is_the_cart_in_the_file() -> None:
    script, file = run("cart_pole")["d"], derivation("cart-pole")
    for one, other in zip(script.equations, file.equations, strict=True):
        assert sp.expand(one.lhs - one.rhs - other.lhs + other.rhs, trig=True) == 0


def test_the_bead_from_its_energies_rubs_along_its_way() -> None:
    script, file = run("from_energies")["d"], derivation("bead-on-parabola")
    x, (c, b) = dynamicsymbols("x"), sp.symbols("c b")
    (one,), (other,) = script.equations, file.equations
    assert sp.expand(one.lhs - one.rhs - other.lhs - b * (1 + 4 * c**2 * x**2) * x.diff()) == 0


ACROBOT = pytest.param("ilqr_acrobot", [3.14159, 0, 0, 0], marks=pytest.mark.slow)


@pytest.mark.parametrize(("name", "goal"), [("ilqr_swing_up", [0, 0, 0, 0]), ACROBOT])
def test_it_swings_up_and_stands(name: str, goal: list[float]) -> None:
    script = run(name)
    X, U, _ = script["swing_up"]()
    assert abs(X[0] - script["start"]).max() == 0 and abs(X[-1] - goal).max() < 0.02
    again = script["dyn"].step(X[:-1, :2], X[:-1, 2:], U, script["dt"])  # every state follows from the one before
    assert abs(again - X[1:]).max() < 1e-11
