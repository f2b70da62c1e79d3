"""Answers worked out by hand, with names and words of their own, are judged as what they state.

Oracle: the equations of these small systems, whose mistakes are made here one by one.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer, check_answer
from lagrangian.derive import Derived
from lagrangian.read import loads
from lagrangian.structured.choose import derive_in_form

BAR = """
name = "bar on a crank"
[coordinates]
phi = "crank, from the top"
[parameters]
J = "0.7 kg*m^2"
m = "0.7 kg"
d = "0.7 m"
c = "0.7 N*m*s"
g = "9.81 m/s^2"
[inputs]
tau = "N*m"
[define]
l = "d/2"
[points]
N = ["0", "l*cos(phi)"]
[[particle]]
name = "bar"
mass = "m"
at = "N"
[[kinetic]]
name = "wheel"
value = "1/2*J*phi'^2"
[[gravity]]
direction = [0, -1]
[[damper]]
b = "c"
deflection = "phi"
[[torque]]
value = "tau"
on = "phi"
"""


@cache
def derived(system: str) -> Derived:
    return derive_in_form(loads(system).model())


def judged(answer: str, system: str = BAR, name: str = "a.txt") -> CheckedAnswer:
    return check_answer(derived(system), answer, name=name)


SLOPES = """Θ(φ) φ̈ + ½ (dΘ/dφ) φ̇² + c φ̇ + dV/dφ = τ
Θ(φ) = J + m l² sin² φ
dΘ/dφ = 2 m l² sin φ cos φ
dV/dφ = −m g l sin φ
"""


def test_slopes_that_are_stated_may_hold_names_that_the_system_defines() -> None:
    """Of an energy that no line states, its derivative has a value, dV/dφ = −m g l sin φ with l = d/2."""
    assert judged(SLOPES).status.name == "RIGHT"
    for wrong in (
        SLOPES.replace("−m g l", "m g l"),
        SLOPES.replace("½ ", ""),
        SLOPES.replace("m l² sin² φ", "2 m l² sin² φ"),
        SLOPES.replace("dV/dφ = −m g l sin φ", "dV/dφ = −m g l sin φ − τ"),
    ):
        assert not judged(wrong).right


def test_a_function_of_an_own_angle_has_a_slope_by_it() -> None:
    """Θ(θ) with rates as dots: dΘ/dθ is its slope, and no d times θ."""
    answer = SLOPES.replace("dV/dφ", "(−m g l sin φ)", 1).rpartition("dV/dφ")[0].replace("φ", "θ")
    assert judged(answer).right
    assert not judged(answer.replace("½ ", "")).right
    assert not judged(answer.replace("J + m l²", "J + 2 m l²")).right


LIFTS = """
name = "lift with a load"
[coordinates]
z = { description = "height", unit = "m" }
[parameters]
m0 = "0.7 kg"
m1 = "0.7 kg"
k = "0.7 N/m"
c = "0.7 N*s/m"
g = "9.81 m/s^2"
[inputs]
F = "N"
[points]
A = ["0", "z"]
B = ["0", "z + 1"]
[[particle]]
mass = "m0"
at = "A"
[[particle]]
mass = "m1"
at = "B"
[[gravity]]
direction = [0, -1]
[[spring]]
k = "k"
deflection = "z"
[[damper]]
b = "c"
deflection = "z"
[[force]]
value = "F"
deflection = "z"
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("sign", ["Σ", "∑", "∑ "])
def test_the_sign_of_a_sum_may_be_part_of_a_name(sign: str) -> None:
    """Σm := m0 + m1 says what Σm is; ∑F = m x'' only says what is added up."""
    answer = f"d/dt [ {sign}m ż ] = F − c ż − k z − {sign}m g,   {sign}m := m0 + m1"
    assert judged(answer, LIFTS).status.name == "RIGHT"
    for wrong in (answer.replace("m0 + m1", "m0 + m0"), answer.replace(f"− {sign}m g", f"+ {sign}m g")):
        assert judged(wrong, LIFTS).status.name == "WRONG"
    energy = (
        f"Power theorem dE/dt = P_nc :\nE = ½ {sign}m ż² + ½ k z² + {sign}m g z, {sign}m = m0 + m1\nP_nc = F ż − c ż²"
    )
    assert judged(energy, LIFTS).right
    assert not judged(energy.replace("− c", "+ c"), LIFTS).right
    assert judged(f"{sign}F = (m0 + m1) z'' = F − c z' − k z − (m0 + m1) g", LIFTS).status.name == "RIGHT"


def test_the_sign_of_a_sum_in_latex_may_be_part_of_a_name() -> None:
    answer = r"\[ \sum m\,\ddot z = F - c\dot z - k z - \sum m\,g,\qquad \sum m = m_0 + m_1 \]"
    assert judged(answer, LIFTS).status.name == "RIGHT"
    assert judged(answer.replace("m_0 + m_1", "m_1 + m_1"), LIFTS).status.name == "WRONG"


