"""Commands advise their own options, not Python."""

from __future__ import annotations

from typing import Any

import pytest

from lagrangian.cli import main

BARE = """name = "bare"
[coordinates]
x = "place"
[parameters]
m = {}
[[particle]]
mass = "m"
at = ["x", "0"]
"""


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
        (["linearize", "-e", "cart-pole", "--at", "theta=1"], "`lagrangian equilibria` finds them; --operating-point"),
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
