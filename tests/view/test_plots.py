"""Plots: what is on them, that they say units and names, and that nothing global is touched."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib import _pylab_helpers

import lagrangian as lg
from lagrangian import examples
from lagrangian.view import Marks, Panel, Picture, Series, draw


@pytest.fixture(scope="module")
def run() -> lg.Trajectory:
    s = lg.loads(examples.text("cart-pole"))
    return s.simulate(3.0, inputs={"F": "sin(t)"}, samples=101)


def labels(figure: Any) -> list[str]:
    return [axes.get_ylabel() for axes in figure.axes]


def legends(axes: Any) -> list[str]:
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_a_plot_without_options_shows_coordinates_inputs_and_energies(run: lg.Trajectory) -> None:
    figure = run.plot()
    assert labels(figure) == ["$x$ [m]", r"$\theta$ [deg]", "$F$ [N]", "energy [J]"]
    x, theta, _, energy = figure.axes
    assert np.array_equal(x.lines[0].get_ydata(), run["x"])
    assert theta.lines[0].get_ydata() == pytest.approx(np.degrees(run["theta"]))
    assert legends(energy) == ["$T^{*}$", "$V$", "$T^{*} + V$"]
    assert figure.axes[-1].get_xlabel() == "$t$ [s]"
    assert figure.axes[0].get_xlim() == (0.0, 3.0)
    assert figure.get_suptitle() == "pole on a cart"


def test_asked_quantities_of_one_unit_share_a_panel(run: lg.Trajectory) -> None:
    s = run.model.symbols
    figure = run.plot("theta'", s["x"].diff(), "2*theta'", "x''", "sin(theta)*l")
    assert labels(figure) == [
        "angular velocity [rad/s]",
        r"$\dot{x}$ [m/s]",
        r"$\ddot{x}$ [m/s²]",
        r"$l \sin \theta$ [m]",
    ]
    assert legends(figure.axes[0])[0] == r"$\dot{\theta}$"
    with pytest.raises(lg.ModelError, match="unknown symbol 'y'"):
        run.plot("y")


def test_the_audit_and_events_are_drawn(run: lg.Trajectory) -> None:
    s = lg.loads(examples.text("pendulum"))
    swing = s.simulate(5.0, theta=0.5, events=lg.event(s["theta"], name="low"))
    figure = swing.plot(audit=True, energy=False)
    assert labels(figure) == [r"$\theta$ [deg]", r"$\Delta E$ [J]"]
    verticals = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 2]
    assert [line.get_xdata()[0] for line in verticals] == pytest.approx(swing.events["low"].t)


def test_angles_that_go_round_are_drawn_in_turns() -> None:
    s = lg.loads(examples.text("pendulum"))
    figure = s.simulate(10.0, initial={"theta'": 40.0}, params={"b": 0.0}).plot(energy=False)
    assert labels(figure) == [r"$\theta$ [turns]"]


def test_pictures_are_written_and_nothing_global_is_touched(run: lg.Trajectory, tmp_path: Path) -> None:
    loaded = "matplotlib.pyplot" in sys.modules  # python-control loads it, and may have been here before
    run.plot().savefig(tmp_path / "run.png")
    assert (tmp_path / "run.png").read_bytes().startswith(b"\x89PNG")
    assert run.plot()._repr_png_().startswith(b"\x89PNG")
    assert ("matplotlib.pyplot" in sys.modules) == loaded
    assert not _pylab_helpers.Gcf.figs  # the figures that pyplot keeps


def test_names_cannot_become_markup() -> None:
    series = Series(r"\no{such", "a$b_c", np.zeros(3))
    figure = draw(Picture("cost $5 _ ^", np.arange(3.0), (Panel("", "", (series, series)),), (Marks("m", np.ones(1)),)))
    figure.canvas.draw()
    assert legends(figure.axes[0]) == [r"a\$b_c"] * 2


def test_a_single_instant_and_a_constant_are_drawn() -> None:
    s = lg.loads(examples.text("pendulum"))
    s.simulate(0).plot().canvas.draw()
    flat = draw(Picture("", np.arange(3.0), (Panel("", "m", (Series("c", "c", np.full(3, 2.0)),)),)))
    assert flat.axes[0].get_ylim() == pytest.approx((-2.4, 2.4))


def test_without_matplotlib_the_line_that_installs_it_is_told(
    run: lg.Trajectory, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(lg.MissingExtra, match=r"pip install 'lagrangian\[plot\]'"):
        run.plot()
