"""What a class's tables and pages tell: each student once, a page for everybody, one sentence for one mistake."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest

import lagrangian as lg
from built_in import derivation
from lagrangian.errors import Error

WHOLE = """T = m1*x1'^2/2 + m2*(x1' + x2r')^2/2
V = k*x2r^2/2
(m1 + m2)*x1'' + m2*x2r'' = 0
m2*(x1'' + x2r'') + k*x2r = F
"""
RELATIVE = "T = m1*x1'^2/2 + m2*x2r'^2/2\nV = k*x2r^2/2"
BALANCES = "m1*x1'' = 0\nm2*x2r'' + k*x2r = F"
MOODLE = "Anna Lee_4711_assignsubmission_"


def carts() -> lg.Derivation:
    return derivation("lecture-3b")


@pytest.mark.parametrize("second", ["file_b.txt", "onlinetext_b.txt"])
def test_a_participant_has_one_answer_with_and_without_a_list(second: str) -> None:
    answers = {f"{MOODLE}file_a.txt": WHOLE, f"{MOODLE}{second}": RELATIVE}
    with pytest.raises(Error, match=r"both .*answers of Anna Lee") as told:
        carts().check_class(answers, points={"V": 2})
    assert told.value.code == "E404"
    others = {f"{MOODLE}file_a.txt": WHOLE, MOODLE.replace("4711", "12") + second: WHOLE}  # two students of one name
    assert len(carts().check_class(others, points={"V": 2}).rows) == 2


@pytest.mark.parametrize("form", ["html", "text", "markdown"])
def test_everybody_gets_a_page_also_without_a_verdict(tmp_path: Path, form: str) -> None:
    folder = tmp_path / "answers" / f"{MOODLE}file_"
    folder.mkdir(parents=True)
    for name in ("a.txt", "b.txt"):
        (folder / name).write_text(WHOLE)
    (tmp_path / "answers" / "cut.txt").write_text("m1*x1'' = = F")
    found = carts().check_class(tmp_path / "answers", feedback=form, points={"V": 2})  # type: ignore[arg-type]
    for path, row in zip(found.write_feedback(tmp_path / "replies"), found.rows, strict=True):
        said = " ".join(path.read_text(encoding="utf-8").split())
        assert "Your answer could not be read" in said and row.comment[0][:40] in said
    assert "the folder holds 2 files" in " ".join(found.rows[0].comment)


def test_files_whose_names_have_blanks_can_be_told_apart() -> None:
    wrong = WHOLE.replace("+ k", "- k")
    found = carts().check_class({"anna lee.txt": wrong, "bo ek.txt": wrong})
    rows = list(csv.DictReader(io.StringIO(found.to_csv())))
    assert rows[0]["files"] == "anna lee.txt; bo ek.txt"


def test_one_mistake_is_counted_once_whatever_was_stated() -> None:
    """Who states T* is told of T*; who writes balances is told the same of no energy."""
    found = carts().check_class({"energies": RELATIVE, "balances": BALANCES, "both": f"{RELATIVE}\n{BALANCES}"})
    (count,) = (c for c in found.statistics if c.kind == "mistake")
    assert count.count == 3 and count.name == "relative_speed"
    assert not any("parent" in c.sentence for c in found.statistics)


def test_an_average_says_how_many_it_leaves_out() -> None:
    answers = {"ann": WHOLE, "bob": "V = k*x2r^2", "cid": "= ="}
    said = str(carts().check_class(answers, points={"V": 2}))
    assert "1 of 2 points on average, without 1 that could not be read or judged" in said
    assert "average\n" in str(carts().check_class({"ann": WHOLE}, points={"V": 2}))


def test_what_an_incomplete_answer_lacks_is_named() -> None:
    answers = {"no T": "V = k*x2r^2/2\nXi_2 = F", "no row": WHOLE.splitlines()[2], "one V": "V = k*x2r^2/2"}
    rows = carts().check_class(answers, feedback="text").rows
    assert rows[0].comment[0] == "Right as far as it goes, but something is missing: T*."
    assert rows[1].comment[0].endswith("something is missing: the equation of x2r.")
    assert rows[2].right and "missing" not in " ".join(rows[2].comment)
    assert all("is missing: T*" in (rows[0].feedback or "") for _ in (0,))


def test_a_question_in_a_message_ends_with_its_own_mark() -> None:
    (row,) = carts().check_class({"typo": WHOLE.replace("m2*x2r''", "mm2*x2r''")}).rows
    assert row.trouble and "Did you mean" in row.trouble and "?." not in row.trouble
