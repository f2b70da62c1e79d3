"""Measure the engine: operations, model to machine code, time a state, agreement with Pinocchio, MuJoCo and CasADi.

    python bench/engine.py                 print Markdown tables
    python bench/engine.py --append        and append them to bench/RESULTS.md, with the machine

The peers come from their wheels (``pip install pin mujoco casadi``); one that is missing is said and left out. Times
are those of one core: the least of many short chunks, contenders in turn, so that ratios come from one run. Operations
are graph operations, sines and cosines apart. "One call" is a loop in machine code over the function pointer, no Python
in between; "batch" is many states, as many side by side as the machine has lanes.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import engine_systems as systems
from engine_peers import PEERS, CasADi, Loop, Timed, address
from engine_systems import Array, Tree
from lagrangian import codegen as machine
from lagrangian.codegen import Kernel
from lagrangian.graph import count_program
from record import append, command_line, one_core, table, this_machine

HERE = Path(__file__).parent
CHECKED = 1000
"""States at which engines are compared."""

NUMBERS = 60_000
"""Coordinates, velocities and forces in a timed call: they stay in the cache, and what Python adds does not count."""

KERNELS = {
    "2 links, absolute": (lambda: systems.chain(2, relative=False), 0.05),
    "7-joint arm": (lambda: systems.described(systems.arm_tree()), 0.4),
    "64 links, absolute": (lambda: systems.chain(64, relative=False), 0.5),
    "64 links, relative": (lambda: systems.chain(64, relative=True), 0.5),
    "1000 links, absolute": (lambda: systems.chain(1000, relative=False), 6.0),
    "1000 links, relative": (lambda: systems.chain(1000, relative=True), 6.0),
}
"""Name → how it is described, and the aim [s]."""

TREES: dict[str, Callable[[], Tree]] = {
    "2 links": lambda: systems.planar_tree(2),
    "8 links": lambda: systems.planar_tree(8),
    "64 links": lambda: systems.planar_tree(64),
    "7-joint arm": systems.arm_tree,
    "quadruped": systems.quadruped_tree,
    "humanoid": systems.humanoid_tree,
}


# -- operations ---------------------------------------------------------------------------------------------------


def operations(sizes: tuple[int, ...]) -> list[str]:
    rows = []
    for relative, aim in ((False, 18), (True, 19)):
        counts = [count_program(systems.chain_program(n, relative=relative)).operations / n for n in sizes]
        name = "planar chain, relative angles" if relative else "planar chain, absolute angles"
        furthest = max(abs(c / counts[-1] - 1) for c in counts)
        rows.append([name, *(f"{c:.1f}" for c in counts), f"{furthest:.1%}", str(aim)])
    return table(["operations a link", *map(str, sizes), "furthest from the last", "at most"], rows)


def arm_operations() -> str:
    tree = systems.arm_tree()
    dyn = systems.described(tree).compile()
    forward, inverse = (count_program(dyn.program(name)) for name in ("forward", "inverse"))
    text = f"7-joint arm with full inertias, forward: {forward.operations} operations (aim 2050, then 1773) and"
    text += f" {forward.sincos} sines and cosines; {dyn.operations} instructions with products and sums fused;"
    text += f" {inverse.operations} operations inverse."
    if "CasADi" in found():
        text += f" CasADi from L: {CasADi(tree).operations}."
    return text


# -- model to machine code ----------------------------------------------------------------------------------------


def one_kernel(name: str) -> dict[str, float]:
    """Seconds from Python objects to the first q̈, in this process, with nothing kept on disk."""
    describe = KERNELS[name][0]
    marks = [time.perf_counter()]
    system = describe()
    marks.append(time.perf_counter())
    dyn = system.compile()
    marks.append(time.perf_counter())
    n = len(dyn.coordinates)
    dyn.forward(np.full(n, 0.1), np.zeros(n))
    marks.append(time.perf_counter())
    return dict(zip(("described", "program", "machine code"), np.diff(marks).tolist(), strict=True))


def kernel_row(name: str, repeats: int, cap: float) -> list[str]:
    best: dict[str, float] | None = None
    command = [sys.executable, str(Path(__file__).resolve()), "--one", name]
    environment = {**os.environ, "LAGRANGIAN_CACHE_DIR": ""}
    aim = KERNELS[name][1]
    for _ in range(repeats):
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=cap, env=environment, check=True)
        except subprocess.TimeoutExpired:
            break
        except subprocess.CalledProcessError as error:
            raise SystemExit(f"{name}:\n{error.stderr}") from error
        taken = json.loads(done.stdout)
        if best is None or sum(taken.values()) < sum(best.values()):
            best = taken
        if sum(taken.values()) > cap / 10:
            break
    if best is None:
        return [name, "", "", "", f"> {cap:g}", f"{aim:g}"]
    return [name, *(f"{x:.3f}" for x in best.values()), f"{sum(best.values()):.3g}", f"{aim:g}"]


# -- one state ----------------------------------------------------------------------------------------------------


def best(contenders: dict[str, Timed], rounds: int, seconds: float) -> dict[str, float]:
    """Seconds a call of each: the least over chunks of a few milliseconds, in turn, round after round."""
    found: dict[str, float] = {}
    for _ in range(rounds):
        for name, call in contenders.items():
            call()
            start, count = time.perf_counter(), 0
            while time.perf_counter() - start < 0.003:
                call()
                count += 1
            end = time.perf_counter() + seconds
            while time.perf_counter() < end:
                start = time.perf_counter()
                for _ in range(count):
                    call()
                each = (time.perf_counter() - start) / count
                found[name] = min(each, found.get(name, each))
    return found


def one_call(kernel: Kernel, q: Array, v: Array, u: Array) -> Timed:
    """A loop over the function pointer, one state after the other."""
    raw, shared, loop = kernel.raw(1), kernel.shared(), Loop()
    states = np.zeros((len(q), raw.inputs))
    given = np.hstack([q, v, u])
    states[:, : given.shape[1]] = given
    out, scratch = np.empty((len(q), raw.outputs)), machine.aligned(raw.scratch)
    kept = (states, out, scratch, shared, raw)
    table = (raw.address, len(q), address(states), states.strides[0], address(shared), address(out), out.strides[0])
    return lambda: loop.call(*table, address(kept[2]))


def compiled(tree: Tree, states: tuple[Array, Array, Array]) -> tuple[Kernel, tuple[Array, Array, Array]]:
    """Our kernel and what it is given: planar chains as such, and without torques."""
    q, v, _ = states
    if not tree.name.endswith("chain"):
        return systems.kernel_of(tree), states
    program = systems.chain(len(tree.links), relative=True).compile().program("forward")
    return machine.compile(program, optional={"u": 0.0, "t": 0.0}, threads=1), (q, v, np.zeros((len(q), 0)))


def found() -> list[str]:
    """The peers that are installed."""
    return [name for name, (module, _) in PEERS.items() if importlib.util.find_spec(module)]


def beside(name: str, rounds: int, seconds: float) -> tuple[list[str], list[str]]:
    """The rows of one system: times, and agreement."""
    tree = TREES[name]()
    many = tree.states(CHECKED)
    kernel, given = compiled(tree, many)
    if not given[2].size:
        many = (*many[:2], np.zeros_like(many[2]))
    mine = kernel(*given)
    count = NUMBERS // sum(x.shape[1] for x in (*given, given[1])) // 16 * 16
    timed_at = tuple(np.ascontiguousarray(np.resize(x, (count, x.shape[1]))) for x in given)
    theirs_at = tuple(np.ascontiguousarray(np.resize(x, (count, x.shape[1]))) for x in many)
    contenders: dict[str, Timed] = {"one": one_call(kernel, *timed_at), "batch": kernel.prepared(*timed_at)}
    agreement = []
    for peer in PEERS:
        if peer not in found() or (peer == "CasADi" and (tree.floats or tree.nv > 8)):
            agreement.append("")
            continue
        engine = PEERS[peer][1](tree)
        theirs = engine.accelerations(*many)
        scale = np.abs(theirs).max(axis=1, keepdims=True)
        agreement.append(f"{(np.abs(mine - theirs) / scale).max():.1e}")
        timed = engine.timed(*theirs_at)
        if timed is not None:
            contenders[peer] = timed
    seconds_a_state = {k: t / count for k, t in best(contenders, rounds, seconds).items()}
    one, batch = seconds_a_state["one"], seconds_a_state["batch"]
    single = [x[0].copy() for x in given]
    python = best({"python": lambda: kernel(*single)}, rounds, seconds)["python"]
    cells = [name, f"{one * 1e9:.4g}", f"{batch * 1e9:.3g}", f"{one / batch:.2f}", f"{(python - one) * 1e6:.2f}"]
    for peer in PEERS:
        t = seconds_a_state.get(peer)
        cells.append(f"{t * 1e9:.4g} ({t / one:.1f}, {t / batch:.0f})" if t else "")
    return cells, [name, *agreement]


def python_overhead(rounds: int, seconds: float) -> str:
    """What `forward` of a compiled system costs beyond its machine code, for one state of two links."""
    dyn = systems.chain(2, relative=False).compile(threads=1)
    q, v = np.array([0.1, 0.2]), np.array([0.3, 0.4])
    taken = best({"forward": lambda: dyn.forward(q, v)}, rounds, seconds)["forward"]
    return f"One `dyn.forward(q, v)` from Python, two links: {taken * 1e6:.2f} µs (aim 3 µs)."


# -- the report ---------------------------------------------------------------------------------------------------


def report(quick: bool) -> list[str]:
    rounds, seconds = (2, 0.05) if quick else (6, 0.15)
    lines = [
        "## The engine",
        "",
        f"`python bench/engine.py`. {this_machine('llvmlite', 'pin', 'mujoco', 'casadi')}.",
        "",
    ]
    lines += operations((8, 64, 256) if quick else (8, 64, 256, 1000))
    lines += ["", arm_operations(), ""]
    kernels = [kernel_row(name, 1 if quick else 3, 30 if quick else 120) for name in KERNELS]
    lines += table(["model to first q̈ [s]", "described", "program", "machine code", "total", "at most"], kernels)
    hows = "; ".join(f"{name}: {PEERS[name][1].how}" for name in found())
    lines += ["", f"Times in ns a state; in brackets how many times ours, one call and batch. {hows}.", ""]
    rows = [beside(name, rounds, seconds) for name in TREES]
    lines += table(["one core", "one call", "batch", "ratio", "Python adds [µs]", *PEERS], [times for times, _ in rows])
    lines += ["", python_overhead(rounds, seconds), ""]
    head = [f"greatest relative difference at {CHECKED} states", *PEERS]
    return lines + table(head, [agreement for _, agreement in rows])


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer rounds, nothing that takes long")
    parser.add_argument("--one", metavar="SYSTEM", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        print(json.dumps(one_kernel(given.one)))
        return
    one_core()
    lines = report(given.quick)
    print("\n".join(lines), flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
