"""What a call from Python costs, beside the arithmetic in it: forward dynamics of one double pendulum, and of 512.

    python bench/calls.py                 print Markdown tables
    python bench/calls.py --append        and append them to bench/RESULTS.md, with the machine

The peers come from their wheels (``pip install heyoka jax``); one that is missing is left out. All compute the same
accelerations, compared before they are timed. Contenders take turns; a figure is the least of the rounds. The last
table is what comes before the runs: a second ensemble of 16 runs of two steps, a second run of as many.
"""

from __future__ import annotations

import importlib.util
import itertools
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import lagrangian as lg
from lagrangian import examples
from record import append, command_line, this_machine

HERE = Path(__file__).parent
STATES = 512
ROUNDS = 40
ROUND = 1e-3
"""The longest round [s]: a longer one is interrupted in every round where other programs wait for the core."""
Array = np.ndarray
Call = Callable[[], Any]


def there(name: str) -> bool:
    return importlib.util.find_spec(name) is not None


def least(calls: dict[str, Call], each: int) -> dict[str, float]:
    """Microseconds a call, the least over rounds of at most ``each`` calls in which all take their turn."""
    found = dict.fromkeys(calls, float("inf"))
    for _ in range(ROUNDS):
        for name, call in calls.items():
            count = min(each, max(1, int(ROUND / found[name] * 1e6))) if found[name] < float("inf") else 1
            begin = time.perf_counter()
            for _ in range(count):
                call()
            found[name] = min(found[name], (time.perf_counter() - begin) / count * 1e6)
    return found


def energies(p: Array, cos: Any) -> Any:
    """L of the example's double pendulum with absolute angles, for peers that differentiate it."""
    m1, m2, l1, l2, g = p

    def lagrangian(a: Any, b: Any, va: Any, vb: Any) -> Any:
        T = 0.5 * ((m1 + m2) * l1**2 * va * va + m2 * l2**2 * vb * vb) + m2 * l1 * l2 * va * vb * cos(a - b)
        return T + g * ((m1 + m2) * l1 * cos(a) + m2 * l2 * cos(b))

    return lagrangian


def heyoka(p: Array, x: Array, rows: Array) -> tuple[Call, Call]:
    import heyoka as hy

    names = hy.make_vars("a", "b", "va", "vb")
    system = hy.lagrangian(energies(p.tolist(), hy.cos)(*names), list(names[:2]), list(names[2:]))
    function = hy.cfunc([rate for _, rate in system[2:]], vars=list(names))
    columns = np.ascontiguousarray(rows.T)
    return lambda: function(x), lambda: function(columns).T


def jax(p: Array, x: Array, rows: Array) -> tuple[Call, Call]:
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    L = energies(p, jnp.cos)

    def forward(x: Any) -> Any:
        q, v = x[:2], x[2:]

        def of(q: Any, v: Any) -> Any:
            return L(q[0], q[1], v[0], v[1])

        M = jax.hessian(of, 1)(q, v)
        return jnp.linalg.solve(M, jax.grad(of, 0)(q, v) - jax.jacfwd(jax.grad(of, 1), 0)(q, v) @ v)

    one, many = jax.jit(forward), jax.jit(jax.vmap(forward))
    at, all_at = jnp.asarray(x), jnp.asarray(rows)
    return lambda: one(at).block_until_ready(), lambda: many(all_at).block_until_ready()


def beside_peers() -> str:
    system = lg.loads(examples.text("double-pendulum"))
    compiled = system.compile(threads=1)
    p = np.array([q.value for q in system.model.parameters], float)
    rows = np.random.default_rng(0).uniform(-1, 1, (STATES, 4))
    x, Q, V = rows[0], np.ascontiguousarray(rows[:, :2]), np.ascontiguousarray(rows[:, 2:])
    q, v = Q[0], V[0]
    one: dict[str, Call] = {"lagrangian": lambda: compiled.forward(q, v)}
    many: dict[str, Call] = {"lagrangian": lambda: compiled.forward(Q, V)}
    for name, make in {"heyoka `cfunc`": heyoka, "JAX `jit`": jax}.items():
        if there(make.__name__):
            one[name], many[name] = make(p, x, rows)
    for calls in (one, many):
        for call in calls.values():
            np.testing.assert_allclose(np.asarray(call()), calls["lagrangian"](), rtol=1e-9, atol=1e-12)
    prepared = compiled._kernels["forward"].prepared(Q, V)
    singles, batches = least(one, 1000), least({**many, "arithmetic": prepared}, 100)
    lines = [
        "| double pendulum, µs a call | one state | times | 512 states | times |",
        "| --- | ---: | ---: | ---: | ---: |",
    ]
    for name in one:
        ratios = singles[name] / singles["lagrangian"], batches[name] / batches["lagrangian"]
        lines.append(f"| {name} | {singles[name]:.2f} | {ratios[0]:.1f} | {batches[name]:.1f} | {ratios[1]:.1f} |")
    lines.append(f"| lagrangian, arrays prepared once | | | {batches['arithmetic']:.1f} | |")
    return "\n".join(lines)


