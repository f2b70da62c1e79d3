"""``lagrangian simulate`` as it is typed."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from lagrangian.cli import main


def said(capsys: pytest.CaptureFixture[str], *argv: str) -> tuple[int, str, str]:
    code = main(["simulate", *argv])
    out, err = capsys.readouterr()
    return code, out, err


def test_a_summary_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = said(capsys, "-e", "cart-pole", "--duration", "2 s", "--init", "theta=30 deg")
    assert code == 0 and err == ""
    assert "pole on a cart: t = 0 … 2 s" in out
    assert "power balance" in out and "dop853" in out
    row = next(line.split() for line in out.splitlines() if line.split()[:1] == ["theta"])
    assert row[1] == "30" and row[-1] == "deg"
    below = next(line.split() for line in out.splitlines() if line.split()[-1:] == ["(rad)"])
    assert below[0] == f"({np.pi / 6:.4g})"


BLOCK = """
name = "block"

[coordinates]
x = ""

[points]
P = ["x", 0]

[[particle]]
mass = 2
at = "P"

[[friction]]
name = "floor"
mu = 0.5
normal = 20
deflection = "x"
"""


@pytest.mark.slow
def test_a_summary_says_when_friction_sticks(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """A block at 2 m/s that brakes with μ g = 5 m/s² rests after 0.4 s."""
    path = tmp_path / "block.toml"
    path.write_text(BLOCK, encoding="utf-8")
    _, out, _ = said(capsys, str(path), "--duration", "1", "--init", "x'=2")
    assert "friction 'floor' sticks once, 0.6 s in all:\n    0.4 … 1 s\n" in out
    _, out, _ = said(capsys, str(path), "--duration", "0.1", "--init", "x'=2")
    assert "friction 'floor' slips all the time" in out
    _, out, _ = said(capsys, str(path), "--duration", "1", "--init", "x'=2", "--json")
    assert json.loads(out)["stuck"]["floor"] == [[pytest.approx(0.4, abs=1e-12), 1.0]]


def test_csv_on_standard_output_holds_the_run(capsys: pytest.CaptureFixture[str]) -> None:
    argv = ["-e", "pendulum", "-d", "1", "--set", "b=0", "--samples", "5", "-o", "-"]
    code, out, _ = said(capsys, *argv)
    assert code == 0
    header, *lines = out.splitlines()
    assert header.startswith("t,theta,theta'") and len(lines) == 5


@pytest.mark.slow
def test_inputs_parameters_and_methods_are_read(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    argv = ["-e", "cart-pole", "-d", "1", "-s", "m=300 g", "-i", "F=-3*x - 2*x' + sin(t)", "--init", "x'=0.1"]
    code, _, err = said(capsys, *argv, "--method", "rk4", "--step", "1 ms", "-o", str(path), "--samples", "11")
    assert code == 0 and f"wrote {path}" in err
    data = np.genfromtxt(path, delimiter=",", names=True, deletechars="")
    force = -3 * data["x"] - 2 * data["x'"] + np.sin(data["t"])
    assert data["F"] == pytest.approx(force, abs=1e-12)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_pictures_are_drawn(capsys: pytest.CaptureFixture[str], tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"run.{ending}"
    code, _, err = said(capsys, "-e", "pendulum", "-d", "1", "--plot", str(path))
    assert code == 0 and f"wrote {path}" in err
    assert path.stat().st_size > 1000


MISTAKES = [
    (["-e", "cart-pole", "--set", "mm=3"], "Did you mean 'm'?"),
    (["-e", "cart-pole", "--set", "m=3 s"], "has the unit s, but kg is needed"),
    (["-e", "cart-pole", "--set", "m=1", "--set", "m=2"], "'m' is given twice"),
    (["-e", "cart-pole", "--init", "theta"], "takes name=value"),
    (["-e", "cart-pole", "--init", "thet=1"], "Did you mean 'theta'?"),
    (["-e", "cart-pole", "-i", "F=3*zin(t)"], "unknown function 'zin'"),
    (["-e", "cart-pole", "-i", "F=__import__('os')"], "E70"),
    (["-e", "cart-pole", "-d", "-3"], "duration is negative"),
    (["-e", "cart-pole", "--rtol", "0"], "rtol must be above 0"),
    (["-e", "cart-pole", "--method", "rk45"], "write 'RK45'"),
    (["-e", "cart-pole", "-o", "run.xls"], "is not supported"),
    (["-e", "cart-pole", "--plot", "run.xyz"], "is not supported"),
    (["-e", "cart-pole", "-o", "/nowhere/run.csv"], "there is no folder"),
    (["-e", "cart-polo"], "cart-pole"),
    ([], "name a model file"),
]


@pytest.mark.parametrize(("argv", "words"), MISTAKES, ids=[w for _, w in MISTAKES])
def test_mistakes_are_told_on_standard_error(capsys: pytest.CaptureFixture[str], argv: list[str], words: str) -> None:
    code, out, err = said(capsys, *argv)
    assert code == 2 and out == ""
    assert words in err and "Traceback" not in err


def test_files_that_exist_are_kept_unless_forced(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("precious")
    code, _, err = said(capsys, "-e", "pendulum", "-d", "1", "-o", str(path))
    assert code == 2 and "exists already" in err and path.read_text() == "precious"
    code, *_ = said(capsys, "-e", "pendulum", "-d", "1", "-o", str(path), "--force")
    assert code == 0 and path.read_text().startswith("t,theta")


def test_a_run_that_fails_exits_with_1_and_keeps_what_it_reached(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "run.csv"
    argv = ["-e", "pendulum", "-d", "1e7", "--timeout", "0.1", "--samples", "100000", "-o", str(path)]
    code, _, err = said(capsys, *argv)
    assert code == 1 and "time allowed" in err
    assert len(path.read_text().splitlines()) > 2


@pytest.mark.slow
def test_a_closed_pipe_is_no_traceback() -> None:
    argv = [sys.executable, "-m", "lagrangian", "simulate", "-e", "pendulum", "-o", "-"]
    with subprocess.Popen(argv, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stderr is not None
        assert process.stdout.readline().startswith("t,theta")
        process.stdout.close()
        assert "Traceback" not in process.stderr.read()


def test_a_table_in_a_file_drives_the_run(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    table, out = tmp_path / "force.csv", tmp_path / "run.csv"
    table.write_text("t,F\n# measured\n0,1\n0.5,-2\n1,0\n")
    for kind, wanted in (("", [1.0, -0.5, -2.0, -1.0, 0.0]), (" hold", [1.0, 1.0, -2.0, -2.0, 0.0])):
        argv = ["-e", "cart-pole", "-d", "1", "-i", f"F=@{table}{kind}", "--samples", "5", "-o", str(out), "--force"]
        code, _, err = said(capsys, *argv)
        assert code == 0, err
        assert np.genfromtxt(out, delimiter=",", names=True)["F"] == pytest.approx(wanted)
    table.write_text("0,1\n0.5;2\n")
    code, _, err = said(capsys, "-e", "cart-pole", "-d", "1", "-i", f"F=@{table}")
    assert code == 2 and f"{table}:2" in err and "is not a time and a value" in err
    code, _, err = said(capsys, "-e", "cart-pole", "-i", f"F=@{tmp_path / 'none.csv'}")
    assert code == 2 and "cannot read the table: no such file" in err
    code, _, err = said(capsys, "-e", "cart-pole", "-i", f"F=@{table} cubic")
    assert code == 2 and "may be followed by 'hold' or 'linear'" in err


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("written", "words"),
    [
        (b"\xef\xbb\xbf0,1\n2,1\n", ""),  # as spreadsheets write it
        (b"time,force\n0,1\n2,1\n", ""),
        (b'# of a run\n"0","1"\n2,1\n\n', ""),
        (b"0,1,5\n0,1\n2,1\n", "'0,1,5' is not a time and a value"),
        (b"0;1\n0;1\n", "'0;1' is not a time and a value"),
        (b"0,1\n2," + b"1" * 200_000 + b"x\n", "is not a time and a value"),
        (b"\0" * 1000, "the table contains no numbers"),
        (b"\xff\xfe0", "it is not text"),
    ],
)
def test_tables_are_read_as_they_are_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], written: bytes, words: str
) -> None:
    table = tmp_path / "force.csv"
    table.write_bytes(written)
    code, out, err = said(capsys, "-e", "cart-pole", "-d", "1", "-i", f"F=@{table}")
    assert (code, "Traceback" in err) == (2 if words else 0, False)
    assert words in err and ("F" in out) == (not words)


def test_a_table_without_end_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(import_module("lagrangian.cli.table_files"), "MAX_BYTES", 1000)
    table = tmp_path / "force.csv"
    table.write_bytes(b"0" * 1001)
    code, _, err = said(capsys, "-e", "cart-pole", "-d", "1", "-i", f"F=@{table}")
    assert code == 2 and "more than 1000 bytes" in err
