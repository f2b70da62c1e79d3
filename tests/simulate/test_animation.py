"""Runs as moving pictures, against positions of points that are computed another way, and Pillow's reading of GIFs."""

from __future__ import annotations

import pathlib
import re
import shutil
import subprocess
from html import unescape

import numpy as np
import pytest

import built_in
import lagrangian as lg
from lagrangian.page.motion import SceneMotion
from lagrangian.page.scene import SWING
from lagrangian.simulate.animating import hermite, usual_speed
from lagrangian.view.movies import centiseconds
from svg_player import SVG, moving, parsed, place, value

SECONDS, FPS = 4.0, 25


def animated(name: str, samples: int = 1001, **options) -> tuple[lg.System, lg.Animation]:
    system = built_in.system(name)
    return system, system.simulate(SECONDS, samples=samples).animate(**options)


def seen(motion: SceneMotion, r: np.ndarray) -> np.ndarray:
    """The scene's formula, in the frame of the animation."""
    scene = motion.scene
    return np.array(scene.origin) + scene.scale * np.array(scene.view) @ r - np.array(motion.frame[:2])


def states(system: lg.System) -> np.ndarray:
    """Coordinates at the times of the frames, by a run that is stored there."""
    return system.simulate(SECONDS, samples=round(SECONDS * FPS) + 1).y.T[:, : len(system.model.coordinates)]


def test_bodies_are_where_the_compiled_points_are() -> None:
    system, animation = animated("double-pendulum")
    root, motion, dyn = parsed(animation.to_svg()), animation.motion, system.compile()
    q = states(system)
    assert animation.frames == len(q) == 101
    for element, point in (("m1", "P1"), ("m2", "P2")):
        group = next(
            g
            for g in root.iter(f"{SVG}g")
            if g.get("class") == "glyph kind-ball role-body" and g.get("data-element") == element
        )
        circle = next(group.iter(f"{SVG}circle"))
        centre = float(circle.get("cx", "")), float(circle.get("cy", ""))
        for k in range(0, 101, 4):
            true = seen(motion, dyn.point(point, q[k])["r"])
            assert place(root, circle, centre, k / 100) == pytest.approx(true, abs=0.35)
            assert 0 < true[0] < motion.frame[2] and 0 < true[1] < motion.frame[3]


def test_a_rod_ends_at_its_mass_in_every_frame() -> None:
    system, animation = animated("double-pendulum")
    root, dyn = parsed(animation.to_svg()), system.compile()
    rod = next(moving(root, "m1").iter(f"{SVG}path"))
    length = float(re.findall(r"L([\d.]+)", rod.get("d", ""))[0])
    assert length == pytest.approx(190, abs=0.02)  # one metre, drawn to scale
    for k, q in enumerate(states(system)):
        true = seen(animation.motion, dyn.point("P1", q)["r"])
        assert place(root, rod, (length, 0), k / 100) == pytest.approx(true, abs=0.5)


@pytest.mark.slow
def test_a_spring_is_stretched_from_its_pivot_to_its_mass() -> None:
    system, animation = animated("elastic-pendulum")
    root, dyn = parsed(animation.to_svg()), system.compile()
    motion = animation.motion
    group = next(g for g in root.iter(f"{SVG}g") if "kind-spring" in g.get("class", ""))
    spring = next(x for x in group.iter(f"{SVG}path"))
    numbers = [float(x) for x in re.findall(r"-?\d+\.?\d*", spring.get("d", ""))]
    start, end = (numbers[0], numbers[1]), (numbers[-2], numbers[-1])
    pivot, body = seen(motion, np.zeros(2)), next(b for b in system.model.bodies)
    for k, q in enumerate(states(system)):
        mass = seen(motion, dyn.point(body.at, q)["r"])
        assert place(root, spring, start, k / 100) == pytest.approx(pivot, abs=0.5)
        assert np.linalg.norm(place(root, spring, end, k / 100) - mass) < 12  # the radius of its circle, and a line


def test_carts_that_were_moved_apart_do_not_meet() -> None:
    _, animation = animated("two-carts")
    motion = animation.motion
    first, second = motion.scene.handles[:2]
    shifts = [next(p.placement.shift for p in motion.parts if p.placement.at == a) for a in (first, second)]
    gap = motion.at[:, second] + shifts[1] - motion.at[:, first] - shifts[0]
    assert gap[:, 0].min() > 58 and np.ptp(gap[:, 0]) > 20


