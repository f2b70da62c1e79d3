"""Hamilton's canonical equations: momenta are held where H is differentiated, and may be told by the rates alone.

Oracle: those of the elastic pendulum, by hand. Every form has a wrong twin.
"""

from __future__ import annotations

import pytest

from built_in import derivation

MOMENTA = "p_r = m*r', p_theta = m*r^2*theta'\n"
H = "H = p_r^2/(2*m) + p_theta^2/(2*m*r^2) + k/2*(r - L_0)^2 - m*g*r*cos(theta)\n"
BY_H = "r' = ∂H/∂p_r = p_r/m\ntheta' = ∂H/∂p_theta = p_theta/(m*r^2)\n"
RATES = "r' = p_r/m\ntheta' = p_theta/(m*r^2)\n"
DERIVED = (
    "p_r' = -∂H/∂r = p_theta^2/(m*r^3) - k*(r - L_0) + m*g*cos(theta)\np_theta' = -∂H/∂theta = -m*g*r*sin(theta)\n"
)
ROWS = "p_r' = p_theta^2/(m*r^3) - k*(r - L_0) + m*g*cos(theta)\np_theta' = -m*g*r*sin(theta)\n"


@pytest.mark.parametrize("sheet", [MOMENTA + H + DERIVED, MOMENTA + H + BY_H + DERIVED, H + BY_H + ROWS, RATES + ROWS])
def test_canonical_equations_are_equations_of_motion(sheet: str) -> None:
    verdict = derivation("elastic-pendulum").check(sheet)
    assert verdict.right and "nothing else uses H" not in verdict.to_text()


@pytest.mark.slow
@pytest.mark.parametrize("sheet", [MOMENTA + H + DERIVED, RATES + ROWS])
def test_wrong_canonical_equations_stay_wrong(sheet: str) -> None:
    for now, wrong in (("p_theta^2/(m*r^3)", "-p_theta^2/(m*r^3)"), ("-m*g*r*sin", "m*g*r*sin")):
        assert now in sheet and not derivation("elastic-pendulum").check(sheet.replace(now, wrong), hint=0).right


def test_a_wrong_hamiltonian_is_found_by_its_derivatives() -> None:
    assert not derivation("elastic-pendulum").check(MOMENTA + H.replace("- m*g*r", "+ m*g*r") + DERIVED, hint=0).right
