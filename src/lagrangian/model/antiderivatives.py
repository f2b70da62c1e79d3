"""∫₀^δ of a law in closed form: laws with kinks exactly, piece by piece; others by SymPy's rules, counted.

A law that is positively homogeneous of degree n, f(s δ) = sⁿ f(δ) for s > 0, has the integral δ f(δ)/(n + 1), whatever
the signs of its parameters (Euler's theorem): k δ |δ|, δ² sign δ, max(k δ, 0). Any other kink |L| or sign L of a line
L = a δ + b beside a polynomial p is integrated from the kink: ∫ p sign L = |L| R with R = (P − P(−b/a))/L, P' = p.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false

from __future__ import annotations

from typing import Any, cast

import sympy as sp

from lagrangian import bounded

MOST_PIECES = 40
"""The largest number of terms and kinks of a law."""

HIGHEST = 20
"""The highest power of the extension in a term with a kink."""


def antiderivative(law: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """Return ∫₀^x law in closed form, or None if none was found."""
    if not law.has(x):
        return law * x
    if law.has(sp.Abs, sp.sign, sp.Max, sp.Min, sp.Piecewise, sp.Heaviside):
        return _bent(law, x)
    return _smooth(law, x)


def _smooth(law: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    from sympy.integrals.manualintegrate import manualintegrate  # slow to load, and few laws come here

    polynomial = _polynomial(law, x)
    if polynomial is not None:
        return sp.Add(*[c * x ** (n + 1) / (n + 1) for n, c in enumerate(polynomial)])
    if bounded.size(law) > bounded.MAX_OPERATIONS:
        return None
    primitive = bounded.searched(lambda: cast("sp.Expr", manualintegrate(law, x)))
    if primitive is None or primitive.has(sp.Integral):
        return None
    at_zero = bounded.searched(lambda: primitive.subs(x, 0))
    return None if at_zero is None or at_zero.has(sp.nan, sp.zoo, sp.oo, -sp.oo) else primitive - at_zero


# -- kinks --------------------------------------------------------------------------------------------------------


def _bent(law: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """The integral of a law with kinks, term by term; if it has kinks only where a x + b = 0, from there."""
    whole = bounded.expand(_split(law, x))
    found = _by_terms(law, whole, x)
    lines: set[Any] = {a.args[0] for a in whole.atoms(sp.Abs, sp.sign) if found is None and a.has(x)}
    slopes = _polynomial(lines.pop(), x) if len(lines) == 1 else None
    if slopes is None or len(slopes) != 2 or slopes[0] == 0:
        return found
    start = slopes[0] / slopes[1]
    moved = bounded.expand(_split(bounded.expand(cast("sp.Expr", whole.xreplace({x: x - start}))), x))
    primitive = _by_terms(moved, moved, x)
    return None if primitive is None else primitive.subs(x, x + start) - primitive.subs(x, start)


def _split(law: sp.Expr, x: sp.Symbol) -> sp.Expr:
    """The law with |c x| and sign(c x) written as |c| |x| and sign(c) sign(x)."""
    table: dict[sp.Expr, sp.Expr] = {}
    for kink in law.atoms(sp.Abs, sp.sign):
        factor, rest = cast("sp.Expr", kink.args[0]).as_independent(x, as_Add=False)
        if rest == x and factor != 1:
            table[kink] = kink.func(factor) * kink.func(x)
    return cast("sp.Expr", law.xreplace(table))


def _by_terms(law: sp.Expr, whole: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    pieces = sp.Add.make_args(whole if not isinstance(law, sp.Piecewise) else law)
    if len(pieces) > MOST_PIECES:
        return None
    found: list[sp.Expr] = []
    smooth: list[sp.Expr] = []
    for piece in pieces:
        degree = _degree(piece, x)
        if not piece.has(sp.Abs, sp.sign, sp.Max, sp.Min, sp.Piecewise, sp.Heaviside):
            smooth.append(piece)
        elif degree is not None and degree > -1:
            found.append(_by_euler(piece, x, degree))
        elif (value := _from_kinks(piece, x)) is not None:
            found.append(value)
        else:
            return None
    rest = antiderivative(sp.Add(*smooth), x) if smooth else sp.S.Zero
    return None if rest is None else sp.Add(rest, *found)


def _by_euler(law: sp.Expr, x: sp.Symbol, degree: sp.Expr) -> sp.Expr:
    """δ f(δ)/(n + 1), with δ² |δ| written |δ|³, δ max(δ, 0) as max(δ, 0)²; no sign δ, which jumps, stays."""
    over = law / (degree + 1)
    powers = law.as_powers_dict()
    own, size, turn = (sp.sympify(powers.get(b, 0)) for b in (x, sp.Abs(x), sp.sign(x)))
    factor = over / (x**own * sp.Abs(x) ** size * sp.sign(x) ** turn)
    if not factor.has(x) and own.is_integer and turn.is_integer:
        n = own + size + 1
        if (own + turn) % 2:
            return factor * sp.Abs(x) ** n
        return factor * (x**n if n % 2 == 1 else x * sp.Abs(x) ** (n - 1))
    for kink in (sp.Max(0, x), sp.Min(0, x)):
        if powers.get(kink, 0):
            return over / x**own * kink ** (own + 1)
    return over / sp.sign(x) * sp.Abs(x) if turn == 1 else over * x


def _degree(expr: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """n if expr(s x) = s^n expr(x) for every s > 0; None if no such n is found."""
    if not expr.has(x):
        return sp.S.Zero
    if expr == x:
        return sp.S.One
    if isinstance(expr, sp.Mul):
        degrees = [_degree(a, x) for a in expr.args]
        return None if any(d is None for d in degrees) else sp.Add(*cast("list[sp.Expr]", degrees))
    if isinstance(expr, sp.Pow) and isinstance(expr.exp, sp.Rational):
        below = _degree(expr.base, x)
        return None if below is None else below * expr.exp
    if isinstance(expr, (sp.Add, sp.Max, sp.Min, sp.Abs)):
        return _one({_degree(cast("sp.Expr", a), x) for a in expr.args if a != 0})
    if isinstance(expr, (sp.sign, sp.Heaviside)):
        return None if _degree(cast("sp.Expr", expr.args[0]), x) is None else sp.S.Zero
    if isinstance(expr, sp.Piecewise):
        if not all(_scales(condition, x) for _, condition in _pairs(expr)):
            return None
        return _one({_degree(value, x) for value, _ in _pairs(expr) if value != 0})
    return None


def _scales(condition: Any, x: sp.Symbol) -> bool:
    """Whether a condition that holds at x holds at every positive multiple of it."""
    if not condition.has(x):
        return True
    if isinstance(condition, sp.core.relational.Relational):
        return _one({_degree(cast("sp.Expr", side), x) for side in condition.args if side != 0}) is not None
    return isinstance(condition, (sp.And, sp.Or, sp.Not)) and all(_scales(c, x) for c in condition.args)


def _one(degrees: set[sp.Expr | None]) -> sp.Expr | None:
    return degrees.pop() if len(degrees) == 1 else None


def _from_kinks(piece: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """The integral of a polynomial times one kink of a line."""
    factors = sp.Mul.make_args(piece)
    kinks = [a for a in factors if a.has(x) and not a.is_polynomial(x)]
    if len(kinks) != 1:
        return None
    kink, rest = kinks[0], sp.Mul(*(a for a in factors if a is not kinks[0]))
    base, power = kink.as_base_exp()
    polynomial = _polynomial(rest, x)
    if polynomial is None or len(polynomial) > HIGHEST:
        return None
    if isinstance(base, (sp.Max, sp.Min)) and power == 1 and len(base.args) == 2:  # (u + v ± |u − v|)/2
        u, v = cast("tuple[sp.Expr, sp.Expr]", base.args)
        half = rest / 2 if isinstance(base, sp.Max) else -rest / 2
        smooth, bent = antiderivative(bounded.expand(rest * (u + v) / 2), x), _by_sign(half * (u - v), u - v, x)
        return None if smooth is None or bent is None else smooth + bent
    if isinstance(base, sp.Piecewise) and power == 1:
        return _cases(base, rest, x)
    if isinstance(base, sp.Heaviside) and power == 1:  # (1 + sign L)/2 but at the step itself
        smooth, bent = antiderivative(rest / 2, x), _by_sign(rest / 2, cast("sp.Expr", base.args[0]), x)
        return None if smooth is None or bent is None else smooth + bent
    if isinstance(base, (sp.Abs, sp.sign)) and isinstance(power, sp.Integer) and 0 < power <= HIGHEST and power % 2:
        line = cast("sp.Expr", base.args[0])
        return _by_sign(rest * (line**power if isinstance(base, sp.Abs) else 1), line, x)
    return None


def _by_sign(factor: sp.Expr, line: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """∫₀^x factor·sign(line), factor a polynomial and line a x + b: |line| R(x) − |b| R(0)."""
    slopes, polynomial = _polynomial(line, x), _polynomial(factor, x)
    if slopes is None or polynomial is None or len(slopes) != 2 or len(polynomial) > HIGHEST:
        return None
    a, start = slopes[1], -slopes[0] / slopes[1]
    primitive = [sp.S.Zero, *(c / (n + 1) for n, c in enumerate(polynomial))]
    quotient: list[sp.Expr] = [sp.S.Zero] * (len(primitive) - 1)  # of P − P(start) by x − start, Horner's scheme
    carried: sp.Expr = sp.S.Zero
    for n in range(len(primitive) - 1, 0, -1):
        carried = bounded.expand(primitive[n] + carried * start)
        quotient[n - 1] = carried
    R = sp.Add(*[c * x**n for n, c in enumerate(quotient)]) / a
    return sp.Abs(line) * R - sp.Abs(slopes[0]) * quotient[0] / a


def _cases(cases: sp.Piecewise, rest: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """The integral of cases that are separated by numbers, in order: each begins where the previous one ends."""
    edges: list[sp.Expr] = []
    for _, condition in _pairs(cases)[:-1]:
        bound = _upper(condition, x)
        if bound is None or (edges and not bound > edges[-1]):
            return None
        edges.append(bound)
    if _pairs(cases)[-1][1] != sp.true:
        return None
    primitives = [antiderivative(bounded.expand(value * rest), x) for value, _ in _pairs(cases)]
    if any(p is None for p in primitives):
        return None
    whole = cast("list[sp.Expr]", primitives)
    offsets: list[sp.Expr] = [sp.S.Zero]
    for before, after, edge in zip(whole, whole[1:], edges, strict=False):
        offsets.append(offsets[-1] + before.subs(x, edge) - after.subs(x, edge))
    home = next((k for k, edge in enumerate(edges) if edge > 0), len(edges))
    pairs = [
        (bounded.expand(p + c - offsets[home]), condition)
        for p, c, (_, condition) in zip(whole, offsets, _pairs(cases), strict=True)
    ]
    return sp.Piecewise(*pairs, evaluate=False)


def _pairs(cases: Any) -> list[tuple[sp.Expr, Any]]:
    """The values of cases with their conditions."""
    return [(pair.args[0], pair.args[1]) for pair in cases.args]


def _upper(condition: Any, x: sp.Symbol) -> sp.Expr | None:
    """c of the condition x < c or x ≤ c with a number c."""
    if isinstance(condition, (sp.StrictLessThan, sp.LessThan)):
        low, high = condition.args
    elif isinstance(condition, (sp.StrictGreaterThan, sp.GreaterThan)):
        high, low = condition.args
    else:
        return None
    return cast("sp.Expr", high) if low == x and isinstance(high, sp.Rational) else None


def _polynomial(expr: sp.Expr, x: sp.Symbol) -> list[sp.Expr] | None:
    """The coefficients c₀, c₁, … of a polynomial in x, or None if it is not one or is too long."""
    if not expr.is_polynomial(x):
        return None
    found: dict[int, list[sp.Expr]] = {}
    for term in sp.Add.make_args(bounded.expand(expr)):
        factor, power = term.as_independent(x, as_Add=False)
        base, exponent = power.as_base_exp() if power != 1 else (x, sp.S.Zero)
        if base != x or not isinstance(exponent, sp.Integer) or exponent > bounded.TERMS:
            return None
        found.setdefault(int(exponent), []).append(factor)
    return [sp.Add(*found.get(n, [])) for n in range(max(found, default=0) + 1)]
