"""Chooses which sines and cosines to show, whichever is shorter: cos(θ₁ − θ₂) or products, (1 − cos 2θ)/2 or sin²θ."""

from __future__ import annotations

from fractions import Fraction
from math import comb
from typing import TYPE_CHECKING

from lagrangian.derive.algebra.factor import Flat
from lagrangian.derive.algebra.generators import Generators
from lagrangian.derive.algebra.monomials import Packed, digits, multiples, packed, turn, unit, whole
from lagrangian.derive.algebra.variables import Trig

if TYPE_CHECKING:
    from lagrangian.derive.algebra.form import Form, Harmonic

SPLIT_TERMS = 3000
"""Forms with more terms keep their harmonics."""


def displayed(form: Form, generators: Generators) -> Flat:
    """Return the form in displayed symbols, with those angles split for which that is shorter.

    There is one choice for the whole form, so that sin²θ and sin θ cos θ occur together. But terms with the same rates
    (or none) return to harmonics if that gives fewer terms, as J − I cos 2ψ instead of J − I + 2 I sin²ψ. A sum of
    angles is split as one angle if its double occurs: cos(2θ₁ + θ₂) + cos θ₂ is 2 cos θ₁ cos(θ₁ + θ₂) beside cos²(θ₁ +
    θ₂).
    """
    split: frozenset[int] = frozenset()
    harmonic = best = _flat(form, generators, split)
    if form.size > SPLIT_TERMS:
        return best
    best_cost = plain_cost(best, generators)
    for j in _candidates(form):
        if not (generators.affords(form.size) and generators.affords(_splitting(form, j))):
            break
        trial = _flat(form, generators, split | {j})
        cost = plain_cost(trial, generators)
        if cost <= best_cost:
            split, best, best_cost = split | {j}, trial, cost
    if not split:
        return best
    out: Flat = {}
    fewer = [
        _by_motion(flat, generators) for flat in (harmonic, *(_flat(form, generators, split - {j}) for j in split))
    ]
    for motion, terms in _by_motion(best, generators).items():
        out |= min((terms, *(other.get(motion, terms) for other in fewer)), key=len)
    return out


def _by_motion(flat: Flat, generators: Generators) -> dict[int, Flat]:
    """The terms grouped by the moving part of their monomials without sines and cosines."""
    moving, table = generators.moving, generators.table
    groups: dict[int, Flat] = {}
    for m, c in flat.items():
        bare = int(packed((i, e) for i, e in digits(m) if not isinstance(table[i], Trig)))
        groups.setdefault(moving(bare), {})[m] = c
    return groups


