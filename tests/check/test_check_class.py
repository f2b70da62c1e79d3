"""A class: required parts, coordinates, points, feedback, statistics, lists, stored verdicts, processes."""

from __future__ import annotations

import base64
import csv
import io
import json
import os
import re
import signal
from pathlib import Path
from typing import Any

import pytest

import lagrangian as lg
from built_in import derivation
from lagrangian.check.classes import processes, scheme_of
from lagrangian.check.classes.judge import Judge
from lagrangian.check.classes.students import student_of
from lagrangian.cli import main
from lagrangian.errors import Error, ModelError

WHOLE = """T = 1/2*m1*x1'^2 + 1/2*m2*(x1' + x2r')^2
V = 1/2*k*x2r^2
Xi_1 = 0
Xi_2 = F
(m1 + m2)*x1'' + m2*x2r'' = 0
m2*(x1'' + x2r'') + k*x2r = F
"""
EQUATIONS = "\n".join(WHOLE.splitlines()[4:])
NO_HALF = """T = 1/2*m1*x1'^2 + 1/2*m2*(x1' + x2r')^2
V = k*x2r^2
L = 1/2*m1*x1'^2 + 1/2*m2*(x1' + x2r')^2 - k*x2r^2
(m1 + m2)*x1'' + m2*x2r'' = 0
m2*(x1'' + x2r'') + 2*k*x2r = F
"""
ABSOLUTE = "m1*x1'' - k*(x2 - x1) = -F\nm2*x2'' + k*(x2 - x1) = F\n"
COUPLING = WHOLE.replace("(x1' + x2r')^2", "x2r'^2")
POINTS = {"T": 2, "V": 2, "Xi": 2, "equations": 4}


def carts() -> lg.Derivation:
    return derivation("lecture-3b")


def earned(found: lg.CheckedClass) -> dict[str, float | None]:
    return {row.file: row.points for row in found.rows}


def test_a_right_answer_without_a_required_part_is_incomplete_and_says_which() -> None:
    found = carts().check_class({"whole": WHOLE, "bare": EQUATIONS}, require=["equations", "T", "V", "Xi"])
    whole, bare = found.rows
    assert whole.right and not whole.lacks
    assert not bare.right and bare.said == "incomplete"
    assert bare.lacks == ("T*", "V", "Ξ of x2r")  # Ξ of x1 is 0 and may be left out
    assert "T*, V and Ξ of x2r" in bare.comment[0]


def test_one_equation_of_two_lacks_the_other() -> None:
    (row,) = carts().check_class({"one": EQUATIONS.splitlines()[0]}, require=["equations"]).rows
    assert row.lacks == ("1 of the equations",)


def test_points_by_part_and_by_line() -> None:
    found = carts().check_class({"whole": WHOLE, "bare": EQUATIONS}, points=POINTS)
    assert earned(found) == {"whole": 10, "bare": 4}
    lines = carts().check_class({"bare": EQUATIONS}, points={"equations_x1": 1, "equations_x2r": 3, "Xi_x1": 1})
    assert earned(lines) == {"bare": 5}
    half = carts().check_class({"half": EQUATIONS.replace("+ k", "- k")}, points=POINTS)
    assert earned(half) == {"half": 2}


def test_every_row_of_matrices_is_told_with_its_coordinate() -> None:
    told = carts().check("[m1 + m2, m2; m2, m2]*[x1''; x2r''] = [0; F + k*x2r]").to_text()
    assert "line 1, the equation of x" in told.partition("Line by line")[2]
    assert "1 of 2 lines is right" in told


def test_an_equation_that_is_written_twice_counts_once() -> None:
    first, second = EQUATIONS.splitlines()
    wrong = second.replace("+ k", "- k")
    answers = {"once": f"{first}\n{wrong}", "echo": f"{first}\n{first}\n{wrong}\n{wrong}"}
    for row in carts().check_class(answers, points={"equations": 4}).rows:
        assert [(m["points"], m["why"]) for m in row.marks] == [(2, "1 not right")], row.file


