"""Derivations of systems with floating frames, in quasi-velocities."""

from dataclasses import replace

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.cli import main
from lagrangian.errors import ModelError
from lagrangian.verify.listed import verify_listed


def hull():
    """A body whose centre of mass is beside the origin of its frame, with a thrust there."""
    s = lg.System("hull")
    m, A, B, C, c = s.parameters("m A B C c")
    F = s.input("F")
    body = s.floating_frame("body")
    s.rigid_body(m, (A, B, C), body.point(c, 0, 0), body)
    s.gravity(direction=(0, 0, -1))
    s.force((F, 0, 0), at=body.origin, axes=body)
    return s


def arm():
    """A floating base with a turning link and a spring to the ground."""
    s = lg.System("satellite")
    m, J, L, k = s.parameters("m J L k", m=2, J=1, L=1, k=3)
    base = s.floating_frame("base")
    q = s.coordinate("q")
    link = s.frame(q, axis=(0, 1, 0), parent=base, origin=base.point(L, 0, 0))
    s.rigid_body(3 * m, (J, 2 * J, 2 * J), base.origin, base)
    s.rigid_body(m, (0.1, J, J), link.point(L / 2, 0, 0), link)
    s.spring(k, between=(s.origin, link.point(L, 0, 0)), rest=0.3)
    s.damper(0.2, deflection=q)
    return s


def test_one_body_has_the_equations_of_newton_and_euler_about_any_point() -> None:
    """m (v̇ + ω × v + ω̇ × r + ω × (ω × r)) + m g Rᵀe = F, and J ω̇ + ω × J ω + r × (the first) = 0, r = (c, 0, 0)."""
    s = hull()
    d = s.derive()
    f = s.model.floating[0].floating
    v, w = sp.Matrix(f.velocity), sp.Matrix(f.angular_velocity)
    time = next(iter(v[0].free_symbols))
    m, A, B, C, c = (s[x] for x in ("m", "A", "B", "C", "c"))
    r, J, up = sp.Matrix([c, 0, 0]), sp.diag(A, B, C), f.rotation.T * sp.Matrix([0, 0, 1])
    a = v.diff(time) + w.cross(v) + w.diff(time).cross(r) + w.cross(w.cross(r))
    force = m * a + m * s["g"] * up
    turn = J * w.diff(time) + w.cross(J * w) + r.cross(force)
    expected = [*force, *turn]
    values = {x: sp.Rational(k + 2, 7) for k, x in enumerate(s.model.symbols.values())}
    values |= {x.diff(time): sp.Rational(k + 1, 5) for k, x in enumerate((*v, *w))}
    for i, other in enumerate(expected):
        found = d.expanded(i)
        assert sp.nsimplify((found.lhs - other).xreplace(_sorted(values)).doit()) == 0
        assert found.rhs == (s["F"] if i == 0 else 0)
    assert list(d.Xi) == [*v, *w]


def _sorted(values):
    return dict(sorted(values.items(), key=lambda pair: not pair[0].has(sp.Derivative)))


@pytest.mark.slow
def test_every_line_is_proved_and_a_wrong_one_is_found() -> None:
    d = arm().derive()
    assert d.form == "structured" and all(c.holds for c in d.verified)
    assert "rates shown" in str(d.verified[0].what)
    rates = dict(d.steps[1].expressions["rates"])
    first = next(iter(rates))
    wrong = replace(d.steps[1], expressions={"rates": {**rates, first: -rates[first]}})
    found = verify_listed(replace(d, steps=(d.steps[0], wrong, *d.steps[2:])), states=2, seed=1)
    assert [c.holds for c in found].count(False) == 1 and not found[0].holds
    momenta = dict(d.steps[5].expressions["momenta"])
    one = next(iter(momenta))
    wrong = replace(d.steps[5], expressions={**d.steps[5].expressions, "momenta": {**momenta, one: 2 * momenta[one]}})
    found = verify_listed(replace(d, steps=(*d.steps[:5], wrong, d.steps[6])), states=2, seed=1)
    assert [c.holds for c in found].count(False) == 2


def test_the_page_says_what_the_speeds_are_and_shows_boltzmanns_and_hamels_terms() -> None:
    text = arm().derive().to_text()
    for words in (
        "quasi-velocities",
        "Boltzmann and Hamel",
        "#GC = 7 = #DDOF",
        "base_qw: quaternion of base, scalar part",
        "d/dt (∂ℒ/∂v_x) + ω_y ∂ℒ/∂v_z − ω_z ∂ℒ/∂v_y − ∂ℒ/∂π_v_x",
        "+ v_y ∂ℒ/∂v_z − v_z ∂ℒ/∂v_y",
        "ε̇_w = −½ ε_x ω_x − ½ ε_y ω_y − ½ ε_z ω_z",
    ):
        assert words in text, words
    assert "--why" not in text  # there is no such page for it


@pytest.mark.slow
def test_all_formats_and_notations() -> None:
    d = arm().derive()
    for notation in ("lecture", "physics", "robotics"):
        assert "π" in d.to_text(notation=notation)
    assert r"\varepsilon" in d.to_latex() or r"\epsilon" in d.to_latex()
    assert "Hamel" in d.to_html() and "Hamel" in d.to_markdown()
    data = d.to_dict()
    assert [e["coordinate"] for e in data["equations"]][5:] == ["base_wz", "q"]
    assert set(data["Xi"]) >= {"base_vx", "q"}


@pytest.mark.slow
def test_letters_of_frames_never_look_like_others() -> None:
    s = lg.System("two")
    x = s.coordinate("x")
    a = s.floating_frame("a")
    m = s.parameter("m")
    s.rigid_body(m, (1, 1, 1), a.origin, a)
    s.particle(m, at=s.origin + (x, 0, 0))
    text = s.derive().to_text()
    assert "v_x_a" in text and "x_a" in text  # x is the coordinate's
    b = s.floating_frame("b")
    s.rigid_body(m, (1, 2, 3), b.origin, b)
    text = s.derive().to_text()
    assert "v_x_a" in text and "v_x_b" in text and "The same holds for b." in text


def test_what_cannot_be_derived_says_why() -> None:
    s = lg.System("particle")
    b = s.floating_frame("b")
    s.particle(s.parameter("m"), b.origin)
    with pytest.raises(ModelError, match=r"move no mass.*\n.*an inertia about every axis") as error:
        s.derive()
    assert error.value.code == "E201"
    s = hull()
    with pytest.raises(ModelError, match="three angles"):
        s.derive(form="expanded")
    s.kinetic(s["body_vx"] ** 2)
    assert all(c.holds for c in s.derive().verified)  # an energy that was given is one more term of T*


@pytest.mark.slow
def test_where_and_shares_add_up() -> None:
    d = arm().derive()
    found = d.where(d.equations[6].lhs)
    assert {o.coordinate for o in found} == {"q"}
    assert {type(o.element).__name__ for o in found} >= {"RigidBody", "Spring"}


def test_the_command_derives_a_file_with_a_floating_frame(tmp_path, capsys) -> None:
    path = tmp_path / "hull.toml"
    path.write_text(hull().to_toml(), encoding="utf-8")
    assert main(["derive", str(path)]) == 0
    shown = capsys.readouterr().out
    assert "Boltzmann and Hamel" in shown and "✗" not in shown


def test_floating_bodies_are_compared_by_their_motions() -> None:
    """The same body twice, and one with a torque besides."""
    assert lg.compare(hull(), hull()).same
    driven = hull()
    driven.torque((0, 0, driven["F"]), on=driven.model.floating[0], axes=driven.model.floating[0])
    assert not lg.compare(hull(), driven).same
