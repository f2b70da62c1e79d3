"""Systems given by energies as textbooks print them, against the same systems described by their bodies.

Energies: Goldstein, Poole & Safko, Classical Mechanics (3rd ed. 2002), ch. 1-2 and 6; Landau & Lifshitz, Mechanics
(3rd ed. 1976), §5 and its problems; the cart-pole is Ogata's (Modern Control Engineering, 5th ed. 2010, ex. 3-5).
"""

from collections.abc import Callable

import numpy as np
import pytest
from sympy import Rational, cos, sin

import lagrangian as lg
from size import rest_slow

Pair = tuple[lg.System, lg.System]
HALF = Rational(1, 2)


def empty(coordinates: str, parameters: str) -> tuple[lg.System, ...]:
    made = []
    for name in ("bodies", "energies"):
        s = lg.System(name)
        s.coordinates(coordinates)
        s.parameters(parameters)
        made.append(s)
    return tuple(made)


def symbols(s: lg.System, names: str) -> list:
    return [s[name] for name in names.split()]


def double_pendulum(*, relative: bool) -> Pair:
    bodies, energies = empty("a b", "m1 m2 l1 l2 g")
    for s in (bodies, energies):
        a, b, m1, m2, l1, l2, g = symbols(s, "a b m1 m2 l1 l2 g")
        c = a + b if relative else b
        if s is bodies:
            p1 = s.origin + (l1 * sin(a), -l1 * cos(a))
            p2 = p1 + (l2 * sin(c), -l2 * cos(c))
            s.particle(m1, at=p1)
            s.particle(m2, at=p2)
            s.gravity(g=g, direction=(0, -1))
        else:
            w1, w2 = a.diff(), c.diff()
            s.kinetic(
                HALF * (m1 + m2) * l1**2 * w1**2 + HALF * m2 * l2**2 * w2**2 + m2 * l1 * l2 * w1 * w2 * cos(a - c)
            )
            s.potential(-(m1 + m2) * g * l1 * cos(a) - m2 * g * l2 * cos(c))
    return bodies, energies


def cart_pole() -> Pair:
    bodies, energies = empty("x a", "M m l J g")
    for s in (bodies, energies):
        x, a, M, m, l, J, g = symbols(s, "x a M m l J g")
        if s is bodies:
            cart = s.origin + (x, 0)
            s.particle(M, at=cart)
            pole = s.frame(angle=-a)
            s.rigid_body(m, J, at=cart + (l * sin(a), l * cos(a)), frame=pole)
            s.gravity(g=g, direction=(0, -1))
        else:
            v, w = x.diff(), a.diff()
            s.kinetic(HALF * (M + m) * v**2 + m * l * cos(a) * v * w + HALF * (J + m * l**2) * w**2)
            s.potential(m * g * l * cos(a))
    return bodies, energies


def relative_carts() -> Pair:
    bodies, energies = empty("x y", "m1 m2 k")
    for s in (bodies, energies):
        x, y, m1, m2, k = symbols(s, "x y m1 m2 k")
        if s is bodies:
            s.particle(m1, at=s.origin + (x, 0))
            s.particle(m2, at=s.origin + (x + y, 0))
            s.spring(k, deflection=y)
        else:  # T* multiplied out: the rates stand alone, times a mass, and in a product
            s.kinetic(
                HALF * (m1 + m2) * x.diff() ** 2 + m2 * x.diff() * y.diff() + HALF * m2 * y.diff() ** 2,
            )
            s.potential(HALF * k * y**2)
    return bodies, energies


def elastic_pendulum() -> Pair:
    bodies, energies = empty("r a", "m k l g")
    for s in (bodies, energies):
        r, a, m, k, l, g = symbols(s, "r a m k l g")
        if s is bodies:
            s.particle(m, at=s.origin + (r * sin(a), -r * cos(a)))
            s.spring(k, deflection=r, rest=l)
            s.gravity(g=g, direction=(0, -1))
        else:
            s.kinetic(HALF * m * (r.diff() ** 2 + r**2 * a.diff() ** 2))
            s.potential(HALF * k * (r - l) ** 2 - m * g * r * cos(a))
    return bodies, energies


def bead_on_a_turning_hoop() -> Pair:
    bodies, energies = empty("a", "m R w g")
    for s in (bodies, energies):
        a, m, R, w, g = symbols(s, "a m R w g")
        if s is bodies:
            t = s.t
            s.particle(m, at=s.origin + (R * sin(a) * cos(w * t), R * sin(a) * sin(w * t), -R * cos(a)))
            s.gravity(g=g, direction=(0, 0, -1))
        else:
            s.kinetic(HALF * m * R**2 * (a.diff() ** 2 + w**2 * sin(a) ** 2))
            s.potential(-m * g * R * cos(a))
    return bodies, energies


def spherical_pendulum() -> Pair:
    bodies, energies = empty("a b", "m l g")
    for s in (bodies, energies):
        a, b, m, l, g = symbols(s, "a b m l g")
        if s is bodies:
            s.particle(m, at=s.origin + (l * sin(a) * cos(b), l * sin(a) * sin(b), -l * cos(a)))
            s.gravity(g=g, direction=(0, 0, -1))
        else:
            s.kinetic(HALF * m * l**2 * (a.diff() ** 2 + sin(a) ** 2 * b.diff() ** 2))
            s.potential(-m * g * l * cos(a))
    return bodies, energies


