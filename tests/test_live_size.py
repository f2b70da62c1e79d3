"""What a live page weighs, and how it is packed."""

import base64
import re
from importlib import resources

import pytest
from sympy import cos, sin

import built_in
import lagrangian as lg
from lagrangian import live


def test_what_is_packed_is_read_in_the_digits_in_which_it_is_written() -> None:
    script = resources.files("lagrangian.write.interactive").joinpath("unpack.js").read_text(encoding="utf-8")
    digits = re.search(r'const digits = "(.*?)";', script)
    assert digits is not None
    numbers = [base64.b85encode(bytes([0, 0, 0, n])).decode()[-1] for n in range(85)]
    assert digits[1] == "".join(numbers).replace("<", ",")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["whipple-bicycle", "andrews-squeezer", "balancing-robot", "double-parallelogram"])
def test_the_largest_pages_are_below_150_kb(name: str) -> None:
    """So is every example's but that of the Stewart platform (203 kB)."""
    assert len(built_in.picture(name).to_html().encode()) < 150_000


def test_a_long_description_is_cut_below_the_name_and_whole_in_the_picture() -> None:
    system = lg.System("chain")
    at = system.origin
    for i in range(14):
        q = system.coordinate(f"q{i}")
        at = at + (0.1 * sin(q), -0.1 * cos(q))
        system.particle(1, at=at, name=f"number {i} of a long chain")
    words = live._subtitle(system.look().scene)
    assert len(words) < live.LONGEST_SUBTITLE + 3 and words.endswith(" …")
    assert system.look().scene.description.startswith(words.removesuffix(" …"))


def test_a_positive_coordinate_without_a_start_begins_as_it_is_drawn() -> None:
    system = lg.System("ball on a spring")
    r = system.coordinate("r", positive=True)
    theta = system.coordinate("theta")
    m, k, L = system.parameters("m k L", m="1 kg", k="10 N/m", L="0.8 m")
    system.particle(m, at=system.point("P", (r * sin(theta), -r * cos(theta))))
    system.spring(k, deflection=r - L)
    look = system.look()
    starts = live._starts(system.model, look.scene)
    assert starts == {"r": look.pose["r"]} and starts["r"] > 0
    assert live._module(system.model, look.program, (), starts).layout["start"] == [starts["r"], 0.0, 0.0, 0.0]
    with pytest.raises(lg.RunError, match="'r' is declared positive") as caught:
        system.simulate(1.0)
    assert caught.value.fix == "give a start above 0: initial={'r': 1}"
