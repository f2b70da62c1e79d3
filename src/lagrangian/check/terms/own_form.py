"""What belongs in the place of a term, in the form in which that was written, so that one sees what is wrong in it.

−(a r + b s) ψ̇² sin θ has the wrong sign, although the right sum has a r ψ̇² sin θ + ½ b² ψ̇² sin 2θ; the term with cos θ
in place of sin θ is told with sin θ.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.terms.matched import number_between
from lagrangian.check.terms.pieces import partner

MOST_FORMS = 40
"""The most other forms of a term that are compared with what belongs there."""
MOST_SIGNS = 4
"""The most terms of a sum whose signs are changed."""
LONGEST_TERM = 80
"""A term with more operations is told as it is."""


def in_own_form(truth: Reference, written: sp.Expr, right: sp.Expr) -> sp.Expr:
    """The ``right`` term as a multiple of what was ``written``, or as this with one other function of an angle or one
    other sign; the right term as it is where it is neither."""
    if 0 in (written, right) or max(map(bounded.operations, (written, right))) > LONGEST_TERM:
        return right
    form, own = truth.form(right), truth.form(written)
    if form is None or own is None or form.opaque():
        return right
    if (number := number_between(form, own)) is not None:
        return cast("sp.Expr", number * written)
    longest = max(map(bounded.operations, (written, right)))
    for k, other in enumerate(_others(written, right)):
        if k == MOST_FORMS:
            break
        short = bounded.operations(other) <= longest
        if short and (found := truth.form(other)) is not None and (form - found).is_zero:
            return other
    return right


def _others(written: sp.Expr, right: sp.Expr) -> Iterator[sp.Expr]:
    """A term with a sine or cosine exchanged, with another sign in one sum, or with a sine or cosine more or less."""
    turned: list[Any] = sorted(written.atoms(sp.sin, sp.cos), key=sp.default_sort_key)
    for f in turned:
        for other in (partner(f), -partner(f)):
            yield cast("sp.Expr", written / f * other)
            yield cast("sp.Expr", written.xreplace({f: other}))
    for whole in sorted(written.atoms(sp.Add), key=sp.default_sort_key):
        for x in sp.Add.make_args(whole)[:MOST_SIGNS]:
            yield cast("sp.Expr", written.xreplace({whole: whole - 2 * x}))
    angles = {f.args[0] for f in (written + right).atoms(sp.sin, sp.cos)}
    angles |= {a / 2 for a in angles if cast("sp.Expr", a).as_coeff_Mul()[0].is_even}
    for angle in sorted(angles, key=sp.default_sort_key):
        for f in (sp.sin(angle), sp.cos(angle)):
            for power in (1, 2, -1):
                yield cast("sp.Expr", written * f**power)
