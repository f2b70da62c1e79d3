"""A wrong deflection is quoted as it is squared in the answer: ½ κ (ζ − ρ)² takes it as ζ − ρ, and as nothing else.

Two mistakes in one deflection, a piece left out and a sign, lead to a third one, which is what was written.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.verdict import Mistake, Status, Verdict
from lagrangian.page.formula import text

_TAKEN = re.compile(r"The deflection of (?P<of>.{1,120}) is taken as \Z")
MOST_FACTORS = 400
"""The most factors of a line that are looked at."""


def with_written_deflections(verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, in which a deflection is taken as what is squared, once for every spring."""
    springs = [of for m in verdict.mistakes if (of := _spring(m)) is not None]
    if verdict.hint == 0 or not springs:
        return verdict
    told: list[Mistake] = []
    done = set[str]()
    for m in verdict.mistakes:
        if (of := _spring(m)) is None:
            told.append(m)
        elif of not in done:
            done.add(of)
            told.append(_as_written(m, verdict, several=springs.count(of) > 1))
    return replace(verdict, mistakes=tuple(told))


def _spring(mistake: Mistake) -> str | None:
    """The spring of which words say as what its deflection is taken."""
    parts = mistake.what.parts
    formulas = len(parts) == 5 and all(isinstance(x, sp.Expr) for x in (parts[1], parts[3]))
    found = _TAKEN.match(str(parts[0])) if formulas else None
    return found["of"] if found is not None else None


def _as_written(mistake: Mistake, verdict: Verdict, *, several: bool) -> Mistake:
    """The mistake with the deflection that is written, if that is the only sum of such letters that is squared."""
    parts = mistake.what.parts
    taken, right = cast("tuple[sp.Expr, sp.Expr]", (parts[1], parts[3]))
    found = list(dict.fromkeys(_own(x, verdict) for x in _squared(verdict)))
    if not several and any(_is_same(x, taken) for x in found):
        return mistake
    alike = [x for x in found if letters_in(x) <= letters_in(right) | letters_in(taken) and not _is_same(x, right)]
    alike = [x for x in alike if letters_in(x) & letters_in(right)]
    if len(alike) != 1:
        return mistake
    away = [len(sp.Add.make_args(bounded.expand(sign * alike[0] - right))) for sign in (1, -1)]
    written = alike[0] if away[0] <= away[1] or several else -alike[0]
    return replace(mistake, what=text(parts[0], written, *parts[2:]))


def _is_same(one: sp.Expr, other: sp.Expr) -> bool:
    """Whether two deflections are the same but for the sense in which they are counted."""
    return bounded.expand(one - other) == 0 or bounded.expand(one + other) == 0


def _squared(verdict: Verdict) -> Iterator[sp.Expr]:
    """The sums without rates that are squared in the wrong lines of V and ℒ, as they are written."""
    lines = [f.line for f in verdict.findings if f.status is Status.WRONG and f.line.kind in ("V", "L")]
    factors = [x for line in lines for ways in line.summands for product in ways for x in product]
    for x in factors[:MOST_FACTORS]:
        base, power = x.as_base_exp()
        if power == 2 and base.is_Add and not base.has(sp.Derivative):
            yield base


def _own(expr: sp.Expr, verdict: Verdict) -> sp.Expr:
    """A formula in the coordinates of the answer, where one of these is a sum with one of the system's."""
    table: dict[sp.Expr, sp.Expr] = {}
    for own, value in verdict.change.items():
        for q in letters_in(value):
            factor = bounded.diff(value, q) if q.is_Function else sp.S.Zero
            if factor in (1, -1):
                table[q] = bounded.expand((own - value + factor * q) / factor)
    return bounded.expand(cast("sp.Expr", expr.xreplace(table))) if table else expr
