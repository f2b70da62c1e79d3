"""Links: the inertia of rigidly connected bodies; parts that a turn does not affect can be moved to the parent.

In space a link's inertia about its place O, in its own axes, is (m, h, Σ): mass, first moment ∫ρ r and second moment
∫ρ r rᵀ, so that I_O = tr Σ · 1 − Σ. With A = [α]× + ω ωᵀ − |ω|² 1 the acceleration at r is a + A r, and

    f = m a + A h,        n = h × a + ∫ρ r × (A r),        T = ½ m v² + v·(ω × h) + ½ ωᵀ I_O ω.

In the plane it is (m, h, J) with h turned into the fixed axes:  f = m a + α × h − ω² h,  n = J α + h × a.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.dynamics.axes import Accelerations, Axes, PlaceMotion
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.vectors import Matrix, Vector, cross, plus, product, scaled, times, transposed, zeros
from lagrangian.graph import Graph
from lagrangian.records import dataclass

Pairs = list[tuple[int, int]]
Triples = list[tuple[int, int, int]]


@dataclass
class Inertia:
    """m [kg], h [kg m], Σ [kg m²] about a link's place, in its axes."""

    m: int
    h: Vector
    S: Matrix

    @classmethod
    def none(cls, g: Graph) -> Inertia:
        """No inertia."""
        return cls(g.zero, zeros(g, 3), [zeros(g, 3) for _ in range(3)])

    @classmethod
    def of_body(cls, g: Graph, m: int, centre: Sequence[int], central: Matrix) -> Inertia:
        """A body of mass m with centre of mass at ``centre`` and inertia tensor I_C: Σ = ½ tr I_C 1 − I_C + m c cᵀ."""
        half = g.mul(g.const(0.5), g.add(g.add(central[0][0], central[1][1]), central[2][2]))
        second = [[g.sub(half if i == j else g.zero, central[i][j]) for j in range(3)] for i in range(3)]
        return cls(m, zeros(g, 3), second).shifted(g, centre)

    def shifted(self, g: Graph, r: Sequence[int]) -> Inertia:
        """The same mass about a place from which it is displaced by r: h + m r, Σ + r hᵀ + h rᵀ + m r rᵀ."""
        mr = scaled(g, self.m, r)
        second = [
            [
                g.add(g.add(self.S[i][j], g.add(g.mul(r[i], self.h[j]), g.mul(self.h[i], r[j]))), g.mul(r[i], mr[j]))
                if i <= j
                else g.zero
                for j in range(3)
            ]
            for i in range(3)
        ]
        return Inertia(
            self.m, plus(g, self.h, mr), [[second[min(i, j)][max(i, j)] for j in range(3)] for i in range(3)]
        )

    def turned(self, g: Graph, R: Matrix) -> Inertia:
        """The same mass in axes to which R leads: R h, R Σ Rᵀ."""
        second = product(g, product(g, R, self.S), transposed(R))
        return Inertia(
            self.m, times(g, R, self.h), [[second[min(i, j)][max(i, j)] for j in range(3)] for i in range(3)]
        )

    def plus(self, g: Graph, other: Inertia) -> Inertia:
        """The sum of both inertias."""
        return Inertia(
            g.add(self.m, other.m),
            plus(g, self.h, other.h),
            [plus(g, a, b) for a, b in zip(self.S, other.S, strict=True)],
        )

    def tensor(self, g: Graph) -> Matrix:
        """I_O = tr Σ 1 − Σ."""
        s = self.S
        return [
            [
                g.add(s[(i + 1) % 3][(i + 1) % 3], s[(i + 2) % 3][(i + 2) % 3]) if i == j else g.neg(s[i][j])
                for j in range(3)
            ]
            for i in range(3)
        ]


