"""Derivations in named quantities of systems with constraints, dry friction and energies that were given."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian.derivation import verify_lines
from lagrangian.errors import ModelError
from lagrangian.structured.derive import derive_structured

PROOFS = 6
"""The checks that hold identically where there are constraints: those without any, and the rows."""


def held(derivation: Any) -> bool:
    checks = verify_lines(derivation, states=3, seed=2)
    return all(c.holds for c in checks) and sum("prime field" in c.figure for c in checks) >= PROOFS


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "chaplygin-sleigh", "rolling-disc", "ladder"])
def test_every_line_is_proved_with_its_rows(name: str) -> None:
    d = derive_structured(built_in.system(name).model)
    assert held(d) and len(d.constraint_equations) == len(d.multipliers) > 0


@pytest.mark.parametrize("name", ["four-bar", "chaplygin-sleigh"])
def test_equations_and_rows_are_those_of_the_expanded_form(name: str) -> None:
    """Each equation's left minus right, and each ċ, at random numbers: two derivations that share no formula."""
    one, other = built_in.derivation(name), built_in.system(name).derive(form="structured")
    rng = np.random.default_rng(4)
    model = one.model
    values: dict[Any, float] = {p.symbol: rng.uniform(0.5, 1.5) for p in model.parameters}
    values |= {u.symbol: rng.uniform(-1, 1) for u in model.inputs}
    values |= {row.symbol: rng.uniform(-1, 1) for row in one.multipliers.values()}
    for c in model.coordinates:
        values |= {c.acceleration: rng.uniform(-1, 1), c.rate: rng.uniform(-1, 1), c.symbol: rng.uniform(-1, 1)}
    ordered = dict(sorted(values.items(), key=lambda x: -x[0].count_ops() if x[0].args else 0))

    def value(expr: sp.Expr, known: dict[Any, float]) -> float:
        derivatives = sorted((x for x in known if isinstance(x, sp.Derivative)), key=lambda x: -x.derivative_count)
        for x in derivatives:
            expr = expr.xreplace({x: known[x]})
        return float(expr.xreplace(known))

    named = dict(ordered)
    for symbol, meaning in other.cse[0]:
        named[symbol] = value(meaning, named)
    for mine, theirs in zip(other.equations, one.equations, strict=True):
        assert abs(value(mine.lhs - mine.rhs, named) - value(theirs.lhs - theirs.rhs, ordered)) < 1e-12
    for mine, theirs in zip(other.multipliers.values(), one.multipliers.values(), strict=True):
        assert abs(value(mine.second_rate, named) - value(theirs.second_rate, ordered)) < 1e-12


@pytest.mark.slow
def test_a_wrong_row_and_a_wrong_force_of_a_row_are_found() -> None:
    d = derive_structured(built_in.system("four-bar").model)
    name, row = next(iter(d.multipliers.items()))
    wrong = dataclasses.replace(row, second_rate=2 * row.second_rate)
    broken = dataclasses.replace(d, multipliers={**d.multipliers, name: wrong})
    missed = [str(c.what) for c in verify_lines(broken, states=3, seed=1) if not c.holds]
    assert len(missed) == 1 and "rate of c" in missed[0]
    first = d.equations[0]
    turned = sp.Eq(first.lhs, -first.rhs, evaluate=False)
    broken = dataclasses.replace(d, equations=(turned, *d.equations[1:]))
    assert not verify_lines(broken, states=3, seed=1)[0].holds


def test_a_term_of_a_row_has_its_constraint_as_its_origin() -> None:
    d = built_in.system("chaplygin-sleigh").derive(form="structured")
    lam = next(iter(d.multipliers.values())).symbol
    assert lam in d.equations[0].rhs.free_symbols | d.equations[0].rhs.atoms(sp.Function)
    origins = [o for o in d.where(d.equations[0].rhs) if o.step == 4]
    assert [o.element.name for o in origins] == ["knife edge"]
    assert any(t.kind == "constraint" for t in d.terms[0])


