"""The app in a real browser: what a person types, and what is seen then."""

import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from served_app import TOKEN, Served

from accessible import CONTRAST, LOST, NAMELESS, broken_rules, nameless_stops
from lagrangian import examples

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
playwright = pytest.importorskip("playwright.sync_api")
pytestmark = [pytest.mark.slow, pytest.mark.skipif(BROWSER is None, reason="no Chromium here")]

PATIENCE = 120_000
"""A busy machine may take so many milliseconds for one step."""


playwright.expect.set_options(timeout=PATIENCE)
expect = playwright.expect


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as tool:
        found = tool.chromium.launch(executable_path=BROWSER, args=["--no-sandbox"])
        yield found
        found.close()


@pytest.fixture
def page(browser: Any, kind_app: Served) -> Iterator[Any]:
    """A fresh tab with the app; anything on the console, and any request to elsewhere, fails the test."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.set_default_timeout(PATIENCE)
    made = context.new_page()
    said: list[str] = []
    made.on("console", lambda message: said.append(message.text))
    made.on("pageerror", lambda error: said.append(str(error)))
    made.on("dialog", lambda dialog: (said.append(f"dialog: {dialog.message}"), dialog.dismiss()))
    made.on("request", lambda r: r.url.startswith((kind_app.address, "blob:")) or said.append(f"request to {r.url}"))
    made.goto(f"{kind_app.address}/#{TOKEN}")
    made.wait_for_selector("body.started")
    yield made
    context.close()
    assert said == []


def opened(page: Any, name: str) -> Any:
    """Open an example and wait for its derivation; return the field of the model."""
    page.get_by_role("searchbox").fill(name)
    page.locator(".card button", has=page.locator(".card-name", has_text=re.compile(f"^{name}$"))).click()
    page.wait_for_selector("#derive-state.right")
    return page.locator("#model-editor textarea")


def typed(page: Any, field: Any, text: str) -> None:
    field.fill(text)
    page.wait_for_selector("#derive-state.busy, #derive-state.wrong, #derive-state.right")


def test_the_token_leaves_the_address(page: Any) -> None:
    assert TOKEN not in page.url
    page.reload()
    page.wait_for_selector("body.started")
    assert page.locator(".card").count() == len(examples.names())


def test_a_model_that_is_typed_shows_its_equations(page: Any) -> None:
    page.get_by_role("button", name="New model").click()
    page.wait_for_selector("#derive-state.right")
    field = page.locator("#model-editor textarea")
    assert "Equations of motion" in page.locator("#derivation").inner_text()
    assert page.locator("#derivation .result .term").count() == 2
    assert page.evaluate("document.documentElement.scrollHeight <= innerHeight")  # only the derivation slides
    field.fill(field.input_value().replace("[simulate]", '[[damper]]\nb = "0.5 N*s/m"\ndeflection = "x"\n\n[simulate]'))
    page.wait_for_selector("#model-error:not([hidden])")
    text = field.input_value().replace('b = "0.5 N*s/m"', 'b = "b"')
    field.fill(text.replace('k = "40 N/m"', 'k = "40 N/m"\nb = "1 N*s/m"'))
    expect(page.locator("#derivation .result .term")).to_have_count(3)
    assert page.locator("#derivation .term.damping").get_attribute("data-from") == "damper b"


def test_a_mistake_is_shown_at_its_line_and_the_last_good_derivation_stays(page: Any) -> None:
    field = opened(page, "cart pole")
    page.wait_for_selector(".part-look svg")
    before = page.locator("#derivation").inner_text()
    text = field.input_value()
    line = 1 + text[: text.index("l*cos(theta)")].count("\n")
    typed(page, field, text.replace("l*cos(theta)", "l*cos(thta)"))
    page.wait_for_selector("#model-error:not([hidden])")
    assert f"Line {line}, column " in page.locator("#model-error").inner_text()
    assert "Did you mean 'theta'?" in page.locator("#model-error").inner_text()
    assert page.locator(".numbers .wrong").inner_text().strip() == str(line)
    assert field.get_attribute("aria-invalid") == "true"
    assert page.locator("#derivation.old").inner_text() == before
    page.locator("#model-error button").click()
    at = page.evaluate("document.activeElement.selectionStart")
    assert field.input_value()[at:].startswith("thta")
    typed(page, field, text)
    page.wait_for_selector("#derivation:not(.old)")
    assert page.locator("#model-error").is_hidden()


def test_the_mark_lies_under_what_is_wrong(page: Any) -> None:
    """The underline is measured against the text that it belongs to, in a line with wide and astral characters."""
    field = opened(page, "pendulum")
    text = field.input_value()
    typed(page, field, text.replace('mass = "m"', 'mass = "mm"', 1))
    page.wait_for_selector("#model-error:not([hidden])")
    before = "e => e.textContent.slice(0, e.textContent.length - e.querySelector('.wave').textContent.length)"
    assert page.locator(".wave-row").evaluate(before) == 'mass = "'
    wave, shown = page.locator(".wave").bounding_box(), page.locator("#model-editor .shown").bounding_box()
    assert wave["y"] > shown["y"] and wave["width"] > 5


def test_an_answer_is_read_while_it_is_typed_and_judged_when_asked(page: Any) -> None:
    opened(page, "lecture 3b")
    page.get_by_role("link", name="Your answer").click()
    field = page.locator("#answer-editor textarea")
    field.fill("m1*x1'' = k*x2r - F\nm2*(x1'' + x2r'') = F - k*x2r")
    expect(page.locator("#answer-lines li")).to_have_count(2)
    assert page.locator("p.verdict").count() == 0
    page.get_by_role("button", name="Check").click()
    page.wait_for_selector("p.verdict.right")
    assert page.locator("#answer-lines .mark.right").count() == 2
    field.fill("m1*x1'' = k*x2r - F\nm2*(x1'' + x2r'') = F + k*x2r")
    page.wait_for_selector("#verdict.old")
    page.get_by_label("which element and step").check()
    page.wait_for_selector("p.verdict.wrong")
    assert page.locator("#answer-lines .mark.wrong").count() == 1
    assert "This belongs to step" in page.locator("#answer-report").inner_text()
    assert page.locator(".numbers .wrong").last.inner_text().strip() == "2"
    field.fill("m1*x1'' = k*)x2r")
    page.wait_for_selector("#answer-error:not([hidden])")
    assert "Line 1, column" in page.locator("#answer-error").inner_text()


def test_the_hint_level_limits_what_is_told(page: Any) -> None:
    opened(page, "lecture 3b")
    page.get_by_role("link", name="Your answer").click()
    page.locator("#answer-editor textarea").fill("m2*(x1'' + x2r'') = F + k*x2r")
    page.get_by_label("right or wrong").check()
    page.get_by_role("button", name="Check").click()
    page.wait_for_selector("p.verdict.wrong")
    assert page.locator("#answer-lines .mark").count() == 0
    assert page.locator(".numbers .wrong").count() == 0
    page.get_by_label("which term").check()
    page.wait_for_selector("#answer-lines .mark.wrong")
    assert "Term by term" in page.locator("#answer-report").inner_text()


def test_a_sweep_fills_its_plot_and_can_be_stopped(page: Any) -> None:
    opened(page, "lecture 3b")
    page.get_by_role("link", name="Sweep").click()
    page.get_by_label("and: the quantity").select_option("k")
    page.get_by_label("Values along each axis").select_option("10")
    page.get_by_role("button", name="Run").click()
    expect(page.locator("#sweep .cell")).to_have_count(100)
    said = page.locator("#sweep .pane:last-child [role=status]")
    expect(said).to_have_text(re.compile("^100 runs"))
    page.get_by_label("Duration").fill("100000 s")
    page.get_by_role("button", name="Run").click()
    page.get_by_role("button", name="Stop").click()
    expect(said).to_have_text(re.compile("^Stopped"))
    assert page.get_by_role("button", name="Run").is_enabled()


def test_a_sweep_offers_and_tells_numbers_in_si_units_whatever_the_file_has(page: Any) -> None:
    page.get_by_role("button", name="New model").click()
    page.wait_for_selector("#derive-state.right")
    field = page.locator("#model-editor textarea")
    field.fill(field.input_value().replace('"40 N/m"', '"4 N/cm"'))
    expect(page.locator("#derivation")).to_contain_text("4 N/cm")
    page.get_by_role("link", name="Sweep").click()
    page.get_by_label("Vary: the quantity").select_option("k")
    assert page.get_by_label("k from, number").input_value() == "200"
    expect(page.locator("#sweep .unit").first).to_have_text("N/m")
    page.get_by_label("Values along each axis").select_option("10")
    page.get_by_role("button", name="Run").click()
    said = page.locator("#sweep .pane:last-child [role=status]")
    expect(said).to_have_text(re.compile(r"^10 runs\. max x: least [^;]+ m at k = \d+ N/m\.( Note.*)?\s*$"))


HOSTILE = {
    "script": "</script><script>document.title='run'</script>",
    "image": '"><img src=x onerror="document.title=\'run\'">',
    "style": "<style>body{display:none}</style>",
    "frame": "<iframe src='javascript:parent.document.title=1'></iframe>",
    "svg": "<svg onload=\"document.title='run'\">",
    "markup": "${document.title='run'} {{7*7}} &lt;b&gt;",
    "direction": "\u202egnp.\u202c",
    "long": "x" * 10_000,
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_names_run_nothing(page: Any, case: str) -> None:
    text = examples.text("pendulum").replace('name = "pendulum"', f"name = '''{HOSTILE[case]}'''")
    text = re.sub(r"^theta = .*$", lambda _: f"theta = '''{HOSTILE[case]}'''", text, count=1, flags=re.M)
    page.get_by_role("button", name="New model").click()
    page.wait_for_selector("#derive-state.right")
    page.locator("#model-editor textarea").fill(text)
    expect(page.locator("#derivation h2.name", has_text="mass on a spring")).to_have_count(0)
    for view in ("Your answer", "Motion", "Sweep", "Editor"):
        page.get_by_role("link", name=view).click()
    assert page.title().endswith("lagrangian")
    own = ("img[src^='data:image/svg+xml,']", "iframe[src^='/page/']")
    foreign = f"main :is(script, style, img, iframe, [onerror], [onload], [href], [src]):not({', '.join(own)})"
    assert [node.evaluate("e => e.outerHTML") for node in page.locator(foreign).all()] == []
    assert page.locator("body").is_visible()


def test_a_model_is_opened_from_a_file_and_saved_as_a_download(page: Any, tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(examples.text("pendulum"), encoding="utf-8")
    page.locator("#open-file").set_input_files(str(file))
    page.wait_for_selector("#derive-state.right")
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Save").click()
    assert waiting.value.suggested_filename == "mine.toml"
    assert Path(waiting.value.path()).read_text(encoding="utf-8") == file.read_text(encoding="utf-8")


def test_the_keyboard_alone_opens_a_model_and_leaves_its_field(page: Any) -> None:
    page.locator("#search").focus()
    page.keyboard.type("lecture 1")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    page.wait_for_selector("#derive-state.right")
    page.locator("#model-editor textarea").focus()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.localName") != "textarea"


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [320, 640, 1280])
def test_nothing_is_wider_than_the_screen(browser: Any, kind_app: Served, scheme: str, width: int) -> None:
    context = browser.new_context(viewport={"width": width, "height": 640}, color_scheme=scheme)
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.goto(f"{kind_app.address}/#{TOKEN}")
    page.wait_for_selector("body.started")
    opened(page, "furuta pendulum")
    for view in ("Models", "Editor", "Your answer", "Motion", "Sweep"):
        page.get_by_role("link", name=view, exact=True).click()
        page.wait_for_selector("section.view:not([hidden])")
        assert page.evaluate(LOST) == [], view
    context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_text_has_contrast(browser: Any, kind_app: Served, scheme: str) -> None:
    """At least 4.5 to 1, as WCAG 2.2 asks of text (success criterion 1.4.3)."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, color_scheme=scheme, reduced_motion="reduce")
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.goto(f"{kind_app.address}/#{TOKEN}")
    page.wait_for_selector("body.started")
    opened(page, "cart pole")
    for view in ("Models", "Editor", "Your answer", "Motion", "Sweep"):
        page.get_by_role("link", name=view, exact=True).click()
        assert page.evaluate(CONTRAST) == [], view
    context.close()