@dataclass
class Link:
    """A rigid part in space: its axes, its place, and its inertia about that place in these axes."""

    axes: Axes
    place: PlaceMotion
    inertia: Inertia

    def velocity(self, motion: Motion) -> Vector:
        """v of the place, in the link's axes."""
        return motion.turned(self.place.velocity, self.place.axes, self.axes)

    def seeds(self, motion: Motion) -> Triples:
        """The entries (i, k, h) of T = Σ h v_i v_k over its velocity nodes."""
        g, v, w = motion.graph, self.velocity(motion), self.axes.omega
        h, tensor, half = self.inertia.h, self.inertia.tensor(g), g.const(0.5)
        triples: Triples = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            triples.append((v[i], v[i], g.mul(half, self.inertia.m)))
            triples += [(v[i], w[j], h[k]), (v[i], w[k], g.neg(h[j]))]  # v·(ω × h)
            triples += [(w[i], w[i], g.mul(half, tensor[i][i])), (w[i], w[j], tensor[i][j])]
        return triples

    def moment(self, motion: Motion) -> Vector:
        """∫ρ r from the origin, in the fixed axes: m r_O + R h."""
        g = motion.graph
        turned = times(g, motion.rotation(self.axes), self.inertia.h)
        return plus(g, scaled(g, self.inertia.m, motion.position(self.place)), turned)

    def wrench(self, motion: Motion, acc: Accelerations) -> Pairs:
        """f = m a + A h on the place's velocity and n = h × a + ∫ρ r × (A r) on ω."""
        g, w = motion.graph, self.axes.omega
        a = motion.turned(acc.a[self.place], self.place.axes, self.axes)
        m, h, S = self.inertia.m, self.inertia.h, self.inertia.S
        A = motion.spin(self.axes, acc)
        force = plus(g, times(g, A, h), scaled(g, m, a))
        moment = cross(g, h, a)
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            # ∫ρ (r × A r)_i = A_kj Σ_jj − A_jk Σ_kk + (ω_k² − ω_j²) Σ_jk + A_ki Σ_ij − A_ji Σ_ik
            square = g.sub(g.mul(w[k], w[k]), g.mul(w[j], w[j]))
            parts = (
                g.sub(g.mul(A[k][j], S[j][j]), g.mul(A[j][k], S[k][k])),
                g.mul(square, S[j][k]),
                g.sub(g.mul(A[k][i], S[i][j]), g.mul(A[j][i], S[i][k])),
            )
            for part in parts:
                moment[i] = g.add(moment[i], part)
        return [*zip(self.velocity(motion), force, strict=True), *zip(w, moment, strict=True)]


@dataclass
class PlaneLink:
    """A rigid part in the plane: ``h`` in its own axes, J about its place; the velocities are in the fixed axes."""

    axes: Axes
    place: PlaceMotion
    m: int
    h: Vector
    J: int

    def plus(self, g: Graph, m: int, h: Vector, J: int) -> PlaneLink:
        """The part with additional mass."""
        return PlaneLink(self.axes, self.place, g.add(self.m, m), plus(g, self.h, h), g.add(self.J, J))

    def seeds(self, motion: Motion) -> Triples:
        """The entries (i, k, h) of T = Σ h v_i v_k: ½ m v² + ω (h_x v_y − h_y v_x) + ½ J ω²."""
        g, (vx, vy), w = motion.graph, self.place.velocity, self.axes.omega[0]
        hx, hy = times(g, self.axes.turn, self.h)
        m, J = g.mul(g.const(0.5), self.m), g.mul(g.const(0.5), self.J)
        return [(vx, vx, m), (vy, vy, m), (vx, w, g.neg(hy)), (vy, w, hx), (w, w, J)]

    def moment(self, motion: Motion) -> Vector:
        """∫ρ r from the origin, in the fixed axes: m r_O + R h."""
        g = motion.graph
        return plus(g, scaled(g, self.m, motion.position(self.place)), times(g, self.axes.turn, self.h))

    def wrench(self, motion: Motion, acc: Accelerations) -> Pairs:
        """f = m a + α × h − ω² h,  n = J α + h × a."""
        g, w, alpha = motion.graph, self.axes.omega[0], acc.alpha[self.axes][0]
        hx, hy = times(g, self.axes.turn, self.h)
        ax, ay = acc.a[self.place]
        ww = g.mul(w, w)
        fx = g.sub(g.sub(g.mul(self.m, ax), g.mul(alpha, hy)), g.mul(ww, hx))
        fy = g.sub(g.add(g.mul(self.m, ay), g.mul(alpha, hx)), g.mul(ww, hy))
        n = g.add(g.mul(self.J, alpha), g.sub(g.mul(hx, ay), g.mul(hy, ax)))
        vx, vy = self.place.velocity
        return [(vx, fx), (vy, fy), (w, n)]


AnyLink = Link | PlaneLink
