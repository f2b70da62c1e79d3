"""The command: what goes where, exit codes, one message a mistake."""

import io
import json
import pathlib
import subprocess
import sys

import pytest

from lagrangian.cli import main

CART = """
name = "cart"
[coordinates]
x = "from the wall"
[parameters]
m = "1 kg"
k = "40 N/m"
[points]
A = ["x", "0"]
[[particle]]
mass = "m"
at = "A"
[[spring]]
k = "k"
deflection = "x"
"""


def call(capsys: pytest.CaptureFixture[str], *argv: str) -> tuple[int, str, str]:
    code = main(list(argv))
    captured = capsys.readouterr()
    return code, captured.out, captured.err


@pytest.fixture
def cart(tmp_path: pathlib.Path) -> str:
    path = tmp_path / "cart.toml"
    path.write_text(CART, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("format", "mark"),
    [("text", "Ξ"), ("markdown", "$"), ("latex", r"\documentclass"), ("html", "<!DOCTYPE html>"), ("json", "{")],
)
def test_derive_writes_every_format(capsys: pytest.CaptureFixture[str], cart: str, format: str, mark: str) -> None:
    code, out, err = call(capsys, "derive", cart, "--format", format)
    assert (code, err) == (0, "")
    assert mark in out


def test_json_is_json(capsys: pytest.CaptureFixture[str], cart: str) -> None:
    _, out, _ = call(capsys, "derive", cart, "-f", "json")
    assert json.loads(out)


def test_output_goes_to_a_file_whole(capsys: pytest.CaptureFixture[str], cart: str, tmp_path: pathlib.Path) -> None:
    target = tmp_path / "cart.html"
    assert call(capsys, "derive", cart, "-f", "html", "-o", str(target)) == (0, "", "")
    assert target.read_text(encoding="utf-8").rstrip().endswith("</html>")


def test_every_example_is_listed_and_printed(capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = call(capsys, "examples")
    names = [line.split()[0] for line in out.splitlines()]
    assert {"lecture-1", "lecture-2", "lecture-3a", "lecture-3b"} <= set(names)
    code, text, _ = call(capsys, "new", "lecture-1")
    assert code == 0 and "[coordinates]" in text


def test_the_schema_is_a_json_schema(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = call(capsys, "schema")
    assert code == 0 and json.loads(out)["$schema"].startswith("https://json-schema.org/")


def test_derive_says_so_where_a_check_does_not_hold(capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path) -> None:
    path = tmp_path / "negative.toml"
    path.write_text(
        'name = "n"\n[coordinates]\nx = ""\n[parameters]\nm = 1\n[energies]\nT = "-m*x\'^2/2"\n', encoding="utf-8"
    )
    code, out, error = call(capsys, "derive", str(path), "--brief")
    assert code == 1
    assert "✗ M is positive definite" in out
    assert "does not hold" in error


@pytest.mark.slow
def test_verify_says_ok_line_by_line(capsys: pytest.CaptureFixture[str], cart: str) -> None:
    code, out, _ = call(capsys, "verify", cart, "--states", "5")
    assert code == 0 and "✗" not in out
    assert out.count("✓") + out.count("– ") == 30 and "at 5 random states" in out


MISTAKES = {
    "no such file": (["derive", "nowhere.toml"], ["nowhere.toml"]),
    "an example without its option": (["derive", "pendulum"], ["no such file", "--example pendulum"]),
    "a folder": (["derive", "."], ["."]),
    "a sheet's file for its folder": (
        ["worksheet", "-e", "pendulum", "-o", "a.html"],
        ["folder of the sheets", "a.html"],
    ),
    "neither file nor example": (["derive"], ["--example"]),
    "no such example": (["new", "lecture1"], ["lecture1", "Did you mean 'lecture-1'"]),
    "no such format": (["derive", "x.toml", "--format", "pdf"], ["pdf"]),
    "no such command": (["derve"], ["derve"]),
    "no such option": (["derive", "x.toml", "--breif"], ["--breif"]),
    "a width of nothing": (["derive", "-e", "lecture-1", "--width", "3"], ["--width", "40"]),
    "a folder that does not exist": (["new", "lecture-1", "-o", "no/such/folder/x.toml"], ["no/such/folder"]),
}


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_is_one_message_and_exit_2(
    capsys: pytest.CaptureFixture[str], case: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    argv, fragments = MISTAKES[case]
    code, out, err = call(capsys, *argv)
    assert (code, out) == (2, "")
    assert "Traceback" not in err
    assert all(f in err for f in fragments), err


def test_a_file_that_the_system_refuses_is_named(capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path) -> None:
    """Not standard output, which nothing was written to."""
    long = str(tmp_path / f"{'x' * 300}.txt")
    code, _, err = call(capsys, "derive", "--example", "pendulum", "-o", long)
    assert code == 2
    assert long in err and "too long" in err and "standard output" not in err


def test_a_mistake_in_the_file_shows_line_and_caret(capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path) -> None:
    path = tmp_path / "cart.toml"
    path.write_text(CART.replace('mass = "m"', 'mass = "mm"'), encoding="utf-8")
    code, out, err = call(capsys, "derive", str(path))
    assert (code, out) == (2, "")
    assert "cart.toml:11" in err and "'mm'" in err and "^" in err and "Did you mean 'm'" in err


def test_standard_input_is_read(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    class Stdin:
        buffer = io.BytesIO(CART.encode())

    monkeypatch.setattr(sys, "stdin", Stdin())
    code, out, _ = call(capsys, "derive", "-", "--brief")
    assert code == 0 and "cart" in out


@pytest.mark.slow
def test_a_reader_that_goes_away_is_no_traceback() -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "lagrangian", "schema"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None and process.stderr is not None
        process.stdout.close()
        assert process.stderr.read() == b""


@pytest.mark.slow
def test_output_is_utf8_wherever_it_goes() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "lagrangian", "schema"],
        capture_output=True,
        env={"PYTHONIOENCODING": "ascii", "PATH": "", "SYSTEMROOT": ""},
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "½ b δ̇²" in done.stdout.decode("utf-8")
