"""What is no real number anywhere is said of its element, never as NaN; masses that digits do not hold are told."""

import pytest
import sympy as sp

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


def two_masses(small: float) -> lg.System:
    """A double pendulum whose lower mass is small."""
    s = lg.System("unlike")
    a, b = s.coordinates("a b")
    m1, m2 = s.parameters("m1 m2", m1=1.0, m2=small)
    upper = s.origin + (sp.sin(a), -sp.cos(a))
    s.particle(m1, at=upper)
    s.particle(m2, at=upper + (sp.sin(b), -sp.cos(b)))
    s.gravity((0, -1))
    return s


@pytest.mark.slow
def test_a_mass_of_a_picogramme_beside_a_kilogramme_is_no_trouble() -> None:
    s = two_masses(1e-12)
    assert not s.notices
    assert all(check.holds is not False for check in s.verify(states=3))


def test_a_mass_that_the_digits_of_another_hide_has_a_notice_with_what_helps() -> None:
    (notice,) = two_masses(1e-149).notices
    assert notice.code == "E109" and "'m2'" in notice.where
    assert "1e-149 kg beside 1 kg of" in notice.text and "more than 1e-13 kg" in notice.text
