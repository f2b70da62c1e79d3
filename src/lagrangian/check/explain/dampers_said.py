"""Which damper has the wrong share in a generalized force that an answer states: its velocity and its arm are named."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.quantities import Sayable
from lagrangian.model import Damper
from lagrangian.page.formula import Left
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class DamperShare:
    """The share of one damper in a generalized force: what it is, what is written, and how a sentence ends."""

    of: Sayable
    right: sp.Expr
    written: sp.Expr
    ending: tuple[str | Left, ...]


def damper_share(s: Ingredients, q: Sayable, written: sp.Expr) -> DamperShare | None:
    """The one damper of which all that is wrong in a generalized force may be; None if it is not there at all, or only
    has another sign or number."""
    i = next((i for i, c in enumerate(s.coordinates) if c.name == q.coordinate), None)
    if q.kind != "Xi" or i is None or bounded.expand(q.right - s.Xi[i]) != 0:
        return None
    found = [x for d in s.acting if isinstance(d, Damper) and (x := _share(s, q, d, i, written)) is not None]
    return found[0] if len(found) == 1 else None


def _share(s: Ingredients, q: Sayable, d: Damper, i: int, written: sp.Expr) -> DamperShare | None:
    right = s.shares(d).get(i, sp.S.Zero)
    if d.b is None or right == 0 or not (letters := s.expand(d.b).free_symbols):
        return None
    rate = s.expand(d.rate(s.model))
    own = bounded.expand(written - (q.right - right))
    if own == 0 or not own.free_symbols <= right.free_symbols or not _all_have(letters, own):
        return None
    if bounded.cancel(own / right).is_number:
        return None
    ending: Sequence[str | Left] = ("; its velocity is ", rate, ", and its arm is ", bounded.diff(rate, s.v[i]), ".")
    words = (f"share of {d.title} in the ", *q.words)
    return DamperShare(replace(q, words=words, owner=d), right, own, tuple(ending))


def _all_have(letters: set[sp.Basic], expr: sp.Expr) -> bool:
    """Whether every term holds the letters of the damper."""
    return all(letters <= x.free_symbols for x in sp.Add.make_args(expr))
