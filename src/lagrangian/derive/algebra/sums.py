"""Sums of parameters in the description of a system, such as L_a + L_b, become one symbol if that is shorter.

If a mass at the end of link 1 is at (L_a + L_b) cos θ₁, then m₁ L_a² + m₂ (L_a + L_b)² is easier to read than (m₁ + m₂)
L_a² + m₂ L_b (2 L_a + L_b), although not shorter. With S for the sum, L_b = S − L_a is substituted and expanded: what
was a product of sums becomes one again.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from lagrangian.derive.algebra.factor import Flat, order, primitive
from lagrangian.derive.algebra.generators import Generators
from lagrangian.derive.algebra.monomials import digits, unit
from lagrangian.derive.algebra.trig import plain_cost
from lagrangian.derive.algebra.variables import Symbolic

if TYPE_CHECKING:
    from lagrangian.derive.algebra.form import Form

MAX_LETTERS = 4
"""The largest number of symbols of a sum."""
MAX_SUMS = 12
"""The largest number of sums, of which the first ones are kept."""
LARGEST_FLAT = 1500
"""A form with more terms is left as it is."""
HIGHEST = 4
"""The highest power of a symbol for which a sum is substituted."""


def sums_in(form: Form, generators: Generators) -> list[Flat]:
    """Return the sums a + b, a − b of parameters, plain or squared, that multiply moving quantities."""
    found: list[Flat] = []
    for (h, _), poly in form.parts.items():
        groups: dict[int, Flat] = {}
        for m, c in poly.items():
            moved = generators.moving(m)
            if moved or (h and generators.turning(h)):
                groups.setdefault(moved, {})[m - moved] = Fraction(c)
        for group in groups.values():
            base = _base(primitive(group)[2], generators)
            if base and base not in found:
                found.append(base)
    return found


def _base(poly: Flat, generators: Generators) -> Flat | None:
    """The polynomial if it is Σ ±a_i, or Σ ±a_i if the polynomial is its square; otherwise None."""
    single = {m: c for m, c in poly.items() if _letter(m, generators) is not None}
    if len(single) == len(poly):
        return poly if 1 < len(poly) <= MAX_LETTERS and all(abs(c) == 1 for c in poly.values()) else None
    roots = [i for m in sorted(poly, key=order) for i, e in digits(m) if poly[m] == 1 and e == 2 and m == 2 * unit(i)]
    if not 1 < len(roots) <= MAX_LETTERS or len(poly) != len(roots) * (len(roots) + 1) // 2:
        return None
    first = unit(roots[0])
    base = {first: Fraction(1)} | {unit(i): poly.get(first + unit(i), Fraction(0)) / 2 for i in roots[1:]}
    square: Flat = {}
    for m, a in base.items():
        for n, b in base.items():
            square[m + n] = square.get(m + n, Fraction(0)) + a * b
    plain = all(_letter(m, generators) is not None and abs(c) == 1 for m, c in base.items())
    return base if plain and square == poly else None


def _letter(monomial: int, generators: Generators) -> int | None:
    """The parameter of a monomial that is a single parameter; otherwise None."""
    pairs = digits(monomial)
    if len(pairs) != 1 or pairs[0][1] != 1:
        return None
    entry = generators.table[pairs[0][0]]
    return pairs[0][0] if isinstance(entry, Symbolic) and entry.role == "parameter" else None


def with_sums(flat: Flat, sums: Sequence[Flat], generators: Generators) -> Flat:
    """Return the polynomial with sums as symbols in every group of terms with the same motion that becomes shorter."""
    if not sums or not 1 < len(flat) <= LARGEST_FLAT:
        return flat
    groups: dict[int, Flat] = {}
    for m, c in flat.items():
        groups.setdefault(generators.moving(m), {})[m] = c
    out: Flat = {}
    for group in groups.values():
        out |= _shorter(group, sums, generators) if len(group) > 1 else group
    return out


def _shorter(flat: Flat, sums: Sequence[Flat], generators: Generators) -> Flat:
    """The polynomial with each of the sums substituted if it then has fewer terms, or as many and simpler ones."""
    best, best_cost = flat, (len(flat), plain_cost(flat, generators))
    for base in sums:
        here, letters = best, {i for m in best for i, _ in digits(m)}
        if any(i not in letters for n in base for i, _ in digits(n)):
            continue
        letter = generators.sum_letter(base)
        for n, c in base.items():
            trial = _put_in(here, digits(n)[0][0], _solved(base, n, c, letter))
            if trial is None:
                continue
            cost = (len(trial), plain_cost(trial, generators))
            if cost < best_cost:
                best, best_cost = trial, cost
    return best


def _solved(base: Flat, monomial: int, coefficient: Fraction, letter: int) -> Flat:
    """S = c·a + rest solved for a = (S − rest)/c, where c is ±1."""
    out = {n: -c * coefficient for n, c in base.items() if n != monomial}
    out[unit(letter)] = coefficient
    return out


def _put_in(flat: Flat, letter: int, value: Flat) -> Flat | None:
    """Return the polynomial with a sum substituted for a symbol; None if the symbol is in a denominator or has a high
    power."""
    powers: list[Flat] = [{0: Fraction(1)}]
    out: Flat = {}
    for m, c in flat.items():
        e = dict(digits(m)).get(letter, 0)
        if not 0 <= e <= HIGHEST:
            return None
        while len(powers) <= e:
            higher: Flat = {}
            for n, a in powers[-1].items():
                for k, b in value.items():
                    higher[n + k] = higher.get(n + k, Fraction(0)) + a * b
            powers.append(higher)
        bare = m - e * unit(letter)
        for n, a in powers[e].items():
            out[bare + n] = out.get(bare + n, Fraction(0)) + a * c
    return {m: c for m, c in out.items() if c}
