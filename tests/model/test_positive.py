"""Distances known to be positive: roots of their squares vanish, and rests, runs and answers follow."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import ModelError, RunError


@pytest.fixture(scope="module")
def polar() -> lg.System:
    """A bob on a spring from the origin, in polar coordinates."""
    s = lg.System("polar")
    r, theta = s.coordinate("r", "from the origin", unit="m", positive=True), s.coordinate("theta")
    m, k, rest = s.parameters("m k L0", m=1, k=40, L0=0.5)
    bob = s.point("bob", (r * sp.sin(theta), -r * sp.cos(theta)))
    s.particle(m, at=bob)
    s.gravity()
    s.spring(k, between=(s.origin, bob), rest=rest)
    return s


@pytest.fixture(scope="module")
def derived(polar: lg.System) -> lg.Derivation:
    return polar.derive()


def residual(d: lg.Derivation) -> sp.Expr:
    """The equation of r as an expression."""
    left, right = d.equations[0].args
    return sp.Add(left, -right)  # type: ignore[operator]


def test_the_textbook_equation_comes_out(polar: lg.System, derived: lg.Derivation) -> None:
    r, theta, m, k, rest, g = (polar[n] for n in ("r", "theta", "m", "k", "L0", "g"))
    t = polar.t
    wanted = m * r.diff(t, 2) - m * r * theta.diff() ** 2 + k * (r - rest) - m * g * sp.cos(theta)
    assert sp.expand(residual(derived) - wanted) == 0
    assert not any(e.has(sp.Abs) or e.atoms(sp.Pow) & {sp.sqrt(r**2, evaluate=False)} for e in derived.equations)
    assert derived.verified
    assert all(c.holds for c in derived.verified)


def test_answers_with_and_without_the_root_are_right(derived: lg.Derivation) -> None:
    second = "m*r^2*theta'' + 2*m*r*r'*theta' + m*g*r*sin(theta) = 0"
    for pull in ("k*(r - L0)", "k*(sqrt(r^2) - L0)", "k*(1 - L0/abs(r))*r"):
        assert derived.check(f"m*r'' - m*r*theta'^2 + {pull} - m*g*cos(theta) = 0\n{second}").right, pull


def test_rests_lie_on_the_positive_side(polar: lg.System) -> None:
    found = sorted(e["r"] for e in polar.equilibria())
    assert found == pytest.approx([0.5 - 9.81 / 40, 0.5 + 9.81 / 40])


def test_rests_that_are_left_out_have_their_reason_and_no_box_is_spoken_of_that_was_not_given(polar: lg.System) -> None:
    s = lg.System("two wells, one of them at a negative distance")
    x = s.coordinate("x", unit="m", positive=True)
    m, k, a = s.parameters("m k a", m=1, k=1, a=1)
    s.particle(m, at=s.origin + (x, 0))
    s.potential(k * ((x / a) ** 2 - 1) ** 2)
    found = s.equilibria()
    assert [e["x"] for e in found] == pytest.approx([1.0])
    assert found.notes == ("2 more are left out, where a coordinate that is always positive is not (x)",)
    outside = [n for n in polar.equilibria(box={"r": ("0.1 m", "0.5 m")}).notes if "outside" in n]
    assert outside == ["1 more lies outside the box that was given"]


def test_a_run_starts_at_a_positive_distance(polar: lg.System) -> None:
    with pytest.raises(RunError, match="'r' is declared positive, and starts at 0"):
        polar.simulate(1.0)
    assert polar.simulate(0.1, r=0.5, theta=1.0, samples=2).success


def test_files_know_it(polar: lg.System, derived: lg.Derivation) -> None:
    again = lg.loads(polar.to_toml())
    assert again["r"].is_positive
    assert not again["theta"].is_positive
    assert sp.expand(residual(again.derive()) - residual(derived)) == 0
    with pytest.raises(ModelError, match="positive"):
        lg.loads(polar.to_toml().replace("positive = true", 'positive = "yes"'))


def test_other_coordinates_keep_it(polar: lg.System) -> None:
    assert polar.in_coordinates({"theta": "phi + 1"})["r"].is_positive


def test_a_range_of_names() -> None:
    s = lg.System("ranges")
    assert [str(q.func) for q in s.coordinates("q1:4")] == ["q1", "q2", "q3"]
    assert [p.name for p in s.parameters("m1:3 k", m1=2)] == ["m1", "m2", "k"]
    assert len(s.inputs("tau:2")) == 2
    assert isinstance(s.coordinates("z1:2"), tuple)
    assert all(x.is_positive for x in s.coordinates("d1:3", positive=True))
    for wrong, code in (("q1:9999999999", "E601"), ("a1:100:1000", "E601"), ("q3:1", "E702"), ("q:", "E702")):
        with pytest.raises(ModelError) as trouble:
            s.coordinates(wrong)
        assert trouble.value.code == code
    with pytest.raises(ModelError, match="True or False"):
        s.coordinate("y", positive=1)  # type: ignore[arg-type]


def test_a_mass_is_refused_in_the_line_that_describes_it() -> None:
    s = lg.System("bad")
    x = s.coordinates("x")
    m = s.parameter("m", -1.0)
    with pytest.raises(ModelError, match="negative"):
        s.particle(m, at=s.origin + (x, 0))
    assert s.elements == ()
