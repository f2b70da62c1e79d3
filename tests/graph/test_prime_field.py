"""Evaluation in a prime field: the field has the roots and angles it claims, and functions keep their relations."""

import random
from fractions import Fraction

import pytest
import sympy as sp

from lagrangian.graph import Graph, NotAlgebraic, PrimePoint, from_sympy
from lagrangian.graph.prime_field import PRIMES, SMOOTH, Echelon, half_turn, multiple, root

X, Y, Z = sp.symbols("x y z", real=True)


@pytest.mark.parametrize("p", PRIMES)
def test_the_numbers_are_primes_with_many_square_roots(p: int) -> None:
    assert sp.isprime(p)
    assert (p + 1) % SMOOTH == 0
    assert sp.factorint(SMOOTH) == {2: 4, 3: 2} | dict.fromkeys(sp.primerange(5, 48), 1)
    assert all(sp.jacobi_symbol(q, p) == 1 for q in sp.primerange(2, 48))
    assert sp.jacobi_symbol(p - 1, p) == -1


@pytest.mark.parametrize("p", PRIMES[:2])
@pytest.mark.parametrize("q", [2, 3, 4, 5, 6, 7, 9, 12])
def test_a_root_to_the_power_is_the_number(p: int, q: int) -> None:
    draw = random.Random(q)
    for _ in range(5):
        x = pow(draw.randrange(2, p), q, p)
        found = root(x, q, p)
        assert found is not None
        assert pow(found, q, p) == x


def test_there_is_no_root_where_the_symbol_says_so() -> None:
    p = PRIMES[0]
    found = {x: root(x, 2, p) is not None for x in range(48, 90)}
    assert found == {x: sp.jacobi_symbol(x, p) == 1 for x in range(48, 90)}
    assert not all(found.values())


@pytest.mark.parametrize("p", PRIMES)
def test_the_circle_holds_the_known_sines(p: int) -> None:
    point = half_turn(360, p)
    assert point is not None
    half, three, five = pow(2, -1, p), root(3, 2, p), root(5, 2, p)
    assert three is not None
    assert five is not None
    assert multiple(point, 360, p) == (p - 1, 0)
    assert multiple(point, 180, p) == (0, 1)
    assert multiple(point, 120, p) == (half, three * half % p)
    assert multiple(point, 72, p)[0] == (1 + five) * half * half % p
    assert all(multiple(point, k, p) != (1, 0) for k in range(1, 720))


def test_an_echelon_finds_rank_and_combination() -> None:
    echelon = Echelon(PRIMES[0])
    rows = [[1, 2, 3, 4], [2, 4, 6, 9], [0, 1, 1, 1]]
    assert [echelon.take(k, row) for k, row in enumerate(rows)] == [True, True, True]
    left, lost = echelon.reduce([a - 2 * b + 5 * c for a, b, c in zip(*rows, strict=True)])
    assert left == [0, 0, 0, 0]
    assert lost == {0: 1, 1: PRIMES[0] - 2, 2: 5}
    assert any(echelon.reduce([0, 0, 1, 0])[0])


def values(*exprs: sp.Expr, seed: int = 1) -> list[int] | NotAlgebraic:
    graph = Graph()
    symbols: dict[sp.Basic, int] = {s: graph.input("q", k) for k, s in enumerate((X, Y, Z))}
    pi = symbols[sp.pi] = graph.input("pi", 0)
    numbers: dict[int, Fraction] = {}
    for expr in exprs:
        for r in expr.atoms(sp.Rational):
            if r not in symbols:
                symbols[r] = graph.input("number", len(numbers))
                numbers[symbols[r]] = Fraction(int(r.p), int(r.q))
    ids = [from_sympy(graph, expr, symbols) for expr in exprs]
    return PrimePoint(graph, numbers, pi, seed=seed).values(ids)


