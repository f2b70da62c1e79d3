"""A dissipation function that words call so, under the letters F and P; the pendulum's is D = ½ b θ̇²."""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian.check.reading import parse_answer

ROW = "m*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0"
LATEX = r"$m L^2\ddot\theta + b\dot\theta + m g L\sin\theta = 0$"


@pytest.mark.parametrize(
    ("said", "row"),
    [
        ("Rayleigh: P = (1/2) b theta'^2", ROW),
        ("Damping: P = 1/2 b theta'^2", ROW),
        ("with the dissipation function F = ½ b θ'², ∂F/∂θ' = b θ'", ROW),
        (r"Rayleigh: $\mathcal F=\tfrac12 b\dot\theta^2$.", LATEX),
    ],
)
def test_words_call_a_dissipation_function_so(said: str, row: str) -> None:
    checked = derivation("pendulum").check(f"{said}\n{row}")
    assert checked.right
    assert "(D)" in checked.to_text()
    wrong = derivation("pendulum").check(f"{said.replace(' b', ' m', 1)}\n{row}")
    assert "(D)   not right" in wrong.to_text()


@pytest.mark.parametrize(
    "said",
    [
        "Dissipated power: P = b theta'^2",
        "F = 1/2 b theta'^2",
        "With Rayleigh damping, F = b theta'",
        "Rayleigh: F = b theta'^2/2\nF*L = m*g*L",
    ],
)
def test_a_power_and_a_force_are_no_dissipation_function(said: str) -> None:
    assert not [x for x in parse_answer(f"{said}\n{ROW}", derivation("pendulum").model).lines if x.kind == "D"]
