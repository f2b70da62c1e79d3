"""The picture at the head of a derivation, in every format that has pictures, and what happens where there is none."""

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

import built_in
import lagrangian as lg
from lagrangian.derive import pages
from lagrangian.look import heading

CHROMIUM = shutil.which("chromium")
PDFLATEX = shutil.which("pdflatex")


@pytest.fixture(scope="module")
def cart_pole() -> lg.Derivation:
    return built_in.derivation("cart-pole")


def energies() -> lg.System:
    q: Any = dynamicsymbols("q")
    m, k = sp.symbols("m k")
    return lg.System.from_energies([q], T=m * q.diff() ** 2 / 2, V=k * q**2 / 2)


def svg_of(html: str) -> ET.Element:
    (text,) = re.findall(r"<figure class=\"schematic\".*?(<svg.*?</svg>)", html, re.DOTALL)
    return ET.fromstring(text)


def test_html_and_notebooks_begin_with_the_picture(cart_pole: lg.Derivation) -> None:
    system = built_in.system("cart-pole")
    for html in (cart_pole.to_html(), cart_pole.to_html(brief=True), cart_pole._repr_html_(), system._repr_html_()):
        named = {n for g in svg_of(html).iter() for n in g.get("data-element", "").split()}
        assert {"cart", "pole", "F", "b"} <= named
        assert html.index("<figure") < html.index("<h2")


def test_terms_and_parts_of_the_picture_have_the_same_names(cart_pole: lg.Derivation) -> None:
    html = cart_pole.to_html()
    terms = {n for names in re.findall(r'class="term [^>]*data-element="([^"]*)"', html) for n in names.split(" ")}
    shown = {n for g in svg_of(html).iter() for n in g.get("data-element", "").split(" ")}
    assert terms == {"cart", "pole", "g", "b", "F"}
    assert terms <= shown


def test_text_and_markdown_have_no_picture_but_can_describe_it(cart_pole: lg.Derivation) -> None:
    for text in (cart_pole.to_text(), cart_pole.to_markdown()):
        assert "svg" not in text and "tikz" not in text and "What it looks like" not in text
    described = pages.lay_out(cart_pole, described=True)
    assert described.sections[0].anchor == "seen"
    assert described.picture is None


def test_energies_alone_have_no_picture() -> None:
    derivation = energies().derive()
    assert derivation.picture is None
    assert "<figure" not in derivation.to_html() and "tikz" not in derivation.to_latex()
    assert "<figure" not in energies()._repr_html_()


@pytest.mark.parametrize("error", [ZeroDivisionError("0"), lg.ModelError("no such rule", code="E402")])
def test_a_fault_in_the_rules_costs_no_derivation(monkeypatch: pytest.MonkeyPatch, error: Exception) -> None:
    def broken(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(heading, "scene_of", broken)
    derivation = lg.example("pendulum").derive()  # not the shared one, whose picture may be drawn already
    html = derivation.to_html()
    assert "picture: none could be drawn" in html and "<figure" not in html
    assert 'class="equation"' in html
    assert "none could be drawn" in derivation.to_latex()
    assert "could be drawn" not in derivation.to_text()


def test_a_pose_that_makes_no_sense_costs_no_derivation() -> None:
    system = lg.loads(built_in.system("pendulum").to_toml() + '\n[look]\npose = { theta = "1 m" }\n')
    assert "picture: none could be drawn" in system.derive().to_html()


@pytest.mark.skipif(PDFLATEX is None, reason="no pdflatex")
@pytest.mark.parametrize("name", ["cart-pole", "lecture-3b"])
def test_latex_with_its_picture_runs(name: str, tmp_path: Path) -> None:
    text = built_in.derivation(name).to_latex()
    assert text.count(r"\begin{tikzpicture}") == 1
    (tmp_path / "a.tex").write_text(text, encoding="utf-8")
    command = [str(PDFLATEX), "-interaction=nonstopmode", "-halt-on-error", "a.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no browser")
def test_pointing_at_a_term_fades_what_it_did_not_come_from(tmp_path: Path) -> None:
    """Names with spaces, quotes and letters that mean something in style sheets."""
    playwright = pytest.importorskip("playwright.sync_api")
    text = built_in.system("lecture-3b").to_toml()
    hostile = "a ] \\\\ } 'k' > *"
    text = text.replace('name = "k"', f'name = "{hostile}"').replace('name = "m1"', 'name = "cart 1"')
    file = tmp_path / "page.html"
    file.write_text(lg.loads(text).derive().to_html(), encoding="utf-8")
    faded = """() => Object.fromEntries([...document.querySelectorAll('.schematic .glyph[data-element]')].map(
        g => [g.dataset.element, getComputedStyle(g).opacity]))"""
    with playwright.sync_playwright() as p:
        browser = p.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1200, "height": 900})
        page.goto(file.as_uri())
        page.add_style_tag(content=".schematic .glyph { transition: none !important; }")
        assert set(page.evaluate(faded).values()) == {"1"}
        spring = hostile.replace("\\\\", "\\").replace(" ", "\u00a0")
        term = page.locator(".result .term.stiffness").first
        term.scroll_into_view_if_needed()
        term.focus()
        found = page.evaluate(faded)
        assert found[spring] == "1"
        assert float(found["cart\u00a01"]) < 0.3 and float(found["F"]) < 0.3
        box = page.locator(".schematic svg").bounding_box()
        assert box["y"] >= 0 and box["y"] + box["height"] <= 900
        term.evaluate("x => x.blur()")
        page.evaluate("() => scrollTo(0, 0)")
        marked = "() => getComputedStyle(document.querySelector('.result .term.stiffness')).backgroundColor"
        before = page.evaluate(marked)
        glyph = page.locator(".schematic .kind-spring path").first
        box = glyph.bounding_box()
        page.mouse.move(box["x"] + box["width"] * 0.08, box["y"] + box["height"] / 2)
        assert page.evaluate(marked) != before
        browser.close()
