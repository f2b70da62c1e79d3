"""Which sign a sum has: the one that reads best, (R − r) φ̇/r and not −(−R + r) φ̇/r."""

from __future__ import annotations

from typing import cast

import sympy as sp

from lagrangian import bounded


def turned(expr: sp.Expr) -> sp.Expr:
    """The negative of an expression, with the sign inside of its sum: ((R − r) φ̇ − R ψ̇)/r."""
    factors = list(sp.Mul.make_args(expr))
    for k, f in enumerate(factors):
        if isinstance(f, sp.Add) and sp.S.NegativeOne not in factors:
            factors[k] = sp.Add(*[-x for x in f.args])
            return cast("sp.Expr", sp.Mul(*factors))
    return -expr


def without_double_sign(expr: sp.Expr) -> sp.Expr:
    """A product without a minus in front of a sum that begins with one: (R − r) φ̇/r for −(−R + r) φ̇/r."""
    sums = [x for x in sp.Mul.make_args(expr) if isinstance(x, sp.Add)]
    doubled = sp.S.NegativeOne in sp.Mul.make_args(expr) and sums
    return (
        turned(-expr) if doubled and cast("sp.Expr", sums[0].as_ordered_terms()[0]).could_extract_minus_sign() else expr
    )


def opposed(right: sp.Expr, written: sp.Expr) -> bool:
    """Whether most terms that two sums have in common, but for their numbers, have opposite signs in them; of others
    that have none, whether the right one alone has a minus in front."""
    signs = [{t: c > 0 for t, c in bounded.expand(x).as_coefficients_dict().items()} for x in (right, written)]
    same = [signs[0][t] == signs[1][t] for t in signs[0].keys() & signs[1].keys()]
    return 2 * sum(same) < len(same) if same else right.could_extract_minus_sign()
