"""A linearization as a report: the point, the matrices, poles and modes, stability."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian.linear.linear_model import LinearModel
from lagrangian.linear.reach import Missing, Reach
from lagrangian.linear.symbolic import SymbolicLinearization
from lagrangian.model import Model
from lagrangian.page.figures import complex_figure, figure, matrix, or_none, plain_numbers, scientific
from lagrangian.page.formula import Item, Matrix, Name, Table, Text, formula, text
from lagrangian.page.report import Part, Report

ROUNDING = 1e-12
"""A remaining acceleration below this fraction of the largest entry of A is due to rounding."""

MAX_SHOWN_COLUMNS = 16
"""A matrix with at most this many columns is written out."""


POLES_AND_MODES = "Poles and modes"
"""The title of that section."""


def symbol(model: Model, name: str) -> Any:
    """The symbol for the name of a state or an output: the coordinate, its rate, or the name itself."""
    for c in model.coordinates:
        if name == c.name:
            return c.symbol
        if name == f"{c.name}'":
            return c.rate
    found = model.symbols.get(name)
    return name if found is None else found


def linear_report(linear: LinearModel, symbols: SymbolicLinearization | None = None) -> Report:
    """Return the report of a linearization, with its matrices in symbols if they are given."""
    parts = [_point(linear), _matrices(linear)]
    if linear.mass is not None and len(linear.mass) <= MAX_SHOWN_COLUMNS:
        parts.append(_second_order(linear))
    parts.append(_modes(linear))
    parts.append(_reach(linear))
    if symbols is not None:
        parts.append(_symbols(linear, symbols))
    return Report(f"{linear.model.name}: linearization", linear.model, tuple(parts), linear_data(linear))


def _point(linear: LinearModel) -> Part:
    model = linear.model
    rows = [(text(symbol(model, name)), text(figure(value))) for name, value in linear.at.items()]
    rows += [(text(symbol(model, name)), text(figure(value))) for name, value in linear.inputs_at.items()]
    kind = {
        "rest": "An equilibrium: the largest acceleration there is ",
        "steady motion": "A steady motion: the largest acceleration is ",
        "operating point": "Not an equilibrium: the largest acceleration there is ",
    }[linear.kind]
    items: list[Item] = [Table((text("state, input"), text("value")), tuple(rows))]
    small = linear.kind != "operating point" and linear.residual <= ROUNDING * float(np.abs(linear.A).max(initial=1.0))
    items.append(text(f"{kind}{'0 up to rounding' if small else scientific(linear.residual, 2)}."))
    items += [text(note[0].upper() + note[1:] + ".") for note in linear.notes]
    if linear.multipliers:
        items.append(text("The constraints push with these multipliers:"))
        pushes = tuple((text(name), text(figure(value))) for name, value in linear.multipliers.items())
        items.append(Table((text("row"), text("λ")), pushes))
    return Part(text("The point"), tuple(items))


A, B, C, D, K, M, S, f = (Name(x) for x in ("A", "B", "C", "D matrix", "K", "M", "S", "f vector"))
DAMPING = Name("damping matrix")
x, u, y, q = (Name(f"{letter} vector") for letter in "xuyq")


def _ordered(linear: LinearModel, vector: Name, names: Sequence[str]) -> Text:
    """``x = (θ₁, θ₂, θ̇₁, θ̇₂)``, with a bold letter for the vector, because a coordinate may also be called x."""
    parts: list[Any] = []
    for name in names:
        parts += [", " if parts else "", _entry(linear, name)]
    return text(vector, " = (", *parts, ")")


def _entry(linear: LinearModel, name: str) -> Any:
    found = symbol(linear.model, name)
    return found if isinstance(found, sp.Basic) else Name(found)


def _listed(linear: LinearModel, names: Sequence[str]) -> list[Any]:
    """``ẋ, θ₂ and θ̇₂``."""
    parts: list[Any] = []
    for k, name in enumerate(names):
        parts += [" and " if k == len(names) - 1 else ", "] if k else []
        parts.append(_entry(linear, name))
    return parts


def _matrices(linear: LinearModel) -> Part:
    items: list[Item] = []
    drift = linear.kind == "operating point"
    rate = ("δ", Name(x.base, "", 1), " = ", A, " δ", x, " + ", B, " δ", u, *((" + ", f) if drift else ()))
    items.append(text(*rate, " and δ", y, " = ", C, " δ", x, " + ", D, " δ", u, ", with"))
    items.append(_ordered(linear, x, linear.states))
    if linear.back is not None:
        said = "The quaternions change by small turns about the frames' own axes, in rad: "
        items.append(text(said, *_listed(linear, [name for name in linear.states if name not in linear.at]), "."))
    elif linear.basis is not None:
        rest = [name for name in linear.at if name not in linear.states]
        said = f"The constraints leave {len(linear.states)} of {len(linear.at)} states independent"
        items.append(text(said, ": these. ", *_listed(linear, rest), " follow from them."))
    if linear.inputs:
        items.append(_ordered(linear, u, linear.inputs))
    items.append(_ordered(linear, y, linear.outputs))
    shown = [(A, linear.A), (B, linear.B), (C, linear.C), (D, linear.D)]
    if drift:
        shown.append((f, linear.drift.reshape(-1, 1)))
    for name, found in shown:
        if found.shape[1] and found.shape[1] <= MAX_SHOWN_COLUMNS:
            items.append(formula(name, matrix(found)))
    if len(linear.states) > MAX_SHOWN_COLUMNS:
        items.append(text(f"Matrices of more than {MAX_SHOWN_COLUMNS} columns are in the data, not here."))
    return Part(text("The linear system"), tuple(items))


def _second_order(linear: LinearModel) -> Part:
    matrices = ((M, linear.mass), (DAMPING, linear.damping), (K, linear.stiffness), (S, linear.input_matrix))
    own = linear.states[: 0 if linear.mass is None else len(linear.mass)]
    rates = (
        M,
        " δ",
        Name(q.base, "", 2),
        " + ",
        DAMPING,
        " δ",
        Name(q.base, "", 1),
        " + ",
        K,
        " δ",
        q,
        " = ",
        S,
        " δ",
        u,
    )
    items: list[Item] = [text(*rates, ", with"), _ordered(linear, q, own)]
    items += [formula(name, matrix(found)) for name, found in matrices if found is not None and found.size]
    return Part(text("Small motions"), tuple(items))


def _modes(linear: LinearModel) -> Part:
    header = (text("pole [1/s]"), text("frequency [rad/s]"), text("damping ratio"), text("period [s]"), text("shape"))
    rows = []
    for mode in linear.modes:
        pole = complex_figure(mode.pole)
        if mode.pair:
            pole = pole.replace(" + ", " ± ") if mode.pole.real else f"±{pole}"
        parts: list[Any] = []
        for name, x in mode.shape.items():
            parts += [", " if parts else "", _entry(linear, name), f" {complex_figure(_rounded(x))}"]
        rows.append(
            (
                text(pole),
                text(figure(mode.frequency)),
                text(figure(mode.damping)),
                text(figure(mode.period)),
                text(*parts),
            )
        )
    verdict = linear.stability
    items: tuple[Item, ...] = (
        Table(header, tuple(rows)),
        text(f"Verdict: {verdict.verdict}. {verdict.reason[0].upper()}{verdict.reason[1:]}."),
    )
    return Part(text(POLES_AND_MODES), items)


def _reach(linear: LinearModel) -> Part:
    """Controllability by inputs and observability from outputs."""
    items: list[Item] = []
    if linear.inputs:
        items.append(text(_sentence("Controllability", linear.controllability, "not controllable", "stabilizable")))
    else:
        items.append(text("The system has no input."))
    items.append(text(_sentence("Observability", linear.observability, "not observable", "detectable")))
    return Part(text("Control"), tuple(items))


def _sentence(what: str, reach: Reach, lacking: str, enough: str) -> str:
    words = f"{what}: rank {reach.rank} of {reach.order}"
    for _, alike in groupby(reach.missing, key=lambda m: (m.pole, m.times)):
        lost = list(alike)
        often = f" ({lost[0].times} times)" if lost[0].times > 1 else ""
        shares = " and of ".join(_combination(m) for m in lost)
        words += f"; {lacking}: the pole {complex_figure(lost[0].pole)}{often} of {shares}"
    return words + ("." if reach.complete else f"; {enough if reach.enough else 'not ' + enough}.")


def _combination(missing: Missing) -> str:
    """``0.5·x1' − x2'``."""
    words = ""
    for name, x in missing.combination.items():
        share = complex_figure(_rounded(x))
        sign, size = ("−", share[1:]) if share[0] == "−" and not (x.imag and x.real) else ("+", share)
        term = name if size == "1" else f"({size})·{name}" if x.imag and x.real else f"{size}·{name}"
        words += f" {sign} {term}" if words else f"{sign if sign == '−' else ''}{term}"
    return words


def _symbols(linear: LinearModel, found: SymbolicLinearization) -> Part:
    items: list[Item] = [text("About ", *_exact_point(found), ":")]
    named = [(M, found.M), (DAMPING, found.D), (K, found.K), (S, found.S), (A, found.A), (B, found.B)]
    for name, m in named:
        if m.cols:
            rows = tuple(tuple(cast("sp.Expr", m[i, j]) for j in range(m.cols)) for i in range(m.rows))
            items.append(formula(name, Matrix(rows)))
    if found.conditions:
        items.append(text("where at the rest"))
        items += [formula(cast("sp.Expr", eq.lhs), sp.S.Zero) for eq in found.conditions]
    return Part(text("In symbols"), tuple(items))


def _exact_point(found: SymbolicLinearization) -> list[Any]:
    parts: list[Any] = []
    for symbol_, value in found.point.items():
        parts += [", " if parts else "", symbol_, " = ", value]
    return parts


def _reach_data(reach: Reach) -> dict[str, Any]:
    return {
        "order": reach.order,
        "rank": reach.rank,
        "complete": reach.complete,
        "missing": [
            {
                "pole": plain_numbers([m.pole])[0],
                "times": m.times,
                "combination": dict(zip(m.combination, plain_numbers(m.combination.values()), strict=True)),
            }
            for m in reach.missing
        ],
    }


def _rounded(z: complex) -> complex:
    return complex(float(f"{z.real:.4g}"), float(f"{z.imag:.4g}"))


def linear_data(linear: LinearModel) -> dict[str, Any]:
    """A linearization as plain data."""
    return {
        "system": linear.model.name,
        "kind": linear.kind,
        "at": dict(linear.at),
        "inputs_at": dict(linear.inputs_at),
        "outputs_at": dict(linear.outputs_at),
        "parameters": dict(linear.parameters),
        "time": linear.time,
        "residual": linear.residual,
        "states": list(linear.states),
        "inputs": list(linear.inputs),
        "outputs": list(linear.outputs),
        "A": linear.A.tolist(),
        "B": linear.B.tolist(),
        "C": linear.C.tolist(),
        "D": linear.D.tolist(),
        "drift": linear.drift.tolist(),
        "mass": None if linear.mass is None else linear.mass.tolist(),
        "damping": None if linear.damping is None else linear.damping.tolist(),
        "stiffness": None if linear.stiffness is None else linear.stiffness.tolist(),
        "input_matrix": None if linear.input_matrix is None else linear.input_matrix.tolist(),
        "poles": plain_numbers(linear.poles),
        "modes": [
            {
                "pole": plain_numbers([mode.pole])[0],
                "frequency": mode.frequency,
                "damping_ratio": or_none(mode.damping),
                "period": or_none(mode.period),
                "pair": mode.pair,
                "shape": dict(zip(mode.shape, plain_numbers(mode.shape.values()), strict=True)),
            }
            for mode in linear.modes
        ],
        "stability": {
            "verdict": linear.stability.verdict,
            "stable": linear.stable,
            "reason": linear.stability.reason,
        },
        "controllability": _reach_data(linear.controllability) if linear.inputs else None,
        "observability": _reach_data(linear.observability),
        "notes": list(linear.notes),
        **({} if linear.basis is None else _rows_data(linear, linear.basis)),
    }


def _rows_data(linear: LinearModel, basis: Any) -> dict[str, Any]:
    """What a system with constraints has besides."""
    return {"basis": basis.tolist(), "all_states": list(linear.at), "multipliers": dict(linear.multipliers)}