ROLLER = """
name = "roller"
[coordinates]
x = { description = "roller, to the right", unit = "m" }
[parameters]
m = "0.7 kg"
J = "0.7 kg*m^2"
a = { value = "0.7 m", description = "radius" }
c = "0.7 N*s/m"
[inputs]
F = "N"
[points]
P = ["x", "0"]
[[particle]]
mass = "m"
at = "P"
[[kinetic]]
value = "1/2*J*(x'/a)^2"
[[damper]]
b = "c"
deflection = "x"
[[force]]
value = "F"
deflection = "x"
"""


def test_an_article_is_no_length_and_what_follows_with_another_is_none() -> None:
    """The floor pushes with N and with a couple K: no word says that N is a."""
    answer = (
        "The floor pushes with N (to the left) and with a couple K:\nm x'' = F - c x' - N\nJ x''/a = N a + K\nK = 0\n"
    )
    answer += "together: (m + J/a^2) x'' = F - c x'"
    found = judged(answer, ROLLER)
    assert found.right and not any("as the words say" in str(note) for note in found.notes)
    assert not judged(answer.replace("F - c x'", "F + c x'"), ROLLER).right
    assert not judged(answer.replace("(m + J/a^2)", "(m - J/a^2)"), ROLLER).right
    assert judged("b is a here.\n(m + J/b^2) x'' = F - c x'", ROLLER).right


TABLE = """Reduced inertia

  wheel    | on its own axis      | J
  bar      | moves by l sin φ     | m d² sin² φ/4 = m l² sin² φ
  ------------------------------------------
  sum: I(φ)

V(φ) = m g l cos φ
Angular momentum-like quantity p = I(φ) φ̇, then
  ṗ = τ − c φ̇ + m g l sin φ + m l² φ̇² sin φ cos φ
"""


def test_the_rows_of_a_table_are_added_to_what_stands_below_it() -> None:
    found = judged(TABLE)
    assert found.right and any("was added to I" in str(note) for note in found.notes)
    assert judged(TABLE.replace("sum: I(φ)", "Total = I(φ)")).right
    assert judged(TABLE.replace("m d² sin² φ/4 = ", "")).status.name == "RIGHT"
    for old, new in (("| J", "| 2 J"), ("= m l²", "= 2 m l²"), ("+ m l² φ̇²", "− m l² φ̇²"), ("+ m g", "− m g")):
        assert judged(TABLE.replace(old, new)).status.name == "WRONG"


POWERS = """Power balance. w = φ̇ wheel, the bar moves with l sin φ w.
E = ½ I w², I = J + m l² sin² φ
I w' + m l² sin φ cos φ w² = τ − c w + m g l sin φ
"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize("words", ["wheel,", "of the wheel,", "crank, from the top;", "for the crank."])
def test_words_behind_a_rate_say_of_which_body_it_is(words: str) -> None:
    answer = POWERS.replace("wheel,", words)
    assert judged(answer).right
    for old, new in (("− c w", "+ c w"), ("w = φ̇", "w = 2 φ̇"), ("l² sin² φ", "l sin² φ")):
        assert judged(answer.replace(old, new)).status.name == "WRONG"


def test_other_words_behind_a_rate_may_change_it() -> None:
    with pytest.raises(lg.ParseError):
        judged(POWERS.replace("φ̇ wheel", "φ̇ twice"))


PENDULUM = """
name = "bob on a rod"
[coordinates]
phi = "rod, from the downward vertical"
[parameters]
m = "0.7 kg"
l = "0.7 m"
g = "9.81 m/s^2"
[inputs]
tau = "N*m"
[points]
B = ["l*sin(phi)", "-l*cos(phi)"]
[[particle]]
name = "bob"
mass = "m"
at = "B"
[[gravity]]
direction = [0, -1]
[[torque]]
value = "tau"
on = "phi"
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["γ1", "a_B", "aB", "a"])
@pytest.mark.parametrize("column", ["({} ; {})", "({}, {})", "[{}; {}]"])
def test_the_components_of_an_acceleration_are_no_list_of_equations(name: str, column: str) -> None:
    """γ1 = (… ; …) beside the equations says what an acceleration is, not that its components are zero."""
    components = column.format("l (φ̈ cos φ − φ̇² sin φ)", "l (φ̈ sin φ + φ̇² cos φ)")
    answer = f"accélérations : {name} = {components}\nPuissances :\nm l² φ̈ + m g l sin φ = τ"
    found = judged(answer, PENDULUM)
    assert found.right and [f.line.number for f in found.findings if not f.status.right] == []
    assert judged(answer.replace("+ m g l", "− m g l"), PENDULUM).status.name == "WRONG"


def test_a_list_of_expressions_with_the_name_of_equations_is_still_zero() -> None:
    assert judged("eqs = [m*l^2*phi'' + m*g*l*sin(phi) - tau, phi'' - phi'']", PENDULUM).right
    assert not judged("eqs = [m*l^2*phi'' - m*g*l*sin(phi) - tau, phi'' - phi'']", PENDULUM).right
