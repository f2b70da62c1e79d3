"""Other engines beside ours in `engine.py`: Pinocchio, MuJoCo, CasADi. Each from its wheel; what is missing is said.

Every peer has ``accelerations(q, v, u)`` for its agreement with ours and ``timed(q, v, u)``, a callable that evaluates
once for each of those states without Python in between, and how that is done in ``how``.
"""

from __future__ import annotations

import ctypes
import importlib
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm
import numpy as np

from engine_systems import GRAVITY, Array, Body, Pins, Tree, Z

Timed = Callable[[], object]
TINY = 1e-12
"""[kg m²] MuJoCo wants an inertia of point masses too."""

# Calls f(a + i·da, b, c + i·dc, d) for i = 0 … n − 1: a loop as C would have it, without a C compiler.
_LOOP = """
define void @many(ptr %f, i64 %n, ptr %a, i64 %da, ptr %b, ptr %c, i64 %dc, ptr %d) {
entry:
  %some = icmp sgt i64 %n, 0
  br i1 %some, label %loop, label %end
loop:
  %i = phi i64 [0, %entry], [%next, %loop]
  %ai = mul i64 %i, %da
  %ci = mul i64 %i, %dc
  %pa = getelementptr i8, ptr %a, i64 %ai
  %pc = getelementptr i8, ptr %c, i64 %ci
  call void %f(ptr %pa, ptr %b, ptr %pc, ptr %d)
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %end
end:
  ret void
}
"""


class Loop:
    """The loop above as a Python callable."""

    def __init__(self) -> None:
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        target = llvm.Target.from_default_triple().create_target_machine(opt=2, jit=True)
        self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(_LOOP), target)
        self._engine.finalize_object()
        p, i = ctypes.c_void_p, ctypes.c_int64
        self.call = ctypes.CFUNCTYPE(None, p, i, p, i, p, p, i, p)(self._engine.get_function_address("many"))


def address(array: Array) -> int:
    """Where an array starts."""
    return array.__array_interface__["data"][0]


class Pinocchio:
    """`aba` of the wheel's library."""

    how = "abaInParallel of the wheel on one thread"

    def __init__(self, tree: Tree) -> None:
        self.pin = pin = importlib.import_module("pinocchio")
        self.model = pin.Model()
        root = 0
        if tree.floats:
            root = self.model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "floating")
            self._append(root, tree.floats)
        self.model.gravity.linear = np.array([0, 0, -GRAVITY])
        ids: list[int] = []
        joints = (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ)
        for i, link in enumerate(tree.links):
            placed = pin.SE3(quarter_turn(link.quarter), np.array(link.offset))
            parent = ids[link.parent] if link.parent >= 0 else root
            ids.append(self.model.addJoint(parent, joints[link.axis](), placed, f"joint {i}"))
            self._append(ids[-1], link.body)
        self.data = self.model.createData()

    def _append(self, joint: int, body: Body) -> None:
        inertia = self.pin.Inertia(body.mass, np.array(body.centre), np.array(body.inertia))
        self.model.appendBodyToJoint(joint, inertia, self.pin.SE3.Identity())

    def accelerations(self, q: Array, v: Array, u: Array) -> Array:
        return np.array([self.pin.aba(self.model, self.data, *state).copy() for state in zip(q, v, u, strict=True)])

    def timed(self, q: Array, v: Array, u: Array) -> Timed:
        columns = [np.asfortranarray(x.T) for x in (q, v, u, np.empty_like(v))]
        pool = self.pin.ModelPool(self.model, 1)
        return lambda: self.pin.abaInParallel(1, pool, *columns)


class MuJoCo:
    """`mj_forward` of the wheel's library, contacts, constraints and sensors switched off."""

    how = "mj_forward through its function pointer, one state over and over"

    def __init__(self, tree: Tree, pins: Pins | None = None) -> None:
        self.mujoco = mujoco = importlib.import_module("mujoco")
        mujoco.set_mjcb_time(None)  # the Python module's clock costs half a microsecond a call
        self.tree = tree
        self.model = mujoco.MjModel.from_xml_string(mjcf(tree, pins or {}))
        self.data = mujoco.MjData(self.model)
        self.loop = Loop()

    def _put(self, q: Array, v: Array, u: Array) -> Array:
        """Hand a state over, quaternion w first and linear motion in fixed axes; return R of the body that floats."""
        data, turn = self.data, np.eye(3)
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = q, v, u
        if self.tree.floats:
            turn = rotation(q[3:7])
            data.qpos[3:7] = q[[6, 3, 4, 5]]
            data.qvel[:3], data.qfrc_applied[:3] = turn @ v[:3], turn @ u[:3]
        return turn

    def accelerations(self, q: Array, v: Array, u: Array) -> Array:
        found = np.empty_like(v)
        for k in range(len(q)):
            turn = self._put(q[k], v[k], u[k])
            self.mujoco.mj_forward(self.model, self.data)
            found[k] = self.data.qacc
            if self.tree.floats:  # d/dt of the components in body axes
                found[k, :3] = turn.T @ found[k, :3] - np.cross(v[k, 3:6], v[k, :3])
        return found

    def timed(self, q: Array, v: Array, u: Array) -> Timed:
        folder = Path(self.mujoco.__path__[0])
        library = next(p for p in sorted(folder.iterdir()) if p.name.startswith(("libmujoco.", "mujoco.dll")))
        forward = ctypes.cast(ctypes.CDLL(str(library)).mj_forward, ctypes.c_void_p).value
        self._put(q[0], v[0], u[0])
        # mj_forward takes two pointers; the loop hands over four, of which C's calling conventions ignore the rest.
        given = (forward, len(q), self.model._address, 0, self.data._address, None, 0, None)
        return lambda: self.loop.call(*given)


