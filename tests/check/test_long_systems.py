"""Answers for systems whose equations are written in named quantities: floating bodies, robots, the bicycle."""

from __future__ import annotations

import random
from typing import Any

import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian.check import Status
from lagrangian.cli import main
from lagrangian.model import time
from structured import robots
from structured.test_floating_derivations import arm, hull


@pytest.fixture(scope="module")
def floating() -> Any:
    return hull()


@pytest.fixture(scope="module")
def floating_lines(floating: lg.System) -> Any:
    return floating.derive()


def newton_and_euler(s: lg.System) -> list[sp.Eq]:
    """m (v̇ + ω × v + ω̇ × r + ω × (ω × r)) + m g Rᵀe = F and J ω̇ + ω × J ω + r × (the first) = 0, r = (c, 0, 0)."""
    f = s.model.floating[0].floating
    assert f is not None
    v, w = sp.Matrix(f.velocity), sp.Matrix(f.angular_velocity)
    m, A, B, C, c, F = (s[x] for x in ("m", "A", "B", "C", "c", "F"))
    r, J, up = sp.Matrix([c, 0, 0]), sp.diag(A, B, C), f.rotation.T * sp.Matrix([0, 0, 1])
    e = sp.Matrix(f.quaternion)
    up = up.subs(dict(zip(f.quaternion, e / sp.sqrt(e.dot(e)), strict=True)), simultaneous=True)
    a = v.diff(time) + w.cross(v) + w.diff(time).cross(r) + w.cross(w.cross(r))
    force = m * a + m * s["g"] * up
    turn = J * w.diff(time) + w.cross(J * w) + r.cross(force)
    return [sp.Eq(x, F if i == 0 else 0) for i, x in enumerate([*force, *turn])]


@pytest.mark.slow
def test_newton_and_euler_are_right_for_a_floating_body(floating: lg.System, floating_lines: Any) -> None:
    lines = newton_and_euler(floating)
    found = floating_lines.check(lines)
    assert found.status is Status.RIGHT and {f.coordinate for f in found.findings} >= {"body_vx", "body_wz"}
    assert floating_lines.check([sp.Eq(2 * x.lhs, 2 * x.rhs) for x in lines], hint=0).status is Status.EQUIVALENT
    assert floating_lines.check(lines[:5], hint=0).status is Status.INCOMPLETE


def test_rotation_matrices_of_unit_quaternions_need_no_divisor(floating: lg.System, floating_lines: Any) -> None:
    """R as step 1 prints it, 2 (ε_x ε_z − ε_y ε_w), is that of a quaternion of length 1, which the quaternion has."""
    right = "m*body_vx' + m*(body_wy*body_vz - body_wz*body_vy) - m*c*(body_wy^2 + body_wz^2) = F - m*g*({})"
    for up in ("2*body_qx*body_qz - 2*body_qy*body_qw", "(2*body_qx*body_qz - 2*body_qy*body_qw)/({})"):
        square = "body_qx^2 + body_qy^2 + body_qz^2 + body_qw^2"
        found = floating_lines.check(right.format(up.format(square)))
        assert found.findings[0].status is Status.RIGHT, str(found)
    wrong = floating_lines.check(right.format("2*body_qx*body_qz + 2*body_qy*body_qw"), hint=0)
    assert wrong.status is Status.WRONG


def test_text_in_quasi_velocities_is_read(floating_lines: Any) -> None:
    right = "A*body_wx' + (C - B)*body_wy*body_wz = 0"
    found = floating_lines.check(right)
    assert found.status is Status.INCOMPLETE and found.findings[0].status is Status.RIGHT
    wrong = floating_lines.check(right.replace("C - B", "B - C"))
    assert wrong.status is Status.WRONG and "not which mistake" in str(wrong)


def changed(lines: list[sp.Eq], source: random.Random) -> list[sp.Eq]:
    """One term of one equation with another factor, left out, or with the other sign."""
    i = source.randrange(len(lines))
    terms = list(sp.Add.make_args(sp.expand(lines[i].lhs - lines[i].rhs)))
    k = source.randrange(len(terms))
    terms[k] *= source.choice([0, -1, 2, sp.Rational(9, 10)])
    return [*lines[:i], sp.Eq(sp.Add(*terms), 0), *lines[i + 1 :]]


