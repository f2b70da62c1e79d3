"""What stands around equations on ordinary sheets, exercises, values, places where x is 0, and names of their own.

Oracle: the equations of a rocker on a spring and of two discs. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def rocker() -> lg.Derivation:
    """A weight on an arm that a spring and a damper hold; a force pushes its tip."""
    s = lg.System("rocker")
    theta = s.coordinate("theta")
    m, l, k, b, c, r, g = s.parameters("m l k b c r g", m=2, l=0.5, k=400, b=3, c=0.02, r=0.1, g=9.81)
    s.particle(m, at=s.point("P", (l * sp.sin(theta), l * sp.cos(theta))), name="weight")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=r * theta, name="spring")
    s.damper(b, deflection=r * theta, name="damper")
    s.damper(c, deflection=theta, name="bearing")
    s.force(s.input("F"), deflection=l * theta, name="push")
    return s.derive()


EQUATION = "(b r^2 + c) theta' + m l^2 theta'' + k r^2 theta - m g l sin theta = F l"
IN_NUMBERS = "0.5 theta'' + 0.05 theta' + 4 theta - 9.81 sin theta = 0.5 F"

NUMBERS = (
    "Exercise 3 c)   ",
    "Task 2b: ",
    "Aufgabe 1 a) ",
    "ii) ",
    "Problem 4 (b) ",
    "Exercise 2.1 b) ",
    "Ex 3 (c)   ",
    "HW 4 P2 b)   ",
    "Task 2 (ii)  ",
    "Frage 3 b) ",
    "Exercise 3 - ",
    "3 c) ",
    "Lösung zu Aufgabe 2 a): ",
    "Sheet 7, exercise 2: ",
)
"""What may stand in front of an equation and is no part of it."""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("number", NUMBERS)
def test_numbers_of_exercises_are_no_factors(number: str) -> None:
    assert rocker().check(number + EQUATION).right
    verdict = rocker().check(number + EQUATION.replace("m g l", "m g"))
    assert not verdict.right
    assert "m g" in verdict.to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("factor", ["2 ", "2 (b) ", "3 (c + b) ", "(b) ", "Exercise 3: 2 ", "Solution - (c) "])
def test_factors_in_front_of_an_equation_stay(factor: str) -> None:
    written = factor + "theta'' = 0"
    times = factor.partition(":")[2] or factor.partition("-")[2] or factor
    whole = f"{EQUATION.partition('=')[0]} - F l + {times} theta'' = 0"
    assert not rocker().check(whole).right
    assert not rocker().check(f"{EQUATION}\n{written}").right


LISTS = (
    "numbers: m = 2 kg, l = 0.5 m, b = 3 Ns/m, c = 0.02 Nms, theta = 0 at relaxed spring",
    "m = 2 kg, c = 0.02 Nms, k = 400 N/m, r = 10 cm; theta = 0 upright",
    "m = 2 kg, c = 0.02 Nms, theta = 0 with the spring relaxed",
    "theta = 0 for the relaxed spring, m = 2 kg, c = 0.02 Nms",
    "m=2kg, l=50cm, c=0.02Nms, theta = angle of the arm",
    "m l² = 0.5 kgm², c = 0.02 Nms, theta = 0 spring relaxed",
)
"""Values with units in one word, and places where the angle is 0."""


@pytest.mark.sampled(6)
@pytest.mark.parametrize("listed", LISTS)
def test_lists_of_values_may_end_in_words(listed: str) -> None:
    assert rocker().check(f"{listed}\n\n{IN_NUMBERS}").right
    for wrong in ("0.05", "9.81"):
        verdict = rocker().check(f"{listed}\n\n{IN_NUMBERS.replace(wrong, '0.7')}")
        assert not verdict.right
        assert "line 1, the equation" not in verdict.to_text()


@pytest.mark.parametrize("value", ["c = 0.03 Nms", "m = 3 kg, c = 0.02 Nms"])
def test_other_values_in_such_a_list_count(value: str) -> None:
    verdict = rocker().check(f"{value}, theta = 0 at relaxed spring\n\n{IN_NUMBERS}")
    assert not verdict.right
    assert f"With {value.partition(' k')[0].partition(' N')[0]}" in verdict.to_text()


def test_an_equation_of_rest_beside_a_relaxed_spring_is_judged() -> None:
    """A product that is 0 is no place where the angle is 0."""
    assert not rocker().check(f"spring relaxed: k theta = 0\n{EQUATION.replace('k r^2 theta', '0')}").right


@cache
def discs() -> lg.Derivation:
    """Two discs with a shaft between them; an arm of length l with a weight at a l is on the first one."""
    s = lg.System("two discs")
    alpha, beta = s.coordinates("alpha beta")
    J, b, e, k, a, l, F = s.parameters("J b e k a l F")
    s.kinetic(J * alpha.diff() ** 2 / 2, name="first disc")
    s.kinetic(b * e * beta.diff() ** 2 / 2, name="second disc")
    s.spring(k, deflection=alpha - beta, name="shaft")
    s.potential(F * a * l * sp.cos(alpha), name="weight")
    s.torque(s.input("M"), on=beta, name="motor")
    return s.derive()


SHORT = "J al'' + k (al - be) - F a l sin al = 0\nb e be'' - k (al - be) = M"


@pytest.mark.sampled(4)
@pytest.mark.parametrize("mark", ["'", "d", "_dot"])
def test_short_names_with_rates_are_no_products_of_constants(mark: str) -> None:
    """al'' is alpha'', though there are an a and an l, of which none moves."""
    twice = {"'": "''", "d": "dd", "_dot": "_ddot"}[mark]
    answer = SHORT.replace("''", twice)
    assert discs().check(answer).right
    assert discs().check(f"T = (J al{mark}^2 + b e be{mark}^2)/2\nV = k (al - be)^2/2 + F a l cos al\n{answer}").right
    assert not discs().check(answer.replace("k (al - be) -", "k (al + be) -")).right
    assert not discs().check(answer.replace("sin al", "sin be")).right


def test_short_names_without_rates_are_products() -> None:
    answer = "J alpha'' + k (alpha - beta) - F al sin alpha = 0\nbe beta'' - k (alpha - beta) = M"
    assert discs().check(answer).right
    assert not discs().check(answer.replace("F al", "F aa")).right


def test_momenta_and_slopes_by_short_names_are_read() -> None:
    lines = "dT/d al' = J al'\ndV/d al = k (al - be) - F a l sin al\nXi_be = M"
    energies = "T = (J al'^2 + b e be'^2)/2\nV = k (al - be)^2/2 + F a l cos al"
    assert discs().check(f"{energies}\n{lines}\n{SHORT}").right
    told = discs().check(f"{energies}\n{lines.replace('- F a l', '+ F a l')}\n{SHORT.replace('- F a l', '+ F a l')}")
    assert not told.right
    assert "line 4" in told.to_text()


PLACES = (
    r"Let $\psi$ be the angle to the level: $\psi=90^\circ$ up, $\psi=0$ level, i.e. $\theta=\frac{\pi}{2}-\psi$.",
    r"I use $\psi$ ($\psi = \pi/2$ when upright, $\psi = 0$ when level), so $\theta=\pi/2-\psi$.",
    r"Coordinate: $\psi=\frac\pi2-\theta\in[0,\frac{\pi}{2}]$.",
    r"$\theta=90^\circ-\psi$, where $\psi=0^\circ$ is level and $\psi=90^\circ$ upright.",
)
"""What is said of a coordinate of the answer's own, values of it among them."""
TURNED = (
    r"\[ml^2\ddot\psi+(br^2+c)\dot\psi-kr^2\left(\frac{\pi}{2}-\psi\right)+mgl\cos\psi=-Fl\]",
    r"\[ml^2\ddot\psi+(br^2+c)\dot\psi-kr^2\left(\frac{\pi}{2}-\psi\right)+mgl\cos\psi=Fl\]",
)


