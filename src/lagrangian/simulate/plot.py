"""Tables and plots of a run: its columns with units and descriptions, and its figure."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from fractions import Fraction
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.errors import ModelError
from lagrangian.model import Frame, Model
from lagrangian.model.names import multiplier_symbol
from lagrangian.model.rows import Row, rows_of
from lagrangian.page.plain import plain
from lagrangian.simulate.integrating import remembered
from lagrangian.simulate.joint_forces import joint_force
from lagrangian.simulate.quantities import multiplier_words, quantity, row_of
from lagrangian.simulate.recorded import Recorded
from lagrangian.values.dimensions import ENERGY, NONE, RATE, Dim, Dimensions, Mismatch, check_dimensions
from lagrangian.view import Marks, Panel, Plotted, Series, draw, joined
from lagrangian.write.labels import Labels
from lagrangian.write.tables import Column, ColumnTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure


Array = NDArray[np.float64]

TURNS = 4 * np.pi
"""Angles [rad] that exceed this are plotted in turns, others in degrees."""

ROUNDING = 1e-9
"""A force or torque of a joint below this part of the largest one counts as 0."""

PICTURES = frozenset((".png", ".pdf", ".svg", ".jpg", ".jpeg", ".eps"))
"""Endings of the names of image files."""

KINDS = {
    "rad": "angle",
    "m": "position",
    "rad/s": "angular velocity",
    "m/s": "velocity",
    "rad/s^2": "angular acceleration",
    "m/s^2": "acceleration",
    "N": "force",
    "N m": "torque",
    "J": "energy",
    "W": "power",
    "C": "charge",
    "A": "current",
    "V": "voltage",
    "Wb": "flux linkage",
}
"""The common meaning of quantities with a unit."""


class Units:
    """The SI units of a model's quantities, as far as its declarations and its geometry determine them."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self._dims: Dimensions | None = check_dimensions(model)
        self._angles: set[Any] = remembered(model, "angles", lambda: _angles(model))

    def of(self, expr: sp.Expr) -> str:
        """The unit of an expression, or an empty text if it is not known."""
        if isinstance(expr, sp.Add):
            found = {self.of(term) for term in expr.args}
            return found.pop() if len(found) == 1 else self._worked_out(expr)
        number, bare = expr.as_coeff_Mul()
        if number != 1 and not bare.is_number:
            return self.of(bare)
        if isinstance(expr, sp.Derivative) and expr.expr in self._angles:
            return "rad/s" if expr.derivative_count == 1 else f"rad/s^{expr.derivative_count}"
        if expr in self._angles:
            return "rad"
        if (row := row_of(self.model, expr)) is not None:
            return self._of_multiplier(row)
        for x in (*self.model.coordinates, *self.model.velocities, *self.model.inputs):
            if x.symbol == expr and x.unit:
                return x.unit.replace("*", " ")
        return self._worked_out(expr)

    def _of_multiplier(self, row: Row) -> str:
        """Power per unit of c; of a row on positions, energy per unit of f."""
        if row.unit is not None:
            found = Dim.of_unit(row.unit)
        else:
            try:
                own = None if self._dims is None else self._dims.of(row.rate if row.position is None else row.position)
            except Mismatch:
                own = None
            if own is None or own.unknown:
                return ""
            found = (ENERGY if row.position is not None else ENERGY.times(RATE)).times(own, Fraction(-1))
        return str(found)

    def _worked_out(self, expr: sp.Expr) -> str:
        if self._dims is None:
            return ""
        try:
            found = self._dims.of(expr)
        except Mismatch:
            return ""
        if found is None or found.unknown or found == NONE:
            return ""
        return str(found)


def _angles(model: Model) -> set[Any]:
    """Coordinates that are angles: those in the angle of a frame or inside a sine or cosine."""
    # a position is a sum of offsets, turned by the frames in which they are given
    ends = [*model.points, *(body.at for body in model.bodies)]
    points = {id(point): point for end in ends for point in end.with_parents()}.values()
    exprs = {x: None for point in points for x in point.offset}
    frames = [f for e in model.elements for _, f in e.frames()] + list(model.frames)
    frames += [point.frame for point in points if point.frame is not None]
    turned: list[Any] = []
    seen: set[int] = set()
    while frames:
        frame: Frame | None = frames.pop()
        if frame is None or id(frame) in seen:
            continue
        seen.add(id(frame))
        frames.append(frame.parent)  # type: ignore[arg-type]
        if frame.floating is None:
            turned.append(frame.angle)
    turned += [f.args[0] for e in exprs for f in model.expand(e).atoms(sp.sin, sp.cos, sp.tan)]
    angles = {c.symbol for c in model.coordinates if c.unit in (None, "rad")}
    written = {model.expand(a) for a in dict.fromkeys(turned)}
    return {q for q in angles if any(_alone(a, q) for a in written)}


