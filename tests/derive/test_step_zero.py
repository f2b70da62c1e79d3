"""Step 0 of systems with constraints: what the page says, in every format, and what `derivation.constraints` holds."""

import itertools
import json
from typing import Any

import pytest
import sympy as sp

import built_in
import lagrangian as lg
from constrained_systems import peaucellier, pendulum_in_plane
from effort import at_most
from lagrangian.derive.constraints.integrals import Integral
from lagrangian.derive.constraints.proposal import proposals
from lagrangian.model import time as t


def sled(*more: tuple[str, float]) -> lg.System:
    """A knife edge, and multiples of its row, by name and factor."""
    s = lg.System("knife edge")
    x, y, theta = s.coordinates("x y theta")
    m, inertia = s.parameters("m J", m=1.0, J=0.5)
    blade = s.frame(theta, origin=s.point("C", (x, y)), name="blade")
    s.rigid_body(m, inertia, at=blade.origin, frame=blade, name="sled")
    row = x.diff(t) * sp.sin(theta) - y.diff(t) * sp.cos(theta)
    for name, factor in (("edge", 1.0), *more):
        s.velocity_constraint(row * factor, name=name)
    return s


def disc() -> lg.System:
    """A disc that rolls upright."""
    s = lg.System("rolling disc")
    x, y, phi, psi = s.coordinates("x y phi psi")
    m, i, k, r = s.parameters("m I K r", m=1.0, I=0.5, K=0.25, r=0.3)
    speeds = [m * x.diff(t) ** 2, m * y.diff(t) ** 2, i * phi.diff(t) ** 2, k * psi.diff(t) ** 2]
    s.kinetic(sum(speeds) / 2)
    s.velocity_constraint(x.diff(t) - r * sp.cos(psi) * phi.diff(t), name="no slip, x")
    s.velocity_constraint(y.diff(t) - r * sp.sin(psi) * phi.diff(t), name="no slip, y")
    return s


def held(s: lg.System) -> Any:
    """The constraints of the system's derivation."""
    found = s.derive().constraints
    assert found is not None
    return found


def test_a_rod_proposes_an_angle() -> None:
    found = held(pendulum_in_plane())
    assert (found.holonomic, found.GC, found.DDOF) == (True, 1, 1)
    (way,) = found.proposals
    (f,) = [i.expression for i in found.integrals]
    assert way.new is not None
    positive = {p.symbol: sp.Symbol(p.name, positive=True) for p in found.model.parameters}
    assert sp.simplify(f.subs(dict(way.written)).subs(positive)) == 0
    page = str(found)
    assert "with x = l sin θ, y = −l cos θ, where θ is a new coordinate, 'rod' holds by" in page


def test_a_rolling_disc_is_nonholonomic_by_two() -> None:
    derivation = disc().derive()
    data = derivation.steps[0].expressions
    assert (data["holonomic"], data["GC"], data["DDOF"], data["growth"]) == (False, 4, 2, (2, 3, 4))
    page = derivation.to_text()
    assert "the system is nonholonomic by 2" in " ".join(page.split())
    words = " ".join(page.split())
    assert "1. Integrate: impossible" in words
    assert "2. Eliminate: the rows are linear in the 4 rates. Solved for 2 of them they leave 2 free" in words
    assert "The rows must not be put into ℒ before it is differentiated" in words
    assert (
        "3. Use the rows as they are: all 4 coordinates stay" in words
        and "2 more unknowns and 2 more equations" in words
    )
    assert derivation.constraints is not None
    assert derivation.constraints.verdict == "nonholonomic by 2: #DDOF = 2, #GC = 4, growth (2, 3, 4)"


def test_a_row_given_twice_is_left_out_by_name() -> None:
    derivation = sled(("again", 2.0)).derive()
    assert derivation.constraints is not None
    assert [(r.name, r.repeats) for r in derivation.constraints.holonomy.redundant] == [("again", ("edge",))]
    (said,) = derivation.constraints.notices()
    assert len([n for n in derivation.notices if n.code == "E306"]) == 1
    assert str(said) == "[E306] constraint 'again': left out: it says again what 'edge' says"
    assert "The constraint 'again' is left out" in derivation.to_text()


