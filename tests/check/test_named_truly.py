"""What is told is true of the system and of what was written: divided rows, solved rows, own terms, equal bodies.

The answers are made with SymPy from the right equations, or written by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian.check.explain.changes.pool import pool_of
from lagrangian.check.reference import truth_of
from lagrangian.model import time
from student_answers import told

SWING = "theta'' + b*L_b^2/(m*L_m^2)*theta' + k*L_k^2/(m*L_m^2)*theta + g/L_m*sin(theta) = tau"
CART = "(M+m)*x'' + b*x' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2"
POLE = "(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta)"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("name", "answer", "element", "ending"),
    [
        ("lecture-1", SWING, "torque 'tau'", "divided by L_m^2*m, but the term tau was not."),
        ("pendulum", "theta'' + b*theta'/(m*L) + g/L*sin(theta) = 0", "damper 'b'", "b*theta' only by L*m."),
        ("pendulum", "theta'' + b*theta'/(m*L^2) + m*g*sin(theta) = 0", "gravity 'g'", "sin(theta) only by L."),
        (
            "cart-pole",
            f"{CART} = F\ntheta'' + m*l*cos(theta)*x''/(J + m*l^2) - m*g*l*sin(theta) = 0",
            "gravity 'g'",
            "divided by J + l^2*m, but the term g*l*m*sin(theta) was not.",
        ),
    ],
)
def test_a_term_that_was_not_divided_as_the_others(name: str, answer: str, element: str, ending: str) -> None:
    kind, blamed, words = told(name, answer)
    assert kind == "not_divided" and blamed == element
    assert words.endswith(ending), words


BLOCK = "m*s'' + m*cos(alpha)*x'' - m*g*sin(alpha) = 0"


@cache
def cart_pole() -> tuple[sp.Matrix, sp.Matrix, dict[str, sp.Symbol], list[sp.Expr]]:
    """M and h of M ξ̈ = h, the parameters by name, and the accelerations."""
    d = derivation("cart-pole")
    a = [c.acceleration for c in d.model.coordinates]
    still = dict.fromkeys(a, sp.S.Zero)
    h = sp.Matrix([e.rhs - e.lhs.xreplace(still) for e in d.equations])
    return sp.Matrix(d.mass_matrix), h, {p.name: p.symbol for p in d.model.parameters}, a


def check_solved(accelerations: sp.Matrix) -> tuple[str, str | None, str]:
    return told("cart-pole", [sp.Eq(a, x) for a, x in zip(cart_pole()[3], accelerations, strict=True)])


def test_a_wrong_element_of_the_mass_matrix_in_solved_rows() -> None:
    M, h, p, _ = cart_pole()
    wrong = M.copy()
    wrong[0, 0] = p["M"]
    kind, element, _ = check_solved(wrong.LUsolve(h))
    assert kind == "carried_mass_forgotten" and element == "rigid body 'pole'"


@pytest.mark.slow
def test_a_wrong_denominator_of_solved_rows() -> None:
    M, h, p, _ = cart_pole()
    numerators, det = M.adjugate() * h, M.det()
    kind, _, words = check_solved(numerators / (det + p["J"] * p["m"]))
    assert kind == "denominator" and "common denominator" in words
    kind, _, words = check_solved(sp.Matrix([numerators[0] / (2 * det), numerators[1] / det]))
    assert kind == "denominator" and "x'' is 1/2 times" in words


def test_an_arm_or_a_weight_in_an_equation_where_it_does_no_work() -> None:
    kind, element, _ = told("cart-pole", f"{CART} = F\n{POLE} = F*l*cos(theta)")
    assert kind == "arm_added" and element == "force 'F'"
    kind, element, words = told("wedge", f"(M+m)*x'' + m*cos(alpha)*s'' - m*g*sin(alpha) = F\n{BLOCK}")
    assert element == "gravity 'g'" and "adds nothing to this equation" in words


def test_a_factor_that_is_not_there_is_not_missing() -> None:
    kind, _, words = told("lecture-1", SWING.replace("= tau", "= tau/(m*L_m^2)/k"))
    assert kind == "divided_by" and "divisor k too much" in words
    kind, _, words = told("lecture-3b", "(m1+m2)*x1'' + m2*x2r'' = 0\nm2*(x1''+x2r'') + k*x2r = F/k")
    assert kind == "divided_by" and "divisor k too much" in words


def test_a_term_in_place_of_another() -> None:
    kind, element, words = told("lecture-3b", "(m1+m2)*x1'' + m2*x2r'' = 0\nm2*(x1''+x2r'') + m1*x1' = F")
    assert kind == "term_replaced" and element == "spring 'k'"
    assert words == "The term m1*x1' stands where k*x2r belongs."
    kind, _, words = told("cart-pole", "T = (M+m)*x'^2/(2*m) + m*l*cos(theta)*x'*theta' + (J+m*l^2)*theta'^2/2")
    assert kind == "divided_by" and "divisor m" in words


def test_a_factor_too_much_in_a_sum_that_is_written_out() -> None:
    kind, element, words = told("lecture-3a", "m1*x1'' + k*m1*x1 - k*m1*x2 = -F\nm2*x2'' + k*(x2 - x1) = F")
    assert kind == "foreign_factor" and element == "spring 'k'" and "factor m1 too much" in words


def test_of_two_equal_bodies_either_is_named() -> None:
    s = lg.System("two pulleys")
    x = s.coordinates("x")
    m, M, R = s.parameters("m M R")
    for name in ("upper", "lower"):
        frame = s.frame(x / R)
        s.rigid_body(M, M * R**2 / 2, at=frame.origin, frame=frame, name=name)
    s.particle(m, at=s.origin + (0, -x))
    s.gravity(direction=(0, -1))
    (mistake,) = s.derive().check("T = m*x'^2/2 + M*x'^2/4").mistakes
    assert mistake.element == "rigid body 'upper' or rigid body 'lower'"


def test_a_force_without_the_dampers_is_right_only_if_they_stand_elsewhere() -> None:
    pendulum = derivation("pendulum")
    rest = "m*L^2*theta'' + m*g*L*sin(theta)"
    assert pendulum.check(f"Xi_theta = 0\n{rest} + b*theta' = 0", hint=0).right
    assert pendulum.check("D = b*theta'^2/2\nXi_theta = 0", hint=0).right
    verdict = pendulum.check(f"Xi_theta = 0\n{rest} = 0")
    assert not verdict.findings[0].status.right
    assert verdict.mistake is not None and verdict.mistake.element == "damper 'b'"


def test_a_letter_whose_value_is_1_must_be_written_if_others_are() -> None:
    pendulum = derivation("pendulum")
    verdict = pendulum.check("V = -g*L*cos(theta)")
    assert not verdict.right and verdict.mistake is not None and verdict.mistake.name == "lost"
    assert "would be right with m = 1" in str(verdict.notes[-1])
    assert pendulum.check("0.25*theta'' + 0.02*theta' + 4.905*sin(theta) = 0", hint=0).right


@pytest.mark.parametrize("name", ["cart-pole", "lecture-1", "elastic-pendulum"])
def test_what_is_called_missing_belongs_there(name: str) -> None:
    """Every change that says that a letter is missing or not squared is made where the right equations hold it."""
    pool = pool_of(truth_of(derivation(name)))
    ring = pool.sites.ring
    for possible in pool.all:
        change = possible.change
        if change is None or change.kind not in ("lost", "lost_in_a_sum", "not_squared", "factor_missing"):
            continue
        (needed,) = ring.of(change.right if change.kind != "factor_missing" else change.written)
        power = 2 if change.kind == "not_squared" else 1
        held = [dict(m) for s in change.site.sums() for m in s]
        some = all if change.kind == "factor_missing" else any
        assert some(all(m.get(a, 0) * e > 0 and abs(m[a]) >= abs(power * e) for a, e in needed) for m in held)


def pushed() -> lg.Derivation:
    """A mass in the plane on two springs, pushed by F at the angle beta from x."""
    s = lg.System("pushed mass")
    x, y = s.coordinates("x y")
    m, k, beta = s.parameters("m k beta")
    F = s.input("F")
    at = s.origin + (x, y)
    s.particle(m, at=at, name="block")
    s.spring(k, deflection=x)
    s.spring(k, deflection=y)
    s.force((F * sp.cos(beta), F * sp.sin(beta)), at=at, name="push")
    return s.derive()


def bar() -> lg.Derivation:
    """A bar of length d on two springs, lifted by F at the distance a from its left end; a motor with the gear n."""
    s = lg.System("bar")
    u, w = s.coordinates("u w")
    m, J, k, d, a, n, r = s.parameters("m J k d a n r")
    F, tau = s.input("F"), s.input("tau")
    turned = s.frame((w - u) / d)
    s.rigid_body(m, J, at=s.origin + (d / 2, (u + w) / 2), frame=turned, name="bar")
    s.spring(k, deflection=u)
    s.spring(k, deflection=w)
    s.force(F, deflection=u + a * (w - u) / d, name="lift")
    s.torque(tau, on=n * u / r, name="motor")
    return s.derive()


def carts() -> lg.Derivation:
    """A cart and a trailer on a coupling that is longer by z."""
    s = lg.System("cart and trailer")
    x, z = s.coordinates("x z")
    m, M, k = s.parameters("m M k")
    s.particle(M, at=s.origin + (x, 0), name="cart")
    s.particle(m, at=s.origin + (x - z, 0), name="trailer")
    s.particle(2 * m, at=s.origin + (x - z, 0), name="load")
    s.spring(k, deflection=z)
    return s.derive()


def only(derivation: lg.Derivation, answer: str) -> tuple[str, str]:
    """The name and the words of the one mistake in an answer."""
    (mistake,) = derivation.check(answer).mistakes
    return mistake.name, str(mistake.what)


@pytest.mark.slow
def test_a_force_that_stands_in_both_equations_is_in_neither_in_place_of_the_other() -> None:
    name, words = only(pushed(), "m*x'' + k*x = F*sin(beta)\nm*y'' + k*y = F*cos(beta)")
    assert (name, words) == ("sine_for_cosine", "Sine and cosine are exchanged in what force 'push' adds to Xi.")
    rows = "m*(u''+w'')/4 - J*(w''-u'')/d^2 + k*u = {} + n*tau/r\nm*(u''+w'')/4 + J*(w''-u'')/d^2 + k*w = {}"
    name, words = only(bar(), rows.format("F*a/d", "F*(d-a)/d"))
    assert name == "force_wrong_equation"
    assert words == "What force 'lift' adds to the Ξ of u and what it adds to the Ξ of w are exchanged."
    name, words = only(bar(), rows.format("F", "0"))
    assert "in place of" not in words


@pytest.mark.slow
def test_one_factor_of_an_arm_is_not_the_whole_arm() -> None:
    rows = "m*(u''+w'')/4 - J*(w''-u'')/d^2 + k*u = F*(d-a)/d + {}\nm*(u''+w'')/4 + J*(w''-u'')/d^2 + k*w = F*a/d"
    for written, missing in (("tau/r", "n"), ("n*tau", "1/r")):
        name, words = only(bar(), rows.format(written))
        assert name in {"force_arm", "lost"} and f"the factor {missing} is missing" in words, words
    name, words = only(bar(), rows.format("tau"))
    assert name == "force_arm" and words.endswith("comes without its arm.")


@pytest.mark.slow
def test_a_rate_is_quoted_as_it_was_written_and_as_it_belongs_there() -> None:
    name, words = only(carts(), "M*x'' = 0\n3*m*z'' + k*z = 0")
    assert "x' + z'" not in words and "z' + x'" not in words
    assert (name, words) == ("rate", "In the terms of the kinetic energy, z' stands in place of x' - z'.")


@pytest.mark.slow
def test_an_inertia_about_an_end_is_too_much_for_the_bodys_own_rate() -> None:
    more = "(J/d^2 + m/4)*(w''-u'')"
    answer = f"m*(u''+w'')/4 - {more} + k*u = F*(d-a)/d + n*tau/r\nm*(u''+w'')/4 + {more} + k*w = F*a/d"
    name, words = only(bar(), answer)
    assert name == "inertia_added" and "1/4·d^2*m too much as an inertia for" in words, words


def test_of_a_far_fetched_explanation_what_differs_is_said_first() -> None:
    first = "(M+m)*x'' + b*x' + m^2*l*cos(theta)*theta'' - m*l*sin(2*theta)*theta'^2 = F"
    verdict = derivation("cart-pole").check(f"{first}\n{POLE} = 0")
    words = str(verdict)
    assert not verdict.sure
    assert words.index("What differs in line 1 comes from the pole") < words.index("This would explain it")
    plain = derivation("cart-pole").check(f"{CART.replace('b*x', '2*b*x')} = F\n{POLE} = 0")
    assert plain.sure and "This would explain it" not in str(plain)


@pytest.mark.parametrize(
    ("energy", "said"),
    [
        ("m/2*((x' - Omega*y)^2 + y'^2)", "along axes that turn, Omega*x is left out."),
        ("m/2*((x' + Omega*y)^2 + (y' + Omega*x)^2)", "along axes that turn, Omega*y has the wrong sign."),
    ],
)
def test_parts_of_a_velocity_along_axes_that_turn(energy: str, said: str) -> None:
    """On a turntable the velocity is (x′ − Ω y, y′ + Ω x) along its axes."""
    s = lg.System("turntable")
    x, y, omega = s.coordinate("x"), s.coordinate("y"), s.parameter("Omega")
    s.particle(s.parameter("m"), at=s.point("P", (x, y), frame=s.frame(omega * time)), name="m")
    (mistake,) = s.derive().check(f"T = {energy}").mistakes
    assert said in str(mistake.what), str(mistake.what)


@pytest.mark.slow
def test_a_spring_linearized_alone_is_one_mistake_and_gravity_is_not_blamed() -> None:
    s = lg.System("two pendula")
    p, q = s.coordinate("p"), s.coordinate("q")
    m, l, a, k = (s.parameter(x) for x in ("m", "l", "a", "k"))
    for name, angle in (("left", p), ("right", q)):
        s.particle(m, at=s.point(name, (l * sp.sin(angle), -l * sp.cos(angle))), name=name)
    s.gravity((0, -1), s.parameter("g"))
    s.spring(k, deflection=a * (sp.sin(q) - sp.sin(p)), name="k")
    rows = "m*l^2*p'' + m*g*l*sin(p) - k*a^2*(q - p) = 0\nm*l^2*q'' + m*g*l*sin(q) + k*a^2*(q - p) = 0"
    (mistake,) = s.derive().check(rows).mistakes
    assert mistake.element == "spring 'k'" and "a sine was replaced by its angle" in str(mistake.what)


def test_of_two_terms_the_one_with_a_factor_too_much_is_told() -> None:
    """J θ″ = L² F: rather L stands squared than the equation was multiplied by L without its first term."""
    s = lg.System("beam with a jet")
    theta, J, L, F = s.coordinate("theta"), s.parameter("J"), s.parameter("L"), s.input("F")
    s.rigid_body(s.parameter("m"), J, at=s.origin, frame=theta, name="beam")
    s.force(F, deflection=L * theta, name="jet")
    name, words = only(s.derive(), "J*theta'' = L^2*F")
    assert name in {"squared", "force_arm", "foreign_factor"} and "multiplied" not in words, words


def test_a_change_of_alike_bodies_together_comes_before_seven_times_one_of_them() -> None:
    s = lg.System("platform on cranks")
    a, x = s.coordinates("a x")
    m, J, l, M, k = s.parameters("m J l M k")
    for name, at in (("left", 0), ("right", 1)):
        frame = s.frame(a, origin=s.origin + (at, 0))
        s.rigid_body(m, J, at=frame.point(l / 2, 0), frame=frame, name=name)
    s.particle(M, at=s.point("P", (x, 0)), name="block")
    s.spring(k, deflection=x)
    s.spring(k, deflection=a, name="torsion spring")
    verdict = s.derive().check("(2*J + 2*m*l^2)*a'' + k*a = 0\nM*x'' + k*x = 0")
    (mistake,) = verdict.mistakes
    assert "½mv² of" in str(mistake.what) and "left" in str(mistake.what) and "are 4 times what" in str(mistake.what)


def test_an_exchanged_sine_and_the_sign_of_a_spring_are_two_mistakes() -> None:
    s = lg.System("eccentric")
    x, phi = s.coordinates("x phi")
    m, M, e, k = s.parameters("m M e k")
    s.particle(M, at=s.point("A", (x, 0)), name="plank")
    s.particle(m, at=s.point("B", (x + e * sp.cos(phi), e * sp.sin(phi))), name="bob")
    s.gravity()
    s.spring(k, deflection=x)
    rows = (
        "(M + m)*x'' - m*e*sin(phi)*phi'' - m*e*cos(phi)*phi'^2 + k*x = 0\n"
        "m*e^2*phi'' - m*e*sin(phi)*x'' + m*g*e*cos(phi) = 0"
    )
    derived = s.derive()
    assert derived.check(rows, hint=0).right
    verdict = derived.check(rows.replace("+ k*x", "- k*x").replace("m*g*e*cos", "m*g*e*sin"))
    assert {m.element for m in verdict.mistakes} == {"spring 'k'", "gravity 'g'"}


@cache
def tackle() -> lg.Derivation:
    """A block that lifts a load by half its way, with a spring and a damper in between."""
    s = lg.System("tackle")
    x, z = s.coordinates("x z")
    m, M, k, c = s.parameters("m M k c", m=2, M=3, k=50, c=4)
    s.kinetic(m * x.diff() ** 2 / 2 + M * z.diff() ** 2 / 2)
    s.spring(k, deflection=z - x / 2)
    s.damper(c, deflection=z - x / 2)
    return s.derive()


@pytest.mark.parametrize(
    ("spring", "damper", "words"),
    [
        ("z - x/2", "z' - x'", "the force of damper 'c' is c*(-x'/2 + z'), not c*(-x' + z')."),
        ("z - x", "z' - x'/2", "the force of spring 'k' is k*(-x/2 + z), not k*(-x + z)."),
    ],
)
def test_a_force_with_a_factor_left_out_has_the_signs_of_the_answer(spring: str, damper: str, words: str) -> None:
    verdict = tackle().check(f"F1 = k ({spring}) + c ({damper})\nm x'' = F1/2\nM z'' = -F1")
    assert str(verdict.mistakes[0].what) == f"Line 1 is not right: {words}"


def test_a_wrong_deflection_has_the_signs_of_the_right_one() -> None:
    verdict = tackle().check("m x'' = k (z-x) + c (z'-x'/2)/2\nM z'' = -k (z-x) - c (z'-x'/2)")
    assert "is taken as -x + z; it is -x/2 + z." in str(verdict.mistakes[0].what)


def test_a_damper_that_is_put_into_the_equation_of_another_body_is_said_to_be_there() -> None:
    s = lg.System("two carts")
    x, y = s.coordinates("x y")
    m, M, k, b = s.parameters("m M k b")
    s.particle(m, at=s.point("A", (x, 0)))
    s.particle(M, at=s.point("B", (y, 0)))
    s.spring(k, deflection=y - x)
    s.damper(b, deflection=x, name="brake")
    said = s.derive().check("m x'' + k (x - y) = 0\nM y'' + b y' + k (y - x) = 0").mistakes[0].what
    assert str(said) == (
        "Damper 'brake' is counted in the equation of y, with y'; it belongs to that of x, with x'."
    ), said


def test_a_weight_that_is_forgotten_is_no_small_angle() -> None:
    verdict = derivation("cart-pole").check("V = 0")
    said = [str(m.what) for m in (*verdict.mistakes, *verdict.alternatives)]
    assert said and not any("small" in x for x in said), said


@cache
def lamps() -> lg.Derivation:
    """Two equal lamps on equal rods side by side, held parallel by a bar without mass; the hinge has friction."""
    s = lg.System("two lamps")
    w = s.coordinate("w")
    m, l, b, c, g = s.parameters("m l b c g")
    s.particle(m, at=s.point("L1", (l * sp.sin(w), -l * sp.cos(w))), name="lamp 1")
    s.particle(m, at=s.point("L2", (b + l * sp.sin(w), -l * sp.cos(w))), name="lamp 2")
    s.gravity((0, -1), g)
    s.damper(c, deflection=w, name="hinge")
    return s.derive()


def test_of_equal_weights_none_is_named_alone() -> None:
    answer = "T = m l^2 w'^2\nV = -m g l cos(w)\nQ_w = -c w'\n2 m l^2 w'' + m g l sin(w) = -c w'"
    (mistake,) = lamps().check(answer).mistakes
    said = str(mistake.what)
    assert "one of " in said and "'lamp 1'" in said and "'lamp 2'" in said and said.endswith("is missing in V."), said
