"""Stores in object storage: a local S3 server, and fsspec's memory; the same checks as in folders."""

import pathlib
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import lagrangian as lg

fsspec = pytest.importorskip("fsspec")

GRID = ["theta=0.1:3:30", "m~normal(1,0.1)"]
HOW: dict[str, Any] = {"draws": 30, "method": "rk4", "step": 0.01, "outputs": ["max theta"], "times": 51}


class Stopped(Exception):
    """The process ends here."""


@pytest.fixture(scope="module")
def system() -> lg.System:
    return lg.example("pendulum")


@pytest.fixture(scope="module")
def here(system: lg.System) -> lg.Ensemble:
    return system.sweep(1.0, GRID, **HOW)


@pytest.fixture(scope="module")
def bucket() -> Iterator[str]:
    """A bucket on an S3 server of this machine, which the environment names."""
    server = pytest.importorskip("moto.server")
    pytest.importorskip("s3fs")
    running = server.ThreadedMotoServer(port=0, verbose=False)
    running.start()
    host, port = running.get_host_and_port()
    with pytest.MonkeyPatch.context() as environment:
        for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"):
            environment.setenv(name, "testing")  # the server takes any
        environment.setenv("AWS_DEFAULT_REGION", "us-east-1")
        environment.setenv("AWS_ENDPOINT_URL", f"http://{host}:{port}")
        fsspec.filesystem("s3").mkdir("sweeps")
        yield "s3://sweeps"
    running.stop()


def interrupted(system: lg.System, store: str) -> int:
    """Begin a sweep and stop it at half; return the number of runs that were finished."""
    finished: list[int] = []

    def stop(done: int, count: int) -> None:
        finished.append(done)
        if done > count // 2:
            raise Stopped

    with pytest.raises(Stopped):
        system.sweep(1.0, GRID, **HOW, store=store, progress=stop)
    return finished[-1]


def resumes_and_notices_damage(system: lg.System, here: lg.Ensemble, store: str) -> None:
    done = interrupted(system, store)
    halfway = lg.Ensemble.of_store(store)
    assert halfway.counts == {"the end was reached": done, "not run yet": 900 - done}
    counted: list[int] = []
    again = system.sweep(1.0, GRID, **HOW, store=store, resume=True, progress=lambda at, _: counted.append(at))
    assert counted[0] == done
    for name in here:
        np.testing.assert_array_equal(again[name], here[name])
    files, path = fsspec.core.url_to_fs(store, use_listings_cache=False)
    chunks = sorted(name for name in files.find(path) if "/max theta/c/" in name)
    files.rm_file(chunks[0])
    data = bytearray(files.cat_file(chunks[1]))
    data[len(data) // 2] ^= 1
    files.pipe_file(chunks[1], bytes(data))
    with pytest.raises(lg.RunError, match=r"has 1 damaged chunk .*'max theta/c/0/0' is missing"):
        lg.Ensemble.of_store(store)
    left = lg.Ensemble.of_store(store, lost=True)
    assert "has 2 damaged chunks" in left.notices[0]
    assert np.isnan(left["max theta"]).sum() == (left.status == -127).sum() > 0
    files.rm(f"{path}/theta/c", recursive=True)
    with pytest.raises(lg.RunError, match="the values of 'theta' are not what was written"):
        lg.Ensemble.of_store(store)
    mended = system.sweep(1.0, GRID, **HOW, store=store, resume=True)
    assert ["2 damaged chunks" in said for said in mended.notices] == [False, True]
    for name in here:
        np.testing.assert_array_equal(mended[name], here[name])
    np.testing.assert_array_equal(mended.coordinates["theta"][1], here.coordinates["theta"][1])
    with pytest.raises(lg.RunError, match=r"belongs to a different sweep: varied m .* seed 0, is .* seed 1"):
        system.sweep(1.0, GRID, **HOW, store=store, resume=True, seed=1)
    with pytest.raises(lg.Error, match="exists"):
        system.sweep(1.0, GRID, **HOW, store=store)
    files.pipe_file(f"{path}/notes.txt", b"mine")
    with pytest.raises(lg.Error, match=r"'notes.txt' in it was not written by a sweep"):
        system.sweep(1.0, GRID, **HOW, store=store, overwrite=True)
    files.rm_file(f"{path}/notes.txt")
    assert system.sweep(1.0, GRID, **HOW, store=store, overwrite=True, seed=1).success


@pytest.mark.slow
def test_a_store_in_memory_is_resumed_and_checked(system: lg.System, here: lg.Ensemble) -> None:
    resumes_and_notices_damage(system, here, "memory://sweeps/a.zarr")


@pytest.mark.slow
@pytest.mark.filterwarnings("default")  # of the server and its client
def test_a_store_on_an_s3_server_is_resumed_and_checked(system: lg.System, here: lg.Ensemble, bucket: str) -> None:
    resumes_and_notices_damage(system, here, f"{bucket}/a.zarr")
    with pytest.raises(lg.Error, match=r"cannot (make|open) 's3://nowhere/a.zarr'"):
        system.sweep(1.0, GRID, **HOW, store="s3://nowhere/a.zarr")


def test_a_second_process_takes_over_and_the_first_one_stops(system: lg.System, here: lg.Ensemble) -> None:
    store = "memory://sweeps/b.zarr"
    second: list[lg.Ensemble] = []

    def meanwhile(done: int, count: int) -> None:
        if not second and done > count // 2:
            second.append(system.sweep(1.0, GRID, **HOW, store=store, resume=True))

    with pytest.raises(lg.Error, match=r"another process is writing to 'memory://sweeps/b\.zarr'"):
        system.sweep(1.0, GRID, **HOW, store=store, progress=meanwhile)
    for name in here:
        np.testing.assert_array_equal(lg.Ensemble.of_store(store)[name], second[0][name])
        np.testing.assert_array_equal(here[name], second[0][name])


def test_a_file_url_is_a_folder(system: lg.System, tmp_path: pathlib.Path) -> None:
    runs = system.sweep(1.0, GRID, **HOW, store=f"file://{tmp_path}/a.zarr")
    assert (tmp_path / "a.zarr" / "zarr.json").is_file()
    assert runs.success


@pytest.mark.parametrize(
    ("store", "message"),
    [
        ("nothing://a.zarr", "is not a place"),
        ("simplecache::s3://a/b.zarr", "is a chain of places"),
        ("s3://sweeps/a.nc", "must end in .zarr"),
    ],
)
def test_what_is_not_a_place(system: lg.System, store: str, message: str) -> None:
    with pytest.raises(lg.Error, match=message):
        system.sweep(1.0, GRID, **HOW, store=store)


def test_a_package_that_is_missing_is_named(system: lg.System, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*_: object, **__: object) -> None:
        raise ImportError("Install s3fs to access S3")

    monkeypatch.setattr(fsspec.core, "url_to_fs", missing)
    with pytest.raises(lg.MissingExtra, match="needs another package: Install s3fs to access S3"):
        system.sweep(1.0, GRID, **HOW, store="s3://sweeps/a.zarr")


def test_the_command_takes_a_url(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from lagrangian.cli import main

    monkeypatch.chdir(tmp_path)
    given = ["sweep", "--example", "pendulum", "theta=0.1,0.2", "--duration", "1", "-o", "memory://sweeps/c.zarr"]
    assert main(given) == 0
    assert "wrote memory://sweeps/c.zarr: 2 runs" in capsys.readouterr().err
    assert main(given) == 2
    assert "continue it with --resume" in capsys.readouterr().err
    assert main([*given, "--resume"]) == 0
    assert not list(tmp_path.iterdir())
