"""Readable equations: the shapes that textbooks print, their length, and that nothing is lost on the way to the page.

Lecture: examples 1, 3A and 3B of the lecture on Lagrange's equations, as printed there. Other shapes: Goldstein,
Classical Mechanics, 3rd ed., chapter 1, exercise 19 (spherical pendulum) and section 5.7 (symmetric top); Strogatz,
Nonlinear Dynamics and Chaos, section 3.5 (bead on a rotating hoop). Lengths count a rate as one name.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

import lagrangian as lg
from effort import at_most
from lagrangian.derive.algebra import Algebra, Form, equations
from lagrangian.derive.algebra.factor import Flat, Shortener
from size import sized

t = dynamicsymbols._t
sin, cos = sp.sin, sp.cos
m, M, m1, m2, m3, L, l, g, k, k1, k2, R, r0, J, I1, I3, Omega, alpha, A, omega, l0, h, d, b = sp.symbols(
    "m M m1 m2 m3 L l g k k1 k2 R r0 J I1 I3 Omega alpha A omega l0 h d b"
)
x, s, y, r, theta, phi, psi, x1, x2, x2r, u, tau = dynamicsymbols("x s y r theta phi psi x1 x2 x2r u tau")


CALLS = 10_000_000
"""Of Python functions, that any one of these takes at most."""


@dataclass(frozen=True)
class Named:
    symbol: sp.Expr


@dataclass(frozen=True)
class Described:
    coordinates: tuple[Named, ...]


def dot(q: sp.Expr, n: int = 1) -> sp.Expr:
    return sp.diff(q, t, n)


def derived(q: list[Any], T: list[Any], V: list[Any]) -> tuple[Algebra, list[Form]]:
    ring = Algebra(Described(tuple(Named(c) for c in q)), [*T, *V])
    return ring, equations([ring.form(e) for e in T], [ring.form(e) for e in V], q, ring)


def written(form: Form) -> list[str]:
    """The terms with dots as primes: ``m*x''``."""
    names: dict[sp.Basic, sp.Symbol] = {}
    whole = [term.expr for term in form.terms()]
    for a in sp.Add(*whole).atoms(sp.Derivative, AppliedUndef):
        order = int(a.derivative_count) if isinstance(a, sp.Derivative) else 0
        base = a.expr if isinstance(a, sp.Derivative) else a
        names[a] = sp.Symbol(str(base.func) + "'" * order)
    return [str(e.xreplace(names)) for e in whole]


def speed(*position: sp.Expr) -> sp.Expr:
    return sum(dot(p) ** 2 for p in position)


SHAPES: dict[str, tuple[list[Any], list[Any], list[Any], list[list[str]]]] = {
    "lecture 1": (
        [theta],
        [m * speed(L * sin(theta), L * cos(theta)) / 2],
        [k * (l * theta) ** 2 / 2, m * g * L * (1 - cos(theta))],
        [["L**2*m*theta''", "k*l**2*theta", "L*g*m*sin(theta)"]],
    ),
    "lecture 3A": (
        [x1, x2],
        [m1 * dot(x1) ** 2 / 2, m2 * dot(x2) ** 2 / 2],
        [k * (x2 - x1) ** 2 / 2],
        [["m1*x1''", "k*(x1 - x2)"], ["m2*x2''", "-k*(x1 - x2)"]],
    ),
    "lecture 3B": (
        [x1, x2r],
        [m1 * dot(x1) ** 2 / 2, m2 * dot(x1 + x2r) ** 2 / 2],
        [k * x2r**2 / 2],
        [["x1''*(m1 + m2)", "m2*x2r''"], ["m2*x1''", "m2*x2r''", "k*x2r"]],
    ),
    "pendulum on a cart": (
        [x, theta],
        [M * dot(x) ** 2 / 2, m * speed(x + L * sin(theta), L * cos(theta)) / 2],
        [-m * g * L * cos(theta)],
        [
            ["x''*(M + m)", "L*m*theta''*cos(theta)", "-L*m*theta'**2*sin(theta)"],
            ["L*m*x''*cos(theta)", "L**2*m*theta''", "L*g*m*sin(theta)"],
        ],
    ),
    "elastic pendulum": (
        [r, theta],
        [m * speed(r * sin(theta), r * cos(theta)) / 2],
        [-m * g * r * cos(theta), k * (r - l0) ** 2 / 2],
        [
            ["m*r''", "-m*r*theta'**2", "k*(-l0 + r)", "-g*m*cos(theta)"],
            ["m*r**2*theta''", "2*m*r*r'*theta'", "g*m*r*sin(theta)"],
        ],
    ),
    "spherical pendulum": (
        [theta, phi],
        [m * L**2 * speed(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)) / 2],
        [-m * g * L * cos(theta)],
        [
            ["L**2*m*theta''", "-L**2*m*phi'**2*sin(theta)*cos(theta)", "L*g*m*sin(theta)"],
            ["L**2*m*phi''*sin(theta)**2", "2*L**2*m*phi'*theta'*sin(theta)*cos(theta)"],
        ],
    ),
    "symmetric top": (
        [phi, theta, psi],
        [
            I1 * ((dot(phi) * sin(theta) * sin(psi) + dot(theta) * cos(psi)) ** 2) / 2,
            I1 * ((dot(phi) * sin(theta) * cos(psi) - dot(theta) * sin(psi)) ** 2) / 2,
            I3 * (dot(phi) * cos(theta) + dot(psi)) ** 2 / 2,
        ],
        [m * g * l * cos(theta)],
        [
            [
                "phi''*(I1*sin(theta)**2 + I3*cos(theta)**2)",
                "I3*psi''*cos(theta)",
                "2*phi'*theta'*(I1 - I3)*sin(theta)*cos(theta)",
                "-I3*psi'*theta'*sin(theta)",
            ],
            [
                "I1*theta''",
                "-phi'**2*(I1 - I3)*sin(theta)*cos(theta)",
                "I3*phi'*psi'*sin(theta)",
                "-g*l*m*sin(theta)",
            ],
            ["I3*phi''*cos(theta)", "I3*psi''", "-I3*phi'*theta'*sin(theta)"],
        ],
    ),
    "bead on a hoop": (
        [theta],
        [m * R**2 * speed(sin(theta) * cos(Omega * t + alpha), sin(theta) * sin(Omega * t + alpha), cos(theta)) / 2],
        [-m * g * R * cos(theta)],
        [["R**2*m*theta''", "-Omega**2*R**2*m*sin(theta)*cos(theta)", "R*g*m*sin(theta)"]],
    ),
    "wedge": (
        [x, s],
        [M * dot(x) ** 2 / 2, m * speed(x + s * cos(alpha), s * sin(alpha)) / 2],
        [-m * g * s * sin(alpha)],
        [["x''*(M + m)", "m*s''*cos(alpha)"], ["m*x''*cos(alpha)", "m*s''", "-g*m*sin(alpha)"]],
    ),
    "Atwood": (
        [y],
        [m1 * dot(y) ** 2 / 2, m2 * dot(y) ** 2 / 2, J * (dot(y) / R) ** 2 / 2],
        [-m1 * g * y, m2 * g * y],
        [["y''*(J/R**2 + m1 + m2)", "-g*(m1 - m2)"]],
    ),
    "quarter car": (
        [x1, x2],
        [m1 * dot(x1) ** 2 / 2, m2 * dot(x2) ** 2 / 2],
        [k1 * (x1 - u) ** 2 / 2, k2 * (x2 - x1) ** 2 / 2],
        [["m1*x1''", "k1*(-u + x1)", "k2*(x1 - x2)"], ["m2*x2''", "-k2*(x1 - x2)"]],
    ),
    "driven pivot": (
        [theta],
        [m * speed(L * sin(theta), A * cos(omega * t) + L * cos(theta)) / 2],
        [m * g * (A * cos(omega * t) + L * cos(theta))],
        [["L**2*m*theta''", "-L*m*(-A*omega**2*cos(omega*t) + g)*sin(theta)"]],
    ),
    "spring across": (
        [x],
        [m * dot(x) ** 2 / 2],
        [k * (sp.sqrt(x**2 + h**2) - l0) ** 2 / 2],
        [["m*x''", "k*x*(-l0/sqrt(h**2 + x**2) + 1)"]],
    ),
    "ball in a bowl": (
        [theta],
        [m * ((R - r0) * dot(theta)) ** 2 / 2, J * ((R - r0) / r0 * dot(theta)) ** 2 / 2],
        [-m * g * (R - r0) * cos(theta)],
        [["theta''*(R - r0)**2*(J/r0**2 + m)", "g*m*(R - r0)*sin(theta)"]],
    ),
}


@pytest.mark.parametrize("name", SHAPES)
def test_equations_read_as_in_a_textbook(name: str) -> None:
    q, T, V, expected = SHAPES[name]
    _, found = derived(q, T, V)
    for form, terms in zip(found, expected, strict=True):
        assert written(form) == terms


ENERGIES = [
    (k * (x1 - x2) ** 2 / 2, "k*(x1 - x2)**2/2"),
    (k * (r - l0) ** 2 / 2 - m * g * r * cos(theta), "-g*m*r*cos(theta) + k*(-l0 + r)**2/2"),
    (m * g * L * (1 - cos(theta)), "L*g*m*(1 - cos(theta))"),
    (b * dot(x1) - b * dot(x2), "b*(x1' - x2')"),
    (tau - b * dot(theta), "-b*theta' + tau"),
    (m1 * x1 + m2 * x1, "x1*(m1 + m2)"),
    ((x1 + x2) ** 3 * k, "k*(x1 + x2)**3"),
    (k * (sp.sqrt(x1**2 + h**2) - l0) ** 2 / 2, "k*(-l0 + sqrt(h**2 + x1**2))**2/2"),
    (sp.sqrt((x1 - x2) ** 2 + (r - h) ** 2), "sqrt((-h + r)**2 + (x1 - x2)**2)"),
    (J / 2 + L**2 * m1 / 8 + L**2 * m2 / 2, "J/2 + L**2*(m1/4 + m2)/2"),
    # one style of fractions: ½ (J + ¼ m L²), whatever stands behind it, and never ⅛ (4 J + m L²)
    ((J + m * L**2 / 4) * dot(x1) ** 2 / 2, "x1'**2*(J + L**2*m/4)/2"),
    ((J + m * L**2 / 4) * (x1 + x2) ** 2 / 2, "(J + L**2*m/4)*(x1 + x2)**2/2"),
    ((J + m * L**2 / 4) * (x1 + x2) ** 2, "(J + L**2*m/4)*(x1 + x2)**2"),
    (m * (1 + 4 * h**2 * x**2) * dot(x) ** 2 / 2, "m*x'**2*(4*h**2*x**2 + 1)/2"),
    (sp.sqrt(m) * x1 + m * x2, "sqrt(m)*x1 + m*x2"),
    (sp.Rational(1, 2) * (x1 + x2), "x1/2 + x2/2"),
    (sp.S.Zero * x, "0"),
    (1 + sp.S.Zero * x, "1"),
]


@pytest.mark.parametrize(("expr", "expected"), ENERGIES, ids=[e[1] for e in ENERGIES])
def test_single_expressions(expr: sp.Expr, expected: str) -> None:
    ring = Algebra(Described(tuple(Named(c) for c in (x1, x2, r, theta))))
    shown = ring.form(expr).expr()
    names = {a: sp.Symbol(f"{a.expr.func}'") for a in shown.atoms(sp.Derivative)}
    names |= {a: sp.Symbol(str(a.func)) for a in shown.atoms(AppliedUndef)}
    assert str(shown.xreplace(names)) == expected


def chain(n: int, relative: bool) -> tuple[list[Any], list[Any], list[Any]]:
    """n point masses on massless links, angles from the vertical or from the link before."""
    q = list(dynamicsymbols(f"theta1:{n + 1}"))
    lengths, masses = sp.symbols(f"L1:{n + 1}"), sp.symbols(f"m1:{n + 1}")
    X = Y = angle = sp.S.Zero
    T, V = [], []
    for i in range(n):
        angle = angle + q[i] if relative else q[i]
        X, Y = X + lengths[i] * sin(angle), Y - lengths[i] * cos(angle)
        T.append(masses[i] * speed(X, Y) / 2)
        V.append(masses[i] * g * Y)
    return q, T, V


def operations(form: Form) -> int:
    whole = sp.Add(*[term.expr for term in form.terms()])
    names = {a: sp.Dummy() for a in whole.atoms(sp.Derivative, AppliedUndef)}
    return int(sp.count_ops(whole.xreplace(names)))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("n", "relative", "most"),
    [(2, False, 48), (2, True, 62), (3, False, 124), (3, True, 240), (4, False, 240), (4, True, 561)],
)
def test_length_of_chains(n: int, relative: bool, most: int) -> None:
    _, found = derived(*chain(n, relative))
    assert sum(operations(form) for form in found) <= most


@pytest.mark.parametrize("links", [4, pytest.param(8, marks=pytest.mark.slow)])
def test_many_relative_links_stay_usable(links: int) -> None:
    q, T, V = chain(links, True)
    with at_most(CALLS):
        _, found = derived(q, T, V)
        terms = [form.terms() for form in found]
    assert all(terms)


def number(name: object) -> sp.Float:
    return sp.Float(random.Random(str(name)).uniform(0.3, 1.7), 40)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("n", [2, 3, 4])
def test_nothing_is_lost_between_the_form_and_the_page(n: int) -> None:
    q, T, V = chain(n, True)
    _, found = derived(q, T, V)
    lagrangian = sum(T) - sum(V)
    for c, form in zip(q, found, strict=True):
        expected = dot(sp.diff(lagrangian, dot(c))) - sp.diff(lagrangian, c)
        for shown in (sp.Add(*[term.expr for term in form.terms()]), form.expr()):
            values = []
            for e in (expected, shown):
                e = e.xreplace({a: number(a) for a in e.atoms(sp.Derivative, AppliedUndef)})
                values.append(sp.N(e.xreplace({p: number(p) for p in e.free_symbols}), 40))
            assert abs(values[0] - values[1]) < 1e-30


def test_a_sum_of_angles_is_split_as_one_where_its_double_stands() -> None:
    """The waist's inertia of a three-joint arm: in cos θ₂ and cos(θ₂ + θ₃), no double angle, the reach one square."""
    ring = Algebra(Described((Named(theta), Named(phi))))
    reach = L * cos(theta) + l * cos(theta + phi)
    inertia = J + k1 * sin(theta) ** 2 + k2 * sin(theta + phi) ** 2 + m * reach**2
    shown = ring.form(sp.expand_trig(inertia).expand()).expr()
    assert {a.args[0] for a in shown.atoms(sp.sin, sp.cos)} == {theta, theta + phi}
    (term,) = ring.form(inertia * dot(psi, 2)).terms()
    assert reach**2 in term.expr.atoms(sp.Pow)


