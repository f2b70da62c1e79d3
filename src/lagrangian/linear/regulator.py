"""A linear-quadratic regulator: the feedback law, its gains, the poles of the closed loop, and the report."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.linear.closed_loop import closed_loop
from lagrangian.linear.linear_model import LinearModel
from lagrangian.linear.report import symbol
from lagrangian.model import Model
from lagrangian.page.figures import complex_figure, figure, matrix, plain_numbers
from lagrangian.page.formula import Check, Item, Name, Table, Text, formula, text
from lagrangian.page.plain import plain
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass, field
from lagrangian.write.written import Written

Array = NDArray[np.float64]

TURNS = "The turns of a floating frame are 2 vec(e₀* ∘ e)/|e₀|² of its quaternion e, e₀ at the point."
"""How a law takes the minimal states of floating frames from their coordinates."""

LEFT_OUT = " is left out: no rate depends on it, and it costs nothing. Only its rate is regulated; it may drift itself."
"""What a law does not do about such a coordinate."""

ZERO_GAIN_TOLERANCE = 1e-11
"""Entries below this fraction of the largest in their row are shown as zero."""


@dataclass(frozen=True, eq=False)
class Regulator(Written):
    """A regulator u = u₀ − K (x − x₀): ``K`` (inputs × states), Riccati's ``S``, the poles of A − B K [1/s], slowest
    first.

    ``Q`` and ``R`` are the weights of states and inputs. Coordinates that are ``left_out``, since no rate depends on
    them and they cost nothing, have zeros in K and S, and their poles 0 are not among the poles. ``law`` is this
    feedback as input symbol → expression of coordinates and rates, for the inputs of a simulation.
    """

    linear: LinearModel = field(repr=False)
    Q: Array
    R: Array
    K: Array
    S: Array
    poles: NDArray[np.complex128]
    left_out: tuple[str, ...] = ()

    @property
    def law(self) -> dict[sp.Expr, sp.Expr]:
        """Input symbol → u₀ − K (x − x₀).

        The turns of a floating frame are taken from its quaternion e, 2 vec(e₀* ∘ e)/|e₀|², which is linear in e.
        """
        linear = self.linear
        names = linear.states if linear.back is None else tuple(linear.at)
        gains = self.K if linear.back is None else self.K @ linear.back
        state = [symbol(linear.model, name) for name in names]
        away = [x - sp.Float(linear.at[name], 17) for x, name in zip(state, names, strict=True)]
        found: dict[sp.Expr, sp.Expr] = {}
        for u, row in zip(linear.model.inputs, gains, strict=True):
            terms = [-sp.Float(float(k), 17) * d for k, d in zip(row, away, strict=True) if k]
            found[u.symbol] = sp.Add(sp.Float(linear.inputs_at[u.name], 17), *terms)
        return found

    @cached_property
    def verified(self) -> tuple[Check, ...]:
        """The checks of S, of the poles and of the law, each with its figure; see `lagrangian.linear.closed_loop`."""
        return closed_loop(self.linear, (self.Q, self.R, self.K, self.S), self.law, self.left_out)

    def report(self) -> Report[Model]:
        """Return the report."""
        return regulator_report(self)


def regulator_report(found: Regulator) -> Report[Model]:
    """Return the report of a regulator."""
    linear = found.linear
    K, S, Q, R, x, u = (Name(name) for name in ("K", "S", "Q", "R", "x vector", "u vector"))
    names = [(name, linear.at[name]) for name in (linear.states if linear.back is None else linear.at)]
    names += [*zip(linear.inputs, linear.inputs_at.values(), strict=True)]
    point = tuple((_symbol(found, name), text(figure(value))) for name, value in names)
    law: tuple[Item, ...] = (
        text(u, " = ", u, "₀ − ", K, " (", x, " − ", x, "₀), with"),
        _ordered(found, u, linear.inputs),
        _ordered(found, x, linear.states),
        formula(K, matrix(_swept(found.K, np.sqrt(np.abs(np.diag(found.S)))))),
        *([] if linear.back is None else [text(TURNS)]),
        *(text(symbol(linear.model, name), LEFT_OUT) for name in found.left_out),
        text("As inputs of a run, such as `lagrangian simulate --input`:"),
        *(text(f"{name} = {law}") for name, law in _typed(found).items()),
        text("about the point"),
        Table((text("state, input"), text("value")), point),
    )
    poles = tuple((text(complex_figure(complex(pole))),) for pole in found.poles)
    cost = text("Starting from δ", x, ", the law costs δ", x, "ᵀ ", S, " δ", x, ", with")
    weights = text("It minimizes ∫ (δ", x, "ᵀ ", Q, " δ", x, " + δ", u, "ᵀ ", R, " δ", u, ") dt, with")
    parts = (
        Part(text("The law"), law),
        Part(text("The weights"), (weights, formula(Q, matrix(found.Q)), formula(R, matrix(found.R)))),
        Part(text("The poles of the closed loop"), (Table((text("pole [1/s]"),), poles),)),
        Part(text("Riccati's matrix"), (cost, formula(S, matrix(_swept(found.S, np.sqrt(np.abs(np.diag(found.S)))))))),
        Part(text("What was checked"), (), found.verified),
    )
    return Report(f"{linear.model.name}: linear-quadratic regulator", linear.model, parts, _data(found))


def _swept(found: Array, unit: Array) -> Array:
    """Set rounding errors to zero: entries far below the others of their row, with columns in units of S."""
    sized = np.abs(found) / np.where(unit > 0, unit, 1.0)
    return np.where(sized > ZERO_GAIN_TOLERANCE * sized.max(axis=1, initial=0.0, keepdims=True), found, 0.0)


def _symbol(found: Regulator, name: str) -> Text:
    return text(symbol(found.linear.model, name))


def _ordered(found: Regulator, vector: Name, names: tuple[str, ...]) -> Text:
    """``x = (θ, θ̇)``."""
    parts: list[Any] = []
    for name in names:
        parts += [", " if parts else "", symbol(found.linear.model, name)]
    return text(vector, " = (", *parts, ")")


def _data(found: Regulator) -> dict[str, Any]:
    linear = found.linear
    return {
        "system": linear.model.name,
        "states": list(linear.states),
        "inputs": list(linear.inputs),
        "at": dict(linear.at),
        "inputs_at": dict(linear.inputs_at),
        "Q": found.Q.tolist(),
        "R": found.R.tolist(),
        "K": found.K.tolist(),
        "S": found.S.tolist(),
        "poles": plain_numbers(found.poles),
        "left_out": list(found.left_out),
        "law": _typed(found),
        "checks": [{"what": str(c.what), "holds": c.holds, "figure": c.figure} for c in found.verified],
    }


def _typed(found: Regulator) -> dict[str, str]:
    """The law as people type it: name of the input → expression, with as many digits as a double has."""
    return {plain(u): plain(expr) for u, expr in found.law.items()}
