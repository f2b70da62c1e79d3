"""Lines that say what parameters amount to, m g l = 14.7, say nothing of the motion: true ones, and wrong ones."""

from __future__ import annotations

from functools import cache

import pytest

from lagrangian import loads
from lagrangian.check import Status
from lagrangian.derivation import Derivation

SWING = """
name = "bar with a spring"
[coordinates]
theta = "bar, from hanging straight down"
[parameters]
m = "1.5 kg"
l = "0.9 m"
a = "0.4 m"
k = "200 N/m"
alpha = "25 deg"
g = "9.81 m/s^2"
[inputs]
M = "N*m, on the bar"
[[kinetic]]
value = "m*l^2*theta'^2/6"
[[potential]]
value = "-m*g*l/2*cos(theta) - k*a^2*sin(alpha)*theta"
[[spring]]
k = "k"
deflection = "a*theta"
[[force]]
value = "M"
deflection = "theta"
"""
ROW = "0.405 theta'' + 32 theta + 6.622 sin(theta) - 13.52 = M"
LETTERS = "m l^2/3 theta'' + k a^2 theta + m g l/2 sin(theta) - k a^2 sin(alpha) = M"


@cache
def swing() -> Derivation:
    """A bar that gravity, a spring and a constant torque turn."""
    return loads(SWING).derive()


