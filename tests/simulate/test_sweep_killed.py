"""A sweep killed without warning, at any moment, and carried on: nothing is lost and nothing done twice."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import lagrangian as lg
from lagrangian import examples

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform == "win32", reason="there is no kill -9")]

SCRIPT = """
import time
import lagrangian as lg
from lagrangian import examples
from test_sweep_killed import GRID, HOW
def wait(done, count):  # near its end it waits to be killed, however late that comes
    while done > 0.85 * count:
        time.sleep(1)
lg.loads(examples.text("double-pendulum")).sweep(20.0, GRID, **HOW, store="a.zarr", resume=True, progress=wait)
"""
GRID = ["theta1=0.1:3:50", "m1~normal(1,0.1)"]
HOW = {
    "draws": 200,
    "method": "rk4",
    "step": 0.01,
    "outputs": ["max theta1", "final theta2'"],
    "times": 51,
    "seed": 5,
}


def finished(marks: pathlib.Path) -> np.ndarray:
    """Which chunks are finished: those with a mark for each of the four results."""
    return np.frombuffer(marks.read_bytes(), "<u8").reshape(-1, 4).all(axis=1)


@pytest.fixture(scope="module")
def whole() -> lg.Ensemble:
    return lg.loads(examples.text("double-pendulum")).sweep(20.0, GRID, **HOW)


@pytest.mark.parametrize("share", [0.3, *(pytest.param(x, marks=pytest.mark.exhaustive) for x in (0.0, 0.7))])
def test_killed_and_resumed_is_the_same_as_never_killed(
    tmp_path: pathlib.Path, whole: lg.Ensemble, share: float
) -> None:
    known = [str(pathlib.Path(__file__).parent), *filter(None, [os.environ.get("PYTHONPATH")])]
    path = {**os.environ, "PYTHONPATH": os.pathsep.join(known)}
    process = subprocess.Popen([sys.executable, "-c", SCRIPT], cwd=tmp_path, env=path)
    marks = tmp_path / "a.zarr" / "done" / "c" / "0"
    while process.poll() is None:
        if marks.exists() and (done := finished(marks)).size and done.sum() >= share * len(done):
            break
        time.sleep(0.001)
    process.send_signal(signal.SIGKILL)
    process.wait()
    done = finished(marks)
    assert share * len(done) <= done.sum() < len(done)
    store = tmp_path / "a.zarr"
    before = {p: p.stat().st_mtime_ns for k in np.flatnonzero(done) for p in store.glob(f"*/c/{k}/0")}
    counted: list[tuple[int, int]] = []
    system = lg.loads(examples.text("double-pendulum"))
    halfway = lg.Ensemble.of_store(store)
    assert halfway.counts.get("not run yet", 0) > 0
    again = system.sweep(20.0, GRID, **HOW, store=store, resume=True, progress=lambda *at: counted.append(at))
    for name in whole:
        np.testing.assert_array_equal(again[name], whole[name])
    assert again.coordinates["m1"][1].tolist() == whole.coordinates["m1"][1].tolist()
    assert counted[0][0] == pytest.approx(done.mean() * 10_000, abs=300)
    assert counted[-1] == (10_000, 10_000)
    assert all(p.stat().st_mtime_ns == t for p, t in before.items())
    with pytest.raises(lg.RunError, match=r"belongs to a different sweep: varied m1 was .* seed 5, is .* seed 6"):
        system.sweep(20.0, GRID, **{**HOW, "seed": 6}, store=store, resume=True)
    with pytest.raises(lg.Error, match="exists"):
        system.sweep(20.0, GRID, **HOW, store=store)
