"""Step 0: holonomic or not?"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.constraints.page import Constraints
from lagrangian.derive.context import Context
from lagrangian.derive.derived import Step
from lagrangian.model import Model, time
from lagrangian.page.formula import Item, Left, Name, formula, text


def constrained(context: Context, found: Constraints) -> Step:
    """Compare the generalized coordinates with the differential degrees of freedom that the constraints leave."""
    h = found.holonomy
    return Step(
        0,
        "Holonomic?",
        text("Compared the number of generalized coordinates with the differential degrees of freedom."),
        text(
            "Lagrange's equations come one by one from a wiggle (a virtual displacement) of one coordinate "
            "while the others stay fixed. "
            "Constraints forbid some of these wiggles: which of the three ways below is open depends on whether "
            "they can be integrated."
        ),
        found.items,
        {
            "holonomic": h.holonomic,
            "GC": h.GC,
            "DDOF": h.DDOF,
            "growth": h.growth,
            "integrals": h.integrals,
            "redundant": h.redundant,
        },
        (text(str(h)),),
    )


def holonomic(context: Context) -> Step:
    """Compare the generalized coordinates with the differential degrees of freedom.

    Without velocity constraints, every coordinate can wiggle independently, so #GC = #DDOF: holonomic.
    """
    model = context.model
    n = len(model.coordinates)
    listed: list[str | Left] = []
    for c in context.symbols:
        listed += [", ", c] if listed else [c]
    if n > 1:
        listed[-2] = " and "
    items: list[Item] = [
        formula(Name("#GC"), Name(str(n)), Name("#DDOF"), brief=True),
        text(
            "No constraint ties the velocities together, so each of the coordinates "
            if n > 1
            else "No constraint restricts the velocity, so the one coordinate ",
            *listed,
            f" can wiggle on its own. #GC = {n} is the number of generalized coordinates, #DDOF = {n} the number of "
            "differential degrees of freedom: rates that can be chosen freely at any instant. The two are equal, so "
            "the system is holonomic.",
        ),
    ]
    if any(model.expand(x).has(time) and not x.is_number for b in model.bodies for x in _explicit(model, b)):
        items.append(
            text(
                "A motion prescribed in t moves part of the system. It restricts positions, not velocities alone, "
                "so the system stays holonomic (rheonomic: the restriction depends on time)."
            )
        )
    return Step(
        0,
        "Holonomic?",
        text("Compared the number of generalized coordinates with the differential degrees of freedom."),
        text(
            "Lagrange's equations come one by one from a wiggle (a virtual displacement) of one coordinate "
            "while the others stay fixed; only "
            "in a holonomic system is each of these wiggles possible."
        ),
        tuple(items),
        {"holonomic": True, "GC": n, "DDOF": n},
        (text(f"holonomic: #GC = #DDOF = {n}, because no constraint on velocities was described"),),
    )


def _explicit(model: Model, body: Any) -> list[sp.Expr]:
    """The components of a body's position with constant coordinates, in which only explicit time is left."""
    held = {c.symbol: sp.S.Zero for c in model.coordinates}
    return [cast("sp.Expr", bounded.replaced(model.expand(x), held)) for x in model.position(body.at)]
