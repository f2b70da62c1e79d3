"""Checks of a derivation that share nothing with how it was found.

The derived equations came from energies, by Lagrange's equations, in a normal form. Here they meet, at random states,

* virtual work, `dynamics.inverse`: Σ_b (m a − F)·∂v/∂ξ̇_i + (I ω̇ + ω × I ω)·∂ω/∂ξ̇_i, differentiated on the graph
  straight from positions and angles, with no energy of motion and no normal form in it;
* Lagrange's equations again, `dynamics.inverse_from_lagrangian`, with L differentiated on the graph;
* what the machine is given of them, `dynamics.forward`, `mass_matrix` and `energy`: q̈ that solves the derived
  equations, the Hessian of the derived T*, the derived energies;
* what any such equations obey: M symmetric and positive definite, Ṁ − 2C skew-symmetric, power balance;
* dimensions, where units were given.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias, cast

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from lagrangian import bounded, dynamics
from lagrangian.derive import Derived
from lagrangian.derive.sample import Sampler
from lagrangian.graph import Graph, Output, Program, evaluate, from_sympy, hessian, jacobian, jvp, vjp
from lagrangian.model import Model, is_hard, time
from lagrangian.page.formula import Check, Name, text
from lagrangian.records import dataclass
from lagrangian.values.dimensions import Mismatch, check_dimensions, check_terms
from lagrangian.values.values import check_sampling
from lagrangian.verify.in_regimes import InRegimes
from lagrangian.verify.row_checks import RowChecks
from lagrangian.verify.states import evaluated, state_groups

_log = logging.getLogger(__name__)
Array: TypeAlias = NDArray[np.float64]

TOLERANCE = 1e-9
"""The relative difference up to which two numbers count as equal: no more than rounding of long expressions."""


def _hard(derivation: Derived, **_: object) -> bool:
    return is_hard(derivation.model)


@bounded.answered("the comparison of the equations", _hard)
def verify(derivation: Derived, *, states: int = 50, seed: int = 1) -> tuple[Check, ...]:
    """Return the checks at ``states`` random states, each with its figure."""
    check_sampling(states, seed)
    _log.info("verifying: the equations at %d random states", states)
    figures = _figures(derivation, states, seed)
    rows = figures.rows
    if rows is not None and not (states := rows.figures.count):
        return tuple(rows.checks(TOLERANCE))
    n = f"{states} random state{'s' if states != 1 else ''}"
    work, energy = figures.work, figures.energy
    M, C, Xi = Name("M"), Name("C"), Name("Xi")
    driven = () if rows is None else (" and of constraints that move with t",)
    allowed = () if rows is None else (" on every motion that the constraints allow",)
    checks = [
        Check(
            text("the equations agree with virtual work, a route without energies"),
            work < TOLERANCE,
            f"largest relative difference {work:.1e} at {n}",
        ),
        Check(
            text("the equations agree with automatic differentiation of ", Name("L")),
            energy < TOLERANCE,
            f"largest relative difference {energy:.1e} at {n}",
        ),
        *(_accelerations(figures) if rows is None else rows.checks(TOLERANCE)),
        Check(
            text("the compiled ", M, " is that of the equations, and the Hessian of ", Name("T*"), " in the rates"),
            figures.mass < TOLERANCE,
            f"largest relative difference {figures.mass:.1e}",
        ),
        Check(
            text("the compiled energies are ", Name("T*"), " and ", Name("V")),
            figures.energies < TOLERANCE,
            f"largest relative difference {figures.energies:.1e}",
        ),
        Check(text(M, " is symmetric"), figures.asymmetry < TOLERANCE, f"largest difference {figures.asymmetry:.1e}"),
        Check(
            text(M, " is positive definite", *allowed),
            figures.smallest > 0,
            f"smallest eigenvalue {figures.smallest:.2e}",
        ),
    ]
    if not any(map(_holds_rates, derivation.mass_matrix.flat())):  # Christoffel symbols require a quadratic T*
        timed = any(map(_holds_time, derivation.mass_matrix.flat()))
        held = ("; t itself, which stands in ", M, ", is held") if timed else ()
        skew = text("d", M, "/dt − 2", C, " is skew-symmetric", *held)
        checks.append(Check(skew, figures.skew < TOLERANCE, f"{figures.skew:.1e}"))
    checks.append(
        Check(
            text("power balance: the energy grows by the power of ", Xi, *driven),
            figures.power < TOLERANCE,
            f"largest relative difference {figures.power:.1e}",
        )
    )
    if (dimensional := _dimensional(derivation)) is not None:
        checks.append(dimensional)
    return tuple(checks)


def _accelerations(figures: _Figures) -> Iterator[Check]:
    """The accelerations of a system without constraints."""
    yield Check(
        text("the compiled accelerations solve the equations"),
        figures.forward < TOLERANCE,
        f"largest relative residual {figures.forward:.1e}",
    )


def _residual(equation: sp.Eq) -> sp.Expr:
    """Left minus right."""
    return cast("sp.Expr", equation.lhs) - cast("sp.Expr", equation.rhs)


def _holds_time(expr: sp.Expr) -> bool:
    """Whether an expression contains t itself, apart from the coordinates that depend on it."""
    return expr.replace(lambda e: isinstance(e, (AppliedUndef, sp.Derivative)), lambda _: sp.Dummy()).has(time)


def _holds_rates(expr: sp.Expr) -> bool:
    """Whether an expression contains a rate: an entry of M does if T* is not quadratic in the rates."""
    return expr.has(sp.Derivative)


def _dimensional(derivation: Derived) -> Check | None:
    """Check that every term has the dimension of energy over its coordinate; None without units or with bare
    numbers."""
    dims = check_dimensions(derivation.model)
    what = text("dimensions: every term of an equation has the same unit")
    if dims is None or dims.loose:
        return None
    terms = 0
    for coordinate, row in zip(derivation.coordinates, derivation.terms, strict=True):
        try:
            terms += check_terms(dims, tuple(term.expr for term in row), coordinate)
        except Mismatch as wrong:
            return Check(what, False, f"a term has the unit {wrong.found} where {wrong.wanted} is needed")
    return Check(what, True, f"{terms} terms")


@dataclass
class _Figures:
    """The largest differences found."""

    work: float = 0.0
    energy: float = 0.0
    forward: float = 0.0
    mass: float = 0.0
    energies: float = 0.0
    asymmetry: float = 0.0
    smallest: float = float("inf")
    skew: float = 0.0
    power: float = 0.0
    rows: RowChecks | None = None


def _figures(derivation: Derived, states: int, seed: int) -> _Figures:
    model, n = derivation.model, len(derivation.coordinates)
    exprs: list[sp.Expr] = [_residual(e) for e in derivation.equations]
    exprs += [*derivation.mass_matrix.flat(), *derivation.coriolis_matrix.flat(), *derivation.gravity_vector.flat()]
    exprs += [*derivation.generalized_forces.flat(), *(c.acceleration for c in model.coordinates)]
    exprs += [*(c.rate for c in model.coordinates), *(c.symbol for c in model.coordinates)]
    exprs += [*(p.symbol for p in model.parameters), *(u.symbol for u in model.inputs)]
    exprs += [derivation.T, derivation.V]  # a constant in V is in no equation, and may have no value all the same
    exprs += [*(row.second_rate for row in derivation.multipliers.values())]
    exprs += [*(row.symbol for row in derivation.multipliers.values())]
    sampler = Sampler(model, exprs)
    program = _program(derivation, sampler)
    regimes = InRegimes(derivation)
    machine = (dynamics.mass_matrix(model), dynamics.energy(model))
    found = _Figures()
    rows = None if not derivation.multipliers else RowChecks(derivation)
    found.rows = rows
    free = ((state, state_groups(model, state)) for state, _ in sampler.states(states, seed=seed))
    for state, groups in free if rows is None else rows.states(sampler, states, seed):
        if (here := regimes.at(state, groups)) is None:
            continue
        state, routes = here
        got = {k: np.array(v, float) for k, v in evaluate(program, {"x": [state[s] for s in sampler.symbols]}).items()}
        M, C, Mdot = (got[k].reshape(n, n) for k in ("M", "C", "Mdot"))
        v, a = got["v"], got["a"]
        # rates and accelerations are about 1, so M gives the scale, however small the masses are
        size = float(np.abs(M).max())
        scale = max(size, float(max(np.abs(M * a).max(), np.abs(C * v).max(), np.abs(got["G"]).max())))
        by_work, by_energy = (
            np.array(evaluate(r, groups)["r"], float) for r in (routes.inverse, routes.from_lagrangian)
        )
        if rows is not None:
            push = rows.pushed(groups, got["lambda"])
            by_work, by_energy = by_work - push, by_energy - push
            rows.hold(got, groups, state, routes)
        found.work = _worse(found.work, float(np.abs(got["equations"] - by_work).max()) / scale)
        found.energy = _worse(found.energy, float(np.abs(got["equations"] - by_energy).max()) / scale)
        _hold_machine(found, got, machine, groups)
        if rows is None:
            _hold_forward(found, got, routes.forward, groups)
        found.asymmetry = _worse(found.asymmetry, float(np.abs(M - M.T).max()) / size)
        least = np.linalg.eigvalsh((M + M.T) / 2).min() if rows is None else rows.smallest(got)
        found.smallest = float(np.minimum(found.smallest, least))
        skew = Mdot - 2 * C
        found.skew = _worse(found.skew, float(np.abs(skew + skew.T).max()) / max(size, float(np.abs(C).max())))
        # along a motion: ξ̈ from the derived matrices, then d/dt(ξ̇·∂L/∂ξ̇ − L) = Ξ·ξ̇ − ∂L/∂t
        if rows is None:
            a, power = np.linalg.solve(M, got["Xi"] - C @ v - got["G"]), got["Xi"] @ v
        else:
            a, lam = rows.solved(got)
            power = got["Xi"] @ v + lam @ (got["A"].reshape(-1, n) @ v)
        balance = got["hdot0"][0] + got["p_a"] @ a - power + got["L_t"][0]
        size = max(size, float(np.abs(got["G"]).max() + np.abs(got["Xi"]).max()))
        found.power = _worse(found.power, abs(float(balance)) / size)
    return found


def _hold_machine(
    found: _Figures, got: Mapping[str, Array], machine: Sequence[Program], groups: Mapping[str, list[float]]
) -> None:
    """Compare the programs for M and the energies at a state with the derivation."""
    n = len(got["v"])
    mass, energy = (evaluated(program, groups) for program in machine)
    M = got["M"].reshape(n, n)
    compiled = np.array(mass["M"], float)
    for other in (M, got["H"].reshape(n, n)):
        found.mass = _worse(found.mass, float(np.abs(compiled - other).max() / np.abs(other).max()))
    energies, derived = np.array([energy["T"], energy["V"]], float), np.array([got["T"][0], got["V"][0]])
    off = float(np.abs(energies - derived).max())
    largest = float(np.abs(derived).max())  # 0 if nothing can move and nothing is stored
    found.energies = _worse(found.energies, off / largest if largest else off)


def _hold_forward(
    found: _Figures, got: Mapping[str, Array], forward: Program, groups: Mapping[str, list[float]]
) -> None:
    """The compiled accelerations of a system without constraints solve the derived equations."""
    n, a = len(got["v"]), np.array(evaluated(forward, groups)["a"], float)
    M, bias = got["M"].reshape(n, n), got["C"].reshape(n, n) @ got["v"] + got["G"]
    terms = np.concatenate([M.ravel(), (M * a).ravel(), bias, got["Xi"]])
    residual = M @ a + bias - got["Xi"]
    found.forward = _worse(found.forward, float(np.abs(residual).max() / np.abs(terms).max()))


def _worse(a: float, b: float) -> float:
    """Return the larger number; NaN is the worst and stays, whereas Python's ``max`` could drop it."""
    return float(np.maximum(a, b))


