"""A damping matrix D, the fourth matrix of a state space and a damping ratio are no dissipation function.

Oracle: a mass on a spring and a damper by hand.
"""

from __future__ import annotations

import pytest
from small_systems import mass

EQUATION = "m x'' + b x' + k x = F"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "beside",
    [
        "D = [b];",
        "D = [0];",
        "D = b;",
        "D = b/(2 sqrt(k m))",
        "import numpy as np\nD = np.array([[b]])",
        "A = [0 1; -k/m -b/m]; B = [0; 1/m]; C = [1 0]; D = 0;",
        "D = b x'^2/2",
        "D = [b x'^2/2]",
    ],
)
@pytest.mark.parametrize("equation", [EQUATION, f"% {EQUATION}"])
def test_what_is_called_d_beside_a_right_equation(beside: str, equation: str) -> None:
    equation = equation.replace("%", "#") if "numpy" in beside else equation
    assert mass().check(f"{beside}\n{equation}").right
    assert not mass().check(f"{beside}\n{equation.replace('k x', '2 k x')}").right


@pytest.mark.parametrize("wrong", ["D = b x'^2", "D = [b x'^2]", "D = 0", "D = b x^2/2"])
def test_a_wrong_dissipation_function_is_wrong(wrong: str) -> None:
    assert not mass().check(f"{EQUATION}\n{wrong}").right


@pytest.mark.parametrize("wrong", ["D = b", "D = [0]"])
def test_a_constant_beside_energies_is_a_dissipation_function(wrong: str) -> None:
    assert not mass().check(f"T = m x'^2/2, V = k x^2/2, {wrong}").right
