"""What stands around a tape's functions: one state from Python, and ranges of states in strided arrays.

``i64 single(ptr table)``: the table holds the addresses of the in, shared, out and scratch blocks. Returns 0, or 1 if
an input or an output is not finite.

``i64 batch(ptr table, i64 start, i64 stop, ptr work)``: states start … stop − 1, ``lanes`` at a time. The table
holds, for each input group, each hoisted group (if every state has its own) and each output, an address and two
strides in bytes, from state to state and from entry to entry; then the address of the shared block. Returns the first
state of the first block that holds something not finite, or −1. The last block is filled by repeating the last state,
so every state goes through the same code, wherever a range begins and ends.
"""

from __future__ import annotations

from dataclasses import dataclass

from .ir import Function, Module, Value
from .move import emit_move

MAGNITUDE = 0x7FFFFFFFFFFFFFFF
INFINITE = 0x7FF0000000000000


@dataclass(frozen=True)
class Sizes:
    """How many numbers the blocks hold.

    Inputs by group, hoisted inputs by group, shared slots, outputs by array, scratch.
    """

    groups: tuple[int, ...]
    hoisted: tuple[int, ...]
    shared: int
    outputs: tuple[int, ...]
    scratch: int

    def work(self, lanes: int, own_shared: bool) -> int:
        """How many doubles of work space ``batch`` wants, its blocks one after the other."""
        blocks = sum(self.groups) + sum(self.outputs) + self.scratch
        if own_shared:
            blocks += sum(self.hoisted) + self.shared
        return lanes * max(1, blocks)


def emit_single(module: Module, sizes: Sizes, body: str = "body_1") -> None:
    """Print ``single`` around the scalar body."""
    lines = []
    for k, name in enumerate(("in", "shared", "out", "scratch")):
        lines += [f"  %a{k} = getelementptr ptr, ptr %table, i64 {k}", f"  %{name} = load ptr, ptr %a{k}"]
    lines.append(f"  call void @{body}(ptr %in, ptr %shared, ptr %out, ptr %scratch)")
    for name, count in (("in", sum(sizes.groups)), ("out", sum(sizes.outputs))):
        lines.append(f"  %{name}_top = call i64 @greatest(ptr %{name}, i64 {count})")
    lines += [
        "  %top = call i64 @llvm.umax.i64(i64 %in_top, i64 %out_top)",
        f"  %bad = icmp uge i64 %top, {INFINITE}",
        "  %answer = zext i1 %bad to i64",
        "  ret i64 %answer",
    ]
    module.declare("llvm.umax.i64", "i64", ["i64", "i64"])
    module.define("greatest", _GREATEST)
    module.define("single", "\n".join(["define i64 @single(ptr %table) nounwind {", "entry:", *lines, "}"]))


# The greatest magnitude among n numbers, compared as bits: NaN and infinity are above everything finite.
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