ZEROS = {
    "addition theorem": sp.sin(X + 2 * Y) - sp.sin(X) * sp.cos(2 * Y) - sp.cos(X) * sp.sin(2 * Y),
    "half an angle": 2 * sp.cos(X / 2) ** 2 - 1 - sp.cos(X),
    "a third and a fifth": sp.sin(X / 3 + X / 5) - sp.sin(8 * X / 15),
    "tangent": sp.tan(X) - sp.sin(X) / sp.cos(X),
    "60 degrees": 2 * sp.sin(X + sp.pi / 3) - sp.sin(X) - sp.sqrt(3) * sp.cos(X),
    "15 degrees": 4 * sp.sin(X + sp.pi / 12) - (sp.sqrt(6) + sp.sqrt(2)) * sp.sin(X)
    - (sp.sqrt(6) - sp.sqrt(2)) * sp.cos(X),
    "20 degrees": 8 * sp.cos(sp.pi / 9) ** 3 - 6 * sp.cos(sp.pi / 9) - 1,
    "exponential": sp.exp(X - Y / 2) ** 2 - sp.exp(2 * X) / sp.exp(Y),
    "hyperbolic": sp.cosh(X) ** 2 - sp.sinh(X) ** 2 - 1,
    "cube root": (X + Y) ** sp.Rational(4, 3) / (X + Y) ** sp.Rational(1, 3) - X - Y,
    "roots multiply": sp.sqrt(X * Y) ** 2 - X * Y,
    "sine of an arc": sp.sin(sp.asin(X) + Y) - X * sp.cos(Y) - sp.sqrt(1 - X**2) * sp.sin(Y),
    "cosine of atan2": sp.cos(sp.atan2(Y, X) + Z) * sp.sqrt(X**2 + Y**2) - X * sp.cos(Z) + Y * sp.sin(Z),
    "decimals": sp.Rational(1, 10) * X + sp.Rational(1, 5) * X - sp.Rational(3, 10) * X * (sp.sin(Y) ** 2
    + sp.cos(Y) ** 2),
}  # fmt: skip


@pytest.mark.parametrize("name", ZEROS)
def test_what_is_zero_for_all_values_is_zero(name: str) -> None:
    assert values(ZEROS[name]) == [0]
    changed = values(ZEROS[name] + X / 10**9)
    assert isinstance(changed, list)
    assert changed != [0]


def test_independent_functions_are_not_mixed_up() -> None:
    found = values(sp.sin(X * Y) - sp.sin(X * Z), sp.exp(X) - sp.exp(Y), sp.sin(1) - sp.Rational(84147, 100000))
    assert isinstance(found, list)
    assert 0 not in found


@pytest.mark.parametrize(
    ("expr", "operation"),
    [
        (sp.Abs(X), "abs"),
        (sp.Max(X, Y), "max"),
        (sp.Piecewise((X, X < Y), (Y, True)), "a condition"),
        (X**Y, "a power with an exponent that is not a number"),
        (X ** sp.Rational(123, 1000), "the power 0.123"),
        (sp.log(X) + sp.log(Y) - sp.log(X * Y), "logarithms or arcs that depend on each other"),
        (sp.sin((X + Y) ** 2) - sp.sin(X**2 + 2 * X * Y + Y**2), "angles or exponents that depend on each other"),
        (sp.cos(sp.asin(X) / 2), "the sine of a part of asin"),
        (1 / (sp.sin(X) ** 2 + sp.cos(X) ** 2 - 1), "division by zero"),
        (sp.sqrt(-(X**2) - 2 * X - 1), "a square root"),
    ],
)
def test_what_no_field_has_is_named(expr: sp.Expr, operation: str) -> None:
    assert values(expr) == NotAlgebraic(operation)


def test_a_root_that_is_missing_is_drawn_again() -> None:
    graph = Graph()
    x = [graph.input("q", k) for k in range(6)]
    point = PrimePoint(graph)
    first = point.values(x)
    roots = [graph.sqrt(a) for a in x]
    found = point.values([graph.sub(graph.mul(r, r), a) for r, a in zip(roots, x, strict=True)])
    assert found == [0] * 6
    assert point.draws > 0
    assert point.values(x) != first


def test_logarithms_of_different_things_are_independent() -> None:
    found = values(sp.log(X) - sp.log(Y), sp.log(X + Y) + sp.atan(X), sp.log(Z))
    assert isinstance(found, list)
    assert 0 not in found


def test_angles_are_counted_in_common_parts() -> None:
    found = values(sp.sin(X / 7 + X / 11) - sp.sin(18 * X / 77), sp.sin(sp.pi / 7 + X) - sp.sin(X))
    assert isinstance(found, list)
    assert found[0] == 0
    assert found[1] != 0
