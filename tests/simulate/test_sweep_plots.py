"""Pictures of many runs: what is drawn is what was computed."""

import pathlib

import numpy as np
import pytest

import built_in
import lagrangian as lg
from lagrangian.cli import main
from lagrangian.view.many import SweptAxis, SweptResult, draw_many

FAST = {"method": "rk4", "step": 0.02, "outputs": {"swing": "max theta2", "reach": "max L1*sin(theta1)"}, "times": 51}


@pytest.fixture(scope="module")
def system() -> lg.System:
    return built_in.system("double-pendulum")


def test_one_axis_is_a_curve_angles_in_degrees(system: lg.System) -> None:
    runs = system.sweep(1.0, ["theta1=10deg:90deg:9"], **FAST)
    first, second = runs.plot().axes
    x, y = first.lines[0].get_data()
    np.testing.assert_allclose(x, np.linspace(10, 90, 9))
    np.testing.assert_allclose(y, np.degrees(runs["swing"]))
    assert first.get_xlabel() == "theta1 [deg]"
    assert first.get_ylabel() == "swing [deg]"
    assert second.get_ylabel() == "reach [m]"


def test_two_axes_are_a_map_and_logarithmic_values_a_logarithmic_axis(system: lg.System) -> None:
    runs = system.sweep(1.0, ["theta1=0.1:1:5", "m1=0.1:10:7:log"], **FAST)
    figure = runs.plot("reach")
    panel = figure.axes[0]
    assert panel.get_yscale() == "log"
    assert panel.get_ylabel() == "m1 [kg]"
    np.testing.assert_allclose(panel.collections[0].get_array(), runs["reach"].T)


def test_samples_are_a_histogram_or_a_band(system: lg.System) -> None:
    runs = system.sweep(1.0, ["m1~normal(1, 0.1)"], draws=40, **FAST)
    panel = runs.plot("reach").axes[0]
    assert sum(bar.get_height() for bar in panel.containers[0]) == 40
    runs = system.sweep(1.0, ["theta1=0.5:1:4", "m1~normal(1, 0.1)"], draws=40, **FAST)
    panel = runs.plot("reach").axes[0]
    np.testing.assert_allclose(panel.lines[0].get_ydata(), np.median(runs["reach"], axis=1))


def test_what_failed_is_left_out_and_said_where_nothing_is_left() -> None:
    nan = np.full((3, 4), np.nan)
    some = nan.copy()
    some[0] = [1, 2, 3, np.nan]
    x = SweptAxis("k", "N/m", np.array([1.0, 2.0, 3.0]))
    figure = draw_many("test", (x,), (SweptResult("a", "m", some), SweptResult("b", "m", nan)))
    np.testing.assert_array_equal(figure.axes[0].lines[0].get_ydata(), [2, np.nan, np.nan])
    assert figure.axes[1].texts[0].get_text() == "every run failed"


@pytest.mark.slow
def test_the_command_draws(tmp_path: pathlib.Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.png"
    given = ["sweep", "-e", "double-pendulum", "theta1=0.1:1:5", "--duration", "1", "--plot", str(path)]
    assert main(given) == 0
    assert path.read_bytes().startswith(b"\x89PNG")
    assert main(given) == 2
    assert "exists" in capsys.readouterr().err


def test_samples_kept_are_not_one_number(system: lg.System) -> None:
    runs = system.ensemble(1.0, theta1=[0.1, 0.2], reduce=None, method="rk4", step=0.02, times=5)
    with pytest.raises(lg.RunError, match="a single number per run"):
        runs.plot()
    with pytest.raises(lg.RunError, match="there is no result 'reech'"):
        runs.plot("reech")
