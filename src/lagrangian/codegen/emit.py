"""Tape → LLVM functions over blocks of numbers.

A tape becomes ``void name(ptr in, ptr shared, ptr out, ptr scratch)``. Slot k of a block holds ``lanes`` doubles, one
per system, aligned to their size; a shared block holds one double a slot unless every lane has its own. ``in``,
``shared`` and ``scratch`` do not overlap ``out``. Integrators can call these functions from the same module.

A long tape is cut into functions that hand values on through ``scratch``: LLVM's time grows faster than the length of a
function.
"""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.records import dataclass, field

from .elementary import function as elementary_function
from .elementary import sincos
from .ir import Function, Module, Value
from .tape import FLAGS, LEAVES, Op, Tape, operands

WHOLE = 2000  # a tape with at most this many operations is one function: no values have to be passed on
CHUNK = 1000  # operations in each of several functions …
MAX_SHARED_LENGTH = 10_000  # … up to this length; beyond it,
MIN_SHARED_LENGTH = 300  # this gives a few per cent of speed for a third of LLVM's time

PORTABLE_CHUNK, MAX_PORTABLE_LENGTH = 150, 1200
"""Operations in each of several functions of WebAssembly, for tapes up to a length.

Its compilers keep the values of short functions in registers: a 7-joint arm takes a quarter less time than in one
function. Longer tapes hand on too many values from function to function.
"""

COMPANY = 64  # angles whose sines and cosines are computed consecutively in vector code