def _candidates(form: Form) -> list[int]:
    """The harmonics to split by: sums of angles whose double is there; angles with a double multiple, or with both
    signs against the same others, cos(a + b) beside cos(a − b)."""
    harmonics = {h for h, _ in form.parts}
    found: set[int] = set()
    for h in harmonics:
        pairs = multiples(h)
        whole_numbers = all(isinstance(k, int) for _, k in pairs)
        if len(pairs) > 1 and whole_numbers and all(k % 2 == 0 for _, k in pairs) and _pivot(half := int(h) // 2):
            found.add(half)
        for j, k in pairs:
            if len(pairs) == 1:
                if isinstance(k, int) and abs(k) > 1:
                    found.add(turn(j))
            elif abs(whole(h - 2 * k * turn(j))) in harmonics and isinstance(k, int):
                found.add(turn(j))
    return sorted(found, key=lambda h: (-len(multiples(h)), h))


def _splitting(form: Form, angle: int) -> int:
    """The approximate number of products that splitting by an angle needs: cos kx has k/2 powers."""
    pivot = multiples(angle)[-1][0]
    return sum(
        (1 + abs(int(k)) ** 2 // 2) * len(p) for (h, _), p in form.parts.items() for j, k in multiples(h) if j == pivot
    )


def _pivot(harmonic: int) -> tuple[int, int] | None:
    """The last angle that occurs once in a harmonic, with its sign: the harmonic can replace it."""
    return next(((j, int(k)) for j, k in reversed(multiples(harmonic)) if abs(k) == 1), None)


def _flat(form: Form, generators: Generators, split: frozenset[int]) -> Flat:
    """Σ coefficient · monomial · trig letters."""
    generators.algebra.spend(4 * form.size)
    out: Flat = {}
    for h, p in form.parts.items():
        for trig, k in _expanded(h, generators, split).items():
            for m, c in p.items():
                key = m + trig
                out[key] = out.get(key, Fraction(0)) + Fraction(c, form.den) * k
    out = {m: c for m, c in out.items() if c}
    for angle in sorted(split):
        out = _folded(out, generators.trig_letter((angle, 0)), generators.trig_letter((angle, 1)))
    return out


def _expanded(harmonic: Harmonic, generators: Generators, split: frozenset[int]) -> dict[int, Fraction]:
    """cos or sin of h·a as products: of cos(k a_j), sin(k a_j) for the split angles and one harmonic of the others."""
    h, s = harmonic
    if h == 0:
        return {0: Fraction(1)}
    rest, own = _divided(h, split)
    sign = -1 if rest < 0 else 1
    cos_sum: dict[int, Fraction] = {unit(generators.trig_letter((abs(rest), 0))) if rest else 0: Fraction(1)}
    sin_sum: dict[int, Fraction] = {}
    if rest:
        sin_sum[unit(generators.trig_letter((abs(rest), 1)))] = Fraction(sign * generators.sign(abs(rest)))
    for angle, k in own:
        c, v = _multiple(generators.trig_letter((angle, 0)), generators.trig_letter((angle, 1)), k)
        if generators.sign(angle) < 0:
            v = {m: -x for m, x in v.items()}
        cos_sum, sin_sum = (
            _plus(_times(cos_sum, c), _times(sin_sum, v), -1),
            _plus(_times(sin_sum, c), _times(cos_sum, v), 1),
        )
    return sin_sum if s else cos_sum


def _divided(h: Packed, split: frozenset[int]) -> tuple[Packed, list[tuple[int, int]]]:
    """h = rest + Σ k·angle over the angles and sums of angles that are split, longest sums first."""
    own: list[tuple[int, int]] = []
    for angle in sorted(split, key=lambda a: (-len(multiples(a)), a)):
        pivot = _pivot(angle)
        k = dict(multiples(h)).get(pivot[0], 0) if pivot else 0
        if pivot and k and isinstance(k, int):
            own.append((angle, k * pivot[1]))
            h = whole(h - k * pivot[1] * angle)
    return h, own


def _multiple(c: int, s: int, k: int) -> tuple[dict[int, Fraction], dict[int, Fraction]]:
    """cos kx and sin kx in c = cos x and s = sin x, the sine at most linear (De Moivre with s² = 1 − c²)."""
    cos_k: dict[int, Fraction] = {0: Fraction(1)}
    sin_k: dict[int, Fraction] = {}
    one_c, one_s = {unit(c): Fraction(1)}, {unit(s): Fraction(1)}
    for _ in range(abs(k)):
        cos_k, sin_k = (
            _plus(_times(cos_k, one_c), _times(sin_k, one_s), -1),
            _plus(_times(sin_k, one_c), _times(cos_k, one_s), 1),
        )
        cos_k, sin_k = _linear_in_sine(cos_k, c, s), _linear_in_sine(sin_k, c, s)
    return cos_k, {m: -v for m, v in sin_k.items()} if k < 0 else sin_k


def _linear_in_sine(poly: dict[int, Fraction], c: int, s: int) -> dict[int, Fraction]:
    out: dict[int, Fraction] = {}
    for m, v in poly.items():
        if dict(digits(m)).get(s, 0) >= 2:
            lower = m - 2 * unit(s)
            out[lower] = out.get(lower, Fraction(0)) + v
            lower += 2 * unit(c)
            out[lower] = out.get(lower, Fraction(0)) - v
        else:
            out[m] = out.get(m, Fraction(0)) + v
    return {m: v for m, v in out.items() if v}


def _times(p: dict[int, Fraction], q: dict[int, Fraction]) -> dict[int, Fraction]:
    out: dict[int, Fraction] = {}
    for m, a in p.items():
        for n, b in q.items():
            out[m + n] = out.get(m + n, Fraction(0)) + a * b
    return out


def _plus(p: dict[int, Fraction], q: dict[int, Fraction], sign: int) -> dict[int, Fraction]:
    out = dict(p)
    for m, v in q.items():
        out[m] = out.get(m, Fraction(0)) + sign * v
    return {m: v for m, v in out.items() if v}


def _folded(poly: Flat, c: int, s: int) -> Flat:
    """Replace c² by 1 − s² in every group of terms in which that gives fewer terms: 1 − c² is s²."""
    groups: dict[tuple[int, int], dict[int, Fraction]] = {}
    for m, v in poly.items():
        powers = dict(digits(m))
        e = powers.get(c, 0)
        odd = e % 2
        groups.setdefault((m - e * unit(c), odd), {})[e // 2] = v
    out: Flat = {}
    for (rest, odd), even in groups.items():
        other: dict[int, Fraction] = {}
        for power, v in even.items():
            for i in range(power + 1):
                other[i] = other.get(i, Fraction(0)) + v * (-1) ** i * comb(power, i)
        other = {i: v for i, v in other.items() if v}
        letter, chosen = (s, other) if len(other) < len(even) else (c, even)
        for power, v in chosen.items():
            m = rest + odd * unit(c) + 2 * power * unit(letter)
            out[m] = out.get(m, Fraction(0)) + v
    return {m: v for m, v in out.items() if v}


def plain_cost(poly: Flat, generators: Generators) -> int:
    """The approximate number of operations of the plain sum."""
    total = 0
    for m, c in poly.items():
        total += 1 + (abs(c.numerator) != 1) + (c.denominator != 1)
        for i, e in digits(m):
            total += 1 + (abs(e) != 1) + (generators.cost(i))
    return total
