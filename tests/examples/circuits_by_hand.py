"""The built-in circuits once more, by hand: Kirchhoff's voltage law for the loop, Newton's second law for the body.

Nothing is derived from an energy: the voltage of a coil is the rate of its flux linkage, written out, and the forces
are those that books print.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from kane_route import Residual, residual
from sympy import Symbol, cosh, log, sin, symbols, tanh

g = Symbol("g")


@dataclass(frozen=True)
class ByHand:
    """Equations as r_i = 0, row by row, in q, q_rate, q_acceleration, constants and inputs."""

    names: tuple[str, ...]
    rows: tuple[sp.Expr, ...]

    def residual(self) -> Residual:
        return residual(self.rows, self.names)


def moving(name: str) -> tuple[sp.Symbol, sp.Symbol, sp.Symbol]:
    return Symbol(name), Symbol(f"{name}_rate"), Symbol(f"{name}_acceleration")


def motor() -> ByHand:
    """Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, section 2.3: the DC motor; an arm added."""
    _, i, di = moving("q")
    theta, w, dw = moving("theta")
    L, R, K, J, m, l, b, u = symbols("L R K J m l b u")
    return ByHand(
        ("q", "theta"), (L * di + R * i + K * w - u, (J + m * l**2) * dw + b * w + m * g * l * sin(theta) - K * i)
    )


def levitation() -> ByHand:
    """Khalil, Nonlinear Systems, 3rd ed., exercise 1.18, with an L(y) that saturates: the force is ∂T*/∂y."""
    _, i, di = moving("q")
    y, v, dv = moving("y")
    m, b, R, L1, L0, a, i0, u = symbols("m b R L_1 L_0 a i_0 u")
    near = 1 + y / a
    by_current = L1 + L0 / near / cosh(i / i0) ** 2
    by_position = -L0 * i0 * tanh(i / i0) / (a * near**2)
    pull = L0 * i0**2 * log(cosh(i / i0)) / (a * near**2)  # upward, against y
    return ByHand(("q", "y"), (by_current * di + by_position * v + R * i - u, m * dv + b * v - m * g + pull))


def loudspeaker() -> ByHand:
    """Beranek, Acoustics, McGraw-Hill 1954, section 7.3: the direct-radiator loudspeaker."""
    _, i, di = moving("q")
    x, v, dv = moving("x")
    m, k, b, Bl, R, L, u = symbols("m k b Bl R L u")
    return ByHand(("q", "x"), (L * di + R * i + Bl * v - u, m * dv + b * v + k * x - Bl * i))


def actuator() -> ByHand:
    """Senturia, Microsystem Design, Kluwer 2001, section 6.4: the plates attract each other with q²/(2 ε A)."""
    q, i, di = moving("q")
    x, v, dv = moving("x")
    m, k, b, A, d, epsilon, R, L, u = symbols("m k b A d epsilon R L u")
    voltage = q * (d - x) / (epsilon * A)
    return ByHand(("q", "x"), (L * di + R * i + voltage - u, m * dv + b * v + k * x - q**2 / (2 * epsilon * A)))


BY_HAND = {
    "dc-motor": motor,
    "magnetic-levitation": levitation,
    "loudspeaker": loudspeaker,
    "capacitive-actuator": actuator,
}
