"""What people type in plain text, and paste from programs, is read; what can mean two things is asked about.

Oracle: the equation of the pendulum, written in the grammar of model files.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError, System
from lagrangian.check.reading import parse_answer

SPELLINGS = [
    "m L^2 theta'' + b theta' + m g L sin theta = 0",
    "mL^2 θ'' + bθ' + mgLsinθ = 0",
    "mL²θ̈ + bθ̇ + mgL sin θ = 0",
    "½mL²θ̈ + ½ bθ̇ + ½mgL sinθ = 0",
    "mL²Lθ̈ + bLθ̇ + mgLL sinθ = 0",
    "mL^2theta'' + btheta' + mgLsin(theta) = 0",
    "L(mLθ'' + mg sin(θ)) + bθ' = 0",
    "θ'' + b/(mL^2) θ' + g/L sin theta = 0",
    "θ'' + b/mL^2 θ' + g/L sin(θ) = 0",
    "Eq(L**2*m*Derivative(theta(t), (t, 2)) + L*g*m*sin(theta(t)) + b*Derivative(theta(t), t), 0)",
    "eqs = [Eq(L**2*m*diff(theta(t), t, t) + L*g*m*sin(theta(t)),\n -b*diff(theta(t), t))]",
    "Matrix([[m*L^2]])*Matrix([theta'']) + b*theta' + m*g*L*sin(theta) = 0",
    "m.*L.^2.*diff(theta,t,2) + b.*diff(theta,t) ...\n + m.*g.*L.*sin(theta) == 0;",
    "{b*θ'[t] + L^2*m*θ''[t] + g*L*m*Sin[θ[t]] == 0}",
    "m L^2 D[θ[t], {t, 2}] + b D[θ[t], t] + m g L Sin[θ[t]] == 0",
    "m*L^2*θ'' = -b*θ' - m*g*L*SIN(θ)",
    "0,25*θ'' + 0,02*θ' + 4,905*sin(θ) = 0",
    "0.25 kg m^2 θ'' + 0.02 N m s θ' + 4.905 N m sin θ = 0",
    "m L^2 θ'' + b θ' + 9.81 m/s^2 m L sin θ = 0",
    "- m L^2 θ'' + b θ' + m g L sin θ = 0",
    "* T = 1/2 m L^2 θ'^2\n* V = -m g L cos θ\n* m L^2 θ'' + b θ' + m g L sin θ = 0",
    "**Solution:** m*L**2*theta'' + b*theta' + m*g*L*sin(theta) = 0",
    "## Answer\n```\nm*L**2*theta'' + b*theta' + m*g*L*sin(theta) = 0\n```",
    "T = 1/2 m L^2 θ'^2 ⇒ m L^2 θ'' + b θ' + m g L sin θ = 0",
    "T = 1/2mL^2θ'^2 and m L^2 θ'' = -b θ' - m g L cos θ tan θ",
    "m L² θ'' + b θ' = -m g L / csc θ",
    "m L² θ'' + b θ' = -m g L (1 - cos² θ) / √(sin²θ) * sin(θ)/abs(sin(θ))",
    'm L^2 θ" + b θ’ + m g L sin θ = 0',
    "𝑚 𝐿² θ̈ + 𝑏 θ̇ ＋ 𝑚 𝑔 𝐿 sin θ ＝ 0",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("written", SPELLINGS)
def test_one_equation_in_many_spellings_is_right(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right, verdict.to_text()


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("mL^2*theta'' + b*theta' + mgL*sin(theta) = 0", "mL as m L, mgL as m g L"),
        ("m*L^2*theta'' + b*theta' + m*g*L*sin theta * 1 = 0", "sin theta*… was read as sin(theta)"),
        ("- m L^2 θ'' + b θ' + m g L sin θ = 0", "as that of a list"),
        ("θ'' + b/m L^2 θ' + g/L sin(θ) = 0", "read in the other way"),
        ("0.25*θ'' + 0.02*θ' + 4.905 N m*sin(θ) = 0", "4.905 N m was read as 4.905"),
        ("0.25*θ'' + 0.02*θ' + 4905 mN m*sin(θ) = 0", "4905 mN m was read as 4.905"),
    ],
)
def test_how_it_was_read_is_told(written: str, said: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right and said in " ".join(map(str, verdict.notes)), verdict.to_text()


def test_a_word_of_two_readings_is_asked_about() -> None:
    s = System("words")
    x = s.coordinates("x")
    a, ab, _bc, c = s.parameters("a ab bc c")
    s.particle(a, at=s.origin + (x, 0))
    s.spring(ab * c, deflection=x)
    with pytest.raises(ParseError, match=r"can mean ab\*c or a\*bc") as caught:
        parse_answer("a x'' + abc x = 0", s.model)
    assert caught.value.place is not None and caught.value.place.column == 9
    assert not parse_answer("a x'' + ab c x = 0", s.model).notes


def test_a_name_is_not_split_again() -> None:
    answer = parse_answer("m1x1'' + k(x1 - x2) = -F", derivation("lecture-3a").model)
    assert answer.notes == ("Products without signs were read: m1x1 as m1 x1.",) and not answer.unknown


def test_all_places_that_cannot_be_read_are_told_at_once() -> None:
    with pytest.raises(ParseError) as caught:
        parse_answer("m*L*sinn(theta) = 0\nV = 2*foo bar\nm*L^2 + * 3 = 0", derivation("pendulum").model)
    errors = [caught.value, *caught.value.others]
    assert [(e.place.line, e.place.column) for e in errors if e.place is not None] == [(1, 5), (2, 11), (3, 9)]
    assert all(word in str(caught.value) for word in ("'sin'", "foo*bar", "operators"))