@pytest.mark.sampled(6)
@pytest.mark.parametrize("said", PLACES)
def test_values_of_an_own_coordinate_are_places(said: str) -> None:
    assert rocker().check(f"{said}\n{TURNED[0]}").right
    verdict = rocker().check(f"{said}\n{TURNED[1]}")
    assert not verdict.right
    assert "wrong sign" in verdict.to_text()
    assert "pi/180" not in verdict.to_text()


def test_values_of_an_own_coordinate_in_plain_text() -> None:
    said = "psi = 90 deg: upright, psi = 0: level, theta = pi/2 - psi"
    equation = "m l^2 psi'' + (b r^2 + c) psi' - k r^2 (pi/2 - psi) + m g l cos psi = -F l"
    assert rocker().check(f"{said}\n{equation}").right
    assert not rocker().check(f"{said}\n{equation.replace('cos', 'sin')}").right
    assert not rocker().check(f"{said.replace('pi/2 - ', '')}\n{equation}").right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("interval", ["∈ [0, pi/2]", "∈ (0; pi)", "∈ [0, 2 pi)"])
def test_intervals_are_no_statements(interval: str) -> None:
    equation = "m l^2 psi'' + (b r^2 + c) psi' - k r^2 (pi/2 - psi) + m g l cos psi = -F l"
    assert rocker().check(f"psi = pi/2 - theta {interval}\n{equation}").right
    assert not rocker().check(f"psi = pi - theta {interval}\n{equation}").right


