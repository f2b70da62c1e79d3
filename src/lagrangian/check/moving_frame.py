"""Energies as they are seen where a system is carried around as prescribed, T* = T₂ + T₁ + T₀ in the orders of rates.

U = V − T₀       the effective potential, which contains that of centrifugal forces
T₂ − U           a right Lagrangian, with the potential of all apparent forces in a frame that does not turn
K = T₂ − T₀ + V  the Hamiltonian, also by the letter of a kinetic energy
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import harmless, unmoved
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.page.formula import Text, text

_LETTERS = ("K", "\\mathcal{K}", "\\mathcal K")


def with_hamiltonian(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[Sequence[AnsweredLine], tuple[Text, ...]]:
    """The lines, with a K that is the Hamiltonian and no kinetic energy as an identity that holds, and notes on it."""
    called = [x for x in lines if x.kind == "T" and x.text.partition("=")[0].strip(" &") in _LETTERS]
    found = [x for x in called if not zero_everywhere(truth, x.expr - truth.T) and _is_hamiltonian(truth, x)]
    held = [replace(x, kind="identity", expr=sp.S.Zero) if any(x is y for y in found) else x for x in lines]
    return held, tuple(text(f"K in line {x.number} was read as the Hamiltonian.") for x in found)


def _is_hamiltonian(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line states Σ ξ̇ ∂L/∂ξ̇ − L, up to a constant."""
    rates = [c.rate for c in truth.model.coordinates]
    h = sp.Add(*[v * bounded.diff(truth.L, v) for v in rates]) - truth.L
    return unmoved(truth, line.expr - h)


def with_effective_potential(truth: Reference, findings: Sequence[Finding], *, motion: bool) -> list[Finding]:
    """The findings, with an effective potential U = V − T₀ as a right one where what is stated with it fits.

    That is a T* with which T* − U is the right Lagrangian, or the whole V or L on another line or, if neither T* nor L
    is stated, all equations of ``motion``.
    """
    wrong = [f for f in findings if f.line.kind == "V" and f.status is Status.WRONG]
    if not wrong or truth.derivation.multipliers:
        return list(findings)
    T_0 = cast("sp.Expr", bounded.replaced(truth.T, {c.rate: sp.S.Zero for c in truth.model.coordinates}))
    relative = cast(
        "sp.Expr", (truth.T + truth.T.xreplace({c.rate: -c.rate for c in truth.model.coordinates})) / 2 - T_0
    )
    centrifugal = [f for f in wrong if unmoved(truth, f.line.expr - truth.V + T_0)]
    carried = [f for f in wrong if f not in centrifugal and _with_potential(truth, relative, f.line)]
    found = [*centrifugal, *carried]
    whole = any(f.line.kind in ("V", "L") and f.status.right for f in findings)
    alone = motion and not any(f.line.kind in ("T", "L") for f in findings)
    with_it = [
        f for f in findings if f.line.kind == "T" and found and _with_potential(truth, f.line.expr, found[-1].line)
    ]
    if not found or not (whole or alone or with_it):
        return list(findings)
    note = text("the effective potential, which contains that of the centrifugal forces")
    beside = text("it gives the right Lagrangian with the effective potential")
    seen = text("the potential in the frame that is carried, with that of the apparent forces")
    notes = {id(f): seen if f in carried else note for f in found} | {
        id(f): beside for f in with_it if not f.status.right
    }
    return [
        replace(f, status=Status.EQUIVALENT, note=notes[id(f)], differences=()) if id(f) in notes else f
        for f in findings
    ]


def _with_potential(truth: Reference, T: sp.Expr, U: AnsweredLine) -> bool:
    """Whether a kinetic energy less a potential is a right Lagrangian."""
    rest = T - U.expr - truth.L
    return zero_everywhere(truth, rest) or harmless(truth, replace(U, kind="L", expr=T - U.expr), rest) is not None
