"""What is told of a wrong answer is true of what stands in it: in V, in ℒ, in the rate of a name, in derivatives."""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer, check_answer


@cache
def hatch() -> lg.Derivation:
    """A hatch with a gas spring, whose length has a name."""
    s = lg.System("hatch")
    phi = s.coordinate("phi")
    m, J, e, p, q, k, n, b = s.parameters("m J e p q k n b")
    G = s.point("G", (e * sp.cos(phi), e * sp.sin(phi)))
    s.rigid_body(mass=m, inertia=J, at=G, frame=s.frame(phi, name="hatch"), name="hatch")
    z = s.define("z", sp.sqrt(p**2 + q**2 - 2 * p * q * sp.cos(phi)))
    s.gravity((0, -1))
    s.spring(k, deflection=z, rest=n, name="gas spring")
    s.damper(b, deflection=z, name="oil")
    return s.derive()


T = "T = 1/2 (J + m e^2) phi'^2\n"
D = "D = 1/2 b (p q sin(phi)/z)^2 phi'^2\n"
LEFT = "(J + m e^2) phi'' + m g e cos(phi)"
RIGHT = f"{LEFT} + (k (z - n) + b p q sin(phi)/z phi') p q sin(phi)/z = 0"


def judged(answer: str) -> CheckedAnswer:
    """The verdict on a wrong answer."""
    verdict = check_answer(hatch(), answer)
    assert not verdict.right
    return verdict


def told(answer: str) -> list[str]:
    """What is said to be wrong in an answer."""
    return [str(m.what) for m in judged(answer).mistakes]


def test_the_right_answer_is_right() -> None:
    assert check_answer(hatch(), RIGHT).right
    assert check_answer(hatch(), f"{T}V = m g e sin(phi) + 1/2 k (z - n)^2\n{D}").right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("energy", ["1/2 k z^2 - 1/2 k n^2", "1/2 k (z^2 + n^2)", "k/2 z^2 + k n^2/2"])
def test_a_rest_length_that_is_squared_alone_is_not_missing(energy: str) -> None:
    """What is missing is the double product."""
    verdict = judged(f"{T}V = m g e sin(phi) + {energy}\n{D}")
    assert not any("rest length" in str(m.what) for m in verdict.mistakes)
    assert "(a − b)²" in str(verdict.mistakes[0].why)


def test_a_rest_length_that_is_nowhere_is_missing() -> None:
    assert told(f"{T}V = m g e sin(phi) + 1/2 k z^2\n{D}") == ["The rest length n of spring 'gas spring' is missing."]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("weight", ["V1 = m g e sin(phi)\n", "Vg = m g e sin(phi)\n"])
@pytest.mark.parametrize("spring", ["V2 = 1/2 k (z - n)^2\n", "Vf = k (z - n)^2/2\n"])
def test_a_sign_that_is_wrong_in_the_lagrangian_alone_is_told_of_it(weight: str, spring: str) -> None:
    answer = f"{T}{weight}{spring}L = 1/2 (J + m e^2) phi'^2 - m g e sin(phi) + 1/2 k (z - n)^2\n{D}"
    verdict = judged(answer)
    assert [(str(m.what), m.step) for m in verdict.mistakes] == [
        (
            "Not above, where it is right, but in line 4 (L): the energy of spring 'gas spring' has the wrong sign.",
            4,
        )
    ]


def test_a_sign_that_is_wrong_in_the_potential_energy_is_told_of_that() -> None:
    said = told(f"{T}V = m g e sin(phi) - 1/2 k (z - n)^2\n{D}")
    assert said == ["The energy of spring 'gas spring' has the wrong sign in V."]


@pytest.mark.parametrize("rate", ["p q sin(phi) phi'/(2 z)", "2 p q sin(phi)/z phi'"])
def test_an_equation_with_a_rate_that_is_said_wrongly_is_not_right(rate: str) -> None:
    answer = f"z' = {rate}\nF = k (z - n) + b z'\n{LEFT} + F p q sin(phi)/z = 0"
    verdict = judged(answer)
    assert not verdict.motion
    assert [(f.line.number, f.is_open) for f in verdict.findings if not f.status.right] == [(1, True), (3, False)]
    assert told(answer)[0].startswith("Line 1 is not right: the rate of z is ")


