"""The words and values of variants stay true; the oracles are the model file, and what a move does to a deflection."""

from __future__ import annotations

import re
from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import Damper, Spring
from lagrangian.worksheet.dice import Dice
from lagrangian.worksheet.directions import turned_words
from lagrangian.worksheet.letters import new_letters, new_values, parameter_letters, relabelled
from lagrangian.worksheet.sides import moves, turns
from lagrangian.worksheet.variant import variant_of
from lagrangian.worksheet.worded import claims, formulas, relations, still_true, typeset, values_of

SEEDS = range(100, 106)

ROD = """name = "rod on a trolley"
[coordinates]
s = "trolley, down the slope from where the spring is relaxed"
beta = "rod, from the downward vertical"
[parameters]
m1 = { value = "2 kg", description = "trolley" }
m2 = { value = "0.3 kg", description = "rod" }
h = { value = "0.4 m", description = "axle to the rod's middle" }
I1 = { value = "0.016 kg*m^2", description = "rod, m2*(2*h)^2/12 about its middle" }
k = { value = "90 N/m", description = "spring" }
c = { value = "3 N*s/m", description = "damper of the trolley" }
w = { value = "0.8 m", description = "length of the rod, w = 2*h" }
alpha = "15 deg"
g = "9.81 m/s^2"
[inputs]
P = "N, pulls the trolley up the slope"
[points]
A = ["s*cos(alpha)", "-s*sin(alpha)"]
B = { from = "A", offset = ["h*sin(beta)", "-h*cos(beta)"] }
[[frame]]
name = "R"
angle = "beta"
origin = "A"
[[particle]]
name = "trolley"
mass = "m1"
at = "A"
[[rigid_body]]
name = "rod"
mass = "m2"
inertia = "I1"
at = "B"
frame = "R"
[[gravity]]
direction = [0, -1]
[[spring]]
k = "k"
deflection = "s"
[[damper]]
name = "brake"
b = "c"
deflection = "s"
[[force]]
value = "-P"
deflection = "s"
"""


@cache
def rod() -> lg.System:
    return lg.loads(ROD)


@cache
def variant(seed: int) -> lg.Worksheet:
    return rod().worksheet(seed=seed)


def described(parameter: str, words: str) -> lg.System:
    """The system with another description of a letter."""
    return lg.loads(re.sub(rf'(?m)^({parameter} = .*description = )"[^"]*"', rf'\1"{words}"', ROD))


def flat(sheet: lg.Worksheet) -> str:
    return " ".join(sheet.question().split())


@pytest.mark.slow
def test_values_that_a_description_derives_follow_the_others() -> None:
    model = rod().model
    m, h, inertia, w = (next(p.symbol for p in model.parameters if p.name == n) for n in ("m2", "h", "I1", "w"))
    assert relations(model) == {inertia: m * h**2 / 3, w: 2 * h}
    for seed in SEEDS:
        drawn = new_values(model, Dice(seed))
        m2, half, about, long_ = (float(drawn[n] or 0) for n in ("m2", "h", "I1", "w"))
        assert about == pytest.approx(m2 * half**2 / 3, rel=1e-3) and long_ == pytest.approx(2 * half)
        made = variant(seed)
        assert [c.holds for c in made.verify() if "formulas" in str(c.what)] == [True], made.to_toml()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("words", "held"),
    [
        ("rod, m2*(2*h)^2/12", True),
        ("rod, m2*h^2/12", False),
        ("rod, I1 = m2*h^2/2", False),
        ("= m2*h^2/2", False),
        ("rod, m2*h^2/2 where it is a ring", None),
        ("rod, m2*h^2/2 of a thin disc", None),
        ("rod, less than m2*h^2", None),
        ("rod, I1 < m2*h^2", None),
        ("rod, turned by g/h", None),
    ],
)
def test_verification_finds_a_formula_that_contradicts_the_values(words: str, held: bool | None) -> None:
    """A condition claims nothing, nor does a formula of another unit; w = 2 h holds in all of them."""
    checks = [c for c in described("I1", words).worksheet().verify() if "formulas" in str(c.what)]
    assert [c.holds for c in checks] == [held is not False]
    assert checks[0].figure.startswith({True: "2 formulas", None: "1 formula", False: "I1 = "}[held])


def test_what_other_values_make_untrue_is_left_out() -> None:
    model = rod().model
    h, w = (next(p for p in model.parameters if p.name == n) for n in ("h", "w"))
    old = values_of(model)
    new = {**old, h.symbol: 0.6, w.symbol: 1.2}
    assert still_true(model, w, "length, w = 2*h", new) == "length, w = 2*h"
    assert still_true(model, w, "length, w = 3*h", new) == "length"
    assert still_true(model, w, "length, twice 0.4 m", new) == "length"
    assert still_true(model, w, "length, on a table of 3 m", new) == "length, on a table of 3 m"
    assert still_true(model, w, "length, w = 0.8", new) == "length"
    assert still_true(model, w, "the rod is y = w*s^2", new) == "the rod is y = w*s^2"
    assert still_true(model, w, "length, w = 3*h", old) == "length, w = 3*h"


