"""Ensembles over a system of any kind: designs, chunks, reductions."""

from itertools import pairwise

import numpy as np
import pytest
from slow_solver import SlowSolver

from lagrangian.errors import RunError
from lagrangian.graph import Graph, Output, Program
from lagrangian.integrate import ensemble
from lagrangian.integrate.chunks import Portions, cut
from lagrangian.integrate.design import Design, DesignColumn, RandomColumn
from lagrangian.integrate.ensemble import Memory, carry_out
from lagrangian.integrate.observe import Kept, Study


def oscillator() -> tuple[Program, Program]:
    """ẍ = u − ω² x, and its energy; ω is the parameter."""
    g = Graph()
    x, v, u, w = g.input("x", 0), g.input("x", 1), g.input("u", 0), g.input("p", 0)
    groups = {"x": ("x", "x'"), "u": ("u",), "p": ("omega",), "t": ("t",)}
    stiffness = g.mul(w, w)
    rate = Output((v, g.sub(u, g.mul(stiffness, x))), (2,))
    energy = g.mul(g.const(0.5), g.add(g.mul(v, v), g.mul(stiffness, g.mul(x, x))))
    outputs = {"x": Output((x,), ()), "energy": Output((energy,), ())}
    values = {"omega": 2.0}
    return Program("oscillator", g, groups, {"xdot": rate}, values), Program("seen", g, groups, outputs, values)


def study(kept, times) -> Study:
    program, outputs = oscillator()
    return Study(program, "rk4", np.asarray(times, float), outputs, tuple(kept))


BASE = {"x": np.array([1.0, 0.0]), "u": np.zeros(1), "p": np.array([2.0])}


@pytest.fixture
def slow(monkeypatch):
    monkeypatch.setattr(ensemble, "solver_of", lambda study, threads: SlowSolver(study.program))


@pytest.mark.parametrize("memory", [10**9, 4000, 1])
def test_reductions_of_an_oscillator_against_its_closed_form(slow, memory: int) -> None:
    amplitudes, omegas = np.array([0.5, 1.0, 2.0]), np.array([1.0, 1.5])
    design = Design(
        ("x", "omega"),
        (3, 2),
        BASE,
        [DesignColumn("x", 0, "x", amplitudes[:, None]), DesignColumn("p", 0, "omega", omegas[None, :])],
    )
    kept = [Kept(f"{r} x", "x", r) for r in ("final", "max", "min", "mean", "rms", "range")]
    kept += [Kept("max energy", "energy", "max"), Kept("x", "x", None)]
    times = np.linspace(0, 2 * np.pi, 41)
    s = study(kept, times)
    portions = cut(design.shape, s.bytes_per_run, memory=memory)
    sink = Memory(s, portions)
    seen: list[tuple[int, int]] = []
    carry_out(s, design, portions, sink, progress=lambda *at: seen.append(at))
    a, w = amplitudes[:, None], omegas[None, :]
    exact = a[..., None] * np.cos(w[..., None] * times)
    r = sink.arrays
    close = {"rtol": 0, "atol": 2e-5}
    np.testing.assert_allclose(r["x"], exact, **close)
    np.testing.assert_allclose(r["final x"], a * np.cos(w * 2 * np.pi), **close)
    np.testing.assert_allclose(r["max x"], exact.max(-1), **close)
    np.testing.assert_allclose(r["min x"], exact.min(-1), **close)
    np.testing.assert_allclose(r["range x"], exact.max(-1) - exact.min(-1), **close)
    np.testing.assert_allclose(r["mean x"], a * np.sin(w * 2 * np.pi) / (w * 2 * np.pi), rtol=0, atol=5e-3)
    np.testing.assert_allclose(r["rms x"], np.broadcast_to(a / np.sqrt(2), (3, 2)), rtol=2e-2)
    np.testing.assert_allclose(r["max energy"], (w * a) ** 2 / 2, rtol=1e-4)
    assert (r["status"] == 0).all()
    assert (r["reached"] == times[-1]).all()
    assert seen[0] == (0, 6)
    assert seen[-1] == (6, 6)
    assert sink.done.all()


