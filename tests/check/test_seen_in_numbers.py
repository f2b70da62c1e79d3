"""What a look at numbers decides before SymPy searches: it must decide the same."""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import bounded
from lagrangian.check.constraints import without_constraints
from lagrangian.check.explain.misconceptions import damper_other_velocity
from lagrangian.check.explain.misconceptions.base import Ingredients
from lagrangian.check.reference import Reference, truth_of, without_time
from lagrangian.check.rows import differs_somewhere
from lagrangian.model import time


@cache
def truth() -> Reference:
    """A bead on a rod that turns, driven by an input."""
    system = lg.System("bead")
    phi, s = system.coordinates("phi s")
    m, k, b = system.parameters("m k b")
    tau = system.inputs("tau")
    frame = system.frame(phi, name="rod")
    system.particle(m, at=frame.point(s, 0), name="bead")
    system.spring(k, deflection=s)
    system.damper(b, deflection=s)
    system.torque(tau, on=frame)
    return truth_of(system.derive())


PHI, S = (c.symbol for c in truth().model.coordinates)
OWN = sp.Symbol("Omega")
ZEROS = (
    sp.sin(2 * PHI) - 2 * sp.sin(PHI) * sp.cos(PHI),
    OWN * (sp.sin(PHI + S) - sp.sin(PHI) * sp.cos(S) - sp.cos(PHI) * sp.sin(S)),
    (OWN + S) ** 2 - OWN**2 - 2 * OWN * S - S**2,
    S / sp.cos(PHI) ** 2 - S - S * sp.tan(PHI) ** 2,
)


@pytest.mark.parametrize("expr", ZEROS)
def test_what_vanishes_is_not_seen_to_differ(expr: sp.Expr) -> None:
    assert not differs_somewhere(truth(), expr)
    assert without_constraints._is_zero(truth(), expr)


@pytest.mark.parametrize("expr", ZEROS)
def test_what_differs_is_not_multiplied_out(expr: sp.Expr, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sp, "expand_trig", lambda _: pytest.fail("multiplied out"))
    for other in (expr + sp.Rational(1, 1000), expr + OWN * sp.sin(PHI), expr - S.diff(time, 2)):
        assert differs_somewhere(truth(), other)
        assert not without_constraints._is_zero(truth(), other)


def test_what_numbers_cannot_say_is_left_to_sympy() -> None:
    nowhere = sp.log(-(sp.Symbol("a", positive=True) ** 2))
    unworked = sp.Derivative(PHI**2, time) - 2 * PHI * PHI.diff(time)
    for expr in (nowhere, unworked, sp.zeta(S)):
        assert not differs_somewhere(truth(), expr)


@pytest.mark.slow
def test_sines_that_cancel_are_those_that_sympy_finds() -> None:
    ingredients = Ingredients(truth().derivation)
    beta, r = sp.symbols("beta r", real=True)
    one = sp.sin(beta) ** 2 + sp.cos(beta) ** 2 * sp.sin(PHI) ** 2 + sp.cos(beta) ** 2 * sp.cos(PHI) ** 2
    arm = (r * sp.cos(PHI) - S * sp.sin(PHI)) * sp.cos(PHI) + (r * sp.sin(PHI) + S * sp.cos(PHI)) * sp.sin(PHI)
    left = sp.sin(PHI) * sp.cos(S) + sp.cos(PHI) * sp.sin(S)
    for expr in (one, arm, left, sp.S.Zero):
        assert damper_other_velocity._without_turning(ingredients, expr) == bounded.trigsimp(expr)


def test_what_time_alone_adds_to_an_energy() -> None:
    k, drive = sp.Symbol("k"), sp.sin(3 * time)
    moving = k * S**2 / 2
    assert without_time(truth(), moving) is moving
    assert without_time(truth(), moving + k * drive) == moving
    assert without_time(truth(), k * (S - drive) ** 2 / 2) == bounded.expand(moving - k * S * drive)
    for u in truth().model.inputs:
        assert without_time(truth(), moving + u.symbol) == moving