def test_formulas_in_words_are_found_and_set_as_formulas() -> None:
    model = rod().model

    def found(words: str) -> list[str]:
        return [words[f.start : f.end] for f in formulas(model, words)]

    assert found("rod, m2*(2*h)^2/12 about its middle") == ["m2*(2*h)^2/12"]
    assert found("above sqrt(g/h) it tips, alpha = 0") == ["sqrt(g/h)", "alpha"]
    assert found("3 h, in the s-h plane, N/h") == []
    assert found("nothing (h + ) here ^2") == ["h"]
    assert found("h*" * 300) == []
    parts = typeset(model, "rod, m2*h^2/3 about h")
    assert [str(p) for p in parts] == ["rod, ", "h**2*m2/3", " about ", "h"]
    assert "m2*" not in flat(rod().worksheet()) and "about its middle" in flat(rod().worksheet())


def test_a_claim_of_a_letter_needs_its_unit() -> None:
    model = rod().model
    inertia = next(p for p in model.parameters if p.name == "I1")
    assert [str(c.right) for c in claims(model, inertia, "rod, m2*h^2")] == ["h**2*m2"]
    assert not [*claims(model, inertia, "rod, m2*h")]


@pytest.mark.parametrize("seed", SEEDS)
def test_nobody_is_told_of_a_spring_where_it_was(seed: int) -> None:
    """The words about the spring stand only where it still has the trolley's coordinate as its extension."""
    made = variant(seed)
    spring = next(e for e in made.model.elements if isinstance(e, Spring))
    slope, turn = made.model.coordinates
    assert isinstance(spring.deflection, sp.Expr)
    assert ("relaxed" in slope.description) == spring.deflection.has(slope.symbol), slope.description
    assert "slope" in slope.description and "relaxed" not in turn.description
    damper = next(e for e in made.model.elements if isinstance(e, Damper))
    stands = damper.deflection is not None and damper.deflection.has(slope.symbol)
    assert stands == ("damper of the trolley" in flat(made)) == (damper.name == "brake")
    assert made.substantial and not made.reason


def test_an_element_in_a_hinge_has_the_unit_of_a_hinge() -> None:
    there = next(m for m in moves(rod().model) if m.what == "damper 'brake' is on beta")
    assert there.units == {"c": ("N*m*s/rad", pytest.approx(3 * 0.4**2))}
    assert there.described == {"c": ""}


def test_words_that_a_move_would_make_untrue_forbid_it_or_go() -> None:
    def described_moves(words: str) -> dict[str, object]:
        return {m.what: m.described for m in moves(lg.loads(words).model)}

    there = "spring 'k' is on beta"
    assert described_moves(ROD)[there] == {"s": "trolley, down the slope", "k": ""}
    assert described_moves(ROD.replace("rod on a trolley", "trolley on a spring"))[there] is None
    assert described_moves(ROD.replace('"axle to the rod\'s middle"', '"length of the spring"'))[there] is None
    said = ROD.replace('"rod, from the downward vertical"', '"rod, from the downward vertical: turns the spring"')
    still = {"s": "trolley, down the slope", "beta": "rod, from the downward vertical", "k": ""}
    assert described_moves(said)[there] == still


def test_a_spring_that_moves_takes_its_words_with_it() -> None:
    """Of two carts, x2r is the stretch of the spring only as long as the spring is between them."""
    model = lg.example("lecture-3b").model
    said = {m.what: m.described for m in moves(model)}
    ground = said["spring 'k' is between particle 'm2' and the ground"]
    assert ground == {"x1": "cart 1", "x2r": "cart 2, relative to cart 1", "k": ""}
    first = said["spring 'k' is on x1"]
    assert first == {"x2r": "cart 2, relative to cart 1", "k": ""}


def test_an_arm_keeps_the_index_of_its_element() -> None:
    """No arm L_k belongs to the damper: the two do not exchange their places, and the index follows the letter."""
    model = lg.example("lecture-1").model
    assert all(m.described is None for m in moves(model) if "exchanged" in m.what)
    for seed in SEEDS:
        names = parameter_letters(model, Dice(seed, 3))
        assert {names[f"L_{n}"].partition("_")[2] == names[n] for n in "mkb"} == {True}


