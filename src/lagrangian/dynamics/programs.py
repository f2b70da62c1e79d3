"""The programs of a model: each a graph of its own with the groups q, v, u, p, t as far as it needs them.

    inverse        r(q, v, a, u, p, t) = M a + C v + G − Ξ       the generalized force that is missing
    forward        a(q, v, u, p, t), the solution of r = 0
    rhs            ẋ of x = [q; v]
    rates          q̇ = N(q) v
    mass_matrix    M(q, p, t)
    bias           r at a = 0
    potential_force  G = ∂V/∂q
    coriolis       C(q, v, p, t) by Christoffel, so that Ṁ − 2C is skew
    energy         T and V
    loss           the power that dampers take [W]

Every group is named in ``inputs`` even where a program does not read it, so that all are called alike. Parameters carry
the model's values as defaults.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import wraps

from lagrangian.dynamics import christoffel
from lagrangian.dynamics.describe import describe
from lagrangian.dynamics.description import Inputs
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Output, Program
from lagrangian.model import Model


def _start(model: Model, *, state: bool = False) -> tuple[Graph, Inputs, Mechanics]:
    if not model.coordinates:
        raise ModelError(f"system '{model.name}' has no coordinates, so nothing can move", code="E201")
    graph = Graph()
    inputs = Inputs.of(graph, model, state=state)
    return graph, inputs, describe(model, graph, inputs)


def sketch(model: Model) -> tuple[Graph, Inputs, Mechanics]:
    """The mechanics of a model in one graph that everything shares whose numbers are needed a few times only.

    Programs that are compiled have graphs of their own, in which their operations are chosen.
    """
    return model.remembered("sketch", lambda: _start(model))


def _program(
    model: Model, name: str, graph: Graph, outputs: Mapping[str, Output], *, groups: Sequence[str] = ("q", "v")
) -> Program:
    q, v = tuple(c.name for c in model.coordinates), tuple(v.name for v in model.velocities)
    names = {
        "q": q,
        "v": v,
        "a": tuple(v.rate for v in model.velocities),
        "x": (*q, *v),
        "u": tuple(u.name for u in model.inputs),
        "p": tuple(p.name for p in model.parameters),
        "t": ("t",),
    }
    defaults = {p.name: p.value for p in model.parameters}
    inputs = {group: names[group] for group in (*groups, "u", "p", "t")}
    return Program(name, graph, inputs, outputs, defaults)


def _vector(ids: Sequence[int]) -> Output:
    return Output(tuple(ids), (len(ids),))


def _matrix(rows: Sequence[Sequence[int]]) -> Output:
    return Output(tuple(x for row in rows for x in row), (len(rows), len(rows[0]) if rows else 0))


def _once(make: Callable[[Model], Program]) -> Callable[[Model], Program]:
    """Each program is made once for a model: everything that asks for it gets the same."""

    @wraps(make)
    def found(model: Model) -> Program:
        return model.remembered(("program", make.__name__), lambda: make(model))

    return found


@_once
def forward(model: Model) -> Program:
    """q, v, u, p, t → a [rad/s² or m/s²], shape (n,).

    Raises `ModelError` that names a coordinate where the mass matrix is singular by structure.
    """
    graph, _, m = _start(model)
    return _program(model, "forward", graph, {"a": _vector(m.forward())})


@_once
def rhs(model: Model) -> Program:
    """x, u, p, t → ẋ = [q̇; v̇] of x = [q; v], shape (n_q + n_v,)."""
    graph, _, m = _start(model, state=True)
    return _program(model, "rhs", graph, {"xdot": _vector([*m.motion.rates, *m.forward()])}, groups=("x",))


@_once
def rates(model: Model) -> Program:
    """q, v, u, p, t → q̇ = N(q) v, shape (n_q,): v itself, but for frames that float."""
    graph, _, m = _start(model)
    return _program(model, "rates", graph, {"qdot": _vector(m.motion.rates)})


@_once
def inverse(model: Model) -> Program:
    """q, v, a, u, p, t → the generalized forces that are missing, M a + C v + G − Ξ, shape (n,)."""
    graph, _, m = _start(model)
    a = [graph.input("a", i) for i in range(len(m.v))]
    return _program(model, "inverse", graph, {"r": _vector(m.inverse(a))}, groups=("q", "v", "a"))


@_once
def inverse_from_lagrangian(model: Model) -> Program:
    """The same as `inverse` by the independent route, from L = T − V: d/dt ∂L/∂q̇ − ∂L/∂q − Ξ."""
    graph, _, m = _start(model)
    a = [graph.input("a", i) for i in range(len(m.v))]
    return _program(
        model, "inverse_from_lagrangian", graph, {"r": _vector(m.inverse_from_lagrangian(a))}, groups=("q", "v", "a")
    )


@_once
def mass_matrix(model: Model) -> Program:
    """q, v, u, p, t → M, shape (n, n); it does not read v and u."""
    graph, _, m = _start(model)
    return _program(model, "mass_matrix", graph, {"M": _matrix(m.mass_matrix())})


@_once
def bias(model: Model) -> Program:
    """q, v, u, p, t → C v + G − Ξ, shape (n,): what `inverse` gives at a = 0."""
    graph, _, m = _start(model)
    return _program(model, "bias", graph, {"h": _vector(m.bias())})


@_once
def potential_force(model: Model) -> Program:
    """q, v, u, p, t → G = ∂V/∂q, shape (n,): weights, springs and raw potentials."""
    graph, _, m = _start(model)
    return _program(model, "potential_force", graph, {"G": _vector(m.potential_force())})


@_once
def coriolis(model: Model) -> Program:
    """q, v, u, p, t → C, shape (n, n), by Christoffel's symbols; Ṁ − 2C is skew."""
    graph, _, m = _start(model)
    return _program(model, "coriolis", graph, {"C": _matrix(christoffel.coriolis(m))})


@_once
def energy(model: Model) -> Program:
    """q, v, u, p, t → T and V [J], one number each."""
    graph, _, m = _start(model)
    outputs = {"T": Output((m.kinetic(),), ()), "V": Output((m.potential(),), ())}
    return _program(model, "energy", graph, outputs)


@_once
def loss(model: Model) -> Program:
    """q, v, u, p, t → the power that dampers take [W], one number."""
    graph, _, m = _start(model)
    return _program(model, "loss", graph, {"P": Output((m.loss(),), ())})
