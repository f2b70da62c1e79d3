"""Which form a derivation gets."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Literal, TypeAlias, get_args

import sympy as sp

from lagrangian import bounded
from lagrangian.bounded import hard
from lagrangian.derive import Derived, Detail, derive
from lagrangian.derive.circuits import has_coils
from lagrangian.derive.multipliers.rows import NO_UNITS
from lagrangian.errors import Error, ModelError, did_you_mean
from lagrangian.model import Model, is_hard
from lagrangian.page.formula import text
from lagrangian.structured.derive import derive_structured
from lagrangian.structured.predict import is_long

_log = logging.getLogger(__name__)

AskedForm: TypeAlias = Literal["auto", "expanded", "structured"]
"""How equations are to be written: in the coordinates alone, in named quantities, or whichever can be read."""


def takes_long(model: Model, form: AskedForm = "auto", **_: object) -> bool:
    """Whether deriving a model in a form may take so long that it is counted."""
    if is_structured(model, form) and not model.constraints:
        return is_tangled(model)
    return is_hard(model)


@bounded.answered("writing the equations out", takes_long)
def derive_in_form(
    model: Model, form: AskedForm = "auto", *, detail: Detail = "usual", units: Mapping[str, str] = NO_UNITS
) -> Derived:
    """Derive a model in the form asked for; "auto" writes long equations in named quantities.

    Raises `ModelError` for an unknown form, for ``detail="full"`` of a structured derivation, and where the system
    cannot have that form.
    """
    if form not in get_args(AskedForm):
        known = get_args(AskedForm)
        hint = did_you_mean(str(form), known) or f"use one of {', '.join(known)}"
        raise ModelError(f"there is no form '{form}'", fix=hint, code="E405")
    if is_structured(model, form):
        return _structured(model, detail, units)
    try:
        return derive(model, detail=detail, units=units)
    except Error as error:
        if form == "expanded" or refusal(model) or error.code != "E601":
            raise
        _log.info("deriving: %s", error)
        made = _structured(model, detail, units)
        return replace(made, notes=(*made.notes, text(f"Written in named quantities, because {error.what}.")))


def is_structured(model: Model, form: AskedForm = "auto") -> bool:
    """Whether a derivation in this form is written in named quantities from the start."""
    if form == "auto":
        return bool(model.floating) or (not refusal(model) and is_long(model))
    return form == "structured"


def is_tangled(model: Model) -> bool:
    """Whether SymPy may take long: over a single point, frame or element, or because there are very many."""
    if len(model.coordinates) > MANY_COORDINATES:
        return True
    return model.remembered("is_tangled", lambda: hard(_pieces(model), plain=LONGEST_PIECES))


MANY_COORDINATES = 50
"""The number of coordinates above which deriving is counted."""


LONGEST_PIECES = 20_000
"""The total size of the descriptions above which deriving is counted."""


def _pieces(model: Model) -> Iterator[sp.Basic]:
    """What elements, points and frames are described by, each relative to the one before it."""
    points = {id(p): p for e in model.elements for _, p in e.points()}
    frames = {id(f): f for e in model.elements for _, f in e.frames()}
    listed: list[Any] = [use.expr for e in model.elements for use in e.uses()]
    listed += [d.expression for d in model.definitions]
    listed += [x for p in points.values() for x in p.offset]
    listed += [x for f in frames.values() for x in (*(f.axis or ()), f.angle)]
    for x in listed:
        yield sp.sympify(x)


def _structured(model: Model, detail: Detail, units: Mapping[str, str]) -> Derived:
    refused = refusal(model)
    if refused:
        raise ModelError(
            f"system '{model.name}' has no structured derivation: {refused}",
            fix="leave the form out, or ask for the expanded one"
            if not model.floating
            else "compile, simulate, verify and export take it as it is",
            code="E601",
        )
    if detail == "full":
        raise ModelError(
            "step 5 is written term by term only in the expanded form",
            fix="leave the detail out, or ask for the expanded form",
            code="E405",
        )
    return derive_structured(model, units)


def refusal(model: Model) -> str:
    """Why a model has no structured derivation; empty if it has one."""
    if not model.bodies and not has_coils(model):
        return "its energies were given directly, without bodies"
    return ""
