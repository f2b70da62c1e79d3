"""``lagrangian check``: exit codes, hint levels, data, folders."""

import csv
import json
from importlib import import_module
from pathlib import Path

import pytest

from lagrangian.cli import main
from lagrangian.errors import ModelError

RIGHT = "(m1 + m2)*x1'' + m2*x2r'' = 0\nm2*(x1'' + x2r'') + k*x2r = F\n"
SPRING = "(m1 + m2)*x1'' + m2*x2r'' = 0\nm2*(x1'' + x2r'') - k*x2r = F\n"
LATEX = r"""\begin{align}
m_1 \ddot x_1 - k x_{2r} &= -F \\
m_2 (\ddot x_1 + \ddot x_{2r}) + k x_{2r} &= F
\end{align}"""


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main(["check", *arguments])
    out = capsys.readouterr()
    return code, out.out, out.err


def test_exit_codes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = tmp_path / "answer.txt"
    for text, wanted in ((RIGHT, 0), (LATEX, 0), (SPRING, 1), (RIGHT.splitlines()[0], 1), ("m1*x1'' = = F", 2)):
        answer.write_text(text)
        assert run(capsys, "-e", "lecture-3b", str(answer))[0] == wanted, text


def test_a_text_that_cannot_be_read_is_told_with_its_place(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = tmp_path / "answer.txt"
    answer.write_text("m1*x1'' = 0\nm2*x2r'' = = F\n")
    code, out, err = run(capsys, "-e", "lecture-3b", str(answer))
    assert code == 2 and not out
    assert "answer.txt:2:" in err and "^" in err


@pytest.mark.slow
def test_hints_give_away_more_and_more(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = tmp_path / "answer.txt"
    answer.write_text(SPRING)
    said = [run(capsys, "-e", "lecture-3b", str(answer), "--hint", str(level))[1] for level in range(4)]
    assert all("Not right yet" in text for text in said)
    assert "line 2" not in said[0] and "line 2" in said[1]
    assert "spring k" not in said[1] and "spring k" in said[2]
    assert "k x_2r" not in said[2] and "−k x_2r has the wrong sign" in said[3]


@pytest.mark.slow
def test_data(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = tmp_path / "answer.txt"
    answer.write_text(SPRING)
    data = json.loads(run(capsys, "-e", "lecture-3b", str(answer), "--json")[1])
    assert data["right"] is False and data["verdict"] == "wrong"
    assert [line["right"] for line in data["lines"]] == [True, False]
    assert data["mistakes"][0]["name"] == "spring_sign"
    (difference,) = data["lines"][1]["differences"]
    assert difference["origins"] == [{"element": "spring 'k'", "step": 3}]
    low = json.loads(run(capsys, "-e", "lecture-3b", str(answer), "--json", "--hint", "0")[1])
    assert low == {"right": False, "verdict": "wrong", "hint": 0}


@pytest.mark.slow
def test_a_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answers = tmp_path / "answers"
    answers.mkdir()
    for name, text in (("ann.txt", RIGHT), ("bob.tex", LATEX), ("cid.txt", SPRING), ("dan.txt", SPRING)):
        (answers / name).write_text(text)
    (answers / "eve.txt").write_text("m1*x1'' = = F")
    (answers / "fay.txt").write_bytes(b"\xff\xfe\x00")
    table = tmp_path / "summary.csv"
    code, out, _ = run(capsys, "-e", "lecture-3b", str(answers), "-o", str(table))
    assert code == 1
    assert "2 of 6 right" in out and "eve.txt  cannot be read" in out
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [(r["name"], r["answers"]) for r in rows if r["kind"] == "mistake"] == [
        ("spring_sign", "2"),
        ("unreadable", "2"),
    ]
    assert rows[0]["files"] == "cid.txt; dan.txt"
    assert rows[2]["sentence"] == "2 of 6 went wrong in step 3, potential energy."
    data = json.loads(run(capsys, "-e", "lecture-3b", str(answers), "--json")[1])
    assert data["counts"] == {"spring_sign": 2, "unreadable": 2}
    (answers / "cid.txt").unlink()
    assert run(capsys, "-e", "lecture-3b", str(tmp_path / "nowhere"))[0] == 2


@pytest.mark.slow
def test_a_line_for_each_answer(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answers, table = tmp_path / "answers", tmp_path / "table.csv"
    answers.mkdir()
    for name, text in (("ann.txt", RIGHT), ("cid.txt", SPRING), ("dan.txt", RIGHT.splitlines()[0]), ("eve.txt", "= =")):
        (answers / name).write_text(text)

    def cells(hint: str) -> list[list[str]]:
        arguments = ("-e", "lecture-3b", str(answers), "--answers", str(table), "--hint", hint)
        assert run(capsys, *arguments, "--force")[0] == 1
        rows = list(csv.reader(table.read_text().splitlines()))
        assert rows[0] == [
            "file",
            "verdict",
            "right lines",
            "lines",
            "first wrong line",
            "mistakes",
            "lacks",
            "points",
            "trouble",
        ]
        assert rows[4][:2] == ["eve.txt", "cannot be read"] and rows[4][8]
        return [row[1:6] for row in rows[1:4]]

    full = [["right", "2", "2", "", ""], ["wrong", "1", "2", "2", "spring_sign"]]
    assert cells("3") == [*full, ["incomplete", "1", "1", "", "incomplete"]]
    assert cells("1")[1] == ["wrong", "1", "2", "2", "wrong"]
    assert cells("0")[1] == ["wrong", "", "", "", "wrong"]
    single = answers / "ann.txt"
    assert run(capsys, "-e", "lecture-3b", str(single), "--answers", str(table))[0] == 2


@pytest.mark.slow
def test_a_folder_gives_no_more_away_than_the_hint(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "cid.txt").write_text(SPRING)
    for hint, given in (("0", False), ("1", False), ("2", True), ("3", True)):
        arguments = ("-e", "lecture-3b", str(tmp_path), "--hint", hint)
        for more in ((), ("--json",)):
            said = run(capsys, *arguments, *more)[1].replace("spring sign", "spring_sign")
            assert ("spring_sign" in said) is (hint == "3")
            assert hint != "2" or "There is a wrong sign in the potential energy of spring 'k'" in said
            assert ("spring 'k'" in said) is given


def test_what_can_be_read_is_never_called_unreadable(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object, **__: object) -> None:
        raise ModelError("too much for this check")

    (tmp_path / "ann.txt").write_text(RIGHT)
    monkeypatch.setattr(import_module("lagrangian.check.classes.judge"), "check_answer", refused)
    code, out, _ = run(capsys, "-e", "lecture-3b", str(tmp_path))
    assert code == 1 and "ann.txt  cannot be judged" in out and "too much for this check" in out
    assert "cannot be read" not in out and "1 of 1 could not be judged" in out


def test_usage(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "-e", "lecture-3b")[0] == 2
    assert run(capsys, "model.toml")[0] == 2
    assert run(capsys, "-", "-")[0] == 2
    empty = tmp_path / "empty"
    empty.mkdir()
    assert run(capsys, "-e", "lecture-3b", str(empty))[0] == 2
