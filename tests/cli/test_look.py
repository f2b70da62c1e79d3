"""``lagrangian look``: files by their ending, the page in the browser, one message a mistake."""

from __future__ import annotations

import json
import pathlib
import stat
import sys

import pytest

import lagrangian as lg
from lagrangian import examples
from lagrangian.cli import main
from lagrangian.cli.look import KINDS
from lagrangian.model.hints import BODY_KINDS


def call(capsys: pytest.CaptureFixture[str], *argv: str) -> tuple[int, str, str]:
    code = main(list(argv))
    captured = capsys.readouterr()
    return code, captured.out, captured.err


@pytest.mark.parametrize(("ending", "mark"), [("svg", "<svg"), ("tex", r"\begin{tikzpicture}"), ("html", "<canvas")])
def test_the_ending_chooses_the_format(
    capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path, ending: str, mark: str
) -> None:
    path = tmp_path / f"pendulum.{ending}"
    code, out, err = call(capsys, "look", "--example", "pendulum", "-o", str(path))
    assert (code, out) == (0, "")
    assert f"wrote {path}" in err
    assert mark in path.read_text(encoding="utf-8")


def test_another_ending_is_refused_with_those_that_are_known(
    capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path
) -> None:
    code, _, err = call(capsys, "look", "-e", "pendulum", "-o", str(tmp_path / "pendulum.pdf"))
    assert code == 2
    assert ".svg" in err and ".html" in err


def test_an_existing_file_stays_unless_forced(capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path) -> None:
    path = tmp_path / "pendulum.svg"
    path.write_text("mine", encoding="utf-8")
    assert call(capsys, "look", "-e", "pendulum", "-o", str(path))[0] == 2
    assert path.read_text(encoding="utf-8") == "mine"
    assert call(capsys, "look", "-e", "pendulum", "-o", str(path), "--force")[0] == 0
    assert "<svg" in path.read_text(encoding="utf-8")


def test_without_a_file_the_page_opens_from_a_private_folder(
    capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: list[str] = []
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr("webbrowser.open", lambda address: shown.append(address) or True)
    code, out, _ = call(capsys, "look", "-e", "pendulum")
    path = pathlib.Path(out.strip())
    assert code == 0
    assert shown == [path.as_uri()]
    assert "<canvas" in path.read_text(encoding="utf-8")
    if sys.platform != "win32":
        assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700
    call(capsys, "look", "-e", "pendulum", "--no-browser")
    assert len(shown) == 1


def test_json_says_what_was_written_and_what_is_missing(
    capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path
) -> None:
    path = tmp_path / "pendulum.svg"
    code, out, _ = call(capsys, "look", "-e", "pendulum", "-o", str(path), "--json")
    found = json.loads(out)
    assert code == 0
    assert found["file"] == str(path)
    assert found["missing"] == []
    assert found["description"]


def test_the_help_lists_every_kind_of_body() -> None:
    assert tuple(KINDS.split(", ")) == BODY_KINDS


@pytest.mark.parametrize(
    ("option", "name"), [("--hide", "nothing"), ("--trail", "nowhere"), ("--kind", "bob=carrot"), ("--pose", "alpha=1")]
)
def test_a_name_that_does_not_exist_is_an_error(
    capsys: pytest.CaptureFixture[str], tmp_path: pathlib.Path, option: str, name: str
) -> None:
    code, _, err = call(capsys, "look", "-e", "pendulum", "-o", str(tmp_path / "a.svg"), option, name)
    assert code == 2
    assert err.startswith("error:") and name.partition("=")[0] in err


def test_hints_of_the_file_hold_unless_an_option_replaces_them(tmp_path: pathlib.Path) -> None:
    """The weight is hidden by the file; an option that hides the coordinate instead shows it again."""
    file, out = tmp_path / "pendulum.toml", tmp_path / "a.svg"
    gravity = next(e.name for e in lg.example("pendulum").model.elements if e.kind == "gravity")
    file.write_text(f'{examples.text("pendulum")}\n[look]\nhide = ["{gravity}"]\n', encoding="utf-8")
    shown: list[bool] = []
    for options in ([], ["--hide", "theta"]):
        assert main(["look", str(file), "-o", str(out), "--force", *options]) == 0
        shown.append("kind-gravity" in out.read_text(encoding="utf-8"))
    assert shown == [False, True]
