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
from lagrangian.derivation import verify_lines
from lagrangian.errors import ModelError
from lagrangian.graph import PrimePoint
from lagrangian.structured.choose import refusal
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


def test_a_robot_is_written_in_names_and_proved(puma_lines: Any) -> None:
    d = puma_lines
    assert d.form == "structured"
    assert all(c.holds for c in d.verified)
    assert sum("prime field" in c.figure for c in d.verified) == PROOFS
    assert len(d.definitions) < 200
    assert all(len(str(e)) < 100 for e in d.equations)
    assert str(d.equations[3]) == "Eq(N_x4_out, tau4(t))"


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


@pytest.mark.parametrize(
    "name", ["double-pendulum-relative", "robot-arm", "furuta-pendulum", "planar-quadrotor", "crane"]
)
def test_textbook_systems_in_names_are_proved(name: str) -> None:
    assert proved(derive_structured(built_in.system(name).model))


@pytest.mark.slow
def test_every_example_that_can_be_written_in_names_is_proved() -> None:
    names = [n for n in built_in.FREE if not refusal(built_in.system(n).model)]
    assert len(names) > 25
    assert [n for n in names if not proved(derive_structured(built_in.system(n).model))] == []


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


def test_forms_that_cannot_be_had_are_refused() -> None:
    with pytest.raises(ModelError, match=r"there is no form 'short'.*\n.*auto, expanded, structured"):
        built_in.system("pendulum").derive(form="short")  # type: ignore[arg-type]
    with pytest.raises(ModelError, match=r"no structured derivation: inductor .* stores energy by its current"):
        built_in.system("dc-motor").derive(form="structured")
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
