"""Reduced speeds inside the elimination: two rates are exchanged for the speed along a row and the speed across it.

Where a row holds two rates with the cosine and the sine of one angle, as a blade does, w = c v_j + s v_k and
u = c v_k − s v_j are speeds as good as v_j and v_k:

    v_j = c w − s u        v_k = c u + s w

The row says what w is, with the coefficient 1, so that both the rate and the multiplier follow without a division and
without a pivot that could vanish. A row whose coefficient is a number needs no such exchange (rule 2 of `multipliers`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from lagrangian.dynamics.row_problem import Problem
from lagrangian.dynamics.tape import EliminationTape, Form, is_unit
from lagrangian.dynamics.vectors import rotated

Turned = tuple[int, int, int, int]
"""Two rates, with their coefficients in a row."""


def in_speeds_of_rows(problem: Problem) -> Iterator[Problem]:
    """The problem, and the same in such speeds if a row has them and no rates are exchanged already."""
    yield problem
    found, used = list[Turned](), set[int]()
    for row in problem.rows if not problem.tape.exchanged else ():
        pair = _pair(problem, row.node, used)
        if pair is not None:
            found.append(pair)
            used.update(pair[:2])
    if found:
        tape = EliminationTape(list(problem.tape.order), dict(problem.tape.forms), {}, dict(problem.tape.turned))
        for n, pair in enumerate(found):
            _turn(problem, tape, n, pair)
        yield replace(problem, tape=tape)


def _pair(problem: Problem, node: int, used: set[int]) -> Turned | None:
    """Two rates whose coefficients in a row are a cosine and a sine."""
    form = problem.tape.forms.get(node, {})
    rates = [v for v in form if v in problem.rates and v not in problem.tape.forms and v not in used]
    for n, j in enumerate(rates):
        for k in rates[n + 1 :]:
            if is_unit(problem.graph, form[j], form[k]):
                return j, k, form[j], form[k]
    return None


def _turn(problem: Problem, tape: EliminationTape, n: int, pair: Turned) -> None:
    """Put the speeds w and u before their rates, and into every step in which one of them is left alone."""
    g = problem.graph
    j, k, c, s = pair
    w, u, alone = g.input("turned", 2 * n), g.input("turned", 2 * n + 1), set[int]()
    for i, form in tape.forms.items():
        if j in form or k in form:
            across, along = rotated(g, form.get(k, g.zero), form.get(j, g.zero), c, s)
            if g.zero in (across, along):
                tape.forms[i] = _without(form, j, k) | {x: a for x, a in ((w, along), (u, across)) if a != g.zero}
                alone.add(i)
    tape.turned = {i: pair for i, pair in tape.turned.items() if not alone & {i, pair[0]}}  # no rotations any more
    at = min(tape.order.index(j), tape.order.index(k))
    tape.order = [i for i in tape.order if i not in (j, k)]
    tape.order[at:at] = [w, u, j, k]
    tape.forms[j], tape.forms[k] = {w: c, u: g.neg(s)}, {u: c, w: s}
    tape.turned[k] = (j, w, u, c, g.neg(s))


def _without(form: Form, *gone: int) -> Form:
    return {i: c for i, c in form.items() if i not in gone}
