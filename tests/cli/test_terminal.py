"""What reaches the terminal: clean text, one prefix for errors, the right width, bold titles, data for programs."""

from __future__ import annotations

import ast
import io
import json
import re
import sys
from pathlib import Path
from typing import Any

import pytest
import typer

import lagrangian
from lagrangian.cli import door, main
from lagrangian.cli.app import app
from lagrangian.cli.verbs import VERBS

HOSTILE = """
name = "cart\\u001b[31m\\u009b2J\\u202e\\u2028 \\u0007end"
[coordinates]
x = "from \\u001b]0;mine\\u0007 the wall\\u2066"
[parameters]
m = "1 kg"
k = "40 N/m"
[points]
A = ["x", "0"]
[[particle]]
name = "body"
mass = "m"
at = "A"
[[spring]]
name = "spring"
k = "k"
deflection = "x"
[simulate]
duration = "1 s"
initial = { x = "0.1 m" }
"""
"""A model whose every free text would steer a terminal."""

VERB_LINES = {
    "derive": ["derive", "FILE"],
    "derive, a checklist": ["derive", "FILE", "--brief"],
    "derive, a page": ["derive", "FILE", "-f", "html"],
    "verify": ["verify", "FILE", "--states", "3"],
    "check": ["check", "FILE", "ANSWER"],
    "compare": ["compare", "FILE", "FILE"],
    "linearize": ["linearize", "FILE"],
    "equilibria": ["equilibria", "FILE"],
    "conserved": ["conserved", "FILE"],
    "simulate": ["simulate", "FILE", "--samples", "5"],
    "simulate, a table": ["simulate", "FILE", "--samples", "5", "-o", "-"],
    "sweep": ["sweep", "FILE", "k=10,20", "--times", "3"],
    "export": ["export", "FILE", "--to", "python", "-o", "OUT"],
    "a mistake": ["derive", "BROKEN"],
    "no such file": ["derive", "no\x1b[31m\udcff.toml"],
    "no such option": ["derive", "--br\x1b[31meif"],
    "no such example": ["new", "pendul\x1b[31mum"],
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("hostile")
    (made / "model.toml").write_text(HOSTILE, encoding="utf-8")
    (made / "broken.toml").write_text(HOSTILE.replace('mass = "m"', 'mass = "mm"'), encoding="utf-8")
    (made / "answer.txt").write_text("m*x'' + k*x = 0", encoding="utf-8")
    return made


def typed(folder: Path, line: list[str]) -> list[str]:
    names = {"FILE": "model.toml", "ANSWER": "answer.txt", "BROKEN": "broken.toml", "OUT": "out"}
    return [str(folder / names[word]) if word in names else word for word in line]


def steering(text: str) -> set[str]:
    """The characters of a text that a terminal obeys rather than shows, by their Unicode kind."""
    turning = "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\u2028\u2029\ufeff"
    return {c for c in text if (ord(c) < 32 and c not in "\n\t") or 127 <= ord(c) < 160 or c in turning}


@pytest.mark.sampled(6)
@pytest.mark.parametrize("verb", VERB_LINES)
def test_no_text_of_a_model_steers_the_terminal(capsys: pytest.CaptureFixture[str], folder: Path, verb: str) -> None:
    main([*typed(folder, VERB_LINES[verb]), *(["--force"] if verb == "export" else [])])
    said = capsys.readouterr()
    assert said.out + said.err
    assert steering(said.out + said.err) == set()


def test_what_is_hidden_is_shown_and_data_stays_the_same(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    assert main(typed(folder, ["simulate", "FILE", "--json"])) == 0
    name = json.loads(capsys.readouterr().out)["name"]
    assert name == "cart\x1b[31m\x9b2J\u202e\u2028 \x07end"
    assert main(typed(folder, ["simulate", "FILE"])) == 0
    assert r"cart\u001b[31m\u009b2J\u202e\u2028 \u0007end" in capsys.readouterr().out


def test_the_door_is_the_only_way_out() -> None:
    rooms = Path(lagrangian.__file__).parent
    for path in (rooms / "cli").glob("*.py"):
        if path.name in ("door.py", "progress.py"):
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            assert not (isinstance(node, ast.Call) and ast.unparse(node.func) in ("print", "typer.echo")), path
            if isinstance(node, ast.Attribute) and ast.unparse(node.value) in ("sys.stdout", "sys.stderr"):
                assert node.attr == "flush", f"{path.name}: {ast.unparse(node)}"


# -- errors ----------------------------------------------------------------------------------------------------------

MISTAKES = {
    "an option": (["derive", "--breif"], "no such option: --breif"),
    "an option like no other": (["sweep", "-e", "pendulum", "--keep", "y"], "`lagrangian sweep --help` shows"),
    "a verb": (["derve"], "Did you mean 'derive'"),
    "a value": (["derive", "x.toml", "--width", "3"], "'--width': it should be greater than or equal to 40"),
    "nothing to work on": (["derive"], "--example NAME"),
    "two things to work on": (["derive", "x.toml", "-e", "pendulum"], "both a file and --example were given"),
    "a file": (["derive", "nowhere.toml"], "nowhere.toml"),
    "a folder": (["derive", "."], "this is a folder"),
    "an empty file": (["derive", "empty.toml"], "the file is empty"),
    "a binary file": (["derive", "binary.toml"], "the file is binary"),
    "a line of a file": (["derive", "broken.toml"], "broken.toml:12:9: [E402]"),
    "an option without a value": (["linearize", "-e", "pendulum", "--at", "theta"], "takes name=value"),
    "an ending": (["derive", "-e", "pendulum", "-o", "x.pdf"], ".txt, .md, .tex, .html"),
    "two formats": (["derive", "-e", "pendulum", "-f", "latex", "-o", "x.html"], "ends like html"),
    "data and markup": (["derive", "-e", "pendulum", "-f", "latex", "--json"], "contradict each other"),
    "another language": (
        ["export", "-e", "pendulum", "--to", "rust"],
        "'--to': 'rust' is not one of 'c', 'python', 'javascript', 'wasm'",
    ),
    "no table": (["simulate", "-e", "cart-pole", "--input", "F=@none.csv"], "cannot read the table"),
    "no language": (["export", "-e", "pendulum"], "--to"),
    "a file for a folder": (["export", "-e", "pendulum", "--to", "c", "-o", "empty.toml"], "is a file, not a folder"),
    "one system to compare": (["compare", "-e", "pendulum"], "exactly two systems can be compared (got 1)"),
    "an answer": (["check", "-e", "pendulum", "nowhere.txt"], "nowhere.txt"),
    "no answer": (["check", "x.toml"], "no answer was given to check"),
    "a part of an example's name": (["new", "furuta"], "Did you mean 'furuta-pendulum'?"),
    "a part of several": (["simulate", "-e", "triple"], "'triple-pendulum' or 'triple-pendulum-relative'?"),
    "an example as a file": (["new", "Cart_Pole.toml"], "Did you mean 'cart-pole'?"),
    "no example at all": (["new", "xyz"], "`lagrangian examples` lists them"),
    "an example that is not there": (["new", "lecture-99"], "`lagrangian examples` lists them all"),
    "a language's other name": (["export", "-e", "pendulum", "--to", "cc"], "Did you mean 'c'?"),
    "a value for words": (["derive", "moving.toml", "--brief"], "coordinate 'x' has the value '10 m'"),
    "the argument of another program": (["derive", "located.toml", "--brief"], "Did you mean 'at'? (known"),
    "a force in N m": (["simulate", "-e", "cart-pole", "--input", "F=3 N*m"], "has the unit N m, but N is needed"),
    "no equilibrium": (["linearize", "-e", "pendulum", "--at", "theta=0.3"], " rad/s^2 there"),
    "another ending of a model": (["new", "pendulum", "-o", "x.json"], "-o x.toml"),
    "another ending of its data": (["new", "pendulum", "--json", "-o", "x.toml"], "-o x.json"),
    "another ending of a schema": (["schema", "-o", "x.toml"], "-o x.json"),
    "no ending": (["schema", "-o", "x"], "-o x.json"),
    "a range for a parameter": (["simulate", "-e", "pendulum", "--set", "L=5:10"], "argument of `lagrangian sweep`"),
    "a range without a count": (["sweep", "-e", "pendulum", "L=5:10"], "write 5:10:11 for 11 values"),
    "an option's expression": (["simulate", "-e", "cart-pole", "--input", "F=2*thet"], "input 'F', column 3: unknown"),
    "a sweep of nothing": (["sweep", "k=1:2:3"], "is not a model file"),
}


@pytest.mark.parametrize("case", MISTAKES)
def test_every_mistake_begins_with_the_same_word_and_says_what_would_be_right(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, folder: Path, tmp_path: Path, case: str
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty.toml").write_text("", encoding="utf-8")
    (tmp_path / "binary.toml").write_bytes(bytes(range(256)))
    (tmp_path / "moving.toml").write_text('name = "a"\n[coordinates]\nx = "10 m"\n', encoding="utf-8")
    located = '[coordinates]\nx = ""\n[[particle]]\nmass = 1\nposition = ["x", 0]\n'
    (tmp_path / "located.toml").write_text(f'name = "a"\n{located}', encoding="utf-8")
    (tmp_path / "broken.toml").write_text((folder / "broken.toml").read_text(encoding="utf-8"), encoding="utf-8")
    argv, words = MISTAKES[case]
    assert main(argv) == 2
    said = capsys.readouterr()
    assert said.out == "" and "Traceback" not in said.err
    assert said.err.startswith("error: ") and words in said.err, said.err
    assert "Fix: " in said.err, said.err


# -- what is written, and where --------------------------------------------------------------------------------------


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("ending", "mark"),
    [("txt", "T*"), ("md", "$"), ("tex", r"\documentclass"), ("html", "<!DOCTYPE html>"), ("json", '"schema": 1')],
)
def test_the_ending_of_a_file_says_its_format(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, ending: str, mark: str
) -> None:
    path = tmp_path / f"page.{ending}"
    assert main(["derive", "-e", "pendulum", "-o", str(path)]) == 0
    assert mark in path.read_text(encoding="utf-8")
    assert capsys.readouterr().out == ""


WRITING: dict[str, tuple[list[str], str]] = {
    "derive": (["derive", "FILE"], "a.md"),
    "verify": (["verify", "FILE", "--states", "3"], "a.json"),
    "check": (["check", "FILE", "ANSWER"], "a.txt"),
    "compare": (["compare", "FILE", "FILE"], "a.html"),
    "linearize": (["linearize", "FILE"], "a.json"),
    "equilibria": (["equilibria", "FILE"], "a.tex"),
    "conserved": (["conserved", "FILE"], "a.txt"),
    "simulate": (["simulate", "FILE"], "a.csv"),
    "sweep": (["sweep", "FILE", "k=10,20"], "a.csv"),
    "new": (["new", "pendulum"], "a.toml"),
    "schema": (["schema"], "a.json"),
}


@pytest.mark.sampled(11)
@pytest.mark.parametrize("verb", WRITING)
def test_nothing_is_overwritten_unless_forced(
    capsys: pytest.CaptureFixture[str], folder: Path, tmp_path: Path, verb: str
) -> None:
    line, name = WRITING[verb]
    path = tmp_path / name
    path.write_text("precious", encoding="utf-8")
    assert main([*typed(folder, line), "-o", str(path)]) == 2
    said = capsys.readouterr().err
    assert f"'{path}' exists already" in said and "--force" in said and "overwrite=" not in said
    assert path.read_text(encoding="utf-8") == "precious"
    assert main([*typed(folder, line), "-o", str(path), "--force"]) == 0
    assert "precious" not in path.read_text(encoding="utf-8")


def test_an_export_overwrites_no_file_of_a_folder(
    capsys: pytest.CaptureFixture[str], folder: Path, tmp_path: Path
) -> None:
    line = typed(folder, ["export", "FILE", "--to", "python", "--json", "-o"]) + [str(tmp_path)]
    assert main(line) == 0
    files = json.loads(capsys.readouterr().out)["files"]
    Path(files[0]).write_text("precious", encoding="utf-8")
    assert main(line) == 2
    assert "--force" in capsys.readouterr().err and Path(files[0]).read_text(encoding="utf-8") == "precious"
    assert main([*line, "--force"]) == 0


JSON_KEYS: dict[str, tuple[list[str], set[str]]] = {
    "derive": (["derive", "FILE"], {"schema", "steps", "equations", "verified"}),
    "verify": (["verify", "FILE", "--states", "3"], {"checks"}),
    "check": (["check", "FILE", "ANSWER"], {"right", "verdict"}),
    "compare": (["compare", "FILE", "FILE"], {"same"}),
    "linearize": (["linearize", "FILE"], {"A", "B"}),
    "equilibria": (["equilibria", "FILE"], {"equilibria"}),
    "conserved": (["conserved", "FILE"], {"conserved"}),
    "simulate": (["simulate", "FILE"], {"name", "success", "message", "columns", "balance"}),
    "sweep": (["sweep", "FILE", "k=10,20"], {"name", "runs", "axes", "results", "failed"}),
    "new": (["new", "pendulum"], {"name", "description", "text"}),
    "schema": (["schema"], {"$schema"}),
    "version": (["version"], {"version", "python"}),
}


@pytest.mark.sampled(3)
@pytest.mark.parametrize("verb", JSON_KEYS)
def test_every_verb_gives_data(capsys: pytest.CaptureFixture[str], folder: Path, verb: str) -> None:
    line, keys = JSON_KEYS[verb]
    assert main([*typed(folder, line), "--json"]) == 0
    said = capsys.readouterr()
    assert keys <= set(json.loads(said.out)), said.out[:500]


def test_the_list_of_examples_is_data_too(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["examples", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out)
    assert {"name": "lecture-2"}.items() <= next(e for e in listed if e["name"] == "lecture-2").items()


# -- help ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("verb", VERBS)
def test_every_help_has_an_example_that_is_read(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, verb: str
) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    assert main([verb, "-h"]) == 0
    short = capsys.readouterr().out
    assert main([verb, "--help"]) == 0
    assert capsys.readouterr().out == short
    _, _, after = short.partition("Examples:\n")
    lines = [line.strip() for line in after.splitlines() if line.strip().startswith("lagrangian ")]
    assert lines, short
    assert all(line.split()[1] == verb for line in lines)
    assert "--json" in short
    assert all(len(line) <= 80 for line in lines)
    assert max(map(len, short.splitlines())) <= 100


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_lists_every_option_once_in_groups(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, verb: str
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert main([verb, "--help"]) == 0
    shown = capsys.readouterr().out
    groups = re.findall(r"^([A-Z]\w+):$", shown, flags=re.M)
    assert len(set(groups)) == len(groups) and {*groups} <= {
        *("Arguments", "Options", "Output", "Integration", "Computing"),
    }
    listed = re.findall(r"^  (?:-\w, )?(--[\w-]+)", shown, flags=re.M)
    options = {o.opts[0] if o.opts[0].startswith("--") else o.opts[-1] for o in options_of(verb)}
    assert sorted(listed) == sorted({*options, "--help"})
    if verb in ("simulate", "sweep"):
        assert groups == ["Arguments", "Options", "Output", "Integration", "Computing"]
    assert len(shown.splitlines()) <= 62


def options_of(verb: str) -> list[Any]:
    group = typer.main.get_command(app)
    parameters = group.commands[verb].get_params(typer.Context(group))  # type: ignore[attr-defined]
    return [p for p in parameters if p.param_type_name == "option"]


def test_the_version_is_an_option_too(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"lagrangian {lagrangian.__version__}\n"


def test_nothing_typed_is_the_help_and_exit_2(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 2
    said = capsys.readouterr().out
    assert all(verb in said for verb in VERBS) and "..." not in said.partition("Commands:")[2]


def test_a_shell_completes_verbs_options_and_examples(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def completed(line: str) -> list[str]:
        monkeypatch.setenv("_LAGRANGIAN_COMPLETE", "complete_bash")
        monkeypatch.setenv("COMP_WORDS", line)
        monkeypatch.setenv("COMP_CWORD", str(len(line.split(" ")) - 1))
        with pytest.raises(SystemExit):
            main([])
        return capsys.readouterr().out.split()

    assert {"linearize"} <= set(completed("lagrangian lin"))
    assert {"--notation"} <= set(completed("lagrangian derive --not"))
    assert {"lecture-3a", "lecture-3b"} <= set(completed("lagrangian derive --example lecture-3"))


# -- a terminal ------------------------------------------------------------------------------------------------------


class Screen(io.StringIO):
    """Standard output as a terminal."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


def a_screen(monkeypatch: pytest.MonkeyPatch) -> Screen:
    made = Screen()
    monkeypatch.setattr(sys, "stdout", made)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setattr(door.os, "name", "posix")
    return made


@pytest.mark.parametrize("columns", [60, 140])
def test_a_terminal_is_used_in_its_whole_width(monkeypatch: pytest.MonkeyPatch, folder: Path, columns: int) -> None:
    screen = a_screen(monkeypatch)
    monkeypatch.setenv("COLUMNS", str(columns))
    assert main(["derive", "-e", "lecture-3b"]) == 0
    widths = [len(line) for line in screen.getvalue().splitlines()]
    assert max(widths) <= columns + len("\x1b[1m\x1b[22m") + 20  # dots over letters take no column
    assert max(widths) > 0.8 * columns


def test_a_pipe_has_80_columns_and_no_bold(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    assert door.width() == 80 and door.width(132) == 132
    assert main(["derive", "-e", "lecture-1"]) == 0
    assert "\x1b" not in capsys.readouterr().out


def test_titles_are_bold_on_a_terminal_unless_the_environment_says_no(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    screen = a_screen(monkeypatch)
    line = typed(folder, ["simulate", "FILE", "--samples", "3"])
    assert main(line) == 0
    title = screen.getvalue().splitlines()[0]
    assert title.startswith("\x1b[1mcart") and title.endswith("\x1b[22m")
    assert steering(screen.getvalue()) == {"\x1b"} and screen.getvalue().count("\x1b") == 2
    monkeypatch.setenv("NO_COLOR", "1")
    screen.truncate(screen.seek(0))
    assert main(line) == 0
    assert "\x1b" not in screen.getvalue()
