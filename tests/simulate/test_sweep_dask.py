"""A sweep over Dask's scheduler: the same bits as here, with a worker killed in the middle."""

import gc
import os
import pathlib
import signal
import sys
import threading
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import lagrangian as lg
from lagrangian import examples

distributed = pytest.importorskip("distributed")
pytestmark = pytest.mark.filterwarnings("default")  # of the scheduler's own making

GRID = ["theta1=0.1:3:40", "m1~normal(1,0.1)"]
HOW: dict[str, Any] = {
    "draws": 200,
    "method": "rk4",
    "step": 0.01,
    "outputs": ["max theta1", "final theta2'"],
    "times": 51,
}


@pytest.fixture(scope="module")
def system() -> lg.System:
    return lg.loads(examples.text("double-pendulum"))


@pytest.fixture(scope="module")
def here(system: lg.System) -> lg.Ensemble:
    return system.sweep(5.0, GRID, **HOW)


@pytest.fixture
def cluster() -> Iterator[Any]:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", memory_limit=None
    ) as made:
        yield made
    gc.collect()  # what the cluster left open is closed, and warned of, here


@pytest.mark.slow
def test_two_workers_one_of_them_killed_and_then_resumed(
    system: lg.System, here: lg.Ensemble, cluster: Any, tmp_path: pathlib.Path
) -> None:
    killed: list[int] = []

    def kill(done: int, count: int) -> None:
        if not killed and done > count // 4:
            with distributed.Client(cluster, set_as_default=False) as client:
                killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    there = system.sweep(
        5.0, GRID, **HOW, store=tmp_path / "a.zarr", scheduler=cluster.scheduler_address, progress=kill
    )
    assert killed
    assert set(there) == set(here)
    for name in here:
        np.testing.assert_array_equal(there[name], here[name])
    chunks = sorted(p for p in (tmp_path / "a.zarr" / "max theta1" / "c").rglob("*") if p.is_file())
    chunks[0].unlink()
    chunks[-1].write_bytes(chunks[-2].read_bytes())
    again = system.sweep(5.0, GRID, **HOW, store=tmp_path / "a.zarr", resume=True, scheduler=cluster.scheduler_address)
    assert "has 2 damaged chunks" in again.notices[0]
    for name in here:
        np.testing.assert_array_equal(again[name], here[name])


def slowed() -> None:
    """Make this worker slow: every chunk takes 0.2 s more."""
    from lagrangian.integrate import remote

    quick = remote.work

    def slow(*given: Any) -> Any:
        time.sleep(0.2)
        return quick(*given)

    remote.work = slow


def gated(closed: str, opened: str) -> None:
    """Let this worker begin no chunk while the file ``closed`` is there and ``opened`` is not."""
    from lagrangian.integrate import remote

    free = remote.work

    def waiting(*given: Any) -> Any:
        while os.path.exists(closed) and not os.path.exists(opened):  # noqa: PTH110
            time.sleep(0.01)
        return free(*given)

    remote.work = waiting


def watched(opened: str) -> None:
    """Make the file ``opened`` as soon as this worker has compiled a study for a chunk."""
    from lagrangian.integrate import remote

    def watch() -> None:
        while not remote._known:
            time.sleep(0.01)
        pathlib.Path(opened).touch()

    threading.Thread(target=watch, daemon=True).start()


def computed() -> tuple[int, int]:
    """The process of this worker, and how many studies it has compiled: 0 if it never computed a chunk."""
    from lagrangian.integrate import remote

    return os.getpid(), len(remote._known)


