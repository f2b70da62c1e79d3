"""A derivation as plain data for JSON.

Schema 1. Expressions are ``{"plain": …, "latex": …}``: text that the expression grammar reads back, and LaTeX. Formulas
also have ``"text"`` (one line of Unicode). Keys at the top:

    schema, name, notation      1, the system's name, the notation of the formulas
    coordinates, parameters, inputs, definitions
                                lists with "name", and "unit" as given, "value_si", "description", "expression"
                                where there are
    T, V, L                     expressions: kinetic co-energy, potential energy, Lagrangian
    Xi                          {coordinate: expression}
    equations                   list: "coordinate", "left", "right" (expressions), "terms" (list: expression, "kind",
                                "elements")
    form                        "expanded", or "structured": equations, energies and Ξ in named quantities
    mass_matrix, coriolis_matrix, gravity_vector, generalized_forces
                                of an expanded derivation: lists of rows of plain text; q̈ follows from
                                M q̈ + C q̇ + G = Ξ
    named_quantities            of a structured derivation, each in earlier ones: list: "symbol", "expression", "kind",
                                "of" (what it belongs to), "inward" (a sum over all that hangs on it), "elements"
    steps                       list: "number", "title", "what", "why", "items", "reasons", "checks"
    result                      items of the closing section
    ledger                      list: "element", "column", "reason", "expression" (or null)
    verified                    list: "what", "holds", "figure"
    multipliers                 of a system with constraints only, as the next three: list: "name" (of the row),
                                "element", "symbol", "unit", "words", "position" (or null), "rate", "second_rate"
    constraint_items            items of the step on constraints
    minimal                     the equations without multipliers, or null: "speeds", "meanings", "rates", "S", "s0",
                                "equations"
    no_minimal                  why there are none, or null
    notes                       list of texts
    notices                     list: "code", "where", "text": what is to be known of the system

An item has a "kind": "text" ("text"), "heading" ("text"), "formula" ("plain", "text", "latex", "boxed", "note"; with an
elided side also "operations") or "table" ("header", "rows": lists of text).
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import sympy as sp

from lagrangian.derive.derived import Derived
from lagrangian.page import formula as data
from lagrangian.page.formula import Check
from lagrangian.page.plain import plain
from lagrangian.write.blocks import operations
from lagrangian.write.expression import NamedSymbol
from lagrangian.write.expression_tree import equality
from lagrangian.write.quantities import Notation, Quantities
from lagrangian.write.tex import WEB
from lagrangian.write.unicode_math import unicode

SCHEMA = 1


def to_dict(
    derivation: Derived, *, notation: Notation = "lecture", brief: bool = False, full: bool = False
) -> dict[str, Any]:
    """Return the derivation as plain data: dictionaries, lists, text, numbers.

    ``brief`` keeps only the items of the one-page checklist; ``full`` writes out the formulas that would be summarized
    (the results themselves are always complete). Raises `ModelError` for an unknown notation.
    """
    return _Data(derivation, notation, brief, full).whole()


def named_symbols(derivation: Derived) -> list[NamedSymbol]:
    """The symbols that a derivation defines, turns first: m₁ c₂ v₃."""
    named = (*derivation.definitions, *derivation.patterns)
    return [NamedSymbol(d.symbol, 0 if d.kind == "turn" else 1, d.inward) for d in named]


class _Data:
    def __init__(self, derivation: Derived, notation: Notation, brief: bool, full: bool) -> None:
        self.derivation, self.notation, self.brief = derivation, notation, brief
        self.write = Quantities(derivation.model, notation, full=full, named=named_symbols(derivation))

    def whole(self) -> dict[str, Any]:
        d, model = self.derivation, self.derivation.model
        return {
            "schema": SCHEMA,
            "name": model.name,
            "notation": self.notation,
            "coordinates": [{"name": c.name, "unit": c.unit, "description": c.description} for c in model.coordinates],
            "parameters": [
                {"name": p.name, "value_si": p.value, "unit": p.unit, "description": p.description}
                for p in model.parameters
            ],
            "inputs": [{"name": i.name, "unit": i.unit, "description": i.description} for i in model.inputs],
            "definitions": [{"name": x.name, "expression": self.expression(x.expression)} for x in model.definitions],
            "T": self.expression(d.T),
            "V": self.expression(d.V),
            "L": self.expression(d.L),
            "Xi": {plain(q): self.expression(x) for q, x in d.Xi.items()},
            "equations": [self.equation(i) for i in range(len(d.equations))],
            "form": d.form,
            **(self.named() if d.form == "structured" else self.matrices()),
            "steps": [
                {
                    "number": s.number,
                    "title": s.title,
                    "what": self.text(s.what),
                    "why": self.text(s.why),
                    "items": self.items(s.items),
                    "reasons": [self.text(r) for r in s.reasons],
                    "checks": self.checks(s.checked),
                }
                for s in d.steps
            ],
            "result": self.items(d.result),
            "ledger": [
                {
                    "element": row.element,
                    "column": row.column,
                    "reason": self.text(row.reason),
                    "expression": None if row.expression is None else self.expression(row.expression),
                }
                for row in d.ledger
            ],
            "verified": self.checks(d.verified),
            "notes": [self.text(n) for n in d.notes],
            **(self.constrained() if d.multipliers else {}),
            "notices": [{"code": n.code, "where": n.where, "text": n.text} for n in d.notices],
        }

    def expression(self, expr: sp.Basic) -> dict[str, str]:
        return {"plain": plain(expr), "latex": WEB.latex(self.write.expressions(expr))}

    def matrices(self) -> dict[str, Any]:
        """M, C, G and Ξ of equations in the coordinates alone."""
        d = self.derivation
        return {
            "mass_matrix": _rows(d.mass_matrix),
            "coriolis_matrix": _rows(d.coriolis_matrix),
            "gravity_vector": _rows(d.gravity_vector),
            "generalized_forces": _rows(d.generalized_forces),
        }

    def named(self) -> dict[str, Any]:
        """The definitions of equations in named quantities."""
        return {
            "named_quantities": [
                {
                    "symbol": plain(x.symbol),
                    "expression": self.expression(x.expression),
                    "kind": x.kind,
                    "of": x.of,
                    "inward": x.inward,
                    "elements": list(x.elements),
                }
                for x in self.derivation.definitions
            ]
        }

    def constrained(self) -> dict[str, Any]:
        """What a system with constraints has besides."""
        d = self.derivation
        assert d.constraint_step is not None
        made: dict[str, Any] = {
            "multipliers": [
                {
                    "name": x.name,
                    "element": x.element.title,
                    "symbol": self.expression(x.symbol),
                    "unit": x.unit,
                    "words": self.text(x.words),
                    "position": None if x.position is None else self.expression(x.position),
                    "rate": self.expression(x.rate),
                    "second_rate": self.expression(x.second_rate),
                }
                for x in d.multipliers.values()
            ],
            "constraint_items": self.items(d.constraint_step.items),
            "no_minimal": None if d.no_minimal is None else self.text(d.no_minimal),
            "minimal": None,
        }
        if d.minimal is not None:
            made["minimal"] = {
                "speeds": [self.expression(u) for u in d.minimal.speeds],
                "meanings": {plain(u): self.expression(x) for u, x in d.minimal.meanings.items()},
                "rates": {plain(v): self.expression(x) for v, x in d.minimal.rates.items()},
                "S": _rows(d.minimal.S),
                "s0": _rows(d.minimal.s0),
                "equations": [
                    {"left": self.expression(e.lhs), "right": self.expression(e.rhs)} for e in d.minimal.equations
                ],
            }
        return made

    def equation(self, index: int) -> dict[str, Any]:
        d = self.derivation
        equality = d.equations[index]
        return {
            "coordinate": d.model.velocities[index].name.removesuffix("'"),
            "left": self.expression(equality.lhs),
            "right": self.expression(equality.rhs),
            "terms": [
                {**self.expression(t.expr), "kind": t.kind, "elements": list(t.elements)} for t in d.terms[index]
            ],
        }

    def text(self, item: data.Text | data.Formula) -> str:
        return "".join(x if isinstance(x, str) else unicode(x) for x in self.write.inline(item))

    def items(self, items: Iterable[data.Item]) -> list[dict[str, Any]]:
        return [self.item(x) for x in items if not self.brief or getattr(x, "brief", False)]

    def item(self, item: data.Item) -> dict[str, Any]:
        match item:
            case data.Formula():
                return self.formula(item)
            case data.Text():
                return {"kind": "text", "text": self.text(item)}
            case data.Heading():
                return {"kind": "heading", "text": self.text(item.text)}
            case data.Table():
                return {
                    "kind": "table",
                    "header": [self.text(h) for h in item.header],
                    "rows": [[self.text(c) for c in row] for row in item.rows],
                }
        raise TypeError(f"not an item of a step: {type(item).__name__}")

    def formula(self, item: data.Formula) -> dict[str, Any]:
        sides = self.write.formula(item)
        shown = equality(sides)
        made: dict[str, Any] = {
            "kind": "formula",
            "plain": str(item),
            "text": unicode(shown),
            "latex": WEB.latex(shown),
            "boxed": item.boxed,
            "note": None if item.note is None else self.text(item.note),
        }
        longest = max((n for side in item.sides for n in operations(side)), default=0)
        if longest and not self.write.full:
            made["operations"] = longest
        return made

    def checks(self, checks: Iterable[Check]) -> list[dict[str, Any]]:
        return [{"what": self.text(c.what), "holds": c.holds, "figure": c.figure} for c in checks]


def _rows(matrix: Any) -> list[list[str]]:
    return [[plain(matrix[i, j]) for j in range(matrix.cols)] for i in range(matrix.rows)]
