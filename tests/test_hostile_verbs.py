"""Random hostile model files through every verb: an answer or a word about it, after a bounded number of calls."""

from collections.abc import Callable
from pathlib import Path

import pytest

import built_in
import lagrangian as lg
from effort import at_most
from hostile_answers import answer
from hostile_models import KINDS, LONGEST, model
from lagrangian.bounded import questions
from lagrangian.cli import main
from lagrangian.worksheet.sides import moves
from size import rest_slow

STEPS = 250_000
"""Calls after which a question about hard expressions is given up here; it is 6 000 000 for users."""

CALLS = 40_000_000
"""Calls of Python functions that a verb may take in all: some twenty seconds for users."""

VERBS = {
    "derive": ["derive", "FILE"],
    "verify": ["verify", "FILE", "--states", "5"],
    "check": ["check", "FILE", "ANSWER"],
    "compare": ["compare", "FILE", "FILE"],
    "linearize": ["linearize", "FILE", "--operating-point"],
    "symbols": ["linearize", "FILE", "--symbols"],
    "equilibria": ["equilibria", "FILE"],
    "conserved": ["conserved", "FILE"],
    "export": ["export", "FILE", "--to", "c", "-o", "OUT"],
    "simulate": ["simulate", "FILE", "-d", "1"],
    "animate": ["animate", "FILE", "-d", "1", "-o", "-"],
    "sweep": ["sweep", "FILE", "m=1:2:2", "-d", "0.5", "--threads", "1"],
}
METHODS: dict[str, Callable[[lg.System], object]] = {
    "hamiltonian": lambda system: system.hamiltonian(),
    "routhian": lambda system: system.routhian(),
    "in_coordinates": lambda system: system.in_coordinates({"q0": "q0b^3 + q0b"}).derive(),
    "linearize_along": lambda system: system.linearize_along(system.simulate(0.2)),
    "to_toml": lambda system: system.to_toml(),
}
SEEDS = {0: 2 * STEPS, 4: STEPS // 2, 5: STEPS // 2, 8: 2 * STEPS, 13: STEPS // 2, 100: 2 * STEPS, 105: STEPS // 2}
"""With the steps of a question: 0, 8 and 100 are derived, the others are given up after many more, too."""
JOINTED = (203, 208, 209)
"""Links with joints and friction, of which only the shortest questions are asked here."""
ANSWERS = range(40)


@pytest.fixture(autouse=True)
def fewer_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(questions, "QUESTION", STEPS)


def check_ends(seed: int, verb: str, folder: Path) -> None:
    """Exit 0, 1 or 2 within the calls; an exception that no verb expects fails by itself."""
    if verb in METHODS:
        with at_most(CALLS):
            try:
                METHODS[verb](lg.loads(model(seed)))
            except lg.Error as error:
                assert error.code
        return
    file, answer = folder / "hostile.toml", folder / "answer.txt"
    file.write_text(model(seed), encoding="utf-8")
    answer.write_text("m*q0'' + k*q0 = F\n", encoding="utf-8")
    put = {"FILE": str(file), "ANSWER": str(answer), "OUT": str(folder)}
    with at_most(CALLS):
        assert main([put.get(word, word) for word in VERBS[verb]]) in (0, 1, 2)


def test_hostile_files_are_small_and_the_same_everywhere() -> None:
    assert all(len(model(seed).encode()) <= LONGEST for seed in (*range(3 * len(KINDS)), *SEEDS, *JOINTED))
    assert model(7) == model(7)


@pytest.mark.parametrize("verb", ["equilibria", "to_toml"])
@pytest.mark.parametrize("seed", rest_slow(JOINTED, {209}))
def test_joints_and_friction_end_a_question_too(seed: int, verb: str, tmp_path: Path) -> None:
    check_ends(seed, verb, tmp_path)


@pytest.mark.thinned(5)
@pytest.mark.slow
@pytest.mark.parametrize("verb", [*VERBS, *METHODS])
@pytest.mark.parametrize("seed", SEEDS)
def test_every_verb_ends_on_a_hostile_file(
    seed: int, verb: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(questions, "QUESTION", SEEDS[seed])
    check_ends(seed, verb, tmp_path)


HOOP = """
name = "hoop"
coordinates = { q = "", w = "" }
parameters = { m = 1, a = 1, b = 1.5, c = 0.3, d = 0.4, e = 0.7, k = 2 }
frame = [{ name = "f", angle = "-q/d" }]
rigid_body = [{ mass = "m", inertia = "m*(a+b+c+d+e)^60*d^2", at = ["q", "d"], frame = "f" }]
particle = [{ mass = "m", at = ["0", "w"] }]
spring = [{ k = "k", deflection = "q - (a+b+c+d+e)^60*w" }, { k = "k", deflection = "q - w" }]
"""


def test_pictures_and_variants_of_long_constants_end() -> None:
    """Whether a wheel is a hoop, and two springs lie beside each other, was asked of sums written out: for minutes."""
    system = lg.loads(HOOP)
    with at_most(3_000_000):
        assert system.look().to_svg()
        assert moves(system.model) == []


FURUTA = built_in.system("furuta-pendulum")


def check_answered(seed: int) -> None:
    """A verdict, or a refusal with its code, after a bounded number of calls."""
    model = FURUTA.model
    text = answer(seed, [c.name for c in model.coordinates], [p.name for p in model.parameters])
    with at_most(CALLS):
        try:
            assert FURUTA.check(text).to_text()
        except lg.Error as error:
            assert error.code


@pytest.mark.thinned(5)
@pytest.mark.sampled(3)
@pytest.mark.parametrize("seed", rest_slow(ANSWERS, {1, 7, 10}))
def test_a_hostile_answer_is_judged_or_refused(seed: int) -> None:
    """7: products of values above 1e300."""
    check_answered(seed)