@pytest.mark.parametrize("size", [1e-6, 1.0, 50.0])
def test_a_motion_without_sizes_is_drawn_as_large_as_there_is_room(size: float) -> None:
    """A mass on a spring reaches as far in the picture whether it swings by micrometres or by metres."""
    system = lg.System("oscillator")
    x = system.coordinate("x")
    system.particle(1, at=system.point("mass", (x, 0)))
    system.spring(40, deflection=x)
    motion = system.simulate(2.0, x=size).animate().motion
    (handle,) = motion.scene.handles
    assert np.ptp(motion.at[:, handle], axis=0) == pytest.approx([2 * SWING, 0.0], abs=0.5)


@pytest.mark.slow
def test_a_wheel_that_rolls_in_space_is_written_in_few_numbers() -> None:
    """The ellipse of a wheel changes with its lean alone, not with its turn: in between frames it does not shrink."""
    _, animation = animated("rolling-disc", samples=401)
    assert len(animation.to_svg()) < 90_000


@pytest.mark.slow
def test_the_ground_is_as_wide_as_the_frame() -> None:
    _, animation = animated("cart-pole")
    root = parsed(animation.to_svg())
    floor = next(g for g in root.iter(f"{SVG}g") if "kind-floor" in g.get("class", ""))
    left, width = animation.motion.frame[0], animation.motion.frame[2]
    ((x0, x1),) = re.findall(r"^M([-\d.]+)[ ]?[-\d.]+L([-\d.]+)", floor[0].get("d", ""))
    assert float(x0) == pytest.approx(left, abs=0.01) and float(x1) == pytest.approx(left + width, abs=0.01)


def test_the_path_of_a_point_is_drawn_with_time() -> None:
    system, animation = animated("double-pendulum", trail=["P2"])
    root, dyn = parsed(animation.to_svg()), system.compile()
    drawn = next(x for x in root.iter(f"{SVG}path") if x.get("pathLength") == "1")
    offsets = drawn[0]
    assert value(offsets, 0.0) == pytest.approx([1]) and value(offsets, 1.0) == pytest.approx([0])
    numbers = [float(x) for x in re.findall(r"-?\d+\.?\d*", drawn.get("d", ""))]
    corners = np.array(numbers).reshape(-1, 2) - np.array(animation.motion.frame[:2])
    steps = np.hypot(*np.diff(corners, axis=0).T)
    at = np.concatenate([[0], np.cumsum(steps)]) / steps.sum()
    for k, q in enumerate(states(system)):
        share = 1 - value(offsets, k / 100)[0]
        reached = np.array([np.interp(share, at, column) for column in corners.T])
        assert np.linalg.norm(reached - seen(animation.motion, dyn.point("P2", q)["r"])) < 1.5


@pytest.mark.slow
def test_a_browser_shows_the_same_places(tmp_path: pathlib.Path) -> None:
    sync_api = pytest.importorskip("playwright.sync_api")
    if (chromium := shutil.which("chromium")) is None:
        pytest.skip("no chromium")
    system, animation = animated("double-pendulum")
    path = animation.save(tmp_path / "motion.svg")
    dyn, q = system.compile(), states(system)
    ask = """time => {
      const svg = document.documentElement; svg.pauseAnimations(); svg.setCurrentTime(time);
      const group = [...document.querySelectorAll('.moving .kind-ball')].find(g => g.dataset.element === 'm2');
      const box = group.querySelector('circle').getBoundingClientRect();
      return [box.x + box.width / 2, box.y + box.height / 2]; }"""
    with sync_api.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 900, "height": 900})
        page.goto(path.as_uri())
        for k in (0, 17, 50, 83, 99):
            true = seen(animation.motion, dyn.point("P2", q[k])["r"]) * animation.width / animation.motion.frame[2]
            assert page.evaluate(ask, k / FPS) == pytest.approx(true, abs=1.0)
        browser.close()


# -- files ------------------------------------------------------------------------------------------------------------