MAILS = (
    "Hi, here is my solution. I used the length of rope that is wound up, u = r theta, instead of the angle:",
    "Hi Tom, I take u = r theta instead of the angle.",
    "Dear Ms Miller, below is my solution. Let u = r theta be the length that is paid out, and s no coordinate.",
    "hello! As coordinate I take what the rope has gone down, u = r theta.",
    "Instead of theta I use the way of the rope that goes up, u = r·theta, in metres.",
)
"""Sentences of mails that declare a coordinate."""


@pytest.mark.sampled(6)
@pytest.mark.parametrize("said", MAILS)
def test_an_own_coordinate_is_declared_in_a_mail(said: str) -> None:
    equation = "m l²/r² · u'' + (b + c/r²) u' + k u - (m g l/r) sin(u/r) = F l/r"
    assert rocker().check(f"{said}\n\n{equation}").right
    verdict = rocker().check(f"{said}\n\n{equation.replace('c/r²', 'c/r')}")
    assert not verdict.right
    assert "one divisor r is missing" in verdict.to_text()
    assert not rocker().check(f"{said.replace('r theta', 'l theta').replace('r·theta', 'l·theta')}\n\n{equation}").right


PROGRAM = '''import numpy as np

def rhs(t, s, p, M):
    """s = [alpha, beta, alpha', beta']; returns the time derivative"""
    al, be, wa, wb = s
    twist = p.k*(al - be)
    A = np.array([[p.J, 0],
                  [0,   p.b*p.e]])
    f = np.array([p.F*p.a*p.l*np.sin(al) - twist,
                  M + twist])
    acc = np.linalg.solve(A, f)
    return np.array([wa, wb, acc[0], acc[1]])
'''
"""Short names of the program's own that might be products of parameters, which are attributes of one argument."""
WRITTEN_OTHERWISE = (
    ("al, be, wa, wb = s", "[al, be, wa, wb] = s"),
    ("al, be, wa, wb = s", "(al, be), (wa, wb) = s[:2], s[2:]"),
    ("return np.array([wa, wb, acc[0], acc[1]])", "return np.concatenate(([wa, wb], acc))"),
    ("return np.array([wa, wb, acc[0], acc[1]])", "return [wa, wb, *acc]"),
    ("np.linalg.solve(A, f)", "np.linalg.inv(A) @ f"),
)


@pytest.mark.sampled(6)
@pytest.mark.parametrize(("old", "new"), [("import numpy", "import numpy"), *WRITTEN_OTHERWISE])
def test_a_state_with_short_names_of_its_own_is_read(old: str, new: str) -> None:
    assert old in PROGRAM
    program = PROGRAM.replace(old, new)
    assert discs().check(program).right
    for right, wrong in (("np.sin(al)", "np.cos(al)"), ("M + twist", "M - twist"), ("p.b*p.e", "p.b")):
        assert not discs().check(program.replace(right, wrong)).right
