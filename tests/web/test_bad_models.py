"""The bad models of the reader's tests, through the app: each is one error with its line, and never a failure of it."""

import sys
from pathlib import Path

import pytest
from served_app import Served

sys.path.append(str(Path(__file__).parent.parent / "read"))  # where the collections are

import test_bad_constraints
import test_bad_file

FILES = {name: (text, line, column) for name, text, line, column, _ in test_bad_file.BAD}
CONSTRAINTS = {f"constraint: {name}": case for name, case in test_bad_constraints.BAD.items()}


@pytest.mark.parametrize("case", FILES)
def test_a_bad_file_is_told_at_its_line(kind_app: Served, case: str) -> None:
    text, line, column = FILES[case]
    answer = kind_app.ask("derive", {"model": text})
    assert answer.status_code == 200
    error = answer.json()["error"]
    assert error["what"] and error["fix"] and error["code"]
    assert error["line"] is not None
    assert line is None or error["line"] == line
    assert column is None or error["column"] == column


@pytest.mark.parametrize("case", CONSTRAINTS)
def test_a_bad_constraint_is_told(kind_app: Served, case: str) -> None:
    text, code, fragment = CONSTRAINTS[case]
    asked = {"model": test_bad_constraints.HEAD + text}
    start = {"duration": 0.5, "initial": {"x": 0.3, "y": 0.2}}
    answers = [kind_app.ask("derive", asked), kind_app.ask("simulate", {**asked, **start})]
    assert [answer.status_code for answer in answers] == [200, 200]
    errors = [answer.json()["error"] for answer in answers if "error" in answer.json()]
    assert errors[0]["code"] == code
    assert fragment in errors[0]["message"]


def test_there_are_a_hundred() -> None:
    assert len(FILES) + len(CONSTRAINTS) >= 100
