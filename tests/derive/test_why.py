"""Why the equations hold: the constraint forces of textbooks, every equality checked, and a broken one noticed."""

from __future__ import annotations

import re
from dataclasses import replace
from math import cos, sin

import pytest
import sympy as sp

import lagrangian as lg
from built_in import CIRCUITS, LARGE, derivation
from lagrangian import examples
from lagrangian.derive import why
from lagrangian.derive.reasons.laws import AGREE, agree
from lagrangian.page.formula import text

NAMES = [n for n in examples.names() if n not in {"whipple-bicycle", "stewart-platform", *CIRCUITS}]
LECTURE = ("lecture-1", "lecture-2", "lecture-3a", "lecture-3b")


def vanishes(expr: sp.Expr) -> bool:
    return sp.simplify(sp.expand(expr)) == 0


def holds(found: lg.Why) -> bool:
    assert found.numbers is not None and found.numbers.digits >= AGREE
    return all(check.holds for check in found.checks)


# -- the lecture ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LECTURE)
def test_every_equality_of_the_lectures_examples_holds(name: str) -> None:
    assert holds(derivation(name).why)


@pytest.mark.parametrize(("name", "forces"), [("lecture-1", 1), ("lecture-2", 4), ("lecture-3a", 2), ("lecture-3b", 2)])
def test_free_bodies_need_two_equations_for_every_mass_of_the_lecture(name: str, forces: int) -> None:
    """2 equations for each of N masses in the plane, less one for every coordinate: the constraint forces."""
    d = derivation(name)
    counted = d.why.spared
    assert counted.equations == 2 * len(d.model.bodies)
    assert (counted.accelerations, counted.forces) == (len(d.coordinates), forces)


def test_the_carts_of_3b_pull_at_each_other_by_the_spring_alone() -> None:
    """The spring and the force act on the carts themselves: m ẍ = F + R leaves R = m₂ (ẍ₁ + ẍ₂ᵣ) + k x₂ᵣ − F on cart 2,
    and nothing across the track."""
    d = derivation("lecture-3b")
    s = d.model.symbols
    along, across = d.why.constraint_forces["m2"]
    assert across == 0
    a1, a2 = (c.acceleration for c in d.model.coordinates)
    assert vanishes(along - (s["m2"] * (a1 + a2) + s["k"] * s["x2r"] - s["F"]))


HOOP = """name = "hoop with a pendulum in it"
[coordinates]
x = "hub"
phi = "hoop, clockwise"
theta = "pendulum from the vertical"
[parameters]
M = "2 kg"
R = "0.3 m"
m = "0.5 kg"
l = "0.2 m"
b = "0.02 N*m*s"
[points]
H = ["x", "R"]
P = { from = "H", offset = ["l*sin(theta)", "-l*cos(theta)"] }
[[rigid_body]]
name = "hoop"
mass = "M"
inertia = "M*R^2"
at = "H"
frame = "-phi"
[[particle]]
name = "bob"
mass = "m"
at = "P"
[[damper]]
b = "b"
deflection = "phi + theta"
"""


def test_a_damper_between_a_body_and_a_rod_acts_on_both_and_only_what_moves_is_in_its_box() -> None:
    d = lg.loads(HOOP).derive()
    assert "Damper b acts, at one end at least, on a part without mass" in d.why.to_text(width=400)
    said = d.to_text(width=400)
    assert "In the box: rigid body 'hoop', particle 'bob'" in said and "outside the box" not in said
    assert "what turns with θ and rigid body 'hoop' do not turn when only x moves: it adds nothing" in said


SLOT = """name = "slot"
[coordinates]
psi = "lever"
s = "block along the slot"
[parameters]
m = "2 kg"
J = "0.3 kg*m^2"
[[rigid_body]]
name = "lever"
mass = "m"
inertia = "J"
at = ["0.1*cos(psi)", "0.1*sin(psi)"]
frame = "psi"
[[particle]]
name = "block"
mass = "m"
at = ["s*cos(psi)", "s*sin(psi)"]
"""


def test_a_length_along_a_lever_that_turns_is_relative_to_its_angle() -> None:
    assert "block along the slot; relative to ψ" in str(lg.loads(SLOT).derive())


def test_a_torque_on_a_lever_without_mass_is_passed_on_to_the_mass() -> None:
    text = derivation("lecture-1").why.to_text(width=400)
    assert "Spring k, damper b and torque τ act, at one end at least, on a part without mass" in text


# -- textbooks ------------------------------------------------------------------------------------------------------


def test_the_pull_of_a_pendulums_rod() -> None:
    """S = m g cos θ + m v²/L: javalab.org/en/pendulum_en, "Total tension applied to the string"."""
    d = derivation("pendulum")
    (theta,), s = d.coordinates, d.model.symbols
    x, y = d.why.constraint_forces["m"]
    rate = d.model.coordinates[0].rate
    pull = -x * sp.sin(theta) + y * sp.cos(theta)  # from the bob to the pivot
    assert vanishes(pull - s["m"] * (s["g"] * sp.cos(theta) + s["L"] * rate**2))
    said = d.why.to_text(width=400)
    assert "S = m L θ̇² + m g cos θ   (S is the pull of the rod, string or round track, towards the pivot at" in said
    assert "This one is the pull S." in said


