"""Measure systems with constraints: one state and a batch, beside Pinocchio and MuJoCo on the same mechanism.

    python bench/constraints.py                 print Markdown tables
    python bench/constraints.py --append        and append them to bench/RESULTS.md, with the machine

As in `engine.py`: one core, the least of many short chunks, contenders in turn. States satisfy the constraints. Ours
gives the accelerations; Pinocchio's `constraintDynamics` is called from Python, state by state; MuJoCo's constraints
are soft, so that it agrees to its own softness only. Neither of the two has constraints on velocities.
"""

from __future__ import annotations

import ctypes
import importlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

import lagrangian as lg
from engine import best, found, one_call
from engine_peers import Loop, MuJoCo, Pinocchio, Timed
from engine_systems import GRAVITY, Array, Pins, described, quadruped_tree
from lagrangian import codegen as machine
from lagrangian.graph import Graph, Output, Program, count_operations, from_sympy
from record import append, command_line, one_core, table, this_machine

STATES = 512


@dataclass(frozen=True)
class Linkage:
    """Uniform bars by relative angles: each begins at a point of the ground or the end of an earlier bar.

    ``loops`` are pairs (bar, bar or point of the ground) whose ends coincide; bar k weighs 1 + its length.
    """

    lengths: tuple[float, ...]
    begins: tuple[Any, ...]
    loops: tuple[tuple[int, Any], ...]
    guess: tuple[float, ...]

    def system(self) -> lg.System:
        s = lg.System("linkage")
        tips: list[Any] = []
        frames: list[Any] = []
        for k, (length, below) in enumerate(zip(self.lengths, self.begins, strict=True)):
            l, m = s.parameter(f"l{k}", length), s.parameter(f"m{k}", 1 + length)
            parent, at = (None, s.origin + below) if isinstance(below, tuple) else (frames[below], tips[below])
            frames.append(s.frame(s.coordinate(f"q{k}"), parent=parent, origin=at))
            s.rigid_body(m, m * l**2 / 12, at=frames[-1].point(l / 2, 0, at=at), frame=frames[-1])
            tips.append(frames[-1].point(l, 0, at=at))
        for k, (i, other) in enumerate(self.loops):
            s.pin((tips[i], s.origin + other if isinstance(other, tuple) else tips[other]), name=f"loop {k}")
        s.gravity()
        return s

    def pinocchio(self) -> Callable[[Array, Array], Array]:
        pin = importlib.import_module("pinocchio")
        model, at = pin.Model(), pin.SE3
        model.gravity.linear = np.array([0, 0, -GRAVITY])
        joints: dict[int, int] = {}
        order = self.depth_first()
        for k in order:
            l, below = self.lengths[k], self.begins[k]
            ground = isinstance(below, tuple)
            start = np.array([below[0], 0, below[1]]) if ground else np.array([self.lengths[below], 0, 0])
            turn = pin.JointModelRevoluteUnaligned(0.0, -1.0, 0.0)
            joints[k] = model.addJoint(0 if ground else joints[below], turn, at(np.eye(3), start), f"{k}")
            across = (1 + l) * l * l / 12
            body = pin.Inertia(1 + l, np.array([l / 2, 0, 0]), np.diag([0, across, across]))
            model.appendBodyToJoint(joints[k], body, at.Identity())
        models, closures = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
        for i, other in self.loops:
            end = at(np.eye(3), np.array([self.lengths[i], 0, 0]))
            ground = isinstance(other, tuple)
            place = np.array([other[0], 0, other[1]] if ground else [self.lengths[other], 0, 0])
            models.append(
                pin.RigidConstraintModel(
                    pin.ContactType.CONTACT_3D,
                    model,
                    joints[i],
                    end,
                    0 if ground else joints[other],
                    at(np.eye(3), place),
                    pin.ReferenceFrame.LOCAL,
                )
            )
            closures.append(models[len(models) - 1].createData())
        data, none = model.createData(), np.zeros(len(self.lengths))
        pin.initConstraintDynamics(model, data, models, closures)
        proximal = pin.ProximalSettings(1e-12, 1e-10, 20)
        back = np.argsort(order)
        ordered = order != sorted(order)

        def accelerations(q: Array, v: Array) -> Array:
            if ordered:
                q, v = q[order], v[order]
            found = pin.constraintDynamics(model, data, q, v, none, models, closures, proximal)
            return found[back] if ordered else found

        return accelerations

    def depth_first(self) -> list[int]:
        """Each bar before those that it carries, and these before the next one: Pinocchio's order of joints."""

        def above(k: int) -> list[int]:
            return [k, *(x for j, b in enumerate(self.begins) if b == k and not isinstance(b, tuple) for x in above(j))]

        return [x for k, b in enumerate(self.begins) if isinstance(b, tuple) for x in above(k)]

    def mjcf(self) -> str:
        bodies: dict[int, str] = {}
        for k in reversed(range(len(self.lengths))):
            l, below = self.lengths[k], self.begins[k]
            place = f"{below[0]} 0 {below[1]}" if isinstance(below, tuple) else f"{self.lengths[below]} 0 0"
            within = "".join(bodies[j] for j, b in enumerate(self.begins) if b == k and not isinstance(b, tuple))
            across = (1 + l) * l * l / 12
            bodies[k] = (
                f'<body name="b{k}" pos="{place}"><joint name="j{k}" axis="0 -1 0"/><inertial pos="{l / 2} 0 0" '
                f'mass="{1 + l}" diaginertia="1e-9 {across} {across}"/><site name="s{k}" pos="{l} 0 0"/>{within}</body>'
            )
        roots = "".join(bodies[k] for k, b in enumerate(self.begins) if isinstance(b, tuple))
        joined = ""
        for n, (i, other) in enumerate(self.loops):
            if isinstance(other, tuple):
                roots += f'<site name="g{n}" pos="{other[0]} 0 {other[1]}"/>'
            other_end = f"g{n}" if isinstance(other, tuple) else f"s{other}"
            stiff = 'solref="0.002 1" solimp="0.9999 0.9999 0.001"'
            joined += f'<connect {stiff} site1="s{i}" site2="{other_end}"/>'
        option = f'<option gravity="0 0 -{GRAVITY}" timestep="1e-4"><flag contact="disable"/></option>'
        return f"<mujoco>{option}<worldbody>{roots}</worldbody><equality>{joined}</equality></mujoco>"

    def mujoco(self, q: Array, v: Array) -> tuple[Array, Timed]:
        """The accelerations at all states, and a timed call at the first one."""
        mujoco = importlib.import_module("mujoco")
        mujoco.set_mjcb_time(None)
        model = mujoco.MjModel.from_xml_string(self.mjcf())
        data, order = mujoco.MjData(model), []
        order = [int(model.joint(f"j{k}").dofadr[0]) for k in range(len(self.lengths))]
        out = np.empty_like(v)
        for k in reversed(range(len(q))):
            data.qpos[order], data.qvel[order] = q[k], v[k]
            mujoco.mj_forward(model, data)
            out[k] = data.qacc[order]
        folder = Path(mujoco.__path__[0])
        library = next(p for p in sorted(folder.iterdir()) if p.name.startswith(("libmujoco.", "mujoco.dll")))
        forward = ctypes.cast(ctypes.CDLL(str(library)).mj_forward, ctypes.c_void_p).value
        loop, kept = Loop(), (model, data)
        given = (forward, len(q), model._address, 0, data._address, None, 0, None)
        return out, lambda: (loop.call(*given), kept)


