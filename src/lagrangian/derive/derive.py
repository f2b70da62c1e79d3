"""The derivation, from the model to the equations."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping
from typing import Any, get_args

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Algebra
from lagrangian.derive.constraints.page import constraints
from lagrangian.derive.context import Context, fit
from lagrangian.derive.coordinates import coordinates
from lagrangian.derive.derived import Derived
from lagrangian.derive.energies import kinetic, lagrangian, potential, shares
from lagrangian.derive.forces import contributions, forces
from lagrangian.derive.holonomy import constrained, holonomic
from lagrangian.derive.lagrange import Detail, left_hand_sides, left_sides
from lagrangian.derive.multipliers.minimal import NOTHING_LESS, Found, without_multipliers
from lagrangian.derive.multipliers.rows import NO_UNITS, RowForms, multipliers, row_forms, with_multipliers
from lagrangian.derive.multipliers.step import by_multipliers, introduced
from lagrangian.derive.result import Shares, closing, equations, ledger, ledger_items, matrices
from lagrangian.derive.wiggle import study
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model import Model, is_hard
from lagrangian.page.formula import Text, text

_log = logging.getLogger(__name__)


@bounded.answered("writing the equations out", is_hard)
def derive(model: Model, *, detail: Detail = "usual", units: Mapping[str, str] = NO_UNITS) -> Derived:
    """Return the equations of motion of a model and the steps that lead to them.

    d/dt(∂L/∂ξ̇_i) − ∂L/∂ξ_i = Ξ_i with L = T* − V, for every coordinate. ``detail="full"`` writes d/dt out term by
    term. ``units`` are those of multipliers, by the names of their rows, where an expression decides.

    Raises `ModelError`, with their names, for coordinates that are dependent or move nothing, and for an unknown
    ``detail``. Source: the lecture's steps 0 to 6.
    """
    _check_detail(detail)
    described, model = model, with_multipliers(model)
    _log.info("deriving: which coordinates move what")
    wiggle = study(model)
    context = Context(model, Algebra(model, _everything(model)), wiggle)
    _log.info("deriving: the share of every element")
    pieces = shares(model, context.algebra)

    _log.info("deriving: steps 0 and 1, the generalized coordinates")
    ties = constraints(model, context.readable) if model.constraints else None
    step0 = holonomic(context) if ties is None else constrained(context, ties)
    step1 = coordinates(context)
    _log.info("deriving: step 2, the kinetic energy")
    step2 = kinetic(context, pieces)
    _log.info("deriving: step 3, the potential energy")
    step3 = potential(context, pieces)
    T, V = step2.expressions["T"], step3.expressions["V"]
    _log.info("deriving: step 4, the Lagrangian")
    step4 = lagrangian(context, pieces)
    _log.info("deriving: step 5, the left-hand sides")
    sides = left_sides(context, pieces)
    rows = row_forms(context, ties.holonomy.independent) if ties is not None else ()
    step5 = left_hand_sides(context, sides, detail, by_multipliers() if rows else ())
    _log.info("deriving: step 6, the generalized forces")
    found = contributions(context)
    step6 = forces(context, found, step1.expressions["relative"])

    _log.info("deriving: the equations and M, C, G")
    Xi = step6.expressions["Xi"]
    result, mats, book = equations(context, sides, found, rows), matrices(context, sides, Xi), ledger(model, context)
    less = without_multipliers(context, rows, sides, found, step1.expressions["lengths"]) if rows else NOTHING_LESS
    return Derived(
        model=described,
        steps=(step0, step1, step2, step3, step4, step5, step6),
        T=T,
        V=V,
        L=step4.expressions["L"],
        Xi=Xi,
        equations=result.equalities,
        terms=result.terms,
        matrices=mats,
        result=closing(context, result, mats, rows, less.items) + ledger_items(book),
        ledger=book,
        shares=Shares(context, sides, found, rows),
        notes=tuple(unexpanded_notes(context)),
        constraints=ties,
        **_constrained(context, rows, less, units),
    )


def _check_detail(detail: str) -> None:
    if detail not in get_args(Detail):
        known = get_args(Detail)
        raise ModelError(
            f"there is no level of detail '{detail}'",
            fix=did_you_mean(str(detail), known) or f"use one of {', '.join(known)}",
        )


def _constrained(context: Context, rows: tuple[RowForms, ...], less: Found, units: Mapping[str, str]) -> dict[str, Any]:
    """The fields that a system with constraints has besides; ``less`` are its equations without multipliers."""
    known = multipliers(context, rows, units)
    return {
        "multipliers": known,
        "minimal": less.minimal,
        "no_minimal": less.reason,
        "constraint_step": introduced(context, rows, known) if rows else None,
    }


SHOWN = 3
"""The largest number of expressions listed in a note."""


def unexpanded_notes(context: Context) -> Iterator[Text]:
    """Notes on sums that are too long to be multiplied out, and on searches that were ended early."""
    left = list(context.algebra.reader.left)
    if left:
        listed = [part for expr in left[:SHOWN] for part in (fit(expr), ", ")][:-1]
        more = f" and {len(left) - SHOWN} more" if len(left) > SHOWN else ""
        yield text("Not multiplied out, because the sum would be too long to read: ", *listed, f"{more}.")
    if context.algebra.generators.writing < 0:
        yield text("Some formulas could be shorter: the search for the shortest way of writing was ended early.")


def _everything(model: Model) -> list[sp.Expr]:
    """All energies and forces, from which the algebra chooses its angles and symbols."""
    exprs: list[sp.Expr] = []
    for element in model.elements:
        exprs += [element.kinetic(model), element.potential(model)]
        for action in element.works(model):
            exprs += [action.effort, action.rate]
    return exprs
