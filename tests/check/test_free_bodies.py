"""Balances of single bodies with forces of the answer's own: which line is wrong, and what in it.

Oracle: free-body diagrams by hand. A lift: cage M, sheave J of radius R with a motor, a rope S that does not stretch to
the cage and one F = k (y − x) that does to the counterweight m. A roller on a table that slides, with a spring between.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian.check.explain.free_bodies import free_bodies
from lagrangian.check.explain.known_forces import known_parts
from lagrangian.check.reference import truth_of
from lagrangian.check.verb import check_answer
from lagrangian.check.verdict import AnsweredLine

LIFT = """M x'' = S - M g
J x''/R = F R - S R + tau
m y'' = m g - F
F = k (y - x)
S = M x'' + M g
(M + J/R^2) x'' - k (y - x) + M g = tau/R
m y'' + k (y - x) = m g"""


@cache
def lift() -> lg.Derivation:
    s = lg.System("lift")
    x, y = s.coordinates("x y")
    M, m, J, R, k, g = s.parameters("M m J R k g")
    s.particle(M, at=s.point("cage", (0, x)), name="cage")
    s.particle(m, at=s.point("weight", (R, -y)), name="counterweight")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(-x / R, name="sheave"), name="sheave")
    s.gravity((0, -1), g)
    s.spring(k=k, deflection=y - x)
    s.force(s.inputs("tau"), deflection=x / R)
    return s.derive()


@cache
def table() -> lg.Derivation:
    """A roller m, J, r on a sliding table M, held to it by a spring k and a damper b."""
    s = lg.System("roller on a table")
    x, u = s.coordinates("x u")
    M, m, J, r, k, b = s.parameters("M m J r k b")
    s.particle(M, at=s.point("T", (x, 0)), name="table")
    s.rigid_body(m, inertia=J, at=s.point("P", (x + u, r)), frame=s.frame(-u / r, name="roller"), name="roller")
    s.spring(k=k, deflection=u)
    s.damper(b=b, deflection=u)
    s.force((s.inputs("F"), 0), at=s.point("T2", (x, 0)))
    return s.derive()


TABLE = """m (x'' + u'') = B - k u - b u'
J u''/r = -B r
M x'' = F - B + k u + b u'
B = -J u''/r^2
(m + J/r^2) u'' + m x'' + k u + b u' = 0
(M + m) x'' + m u'' = F"""


def told(derivation: lg.Derivation, answer: str) -> str:
    verdict = check_answer(derivation, answer)
    assert not verdict.right
    return str(verdict.mistakes[0].what)


@pytest.mark.parametrize(("derivation", "answer"), [(lift, LIFT), (table, TABLE)])
def test_right_balances_are_right(derivation: object, answer: str) -> None:
    assert check_answer(derivation(), answer).right  # type: ignore[operator]


def test_a_moment_with_forces_in_place_of_moments() -> None:
    wrong = LIFT.replace("F R - S R + tau", "F - S + tau").replace("J/R^2", "J/R").replace("= tau/R", "= tau")
    assert told(lift(), wrong) == "In line 2, the force of spring 'k' lacks the factor R."


def test_the_sign_of_an_own_force() -> None:
    wrong = TABLE.replace("= -B r", "= B r").replace("B = -J u", "B = J u").replace("(m + J/r^2)", "(m - J/r^2)")
    assert told(table(), wrong) == "In line 2, on the right-hand side, B*r has the wrong sign."


def test_a_reaction_that_is_forgotten() -> None:
    wrong = TABLE.replace("F - B + k u + b u'", "F - B").replace("m u'' = F", "m u'' = F - k u - b u'")
    assert told(table(), wrong) == "In line 3, the force of spring 'k' and the force of damper 'b' are missing."


def test_the_sign_of_an_inertia_in_a_solved_force() -> None:
    wrong = LIFT.replace("M x'' = S - M g", "S = M g - M x''").replace("S = M x'' + M g\n", "")
    wrong = wrong.replace("(M + J/R^2)", "(J/R^2 - M)")
    assert told(lift(), wrong) == "In line 1, on the right-hand side, -M*x'' has the wrong sign."


def test_a_wrong_law_is_not_said_of_a_balance() -> None:
    wrong = LIFT.replace("k (y - x)", "k (y + x)")
    assert "line 1" not in told(lift(), wrong) and "line 2" not in told(lift(), wrong)


def test_known_forces_are_counted_on_every_body() -> None:
    derivation = lift()
    truth = truth_of(derivation)
    p = {q.name: q.symbol for q in truth.model.parameters}
    line = p["M"] * truth.model.coordinates[0].acceleration + 2 * p["M"] * p["g"]
    (found,) = [m for m in free_bodies(truth).matches(line, {}) if np.allclose(m.scale, 1) and len(m.counts) == 1]
    (count,) = found.counts.values()
    assert np.allclose(count, 2)
    assert {e.title for e in found.wrong} == {"gravity 'g'"}
    parts = known_parts(truth, [AnsweredLine("equation", line, 1)], [])
    assert not parts[0].right
    assert str(parts[0].said).endswith("counts twice.")


@cache
def flail() -> lg.Derivation:
    """A rod m, I on a hinge at the radius e of a rotor J, without gravity; angles phi and beta, relative."""
    s = lg.System("flail")
    phi, beta = s.coordinates("phi beta")
    J, I, m, e, a = s.parameters("J I m e a")
    arm = s.frame(phi, name="rotor")
    rod = s.frame(beta, parent=arm, name="rod")
    hinge = s.point("hinge", (e, 0), frame=arm)
    s.rigid_body(0, inertia=J, at=s.origin, frame=arm, name="rotor")
    s.rigid_body(m, inertia=I, at=s.point("centre", (a, 0), relative_to=hinge, frame=rod), frame=rod, name="rod")
    s.torque(s.inputs("tau"), on=phi)
    return s.derive()


FLAIL = """along the rod:  a_n = -a (phi' + beta')^2 - e phi'^2 cos(beta) + e phi'' sin(beta)
across the rod: a_t = a (phi'' + beta'') + e phi'' cos(beta) + e phi'^2 sin(beta)
m a_n = H_n
m a_t = H_t
I (phi'' + beta'') = -a H_t
J phi'' = tau - e (H_t cos(beta) + H_n sin(beta))
(I + m a^2) (phi'' + beta'') + m a e (phi'' cos(beta) + phi'^2 sin(beta)) = 0
(J + m e^2) phi'' + m a e cos(beta) (phi'' + beta'') - m a e sin(beta) (phi' + beta')^2 = tau"""


@pytest.mark.slow
def test_forces_between_which_long_relations_hold_are_given_up() -> None:
    said = "H_n acts along the rod (outward), H_t at right angles to it.\n"
    assert check_answer(flail(), said + FLAIL).right
    assert not check_answer(flail(), said + FLAIL.replace("- m a e sin(beta)", "+ m a e sin(beta)")).right


CART = """M x'' = F - b x' - H
m (x'' + l theta'' cos(theta) - l theta'^2 sin(theta)) = H
m (-l theta'' sin(theta) - l theta'^2 cos(theta)) = N - m g
J theta'' = N l sin(theta) - H l cos(theta)"""


def test_a_weight_that_is_missing_in_its_own_balance() -> None:
    wrong = CART.replace("N - m g", "N")
    verdict = check_answer(built_in.derivation("cart-pole"), wrong)
    assert {f.line.number: f.status.right for f in verdict.findings} == {1: True, 2: True, 3: False, 4: True}
    assert told(built_in.derivation("cart-pole"), wrong) == "In line 3, the force of gravity 'g' is missing."


def test_a_name_for_a_force_that_is_another_one() -> None:
    wrong = "R = 3 b x'\n" + CART.replace("b x'", "R")
    assert (
        told(built_in.derivation("cart-pole"), wrong)
        == "Line 1 is not right: the force of damper 'b' is b*x', not 3*b*x'."
    )


def law_of(answer: str) -> dict[int, tuple[bool, bool]]:
    """Whether each line is right, and follows from another."""
    verdict = check_answer(lift(), answer)
    assert not verdict.right and verdict.first_wrong is not None and verdict.first_wrong.line.number == 4
    return {f.line.number: (f.status.right, f.follows) for f in verdict.findings}


@pytest.mark.parametrize("law", ["k (y + x)", "k y", "k (x - y)/2"])
def test_what_is_wrong_by_a_wrong_law_follows_from_it(law: str) -> None:
    found = law_of(LIFT.replace("F = k (y - x)", f"F = {law}").replace("k (y - x)", law))
    assert all(found.get(k, (False, True)) == (False, True) for k in (2, 3, 6, 7)), found
    assert found[4] == (False, False)


def test_a_line_with_a_mistake_of_its_own_does_not_follow_from_a_wrong_law() -> None:
    wrong = LIFT.replace("F = k (y - x)", "F = k y").replace("k (y - x)", "k y").replace("m y'' + k y", "m y'' - k y")
    assert law_of(wrong)[7] == (False, False)


@cache
def hoist() -> lg.Derivation:
    """One coordinate: a load m on a drum J of radius R, which pulls a car M on a level track against a spring k."""
    s = lg.System("hoist")
    x = s.coordinate("x")
    M, m, J, R, k, c, g = s.parameters("M m J R k c g")
    car = s.point("car", (x, 0))
    s.particle(m, at=s.point("load", (R, -x)), name="load")
    s.particle(M, at=car, name="car")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(-x / R, name="drum"), name="drum")
    s.gravity((0, -1), g)
    s.spring(k, between=(car, s.point("wall", (-5 * R, 0))), rest=5 * R)
    s.damper(b=c, deflection=x / R)
    return s.derive()


HOIST = """m x'' = m g - S
J x''/R = S R - Z R - c x'/R
M x'' = Z - k x
S = m g - m x''
Z = M x'' + k x
(m + M + J/R^2) x'' + c x'/R^2 + k x = m g"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("line", "old", "new", "said"),
    [
        (1, "m x'' = m g", "m x'' = -m g", "-g*m has the wrong sign"),
        (2, "S R - Z R", "Z R - S R", "has the wrong sign"),
        (2, "S R - Z R", "S - Z", "should be"),
        (2, "S R - Z R", "S R + Z R", "R*Z has the wrong sign"),
        (2, "- c x'/R\n", "- c x'\n", "the force of damper 'c' has the factor R too much"),
        (2, "J x''/R =", "J x'' =", "J*x'' should be J*x''/R"),
        (3, "Z - k x", "Z + k x", "the force of spring 'k' has the wrong sign"),
    ],
)
def test_balances_of_a_system_with_one_coordinate(line: int, old: str, new: str, said: str) -> None:
    assert check_answer(hoist(), HOIST).right
    verdict = check_answer(hoist(), HOIST.replace(old, new, 1))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [line]
    assert f"n line {line}" in str(verdict.mistakes[0].what) and said in str(verdict.mistakes[0].what)


def test_a_final_equation_follows_from_a_wrong_balance_of_one_coordinate() -> None:
    wrong = (
        HOIST.replace("S R - Z R", "S R + Z R")
        .replace("(m + M + J", "(m - M + J")
        .replace("+ k x = m g", "- k x = m g")
    )
    verdict = check_answer(hoist(), wrong)
    assert [(f.line.number, f.follows) for f in verdict.findings if not f.status.right] == [(2, False), (6, True)]


def test_a_line_that_follows_from_a_wrong_balance_is_no_second_balance() -> None:
    added = "(J/R + M R) x'' = S R - c x'/R - k x R\n"
    assert check_answer(hoist(), HOIST.replace("S = m g", f"{added}S = m g")).right
    wrong = (
        HOIST.replace("S R - Z R", "S R + Z R")
        .replace("(m + M + J", "(m - M + J")
        .replace("+ k x = m g", "- k x = m g")
    )
    wrong = wrong.replace(
        "S = m g", f"{added.replace('M R', '-M R').replace('+ -', '- ').replace('- k x R', '+ k x R')}S = m g"
    )
    verdict = check_answer(hoist(), wrong)
    assert [(f.line.number, f.follows) for f in verdict.findings if not f.status.right] == [
        (2, False),
        (4, True),
        (7, True),
    ]
    assert "R*Z has the wrong sign" in str(verdict.mistakes[0].what)


def test_a_force_that_may_lack_in_two_lines_lacks_where_its_angle_stands() -> None:
    """A block that slides on a wagon's ramp, with a rope from the wagon: its pull is forgotten on the wagon."""
    s = lg.System("ramp")
    x, q = s.coordinates("x q")
    M, m, n, a, g, k = s.parameters("M m n a g k")
    s.particle(M, at=s.point("wagon", (x, 0)), name="wagon")
    s.particle(m, at=s.point("block", (x + q * sp.cos(a), -q * sp.sin(a))), name="block")
    s.particle(n, at=s.point("load", (x, q)), name="load")
    s.gravity((0, -1), g)
    s.spring(k, deflection=x)
    s.damper(s.parameter("c"), deflection=q)
    answer = """m (q'' + x'' cos(a)) = m g sin(a) - S - R
R = c q'
m x'' sin(a) = N - m g cos(a)
n q'' = S - n g
n x'' = B
M x'' = (S + R) cos(a) - k x - B - N sin(a)
(M + m + n) x'' + m q'' cos(a) + k x = 0
(m + n) q'' + m x'' cos(a) + c q' = m g sin(a) - n g"""
    derivation = s.derive()
    assert check_answer(derivation, answer).right
    verdict = check_answer(derivation, answer.replace("(S + R) cos(a)", "R cos(a)"))
    wrong = [f.line.number for f in verdict.findings if not f.status.right]
    assert wrong == [6], wrong
    assert "on the right-hand side, the term S*cos(a) is missing" in str(verdict.mistakes[0].what)
