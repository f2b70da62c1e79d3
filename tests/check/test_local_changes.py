"""Local changes of a derivation: planted by the reference derivation, they are told, whatever a row is scaled by.

A change is planted by its own effect on the rows, as expressions of the ring; the answer is checked as text of SymPy,
so that neither the numbers nor the search of the pool are used to make it.
"""

from __future__ import annotations

import random
from functools import cache

import numpy as np
import pytest
import sympy as sp

from built_in import derivation
from lagrangian.check.explain import say
from lagrangian.check.explain.changes.change import Site
from lagrangian.check.explain.changes.letters import LetterChanges
from lagrangian.check.explain.changes.pool import Pool, pool_of
from lagrangian.check.explain.changes.ring import ONE, SumRing, plus
from lagrangian.check.explain.changes.slopes import AtomSlopes
from lagrangian.check.reference import truth_of
from lagrangian.check.stated import left_sides, left_values
from lagrangian.check.verb import check_answer
from size import rest_slow

SYSTEMS = ("cart-pole", "double-pendulum", "lecture-3b", "quarter-car")


@cache
def pool(name: str) -> Pool:
    return pool_of(truth_of(derivation(name)))


def rows_with(name: str, effect: Site) -> list[sp.Expr]:
    """The rows of a system with what a change adds, derived by SymPy."""
    p = pool(name)
    truth, ring = p.truth, p.sites.ring
    rows = list(truth.rows)
    extra = left_sides(truth, ring.expr(effect.T) - ring.expr(effect.V))
    for i in range(truth.n):
        if effect.only is None or i in effect.only:
            rows[i] += extra[i]
        rows[i] += ring.expr(effect.rows.get(i, {})) - ring.expr(effect.Xi.get(i, {}))
    return rows


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", SYSTEMS)
def test_sums_keep_their_value_when_they_are_folded(name: str) -> None:
    p = pool(name)
    jets = AtomSlopes(p.truth, p.sites.ring)
    T = plus(*p.sites.translations.values(), *p.sites.rotations.values())
    values = np.einsum("m,mns->ns", [float(c) for c in T.values()], jets.lagrange(list(T)))
    assert np.abs(values - left_values(p.truth, p.truth.T)).max() < 1e-12
    rows = [sum(float(c) * v for c, v in zip(r.values(), jets.values(list(r)), strict=True)) for r in p.sites.rows]
    assert np.abs(np.array(rows) - p.truth.W).max() < 1e-12


def test_sines_and_cosines_are_folded() -> None:
    ring = SumRing(derivation("double-pendulum").model)
    a, b, c = sp.symbols("a b c")
    whole = ring.of(sp.cos(a) * sp.cos(b) * c + sp.sin(a) * sp.sin(b) * c + 3 * sp.sin(c) ** 2 + 3 * sp.cos(c) ** 2)
    assert ring.expr(ring.fold(whole)) == c * sp.cos(a - b) + 3
    assert ring.expr(ring.fold(ring.of(sp.sin(a) * sp.cos(b) - sp.cos(a) * sp.sin(b)))) == sp.sin(a - b)
    assert ring.expr(ring.fold(ring.of(5 * sp.cos(a) ** 2 + 2 * sp.sin(a) ** 2))) == 3 * sp.cos(a) ** 2 + 2
    assert ring.fold({ONE: sp.S.Zero}) == {}  # type: ignore[dict-item]


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", rest_slow(SYSTEMS, {"lecture-3b"}))
def test_one_change_of_every_kind_is_explained(name: str) -> None:
    """What is told has the effect that was planted, under rows that were multiplied and put in another order."""
    p = pool(name)
    source = random.Random(name)
    kinds: dict[str, list[int]] = {}
    for k, possible in enumerate(p.all):
        if possible.change is not None and np.abs(p.W[k]).max() > 1e-6:
            kinds.setdefault(possible.change.kind, []).append(k)
    assert len(kinds) >= 8
    told: list[int] = []
    for kind in sorted(kinds):
        k = source.choice(kinds[kind])
        change = p.all[k].change
        assert change is not None
        symbols = [x.symbol for x in p.truth.model.parameters]
        factors = [source.choice([1, -1, 2, source.choice(symbols)]) for _ in range(p.truth.n)]
        rows = [sp.expand(f * r) for f, r in zip(factors, rows_with(name, change.effect), strict=True)]
        source.shuffle(rows)
        verdict = check_answer(derivation(name), [sp.Eq(r, 0) for r in rows])
        if not verdict.right:  # a letter that stands in every term may be undone by the factors
            told.append(len(verdict.mistakes))
    assert all(told)
    assert told.count(1) >= 0.85 * len(told)


def test_every_kind_has_words() -> None:
    for name in SYSTEMS:
        kinds = {x.change.kind for x in pool(name).all if x.change is not None}
        assert kinds - {"part"} <= set(say.KINDS)
    for kind in say.KINDS.values():
        assert "{right}" not in kind.brief and "{written}" not in kind.brief


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", rest_slow(SYSTEMS, ()))
def test_a_hint_of_level_2_holds_no_term(name: str) -> None:
    """Text and JSON at level 2 contain neither what was done nor a term that differs, for a mistake of every kind."""
    p = pool(name)
    seen: set[str] = set()
    for k in np.argsort(p.cost):
        change = p.all[k].change
        if change is None or change.kind in seen or np.abs(p.W[k]).max() < 1e-6:
            continue
        seen.add(change.kind)
        verdict = check_answer(derivation(name), [sp.Eq(r, 0) for r in rows_with(name, change.effect)], hint=2)
        if verdict.right:
            continue
        told = verdict.to_text() + str(verdict.to_dict())
        for finding in verdict.findings:
            told = told.replace(finding.line.text, "")  # the answer itself
        for mistake in (*verdict.mistakes, *verdict.alternatives):
            assert str(mistake.what) not in told
        for finding in verdict.findings:
            terms = [str(d.term) for d in finding.differences]
            assert not any(term in told for term in terms if len(term) > 6)


PENDULUM_WITH_A_SIGN = """m*r'' - m*r*theta'^2 + k*(r - L_0) - m*g*cos(theta) = 0
m*r^2*theta'' - 2*m*r*r'*theta' + m*g*r*sin(theta) = 0"""


def test_terms_are_told_in_the_scale_of_the_answer() -> None:
    answer = "(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = 0\n"
    answer += "(1+M/m)*x'' + l*cos(theta)*theta'' + l*sin(theta)*theta'^2 + b*x'/m = F/m"
    verdict = check_answer(derivation("cart-pole"), answer)
    told = str(verdict.mistakes[0].what)
    assert told.startswith("The term l*sin(theta)*theta'^2 of the equation of x has the wrong sign")
    assert told.endswith("on the left-hand side it should be -l*sin(theta)*theta'^2.")
    verdict = check_answer(derivation("elastic-pendulum"), PENDULUM_WITH_A_SIGN)
    told = str(verdict.mistakes[0].what)  # a term that is written with a minus
    assert told.startswith("The term -2*m*r*r'*theta' of"), told
    assert told.endswith("should be 2*m*r*r'*theta'.")


def test_lengths_and_ratios_are_known_by_their_units() -> None:
    """Without them no arm, no radius and no gear ratio is ever named as wrong."""
    p = pool("cart-pole")
    letters = LetterChanges(p.sites)
    assert [str(x) for x in letters.lengths] == ["l"] and not p.sites.of.ratios
    kinds = {x.change.kind for x in p.all if x.change is not None}
    assert {"foreign_factor", "divided_by", "arm_added", "inertia_form"} <= kinds
