"""Measure a sweep of a million runs: time, memory, an end by kill -9 in the middle, Dask workers with faults.

    python bench/sweep.py                  print a Markdown table
    python bench/sweep.py --runs 20000     a smaller one
    python bench/sweep.py --append         and append it to bench/RESULTS.md, with the machine

Every sweep is a process of its own (Linux or macOS: peak memory is what the operating system says of it) and writes to
a Zarr store. The stores of those that were killed and resumed, and of the workers, are compared with the one of the
sweep that was left alone, bit by bit.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

import lagrangian as lg
from lagrangian import examples
from record import append, command_line, this_machine

HERE = Path(__file__).parent
METHODS = {"dop853": {}, "rk4": {"step": 0.01}}
DURATION = 10.0
SAMPLES = 1000
MEBIBYTE = 2**10 if platform.system() == "Linux" else 2**20
"""What ``ru_maxrss`` counts in, for one MiB."""


def sweep(path: str, runs: int, method: str, scheduler: str | None = None) -> lg.Ensemble:
    """Cart-poles of 10 s, looked at 1001 times: the greatest swing, where the cart ends, the mean force of friction."""
    system = lg.loads(examples.text("cart-pole"))
    return system.sweep(
        DURATION,
        [f"theta=0.1:3.1:{runs // SAMPLES}", "m~normal(0.2,0.02)", "l~uniform(0.2,0.4)"],
        draws=SAMPLES,
        seed=1,
        outputs=["max theta", "final x", "mean b*x'"],
        method=method,
        store=path,
        resume=True,
        scheduler=scheduler,
        **METHODS[method],
    )


def marks(path: Path) -> np.ndarray:
    """Which chunks of a store are done."""
    file = path / "done" / "c" / "0"
    if not file.exists():
        return np.zeros(1, bool)
    results = json.loads((path / "zarr.json").read_bytes())["attributes"]["lagrangian"]["results"]
    return np.frombuffer(file.read_bytes(), "<u8").reshape(-1, len(results)).all(axis=1)


def started(path: Path, given: argparse.Namespace, scheduler: str = "") -> subprocess.Popen[bytes]:
    command = [sys.executable, __file__, "--one", str(path), "--runs", str(given.runs), "--method", given.method]
    return subprocess.Popen([*command, "--scheduler", scheduler])


def waited(process: subprocess.Popen[bytes]) -> float:
    """Wait for a process; return its peak memory [MiB]."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_maxrss / MEBIBYTE


def until(path: Path, share: float, process: subprocess.Popen[bytes]) -> float:
    """Wait until that share of a sweep is done; return the share that is."""
    while (done := float(marks(path).mean())) < share:
        if process.poll() is not None:
            raise SystemExit("the sweep ended before it was killed")
        time.sleep(0.01)
    return done


def same(a: Path, b: Path) -> str:
    first, second = lg.Ensemble.of_store(a), lg.Ensemble.of_store(b)
    equal = all(np.array_equal(first[name], second[name], equal_nan=True) for name in first)
    return "the same bits" if equal and set(first) == set(second) else "DIFFERENT"


def alone(folder: Path, given: argparse.Namespace) -> list[str]:
    begin = time.perf_counter()
    peak = waited(started(folder / "whole.zarr", given))
    took = time.perf_counter() - begin
    counts = ", ".join(f"{n} {w}" for w, n in lg.Ensemble.of_store(folder / "whole.zarr").counts.items())
    return ["left alone", f"{took:.1f}", f"{given.runs / took:.0f}", f"{peak:.0f}", counts]


def killed(folder: Path, given: argparse.Namespace) -> list[str]:
    path = folder / "killed.zarr"
    peaks, shares = [], []
    begin = time.perf_counter()
    for share in (0.25, 0.6):
        process = started(path, given)
        shares.append(until(path, share, process))
        process.send_signal(signal.SIGKILL)
        peaks.append(waited(process))
    kept = [(p, p.stat().st_mtime_ns) for k in np.flatnonzero(marks(path)) for p in path.glob(f"*/c/{k}/*")]
    peaks.append(waited(started(path, given)))
    took = time.perf_counter() - begin
    again = sum(p.stat().st_mtime_ns != t for p, t in kept)
    at = " and ".join(f"{s:.0%}" for s in shares)
    how = f"{same(path, folder / 'whole.zarr')}; {again} of {len(kept)} files written twice"
    return [f"killed at {at}", f"{took:.1f}", f"{given.runs / took:.0f}", f"{max(peaks):.0f}", how]


def slowed() -> None:
    """Make this worker slow: every chunk takes 0.2 s more."""
    from lagrangian.integrate import remote

    quick = remote.work

    def slow(*given: Any) -> Any:
        time.sleep(0.2)
        return quick(*given)

    remote.work = slow


def workers(folder: Path, given: argparse.Namespace, count: int, *, faults: bool = False) -> list[str]:
    """A sweep on so many Dask workers; with ``faults`` one is slow, one joins late, and one is killed."""
    from distributed import Client, LocalCluster

    path = folder / f"workers{count}{faults}.zarr"
    first = count - 1 if faults else count
    what = f"{count} Dask worker{'s' if count > 1 else ''}"
    with (
        LocalCluster(n_workers=first, threads_per_worker=1, dashboard_address=":0", memory_limit=None) as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        processes = client.run(os.getpid)
        names = sorted(processes)
        slow, doomed = names[0], names[-1]
        if faults:
            client.run(slowed, workers=[slow])
        begin = time.perf_counter()
        process = started(path, given, cluster.scheduler_address)
        if faults:
            joined = until(path, 0.1, process)
            cluster.scale(count)
            share = until(path, 0.4, process)
            os.kill(processes[doomed], signal.SIGKILL)
            what += f", one slow, one joining at {joined:.0%}, one killed at {share:.0%}"
        peak = waited(process)
        took = time.perf_counter() - begin
    how = same(path, folder / "whole.zarr")
    return [what, f"{took:.1f}", f"{given.runs / took:.0f}", f"{peak:.0f}", how]


def report(given: argparse.Namespace) -> list[str]:
    lines = [
        "## A sweep",
        "",
        f"`python bench/sweep.py --runs {given.runs} --method {given.method}`. {this_machine('zarr', 'distributed')}.",
        "",
    ]
    lines += [
        f"{given.runs} cart-poles of {DURATION:g} s, looked at 1001 times, three results each, to a Zarr store.",
        "Peak memory is that of the process that asked; what was killed was started again, with resume.",
        "",
    ]
    lines += ["| " + given.method + " | s | runs a second | peak MiB | |", "| --- | ---: | ---: | ---: | --- |"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = [alone(folder, given), killed(folder, given), workers(folder, given, 1), workers(folder, given, 3)]
        rows.append(workers(folder, given, 3, faults=True))
    return [*lines, *("| " + " | ".join(row) + " |" for row in rows)]


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--runs", type=int, default=1_000_000, help="how many runs, in thousands")
    parser.add_argument("--method", choices=list(METHODS), default="dop853")
    parser.add_argument("--one", metavar="STORE", help=argparse.SUPPRESS)
    parser.add_argument("--scheduler", default="", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        sweep(given.one, given.runs, given.method, given.scheduler or None)
        return
    lines = report(given)
    print("\n".join(lines), flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