def test_no_answer_with_a_changed_term_is_right(floating: lg.System, floating_lines: Any) -> None:
    lines, source = newton_and_euler(floating), random.Random(3)
    found = [floating_lines.check(changed(lines, source), hint=0).status for _ in range(4)]
    assert found == [Status.WRONG] * 4


def test_energies_forces_and_momenta_of_floating_bodies_are_compared(floating: lg.System, floating_lines: Any) -> None:
    d = floating_lines
    assert d.check({"T": d.T, "V": d.V + floating["m"]}, hint=0).right
    assert d.check({"T": 2 * d.T}, hint=0).status is Status.WRONG
    assert d.check({"V": -d.V}, hint=0).status is Status.WRONG
    vx = floating["body_vx"]
    assert d.check({vx: floating["F"]}).findings[0].status is Status.RIGHT
    assert d.check({vx: -floating["F"]}).findings[0].status is Status.WRONG


@pytest.mark.slow
def test_equal_values_of_parameters_do_not_make_an_answer_right() -> None:
    """Both inertias of a robot's link have the value 0.2: exchanged they are another answer."""
    s = robots.puma()
    d = s.derive()
    assert d.check(list(d.equations), hint=0).status is Status.RIGHT
    table = {s["I6yy"]: s["I6zz"], s["I6zz"]: s["I6yy"]}
    last = d.equations[5]
    other = sp.Eq(d.expanded(5).lhs.xreplace(table), last.rhs)
    assert d.check([*d.equations[:5], other], hint=0).status is Status.WRONG


@pytest.mark.slow
def test_answers_with_own_multipliers_for_long_constrained_systems() -> None:
    """A floating frame that a wall holds: λ has any scale, but takes up no slip."""
    s = arm()
    base = s["base_x"]
    s.constraint(base, name="wall")
    d = s.derive()
    assert all(c.holds for c in d.verified) and d.form == "structured"
    assert d.check(list(d.equations), hint=0).right
    lam = next(iter(d.multipliers.values())).symbol
    scaled = [sp.Eq(e.lhs, e.rhs.xreplace({lam: -3 * sp.Function("mu")(time)}), evaluate=False) for e in d.equations]
    assert d.check(scaled, hint=0).right
    first = d.equations[0]
    slipped = [sp.Eq(first.lhs + s["m"], first.rhs), *d.equations[1:]]
    assert d.check(slipped, hint=0).status is Status.WRONG


def test_the_command_and_a_class_take_long_systems(tmp_path: Any, floating: lg.System, capsys: Any) -> None:
    model, answer = tmp_path / "hull.toml", tmp_path / "answers" / "ann.txt"
    floating.save(model)
    answer.parent.mkdir()
    answer.write_text("A*body_wx' + (C - B)*body_wy*body_wz = 0\n")
    assert main(["check", str(model), str(answer)]) == 1
    assert "1 of 6 accelerations" in " ".join(capsys.readouterr().out.split())
    marked = floating.derive().check_class(answer.parent, processes=1)
    assert len(marked.rows) == 1 and not marked.all_right


@pytest.mark.slow
def test_the_bicycle_judges_its_own_equations_and_finds_a_change() -> None:
    d = built_in.system("whipple-bicycle").derive()
    assert d.check(list(d.equations), hint=0).right
    wrong = [sp.Eq(d.equations[0].lhs, 2 * d.equations[0].rhs), *d.equations[1:]]
    assert d.check(wrong, hint=0).status is Status.WRONG


@pytest.mark.slow
def test_a_slip_that_multipliers_could_take_up_is_found() -> None:
    """The Stewart platform: its 18 multipliers could balance one more constant in an equation."""
    d = built_in.system("stewart-platform").derive()
    assert d.check(list(d.equations), hint=0).right
    last = d.equations[-1]
    slipped = sp.Eq(last.lhs + d.model.parameters[0].symbol, last.rhs)
    found = d.check([*d.equations[:-1], slipped])
    assert found.status is Status.WRONG and any(f.status is Status.WRONG for f in found.findings)
