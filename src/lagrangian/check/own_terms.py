"""Finds a single wrong term in an equation: a wrong sign, a wrong factor, a superfluous or a missing term.

The right equations are projected out of a wrong equation P; what remains is its error. If the error is c times what
remains of one of the answer's own terms t, then P − c t is right: c = 2 means a wrong sign, c = 1 a superfluous term,
and another c a wrong factor. A missing term is sought among terms like those that were written, with sine and cosine
exchanged.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference, terms
from lagrangian.check.rows import DOUBLE_TOLERANCE
from lagrangian.check.verdict import Mistake
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.page.formula import text

MOST_TERMS = 250
"""The largest number of terms of an expanded equation that are examined."""

WHY = text("Go through ∂L/∂ξ̇, its d/dt and ∂L/∂ξ once more, term by term, and mind the signs.")


def wrong_term(truth: Reference, expr: sp.Expr, coordinate: str | None) -> Mistake | None:
    """The one term of an equation, left minus right, that makes it wrong; None if there is no such single term."""
    if terms(expr) > MOST_TERMS or not np.isfinite(truth.W).all():
        return None
    parts = (*sp.Add.make_args(expr), *sp.Add.make_args(bounded.expand(expr)))
    written = [t for t in dict.fromkeys(parts) if t not in (0, expr)]
    siblings = list(dict.fromkeys(s for t in written for s in _siblings(t)))[: 4 * MOST_TERMS]
    values = CompiledExpressions([expr, *written, *siblings]).at(truth.states)
    if not np.isfinite(values[0]).all():
        return None
    left = _beside(truth, values)
    for t, rest in zip(written, left[1 : len(written) + 1], strict=True):
        if (c := _times(left[0], rest)) is not None:
            return _of_own(t, c, coordinate)
    for t, rest in zip(siblings, left[len(written) + 1 :], strict=True):
        if (c := _times(left[0], rest)) in (1, -1):
            term = -t if c == 1 else t
            what = text(
                "The term ", term, " is missing: there is one like it with sine and cosine the other way round."
            )
            return Mistake("term_forgotten", what, WHY, 5, None, coordinate)
    return None


def _of_own(t: sp.Expr, c: sp.Expr, coordinate: str | None) -> Mistake:
    if c == 2:
        return Mistake("sign_of_a_term", text("The term ", t, " has the wrong sign."), WHY, 5, None, coordinate)
    if c == 1:
        return Mistake("term_too_much", text("The term ", t, " is too much."), WHY, 5, None, coordinate)
    what = text("The term ", t, " should be ", (1 - c) * t, ".")
    return Mistake("factor_of_a_term", what, WHY, 5, None, coordinate)


def _beside(truth: Reference, values: Array) -> Array:
    """What remains of each row when the right equations are projected out, with factors that are constant in each
    set."""
    size = truth.states.size // SETS
    out = np.empty_like(values)
    for k in range(SETS):
        part = slice(k * size, (k + 1) * size)
        W = truth.W[:, part]
        scale = np.abs(W).max(axis=1, keepdims=True)
        q, r = np.linalg.qr((W / np.where(scale > 0, scale, 1.0)).T)
        q = q[:, np.abs(np.diag(r)) > 1e-10]
        here = values[:, part]
        out[:, part] = here - (here @ q) @ q.T
    return out


def _times(whole: Array, part: Array) -> sp.Expr | None:
    """The rational number c with whole = c · part; None if there is none."""
    largest = float(np.max(np.abs(part), initial=0.0))
    if not np.isfinite(part).all() or not np.isfinite(whole).all() or largest <= 1e-10:
        return None
    unit = part / largest  # squares of very large values would overflow
    with np.errstate(over="ignore", invalid="ignore"):
        c = float(whole @ unit) / float(unit @ unit) / largest
    if not np.isfinite(c) or np.abs(whole - c * part).max() > DOUBLE_TOLERANCE * np.abs(whole).max():
        return None
    found: Any = sp.Rational(Fraction(c).limit_denominator(64))
    return found if abs(float(found) - c) < 1e-7 * max(1.0, abs(c)) and found != 0 else None


def _siblings(t: sp.Expr) -> Iterator[sp.Expr]:
    """The term with sine and cosine exchanged in one place, or in two."""
    table: dict[Any, Any] = {}
    for f in sorted(t.atoms(sp.sin, sp.cos), key=sp.default_sort_key):
        table[f] = sp.cos(f.args[0]) if isinstance(f, sp.sin) else sp.sin(f.args[0])
    for count in (1, 2):
        for chosen in combinations(table, count):
            yield cast("sp.Expr", t.xreplace({f: table[f] for f in chosen}))
