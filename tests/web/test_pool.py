"""The processes of the app: each ends, whatever it does, and the next request is served."""

import os
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx
import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from served_app import Served, served

from lagrangian.web import app as app_of
from lagrangian.web.limits import size_of
from lagrangian.web.pool import PoolLimits

JOBS = ("spin", "eat", "die", "babble", "write", "large", "fail", "refuse", "deep", "nothing", "process")
MEMORY = 200 * 2**20


@pytest.fixture(scope="module")
def known() -> Iterator[None]:
    """The app knows the jobs of a hostile worker."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(app_of, "JOBS", JOBS)
        patch.setenv("PYTHONPATH", os.pathsep.join([str(Path(__file__).parent), *sys.path]))
        yield


@pytest.fixture(scope="module")
def app(known: None) -> Iterator[Served]:
    """Its jobs have hours, so that on a busy machine none is ended for its time."""
    with served(PoolLimits(module="hostile_worker", memory=MEMORY), seconds=3600.0) as found:
        yield found


@pytest.fixture(scope="module")
def hurried(known: None) -> Iterator[Served]:
    """Its jobs have a second."""
    with served(PoolLimits(module="hostile_worker", memory=MEMORY), seconds=1.0) as found:
        yield found


def check_served(app: Served) -> None:
    assert app.ask("nothing").json() == "nothing"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("job", "status"), [("spin", 408), ("eat", 507), ("die", 507), ("large", 507), ("deep", 507), ("fail", 500)]
)
def test_a_job_that_breaks_a_limit_is_refused_and_the_next_is_served(
    app: Served, hurried: Served, job: str, status: int
) -> None:
    app = hurried if job == "spin" else app
    for _ in range(2):
        answer = app.ask(job)
        assert answer.status_code == status
        assert answer.json()["error"]["what"]
        check_served(app)


@pytest.mark.slow
def test_a_process_that_broke_a_limit_does_nothing_more(hurried: Served) -> None:
    before = hurried.ask("process").json()
    while hurried.ask("process").json() != before:
        pass
    killed = {hurried.ask("process").json() for _ in range(4)}
    for _ in range(3):
        hurried.ask("spin")
    after = {hurried.ask("process").json() for _ in range(4)}
    assert not killed & after
    assert not [process for process in killed if _runs(process)]


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True


def test_what_a_library_prints_is_not_an_answer(app: Served) -> None:
    assert app.ask("babble").json() == "said"


@pytest.mark.skipif(os.name != "posix", reason="limits on files are Unix's")
def test_a_process_writes_no_file(app: Served, tmp_path: Path) -> None:
    path = tmp_path / "file"
    assert app.ask("write", {"path": str(path)}).json() == "OSError"
    assert not path.exists() or not path.read_bytes()


def test_a_mistake_is_told_with_its_place(app: Served) -> None:
    error = app.ask("refuse").json()["error"]
    assert (error["code"], error["line"], error["column"], error["fix"]) == ("E402", 3, 7, "right it")
    assert error["message"].startswith("model.toml:3:7: [E402] wrong")


@pytest.mark.slow
def test_more_jobs_than_the_queue_holds_are_refused(app: Served) -> None:
    with (
        ThreadPoolExecutor(10) as threads,
        served(PoolLimits(module="hostile_worker", memory=MEMORY), seconds=3600.0) as patient,
    ):
        asked = [threads.submit(patient.ask, "spin") for _ in range(10)]
        pool = patient.desk.pool
        while (pool.busy, pool.waiting) != (2, 8):
            threading.Event().wait(0.01)
        answer = patient.ask("nothing")
        assert (answer.status_code, answer.headers["retry-after"]) == (429, "1")
    assert all(one.exception() or one.result().status_code == 503 for one in asked)  # the app was ended under them
    check_served(app)


@pytest.mark.slow
def test_a_request_that_is_given_up_ends_its_job(app: Served) -> None:
    with served(PoolLimits(module="hostile_worker", workers=1), seconds=3600.0) as patient:
        for _ in range(3):
            with pytest.raises(httpx.TimeoutException):
                httpx.post(f"{patient.address}/api/spin", json={}, headers=patient.headers, timeout=0.3)
        check_served(patient)


def test_the_size_of_a_process_is_known() -> None:
    size = size_of(os.getpid())
    assert size is not None and size > 2**20
    assert size_of(2**22 + 1) is None
