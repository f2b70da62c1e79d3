"""Abbreviations of lengths beside constraints: they are no coordinates, and said twice they are constraints."""

from functools import cache

import pytest

from lagrangian import Derivation, System


@cache
def hoist() -> Derivation:
    """A collar on a pole, on a rope that runs over a ring to a damped drum."""
    sys = System("hoist")
    s, phi = sys.coordinates("s phi")
    m, J, r, d, length, c = sys.parameters("m J r d l c")
    g = sys.parameter("g")
    sys.kinetic((m * s.diff() ** 2 + J * phi.diff() ** 2) / 2)
    sys.potential(-m * g * s)
    sys.damper(c, deflection=phi)
    sys.torque(-sys.input("M"), on=phi)
    sys.constraint((s**2 + d**2) ** 0.5 - length - r * phi, name="rope")
    return sys.derive()


WITH_ROPE_FORCE = "m s'' = m g - S s/ρ\nJ φ'' = r S - c φ' - M\n"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("said", ["ρ = √(s² + d²) = l + r φ\n{}", "ρ = √(s² + d²)\n{}ρ = l + r φ"])
def test_a_length_in_two_ways_is_the_constraint(said: str) -> None:
    assert hoist().check(said.format(WITH_ROPE_FORCE), hint=0).right
    assert not hoist().check(said.replace("l + r", "l - r").format(WITH_ROPE_FORCE), hint=0).right
    assert not hoist().check(said.format(WITH_ROPE_FORCE.replace("r S", "S")), hint=0).right


SHEET = """ρ = √(s² + d²)
φ' = s s'/(r ρ)
{}∂L/∂s' = m s' + J s² s'/(r² ρ²)
Q_s = -M s/(r ρ) - c s² s'/(r² ρ²)
(m + J s²/(r² ρ²)) s'' + J s d² s'²/(r² ρ⁴) + c s² s'/(r² ρ²) - m g = -M s/(r ρ)"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("more", ["", "φ'' = s s''/(r ρ) + d² s'²/(r ρ³)\n"])
def test_an_abbreviation_is_no_coordinate_of_the_answers_own(more: str) -> None:
    sheet = SHEET.format(more)
    assert hoist().check(sheet, hint=0).right
    for right, wrong in (("-M s", "-M r s"), ("s' + J s²", "s' + J s"), ("d² s'²/", "s'²/")):
        assert right in sheet and not hoist().check(sheet.replace(right, wrong), hint=0).right


def test_a_check_gives_abbreviations_values_of_its_own_case() -> None:
    sheet = f"u = s/√(s² + d²)\n{WITH_ROPE_FORCE.replace('s/ρ', 'u')}r φ' = u s'\n"
    check = "Check d = 0: u = 1, u' = 0 → (m + J/r²) s'' = m g - M/r - c/r² s'. Plausible."
    assert hoist().check(sheet + check, hint=0).right
    assert not hoist().check(sheet.replace("- S u", "- S") + check, hint=0).right