def test_the_numbers_can_be_computed_again_from_what_the_page_says() -> None:
    """(R_x, R_y) from the state, the acceleration and the letters of the page."""
    said = derivation("pendulum").why.to_text(width=400).replace("−", "-").split("The same in numbers")[1]
    value = {a: float(x) for a, x in re.findall(r"(θ̇|θ̈|θ|m|L|g) = (-?\d+\.\d+)", said)}
    (pair,) = re.findall(r"Particle m +\((.+), (.+)\)", said)
    m, L, g, turn, rate, growth = (value[a] for a in ("m", "L", "g", "θ", "θ̇", "θ̈"))
    x = m * L * (growth * cos(turn) - rate**2 * sin(turn))
    y = m * L * (growth * sin(turn) + rate**2 * cos(turn)) + m * g
    assert (x, y) == pytest.approx((float(pair[0]), float(pair[1])), abs=1e-3)
    assert "in N·m if it is an angle" in said


def test_the_exception_to_forces_without_work_comes_first() -> None:
    said = derivation("pendulum").why.to_text(width=400).split("The constraint forces do no work\n")[1]
    assert said.index("First the exception") < said.index("the constraint forces vanish")


def test_the_string_of_atwoods_machine() -> None:
    """T₁ = m₁ (g − a), T₂ = m₂ (g + a), a = (m₁ − m₂) g/(m₁ + m₂ + J/R²): with a disc, J = m_p R²/2, the result of
    A. Duffy, "Atwood's machine re-visited" (Boston University, PY105).
    """
    d = derivation("atwood")
    s, c = d.model.symbols, d.model.coordinates[0]
    m1, m2, g = s["m1"], s["m2"], s["g"]
    a = (m1 - m2) * g / (m1 + m2 + s["J"] / s["R"] ** 2)
    (_, first), (_, second) = d.why.constraint_forces["m1"], d.why.constraint_forces["m2"]
    assert vanishes(first.subs(c.acceleration, a) - m1 * (g - a))
    assert vanishes(second.subs(c.acceleration, a) - m2 * (g + a))


def incline() -> lg.System:
    """A block that slides down a smooth slope."""
    s = lg.System("block")
    x = s.coordinate("x")
    m, alpha = s.parameter("m"), s.parameter("alpha")
    s.particle(m, at=s.origin + (x * sp.cos(alpha), -x * sp.sin(alpha)), name="block")
    s.gravity((0, -1))
    return s


def test_a_slope_pushes_with_the_weights_part_across_it() -> None:
    """N = m g cos α, the part of the weight across the slope: learn.padho.ai/wiki/rolling-on-inclines…"""
    d = incline().derive()
    s = d.model.symbols
    x, y = d.why.constraint_forces["block"]
    push = x * sp.sin(s["alpha"]) + y * sp.cos(s["alpha"])
    assert vanishes(push - s["m"] * s["g"] * sp.cos(s["alpha"]))
    assert "N = m g cos α   (across its path: the push of the track)" in d.why.to_text()


def test_what_holds_a_rolling_cylinder_back() -> None:
    """Friction J a/R² up the slope with a = g sin α/(1 + J/(m R²)): dudung.github.io/blog/0017, and its moment."""
    d = derivation("rolling-cylinder")
    s, c = d.model.symbols, d.model.coordinates[0]
    x, y = d.why.constraint_forces["cylinder"]
    down = x * sp.cos(s["alpha"]) - y * sp.sin(s["alpha"])
    a = s["g"] * sp.sin(s["alpha"]) / (1 + s["J"] / (s["m"] * s["R"] ** 2))
    assert vanishes(down.subs(c.acceleration, a) + s["J"] * a / s["R"] ** 2)
    assert "at rest at every instant" in d.why.to_text(width=200)


def test_the_multiplier_of_a_rod_is_its_push() -> None:
    """A pendulum in x and y: R is λ along the rod, the same force as in the angle."""
    n = derivation("rod-pendulum").why.numbers
    assert n is not None
    ((x, y),) = n.reactions
    assert abs(abs(n.multipliers[0]) ** 2 - x**2 - y**2) < 1e-20
    (wiggle,) = n.wiggles
    assert abs(sum(a * b for a, b in zip((x, y), wiggle, strict=True))) < 1e-20


# -- breaking it ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "noticed"),
    [
        ({"T": 2}, "(7) and (8) hold"),
        ({"V": 2}, "(10) holds"),
        ({"Xi": 2}, "what is left is Xi"),
    ],
)
def test_a_wrong_energy_or_force_is_noticed(change: dict[str, int], noticed: str) -> None:
    """Twice the energy, or the force, is not that of the masses: exactly, and in the numbers."""
    d = derivation("pendulum")
    (name,) = change
    value = getattr(d, name)
    wrong = {q: 2 * x for q, x in value.items()} if name == "Xi" else 2 * value
    found = why(replace(d, **{name: wrong}))
    failed = [str(check.what) for check in found.checks if check.holds is False]
    assert any(noticed in words for words in failed)
    assert any("F = ma" in words for words in failed)


