"""The live page for everybody: small screens, 200 %, contrast, names, the rules of axe-core, a keyboard alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from accessible import CONTRAST, LOST, NAMELESS, broken_rules, nameless_stops
from built_in import derivation, picture, system
from test_live import CHROMIUM, Opened

pytestmark = [pytest.mark.slow, pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")]
PAGES = ("cart-pole", "furuta-pendulum", "four-bar")
NARROW = {"320 px": (320, 1), "200 % of 1280 px": (640, 2), "400 % of 1280 px": (320, 4)}
"""Widths in CSS pixels and their size on the screen: a browser's zoom narrows the window of the page (WCAG 1.4.10)."""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as running:
        found = running.chromium.launch(executable_path=CHROMIUM)
        yield found
        found.close()


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("pages")
    made = {name: folder / f"{name}.html" for name in PAGES}
    for name, path in made.items():
        picture(name).save(path)
    return made


def unfolded(opened: Opened) -> None:
    """Open everything that is folded."""
    opened.page.evaluate("document.querySelectorAll('details').forEach((e) => (e.open = true))")
    opened.draw()


@pytest.mark.parametrize("size", NARROW)
@pytest.mark.parametrize("name", PAGES)
def test_a_narrow_or_enlarged_page_loses_nothing(browser: Any, files: dict[str, Path], name: str, size: str) -> None:
    width, factor = NARROW[size]
    options = {"viewport": {"width": width, "height": 480}, "device_scale_factor": factor}
    made = Opened(browser, files[name].as_uri(), **options)
    assert made.page.evaluate(LOST) == []
    unfolded(made)
    assert made.page.evaluate(LOST) == []
    made.context.close()


@pytest.mark.parametrize("name", PAGES)
def test_text_of_twice_the_size_loses_nothing(browser: Any, files: dict[str, Path], name: str) -> None:
    """Only the letters grow, as in a browser that zooms text alone (WCAG 1.4.4)."""
    made = Opened(browser, files[name].as_uri(), viewport={"width": 1280, "height": 800})
    made.page.evaluate("document.documentElement.style.fontSize = '200%'")
    made.draw()
    assert made.page.evaluate(LOST) == []
    made.context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_has_contrast_and_names(browser: Any, files: dict[str, Path], scheme: str) -> None:
    made = Opened(browser, files["cart-pole"].as_uri(), color_scheme=scheme)
    unfolded(made)
    assert made.page.evaluate(CONTRAST) == []
    assert made.page.evaluate(NAMELESS) == []
    made.context.close()


def test_the_keyboard_stops_at_what_has_a_name(browser: Any, files: dict[str, Path]) -> None:
    """A body in space has many glyphs, and listening to the focus makes a glyph a stop in Chromium."""
    made = Opened(browser, files["furuta-pendulum"].as_uri())
    assert nameless_stops(made.page) == []
    made.context.close()


@pytest.mark.parametrize("name", PAGES)
def test_a_page_keeps_the_rules_of_axe(browser: Any, files: dict[str, Path], name: str) -> None:
    made = Opened(browser, files[name].as_uri())
    unfolded(made)
    assert broken_rules(made.page) == []
    made.context.close()


def feedback(folder: Path) -> str:
    """The page that a student gets who wrote one line with a wrong sign, and one that is no formula."""
    answers = folder / "answers"
    answers.mkdir()
    (answers / "ann.txt").write_text("m1*x1'' + k*(x1 - x2) = F\nnonsense (\n", encoding="utf-8")
    (written,) = derivation("lecture-3a").check_class(answers, feedback="html").write_feedback(folder)
    return written.read_text(encoding="utf-8")


PAPERS: dict[str, Callable[[Path], str]] = {
    "derivation": lambda _: derivation("four-bar").to_html(),
    "reasons": lambda _: derivation("four-bar").why.to_html(),
    "structured": lambda _: derivation("balancing-robot").to_html(),
    "feedback": feedback,
    "motion": lambda _: system("cart-pole").simulate(duration=1).animate().to_html(),
}
"""Every other kind of page."""


