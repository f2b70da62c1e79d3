"""The oracle itself: Kane's equations against results printed in books."""

from __future__ import annotations

import tomllib

import pytest
from closed_forms import FORMS
from kane_systems import SYSTEMS, oracle
from random_states import states, worst

from lagrangian import examples


def described(name: str) -> tuple[list[str], list[str], list[str]]:
    file = tomllib.loads(examples.text(name))
    return list(file["coordinates"]), list(file["parameters"]), list(file.get("inputs", {}))


@pytest.mark.parametrize("name", sorted(FORMS))
def test_kane_gives_what_the_book_prints(name: str) -> None:
    assert worst(FORMS[name], oracle(name), states(*described(name))) < 1e-11


def test_every_example_has_an_oracle() -> None:
    assert set(SYSTEMS) == set(examples.names())
