"""The verbs fit and optimize: tables of measured data, unknowns, what is found, and what is wrong with them."""

import json
import math
from pathlib import Path

import pytest

from lagrangian import example
from lagrangian.cli import main
from lagrangian.cli.table_files import named_columns


@pytest.fixture
def swing(tmp_path: Path) -> Path:
    """A pendulum of 0.8 m, in milliseconds and degrees, every seventh sample missing."""
    run = example("pendulum").simulate(2.0, theta=0.5, params={"L": 0.8}, samples=41)
    lines = [
        f"{1000 * t!r}, {'' if k % 7 == 3 else math.degrees(x)}"
        for k, (t, x) in enumerate(zip(map(float, run.t), map(float, run["theta"]), strict=True))
    ]
    path = tmp_path / "swing.csv"
    path.write_text("\n".join(["# in the lab", "t [ms], theta [deg]", *lines]) + "\n", encoding="utf-8")
    return path


def test_fit_finds_a_length_from_a_table_with_units(swing: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        main(["fit", "-e", "pendulum", "L=50 cm", "theta", "--data", str(swing), "--init", "theta=0.3", "--json"]) == 0
    )
    found = json.loads(capsys.readouterr().out)
    assert found["estimate"] == pytest.approx({"L": 0.8, "theta": 0.5}, rel=1e-9)
    assert main(["fit", "-e", "pendulum", "L", "theta=0.4", "--data", str(swing), "--max-evaluations", "1"]) == 1
    assert "did not end at a minimum" in capsys.readouterr().out


@pytest.mark.slow
def test_optimize_finds_the_least_effort(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model, table, picture = tmp_path / "cart.toml", tmp_path / "push.csv", tmp_path / "best.svg"
    model.write_text(
        'name = "cart"\n[coordinates]\nx = ""\n[inputs]\nF = ""\n[[particle]]\nmass = 1\nat = ["x", "0"]\n'
        '[[force]]\nvalue = ["F", "0"]\nat = ["x", "0"]\n',
        encoding="utf-8",
    )
    table.write_text("t,F\n0,0\n1,0\n", encoding="utf-8")
    reach = ["--reach", "x=1", "--reach", "x'=0", "-d", "1", "--integral", "F^2"]
    assert main(["optimize", str(model), "F", "-i", f"F=@{table}", *reach, "--plot", str(picture), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["values"] == pytest.approx({"F[0]": 6, "F[1]": -6}) and found["cost"] == pytest.approx(12)
    assert picture.stat().st_size > 1000


@pytest.mark.parametrize(
    ("table", "words", "said"),
    [
        ("t,theta\n0,1\n0.1,x\n", ["L"], "data.csv:3: [E406] 'x' in the column 'theta' is not a number"),
        ("t,theta\n0,1\n0.1\n", ["L"], "data.csv:3: [E406] a line with 1 cells under 2 names"),
        ("t,theta [foo]\n0,1\n", ["L"], "data.csv:1: [E408] the unit of the column 'theta': unknown unit 'foo'"),
        ("0,1\n0.1,2\n", ["L"], "data.csv:1: [E406] the first line has no names"),
        ("t,theta,bob.x\n0,1,2\n", ["L"], "--columns theta"),
        ("t,theta\n0,1\n1,2\n", ["L", "--columns", "phi"], "has no column 'phi'"),
        ("t,theta\n0,1\n1,2\n", ["L="], "unknowns are names, or name=guess"),
        ("t,theta\n0,1\n1,2\n", ["Lq"], "Did you mean 'L'?"),
        ("t,theta\n0,1\n1,2\n", ["L", "--bounds", "L=3"], "the range of 'L' is not low:high"),
    ],
)
def test_tables_and_unknowns_that_are_wrong_are_said_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], table: str, words: list[str], said: str
) -> None:
    path = tmp_path / "data.csv"
    path.write_text(table, encoding="utf-8")
    assert main(["fit", "-e", "pendulum", *words, "--data", str(path)]) == 2
    assert said in capsys.readouterr().err


def test_what_is_lacking_is_named_as_an_option(capsys: pytest.CaptureFixture[str]) -> None:
    for words, said in {
        ("fit", "-e", "pendulum", "L"): "--data swing.csv",
        ("optimize", "-e", "cart-pole", "F", "-d", "1"): '--final "(x - 1)^2"',
        ("fit", "L=3", "--data", "a.csv"): "'L=3' is not a model file",
    }.items():
        assert main([*words]) == 2
        assert said in capsys.readouterr().err


def test_a_quoted_name_and_an_expression_are_columns(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text('t,"L*sin(theta) [mm]",x\'\n0,5,nan\n', encoding="utf-8")
    assert named_columns(str(path))["L*sin(theta)"] == [0.005]
    assert math.isnan(named_columns(str(path))["x'"][0])
