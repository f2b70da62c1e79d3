"""A sum in which one letter stands once has no factors but letters: that is seen without a search."""

import random

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

from lagrangian import bounded
from lagrangian.bounded import searches

t = sp.Symbol("t")
q, w = dynamicsymbols("q w")
a, b, c, m, Omega = sp.symbols("a b c m Omega", positive=True)
MOVING = [x for f in (q, w) for x in (f, f.diff(t), f.diff(t, 2), sp.sin(f), sp.cos(f))]
LETTERS = [a, b, c, m, Omega, *MOVING, sp.sin(Omega * t), sp.cos(q - w)]
NUMBERS = [1, -1, 2, -3, 4, sp.Rational(1, 2), sp.Rational(-2, 3)]


def sum_of_products(source: random.Random) -> sp.Expr:
    """A random sum, often with a letter in all terms, or a product of two sums multiplied out."""
    shared = source.choices(LETTERS, k=source.randint(0, 3))
    count = source.randint(2, 5)
    terms = [
        source.choice(NUMBERS) * sp.Mul(*shared, *source.choices(LETTERS, k=source.randint(0, 3))) for _ in range(count)
    ]
    whole = sp.Add(*terms)
    return sp.expand(whole * (source.choice(LETTERS) + 1)) if source.random() < 0.3 else whole


@pytest.mark.slow
def test_it_is_what_sympy_finds() -> None:
    source, seen = random.Random(4), 0
    for _ in range(150):
        expr = sum_of_products(source)
        found = bounded.split(expr)
        if found is None:
            continue
        seen += 1
        number, letters, whole = found
        factors = dict(sp.factor_list(expr)[1])
        assert sp.factor_list(expr)[0] == number
        assert factors == {**letters, whole: 1}
        assert bounded.factored(expr) == sp.factor(expr)
    assert seen > 60


def test_nothing_is_sought(monkeypatch: pytest.MonkeyPatch) -> None:
    def sought(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(searches, "_searched_once", sought)
    terms = [m * a * q.diff(t, 2), -m * b * sp.cos(q) * w.diff(t), m * c * sp.sin(q - w) * w.diff(t) ** 2]
    assert bounded.factored(sp.Add(*terms)) == m * sp.Add(*[x / m for x in terms])
    with pytest.raises(AssertionError):
        bounded.factored(a**2 * q - b**2 * q)


def test_a_sum_that_has_factors_is_not_split() -> None:
    assert bounded.split(sp.expand((a + b) * (q + c))) is None
    assert bounded.split(a**2 - b**2) is None
    assert bounded.split(sp.sqrt(a) * b + c * a) is None
    assert bounded.split(a / b + c) is None
    assert bounded.factored(sp.expand((a + b) * (q + c))) == (a + b) * (q + c)
