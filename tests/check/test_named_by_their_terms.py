"""A cause that shows as one term is told by this term, and a sign by the force that has it."""

from __future__ import annotations

import re
from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian.check.verdict import Status
from lagrangian.model import time

CART = "(M+m)*x'' + b*x' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2 = F"
POLE = "(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = 0"


@cache
def belt() -> lg.Derivation:
    """Two pulleys with both strands of an elastic belt."""
    s = lg.System("belt")
    p, q = s.coordinates("p q")
    J, r, R, k, b = s.parameters("J r R k b")
    s.kinetic(J * (p.diff() ** 2 + q.diff() ** 2) / 2)
    for name, way in (("tight", r * p - R * q), ("slack", R * q - r * p)):
        s.spring(k=k, deflection=way, name=name)
        s.damper(b=b, deflection=way, name=f"{name} damper")
    return s.derive()


def first(system: str | lg.Derivation, answer: str) -> str:
    verdict = (derivation(system) if isinstance(system, str) else system).check(answer)
    assert not verdict.right
    return str(verdict.mistakes[0].what)


@pytest.mark.slow
def test_a_term_that_is_missing_stands_before_the_reason() -> None:
    said = first("cart-pole", CART.replace(" - m*l*sin(theta)*theta'^2", "") + "\n" + POLE)
    assert said.startswith("The term -l*m*sin(theta)*theta'^2 of the equation of x is missing. A possible reason: ")


@pytest.mark.slow
def test_a_hint_tells_no_reason_for_a_term_that_is_missing() -> None:
    """Below the terms a misconception has no words for what was done, only those of its reason."""
    answer = CART.replace(" - m*l*sin(theta)*theta'^2", "") + "\n" + POLE
    named = derivation("cart-pole").check(answer).mistakes[0]
    _, _, cause = str(named.what).partition("A possible reason: ")
    assert named.brief is None and cause
    hinted = derivation("cart-pole").check(answer, hint=2)
    assert cause not in " ".join(hinted.to_text().split()) and cause not in str(hinted.to_dict())


def test_a_generalized_force_with_the_wrong_sign_is_on_no_wrong_side() -> None:
    said = first("cart-pole", f"Xi_x = -F + b*x'\nXi_theta = 0\n{CART}\n{POLE}")
    assert "wrong sign" in said and "side" not in said


KINETIC = "T = (M+m)*x'^2/2 + m*l*x'*theta'*cos(theta) + (J+m*l^2)*theta'^2/2"
MOMENTUM = "dT/dtheta' = (J+m*l^2)*theta' + m*l*x'*cos(theta)"
RATE = "d/dt dT/dtheta' = (J+m*l^2)*theta'' + m*l*x''*cos(theta) - m*l*x'*theta'*sin(theta)"


def test_a_wrong_derivative_is_told_by_its_term_and_one_that_is_right_is_no_cause() -> None:
    sheet = f"{KINETIC}\n{MOMENTUM}\n{RATE}\ndT/dtheta = 0\n{CART}\n{POLE} - m*l*x'*theta'*sin(theta)"
    verdict = derivation("cart-pole").check(sheet.replace("= 0 -", "-") + " = 0")
    assert [f.line.number for f in verdict.findings if f.status is Status.WRONG and not f.follows] == [4]
    assert str(verdict.mistakes[0].what) == "In ∂T*/∂theta, the term -l*m*sin(theta)*theta'*x' is missing."
    assert len(verdict.mistakes) == 1


@cache
def shaken() -> lg.Derivation:
    """A pendulum with a spring, whose support moves as a sin(w t)."""
    s = lg.System("shaken")
    r, theta = s.coordinates("r theta")
    m, k, a, w = s.parameters("m k a w")
    support = s.point("A", (a * sp.sin(w * time), 0))
    s.particle(m, at=s.point("B", (r * sp.sin(theta), -r * sp.cos(theta)), relative_to=support))
    s.spring(k, deflection=r)
    return s.derive()