def _alone(angle: sp.Expr, q: Any) -> bool:
    """Whether q occurs in an angle as a term of a sum, at most with a numerical factor."""
    return angle.has(q) and bool(sp.diff(angle, q).is_number)


# -- columns ----------------------------------------------------------------------------------------------------


def table(run: Recorded) -> ColumnTable:
    """The states, the inputs, the energies, the multipliers of constraints and the named points over time."""
    model, units = run.model, Units(run.model)
    columns: list[Column] = []
    words = {c.name: c.description for c in model.coordinates}
    charges = {c.name for c in model.charges}
    for name, values, symbol in zip(run.states, run.y, _state_symbols(model), strict=True):
        base = name.removesuffix("'")
        said = words.get(base) or base
        rate = f"current, the rate of {said}" if base in charges else f"rate of {said}"
        columns.append(Column(name, values, units.of(symbol), said if name == base else rate))
    signals = run.observe({u.name: u.symbol for u in model.inputs}) if model.inputs else {}
    for u in model.inputs:
        columns.append(Column(u.name, signals[u.name], units.of(u.symbol), u.description or u.name))
    for key, values, said in (
        ("kinetic", run.kinetic, "kinetic co-energy T*"),
        ("potential", run.potential, "potential energy V"),
        ("supplied", run.supplied, "energy supplied since the start"),
    ):
        columns.append(Column(f"energy.{key}", values, "J", said))
    for row in rows_of(model):
        unit = units.of(multiplier_symbol(row.name))
        columns.append(Column(f"multiplier.{row.name}", run.multipliers[row.name], unit, multiplier_words(model, row)))
    columns += _of_reactions(run)
    for name, path in run.points.items():
        for axis, values in zip("xyz", path.T, strict=False):
            columns.append(Column(f"{name}.{axis}", values, "m", f"{axis} of point {name}"))
    return ColumnTable(Column("t", run.t, "s", "time"), tuple(columns), attributes(run))


def _of_reactions(run: Recorded) -> Iterator[Column]:
    """The forces and torques of the joints that are named in ``run.reactions``."""
    for name in run.reactions:
        found = run.reaction(name)
        said = f"joint {name} on {found.on}"
        for axis, values in zip("xyz", found.force.T, strict=False):
            yield Column(f"reaction.{name}.{axis}", values, "N", f"force of {said}, {axis}")
        torque = found.torque.T if found.torque.ndim == 2 else [found.torque]
        for axis, values in zip("xyz" if found.torque.ndim == 2 else "z", torque, strict=False):
            yield Column(f"reaction.{name}.torque_{axis}", values, "N m", f"torque of {said} about {found.at}, {axis}")


