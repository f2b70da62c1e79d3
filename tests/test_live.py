"""The live page in a browser: it moves, it answers, it asks for nothing, and hostile names run nothing."""

from __future__ import annotations

import json
import math
import re
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import lagrangian as lg
from built_in import picture, system
from lagrangian import dynamics
from lagrangian.graph import Program, evaluate
from lagrangian.live import live_page
from lagrangian.model import Model
from lagrangian.page.scene import Scene

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
in_browser = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")


def double_pendulum() -> tuple[Model, Scene, Program]:
    system = lg.example("double-pendulum")
    picture = system.look()
    return system.model, picture.scene, picture.program


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("live") / "double-pendulum.html"
    path.write_text(live_page(*double_pendulum()), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as running:
        found = running.chromium.launch(executable_path=CHROMIUM)
        yield found
        found.close()


class Opened:
    """A page with what it said on its console and what it asked for."""

    def __init__(self, browser: Any, address: str, *, held: bool = True, **options: Any) -> None:
        self.context = browser.new_context(reduced_motion="reduce" if held else "no-preference", **options)
        self.page = self.context.new_page()
        self.trouble: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda said: self.trouble.append(said.text) if said.type != "log" else None)
        self.page.on("pageerror", lambda error: self.trouble.append(str(error)))
        self.page.on("dialog", lambda dialog: self.trouble.append(f"dialog: {dialog.message}"))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(address)
        self.wait_for("globalThis.livePage !== undefined")

    def wait_for(self, condition: str) -> None:
        """Ask again and again: the page's own rules forbid a function that waits inside it."""
        while not self.page.evaluate(condition):
            self.page.wait_for_timeout(20)
            assert not self.trouble

    def draw(self) -> None:
        """Let the page draw twice, so that what was asked of it is done; a busy machine takes its time."""
        self.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))")

    def sample(self) -> list[float]:
        return self.page.evaluate("livePage.sample()")

    def run_to(self, t: float) -> None:
        """Play until a time, then hold."""
        self.page.evaluate("document.activeElement.blur()")
        self.page.keyboard.press("Space")
        self.wait_for(f"livePage.time() >= {t}")
        self.page.keyboard.press("Space")

    def slide(self, identity: str, value: float) -> None:
        self.page.locator(f"#{identity}").evaluate(
            "(slider, x) => { slider.value = x; slider.dispatchEvent(new Event('input')); }", value
        )


@pytest.fixture
def opened(browser: Any, file: Path) -> Iterator[Opened]:
    made = Opened(browser, file.as_uri())
    yield made
    made.context.close()
    assert made.trouble == []
    assert {url.split("#")[0] for url in made.asked} == {file.as_uri()}