def forms() -> str:
    system = lg.loads(examples.text("cart-pole"))
    c = system.compile(threads=1)
    q, v, u, t = np.array([0.1, 0.2]), np.array([0.3, 0.1]), np.array([0.5]), 0.25
    p = np.array([x.value for x in system.model.parameters], float)
    x, Q, V = np.concatenate([q, v]), np.tile(q, (STATES, 1)), np.tile(v, (STATES, 1))
    names, inputs = dict(zip(c.parameters, p.tolist(), strict=True)), {"F": 0.5}
    symbols = {system[name]: 0.5 for name in inputs}, {system[name]: value for name, value in names.items()}
    each_p = np.tile(p, (STATES, 1))
    new = itertools.cycle([p * (1 + 1e-3 * k) for k in range(500)])
    each = {
        "forward(q, v)": lambda: c.forward(q, v),
        "forward(q, v, u=array, p=array)": lambda: c.forward(q, v, u=u, p=p),
        "forward(q, v, u, p, t)": lambda: c.forward(q, v, u, p, t),
        "forward(q, v, p=another array every time)": lambda: c.forward(q, v, p=next(new)),
        "forward(q, v, u={…}, p={…})": lambda: c.forward(q, v, u=inputs, p=names),
        "forward(q, v, u={…}, p={…}), symbols as keys": lambda: c.forward(q, v, u=symbols[0], p=symbols[1]),
        "forward([…], […])": lambda: c.forward([0.1, 0.2], [0.3, 0.1]),
        "inverse(q, v, a, u, p)": lambda: c.inverse(q, v, v, u, p),
        "mass_matrix(q, p=another array every time)": lambda: c.mass_matrix(q, next(new)),
        "energy(q, v)": lambda: c.energy(q, v),
        "rhs(t, x, u, p)": lambda: c.rhs(t, x, u, p),
        "energy of 512 states": lambda: c.energy(Q, V),
        "forward of 512 states, p=array": lambda: c.forward(Q, V, p=p),
        "forward of 512 states, p=another array every time": lambda: c.forward(Q, V, p=next(new)),
        "forward of 512 states, an array with a p for each": lambda: c.forward(Q, V, p=each_p),
    }
    found = least({"nothing(q, v, u, p, t)": lambda: nothing(q, v, u, p, t), **each}, 300)
    kernels, batch = c._kernels, "forward of 512 states, p=array"
    arithmetic = least(
        {
            "energy of 512 states": kernels["energy"].prepared(Q, V),
            batch: kernels["forward"].prepared(Q, V, p=p),
            "forward of 512 states, an array with a p for each": kernels["forward"].prepared(Q, V, p=each_p),
        },
        300,
    )
    arithmetic["forward of 512 states, p=another array every time"] = arithmetic[batch]
    rest = {name: f"{arithmetic[name]:.2f}" if name in arithmetic else "" for name in found}
    lines = (f"| `{name}` | {x:.2f} | {rest[name]} |" for name, x in found.items())
    return "\n".join(["| cart and pole | µs | of which arithmetic |", "| --- | ---: | ---: |", *lines])


def nothing(q: Array, v: Array, u: Array, p: Array, t: float) -> None:
    """What a call of Python costs on the machine."""


def before_runs() -> str:
    system = lg.loads(examples.text("double-pendulum"))
    starts = np.linspace(0.1, 0.2, 16)
    found = least(
        {
            "ensemble": lambda: system.ensemble(0.02, theta1=starts, method="rk4", step=0.01, threads=1),
            "simulate": lambda: system.simulate(0.02, theta1=0.1, samples=3),
        },
        1,
    )
    return "\n".join(["| repeated | ms |", "| --- | ---: |", *(f"| {n} | {x / 1e3:.2f} |" for n, x in found.items())])


def main() -> None:
    parser = command_line(__doc__)
    given = parser.parse_args()
    own = [forms(), before_runs()]  # before the peers are loaded, whose presence slows some of it
    tables = "\n\n".join([beside_peers(), *own])
    where = this_machine("numpy", "llvmlite", "heyoka", "jax")
    text = f"## Calls\n\n`python bench/calls.py`, the least of {ROUNDS} rounds. {where}.\n\n{tables}\n"
    print(text)
    if given.append:
        append([text])


if __name__ == "__main__":
    main()
