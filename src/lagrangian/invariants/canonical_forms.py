"""The forms of Hamilton and Routh as reports."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Model
from lagrangian.page.formula import Check, Elided, Formula, Item, Left, Matrix, Name, Partial, Terms, formula, text
from lagrangian.page.plain import plain
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass
from lagrangian.write.written import Written


@dataclass(frozen=True, eq=False)
class Hamiltonian(Written):
    """Hamilton's form: H(q, p, t), the momenta and the canonical equations.

    ``momenta``: coordinate → symbol of its momentum, a function of time. ``definitions``: momentum → ∂L/∂ξ̇ in terms of
    rates. ``equations``: rate of a coordinate or momentum → its expression in q, p, t. ``is_total`` says whether H is
    T* + V, and ``is_constant`` whether H is constant along every motion, as long as the inputs in ``while_constant`` do
    not change.
    """

    model: Model
    H: sp.Expr
    momenta: Mapping[sp.Expr, sp.Expr]
    definitions: Mapping[sp.Expr, sp.Expr]
    equations: Mapping[sp.Expr, sp.Expr]
    is_total: bool
    is_constant: bool
    checks: tuple[Check, ...]
    while_constant: tuple[str, ...] = ()

    def report(self) -> Report[Model]:
        """Return the report."""
        return hamiltonian_report(self)


@dataclass(frozen=True, eq=False)
class Routhian(Written):
    """Routh's form: the Routhian R of the remaining coordinates, with the momenta of the ignorable ones as constants.

    ``ignorable``: coordinate → symbol of its constant momentum. ``definitions``: that symbol → ∂L/∂ξ̇ in terms of
    rates. ``rates``: rate of an ignorable coordinate → its expression, to be integrated once the others are known.
    ``coordinates`` are the remaining ones, with their ``equations``. ``potential`` is the effective potential, −R at
    rest.
    """

    model: Model
    R: sp.Expr
    ignorable: Mapping[sp.Expr, sp.Symbol]
    definitions: Mapping[sp.Symbol, sp.Expr]
    rates: Mapping[sp.Expr, sp.Expr]
    coordinates: tuple[sp.Expr, ...]
    equations: tuple[sp.Eq, ...]
    potential: sp.Expr
    checks: tuple[Check, ...]

    def report(self) -> Report[Model]:
        """Return the report."""
        return routhian_report(self)


def _defined(definitions: Mapping[Any, sp.Expr], rates: Mapping[Any, Any]) -> list[Item]:
    return [formula(p, Partial(Name("L"), rates[p]), value) for p, value in definitions.items()]


LONGEST = 200
"""H, R and equations with at most this many operations are written out, which is about ten lines of a page."""


def _sum(expr: sp.Expr) -> Left:
    """The terms of a sum, or its summary if it is too long to read."""
    terms = tuple(cast("sp.Expr", term) for term in expr.as_ordered_terms())
    operations = bounded.operations(expr)
    return Terms(terms) if operations <= LONGEST else Elided(expr, operations, terms)


def _by_mass(found: Hamiltonian) -> list[Item]:
    """H = ½ pᵀ M⁻¹ p + V with M and V, if H itself is too long to read and equals T* + V."""
    if not found.is_total or bounded.operations(found.H) <= LONGEST:
        return []
    rates = [c.rate for c in found.model.coordinates]
    M = Matrix(tuple(tuple(_entry(sp.diff(p, v)) for v in rates) for p in found.definitions.values()))
    V = cast("sp.Expr", found.H.xreplace(dict.fromkeys(found.momenta.values(), sp.S.Zero)))
    p = Name("p vector")
    return [
        text("H = ½ ", p, "ᵀ ", Name("M"), "⁻¹ ", p, " + V, with"),
        formula(Name("M"), M),
        formula(Name("V"), _sum(V)),
        text("Written out it is"),
    ]


def _by_rates(found: Hamiltonian) -> list[Item]:
    """The canonical equations in terms of M and V, if H is given in this form."""
    if not _by_mass(found):
        return []
    M, p, v = Name("M"), Name("p vector"), Name("q vector", "", 1)
    return [text(v, " = ", M, "⁻¹ ", p, " and ṗᵢ = ½ ", v, "ᵀ (∂", M, "/∂ξᵢ) ", v, " − ∂V/∂ξᵢ + Ξᵢ; written out:")]


def _entry(expr: Any) -> sp.Expr:
    return cast("sp.Expr", expr)


def hamiltonian_report(found: Hamiltonian) -> Report[Model]:
    """Return the report of Hamilton's form."""
    by_momentum = {found.momenta[c.symbol]: c.rate for c in found.model.coordinates}
    kind = "T* + V" if found.is_total else "not T* + V, because a motion is prescribed"
    kept = "it is constant along every motion" if found.is_constant else "forces or explicit time change it"
    if found.while_constant:
        names = ", ".join(found.while_constant)
        kept = f"it is constant while {names} {'is' if len(found.while_constant) == 1 else 'are'} constant"
    equations: list[Item] = [formula(x, _sum(value), boxed=True) for x, value in found.equations.items()]
    parts = (
        Part(text("Momenta"), tuple(_defined(found.definitions, by_momentum))),
        Part(
            text("Hamiltonian"),
            (*_by_mass(found), formula(Name("H"), _sum(found.H), boxed=True), text(f"H is {kind}; {kept}.")),
        ),
        Part(text("Canonical equations"), (*_by_rates(found), *equations), found.checks),
    )
    data = {
        "system": found.model.name,
        "H": plain(found.H),
        "momenta": {plain(q): plain(p) for q, p in found.momenta.items()},
        "definitions": {plain(p): plain(value) for p, value in found.definitions.items()},
        "equations": {plain(x): plain(value) for x, value in found.equations.items()},
        "is_total": found.is_total,
        "is_constant": found.is_constant,
        "while_constant": list(found.while_constant),
        "checks": _checks(found.checks),
    }
    return Report(f"{found.model.name}: Hamilton's form", found.model, parts, data)


