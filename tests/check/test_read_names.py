"""Right answers in names of the answer's own: speeds, solved forms, inputs, implicit definitions, values of parameters.

Oracle: the equations of the built-in examples, rewritten by hand; every wrong twin differs in one number.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError
from lagrangian.check import Status

OWN = "-b/(m*L^2)*{w} - g/L*sin({q})"
LEVER = "m*L_m^2*theta'' + b*L_b^2*theta' + k*L_k^2*theta + m*g*L_m*sin(theta)"
SHAFT = "p'' = (tau - b*(p' - q') - k*(p - q))/J1\nq'' = (b*(p' - q') - b_load*q' + k*(p - q))/J2"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("name", "answer", "said"),
    [
        ("pendulum", "omega = theta'\nomega' = " + OWN.format(w="omega", q="theta"), ""),
        ("pendulum", "theta' = w\nw' = " + OWN.format(w="w", q="theta"), ""),
        ("pendulum", "w_dot = " + OWN.format(w="w", q="theta") + "\nw = theta_dot", ""),
        ("pendulum", "x1 = theta\nx2 = theta'\nx1' = x2\nx2' = " + OWN.format(w="x2", q="x1"), ""),
        ("pendulum", "x1' = x2\nx2' = " + OWN.format(w="x2", q="x1"), "with x1 = theta"),
        ("pendulum", "omega' = " + OWN.format(w="omega", q="theta"), "'omega' was read as theta'."),
        ("pendulum", f"[theta'; w'] = [w; {OWN.format(w='w', q='theta')}]", ""),
        ("pendulum", "phi'' = " + OWN.format(w="phi'", q="phi"), "with phi = theta"),
        ("lecture-3b", "x'' = (k*s - F)/m1\ns'' = F/m2 + F/m1 - k*s/m1 - k*s/m2", "with s = x2r, x = x1"),
        ("two-disk-shaft", SHAFT, "with p = phi1, q = phi2"),
        ("lecture-3b", "m1*x1'' - k*x2r = -u\nm2*(x1'' + x2r'') + k*x2r = u", "'u' was read as F."),
        ("lecture-3b", "f = k*x2r - m1*x1''\nm2*(x1'' + x2r'') + k*x2r = f", "'f' was read as F."),
        ("pendulum", "2*zeta*wn = b/(m*L^2)\ntheta'' + 2*zeta*wn*theta' + g/L*sin(theta) = 0", ""),
        ("pendulum", "theta'' + 2*zeta*w*theta' + w^2*sin(theta) = 0\nw^2 = g/L\n2*zeta*w = b/(m*L^2)", ""),
        ("rolling-cylinder", "J = m*R^2/2\n3/2*m*x'' = m*g*sin(alpha)", "Right if J = R^2*m/2."),
        ("rolling-cylinder", "m*R^2/2 = J\n(m + J/R^2)*x'' = m*g*sin(alpha)", "Right if J = R^2*m/2."),
        ("pendulum", "L = 2\nm*4*theta'' + b*theta' + 2*m*g*sin(theta) = 0", "Right if L = 2."),
        ("pendulum", "g = 9.81\nm*L^2*theta'' + b*theta' + 9.81*m*L*sin(theta) = 0", ""),
        ("lecture-1", LEVER + " = T", "'T' was read as tau."),
        ("pendulum", "m*L^2*thdd + b*thd + m*g*L*sin(theta) = 0", "'thd' was read as theta'."),
        ("pendulum", "m*L^2*th_ddot + b*th_dot + m*g*L*sin(th) = 0", "'th' was read as theta."),
    ],
)  # fmt: skip
def test_names_of_the_answers_own_are_read_and_told(name: str, answer: str, said: str) -> None:
    verdict = derivation(name).check(answer)
    assert verdict.right, verdict.to_text()
    assert said in " ".join(map(str, verdict.notes))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("pendulum", "omega = theta'\nomega' = -b/(m*L)*omega - g/L*sin(theta)"),
        ("pendulum", "phi'' = -b/(m*L)*phi' - g/L*sin(phi)"),
        ("lecture-3b", "m1*x1'' - k*x2r = -u\nm2*(x1'' + x2r'') + 2*k*x2r = u"),
        ("lecture-3b", "u = k*x2r - m1*x1''\nm2*(x1'' + x2r'') + 2*k*x2r = u"),
        ("pendulum", "2*zeta*wn = b/(m*L)\ntheta'' + 2*zeta*wn*theta' + g/L*sin(theta) = 0"),
        ("pendulum", "theta'' + zeta*w*theta' + w^2*sin(theta) = 0\nw^2 = g/L\n2*zeta*w = b/(m*L^2)"),
        ("rolling-cylinder", "J = m*R^2/2\n2*m*x'' = m*g*sin(alpha)"),
        ("rolling-cylinder", "J = 0\nm*x'' = m*g*sin(alpha)"),
        ("pendulum", "b = 0\nm*L^2*theta'' + m*g*L*sin(theta) = 0"),
        ("lecture-1", LEVER + " = 2*T"),
    ],
)
def test_a_wrong_equation_in_names_of_the_answers_own_is_wrong(name: str, answer: str) -> None:
    assert derivation(name).check(answer, hint=0).status is Status.WRONG


def test_a_force_that_is_used_is_a_definition_where_enough_equations_remain() -> None:
    verdict = derivation("lecture-3b").check("N = m1*x1''\nk*x2r - N = F\nm2*(x1'' + x2r'') + k*x2r = F")
    assert verdict.right and len(verdict.findings) == 2


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("force", "right"), [("tau", True), ("-tau", False), ("2*tau", False)])
def test_a_generalized_force_may_have_a_shortened_coordinate(force: str, right: bool) -> None:
    verdict = derivation("lecture-1").check(f"Xi_th = {force}\n{LEVER} = {force}")
    assert verdict.right is right
    assert [f.status.right for f in verdict.findings if f.line.kind == "Xi"] == [right]


@pytest.mark.parametrize(
    ("name", "answer", "fix"),
    [
        ("pendulum", "m*L^2*vdd + m*g*L*sin(theta) = 0", "theta''"),
        ("lecture-3a", "m1*xdd + k*(x1 - x2) = -F", "x1'' or x2''"),
    ],
)
def test_a_rate_of_nothing_or_of_several_cannot_be_read(name: str, answer: str, fix: str) -> None:
    with pytest.raises(ParseError, match="cannot be read") as caught:
        derivation(name).check(answer)
    assert fix in str(caught.value.fix)