def test_what_follows_from_a_wrong_line_costs_nothing_again() -> None:
    answers = {"ann": NO_HALF, "bob": NO_HALF.partition("\n")[2]}  # bob does not state T*
    for row in carts().check_class(answers, points={"V": 2, "L": 2, "equations": 4}).rows:
        assert {m["part"]: m["points"] for m in row.marks} == {"V": 0, "L": 2, "equations": 4}
        assert not row.right


def test_a_right_lagrangian_holds_both_energies() -> None:
    L = "L = 1/2*m1*x1'^2 + 1/2*m2*(x1' + x2r')^2 - 1/2*k*x2r^2"
    assert earned(carts().check_class({"ann": L}, points={"T": 1, "V": 1, "D": 1})) == {"ann": 3}


def test_other_coordinates_can_be_excluded() -> None:
    answers = {"ann": ABSOLUTE}
    assert carts().check_class(answers, points=POINTS).rows[0].points == 4
    found = carts().check_class(answers, points=POINTS, coordinates="given")
    (row,) = found.rows
    assert not row.right and row.points == 2 and row.said == "right in other coordinates"
    assert "other coordinates than those asked for" in row.comment[0]
    assert found.counts == {"other_coordinates": 1}
    assert carts().check_class(answers, points=POINTS, coordinates="given", other=0).rows[0].points == 0


def test_what_cannot_be_read_is_told_without_advice_on_models() -> None:
    answers = {"empty": "", "words": "I do not know", "long": "x = 1\n" * 20_000, "binary": "a\0b"}
    for row in carts().check_class(answers).rows:
        (told,) = row.comment
        assert not row.read and not any(x in told for x in ("model", "[define]", "^", "1 | Fix")), told


def test_schemes_of_the_command(tmp_path: Path) -> None:
    assert scheme_of("step2=2, V=1,Xi_x2r=3").points == {"T": 2, "V": 1, "Xi_x2r": 3}
    file = tmp_path / "points.toml"
    file.write_text("other_coordinates = 0.25\n[points]\nT = 2\nequations = 4\n")
    scheme = scheme_of(str(file), "T*,equations")
    assert (scheme.points, scheme.other, scheme.require) == ({"T": 2, "equations": 4}, 0.25, ("T", "equations"))
    for text in ("T", "T=two", "T=1,step2=1", "Q=1", "T=-1", "Xi=1,Xi_x1=1", "T=nan"):
        with pytest.raises(Error):
            scheme_of(text)
    with pytest.raises(ModelError, match="no coordinate 'y'"):
        carts().check_class({"ann": WHOLE}, points={"Xi_y": 1})


def test_statistics_by_mistake_step_and_element() -> None:
    answers = {"ann": WHOLE, "bob": COUPLING, "cid": COUPLING, "dan": NO_HALF, "eve": "x1 = = 2"}
    found = carts().check_class(answers)
    counts = {(c.kind, c.name): c for c in found.statistics}
    assert counts["step", "2"].sentence == "2 of 5 went wrong in step 2, kinetic co-energy."
    assert counts["element", "particle 'm2'"].files == ("bob", "cid")
    assert counts["mistake", "unreadable"].sentence == "1 of 5 could not be read."
    first = found.statistics[0]
    assert first.count == 2 and first.sentence.startswith("2 of 5") and first.sentence.endswith("(step 2).")
    assert first.sentence in str(found)
    assert f"wrong: {first.name.replace('_', ' ')}" in str(found) and "_" not in str(found)


def test_feedback_tells_no_more_than_its_level(tmp_path: Path) -> None:
    answers = {"ann.txt": COUPLING, "bob.tex": WHOLE, "bob.txt": WHOLE}
    low = carts().check_class(answers, told=0, feedback="text", points=POINTS)
    paths = low.write_feedback(tmp_path / "replies")
    assert [p.name for p in paths] == ["ann.txt", "bob.tex.txt", "bob.txt.txt"]
    words = paths[0].read_text(encoding="utf-8")
    assert "Not right yet" in words and "line" not in words and "of 10" in words
    assert low.counts  # the teacher's own results hold the mistakes all the same
    with pytest.raises(Error, match="exists already"):
        low.write_feedback(tmp_path / "replies")
    full = carts().check_class({"ann.txt": COUPLING}, feedback="html", points=POINTS)
    (page,) = full.write_feedback(tmp_path / "replies")
    assert "particle" in page.read_text(encoding="utf-8")
    assert [p.name for p in (tmp_path / "replies").iterdir() if p.suffix == ".part"] == []


