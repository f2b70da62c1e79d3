"""Lines that repeat with an index are written once, and stand for exactly the lines that they replace."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

import built_in
from lagrangian.page.formula import Formula, Name, Text, formula, text
from lagrangian.structured.families import Families
from structured import robots

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
MOST_PAGES = 12

INDEX = re.compile(r"k([+−]\d+)?")


@pytest.fixture(scope="module")
def chain() -> Any:
    return robots.chain(12, relative=True).derive()


def written_with(number: int, name: str) -> str:
    """A name with the index k replaced by a number, without the underscores that the letters of a page need."""
    found = INDEX.sub(lambda m: str(number + int((m[1] or "0").replace("−", "-"))), name)
    return found.replace("_", "")


def put(number: int, expr: sp.Expr) -> sp.Expr:
    table: dict[Any, Any] = {s: sp.Symbol(written_with(number, s.name)) for s in expr.free_symbols}
    for f in expr.atoms(sp.core.function.AppliedUndef):
        table[f] = sp.Function(written_with(number, str(f.func)))(*f.args)
    return expr.xreplace(table)


@pytest.mark.slow
def test_every_line_that_is_left_out_follows_from_its_pattern(chain: Any) -> None:
    known = {put(0, d.symbol): put(0, d.expression) for d in chain.definitions}
    count = 0
    items = [item for step in chain.steps for item in step.items if isinstance(item, Formula)]
    for item in items:
        told = re.search(r"k = (\d+) … (\d+)", str(item.note)) if item.note is not None else None
        if told is None or not isinstance(item.sides[0], sp.Symbol):
            continue
        for number in range(int(told[1]), int(told[2]) + 1):
            left, right = (put(number, side) for side in item.sides)
            assert known[left] == right
            count += 1
    assert count > 80


@pytest.mark.slow
def test_long_chains_have_the_pages_of_short_ones(chain: Any) -> None:
    lines = [len(d.to_text(width=200).splitlines()) for d in (chain, robots.chain(16, relative=True).derive())]
    assert lines[1] - lines[0] < 12  # the equations in the box, and nothing else
    text = chain.to_text(width=200)
    assert "v_xk = L_k c_k ω_k + v_(xk−1)   (point k, k = 3 … 12)" in text
    assert "q₁, …, q₁₂ (12)" in text and "Equation k: q_k, k = 2 … 12" in text


@pytest.mark.slow
def test_every_format_writes_patterns(chain: Any) -> None:
    assert "v_{xk-1}" in chain.to_latex() or "xk" in chain.to_latex()
    assert "k = 3 … 12" in chain.to_html() and "xk−1" in chain.to_html()


def test_what_does_not_repeat_is_left_alone() -> None:
    """Other factors, other numbers, and fewer than four lines."""
    a = sp.symbols("a1:9")
    together = Families(built_in.system("pendulum").model)
    same = [[formula(x, 2 * x)] for x in a[:3]]
    assert [list(b) for b in same] == [[x] for x in together(same)]
    mixed = [[formula(x, (2 if i != 3 else 3) * x)] for i, x in enumerate(a)]
    found = list(together(mixed))
    assert [str(i) for i in found][:4] == ["a1 = 2*a1", "a2 = 2*a2", "a3 = 2*a3", "a4 = 3*a4"]
    assert len(found) == 5 and str(found[4].note) == "k = 5 … 8"  # type: ignore[union-attr]


def test_the_index_is_none_of_the_names_of_the_system() -> None:
    together = Families(built_in.system("two-carts").model)
    assert "k" in built_in.system("two-carts").model.symbols and together.index == "j"
    lines = [[formula(Name("V", str(i)), sp.Symbol(f"m{i}"), note=text(f"particle 'm{i}'"))] for i in range(1, 6)]
    (one,) = together(lines)
    assert isinstance(one, Formula) and isinstance(one.note, Text)
    assert str(one.sides[1]) == "m_j" and str(one.note) == "particle m_j, j = 1 … 5"


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium, which prints pages")
@pytest.mark.parametrize(
    "make",
    [
        robots.puma,
        robots.seven_joints,
        robots.platform,
        robots.satellite,
        lambda: robots.chain(20, relative=True),
        lambda: robots.chain(40, relative=True),
    ],
)
def test_robots_and_chains_fill_twelve_pages_at_most(make: Any, tmp_path: Path) -> None:
    page, printed = tmp_path / "page.html", tmp_path / "page.pdf"
    page.write_text(make().derive().to_html(), encoding="utf-8")
    command = [str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}"]
    command += ["--no-pdf-header-footer", f"--print-to-pdf={printed}", page.as_uri()]
    subprocess.run(command, check=True, capture_output=True)
    assert len(re.findall(rb"/Type\s*/Page[^s]", printed.read_bytes())) <= MOST_PAGES
