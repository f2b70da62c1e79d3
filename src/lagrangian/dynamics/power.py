"""The energy balance of a moving system, from its Lagrangian:

    h = q̇·∂L/∂q̇ − L,        dh/dt = Ξ·q̇ − ∂L/∂t

h is T* + V if no motion is prescribed. A potential that depends on an input (a winch, a driven end of a spring) changes
with a signal of unknown rate: it is left out of h, and its force counts among those that supply power.
"""

from __future__ import annotations

from lagrangian.dynamics.constrained import drive
from lagrangian.dynamics.observe import Observed
from lagrangian.dynamics.programs import _program
from lagrangian.dynamics.vectors import dot
from lagrangian.graph import Graph, Output, Program, gradient, reached
from lagrangian.model import Model


def power(model: Model) -> Program:
    """x, u, p, t → h [J] and P = Ξ·q̇ − ∂L/∂t [W], with dh/dt = P along every motion; also T and V [J]."""
    seen = Observed(model)
    return _program(model, "power", seen.graph, balance(seen), groups=("x",))


def balance(seen: Observed) -> dict[str, Output]:
    """h, P, T and V as outputs."""
    found = {
        "h": balanced(seen),
        "P": supplied(seen),
        "T": seen.mechanics.kinetic(),
        "V": seen.mechanics.potential(),
    }
    return {name: Output((node,), ()) for name, node in found.items()}


def balance_terms(seen: Observed) -> dict[str, Output]:
    """The terms of dh/dt − P at a state, with accelerations from forward dynamics; their sum is 0.

    dh/dt = ∂h/∂q·q̇ + ∂h/∂v·v̇ + ∂h/∂t, entry by entry, and −P.
    """
    g, m = seen.graph, seen.mechanics
    moving = [*m.q, *m.v, seen.inputs.t]
    rates = [*m.motion.rates, *seen.vdot, g.one]
    slopes = gradient(g, balanced(seen), moving)
    terms = [g.mul(slope, rate) for slope, rate in zip(slopes, rates, strict=True)]
    terms.append(g.neg(supplied(seen)))
    return {"terms": Output(tuple(terms), (len(terms),))}


def balanced(seen: Observed) -> int:
    """h = Σ v_i ∂T/∂v_i − T + V, without the potentials that depend on inputs."""
    g, m = seen.graph, seen.mechanics
    T = m.kinetic()
    momenta = gradient(g, T, m.v)
    return g.add(g.sub(dot(g, m.v, momenta), T), _own_potential(seen))


def supplied(seen: Observed) -> int:
    """P = Ξ·v − ∂L/∂t − ∂V_u/∂q·q̇, where V_u are the potentials that depend on inputs."""
    g, m = seen.graph, seen.mechanics
    total = dot(g, m.gathered([*m.efforts, *m.dragged]), m.v)
    own = g.sub(m.kinetic(), _own_potential(seen))
    total = g.sub(total, gradient(g, own, [seen.inputs.t])[0])
    for driven in _driven(seen):
        total = g.sub(total, dot(g, gradient(g, driven, m.q), m.motion.rates))
    if m.rows and any(x != g.zero for x in drive(m)):
        total = g.sub(total, dot(g, m.constrained.multipliers, drive(m)))
    return total


def _own_potential(seen: Observed) -> int:
    """V without the potentials that depend on inputs."""
    g = seen.graph
    total = seen.mechanics.potential()
    for driven in _driven(seen):
        total = g.sub(total, driven)
    return total


def _driven(seen: Observed) -> list[int]:
    """The potentials that depend on inputs."""
    return [V for V in seen.mechanics.potentials if _reads_inputs(seen.graph, V)]


def _reads_inputs(graph: Graph, node: int) -> bool:
    return any(graph.nodes[i][:2] == ("input", "u") for i in reached(graph, [node]))
