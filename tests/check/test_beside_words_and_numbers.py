"""Names, numbers and definitions that stand beside the equations of an answer are read as what they are."""

import pytest

from lagrangian import loads
from lagrangian.derivation import Derivation

HOIST = """
name = "hoist"
[coordinates]
s = "m, load"
alpha = { description = "wheel", unit = "rad" }
[parameters]
M = { value = "5 kg" }
I = { value = "2 kg*m^2" }
a = { value = "0.3 m" }
k = { value = "400 N/m" }
b = { value = "7 N*m*s" }
g = { value = "9.81 m/s^2" }
[points]
P = ["0", "s"]
[[frame]]
name = "wheel"
angle = "alpha"
[[particle]]
name = "load"
mass = "M"
at = "P"
[[rigid_body]]
name = "wheel"
mass = "0"
inertia = "I"
at = "origin"
frame = "wheel"
[[gravity]]
direction = [0, -1]
g = "g"
[[spring]]
name = "rope"
k = "k"
deflection = "a*alpha - s"
[[damper]]
name = "bearing"
b = "b"
deflection = "alpha"
"""


@pytest.fixture(scope="module")
def hoist() -> Derivation:
    return loads(HOIST).derive()


ROWS = "M s'' + M g - k δ1 = 0\nI α'' + k a δ1 = -b α'"


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", ["Let δ1 = a α - s be the stretch.", "δ1 = a α - s", "δ_1 = a α - s"])
def test_a_delta_with_a_number_is_a_name(hoist: Derivation, said: str) -> None:
    energy = "L = 1/2 M s'^2 + 1/2 I α'^2 - M g s - 1/2 k δ1^2\nδW = -b α' δα"
    found = hoist.check(f"{said}\n{energy}\n{ROWS}".replace("δ1", "δ_1" if "_" in said else "δ1"))
    assert found.right
    assert not hoist.check(f"{said}\n{ROWS}".replace("= a α - s", "= a α + s").replace("_", "")).right
    wrong = hoist.check(f"{said}\n{energy}\n{ROWS}".replace("_", "").replace("k a δ1", "k δ1"))
    assert [f.status.value for f in wrong.findings][-1] == "wrong"


def test_a_wrong_deflection_is_told_in_one_sense(hoist: Derivation) -> None:
    lines = "e = s + a α\nV = M g s + 1/2 k e^2\nM s'' + M g + k e = 0\nI α'' + k a e = b α'"
    found = hoist.check(lines)
    told = [str(m.what) for m in found.mistakes]
    assert not found.right
    assert sum("deflection" in x for x in told) == 1
    assert any("Damper 'bearing'" in x for x in told)


def test_a_number_beside_equations_is_no_equation(hoist: Derivation) -> None:
    rows = "5 s'' + 49.05 + 400 s - 120 α = 0\n2 α'' + 36 α - 120 s + 7 α' = 0"
    assert hoist.check(f"sin 20° = 0.3420\n{rows}").right
    assert not hoist.check(f"sin 20° = 0.3420\n{rows}".replace("- 120 s", "- 60 s")).right
    assert not hoist.check(f"sin 20° = 0.9129\n{rows}").right
