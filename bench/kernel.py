"""Time one program in every engine that can run it: forward dynamics of many states, one core, ratios in one run.

    python bench/kernel.py                 print a Markdown table
    python bench/kernel.py --append        and append it to bench/RESULTS.md, with the machine

The same graph goes to our machine code, to NumPy (our own source export), to Numba (the C export's statements, compiled
by LLVM with its own sin and cos), to CasADi (its virtual machine) and to gcc and clang (our C export, -O3
-march=native, a loop over the states); what is not installed is left out. Every answer is compared with the interpreter
before it is timed. Engines take turns; the figure is the median over the rounds, in ns a state.
"""

from __future__ import annotations

import ctypes
import importlib.util
import re
import shutil
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import lagrangian as lg
from lagrangian import examples
from lagrangian.codegen import compile as compile_program
from lagrangian.codegen import to_c, to_numpy
from lagrangian.graph import Program, evaluate
from record import append, command_line, this_machine

HERE = Path(__file__).parent
SYSTEMS = ("double-pendulum", "triple-pendulum-relative", "furuta-pendulum", "scara", "robot-arm", "planar-quadrotor")
STATES = 8192
Engine = Callable[[], np.ndarray]


def ours(program: Program, groups: list[np.ndarray]) -> Engine:
    kernel = compile_program(program, threads=1)
    return kernel.prepared(*groups[:3], groups[3][0], groups[4])


def ours_in_numpy(program: Program, groups: list[np.ndarray]) -> Engine:
    space: dict = {}
    exec(to_numpy(program, name="f"), space)
    return lambda: space["f"](*groups[:3], groups[3][0], groups[4])