def _sum(g: Graph, nodes: Sequence[int]) -> int:
    total = g.const(0.0)
    for x in nodes:
        total = g.add(total, x)
    return total


class _Nodes:
    """Expressions as graph nodes, and their rates along a motion with ξ̇, ξ̈ and dt/dt = 1."""

    def __init__(self, g: Graph, model: Model, table: dict[sp.Basic, int]) -> None:
        self.g, self._model, self._table = g, model, table
        self.q = [table[c.symbol] for c in model.coordinates]
        self.v = [table[c.rate] for c in model.coordinates]
        self.a = [table[c.acceleration] for c in model.coordinates]
        self.t = table[time]

    def of(self, expr: sp.Expr) -> int:
        """The node of an expression."""
        return from_sympy(self.g, self._model.expand(sp.sympify(expr), constants=True), self._table)

    def rates(self, nodes: Sequence[int], *, with_acceleration: bool = True, running: bool = True) -> list[int]:
        """d/dt of nodes along the motion; unless ``running``, t itself is constant."""
        moving = dict(zip(self.q, self.v, strict=True))
        if running:
            moving[self.t] = self.g.const(1.0)
        if with_acceleration:
            moving |= dict(zip(self.v, self.a, strict=True))
        return jvp(self.g, list(nodes), moving)


