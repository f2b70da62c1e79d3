"""Kinetic energies of several bodies together, or of one under another number: T_pair = …, T₂ = ….

Oracle: two equal wagons that are coupled, with a load on a spring between them; all energies by hand.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg


@cache
def train() -> lg.Derivation:
    """Two equal wagons in one, and a load that a spring holds to them."""
    s = lg.System("train")
    x, y = s.coordinates("x y")
    m, M, k = s.parameters("m M k")
    s.particle(m, at=s.point("A", (x, 0)), name="front wagon")
    s.particle(m, at=s.point("B", (x, 0)), name="rear wagon")
    s.particle(M, at=s.point("C", (x + y, 0)), name="load")
    s.spring(k, deflection=y, name="spring")
    return s.derive()


EQUATIONS = "\n(2 m + M) x'' + M y'' = 0\nM (x'' + y'') + k y = 0"


@pytest.mark.parametrize("name", ["T₁", "T_pair", "T_wagons"])
def test_the_energy_of_several_bodies_is_told_to_be_right(name: str) -> None:
    verdict = train().check(f"{name} = m x'^2{EQUATIONS}")
    told = verdict.to_text()
    assert verdict.right and "kinetic energy of particle 'front wagon' and particle 'rear wagon'" in " ".join(
        told.split()
    ), told
    assert "not judged" not in told
    wrong = train().check(f"{name} = m x'{EQUATIONS}").to_text()
    assert "kinetic energy of particle" not in wrong, wrong


def test_the_number_of_an_energy_is_that_of_a_part_of_the_answer() -> None:
    told = train().check(f"both wagons: T₁ = m x'^2\nthe rest: T₂ = 1/2 M (x' + y')^2{EQUATIONS}").to_text()
    assert "kinetic energy of particle 'load'" in told
    wrong = train().check(f"the rest: T₂ = 1/2 M (x' - y')^2{EQUATIONS}").to_text()
    assert "kinetic energy of particle 'load'" not in wrong


def test_an_energy_of_bodies_that_the_words_do_not_name_is_not_told() -> None:
    told = train().check(f"load: T_load = m x'^2{EQUATIONS}").to_text()
    assert "kinetic energy of particle 'front wagon' and" not in told
