"""Values whose products are not numbers any more: they are named, and NumPy warns of nothing on the terminal."""

import warnings
from collections.abc import Iterator
from typing import Any

import pytest

import lagrangian as lg

ENORMOUS = lg.example("double-pendulum").to_toml().replace('m1 = { value = "1 kg"', 'm1 = { value = "{} kg"')


@pytest.fixture(autouse=True)
def _no_warning() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def test_a_declared_value_is_named_where_it_is_written() -> None:
    assert ENORMOUS.count("{} kg") == 1
    with pytest.raises(lg.Error, match="parameter 'm1' is too large to compute with: 1e\\+308") as said:
        lg.loads(ENORMOUS.replace("{}", "1e308"))
    assert said.value.code == "E101"
    with pytest.raises(lg.ModelError, match="'m' is too large"):
        lg.System("x").parameter("m", -2e150)


@pytest.mark.parametrize("values", [{"m1": 1e308}, {"m1": "1e308 kg"}, [1e308, 1, 1, 1, 9.81]])
def test_a_value_of_one_call_is_named(values: Any) -> None:
    system = lg.example("double-pendulum")
    for verb in (system.equilibria, system.linearize, lambda params: system.simulate(1.0, params=params)):
        with pytest.raises(lg.RunError, match="parameter 'm1' is too large to compute with: 1e\\+308"):
            verb(params=values)


def test_forces_of_any_size_below_the_limit_balance_at_the_same_places() -> None:
    """Only the direction of the forces counts: the rods hang or stand whatever the bobs weigh."""
    system = lg.example("double-pendulum")
    usual = [e.at for e in system.equilibria(params={"m1": 1.0, "m2": 1.0})]
    assert len(usual) == 4
    assert [e.at for e in system.equilibria(params={"m1": 1e60, "m2": 1e60})] == usual


def test_forces_too_large_for_a_search_are_an_error_and_not_no_force() -> None:
    system = lg.example("double-pendulum")
    with pytest.raises(lg.RunError, match="nowhere in the box finite and below 1e\\+100: parameter 'm1' is 1e\\+149"):
        system.equilibria(params={"m1": 1e149, "m2": 1e149})


@pytest.mark.slow
@pytest.mark.parametrize("mass", ["1e149", "1e-149"])
def test_the_largest_and_smallest_masses_are_verified_without_a_warning(mass: str) -> None:
    system = lg.loads(ENORMOUS.replace("{}", mass))
    checks = system.derive().verify()
    assert checks and all(check.holds is not False for check in checks)
    assert "θ̈" in system.derive(form="structured").to_text()
