"""Functions around those of a tape: for one state from Python, and for ranges of states in strided arrays.

``i64 single(ptr table)``: the table holds the addresses of the in, shared, out and scratch blocks. Returns 0, or 1 if
an input or an output is not finite. ``i64 parameters(ptr table)``: three more addresses: of the hoisted inputs, of the
shared block that is computed from them, and of a function ``i64 look(ptr rows, i64 count)``, or 0 for none. Returns 0,
1 if a hoisted input is not finite or too large, 2 if the function returns this because they need a closer look, 3 for
both. ``i64 both(ptr table)``: parameters, then single; the result contains the bits that either returns.

``i64 batch(ptr table, i64 start, i64 stop, ptr work)``: states start … stop − 1, ``lanes`` at a time. The table holds,
for each input group, each hoisted group (if every state has its own) and each output, an address and two strides in
bytes, from state to state and from entry to entry; then the address of the shared block. Returns the first state of the
first block with a number that is not finite, or −1. The last block is filled by repeating the last state, so that every
state is computed by the same code, wherever a range begins and ends.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence

from lagrangian.quantities.largest import LARGEST

from .emit import attributes
from .ir import Function, Module, Value
from .packed_loop import PackedLoop, emit_packed
from .sizes import Array, Sizes
from .transpose import emit_move

MAGNITUDE = 0x7FFFFFFFFFFFFFFF
INFINITE = 0x7FF0000000000000
BOUND = int.from_bytes(struct.pack(">d", LARGEST))
"""The bits of the largest size of a hoisted input; like those of magnitudes, they are ordered as the numbers are."""

NOT_FINITE, DOUBTFUL = 1, 2


def emit_single(module: Module, sizes: Sizes) -> None:
    """Print ``single`` around the scalar body, `emit_parameters`, and ``both``."""
    lines = _entries({0: "in", 1: "shared", 2: "out", 3: "scratch"})
    lines.append("  call void @body_1(ptr %in, ptr %shared, ptr %out, ptr %scratch)")
    for name, count in (("in", sum(sizes.groups)), ("out", sum(sizes.outputs))):
        lines.append(f"  %{name}_top = call i64 @greatest(ptr %{name}, i64 {count})")
    lines += [
        "  %top = call i64 @llvm.umax.i64(i64 %in_top, i64 %out_top)",
        f"  %bad = icmp uge i64 %top, {INFINITE}",
        "  %answer = zext i1 %bad to i64",
        "  ret i64 %answer",
    ]
    module.define("single", "\n".join(["define i64 @single(ptr %table) nounwind {", "entry:", *lines, "}"]))
    emit_parameters(module, sizes)
    module.define("both", _BOTH)


def emit_parameters(module: Module, sizes: Sizes) -> None:
    """Print ``parameters`` around the scalar prologue."""
    _declare_greatest(module)
    lines = [
        *_entries({3: "scratch", 4: "hoisted", 5: "own", 6: "look"}),
        "  call void @prologue_1(ptr %hoisted, ptr null, ptr %own, ptr %scratch)",
        f"  %top = call i64 @greatest(ptr %hoisted, i64 {sum(sizes.hoisted)})",
        f"  %bad = icmp ugt i64 %top, {BOUND}",
        "  %wrong = zext i1 %bad to i64",
        "  %some = icmp ne ptr %look, null",
        "  br i1 %some, label %looking, label %end",
        "looking:",
        "  %doubt = call i64 %look(ptr %hoisted, i64 1)",
        "  br label %end",
        "end:",
        "  %found = phi i64 [0, %entry], [%doubt, %looking]",
        "  %answer = or i64 %wrong, %found",
        "  ret i64 %answer",
    ]
    module.define("parameters", "\n".join(["define i64 @parameters(ptr %table) nounwind {", "entry:", *lines, "}"]))


def emit_signs(module: Module, sizes: Sizes, above: int) -> None:
    """Print ``i64 signs(ptr rows, i64 count)`` around the scalar body.

    It returns 0 if no entry of the rows, of which there is at least one, is too large or not finite, and if, for each
    row, the first ``above`` outputs are positive, the others are not negative, and all are finite; otherwise it returns
    `DOUBTFUL`.
    """
    _declare_greatest(module)
    module.declare("llvm.vector.reduce.or.v8i64", "i64", ["<8 x i64>"])
    module.declare("llvm.smin.i64", "i64", ["i64", "i64"])
    module.define("moderate", _MODERATE)
    count, width = sum(sizes.outputs), sum(sizes.groups)
    lines = [
        "define i64 @signs(ptr %rows, i64 %count) nounwind {",
        "entry:",
        f"  %out = alloca double, i64 {count}, align 64",
        f"  %scratch = alloca double, i64 {max(1, sizes.scratch)}, align 64",
        "  br label %loop",
        "loop:",
        "  %row = phi i64 [0, %entry], [%next, %loop]",
        f"  %start = mul i64 %row, {width}",
        "  %in = getelementptr double, ptr %rows, i64 %start",
        "  call void @body_1(ptr %in, ptr null, ptr %out, ptr %scratch)",
    ]
    known = "true"
    for k in range(count):
        lines += [
            f"  %a{k} = getelementptr double, ptr %out, i64 {k}",
            f"  %x{k} = load double, ptr %a{k}",
            f"  %low{k} = fcmp {'ogt' if k < above else 'oge'} double %x{k}, 0.0",
            f"  %high{k} = fcmp olt double %x{k}, 0x{INFINITE:X}",
            f"  %both{k} = and i1 %low{k}, %high{k}",
            f"  %fine{k} = and i1 %both{k}, {known}",
        ]
        known = f"%fine{k}"
    lines += [
        "  %next = add i64 %row, 1",
        "  %more = icmp slt i64 %next, %count",
        f"  %on = and i1 %more, {known}",
        "  br i1 %on, label %loop, label %end",
        "end:",
        f"  %entries = mul i64 %count, {width}",
        "  %small = call i1 @moderate(ptr %rows, i64 %entries)",
        f"  %good = and i1 %small, {known}",
        f"  %answer = select i1 %good, i64 0, i64 {DOUBTFUL}",
        "  ret i64 %answer",
        "}",
    ]
    module.define("signs", "\n".join(lines))


def _declare_greatest(module: Module) -> None:
    module.declare("llvm.umax.i64", "i64", ["i64", "i64"])
    module.define("greatest", _GREATEST)


def _entries(names: Mapping[int, str]) -> list[str]:
    """Load addresses from the table of ``single``."""
    lines = []
    for k, name in names.items():
        lines += [f"  %a{k} = getelementptr ptr, ptr %table, i64 {k}", f"  %{name} = load ptr, ptr %a{k}"]
    return lines


_BOTH = """define i64 @both(ptr %table) nounwind {
entry:
  %early = call i64 @parameters(ptr %table)
  %late = call i64 @single(ptr %table)
  %answer = or i64 %early, %late
  ret i64 %answer
}"""

# The largest magnitude among n numbers, compared as bits: NaN and infinity are larger than everything finite.
_GREATEST = f"""define internal i64 @greatest(ptr %x, i64 %n) noinline nounwind {{
entry:
  %some = icmp sgt i64 %n, 0
  br i1 %some, label %loop, label %end
loop:
  %k = phi i64 [0, %entry], [%next, %loop]
  %top = phi i64 [0, %entry], [%higher, %loop]
  %at = getelementptr i64, ptr %x, i64 %k
  %bits = load i64, ptr %at
  %size = and i64 %bits, {MAGNITUDE}
  %higher = call i64 @llvm.umax.i64(i64 %top, i64 %size)
  %next = add i64 %k, 1
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %end
end:
  %answer = phi i64 [0, %entry], [%higher, %loop]
  ret i64 %answer
}}"""

_EIGHT_BOUNDS = ", ".join([f"i64 {BOUND}"] * 8)
_EIGHT_MAGNITUDES = ", ".join([f"i64 {MAGNITUDE}"] * 8)

# Whether no magnitude among n numbers is above the bound, eight at a time, the last eight again: where one is, the
# bound minus its bits is negative.
_MODERATE = f"""define internal i1 @moderate(ptr %x, i64 %n) noinline nounwind {{
entry:
  %last = sub i64 %n, 8
  %many = icmp sge i64 %last, 0
  br i1 %many, label %loop, label %few
loop:
  %k = phi i64 [0, %entry], [%next, %loop]
  %known = phi <8 x i64> [zeroinitializer, %entry], [%all, %loop]
  %start = call i64 @llvm.smin.i64(i64 %k, i64 %last)
  %at = getelementptr i64, ptr %x, i64 %start
  %bits = load <8 x i64>, ptr %at, align 8
  %size = and <8 x i64> %bits, <{_EIGHT_MAGNITUDES}>
  %room = sub <8 x i64> <{_EIGHT_BOUNDS}>, %size
  %all = or <8 x i64> %known, %room
  %next = add i64 %k, 8
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %end
end:
  %any = call i64 @llvm.vector.reduce.or.v8i64(<8 x i64> %all)
  %inside = icmp sge i64 %any, 0
  ret i1 %inside
few:
  %top = call i64 @greatest(ptr %x, i64 %n)
  %small = icmp ule i64 %top, {BOUND}
  ret i1 %small
}}"""


def emit_batch(
    module: Module,
    sizes: Sizes,
    lanes: int,
    *,
    own_shared: bool,
    body: str,
    prologue: str,
    short: PackedLoop | None = None,
) -> None:
    """Print ``batch`` around the ``body`` of ``lanes`` systems, and around ``prologue`` if every state has its own.

    With ``short``, a loop for packed arrays comes first and processes as many states as it can (see `packed_loop`).
    """
    f = Function(module, lanes)
    at = _blocks(f, sizes, own_shared)
    hoisted = sizes.hoisted if own_shared else ()
    inputs = len(sizes.groups) + len(hoisted)
    arrays = [_array(f, k) for k in range(inputs + len(sizes.outputs))]
    shared = at["own"] if own_shared else _entry(f, "ptr", 3 * len(arrays))
    module.declare("llvm.smin.i64", "i64", ["i64", "i64"])
    last = f.put(f"sub i64 %stop, {lanes}")
    before = [
        ("entry", "%start", "-1")
    ]  # where the loop is entered from, at which state, and the first state known not to be finite
    if short is None:
        f.do("br label %loop")
    else:
        before.append(emit_packed(f, short, sizes, arrays, at, shared))
    f.label("loop")
    start_of_loop = len(f.lines)  # its phis use values and a block that are printed below
    f.do(f"%state = call i64 @llvm.smin.i64(i64 %next, i64 {last})")
    f.do("%begin = icmp eq i64 %next, %from")
    moves = _Moves(f)
    moves.gather(arrays, sizes.groups, at["in"])
    if own_shared:
        moves.gather(arrays[len(sizes.groups) :], hoisted, at["early"])
        f.do(f"call void @{prologue}(ptr {at['early']}, ptr null, ptr {at['own']}, ptr {at['scratch']})")
    f.do(f"call void @{body}(ptr {at['in']}, ptr {shared}, ptr {at['out']}, ptr {at['scratch']})")
    moves.scatter(arrays[inputs:], sizes.outputs, at["out"])
    fine = f.all_lanes(f.compare("oeq", moves.trouble, 0.0))
    clean = f.put("icmp eq i64 %first, -1")
    found = f.put(f"select i1 {clean}, i64 %state, i64 %first")
    first = f.put(f"select i1 {fine}, i64 %first, i64 {found}")
    for name, entered, turned in (("first", 2, first), ("next", 1, "%after"), ("from", 1, "%from")):
        sources = [*((b[entered], b[0]) for b in before), (turned, moves.label)]
        f.lines.insert(start_of_loop, f"  %{name} = phi i64 " + ", ".join(f"[{x}, %{at}]" for x, at in sources))
    f.do(f"%after = add i64 %next, {lanes}")
    f.do("%more = icmp slt i64 %after, %stop")
    f.do("br i1 %more, label %loop, label %end")
    f.label("end")
    ends = [(first, moves.label), *((known, label) for label, _, known in before[1:])]
    f.do("%answer = phi i64 " + ", ".join(f"[{x}, %{at}]" for x, at in ends))
    f.do("ret i64 %answer")
    arguments = "ptr %table, i64 %start, i64 %stop, ptr %work"
    f.finish("batch", "i64", arguments, attributes(lanes))


def _blocks(f: Function, sizes: Sizes, own_shared: bool) -> dict[str, str]:
    """The addresses of the blocks in the work space, one after another."""
    counts = {"in": sum(sizes.groups), "out": sum(sizes.outputs), "scratch": sizes.scratch}
    if own_shared:
        counts |= {"early": sum(sizes.hoisted), "own": sizes.shared}
    offset, found = 0, {}
    for name, count in counts.items():
        found[name] = f.put(f"getelementptr {f.real}, ptr %work, i64 {offset}")
        offset += count
    return found


class _Moves:
    """The copies in one iteration of the loop; ``trouble`` is their sum of 0·x, ``label`` the current basic block."""

    def __init__(self, f: Function) -> None:
        self.f, self.label = f, "loop"
        self.trouble = Value(f, f.constant(0.0))

    def gather(self, arrays: Sequence[Array], counts: Sequence[int], block: str) -> None:
        """Copy arrays to a block; an array that is the same for all states is copied only in the first iteration of a
        range."""
        f = self.f
        for call, row in self._calls(arrays, counts, block, gather=True):
            wanted = f.put(f"or i1 %begin, {f.put(f'icmp ne i64 {row}, 0')}")
            move = f"move{len(f.lines)}"
            f.do(f"br i1 {wanted}, label %{move}, label %{move}done")
            f.label(move)
            moved = f.put(call)
            f.do(f"br label %{move}done")
            f.label(f"{move}done")
            answer = f.put(f"phi {f.real} [{f.constant(0.0)}, %{self.label}], [{moved}, %{move}]")
            self.label = f"{move}done"
            self.trouble = self.trouble + Value(f, answer)

    def scatter(self, arrays: Sequence[Array], counts: Sequence[int], block: str) -> None:
        """Copy a block to arrays."""
        for call, _ in self._calls(arrays, counts, block, gather=False):
            self.trouble = self.trouble + Value(self.f, self.f.put(call))

    def _calls(
        self, arrays: Sequence[Array], counts: Sequence[int], block: str, *, gather: bool
    ) -> Iterator[tuple[str, str]]:
        """For each array, the text of the call that copies it, and its stride from state to state."""
        f, slot = self.f, 0
        for (base, row, step), count in zip(arrays, counts, strict=False):
            if count:
                at = f.put(f"getelementptr {f.real}, ptr {block}, i64 {slot}")
                here = f.put(f"getelementptr i8, ptr {base}, i64 {f.put(f'mul i64 %state, {row}')}")
                symbol = emit_move(f.module, f.lanes, count, gather=gather)
                yield f"call {f.real} {symbol}(ptr {here}, i64 {row}, i64 {step}, ptr {at})", row
            slot += count


def _entry(f: Function, kind: str, index: int) -> str:
    """Load entry ``index`` of the table."""
    return f.put(f"load {kind}, ptr {f.put(f'getelementptr i64, ptr %table, i64 {index}')}")


def _array(f: Function, k: int) -> Array:
    """Load address and strides of the k-th array of the table."""
    return _entry(f, "ptr", 3 * k), _entry(f, "i64", 3 * k + 1), _entry(f, "i64", 3 * k + 2)
