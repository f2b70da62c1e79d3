"""∂T*/∂ξ_i from the few velocities that a coordinate enters directly.

With a named velocity v held where it is used, ∂T*/∂ξ = Σ (momentum on v) ∂v/∂ξ over the velocities whose own formula
contains ξ. Where angles add up, φ₃ = φ₂ + q₃, each sum of angles is held as well, and what hangs on it is summed
inwards: otherwise every coordinate would list everything that is further out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lagrangian.dynamics.description import Description
from lagrangian.graph import jvp, reached
from lagrangian.structured.names import Indices
from lagrangian.structured.quantities import Candidate


class CoordinateSlopes:
    """∂T*/∂x of every coordinate and every sum of angles x."""

    def __init__(self, d: Description, velocities: Sequence[int], momenta: Mapping[int, int]) -> None:
        self.d, self.momenta = d, momenta
        g = d.graph
        q = list(d.inputs.q)
        self.sums = (
            sorted({a for a in d.angles.values() if g.nodes[a][0] in ("add", "sub")}) if d.motion.dimension == 2 else []
        )
        self._held = {v for v in velocities if g.nodes[v][0] not in ("input", "const")}
        self._theta: dict[int, int] = dict.fromkeys([*q, *self.sums], g.zero)
        for v in self._held:
            if v in momenta:
                self._spread(v, momenta[v], self._held)
        for angle in reversed(self.sums):
            self._spread(angle, self._theta[angle], set())

    def _spread(self, node: int, weight: int, held: set[int]) -> None:
        """Add weight · ∂node/∂x to every x that the node's own formula contains."""
        g = self.d.graph
        others = (held | set(self._theta)) - {node}
        if weight == g.zero:
            return
        for x in [i for i in reached(g, [node], others) if i in self._theta and i != node]:
            (slope,) = jvp(g, [node], {**dict.fromkeys(others, g.zero), x: g.one})
            if slope != g.zero:
                self._theta[x] = g.add(self._theta[x], g.mul(weight, slope))

    def of(self, coordinate: int) -> int:
        """∂T*/∂ξ of a coordinate."""
        return self._theta[coordinate]

    def candidates(self, indices: Indices) -> list[Candidate]:
        """The sums inwards over what hangs on a sum of angles."""
        axes = {angle: indices.axes[self.d.axes[frame]] for frame, angle in self.d.angles.items()}
        return [Candidate(self._theta[a], "momentum", "Theta", (axes[a],), f"angle {axes[a]}", True) for a in self.sums]
