"""In which rate two sums of rates differ: (R θ̇ − R φ̇)/r for (R θ̇ − (R − r) φ̇)/r is R φ̇ where (R − r) φ̇ belongs.

Where several differ, what carries a body may have been added, or not: ż + e φ̇ of ż + e φ̇ + ṡ for ṡ.
"""

from __future__ import annotations

from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.check.terms.signs import turned
from lagrangian.page.formula import Left


def rates_apart(right: sp.Expr, written: sp.Expr) -> tuple[str | Left, ...]:
    """The part with one rate that is missing, too much or another one, as the end of a sentence; nothing where there is
    one rate alone, or where several differ."""
    rates = sorted(bounded.atoms(right, sp.Derivative) | bounded.atoms(written, sp.Derivative), key=str)
    slopes = {v: (bounded.diff(written, v), bounded.diff(right, v)) for v in rates}
    if len(rates) < 2 or any(x.has(*rates) for pair in slopes.values() for x in pair):
        return ()
    still = dict.fromkeys(rates, sp.S.Zero)
    if bounded.expand(cast("sp.Expr", (written - right).xreplace(still))) != 0:
        return ()
    differ = [v for v, (own, theirs) in slopes.items() if bounded.expand(own - theirs) != 0]
    if len(differ) != 1:
        return ()
    [v] = differ
    own, theirs = slopes[v]
    more = cast("sp.Expr", v * bounded.expand(own - theirs))
    if more in sp.Add.make_args(written):
        own, theirs = more / v, sp.S.Zero
    if bounded.expand(own + theirs) == 0:
        theirs = -own
    elif own.could_extract_minus_sign():
        own, theirs = turned(own), turned(theirs)
    first, *others = term_replaced(cast("sp.Expr", own * v), cast("sp.Expr", theirs * v))[1].parts
    return (": " + str(first)[:1].lower() + str(first)[1:], *cast("list[str | Left]", others))


def carried_apart(right: sp.Expr, written: sp.Expr) -> tuple[str | Left, ...]:
    """What a velocity has too much, or lacks, of rates that the other does not have, as the end of a sentence: what
    carries a body was added, as if the rest were relative to it, or was not, as if that were absolute."""
    for more, whole, said in ((written, right, " is added, as if "), (right, written, " is not added, as if ")):
        every, others = bounded.atoms(more, sp.Derivative), bounded.atoms(whole, sp.Derivative)
        for sign in (1, -1) if others < every else ():
            rest = cast("sp.Expr", bounded.expand(more - sign * whole))
            if rest != 0 and others and bounded.atoms(rest, sp.Derivative) == every - others:
                ending = " were relative to it." if more is written else " were the whole velocity."
                return (": ", sign * rest, said, whole, ending)
    return ()
