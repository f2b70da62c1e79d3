"""Measure derivatives of the accelerations beside Pinocchio: operations, compiling, time a state, agreement.

    python bench/derivatives.py                 print Markdown tables
    python bench/derivatives.py --append        and append them to bench/RESULTS.md, with the machine

All of a, ∂a/∂q, ∂a/∂v and M⁻¹ are computed, by `dynamics.derivatives` with wrt=("q", "v") and by Pinocchio's
``computeABADerivatives``. Pinocchio is called from Python, one state after the other, since its wheel has no loop over
states for derivatives and brings no headers of Eigen. What Python adds is estimated by the same call for a model with
one joint; it is subtracted in the second column of its times, and in the ratios. CasADi differentiates the equations
from L, as C by the compiler that there is, for the arm alone. MuJoCo's `mjd_transitionFD` is the finite difference of a
step: it includes the integrator, and is called from Python. Everything runs in turn on one core, the least of many
short chunks, so ratios come from one run.
"""

from __future__ import annotations

import importlib.util
import os
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np

import engine_systems as systems
from engine import best, one_call
from engine_peers import CasADiDerivatives, MuJoCo, Pinocchio
from engine_systems import Array, Body, Link, Tree, Z
from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.graph import count_program
from record import append, command_line, one_core, table, this_machine

HERE = Path(__file__).parent
TREES = {"arm": systems.arm_tree, "quadruped": systems.quadruped_tree, "humanoid": systems.humanoid_tree}
STATES = 256
"""States in a timed call: inputs and outputs of the largest stay in the second cache."""

NAMES = ("a", "a_q", "a_v", "Minv")


def called(peer: Pinocchio, q: Array, v: Array, u: Array) -> Callable[[], object]:
    """One call of Pinocchio's function, which writes into its data."""
    pin, model, data = peer.pin, peer.model, peer.data
    return lambda: pin.computeABADerivatives(model, data, q, v, u)


def disagreement(peer: Pinocchio, found: dict[str, Array], states: tuple[Array, Array, Array]) -> float:
    """The greatest difference, as a part of the greatest entry of each array."""
    worst = 0.0
    for k, (q, v, u) in enumerate(zip(*states, strict=True)):
        by_q, by_v, Minv = peer.pin.computeABADerivatives(peer.model, peer.data, q, v, u)
        theirs = (peer.data.ddq, by_q, by_v, np.triu(Minv) + np.triu(Minv, 1).T)
        for name, wanted in zip(NAMES, theirs, strict=True):
            worst = max(worst, float(np.abs(found[name][k] - wanted).max() / np.abs(wanted).max()))
    return worst


def one_joint() -> Tree:
    """The smallest tree, for what a call costs in Python."""
    body = Body(1.0, (0.1, 0.0, 0.0), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
    return Tree("one joint", (Link(-1, Z, (0.0, 0.0, 0.0), body),))


def row(name: str, rounds: int, seconds: float) -> list[str]:
    """The figures of one system."""
    tree = TREES[name]()
    states = tree.states(STATES)
    clock = [time.process_time()]
    program = dynamics.derivatives(systems.described(tree).model, ("q", "v"))
    clock.append(time.process_time())
    kernel = machine.compile(program, optional={"t": 0.0}, threads=1, keep=False)
    kernel(*(x[0] for x in states))
    clock.append(time.process_time())
    found = kernel(*states)
    clock.append(time.process_time())
    peer, small = Pinocchio(tree), Pinocchio(one_joint())
    contenders = {
        "one": one_call(kernel, *states),
        "batch": kernel.prepared(*states),
        "theirs": called(peer, *(x[0] for x in states)),
        "python": called(small, *(x[0] for x in one_joint().states(1))),
    }
    others, said = other_peers(tree, states, found)
    taken = best({**contenders, **others}, rounds, seconds)
    one, batch = (taken[k] / STATES for k in ("one", "batch"))
    if "casadi" in taken:
        taken["casadi"] /= STATES
    core = taken["theirs"] - taken["python"]
    made = [f"{b - a:.2f}" for a, b in pairwise(clock)]
    times = [f"{one * 1e9:.0f}", f"{batch * 1e9:.0f}", f"{taken['theirs'] * 1e9:.0f}", f"{core * 1e9:.0f}"]
    ratios = [f"{core / one:.2f}", f"{core / batch:.2f}"]
    ratios += [in_ratio(taken[k], one, batch) if k in taken else said.get(k, "") for k in ("casadi", "mujoco")]
    return [
        name,
        str(count_program(program).operations),
        *made,
        *times,
        *ratios,
        f"{disagreement(peer, found, states):.1e}",
    ]


def in_ratio(theirs: float, one: float, batch: float) -> str:
    """A time in ns, and how many times ours it is, one call and batch."""
    return f"{theirs * 1e9:.0f} ({theirs / one:.1f}, {theirs / batch:.1f})"


def other_peers(
    tree: Tree, states: tuple[Array, Array, Array], ours: dict[str, Array]
) -> tuple[dict[str, Callable[[], object]], dict[str, str]]:
    """What CasADi and MuJoCo have, and what is said of those that are missing. CasADi's numbers are compared first."""
    found: dict[str, Callable[[], object]] = {}
    said: dict[str, str] = {}
    if not tree.floats:
        if importlib.util.find_spec("casadi") is None:
            said["casadi"] = "not installed"
        else:
            casadi = CasADiDerivatives(tree)
            made = casadi.function(*(x[0] for x in states))
            for name, theirs in zip(NAMES, made, strict=True):
                np.testing.assert_allclose(np.array(theirs).reshape(ours[name][0].shape), ours[name][0], 1e-8, 1e-8)
            timed = casadi.timed(*states)
            found |= {} if timed is None else {"casadi": timed}
            said |= {"casadi": "no C compiler"} if timed is None else {}
    peer = MuJoCo(tree)
    peer.accelerations(*(x[:1] for x in states))
    mujoco, model, data, n = peer.mujoco, peer.model, peer.data, peer.model.nv
    A, B = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, model.nu))
    found["mujoco"] = lambda: mujoco.mjd_transitionFD(model, data, 1e-6, False, A, B, None, None)
    return found, said


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer rounds, without the humanoid")
    given = parser.parse_args()
    os.environ["LAGRANGIAN_CACHE_DIR"] = ""
    one_core()
    rounds, seconds = (2, 0.05) if given.quick else (6, 0.15)
    lines = [
        "## Derivatives of the accelerations",
        "",
        f"`python bench/derivatives.py`. {this_machine('llvmlite', 'pin', 'mujoco', 'casadi')}.",
        "",
    ]
    lines += [
        "a, ∂a/∂q, ∂a/∂v and M⁻¹ together. CPU seconds: the program, machine code for one state, for a batch. Times in",
        "ns a state. Pinocchio (the wheel's code, not built for this processor) is called from Python; the next column",
        "is without the same call for one joint, and so are the ratios. Of CasADi's C (from L, the machine's compiler)",
        "and MuJoCo's finite difference of a step: ns, in brackets how many times ours, one call and batch.",
        "",
    ]
    head = [
        "one core",
        "operations",
        "program [s]",
        "one [s]",
        "batch [s]",
        "one call",
        "batch",
        "Pinocchio",
        "without Python",
    ]
    head += ["one call: times as fast", "batch: times as fast", "CasADi's C", "`mjd_transitionFD`", "difference"]
    names = [name for name in TREES if not (given.quick and name == "humanoid")]
    lines += table(head, [row(name, rounds, seconds) for name in names])
    print("\n".join(lines), flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
