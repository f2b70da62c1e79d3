"""Time the whole derivation beside SymPy's LagrangesMethod with simplify, each in a fresh process.

    python bench/derive.py                 print a Markdown table
    python bench/derive.py --append        and append it to bench/RESULTS.md, with the machine

Ours is everything `System.derive` does: the seven steps, the terms and where they come from, the matrices, and the
checks at the end. SymPy's is `form_lagranges_equations` and `simplify` of the equations. Both start from a described
system, after imports, with nothing cached. Operations are `sympy.count_ops` over all equations, with coordinates, rates
and accelerations as plain symbols; in brackets with SymPy's functions and derivatives counted as well.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

from record import append, command_line, this_machine

HERE = Path(__file__).parent
SYSTEMS = {
    "double pendulum, absolute": (2, False),
    "double pendulum, relative": (2, True),
    "triple pendulum, absolute": (3, False),
    "triple pendulum, relative": (3, True),
    "four links, absolute": (4, False),
    "four links, relative": (4, True),
    "eight links, relative": (8, True),
}
LIMITS = {"double pendulum, absolute": 0.3, "double pendulum, relative": 0.3, "triple pendulum, relative": 1.5}
LIMITS |= {"four links, absolute": 2.0, "eight links, relative": 20.0}
SLOW = 10.0
"""[s] A run that takes longer is not repeated."""


def plain(expr, coordinates):
    import sympy as sp

    t = sp.Symbol("t")
    for order in (2, 1, 0):
        for q in coordinates:
            old = sp.Derivative(q, (t, order)) if order else q
            expr = expr.xreplace({old: sp.Symbol(f"{q.func.__name__}_{order}")})
    return expr


def operations(expressions, coordinates) -> tuple[int, int]:
    import sympy as sp

    listed = list(expressions)
    return int(sum(sp.count_ops(plain(e, coordinates)) for e in listed)), int(sum(sp.count_ops(e) for e in listed))


def ours(n: int, relative: bool) -> tuple[float, tuple[int, int]]:
    from sympy import cos, sin

    import lagrangian as lg

    system = lg.System("chain")
    coordinates = system.coordinates([f"theta{i}" for i in range(1, n + 1)])
    masses = system.parameters([f"m{i}" for i in range(1, n + 1)])
    lengths = system.parameters([f"L{i}" for i in range(1, n + 1)])
    point, angle = system.origin, 0
    for q, m, length in zip(coordinates, masses, lengths, strict=True):
        angle = angle + q if relative else q
        point = point + (length * sin(angle), -length * cos(angle))
        system.particle(m, at=point)
    system.gravity()
    start = time.perf_counter()
    d = system.derive()
    taken = time.perf_counter() - start
    return taken, operations([side for e in d.equations for side in (e.lhs, e.rhs)], coordinates)


def sympys(n: int, relative: bool) -> tuple[float, tuple[int, int]]:
    import sympy as sp
    from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

    t, g = dynamicsymbols._t, sp.Symbol("g")
    coordinates = [dynamicsymbols(f"theta{i}") for i in range(1, n + 1)]
    x = y = angle = T = V = sp.S.Zero
    for i, q in enumerate(coordinates, 1):
        angle = angle + q if relative else q
        m, length = sp.Symbol(f"m{i}"), sp.Symbol(f"L{i}")
        x, y = x + length * sp.sin(angle), y - length * sp.cos(angle)
        T += m * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2
        V += m * g * y
    start = time.perf_counter()
    equations = sp.simplify(LagrangesMethod(T - V, coordinates).form_lagranges_equations())
    taken = time.perf_counter() - start
    return taken, operations(equations, coordinates)


CONTENDERS = {"lagrangian": ours, "SymPy LagrangesMethod + simplify": sympys}


def alone(contender: str, name: str, cap: float) -> tuple[float, tuple[int, int]] | None:
    """One contender on one system in a fresh process; None where it takes longer than the cap."""
    command = [sys.executable, str(Path(__file__).resolve()), "--one", contender, name]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=cap + 30, check=True)
    except subprocess.TimeoutExpired:
        return None
    except subprocess.CalledProcessError as error:
        raise SystemExit(f"{contender}, {name}:\n{error.stderr}") from error
    taken, count = json.loads(done.stdout)
    return (taken, count) if taken <= cap else None


def row(name: str, cap: float, repeats: int) -> str:
    def best(contender: str) -> tuple[float, tuple[int, int]] | None:
        results = [alone(contender, name, cap)]
        while results[-1] and results[-1][0] < SLOW and len(results) < repeats:
            results.append(alone(contender, name, cap))
        return min((r for r in results if r), default=None)

    mine, theirs = (best(c) for c in CONTENDERS)
    limit = f"{LIMITS[name]:g} s" if name in LIMITS else ""

    def cells(result: tuple[float, tuple[int, int]] | None) -> tuple[str, str]:
        return (f"{result[0]:.3g} s", "{} ({})".format(*result[1])) if result else (f"> {cap:g} s", "")

    times = (theirs[0] if theirs else cap) / mine[0] if mine else 0
    ratio = f"{'' if theirs else '> '}{times:.{0 if times > 10 else 1}f}" if mine else ""
    return "| " + " | ".join((name, *cells(mine), limit, *cells(theirs), ratio)) + " |"


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--cap", type=float, default=120, help="seconds a contender may take")
    parser.add_argument("--repeats", type=int, default=3, help="runs of which the best counts, while they are short")
    parser.add_argument("--one", nargs=2, metavar=("CONTENDER", "SYSTEM"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        print(json.dumps(CONTENDERS[given.one[0]](*SYSTEMS[given.one[1]])))
        return
    lines = [
        "## Derivation of the equations of motion",
        "",
        f"`python bench/derive.py`. {this_machine('sympy')}.",
        "",
        "| pendulums of point masses | lagrangian | operations | aim | SymPy | operations | times as fast |",
        "|---|---:|---:|---:|---:|---:|---:|",
    ]
    print("\n".join(lines), flush=True)
    for name in SYSTEMS:
        lines.append(row(name, given.cap, given.repeats))
        print(lines[-1], flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