def ladder(count: int) -> Linkage:
    """Four-bars, each on the coupler of the one before."""
    lengths, begins, loops, guess = [], [], [], []
    for i in range(count):
        start, base = ((0.0, 0.0), (1.2, 0.0)) if i == 0 else (3 * i - 3, 3 * i - 2)
        lengths += [0.7 + 0.01 * i, 1.1, 0.8]
        begins += [start, 3 * i, base]
        loops.append((3 * i + 1, 3 * i + 2))
        guess += [1.2 if i == 0 else 0.0, -1.2, 1.2]
    return Linkage(tuple(lengths), tuple(begins), tuple(loops), tuple(guess))


@dataclass(frozen=True)
class Standing:
    """The quadruped of `engine.py` with its four feet held to the ground by ball joints: 18 velocities, 12 rows.

    It sinks to its knees from a stand; later its knees fold, and MuJoCo's soft constraints do not follow.
    """

    bend: float = 0.6

    @property
    def pins(self) -> Pins:
        foot, reach = (0.0, 0.0, -0.2), 0.2 * np.sin(self.bend) - 0.21 * np.sin(self.bend)
        sides = {2: (1, 1), 5: (1, -1), 8: (-1, 1), 11: (-1, -1)}
        return {i: (foot, (0.19 * fore + reach, 0.13 * side, 0.0)) for i, (fore, side) in sides.items()}

    @property
    def guess(self) -> tuple[float, ...]:
        leg = (0.05, self.bend, -2 * self.bend)
        return (0.0, 0.0, 0.41 * np.cos(self.bend), 0.0, 0.0, 0.0, 1.0, *leg * 4)

    def system(self) -> lg.System:
        return described(quadruped_tree(), self.pins)

    def pinocchio(self) -> Callable[[Array, Array], Array]:
        peer = Pinocchio(quadruped_tree())
        pin, model, data = peer.pin, peer.model, peer.data
        models, closures = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
        for i, (foot, place) in self.pins.items():
            joint, world = model.getJointId(f"joint {i}"), pin.SE3(np.eye(3), np.array(place))
            end, kind = pin.SE3(np.eye(3), np.array(foot)), pin.ContactType.CONTACT_3D
            models.append(pin.RigidConstraintModel(kind, model, joint, end, 0, world, pin.ReferenceFrame.LOCAL))
            closures.append(models[len(models) - 1].createData())
        pin.initConstraintDynamics(model, data, models, closures)
        proximal, none = pin.ProximalSettings(1e-14, 1e-12, 20), np.zeros(model.nv)
        return lambda q, v: pin.constraintDynamics(model, data, q, v, none, models, closures, proximal)

    def mujoco(self, q: Array, v: Array) -> tuple[Array, Timed]:
        """The accelerations at all states, and a timed call at the first one."""
        peer = MuJoCo(quadruped_tree(), self.pins)
        nothing = np.zeros_like(v)
        return peer.accelerations(q, v, nothing), peer.timed(q, v, nothing)