def test_a_force_that_is_forgotten_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the weight among the loads, its work is no longer −∂V/∂ξ, and the rest is no equation of motion."""
    from lagrangian.derive.reasons import page as room

    whole = room.applied_loads
    monkeypatch.setattr(room, "applied_loads", lambda c, m: replace(whole(c, m), loads=()))
    failed = [str(check.what) for check in why(derivation("pendulum")).checks if check.holds is False]
    assert any("(10)" in words for words in failed) and any("the sum is" in words for words in failed)


def test_what_normal_forms_do_not_decide_is_decided_by_digits() -> None:
    """tan θ cos θ = sin θ, and tan θ ≠ sin θ."""
    d = derivation("pendulum")
    context, (theta,) = d.shares.context, d.coordinates
    tangent, sine = context.form(sp.tan(theta)), context.form(sp.sin(theta))
    same = agree(context, text("the same"), [(tangent * context.form(sp.cos(theta)), sine)])
    assert same.holds and "50 digits" in same.figure
    assert agree(context, text("another"), [(tangent, sine)]).holds is False


@pytest.mark.slow
def test_a_large_system_has_sums_and_checks_but_no_lines_for_each_mass() -> None:
    s, last = lg.System("chain of springs"), sp.S.Zero
    k = s.parameter("k")
    for i in range(11):
        x = s.coordinate(f"x{i}")
        s.particle(s.parameter(f"m{i}"), at=s.origin + (x, 0))
        s.spring(k, deflection=x - last)
        last = x
    found = s.derive().why
    assert holds(found) and (found.spared.equations, found.spared.forces) == (22, 11)
    assert "There are 11 bodies" in found.to_text() and found.to_text().count("\n") < 130


# -- every system ---------------------------------------------------------------------------------------------------


def test_a_support_that_moves_does_no_virtual_work() -> None:
    found = derivation("kapitza-pendulum").why
    assert holds(found)
    assert "A support moves as prescribed" in found.to_text()
    assert "A support moves" not in derivation("pendulum").why.to_text()


def test_energies_alone_have_no_masses() -> None:
    s = lg.System("energies")
    q = s.coordinate("q")
    s.kinetic(s.parameter("m") * q.diff(s.t) ** 2 / 2)
    d = s.derive()
    with pytest.raises(lg.ModelError, match="no F = ma"):
        _ = d.why
    assert d.reasoning is None and "--why shows the reason" not in d.to_text()


@pytest.mark.slow
def test_a_motor_in_space_turns_one_body_and_pushes_back_on_the_other() -> None:
    """τ on θ₁ turns the arm, b₂ acts between arm and pendulum: Γ of the pendulum about its hinge is J₂ θ̈₂ + b₂ θ̇₂ and
    the gyroscopic part −(J₂ − A₂) θ̇₁² sin θ₂ cos θ₂ (Euler's equations for a body with ω = (θ̇₂, θ̇₁ s, θ̇₁ c)).
    """
    d = derivation("furuta-pendulum")
    s = d.model.symbols
    c1, c2 = d.model.coordinates
    J, A, theta = s["J2"], s["A2"], s["theta2"]
    moment, _, _ = d.why.constraint_moments["pendulum"]
    euler = J * c2.acceleration - (J - A) * c1.rate**2 * sp.sin(theta) * sp.cos(theta)
    assert vanishes(moment - euler - s["b2"] * c2.rate)
    assert "no mass" not in d.why.to_text()


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ("bead-on-hoop", "segway", "wheel-on-incline"))
def test_the_page_of_other_systems(name: str) -> None:
    found = derivation(name).why
    assert holds(found)
    assert "F = ma" in found.to_markdown()


@pytest.mark.thinned(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", [n for n in NAMES if n not in LARGE or n == "andrews-squeezer"])
def test_every_example_has_its_page_in_every_format(name: str) -> None:
    found = derivation(name).why
    assert all(check.holds for check in found.checks)
    assert found.to_text(width=40) and found.to_latex(notation="physics") and found.to_markdown(notation="robotics")
    assert found.to_html().count("<h2>") >= len(found.parts)
    assert found.to_dict()["checks"]


def test_every_step_leads_to_the_page() -> None:
    d = derivation("pendulum")
    html = d.to_html()
    for number in range(7):
        step = html.split(f'id="step-{number}"')[1].split("</section>")[0]
        anchor = step.split('class="see"><a href="#')[1].split('"')[0]
        assert f'id="{anchor}"' in html
    assert d.to_text().count("--why shows the reason") == 7
    assert "--why" not in d.to_text(brief=True)


@pytest.mark.parametrize(("name", "free"), [("lecture-3a", 2), ("lecture-3b", 2), ("pendulum", 0)])
def test_where_nothing_holds_a_mass_its_force_is_said_to_be_0(name: str, free: int) -> None:
    assert derivation(name).why.to_text().count("Nothing holds it along x: there R is 0") == free
