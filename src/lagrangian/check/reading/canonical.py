"""Derivatives of a Hamiltonian, which hold the momenta of the answer fixed and not the rates.

With p = p(q, q̇), M = ∂p/∂q̇ and H written out in rates,

    ∂H/∂q at fixed p = ∂H/∂q − ∂H/∂q̇ M⁻¹ ∂p/∂q,    ∂H/∂p = ∂H/∂q̇ M⁻¹.

A Routhian, R = L − p θ̇, holds the momenta of the coordinates that do not occur in it, and is differentiated by the
rates of the others, too. R is Rayleigh's function otherwise.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.model.names import time

NAMES = ("H", "ℋ")
"""How answers call a Hamiltonian."""

ROUTHIAN = "Routhian"
"""What R is called where it is one."""

MOST = 4
"""The most momenta."""

_R = re.compile(r"(?<![\w\\])(?:\\mathcal[ ]?(?:R(?![A-Za-z])|\{[ ]?R[ ]?\})|[Rℛ])(?!\w)")
_SAID = re.compile(r"\bRouth", re.IGNORECASE)
_TRANSFORMED = re.compile(
    r"(?<![\w\\])R[ ]?(?:\([^()\n]{1,60}\))?[ ]?&?:?=[ ]?"
    r"(?:(?:L|ℒ|\\mathcal\{?[ ]?L\}?)[ ]?[-−–][ ]?(?:\\sum|Σ|∑)?[^\n=+]{0,12}\bp"
    r"|(?:\\sum|Σ|∑)?[ ]?p[^\n=+−-]{1,40}[-−–][ ]?(?:L|ℒ|\\mathcal))"
)
"""A Routhian as it is made of a Lagrangian."""


def with_routhian(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which R is called a Routhian, where words or its value say that it is one; ``taken`` says
    whether the system has a name."""
    text = written.text
    stated = re.search(r"(?<!\w)[Rℛ]\}?[ ]?(?:\([^()\n]{1,60}\))?[ ]?&?:?=(?!=)", text)
    if taken("R") or stated is None or (_SAID.search(text) is None and _TRANSFORMED.search(text) is None):
        return written
    name = rf"\mathrm{{{ROUTHIAN}}}" if "\\" in text or "$" in text else ROUTHIAN
    return written.sub(_R, lambda _: name)


def ignored(
    R: sp.Expr, own: Mapping[str, tuple[str, Any]], coordinates: Sequence[Any]
) -> tuple[dict[str, sp.Expr], list[Any]]:
    """The momenta among an answer's own names that a Routhian holds, by key, and the coordinates to which they belong:
    those that occur in none of these but by their rates; none unless they are equally many."""
    rates = {q.diff(time): sp.Dummy() for q in coordinates}
    found = {
        base: v for base, (_, v) in own.items() if base[:1] in ("p", "P") and isinstance(v, sp.Expr) and v.has(*rates)
    }
    whole = sp.Tuple(R, *found.values()).xreplace(rates)
    absent = [q for q in coordinates if not whole.has(q)]
    return (found, absent) if len(found) == len(absent) <= MOST else ({}, [])


def momenta_of(own: Mapping[str, tuple[str, Any]], rates: Sequence[sp.Expr]) -> dict[str, sp.Expr]:
    """The momenta among an answer's own names, by key: those that begin with p and hold rates; none unless there is one
    for each of the ``rates``."""
    found = {
        base: v for base, (_, v) in own.items() if base[:1] in ("p", "P") and isinstance(v, sp.Expr) and v.has(*rates)
    }
    return found if len(found) == len(rates) <= MOST else {}


def slope_at_momenta(
    H: sp.Expr,
    momenta: Mapping[str, sp.Expr],
    coordinates: Sequence[Any],
    by: Any,
    slope: Callable[[sp.Expr, Any], sp.Expr],
) -> sp.Expr | None:
    """The derivative of H by a coordinate, by the rate of one that is not among the ``coordinates`` of the momenta, or
    by the momentum with the key ``by``; None if the momenta do not determine the rates. ``slope`` differentiates.
    """
    rates = [q.diff(time) for q in coordinates]
    M = sp.Matrix([[slope(p, v) for v in rates] for p in momenta.values()])
    if M.has(*rates) or bounded.is_zero(bounded.expand(cast("sp.Expr", M.det()))):
        return None
    by_momenta = M.T.LUsolve(sp.Matrix([slope(H, v) for v in rates]))
    if by in momenta:
        return cast("sp.Expr", by_momenta[list(momenta).index(by)])
    moved = [x * slope(p, by) for x, p in zip(by_momenta.flat(), momenta.values(), strict=True)]
    return slope(H, by) - sp.Add(*moved)