def pendulum_on_a_slope() -> Pair:
    """A block on a slope, its pendulum's bob in the block's own skew coordinates: every rate is coupled."""
    bodies, energies = empty("s a z", "M m l c g")
    for made in (bodies, energies):
        s, a, z, M, m, l, c, g = symbols(made, "s a z M m l c g")
        if made is bodies:
            block = made.origin + (s * cos(c), s * sin(c))
            made.particle(M, at=block)
            bob = block + (l * sin(a) + z * cos(c), -l * cos(a) + z * sin(c))
            made.particle(m, at=bob)
            made.gravity(g=g, direction=(0, -1))
        else:
            u, w, v = s.diff(), a.diff(), z.diff()
            made.kinetic(HALF * (M + m) * u**2 + m * u * v + HALF * m * v**2)
            made.kinetic(HALF * m * l**2 * w**2 + m * l * w * cos(a - c) * (u + v))
            made.potential((M * s + m * (s + z)) * g * sin(c) - m * g * l * cos(a))
    return bodies, energies


SYSTEMS: dict[str, Callable[[], Pair]] = {
    "double pendulum, absolute": lambda: double_pendulum(relative=False),
    "double pendulum, relative": lambda: double_pendulum(relative=True),
    "cart-pole": cart_pole,
    "carts, relative": relative_carts,
    "elastic pendulum": elastic_pendulum,
    "bead on a turning hoop": bead_on_a_turning_hoop,
    "spherical pendulum": spherical_pendulum,
    "pendulum on a slope": pendulum_on_a_slope,
}


@pytest.mark.parametrize("name", rest_slow(SYSTEMS, {"carts, relative"}))
def test_energies_from_a_book_compile_to_the_dynamics_of_the_bodies(name: str) -> None:
    bodies, energies = SYSTEMS[name]()
    one, two = bodies.compile(), energies.compile()
    rng = np.random.default_rng(7)
    n = len(one.coordinates)
    q, v, a = rng.uniform(0.3, 1.2, (3, 20, n))
    p = rng.uniform(0.5, 1.5, len(one.parameters))
    M = one.mass_matrix(q, p=p)
    for got, expected in [
        (two.mass_matrix(q, p=p), M),
        (two.forward(q, v, p=p, t=0.7), one.forward(q, v, p=p, t=0.7)),
        (two.inverse(q, v, a, p=p, t=0.7), one.inverse(q, v, a, p=p, t=0.7)),
        (two.bias(q, v, p=p, t=0.7), one.bias(q, v, p=p, t=0.7)),
        (two.coriolis_matrix(q, v, p=p, t=0.7), one.coriolis_matrix(q, v, p=p, t=0.7)),
        (two.potential_force(q, p=p) - one.potential_force(q, p=p), 0 * q)
        if name != "bead on a turning hoop"
        else (q, q),
    ]:
        assert np.abs(got - expected).max() < 1e-11 * max(1.0, np.abs(expected).max())


def test_rates_that_are_coupled_have_the_mass_matrix_of_their_quadratic_form() -> None:
    """T* = ẋ² + c ẋẏ + c ẏ² has M = [[2, c], [c, 2c]], however the energy is written."""
    for write in (
        lambda s, x, y, c: s.kinetic(x.diff() ** 2 + c * x.diff() * y.diff() + c * y.diff() ** 2),
        lambda s, x, y, c: s.kinetic((x.diff() + c * y.diff() / 2) ** 2 + (c - c**2 / 4) * y.diff() ** 2),
        lambda s, x, y, c: [s.kinetic(x.diff() ** 2), s.kinetic(c * (x.diff() + y.diff()) * y.diff())],
        lambda s, x, y, c: s.kinetic(c * x.diff() * (c * x.diff()) / c**2 + (c * y.diff()) * (x.diff() + y.diff())),
    ):
        s = lg.System("coupled")
        x, y = s.coordinates("x y")
        c = s.parameters("c")
        write(s, x, y, c)
        dyn = s.compile()
        assert np.allclose(dyn.mass_matrix([0.0, 0.0], p=[3.0]), [[2, 3], [3, 6]], rtol=1e-14)
        assert np.allclose(dyn.inverse([0, 0], [0, 0], [1, 0], p=[3.0]), [2, 3], rtol=1e-14)
        assert np.allclose(dyn.forward([0, 0], [0, 0], p=[3.0]), 0)


def test_a_file_and_from_energies_compile_alike() -> None:
    text = 'name = "e"\n[coordinates]\nx = ""\ny = ""\n[parameters]\nc = 3\n'
    text += "[energies]\nT = \"x'^2 + c*x'*y' + c*y'^2\"\nV = \"c*x*y\"\n"
    made = lg.loads(text).compile()
    assert np.allclose(made.mass_matrix([0.0, 0.0]), [[2, 3], [3, 6]], rtol=1e-14)
    s = lg.System("symbols")
    x, y = s.coordinates("x y")
    T = x.diff() ** 2 + 3 * x.diff() * y.diff() + 3 * y.diff() ** 2
    other = lg.System.from_energies([x, y], T=T, V=3 * x * y).compile()
    # M a = −∂V/∂ξ by hand: [[2, 3], [3, 6]] a = −[3y, 3x] at x = 1, y = 2
    expected = np.linalg.solve([[2.0, 3.0], [3.0, 6.0]], [-6.0, -3.0])
    assert np.allclose(made.forward([1.0, 2.0], [0.3, 0.4]), expected, rtol=1e-13)
    assert np.allclose(other.forward([1.0, 2.0], [0.3, 0.4]), expected, rtol=1e-13)
