"""What docs/simulation.md says runs as it stands there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pytest

from lagrangian import examples
from lagrangian.cli import main

TEXT = (Path(__file__).parents[2] / "docs" / "simulation.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    parts = re.split(r"^```(.*)$", TEXT, flags=re.M)
    return [body.lstrip("\n") for opened, body in zip(parts[1::4], parts[2::4], strict=True) if opened == language]


@pytest.mark.slow
def test_the_python_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    mpl.use("agg")
    monkeypatch.chdir(tmp_path)
    code = "\n".join(blocks("python"))
    names: dict[str, Any] = {}
    exec(compile(code, "docs/simulation.md", "exec"), names)
    said = capsys.readouterr().out
    assert "event 'floor' ended the run at t = 0.451523641 s" in said and "gave up after 50 steps" in said
    assert (tmp_path / "run.png").exists() and (tmp_path / "run.csv").exists()
    assert float(names["run"].audit) < 1e-9


@pytest.mark.slow
def test_the_command_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "carts.toml").write_text(examples.text("two-carts"), encoding="utf-8")
    (block,) = (b for b in blocks("") if b.startswith("lagrangian "))
    argv = shlex.split(block.replace("\\\n", " "))
    assert main(argv[1:]) == 0
    assert (tmp_path / "carts.png").exists() and (tmp_path / "carts.nc").exists()