ARITHMETIC = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv"}
COMPARISON = {"lt": "olt", "le": "ole", "eq": "oeq"}
CALLS = frozenset(
    {"exp", "log", "atan2", "atan", "asin", "acos", "pow", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh"}
)


@dataclass
class Chunk:
    """A part of a tape that becomes one function: the computed entries, and the scratch slots written (entry →
    slot)."""

    members: list[int]
    written: dict[int, int] = field(default_factory=dict)


@dataclass
class Plan:
    """How a tape is split: its chunks, the slots of entries that several chunks use, and the number of slots."""

    chunks: list[Chunk]
    slots: dict[int, int]
    scratch: int


def plan(tape: Tape, chunk: int | None = None, *, portable: bool = False) -> Plan:
    """Split a tape into chunks of equal length; a scratch slot is reused after the chunk of its last reader.

    ``portable``: the functions are for WebAssembly.
    """
    computed = [i for i, op in enumerate(tape.ops) if op[0] not in LEAVES]
    if chunk is None and portable and len(computed) <= MAX_PORTABLE_LENGTH:
        chunk = PORTABLE_CHUNK
    if chunk is None:
        chunk = WHOLE if len(computed) <= WHOLE else CHUNK if len(computed) <= MAX_SHARED_LENGTH else MIN_SHARED_LENGTH
    count = max(1, -(-len(computed) // chunk))
    size = -(-len(computed) // count) if computed else 1
    chunks = [Chunk(computed[k * size : (k + 1) * size]) for k in range(count)]
    home = {i: k for k, c in enumerate(chunks) for i in c.members}
    last: dict[int, int] = {}
    for k, c in enumerate(chunks):
        for i in c.members:
            for j in operands(tape.ops[i]):
                if j in home and home[j] != k:
                    last[j] = k
    ends: list[list[int]] = [[] for _ in chunks]
    slots: dict[int, int] = {}
    free: list[int] = []
    top = 0
    for k, c in enumerate(chunks):
        for i in c.members:
            if i in last:
                if free:
                    slot = free.pop()
                else:
                    slot, top = top, top + 1
                slots[i] = c.written[i] = slot
                ends[last[i]].append(slot)
        free.extend(ends[k])
    return Plan(chunks, slots, top)


def emit(
    module: Module, name: str, tape: Tape, lanes: int, *, own_shared: bool = False, chunk: int | None = None
) -> int:
    """Print a tape as the function ``name``; return the number of scratch slots that it needs.

    ``own_shared``: the shared block has ``lanes`` doubles per slot, as in a sweep with a parameter set for each lane.
    """
    cut = plan(tape, chunk, portable=module.target.imports)
    stores: dict[int, list[int]] = {}
    for slot, i in enumerate(tape.outputs):
        stores.setdefault(i, []).append(slot)
    arguments = "ptr noalias %in, ptr noalias %shared, ptr noalias %out, ptr noalias %scratch"
    if len(cut.chunks) == 1:
        printer = _Printer(module, lanes, tape, cut, own_shared)
        printer.chunk(cut.chunks[0], stores, last=True)
        printer.f.do("ret void")
        printer.f.finish(name, "void", arguments, attributes(lanes))
        return cut.scratch
    whole = Function(module, lanes)
    for k, c in enumerate(cut.chunks):
        printer = _Printer(module, lanes, tape, cut, own_shared)
        printer.chunk(c, stores, last=k == len(cut.chunks) - 1)
        printer.f.do("ret void")
        printer.f.finish(f"{name}_{k}", "internal void", arguments, attributes(lanes) + " noinline")
        whole.do(f"call void @{name}_{k}(ptr %in, ptr %shared, ptr %out, ptr %scratch)")
    whole.do("ret void")
    whole.finish(name, "void", arguments, attributes(lanes))
    return cut.scratch


def emit_inline(
    f: Function, tape: Tape, inputs: Mapping[int, Value], shared: str, *, own_shared: bool = False
) -> list[Value]:
    """Print a whole tape into ``f``, with its ``in`` slots in registers; return its outputs.

    ``shared`` is the address of the shared block. It is used for short tapes inside loops of other functions.
    """
    printer = _Printer(f.module, f.lanes, tape, plan(tape, max(1, len(tape.ops))), own_shared)
    printer.f, printer.shared = f, shared
    printer.names = {i: inputs[op[1]].name for i, op in enumerate(tape.ops) if op[0] == "in"}
    printer.chunk(printer.cut.chunks[0], {}, last=False)
    return [Value(f, printer.name(i)) for i in tape.outputs]


def attributes(lanes: int) -> str:
    """The LLVM attributes of a function that computes in this many lanes."""
    # Wide vectors are requested explicitly, because the tuning of some processors avoids them. There is no call of a
    # stack probe: on Windows it would be a symbol that somebody has to provide, and frames here are far smaller than
    # the guard page. The stack is aligned to a vector: otherwise every spilled register would straddle two cache lines.
    aligned = f" alignstack({8 * lanes})" if lanes > 2 else ""
    return f'nounwind "prefer-vector-width"="{lanes * 64}" "no-stack-arg-probe"{aligned}'


class _Printer:
    """Prints the entries of one chunk; leaves and values of earlier chunks are loaded when they are first used."""

    def __init__(self, module: Module, lanes: int, tape: Tape, cut: Plan, own_shared: bool) -> None:
        self.f = Function(module, lanes)
        self.tape, self.cut, self.own_shared = tape, cut, own_shared
        self.shared = "%shared"
        self.names: dict[int, str] = {}
        self.flags: dict[int, str] = {}

    def chunk(self, chunk: Chunk, stores: dict[int, list[int]], *, last: bool) -> None:
        ops = self.tape.ops
        for group in _angles_together(ops, chunk.members, COMPANY if self.f.lanes > 1 else self.f.module.target.lanes):
            if isinstance(group, list):
                self._turn(group)
                done = group
            else:
                self._compute(group, ops[group])
                done = [group]
            for i in done:
                if i in chunk.written:
                    self.f.store(Value(self.f, self.name(i)), "%scratch", chunk.written[i])
                for slot in stores.get(i, ()):
                    self.f.store(Value(self.f, self.name(i)), "%out", slot)
        if last:
            for i, slots in stores.items():
                if ops[i][0] in LEAVES:
                    for slot in slots:
                        self.f.store(Value(self.f, self.name(i)), "%out", slot)

    def name(self, i: int) -> str:
        """The operand for entry i as a number."""
        found = self.names.get(i)
        if found is None:
            found = self.names[i] = self._fetch(i)
        return found

    def flag(self, i: int) -> str:
        """The operand for entry i as a truth value."""
        if i not in self.flags:
            self.flags[i] = self.f.compare("une", Value(self.f, self.name(i)), 0.0)
        return self.flags[i]

    def _fetch(self, i: int) -> str:
        f, op = self.f, self.tape.ops[i]
        if op[0] == "const":
            return f.constant(op[1])
        if op[0] == "in":
            return f.load("%in", op[1]).name
        if op[0] == "shared":
            return f.load(self.shared, op[1], uniform=not self.own_shared).name
        if i in self.flags:
            return f.select(self.flags[i], 1.0, 0.0).name
        return f.load("%scratch", self.cut.slots[i]).name

    def _compute(self, i: int, op: Op) -> None:
        f, kind = self.f, op[0]
        if kind in ARITHMETIC:
            self.names[i] = f.put(f"{ARITHMETIC[kind]} {f.real} {self.name(op[1])}, {self.name(op[2])}")
        elif kind in FLAGS:
            self.flags[i] = self._truth(op)
        else:
            values = [Value(f, self.name(k)) for k in op[1:]] if kind != "select" else []
            self.names[i] = self._other(op, values).name

    def _truth(self, op: Op) -> str:
        f, kind = self.f, op[0]
        if kind in COMPARISON:
            return f.compare(COMPARISON[kind], Value(f, self.name(op[1])), Value(f, self.name(op[2])))
        if kind == "not":
            return f.opposite(self.flag(op[1]))
        return f.logic(kind, self.flag(op[1]), self.flag(op[2]))

    def _other(self, op: Op, v: list[Value]) -> Value:
        f, kind = self.f, op[0]
        match kind:
            case "fma":
                return f.fma(*v)
            case "fms":
                return f.fma(v[0], v[1], -v[2]) if f.module.target.fma else v[0] * v[1] - v[2]
            case "fnma":
                return f.fma(-v[0], v[1], v[2]) if f.module.target.fma else v[2] - v[0] * v[1]
            case "neg":
                return -v[0]
            case "sqrt":
                return f.intrinsic("sqrt", v[0])
            case "abs":
                return f.intrinsic("fabs", v[0])
            case "min" | "max":  # NaN in either gives NaN, as in the interpreter
                first = f.compare("ole" if kind == "min" else "oge", v[0], v[1])
                return f.select(f.logic("or", first, f.compare("uno", v[0], v[0])), v[0], v[1])
            case "sign":
                unit = f.intrinsic("copysign", 1.0, v[0])
                return f.select(f.compare("one", v[0], 0.0), unit, v[0])
            case "select":
                return f.select(self.flag(op[1]), Value(f, self.name(op[2])), Value(f, self.name(op[3])))
        if kind not in CALLS:
            raise KeyError(f"operation {kind!r} has no machine code")
        symbol = elementary_function(f.module, kind, f.lanes)
        passed = ", ".join(f"{f.real} {a.name}" for a in v)
        return Value(f, f.put(f"call {f.real} {symbol}({passed})"))

    def _turn(self, group: list[int]) -> None:
        """Print the sines and cosines whose angles are known at this point.

        Single numbers are packed into vectors, so that one call computes several.
        """
        f, ops = self.f, self.tape.ops
        angles = list(dict.fromkeys(ops[i][1] for i in group))
        found: dict[int, tuple[str, str]] = {}
        if f.lanes > 1:
            for a in angles:
                found[a] = self._pair(f, self.name(a))
        else:
            widest = f.module.target.lanes
            while angles:
                width = min(widest, 1 << (len(angles) - 1).bit_length())
                found |= self._packed(angles[:width], width)
                angles = angles[width:]
        for i in group:
            self.names[i] = found[ops[i][1]][0 if ops[i][0] == "sin" else 1]

    def _pair(self, f: Function, angle: str) -> tuple[str, str]:
        pair = f"{{ {f.real}, {f.real} }}"
        both = f.put(f"call {pair} {sincos(f.module, f.lanes)}({f.real} {angle})")
        return f.put(f"extractvalue {pair} {both}, 0"), f.put(f"extractvalue {pair} {both}, 1")

    def _packed(self, angles: list[int], width: int) -> dict[int, tuple[str, str]]:
        """One vector call for up to ``width`` scalar angles; unused lanes repeat the first angle."""
        if width == 1:
            return {angles[0]: self._pair(self.f, self.name(angles[0]))}
        wide = self.f.widened(width)
        names = [self.name(a) for a in angles]
        packed = wide.gathered(names + names[:1] * (width - len(names)))
        s, c = self._pair(wide, packed.name)
        return {a: (wide.lane(Value(wide, s), k), wide.lane(Value(wide, c), k)) for k, a in enumerate(angles)}


def _angles_together(ops: list[Op], members: list[int], company: int) -> list[int | list[int]]:
    """The order in which a chunk is printed: that of the tape, but with sines and cosines in groups of up to
    ``company`` angles.

    A group is at the place of its first member, and everything that its other angles need is computed before it. Its
    angles must not depend on sines or cosines that are not yet computed. In this way scalar angles can share a vector
    call, and there are fewer calls, each of which saves the live registers.
    """
    turning = [i for i in members if ops[i][0] in ("sin", "cos")]
    here, done = set(members), set()
    order: list[int | list[int]] = []

    def missing(i: int) -> set[int] | None:
        """What entry i still needs; None if this includes a sine or cosine."""
        found: set[int] = set()
        stack = [ops[i][1]]
        while stack:
            k = stack.pop()
            if k in here and k not in done and k not in found:
                if ops[k][0] in ("sin", "cos"):
                    return None
                found.add(k)
                stack.extend(operands(ops[k]))
        return found

    start = 0
    for i in members:
        if i in done:
            continue
        if ops[i][0] not in ("sin", "cos"):
            order.append(i)
            done.add(i)
            continue
        while turning[start] in done:
            start += 1
        group, angles, needed = [], set(), set()
        for k in turning[start : start + 8 * company]:
            if k in done or (ops[k][1] not in angles and len(angles) == company):
                continue
            wanted = missing(k)
            if wanted is not None:
                group.append(k)
                angles.add(ops[k][1])
                needed |= wanted
        order.extend(sorted(needed))
        order.append(group)
        done |= needed
        done.update(group)
    return order
