"""Hamilton's equations of a model, in coordinates and momenta, for symplectic methods.

    p = ∂L/∂q̇ = M(q, t) q̇ + b(q, t),    q̇ = M⁻¹ (p − b),    ṗ = ∂L/∂q + Ξ

M⁻¹ is never formed: q̇ is computed from p − b by the same elimination along the velocity tape as the accelerations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

from lagrangian.dynamics.accelerations import solve
from lagrangian.dynamics.feedback import SUPPLY, Feedback, with_feedback
from lagrangian.dynamics.impacts import Impact, impact_outputs
from lagrangian.dynamics.observe import Observed
from lagrangian.dynamics.power import supplied
from lagrangian.dynamics.programs import _program
from lagrangian.dynamics.tape import make_tape
from lagrangian.dynamics.vectors import minus, plus
from lagrangian.errors import ModelError
from lagrangian.graph import Output, Program, gradient, reached, replaced
from lagrangian.model import Model


class Canonical:
    """A model's momenta as nodes over [q; v], and its rates as nodes over [q; p] of the same inputs."""

    def __init__(self, model: Model) -> None:
        if model.floating:
            raise ModelError(
                f"frame '{model.floating[0].name}' is a floating frame, whose velocities have no canonical momenta",
                fix="use another method, such as dop853",
                code="E201",
            )
        if model.constraints:
            raise ModelError(
                f"the constraints of system '{model.name}' leave its momenta dependent",
                fix="use another method, such as dop853",
                code="E201",
            )
        self.seen = Observed(model)
        self.names = tuple(f"∂L/∂{v.name}" for v in model.velocities)

    @cached_property
    def momenta(self) -> list[int]:
        """∂T/∂v over [q; v]."""
        m = self.seen.mechanics
        return gradient(self.seen.graph, m.kinetic(), m.v)

    @cached_property
    def rates(self) -> list[int]:
        """v over [q; p], where the entries of x after q are momenta."""
        g, m = self.seen.graph, self.seen.mechanics
        still = dict.fromkeys(m.v, g.zero)
        drift = replaced(g, self.momenta, still)
        found: list[list[int]] = []
        for links in m.groupings:
            H = m.inertia(links)
            held = [h for row in H.rows.values() for h in row.values()]
            if set(m.v) & set(reached(g, held)):
                raise ModelError(
                    "a kinetic energy is not quadratic in the rates: its momenta cannot be solved for them",
                    fix="use another method, such as dop853",
                    code="E201",
                )
            linear = {v: g.neg(p) for v, p in zip(m.v, minus(g, m.v, drift), strict=True)}
            tape = make_tape(g, list(dict.fromkeys((*H.rows, *linear))), m.v, H.rows)
            found.append(solve(g, tape, H, linear, m.v, dict(zip(m.v, m.names, strict=True))))
        return m.cheapest(found)

    def over_momenta(self, program: Program, states: Sequence[str] = ()) -> Program:
        """Convert a program over x = [q; v] to one over x = [q; p]."""
        at = dict(zip(self.seen.mechanics.v, self.rates, strict=True))
        outputs = {
            name: Output(tuple(replaced(program.graph, out.ids, at)), out.shape)
            for name, out in program.outputs.items()
        }
        q = tuple(c.name for c in self.seen.model.coordinates)
        return replace(program, outputs=outputs, inputs={**program.inputs, "x": (*q, *self.names, *states)})


def canonical(model: Model, feedback: Feedback, *, supply: bool = False) -> Program:
    """x = [q; p], u, p, t → ẋ by Hamilton's equations; feedback and supply as in `lagrangian.dynamics.feedback`."""
    made = Canonical(model)
    seen = made.seen
    g, m = seen.graph, seen.mechanics
    L = g.sub(m.kinetic(), m.potential())
    ids = [*m.motion.rates, *plus(g, gradient(g, L, m.q), m.gathered(m.efforts))]
    states: tuple[str, ...] = ()
    if supply and (power := supplied(seen)) != g.zero:
        ids.append(power)
        states = (SUPPLY,)
    program = with_feedback(seen, {"xdot": Output(tuple(ids), (len(ids),))}, feedback, "canonical")
    return made.over_momenta(program, states)


def momenta(model: Model) -> Program:
    """x = [q; v], u, p, t → the momenta p = ∂L/∂v, shape (n,)."""
    made = Canonical(model)
    ids = tuple(made.momenta)
    return _program(model, "momenta", made.seen.graph, {"p": Output(ids, (len(ids),))}, groups=("x",))


def velocities(model: Model) -> Program:
    """x = [q; p], u, p, t → the velocities v, shape (n,)."""
    made = Canonical(model)
    program = _program(
        model, "velocities", made.seen.graph, {"v": Output(made.seen.mechanics.v, (len(made.names),))}, groups=("x",)
    )
    return made.over_momenta(program)


def canonical_impacts(model: Model, events: Sequence[Impact], feedback: Feedback, *, supply: bool = False) -> Program:
    """`lagrangian.dynamics.impacts` over x = [q; p]: the velocities after an event are converted to momenta."""
    made = Canonical(model)
    seen = made.seen
    g, m = seen.graph, seen.mechanics
    n = len(m.q)
    outputs = impact_outputs(seen, events, supply)
    if "after" in outputs:
        count, size = outputs["after"].shape
        ids: list[int] = []
        for k in range(count):
            row = list(outputs["after"].ids[k * size : (k + 1) * size])
            there = dict(zip((*m.q, *m.v), row, strict=False))
            row[n : 2 * n] = replaced(g, made.momenta, there)
            ids += row
        outputs = {**outputs, "after": Output(tuple(ids), (count, size))}
    program = with_feedback(seen, outputs, feedback, "events")
    return made.over_momenta(program, (SUPPLY,) if supply else ())
