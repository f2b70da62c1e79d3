"""A definition in which a term is wrong that shows in the balance in which its name stands: a_u = ẍ − e φ̈ sin φ, and
m a_u = P − m g sin α.

The balance as it is written holds neither e nor φ: no such term can be missing there, it is missing in what a_u is.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.apart import told_apart
from lagrangian.check.explain.quantities import Effect, Sayable, quantities_of
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.said_wrongly import InWords, SaidWrongly
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, TermDifference
from lagrangian.page.formula import text
from lagrangian.read.letters import key

WHY_TWICE = text(
    "The acceleration is the second derivative of the position: by the product rule each factor that moves has its "
    "turn."
)
LONGEST = 60
"""The most operations of such a definition, and of the term."""


def slips_in_definition(
    truth: Reference, line: AnsweredLine, differences: Sequence[TermDifference], symbol: sp.Expr, own: AnsweredLine
) -> Iterator[SaidWrongly]:
    """The value of a name with which a balance is right, if one term of it differs that the balance itself cannot have.

    ``line`` defines the name, whose ``symbol`` stands in the balance ``own``, which has one of the ``differences``.
    """
    if len(differences) != 1 or bounded.operations(line.expr) > LONGEST or not line.expr.has(sp.Derivative):
        return
    factor = bounded.diff(own.expr, symbol)
    if factor == 0 or factor.has(symbol, sp.Derivative):
        return
    (d,) = differences
    more = bounded.expand(cast("sp.Expr", sp.cancel((truth.expand(d.term) - truth.expand(d.written)) / factor)))
    if more.is_Add or bounded.operations(more) > LONGEST or sp.fraction(more)[1] != 1:
        return
    if not _names(more) - {key(x) for x in own.names}:
        return
    right = bounded.expand(truth.expand(line.expr) + more)
    s = quantities_of(truth).of
    of = Sayable("component", None, (f"value of {line.name}",), right, lambda _: Effect())
    letters = frozenset(letters_in(right) | letters_in(line.expr))
    why = WHY_TWICE if any(x.derivative_count > 1 for x in right.atoms(sp.Derivative)) else None
    words = InWords(of, (right,), (line.expr,), letters, told_apart(s, right, line.expr), why)
    yield SaidWrongly(line, Effect(), lambda: words, right=right)


def _names(term: sp.Expr) -> set[str]:
    """The keys of the letters, coordinates and inputs in a term."""
    letters = cast("set[Any]", letters_in(term))
    return {key(str(x.func)) if x.args else key(str(x)) for x in letters}