def by_hand() -> Program:
    """The slider-crank in the crank's angle alone, as on paper: M φ̈ + ½ M′ φ̇² = τ − (F + b ẋ) dx/dφ, K = dψ/dφ."""
    system = lg.example("slider-crank")
    model = system.model
    r, l, a, J1, m2, J2, m3, b = (system[n] for n in ("r", "l", "a", "J_1", "m_2", "J_2", "m_3", "b"))
    tau, F, phi = system["tau"], system["F"], system["phi"]
    rate, graph = sp.Derivative(phi, system.t), Graph()
    kinds = {"q": [c.symbol for c in model.coordinates], "v": [c.rate for c in model.coordinates]}
    kinds |= {"u": [u.symbol for u in model.inputs], "p": [p.symbol for p in model.parameters]}
    known = {x: graph.input(group, i) for group, listed in kinds.items() for i, x in enumerate(listed)}

    def let(name: str, expr: Any) -> sp.Symbol:
        symbol = sp.Symbol(name)
        known[symbol] = from_sympy(graph, expr, known)
        return symbol

    s, c = let("s", sp.sin(phi)), let("c", sp.cos(phi))
    sr = let("sr", -r / l * s)
    cr = let("cr", sp.sqrt(1 - sr**2))
    K = let("K", -r / l * c / cr)
    dK = let("dK", sr / cr * (K**2 - 1))
    ends = [(-r * s - d * sr * K, -r * c - d * (cr * K**2 + sr * dK)) for d in (a, l)]
    side = r * c + a * cr * K, -r * s + a * (cr * dK - sr * K**2)
    (Gx, dGx), (X, dX) = ((let(f"G{i}", p), let(f"D{i}", q)) for i, (p, q) in enumerate(ends))
    Gy, dGy = let("Gy", side[0]), let("dGy", side[1])
    M = let("M", J1 + J2 * K**2 + m2 * (Gx**2 + Gy**2) + m3 * X**2)
    half = let("half", J2 * K * dK + m2 * (Gx * dGx + Gy * dGy) + m3 * X * dX)
    let("phi''", (tau - (F + b * X * rate) * X - half * rate**2) / M)
    node = known[sp.Symbol("phi''")]
    names = {"q": [c.name for c in model.coordinates], "v": [v.name for v in model.velocities]}
    names |= {"u": [u.name for u in model.inputs], "p": [p.name for p in model.parameters], "t": ["t"]}
    values = {p.name: p.value for p in model.parameters}
    return Program("by hand", graph, {k: tuple(v) for k, v in names.items()}, {"a": Output((node,), (1,))}, values)


