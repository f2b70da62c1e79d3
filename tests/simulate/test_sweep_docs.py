"""What the manual says of sweeps runs as it stands there."""

import pathlib
import re
import shlex
import subprocess
import sys

import pytest

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "sweeps.md"


def blocks(language: str) -> list[str]:
    parts = re.split(r"^```(.*)$", PAGE.read_text(encoding="utf-8"), flags=re.M)
    return [body.lstrip("\n") for opened, body in zip(parts[1::4], parts[2::4], strict=True) if opened == language]


@pytest.mark.slow
def test_the_python_runs_and_says_what_stands_there(
    capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    shown = []
    for block in blocks("python"):
        exec(compile(block, str(PAGE), "exec"), names)
        shown += re.findall(r"^\s*(print\(failure\))\s+# (.*)$", block, flags=re.M)
        for expression, said in re.findall(r"^((?:runs|largest)[.\[].*?)\s{2,}# ([({'].*)$", block, flags=re.M):
            assert repr(eval(expression, names)).strip("()") == said.strip("()"), expression
    printed = capsys.readouterr().out
    assert shown
    assert all(said in printed for _, said in shown)


@pytest.mark.slow
def test_the_commands_run(tmp_path: pathlib.Path) -> None:
    for line in blocks("")[0].replace("\\\n", " ").strip().splitlines():
        command, _, target = line.partition(" > ")
        argv = [sys.executable, "-m", *shlex.split(command)]
        done = subprocess.run(argv, cwd=tmp_path, capture_output=True, check=False)
        assert done.returncode == 0, (line, done.stderr.decode())
        if target:
            (tmp_path / target).write_bytes(done.stdout)
    assert {p.name for p in tmp_path.iterdir()} == {"cart.toml", "sweep.zarr", "sweep.csv"}
