"""Measure integrators: ensembles with a fixed step, one accurate run, an ensemble with adaptive steps, two cores.

    python bench/simulate.py                 print Markdown tables
    python bench/simulate.py --append        and append them to bench/RESULTS.md, with the machine

The peers come from their wheels (``pip install scipy heyoka jax mujoco``); one that is missing is said and left out.
All start from the same states; contenders take turns, and a figure is the least of its rounds.
"""

from __future__ import annotations

import importlib.util
import math
import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

import engine_systems as systems
import lagrangian as lg
from lagrangian import dynamics
from lagrangian.graph import Program
from lagrangian.integrate import Solver
from record import append, command_line, table, this_machine

HERE = Path(__file__).parent
STEP = 0.002
STEPS = 1000
RUNS = 10_000
TOLERANCE = 1e-12
END = 100.0
MASSES, LENGTHS, G = (1.0, 1.1), (0.75, 0.7), 9.81
START = (0.3, 0.45, 0.0, 0.0)
"""A moderate swing: the error at the end still means something."""

Array = np.ndarray
Call = Callable[[], Any]


# -- systems --------------------------------------------------------------------------------------------------------


def double_pendulum(driven: bool = False) -> Program:
    """Point masses, absolute angles; with torques if driven."""
    s = lg.System("double pendulum")
    at = s.origin
    for k, (m, length) in enumerate(zip(MASSES, LENGTHS, strict=True)):
        q = s.coordinate(f"q{k}")
        at = s.frame(q, origin=s.origin).point(0, -length, at=at)
        s.particle(m, at=at)
        if driven:
            s.torque(s.input(f"u{k}"), on=q)
    s.gravity(direction=(0, -1), g=G)
    return dynamics.rhs(s.model)


def cart_pole() -> Program:
    """A cart of 1 kg with friction, a pole of 0.2 kg at 0.5 m, a force on the cart."""
    s = lg.System("cart-pole")
    x, angle = s.coordinates("x angle")
    cart = s.origin + (x, 0)
    s.particle(1.0, at=cart)
    s.particle(0.2, at=s.frame(angle, origin=cart).point(0, -0.5, at=cart))
    s.damper(0.1, deflection=x)
    s.force((s.input("f"), 0), at=cart)
    s.gravity(direction=(0, -1), g=G)
    return dynamics.rhs(s.model)


def arm() -> Program:
    """The 7-joint arm with full inertias, torques at the joints."""
    return dynamics.rhs(systems.described(systems.arm_tree()).model)


FIXED: Mapping[str, tuple[Callable[[], Program], float]] = {
    "2 links": (lambda: double_pendulum(driven=True), 33.0),
    "cart-pole": (cart_pole, math.nan),
    "7-joint arm": (arm, 2.8),
}
"""Name → program, and what C by hand reached in a run of its own on such a machine [million steps a second].

Eight lanes, libmvec, gcc -O3 -march=native -ffast-math; it needs a compiler, so it is not run here.
"""


# -- measuring ------------------------------------------------------------------------------------------------------


def fastest(contenders: Mapping[str, Call], rounds: int) -> dict[str, float]:
    """Seconds a call of each: the least over rounds in which they take turns."""
    found: dict[str, float] = {}
    for _ in range(rounds):
        for name, call in contenders.items():
            begin = time.perf_counter()
            call()
            taken = time.perf_counter() - begin
            found[name] = min(taken, found.get(name, taken))
    return found


