"""The oracle itself: Kane's equations against results printed in books."""

from __future__ import annotations

import tomllib

import pytest
from kane_route import residual
from kane_systems import SYSTEMS, oracle
from random_states import states, worst
from textbook import BOOK, sides

from built_in import FREE, SOME
from lagrangian import examples


def described(name: str) -> tuple[list[str], list[str], list[str]]:
    file = tomllib.loads(examples.text(name))
    return list(file["coordinates"]), list(file["parameters"]), list(file.get("inputs", {}))


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", sorted(BOOK))
def test_kane_gives_what_the_book_prints(name: str) -> None:
    coordinates, parameters, inputs = described(name)
    printed = residual([left - right for left, right in sides(name)], coordinates)
    assert worst(printed, oracle(name), states(coordinates, parameters, inputs)) < 1e-11


def test_every_example_without_constraints_has_an_oracle() -> None:
    assert set(SYSTEMS) == set(FREE)
