"""C(q, v) by Christoffel's symbols."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.dynamics.floating import bracket
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.vectors import dot
from lagrangian.graph import jvp


def coriolis(m: Mechanics) -> list[list[int]]:
    """C by Christoffel's symbols, so that Ṁ − 2C is skew:  C = ½ (Ṁ + P − Pᵀ),  P_ij = ∂(M v)_i/∂q_j.

    With quasi-velocities q̇ = N u, the derivatives are taken along the columns of N, P = ∂(M u)/∂q N, and terms with
    the brackets of the velocities are added (Koszul's formula for the connection of M):

        C = ½ (Ṁ + P − Pᵀ + M A − (M A)ᵀ − B),   A = ad_u,   B_ij = (M u)·[e_j, e_i]
    """
    g, n = m.graph, len(m.v)
    M = m.mass_matrix()
    change = jvp(g, [x for row in M for x in row], dict(zip(m.q, m.motion.rates, strict=True)))
    momentum = [dot(g, row, m.v) for row in M]
    columns = _along_velocities(m, momentum)
    total = [[g.add(change[i * n + j], g.sub(columns[j][i], columns[i][j])) for j in range(n)] for i in range(n)]
    for at in m.floats:
        own = range(at.v, at.v + 6)
        basis = [[g.one if i == k else g.zero for i in range(6)] for k in range(6)]
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