def test_the_app_keeps_the_rules_of_axe(browser: Any, kind_app: Served) -> None:
    context = browser.new_context(viewport={"width": 1280, "height": 800}, bypass_csp=True)
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.goto(f"{kind_app.address}/#{TOKEN}")
    page.wait_for_selector("body.started")
    opened(page, "cart pole")
    for view in ("Models", "Editor", "Your answer", "Motion", "Sweep"):
        page.get_by_role("link", name=view, exact=True).click()
        page.wait_for_selector("section.view:not([hidden])")
        assert broken_rules(page) == [], view
    context.close()


@pytest.mark.parametrize("size", ["640 px of 1280", "letters of 200 %"])
def test_the_app_at_200_percent_loses_nothing(browser: Any, kind_app: Served, size: str) -> None:
    """A browser's zoom halves the window in CSS pixels (WCAG 1.4.10); other browsers enlarge letters alone (1.4.4)."""
    zoomed = size.startswith("640")
    view = {"width": 640 if zoomed else 1280, "height": 400 if zoomed else 800}
    context = browser.new_context(viewport=view, device_scale_factor=2 if zoomed else 1)
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.goto(f"{kind_app.address}/#{TOKEN}")
    page.wait_for_selector("body.started")
    if not zoomed:
        page.evaluate("document.documentElement.style.fontSize = '200%'")
    opened(page, "cart pole")
    for name in ("Models", "Editor", "Your answer", "Motion", "Sweep"):
        page.get_by_role("link", name=name, exact=True).click()
        page.wait_for_selector("section.view:not([hidden])")
        assert page.evaluate(LOST) == [], name
    context.close()