MOODLE = "Anna Lee_4711_assignsubmission_file_carts.txt"


def test_moodles_names_say_who_wrote_an_answer() -> None:
    assert student_of(MOODLE).identifier == "Participant 4711"
    assert student_of("Anna Lee_4711_assignsubmission_onlinetext_/x.html").name == "Anna Lee"
    assert student_of("anna.txt").name == "anna"


def test_moodles_worksheet_is_filled_in_and_kept(tmp_path: Path) -> None:
    head = "Identifier,Full name,Email address,Status,Grade,Maximum grade,Last modified (grade),Feedback comments"
    lines = ["Participant 4711,Anna Lee,a@x.org,Submitted,,10.00,-,", "Participant 7,José Ruiz,j.r@x.org,,,10.00,-,"]
    (tmp_path / "worksheet.csv").write_text("\ufeff" + "\r\n".join([head, *lines, ""]), encoding="utf-8")
    answers = {MOODLE: WHOLE, "jose_ruiz.txt": "= =", "stranger.txt": COUPLING}
    found = carts().check_class(answers, points=POINTS, roster=tmp_path / "worksheet.csv")
    rows = list(csv.reader(io.StringIO(found.to_moodle())))
    assert rows[0] == head.split(",")
    assert rows[1][:5] == ["Participant 4711", "Anna Lee", "a@x.org", "Submitted", "10.00"]
    assert rows[2][4] == "" and "could not be read: line 1, column 1: " in rows[2][7]
    assert "[E" not in rows[2][7] and "Fix:" not in rows[2][7]
    assert "stranger.txt belongs to nobody" in str(found) and not found.absent
    with pytest.raises(ModelError, match="no points"):
        carts().check_class({"ann": WHOLE}).to_moodle()
    half = {MOODLE: EQUATIONS.replace("+ k", "- k")}  # 1.5 of 3 points
    found = carts().check_class(half, points={"equations": 3}, roster=tmp_path / "worksheet.csv")
    assert list(csv.reader(io.StringIO(found.to_moodle())))[1][4] == "5.00"
    assert "3 points are its maximum grade 10" in str(found)


def test_a_name_of_two_students_is_told(tmp_path: Path) -> None:
    roster = tmp_path / "list.csv"
    roster.write_text("Full name,ID number\nAnna Lee,1\nAnna Lee,2\n", encoding="utf-8")
    found = carts().check_class({"Anna Lee.txt": WHOLE}, roster=roster)
    assert "Anna Lee.txt fits 2 students of the list" in str(found) and "nobody" not in str(found)


def test_moodle_can_import_without_a_list_and_comments_are_no_markup() -> None:
    found = carts().check_class({MOODLE: WHOLE, "=cmd.txt": "<b> = ="}, points=POINTS)
    rows = list(csv.DictReader(io.StringIO(found.to_moodle())))
    assert rows[0]["Identifier"] == "Participant 4711" and rows[0]["Last modified (grade)"] == "-"
    assert rows[1]["Full name"] == "'=cmd" and "<b>" not in rows[1]["Feedback comments"]


