"""``lagrangian check``: exit codes, hint levels, data, folders."""

import csv
import json
from pathlib import Path

import pytest

from lagrangian.cli import main

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


def test_hints_give_away_more_and_more(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = tmp_path / "answer.txt"
    answer.write_text(SPRING)
    said = [run(capsys, "-e", "lecture-3b", str(answer), "--hint", str(level))[1] for level in range(4)]
    assert all("Not right yet" in text for text in said)
    assert "line 2" not in said[0] and "line 2" in said[1]
    assert "spring 'k'" not in said[1] and "spring 'k'" in said[2]
    assert "k x₂ᵣ" not in said[2] and "−k x₂ᵣ has the wrong sign" in said[3]


def test_data(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = tmp_path / "answer.txt"
    answer.write_text(SPRING)
    data = json.loads(run(capsys, "-e", "lecture-3b", str(answer), "--json")[1])
    assert data["right"] is False and data["verdict"] == "wrong"
    assert [line["right"] for line in data["lines"]] == [True, False]
    assert data["mistakes"][0]["name"] == "plus_potential"
    (difference,) = data["lines"][1]["differences"]
    assert difference["origins"] == [{"element": "spring 'k'", "step": 3}]
    low = json.loads(run(capsys, "-e", "lecture-3b", str(answer), "--json", "--hint", "0")[1])
    assert low == {"right": False, "verdict": "wrong", "hint": 0}


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
    assert [(r["mistake"], r["answers"]) for r in rows] == [("plus_potential", "2"), ("unreadable", "2")]
    assert rows[0]["files"] == "cid.txt dan.txt"
    data = json.loads(run(capsys, "-e", "lecture-3b", str(answers), "--json")[1])
    assert data["counts"] == {"plus_potential": 2, "unreadable": 2}
    (answers / "cid.txt").unlink()
    assert run(capsys, "-e", "lecture-3b", str(tmp_path / "nowhere"))[0] == 2


def test_usage(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "-e", "lecture-3b")[0] == 2
    assert run(capsys, "model.toml")[0] == 2
    assert run(capsys, "-", "-")[0] == 2
    empty = tmp_path / "empty"
    empty.mkdir()
    assert run(capsys, "-e", "lecture-3b", str(empty))[0] == 2
