"""What the papers say runs as it stands there."""

import pathlib
import re
import shlex
import subprocess
import sys
from typing import Any

import pytest
import typer

import lagrangian as lg
from lagrangian.cli.app import app

ROOT = pathlib.Path(__file__).parent.parent


def blocks(path: str, language: str) -> list[str]:
    parts = re.split(r"^```(.*)$", (ROOT / path).read_text(encoding="utf-8"), flags=re.M)
    return [body.lstrip("\n") for opened, body in zip(parts[1::4], parts[2::4], strict=True) if opened == language]


def test_the_readmes_python_runs(tmp_path: pathlib.Path) -> None:
    code = "\n".join(blocks("README.md", "python"))
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, check=False)
    output = done.stdout.decode("utf-8")
    assert done.returncode == 0, done.stderr.decode("utf-8")
    assert "inside the box" in output
    assert (tmp_path / "arm.html").read_text(encoding="utf-8").startswith("<!DOCTYPE html>")


@pytest.mark.parametrize(
    "path", [p.relative_to(ROOT).as_posix() for p in (*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"))]
)
def test_links_between_the_papers_lead_somewhere(path: str) -> None:
    here = ROOT / path
    for target in re.findall(r"\]\(([^)#]+)\)", here.read_text(encoding="utf-8")):
        assert "://" in target or (here.parent / target).exists(), f"{path}: {target}"


def test_the_reference_has_every_public_name_once() -> None:
    text = (ROOT / "docs" / "reference.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\.\. auto(?:class|function):: lagrangian\.(\w+)$", text, flags=re.M)
    assert sorted(listed) == sorted(lg.__all__)


COMMANDS = [
    (path, line)
    for path in ("README.md", *(f"docs/{p.name}" for p in sorted((ROOT / "docs").glob("*.md"))))
    for block in blocks(path, "")
    for line in block.replace("\\\n", " ").splitlines()
    if line.startswith("lagrangian ")
]


@pytest.mark.parametrize(("path", "line"), COMMANDS)
def test_every_command_of_the_papers_can_be_given(
    path: str, line: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its verb and its options are there; whether it does what it should is for the tests that take long."""
    argv = shlex.split(re.split(" [#<>] ", line)[0])[1:]
    monkeypatch.chdir(tmp_path)
    for name in argv:
        if name.endswith((".toml", ".txt")):
            pathlib.Path(name).touch()
    group: Any = typer.main.get_command(app)
    with group.make_context("lagrangian", [], resilient_parsing=True) as above:
        verb = group.get_command(above, argv[0])
        assert verb is not None, argv[0]
        verb.make_context(argv[0], argv[1:], parent=above)


@pytest.mark.slow
def test_every_command_of_the_readme_runs(tmp_path: pathlib.Path) -> None:
    listed = [b for b in blocks("README.md", "") if b.startswith("lagrangian ")]
    assert len(listed) == 3
    (tmp_path / "answer.txt").write_text(blocks("README.md", "text")[0], encoding="utf-8")
    for line in "".join(listed).strip().splitlines():
        command = line.split("#")[0].strip()
        argv, _, target = command.partition(" > ")
        done = subprocess.run(
            [sys.executable, "-m", "lagrangian", *shlex.split(argv)[1:]],
            cwd=tmp_path,
            capture_output=True,
            check=False,
        )
        assert done.returncode == 0, (command, done.stderr.decode("utf-8"))
        if target:
            (tmp_path / target).write_bytes(done.stdout)
    assert {p.name for p in tmp_path.iterdir()} == {
        *("carts.toml", "carts.html", "carts.tex", "out"),
        *("answer.txt", "run.csv", "run.png", "sweep.nc"),
    }