def test_kinds() -> None:
    ring = Algebra(Described((Named(x), Named(theta))))
    expr = (
        m * dot(x, 2) + m * sin(theta) * dot(theta) ** 2 + b * dot(x) + k * x + m * g * sin(theta) + sp.exp(x / l) + tau
    )
    kinds = [term.kind for term in ring.form(expr).terms()]
    assert kinds == ["inertia", "velocity", "damping", "stiffness", "gravity", "other", "input"]
    assert [term.kind for term in ring.form(m * g + 0 * x).terms()] == ["gravity"]


@pytest.mark.slow
@sized(40, 8)
@given(st.dictionaries(st.tuples(*[st.integers(-1, 3)] * 4), st.integers(-4, 4).filter(bool), min_size=1, max_size=9))
def test_factored_shapes_expand_to_what_they_came_from(terms: dict[tuple[int, ...], int]) -> None:
    """Against SymPy's expansion of the tree."""
    from fractions import Fraction

    from lagrangian.derive.algebra.monomials import digits, packed

    letters = sp.symbols("a b c d")
    flat: Flat = {int(packed(enumerate(e))): Fraction(c, 2) for e, c in terms.items()}
    tree = Shortener(lambda _: 0).short(flat)

    def written_out(node: Any) -> sp.Expr:
        factors = [letters[i] ** e for i, e in digits(node.monomial)]
        factors += [sp.Add(*[written_out(term) for term in terms]) ** power for terms, power in node.sums]
        return sp.Rational(node.coefficient) * sp.Mul(*factors)

    original = sum(
        sp.Rational(c, 2) * sp.Mul(*[v**e for v, e in zip(letters, es, strict=True)]) for es, c in terms.items()
    )
    assert sp.expand(written_out(tree) - original) == 0
    plain = sum(Shortener(lambda _: 0).product(c, mono).cost for mono, c in flat.items()) + len(flat) - 1
    assert tree.cost <= plain


