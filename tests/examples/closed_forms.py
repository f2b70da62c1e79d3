"""Equations of motion as the books print them, residuals d/dt(∂L/∂q̇) − ∂L/∂q − Ξ in plain Python.

A second hand behind the oracle: where a book has the result, Kane's equations must give it too.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, sin
from types import SimpleNamespace

from kane_route import State

FORMS: dict[str, Callable[[State], list[float]]] = {}


def form(name: str) -> Callable[..., Callable[[State], list[float]]]:
    def keep(function: Callable[..., list[float]]) -> Callable[[State], list[float]]:
        def residual(s: State) -> list[float]:
            return function(SimpleNamespace(**s.p, **s.u, t=s.t), *[(s.q[n], s.v[n], s.a[n]) for n in s.q])

        FORMS[name] = residual
        return residual

    return keep


@form("lecture-1")
def lever(c, theta):
    """The lecture, example 1: m L_m² θ̈ + b L_b² θ̇ + k L_k² θ + m g L_m sin θ = τ."""
    q, v, a = theta
    return [c.m * c.L_m**2 * a + c.b * c.L_b**2 * v + c.k * c.L_k**2 * q + c.m * c.g * c.L_m * sin(q) - c.tau]


@form("lecture-3a")
def carts_absolute(c, x1, x2):
    """The lecture, example 3A."""
    return [
        c.m1 * x1[2] + c.k * (x1[0] - x2[0]) + c.F,
        c.m2 * x2[2] - c.k * (x1[0] - x2[0]) - c.F,
    ]


def carts_relative(c, x1, x2r):
    """The lecture, example 3B."""
    return [
        (c.m1 + c.m2) * x1[2] + c.m2 * x2r[2],
        c.m2 * x1[2] + c.m2 * x2r[2] + c.k * x2r[0] - c.F,
    ]


form("lecture-3b")(carts_relative)
form("two-carts")(carts_relative)


@form("lecture-2")
def arm_relative(c, theta1, theta2):
    """The lecture, example 2, T* and V of its step 4 differentiated by hand, with L_ab = L_a + L_b."""
    (q1, v1, a1), (q2, v2, a2) = theta1, theta2
    L_ab, far = c.L_a + c.L_b, c.m3 * c.L_c
    inner = c.m1 * c.L_a**2 + (c.m2 + c.m3) * L_ab**2
    weight = (c.m1 * c.L_a + (c.m2 + c.m3) * L_ab) * c.g * cos(q1)
    end = far * c.g * cos(q1 + q2)
    first = (
        (inner + far * c.L_c + 2 * far * L_ab * cos(q2)) * a1
        + (far * c.L_c + far * L_ab * cos(q2)) * a2
        - far * L_ab * sin(q2) * (2 * v1 * v2 + v2**2)
        + weight
        + end
    )
    second = (far * c.L_c + far * L_ab * cos(q2)) * a1 + far * c.L_c * a2 + far * L_ab * sin(q2) * v1**2 + end
    return [first, second - c.tau]


@form("double-pendulum")
def double_pendulum(c, one, two):
    """Landau and Lifshitz, Mechanics, §5, problem 1: its Lagrangian's two equations."""
    (q1, v1, a1), (q2, v2, a2) = one, two
    both, mixed = c.m1 + c.m2, c.m2 * c.L1 * c.L2
    return [
        both * c.L1**2 * a1 + mixed * (a2 * cos(q1 - q2) + v2**2 * sin(q1 - q2)) + both * c.g * c.L1 * sin(q1),
        c.m2 * c.L2**2 * a2 + mixed * (a1 * cos(q1 - q2) - v1**2 * sin(q1 - q2)) + c.m2 * c.g * c.L2 * sin(q2),
    ]


@form("cart-pole")
def cart_pole(c, x, theta):
    """A pendulum whose support moves along a line (Landau and Lifshitz, §5, problem 2), inverted, with J, b and F."""
    (_, vx, ax), (q, v, a) = x, theta
    return [
        (c.M + c.m) * ax + c.m * c.l * (a * cos(q) - v**2 * sin(q)) + c.b * vx - c.F,
        (c.J + c.m * c.l**2) * a + c.m * c.l * cos(q) * ax - c.m * c.g * c.l * sin(q),
    ]


@form("kapitza-pendulum")
def kapitza(c, theta):
    """Landau and Lifshitz, §5, problem 3 (c), from upright: gravity g becomes g plus the pivot's acceleration."""
    q, v, a = theta
    pivot = -c.a * c.omega**2 * cos(c.omega * c.t)
    return [c.m * c.L**2 * a - c.m * c.L * (c.g + pivot) * sin(q) + c.b * v]