def emit_batch(module: Module, sizes: Sizes, lanes: int, *, own_shared: bool, body: str, prologue: str) -> None:
    """Print ``batch`` around the ``lanes`` wide ``body``, and around ``prologue`` where every state has its own."""
    f = Function(module, lanes)
    blocks, offset = {}, 0
    inputs = sizes.groups + (sizes.hoisted if own_shared else ())
    for name, size in (
        ("in", sum(sizes.groups)),
        ("out", sum(sizes.outputs)),
        ("early", sum(sizes.hoisted) if own_shared else 0),
        ("own", sizes.shared if own_shared else 0),
        ("scratch", sizes.scratch),
    ):
        blocks[name] = f.put(f"getelementptr {f.real}, ptr %work, i64 {offset}")
        offset += size
    arrays = [_array(f, k) for k in range(len(inputs) + len(sizes.outputs))]
    shared = blocks["own"] if own_shared else _entry(f, "ptr", 3 * len(arrays))
    module.declare("llvm.smin.i64", "i64", ["i64", "i64"])
    last = f.put(f"sub i64 %stop, {lanes}")
    f.do("br label %loop")
    f.label("loop")
    start_of_next = len(f.lines)
    # the phis name values and a block printed below
    f.do(f"%state = call i64 @llvm.smin.i64(i64 %next, i64 {last})")
    f.do("%begin = icmp eq i64 %next, %start")
    here_label = ["loop"]  # the basic block that is being printed
    zero = Value(f, f.constant(0.0))
    trouble: Value | None = None

    def move(kind: str, array: tuple[str, str, str], count: int, block: str, slot: int) -> None:
        nonlocal trouble
        if not count:
            return
        at = f.put(f"getelementptr {f.real}, ptr {block}, i64 {slot}")
        base, row, step = array
        here = f.put(f"getelementptr i8, ptr {base}, i64 {f.put(f'mul i64 %state, {row}')}")
        symbol = emit_move(module, lanes, count, gather=kind == "gather")
        passed = f"ptr {here}, i64 {row}, i64 {step}, ptr {at}"
        if kind == "scatter":
            answer = f.put(f"call {f.real} {symbol}({passed})")
        else:  # what is the same for all states is in its block after the first time
            new = f.put(f"or i1 %begin, {f.put(f'icmp ne i64 {row}, 0')}")
            before, label = here_label[0], f"move{len(f.lines)}"
            f.do(f"br i1 {new}, label %{label}, label %{label}x")
            f.label(label)
            moved = f.put(f"call {f.real} {symbol}({passed})")
            f.do(f"br label %{label}x")
            f.label(f"{label}x")
            answer = f.put(f"phi {f.real} [{f.constant(0.0)}, %{before}], [{moved}, %{label}]")
            here_label[0] = f"{label}x"
        trouble = Value(f, answer) if trouble is None else trouble + Value(f, answer)

    slot = 0
    for k, count in enumerate(sizes.groups):
        move("gather", arrays[k], count, blocks["in"], slot)
        slot += count
    if own_shared:
        slot = 0
        for k, count in enumerate(sizes.hoisted, len(sizes.groups)):
            move("gather", arrays[k], count, blocks["early"], slot)
            slot += count
        f.do(f"call void @{prologue}(ptr {blocks['early']}, ptr null, ptr {blocks['own']}, ptr {blocks['scratch']})")
    f.do(f"call void @{body}(ptr {blocks['in']}, ptr {shared}, ptr {blocks['out']}, ptr {blocks['scratch']})")
    slot = 0
    for k, count in enumerate(sizes.outputs, len(inputs)):
        move("scatter", arrays[k], count, blocks["out"], slot)
        slot += count
    fine = f.all_lanes(f.compare("oeq", zero if trouble is None else trouble, 0.0))
    clean = f.put("icmp eq i64 %first, -1")
    found = f.put(f"select i1 {clean}, i64 %state, i64 %first")
    first = f.put(f"select i1 {fine}, i64 %first, i64 {found}")
    phis = [f"  %first = phi i64 [-1, %entry], [{first}, %{here_label[0]}]"]
    phis += [f"  %next = phi i64 [%start, %entry], [%after, %{here_label[0]}]"]
    f.lines[start_of_next:start_of_next] = phis
    f.do(f"%after = add i64 %next, {lanes}")
    f.do("%more = icmp slt i64 %after, %stop")
    f.do("br i1 %more, label %loop, label %end")
    f.label("end")
    f.do(f"ret i64 {first}")
    f.finish(
        "batch", "i64", "ptr %table, i64 %start, i64 %stop, ptr %work", f'nounwind "prefer-vector-width"="{lanes * 64}"'
    )


def _entry(f: Function, kind: str, index: int) -> str:
    """Entry ``index`` of the table."""
    return f.put(f"load {kind}, ptr {f.put(f'getelementptr i64, ptr %table, i64 {index}')}")


def _array(f: Function, k: int) -> tuple[str, str, str]:
    """Address and strides of the k-th array of the table."""
    return _entry(f, "ptr", 3 * k), _entry(f, "i64", 3 * k + 1), _entry(f, "i64", 3 * k + 2)