def test_a_gif_has_the_frames_and_the_duration(tmp_path: pathlib.Path) -> None:
    image = pytest.importorskip("PIL.Image")
    counted: list[tuple[int, int]] = []
    _, animation = animated("double-pendulum", fps=30, width=201)
    path = animation.save(tmp_path / "motion.gif", progress=lambda done, count: counted.append((done, count)))
    with image.open(path) as gif:
        assert gif.n_frames == animation.frames == 121
        assert gif.size[0] in (200, 202) and gif.size[1] % 2 == 0 and gif.info["loop"] == 0
        total = 0
        for k in range(gif.n_frames):
            gif.seek(k)
            total += gif.info["duration"]
    assert total == pytest.approx(1000 * (SECONDS + 1 / 30), abs=10)
    assert counted == [(k, 121) for k in range(1, 122)]


@pytest.mark.slow
def test_a_gif_shows_the_mass_where_it_is(tmp_path: pathlib.Path) -> None:
    image = pytest.importorskip("PIL.Image")
    system, animation = animated("pendulum")
    path = animation.save(tmp_path / "motion.gif")
    dyn, q, motion = system.compile(), states(system), animation.motion
    with image.open(path) as gif:
        for k in (0, 30, 77):
            gif.seek(k)
            x, y = seen(motion, dyn.point(system.model.bodies[0].at, q[k])["r"]) * gif.size[0] / motion.frame[2]
            red, _, blue = gif.convert("RGB").getpixel((round(x), round(y)))
            assert blue - red > 10  # the light blue-grey of a body, on paper that is almost white


@pytest.mark.parametrize(("count", "duration"), [(2, 0.04), (101, 4.0), (76, 2.5), (361, 12.0)])
def test_rounded_durations_do_not_drift(count: int, duration: float) -> None:
    found = np.cumsum(centiseconds(count, duration))
    assert np.abs(found - 1000 * duration * np.arange(1, count + 1) / (count - 1)).max() <= 5.0


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "mark", "at"), [("mp4", b"ftyp", 4), ("webm", b"\x1a\x45\xdf\xa3", 0)])
def test_a_video_has_the_frames(tmp_path: pathlib.Path, kind: str, mark: bytes, at: int) -> None:
    pytest.importorskip("PIL.Image")
    program = shutil.which("ffmpeg") or pytest.importorskip("imageio_ffmpeg").get_ffmpeg_exe()
    _, animation = animated("pendulum", width=120, speed=4)
    path = animation.save(tmp_path / f"motion.{kind}", dark=True)
    assert path.read_bytes()[at:].startswith(mark)
    command = [program, "-i", str(path), "-f", "null", "-"]
    told = subprocess.run(command, capture_output=True, check=True).stderr.decode(errors="replace")
    assert re.findall(r"frame=\s*(\d+)", told)[-1] == str(animation.frames) == "26"


