"""What acts on a mass and what holds it: loads on bodies, every holder of a mass, and what Lagrange spares."""

from __future__ import annotations

from typing import cast

import pytest
import sympy as sp

import lagrangian as lg
from built_in import CIRCUITS, LARGE, SOME, SPACE, derivation
from lagrangian import examples
from lagrangian.derive.reasons.held import holds
from lagrangian.derive.reasons.holding import Holding
from lagrangian.derive.reasons.loads import applied_loads
from lagrangian.derive.reasons.motion import moving


def vanishes(expr: sp.Expr) -> bool:
    return sp.simplify(sp.expand(expr)) == 0


def part(found: lg.Why, number: int) -> str:
    """The text of a part of the page in one line."""
    return " ".join(str(item) for item in found.parts[number].items)


# -- loads ----------------------------------------------------------------------------------------------------------

WINCH = """name = "winch"
[coordinates]
psi = "{sense}"
z = "bucket, downwards"
[parameters]
I = "0.3 kg*m^2"
M = "4 kg"
m = "2 kg"
r = "0.2 m"
k = "900 N/m"
d = "0.1 N*m*s"
[inputs]
Q = "N*m"
[[rigid_body]]
name = "wheel"
mass = "M"
inertia = "I"
at = [0, 0]
frame = "{angle}"
[[particle]]
name = "bucket"
mass = "m"
at = ["r", "-z"]
[[spring]]
name = "cable"
k = "k"
deflection = "z - r*psi"
[[damper]]
name = "axle"
b = "d"
deflection = "psi"
[[torque]]
name = "motor"
value = "Q"
on = "psi"
"""


@pytest.mark.parametrize(("sense", "angle", "sign"), [("counter-clockwise", "psi", 1), ("clockwise", "-psi", -1)])
def test_a_torque_acts_on_a_body_whichever_way_its_angle_is_counted(sense: str, angle: str, sign: int) -> None:
    """By hand: I ψ̈ = Q − d ψ̇ + r k (z − r ψ) about the axle; what the cable does is not described as a load."""
    d = lg.loads(WINCH.format(sense=sense, angle=angle)).derive()
    s, psi = d.model.symbols, d.model.coordinates[0]
    (moment,) = d.why.constraint_moments["wheel"]
    assert vanishes(moment - sign * (s["I"] * psi.acceleration + s["d"] * psi.rate - s["Q"]))
    said = part(d.why, 0)
    assert "without mass" not in said and "damper 'axle' and torque 'motor' act on it" in said.replace(
        "Damper", "damper"
    )
    assert "Spring 'cable' is described by how far it is stretched or turned." in said
    assert all(check.holds for check in d.why.checks)


def test_a_force_along_a_slide_on_a_body_that_turns_pushes_back_on_it() -> None:
    """A tool on an arm that turns with α: the force P on s pushes the tool outward, and the arm back through the tool's
    place, beside its centre of mass: about that the arm feels P c, with c the offset of the slide."""
    s = lg.System("tool on an arm")
    alpha, x, c, P = s.coordinate("alpha"), s.coordinate("s"), s.parameter("c"), s.input("P")
    arm = s.frame(alpha)
    s.rigid_body(s.parameter("M"), s.parameter("J"), at=s.origin, frame=arm, name="arm")
    s.particle(s.parameter("m"), at=arm.point(x, c), name="tool")
    s.force(P, deflection=x)
    why = s.derive().why
    assert "without mass" not in part(why, 0)
    J, turn = s.model.symbols["J"], s.model.coordinates[0].acceleration
    (moment,) = why.constraint_moments["arm"]
    assert vanishes(moment - (J * turn - P * c))
    assert all(check.holds for check in why.checks)


def test_an_energy_does_not_say_on_which_masses_it_acts() -> None:
    s = lg.System("field")
    x = s.coordinate("x")
    s.particle(s.parameter("m"), at=s.origin + (x, 0), name="bead")
    s.potential(s.parameter("c") * x**4, name="field")
    why = s.derive().why
    assert "described by an energy or a generalized force" in part(why, 0) and "without mass" not in part(why, 0)
    assert all(check.holds for check in why.checks)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ("lecture-1", "lecture-2", "pendulum"))