def extremes(values: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """The initial, final, smallest and largest value of a quantity."""
    return float(values[0]), float(values[-1]), float(values.min()), float(values.max())


def attributes(run: Recorded) -> dict[str, Any]:
    """Attributes of a run: how it was made, how it ended, how well its energy is balanced."""
    return {
        "title": run.model.name,
        "source": f"lagrangian {version('lagrangian')}",
        "method": run.method,
        **run.settings,
        "steps": run.steps,
        "nfev": run.nfev,
        "success": int(run.success),
        "message": run.message,
        "audit": float(run.audit),
        "parameters": run.params,
        "feedback": {plain(symbol): plain(expr) for symbol, expr in run.feedback.items()},
    }


def _state_symbols(model: Model) -> list[Any]:
    return [*(c.symbol for c in model.coordinates), *(v.symbol for v in model.velocities)]


# -- pictures ---------------------------------------------------------------------------------------------------


def plot(run: Recorded, asked: Sequence[Any], *, energy: bool | None, audit: bool, shown: bool = False) -> Figure:
    """The figure of the requested quantities; by default, of coordinates, inputs that are not 0, the joints in
    ``run.reactions``, and energies."""
    units, labels = Units(run.model), Labels(run.model)
    panels = [_joint_panel(run, x) or _panel(run, units, labels, _expression(run.model, x)) for x in asked]
    if not asked:
        panels = [_panel(run, units, labels, c.symbol) for c in run.model.coordinates]
        driven = [_panel(run, units, labels, u.symbol) for u in run.model.inputs]
        panels += [p for p in driven if any(s.values.any() for s in p.series)]
        panels += _reaction_panels(run)
    panels = list(joined(panels))
    if energy if energy is not None else not asked:
        panels.append(_energies(run))
    if audit:
        panels.append(Panel("imbalance", "J", (Series(r"\Delta E", "ΔE", run.imbalance),)))
    marks = tuple(Marks(name, found.t) for name, found in run.events.items() if len(found))
    footer, failure = f"{run.method}, {run.audit}", "" if run.success else run.message
    return draw(Plotted(run.model.name, run.t, tuple(panels), marks, footer, failure), shown=shown)


def check_no_file(asked: Any, verb: str) -> None:
    """Raise an error for the name of an image file where a quantity is expected."""
    if isinstance(asked, (str, os.PathLike)) and Path(asked).suffix.lower() in PICTURES:
        raise ModelError(
            f"plot takes names and expressions, and '{str(asked)[:60]}' names a file",
            fix=f'{verb}().savefig("{str(asked)[:60]}")',
            code="E406",
        )


def _expression(model: Model, asked: Any) -> sp.Expr:
    check_no_file(asked, "run.plot")
    if isinstance(asked, str):
        return quantity(model, asked, "what is plotted")
    if not isinstance(asked, sp.Expr):
        raise ModelError(
            f"a plot shows expressions and names (got {type(asked).__name__})",
            fix='run.plot("theta", "theta\'"), or SymPy expressions',
            code="E406",
        )
    return asked


def _panel(run: Recorded, units: Units, labels: Labels, expr: sp.Expr) -> Panel:
    values, unit = run[expr], units.of(expr)
    what = KINDS.get(unit, "")
    if unit == "rad":
        turns = bool(len(values)) and float(np.max(np.abs(values))) > TURNS
        values, unit = (values / (2 * np.pi), "turns") if turns else (np.degrees(values), "deg")
    if (row := row_of(run.model, expr)) is not None:
        return Panel(
            what or "multiplier", unit, (Series(rf"\lambda\;\mathrm{{{_escaped(row.name)}}}", row.name, values),)
        )
    return Panel(what, unit, (Series(labels.tex(expr), labels.text(expr), values),))


def _joint_panel(run: Recorded, asked: Any) -> Panel | None:
    """The panel of a joint's reaction, "reaction B" or "reaction B.x"; None for anything else."""
    if not isinstance(asked, str) or (joint := joint_force(run.model, asked)) is None:
        return None
    unit = joint.unit.replace("*", " ")
    return Panel(KINDS[unit], unit, (Series(rf"\mathrm{{{_escaped(asked)}}}", asked, run[asked]),))


def _reaction_panels(run: Recorded) -> list[Panel]:
    """The forces and torques of the joints in ``run.reactions`` that are more than rounding."""
    columns = list(_of_reactions(run))
    sizes = [float(np.abs(c.values).max(initial=0.0)) for c in columns]
    shown = [c for c, size in zip(columns, sizes, strict=True) if size > ROUNDING * max(sizes)]
    names = [c.name.replace(".", " ", 1) for c in shown]  # "reaction B.x", as in run["reaction B.x"]
    series = [Series(rf"\mathrm{{{_escaped(n)}}}", n, c.values) for n, c in zip(names, shown, strict=True)]
    return [Panel(KINDS[c.unit], c.unit, (one,)) for c, one in zip(shown, series, strict=True)]


def _escaped(name: str) -> str:
    """A name inside a formula of a picture."""
    return "".join({" ": r"\ ", "_": r"\_"}.get(c, c) if c.isalnum() or c in " _.-" else "?" for c in name)


def _energies(run: Recorded) -> Panel:
    T = Series("T^{*}", "T*", run.kinetic)
    V = Series("V", "V", run.potential)
    star = ("T", "T") if run.model.saturating else ("T^{*}", "T*")
    return Panel("energy", "J", (T, V, Series(f"{star[0]} + V", f"{star[1]} + V", run.energy, "k--")))
