"""Lines that are very long when multiplied out are judged, and no list of their terms is made."""

from __future__ import annotations

import pytest

import built_in
from lagrangian.check import difference
from lagrangian.check.verb import check_answer

ANSWER = "theta'' = -g/L*tan(theta)*cos(theta) - 2*b/(m*L^2)*theta'/(1 + tan(theta)^2)/cos(theta)^2"


def test_terms_of_functions_in_other_forms_are_listed_up_to_a_length(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[int] = []
    in_any_form = difference._in_any_form
    monkeypatch.setattr(
        difference, "_in_any_form", lambda *given: seen.append(len(found := in_any_form(*given))) or found
    )
    assert not check_answer(built_in.derivation("pendulum"), ANSWER).right
    assert seen and any(seen)
    seen.clear()
    monkeypatch.setattr(difference, "MOST_ALIKE", 0)
    assert not check_answer(built_in.derivation("pendulum"), ANSWER).right
    assert seen and not any(seen)