@pytest.mark.slow
def test_maxima_between_moving_points_are_written_with_steps_that_a_reader_knows() -> None:
    """V = ½ k max(0, x − y)²: the force is k max(0, x − y). V = k max(x, y): it is k on the one that is ahead."""
    for potential, word in ((k * sp.Max(0, x - y) ** 2 / 2, "m ẍ + k max(0, x − y) = 0"), (k * sp.Max(x, y), "x ≥ y")):
        system = lg.System("contact")
        x1, y1 = system.coordinates("x y")
        m1, k1 = system.parameters("m k", m=1.0, k=100.0)
        for q in (x1, y1):
            system.particle(m1, at=system.origin + (q, 0))
        system.potential(potential.xreplace({x: x1, y: y1, k: k1}))
        d = system.derive()
        assert word in d.to_text() and "Heaviside" not in d.to_text() + d.to_latex() + d.to_html()
        for place in ([0.7, 0.5], [0.5, 0.7], [0.5, 0.5]):  # the last where both are the greatest
            at = {m1: 1.0, k1: 100.0, x1.diff().diff(): 0.0, y1.diff().diff(): 0.0, x1: place[0], y1: place[1]}
            forces = [float(e.lhs.subs(list(at.items()))) for e in d.equations]
            assert system.compile().forward(place, [0.0, 0.0]) == pytest.approx([-f for f in forces])


def test_a_step_given_by_sympy_is_written_as_cases() -> None:
    s = lg.System("step")
    x = s.coordinate("x")
    s.particle(s.parameter("m", 1.0), at=s.origin + (x, 0))
    s.force(sp.Heaviside(x), deflection=x)
    d = s.derive()
    assert "Heaviside" not in d.to_text() + d.to_latex() + d.to_markdown()