class CasADi:
    """Lagrange's equations by CasADi's differentiation, M factored, as C where there is a compiler. Not for trees that
    float.
    """

    how = "L differentiated, LDLᵀ; its C, one state after the other"

    def __init__(self, tree: Tree) -> None:
        if tree.floats:
            raise ValueError("the generalized coordinates of a floating body would be others")
        self.tree, self.casadi = tree, importlib.import_module("casadi")
        self.function = self._derived()

    @property
    def operations(self) -> int:
        """Instructions of its function, loads and stores apart."""
        f, moves = self.function, (self.casadi.OP_INPUT, self.casadi.OP_OUTPUT, self.casadi.OP_CONST)
        return sum(f.instruction_id(k) not in moves for k in range(f.n_instructions()))

    def _derived(self) -> Any:
        """q, v, u → v̇ from L = Σ ½ m ṗ² + ½ ωᵀ I ω − m g z:  M v̇ = u + ∂L/∂q − ∂(∂L/∂v)/∂q v."""
        ca = self.casadi
        n = self.tree.nv
        q, v, u = (ca.SX.sym(name, n) for name in "qvu")
        L = self._lagrangian(q, v)
        momentum = ca.gradient(L, v)
        force = u + ca.gradient(L, q) - ca.jtimes(momentum, q, v)
        return ca.Function("fd", [q, v, u], [ca.ldl_solve(force, *ca.ldl(ca.jacobian(momentum, v)))], {"cse": True})

    def _lagrangian(self, q: Any, v: Any) -> Any:
        ca = self.casadi
        total, made = ca.SX(0), []
        for i, link in enumerate(self.tree.links):
            turn, place, omega, speed = made[link.parent] if link.parent >= 0 else (ca.SX.eye(3), *[ca.SX(3, 1)] * 3)
            step = np.array(link.offset)  # velocities stand in the link's own axes
            place = place + turn @ step
            speed = speed + ca.cross(omega, step)
            own = ca.SX(quarter_turn(link.quarter)) @ self._turn(link.axis, q[i])
            turn, omega, speed = turn @ own, own.T @ omega, own.T @ speed
            omega[link.axis] += v[i]
            made.append((turn, place, omega, speed))
            body, centre = link.body, np.array(link.body.centre)
            moving = speed + ca.cross(omega, centre)
            total += body.mass / 2 * ca.dot(moving, moving) + ca.dot(omega, ca.DM(body.inertia) @ omega) / 2
            total -= body.mass * GRAVITY * (place + turn @ centre)[Z]
        return total

    def _turn(self, axis: int, angle: Any) -> Any:
        ca = self.casadi
        turn, i, j = ca.SX.eye(3), (axis + 1) % 3, (axis + 2) % 3
        turn[i, i] = turn[j, j] = ca.cos(angle)
        turn[j, i] = ca.sin(angle)
        turn[i, j] = -turn[j, i]
        return turn

    def accelerations(self, q: Array, v: Array, u: Array) -> Array:
        return np.array(self.function.map(len(q))(q.T, v.T, u.T)).T

    def timed(self, q: Array, v: Array, u: Array) -> Timed | None:
        """None where there is no C compiler."""
        compiler = shutil.which("clang") or shutil.which("cc")
        if compiler is None:
            return None
        with tempfile.TemporaryDirectory() as folder:
            library = ctypes.CDLL(str(self._compiled(compiler, Path(folder))))
        width = sum(self.function.numel_out(k) for k in range(self.function.n_out()))
        arrays = (q, v, u, np.empty((len(q), width)))  # kept by the callable
        return lambda: library.many(ctypes.c_int64(len(q)), *[ctypes.c_void_p(address(x)) for x in arrays])

    def _compiled(self, compiler: str, folder: Path) -> Path:
        generator = self.casadi.CodeGenerator("fd.c")
        generator.add(self.function)
        f, n = self.function, self.tree.nv
        sizes = [f.numel_out(k) for k in range(f.n_out())]
        results = " ".join(f"res[{k}] = a + {sum(sizes[:k])};" for k in range(f.n_out()))
        source = generator.dump() + (
            "\nvoid many(long long count, const double *q, const double *v, const double *u, double *a) {\n"
            f"  casadi_int iw[{f.sz_iw() + 1}]; double w[{f.sz_w() + 1}];\n"
            f"  const double *arg[{f.sz_arg() + 3}]; double *res[{f.sz_res() + f.n_out()}];\n"
            f"  for (; count > 0; count--, q += {n}, v += {n}, u += {n}, a += {sum(sizes)}) {{\n"
            f"    arg[0] = q; arg[1] = v; arg[2] = u; {results}\n"
            "    fd(arg, res, iw, w, 0);\n  }\n}\n"
        )
        (folder / "fd.c").write_text(source, encoding="utf-8")
        command = [
            compiler,
            "-O3",
            "-march=native",
            "-fno-math-errno",
            "-shared",
            "-fPIC",
            "fd.c",
            "-o",
            "fd.so",
            "-lm",
        ]
        subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=600)
        return folder / "fd.so"


