"""Every built-in example's equations against Kane's, at random states with random parameters."""

from __future__ import annotations

import pytest
import sympy as sp
from derived import derivation, in_plain_symbols, ours
from kane_route import residual
from kane_systems import oracle
from random_states import states, worst

import built_in
from built_in import CONSTRAINED, FREE, SOME
from lagrangian import examples
from size import rest_slow


def sampled(name: str, count: int = 20):
    model = derivation(name).model
    return states(
        [c.name for c in model.coordinates],
        [p.name for p in model.parameters],
        [u.name for u in model.inputs],
        count=count,
    )


LONG = {"robot-arm", "scara", "spring-net", "acrobot", "ball-and-beam"}


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", rest_slow(FREE, set(FREE) - LONG))
def test_equations_are_kanes(name: str) -> None:
    assert worst(ours(name), oracle(name), sampled(name)) < 1e-10


@pytest.mark.parametrize("name", rest_slow(FREE, set(SOME) - LONG))
def test_matrix_form_is_kanes(name: str) -> None:
    d = derivation(name)
    rates = sp.Matrix([c.rate for c in d.model.coordinates])
    accelerations = sp.Matrix([c.acceleration for c in d.model.coordinates])
    rows = d.mass_matrix * accelerations + d.coriolis_matrix * rates + d.gravity_vector - d.generalized_forces
    written = [in_plain_symbols(d.model.expand(row, constants=True), d) for row in rows]
    assert worst(residual(written, [c.name for c in d.model.coordinates]), oracle(name), sampled(name, 5)) < 1e-10


WRITTEN = [n for n in CONSTRAINED if n not in ("whipple-bicycle", "stewart-platform", "double-parallelogram")]


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", [*FREE, *WRITTEN])
def test_what_was_verified_holds(name: str) -> None:
    checks = derivation(name).verified
    assert checks
    assert all(check.holds for check in checks), [c for c in checks if not c.holds]


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", examples.names())
def test_every_parameter_has_a_value(name: str) -> None:
    assert all(p.value is not None for p in built_in.system(name).model.parameters)
