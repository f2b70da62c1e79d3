"""An inductance L(x), its slope dL/dx and L'(x) are no Lagrangian."""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg

EQUATIONS = "{0} q'' + {1} x' q' + R q' = u\nm x'' - {1} q'^2/2 + k x = 0"


@cache
def solenoid() -> lg.Derivation:
    s = lg.System("solenoid")
    q, x = s.coordinates("q x")
    m, k, R, L0, a = s.parameters("m k R L0 a")
    s.particle(m, at=s.point("plunger", (x, 0)))
    s.spring(k=k, deflection=x)
    s.inductor(L0 * a / (a + x), charge=q)
    s.resistor(R, charge=q)
    s.voltage_source(s.inputs("u"), charge=q)
    return s.derive()


VALUES = EQUATIONS.format("L0 a/(a + x)", "(-L0 a/(a + x)^2)")

CURVE, SLOPE = r"\frac{L0 a}{a + x}", r"\frac{L0 a}{(a + x)^2}"
LATEX = rf"""
$$ {CURVE} \ddot q - {SLOPE} \dot x \dot q + R \dot q = u $$
$$ m \ddot x + \frac{{1}}{{2}} {SLOPE} \dot q^2 + k x = 0 $$
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "right"),
    [
        (f"L(x) = L0 a/(a + x)\ndL/dx = -L0 a/(a + x)^2\n{VALUES}", True),
        (f"L(x) = L0 a/(a + x)\ndL/dx = -L0/(a + x)^2\n{VALUES}", False),
        ("L(x) = L0 a/(a + x)\n" + EQUATIONS.format("L(x)", "L'(x)"), True),
        ("L(x) = L0 a/(a + x)\n" + EQUATIONS.format("L(x)", "dL/dx"), True),
        ("L(x) = L0 a/(a + x)\n" + EQUATIONS.format("L(x)", "(-L'(x))"), False),
        (f"z = x\nL(z) = L0 a/(a + z)\nT = L0 a/(a + z) q'^2/2 + m z'^2/2\n{VALUES}", True),
        (f"L(x) = L0 a/(a + x)\nL = L(x) q'^2/2 + m x'^2/2 - k x^2/2\ndL/dx = L0 a/(a + x)^2 - k x\n{VALUES}", False),
        (rf"$L(x) = {CURVE}$, $\frac{{\partial L}}{{\partial x}} = -{SLOPE}$" + LATEX, True),
        (rf"$L(x) = {CURVE}$, $L'(x) = {SLOPE}$" + LATEX, False),
    ],
)
def test_an_inductance_and_its_slope_are_judged_as_such(answer: str, right: bool) -> None:
    assert solenoid().check(answer, hint=0).right is right


@cache
def choke() -> lg.Derivation:
    s = lg.System("choke that saturates")
    q = s.coordinate("q")
    L, c, R = s.parameters("L c R")
    s.inductor(charge=q, law=lambda i: L * i - c * i**3, name="coil")
    s.resistor(R, charge=q)
    s.voltage_source(s.input("u"), charge=q)
    return s.derive()


CHOKE = """psi = L q' - c q'^3
CO = L q'^2/2 - c q'^4/4
EN = psi q' - CO = L q'^2/2 - 3 c q'^4/4
T* = L q'^2/2 - c q'^4/4
(L - 3 c q'^2) q'' + R q' = u"""
CHOKE_IN_LATEX = r"""\[ \psi = L\dot q - c\dot q^3, \qquad CO = \tfrac12 L\dot q^2 - \tfrac14 c\dot q^4 \]
\[ \begin{aligned} EN &= \psi\dot q - CO \\ &= \tfrac12 L\dot q^2 - \tfrac34 c\dot q^4 \end{aligned} \]
\[ T^* = CO \]
\[ (L - 3 c\dot q^2)\ddot q + R\dot q = u \]"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "co", "stored"),
    [
        (CHOKE, "T*_coil", "T_coil"),
        (CHOKE, "T*_L", "T_L"),
        (CHOKE.replace("CO =", "T* =", 1), "T*", "T"),
        (CHOKE_IN_LATEX, r"T^{*}_{\mathrm{coil}}", r"T_{\mathrm{coil}}"),
        (CHOKE_IN_LATEX, "T^*_1", "T_1"),
        (CHOKE_IN_LATEX, r"T_{\text{coil}}^*", r"T_{\text{coil}}"),
    ],
)
@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("", ""),
        ("- CO", "+ CO"),
        ("3 c q'^4/4", "c q'^4/4"),
        (r"- \tfrac34 c", r"+ \tfrac34 c"),
        ("c q'^4/4\nEN", "c q'^4/2\nEN"),
    ],
)
def test_the_energy_of_a_coil_beside_its_coenergy(answer: str, co: str, stored: str, old: str, new: str) -> None:
    written = answer.replace(old, new)
    verdict = choke().check(written.replace("CO", co).replace("EN", stored))
    assert verdict.right is (not old or written == answer), verdict.to_text()