def test_the_page_is_one_small_file_that_forbids_itself_every_request(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    assert len(text.encode()) < 100_000
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', text)
    assert policy is not None and policy[1].startswith("default-src 'none'")
    assert "'unsafe-eval'" not in policy[1]
    assert not re.search(r"""(src|href|action)\s*=\s*["']?https?:""", text)
    for id_ in ("schematic", "motion", "bench", "steps"):
        assert f'id="{id_}"' in text


@in_browser
@pytest.mark.slow
def test_a_browser_that_cannot_unpack_says_so(browser: Any, file: Path) -> None:
    context = browser.new_context()
    context.add_init_script("delete globalThis.DecompressionStream")
    page = context.new_page()
    page.goto(file.as_uri())
    page.get_by_text("Nothing moves here: DecompressionStream").wait_for()
    assert page.locator("#status").inner_text().startswith("Nothing moves here: DecompressionStream")
    assert page.locator("#drawing svg").count() == 1
    context.close()


@in_browser
@pytest.mark.slow
def test_energy_is_kept_over_five_seconds(opened: Opened) -> None:
    opened.run_to(5.0)
    size = 4
    t, *rest = opened.sample()
    T, V, balance = rest[size : size + 3]
    at_start = 1.0 * 9.81 * (-2 * math.cos(2.0) - math.cos(2.5))  # both masses 1 kg, both rods 1 m, at rest
    assert t >= 5.0
    assert pytest.approx(T + V, abs=1e-12) == balance
    assert abs(balance - at_start) < 1e-6


@pytest.mark.slow
@in_browser
def test_a_slider_changes_the_motion(opened: Opened) -> None:
    opened.run_to(1.0)
    opened.page.keyboard.press("ArrowRight")
    before = opened.page.evaluate("livePage.time()")
    opened.slide("p-4", 1.62)  # on the moon
    opened.run_to(before + 0.5)
    opened.wait_for("location.hash.includes('p.g=1.62')")
    assert opened.page.locator("#p-4").get_attribute("aria-valuetext") == "1.62 m/s²"
    # from rest, under gravity alone: the way grows with g t²
    ways = []
    for g in (1.62, 9.81):
        opened.slide("p-4", g)
        opened.slide("x-0", 1.0)
        assert opened.page.evaluate("livePage.time()") == 0.0
        opened.page.keyboard.press("ArrowRight")
        opened.page.keyboard.press("ArrowRight")
        t, angle, *_ = opened.sample()
        assert t == pytest.approx(2 / 30)
        ways.append(1.0 - angle)
    assert ways[1] / ways[0] == pytest.approx(9.81 / 1.62, rel=0.05)


@pytest.mark.slow
@in_browser
def test_a_body_follows_the_pointer_to_3_px(opened: Opened) -> None:
    page = opened.page
    box = page.locator("#canvas").bounding_box()
    assert box is not None
    opened.draw()
    x, y = page.evaluate("livePage.handles()")[1]
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    goal = (x - 40, y + 35)
    page.mouse.move(box["x"] + goal[0], box["y"] + goal[1], steps=8)
    opened.draw()
    found = page.evaluate("livePage.handles()")[1]
    assert max(abs(a - b) for a, b in zip(found, goal, strict=True)) < 3
    page.mouse.up()
    assert page.evaluate("livePage.time()") == 0.0
    opened.wait_for("location.hash.includes('x.theta1=')")


@pytest.mark.slow
@in_browser
def test_terms_and_glyphs_light_each_other(opened: Opened) -> None:
    page = opened.page
    term = page.locator('#equations .term[data-from="particle m₂"]').first
    term.hover()
    lit = page.eval_on_selector_all("#drawing .lit", "nodes => nodes.map(n => n.dataset.element)")
    assert lit and set(lit) == {"m2"}
    page.mouse.move(0, 0)
    assert page.locator("#drawing .lit").count() == 0
    page.locator('#drawing [data-element="m1"]').first.focus()
    sources = page.eval_on_selector_all(".term.lit", "nodes => nodes.map(n => n.dataset.from)")
    assert sources and all("m₁" in source for source in sources)


@pytest.mark.slow
@in_browser
def test_the_keyboard_plays_holds_and_steps(opened: Opened) -> None:
    page = opened.page
    assert page.evaluate("livePage.playing()") is False  # reduced motion: it starts held
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    assert page.evaluate("livePage.time()") == pytest.approx(2 / 30)
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("livePage.time()") == pytest.approx(1 / 30)
    page.keyboard.press("Space")
    assert page.evaluate("livePage.playing()") is True


@pytest.mark.slow
@in_browser
def test_a_link_restores_the_state(browser: Any, file: Path) -> None:
    made = Opened(browser, file.as_uri() + "#p.m2=2.5&x.theta1=-0.5&speed=0.5")
    assert made.page.locator("#p-1").input_value() == "2.5"
    assert made.sample()[1] == -0.5
    assert made.page.locator("#speed-value").inner_text() == "0.50×"
    made.context.close()


@in_browser
@pytest.mark.slow
def test_a_page_in_a_frame_offers_no_link_to_it(browser: Any, file: Path) -> None:
    made = Opened(browser, file.as_uri())
    assert made.page.locator("#copy-link").is_visible()
    made.page.set_content('<iframe sandbox="allow-scripts" width="900" height="700"></iframe>')
    text = file.read_text(encoding="utf-8")
    made.page.locator("iframe").evaluate("(frame, text) => { frame.srcdoc = text; }", text)
    frame = made.page.frame_locator("iframe")
    frame.locator("#values .control").first.wait_for()
    frame.locator("#copy-model").wait_for()
    assert not frame.locator("#copy-link").is_visible()
    made.context.close()


@pytest.mark.slow
@in_browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_320_pixels_are_enough(browser: Any, file: Path, scheme: str) -> None:
    made = Opened(browser, file.as_uri(), viewport={"width": 320, "height": 640}, color_scheme=scheme)
    width = made.page.evaluate("document.documentElement.scrollWidth")
    assert width <= 320
    assert made.trouble == []
    made.context.close()


@in_browser
@pytest.mark.slow
def test_the_map_shows_where_starts_lead(opened: Opened, file: Path) -> None:
    """Near hanging at rest the pendulum stays near; the map's worker runs the same solver as the motion."""
    page = opened.page
    page.click("#map summary")
    page.fill("#map-end", "0.1")
    page.locator("#map-end").blur()
    opened.wait_for("document.getElementById('map-told').textContent.includes('starts in')")
    assert "110,592 starts" in page.inner_text("#map-told")
    page.locator("#map-canvas").scroll_into_view_if_needed()
    box = page.locator("#map-canvas").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + 0.25 * box["height"])
    opened.draw()
    state = opened.sample()
    assert state[1:3] == pytest.approx([math.pi / 2, math.pi / 2], abs=0.02)
    opened.asked = [url for url in opened.asked if not url.startswith("blob:")]


