"""C(q, v) by Christoffel's symbols."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import or_

from lagrangian.dynamics.floating import bracket
from lagrangian.dynamics.inertia import AnyLink
from lagrangian.dynamics.mechanics import SMALL, Mechanics
from lagrangian.dynamics.vectors import Matrix, Vector, dot
from lagrangian.graph import Graph, jvp, operands, reached

HOPELESS = 4
"""How many times as many operations on its own make one of two ways hopeless."""


def coriolis(m: Mechanics) -> Matrix:
    """C by Christoffel's symbols, so that Ṁ − 2C is skew:  C = ½ (Ṁ + P − Pᵀ),  P_ij = ∂(M v)_i/∂q_j.

    With quasi-velocities q̇ = N u, the derivatives are taken along the columns of N, P = ∂(M u)/∂q N, and terms with
    the brackets of the velocities are added (Koszul's formula for the connection of M):

        C = ½ (Ṁ + P − Pᵀ + M A − (M A)ᵀ − B),   A = ad_u,   B_ij = (M u)·[e_j, e_i]

    M u is the product of M and u, or gathered from the bodies, whichever makes C cheaper.
    """
    g, n = m.graph, len(m.v)
    M = m.mass_matrix()
    change = jvp(g, [x for row in M for x in row], dict(zip(m.q, m.motion.rates, strict=True)))
    product, gathered = [dot(g, row, m.v) for row in M], [_momenta(m, links) for links in m.groupings]
    momenta = [product, *gathered] if n <= SMALL else _likely(m, product, gathered)
    flat = m.cheapest([x for row in _by(m, M, change, momentum) for x in row] for momentum in momenta)
    return [flat[i * n : (i + 1) * n] for i in range(n)]


def slope_work(g: Graph, ids: Sequence[int], inputs: Sequence[int]) -> int:
    """About how many operations the derivatives of ``ids`` by every one of ``inputs`` take.

    A sum takes one for every input that both of its terms contain; anything else takes one for every operand that
    contains it, and one to add where both do.
    """
    contains = {x: 1 << k for k, x in enumerate(inputs)}  # a bit for each input
    work = 0
    for i in reached(g, ids, inputs):
        if i in contains:
            continue
        found = [contains[k] for k in operands(g.nodes[i])]
        contains[i] = reduce(or_, found, 0)
        shared = sum(x.bit_count() for x in found) - contains[i].bit_count()
        work += shared if g.nodes[i][0] in ("add", "sub") else contains[i].bit_count() + 2 * shared
    return work


def _likely(m: Mechanics, product: Vector, gathered: Sequence[Vector]) -> list[Vector]:
    """The ways to compute M u of a long system that are worth a try: some 100 000 nodes may follow from one.

    The derivatives of the product share terms with Ṁ, so it is tried although its own take a few times as many.
    """
    best, work = min(((ids, slope_work(m.graph, ids, m.q)) for ids in gathered), key=lambda pair: pair[1])
    return [product, best] if slope_work(m.graph, product, m.q) < HOPELESS * work else [best]


def _momenta(m: Mechanics, links: Sequence[AnyLink]) -> Vector:
    """M v = Σ_ik (∂v_i/∂v) H_ik v_k over the velocities of the bodies."""
    rows = m.inertia(links).rows
    return m.gathered([(i, dot(m.graph, list(row.values()), list(row))) for i, row in rows.items()])


def _by(m: Mechanics, M: Matrix, change: Vector, momentum: Vector) -> Matrix:
    """C with one way to compute Ṁ and M u."""
    g, n = m.graph, len(m.v)
    columns = _along_velocities(m, momentum)
    total = [[g.add(change[i * n + j], g.sub(columns[j][i], columns[i][j])) for j in range(n)] for i in range(n)]
    for at in m.floats:
        own = at.velocities
        basis = [[g.one if i == k else g.zero for i in own] for k in own]
        u, h = [m.v[i] for i in own], [momentum[i] for i in own]
        A = [bracket(g, u, e) for e in basis]  # A[j] is column j
        for j, column in zip(own, A, strict=True):
            for i in range(n):
                x = dot(g, [M[i][k] for k in own], column)
                total[i][j] = g.add(total[i][j], x)
                total[j][i] = g.sub(total[j][i], x)
            for i in own:
                twist = bracket(g, basis[j - at.v], basis[i - at.v])
                total[i][j] = g.sub(total[i][j], dot(g, h, twist))
    return [[g.mul(g.const(0.5), x) for x in row] for row in total]


def _along_velocities(m: Mechanics, ids: Sequence[int]) -> list[list[int]]:
    """The derivatives of nodes that depend on q, with v held, along each velocity: ∂/∂q N e_j."""
    g = m.graph
    moved: list[list[int]] = []
    for v in m.v:
        along = jvp(g, list(m.motion.rates), {v: g.one})
        moved.append(jvp(g, ids, {q: x for q, x in zip(m.q, along, strict=True) if x != g.zero}))
    return moved
