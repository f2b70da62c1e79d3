"""Reactions and fixed coordinates on the command and in files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import lagrangian as lg
from lagrangian.cli import main

FILE = """
name = "four-bar"

[coordinates]
crank = "angle"
coupler = "angle"
rocker = "angle"

[parameters]
g = "9.81 m/s^2"

[points]
A = { frame = "C", offset = [0.5, 0] }
B = { from = "A", frame = "K", offset = [1.2, 0] }
D = { from = "B", frame = "R", offset = [0.9, 0] }
post = [1, 0]
CG = { frame = "C", offset = [0.25, 0] }
KG = { from = "A", frame = "K", offset = [0.6, 0] }
RG = { from = "B", frame = "R", offset = [0.45, 0] }

[[frame]]
name = "C"
angle = "crank"

[[frame]]
name = "K"
angle = "coupler"

[[frame]]
name = "R"
angle = "rocker"

[[rigid_body]]
name = "rod 1"
mass = 1
inertia = 0.02
at = "CG"
frame = "C"

[[rigid_body]]
name = "rod 2"
mass = 2
inertia = 0.24
at = "KG"
frame = "K"

[[rigid_body]]
name = "rod 3"
mass = 2
inertia = 0.135
at = "RG"
frame = "R"

[[gravity]]
direction = [0, -1]

[[pin]]
name = "loop"
between = ["D", "post"]

[simulate]
duration = "1 s"
initial = { crank = 1.0 }
fixed = ["crank"]
reactions = ["loop", "A"]
"""


@pytest.fixture()
def file(tmp_path: Path) -> str:
    path = tmp_path / "four-bar.toml"
    path.write_text(FILE, encoding="utf-8")
    return str(path)


def said(capsys: pytest.CaptureFixture[str], *argv: str) -> tuple[int, str, str]:
    code = main(list(argv))
    out = capsys.readouterr()
    return code, out.out, out.err


@pytest.mark.slow
def test_a_file_asks_for_reactions_and_holds_coordinates() -> None:
    system = lg.loads(FILE)
    run = system.simulate(samples=11)
    assert run["crank"][0] == 1.0
    data = run.to_xarray()
    assert data["reaction.loop.x"].attrs["units"] == "N"
    drawn = [[line.get_label() for line in axes.lines] for axes in run.plot().axes]
    assert any("loop.x" in str(x) and "A.y" in str(x) for x in drawn) and "torque" not in str(drawn)  # pins
    assert np.array_equal(data["reaction.A.y"].values, run.reaction("A").force[:, 1])
    # upwards, the two supports together carry the weight and what the centres accelerate by
    last = run.reaction("origin").force + run.reaction("loop").force
    heights = {
        1: "(0.25*cos(crank)*crank'' - 0.25*sin(crank)*crank'^2)",
        2: "(1.0*(cos(crank)*crank'' - sin(crank)*crank'^2)"
        " + (0.6 + 1.2)*(cos(coupler)*coupler'' - sin(coupler)*coupler'^2)"
        " + 0.45*(cos(rocker)*rocker'' - sin(rocker)*rocker'^2))",
    }
    change = run[heights[1]] + 2 * run[heights[2]]
    assert last[:, 1] == pytest.approx(change + 5 * 9.81, abs=1e-9)


def test_they_are_written_back_to_a_file() -> None:
    again = lg.loads(lg.loads(FILE).to_toml())
    assert again.model.settings["reactions"] == ["loop", "A"]
    assert again.model.settings["fixed"] == ["crank"]


def test_an_unknown_joint_in_a_file_is_told_with_its_place() -> None:
    with pytest.raises(lg.ParseError, match="no joint 'lop'") as trouble:
        lg.loads(FILE.replace('["loop", "A"]', '["lop", "A"]'))
    assert trouble.value.place is not None and "loop" in trouble.value.fix
    with pytest.raises(lg.ModelError, match="no body hangs on it"):
        lg.loads(FILE.replace('["loop", "A"]', '["loop", "KG"]')).simulate()


@pytest.mark.slow
def test_the_command_adds_reactions_to_the_table_and_the_summary(capsys: pytest.CaptureFixture[str], file: str) -> None:
    code, out, _ = said(capsys, "simulate", file, "--reactions", "B,rod 1", "--fixed", "crank", "-o", "-")
    assert code == 0
    head = out.splitlines()[0].split(",")
    assert {"reaction.B.x", "reaction.rod 1.y", "multiplier.loop.x"} <= set(head)
    code, out, _ = said(capsys, "simulate", file, "--reactions", "B", "--json")
    assert code == 0
    units = {c["name"]: c["unit"] for c in json.loads(out)["columns"]}
    assert units["reaction.B.x"] == "N" and units["reaction.B.torque_z"] == "N m"
    code, _, err = said(capsys, "simulate", file, "--reactions", "elbow")
    assert code != 0 and "no joint 'elbow'" in err


@pytest.mark.slow
def test_sweeps_hold_coordinates_and_keep_multipliers(capsys: pytest.CaptureFixture[str], file: str) -> None:
    code, out, _ = said(
        capsys, "sweep", file, "crank=0.9,1.0", "--fixed", "crank", "--output-of", "max loop.x", "-o", "-"
    )
    assert code == 0, out
    lines = out.splitlines()
    assert len(lines) == 3 and "max loop.x" in lines[0]
    code, _, err = said(capsys, "sweep", file, "crank=0.9,1.0", "--fixed", "shaft")
    assert code != 0 and "no coordinate 'shaft'" in err


@pytest.mark.parametrize("verb", ["linearize", "simulate", "sweep", "animate"])
def test_coordinates_that_stay_are_a_list_or_several_options(
    capsys: pytest.CaptureFixture[str], file: str, verb: str
) -> None:
    """Every name is read in both forms: the second one, which is unknown, is what the error names."""
    for asked in (["--fixed", "crank,shaft"], ["--fixed", "crank", "--fixed", "shaft"]):
        values = {"sweep": ["crank=0.9,1.0"], "animate": ["-o", file + ".svg"]}.get(verb, [])
        code, _, err = said(capsys, verb, file, *values, *asked)
        assert (code, "there is no coordinate 'shaft' to hold fixed" in err) == (2, True), err
