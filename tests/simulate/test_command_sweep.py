"""The command `lagrangian sweep`, as it is typed."""

import os
import pathlib
import signal
import subprocess
import sys
import time
from functools import partial

import numpy as np
import pytest

import lagrangian as lg
from lagrangian import examples
from lagrangian.cli import main

FAST = ["--method", "rk4", "--step", "0.01", "--duration", "2"]


@pytest.fixture
def folder(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> pathlib.Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.toml").write_text(examples.text("double-pendulum"), encoding="utf-8")
    return tmp_path


def run(*arguments: str) -> int:
    return main(["sweep", *arguments])


def test_a_summary_on_the_terminal(folder: pathlib.Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("arm.toml", "theta1=10deg:120deg:5", "m2=1,2", "--output-of", "reach=max L1*sin(theta1)", *FAST) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert "10 runs, theta1 (5) × m2 (2), rk4" in said.out
    assert "\n  all reached the end\n" in said.out
    runs = lg.load("arm.toml").sweep(
        2.0, ["theta1=10deg:120deg:5", "m2=1,2"], outputs={"reach": "max L1*sin(theta1)"}, method="rk4", step=0.01
    )
    assert f"{runs['reach'].max():.6g}" in said.out
    place = runs.at(tuple(np.unravel_index(runs["reach"].argmax(), (5, 2))))
    assert f"theta1 = {place['theta1']:.6g}, m2 = {place['m2']:.6g}" in said.out


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["a.csv", "a.nc", "a.parquet", "a.zarr"])
def test_files(folder: pathlib.Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    given = ("arm.toml", "m2~normal(1,0.1)", "--draws", "20", "--seed", "4", "--output-of", "max theta1", *FAST)
    assert run(*given, "-o", name) == 0
    assert capsys.readouterr().out == ""
    assert run(*given, "-o", name) == 2
    assert "exists" in capsys.readouterr().err
    assert run(*given, "-o", name, "--force") == 0
    assert run(*given, "-o", "-") == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "sample,m2,max theta1,reached,status"
    if name == "a.csv":
        assert (folder / name).read_text().splitlines() == lines
    if name == "a.zarr":
        assert run(*given, "-o", name, "--resume") == 0
        kept = lg.Ensemble.of_store(name)
        assert [float(line.split(",")[2]) for line in lines[1:]] == kept["max theta1"].tolist()


@pytest.mark.slow
def test_a_damaged_store_is_made_good_with_resume(folder: pathlib.Path, capsys: pytest.CaptureFixture[str]) -> None:
    given = ("arm.toml", "theta1=0.1,0.2", "--output-of", "max theta1", *FAST, "-o", "a.zarr")
    assert run(*given) == 0
    before = lg.Ensemble.of_store("a.zarr")["max theta1"].tolist()
    chunk = folder / "a.zarr" / "max theta1" / "c" / "0"
    data = bytearray(chunk.read_bytes())
    data[len(data) // 2] ^= 4
    chunk.write_bytes(data)
    with pytest.raises(lg.RunError, match="E804"):
        lg.Ensemble.of_store("a.zarr")["max theta1"]
    capsys.readouterr()
    assert run(*given, "--resume") == 0
    said = capsys.readouterr()
    assert "'a.zarr' has 1 damaged chunk (2 runs): 'max theta1/c/0' is not what was written" in said.err
    assert "it is computed again" in said.err
    assert lg.Ensemble.of_store("a.zarr")["max theta1"].tolist() == before
    (folder / "a.zarr" / "zarr.json").write_text("{}")
    assert run(*given, "--resume") == 2
    assert "is not a store of a sweep" in capsys.readouterr().err
    assert run(*given, "--force") == 2
    assert "is not replaced" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["arm.toml", "kk=1:2:3", *FAST], "kk"),
        (["arm.toml", "m2=1:2", *FAST], "three parts"),
        (["arm.toml", *FAST], "no varied quantity is given"),
        (["m2=1:2:3", *FAST], "is not a model file"),
        (["arm.toml", "m2=1:2:3", *FAST, "-o", "a.xls"], "a.xls"),
        (["arm.toml", "m2=1:2:3", *FAST, "-o", "a.csv", "--resume"], "only a .zarr store"),
        (["arm.toml", "m2=1:2:3", *FAST, "-o", "nowhere/a.zarr"], "no folder"),
        (["arm.toml", "m2=1:2:3", *FAST, "--output-of", "most theta1"], "no reduction 'most'"),
        (["arm.toml", "m2=1:2:3", "--duration", "-1"], "duration"),
        (["arm.toml", "m2=1:2:3", "--duration", "1 kg"], "duration"),
        (["arm.toml", "m2=1:2:3", *FAST, "--scheduler", "nowhere"], "no scheduler answers"),
        (["missing.toml", "m2=1:2:3", *FAST], "missing.toml"),
    ],
)
def test_mistakes(
    folder: pathlib.Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, arguments, message: str
) -> None:
    from lagrangian.integrate import remote

    monkeypatch.setattr(remote, "PATIENCE", 0.3)
    assert run(*arguments) == 2
    said = capsys.readouterr()
    assert message in said.err
    assert "Traceback" not in said.err
    assert said.out == ""


def test_failures_are_told_and_counted(folder: pathlib.Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("arm.toml", "theta1'=0,1e149", *FAST) == 0
    said = capsys.readouterr()
    assert "1 of 2 runs failed" in said.err
    assert "theta1' = 1e+149: stopped at" in said.err
    assert run("arm.toml", "theta1'=1e149,2e149", *FAST) == 1


@pytest.mark.slow
def test_an_interrupt_on_a_terminal_loses_nothing(folder: pathlib.Path) -> None:
    pty = pytest.importorskip("pty")
    ours, theirs = pty.openpty()
    grid = ["theta1=0.1:3:200", "m2~normal(1,0.1)", "--draws", "500", "-o", "a.zarr", "--output-of", "max theta1"]
    command = [sys.executable, "-m", "lagrangian", "sweep", "arm.toml", *grid, *FAST, "--duration", "60"]
    # as a terminal starts it: tests that run in the background pass on that interrupts are ignored
    heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    process = subprocess.Popen(command, stderr=theirs, stdout=subprocess.DEVNULL, preexec_fn=heard)
    os.close(theirs)
    marks = folder / "a.zarr" / "done" / "c" / "0"
    while process.poll() is None and not (marks.exists() and finished(marks).sum() > 1):
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    said = b""
    while chunk := _read(ours):
        said += chunk
    assert process.wait() == 130
    text = said.decode()
    assert "continue with --resume" in text
    assert "Traceback" not in text
    assert 1 < finished(marks).sum() < len(finished(marks))


def finished(marks: pathlib.Path) -> np.ndarray:
    """Which chunks are finished: those with a mark for each of the three results."""
    return np.frombuffer(marks.read_bytes(), "<u8").reshape(-1, 3).all(axis=1)


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 4096)
    except OSError:  # the other end is closed
        return b""