@in_browser
@pytest.mark.slow
def test_the_sweep_draws_many_runs_and_follows_its_range(opened: Opened) -> None:
    page = opened.page
    page.click("#sweep summary")
    opened.wait_for("document.getElementById('sweep-told').textContent.startsWith('129 runs')")
    assert page.inner_text("#sweep-range") == "0.700 … 1.30"
    opened.slide("sweep-high", 2.0)
    opened.wait_for("document.getElementById('sweep-range').textContent === '0.700 … 2.00'")
    page.select_option("#sweep-of", label="g [m/s²]")
    assert page.inner_text("#sweep-unit") == "m/s²"
    opened.asked = [url for url in opened.asked if not url.startswith("blob:")]


SECTION = """async ([x, p]) => {
  const add = (text) => document.body.append(Object.assign(document.createElement("script"), { textContent: text }));
  add(document.getElementById("worker").textContent);
  const found = [], across = { state: 1, low: 0, high: 0 };
  const job = { x, p, u: [], where: 0, value: 0, round: true, machine: x.length, across, up: 3, speed: 2, rate: 2,
    energy: energyOf(physics.functions, x, p, []), runs: 1, most: 6, dt: 0.03, longest: 100 };
  await jobs.section(job, await physics.solver(), ({ points }) => found.push(...points));
  return found;
}"""


@in_browser
@pytest.mark.slow
def test_a_section_has_the_points_at_which_events_are_found_in_python(opened: Opened) -> None:
    """Through θ₁ = 0 upward, with the energy of (0.3, 0.2) at rest; θ₂ and its rate there are those of an event."""
    system = lg.example("double-pendulum")
    values = [float(p.value) for p in system.model.parameters]
    points = opened.page.evaluate(SECTION, [[0.3, 0.2, 0.0, 0.0], values])
    energy = -9.81 * (2 * math.cos(0.3) + math.cos(0.2))
    rate = math.sqrt(energy + 3 * 9.81)  # at θ = 0 and θ₂' = 0: T = ½ (m₁ + m₂) L² θ₁'², all of them 1
    run = system.simulate(
        20.0, theta1=0.0, theta2=0.0, initial={"theta1'": rate}, events=lg.event(system["theta1"], 1, name="up")
    )
    found = run.events["up"]
    assert len(points) >= 12
    start = 1 if found.t[0] < 1e-6 else 0  # Python also counts the start itself
    for k in range(5):
        expected = found.y[1, start + k], found.y[3, start + k]
        assert points[2 * k : 2 * k + 2] == pytest.approx(expected, abs=1e-6)


