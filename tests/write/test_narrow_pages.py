"""Pages on narrow screens: formulas break at the width there is, and no line of them is wider than the screen."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from built_in import derivation

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")

WIDER = """() => [...document.querySelectorAll('.formula, .result')].filter(e => !e.querySelector('mtable'))
    .filter(e => e.scrollWidth > e.clientWidth + 1).map(e => e.textContent)"""
BRACKETS = """() => { const all = [...document.querySelectorAll("mtable.matrix")];
  const hidden = (m) => m.previousElementSibling.getBoundingClientRect().height === 0;
  const drawn = (m) => hidden(m) && getComputedStyle(m).borderLeftWidth !== "0px";
  return all.every(drawn) ? all.length : 0; }"""
"""How many matrices there are, if all of them have brackets that need no font."""


def test_a_long_term_can_break_before_a_function_but_not_before_its_parenthesis() -> None:
    page = derivation("double-pendulum").to_html()
    parts = [re.sub(r"<[^>]*>", "", part) for part in re.findall(r'<span class="span">(.*?)</span>', page)]
    assert {"sin", "cos"} < {part[:3] for part in parts}
    assert not any(part.startswith(("(", "\u2009")) for part in parts)


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")
def test_no_formula_is_wider_than_the_screen_of_a_telephone(tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as running:
        browser = running.chromium.launch(executable_path=CHROMIUM)
        for name in ("double-pendulum", "four-bar"):
            file = tmp_path / f"{name}.html"
            file.write_text(derivation(name).to_html(), encoding="utf-8")
            opened = browser.new_page(viewport={"width": 320, "height": 900})
            opened.goto(file.as_uri())
            assert opened.evaluate(WIDER) == [], name
            assert opened.evaluate(BRACKETS) > 0, name
            assert opened.evaluate("document.documentElement.scrollWidth") == 320, name
        browser.close()


def test_a_keyboard_reaches_what_slides_on_a_narrow_screen() -> None:
    """Tables and long matrices; a formula that breaks is no stop on the way through the page."""
    page = derivation("double-pendulum").to_html()
    boxes = re.findall(r'<div class="(?:table|formula)"[^>]*>', page)
    tables = [box for box in boxes if 'class="table"' in box]
    reached = [box for box in boxes if 'tabindex="0" role="group" aria-label="' in box]
    assert tables and set(tables) < set(reached)
    assert 'aria-label="Table: symbol, what it is, value"' in "".join(tables)
    assert 0 < len(reached) - len(tables) < len(boxes) - len(tables)
