"""Random single mistakes in printed equations are found, and what is told of them is true, as SymPy alone sees it.

`tools/mutations.py` does the same with thousands, and prints figures.
"""

from __future__ import annotations

from collections import Counter

import pytest
from mutation_judge import judged

import size
from built_in import derivation
from lagrangian.check import Status
from lagrangian.check.verb import check_answer
from mutations import Mutator

FEW = ("lecture-3b", "pendulum")
MANY = (
    *FEW,
    "cart-pole",
    "lecture-1",
    "double-pendulum",
    "elastic-pendulum",
    "two-disk-shaft",
    "wedge",
    "segway",
    "quarter-car",
)


def told(name: str, count: int, seed: str) -> Counter[str]:
    """What is told of some mutations of an example, counted; every one is found."""
    mutator, found = Mutator(derivation(name), seed), Counter[str]()
    for _ in range(count):
        mutation = mutator.mutation()
        verdict = check_answer(derivation(name), mutation.lines)
        if verdict.status is Status.OTHER_COORDINATES:  # of V alone, an angle may be counted from anywhere
            assert mutation.kind != "equation", mutation
            continue
        assert verdict.status is Status.WRONG, mutation
        kind = judged(mutator, mutation, verdict)
        assert kind != "false", f"{mutation}: {verdict.mistakes[0].what}"
        found[kind] += 1
    return found


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", FEW)
def test_a_few_mutations_are_found_and_nothing_false_is_told(name: str) -> None:
    assert told(name, 6, "few")["nothing"] <= 1


@pytest.mark.slow
def test_many_mutations_are_found_and_named() -> None:
    count = 12 if size.EVERY else 4
    found = sum((told(name, count, "many") for name in MANY), Counter[str]())
    assert found["nothing"] + found["two"] <= 0.05 * found.total()
