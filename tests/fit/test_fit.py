"""Fits against linear regression, exact data, and the errors of data that do not fit."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.fit.problem import FitProblem
from lagrangian.simulate import allowance


def glider() -> lg.System:
    """A particle without forces: x = x₀ + v t."""
    system = lg.System("glider")
    x = system.coordinate("x")
    system.particle(system.parameter("m", 2.0), at=system.origin + (x, 0))
    return system


T = np.linspace(0.0, 2.0, 21)


def swings(noise: float = 0.0, seed: int = 1, t: Any = T) -> dict[str, Any]:
    """Both angles of a double pendulum with the declared parameters."""
    run = lg.example("double-pendulum").simulate(times=t, theta1=0.7, theta2=0.4)
    rng = np.random.default_rng(seed)
    return {"t": t, **{name: run[name] + noise * rng.normal(size=len(t)) for name in ("theta1", "theta2")}}


@pytest.mark.slow
def test_a_line_has_the_estimate_and_covariance_of_linear_regression() -> None:
    """numpy.polyfit solves the same problem, with σ² = Σ r²/(N − 2)."""
    values = 0.3 + 0.8 * T + 0.05 * np.random.default_rng(2).normal(size=21)
    found = glider().fit({"t": T, "x": values}, ["x'", "x"])
    slope, cov = np.polyfit(T, values, 1, cov=True)
    np.testing.assert_allclose([found.estimate["x'"], found.estimate["x"]], slope, rtol=1e-8)
    np.testing.assert_allclose(found.covariance, cov, rtol=1e-6)
    assert found.dof == 19
    low, high = found.interval("x'")
    assert high - low == pytest.approx(
        2 * 2.093024 * np.sqrt(cov[0, 0]), rel=1e-5
    )  # Student's t of 19, a table's value
    np.testing.assert_allclose(found.residuals[0]["x"], np.polyval(slope, T) - values, atol=1e-9)


def test_a_report_without_sigma_does_not_praise_the_fit_and_tells_residuals_that_are_no_noise() -> None:
    """The data accelerate, the glider does not: σ is estimated from the misfit, and the residuals form an arc."""
    noise = 0.01 * np.random.default_rng(2).normal(size=101)
    t = np.linspace(0.0, 2.0, 101)
    right, wrong = (str(glider().fit({"t": t, "x": 0.3 + 0.8 * t + a * t**2 + noise}, ["x'", "x"])) for a in (0.0, 0.5))
    assert "it says nothing of it" in right and "range of the data" in right and "not random" not in right
    assert "χ² = " not in right and "residuals of x are not random" in " ".join(wrong.split())


def test_a_given_sigma_is_taken_as_it_is() -> None:
    """The covariance is (XᵀX)⁻¹ σ², whatever is left over."""
    values = 0.3 + 0.8 * T + 0.05 * np.random.default_rng(2).normal(size=21)
    found = glider().fit({"t": T, "x": values}, ["x'", "x"], sigma=0.1)
    X = np.stack([T, np.ones(21)], axis=1)
    np.testing.assert_allclose(found.covariance, 0.01 * np.linalg.inv(X.T @ X), rtol=1e-7)
    low, high = found.interval("x", 0.95)
    assert high - low == pytest.approx(2 * 1.959964 * found.std["x"], rel=1e-6)
    assert found.known_sigma
    assert found.chi2 == pytest.approx(float(np.sum(found.residuals[0]["x"] ** 2)) / 0.01)


def test_missing_samples_count_as_not_measured() -> None:
    values = 0.3 + 0.8 * T + 0.05 * np.random.default_rng(2).normal(size=21)
    holes = values.copy()
    holes[[3, 4, 17]] = np.nan
    kept = np.isfinite(holes)
    found = glider().fit({"t": T, "x": holes}, ["x'", "x"])
    other = glider().fit({"x": (T[kept], values[kept])}, ["x'", "x"])
    np.testing.assert_allclose(found.covariance, other.covariance, rtol=1e-7)
    assert found.dof == 16
    np.testing.assert_array_equal(np.isnan(found.residuals[0]["x"]), ~kept)


@pytest.mark.slow
def test_columns_have_their_own_times_and_may_be_expressions() -> None:
    early, late = np.linspace(0, 1, 11), np.linspace(0.5, 2, 7)
    data = {"x": (early, 1 + 0.5 * early), "m*x'^2/2": (late, np.full(7, 0.5 * 3.0 * 0.25))}
    found = glider().fit(data, {"x'": 0.4, "x": 0.0, "m": 2.5})
    assert found.estimate["m"] == pytest.approx(3.0, rel=1e-7)
    assert found.success
    assert len(found.runs[0].t) == len(np.union1d(early, late))


@pytest.mark.slow
def test_several_runs_share_parameters_and_have_their_own_initial_values() -> None:
    system = lg.example("pendulum")
    runs = [system.simulate(times=T, theta=x, params={"L": 0.9}) for x in (0.3, 0.8)]
    data = [{"t": run.t, "theta": run["theta"]} for run in runs]
    found = system.fit(data, {"L": None, "theta": [0.2, 1.0]})
    assert found.names == ("L", "theta[0]", "theta[1]")
    np.testing.assert_allclose([found.estimate[x] for x in found.names], [0.9, 0.3, 0.8], rtol=1e-6)
    known = system.fit(data, ["L"], initial=[{"theta": 0.3}, {"theta": 0.8}])
    assert known.estimate["L"] == pytest.approx(0.9, rel=1e-7)
    np.testing.assert_allclose(known.runs[1]["theta"], runs[1]["theta"], atol=1e-6)


@pytest.mark.slow
def test_constants_that_cannot_be_told_apart_are_named() -> None:
    """Without forces but weights only m₁/m₂, L₁/g and L₂/g count; without a period known nothing else does."""
    found = lg.example("double-pendulum").fit(swings(0.001), ["m1", "m2", "L1", "L2", "g"], theta1=0.7, theta2=0.4)
    assert {x.names: tuple(np.round(x.proportions, 4)) for x in found.undetermined} == {
        ("m1", "m2"): (1.0, 1.0),
        ("L1", "L2", "g"): (1.0, 1.0, 1.0),
    }
    assert all(x.relative for x in found.undetermined)
    assert np.isinf(found.std["m1"])
    assert "m1, m2" in str(found)
    with pytest.raises(lg.RunError, match="not determined"):
        found.contains(found.estimate)
    one = glider().fit({"t": T, "x": 0.8 * T}, ["m", "x'"])
    assert [x.names for x in one.undetermined] == [("m",)]
    assert one.std["x'"] < 1e-9


def test_a_bound_holds_and_is_named() -> None:
    found = lg.example("pendulum").fit(
        {"t": T, "theta": lg.example("pendulum").simulate(times=T, theta=0.5, params={"L": 0.9})["theta"]},
        {"L": 1.0, "theta": 0.5},
        bounds={"L": (0.95, None)},
    )
    assert found.at_bound == ("L",)
    assert found.estimate["L"] == pytest.approx(0.95)
    assert np.isnan(found.std["L"])
    assert "on a bound" in found.to_text()


@pytest.mark.slow
def test_masses_that_cannot_be_are_not_tried() -> None:
    """The residuals of a mass at or below 0 are infinite, so that the search takes smaller steps."""
    system = lg.example("double-pendulum")
    run = system.simulate(times=T, theta1=0.7, theta2=0.4, params={"m2": 0.02})
    found = system.fit({"t": T, "theta1": run["theta1"], "theta2": run["theta2"]}, ["m2"], theta1=0.7, theta2=0.4)
    assert found.estimate["m2"] == pytest.approx(0.02, rel=1e-5)


@pytest.mark.slow
def test_a_constant_input_is_an_unknown_too() -> None:
    system = glider()
    F = system.input("F")
    system.force((F, 0), at=system.origin + (system["x"], 0), name="wind")
    found = system.fit({"t": T, "x": 0.25 * T**2}, {"F": 0.7})
    assert found.estimate["F"] == pytest.approx(1.0, rel=1e-8)


@pytest.mark.slow
def test_the_result_is_written_and_saved() -> None:
    found = lg.example("double-pendulum").fit(swings(0.01), ["m2", "L1"], theta1=0.7, theta2=0.4)
    assert found.to_dict()["unknowns"] == ["m2", "L1"]
    assert "95 % interval" in found.to_markdown()
    assert repr(found).startswith("<Fit 'double pendulum': m2 = ")
    assert set(found.intervals(0.9)) == {"m2", "L1"}
    assert found.correlation[0, 0] == pytest.approx(1.0)
    with pytest.raises(lg.Error, match="the fit has no unknown 'm3'"):
        found.interval("m3")
    with pytest.raises(lg.RunError, match="between 0 and 1"):
        found.interval("m2", 95)


GOOD = {"t": T, "x": 0.8 * T}


@pytest.mark.parametrize(
    ("data", "parameters", "options", "code", "said"),
    [
        (GOOD, ["mass"], {}, "E402", "nothing called 'mass' to fit"),
        (GOOD, [], {}, "E401", "names nothing"),
        (GOOD, 3, {}, "E501", "names to first guesses"),
        (GOOD, {"m": "heavy"}, {}, None, "first guess of 'm'"),
        (GOOD, {"m": [1.0]}, {}, "E501", "one value for a parameter"),
        (GOOD, ["m", sp.Symbol("m", positive=True)], {}, "E404", "twice"),
        ([1.0, 2.0], ["m"], {}, "E501", "columns by name"),
        ([], ["m"], {}, "E401", "no run"),
        ({"t": T}, ["m"], {}, "E401", "no column beside the times"),
        ({"x": T}, ["m"], {}, "E401", "has no times"),
        ({"t": T, "y": T}, ["m"], {}, "E402", "y"),
        ({"t": T, "x": T[:-1]}, ["m"], {}, "E501", "one value for each time"),
        ({"t": T[::-1], "x": T}, ["m"], {}, "E501", "do not increase"),
        ({"t": np.where(T == 1, np.nan, T), "x": T}, ["m"], {}, "E502", "every sample needs a time"),
        ({"t": T, "x": T * np.nan}, ["m"], {}, "E502", "every sample is missing"),
        ({"t": T, "x": np.where(T == 1, np.inf, T)}, ["m"], {}, "E502", "NaN marks a missing sample"),
        ({"t": T, "x": ["a"] * 21}, ["m"], {}, "E501", "real numbers"),
        ({"t": [0.0], "x": [1.0]}, ["m"], {}, "E501", "two or more"),
        ([GOOD, {"t": T, "x'": T}], ["m"], {}, "E501", "the same columns"),
        ([GOOD, GOOD], ["m"], {"initial": [{}]}, "E501", "1 entries for 2 runs"),
        (GOOD, ["m"], {"sigma": 0}, "E501", "above 0"),
        (GOOD, ["m"], {"sigma": {"y": 1}}, "E402", "no column 'y'"),
        ({**GOOD, "x'": T}, ["m"], {"sigma": {"x": 1}}, "E401", "is missing"),
        (GOOD, ["m"], {"bounds": {"x": (0, 1)}}, "E402", "not an unknown"),
        (GOOD, ["m"], {"bounds": {"m": 1}}, "E501", "two values"),
        (GOOD, ["m"], {"bounds": {"m": (2, 1)}}, "E501", "are empty"),
        (GOOD, ["m"], {"bounds": {"m": (3, 4)}}, "E501", "not between its bounds"),
        (GOOD, ["m"], {"bounds": 3}, "E501", "a mapping"),
        (GOOD, ["m"], {"inputs": 3}, "E501", "inputs must be a mapping"),
        (GOOD, ["m"], {"params": [1.0, 2.0]}, "E501", "params must be a mapping"),
        (GOOD, ["m"], {"start": 1.0}, "E501", "after the first sample"),
        (GOOD, ["m"], {"max_evaluations": 0}, "E501", "whole number"),
        (GOOD, ["m"], {"y": 1.0}, "E402", "no option or state 'y'"),
        ({"t": T[:2], "x": T[:2]}, ["m", "x", "x'"], {}, "E501", "cannot determine 3 unknowns"),
    ],
)
def test_what_does_not_fit_is_said(data: Any, parameters: Any, options: Any, code: str | None, said: str) -> None:
    with pytest.raises(lg.Error) as caught:
        glider().fit(data, parameters, **options)
    assert said in str(caught.value)
    assert code is None or caught.value.code == code


def test_a_first_guess_that_is_impossible_is_an_error() -> None:
    with pytest.raises(lg.ModelError, match="mass"):
        glider().fit(GOOD, {"m": -1.0})
    with pytest.raises(lg.RunError, match="an event ends the run"):
        x = glider()
        x.fit(GOOD, ["m"], events=lg.event(x["x"] - 1, terminal=True), initial={"x'": 0.8})


@pytest.mark.slow
def test_the_stated_confidence_is_that_of_a_hundred_draws() -> None:
    """A noisy double pendulum: of 100 draws of the noise, about 95 have the truth in the joint region of 95 %.

    So do the intervals of each unknown. The draws are always the same. A right region has 90 to 99 of 100 with a
    probability of 0.98 (binomial distribution), and one with a wrong scale is far from that.
    """
    system, names = lg.example("double-pendulum"), ["m2", "L1", "L2", "theta1", "theta2"]
    truth = {"m2": 1.0, "L1": 1.0, "L2": 1.0, "theta1": 0.7, "theta2": 0.4}
    start = {"m2": 1.2, "L1": 0.95, "L2": 1.05, "theta1": 0.65, "theta2": 0.45}
    joint, each = 0, dict.fromkeys(names, 0)
    for draw in range(100):
        found = system.fit(swings(0.02, seed=draw, t=np.linspace(0, 4, 101)), start)
        assert found.success
        joint += found.contains(truth)
        for name in names:
            low, high = found.interval(name)
            each[name] += low <= truth[name] <= high
    assert 90 <= joint <= 99
    assert all(90 <= count <= 99 for count in each.values()), each


# -- what its arguments and its words must be ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"sigma": "1 kg"}, "sigma of 'theta' = '1 kg' has the unit kg"),
        ({"sigma": {"theta": "1 kg"}}, "has the unit kg"),
        ({"start": "0 kg"}, "start = '0 kg' has the unit kg, but s is needed"),
        ({"rtol": "1 kg"}, "rtol = '1 kg' has the unit kg"),
    ],
)
def test_units_of_options_are_checked(options: dict[str, Any], said: str) -> None:
    with pytest.raises(lg.RunError, match=said):
        lg.example("pendulum").fit({"t": T, "theta": 0.1 * T}, ["L"], **options)


def test_units_of_values_that_are_asked_about_are_checked() -> None:
    run = lg.example("pendulum").simulate(times=T, theta=0.5)
    noise = 0.01 * np.random.default_rng(1).normal(size=21)
    found = lg.example("pendulum").fit({"t": T, "theta": run["theta"] + noise}, ["L"], theta=0.5)
    assert found.contains({"L": "50 cm"}) == found.contains({"L": 0.5})
    with pytest.raises(lg.RunError, match="but m is needed"):
        found.contains({"L": "1 s"})


@pytest.mark.slow
def test_a_fit_names_unknowns_and_units_as_they_are_written_in_formulas() -> None:
    """A length L is no Lagrangian, and the unit V no potential energy, whatever letters the page needs for these."""
    system = lg.System("coil")
    q = system.coordinate("q", unit="C")
    V, L, R = system.parameters("V L R", V="2 V", L="1 H", R="1 ohm")
    system.inductor(L, q)
    system.resistor(R, q)
    system.voltage_source(V, q)
    run = system.simulate(times=T)
    page = str(system.fit({"t": T, "q'": run["q'"]}, {"V": 1.0, "L": 2.0, "q'": 0.1}))
    table = [line.split() for line in page.splitlines() if line.endswith((" V", " H", " A"))]
    assert [(row[0], row[-1]) for row in table] == [("V", "V"), ("L", "H"), ("q̇", "A")]


def test_how_a_search_ended_is_said_in_words_of_its_own() -> None:
    run = lg.example("pendulum").simulate(times=T, theta=0.5)
    found = lg.example("pendulum").fit({"t": T, "theta": run["theta"]}, {"L": 0.6}, theta=0.5, max_evaluations=1)
    assert found.message == "max_evaluations were not enough"
    assert "The search did not end at a minimum: max_evaluations were not enough.\n" in str(found)


FAR = {"t": T, "theta1": 40 * T**2 + 5, "theta2": -30 * np.cos(9 * T)}
"""Angles that no double pendulum has."""


@pytest.mark.sampled(3)
@pytest.mark.parametrize("most", [1, 7, 60])
def test_the_evaluations_of_all_searches_together_are_limited(monkeypatch: pytest.MonkeyPatch, most: int) -> None:
    """The unknowns cannot be told apart either. A few more evaluations belong to the start and to the estimate."""
    counted = list[int]()
    compute = FitProblem._computed
    monkeypatch.setattr(FitProblem, "_computed", lambda self, z: counted.append(1) or compute(self, z))
    found = lg.example("double-pendulum").fit(
        FAR, ["m1", "m2", "L1", "L2", "g"], theta1=0.7, theta2=0.4, max_evaluations=most
    )
    assert len(counted) <= most + 20
    assert not found.success and found.message == "max_evaluations were not enough"
    assert "The search did not end at a minimum" in str(found)


def test_a_timeout_ends_the_whole_fit_and_the_best_so_far_is_returned(monkeypatch: pytest.MonkeyPatch) -> None:
    """By a clock that goes on by a second whenever it is read: it is not the machine's time that counts."""
    ticks = iter(range(10**6))
    monkeypatch.setattr(allowance, "time", SimpleNamespace(monotonic=lambda: next(ticks)))
    found = lg.example("double-pendulum").fit(FAR, ["m1", "m2", "L1", "L2", "g"], theta1=0.7, theta2=0.4, timeout=5.0)
    assert next(ticks) < 30
    assert not found.success and found.message == "timeout was not enough"
    start = lg.example("double-pendulum").simulate(times=T, theta1=0.7, theta2=0.4)
    away = sum(float(np.sum((start[name] - FAR[name]) ** 2) / np.ptp(FAR[name]) ** 2) for name in ("theta1", "theta2"))
    left = sum(float(np.sum(found.residuals[0][name] ** 2) / np.ptp(FAR[name]) ** 2) for name in ("theta1", "theta2"))
    assert left < away
