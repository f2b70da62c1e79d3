"""The tapes of a program inside an integrator: printed in place if they are short, called if they are long."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from lagrangian.codegen.emit import emit, emit_inline, plan
from lagrangian.codegen.ir import Value
from lagrangian.codegen.tape import lower

from .printer import UNROLLED, Printer, Vec

if TYPE_CHECKING:
    from lagrangian.graph import Program

INLINE = 3000  # operations that may be printed in place, all copies together


class PrintedProgram:
    """A program as code within an integrator, with hoisted parameters, and the slots of its inputs x, u, p and t.

    ``own``: every lane has its own parameters, so the shared block has one number per lane.
    ``called``: the body is a function too, even if it is short enough to be printed in place.
    """

    def __init__(
        self, p: Printer, program: Program, name: str, *, own: bool, copies: int, called: bool = False
    ) -> None:
        self.p, self.name, self.own = p, name, own
        self.low = lower(program, ("p",))
        self.groups = {group: len(program.inputs[group]) for group in self.low.groups}
        self.inline = p.unrolled and self.low.body.operations * copies <= INLINE
        self.count = len(self.low.body.outputs)
        portable = p.f.module.target.imports
        cuts = plan(self.low.body, portable=portable), plan(self.low.prologue, portable=portable)
        self.scratch = p.reserve(max(cut.scratch for cut in cuts))
        self.inputs = p.reserve(sum(self.groups.values()))
        self.shared = p.reserve(len(self.low.prologue.outputs)) if own else 0
        module, lanes = p.f.module, p.lanes
        if own or lanes == 1:
            emit(module, f"{name}_prologue_{lanes}", self.low.prologue, lanes, own_shared=own)
        if not own and lanes > 1:
            emit(module, f"{name}_prologue_1", self.low.prologue, 1)
        if called or not self.inline:
            emit(module, f"{name}_{lanes}", self.low.body, lanes, own_shared=own)

    def start(self, name: str, group: str) -> int:
        """The slot of the first entry of an input group."""
        found = self.inputs
        for other, size in self.groups.items():
            if other == group:
                return found
            found += size
        return found

    def named(self, slot: int) -> tuple[str, int]:
        """The group of an input slot, and the index in it."""
        for group, size in self.groups.items():
            if slot < size:
                return group, slot
            slot -= size
        raise IndexError(slot)

    def prologue(self, slot: int) -> None:
        """Print the computation of every lane's shared block from the parameters in the slots from ``slot`` on."""
        p = self.p
        given = f"ptr {p.at(slot)}, ptr null, ptr {p.at(self.shared)}, ptr {p.at(self.scratch)}"
        p.f.do(f"call void @{self.name}_prologue_{p.lanes}({given})")

    def evaluate(
        self, shared: str, values: Mapping[str, Vec], time: Value, out: int | None = None, *, call: bool = False
    ) -> tuple[Value, ...] | None:
        """Print the body for given vectors and a time; return its outputs, or write them to the slots ``out``.

        ``shared``: the address of the shared block if it is common to all lanes. ``call``: call the body even if it is
        short; only with ``called``.
        """
        p, f = self.p, self.p.f
        shared = p.at(self.shared) if self.own else shared
        if self.inline and not call:
            slots: dict[int, Value] = {}
            for group, size in self.groups.items():
                for k in range(size):
                    slots[len(slots)] = time if group == "t" else _entry(p, values[group], k)
            found = tuple(emit_inline(f, self.low.body, slots, shared, own_shared=self.own))
            if out is not None:
                for k, x in enumerate(found):
                    p.store(x, out, k)
            return found
        slot = self.inputs
        for group, size in self.groups.items():
            self._fill(slot, size, time if group == "t" else values[group])
            slot += size
        target = p.reserve(self.count) if out is None else out
        given = f"ptr {p.at(self.inputs)}, ptr {shared}, ptr {p.at(target)}, ptr {p.at(self.scratch)}"
        f.do(f"call void @{self.name}_{p.lanes}({given})")
        return tuple(p.load(target, k) for k in range(self.count)) if out is None else None

    def _fill(self, slot: int, size: int, given: Vec | Value) -> None:
        p = self.p
        if isinstance(given, Value):
            p.store(given, slot)
        elif given.slot == slot and given.values is None:
            return  # it is there already
        elif given.values is not None or size <= UNROLLED:
            for k in range(size):
                p.store(_entry(p, given, k), slot, k)
        else:
            with p.repeat(size) as i:
                p.store(p.read(given, i), slot, i)


def _entry(p: Printer, v: Vec, k: int) -> Value:
    return p.read(v, k)
