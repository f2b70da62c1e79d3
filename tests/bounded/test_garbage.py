"""Garbage is looked for less often while a question is answered, and as before afterwards."""

from __future__ import annotations

import gc
from collections.abc import Iterator

import pytest

from built_in import derivation
from lagrangian import bounded
from lagrangian.bounded import garbage


@pytest.fixture(autouse=True)
def kept() -> Iterator[None]:
    """Sets what Python does with garbage as it was."""
    before, enabled = gc.get_threshold(), gc.isenabled()
    yield
    gc.set_threshold(*before)
    if enabled:
        gc.enable()


@pytest.mark.slow
def test_less_often_within_and_as_before_after_an_error() -> None:
    gc.set_threshold(500, 7, 8)
    with pytest.raises(ValueError, match="inside"), bounded.rarely_collected():
        assert gc.get_threshold() == (garbage.YOUNG, 7, 8)
        with bounded.rarely_collected():
            pass
        assert gc.get_threshold() == (garbage.YOUNG, 7, 8)
        raise ValueError("inside")
    assert gc.get_threshold() == (500, 7, 8)


@pytest.mark.parametrize("own", [(0, 10, 10), (garbage.YOUNG + 1, 10, 10)])
def test_whoever_looks_even_less_often_is_left_alone(own: tuple[int, int, int]) -> None:
    gc.set_threshold(*own)
    gc.disable()
    with bounded.rarely_collected():
        assert gc.get_threshold() == own
        assert not gc.isenabled()
    assert gc.get_threshold() == own
    assert not gc.isenabled()


def test_a_check_leaves_it_as_it_was() -> None:
    gc.set_threshold(600, 10, 10)
    assert derivation("pendulum").check("T = m*l^2*theta'^2/2").status.value
    assert gc.get_threshold() == (600, 10, 10)