TRUE = [
    "m g l/2 = 6.622",
    "m g l/2 = 6.62",
    "m g l/2 = 6.6",
    "6.622 = m g l/2",
    "m g l/2 = 1.5 * 9.81 * 0.45 = 6.622",
    "m g l/2 = 1.5 * 9.81 * 0.45 = 6.62175 = 6.622",
    "m g l/2 = 1.5 * 0.45 g = 6.622",
    "1.5 * 9.81 * 0.45 = 6.622 = m g l/2",
    "k a^2 sin(alpha) = 32 * 0.4226 = 13.52",
    "k a^2 sin(alpha) = 13.5238",
    "k a^2 = 32, k a = 80",
    "sin(alpha) = 0.423",
    "k a^2 - 32 = 0",
    "$m g l/2 = 6{,}622$",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("line", TRUE)
@pytest.mark.parametrize("row", [ROW, LETTERS])
def test_a_true_amount_is_right_beside_the_equation(row: str, line: str) -> None:
    assert swing().check(f"{line}\n{row}", hint=0).right


WRONG = [
    ("m g l/2 = 7.622", "g*l*m/2 is 6.622, not 7.622."),
    ("m g l/2 = 6.722", "g*l*m/2 is 6.622, not 6.722."),
    ("m g l/2 = 6.632", "g*l*m/2 is 6.622, not 6.632."),
    ("m g l/2 = 6.623", "g*l*m/2 is 6.622, not 6.623."),
    ("m g l/2 = 6.621", "g*l*m/2 is 6.622, not 6.621."),
    ("m g l/2 = 6.63", "g*l*m/2 is 6.62, not 6.63."),
    ("m g l/2 = 66.22", "g*l*m/2 is 6.62, not 66.22."),
    ("m g l/2 = -6.622", "g*l*m/2 is 6.622, not -6.622."),
    ("m g l/2 = 1.5 * 9.81 * 0.45 = 7.622", "g*l*m/2 is 6.622, not 7.622."),
    ("m g l/2 = 1.5 * 9.81 * 0.54 = 7.946", "g*l*m/2 is 6.62175, not 7.9461."),
    ("k a^2 sin(12 deg) = 6.654", "0.2079*a^2*k is 6.653, not 6.654."),
    ("k a^2 = 33", "a^2*k is 32, not 33."),
    ("k a = 80, k a^2 = 34", "a^2*k is 32, not 34."),
    ("k a^2 sin(alpha) = 32 * 0.4236 = 13.56", "a^2*k*sin(alpha) is 13.5238, not 13.5552."),
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("line", "told"), WRONG)
@pytest.mark.parametrize("row", [ROW, LETTERS])
def test_a_wrong_amount_is_told_by_its_number_and_is_no_equation(row: str, line: str, told: str) -> None:
    verdict = swing().check(f"{line}\n{row}")
    assert not verdict.right and verdict.motion and not verdict.mistakes
    assert [str(f.note) for f in verdict.findings if f.status is Status.WRONG] == [told]
    assert "missing" not in verdict.to_text()
    assert told[:-1] not in swing().check(f"{line}\n{row}", hint=2).to_text()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("line", ["m g l/2 = 1.5 * 0.55 g = 6.622", "m g l/2 = 1.5 * 0.45 g = 7.622"])
def test_a_wrong_side_in_a_chain_of_amounts_is_wrong(line: str) -> None:
    assert not swing().check(f"{line}\n{ROW}", hint=0).right


def test_a_true_amount_does_not_make_a_wrong_equation_right() -> None:
    for wrong in (ROW.replace("6.622", "7.622"), ROW.replace("6.622", "6.623"), ROW.replace("13.52", "13.53")):
        verdict = swing().check(f"m g l/2 = 6.622\n{wrong}")
        assert not verdict.right and not verdict.motion
    assert not swing().check("m g l/2 = 6.622", hint=0).right


def test_amounts_may_be_those_of_values_that_are_stated() -> None:
    row = LETTERS.replace("k a^2 sin(alpha)", "k a^2/2")
    assert swing().check(f"alpha = 30 deg, k a^2 sin(alpha) = 16\n{row}", hint=0).right
    assert not swing().check(f"alpha = 30 deg, k a^2 sin(alpha) = 17\n{row}", hint=0).right


@pytest.mark.parametrize("line", [ROW, LETTERS])
def test_a_line_that_is_true_with_the_values_of_the_system_is_no_equation_of_motion(line: str) -> None:
    said = "k a^2 cos(theta)^2 + 2 m sin(theta)^2 = {} - 29 sin(theta)^2"
    assert swing().check(f"{said.format(32)}\n{line}").right
    assert swing().check(f"{said.format(31)}\n{line}").status is Status.WRONG


def test_a_line_that_is_true_with_the_values_of_the_system_is_not_enough() -> None:
    said = "k a^2 cos(theta)^2 + 2 m sin(theta)^2 = 32 - 29 sin(theta)^2"
    assert not swing().check(said).right
    assert swing().check(f"{said}\n{ROW.replace('32', '31')}").status is Status.WRONG


@pytest.mark.parametrize("line", [ROW, LETTERS])
def test_an_amount_may_stand_before_what_moves(line: str) -> None:
    assert swing().check(f"m g l cos(theta) = 13.2435 cos(theta)\n{line}").right
    assert swing().check(f"m g l cos(theta) = 14.2435 cos(theta)\n{line}").status is Status.WRONG
    assert swing().check(f"m g l cos(theta) = 13.2435 sin(theta)\n{line}").status is Status.WRONG


def test_an_equation_follows_from_a_wrong_amount_above_it() -> None:
    """What is wrong in it is what is wrong in the amount, and nothing else can be the cause."""
    verdict = swing().check("m l^2/3 = 0.0405\n0.0405 theta'' + 32 theta + 6.622 sin(theta) - 13.52 = M")
    first, second = verdict.findings
    assert str(first.note) == "l^2*m/3 is 0.4050, not 0.0405."
    assert second.follows and not verdict.alternatives
    other = swing().check("m l^2/3 = 0.0405\n0.4050 theta'' + 36 theta + 6.622 sin(theta) - 13.52 = M")
    assert not other.findings[1].follows


TWO = """
name = "hoist"
[coordinates]
x = "load"
s = "block"
[parameters]
m = "1.5 kg"
J = "0.08 kg*m^2"
r = "0.2 m"
k = "30 N/m"
d = "2 N*s/m"
M = "4 kg"
[inputs]
F = "N"
[[kinetic]]
name = "load"
value = "m*x'^2/2"
[[kinetic]]
name = "drum"
value = "J*(x'/r)^2/2"
[[kinetic]]
name = "block"
value = "M*s'^2/2"
[[spring]]
name = "band"
k = "k"
deflection = "s"
[[damper]]
name = "brake"
b = "d"
deflection = "x"
[[force]]
value = "F"
deflection = "x"
"""


def test_a_sum_of_numbers_with_a_wrong_amount_blames_no_body() -> None:
    """The number of one of several bodies is wrong where it was worked out; another mistake is told beside it."""
    hoist = loads(TWO).derive()
    amount, rows = "J/r^2 = 0.08/0.04 = {0}", "{1} x'' + 2 x' = F\n4 s'' + 30 {2} = 0"
    assert hoist.check(f"{amount}\n{rows}".format("2.0", "3.5", "s")).right
    verdict = hoist.check(f"{amount}\n{rows}".format("0.2", "1.7", "s"))
    assert not verdict.right and [str(m.what) for m in verdict.mistakes] == ["In line 1, J/r^2 is 2.0, not 0.2."]
    assert verdict.concerned(verdict.mistakes[0]) == []
    verdict = hoist.check(f"{amount}\n{rows}".format("0.2", "1.7", "(1)"))
    told = [str(m.what) for m in verdict.mistakes]
    assert "In line 1, J/r^2 is 2.0, not 0.2." in told and not any("load" in x or "squared" in x for x in told), told
    assert any("band" in x or "30" in x for x in told), told
    verdict = hoist.check(f"{amount}\n{rows}".format("2.0", "1.7", "s"))
    assert not any("In line 1" in str(m.what) for m in verdict.mistakes)


@pytest.mark.parametrize("sum_", ["1.7", "(1.5 + 0.2)", "9.25"])
def test_a_wrong_sum_of_numbers_is_told_as_the_sum(sum_: str) -> None:
    """Not as a number of one of the bodies whose sum it is; a number of one alone is that of this one."""
    hoist = loads(TWO).derive()
    verdict = hoist.check(f"{sum_} x'' + 2 x' = F\n4 s'' + 30 s = 0")
    [mistake] = verdict.mistakes
    assert str(mistake.what).endswith("should be 3.5*x''.") and mistake.element is None, str(mistake.what)
    verdict = hoist.check("3.5 x'' + 2 x' = F\n4.7 s'' + 30 s = 0")
    assert "block" in str(verdict.mistakes[0].what) + str(verdict.mistakes[0].element)


def test_an_amount_is_told_with_three_digits() -> None:
    """0.0625, not 0.06 where 0.25 was written."""
    verdict = swing().check(f"m l^2/30 = 0.45\n{ROW}")
    assert [str(f.note) for f in verdict.findings if not f.status.right] == ["l^2*m/30 is 0.0405, not 0.45."]


@pytest.mark.parametrize("row", [ROW, LETTERS])
def test_letters_that_amount_to_nothing_are_worked_out(row: str) -> None:
    """4 l and 9 a are 3.6 m; without its numbers such a line would be a condition."""
    line = "4 l - 9 a = 3.6 - 3.6 = 0   (balanced!)"
    assert swing().check(f"{line}\n{row}", hint=0).right
    assert swing().check(f"0 = 3.6 - 3.6 = 4 l - 9 a\n{row}", hint=0).right
    assert not swing().check(f"{line}\n{row.replace('+ 32', '- 32').replace('+ k', '- k')}", hint=0).right
    for wrong, amount in (("4 l - 8 a", "-0.4"), ("4 l + 9 a", "7.2")):
        verdict = swing().check(f"{line.replace('4 l - 9 a', wrong)}\n{row}")
        assert [f.line.number for f in verdict.findings if f.status is Status.WRONG] == [1]
        assert f"is {amount}, not 0." in verdict.to_text()


RELATION = "'{}' was not judged: it is a relation of parameters that holds with the values of the system, and no "


@pytest.mark.sampled(4)
@pytest.mark.parametrize("relation", ["4 l = 9 a", "k a^2 = 8 m l*80/27", "9 a - 4 l = 0"])
@pytest.mark.parametrize("row", [ROW, LETTERS])
def test_a_relation_of_parameters_that_holds_is_no_equation_of_motion(relation: str, row: str) -> None:
    verdict = swing().check(f"{relation}\n{row}")
    assert verdict.right and RELATION.format(relation)[:40] in " ".join(verdict.to_text().split())
    assert (
        not swing()
        .check(f"{relation}\n{row.replace('- 13.52', '+ 13.52').replace('- k a^2 sin', '+ k a^2 sin')}")
        .right
    )


def test_a_relation_of_parameters_does_not_hold_for_letters() -> None:
    """9 a is 4 l with these values alone: letters are judged for all."""
    answer = LETTERS.replace("k a^2 theta", "16/81 k l^2 theta")
    assert not swing().check(f"4 l = 9 a\n{answer}").right
    assert not swing().check(f"4 l = 8 a\n{ROW}").right
    assert not swing().check("4 l = 9 a").right


def test_the_value_of_a_product_with_an_index_is_no_name_of_its_own() -> None:
    """m₂L² beside m₂L = 48 is m₂ L², and not 48²."""
    model = """
    name = "pendulum"
    [coordinates]
    phi = "rod"
    [parameters]
    m2 = "60 kg"
    L = "0.8 m"
    J = "6 kg*m^2"
    g = "9.81 m/s^2"
    [[frame]]
    name = "rod"
    angle = "phi"
    [points]
    P = ["L*sin(phi)", "-L*cos(phi)"]
    [[rigid_body]]
    mass = "m2"
    inertia = "J"
    at = "P"
    frame = "rod"
    [[gravity]]
    direction = [0, -1]
    """
    pendulum = loads(model).derive()
    written = "m₂L = 48,  m₂L² + J = 44.4\n44.4 φ'' + 470.88 sin φ = 0"
    assert pendulum.check(written).right
    assert not pendulum.check(written.replace("= 44.4\n", "= 45.4\n")).right
    assert not pendulum.check(written.replace("= 48", "= 49")).right
