"""The page that moves, held against its system: every test plants a fault in the page, in its solver or in its data."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable

import pytest

import built_in
import lagrangian as lg
from lagrangian import dynamics
from lagrangian.page.formula import Check
from lagrangian.picture import Picture
from lagrangian.verify import live_pages
from lagrangian.verify.states import random_states
from lagrangian.write.interactive.page import dense

needs_node = pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")


def checks(system: lg.System) -> list[Check]:
    model = system.model
    return list(live_pages.live_page_checks(model, list(random_states(model, dynamics.forward(model), 1, 1))))


def altered(part: str, change: Callable[[str], str], page: str) -> str:
    """A page one of whose packed parts is another."""
    (packed,) = re.findall(r'id="packed">(.*?)</script>', page, re.DOTALL)
    listed = live_pages.packed_parts(page)
    for k, (name, text, kind) in enumerate(listed):
        if name == part:
            listed[k] = name, change(text), kind
            assert listed[k][1] != text
    return page.replace(packed, dense(json.dumps(listed, ensure_ascii=False).encode()))


@pytest.mark.slow
@needs_node
def test_the_page_of_a_system_with_an_input_and_a_damper_holds() -> None:
    found = checks(built_in.system("cart-pole"))
    assert [check.holds for check in found] == [True, True, True], found
    assert "6 parameters and 4 initial values" in found[0].figure and "by wasm" in found[1].figure


def twice(key: str) -> Callable[[str], str]:
    """The data of a page in which a number of a group is twice as large."""

    def change(text: str) -> str:
        data = json.loads(text)
        data[key]["values"][0] = 2 * data[key]["values"][0] + 1
        return json.dumps(data)

    return change


@pytest.mark.sampled(5)
@needs_node
@pytest.mark.parametrize(
    ("part", "change", "expected"),
    [
        ("data", twice("p"), [False, True, False]),
        ("data", lambda text: text.replace("direction = [0, -1]", "direction = [0, 1]"), [False, True, True]),
        ("data", lambda text: text.replace("[[gravity]]", "[[gravitas]]"), [False, True, True]),
        ("engine", lambda text: text.replace('"value":9.81', '"value":1.62'), [True, False, False]),
        ("engine", lambda text: text.replace("=.5*c[0];", "=c[0];"), [True, True, False]),
    ],
    ids=["a value", "a sign of the file", "a file that is refused", "a value of the solver", "an energy"],
)
def test_a_fault_in_a_page_is_found(
    part: str, change: Callable[[str], str], expected: list[bool], monkeypatch: pytest.MonkeyPatch
) -> None:
    write = Picture.to_html
    monkeypatch.setattr(Picture, "to_html", lambda self: altered(part, change, write(self)))
    assert [check.holds for check in checks(built_in.system("pendulum"))] == expected


def test_a_page_that_there_is_not_and_a_machine_without_node_are_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live_pages, "NODE", "no-such-program")
    found = checks(built_in.system("pendulum"))
    assert [check.holds for check in found] == [True, None, None] and "Node was not found" in found[1].figure
    monkeypatch.undo()
    s = lg.System("no values")
    x = s.coordinate("x")
    s.particle(s.parameter("m"), at=s.origin + (x, 0))
    s.spring(s.parameter("k"), deflection=x)
    assert [check.holds for check in checks(s)] == [None, None, None]