@pytest.mark.slow
def test_a_kinetic_energy_with_an_index_is_that_of_derivatives_and_a_wrong_function_of_time_is_told() -> None:
    verdict = shaken().check(
        "d^2/dt^2 (a sin(w t)) = -a w^2 cos(w t)\nT_rel = m (r'^2 + r^2 theta'^2)/2\nd/dt(dT/dr') = m r''\n"
        "d/dt(dT/dtheta') = m r^2 theta''\ndT/dr = m r theta'^2\n"
        "m r'' - m r theta'^2 + k r = m a w^2 cos(w t) sin(theta)"
    )
    assert [f.status is Status.WRONG for f in verdict.findings] == [True, False, True, False, True]
    assert str(verdict.mistakes[0].what) == "In line 1, a*w^2*cos(t*w) is not the same as a*w^2*sin(t*w)."
    assert any("2*m*r*r'*theta' is missing" in str(m.what) for m in verdict.mistakes[:2])
    assert not any("T_rel" in str(note) and "not judged" in str(note) for note in verdict.notes)


@pytest.mark.slow
def test_a_wrong_function_is_told_by_the_term_that_has_it() -> None:
    rows = "m r'' - m r theta'^2 + k r = m a w^2 sin(w t) sin(theta)\n"
    said = first(shaken(), f"{rows}m r^2 theta'' + 2 m r r' theta' = m a w^2 r sin(w t) sin(theta)")
    assert said == (
        "In line 2, on the right-hand side: in the term a*m*w^2*r*sin(t*w)*sin(theta) of the equation of theta, "
        "sin(theta) stands in place of cos(theta)."
    )


def test_a_force_along_a_line_has_no_arm_but_a_direction() -> None:
    s = lg.System("slope")
    x, (m, k, alpha), F = s.coordinates("x"), s.parameters("m k alpha"), s.inputs("F")
    at = s.point("A", (x * sp.cos(alpha), x * sp.sin(alpha)))
    s.particle(m, at=at)
    s.spring(k, deflection=x)
    s.force((F, 0), at=at)
    assert first(s.derive(), "m x'' + k x = F").endswith("is counted whole, whatever its direction.")


@pytest.mark.slow
def test_both_strands_of_a_belt_are_taken_alike() -> None:
    way, speed = "(r*p + R*q)", "(r*p' + R*q')"
    forces = f"Xi_p = -2*b*r*{speed}\nXi_q = -2*b*R*{speed}\n"
    said = first(
        belt(), f"T = J*(p'^2 + q'^2)/2\nV = k*{way}^2\n{forces}J*p'' + 2*k*r*{way} = Xi_p\nJ*q'' + 2*k*R*{way} = Xi_q"
    )
    assert said.startswith("The deflection of spring 'tight', spring 'slack', ")
    assert said.endswith("is taken as R*q + r*p; it is -R*q + r*p.")


@pytest.mark.slow
def test_a_letter_in_one_piece_of_a_deflection() -> None:
    s = lg.System("rods")
    p, q = s.coordinates("p q")
    J, k = s.parameters("J k")
    l, c = (s.parameter(x, 1.0, unit="m") for x in "lc")
    s.kinetic(J * (p.diff() ** 2 + q.diff() ** 2) / 2)
    s.particle(J / l**2, at=s.point("end", (l * sp.sin(p), -l * sp.cos(p))))
    s.spring(k=k, deflection=c * sp.sin(q) - c * sp.sin(p), name="between")
    said = first(s.derive(), "V = k*(c*sin(q) - l*sin(p))^2/2")
    assert said.startswith("The deflection of spring 'between' is taken as c*sin(q) - l*sin(p)")


@pytest.mark.slow
def test_an_arm_of_a_damper_that_stands_once() -> None:
    said = first(belt(), "Xi_q = 2*b*(r*p' - R*q')")
    assert "damper" in said and "spring" not in said, said


@cache
def slot() -> lg.Derivation:
    """A lever whose slot drives a carriage: x = h tan θ."""
    s = lg.System("slot")
    theta, x = s.coordinates("theta x")
    J, m, h, k = s.parameters("J m h k")
    F, tau = s.inputs("F tau")
    s.kinetic((J * theta.diff() ** 2 + m * x.diff() ** 2) / 2)
    s.spring(k=k, deflection=x)
    s.force(F, deflection=x)
    s.torque(tau, on=theta)
    s.constraint(x - h * sp.tan(theta))
    return s.derive()


