"""A full stop behind a formula ends it where a sentence or another statement follows on its line.

Oracle: by hand, two carts on springs in a row with a damper between them, and a push on the second one.
"""

from __future__ import annotations

import pytest
from small_systems import two_carts

from lagrangian import ParseError

ROWS = "first cart: m x'' = -k x + N\nsecond cart: n y'' = F - N\n"
FORCE = "N = c (y - x) + b (y' - x')"


def right(written: str) -> bool:
    try:
        return two_carts(between=True).check(written, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "sentence",
    [
        "The second cart feels -N.",
        "Cart two feels -N, by the third law.",
        "On the other cart acts −N",
        "The reaction on the other cart is -N.",
        "Dann wirkt auf den zweiten Wagen -N.",
    ],
)
def test_a_sentence_with_a_formula_begins_behind_the_full_stop(sentence: str) -> None:
    sheet = f"Force on the first cart: {FORCE}. {sentence}\n\n{ROWS}"
    assert right(sheet)
    for was, now in (("+ b", "- b"), ("F - N", "F + N"), ("-k x + N", "-k x"), ("c (y - x)", "c (y + x)")):
        assert was in sheet and not right(sheet.replace(was, now))


@pytest.mark.parametrize("number", ["a = k/4. ", "a = k/4; "])
@pytest.mark.parametrize("stated", ["m + n = M_t", "M_t = m + n", "n + m = M_t"])
def test_a_statement_begins_behind_the_full_stop(number: str, stated: str) -> None:
    rows = "(M_t - n) x'' = -4 a x + c (y - x) + b (y' - x')\nn y'' = F - c (y - x) - b (y' - x')"
    sheet = f"{number}{stated}\n\n{rows}"
    assert right(sheet)
    assert not right(sheet.replace("k/4", "k/5"))
    assert not right(sheet.replace(stated, stated.replace("+", "-")))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "The second cart pulls with N, the outer spring pulls back with k x.",
        "N pulls outwards, and the outer spring pulls with k x, backwards.",
        "N acts to the right, the force of the outer spring is k x.",
        "Der andere Wagen zieht mit N, die Feder zieht mit k x zurück.",
        "The other cart pulls with N where the spring pulls back with k x.",
    ],
)
def test_what_another_clause_is_about_is_no_value_of_a_name(said: str) -> None:
    rows = "m x'' = N - k x\nn y'' = F - N\nn y'' = F - c (y - x) - b (y' - x')"
    assert right(f"{said}\n\n{rows}")
    assert not right(f"{said}\n\n{rows.replace('N - k x', 'N + k x')}")
    assert not right(f"{said}\n\n{rows.replace('F - N', 'F + N')}")


def test_what_a_clause_says_of_the_name_is_its_value() -> None:
    rows = "m x'' = N - k x\nn y'' = F - N"
    for said in ("The other cart pulls with N, which is c (y - x) + b (y' - x').", "N is c (y - x) + b (y' - x')"):
        assert right(f"{said}\n\n{rows}")
        assert not right(f"{said}\n\n{rows}".replace("c (y", "b (y"))
