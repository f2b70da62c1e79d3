"""What a correction states anew: the line above with the same name, or of the same accelerations, is taken back.

Oracle: by hand, a puck on a spring along a rod that a motor turns:

    m r'' − m r φ'² + k (r − a) = 0,    (J + m r²) φ'' + 2 m r r' φ' = M
"""

from __future__ import annotations

import pytest
from small_systems import rod

from lagrangian.check.verdict import Verdict

ROWS = "m r'' - m r phi'^2 + k (r - a) = 0\n(J + m r^2) phi'' + 2 m r r' phi' = M"
T = "T = 1/2 (J + m r^2) phi'^2 + 1/2 m r'^2"
SLIP = "T = 1/2 (J + m r^2) phi'^2 - 1/2 m r'^2"
V = "V = 1/2 k (r - a)^2"


def told(text: str) -> Verdict:
    """The verdict on an answer to the rod."""
    return rod().check(text)


CORRECTIONS = (
    "*{0}",
    "* no minus here: {0}",
    "*plus, not minus: {0}",
    "Correction: {0}",
    "Correction to line 1, I forgot a sign: {0}",
    "correction (both energies are positive): {0}",
    "Sorry, a slip: {0}",
    "oops, {0}",
    "Wait, wait: {0}",
    "no, that was wrong: {0}",
    "Edit: {0}",
    "Korrektur zu Zeile 1: {0}",
    "Correction:\n{0}",
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", CORRECTIONS)
def test_a_correction_takes_back_the_line_with_the_same_name(form: str) -> None:
    bulleted = form.startswith("* ")
    verdict = told(f"{SLIP}\n{V}\n{form.format(T)}\n{ROWS}")
    assert verdict.right is not bulleted, verdict.findings  # a star and a blank begin an item of a list
    if not bulleted:
        assert f"'{SLIP}' was not judged: it is crossed out or taken back." in map(str, verdict.notes)
        swapped = told(f"{T}\n{V}\n{form.format(SLIP)}\n{ROWS}")
        assert not swapped.right
        assert [str(f.line.text) for f in swapped.findings if f.status.name == "WRONG"] == [SLIP]


def test_what_a_sentence_says_that_it_should_be() -> None:
    anew = T.replace("T = ", "T should be ")
    assert told(f"{SLIP}\n{V}\nwait, both are positive, so {anew}\n{ROWS}").right
    assert not told(f"{T}\n{V}\nwait, so {SLIP.replace('T = ', 'T should be ')}\n{ROWS}").right


def test_only_one_statement_of_a_line_is_taken_back() -> None:
    verdict = told(f"{SLIP}, {V}\nsorry: {T}\n{ROWS}")
    assert verdict.right, verdict.findings
    assert not told(f"{SLIP}, {V.replace('- a', '+ a')}\nsorry: {T}\n{ROWS}").right


@pytest.mark.parametrize("form", ["Correction: {}", "sorry, sign: {}", "Correction to (2): {}"])
def test_an_equation_is_stated_anew(form: str) -> None:
    first, second = ROWS.split("\n")
    wrong = second.replace("+ 2 m", "- 2 m")
    assert told(f"(1) {first}\n(2) {wrong}\n{form.format(second)}").right
    assert not told(f"(1) {first}\n(2) {second}\n{form.format(wrong)}").right


def test_a_correction_of_something_else_takes_nothing_back() -> None:
    verdict = told(f"{SLIP}\nCorrection: {V}\n{ROWS}")
    assert not verdict.right
    assert not any("taken back" in str(x) for x in verdict.notes)