def test_a_lever_without_mass_is_called_so(name: str) -> None:
    assert "at one end at least, on a part without mass" in part(derivation(name).why, 0)


# -- holders --------------------------------------------------------------------------------------------------------


def holders(d: lg.Derivation) -> tuple[Holding, ...]:
    context = d.shares.context
    context.algebra.renew()
    parts = moving(context)
    return holds(context, parts, applied_loads(context, parts), d.shares.rows)


def held(name: str) -> set[tuple[str, ...]]:
    """Every holder of an example: its kind, and the bodies that it holds."""
    return {(h.kind, *sorted(b.name for b in h.bodies)) for h in holders(derivation(name))}


def test_what_carries_another_mass_is_held_by_that_too() -> None:
    """By hand: a wedge M on a floor carries a block m on its slope. The block is pushed by N₂ = m g cos α + m ẍ sin α,
    and the floor carries both: N₁ = (M + m) g − m s̈ sin α."""
    d = derivation("wedge")
    s, x, t = d.model.symbols, *d.model.coordinates
    floor, slope = holders(d)
    assert (floor.kind, slope.kind) == ("track", "track")
    assert floor.force is not None and slope.force is not None
    g, alpha = s["g"], s["alpha"]
    assert vanishes(slope.force.expr() - s["m"] * (g * sp.cos(alpha) + x.acceleration * sp.sin(alpha)))
    assert vanishes(floor.force.expr() - (s["M"] + s["m"]) * g + s["m"] * t.acceleration * sp.sin(alpha))
    said = part(d.why, 0)
    assert "Held by: a straight track (push_1); particle 'block', which slides on it (push_2, in the opposite" in said
    assert "R_1 is the sum of their forces" in said and "R_2 is its force" in said


def test_a_slider_with_a_pendulum_is_held_by_its_rod_too() -> None:
    """By hand: across the slope N = (M + m) g cos β + m l (ψ̈ sin(β + ψ) + ψ̇² cos(β + ψ))."""
    s = lg.System("slider")
    u, psi = s.coordinate("u"), s.coordinate("psi")
    M, m, length, beta = (s.parameter(x) for x in ("M", "m", "l", "beta"))
    hook = s.origin + (u * sp.cos(beta), -u * sp.sin(beta))
    s.particle(M, at=hook, name="slider")
    s.particle(m, at=hook + (length * sp.sin(psi), -length * sp.cos(psi)), name="bob")
    s.gravity((0, -1))
    s.torque(s.input("Q"), on=psi)
    d = s.derive()
    track, rod = holders(d)
    (_, turn), g = d.model.coordinates, d.model.symbols["g"]
    swing = turn.acceleration * sp.sin(beta + psi) + turn.rate**2 * sp.cos(beta + psi)
    assert track.force is not None and rod.named and [b.name for b in rod.bodies] == ["bob", "slider"]
    assert vanishes(track.force.expr() - (M + m) * g * sp.cos(beta) - m * length * swing)
    assert "Held by: a straight track (push_1); a rod, a string or a round track to particle 'bob' (pull_2)" in part(
        d.why, 0
    )


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("atwood", {("track", "m1"), ("track", "m2"), ("pin", "pulley"), ("tie", "m1", "m2", "pulley")}),
        ("swinging-atwood", {("track", "M"), ("tie", "M", "m")}),
        ("bead-on-parabola", {("tie", "m")}),
        ("bead-on-hoop", {("rod", "m"), ("tie", "m")}),
        ("lecture-2", {("rod", "m1"), ("rod", "m1", "m2"), ("rod", "m2", "m3"), ("lever", "m1", "m2")}),
        ("lecture-3b", {("track", "m1"), ("track", "m2")}),
        ("crane", {("track", "trolley")}),
        ("ball-and-beam", {("rolling", "ball", "beam"), ("pin", "beam")}),
        ("four-bar", {("pin", "crank"), ("pin", "rocker"), ("pin", "coupler", "crank"),
                      ("constraint", "coupler", "rocker")}),
        ("wheel-on-incline", {("track", "wheel"), ("constraint", "wheel")}),
        ("ladder", {("constraint", "ladder")}),
        ("car", {("pin", "car", "steered wheels"), ("constraint", "car"), ("constraint", "steered wheels")}),
        ("robot-arm", {("pin", "waist"), ("pin", "upper arm", "waist"), ("pin", "forearm", "upper arm")}),
        ("elastic-pendulum", set()),
    ],
)  # fmt: skip
def test_every_holder_is_found(name: str, expected: set[tuple[str, ...]]) -> None:
    assert held(name) == expected


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", [n for n in SOME if n not in SPACE])
def test_what_is_told_of_a_holder_is_all_that_holds_the_masses_on_it(name: str) -> None:
    """The R of all that hang on a rod or a track is its force alone, in the numbers, where nothing else holds them; and
    what nothing holds feels R = 0."""
    d = derivation(name)
    found, n = holders(d), d.why.numbers
    assert n is not None
    context = d.shares.context
    forces = {m.body: R for m, R in zip(moving(context), n.reactions, strict=True) if not m.turning}
    passed = applied_loads(context, moving(context)).passed
    for body, R in forces.items():
        assert passed or any(body in h.bodies for h in found) or all(abs(x) < 1e-20 for x in R)
    ties = {b for h in found if h.kind in ("tie", "lever") for b in h.bodies}
    for hold in found:
        if hold.along and hold.branch and not passed and not ties & set(hold.branch):
            e = [d.model.expand(x.expr(), constants=True).xreplace(dict(n.state)) for x in hold.along]
            values = [cast("sp.Expr", x) for x in e]
            R = [sum(forces[b][i] for b in hold.branch) for i in range(2)]
            across = values[0] * R[1] - values[1] * R[0]
            assert abs(sp.N(across, 30)) < 1e-12