REDUCED = (
    "(J + m*h^2/cos(theta)^4)*theta'' + 2*m*h^2*sin(theta)/cos(theta)^5*theta'^2 + k*h^2*tan(theta)/cos(theta)^2"
    " = tau + F*h/cos(theta)^2"
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "said", "term"),
    [
        ("2*m*h^2*sin", "m*h^2*sin", "should be 2*h^2*m*sin(theta)*theta'^2/cos(theta)^5", "coefficient"),
        ("F*h/cos(theta)^2", "F*h", "the factor cos(theta)^(-2) is missing", "coefficient"),
        ("tau +", "-tau +", "wrong sign", "sign"),
    ],
)
def test_terms_are_compared_in_any_form_of_their_functions(right: str, wrong: str, said: str, term: str) -> None:
    verdict = slot().check(REDUCED.replace(right, wrong) + "\nx = h*tan(theta)")
    assert said in str(verdict.mistakes[0].what)
    (difference,) = (d for f in verdict.findings for d in f.differences)
    assert difference.kind == term


def test_an_equation_that_is_reduced_from_right_ones() -> None:
    rows = "m*x'' + k*x = F + lambda\nJ*theta'' = tau - lambda*h/cos(theta)^2\nx = h*tan(theta)\n"
    said = first(slot(), rows + REDUCED.replace("k*h^2*tan(theta)/cos(theta)^2", "k*h^2*tan(theta)"))
    assert "what spring 'k' adds" in said and "h/cos(theta)^2, not h" in said


def test_an_equation_follows_from_a_wrong_derivative() -> None:
    energies = "T = m*L^2*theta'^2/2\nV = -m*g*L*cos(theta)\ndV/dtheta = -m*g*L*cos(theta)\n"
    verdict = derivation("pendulum").check(f"{energies}m*L^2*theta'' - m*g*L*cos(theta) = -b*theta'")
    assert [f.follows for f in verdict.findings if f.status is Status.WRONG] == [False, True]
    (mistake,) = verdict.mistakes
    assert "minus the sine" in str(mistake.why)


@pytest.mark.parametrize("factor", ["h/cos(theta)", "h"])
def test_a_stated_constraint_says_which_factor_of_a_multiplier_is_wrong(factor: str) -> None:
    verdict = slot().check(f"J*theta'' = tau - lambda*{factor}\nm*x'' + k*x = F + lambda\nx = h*tan(theta)")
    assert [f.status is Status.WRONG for f in verdict.findings] == [True, False, False]
    assert str(verdict.mistakes[0].what).endswith("to fit the others, -h/cos(theta)^2 belongs there.")


@cache
def shaft() -> lg.Derivation:
    """Two disks on an elastic shaft, whose twist is a name of the system."""
    s = lg.System("shaft")
    p, q = s.coordinates("p q")
    J, n, k, b = s.parameters("J n k b")
    delta = s.define("delta", p / n - q)
    s.kinetic(J * (p.diff() ** 2 + q.diff() ** 2) / 2)
    s.spring(k=k, deflection=delta)
    s.damper(b=b, deflection=delta)
    return s.derive()


@pytest.mark.slow
def test_a_wrong_definition_is_one_mistake() -> None:
    rows = "V = k*delta^2/2\nJ*p'' + (k*delta + b*delta')/n = 0\nJ*q'' {} (k*delta + b*delta') = 0"
    verdict = shaft().check("delta = p/n + q\ndelta' = p'/n + q'\n" + rows.format("+"))
    assert [str(m.what) for m in verdict.mistakes] == ["delta is -q + p/n, not q + p/n."]
    assert all(f.follows for f in verdict.findings if f.status is Status.WRONG and f.line.number > 1)
    assert shaft().check("delta = p/n - q\n" + rows.format("-"), hint=0).right
    assert not shaft().check("delta = p/n + q\n" + rows.format("-"), hint=0).right


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("(M+m)*x'", "the term l*m*cos(theta)*theta' is missing."),
        (
            "(M+m)*x' + m*l*sin(theta)*theta'",
            "the term l*m*sin(theta)*theta' should be l*m*cos(theta)*theta'.",
        ),
    ],
)
def test_a_derivative_that_nothing_else_explains_is_told_by_its_terms(written: str, said: str) -> None:
    assert said[:-1] in first("cart-pole", f"dL/dx' = {written}")


