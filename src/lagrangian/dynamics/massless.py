"""A rate k without inertia that several rows hold, where no row has a coefficient that cannot vanish.

Rows may be combined: Σ Q_ij λ′_j for λ_i is the same problem for any regular Q. The reflection

    Q = 1 − v vᵀ / (ρ (ρ + |a₁|)),      v = a + sign(a₁) ρ e₁,      ρ = |a|

turns the coefficients a_i of the rate into −sign(a₁) ρ in one row and 0 in all others. It exists unless all a_i vanish,
and then nothing determines the rate. It is eliminated together with its one row: in

    | h  a |
    | a  d |      h ≥ 0 is its inertia so far and d ≤ 0 what rates before it left in the row,

so that h d − a² < 0 never vanishes. The other rows no longer contain the rate.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.dynamics.accelerations import Elimination
from lagrangian.dynamics.tape import Form
from lagrangian.dynamics.vectors import Matrix, dot
from lagrangian.graph import Graph


def reflection(g: Graph, a: Sequence[int]) -> tuple[Matrix, int]:
    """Q, and the coefficient −sign(a₁) ρ of the first combined row."""
    rho = g.sqrt(dot(g, a, a))
    sign = g.select(g.lt(a[0], g.zero), g.negative, g.one)
    v = [g.add(a[0], g.mul(sign, rho)), *a[1:]]
    over = g.div(g.one, g.mul(rho, g.add(rho, g.mul(sign, a[0]))))  # not |a₁|, whose slope at 0 is that of neither side
    rows = [
        [g.sub(g.one if i == j else g.zero, g.mul(g.mul(x, over), y)) for j, y in enumerate(v)] for i, x in enumerate(v)
    ]
    return rows, g.neg(g.mul(sign, rho))


def combine(e: Elimination, k: int, old: Sequence[int], new: Sequence[int]) -> None:
    """Replace the multipliers ``old`` by ``new`` ones, of which the first alone acts on the rate k."""
    g, H = e.graph, e.H
    Q, coefficient = reflection(g, [H.rows[k][key] for key in old])
    for key in old:
        H.add(k, key, g.neg(H.rows[k][key]))
    for key, row in zip(old, Q, strict=True):
        form: Form = {j: x for j, x in zip(new, row, strict=True) if x != g.zero}
        e.substitute(key, form)
        e.found.append((key, g.zero, form))
    H.add(k, new[0], coefficient)


def eliminate_pair(e: Elimination, k: int, key: int) -> None:
    """Eliminate a rate and a multiplier together, whatever their diagonal is."""
    g, H = e.graph, e.H
    one, two = H.pop(k), H.pop(key)
    h, d, a = one.pop(k, g.zero), two.pop(key, g.zero), one.pop(key)
    two.pop(k, None)
    over = g.div(g.one, g.sub(g.mul(a, a), g.mul(h, d)))
    first, mixed, last = g.neg(g.mul(d, over)), g.mul(a, over), g.neg(g.mul(h, over))  # of the inverse

    def solved(x: int, y: int) -> tuple[int, int]:
        """The rate and the multiplier for the loads x and y."""
        rate, multiplier = g.add(g.mul(first, x), g.mul(mixed, y)), g.add(g.mul(mixed, x), g.mul(last, y))
        return g.neg(rate), g.neg(multiplier)

    others = list(dict.fromkeys((*one, *two)))
    forms = {j: solved(one.get(j, g.zero), two.get(j, g.zero)) for j in others}
    constants = solved(e.g.pop(k, g.zero), e.g.pop(key, g.zero))
    for n, j in enumerate(others):
        x, y = one.get(j, g.zero), two.get(j, g.zero)
        e.add_linear(j, g.add(g.mul(x, constants[0]), g.mul(y, constants[1])))
        for i in others[n:]:
            H.add(j, i, g.add(g.mul(x, forms[i][0]), g.mul(y, forms[i][1])))
    for at, unknown in enumerate((k, key)):
        e.found.append((unknown, constants[at], {j: pair[at] for j, pair in forms.items() if pair[at] != g.zero}))