def test_dry_friction_and_given_energies_have_a_structured_form() -> None:
    s = lg.System("belt")
    x, y = s.coordinates("x y")
    m, k, mu, N = s.parameters("m k mu N", m=1, k=2, mu=0.2, N=3)
    for q in (x, y):
        s.particle(m, at=s.origin + (q, 0))
    s.spring(k, deflection=x - y)
    s.friction(mu=mu, normal=N, deflection=x)
    s.kinetic(m * x.diff() ** 2 * (1 + sp.cos(y)), name="more")
    d = s.derive(form="structured")
    assert all(c.holds for c in d.verified)
    assert sp.sign(x.diff()) * mu * N in (-d.equations[0].rhs, d.equations[0].rhs)
    text = d.to_text()
    assert "was given" not in text or "more" in text
    assert "slips" in text


def test_friction_that_a_constraint_presses_on_has_a_structured_form() -> None:
    """m ẍ = −N sin α − μ |N| sgn(ṡ) cos α on a rough incline, and N in place of the weight across it."""
    s = lg.System("rough incline")
    x, y = s.coordinates("x y")
    m, mu, alpha = s.parameters("m mu alpha", m=1, mu=0.2, alpha=0.3)
    s.particle(m, at=s.origin + (x, y))
    s.gravity()
    s.constraint(y * sp.cos(alpha) - x * sp.sin(alpha), name="rod")
    s.friction(mu, pressed_by="rod", deflection=x * sp.cos(alpha) + y * sp.sin(alpha), name="rough")
    d = s.derive(form="structured")
    assert all(c.holds for c in d.verified)
    N, speed = d.multipliers["rod"].symbol, x.diff() * sp.cos(alpha) + y.diff() * sp.sin(alpha)
    force = -mu * sp.Abs(N) * sp.sign(speed)
    right = [force * sp.cos(alpha) - N * sp.sin(alpha), force * sp.sin(alpha) + N * sp.cos(alpha)]
    for equation, expected in zip(d.equations, right, strict=True):
        shown = equation.rhs
        for definition in reversed(d.definitions):
            shown = shown.xreplace({definition.symbol: definition.expression})
        assert sp.expand(shown - expected) == 0
    assert [o.element.name for o in d.where(d.equations[0].rhs) if o.step == 6] == ["rough"]
    turned = [dataclasses.replace(x, expression=x.expression.xreplace({mu: -mu})) for x in d.definitions]
    assert not verify_lines(dataclasses.replace(d, definitions=tuple(turned)), states=3, seed=1)[0].holds


def test_an_empty_motion_without_bodies_is_refused() -> None:
    s = lg.System("energies")
    x = s.coordinate("x")
    s.kinetic(x.diff() ** 2)
    with pytest.raises(ModelError, match="its energies were given directly"):
        s.derive(form="structured")


@pytest.mark.slow
def test_the_bicycle_is_derived_and_proved() -> None:
    d = built_in.system("whipple-bicycle").derive()
    assert d.form == "structured" and all(c.holds for c in d.verified)
    assert [str(e.rhs) for e in d.equations[:2]] == ["R_x_rear_contact_out", "R_y_rear_contact_out"]
    assert d.steps[0].expressions["DDOF"] == 3 and "front wheel rolls" in d.to_text()


@pytest.mark.slow
def test_the_stewart_platform_is_derived_and_proved() -> None:
    """Six legs of two bodies on a floating plate: 24 speeds, 18 rows, and six freedoms."""
    d = built_in.system("stewart-platform").derive()
    assert len(d.multipliers) == 18 and all(c.holds for c in d.verified)
    assert d.steps[0].expressions["DDOF"] == d.steps[0].expressions["GC"] == 6
    assert d.constraints is not None and d.constraints.verdict == "holonomic: #GC = #DDOF = 6"
