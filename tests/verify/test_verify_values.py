"""What is no real number anywhere is said of its element, never shown as NaN."""

import pytest

import lagrangian as lg
from lagrangian import ModelError

MODEL = """
name = "unreal"
[coordinates]
q = ""
[parameters]
m = 1
c = 0.3
[[particle]]
mass = "m"
at = ["q", "0"]
[[potential]]
value = "VALUE"
"""


def test_a_constant_of_the_energy_that_is_not_real_is_named() -> None:
    """acosh(c) stands in no equation of motion: only V has no value."""
    checks = lg.loads(MODEL.replace("VALUE", "acosh(c) + q^2")).verify(states=3)
    failed = [c for c in checks if not c.holds]
    assert len(failed) == 1 and "nan" not in failed[0].figure
    assert "potential 1 has no finite real value with the values that parameters have" in failed[0].figure


@pytest.mark.parametrize("value", ["acosh(c - 5) + q^2", "acosh(sin(c)/5)*q^2", "acosh(c)*q^2"])
def test_an_energy_that_is_nowhere_real_is_refused_by_its_element(value: str) -> None:
    with pytest.raises(ModelError, match="potential 1 has no finite real value") as caught:
        lg.loads(MODEL.replace("VALUE", value)).verify(states=3)
    assert caught.value.code == "E503" and caught.value.fix
