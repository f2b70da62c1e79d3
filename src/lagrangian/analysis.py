"""What `System.linearize`, `equilibria`, `conserved` … return: the data of `analyze`, with the ways of writing it."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

from lagrangian import analyze, write
from lagrangian.analyze import LinearizationAlong, SymbolicLinearization, linearize_along
from lagrangian.analyze.kept.canonical_report import hamiltonian_report, routhian_report
from lagrangian.analyze.kept.conserved_report import conserved_report
from lagrangian.analyze.linear.modes import Mode, modes
from lagrangian.analyze.linear.regulator_report import regulator_report
from lagrangian.analyze.linear.report import POLES_AND_MODES, linear_report
from lagrangian.analyze.report import Report
from lagrangian.analyze.rests.report import equilibria_report
from lagrangian.model import Model
from lagrangian.viewed import Brief, Viewed, cut
from lagrangian.write import Notation


class Written(Brief):
    """What has a report can be written: as text, Markdown, LaTeX, HTML, and plain data."""

    def report(self) -> Report:
        """Return the report: words, formulas, tables."""
        raise TypeError(f"{type(self).__name__} has no report")

    def to_text(self, *, notation: Notation = "lecture", full: bool = False, width: int = 80) -> str:
        """Return Unicode text for a terminal of ``width`` columns; ``full`` writes out what is too long to read."""
        return write.write_report(self.report(), "text", notation=notation, full=full, width=width)

    def to_markdown(self, *, notation: Notation = "lecture", full: bool = False) -> str:
        """Return Markdown with LaTeX mathematics."""
        return write.write_report(self.report(), "markdown", notation=notation, full=full)

    def to_latex(self, *, notation: Notation = "lecture", full: bool = False) -> str:
        """Return a LaTeX article that compiles as it is."""
        return write.write_report(self.report(), "latex", notation=notation, full=full)

    def to_html(self, *, notation: Notation = "lecture", full: bool = False) -> str:
        """Return one self-contained HTML page."""
        return write.write_report(self.report(), "html", notation=notation, full=full)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        return dict(self.report().data)

    def to_json(self) -> str:
        """Return `to_dict` as JSON text."""
        return json.dumps(self.to_dict(), ensure_ascii=False, indent=1, allow_nan=False) + "\n"

    def _repr_html_(self) -> str:
        return write.report_fragment(self.report())

    def __str__(self) -> str:
        """Read as text."""
        return self.to_text()

    def __repr__(self) -> str:
        """Say what it is of; ``print`` shows it all."""
        return cut(f"<{self.report().title}>")


@dataclass(frozen=True, eq=False)
class Regulator(Written, analyze.Regulator):
    """u = u₀ − K (x − x₀), Riccati's S and the poles that are left; see `analyze.Regulator`."""

    def report(self) -> Report:
        """Return the report."""
        return regulator_report(self)


@dataclass(frozen=True, eq=False)
class Linearization(Written, analyze.Linearization):
    """δẋ = A δx + B δu, δy = C δx + D δu, with names, poles, modes and the verdict; see `analyze.Linearization`."""

    def report(self, *, symbols: bool = False) -> Report:
        """Return the report; with ``symbols`` also its matrices in symbols."""
        return linear_report(self, self.symbolic if symbols else None)

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """The modes, slowest first; a notebook shows them as a table."""
        return Viewed(modes(self.spectrum, self.states[: len(self.coordinates)]), self._modes_view)

    def _modes_view(self) -> str:
        found = self.report()
        parts = tuple(part for part in found.parts if str(part.title) == POLES_AND_MODES)
        return write.report_fragment(Report(found.title, found.model, parts))

    @cached_property
    def symbolic(self) -> SymbolicLinearization:
        """M, D, K, S, A, B as SymPy, parameters as letters; raises `RunError` where they are too long to write."""
        return analyze.symbolic(self)

    def to_control(self) -> Any:
        """Return python-control's StateSpace with the names of states, inputs and outputs."""
        return analyze.to_control(self)

    def lqr(self, Q: Any, R: Any) -> Regulator:
        """Return the linear-quadratic regulator u = u₀ − K (x − x₀), by python-control.

        ``Q`` weighs states, ``R`` inputs: a matrix, one number, or weights by name.
        """
        data = analyze.lqr(self, Q, R)
        return Regulator(**{f.name: getattr(data, f.name) for f in fields(data)})


@dataclass(frozen=True, eq=False)
class Equilibria(Written, analyze.Equilibria):
    """The rests of a system, a sequence of `analyze.Equilibrium`."""

    def report(self) -> Report:
        """Return the report."""
        return equilibria_report(self)


@dataclass(frozen=True, eq=False)
class ConservedQuantities(Written, analyze.ConservedQuantities):
    """What every motion of a system keeps, a sequence of `analyze.Conserved`."""

    def report(self) -> Report:
        """Return the report."""
        return conserved_report(self)


@dataclass(frozen=True, eq=False)
class Hamiltonian(Written, analyze.Hamiltonian):
    """H(q, p, t), momenta and canonical equations; see `analyze.Hamiltonian`."""

    def report(self) -> Report:
        """Return the report."""
        return hamiltonian_report(self)


@dataclass(frozen=True, eq=False)
class Routhian(Written, analyze.Routhian):
    """The Lagrangian of what is left without ignorable coordinates; see `analyze.Routhian`."""

    def report(self) -> Report:
        """Return the report."""
        return routhian_report(self)


def linearize(model: Model, at: Any, **options: Any) -> Linearization:
    """Return the linearization of a model about a point; see `analyze.linearize`."""
    data = analyze.linearize(model, at, **options)
    return Linearization(**{f.name: getattr(data, f.name) for f in fields(data)})


def equilibria(model: Model, **options: Any) -> Equilibria:
    """Return the rests of a model; see `analyze.equilibria`."""
    data = analyze.equilibria(model, **options)
    return Equilibria(**{f.name: getattr(data, f.name) for f in fields(data)})


def conserved(model: Model, **options: Any) -> ConservedQuantities:
    """Return the conserved quantities of a model; see `analyze.conserved`."""
    data = analyze.conserved(model, **options)
    return ConservedQuantities(**{f.name: getattr(data, f.name) for f in fields(data)})


def hamiltonian(model: Model) -> Hamiltonian:
    """Return Hamilton's form of a model; see `analyze.hamiltonian`."""
    data = analyze.hamiltonian(model)
    return Hamiltonian(**{f.name: getattr(data, f.name) for f in fields(data)})


def routhian(model: Model, ignorable: Any = None) -> Routhian:
    """Return Routh's form of a model; see `analyze.routhian`."""
    data = analyze.routhian(model, ignorable)
    return Routhian(**{f.name: getattr(data, f.name) for f in fields(data)})


__all__ = [
    "ConservedQuantities",
    "Equilibria",
    "Hamiltonian",
    "Linearization",
    "LinearizationAlong",
    "Regulator",
    "Routhian",
    "conserved",
    "equilibria",
    "hamiltonian",
    "linearize",
    "linearize_along",
    "routhian",
]
