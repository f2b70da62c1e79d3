"""Plots: what is on them, that they say units and names, and that nothing global is touched."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest

import built_in
import lagrangian as lg
from lagrangian.view import Marks, Panel, Plotted, Series, draw

matplotlib.use("Agg")


@pytest.fixture(autouse=True)
def _closed() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def run() -> lg.Trajectory:
    s = built_in.system("cart-pole")
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
    s = built_in.system("pendulum")
    swing = s.simulate(5.0, theta=0.5, events=lg.event(s["theta"], name="low"))
    figure: Any = swing.plot(audit=True, energy=False)
    assert labels(figure) == [r"$\theta$ [deg]", r"$\Delta E$ [J]"]
    verticals = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 2]
    assert [line.get_xdata()[0] for line in verticals] == pytest.approx(swing.events["low"].t)


def test_angles_that_go_round_are_drawn_in_turns() -> None:
    s = built_in.system("pendulum")
    figure = s.simulate(10.0, initial={"theta'": 40.0}, params={"b": 0.0}).plot(energy=False)
    assert labels(figure) == [r"$\theta$ [turns]"]


@pytest.mark.slow
def test_pictures_are_written_and_figures_touch_nothing_global(run: lg.Trajectory, tmp_path: Path) -> None:
    before = plt.get_fignums()
    run.figure().savefig(tmp_path / "run.png")
    assert (tmp_path / "run.png").read_bytes().startswith(b"\x89PNG")
    figure: Any = run.figure()
    assert figure._repr_png_().startswith(b"\x89PNG")
    assert plt.get_fignums() == before


def test_plots_are_pyplots_own(run: lg.Trajectory) -> None:
    figure = run.plot()
    assert figure.number in plt.get_fignums()  # plt.show() opens it


def test_a_notebook_shows_a_plot_once(run: lg.Trajectory, monkeypatch: pytest.MonkeyPatch) -> None:
    figure: Any = run.plot()
    monkeypatch.setattr(matplotlib, "get_backend", lambda: "inline")
    with pytest.raises(NotImplementedError):  # IPython then shows it in the usual way
        figure._ipython_display_()
    assert figure.number not in plt.get_fignums()  # and the end of the cell not again


def test_the_first_figure_of_a_notebook_leaves_pyplot_interactive(
    run: lg.Trajectory, monkeypatch: pytest.MonkeyPatch
) -> None:
    """IPython's backend turns it on while it makes its first figure, and shows none that is made while it is off."""
    made, limit = plt.figure, plt.rcParams["figure.max_open_warning"]

    def first(*given: Any, **named: Any) -> Any:
        plt.ion()
        return made(*given, **named)

    monkeypatch.setattr(plt, "figure", first)
    try:
        plt.close(run.plot())
        assert plt.isinteractive()
        assert plt.rcParams["figure.max_open_warning"] == limit
    finally:
        plt.ioff()


def test_plots_in_another_thread_are_not_pyplots(run: lg.Trajectory) -> None:
    before = plt.get_fignums()
    made: list[Any] = []
    thread = threading.Thread(target=lambda: made.append(run.plot()))
    thread.start()
    thread.join()
    assert made
    assert plt.get_fignums() == before


def test_a_run_that_failed_is_marked(run: lg.Trajectory) -> None:
    failed = built_in.system("pendulum").simulate(20.0, theta=0.5, max_steps=60)
    figure: Any = failed.plot()
    assert "FAILED: stopped at" in " ".join(figure.get_suptitle().split())
    cross = figure.axes[0].lines[-1]
    assert (cross.get_marker(), cross.get_xdata()[0]) == ("x", failed.t[-1])
    assert "FAILED" not in run.plot().get_suptitle()


def test_runs_of_a_sweep_that_failed_are_marked() -> None:
    runs = built_in.system("pendulum").sweep(0.1, {"m": [-1.0, 1.0, 2.0]}, theta=0.3)
    figure: Any = runs.plot("final theta")
    assert "1 of 3 runs FAILED" in figure.get_suptitle()
    assert list(figure.axes[0].lines[-1].get_xdata()) == [-1.0]
    assert figure.number in plt.get_fignums()
    before = plt.get_fignums()
    runs.figure("final theta")
    assert plt.get_fignums() == before


def test_the_name_of_a_file_is_not_a_quantity(run: lg.Trajectory) -> None:
    for name in ("run.png", Path("run.pdf")):
        with pytest.raises(lg.ModelError, match=r"run\.plot\(\)\.savefig"):
            run.plot(name)


def test_names_cannot_become_markup() -> None:
    series = Series(r"\no{such", "a$b_c", np.zeros(3))
    figure = draw(Plotted("cost $5 _ ^", np.arange(3.0), (Panel("", "", (series, series)),), (Marks("m", np.ones(1)),)))
    figure.canvas.draw()
    assert legends(figure.axes[0]) == [r"a\$b_c"] * 2


@pytest.mark.slow
def test_a_single_instant_and_a_constant_are_drawn() -> None:
    s = built_in.system("pendulum")
    s.simulate(0).plot().canvas.draw()
    flat = draw(Plotted("", np.arange(3.0), (Panel("", "m", (Series("c", "c", np.full(3, 2.0)),)),)))
    assert flat.axes[0].get_ylim() == pytest.approx((-2.4, 2.4))


def test_without_matplotlib_the_line_that_installs_it_is_told(
    run: lg.Trajectory, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(lg.MissingExtra, match=r"pip install 'lagrangian\[plot\]'"):
        run.plot()
