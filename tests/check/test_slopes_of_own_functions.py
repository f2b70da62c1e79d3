"""Derivatives of a function of a coordinate that an answer states, by this coordinate: dI/dθ after I(θ) = ….

Oracle: the equations of the spherical pendulum. Every form has a wrong twin.
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation

LATEX = r"""$$I(\theta) = m L^2\sin^2\theta, \qquad SLOPE = 2 m L^2\sin\theta\cos\theta$$
$$m L^2\ddot\theta - \frac12 SLOPE\,\dot\phi^2 + m g L\sin\theta = 0$$
$$I(\theta)\ddot\phi + SLOPE\,\dot\theta\dot\phi = 0$$
"""
PLAIN = """I(theta) = m L^2 sin(theta)^2, SLOPE = 2 m L^2 sin(theta) cos(theta)
m L^2 theta'' - 1/2 SLOPE phi'^2 + m g L sin(theta) = 0
I(theta) phi'' + SLOPE theta' phi' = 0
"""
IN_LATEX = [
    r"\frac{dI}{d\theta}",
    r"\frac{dI(\theta)}{d\theta}",
    r"\tfrac{\mathrm{d}I}{\mathrm{d}\theta}",
    r"\frac{d}{d\theta}I(\theta)",
    r"\frac{d}{d\theta}\left[I\right]",
    r"(dI/d\theta)",
    r"\frac{\partial I}{\partial\theta}",
    "I'(\\theta)",
]
IN_TEXT = ["dI/dtheta", "(dI/dθ)", "dI(theta)/dtheta", "d/dtheta(I)", "d/dtheta I(theta)", "I'(theta)", "∂I/∂theta"]


@pytest.mark.sampled(16)
@pytest.mark.parametrize("slope", [*IN_LATEX, *IN_TEXT])
def test_a_function_of_a_coordinate_is_differentiated_by_it(slope: str) -> None:
    written = (LATEX if "\\" in slope else PLAIN).replace("SLOPE", slope)
    verdict = derivation("spherical-pendulum").check(written)
    assert verdict.right, verdict.to_text()
    half = r"\frac12" if "\\" in slope else "1/2"
    for old, new in ((half, ""), (f"- {half}", f"+ {half}"), ("= 2 m L^2", "= m L^2")):
        assert old in written
        assert not derivation("spherical-pendulum").check(written.replace(old, new), hint=0).right


def test_a_quantity_without_arguments_is_differentiated_by_a_coordinate() -> None:
    written = LATEX.replace("SLOPE", r"\frac{dI}{d\theta}").replace(r"I(\theta)", "I")
    assert derivation("spherical-pendulum").check(written, hint=0).right
    assert not derivation("spherical-pendulum").check(written.replace(r"\frac12", ""), hint=0).right


def test_the_time_derivative_of_a_function_is_no_slope() -> None:
    written = PLAIN.replace("SLOPE theta'", "dI/dt").replace("SLOPE", "dI/dtheta")
    assert derivation("spherical-pendulum").check(written, hint=0).right
    assert not derivation("spherical-pendulum").check(written.replace("dI/dt phi'", "dI/dt theta' phi'"), hint=0).right


DECLARED = r"""\[ I(\theta)=mL^2\sin^2\theta,\qquad I'=\frac{dI}{d\theta}=2mL^2\sin\theta\cos\theta \]
\[ I''=2mL^2\cos 2\theta \]
\[ mL^2\ddot\theta-\frac12I'\dot\phi^2+mgL\sin\theta=0 \]
\[ I\ddot\phi+I'\dot\theta\dot\phi=0 \]"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "declared", [r"I'=\frac{dI}{d\theta}=", r"I'(\theta)=dI/d\theta=", r"I' = \frac{\mathrm{d}I}{\mathrm{d}\theta} ="]
)
def test_an_answer_says_that_its_primes_are_slopes(declared: str) -> None:
    written = DECLARED.replace(r"I'=\frac{dI}{d\theta}=", declared)
    verdict = derivation("spherical-pendulum").check(written)
    assert verdict.right, verdict.to_text()
    assert "slope" in verdict.to_text()
    for old, new in (
        (r"\frac12I'", "I'"),
        ("=2mL^2\\sin", "=mL^2\\sin"),
        ("I''=2m", "I''=m"),
        (r"+I'\dot\theta", r"-I'\dot\theta"),
        (r"+I'\dot\theta\dot\phi", r"+I'\dot\phi"),
        (r"+I'\dot\theta\dot\phi", r"+I''\dot\theta\dot\phi"),
    ):
        assert old in written
        assert not derivation("spherical-pendulum").check(written.replace(old, new), hint=0).right, new


def test_slopes_are_declared_in_plain_text_beside_primes_of_rates() -> None:
    written = """I = m L^2 sin(θ)^2, I' = dI/dθ = 2 m L^2 sin θ cos θ
m L^2 θ'' - 1/2 I' φ'^2 + m g L sin θ = 0
I φ'' + I' θ' φ' = 0
"""
    verdict = derivation("spherical-pendulum").check(written)
    assert verdict.right, verdict.to_text()
    for old, new in (("1/2 I'", "I'"), ("I' θ' φ'", "I' φ'"), ("= 2 m", "= m"), ("dI/dθ", "dI/dθ θ'")):
        assert not derivation("spherical-pendulum").check(written.replace(old, new), hint=0).right, new


@cache
def bar() -> lg.Derivation:
    """A bar about its end, whose tip a spring, a damper and a force hold along one direction."""
    s = lg.System("bar")
    theta = s.coordinate("theta")
    J, l, k, b = s.parameters("J l k b")
    s.kinetic(J * theta.diff() ** 2 / 2, name="bar")
    s.spring(k, deflection=l * sp.sin(theta), name="spring")
    s.damper(b, deflection=l * sp.sin(theta), name="damper")
    s.force(s.input("F"), deflection=l * sp.sin(theta), name="push")
    return s.derive()


OF_ITS_OWN = r"""I use $x=l\sin\theta$ instead of the angle.
\[T=\frac12\mu(x)\dot x^2,\qquad \mu(x)=\frac{J}{l^2-x^2}\]
With $\frac12SLOPE=\dfrac{J\,x}{(l^2-x^2)^2}$ this gives
\[\mu(x)\ddot x+\frac12SLOPE\,\dot x^2+kx=F-b\dot x\]"""
OF_ITS_OWN_IN_TEXT = """x = l sin(theta)
T = 1/2 mu(x) x'^2, mu(x) = J/(l^2 - x^2)
1/2 SLOPE = J x/(l^2 - x^2)^2
mu(x) x'' + 1/2 SLOPE x'^2 + k x = F - b x'
"""


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    "slope", [r"\mu'(x)", r"\mu'", r"\frac{d\mu}{dx}", r"\frac{\mathrm{d}\mu(x)}{\mathrm{d}x}", "mu'(x)", "dmu/dx"]
)
@pytest.mark.parametrize("letter", ["mu", "A"])
def test_a_function_of_an_own_coordinate_is_differentiated_by_it(slope: str, letter: str) -> None:
    """x is no coordinate of the system, and the function that it stands in has no rate."""
    written = (OF_ITS_OWN if "\\" in slope else OF_ITS_OWN_IN_TEXT).replace("SLOPE", slope)
    written = written.replace(r"\mu", "mu" if letter == "A" else r"\mu").replace("mu", letter)
    verdict = bar().check(written)
    assert verdict.right, verdict.to_text()
    half = r"\frac12" if "\\" in slope else "1/2 "
    first, _, last = written.rpartition(half)
    assert not bar().check(first + last).right
    wrong = written.replace("J\\,x}", "2J\\,x}").replace("J x/", "2 J x/")
    assert not bar().check(wrong).right
    assert "not right" in bar().check(wrong).to_text()


def test_the_root_beside_an_abbreviation_has_its_sign() -> None:
    """sqrt(l² − x²) is l cos θ where x = l sin θ is a coordinate, and μ beside it none."""
    force = "T = J x'^2/(2 (l^2 - x^2)), mu = J/(l^2 - x^2)\nmu x'' + J x x'^2/(l^2 - x^2)^2 + k x = F - b x'"
    written = "x = l sin(theta)\nd = sqrt(l^2 - x^2)\n" + force.replace("mu = J/(l^2 - x^2)", "mu = J/d^2")
    assert bar().check(written).right
    assert bar().check(written.replace("mu x''", "J/(d sqrt(l^2 - x^2)) x''")).right
    assert not bar().check(written.replace("mu x''", "-mu x''")).right