def test_gradescopes_columns(tmp_path: Path) -> None:
    (tmp_path / "roster.csv").write_text("First Name,Last Name,SID,Email\nAnna,Lee,11,a@x.org\nBo,Ek,12,bo@x.org\n")
    found = carts().check_class({"11.txt": EQUATIONS}, points=POINTS, roster=tmp_path / "roster.csv")
    rows = list(csv.reader(io.StringIO(found.to_gradescope())))
    assert rows[0][4:] == [
        "Total Score",
        "Max Points",
        "Status",
        "1: T* (2.0 pts)",
        "2: V (2.0 pts)",
        "3: Ξ (2.0 pts)",
    ] + ["4: the equations (4.0 pts)"]
    assert rows[1] == ["Anna", "Lee", "11", "a@x.org", "4", "10", "Graded", "0", "0", "0", "4"]
    assert rows[2][:7] == ["Bo", "Ek", "12", "bo@x.org", "", "10", "Missing"]
    (tmp_path / "more.csv").write_text("a,b\n1,2\n")
    with pytest.raises(Error, match="who the students are"):
        carts().check_class({"ann": WHOLE}, roster=tmp_path / "more.csv")
    with pytest.raises(Error, match="both"):
        carts().check_class({"11.txt": WHOLE, "lee.txt": WHOLE, "anna_lee": WHOLE}, roster=tmp_path / "roster.csv")


def test_stored_verdicts_are_not_made_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    judged: list[bytes] = []
    judge = Judge.judge
    monkeypatch.setattr(Judge, "judge", lambda self, name, text: judged.append(text) or judge(self, name, text))
    store, answers = tmp_path / "verdicts.jsonl", {"ann": WHOLE, "bob": COUPLING, "cid": "= =", "dan": WHOLE}

    def run(hint: int = 3) -> lg.CheckedClass:
        return carts().check_class(answers, store=store, hint=hint, processes=1)

    first = run()
    again = run()
    assert len(judged) == 3 and again.reused == 4  # dan wrote what ann wrote
    assert [row.record["file"] for row in again.rows] == list(answers)
    assert again.to_json() == first.to_json()
    answers["bob"] = EQUATIONS
    assert run().reused == 3 and judged[3:] == [EQUATIONS.encode()]
    assert run(hint=1).reused == 0  # other options are another question


def test_a_damaged_line_of_the_store_is_told_and_judged_again(tmp_path: Path) -> None:
    store = tmp_path / "verdicts.jsonl"
    carts().check_class({"ann": COUPLING, "bob": WHOLE}, store=store)
    kind, ann, bob = store.read_text().splitlines()
    changed = json.loads(ann)
    changed["record"]["right"] = True
    store.write_text("\n".join([kind, json.dumps(changed), bob[:-20]]))
    again = carts().check_class({"ann": COUPLING, "bob": WHOLE}, store=store)
    assert (again.reused, again.damaged) == (0, 2) and not again.rows[0].right
    assert carts().check_class({"ann": COUPLING, "bob": WHOLE}, store=store).reused == 2
    (tmp_path / "other").write_text("m*x'' = F\n")
    with pytest.raises(Error, match="not a file of verdicts"):
        carts().check_class({"ann": WHOLE}, store=tmp_path / "other")
    assert (tmp_path / "other").read_text() == "m*x'' = F\n"


@pytest.mark.slow
def test_two_processes_find_the_same_as_one() -> None:
    answers = {"ann": WHOLE, "bob": COUPLING, "cid": "= =", "dan": NO_HALF, "eve": ABSOLUTE}
    one, two = (carts().check_class(answers, points=POINTS, feedback="markdown", processes=count) for count in (1, 2))
    assert one.to_json() == two.to_json()
    assert [row.record for row in one.rows] == [row.record for row in two.rows]


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_a_process_that_is_killed_is_told_and_the_others_are_judged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    exchanged = processes._exchanged

    def killing(process: object, message: dict[str, str]) -> object:
        if base64.b64decode(message.get("content", "")) == COUPLING.encode():
            os.kill(process.pid, signal.SIGKILL)  # type: ignore[attr-defined]
            process.wait()  # type: ignore[attr-defined]
        return exchanged(process, message)  # type: ignore[arg-type]

    monkeypatch.setattr(processes, "_exchanged", killing)
    store = tmp_path / "verdicts.jsonl"
    found = carts().check_class({"ann": WHOLE, "bob": COUPLING, "cid": EQUATIONS}, processes=2, store=store)
    assert [row.said for row in found.rows] == ["right", "cannot be judged", "right"]
    assert "killed (signal 9)" in found.rows[1].trouble
    assert len(store.read_text().splitlines()) == 3  # it is not kept: the next run judges it


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main(["check", "-e", "lecture-3b", *arguments])
    out = capsys.readouterr()
    return code, out.out, out.err


