"""What follows from the system alone is made once: repeated runs and ensembles of it only run."""

import threading

import numpy as np
import pytest

import built_in
import lagrangian as lg
from lagrangian.codegen import native
from lagrangian.dynamics.observe import Observed
from lagrangian.quantities import quantity
from lagrangian.simulate import plot
from lagrangian.values import dimensions, values


def pendulum() -> lg.System:
    return built_in.system("pendulum")


WAYS = {
    "rk4": {"method": "rk4", "step": 0.01},
    "gauss4": {"method": "gauss4", "step": 0.01},
    "outputs": {"outputs": {"reach": "max L*sin(theta)"}, "times": 11},
}


def nothing_new(monkeypatch: pytest.MonkeyPatch) -> None:
    """From here on nothing that follows from the model alone may be worked out again."""

    def refuse(*_: object) -> None:
        raise AssertionError("worked out a second time")

    monkeypatch.setattr(native.Loaded, "__init__", refuse)
    monkeypatch.setattr(Observed, "__init__", refuse)
    monkeypatch.setattr(dimensions, "_checked", refuse)
    monkeypatch.setattr(plot, "_angles", refuse)
    monkeypatch.setattr(values, "_groups", refuse)
    monkeypatch.setattr(quantity, "read_quantity", refuse)


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
@pytest.mark.slow
def test_a_second_ensemble_makes_nothing_that_the_first_one_made(monkeypatch: pytest.MonkeyPatch, way: dict) -> None:
    first, other = np.linspace(0.1, 0.4, 9), np.linspace(-0.5, 0.9, 9)
    wanted = pendulum().ensemble(0.5, theta=other, params={"L": 0.7}, **way)
    system = pendulum()
    system.ensemble(0.5, theta=first, params={"L": 0.6}, **way)
    with monkeypatch.context() as patched:
        nothing_new(patched)
        found = system.ensemble(0.5, theta=other, params={"L": 0.7}, **way)
    assert list(found) == list(wanted)
    for name in wanted:
        np.testing.assert_array_equal(found[name], wanted[name])
    assert found.settings == wanted.settings


def test_a_second_run_makes_nothing_that_the_first_one_made(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = pendulum().simulate(0.5, theta=0.7, samples=5).states
    system = pendulum()
    system.simulate(0.5, theta=0.1, samples=5)
    nothing_new(monkeypatch)
    np.testing.assert_array_equal(system.simulate(0.5, theta=0.7, samples=5).states, wanted)


def test_ensembles_of_one_system_in_several_threads_stay_apart() -> None:
    system = pendulum()
    starts = [np.linspace(0.1, 0.2 + k, 5) for k in range(4)]
    wanted = [pendulum().ensemble(0.2, theta=x, method="rk4", step=0.01)["final theta"] for x in starts]
    found: dict[int, np.ndarray] = {}

    def work(k: int) -> None:
        for _ in range(3):
            found[k] = system.ensemble(0.2, theta=starts[k], method="rk4", step=0.01)["final theta"]

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k in range(4):
        np.testing.assert_array_equal(found[k], wanted[k])


def test_what_another_asks_of_the_dimensions_does_not_change_them() -> None:
    model = pendulum().model
    first = dimensions.check_dimensions(model)
    assert first is not None
    kept = dict(first.solved)
    first.solved.clear()
    again = dimensions.check_dimensions(model)
    assert again is not None and again.solved == kept