def test_an_equation_with_a_rate_that_is_said_rightly_is_right() -> None:
    assert check_answer(hatch(), f"z' = p q sin(phi) phi'/z\n{LEFT} + (k (z - n) + b z') p q sin(phi)/z = 0").right


@pytest.mark.slow
def test_derivatives_of_energies_in_a_wrong_length_follow() -> None:
    answer = (
        "z = sqrt(p^2 + q^2 - p q cos(phi))\nV = m g e sin(phi) + 1/2 k (z - n)^2\n"
        "dV/dphi = m g e cos(phi) + k (z - n) p q sin(phi)/(2 z)"
    )
    found = {f.line.number: f.is_open for f in judged(answer).findings if not f.status.right}
    assert found == {1: True, 2: False, 3: False}
    wrong = judged(answer.replace("/(2 z)", "/(3 z)"))
    assert [f.line.number for f in wrong.open_findings] == [1, 3]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("gloss", ["      (dz/dphi)", "\t(dz/dphi)", "    (= dz/dphi)"])
def test_a_derivative_in_a_column_of_its_own_says_what_a_name_is(gloss: str) -> None:
    answer = f"w = p q sin(phi)/z{gloss}\n{LEFT} + k (z - n) w + b w^2 phi' = 0"
    assert check_answer(hatch(), answer).right
    assert told(answer.replace("(J + m e^2)", "J")) == ["½mv² of rigid body 'hatch' is missing."]


def test_a_derivative_in_brackets_that_is_multiplied_stays() -> None:
    assert check_answer(hatch(), f"Q = -(k (z - n) + b z') (dz/dphi)\n{LEFT} = Q").right


@pytest.mark.slow
@pytest.mark.parametrize("sine", ["sin(beta) = q sin(phi)/z", "sin beta = q sin(phi)/z"])
def test_the_sine_of_an_angle_is_told_as_it_is_written(sine: str) -> None:
    answer = f"S = k (z - n) + b p q sin(phi)/z phi'\n{sine}\n{LEFT} - S p sin(beta) = 0"
    assert check_answer(hatch(), answer.replace("- S", "+ S")).right
    shown = str(judged(answer).to_text())
    assert "sin(beta)" in shown or "sin β" in shown
    assert not any(x in shown for x in ("p β", "β²"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("arm", "wrong"),
    [
        ("sin(beta) = q sin(phi)/z", "sin(beta) = p sin(phi)/z"),
        ("sin(beta) = q sin(phi)/z", "sin(beta) = q cos(phi)/z"),
        ("u = q sin(phi)/z", "u = p sin(phi)/z"),
    ],
)
def test_a_line_is_not_blamed_that_is_right_with_the_right_arm(arm: str, wrong: str) -> None:
    name = arm.partition(" =")[0]
    answer = f"S = k (z - n) + b p q sin(phi)/z phi'\n{{}}\n{LEFT} + S p {name} = 0"
    assert check_answer(hatch(), answer.format(arm)).right
    verdict = judged(answer.format(wrong))
    assert [f.line.number for f in verdict.open_findings] == [2]
    said = [str(m.what) for m in verdict.mistakes]
    assert len(said) == 1 and said[0].startswith(f"Line 2 is not right: the value of {name} is q*sin(phi)/z, not "), (
        said
    )


def test_a_determinant_is_to_blame_and_not_what_is_divided_by_it() -> None:
    """With right sides that have names, too, which are no forces."""
    s = lg.System("two carts")
    x, y = s.coordinates("x y")
    m, n, k = s.parameters("m n k")
    s.particle(m, at=s.point("A", (x, 0)), name="cart")
    s.particle(n, at=s.point("B", (x + y, 0)), name="rider")
    s.spring(k, deflection=y, name="spring")
    answer = (
        "A = m + n, B = n, C = n\nA x'' + B y'' = f1\nB x'' + C y'' = f2\nf1 = 0\nf2 = -k y\n"
        "D = A C {} B^2\nx'' = (C f1 - B f2)/D\ny'' = (A f2 - B f1)/D"
    )
    assert check_answer(s.derive(), answer.format("-")).right
    verdict = check_answer(s.derive(), answer.format("+"))
    assert [f.line.number for f in verdict.open_findings] == [6]
    assert all("Line 6" in str(m.what) for m in verdict.mistakes)