def beside_hand(rounds: int, seconds: float) -> str:
    """What the multipliers cost beside the equation of one degree of freedom that is written by hand."""
    system = lg.example("slider-crank")
    q, v = states(system, None)
    u = np.zeros((len(q), 2))
    programs = {"rows": system.compile().program("forward"), "hand": by_hand()}
    kernels = {key: machine.compile(p, optional={"t": 0.0}, threads=1) for key, p in programs.items()}
    a, hand = kernels["rows"](q, v, u)[:, 0], np.ravel(kernels["hand"](q, v, u))
    timed = {key: one_call(kernel, q, v, u) for key, kernel in kernels.items()}
    timed |= {f"{key} batch": kernel.prepared(q, v, u) for key, kernel in kernels.items()}
    each = {key: t / len(q) * 1e9 for key, t in best(timed, rounds, seconds).items()}
    ops = {k: count_operations(p.graph, p.ids, hoist=["p"]).operations for k, p in programs.items()}
    return (
        f"The slider-crank in its crank's angle alone, derived by hand and compiled alike: {ops['hand']} operations, "
        f"{each['hand']:.1f} ns a call and {each['hand batch']:.1f} in a batch; with three coordinates and two rows "
        f"{ops['rows']}, {each['rows']:.1f} and {each['rows batch']:.1f} (largest relative difference "
        f"{np.abs(a - hand).max() / np.abs(hand).max():.0e})."
    )


def call_alone(rounds: int, seconds: float) -> str:
    """What of Pinocchio's time is the call from Python: the same call for one joint without constraints."""
    if "Pinocchio" not in found():
        return ""
    pin = importlib.import_module("pinocchio")
    model = pin.Model()
    model.addJoint(0, pin.JointModelRZ(), pin.SE3.Identity(), "joint")
    model.appendBodyToJoint(1, pin.Inertia(1.0, np.zeros(3), np.eye(3)), pin.SE3.Identity())
    data, models, closures = model.createData(), pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    pin.initConstraintDynamics(model, data, models, closures)
    proximal, x = pin.ProximalSettings(1e-14, 1e-12, 20), np.zeros(1)
    repeat = range(STATES)

    def calls() -> object:
        return [pin.constraintDynamics(model, data, x, x, x, models, closures, proximal) for _ in repeat]

    each = best({"call": calls}, rounds, seconds)["call"] / STATES
    return (
        f"Of Pinocchio's times, {each * 1e9:.0f} ns are the call from Python: the same call for one joint without "
        "constraints takes as long."
    )


LINKAGES: dict[str, Linkage | Standing] = {
    "four-bar": Linkage((0.5, 1.2, 0.9), ((0.0, 0.0), 0, (1.0, 0.0)), ((1, 2),), (1.0, -0.7, 1.1)),
    "five-bar": Linkage((0.7, 1.1, 0.8, 1.2), ((0.0, 0.0), 0, (1.3, 0.0), 2), ((1, 3),), (2.0, -1.2, 1.2, 1.2)),
    "ladder of 10": ladder(10),
    "quadruped on four feet": Standing(),
}
EXAMPLES = [
    "slider-crank",
    "rolling-disc",
    "chaplygin-sleigh",
    "andrews-squeezer",
    "whipple-bicycle",
    "stewart-platform",
]


