"""Functions that an answer states for a letter of their own, e_r(β), and uses for its coordinates.

Oracle: an arm on the rim of a disc and two masses on springs that harden, by hand. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from student_answers import right


@cache
def arm() -> lg.Derivation:
    """A mass on an arm of length l, hinged to the rim of a disc of radius R."""
    s = lg.System("arm")
    phi, psi = s.coordinates("phi psi")
    J, R, l, m = s.parameters("J R l m")
    tau = s.inputs("tau")
    disc = s.frame(phi, name="disc")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=disc, name="disc")
    at = (R * sp.cos(phi) + l * sp.cos(phi + psi), R * sp.sin(phi) + l * sp.sin(phi + psi))
    s.particle(m, at=s.point("E", at), name="mass")
    s.torque(tau, on=disc)
    return s.derive()


@cache
def masses() -> lg.Derivation:
    """Two masses, coupled by a spring with the force k u + c u³."""
    s = lg.System("two masses")
    x, y = s.coordinates("x y")
    M, m, k, c = s.parameters("M m k c")
    s.particle(M, at=s.point("A", (x, 0)), name="first")
    s.particle(m, at=s.point("B", (y, 0)), name="second")
    s.potential(k * (y - x) ** 2 / 2 + c * (y - x) ** 4 / 4)
    return s.derive()


ARM = """\
e_r(β) = (cos β, sin β), e_φ(β) = (−sin β, cos β)
r = R·e_r(φ) + l·e_r(φ+ψ)
v = R·φ̇·e_φ(φ) + l·(φ̇ + ψ̇)·e_φ(φ+ψ)
v² = R²·φ̇² + l²·(φ̇ + ψ̇)² + 2·R·l·φ̇·(φ̇ + ψ̇)·cos ψ
T = ½·J·φ̇² + ½·m·v²
(J + m·R² + m·l² + 2·m·R·l·cos ψ)·φ̈ + (m·l² + m·R·l·cos ψ)·ψ̈ − 2·m·R·l·φ̇·ψ̇·sin ψ − m·R·l·ψ̇²·sin ψ = τ
(m·l² + m·R·l·cos ψ)·φ̈ + m·l²·ψ̈ + m·R·l·φ̇²·sin ψ = 0
"""
FORCE = """\
f(u) = k u + c u^3
M x'' = f(y - x)
m y'' = -f(y - x)
"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [("+ l·(φ̇ + ψ̇)·e_φ(φ+ψ)", "+ l·(φ̇ + ψ̇)·e_φ(ψ)"), ("e_φ(β) = (−sin β, cos β)", "e_φ(β) = (−sin β, sin β)")],
)
def test_unit_vectors_are_functions_of_an_angle(now: str, wrong: str) -> None:
    assert arm().check(ARM, hint=0).right
    assert now in ARM and not arm().check(ARM.replace(now, wrong), hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [("c u^3", "c u^2"), ("= f(y - x)", "= f(x - y)"), ("-f(y - x)", "-f(y)"), ("f(u) = k u", "f(u) = 2 k u")],
)
def test_a_force_is_a_function_of_a_deflection(now: str, wrong: str) -> None:
    assert masses().check(FORCE, hint=0).right
    assert now in FORCE and not masses().check(FORCE.replace(now, wrong), hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("letter", "last"), [("K", "½·K·φ̇²"), ("R", "½·R·φ̇²"), ("K", "½·K(ψ)·φ̇²")], ids=["K", "R of the system", "K(ψ)"]
)
def test_the_letter_of_an_energy_alone_is_the_function_that_is_stated(letter: str, last: str) -> None:
    """K in ½ K φ̇² is K(ψ), where no line says K = … and none differentiates K; R is a radius of the disc."""
    rest = "(m·l² + m·R·l·cos ψ)·φ̇·ψ̇ + ½·m·l²·ψ̇²"
    answer = f"{letter}(ψ) = J + m·R² + m·l² + 2·m·R·l·cos ψ\nT = {last} + {rest}"
    verdict = arm().check(answer)
    judged = [f.status.right for f in verdict.findings if f.line.kind != "definition"]
    assert judged == ([True] if letter == "K" else [False])
    if letter == "K":
        assert not arm().check(answer.replace("2·m·R·l", "m·R·l"), hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "slope",
    [r"\frac{d h_c}{d\theta}", r"\dfrac{\mathrm{d}h_{c}}{\mathrm{d}\theta}", r"\frac{dh_c}{d \theta}", r"dh_c/d\theta"],
)
def test_a_slope_of_an_own_quantity_is_read_in_latex(slope: str) -> None:
    written = rf"""$h_c = l\cos\theta$

${slope} = -l\sin\theta$

$(M+m)\ddot x + ml\ddot\theta\cos\theta - ml\dot\theta^2\sin\theta + b\dot x = F$

$(J+ml^2)\ddot\theta + ml\ddot x\cos\theta - mgl\sin\theta = 0$"""
    assert right(written)
    assert not right(written.replace("= -l", "= l"))
    assert not right(written.replace("- mgl", "+ mgl"))


ENERGIES = "T = 1/2 m L^2 theta'^2\nV = -m g L cos(theta)\n"
ROW = "m L^2 theta'' + b theta' + m g L sin(theta) = 0"
OF_U = "m L^2 theta'' = -U'(theta) - b theta'\nU = -m g L cos(theta)"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "sheet",
    [
        f"{ENERGIES}ℒ = T(theta') - V(theta)\n{ROW}",
        "$T = \\frac m2 L^2\\dot\\theta^2$, $V = -mgL\\cos\\theta$, $\\mathcal L = T(\\dot\\theta) - V(\\theta)$\n"
        r"$mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0$",
        OF_U,
        f"U = -m g L cos(theta)\n{OF_U.partition(chr(10))[0]}",
        "E = 1/2 m L^2 theta'^2 + U(theta)\nU = -m g L cos(theta)\n"
        "dE/dt = m L^2 theta' theta'' + U'(theta) theta' = -b theta'^2",
    ],
)
def test_an_energy_with_its_coordinate_in_brackets_is_no_product(sheet: str) -> None:
    assert right(sheet, "pendulum")
    for now, wrong in (
        ("-m g L cos", "m g L cos"),
        ("-mgL", "mgL"),
        ("b theta'", "2 b theta'"),
        ("m g L sin", "m L sin"),
    ):
        assert now not in sheet or not right(sheet.replace(now, wrong), "pendulum")