@pytest.mark.parametrize("kind", PAPERS)
def test_every_other_kind_of_page_keeps_the_rules_of_axe(browser: Any, tmp_path: Path, kind: str) -> None:
    page = browser.new_page(reduced_motion="reduce", bypass_csp=True)
    page.set_content(PAPERS[kind](tmp_path))
    page.evaluate("document.querySelectorAll('details').forEach((e) => (e.open = true))")
    assert broken_rules(page) == []
    page.set_viewport_size({"width": 320, "height": 480})
    assert page.evaluate(LOST) == []
    assert broken_rules(page) == []
    page.close()


def test_the_rules_of_axe_find_what_keeps_people_out(browser: Any) -> None:
    page = browser.new_page()
    page.set_content("<html lang=en><title>t</title><main><h1>t</h1><button></button><p style='color:#999'>pale</p>")
    assert [rule.partition(":")[0] for rule in broken_rules(page)] == [
        "button-name",
        "color-contrast",
        "color-contrast",
    ]
    page.close()


def test_a_sweep_of_a_parameter_of_0_has_a_range(browser: Any, tmp_path: Path) -> None:
    import lagrangian as lg

    s = lg.System("damped")
    x = s.coordinates("x")
    m, k, b = s.parameters("m k b", m="1 kg", k="4 N/m", b="0 N*s/m")
    s.particle(m, at=s.point("P", (x, 0)))
    s.spring(k, deflection=x)
    s.damper(b, deflection=x)
    path = tmp_path / "damped.html"
    s.look().save(path)
    made = Opened(browser, path.as_uri())
    made.page.click("#sweep summary")
    made.page.select_option("#sweep-of", label="b [N·s/m]")
    low, high = (float(made.page.input_value(f"#sweep-{end}")) for end in ("low", "high"))
    assert low < high
    made.wait_for("document.getElementById('sweep-told').textContent.startsWith('129 runs')")
    made.context.close()


def test_what_falls_stays_in_the_frame(browser: Any, tmp_path: Path) -> None:
    import lagrangian as lg

    s = lg.System("ball")
    y = s.coordinates("y")
    s.particle(s.parameter("m", "1 kg"), at=s.point("P", (0, y)), name="ball")
    s.gravity(direction=(0, -1), g=9.81)
    path = tmp_path / "ball.html"
    s.look().save(path)
    made = Opened(browser, path.as_uri())
    made.page.locator("#speed").evaluate("(e) => { e.value = e.max; e.dispatchEvent(new Event('input')); }")
    made.run_to(30.0)
    made.draw()
    ((x, y),) = made.page.evaluate("livePage.handles()")
    box = made.page.locator("#canvas").bounding_box()
    assert box is not None and 0 <= x <= box["width"] and 0 <= y <= box["height"]
    made.context.close()


DARK = """(() => {
  const canvas = document.getElementById("canvas"), { width, height } = canvas, made = [];
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  for (let x = 0; x < width; x++)
    for (let y = 0; y < height; y++) if (data[4 * (y * width + x)] < 90) made.push([x, y]);
  return made;
})()"""
"""The pixels in which ink is seen."""


def test_what_is_followed_is_seen_whole_and_the_ground_is_where_the_view_is(browser: Any, tmp_path: Path) -> None:
    path = tmp_path / "wheel.html"
    picture("wheel-on-incline").save(path)
    made = Opened(browser, path.as_uri())
    made.page.locator("#speed").evaluate("(e) => { e.value = e.max; e.dispatchEvent(new Event('input')); }")
    made.run_to(6.0)
    made.draw()
    ((x, y),), dark = made.page.evaluate("livePage.handles()"), made.page.evaluate(DARK)
    width = made.page.evaluate("document.getElementById('canvas').width")
    assert len({a // 10 for a, _ in dark}) > 0.9 * width / 10  # the ground
    assert any(abs(a - x) < 2 and b > y + 10 for a, b in dark)  # the lower rim
    made.context.close()
