"""Mistakes that are made in the derivation, where people make them, are told first and as what they are.

The wrong equations come from `physical_mistakes`, which derives them by SymPy alone and knows nothing of the checker.
"""

from __future__ import annotations

import random
import re
from functools import cache

import physical_systems
import pytest
import sympy as sp
from physical import Link, Mechanism
from physical_mistakes import Planted, planted

import lagrangian as lg
import size
from lagrangian.check import Status
from lagrangian.model import time as t
from lagrangian.page.plain import plain


@cache
def mechanism(name: str) -> tuple[Mechanism, lg.Derivation]:
    m: Mechanism = getattr(physical_systems, name)()
    return m, m.model()


def written(m: Mechanism, made: Planted, style: str) -> str:
    """The wrong answer as text: equations alone, with their accelerations collected, or below T, V and every Ξ."""
    rows = [sp.expand(r) for r in made.rows]
    if style == "collected":
        rows = [sp.collect(r, [sp.diff(p, t, 2) for p in m.q]) for r in rows]
    lines = [f"{plain(r)} = 0" for r in rows]
    if style == "energies" and made.steps is not None:
        forces = [f"Xi_{plain(p)} = {plain(sp.expand(made.steps.Xi(p)))}" for p in m.q]
        lines = [f"T = {plain(sp.expand(made.steps.T))}", f"V = {plain(sp.expand(made.steps.V))}", *forces, *lines]
    return "\n".join(lines)


def is_told(made: Planted, mistake: object) -> bool:
    """Whether the words of a mistake speak of the element that was changed, and of what was done to it."""
    words, element = str(mistake.what), mistake.element or ""  # type: ignore[attr-defined]
    where = [e for e in made.elements if f"'{e}'" in words or f"'{e}'" in element]
    of_weight = "gravity" in element and ("weight" in made.kind or "height" in made.kind)
    return bool(not element or where or of_weight) and bool(re.search(made.words, words))


def is_wrong(m: Mechanism, made: Planted) -> bool:
    """Whether the equations change: those of the change of T, V and Ξ, in which Lagrange's operator is linear."""
    right = m.steps()
    if made.steps is None:
        return any(sp.expand(a - b) != 0 for a, b in zip(made.rows, right.rows(), strict=True))
    T, V = sp.expand(made.steps.T - right.T), sp.expand(made.steps.V - right.V)
    for p in m.q:
        inertia = sp.diff(sp.diff(T, sp.diff(p, t)), t) - sp.diff(T, p)
        if sp.expand(inertia + sp.diff(V, p) - made.steps.Xi(p) + right.Xi(p)) != 0:
            return True
    return False


def sampled(name: str, count: int, seed: str) -> tuple[int, list[str]]:
    """How many of some mistakes were told first and alone; the others in words. None is accepted."""
    m, derivation = mechanism(name)
    every = [x for x in planted(m) if is_wrong(m, x)]
    chooser = random.Random(f"{name} {seed}")
    missed: list[str] = []
    chosen = chooser.sample(every, min(count, len(every)))
    for made in chosen:
        text = written(m, made, chooser.choice(["plain", "collected", "energies"]))
        verdict = derivation.check(text)
        assert verdict.status is Status.WRONG, f"{name}: {made}\n{text}"
        if len(verdict.mistakes) != 1 or not is_told(made, verdict.mistakes[0]):
            missed.append(f"{made}: {[str(x.what) for x in verdict.mistakes]}")
    return len(chosen) - len(missed), missed


@pytest.mark.slow
def test_a_few_physical_mistakes_are_told_first() -> None:
    first, missed = sampled("hoist", 4, "few")
    assert first == 4, missed


@pytest.mark.slow
def test_many_physical_mistakes_are_told_first() -> None:
    counted = [
        sampled(f.__name__, 10 if size.EVERY else 5, "many")
        for f in physical_systems.EVERY
        if f.__name__ not in ("car", "chain")
    ]
    missed = [x for _, more in counted for x in more]
    assert len(missed) <= 0.06 * sum(first + len(more) for first, more in counted), missed


def only(name: str, made: Planted, style: str) -> tuple[str, str]:
    """The kind and the words of the one mistake that is told."""
    m, derivation = mechanism(name)
    (mistake,) = derivation.check(written(m, made, style)).mistakes
    return mistake.name, str(mistake.what)


def of_kind(name: str, kind: str) -> Planted:
    return next(x for x in planted(mechanism(name)[0]) if kind in str(x))


@pytest.mark.slow
def test_a_slip_in_a_position_that_shows_in_T_and_in_V_is_one_mistake() -> None:
    made = of_kind("pulleys", "sign of -y(t) in the position of stone")
    kind, words = only("pulleys", made, "energies")
    assert kind == "piece_sign" and "In the position of particle 'stone'" in words


@pytest.mark.slow
def test_a_force_in_the_wrong_equation_is_one_mistake_beside_its_Xi() -> None:
    kind, words = only("slider", of_kind("slider", "for r(t) instead of motor"), "energies")
    assert kind in {"share_moved", "force_wrong_equation"} and "'motor'" in words


@pytest.mark.slow
def test_a_relative_angle_taken_for_an_absolute_one_is_told() -> None:
    made = of_kind("arm", "b(t) for a(t) + b(t) in the position of fore")
    kind, words = only("arm", made, "plain")
    assert kind == "angle" and "b stands in place of a + b" in words


@pytest.mark.slow
def test_half_of_the_products_of_rates_is_one_mistake() -> None:
    _, words = only("arm", of_kind("arm", "half the mixed products in v² of fore"), "plain")
    assert "half" in words and "'fore'" in words


def strut() -> Mechanism:
    """A mass on a spring and a damper that stand side by side on a lever of the ratio n."""
    s = lg.System("strut")
    x, y = s.coordinates("x y")
    m, M, n, k, c, K = s.parameters("m M n k c K")
    s.particle(m, at=s.origin + (x, 0), name="m")
    s.particle(M, at=s.origin + (y, 0), name="M")
    along = y - n * x
    return Mechanism(
        "strut", (x, y), springs={"k": Link(k, along), "K": Link(K, x)}, dampers={"c": Link(c, along)}, system=s
    )


STRUT = "m*x'' + K*x - n*k*(y - n*x) - n*c*(y' - n*x') = 0\nM*y'' + k*(y - n*x) + c*(y' - n*x') = 0"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("old", "new", "kind"),
    [
        ("(y - n*x)", "(y + n*x)", "deflection_sign"),
        (" - n*k*(y - n*x) - n*c*(y' - n*x')", " - k*(y - n*x) - c*(y' - n*x')", "inner_derivative"),
        (" - n*k*(y - n*x) - n*c*(y' - n*x')", "", "left_out"),
    ],
)
def test_a_spring_and_the_damper_beside_it_are_told_together(old: str, new: str, kind: str) -> None:
    answer = STRUT.replace(old, new)
    if kind == "deflection_sign":  # the whole of it, with the sign that it then has in both equations
        answer = "m*x'' + K*x + n*k*(y + n*x) + n*c*(y' + n*x') = 0\nM*y'' + k*(y + n*x) + c*(y' + n*x') = 0"
    (mistake,) = strut().model().check(answer).mistakes
    assert mistake.name == kind and "spring 'k' and damper 'c'" in str(mistake.what), str(mistake.what)


def test_a_wrong_deflection_in_the_force_alone_is_one_mistake_in_both_equations() -> None:
    (mistake,) = strut().model().check(STRUT.replace("(y - n*x)", "y")).mistakes
    assert mistake.name == "deflection_left_out" and "in the force of spring 'k' is taken as y" in str(mistake.what)