def test_an_identity_beside_equations_is_a_right_line() -> None:
    verdict = derivation("cart-pole").check(f"{CART}\n{POLE}\nd/dt (m*x') = m*x''\n0 = 0")
    assert verdict.right
    assert [f.status.right for f in verdict.findings] == [True, True, True, False]


def test_an_inductance_is_no_lagrangian_in_what_was_read() -> None:
    told = derivation("dc-motor").check("Lq̈ + Rq̇ + Kθ̇ = u").to_text()
    assert "Lq̈ as L q̈" in told, told


@pytest.mark.slow
@pytest.mark.parametrize(
    ("derivative", "equation", "said"),
    [
        (
            "dL/dtheta' = J*theta' + m*l*x'*cos(theta)",
            POLE.replace("(J+m*l^2)", "J"),
            "the term .* is missing. A possible reason: J of .* adds to J is missing",
        ),
        ("d/dt(dL/dx') = (M+m)*x'' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^3",
         CART.replace("theta'^2", "theta'^3"), "there is the factor .*theta.* too much"),
    ],
)  # fmt: skip
def test_a_cause_in_the_energy_and_a_rate_too_much_are_told_of_derivatives(
    derivative: str, equation: str, said: str
) -> None:
    other = POLE if equation.startswith("(M") else CART
    assert re.search(said, first("cart-pole", f"{derivative}\n{equation}\n{other}"))


@pytest.mark.slow
def test_a_wrong_moment_of_inertia_about_a_pivot_is_told_as_it_is_written() -> None:
    energy = "T = 1/2 (M+m) x'^2 + m l x' theta' cos(theta) + 1/2 JA theta'^2"
    said = first("cart-pole", f"JA = J + m (l/2)^2\n{energy}\n{CART}\n{POLE.replace('m*l^2', 'm*l^2/4')}")
    assert said.startswith("Line 1 is not right: the moment of inertia of rigid body 'pole' about its pivot is J + "), (
        said
    )


def test_a_wrong_velocity_is_told_by_rates() -> None:
    s = lg.System("sleeve")
    theta, x = s.coordinates("theta x")
    m, l, g = s.parameters("m l g")
    s.particle(m, at=s.point("sleeve", (x, x - 2 * l * sp.cos(theta))), name="sleeve")
    s.gravity((0, -1), g)
    said = first(s.derive(), "T = m*(x'^2 + (x' + l*sin(theta)*theta')^2)/2\nV = m*g*(x - 2*l*cos(theta))")
    assert "l*sin(theta)*theta' stands in place of 2*l*sin(theta)*theta'" in said, said


@cache
def turning() -> lg.Derivation:
    """Two masses on a rod that nods on a turntable."""
    s = lg.System("nodding rod")
    theta = s.coordinates("theta")
    m, M, l, R, Omega, g = s.parameters("m M l R Omega g")
    for mass, arm, name in ((m, l, "near"), (M, -R, "far")):
        along = arm * sp.cos(theta)
        at = (along * sp.cos(Omega * time), along * sp.sin(Omega * time), arm * sp.sin(theta))
        s.particle(mass, at=s.point(name, at), name=name)
    s.gravity((0, 0, -1), g)
    return s.derive()


TURNING = """T = (m*l^2 + M*R^2)*(theta'^2 + Omega^2*cos(theta)^2)/2
V = (m*l - M*R)*g*sin(theta)"""
SLOPE = "(m*l^2 + M*R^2)*Omega^2*sin(theta)*cos(theta)"