@in_browser
@pytest.mark.slow
def test_a_page_finds_the_events_that_it_is_given_with_their_resets(browser: Any, tmp_path: Path) -> None:
    """A ball that falls from 1 m and loses a tenth of its speed at the floor: it rises to 0.81 m."""
    ball = lg.System("ball")
    y = ball.coordinates("y")
    ball.particle(ball.parameter("m", "1 kg"), at=ball.point("P", (0, y)), name="ball")
    ball.gravity(direction=(0, -1), g=9.81)
    bounce = lg.event(y, direction=-1, reset={y.diff(): -0.9 * y.diff()}, name="bounce")
    path = tmp_path / "ball.html"
    ball.look().save(path, events=bounce)
    made = Opened(browser, path.as_uri())
    field = made.page.locator('.control[data-group="x"] input[type="text"]').first
    field.fill("1")
    field.blur()
    made.run_to(0.9)
    assert "bounce at 0.452 s" in made.page.inner_text("#status")
    _, height, speed, *_ = made.sample()  # on a line between stored samples: g h²/8 = 2e-5 m
    assert height > 0 and height + speed**2 / (2 * 9.81) == pytest.approx(0.81, abs=4e-5)
    made.context.close()


@in_browser
@pytest.mark.slow
def test_without_webassembly_javascript_takes_over_and_says_so(browser: Any, file: Path, tmp_path: Path) -> None:
    path = tmp_path / "forbidden.html"
    path.write_text(file.read_text(encoding="utf-8").replace(" 'wasm-unsafe-eval'", ""), encoding="utf-8")
    made = Opened(browser, path.as_uri())
    assert made.page.evaluate("livePage.kind") == "javascript"
    assert made.page.locator("#fallback").is_visible()
    made.run_to(1.0)
    balance = made.sample()[7]
    assert balance == pytest.approx(9.81 * (-2 * math.cos(2.0) - math.cos(2.5)), abs=1e-6)
    made.context.close()


@in_browser
@pytest.mark.slow
def test_print_shows_the_equations_and_no_controls(opened: Opened) -> None:
    opened.page.emulate_media(media="print")
    assert opened.page.locator("#equations").is_visible()
    assert opened.page.locator("#drawing svg").is_visible()
    assert not opened.page.locator("#controls").is_visible()
    assert not opened.page.locator("#play").is_visible()


@pytest.mark.slow
@in_browser
def test_copied_models_read_back_with_the_values_of_the_sliders(opened: Opened) -> None:
    opened.slide("p-1", 2.5)
    opened.slide("x-0", 0.25)
    opened.page.evaluate("void (navigator.clipboard.writeText = () => Promise.reject())")
    opened.page.click("#copy-model")
    opened.wait_for("document.getElementById('copy').open")
    model = lg.loads(opened.page.input_value("#copy textarea")).model
    assert {p.name: p.value for p in model.parameters}["m2"] == 2.5
    assert float(model.settings["initial"]["theta1"]) == 0.25


@in_browser
@pytest.mark.slow
def test_a_loop_stays_closed_while_it_is_dragged(browser: Any, tmp_path: Path) -> None:
    path = tmp_path / "four-bar.html"
    lg.example("four-bar").look().save(path)
    made = Opened(browser, path.as_uri())
    page = made.page
    made.draw()
    box = page.locator("#canvas").bounding_box()
    x, y = page.evaluate("livePage.handles()")[0]
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    page.mouse.move(box["x"] + x + 20, box["y"] + y + 10, steps=5)
    page.mouse.up()
    made.draw()
    t1, t2, t3 = made.sample()[1:4]
    closed = complex(0.5 * math.cos(t1) + 1.2 * math.cos(t2) - 0.9 * math.cos(t3) - 1.0,
                     0.5 * math.sin(t1) + 1.2 * math.sin(t2) - 0.9 * math.sin(t3))  # fmt: skip
    assert abs(closed) < 1e-9
    assert abs(t1 - math.radians(60)) > 0.01
    assert made.trouble == []
    made.context.close()


@in_browser
@pytest.mark.slow
@pytest.mark.parametrize("name", ["stewart-platform", "chaplygin-sleigh"])
def test_a_long_loop_and_a_skate_can_be_dragged(browser: Any, tmp_path: Path, name: str) -> None:
    """Steps that close the platform's loops are too long for its page; the sleigh's constraint is on rates alone."""
    path = tmp_path / "page.html"
    picture(name).save(path)
    made = Opened(browser, path.as_uri())
    made.draw()
    before, box = made.sample(), made.page.locator("#canvas").bounding_box()
    x, y = made.page.evaluate("livePage.handles()")[0]
    made.page.mouse.move(box["x"] + x, box["y"] + y)
    made.page.mouse.down()
    made.page.mouse.move(box["x"] + x + 15, box["y"] + y, steps=2)
    made.draw()
    model, found = system(name).model, made.sample()
    n = len(model.coordinates)
    assert max(abs(a - b) for a, b in zip(before[1 : n + 1], found[1 : n + 1], strict=True)) > 0.01
    program = dynamics.residual(model)
    given = {"q": found[1 : n + 1], "v": [0.0] * len(model.velocities), "u": [0.0] * len(model.inputs), "t": [0.0]}
    rows = evaluate(program, {**given, "p": [p.value for p in model.parameters]})["f"]
    assert max(map(abs, rows), default=0.0) < 1e-9
    made.context.close()
    assert made.trouble == []


