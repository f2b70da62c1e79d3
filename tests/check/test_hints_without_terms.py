"""What a hint tells: at level 1 the line, at level 2 also the kind of the mistake and its place, and never the term.

The oracle is the vocabulary: of the names of a system, level 2 may only contain those of its elements and coordinates.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian.check.explain import say
from lagrangian.check.explain.changes.pool import pool_of
from lagrangian.check.explain.misconceptions import MISCONCEPTIONS
from lagrangian.check.hints import NAMED
from lagrangian.check.reference import truth_of
from lagrangian.check.verb import check_answer
from lagrangian.check.verdict import Mistake
from lagrangian.model import Model
from size import rest_slow

SYSTEMS = ("cart-pole", "lecture-2", "lecture-3b", "quarter-car", "double-pendulum", "two-disk-shaft")
HEIGHT = "m1*g*L_a*sin(theta1) + m2*g*(L_a + L_b)*sin(theta1)"
ARTICLE = "a"
"""A parameter that may have this name cannot be told from a word."""


def mistakes(name: str) -> Iterator[Mistake]:
    """Every mistake that can be named in a system, in every amount in which it has words of its own."""
    truth = truth_of(derivation(name))
    for possible in pool_of(truth).all:
        if possible.wrong is not None:
            yield possible.wrong.mistake(truth)
        if (change := possible.change) is not None:
            amounts = (1, 2, -1, -2, Fraction(-1, 2)) if change.free else (1,)
            yield from (say.mistake(change, Fraction(x), truth.model) for x in amounts)


@cache
def terms_of(model: Model) -> re.Pattern[str]:
    """A name of the system that belongs to no element and is no coordinate, or a sign of a formula."""
    names = {x.name for x in (*model.parameters, *model.inputs)} - {ARTICLE}
    return re.compile(rf"(?<![\w'])(?:{'|'.join(map(re.escape, sorted(names)))})(?![\w'])|[\^*+=](?<!T\*)|½|''")


def words_of(said: str, model: Model) -> str:
    """What is said without the titles of elements."""
    titles = sorted((e.title for e in model.elements), key=len, reverse=True)
    for title in (x for t in titles for x in (t, t[:1].upper() + t[1:])):
        said = said.replace(title, "§")
    return said


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", rest_slow(SYSTEMS, {"cart-pole", "lecture-2", "lecture-3b"}))
def test_level_2_of_every_mistake_has_a_kind_and_a_place_and_no_term(name: str) -> None:
    model = derivation(name).model
    titles = {e.title for e in model.elements}
    coordinates = {c.name for c in model.coordinates}
    seen: set[str] = set()
    for mistake in mistakes(name):
        data = mistake.to_dict(2)
        said = str(mistake.hinted())
        if f"{said}{data}" in seen:
            continue
        seen.add(f"{said}{data}")
        assert "what" not in data and data["kind"] and data["name"] == data["kind"] and data["step"] in range(1, 7)
        for text in (said, data["brief"], data["why"]):
            found = terms_of(model).search(words_of(text, model))
            assert found is None, f"{mistake.name}: {text}"
        formulas = [x for x in mistake.hinted().parts if isinstance(x, sp.Expr)]
        assert all(str(x.func) in coordinates for x in formulas), mistake.name
        whole = re.search(r"T\*|\bV\b|\bL\b|Xi|equation|derivation|weights|energies|forces|dampers", said)
        assert whole or mistake.coordinate or any(t in said for t in titles), said
    assert len(seen) > 40


def test_every_kind_of_mistake_is_told() -> None:
    known = {m.__name__.rpartition(".")[2] for m in MISCONCEPTIONS} | set(say.KINDS)
    assert known <= NAMED


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("cart-pole", "T = M*x'^2/2 + m*(x'^2 + 2*l*x'*theta'*cos(theta) + l^2*theta'^2)/2"),
        ("cart-pole", "T = M*x'^2/2 + m*x'^2/2 + J*theta'^2/2 + m*l*x'*theta'*cos(theta)"),
        ("cart-pole", "m*l*cos(theta)*x'' + J*theta'' - m*g*l*sin(theta) = 0"),
        ("cart-pole", "V = -m*g*l*cos(theta)"),
        ("cart-pole", "D = b*x'^2"),
        ("lecture-3b", "Xi_x1 = -F\nXi_x2r = F"),
        ("lecture-3b", "m1*x1'' + m2*(x1'' + x2r'') = F\nm2*(x1'' + x2r'') + k*x2r = -F"),
        ("lecture-2", "V = m2*g*(L_a + L_b)*sin(theta1) + m3*g*L_c*sin(theta1 + theta2)"),
        ("double-pendulum", "V = m1*g*L1*cos(theta1) + m2*g*(L1*cos(theta1) + L2*cos(theta2))"),
    ],
)
def test_an_answer_is_hinted_at_without_its_term(name: str, answer: str) -> None:
    model = derivation(name).model
    verdict = check_answer(derivation(name), answer, hint=2)
    assert not verdict.right and verdict.mistakes
    data = verdict.to_dict()
    said = verdict.to_text().split("What went wrong")[1]
    told = " ".join(str(x) for m in data["mistakes"] for x in (m["brief"], m["why"], m["name"])) + str(data["notes"])
    assert terms_of(model).search(words_of(told, model)) is None, told
    assert "would be right" not in verdict.to_text() and not data["alternatives"]
    assert all(m["elements"] for m in data["mistakes"]) and "This belongs to step" in said
    line = check_answer(derivation(name), answer, hint=1)
    assert "What went wrong" not in line.to_text() and "would be right" not in f"{line.to_text()}{line.to_dict()}"
    assert not any(e.title in f"{line.to_text()}{line.to_dict()}" for e in model.elements)
    full = check_answer(derivation(name), answer)
    assert str(full.mistakes[0].what) in str(full.to_dict())


def test_a_wrong_height_is_of_the_body_and_not_of_gravity() -> None:
    answer = f"V = {HEIGHT} + m3*g*L_c*sin(theta1 + theta2)"
    (mistake, *_) = check_answer(derivation("lecture-2"), answer, hint=2).to_dict()["mistakes"]
    assert mistake["element"].startswith("particle ")


RESISTED = """
name = "two dampers"
[coordinates]
x = "a cart"
y = "another cart"
[parameters]
M = "2 kg"
c1 = "1 N s/m"
c2 = "3 N s/m"
k = "5 N/m"
[points]
one = ["x", "0"]
two = ["y", "0"]
[[particle]]
mass = "M"
at = "one"
[[particle]]
mass = "M"
at = "two"
[[damper]]
name = "floor"
b = "c1"
deflection = "x"
[[damper]]
name = "link"
b = "c2"
deflection = "x - y"
[[spring]]
name = "wall"
k = "k"
deflection = "y"
"""


def test_the_first_wrong_line_has_a_hint_also_if_no_mistake_explains_it() -> None:
    """A power is wrong in D, which no known mistake explains; the mistake below it is named."""
    answer = "D = c1*x'/2 + c2*(x' - y')^2/2\nV = -k*y^2/2"
    said = " ".join(lg.loads(RESISTED).derive().check(answer, hint=2).to_text().split())
    assert "What differs in line 1 (D) comes from damper 'floor', step 6" in said
    assert "In line 1 (D), a factor or a power is not right." in said and "c1" not in said
