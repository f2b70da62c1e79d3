"""Values whose products are not numbers any more: they are named, and NumPy warns of nothing on the terminal."""

import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from sympy import Rational

import built_in
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


def test_a_number_written_into_a_description_is_named() -> None:
    system = lg.System("x")
    x = system.coordinates("x")
    with pytest.raises(lg.ModelError, match=r"the mass of particle holds a number that is too large .*: 1e\+308"):
        system.particle(1e308, at=system.origin + (x, 0))
    with pytest.raises(lg.ModelError, match="holds a number that is too large"):
        system.spring(Rational(10) ** 151, deflection=x)


CALLS = ("forward", "inverse", "mass_matrix", "bias", "energy", "derivatives")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("method", CALLS)
def test_parameters_of_compiled_calls_are_bounded_like_declared_ones(method: str) -> None:
    compiled = built_in.system("cart-pole").compile()
    p = np.array([q.value for q in built_in.system("cart-pole").model.parameters], float)
    given = {"inverse": 3, "mass_matrix": 1}.get(method, 2) * [[0.1, 0.2]]
    call, enormous = getattr(compiled, method), p.copy()
    enormous[1] = -2e150
    each = np.tile(p, (9, 1))
    each[7] = enormous
    for states in (given, [np.tile(x, (9, 1)) for x in given]):  # the first call of a kind, and the quick way
        for kept in (p, [*p.tolist()]):
            call(*states, p=kept)
        for refused in (enormous, enormous.tolist(), {"m": -2e150}):
            with pytest.raises(lg.RunError, match="parameter 'm' is too large to compute with: -2e\\+150"):
                call(*states, p=refused)
    many = [np.tile(x, (9, 1)) for x in given]
    for _ in range(2):
        call(*many, p=np.tile(p, (9, 1)))
        with pytest.raises(lg.RunError, match=r"parameter 'm' is too large .* at state 7"):
            call(*many, p=each)


def test_states_and_inputs_explain_a_result_that_is_no_number() -> None:
    compiled = built_in.system("cart-pole").compile()
    for given, said in (
        (([0, 0.1], [0, 1e200], [0]), "velocity 'theta''"),
        (([0, 0.1], [0, 0], [1e308]), "input 'F'"),
    ):
        many = [np.tile(np.array(x, float), (9, 1)) for x in given]
        for arguments in (given, many):
            with pytest.raises(lg.RunError, match=f"{said} is too large to compute with"):
                compiled.forward(*arguments)


@pytest.mark.parametrize(
    "given",
    [
        {"theta": 1e308},
        {"initial": {"theta'": 1e200}},
        {"inputs": {"F": -1e308}},
        {"inputs": {"F": "1e200"}},
        {"inputs": {"F": ([0, 1], [0, 1e200])}},
    ],
)
def test_a_run_names_what_it_cannot_start_with(given: dict[str, Any]) -> None:
    system = built_in.system("cart-pole")
    with pytest.raises(lg.Error, match="is too large to compute with"):
        system.simulate(0.1, **given)
    if "inputs" not in given or given["inputs"]["F"] == -1e308:
        with pytest.raises(lg.RunError, match="is too large to compute with"):
            system.ensemble(0.1, **{**given, "params": {"m": [0.1, 0.2]}})


def test_arrays_of_an_ensemble_are_bounded() -> None:
    with pytest.raises(lg.RunError, match="'m' is too large to compute with: 1e\\+151"):
        built_in.system("cart-pole").ensemble(0.1, params={"m": [1, 1e151]})


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
    told = [str(check.what) for check in checks if check.holds is False]
    if mass == "1e149":
        assert checks and not told
    else:  # 1/m is a factor of the tensions: derivatives by m lose all digits, which is told and not passed over
        assert all("pullback" in what for what in told) and len(told) <= 2 < len(checks)
    assert "θ̈" in system.derive(form="structured").to_text()