class CasADiDerivatives(CasADi):
    """The same with ∂a/∂q, ∂a/∂v and M⁻¹ = ∂a/∂u."""

    def _derived(self) -> Any:
        ca = self.casadi
        plain, n = super()._derived(), self.tree.nv
        q, v, u = (ca.SX.sym(name, n) for name in "qvu")
        a = plain(q, v, u)
        made = [a, *(ca.densify(ca.jacobian(a, x)) for x in (q, v, u))]
        return ca.Function("fd", [q, v, u], made, {"cse": True})


def quarter_turn(quarter: int) -> Array:
    """R of −1, 0 or 1 quarter turns about x."""
    c, s = 1.0 - abs(quarter), float(quarter)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def rotation(e: Array) -> Array:
    """R of the unit quaternion (x, y, z, w): R = 1 + 2 w [r]× + 2 [r]×²."""
    x, y, z, w = e
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * K + 2 * K @ K


STIFF = 'solref="0.002 1" solimp="0.9999 0.9999 0.001"'
"""MuJoCo's constraints as hard as they go."""


def mjcf(tree: Tree, pins: Pins | None = None) -> str:
    """MuJoCo's description of a tree, and of the points that are pinned to the ground."""
    pins = pins or {}

    def numbers(values: Any) -> str:
        return " ".join(repr(float(x)) for x in np.ravel(values))

    def inertial(body: Body) -> str:
        I = np.array(body.inertia)
        if not I.any():
            I = TINY * np.eye(3)
        full = [I[0, 0], I[1, 1], I[2, 2], I[0, 1], I[0, 2], I[1, 2]]
        return f'<inertial pos="{numbers(body.centre)}" mass="{body.mass!r}" fullinertia="{numbers(full)}"/>'

    def children(parent: int) -> str:
        text = ""
        for i, link in enumerate(tree.links):
            if link.parent == parent:
                turn = [np.sqrt(0.5), link.quarter * np.sqrt(0.5), 0, 0] if link.quarter else [1, 0, 0, 0]
                joint = f'<joint type="hinge" axis="{numbers(np.eye(3)[link.axis])}"/>'
                place = f'pos="{numbers(link.offset)}" quat="{numbers(turn)}"'
                text += f"<body {place}>{inertial(link.body)}{joint}{site(i)}{children(i)}</body>"
        return text

    def site(i: int) -> str:
        return f'<site name="s{i}" pos="{numbers(pins[i][0])}"/>' if i in pins else ""

    world = children(-1)
    if tree.floats:
        world = f"<body>{inertial(tree.floats)}<freejoint/>{world}</body>"
    world += "".join(f'<site name="g{i}" pos="{numbers(place)}"/>' for i, (_, place) in pins.items())
    joined = "".join(f'<connect {STIFF} site1="s{i}" site2="g{i}"/>' for i in pins)
    rows = f"<equality>{joined}</equality>" if pins else ""
    unused = "" if pins else 'constraint="disable" '
    flags = f'<flag contact="disable" {unused}sensor="disable"/>'
    option = f'<option gravity="0 0 -{GRAVITY}" timestep="1e-4">{flags}</option>'
    return f"<mujoco>{option}<worldbody>{world}</worldbody>{rows}</mujoco>"


PEERS: dict[str, tuple[str, type[Pinocchio] | type[MuJoCo] | type[CasADi]]] = {
    "Pinocchio": ("pinocchio", Pinocchio),
    "MuJoCo": ("mujoco", MuJoCo),
    "CasADi": ("casadi", CasADi),
}
"""Name → the module it needs, and its class."""
