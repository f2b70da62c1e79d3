"""The loop of a batch for contiguous states, in which the numbers of a short tape stay in registers.

If every array contains its rows one after another, or one row for all states, then the rows of W states are n·W
consecutive numbers: they are loaded as whole vectors and rearranged by shuffles into one vector per entry.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from lagrangian.records import dataclass

from .emit import emit_inline
from .ir import Function, Value, shuffle_mask
from .transpose import Transposer

if TYPE_CHECKING:
    from .sizes import Array, Sizes
    from .tape import Tape

MAX_SORTED_ENTRIES = 4  # up to this many entries, whole vectors are rearranged; rows with more are transposed in tiles


def load(f: Function, base: str, n: int) -> list[Value]:
    """Load ``n`` entries of W consecutive rows at ``base``, as one vector per entry."""
    if n > MAX_SORTED_ENTRIES:
        mover = Transposer(f, _rows(f, base, n), gather=True)
        found: dict[int, str] = {}
        for start, width in mover.pieces(n):
            found.update(zip(range(start, start + width), mover.lifted(str(start), width), strict=True))
        return [Value(f, found[k]) for k in range(n)]
    whole = [_vector(f, base, k) for k in range(n)]
    read = [f.put(f"load {f.real}, ptr {place}, align 8") for place in whole]
    spots = [[divmod(lane * n + entry, f.lanes) for lane in range(f.lanes)] for entry in range(n)]
    return [_sorted(f, read, spot) for spot in spots]


def store(f: Function, base: str, values: Sequence[Value]) -> None:
    """Store, the reverse of `load`."""
    n = len(values)
    if n > MAX_SORTED_ENTRIES:
        mover = Transposer(f, _rows(f, base, n), gather=False)
        for start, width in mover.pieces(n):
            mover.dropped(str(start), width, [v.name for v in values[start : start + width]])
        return
    for k in range(n):
        places = range(k * f.lanes, (k + 1) * f.lanes)
        spots = [(place % n, place // n) for place in places]
        x = _sorted(f, [v.name for v in values], spots)
        f.do(f"store {f.real} {x.name}, ptr {_vector(f, base, k)}, align 8")


def _rows(f: Function, base: str, n: int) -> list[str]:
    return [f.put(f"getelementptr double, ptr {base}, i64 {n * lane}") for lane in range(f.lanes)]


def _vector(f: Function, base: str, k: int) -> str:
    return f.put(f"getelementptr {f.real}, ptr {base}, i64 {k}")


def _sorted(f: Function, sources: Sequence[str], spots: Sequence[tuple[int, int]]) -> Value:
    """The vector whose lane l is lane ``spots[l][1]`` of source ``spots[l][0]``, merged from one source after
    another."""
    used = sorted({source for source, _ in spots})
    x = sources[used[0]]
    first = [lane if source == used[0] else 0 for source, lane in spots]
    if len(used) == 1:
        if first == list(range(f.lanes)):
            return Value(f, x)
        return Value(f, f.put(f"shufflevector {f.real} {x}, {f.real} poison, {shuffle_mask(first)}"))
    for step, number in enumerate(used[1:]):
        chosen = []
        for place, (source, lane) in enumerate(spots):
            if source == number:
                chosen.append(f.lanes + lane)
            else:
                chosen.append(first[place] if step == 0 else place)
        x = f.put(f"shufflevector {f.real} {x}, {f.real} {sources[number]}, {shuffle_mask(chosen)}")
    return Value(f, x)


@dataclass(frozen=True)
class PackedLoop:
    """A tape that is short enough to be printed into the loop, for ``blocks`` × W states per iteration."""

    tape: Tape
    blocks: int = 1


def emit_packed(
    f: Function, short: PackedLoop, sizes: Sizes, arrays: Sequence[Array], at: dict[str, str], shared: str
) -> tuple[str, str, str]:
    """Print the loop for packed arrays, used if there is at least one full iteration; the block ``loop`` or ``end``
    follows.

    Return where control comes from: the label, the next state, and the first state that is not finite, or −1.
    """
    states = short.blocks * f.lanes
    inputs, outputs = arrays[: len(sizes.groups)], arrays[len(sizes.groups) :]
    fits = f.put(f"icmp sge i64 {f.put('sub i64 %stop, %start')}, {states}")
    for array, n in zip(inputs, sizes.groups, strict=True):
        fits = _and(f, fits, _packed(f, array, n, still=True)) if n else fits
    for array, n in zip(outputs, sizes.outputs, strict=True):
        fits = _and(f, fits, _packed(f, array, n, still=False)) if n else fits
    f.do(f"br i1 {fits}, label %copy, label %loop")
    f.label("copy")
    bases = _repeated(f, inputs, sizes.groups, at["in"])
    f.do("br label %fast")
    f.label("fast")
    start_of_loop = len(f.lines)  # its phis use values that are printed below
    firsts = [f.put(f"add i64 %turn, {k * f.lanes}") for k in range(short.blocks)]
    read = [_read(f, bases, sizes.groups, state) for state in firsts]
    wide = f.widened(states)
    joined = [f.joined([block[k].name for block in read], wide) for k in range(len(read[0]))]
    results = emit_inline(wide, short.tape, dict(enumerate(joined)), shared)
    found = "-1"
    for k in reversed(range(short.blocks)):
        values = [wide.part(x, f, k) for x in results]
        _write(f, outputs, sizes.outputs, firsts[k], values)
        trouble = Transposer(f, [], gather=True).noted([x.name for x in (*read[k], *values)], Value(f, f.constant(0.0)))
        fine = f.all_lanes(f.compare("oeq", trouble, 0.0))
        found = f.put(f"select i1 {fine}, i64 {found}, i64 {firsts[k]}")
    known = f.put(f"select i1 {f.put('icmp eq i64 %known, -1')}, i64 {found}, i64 %known")
    f.lines[start_of_loop:start_of_loop] = [
        "  %turn = phi i64 [%start, %copy], [%ahead, %fast]",
        f"  %known = phi i64 [-1, %copy], [{known}, %fast]",
    ]
    f.do(f"%ahead = add i64 %turn, {states}")
    beyond = f.put(f"add i64 %ahead, {states}")
    f.do(f"br i1 {f.put(f'icmp sle i64 {beyond}, %stop')}, label %fast, label %slow")
    f.label("slow")
    f.do(f"br i1 {f.put('icmp slt i64 %ahead, %stop')}, label %loop, label %end")
    return "slow", "%ahead", known


def _and(f: Function, a: str, b: str) -> str:
    return f.put(f"and i1 {a}, {b}")


def _packed(f: Function, array: Array, n: int, *, still: bool) -> str:
    """Whether rows of ``n`` are contiguous or (``still``) there is one row for all states."""
    _, row, step = array
    fits = f.put(f"icmp eq i64 {row}, {8 * n}")
    if still:
        fits = f.put(f"or i1 {fits}, {f.put(f'icmp eq i64 {row}, 0')}")
    return fits if n == 1 else _and(f, fits, f.put(f"icmp eq i64 {step}, 8"))


def _repeated(f: Function, arrays: Sequence[Array], counts: Sequence[int], block: str) -> list[tuple[str, str]]:
    """Base and stride of every input; one row for all states is copied W times into ``block`` and read from there."""
    found: list[tuple[str, str]] = []
    slot = 0
    for (base, row, _), n in zip(arrays, counts, strict=True):
        if n:
            own = f.put(f"getelementptr {f.real}, ptr {block}, i64 {slot}")
            for k in range(n):
                x = f.put(f"load double, ptr {f.put(f'getelementptr double, ptr {base}, i64 {k}')}, align 8")
                for lane in range(f.lanes):
                    place = f.put(f"getelementptr double, ptr {own}, i64 {lane * n + k}")
                    f.do(f"store double {x}, ptr {place}, align 8")
            still = f.put(f"icmp eq i64 {row}, 0")
            base = f.put(f"select i1 {still}, ptr {own}, ptr {base}")
        found.append((base, row))
        slot += n
    return found


def _read(f: Function, bases: Sequence[tuple[str, str]], counts: Sequence[int], state: str) -> list[Value]:
    """Read the inputs of W states from ``state`` on."""
    found: list[Value] = []
    for (base, row), n in zip(bases, counts, strict=True):
        if n:
            found += load(f, _place(f, base, row, state), n)
    return found


def _write(f: Function, arrays: Sequence[Array], counts: Sequence[int], state: str, values: Sequence[Value]) -> None:
    """Write the outputs of W states from ``state`` on."""
    done = 0
    for (base, row, _), n in zip(arrays, counts, strict=True):
        if n:
            store(f, _place(f, base, row, state), values[done : done + n])
        done += n


def _place(f: Function, base: str, row: str, state: str) -> str:
    return f.put(f"getelementptr i8, ptr {base}, i64 {f.put(f'mul i64 {state}, {row}')}")