def there(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


# -- ensembles with a fixed step ------------------------------------------------------------------------------------


def jax_loop(x0: Array, u: Array, steps: int) -> Call:
    """``lax.scan`` over RK4 steps of the whole batch, the equations written by hand."""
    os.environ.setdefault("JAX_PLATFORMS", "cpu")
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    (m1, m2), (l1, l2) = MASSES, LENGTHS

    def rates(x: Any, u: Any) -> Any:
        a, b, va, vb = x[:, 0], x[:, 1], x[:, 2], x[:, 3]
        k, s, c = m2 * l1 * l2, jnp.sin(a - b), jnp.cos(a - b)
        h1 = u[:, 0] - k * s * vb * vb - (m1 + m2) * G * l1 * jnp.sin(a)
        h2 = u[:, 1] + k * s * va * va - m2 * G * l2 * jnp.sin(b)
        m11, m12, m22 = (m1 + m2) * l1**2, k * c, m2 * l2**2
        d = 1 / (m11 * m22 - m12 * m12)
        return jnp.stack([va, vb, (m22 * h1 - m12 * h2) * d, (m11 * h2 - m12 * h1) * d], axis=1)

    @jax.jit
    def run(x: Any, u: Any) -> Any:
        def step(x: Any, _: Any) -> Any:
            k1 = rates(x, u)
            k2 = rates(x + STEP / 2 * k1, u)
            k3 = rates(x + STEP / 2 * k2, u)
            k4 = rates(x + STEP * k3, u)
            return x + STEP / 6 * (k1 + 2 * k2 + 2 * k3 + k4), None

        return jax.lax.scan(step, x, None, length=steps)[0]

    given = jnp.asarray(x0), jnp.asarray(u)
    run(*given).block_until_ready()
    return lambda: np.asarray(run(*given))


def mujoco_rollout(x0: Array, u: Array, steps: int, tree: systems.Tree) -> Call:
    """MuJoCo's own RK4 by its ``rollout`` of many states."""
    import mujoco
    from mujoco import rollout

    from engine_peers import mjcf

    model = mujoco.MjModel.from_xml_string(mjcf(tree))
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.timestep = STEP
    data = mujoco.MjData(model)
    state = np.concatenate([np.zeros((len(x0), 1)), x0], axis=1)
    control = np.repeat(u[:, None, : model.nu], steps, axis=1) if model.nu else None
    return lambda: rollout.rollout(model, data, state, control, nstep=steps)


def ours_fixed(program: Program, cores: int, x0: Array, u: Array, times: list[float]) -> Call:
    """Our RK4 on so many cores, compiled beforehand."""
    solver = Solver(program, "rk4", threads=cores)
    solver.solve(x0[:32], times, u=u[:32], step=STEP, store=False)
    return lambda: solver.solve(x0, times, u=u, step=STEP, store=False)


def fixed_rows(quick: bool) -> list[list[str]]:
    rows = []
    runs, steps, rounds = (1000, 200, 2) if quick else (RUNS, STEPS, 4)
    rng = np.random.default_rng(0)
    for name, (program, aim) in FIXED.items():
        made = program()
        size, inputs = len(made.inputs["x"]), len(made.inputs["u"])
        x0, u = rng.uniform(-1, 1, (runs, size)), rng.uniform(-1, 1, (runs, inputs))
        end = [0.0, steps * STEP]
        contenders: dict[str, Call] = {}
        for cores in (1, 2):
            contenders[f"ours {cores}"] = ours_fixed(made, cores, x0, u, end)
        scale: dict[str, float] = {}
        if name == "2 links" and there("jax"):
            contenders["jax"] = jax_loop(x0, u, steps)
            agree = np.abs(contenders["jax"]() - contenders["ours 1"]().final).max()
            assert agree < 1e-9, agree
        if name == "7-joint arm" and there("mujoco"):
            few = max(1, runs // 100)
            contenders["mujoco"] = mujoco_rollout(x0[:few], u[:few], steps, systems.arm_tree())
            scale["mujoco"] = few / runs
        taken = fastest(contenders, rounds)
        speed = {k: runs * scale.get(k, 1.0) * steps / t / 1e6 for k, t in taken.items()}
        row = [name, f"{speed['ours 1']:.3g}", f"{speed['ours 2'] / speed['ours 1']:.2f}"]
        row.append(f"{aim:g} ({speed['ours 1'] / aim:.1f})" if aim == aim else "")
        for peer in ("jax", "mujoco"):
            s = speed.get(peer)
            row.append(f"{s:.3g} ({speed['ours 1'] / s:.0f})" if s else "")
        rows.append(row)
    return rows


# -- one accurate run -----------------------------------------------------------------------------------------------


def by_hand(cos: Any = math.cos, sin: Any = math.sin) -> Callable[[float, Array], tuple]:
    """The double pendulum's right-hand side in plain Python, as ``lambdify`` with common subexpressions writes it."""
    (m1, m2), (l1, l2) = MASSES, LENGTHS
    k, m11, m22, w1, w2 = m2 * l1 * l2, (m1 + m2) * l1**2, m2 * l2**2, (m1 + m2) * G * l1, m2 * G * l2

    def rates(t: float, x: Array) -> tuple:
        a, b, va, vb = x
        s, m12 = k * sin(a - b), k * cos(a - b)
        h1, h2 = -s * vb * vb - w1 * sin(a), s * va * va - w2 * sin(b)
        d = 1 / (m11 * m22 - m12 * m12)
        return va, vb, (m22 * h1 - m12 * h2) * d, (m11 * h2 - m12 * h1) * d

    return rates


def heyoka_system(real: Callable[[float], Any] = float) -> Any:
    import heyoka as hy

    (m1, m2), (l1, l2), g = [real(x) for x in MASSES], [real(x) for x in LENGTHS], real(G)
    a, b, va, vb = hy.make_vars("a", "b", "va", "vb")
    half = real(0.5)
    energy = half * ((m1 + m2) * l1 * l1 * va * va + m2 * l2 * l2 * vb * vb) + m2 * l1 * l2 * va * vb * hy.cos(a - b)
    potential = -g * ((m1 + m2) * l1 * hy.cos(a) + m2 * l2 * hy.cos(b))
    return hy.lagrangian(energy - potential, [a, b], [va, vb])


def truth() -> tuple[Array, str]:
    """The state at the end: 80-bit numbers where heyoka is there, else our series at its finest."""
    if there("heyoka"):
        import heyoka as hy

        if np.finfo(np.longdouble).nmant > 60:
            long = np.longdouble
            start = np.array(START, dtype=long)
            exact = hy.taylor_adaptive(heyoka_system(long), start, tol=long(1e-18), fp_type=long, high_accuracy=True)
            exact.propagate_until(long(END))
            return np.array(exact.state, float), "heyoka's series in 80-bit numbers"
    found = Solver(double_pendulum(), "taylor").solve(START, [0.0, END], rtol=1e-16, atol=1e-16)
    return found.final[0], "our own series, tolerance 1e-16"


def accurate_rows(quick: bool) -> tuple[list[list[str]], str]:
    exact, how = truth()
    program = double_pendulum()
    contenders: dict[str, Callable[[], tuple[Array, Any]]] = {}
    for method, tolerance in (("taylor", 1e-12), ("taylor", 3e-13), ("dop853", 1e-12), ("dop853", 1e-14)):
        solver = Solver(program, method)

        def ours(s: Solver = solver, tol: float = tolerance) -> tuple[Array, Any]:
            found = s.solve(START, [0.0, END], rtol=tol, atol=tol, store=False)
            return found.final[0], found.steps[0]

        contenders[f"ours, {method}, {tolerance:g}"] = ours
    if there("scipy"):
        from scipy.integrate import solve_ivp

        rates = by_hand()

        def scipy() -> tuple[Array, Any]:
            found = solve_ivp(rates, (0, END), START, method="DOP853", rtol=TOLERANCE, atol=TOLERANCE)
            return found.y[:, -1], len(found.t) - 1

        contenders[f"SciPy DOP853, plain Python, {TOLERANCE:g}"] = scipy
    if there("heyoka"):
        import heyoka as hy

        series = hy.taylor_adaptive(heyoka_system(), np.zeros(4), tol=TOLERANCE)

        def heyoka() -> tuple[Array, Any]:
            series.time, series.state[:] = 0.0, START
            steps = series.propagate_until(END)[3]
            return series.state.copy(), steps

        contenders[f"heyoka, {TOLERANCE:g}"] = heyoka
    taken = fastest(contenders, 3 if quick else 25)
    slow = next((t for name, t in taken.items() if name.startswith("SciPy")), math.nan)
    rows = []
    for name, call in contenders.items():
        state, steps = call()
        error = np.abs(state - exact).max()
        rows.append([name, f"{taken[name] * 1e3:.3f}", f"{slow / taken[name]:.0f}", str(steps), f"{error:.1e}"])
    return rows, how


# -- an ensemble with adaptive steps --------------------------------------------------------------------------------


def ensemble_rows(quick: bool) -> list[list[str]]:
    runs, end, tolerance = (400 if quick else RUNS), 10.0, 1e-9
    x0 = np.random.default_rng(1).uniform(-1, 1, (runs, 4))
    program = double_pendulum()
    exact = Solver(program, "taylor").solve(x0, [0.0, end], rtol=1e-15, atol=1e-15, store=False).final
    contenders: dict[str, Callable[[], Array]] = {}
    for method, tol in (("dop853", 1e-9), ("dop853", 1e-11), ("taylor", 1e-9), ("taylor", 3e-11)):
        solver = Solver(program, method, threads=1)
        contenders[f"ours, {method}, {tol:g}"] = lambda s=solver, tol=tol: (
            s.solve(x0, [0.0, end], rtol=tol, atol=tol, store=False).final
        )
    if there("heyoka"):
        import heyoka as hy

        series = hy.taylor_adaptive_batch(heyoka_system(), np.zeros((4, 8)), tol=tolerance)

        def heyoka() -> Array:
            final = np.empty_like(x0)
            for k in range(0, runs, 8):
                series.set_time(0.0)
                series.state[:] = x0[k : k + 8].T
                series.propagate_until(end)
                final[k : k + 8] = series.state.T
            return final

        contenders[f"heyoka, batches of 8, {tolerance:g}"] = heyoka
    for call in contenders.values():
        call()
    taken = fastest(contenders, 2 if quick else 4)
    rows = []
    for name, call in contenders.items():
        errors = np.abs(call() - exact).max(axis=1)
        rows.append([name, f"{taken[name] / runs * 1e6:.1f}", f"{np.median(errors):.1e}", f"{errors.max():.1e}"])
    return rows


# -- the report -----------------------------------------------------------------------------------------------------


def report(quick: bool) -> list[str]:
    lines = [
        "## Integrators",
        "",
        f"`python bench/simulate.py`. {this_machine('llvmlite', 'scipy', 'heyoka', 'jax', 'mujoco')}.",
        "",
    ]
    lines += [f"RK4, {RUNS} runs of {STEPS} steps, million steps a second on one core; in brackets how many times.", ""]
    lines += ["C by hand needs a compiler: its figures are those of another run on such a machine.", ""]
    head = ["one core", "ours", "two cores", "C by hand, another run", "JAX `lax.scan`", "MuJoCo `rollout`"]
    lines += table(head, fixed_rows(quick))
    rows, how = accurate_rows(quick)
    lines += ["", f"One run, double pendulum, moderate swing, t = {END:g}; error at the end against {how}.", ""]
    lines += table(["method, tolerance", "ms", "times SciPy", "steps", "error"], rows)
    lines += ["", "An ensemble of double pendula, t = 10, one core; errors against our series, tolerance 1e-15.", ""]
    return lines + table(["method, tolerance", "µs a run", "median error", "greatest"], ensemble_rows(quick))


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer runs and rounds")
    given = parser.parse_args()
    lines = report(given.quick)
    print("\n".join(lines), flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