def test_every_control_has_a_name(page: Any) -> None:
    opened(page, "lecture 3b")
    for view in ("Models", "Editor", "Your answer", "Motion", "Sweep"):
        page.get_by_role("link", name=view, exact=True).click()
        nameless = page.evaluate(NAMELESS)
        assert nameless == [], view


def test_the_schematic_and_the_terms_light_each_other(page: Any) -> None:
    opened(page, "lecture 3b")
    page.wait_for_selector(".part-look svg")
    page.locator("#derivation .term.stiffness").first.hover()
    lit = page.locator(".part-look .glyph.lit")
    assert lit.count() >= 1
    assert {node.get_attribute("data-element") for node in lit.all()} == {"k"}
    page.locator(".part-look [data-element=k]").first.hover()
    assert page.locator("#derivation .term.lit").count() == page.locator("#derivation .term.stiffness").count()
    assert nameless_stops(page, 40) == []
    assert page.locator(".part-look .glyph[tabindex]").count() > 3


def test_the_motion_runs_in_a_frame_that_cannot_reach_the_app(page: Any) -> None:
    opened(page, "double pendulum")
    page.get_by_role("link", name="Motion").click()
    frame = page.frame_locator("#motion iframe")
    expect(frame.locator("#clock")).to_have_text(re.compile(r"t = [1-9]"))
    inside = page.frames[1]
    assert inside.evaluate("self.origin") == "null"
    for reach in ("parent.document.title", "sessionStorage.length", "document.cookie"):
        tried = f"(() => {{ try {{ return {reach}; }} catch (error) {{ return error.name; }} }})()"
        assert inside.evaluate(tried) == "SecurityError"
    page.get_by_role("link", name="Editor").click()
    assert page.locator("#model-editor textarea").is_visible()


BRAKED = """name = "block"
[coordinates]
x = ""
[points]
P = ["x", 0]
[[particle]]
mass = 2
at = "P"
[[friction]]
name = "floor"
mu = 0.5
normal = 20
deflection = "x"
[simulate]
duration = "1 s"
initial = { "x'" = 2 }
"""


def test_a_run_says_how_long_friction_sticks(page: Any) -> None:
    """A block at 2 m/s that brakes with μ g = 5 m/s² rests after 0.4 s; friction has no page that moves."""
    page.get_by_role("button", name="New model").click()
    page.wait_for_selector("#derive-state.right")
    typed(page, page.locator("#model-editor textarea"), BRAKED)
    page.wait_for_selector("#derive-state.right")
    page.get_by_role("link", name="Motion").click()
    expect(page.locator("#motion p[role=status]").last).to_have_text(
        re.compile(r"Friction floor sticks once, 0\.6(00)? s in all\.$")
    )
    told = page.locator("#motion .trouble").first
    expect(told).to_contain_text("no page integrates that")
    expect(told).not_to_contain_text("Python.")  # alone: the app itself computes the run