@pytest.mark.parametrize(("sign", "is_right"), [("-", True), ("+", False)])
def test_no_mistake_is_placed_in_an_energy_that_is_right(sign: str, is_right: bool) -> None:
    """The sign of the derivative of a cosine is wrong, in the terms of both masses; T* has its cosine."""
    verdict = turning().check(f"{TURNING}\ndT/dtheta = {sign}{SLOPE}")
    assert verdict.findings[2].status.right == is_right
    if not is_right:
        (mistake,) = verdict.mistakes
        assert mistake.step == 5 and "has the wrong sign" in str(mistake.what)
        assert "stands in place of" not in str(mistake.what)


@pytest.mark.parametrize("above", ["", TURNING])
def test_a_slip_in_l_below_energies_that_are_right_is_made_there(above: str) -> None:
    written = "L = (m*l^2 + M*R^2)*(theta'^2 + Omega^2*sin(theta)^2)/2 - (m*l - M*R)*g*sin(theta)"
    said = first(turning(), f"{above}\n{written}")
    assert said.startswith("Not above, where it is right, but in line 3") == bool(above), said


@cache
def unbalanced() -> lg.Derivation:
    """A mass on a spring with an unbalance that turns at a given rate, and a door that it shakes."""
    s = lg.System("unbalanced")
    y, u = s.coordinates("y u")
    m, n, k, e, c, w = s.parameters("m n k e c Omega")
    s.kinetic(m * (y.diff() ** 2 + u.diff() ** 2) / 2)
    s.particle(n, at=s.point("P", (e * sp.sin(w * time), y + c * u - e * sp.cos(w * time))), name="unbalance")
    s.spring(k=k, deflection=y, name="bed")
    s.spring(k=k, deflection=u, name="door")
    return s.derive()


UNBALANCED = """T = m/2 (y'^2 + u'^2) + n/2 (y' + c u' + e Omega sin(Omega t))^2
V = k/2 (y^2 + u^2)
d/dt(dT/dy') = (m + n) y'' + n c u'' + n e Omega^2 cos(Omega t)
(m + n) y'' + n c u'' + n e Omega^2 cos(Omega t) + k y = 0
(m + n c^2) u'' + n c y'' + n c e Omega^2 cos(Omega t) + k u = 0"""


def test_a_derivative_by_time_names_its_wrong_term() -> None:
    """The inner derivative, and the sign of the derivative of a sine or cosine of time."""
    assert unbalanced().check(UNBALANCED).right
    wrong = UNBALANCED.replace("u'' + n e Omega^2", "u'' + n e Omega")
    (mistake,) = unbalanced().check(wrong).mistakes
    assert str(mistake.what).startswith("In d/dt(∂T*/∂y'): in the term") and "Omega is missing" in str(mistake.what)
    assert "inner derivative" in str(mistake.why)
    (mistake,) = unbalanced().check(UNBALANCED.replace("u'' + n e Omega^2", "u'' - n e Omega^2")).mistakes
    assert str(mistake.what).startswith("In d/dt(∂T*/∂y'), the term") and "wrong sign" in str(mistake.what)
    assert "minus the sine" in str(mistake.why)


def test_what_time_alone_adds_to_an_energy_is_no_part_of_a_mistake() -> None:
    """The component e Ω cos Ωt of the unbalance changes no equation: the mistake is that c u′ is left out."""
    wrong = "T = m/2 (y'^2 + u'^2) + n/2 (y' + e Omega sin(Omega t))^2\nV = k/2 (y^2 + u^2)"
    (mistake,) = unbalanced().check(wrong).mistakes
    assert "c*u' is left out" in str(mistake.what)
    parts = wrong.replace("T = m/2 (y'^2 + u'^2) + n", "T1 = m/2 (y'^2 + u'^2)\nT_unbalance = n")
    (mistake,) = (
        unbalanced().check(f"{parts}\n(m + n) y'' + n e Omega^2 cos(Omega t) + k y = 0\nm u'' + k u = 0").mistakes
    )
    assert "sin(Omega*t)**2" not in str(mistake.what) and "c*u' is left out" in str(mistake.what)
