"""Browser modules in Chromium, on a page without a server: against machine code, and where WebAssembly is forbidden."""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser_runs import CHROMIUM, SHOWN
from run_systems import ball

import lagrangian as lg
from lagrangian.simulate.browser import BrowserModule, browser_module

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")

POLICY = "default-src 'none'; script-src 'unsafe-inline'"


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as running:
        found = running.chromium.launch(executable_path=CHROMIUM)
        yield found
        found.close()


def in_page(browser: Any, module: BrowserModule, script: str, folder: Path, policy: str) -> Any:
    """What an asynchronous function of a page gives; the page makes no request and has no error."""
    path = folder / "page.html"
    head = f'<!doctype html><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{policy}">'
    path.write_text(f"{head}<script>{module.script()}{SHOWN}</script>", encoding="utf-8")
    page = browser.new_page()
    errors, requests = [], []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("request", lambda request: requests.append(request.url))
    page.goto(path.as_uri())
    found = page.evaluate(f"async () => {{ {script} }}")
    page.close()
    assert errors == [] and requests == [path.as_uri()]
    return found


SOLVE = """const s = await physics.solver(); const r = s.solve({t1: 1, samples: 11});
const states = r.states.map((x) => Array.from(x)), events = r.events.map((e) => e.t);
return {kind: s.kind, status: r.status, states, events};"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["double-pendulum", "four-bar", "crane"])
def test_a_run_on_a_page_is_that_of_machine_code(name: str, browser: Any, tmp_path: Path) -> None:
    system = lg.example(name)
    found = in_page(browser, browser_module(system), SOLVE, tmp_path, f"{POLICY} 'wasm-unsafe-eval'")
    assert (found["kind"], found["status"]) == ("wasm", 0)
    np.testing.assert_allclose(np.array(found["states"]).T, system.simulate(1.0, samples=11).y, rtol=1e-9, atol=1e-9)


@pytest.mark.slow
def test_a_page_that_forbids_webassembly_makes_fixed_steps(browser: Any, tmp_path: Path) -> None:
    system = lg.example("double-pendulum")
    found = in_page(browser, browser_module(system), SOLVE, tmp_path, POLICY)
    assert (found["kind"], found["status"]) == ("javascript", 0)
    np.testing.assert_allclose(np.array(found["states"]).T, system.simulate(1.0, samples=11).y, atol=1e-7)


@pytest.mark.slow
def test_events_are_found_on_a_page_and_refused_without_webassembly(browser: Any, tmp_path: Path) -> None:
    s = ball(e=0.5)
    y = s["y"]
    bounce = lg.event(y, direction=-1, reset={y.diff(): -s["e"] * y.diff()}, name="bounce")
    module = browser_module(s, events=bounce, initial={"y": 1.0})
    found = in_page(browser, module, SOLVE, tmp_path, f"{POLICY} 'wasm-unsafe-eval'")
    np.testing.assert_allclose(found["events"], np.sqrt(2 / 9.81) * np.array([1, 2]), rtol=1e-9)
    script = "return physics.solver().then(() => '', (error) => error.message);"
    assert "only by WebAssembly" in in_page(browser, module, script, tmp_path, POLICY)


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: Any) -> None:
        pass


@pytest.mark.slow
def test_the_page_of_the_manual_moves(browser: Any, tmp_path: Path) -> None:
    manual = (Path(__file__).parents[2] / "docs" / "browser.md").read_text(encoding="utf-8")
    (html,) = re.findall(r"```html\n(.*?)```", manual, re.DOTALL)
    html = html.replace("requestAnimationFrame(frame)", "{ last = state; requestAnimationFrame(frame); }")
    (tmp_path / "index.html").write_text(html.replace("<script>", "<script>let last;", 1), encoding="utf-8")
    lg.example("double-pendulum").export(tmp_path / "pendulum.wasm")
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(tmp_path)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        page = browser.new_page()
        errors = []
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(f"http://127.0.0.1:{server.server_port}/")
        page.wait_for_function("typeof last !== 'undefined' && Math.abs(last[0] - 2) > 0.1")
        page.close()
    finally:
        server.shutdown()
        server.server_close()
    assert errors == []
