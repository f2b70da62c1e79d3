"""What notebooks show: every result is a piece of HTML of its own, and names from outside stay text."""

from __future__ import annotations

import copy
import pickle
from html.parser import HTMLParser
from typing import Any

import pytest

import built_in
import lagrangian as lg
from lagrangian import examples


class Balance(HTMLParser):
    """Every tag is closed by its own."""

    def __init__(self) -> None:
        super().__init__()
        self.opened: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        if tag not in ("br", "col", "meta"):
            self.opened.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.opened.pop() == tag


@pytest.fixture(scope="module")
def results() -> dict[str, Any]:
    system = lg.loads(examples.text("pendulum").replace('name = "', 'name = "<b>&', 1))
    derivation = system.derive()
    return {
        "system": system,
        "step": derivation.steps[6],
        "ledger": derivation.ledger,
        "modes": system.linearize().modes,
        "run": system.simulate(1.0, theta=0.3, samples=5),
        "ensemble": system.sweep(1.0, {"theta": [0.1, 0.2]}),
    }


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("system", ["Elements", "θ"]),
        ("step", ["Ξ", "Why:"]),
        ("ledger", ["counted in", "T*"]),
        ("modes", ["Poles and modes"]),
        ("run", ["theta", "greatest", "dop853"]),
        ("ensemble", ["2 runs", "how the runs ended"]),
    ],
)
def test_a_notebook_shows_a_piece_of_html(results: dict[str, Any], name: str, words: list[str]) -> None:
    shown = results[name]._repr_html_()
    assert shown.startswith('<div class="lagrangian"') and shown.rstrip().endswith("</div>")
    assert "<b>" not in shown and "<script" not in shown
    for word in words:
        assert word in shown
    balance = Balance()
    balance.feed(shown)
    assert not balance.opened


def test_a_system_that_is_not_complete_is_shown_too() -> None:
    assert "0 coordinates" in lg.System("empty")._repr_html_()


def test_what_a_notebook_shows_can_be_copied(results: dict[str, Any]) -> None:
    ledger = results["ledger"]
    steps = built_in.derivation("pendulum").steps
    shown = copy.copy(steps)._repr_html_()
    assert shown.count("<h2>") == len(steps) == 7 and "Kinetic co-energy" in shown and "Result" not in shown
    assert copy.copy(ledger) == ledger and copy.copy(ledger)._repr_html_() == ledger._repr_html_()
    modes = results["modes"]
    assert pickle.loads(pickle.dumps(tuple(modes))) == tuple(modes)


def test_a_view_follows_the_theme_of_its_notebook() -> None:
    html = lg.example("pendulum").linearize()._repr_html_()
    for theme, paper in (("true", "#fdfdfb"), ("false", "#16191c")):
        rule = html.partition(f'[data-jp-theme-light="{theme}"]')[2].partition("}")[0]
        assert f"--paper: {paper};" in rule
        assert ") & {" in rule


def test_pictures_follow_the_theme_of_their_notebook() -> None:
    system = lg.example("pendulum")
    pair = lg.compare(system, lg.example("double-pendulum")).look()
    for view in (system.look()._repr_html_(), system.derive()._repr_html_(), pair._repr_html_()):
        for theme, paper in (("true", "#fdfdfb"), ("false", "#16191c")):
            after = view.split(f'[data-jp-theme-light="{theme}"]')[1:]
            rules = [x.partition("}")[0] for x in after if ".lagrangian-scene{" in x.partition("}")[0]]
            assert len(rules) == 1 and f"--paper:{paper};" in rules[0]
    assert "data-jp-theme" not in system.look().to_svg()


def test_a_view_without_its_style_says_what_is_missing() -> None:
    """JupyterLab removes styles and MathML from what a notebook that is not trusted holds; then ½ becomes 12."""
    view = lg.example("pendulum").linearize()._repr_html_()
    assert "\n.stripped { display: none; }" in view.partition("</style>")[0]
    assert '<p class="stripped">This notebook is not trusted' in view


def test_sensitivities_show_their_last_values() -> None:
    found = lg.example("pendulum").simulate(1.0, theta=0.5).sensitivities(["L", "theta"])
    html = found._repr_html_()
    assert "by L" in html
    assert "by theta" in html
    assert f"{found['theta', 'L'][-1]:.6g}" in html
    whole = lg.example("double-pendulum").simulate(1.0, theta1=0.5).sensitivities()
    assert ("more columns" in whole._repr_html_()) == (len(whole.wrt) > 8)