def routhian_report(found: Routhian) -> Report[Model]:
    """Return the report of Routh's form."""
    by_momentum = {found.ignorable[c.symbol]: c.rate for c in found.model.coordinates if c.symbol in found.ignorable}
    equations: list[Item] = [
        Formula((_sum(cast("sp.Expr", e.lhs)), _sum(cast("sp.Expr", e.rhs))), boxed=True) for e in found.equations
    ]
    gone: list[Item] = [formula(v, _sum(value)) for v, value in found.rates.items()]
    parts = (
        Part(text("Constant momenta"), tuple(_defined(found.definitions, by_momentum))),
        Part(
            text("Routhian"),
            (
                formula(Name("R"), _sum(found.R), boxed=True),
                text("The Lagrangian of the remaining coordinates; its potential is"),
                formula(Name("V", "eff"), _sum(found.potential)),
            ),
        ),
        Part(text("Equations of the remaining coordinates"), tuple(equations), found.checks),
        Part(text("The ignorable coordinates"), tuple(gone)),
    )
    data = {
        "system": found.model.name,
        "R": plain(found.R),
        "ignorable": {plain(q): plain(p) for q, p in found.ignorable.items()},
        "definitions": {plain(p): plain(value) for p, value in found.definitions.items()},
        "rates": {plain(v): plain(value) for v, value in found.rates.items()},
        "coordinates": [plain(q) for q in found.coordinates],
        "equations": [f"{plain(e.lhs)} = {plain(e.rhs)}" for e in found.equations],
        "potential": plain(found.potential),
        "checks": _checks(found.checks),
    }
    return Report(f"{found.model.name}: Routh's form", found.model, parts, data)


def _checks(checks: tuple[Check, ...]) -> list[dict[str, Any]]:
    return [{"what": str(c.what), "holds": c.holds, "figure": c.figure} for c in checks]
