"""Pictures, animations and stores of sweeps, held against the system: every test plants a fault in one of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import built_in
from lagrangian import dynamics
from lagrangian.model import Model
from lagrangian.picture import Picture
from lagrangian.simulate import animating
from lagrangian.simulate.animation import Animation
from lagrangian.verify import drawn, swept
from lagrangian.verify.states import State, random_states


def states_of(model: Model) -> list[State]:
    return list(random_states(model, dynamics.forward(model), 1, 1))


def held(name: str) -> list[bool | None]:
    model = built_in.system(name).model
    return [check.holds for check in drawn.drawn_checks(model, states_of(model))]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "name", ["cart-pole", "two-carts", "rolling-disc"], ids=["to scale", "not to scale", "in space"]
)
def test_a_picture_and_an_animation_hold(name: str) -> None:
    assert held(name) == [True, True, True]


def test_a_body_that_is_drawn_elsewhere_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    anchors = drawn._anchors
    monkeypatch.setattr(drawn, "_anchors", lambda *given: np.array(anchors(*given)) + 1e-6)
    assert held("pendulum")[0] is False


def cut(written: str) -> str:
    return written.replace("circle cx", "ellipse cx", 1)


def shifted(written: str) -> str:
    at = written.index('values="') + len('values="')
    return f"{written[:at]}3{written[at:]}"


@pytest.mark.parametrize(
    ("kind", "method", "change", "expected"),
    [
        (Picture, "to_svg", cut, [True, False, True]),
        (Picture, "to_tikz", lambda text: text.replace("circle[radius=10]", "circle[radius=11]"), [True, False, True]),
        (Animation, "to_svg", shifted, [True, True, False]),
        (Animation, "to_html", lambda text: text.replace("translate(", "translate(1"), [True, True, False]),
    ],
    ids=["a shape too few", "a radius", "a frame", "the place of all"],
)
def test_a_fault_in_what_is_written_is_found(
    kind: Any, method: str, change: Callable[[str], str], expected: list[bool], monkeypatch: pytest.MonkeyPatch
) -> None:
    write = getattr(kind, method)
    monkeypatch.setattr(kind, method, lambda self: change(write(self)))
    assert held("pendulum") == expected


def test_frames_that_lag_behind_the_run_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    between = animating.hermite
    monkeypatch.setattr(
        animating, "hermite", lambda t, q, rates, wanted: between(t, q, rates, np.maximum(wanted - 0.02, t[0]))
    )
    assert held("pendulum") == [True, True, False]


def test_a_store_of_a_sweep_holds_and_another_number_in_it_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    zarr = pytest.importorskip("zarr")
    model = built_in.system("pendulum").model
    state = states_of(model)[0]
    assert swept.swept_runs(model, state).holds
    sweep = swept.sweep

    def faulty(*given: Any, **named: Any) -> Any:
        made = sweep(*given, **named)
        path: Path = given[4].store
        array = zarr.open_group(path)["theta"]
        array[1, 0, 3] = array[1, 0, 3] + 1e-5
        return made

    monkeypatch.setattr(swept, "sweep", faulty)
    assert swept.swept_runs(model, state).holds is False