def states(system: lg.System, linkage: Linkage | Standing | None) -> tuple[Array, Array]:
    """States along a motion, which satisfy the constraints."""
    settings = system.model.settings
    names = [c.name for c in system.model.coordinates]
    start = settings.get("initial", {}) if linkage is None else dict(zip(names, linkage.guess, strict=True))
    duration = 0.15 if isinstance(linkage, Standing) else settings.get("duration", 0.3)
    run = system.simulate(duration, initial=start, samples=STATES)
    n = len(names)
    q = np.ascontiguousarray(run.y[:n].T)
    if isinstance(linkage, Standing):  # ours takes quaternions of any length, Pinocchio those of length 1
        q[:, 3:7] /= np.linalg.norm(q[:, 3:7], axis=1, keepdims=True)
    return q, np.ascontiguousarray(run.y[n : n + len(system.model.velocities)].T)


def measured(name: str, rounds: int, seconds: float) -> list[str]:
    linkage = LINKAGES.get(name)
    system = lg.example(name) if linkage is None else linkage.system()
    q, v = states(system, linkage)
    program = system.compile().program("forward")
    kernel = machine.compile(program, optional={"t": 0.0}, threads=1)
    u = np.zeros((len(q), len(system.model.inputs)))
    contenders: dict[str, Timed] = {"one": one_call(kernel, q, v, u), "batch": kernel.prepared(q, v, u)}
    agreement: dict[str, str] = {}
    mine = kernel(q, v, u)
    if linkage is not None and "Pinocchio" in found():
        pinocchio = linkage.pinocchio()
        theirs = np.array([pinocchio(*at).copy() for at in zip(q, v, strict=True)])
        agreement["Pinocchio"] = f"{(np.abs(mine - theirs).max(axis=1) / np.abs(theirs).max(axis=1)).max():.0e}"
        contenders["Pinocchio"] = lambda: [pinocchio(q[k], v[k]) for k in range(len(q))]
    if linkage is not None and "MuJoCo" in found():
        theirs, contenders["MuJoCo"] = linkage.mujoco(q, v)
        agreement["MuJoCo"] = f"{(np.abs(mine - theirs).max(axis=1) / np.abs(theirs).max(axis=1)).max():.0e}"
    each = {key: t / len(q) for key, t in best(contenders, rounds, seconds).items()}
    cells = [
        name,
        str(count_operations(program.graph, program.ids, hoist=["p"]).operations),
        f"{each['one'] * 1e9:.4g}",
        f"{each['batch'] * 1e9:.3g}",
    ]
    for peer in ("Pinocchio", "MuJoCo"):
        t = each.get(peer)
        cells.append(f"{t * 1e9:.4g} ({t / each['one']:.0f}, {t / each['batch']:.0f}; {agreement[peer]})" if t else "")
    return cells


def report(quick: bool) -> list[str]:
    rounds, seconds = (2, 0.05) if quick else (6, 0.15)
    lines = ["## Constraints", "", f"`python bench/constraints.py`. {this_machine('llvmlite', 'pin', 'mujoco')}.", ""]
    lines += ["Times in ns a state; in brackets how many times ours, one call and batch, and the greatest relative"]
    lines += ["difference. Pinocchio: `constraintDynamics`, a call from Python; MuJoCo: `mj_forward`, soft.", ""]
    rows = [measured(name, rounds, seconds) for name in (*LINKAGES, *EXAMPLES)]
    lines += table(["accelerations", "operations", "one call", "batch", "Pinocchio", "MuJoCo"], rows)
    return [*lines, "", call_alone(rounds, seconds), "", beside_hand(rounds, seconds)]


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer rounds")
    given = parser.parse_args()
    one_core()
    lines = report(given.quick)
    print("\n".join(lines), flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
