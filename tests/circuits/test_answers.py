"""Students' answers about circuits: right ones in other words, and the mistakes that belong to circuits."""

from __future__ import annotations

import pytest

import built_in

pytestmark = pytest.mark.slow

CIRCUIT = "(L_1 + L_0*(1 - tanh(q'/i_0)^2)/(1 + y/a))*q''{} + R*q' = u"
BY_POSITION = " - L_0*i_0*tanh(q'/i_0)*y'/(a*(1 + y/a)^2)"
BALL = "m*y'' + b*y' - m*g{} = 0"
PULL = " + L_0*i_0^2*log(cosh(q'/i_0))/(a*(1 + y/a)^2)"
PLATE = "L*q'' + R*q' + (d - x)*q/(epsilon*A) = u\nm*x'' + b*x' + k*x{} = 0"
MOTOR = "L*q'' + R*q' {} K*theta' = u\n(J + m*l^2)*theta'' + b*theta' + m*g*l*sin(theta) = {}"


def said(name: str, answer: str) -> str:
    return " ".join(str(built_in.derivation(name).check(answer)).split())


def test_right_answers_are_right() -> None:
    right = "\n".join((CIRCUIT.format(BY_POSITION), BALL.format(PULL)))
    assert built_in.derivation("magnetic-levitation").check(right).right
    assert built_in.derivation("dc-motor").check(MOTOR.format("+", "K*q'")).right
    assert built_in.derivation("capacitive-actuator").check(PLATE.format(" - q^2/(2*epsilon*A)")).right
    assert built_in.derivation("loudspeaker").check("u - Bl*x' - R*q' = L*q''\nBl*q' = m*x'' + b*x' + k*x").right


@pytest.mark.parametrize(
    ("name", "answer", "mistake"),
    [
        (
            "magnetic-levitation",
            "\n".join((CIRCUIT.format(""), BALL.format(PULL))),
            "The voltage of inductor 'coil' lacks the rate of its flux linkage by position.",
        ),
        (
            "magnetic-levitation",
            "\n".join((CIRCUIT.format(BY_POSITION), BALL.format(""))),
            "The force of inductor 'coil' on y is missing.",
        ),
        (
            "magnetic-levitation",
            "T = m*y'^2/2 + L_1*q'^2/2 + L_0/(1 + y/a)*(i_0*q'*tanh(q'/i_0) - i_0^2*log(cosh(q'/i_0)))",
            "Of inductor 'coil' the energy that is stored is in T*, not its co-energy.",
        ),
        (
            "magnetic-levitation",
            "T = m*y'^2/2 + L_1*q'^2/2 + L_0/(1 + y/a)*i_0*q'*tanh(q'/i_0)/2",
            "The co-energy of inductor 'coil' is taken as ½ψi",
        ),
        ("dc-motor", MOTOR.format("-", "K*q'"), "The reaction of transducer K on its current has the wrong sign."),
        ("capacitive-actuator", PLATE.format(""), "Capacitor 'plates' is missing in the equation of x."),
    ],
)
def test_mistakes_with_circuits_are_named(name: str, answer: str, mistake: str) -> None:
    assert mistake in said(name, answer)