def test_a_mass_in_a_slot_of_a_lever_is_pushed_by_coriolis() -> None:
    """N = m (s ψ̈ + 2 ṡ ψ̇) across a radial slot without gravity, from polar coordinates."""
    s = lg.System("slot")
    psi, r = s.coordinate("psi"), s.coordinate("r")
    m, lever = s.parameter("m"), s.frame(psi)
    s.rigid_body(s.parameter("M"), s.parameter("J"), at=s.origin, frame=lever, name="lever")
    s.particle(m, at=lever.point(r, 0), name="bead")
    d = s.derive()
    slot = next(h for h in holders(d) if h.body.name == "bead")
    turn, out = d.model.coordinates
    assert slot.carrier is not None and slot.carrier.name == "lever" and slot.force is not None
    assert vanishes(slot.force.expr() - m * (r * turn.acceleration + 2 * out.rate * turn.rate))


# -- what is spared -------------------------------------------------------------------------------------------------

NAMES = [n for n in examples.names() if n not in {*LARGE, *CIRCUITS}]


@pytest.mark.sampled(16)
@pytest.mark.parametrize("name", NAMES)
def test_both_ways_have_as_many_unknowns_as_equations(name: str) -> None:
    counted = derivation(name).why.spared
    assert counted.equations == counted.accelerations + counted.forces
    assert counted.accelerations == counted.coordinates and counted.forces >= counted.multipliers


@pytest.mark.parametrize(("name", "number"), [("rod-pendulum", 3), ("ladder", 5), ("chaplygin-sleigh", 4)])
def test_nothing_is_spared_where_every_coordinate_of_a_free_body_is_kept(name: str, number: int) -> None:
    """2 or 3 accelerations and one multiplier a row: the constraint forces themselves."""
    why = derivation(name).why
    said = part(why, len(why.parts) - 1)
    assert why.spared.equations == number == why.spared.coordinates + why.spared.multipliers
    assert "Lagrange spares none of them here" in said and "never has to be calculated" not in said
    assert "tells the force of" in said or "tell the forces of" in said


def test_with_multipliers_only_what_they_tell_is_calculated() -> None:
    said = part(derivation("four-bar").why, 6)
    assert (
        "of R only what the multipliers tell is calculated" in said and "The multipliers tell the forces of pin" in said
    )