def test_no_letter_misleads() -> None:
    for seed in range(20):
        names = parameter_letters(rod().model, Dice(seed))
        assert names["k"] in ("k", "kappa")  # c was the damper
        assert names["m1"] == "M1" and names["h"] in ("l", "a", "d")
        both = new_letters([("M", ("m", "M")), ("m", ("m", "M"))], ["t"], Dice(seed))
        assert both == {"M": "m", "m": "M"}
        found = new_letters([("k", ("k", "c")), ("J_c", ("J", "Theta"))], [], Dice(seed))
        assert found["k"] == "k"
        two = new_letters([("L_0", ("a", "d")), ("b", ("b", "d"))], [], Dice(seed))
        assert two["L_0"][0] != two["b"], "one letter for a length and a damping"


def test_constants_of_nature_keep_their_values() -> None:
    model = lg.example("capacitive-actuator").model
    kept = [p.name for p in model.parameters if all(new_values(model, Dice(seed))[p.name] == p.value for seed in SEEDS)]
    assert kept == ["epsilon"]


@pytest.mark.slow
def test_no_two_forces_act_at_one_place() -> None:
    """The hoist of the crane pulls at the rope, not at the trolley beside the drive."""
    for seed in range(1, 5):
        made = variant_of(lg.example("crane").model, seed)
        assert "force 'hoist' is on x" not in made.changes


def test_axes_are_no_letters() -> None:
    assert relabelled("axle, along x; heading about z", {"x": "s", "z": "u"}) == "axle, along x; heading about z"
    assert relabelled("moves by x", {"x": "s"}) == "moves by s"


@pytest.mark.parametrize(
    ("words", "turned"),
    [
        ("drum, clockwise", "drum, counter-clockwise"),
        ("block, down the slope from where it rests", "block, up the slope from where it rests"),
        ("load, downwards", "load, upwards"),
        ("bob, to the right of the pivot", "bob, to the left of the pivot"),
        ("pole, from upright, positive where it leans forward", "pole, from upright, positive where it leans backward"),
        ("rod, from hanging straight down", None),
        ("left wheel", None),
        ("cart, up and to the right, downward", None),
        ("pushes the shaft down, out of link 2", None),
    ],
)
def test_a_direction_is_turned_round_where_there_is_one(words: str, turned: str | None) -> None:
    assert turned_words(words) == turned


def test_a_force_the_other_way_round_is_told() -> None:
    sheet = flat(rod().worksheet())
    assert "Force P is positive in the sense in which s falls." in sheet
    found = [variant(seed) for seed in SEEDS if any("other way round" in c for c in variant(seed).changes)]
    assert found and all(re.search(r"positive in the sense in which \w+ (?:grows|falls)", flat(made)) for made in found)


def test_words_of_a_force_that_acts_the_other_way_round_keep_what_is_no_direction() -> None:
    def words(name: str) -> list[dict[str, str]]:
        return [dict(m.described or {}) for m in turns(lg.example(name).model)]

    assert words("duffing") == [{"F_0": "strength of the force", "omega": "how often it comes and goes"}]
    assert words("cart-pole") == [{"F": "pushes the cart backward"}]
    assert words("two-carts") == [{"F": ""}]  # apart
    assert {"F_h": ""} in words("crane")  # pull of the hoist


def test_a_drag_stays_a_drag() -> None:
    """A force that depends on the velocity does not act the other way round."""
    model = lg.example("planar-quadrotor").model
    assert [m.what for m in turns(model)] == [f"force '{n}' acts the other way round" for n in ("F1", "F2")]


def test_why_nothing_is_elsewhere_is_told() -> None:
    made = lg.example("double-pendulum").worksheet(seed=1)
    assert not made.substantial and "no force, torque, spring or damper" in made.reason
    assert made.to_dict()["reason"] == made.reason
    assert len(made.changes) > 1, "its coordinates are measured in another way"


TWO = """name = "two weights"
[coordinates]
x = "weight"
[parameters]
m = "1 kg"
k = "9 N/m"
[[particle]]
name = "upper"
mass = "m"
at = ["0", "x"]
[[particle]]
name = "lower"
mass = "m"
at = ["0", "x - 1"]
[[spring]]
k = "k"
deflection = "x"
"""


def test_a_letter_of_two_elements_is_explained_by_both() -> None:
    assert "mass of particle 'upper' and particle 'lower'" in flat(lg.loads(TWO).worksheet())
    named = TWO.replace('m = "1 kg"', 'm = { value = "1 kg", description = "upper" }')
    assert "upper (mass); also mass of particle 'lower'" in flat(lg.loads(named).worksheet())
    each = TWO.replace('m = "1 kg"', 'm = { value = "1 kg", description = "a weight" }')
    assert "a weight (mass) 1 kg" in flat(lg.loads(each).worksheet())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cart-pole", "wedge", "lecture-3a"])
def test_seeds_differ_in_more_than_one_way(name: str) -> None:
    model = lg.example(name).model
    found = {tuple(c for c in variant_of(model, seed).changes if "'" in c) for seed in range(100, 108)}
    assert len(found) > 2, found