def test_a_run_that_fails_keeps_nothing_but_its_status(slow) -> None:
    column = DesignColumn("p", 0, "omega", np.array([2.0, 3000.0, 1.0]))
    design = Design(("omega",), (3,), BASE, [column])
    s = study([Kept("max energy", "energy", "max"), Kept("final x", "x", "final")], np.linspace(0, 1, 5))
    portions = cut(design.shape, s.bytes_per_run)
    sink = Memory(s, portions)
    carry_out(s, design, portions, sink)
    assert sink.arrays["status"].tolist() == [0, -2, 0]
    assert np.isnan(sink.arrays["max energy"]).tolist() == [False, True, False]
    np.testing.assert_allclose(sink.arrays["final x"][[0, 2]], np.cos([2.0, 1.0]), atol=1e-4)


@pytest.mark.parametrize(
    "shape", [(), (1,), (7,), (1000,), (3, 4), (1, 1, 1), (5, 1000), (1000, 5), (2, 3, 100003), (100003, 7)]
)
@pytest.mark.parametrize("fits", [1, 2, 999, 10**6])
def test_chunks_are_ranges_and_boxes_at_once_and_cover_everything(shape: tuple[int, ...], fits: int) -> None:
    portions = cut(shape, 100, memory=100 * fits)
    count = int(np.prod(shape))
    if count // fits > 20_000:
        pytest.skip("too many to list")
    ranges = sorted(portions.range(k) for k in range(len(portions)))
    assert ranges[0][0] == 0
    assert ranges[-1][1] == count
    assert all(a[1] == b[0] for a, b in pairwise(ranges))
    assert all(0 < stop - start <= fits for start, stop in ranges)
    numbers = np.arange(count).reshape(shape)
    for k in {0, len(portions) // 2, len(portions) - 1}:
        assert numbers[portions.box(k)].ravel().tolist() == list(range(*portions.range(k)))


def test_a_million_runs_are_cut_into_about_a_hundred_chunks() -> None:
    portions = cut((50, 20, 1000), 64)
    assert 64 <= len(portions) <= 512
    assert isinstance(portions, Portions)


def test_draws_are_the_same_in_any_portion_and_follow_their_law() -> None:
    drawn = RandomColumn("b", "normal", 1.0, 0.1, 3)
    whole = drawn.sample(np.arange(100_000))
    assert drawn.sample(np.arange(777, 1234)).tolist() == whole[777:1234].tolist()
    assert drawn.sample(np.array([5])).tolist() == [whole[5]]
    assert RandomColumn("b", "normal", 1.0, 0.1, 4).sample(np.arange(3)).tolist() != whole[:3].tolist()
    assert RandomColumn("c", "normal", 1.0, 0.1, 3).sample(np.arange(3)).tolist() != whole[:3].tolist()
    from scipy import stats

    laws = {
        "normal": stats.norm(1.0, 0.1),
        "uniform": stats.uniform(2.0, 3.0),
        "lognormal": stats.lognorm(0.5, scale=np.exp(0.2)),
    }
    given = {"normal": (1.0, 0.1), "uniform": (2.0, 5.0), "lognormal": (0.2, 0.5)}
    for name, law in laws.items():
        sample = RandomColumn("b", name, *given[name], 3).sample(np.arange(20_000))
        assert stats.kstest(sample, law.cdf).pvalue > 1e-3


def test_what_does_not_fit_is_refused() -> None:
    with pytest.raises(RunError, match=r"does not broadcast to \(3,\)"):
        Design(("run",), (3,), BASE, [DesignColumn("x", 0, "x", np.zeros(4))])
    with pytest.raises(RunError, match="'x' is nan at"):
        Design(("run",), (3,), BASE, [DesignColumn("x", 0, "x", np.array([0.0, np.nan, 1.0]))])
    with pytest.raises(RunError, match="'k' is empty"):
        Design(("k",), (0,), BASE)
    with pytest.raises(RunError, match="too many"):
        Design(("k", "m"), (10**7, 10**6), BASE)