def test_what_is_no_file_among_answers_is_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "ann.txt").write_text(WHOLE, encoding="utf-8")
    (tmp_path / "late").mkdir()
    (tmp_path / "lost.txt").symlink_to(tmp_path / "gone.txt")
    os.mkfifo(tmp_path / "pipe")
    assert [row.file for row in carts().check_class(tmp_path).rows] == ["ann.txt"]
    assert all(x in caplog.text for x in ("'late' is a folder", "'lost.txt' is a link to nothing", "'pipe' is no file"))


def test_the_command_for_a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answers, replies = tmp_path / "answers", tmp_path / "replies"
    (answers / MOODLE.removesuffix("carts.txt")).mkdir(parents=True)
    (answers / MOODLE.removesuffix("carts.txt") / "carts.txt").write_text(COUPLING)
    (answers / "bob.txt").write_text(EQUATIONS)
    (answers / "notes").mkdir()
    options = ("--points", "T=2,V=2,Xi=2,equations=4", "--require", "equations,T", "--processes", "1")
    written = ("--feedback", str(replies), "--moodle", str(tmp_path / "m.csv"), "--gradescope", str(tmp_path / "g.csv"))
    kept = ("--store", str(tmp_path / "verdicts.jsonl"))
    code, out, _ = run(capsys, str(answers), *options, *written, *kept, "--hint", "1")
    assert code == 1 and "bob.txt" in out and "incomplete: lacks T*" in out
    assert "(step 2)" in out  # the level is for the students
    page = (replies / "bob.html").read_text(encoding="utf-8")
    assert "Points" in page and "particle" not in page
    assert sorted(p.name for p in replies.iterdir())[0].startswith("Anna Lee_4711")
    assert "particle" not in (tmp_path / "m.csv").read_text(encoding="utf-8")
    code, _, err = run(capsys, str(answers), *options, *written, *kept, "--hint", "1")
    assert code == 2 and "exists already" in err
    code, _, err = run(capsys, str(answers), *options, *written, *kept, "--hint", "1", "--force")
    assert code == 1 and "2 of 2 answers were judged before" in err


def test_the_manuals_examples_run(tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "check.md").read_text(encoding="utf-8")
    section = page.partition("## A class")[2]
    (code,) = re.findall(r"^```python\n(.*?)^```", section, flags=re.M | re.S)
    names: dict[str, Any] = {}
    exec(code.replace('built_in.derivation("lecture-3b")', "carts()"), {"carts": carts}, names)
    ann, bob = names["found"].rows
    assert (ann.points, ann.right) == (6.0, True)
    assert not bob.right and bob.points < 3 and names["found"].statistics[0].count == 1
    (table,) = re.findall(r"^```toml\n(.*?)^```", section, flags=re.M | re.S)
    (tmp_path / "points.toml").write_text(table)
    assert scheme_of(str(tmp_path / "points.toml")).total == 10


def test_usage_of_the_command_for_a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "ann.txt").write_text(WHOLE)
    for wrong in (
        ("--points", "Q=1"),
        ("--require", "everything"),
        ("--moodle", str(tmp_path / "m.csv")),
        ("--moodle", str(tmp_path / "m.txt"), "--points", "T=1"),
        ("--feedback", str(tmp_path)),
        ("--feedback", str(tmp_path / "none" / "replies")),
        ("--roster", str(tmp_path / "none.csv")),
        ("--store", str(tmp_path / "ann.txt")),
    ):
        assert run(capsys, str(tmp_path), *wrong)[0] == 2, wrong
    assert run(capsys, str(tmp_path / "ann.txt"), "--points", "T=1")[0] == 2
    assert sorted(p.name for p in tmp_path.iterdir()) == ["ann.txt"]