def _program(derivation: Derived, sampler: Sampler) -> Program:
    model, g = derivation.model, Graph()
    symbols = sampler.symbols
    table: dict[sp.Basic, int] = {s: g.input("x", i) for i, s in enumerate(symbols)}
    node = _Nodes(g, model, table)
    M = [node.of(x) for x in derivation.mass_matrix.flat()]
    v = node.v
    # h = ξ̇·∂L/∂ξ̇ − L; its rate at ξ̈ = 0, and the contribution of ξ̈
    lagrangian = node.of(derivation.L)
    T, n = node.of(derivation.T), len(v)
    second = hessian(g, T, v)
    momenta = vjp(g, [lagrangian], [g.const(1.0)], v)
    h = g.sub(_sum(g, [g.mul(p, x) for p, x in zip(momenta, v, strict=True)]), lagrangian)
    rows = [node.of(row.rate) for row in derivation.multipliers.values()]
    outputs = {
        "equations": [node.of(_residual(e)) for e in derivation.equations],
        "M": M,
        "H": [second.get((i, k), g.zero) for i in range(n) for k in range(n)],
        "T": [T],
        "V": [node.of(derivation.V)],
        "Mdot": node.rates(M, running=False),
        "C": [node.of(x) for x in derivation.coriolis_matrix.flat()],
        "G": [node.of(x) for x in derivation.gravity_vector.flat()],
        "Xi": [node.of(x) for x in derivation.generalized_forces.flat()],
        "v": v,
        "a": node.a,
        "hdot0": node.rates([h], with_acceleration=False),
        "p_a": vjp(g, [h], [g.const(1.0)], v),
        "A": [x for row in rows for x in vjp(g, [row], [g.const(1.0)], v)],
        "gamma": node.rates(rows, with_acceleration=False),
        "lambda": [node.of(row.symbol) for row in derivation.multipliers.values()],
        "L_t": [_partial(g, lagrangian, node.t)],
    }
    shaped = {k: Output(tuple(ids), (len(ids),)) for k, ids in outputs.items()}
    return Program("verify", g, {"x": tuple(str(s) for s in symbols)}, shaped, {})


def _partial(g: Graph, output: int, by: int) -> int:
    found = jacobian(g, [output], [by])
    return found.get((0, 0), g.const(0.0))
