"""A moment of inertia of another shape, ½ m r² for m r²: likelier than ½mv² or ½Jω² that counts half.

What rolls has both energies in one term; that the ½ stands there twice is written by nobody.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp

from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.changes.pool import Pool, Possible
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.search import SMALL, Told
from lagrangian.check.reference import Reference
from lagrangian.model import RigidBody

HALF = Fraction(-1, 2)
"""The multiple of a part that counts half."""


def as_form(pool: Pool, told: Told) -> Told:
    """Half of a kinetic energy of a body as another moment of inertia of this body that leads to the same."""
    change = told.mistake.change
    body = change.site.element if change is not None and change.kind == "part" and told.times == HALF else None
    if change is None or not change.site.T or not isinstance(body, RigidBody):
        return told
    s = ingredients_of(pool.truth.derivation)
    letters, place = letters_in(s.expand(body.inertia[0])), pool.places[id(told.mistake)]
    made = float(told.times) * np.array([pool.T[place], *pool.W[place]])
    for k, possible in enumerate(pool.all):
        form = _form(possible, body)
        if form is None or not letters_in(form) <= letters:
            continue
        own = np.array([pool.T[k], *pool.W[k]])
        if np.abs(own - made).max() <= SMALL * np.abs(made).max():
            return replace(told, mistake=possible, times=Fraction(1))
    return told


def cancelled(truth: Reference, possible: Possible) -> set[Any]:
    """The letters of a moment of inertia that stand in no energy: r of ½ (½ m r²) (ẋ/r)². They may be written."""
    body = possible.element
    if not isinstance(body, RigidBody) or _form(possible, body) is None:
        return set()
    s = ingredients_of(truth.derivation)
    return letters_in(s.expand(body.inertia[0])) - letters_in(s.rotation(body))


def _form(possible: Possible, body: RigidBody) -> sp.Expr | None:
    """The moment of inertia of another shape that a body is given by a possible mistake."""
    change = possible.change
    if change is None or change.kind != "inertia_form" or possible.element is not body:
        return None
    return change.written if isinstance(change.written, sp.Expr) else None
