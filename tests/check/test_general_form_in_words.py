"""A general form, M q'' + c = Q, whose entries stand one by one below it is the system of equations that these make.

Oracle: by hand, a pendulum on a cart; see `small_systems`.
"""

from __future__ import annotations

import pytest
from small_systems import pushed_cart

HEAD = "In matrix form **M** q̈ + **c** = **Q** with q = (x, θ):\n"
PLAIN = "Matrix form: M q'' + c = Q, where\n"
ENTRIES = {
    "M₁₁": "M + m",
    "M₁₂ = M₂₁": "m l cos θ",
    "M₂₂": "m l²",
    "c₁": "− m l sin θ θ̇² + k x + b ẋ",
    "c₂": "m g l sin θ",
    "Q₁": "F",
    "Q₂": "F l cos θ",
}


def written(head: str, changed: dict[str, str] | None = None) -> str:
    """The form with its entries, of which some are changed."""
    return head + "".join(f"\n{name} = {value}\n" for name, value in (ENTRIES | (changed or {})).items())


@pytest.mark.parametrize("head", [HEAD, PLAIN])
def test_right_entries_are_right_equations(head: str) -> None:
    verdict = pushed_cart().check(written(head))
    assert verdict.right, verdict
    assert "was not judged" not in str(verdict)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("head", [HEAD, PLAIN])
@pytest.mark.parametrize(
    ("name", "value", "line"),
    [
        ("M₁₁", "M − m", 3),
        ("M₁₂ = M₂₁", "m l sin θ", 5),
        ("M₂₂", "m l", 7),
        ("c₁", "m l sin θ θ̇² + k x + b ẋ", 9),
        ("c₂", "− m g l sin θ", 11),
        ("Q₁", "F cos θ", 13),
        ("Q₂", "F l sin θ", 15),
    ],
)
def test_a_wrong_entry_is_told_at_its_own_line(head: str, name: str, value: str, line: int) -> None:
    verdict = pushed_cart().check(written(head, {name: value}))
    assert not verdict.right
    first = verdict.first_wrong
    assert first is not None and first.line.number == line, verdict


def test_no_force_is_blamed_for_a_mass() -> None:
    verdict = pushed_cart().check(written(HEAD, {"M₁₁": "m"}))
    assert verdict.first_wrong is not None and verdict.first_wrong.line.number in (1, 3), verdict
