"""Answers for systems with constraints by Newton's laws with forces between bodies, and with constraints put in."""

from __future__ import annotations

from functools import cache

import pytest

from lagrangian import Derivation, System
from size import rest_slow

NEWTON = """H is the friction of the floor on the wheel, to the left; A is the force of the axle on the box.
m x'' = F - H - A
J phi'' = R H
M x'' = A - k x
x'' = R phi''
(M + m + J/R^2) x'' + k x = F"""
ENERGIES = """phi = x/R
T = 1/2 (M + m) x'^2 + 1/2 J phi'^2
V = 1/2 k x^2
L = T - V
d/dt(dL/dx') - dL/dx = F"""


@cache
def wheel() -> Derivation:
    """A wheel that rolls and pushes a box on a spring."""
    sys = System("wheel with a box")
    x, phi = sys.coordinates("x phi")
    M, m, J, R, k = sys.parameters("M m J R k")
    F = sys.input("F")
    axle = sys.point("axle", (x, R))
    body = sys.rigid_body(m, J, at=axle, frame=sys.frame(-phi), name="wheel")
    sys.particle(M, at=axle, name="box")
    sys.spring(k, deflection=x)
    sys.force((F, 0), at=axle)
    sys.rolling(body, at=sys.point("contact", (x, 0)), along=(1, 0))
    return sys.derive()


@pytest.mark.parametrize("last", [True, False])
def test_a_force_of_an_axle_is_none_of_the_constraint(last: bool) -> None:
    answer = NEWTON if last else NEWTON.rpartition("\n")[0]
    assert wheel().check(answer, hint=0).right
    assert wheel().check(answer.replace("F - H - A", "F + H - A").replace("R H", "-R H"), hint=0).right


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("F - H - A", "F + H - A"),
        ("F - H - A", "F - H + A"),
        ("= R H", "= H"),
        ("A - k x", "A + k x"),
        ("m x''", "2 m x''"),
        ("J/R^2", "J/R"),
    ],
)
def test_no_force_between_bodies_takes_up_a_mistake(right: str, wrong: str) -> None:
    assert right in NEWTON and not wheel().check(NEWTON.replace(right, wrong), hint=0).right


@pytest.mark.slow
def test_a_force_that_leaves_nothing_but_the_constraint_is_judged() -> None:
    """m r″ = S without −m r θ̇² and S + m r″ = 0 agree, and the motion is right; the tension S is not."""
    sys = System("puck on a string")
    r, theta = sys.coordinates("r theta")
    m, M, l, k = sys.parameters("m M l k")
    sys.kinetic(m * (r.diff() ** 2 + r**2 * theta.diff() ** 2) / 2 + M * l**2 * theta.diff() ** 2 / 2)
    sys.spring(k, deflection=theta)
    sys.constraint(r - l, name="string")
    turning = "m r^2 theta'' + 2 m r r' theta' + B = 0\nM l^2 theta'' = B - k theta\nr = l"
    assert sys.derive().check(f"m r'' - m r theta'^2 = -S\nS - m l theta'^2 = 0\n{turning}", hint=0).right
    assert not sys.derive().check(f"m r'' = -S\nS + m r'' = 0\n{turning}", hint=0).right
    together = "(m r^2 + M l^2) theta'' + 2 m r r' theta' + k theta = 0\nr = l"
    assert sys.derive().check(f"m r'' - m r theta'^2 = -S\n{together}", hint=0).right
    assert not sys.derive().check(f"m r'' = -S\n{together}", hint=0).right  # S would be 0


@pytest.mark.slow
def test_a_force_in_the_equation_of_one_coordinate_alone_is_none_of_a_constraint_between_two() -> None:
    """The friction S of the floor on a rolling cart is no force P of the rod between cart and collar."""
    sys = System("cart, rod and collar")
    x, y = sys.coordinates("x y")
    m, J, R, M, l, k, g = sys.parameters("m J R M l k g")
    sys.kinetic((m + J / R**2) * x.diff() ** 2 / 2 + M * y.diff() ** 2 / 2)
    sys.spring(k, deflection=x)
    sys.potential(M * g * y)
    sys.constraint(x**2 + y**2 - l**2, name="rod")
    right = "J x''/R = S R\nm x'' = -k x - S + P x/l\nM y'' = -M g + P y/l\nx^2 + y^2 = l^2"
    assert sys.derive().check(right, hint=0).right
    results = "(m + J/R^2) x'' + k x = -P x/l\nM y'' + M g = P y/l"
    verdict = sys.derive().check(right.replace("+ P x", "- P x").replace("\nx^2", f"\n{results}\nx^2"))
    assert not verdict.right
    said = " ".join(str(m.what) for m in verdict.mistakes)
    assert "multiplier P" in said and "wrong sign" in said and "S" not in said, said
    assert all(f.status.right for f in verdict.findings if f.line.number == 1)


TWINS = {"phi = x/R": "phi = 2 x/R", "1/2 J": "J", "1/2 k x^2": "k x^2", "= F": "= -F"}


@pytest.mark.parametrize("right", rest_slow(TWINS, {"phi = x/R"}))
def test_wrong_energies_into_which_a_coordinate_is_put_are_wrong(right: str) -> None:
    assert right in ENERGIES and not wheel().check(ENERGIES.replace(right, TWINS[right]), hint=0).right


@pytest.mark.slow
def test_a_coordinate_may_be_put_in_before_an_energy_is_differentiated() -> None:
    verdict = wheel().check(ENERGIES)
    assert verdict.right and any("put into its energies" in str(note) for note in verdict.notes)
    assert not wheel().check(f"{ENERGIES}\n(M + m) x'' + k x = F", hint=0).right


BESIDE = """Forces: H is a force of the floor, A of the axle.
   box: M acc = A - k x      acc = x''
   m x'' = F - H - A
   J phi'' = R H
   x'' = R phi''"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["acc", "ab", "ax"])
def test_a_name_is_defined_behind_a_gap_and_is_no_product_with_an_article(name: str) -> None:
    answer = BESIDE.replace("acc", name)
    assert wheel().check(answer, hint=0).right
    assert not wheel().check(answer.replace(f"{name} = x''", f"{name} = 2 x''"), hint=0).right
    assert not wheel().check(answer.replace("A - k x", "A + k x"), hint=0).right