@form("spinning-top")
def spinning_top(c, phi, theta, psi):
    """Landau and Lifshitz, §35, problem 1: L = ½ I₁'(θ̇² + φ̇² sin²θ) + ½ I₃(ψ̇ + φ̇ cos θ)² − m g l cos θ."""
    (_, vf, af), (q, v, a), (_, vs, as_) = phi, theta, psi
    inertia = c.A + c.m * c.l**2
    spin, spin_rate = vs + vf * cos(q), as_ + af * cos(q) - vf * v * sin(q)
    return [
        inertia * (af * sin(q) ** 2 + 2 * vf * v * sin(q) * cos(q)) + c.C * (spin_rate * cos(q) - spin * v * sin(q)),
        inertia * (a - vf**2 * sin(q) * cos(q)) + c.C * spin * vf * sin(q) - c.m * c.g * c.l * sin(q),
        c.C * spin_rate,
    ]


@form("spherical-pendulum")
def spherical_pendulum(c, theta, phi):
    """Newton's law in spherical coordinates: a_θ = L(θ̈ − φ̇² sin θ cos θ), and d/dt of m L² sin²θ φ̇ is zero."""
    (q, v, a), (_, vf, af) = theta, phi
    return [
        c.m * c.L**2 * (a - vf**2 * sin(q) * cos(q)) + c.m * c.g * c.L * sin(q),
        c.m * c.L**2 * (af * sin(q) ** 2 + 2 * v * vf * sin(q) * cos(q)),
    ]


@form("elastic-pendulum")
def elastic_pendulum(c, r, theta):
    """Newton's law in polar coordinates: a_r = r̈ − r θ̇², a_θ = r θ̈ + 2 ṙ θ̇."""
    (x, vx, ax), (q, v, a) = r, theta
    return [
        c.m * (ax - x * v**2) + c.k * (x - c.L_0) - c.m * c.g * cos(q),
        c.m * x * (x * a + 2 * vx * v) + c.m * c.g * x * sin(q),
    ]


@form("bead-on-hoop")
def bead_on_hoop(c, theta):
    """m R² θ̈ = m R² Ω² sin θ cos θ − m g R sin θ: balance of moments in the hoop's axes, centrifugal force included."""
    q, _, a = theta
    return [c.m * c.R**2 * (a - c.Omega**2 * sin(q) * cos(q)) + c.m * c.g * c.R * sin(q)]


@form("atwood")
def atwood(c, x):
    """(m₁ + m₂ + J/R²) ẍ = (m₁ − m₂) g."""
    return [(c.m1 + c.m2 + c.J / c.R**2) * x[2] - (c.m1 - c.m2) * c.g]


@form("swinging-atwood")
def swinging_atwood(c, r, theta):
    """(M + m) r̈ = m r θ̇² + m g cos θ − M g and r θ̈ + 2 ṙ θ̇ + g sin θ = 0 (Tufillaro, Abbott and Griffiths 1984)."""
    (x, vx, ax), (q, v, a) = r, theta
    return [
        (c.M + c.m) * ax - c.m * x * v**2 + c.M * c.g - c.m * c.g * cos(q),
        c.m * x * (x * a + 2 * vx * v + c.g * sin(q)),
    ]


@form("wedge")
def wedge(c, x, s):
    """Momentum along the floor; the block along the slope, which the wedge's acceleration tilts."""
    return [
        (c.M + c.m) * x[2] + c.m * cos(c.alpha) * s[2] - c.F,
        c.m * (s[2] + x[2] * cos(c.alpha)) - c.m * c.g * sin(c.alpha),
    ]


@form("rolling-cylinder")
def rolling_cylinder(c, x):
    """(m + J/R²) ẍ = m g sin α."""
    return [(c.m + c.J / c.R**2) * x[2] - c.m * c.g * sin(c.alpha)]


@form("bead-on-parabola")
def bead_on_parabola(c, x):
    """m (1 + 4 c² x²) ẍ + 4 m c² x ẋ² + 2 m g c x = 0."""
    q, v, a = x
    return [c.m * (1 + 4 * c.c**2 * q**2) * a + 4 * c.m * c.c**2 * q * v**2 + 2 * c.m * c.g * c.c * q]


@form("duffing")
def duffing(c, x):
    """m ẍ + b ẋ + k x + k₃ x³ = F₀ cos ωt."""
    q, v, a = x
    return [c.m * a + c.b * v + c.k * q + c.k3 * q**3 - c.F_0 * cos(c.omega * c.t)]


@form("pendulum")
def pendulum(c, theta):
    """m L² θ̈ + b θ̇ + m g L sin θ = 0."""
    q, v, a = theta
    return [c.m * c.L**2 * a + c.b * v + c.m * c.g * c.L * sin(q)]
