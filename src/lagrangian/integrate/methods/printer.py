"""Structured LLVM IR for integrators: vectors, loops, conditions and work space on top of `lagrangian.codegen.ir`.

An integrator computes ``lanes`` runs side by side. Its memory is one block, ``%work``, of slots of ``lanes`` doubles;
entry i of a vector is slot ``base + i``. A short vector is held in registers, entry by entry (``Vec.values``); a long
one in its slots, and operations on it are loops (:meth:`Printer.map`). The same code describes both.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from lagrangian.codegen.ir import Function, Module, Value
from lagrangian.records import dataclass

UNROLLED = 16  # entries of the longest vector that is kept in registers
HEAD = 8  # slots of the work space that hold scalars shared with Python


@dataclass(frozen=True)
class Vec:
    """A vector with an entry per component of the state: in registers, in slots, or both; or an external array.

    ``pointer``: address of one double per entry, the same for all lanes.
    """

    values: tuple[Value, ...] | None = None
    slot: int | None = None
    pointer: str | None = None


class Printer:
    """Prints one function ``name(ptr table, ptr work, i64 budget)`` on vectors of ``size`` entries."""

    def __init__(self, module: Module, lanes: int, size: int) -> None:
        self.f, self.lanes, self.size = Function(module, lanes), lanes, size
        self.unrolled = size <= UNROLLED
        self._labels = 0
        self.slots = HEAD  # of the work space given away so far

    # Work space --------------------------------------------------------------------------------------------------

    def reserve(self, count: int) -> int:
        """The first of ``count`` new slots."""
        found, self.slots = self.slots, self.slots + max(count, 1)
        return found

    def block(self) -> Vec:
        """Slots for a vector."""
        return Vec(slot=self.reserve(self.size))

    def at(self, slot: int, index: str | int = 0) -> str:
        """The address of a slot, or of the slot ``index`` positions after it."""
        f = self.f
        if isinstance(index, int):
            return f.put(f"getelementptr {f.real}, ptr %work, i64 {slot + index}")
        return f.put(f"getelementptr {f.real}, ptr %work, i64 {f.put(f'add i64 {index}, {slot}')}")

    def load(self, slot: int, index: str | int = 0) -> Value:
        """Load the numbers in a slot."""
        f = self.f
        return Value(f, f.put(f"load {f.real}, ptr {self.at(slot, index)}, align {8 * f.lanes}"))

    def store(self, x: Value | float, slot: int, index: str | int = 0) -> None:
        """Write the numbers of a slot."""
        f = self.f
        f.do(f"store {f.real} {f.operand(x)}, ptr {self.at(slot, index)}, align {8 * f.lanes}")

    def load_whole(self, slot: int) -> str:
        """Load the 64-bit integers in a slot."""
        return self.f.put(f"load {self.f.whole}, ptr {self.at(slot)}, align {8 * self.lanes}")

    def store_whole(self, x: str, slot: int) -> None:
        """Write the 64-bit integers of a slot."""
        self.f.do(f"store {self.f.whole} {x}, ptr {self.at(slot)}, align {8 * self.lanes}")

    def lane_at(self, slot: int, lane: str) -> str:
        """The address of one lane of a slot."""
        f = self.f
        place = f.put(f"add i64 {self.lanes * slot}, {lane}")
        return f.put(f"getelementptr double, ptr %work, i64 {place}")

    def get(self, slot: int, lane: str, kind: str = "double") -> str:
        """One lane of a slot: a ``double`` or an ``i64``."""
        return self.f.put(f"load {kind}, ptr {self.lane_at(slot, lane)}")

    def set(self, x: str, slot: int, lane: str, kind: str = "double") -> None:
        """Write one lane of a slot."""
        self.f.do(f"store {kind} {x}, ptr {self.lane_at(slot, lane)}")

    def word(self, index: int, kind: str = "i64") -> str:
        """Load a scalar in the head of the work space."""
        return self.f.put(f"load {kind}, ptr {self.f.put(f'getelementptr i64, ptr %work, i64 {index}')}")

    def set_word(self, x: str, index: int) -> None:
        """Write an integer to the head of the work space."""
        self.f.do(f"store i64 {x}, ptr {self.f.put(f'getelementptr i64, ptr %work, i64 {index}')}")

    def entry(self, index: int, kind: str = "i64") -> str:
        """Load an entry of the table that Python filled."""
        return self.f.put(f"load {kind}, ptr {self.f.put(f'getelementptr i64, ptr %table, i64 {index}')}")

    # Flow --------------------------------------------------------------------------------------------------------

    def _label(self) -> int:
        self._labels += 1
        return self._labels

    @contextmanager
    def when(self, flag: str) -> Iterator[None]:
        """A context: what is printed inside is executed only if a scalar flag holds."""
        f, k = self.f, self._label()
        f.do(f"br i1 {flag}, label %then{k}, label %join{k}")
        f.label(f"then{k}")
        yield
        f.do(f"br label %join{k}")
        f.label(f"join{k}")

    @contextmanager
    def repeat(self, count: str | int) -> Iterator[str]:
        """A context: a loop over 0 … count − 1 that yields the index."""
        f, k = self.f, self._label()
        f.do(f"br label %before{k}")
        f.label(f"before{k}")
        f.do(f"br label %head{k}")
        f.label(f"head{k}")
        f.do(f"%i{k} = phi i64 [0, %before{k}], [%next{k}, %latch{k}]")
        more = f.put(f"icmp slt i64 %i{k}, {count}")
        f.do(f"br i1 {more}, label %body{k}, label %end{k}")
        f.label(f"body{k}")
        yield f"%i{k}"
        f.do(f"br label %latch{k}")
        f.label(f"latch{k}")
        f.do(f"%next{k} = add i64 %i{k}, 1")
        f.do(f"br label %head{k}")
        f.label(f"end{k}")

    @contextmanager
    def forever(self) -> Iterator[Callable[[str], None]]:
        """A context: a loop that ends when the function that it yields is called with a flag that holds."""
        f, k = self.f, self._label()
        exits = 0

        def leave(flag: str) -> None:
            nonlocal exits
            exits += 1
            f.do(f"br i1 {flag}, label %out{k}, label %on{k}_{exits}")
            f.label(f"on{k}_{exits}")

        f.do(f"br label %again{k}")
        f.label(f"again{k}")
        yield leave
        f.do(f"br label %again{k}")
        f.label(f"out{k}")

    def any(self, flag: str) -> str:
        """A scalar flag: whether a flag holds in some lane."""
        if self.lanes == 1:
            return flag
        bits = self.f.put(f"bitcast {self.f.flag} {flag} to i{self.lanes}")
        return self.f.put(f"icmp ne i{self.lanes} {bits}, 0")

    def count(self, flag: str, slot: int) -> None:
        """Add 1 to the integers of a slot where the flag holds."""
        f = self.f
        one = f.put(f"zext {f.flag} {flag} to {f.whole}")
        self.store_whole(f.put(f"add {f.whole} {self.load_whole(slot)}, {one}"), slot)

    def whole_is(self, x: str, value: int) -> str:
        """Where integers have a value."""
        return self.f.put(f"icmp eq {self.f.whole} {x}, {self.f.integer(value)}")

    def whole_select(self, flag: str, a: str, b: str) -> str:
        """``a`` where the flag holds, else ``b``, of integers."""
        f = self.f
        return f.put(f"select {f.flag} {flag}, {f.whole} {a}, {f.whole} {b}")

    # Vectors -----------------------------------------------------------------------------------------------------

    def read(self, v: Vec, index: str | int) -> Value:
        """An entry of a vector."""
        if v.values is not None and isinstance(index, int):
            return v.values[index]
        if v.pointer is not None:
            f = self.f
            address = f.put(f"getelementptr double, ptr {v.pointer}, i64 {index}")
            return f.broadcast(f.put(f"load double, ptr {address}, align 8"))
        assert v.slot is not None
        return self.load(v.slot, index)

    def map(
        self, compute: Callable[..., Value | tuple[Value, ...]], *given: Vec, into: Sequence[Vec] = ()
    ) -> tuple[Vec, ...]:
        """``compute`` applied to the entries of the given vectors, entry by entry.

        Results are written to the vectors ``into``; if vectors are in registers and ``into`` is not given, they stay in
        registers.
        """
        if self.unrolled:
            rows = [_several(compute(*(self.read(v, i) for v in given))) for i in range(self.size)]
            columns = tuple(Vec(values=tuple(column)) for column in zip(*rows, strict=True))
            for column, target in zip(columns, into, strict=False):
                assert column.values is not None and target.slot is not None
                for i, x in enumerate(column.values):
                    self.store(x, target.slot, i)
            return columns
        with self.repeat(self.size) as i:
            results = _several(compute(*(self.read(v, i) for v in given)))
            targets = list(into) + [self.block() for _ in results[len(into) :]]
            for x, target in zip(results, targets, strict=True):
                assert target.slot is not None
                self.store(x, target.slot, i)
        return tuple(targets)

    def fold(self, add: Callable[..., tuple[Value, ...]], start: Sequence[float], *given: Vec) -> tuple[Value, ...]:
        """``add(sums so far, entries of the given vectors) → sums``, over all entries."""
        f = self.f
        sums = tuple(Value(f, f.constant(x)) for x in start)
        if self.unrolled:
            for i in range(self.size):
                sums = add(*sums, *(self.read(v, i) for v in given))
            return sums
        homes = [self.reserve(1) for _ in start]
        for x, home in zip(sums, homes, strict=True):
            self.store(x, home)
        with self.repeat(self.size) as i:
            found = add(*(self.load(home) for home in homes), *(self.read(v, i) for v in given))
            for x, home in zip(found, homes, strict=True):
                self.store(x, home)
        return tuple(self.load(home) for home in homes)

    def weighted(self, pairs: Sequence[tuple[float, Value]]) -> Value:
        """Σ c x, with a fused product and sum for each term."""
        total: Value | None = None
        for c, x in pairs:
            total = x * c if total is None else self.f.fma(x, c, total)
        assert total is not None
        return total


def _several(results: Value | tuple[Value, ...]) -> tuple[Value, ...]:
    return results if isinstance(results, tuple) else (results,)