def test_an_interrupted_file_is_removed(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("PIL.Image")
    _, animation = animated("pendulum")

    def interrupt(done: int, count: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        animation.save(tmp_path / "motion.gif", progress=interrupt)
    assert list(tmp_path.iterdir()) == []


# -- notebooks and pages ----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_notebook_gets_a_sandbox_of_bounded_size() -> None:
    system = built_in.system("triple-pendulum")
    animation = system.simulate(30.0, samples=6001).animate(fps=60, trail=["P3"])
    html = animation._repr_html_()
    assert len(html) < 150_000
    assert html.startswith('<iframe sandbox="allow-scripts"') and html.count("<iframe") == 1
    assert "allow-same-origin" not in html


def test_a_page_asks_for_nothing_and_keeps_names_as_text() -> None:
    text = built_in.system("pendulum").to_toml().replace('name = "pendulum"', "name = '<script>alert(1)</script>'", 1)
    animation = lg.loads(text).simulate(1.0).animate()
    page = animation.to_html()
    assert page.count("<script") == 1 and "&lt;script&gt;alert(1)" in page
    assert "default-src 'none'" in page and "http" not in page.replace("http://www.w3.org/2000/svg", "").replace(
        "http-equiv", ""
    )
    assert "prefers-reduced-motion" in page
    inner = unescape(re.findall(r'srcdoc="([^"]*)"', animation._repr_html_())[0])
    assert inner.count("<script") == 1


# -- times ------------------------------------------------------------------------------------------------------------


def test_cubic_polynomials_are_met_between_samples() -> None:
    t = np.array([0.0, 0.3, 0.5, 0.5, 1.7, 2.0])
    q = np.stack([t**3 - 2 * t, 1 - t**2], axis=-1)
    rates = np.stack([3 * t**2 - 2, -2 * t], axis=-1)
    at = np.linspace(0, 2, 41)
    assert hermite(t, q, rates, at) == pytest.approx(np.stack([at**3 - 2 * at, 1 - at**2], axis=-1), abs=1e-12)


@pytest.mark.parametrize(
    ("seconds", "speed"), [(2.0, 1.0), (30.0, 1.0), (31.0, 2.0), (100.0, 5.0), (1.0, 0.5), (0.03, 0.01), (4e4, 2000.0)]
)
def test_runs_are_shown_in_real_time_unless_they_are_short_or_long(seconds: float, speed: float) -> None:
    assert usual_speed(seconds) == pytest.approx(speed)


def test_a_run_that_stops_at_once_says_why_there_is_no_animation() -> None:
    run = built_in.system("duffing").simulate(1.0, samples=51, max_steps=2, x=0.3)
    with pytest.raises(lg.RunError, match=r"the run has only \d samples, as it stopped at t = .* s: \[E505\]"):
        run.animate()


@pytest.mark.slow
def test_samples_that_are_too_far_apart_are_refused() -> None:
    run = built_in.system("duffing").simulate(100.0, samples=9)
    with pytest.raises(lg.RunError, match="too far apart") as refused:
        run.animate()
    assert refused.value.fix == "simulate with samples=36"


def test_a_run_without_length_is_refused() -> None:
    run = built_in.system("pendulum").simulate(1.0, samples=1001)
    run.t, run.y = run.t[:1], run.y[:, :1]
    with pytest.raises(lg.RunError, match="nothing moves"):
        run.animate()


def test_another_systems_picture_is_refused() -> None:
    run = built_in.system("pendulum").simulate(1.0)
    with pytest.raises(lg.RunError, match="another system"):
        run.animate(look=built_in.picture("crane"))


def test_a_picture_with_its_own_choices_moves() -> None:
    system = built_in.system("cart-pole")
    animation = system.simulate(2.0).animate(look=system.look(hide=["b"]))
    assert 'data-element="b"' not in animation.to_svg() and 'data-element="pole"' in animation.to_svg()


def test_many_runs_say_how_to_see_one() -> None:
    runs = built_in.system("pendulum").sweep(1.0, {"b": [0.0, 0.1]})
    with pytest.raises(AttributeError, match="has no 'animate'") as refused:
        runs.animate  # noqa: B018
    assert "animate() shows one of the runs" in str(refused.value)


def test_an_animation_says_what_it_is() -> None:
    _, animation = animated("pendulum", speed=0.5)
    assert repr(animation).startswith("<Animation of 'pendulum': 201 frames, 8 s, ")
    assert "0.5 × real time" in "".join(parsed(animation.to_svg()).itertext())


def test_what_falls_far_is_followed_and_keeps_its_size() -> None:
    """A ball that falls for 10 s, 490 m: the frame moves with it, says so, and a floor passes by."""
    s = lg.System("ball")
    x, y = s.coordinates("x y")
    s.particle(s.parameter("m", "1 kg"), at=s.point("P", (x, y)), name="ball")
    s.gravity(direction=(0, -1), g=9.81)
    short, far = (s.simulate(t, initial={"x'": 1.0}).animate().motion for t in (0.1, 10.0))
    assert not short.followed and far.followed and "moves with the bodies" in far.pace
    assert far.frame[2] < 3 * max(far.scene.size)
    (ball,) = far.scene.handles
    assert np.ptp(far.at[:, ball], axis=0) == pytest.approx([0.0, 0.0], abs=1e-6)


def test_a_pendulum_is_not_followed() -> None:
    assert not lg.example("double-pendulum").simulate(5.0).animate().motion.followed


def test_a_circuit_alone_has_nothing_that_moves() -> None:
    system = lg.System("oscillator")
    q = system.coordinate("q", unit="C")
    system.inductor(system.parameter("L", "1 mH"), q)
    system.capacitor(system.parameter("C", "1 uF"), q)
    run = system.simulate(1e-3, initial={"q": 1e-6})
    with pytest.raises(lg.RunError, match="nothing moves in the picture of 'oscillator'"):
        run.animate()
