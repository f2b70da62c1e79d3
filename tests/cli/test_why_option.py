"""``lagrangian derive --why``: the page in the format of the file's ending, and options that do not go with it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from lagrangian.cli import main


@pytest.mark.parametrize(("ending", "begin"), [("html", "<!DOCTYPE html>"), ("tex", "\\documentclass"), ("md", "# ")])
def test_the_format_is_that_of_the_ending(tmp_path: Path, ending: str, begin: str) -> None:
    path = tmp_path / f"why.{ending}"
    assert main(["derive", "--example", "pendulum", "--why", "-o", str(path)]) == 0
    assert path.read_text(encoding="utf-8").startswith(begin)


def test_the_data_has_the_forces_and_the_counts(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["derive", "--example", "pendulum", "--why", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["constraint_forces"]["m"][0] == "-L*m*sin(theta)*theta'^2 + L*m*cos(theta)*theta''"
    assert data["spared"]["equations"] == 2 and all(check["holds"] for check in data["checks"])


@pytest.mark.parametrize("option", ["--brief", "--describe"])
def test_options_of_the_steps_do_not_go_with_it(option: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["derive", "--example", "pendulum", "--why", option]) == 2
    assert f"{option} is for the steps" in capsys.readouterr().err
