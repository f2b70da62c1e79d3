"""Rates of prescribed motions that a program writes out itself, and that are not the derivatives of these.

beta = b0*sin(W*t); dbeta = b0*W*cos(W*t); ddbeta = b0*W^2*sin(W*t)         beta = …, beta'' = b0*W^2*sin(W*t)
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.values import TIME, Shown
from lagrangian.check.reading.names import spelled_rates


def other_rates(run: Evaluator) -> Iterator[tuple[Shown, str]]:
    """The motions and the rates that are not their derivatives, each as what is assigned and its name with primes."""
    given: dict[str, Shown] = {}
    several: set[str] = set()
    for one in run.stated:
        if one.name is None:
            continue
        above = given.setdefault(one.name, one)
        several |= {one.name} if above.value != one.value else set()
    told: set[str] = set()
    for name, one in given.items():
        if name not in run.used or name in several or not _is_motion(run, one):
            continue
        for order, stem in spelled_rates(name):
            of = given.get(stem)
            if of is None or stem in several or not _is_motion(run, of):
                continue
            if bounded.expand(bounded.diff(of.value, *[TIME] * order) - one.value) == 0:
                break
            if stem not in told:
                told.add(stem)
                yield of, stem
            yield one, stem + "'" * order
            break


def _is_motion(run: Evaluator, one: Shown) -> bool:
    """Whether a value is a function of time in the letters of the system alone."""
    value = one.value
    if not isinstance(value, sp.Expr) or TIME not in value.free_symbols or value.atoms(AppliedUndef):
        return False
    return all(run.known(x.name) for x in value.free_symbols if x != TIME and isinstance(x, sp.Symbol))