@pytest.mark.slow
def test_three_workers_one_killed_one_slow_one_joining_late(
    system: lg.System, here: lg.Ensemble, cluster: Any, tmp_path: pathlib.Path
) -> None:
    """Files are gates, so that nothing depends on who is faster: the first two workers wait for the late one's share.

    The worker that Dask starts in place of the killed one gets chunks or gets none.
    """
    closed, opened = str(tmp_path / "closed"), str(tmp_path / "opened")
    late: list[str] = []
    killed: list[int] = []
    with distributed.Client(cluster, set_as_default=False) as client:
        first = {worker: pid for worker, (pid, _) in client.run(computed).items()}
        slow, doomed = sorted(first)
        client.run(slowed, workers=[slow])
        client.run(gated, closed, opened)

        def disturb(done: int, count: int) -> None:
            if not late and done > count // 8:
                while not client.run(computed, workers=[slow])[slow][1]:  # it was given a chunk with the first ones
                    time.sleep(0.01)
                cluster.scale(3)
                client.wait_for_workers(3)
                late.extend(set(client.run(computed)) - set(first))
                client.run(watched, opened, workers=late)
                pathlib.Path(closed).touch()
            elif late and not killed and done > count // 2:
                killed.append(first[doomed])
                os.kill(first[doomed], signal.SIGKILL)

        there = system.sweep(
            5.0, GRID, **HOW, store=tmp_path / "a.zarr", scheduler=cluster.scheduler_address, progress=disturb
        )
        workers = client.run(computed, on_error="return")
    assert len(late) == 1 and killed
    answers = {worker: answer for worker, answer in workers.items() if not isinstance(answer, BaseException)}
    assert first[doomed] not in {pid for pid, _ in answers.values()}
    assert answers[slow] == (first[slow], 1) and answers[late[0]][1] == 1
    assert all(count <= 1 for _, count in answers.values())
    assert set(there) == set(here)
    for name in here:
        np.testing.assert_array_equal(there[name], here[name])


@pytest.mark.slow
def test_a_worker_that_hangs_does_not_hold_up_the_sweep(
    system: lg.System, here: lg.Ensemble, cluster: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from lagrangian.integrate import remote

    monkeypatch.setattr(remote, "DELIVERY", 2.0)
    with distributed.Client(cluster, set_as_default=False) as client:  # before the sweep: nothing else is said then
        process_of_a_worker = next(iter(client.run(os.getpid).values()))
    hung: list[int] = []

    def hang(done: int, count: int) -> None:
        if not hung and done > count // 4:
            hung.append(process_of_a_worker)
            os.kill(process_of_a_worker, signal.SIGSTOP)

    try:
        there = system.sweep(5.0, GRID, **HOW, scheduler=cluster.scheduler_address, progress=hang)
    finally:
        for process in hung:
            os.kill(process, signal.SIGCONT)
    assert hung
    for name in here:
        np.testing.assert_array_equal(there[name], here[name])


def test_nobody_answers(system: lg.System, monkeypatch: pytest.MonkeyPatch) -> None:
    from lagrangian.integrate import remote

    monkeypatch.setattr(remote, "PATIENCE", 0.5)
    with pytest.raises(lg.RunError, match=r"no scheduler answers at 'tcp://127.0.0.1:9'"):
        system.sweep(5.0, GRID, **HOW, scheduler="tcp://127.0.0.1:9")
    with pytest.raises(lg.RunError, match=r"address or a distributed.Client"):
        system.sweep(5.0, GRID, **HOW, scheduler=3)
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(lg.MissingExtra, match=r"pip install 'lagrangian\[sweep\]'"):
        system.sweep(5.0, GRID, **HOW, scheduler="tcp://127.0.0.1:9")


@pytest.mark.parametrize(
    ("trouble", "message"),
    [
        (lambda: distributed.KilledWorker("task", "worker", 3), "every worker that computed one of the chunks died"),
        (lambda: ModuleNotFoundError("No module named 'lagrangian'"), "a worker lacks a package"),
        (lambda: distributed.client.FutureCancelledError("key", "scheduler-connection-lost"), "the scheduler was lost"),
        (lambda: ConnectionResetError("gone"), "the scheduler was lost"),
        (lambda: lg.RunError("a worker runs lagrangian 0.0"), "a worker runs lagrangian 0.0"),
    ],
)
def test_what_goes_wrong_over_there_is_told_here(trouble, message: str) -> None:
    from lagrangian.integrate.remote import Dask

    class Future:
        def result(self, timeout: float | None) -> None:
            raise trouble()

    dask = object.__new__(Dask)
    dask._lib = distributed
    with pytest.raises(lg.RunError, match=message):
        dask._result(Future(), 1.0)


def test_a_worker_of_another_version_is_refused(system: lg.System) -> None:
    from lagrangian.integrate import remote

    with pytest.raises(lg.RunError, match=r"a worker runs lagrangian .*, but this process runs 9\.9"):
        remote.work("key", b"", "9.9", None)  # type: ignore[arg-type]
