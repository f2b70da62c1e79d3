"""Derivations in named quantities: every line is proved, and long systems end."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian import dynamics
from lagrangian.derivation import verify_lines
from lagrangian.errors import ModelError
from lagrangian.graph import PrimePoint, evaluate
from lagrangian.structured.choose import refusal
from lagrangian.structured.constants import constants
from lagrangian.structured.derive import derive_structured
from lagrangian.structured.listing import listing
from lagrangian.structured.predict import is_long
from lagrangian.structured.shares import ListedShares
from lagrangian.structured.writing import ListingWriter
from structured import robots

PROOFS = 5
"""The checks of a structured derivation that hold identically."""


def proved(derivation: Any) -> bool:
    """Whether every line is proved exactly, and all other checks hold."""
    checks = verify_lines(derivation, states=3, seed=2)
    exact = [c for c in checks if "prime field" in c.figure]
    return len(exact) == PROOFS and all(c.holds for c in checks)


@pytest.fixture(scope="module")
def puma() -> lg.System:
    return robots.puma()


@pytest.fixture(scope="module")
def puma_lines(puma: lg.System) -> Any:
    return puma.derive()


@pytest.mark.slow
def test_a_robot_is_written_in_names_and_proved(puma_lines: Any) -> None:
    d = puma_lines
    assert d.form == "structured"
    assert all(c.holds for c in d.verified)
    assert sum("prime field" in c.figure for c in d.verified) == PROOFS
    assert len(d.definitions) < 200
    assert all(len(str(e)) < 100 for e in d.equations)
    assert str(d.equations[3]) == "Eq(N_x4_out, tau4(t))"


@pytest.mark.slow
@pytest.mark.parametrize(
    "make",
    [
        robots.seven_joints,
        lambda: robots.chain(8, relative=True),
        lambda: robots.chain(5, relative=False),
        robots.platform,
    ],
)
def test_arms_chains_and_platforms_are_proved(make: Any) -> None:
    assert proved(derive_structured(make().model))


@pytest.mark.slow
def test_quantities_stand_before_what_needs_them_in_every_chain() -> None:
    d = derive_structured(robots.crooked_chain(4).model)
    known = {p.symbol for p in d.model.parameters}
    for x in d.definitions:
        assert x.expression.free_symbols - {sp.Symbol("t")} <= known
        known.add(x.symbol)
    kinds = {x.symbol: x.kind for x in d.definitions}
    assert any(
        kinds.get(s) == "height" for x in d.definitions if x.kind == "velocity" for s in x.expression.free_symbols
    )
    assert proved(d)


@pytest.mark.slow
def test_numbers_that_are_rounded_differently_are_compared_as_numbers() -> None:
    d = derive_structured(robots.numeric_arm().model)
    checks = verify_lines(d, states=3, seed=1)
    assert all(c.holds for c in checks)
    wrong = dataclasses.replace(d, T=d.T + sp.Float("0.001"), V=d.V * sp.Float("1.001"))
    assert not verify_lines(wrong, states=3, seed=1)[3].holds


def test_bodies_in_one_frame_and_two_gravities_keep_their_own_names() -> None:
    d = derive_structured(robots.two_gravities().model)
    checks = verify_lines(d, states=3, seed=1)
    assert all(c.holds for c in checks)
    lines = [str(i) for step in d.steps[2:4] for i in step.items]
    names = [line.split(" = ")[0] for line in lines if line.startswith(("T*_", "V_"))]
    assert len(names) == len(set(names)) == 3 + 6
    broken = dataclasses.replace(d, Xi={q: 7 * x + 1 for q, x in d.Xi.items()})
    forces = next(c for c in verify_lines(broken, states=3, seed=1) if "power of the forces" in str(c.what))
    assert forces.holds is False and "random states" in forces.figure  # |δ̇| has no value in a field


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "name",
    ["double-pendulum-relative", "robot-arm", "furuta-pendulum", "planar-quadrotor", "crane", "magnetic-levitation"],
)
def test_textbook_systems_in_names_are_proved(name: str) -> None:
    assert proved(derive_structured(built_in.system(name).model))


@pytest.mark.slow
def test_every_example_that_can_be_written_in_names_is_proved() -> None:
    names = [n for n in built_in.FREE if not refusal(built_in.system(n).model)]
    assert len(names) > 25
    assert [n for n in names if not proved(derive_structured(built_in.system(n).model))] == []


@pytest.mark.slow
def test_names_are_unique_used_and_in_order(puma_lines: Any) -> None:
    d = puma_lines
    known: set[sp.Basic] = set()
    taken = set(d.model.symbols)
    for x in d.definitions:
        assert x.symbol not in known and x.symbol.name not in taken and x.symbol.name.isidentifier()
        assert x.expression.free_symbols - {p.symbol for p in d.model.parameters} - {sp.Symbol("t")} <= known
        known.add(x.symbol)
    lines = [*(x.expression for x in d.definitions), *d.equations, d.T, d.V]
    lines += [v for kind in d.steps[5].expressions.values() for v in kind.values()]
    used = set().union(*(line.free_symbols for line in lines))
    assert known <= used


def test_springs_between_points_have_lengths_with_plain_names() -> None:
    d = derive_structured(robots.platform().model)
    lengths = [x for x in d.definitions if x.kind == "length"]
    assert [x.symbol.name for x in lengths] == ["delta_k", "delta_k2", "delta_k3", "delta_k4", "delta_b"]
    assert all(isinstance(x.expression, sp.Pow) and len(x.elements) == 1 for x in lengths)


@pytest.mark.slow
def test_a_line_that_is_changed_is_found(puma_lines: Any) -> None:
    d = puma_lines
    one = next(x for x in d.definitions if x.kind == "force" and x.inward)
    wrong = dataclasses.replace(one, expression=-one.expression)
    broken = dataclasses.replace(d, definitions=tuple(wrong if x is one else x for x in d.definitions))
    checks = verify_lines(broken, states=2, seed=1)
    assert [c.holds for c in checks[:2]] == [False, False]
    assert checks[2].holds and checks[3].holds  # momenta and energies do not need that force


def test_the_energies_shown_are_checked(puma_lines: Any) -> None:
    d = puma_lines
    broken = dataclasses.replace(d, T=2 * d.T)
    assert [c.holds for c in verify_lines(broken, states=2, seed=1)[2:4]] == [False, False]


def test_cse_and_expanded_equations_are_the_compiled_ones(puma: lg.System, puma_lines: Any) -> None:
    d, compiled = puma_lines, puma.compile()
    rng = np.random.default_rng(3)
    q, v, a, u = (rng.uniform(-1, 1, 6) for _ in range(4))
    values: dict[Any, float] = {p.symbol: p.value for p in d.model.parameters}
    for c, x, y, z in zip(d.model.coordinates, q, v, a, strict=True):
        values |= {c.acceleration: z, c.rate: y, c.symbol: x}
    values |= {i.symbol: x for i, x in zip(d.model.inputs, u, strict=True)}
    replacements, equations = d.cse
    for symbol, meaning in replacements:
        values[symbol] = float(meaning.xreplace(values))
    missing = [float((e.lhs - e.rhs).xreplace(values)) for e in equations]
    wanted = compiled.inverse(q, v, a, u=u)
    assert np.allclose(missing, wanted, rtol=1e-12, atol=1e-12)
    last = d.expanded(5)
    assert not last.free_symbols & {x.symbol for x in d.definitions}
    assert abs(float((last.lhs - last.rhs).xreplace(values)) - wanted[5]) < 1e-11


@pytest.mark.slow
def test_shares_of_the_elements_add_up_to_the_rows(puma: lg.System) -> None:
    found = listing(puma.model)
    shares = ListedShares(found, ListingWriter(found))
    g = found.graph
    for i in (0, 3):
        origins = list(shares.of(i))
        assert {o.step for o in origins} == {2, 6}
        total = found.mechanics.gathered(
            [pair for element, pairs, step in shares._acting() if step != 6 for pair in pairs]
        )[i]
        assert PrimePoint(g).values([g.sub(total, found.rows[i])]) == [0]
    d = puma.derive()
    bodies = [o.element.name for o in d.where(d.equations[3].lhs) if o.step == 2]
    assert bodies == ["m4", "m5", "m6"]
    with pytest.raises(ModelError, match="no equation of motion holds"):
        d.where(sp.Symbol("x"))


def test_long_and_short_systems_are_told_apart() -> None:
    assert not is_long(robots.chain(4, relative=False).model)
    assert not any(
        is_long(built_in.system(n).model) for n in ("double-pendulum", "triple-pendulum-relative", "robot-arm")
    )
    assert all(is_long(m.model) for m in (robots.puma(), robots.chain(6, relative=True), robots.platform()))


@pytest.mark.slow
def test_listings_grow_with_the_number_of_links() -> None:
    sizes = []
    for n in (10, 20, 40):
        write = ListingWriter(listing(robots.chain(n, relative=True).model))
        sizes.append(len(write.quantities))
    assert sizes[2] - sizes[1] == 2 * (sizes[1] - sizes[0])  # so many a link


def test_a_system_keeps_its_own_names() -> None:
    s = robots.arm("zyy", (("", "", ""), ("d2", "", ""), ("omega_x3", "", "")), "with names")
    d = derive_structured(s.model)
    names = [x.symbol.name for x in d.definitions]
    assert all(n.isidentifier() for n in names)
    assert "omega_x3" not in names and "omega_x3_own" in names
    assert proved(d)


@pytest.mark.slow
def test_forms_that_cannot_be_had_are_refused() -> None:
    with pytest.raises(ModelError, match=r"there is no form 'short'.*\n.*auto, expanded, structured"):
        built_in.system("pendulum").derive(form="short")  # type: ignore[arg-type]
    with pytest.raises(ModelError, match="only in the expanded form"):
        built_in.system("robot-arm").derive(form="structured", detail="full")
    with pytest.raises(ModelError, match="there is no equation 3"):
        built_in.system("robot-arm").derive().expanded(3)
    s = lg.System("given")
    x = s.coordinate("x")
    s.kinetic(x.diff() ** 2)
    assert "given" in refusal(s.model)


@pytest.mark.slow
def test_answers_and_reasons_go_back_to_the_coordinates() -> None:
    d = built_in.system("double-pendulum-relative").derive(form="structured")
    assert d.check(built_in.derivation("double-pendulum-relative").to_text(brief=True)).right
    assert not d.check("m2*L2^2*(theta1'' + theta2'') = 0").right
    assert d.why.checks and all(c.holds for c in d.why.checks)


@pytest.mark.slow
def test_long_systems_are_compared_by_their_motions(puma_lines: Any) -> None:
    """Absolute and relative angles of one chain, whose relative equations are too long; and a robot with itself."""
    same = lg.compare(robots.chain(6, relative=True).derive(), robots.chain(6, relative=False).derive())
    assert same.same and "at random states" in " ".join(str(same).split()) and same.change is not None
    assert lg.compare(puma_lines, puma_lines).same
    heavier = robots.puma()
    heavier.damper(0.1, deflection=heavier["q3"])
    other = lg.compare(puma_lines, heavier)
    assert not other.same and "q3" in str(other)


@pytest.mark.slow
def test_every_format_has_the_definitions(puma_lines: Any) -> None:
    d = puma_lines
    data = json.loads(json.dumps(d.to_dict()))
    assert data["form"] == "structured" and "mass_matrix" not in data
    assert len(data["named_quantities"]) == len(d.definitions)
    assert "N_x₄⁺ = c₅ N_x₅⁺" in d.to_text(width=200)
    assert r"N^{+}_{x_{4}}" in d.to_latex()
    assert "<mo>+</mo></msubsup>" in d.to_html()
    assert d.to_markdown().count(r"\omega_{x_{3}}") > 5


def test_a_single_equation_of_long_systems_has_its_matrices(puma: lg.System, puma_lines: Any) -> None:
    M = puma_lines.mass_matrix
    q = dict(zip((c.symbol for c in puma.model.coordinates), (0.1, 0.2, 0.3, 0.4, 0.5, 0.6), strict=True))
    values = {**{p.symbol: p.value for p in puma.model.parameters}, **q}
    numbers = np.array([[float(M[i, j].xreplace(values)) for j in range(6)] for i in range(6)])
    assert np.allclose(numbers, puma.compile().mass_matrix(list(q.values())), rtol=1e-12)


def test_the_constants_of_the_puma_are_those_of_the_paper() -> None:
    """22 of T* and 5 of the weights, and four motors by themselves (Armstrong, Khatib, Burdick 1986, their table)."""
    model = robots.armstrongs_puma().model
    found = constants(listing(model))
    values = {p.symbol: p.value for p in model.parameters}
    weights = [abs(float(c.xreplace(values))) for c in found if "g" in map(str, c.free_symbols)]
    assert len(found) == 22 + 5 + 4
    assert sorted(weights, reverse=True) == pytest.approx([37.2, 8.44, 1.02, 0.249, 0.0282], rel=5e-3)
    others = [abs(float(c.xreplace(values))) for c in found]
    for published in (0.69, 0.372, 0.134, 0.0238, 0.011, 0.00379, 0.00125, 0.00124, 6.42e-4, 4.31e-4, 4e-5):
        assert any(x == pytest.approx(published, rel=6e-3) for x in others)


def test_constants_of_a_chain_are_sums_of_the_masses_further_out() -> None:
    m1, m2, m3, L1, L2, L3, g = sp.symbols("m1 m2 m3 L1 L2 L3 g", real=True)
    outer = {L1: m1 + m2 + m3, L2: m2 + m3, L3: m3}
    pairs = [(L1, L1), (L1, L2), (L1, L3), (L2, L2), (L2, L3), (L3, L3)]
    wanted = {sp.expand(a * b * outer[b]) for a, b in pairs} | {sp.expand(g * a * outer[a]) for a in outer}
    model = robots.chain(3, relative=True).model
    plain = {p.symbol: sp.Symbol(p.name, real=True) for p in model.parameters}
    found = constants(listing(model))
    assert {sp.expand(c.xreplace(plain)) for c in found} == wanted and len(found) == len(wanted)


def test_energies_are_as_many_functions_of_their_parameters_as_there_are_constants() -> None:
    """T* - V at random parameters (rows) and states (columns): the constants span the rows, and none is spare."""
    model = robots.arm("zyx", (("", "", ""), ("d2", "", "a2"), ("", "e3", "")), "three joints").model
    found = constants(listing(model))
    program, source = dynamics.energy(model), np.random.default_rng(1)
    count = len(found) + 6
    states = [source.uniform(-2, 2, (2, 3)) for _ in range(count)]
    drawn = [source.uniform(0.4, 1.6, len(model.parameters)) for _ in range(count)]
    L = np.array([[_lagrangian(program, p, *x) for x in states] for p in drawn])
    L -= L[:, :1]  # a constant adds nothing to the motion
    names = [p.symbol for p in model.parameters]
    C = np.array([[float(c.xreplace(dict(zip(names, p, strict=True)))) for c in found] for p in drawn])
    F = np.linalg.lstsq(C, L, rcond=None)[0]
    assert np.abs(C @ F - L).max() < 1e-9 * np.abs(L).max()
    singular = np.linalg.svd(L / np.abs(L).max(axis=0, initial=1e-300), compute_uv=False)
    assert singular[len(found) - 1] > 1e-9 * singular[0] > 1e4 * singular[len(found)]


def _lagrangian(program: Any, p: Any, q: Any, v: Any) -> float:
    found = evaluate(program, {"q": q, "v": v, "u": [0.0] * 3, "p": p, "t": [0.0]})
    return float(found["T"]) - float(found["V"])


def test_what_is_no_polynomial_in_the_parameters_has_no_constants() -> None:
    s = lg.System("crank")
    q, a, b = s.coordinate("q"), *s.parameters("a b")
    s.particle(s.parameter("m"), at=s.origin + (a * sp.cos(q) + sp.sqrt(b**2 - (a * sp.sin(q)) ** 2), 0))
    assert constants(listing(s.model)) == ()
    assert constants(listing(robots.chain(10, relative=True).model)) == ()  # 65 of them


def floating_ball(rolls: bool) -> lg.System:
    system = lg.System("ball")
    frame, m, R = system.floating_frame("b"), *system.parameters("m R")
    system.rigid_body(m, (m * R**2,) * 3, at=frame.origin, frame=frame)
    system.gravity(direction=(0, 0, -1))
    if rolls:
        system.constraint(system["b_z"] - R, name="floor")
        system.velocity_constraint(system["b_x"].diff() - R * frame.in_fixed_axes(system_speeds(system))[1], name="rx")
    return system


def system_speeds(system: lg.System) -> list[sp.Expr]:
    return [system[f"b_w{axis}"] for axis in "xyz"]


@pytest.mark.parametrize("rolls", [False, True])
def test_the_checklist_of_a_floating_body_defines_what_it_uses(rolls: bool) -> None:
    """Coordinates, speeds, energies, accelerations: no letter of the equations is without its line."""
    page = floating_ball(rolls).derive().to_text(brief=True, width=200)
    for line in (
        "ε_w      b_qw: quaternion",
        "ω_x     b_wx: angular velocity",
        "T*_b = ½ m",
        "V_b = m g z",
        "a_x_b = v̇_x",
    ):
        assert line in page, line
    assert "#DDOF" in page and "There is no coordinate π" in page and "∂π_v_x" not in page
    assert max(map(len, page.splitlines())) < 200 and page.count("per unit of what this row keeps at zero") == rolls