def compiled_c(compiler: str, program: Program, groups: list[np.ndarray]) -> Engine:
    """The C export in a loop over the states, as a user would write it."""
    sizes = [len(entries) for entries in program.inputs.values()]
    (output,) = program.outputs.values()
    source, header = to_c(program, name="f")
    steps = [
        f"in[{k}] + {n} * i" if g != "p" else f"in[{k}]" for k, (g, n) in enumerate(zip("qvupt", sizes, strict=True))
    ]
    call = f"f({', '.join(steps)}, out + {len(output.ids)} * i)"
    loop = f"void loop(double **in, double *out, long n) {{ for (long i = 0; i < n; i++) {call}; }}"
    folder = Path(tempfile.mkdtemp())
    (folder / "f.c").write_text(source + loop)
    (folder / "f.h").write_text(header)
    command = [compiler, "-O3", "-march=native", "-ffp-contract=fast", "-shared", "-fPIC", "f.c", "-o", "f.so", "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    looped = ctypes.CDLL(str(folder / "f.so")).loop
    table = (ctypes.c_void_p * 5)(*[g.ctypes.data for g in groups])
    out = np.empty((STATES, len(output.ids)))

    def run() -> np.ndarray:
        looped(table, ctypes.c_void_p(out.ctypes.data), ctypes.c_long(STATES))
        return out

    return run


def numba(program: Program, groups: list[np.ndarray]) -> Engine:
    """The C export's assignments are Python's too, but for types and semicolons."""
    import numba as nb

    source, _ = to_c(program, name="f")
    body = source[source.index("{") + 1 : source.rindex("}")]
    (output,) = program.outputs
    lines = [re.sub(r"^ *const \w+ |;$", "", line).strip() for line in body.splitlines() if "=" in line]
    names = [f"in_{g}" for g in program.inputs]
    rows = [f"        {n} = {n}s{'' if g == 'p' else '[i]'}" for n, g in zip(names, program.inputs, strict=True)]
    text = [
        "from math import *",
        f"def f({', '.join(n + 's' for n in names)}, out_s):",
        "    for i in range(len(out_s)):",
    ]
    text += [*rows, f"        out_{output} = out_s[i]", *("        " + line for line in lines)]
    space: dict = {}
    exec("\n".join(text), space)
    fast = nb.njit(error_model="numpy", fastmath={"contract"})(space["f"])
    out = np.empty((STATES, len(program.outputs[output].ids)))
    given = [g[0] if k == 3 else g.reshape(STATES, -1) for k, g in enumerate(groups)]

    def run() -> np.ndarray:
        fast(*given, out)
        return out

    return run


def casadi(program: Program, groups: list[np.ndarray]) -> Engine:
    """The graph rebuilt as CasADi's own scalar expressions."""
    import casadi as ca

    inputs = {g: ca.SX.sym(g, len(e)) for g, e in program.inputs.items()}
    plain = {"add": "plus", "sub": "minus", "mul": "times", "div": "rdivide", "asin": "asin", "abs": "fabs"}
    value: dict[int, object] = {}
    for i, (op, *rest) in enumerate(program.graph.nodes):
        if op == "const":
            value[i] = ca.SX(rest[0])
        elif op == "input":
            value[i] = inputs[rest[0]][rest[1]]
        elif op == "powi":
            value[i] = value[rest[0]] ** rest[1]
        elif op == "neg":
            value[i] = -value[rest[0]]
        else:
            value[i] = getattr(ca, plain.get(op, op))(*(value[k] for k in rest))
    (output,) = program.outputs.values()
    used = [(x, g) for x, g in zip(inputs.values(), groups, strict=True) if g.size]
    f = ca.Function("f", [x for x, _ in used], [ca.vertcat(*(value[i] for i in output.ids))]).map(STATES)
    buffer, trigger = f.buffer()
    out = np.zeros((STATES, len(output.ids)))
    for k, (_, g) in enumerate(used):
        buffer.set_arg(k, memoryview(g))
    buffer.set_res(0, memoryview(out))

    def run(keep: object = (f, buffer, used)) -> np.ndarray:  # CasADi holds no reference to these
        trigger()
        return out

    return run


def engines() -> dict[str, Callable[[Program, list[np.ndarray]], Engine]]:
    found = {"lagrangian": ours, "NumPy": ours_in_numpy}
    for name, contender in (("numba", numba), ("casadi", casadi)):
        if importlib.util.find_spec(name):
            found[name] = contender
    for compiler in ("clang", "gcc"):
        if shutil.which(compiler):
            found[compiler] = lambda program, groups, c=compiler: compiled_c(c, program, groups)
    return found


def groups_of(program: Program) -> list[np.ndarray]:
    """Random states in the program's order q, v, u, p, t; every state has the same declared parameters."""
    random = np.random.default_rng(0)
    made = [random.uniform(0.2, 1.0, (STATES, len(program.inputs[g]))) for g in "qvu"]
    values = [float(program.defaults.get(e) or 1.0) for e in program.inputs["p"]]
    return [*made, np.tile(values, (STATES, 1)), np.zeros(STATES)]


def times(name: str, rounds: int) -> tuple[dict[str, float], int]:
    """Median ns a state of every engine that answers rightly, and our operations a state."""
    program = lg.loads(examples.text(name)).compile().program("forward")
    groups = groups_of(program)
    (output,) = program.outputs
    rows = [{g: np.atleast_1d(a[k]) for g, a in zip("qvupt", groups, strict=True)} for k in (0, 1, STATES - 1)]
    want = [evaluate(program, row)[output] for row in rows]
    ready = {engine: make(program, groups) for engine, make in engines().items()}
    for engine, run in ready.items():
        np.testing.assert_allclose(run()[[0, 1, STATES - 1]], want, rtol=1e-9, err_msg=f"{engine}, {name}")
    taken: dict[str, list[float]] = {engine: [] for engine in ready}
    for _ in range(rounds):
        for engine, run in ready.items():
            best = min(_once(run) for _ in range(5))
            taken[engine].append(best / STATES * 1e9)
    return {engine: statistics.median(t) for engine, t in taken.items()}, compile_program(program).operations


def _once(run: Engine) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--rounds", type=int, default=21)
    given = parser.parse_args()
    listed = list(engines())
    lines = [
        "## Forward dynamics of many states, one core",
        "",
        f"`python bench/kernel.py`, {STATES} states a call, ns a state. {this_machine('numpy')}.",
        "",
        f"| example | operations | {' | '.join(listed)} | next best |",
        f"|---|---:|{'---:|' * len(listed)}---:|",
    ]
    print("\n".join(lines), flush=True)
    for name in SYSTEMS:
        medians, operations = times(name, given.rounds)
        others = min(t for engine, t in medians.items() if engine != "lagrangian")
        cells = " | ".join(f"{medians[engine]:.3g}" for engine in listed)
        lines.append(f"| {name} | {operations} | {cells} | {others / medians['lagrangian']:.1f} times |")
        print(lines[-1], flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
