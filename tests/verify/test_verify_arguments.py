"""How often and from where `verify` draws states: whole numbers, or a word about it."""

import pytest

import built_in
import lagrangian as lg
from lagrangian import RunError


@pytest.fixture(scope="module")
def pendulum() -> lg.System:
    return built_in.system("pendulum")


@pytest.mark.parametrize("seed", ["a", None, 1.5, -1, True])
def test_a_seed_is_a_whole_number(pendulum: lg.System, seed) -> None:
    with pytest.raises(RunError, match="seed must be a whole number, 0 or more"):
        pendulum.verify(seed=seed)


@pytest.mark.parametrize("states", ["a", 0, 2.5, 10**9])
def test_states_are_counted(pendulum: lg.System, states) -> None:
    with pytest.raises(RunError, match="states must be a whole number, 1 to 1000000"):
        pendulum.verify(states=states)
    with pytest.raises(RunError, match="states must be"):
        pendulum.derive().verify(states=states)
