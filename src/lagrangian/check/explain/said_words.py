"""The words for what is wrong in a quantity of a system that an answer says: what it is called, and why it is wrong."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.meant import PART_OF
from lagrangian.check.explain.misconceptions.sine_for_cosine import WHY as WHY_EXCHANGED
from lagrangian.check.explain.say import WHY_PART
from lagrangian.page.formula import Left, Text, text

_SPEED = "The velocity is the derivative of the position; every coordinate that moves the body adds to it."
_WAY = "Go along the way from the fixed point to the body: every piece of it counts."
_DEFLECTION = "The deflection is the motion of one end relative to the other, less the rest length."
_DAMPER = "A damper feels the velocity of one end relative to the other."
WHY = {
    "speed": text(_SPEED),
    "component": text(_SPEED),
    "along": text(_SPEED),
    "acceleration": text(
        "The acceleration is the derivative of the velocity: what multiplies a rate in it is differentiated as well."
    ),
    "turning": text("ω is how fast the body itself turns against the fixed axes."),
    "inertia": text("Take the moment of inertia that is given, about the centre of mass."),
    "axis": text(
        "About a parallel axis it is larger, by the mass times the square of the distance of this axis from the centre "
        "of mass."
    ),
    "position": text(_WAY),
    "apart": text(_WAY),
    "height": text(_WAY),
    "place": text(_WAY),
    "velocity": text(_SPEED),
    "deflection": text(_DEFLECTION),
    "rate": text(_DAMPER),
    "force": text("Look at both ends: how far, and how fast, do they move relative to each other?"),
    "rotation": text("An angular velocity is squared, and so is the radius by which a velocity is divided for it."),
    "translation": text(_SPEED),
    "kinetic": text("Every body has the kinetic energy of its translation and, if it turns, that of its rotation."),
    "potential": text(WHY_PART[3]),
    "Xi": text("Change only this coordinate a little. Does the point where the force acts move, and how far?"),
    "damping": text(_DAMPER),
    "restoring": text(_DEFLECTION),
    "mass": text("Every body that moves with this coordinate adds to it, by its mass and by its moment of inertia."),
}
WHY_TERM = text("Go through it term by term: a sum is squared as a whole, with twice the product of its parts.")
WHY_RELATIVE = text("Ask of every coordinate whether it is counted from a fixed place, or from what carries the body.")
CALLED = {
    "component": "velocity",
    "along": "velocity",
    "turning": "angular velocity",
    "inertia": "moment of inertia",
    "axis": "moment of inertia",
    "height": "position",
    "apart": "position",
    "place": "position",
    "rate": "velocity",
    "kinetic": "kinetic energy",
    "rotation": "kinetic energy of the rotation",
    "translation": "kinetic energy of the translation",
    "potential": "potential energy",
    "Xi": "generalized force",
}
NAMES = {"place": "position", "height": "position", "apart": "position", "rate": "deflection", **PART_OF}
NAMES |= dict.fromkeys(["component", "along", "velocity"], "speed")
"""What mistakes of some kinds are called."""
WHY_SIGN = text("Every piece counts in the direction in which it points: plus along the axis, minus against it.")
WHY_SIGN_OF_RATE = text(
    "Differentiate the position by time, term by term: the derivative of a sine is the cosine, that of a cosine is "
    "minus the sine."
)
OF_MANY_TERMS = ("speed", "kinetic", "mass", "potential")
"""Kinds in which two formulas in different arrangements do not show at once in which term they differ."""
WHY_ROLLING = text(
    "ω is how fast the body itself turns against the fixed axes: where it rolls, or a rope or a wheel drives it, both "
    "have the same velocity at the contact; that velocity against its own axle, divided by its own radius, is ω."
)
OF_WAYS, OF_TURNED = ("position", "apart", "height", "place"), ("component", "acceleration", "velocity")
SIGN = " has the wrong sign."
"""How the words for a wrong sign of a term end."""


def why_of(kind: str, right: sp.Expr, apart: Sequence[str | Left]) -> Text:
    """Why a quantity is wrong that differs in these words from what is ``right``."""
    if kind == "turning" and sp.fraction(right)[1].free_symbols:
        return WHY_ROLLING
    sign = bool(apart) and str(apart[-1]) == SIGN
    if sign and kind in OF_WAYS:
        return WHY_SIGN
    if kind in (*OF_TURNED, "along", "speed") and _are_exchanged(apart):
        return WHY_EXCHANGED
    turned = any(isinstance(x, sp.Expr) and x.has(sp.sin, sp.cos) for x in apart)
    return WHY_SIGN_OF_RATE if sign and turned and kind in OF_TURNED else WHY[kind]


def _are_exchanged(apart: Sequence[str | Left]) -> bool:
    """Whether one term stands in place of another that differs in a sine and a cosine that are exchanged."""
    terms = [x for x in apart if isinstance(x, sp.Expr)]
    if len(terms) != 2 or not all(x.has(sp.sin, sp.cos) for x in terms):
        return False
    other, right = terms
    angles = [x.args[0] for x in other.atoms(sp.sin, sp.cos)]
    swaps = ({sp.sin(a): sp.cos(a), sp.cos(a): sp.sin(a)} for a in angles)
    return any(bounded.expand(cast("sp.Expr", other.xreplace(swap))) in (right, -right) for swap in swaps)


STEPS = {"deflection": 3, "potential": 3, "height": 3, "restoring": 3, "rate": 6, "Xi": 6, "damping": 6, "force": 6}


def of_terms(terms: Sequence[sp.Expr]) -> Text | None:
    """What is advised for terms each of which may be twice the product of two parts of a sum, 2 m a b, and not the
    square of one, m e²; None for others, and where a sine and a cosine are exchanged."""
    if _are_exchanged(terms):
        return None
    powers = [x.as_powers_dict().items() for x in terms]
    cross = all(sum(n == 1 and not x.is_number for x, n in own) > 1 for own in powers)
    return WHY_TERM if cross else None
