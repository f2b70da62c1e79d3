"""The notices of a system: impossible inertias, judged by the mass matrix, and missing gravity.

T* = ½ Σ m v² + ½ Σ ωᵀ I ω is positive if every I is positive semidefinite, whether a real body can have it or not. If
some I is not, M is examined at random states: if it stays positive definite, the equations can be solved and run;
otherwise the numbers are refused, and the error names those responsible.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import replace

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.codes import Code
from lagrangian.dynamics.dependent import Repeated, dependent_among, independent_somewhere, quoted
from lagrangian.dynamics.friction import slips
from lagrangian.dynamics.programs import mass_matrix, sketch
from lagrangian.errors import ModelError, Notice, Place
from lagrangian.graph import Program, evaluate
from lagrangian.model import Body, Gravity, Kinetic, Model, Parameter, VelocityConstraint
from lagrangian.model.body_checks import ConstantValues, Doubt, doubt
from lagrangian.model.rows import named_conditions, rows_of
from lagrangian.records import dataclass

STATES = 20
"""The number of random states at which M is examined, for each random choice of the parameters."""

DRAWINGS = 5
"""The number of random choices of the parameters without a value."""

NEGATIVE = 1e-9
"""The smallest eigenvalue counts as negative, not as rounding, if it is below this fraction of the largest."""

UNLIKE = 1e-13
"""A mass that is less than this part of the largest gets a notice."""

SHOWN = 6
"""The largest number of coordinates and entries listed in a message."""


def notices(model: Model) -> tuple[Notice, ...]:
    """Return the notices of a system; raise `ModelError` (E106) if an inertia makes M indefinite."""
    return model.remembered("notices", lambda: _found(model))


def _found(model: Model) -> tuple[Notice, ...]:
    numbers = ConstantValues.of_model(model)
    found = [d for d in (doubt(numbers, body) for body in model.bodies) if d is not None]
    negative = [d for d in found if d.negative]
    if negative:
        _decide(model, negative)
    return (
        *model.remarks,
        *(Notice(d.code, _where(d.body.title, d.body.place), _said(d)) for d in found),
        *_unlike(model, numbers),
        *_weightless(model),
        *_dependent(model),
        *_put_in(model),
    )


def _unlike(model: Model, numbers: ConstantValues) -> Iterator[Notice]:
    """Whether a mass is so small beside another that the digits of numbers do not hold both."""
    known = [(mass, body) for body in model.bodies if (mass := numbers.of(body.mass)) is not None and mass > 0]
    if not known:
        return
    large, largest = max(known, key=lambda pair: pair[0])
    small, smallest = min(known, key=lambda pair: pair[0])
    if small < UNLIKE * large:
        yield Notice(
            Code.E109,
            _where(smallest.title, smallest.place),
            f"its mass is {small:.3g} kg beside {large:.3g} kg of {largest.title}. Numbers have 16 digits: derivatives "
            "by this mass, slow poles and the shapes of modes may lose all of theirs, and verify says where. Leave it "
            f"out if it does not matter, or give it more than {UNLIKE * large:.1g} kg",
        )


def dependent_rows(model: Model) -> Repeated:
    """Return the names of rows that other rows imply, each with the names of these rows; raises `ModelError` (E302) if
    rows contradict each other.

    The answer does not depend on the values of parameters.
    """

    def found() -> Repeated:
        if not model.constraints:
            return {}
        graph, _, m = sketch(slips(model))
        if not m.spare and not m.drags and independent_somewhere(graph, m.rows, m.v, m.inertia(m.groupings[0])):
            return {}
        return dependent_among(graph, m.rows, m.v, m.constrained_problems, m.known)

    return model.remembered("dependent rows", found)


def _dependent(model: Model) -> Iterator[Notice]:
    repeated = dependent_rows(model)
    for row in named_conditions(model):
        if (others := repeated.get(row.name)) is not None:
            what = f"says again what {quoted(others)} {'say together' if len(others) > 1 else 'says'}, in"
            said = f"it {what if others else 'holds in'} every position: it is left out, its multiplier is 0"
            yield Notice(Code.E306, _where(f"constraint '{row.name}'", row.element.place), said)


def _put_in(model: Model) -> Iterator[Notice]:
    """The velocity constraints that may have been put into a T* that is given as an expression.

    Such a constraint contains a rate that no T* contains, and its factors change with the position: where they do not,
    it can be integrated, and may be put in.
    """
    if not any(isinstance(e, Kinetic) for e in model.elements):
        return
    rows = [row for row in rows_of(model) if row.position is None]
    energies = [e.kinetic(model) for e in model.elements if e.ledger == "T*"] if rows else []
    for row in rows:
        rate = model.expand(row.rate)
        held = [c for c in model.coordinates if rate.has(c.rate)]
        bent = any(bounded.diff(rate, c.rate).has(*[x.symbol for x in model.coordinates]) for c in held)
        missing = [f"{c.name}'" for c in held if not any(T.has(c.rate) for T in energies)]
        if bent and missing:
            listed = " and ".join(missing)
            yield Notice(
                Code.E312,
                f"constraint '{row.name}'",
                f"T* is given as an expression without {listed}. If this constraint was put into it, the equations are "
                "wrong: write T* in all rates, or describe particles and rigid bodies",
            )


def _weightless(model: Model) -> Iterator[Notice]:
    """Whether g is declared but not used, or nothing acts on bodies that rise and fall in the plane."""
    if any(isinstance(e, Gravity) for e in model.elements):
        return
    where = f"system '{model.name}'"
    used = {s for e in model.elements for use in e.uses() for s in model.expand(use.expr, constants=True).free_symbols}
    if any(p.name == "g" and p.symbol not in used for p in model.parameters):
        yield Notice(
            Code.E107, where, "the parameter g is declared, and no gravity uses it: add gravity if bodies have weight"
        )
        return
    if model.dimension != 2 or any(e.ledger not in ("T*", "λ") for e in model.elements):
        return
    if any(isinstance(e, VelocityConstraint) for e in model.elements):
        return  # a knife edge or the axle of a car: the plane is seen from above
    heights = [model.expand(model.position(body.at)[1]) for body in model.bodies]
    if any(h.has(sp.sin, sp.cos) and h.has(AppliedUndef) for h in heights):
        yield Notice(
            Code.E107, where, "bodies swing in the plane and nothing acts on them: add gravity if y is upwards"
        )


def _where(title: str, place: Place | None) -> str:
    """An element in words, with file and line if it is from a file."""
    if place is None or place.line is None:
        return title
    file = place.file or ""
    return f"{title} ({file + ', ' if file and not file.startswith('<') else ''}line {place.line})"


def _said(doubt: Doubt) -> str:
    if doubt.negative:
        return (
            f"{doubt.what}, which no body has; the mass matrix is positive definite at {STATES} random states all the "
            "same, and these numbers are used as given"
        )
    return (
        f"{doubt.what}; the mass matrix stays positive definite all the same, and these numbers are used as given "
        "(moments are about the centre of mass)"
    )


# -- by the mass matrix -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Low:
    """A state at which M has a negative eigenvalue: groups q and p, the eigenvalue, and its direction along v."""

    q: list[float]
    p: list[float]
    eigenvalue: float
    direction: tuple[float, ...]


def _decide(model: Model, doubts: Sequence[Doubt]) -> None:
    """Raise an error if M has a negative eigenvalue for every random choice of the parameters without a value."""
    program = mass_matrix(model)
    low: _Low | None = None
    for seed in range(1 if all(p.value is not None for p in model.parameters) else DRAWINGS):
        low = _lowest(model, program, seed)
        if low is None:
            return
    assert low is not None
    raise _refused(model, doubts, low)


def _lowest(model: Model, program: Program, seed: int) -> _Low | None:
    """The first random state where M has a negative eigenvalue, if any."""
    import numpy as np  # here, as deriving waits for SymPy alone

    source = random.Random(seed)
    p = [source.uniform(0.4, 1.6) if x.value is None else x.value for x in model.parameters]
    for q in configurations(model):
        M = np.array(_at(program, model, q, p))
        if not np.isfinite(M).all():
            continue
        values, vectors = np.linalg.eigh((M + M.T) / 2)
        if values[0] < -NEGATIVE * np.abs(values).max():
            return _Low(q, p, float(values[0]), tuple(vectors[:, 0].tolist()))
    return None


def configurations(model: Model) -> Iterator[list[float]]:
    """Random coordinates at which M is looked at: positive ones, as lengths are, and from all around the circle."""
    source = random.Random(1)
    for k in range(STATES):
        low, high = (0.4, 1.6) if k % 2 else (-math.pi, math.pi)
        yield [source.uniform(low, high) for _ in model.coordinates]


def _at(program: Program, model: Model, q: list[float], p: list[float]) -> list[list[float]]:
    """M, row after row."""
    n = len(model.velocities)
    groups = {"q": q, "v": [0.0] * n, "u": [0.0] * len(model.inputs), "p": p, "t": [1.0]}
    return evaluate(program, groups)["M"]


# -- which entries ----------------------------------------------------------------------------------------------


def _refused(model: Model, doubts: Sequence[Doubt], low: _Low) -> ModelError:
    """The error that names the cause of an indefinite M: the body and the entries of its inertia that lower the
    energy."""
    share, guilty, entries = min(
        ((share, d, entries) for d in doubts for share, entries in [_shares(model, d.body, low)]), key=lambda x: x[0]
    )
    where = ", ".join(f"{c.name} = {x:.3g}" for c, x in list(zip(model.coordinates, low.q, strict=True))[:SHOWN])
    along = [v.name.removesuffix("'") for v, x in zip(model.velocities, low.direction, strict=True) if abs(x) > 0.1]
    listed = ", ".join(entries[:SHOWN])
    lowers = f", lowered by {share:.3g} by {listed}" if entries else ""
    return ModelError(
        f"{guilty.what} and makes the mass matrix indefinite: at {where} its eigenvalue along "
        f"{', '.join(along[:SHOWN])} is {low.eigenvalue:.3g}{lowers}",
        element=guilty.body.title,
        place=guilty.body.place,
        fix="give moments about the centre of mass, none negative; products are the tensor's elements (−∫xy dm)",
        code="E106",
    )


def _shares(model: Model, body: Body, low: _Low) -> tuple[float, list[str]]:
    """The contribution of a body's inertia to the eigenvalue of M, and the entries that make it smaller, with
    values."""
    size, numbers = (
        len(body.tensor),
        ConstantValues(dict(zip([x.symbol for x in model.parameters], low.p, strict=True)), {}),
    )
    pairs = [(i, k) for i in range(size) for k in range(i, size)]
    symbols = {pair: sp.Symbol(f"inertia_{pair[0]}{pair[1]} of {body.name}") for pair in pairs}
    tensor = sp.ImmutableMatrix(size, size, lambda i, k: symbols[min(i, k), max(i, k)])
    probe = replace(
        model,
        elements=tuple(
            replace(e, inertia=tensor if size == 3 else tensor[0, 0]) if e is body else e for e in model.elements
        ),  # type: ignore[call-arg]
        parameters=(*model.parameters, *(Parameter(s.name, s) for s in symbols.values())),
        _memo={},
    )
    program = mass_matrix(probe)
    given = [numbers.of(model.expand(body.tensor[pair[0]][pair[1]], constants=True)) or 0.0 for pair in pairs]

    def energy(values: Sequence[float]) -> float:
        M, w = _at(program, probe, low.q, [*low.p, *values]), low.direction
        return sum(x * entry * y for x, row in zip(w, M, strict=True) for entry, y in zip(row, w, strict=True))

    none = energy([0.0] * len(pairs))
    found = []
    for at, value in enumerate(given):
        if (share := energy([value if k == at else 0.0 for k in range(len(pairs))]) - none) < 0:
            found.append((share, f"{_entry(pairs[at], size)} = {value:.6g}"))
    return energy(given) - none, [said for _, said in sorted(found)]


def _entry(pair: tuple[int, int], size: int) -> str:
    return "J" if size == 1 else "I" + "".join("xyz"[k] for k in pair)