def test_rows_that_contradict_each_other_are_refused_by_name() -> None:
    s = pendulum_in_plane()
    x, y = (c.symbol for c in s.model.coordinates)
    s.constraint(x**2 + y**2 - 9 * next(p.symbol for p in s.model.parameters if p.name == "l") ** 2, name="longer rod")
    with pytest.raises(lg.ModelError, match="'longer rod': it contradicts 'rod'") as caught:
        s.derive()
    assert caught.value.code == "E302"


@pytest.mark.parametrize("make", [pendulum_in_plane, sled, disc])
def test_every_format_says_the_verdict(make: Any) -> None:
    found = held(make())
    for page in (found.to_text(), found.to_markdown(), found.to_latex(), found.to_html(), found._repr_html_()):
        assert "holonomic" in page
        assert found.rows[0].name in page
    data = json.loads(found.to_json())
    assert data["growth"] == list(found.holonomy.growth)
    assert [row["name"] for row in data["rows"]] == [row.name for row in found.rows]


def test_without_constraints_nothing_is_said_of_them() -> None:
    derivation = built_in.derivation("cart-pole")
    assert derivation.constraints is None
    assert derivation.steps[0].expressions == {"holonomic": True, "GC": 2, "DDOF": 2}


@pytest.mark.slow
def test_rows_that_depend_on_each_other_along_the_motion_leave_it_free() -> None:
    """A platform on three equal cranks: four rows, four angles, and it moves; at random angles the rank is 4."""
    found = built_in.derivation("double-parallelogram").constraints
    assert found is not None and found.verdict == "holonomic: #GC = #DDOF = 1"
    assert "only 3 of the 4 are independent" in found.holonomy.notes[0]
    other = built_in.derivation("four-bar").constraints
    assert other is not None and other.verdict == "holonomic: #GC = #DDOF = 1" and not other.holonomy.notes


@pytest.mark.slow
def test_positions_of_another_kind_are_noted_and_kept_out_of_the_verification() -> None:
    """Peaucellier's linkage moves in one way; where its arms lie on each other it turns like two rods."""
    derivation = peaucellier().derive()
    found = derivation.constraints
    assert found is not None and found.verdict == "holonomic: #GC = #DDOF = 1"
    (note,) = found.holonomy.notes
    assert "positions of another kind, where only 3 of them are independent: there the system moves in 2 ways" in note
    assert all(check.holds is not False for check in derivation.verify(states=20))


@pytest.mark.slow
def test_a_platform_on_three_cranks_is_verified() -> None:
    assert all(check.holds is not False for check in built_in.derivation("double-parallelogram").verified)


def test_a_distance_between_two_points_that_always_coincide_is_refused() -> None:
    s = lg.System("nothing apart")
    x, y = s.coordinates("x y")
    s.particle(1, at=s.point("P", (x, y)))
    s.constraint(between=(s["P"], s.point("Q", (x, y))), distance=1, name="rod")
    with pytest.raises(lg.Error, match="E302"):
        s.derive()


def test_a_circle_is_found_beside_many_angles_and_not_sought_among_them() -> None:
    """(x − a)² + (y − b)² = r² around a body on a chain of arms; in no sine stand only x and y of 14 coordinates."""
    x, y, *angles = (sp.Function(n, real=True)(t) for n in ("x", "y", *(f"q{k}" for k in range(12))))
    r = sp.Symbol("r", positive=True)
    reach = sum(sp.sin(q) * sp.cos(p) for q, p in itertools.pairwise(angles))
    beside = Integral(x**2 + y * reach, (), "")
    around = Integral((x - 2) ** 2 + (y + 1) ** 2 - r**2, (), "", sp.S.Zero)
    hinged = Integral(reach - x * y - 3 * x**2, (), "", sp.S.Zero)
    with at_most(150_000):
        (found,) = proposals([beside, hinged, around], [x, y, *angles], t)
    assert found.integral is around and found.new is not None
    assert sp.simplify(around.expression.subs(dict(found.written))) == 0
