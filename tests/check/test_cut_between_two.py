"""Of two balances with a cut force between them, the one is blamed in which the mistake is, or neither alone.

Oracle: by hand, from the free bodies of each system.
"""

from __future__ import annotations

from small_systems import cart, rack, wheels

import lagrangian as lg


def told(system: lg.Derivation, answer: str) -> str:
    """What is told of a wrong answer, in one line."""
    verdict = system.check(answer)
    assert not verdict.right
    return " ".join(str(verdict).split())


def test_a_rest_length_is_missing_where_the_rest_of_the_spring_stands() -> None:
    right = "Newton: rack m x'' = S - k (x - d)\npinion J x''/R = M - S R\n(m + J/R^2) x'' + k (x - d) = M/R"
    assert rack().check(right).right
    said = told(rack(), right.replace("k (x - d)", "k x"))
    assert "Look at line 1: that is the first that is not right." in said
    assert "In line 1, on the right-hand side, the term k d is missing." in said
    assert "line 2 right" in said


def test_a_force_that_is_the_balance_of_another_body_was_not_solved_from_the_one_above() -> None:
    right = (
        "Cart: M x'' = -k x - H\nBob, horizontally: H = m (x'' + l phi'' cos(phi) - l phi'^2 sin(phi))\n"
        "so (M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) + k x = 0\n"
        "m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = 0"
    )
    assert cart().check(right).right
    said = told(cart(), right.replace("(x'' + l", "(l").replace("(M + m)", "M"))
    assert "Look at line 2: that is the first that is not right." in said
    assert "In line 2, on the right-hand side, the term m ẍ is missing." in said


def test_a_force_solved_from_the_balance_above_is_where_that_was_solved_wrongly() -> None:
    said = told(
        cart(),
        "Cart: M x'' = -k x - H\nso H = k x - M x''\nm (x'' + l phi'' cos(phi) - l phi'^2 sin(phi)) = H\n"
        "m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = 0",
    )
    assert "Look at line 2" in said


def test_where_a_sign_may_be_wrong_in_either_neither_is_called_right() -> None:
    right = (
        "Drum: A phi'' = -k phi + R X\nRoller: B R/r phi'' = M - c R/r phi' - r X\n"
        "(A + B R^2/r^2) phi'' + c R^2/r^2 phi' + k phi = M R/r"
    )
    assert wheels().check(right).right
    wrong = right.replace("- r X", "+ r X").replace("(A + B", "(A - B").replace("+ c R^2", "- c R^2")
    said = told(wheels(), wrong.replace("= M R/r", "= -M R/r"))
    assert "Look at line 1, and line 2: they do not fit each other." in said
    assert "In line 1 or in line 2, X has the wrong sign" in said