@in_browser
@pytest.mark.slow
def test_a_push_is_counted_as_supplied(browser: Any, tmp_path: Path) -> None:
    path = tmp_path / "cart-pole.html"
    lg.example("cart-pole").look().save(path)
    made = Opened(browser, path.as_uri())
    page = made.page
    knob = page.locator("[data-push]").nth(1)
    page.keyboard.press("Space")
    knob.focus()
    page.keyboard.down("Space")
    start = page.evaluate("livePage.time()")  # the page may have played for long before the key came
    made.wait_for(f"livePage.time() > {start + 0.5}")
    page.keyboard.up("Space")
    made.wait_for(f"livePage.time() > {start + 0.8}")
    page.locator("#play").click()
    made.draw()
    *_, T, V, balance, force = made.sample()
    assert force == 0.0
    assert (T + V) - balance > 0.1  # the push has done work
    at_start = 0.2 * 9.81 * 0.3 * math.cos(0.1)  # m g l cos θ, at rest
    assert balance == pytest.approx(at_start, abs=1e-6)
    assert made.trouble == []
    made.context.close()


HOSTILE = ("</script><script>alert(1)</script>", '"><img src=x onerror=alert(1)>', "n" * 10_000, "<!--<script>", "]]>")


@in_browser
@pytest.mark.sampled(5)
@pytest.mark.parametrize("name", HOSTILE, ids=lambda name: name[:12])
def test_hostile_names_run_nothing(browser: Any, tmp_path: Path, name: str) -> None:
    given, scene, program = double_pendulum()
    model = replace(
        given,
        name=name,
        parameters=tuple(replace(p, description=name) for p in given.parameters),
        _memo={},
    )
    elements = tuple(e.named(f"{name}{k}") for k, e in enumerate(model.elements))
    hostile = replace(model, elements=elements, _memo={})
    drawn = replace(scene, name=name, description=name, missing=(name,))
    path = tmp_path / "hostile.html"
    path.write_text(live_page(hostile, drawn, program), encoding="utf-8")
    made = Opened(browser, path.as_uri())
    assert made.trouble == []
    assert made.asked == [path.as_uri()]
    assert made.page.locator("h1").inner_text()[:100] == name[:100]
    assert made.page.locator("img").count() == 0
    made.context.close()


def test_data_cannot_end_its_element() -> None:
    from lagrangian.write.interactive.page import embedded

    text = embedded({"a": "</script><!-- &\u2028"})
    assert not set("<>&\u2028") & set(text)
    assert json.loads(text) == {"a": "</script><!-- &\u2028"}


@pytest.mark.slow
@in_browser
def test_a_body_that_floats_shows_its_equations_and_stays_in_sight_as_it_falls(browser: Any, tmp_path: Path) -> None:
    system = lg.System("falling plate")
    plate = system.floating_frame("plate")
    system.rigid_body(1, (0.1, 0.1, 0.2), plate.origin, plate)
    system.particle(1, plate.point(1, 0, 0))
    system.gravity(direction=(0, 0, -1))
    picture = system.look()
    path = tmp_path / "plate.html"
    path.write_text(live_page(system.model, picture.scene, picture.program), encoding="utf-8")
    shown = Opened(browser, path.as_uri())
    assert shown.page.locator(".result .equation").count() == 6
    shown.run_to(2.0)
    first, second = shown.page.evaluate("livePage.handles()")
    assert math.dist(first, second) > 8  # pixels: the frame that holds all it falls, 490 m in ten seconds, leaves 1
    assert all(0 < y < 1000 for _, y in (first, second))
    assert shown.trouble == []
    shown.context.close()
