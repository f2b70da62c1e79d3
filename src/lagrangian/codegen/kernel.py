"""Kernel: a compiled program that is called with arrays."""

from __future__ import annotations

import ctypes
import math
import threading
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy import ndarray

from lagrangian.errors import RunError, did_you_mean
from lagrangian.quantities.largest import LARGEST

from . import native
from .arguments import InputGroup, unfit_input, where, within
from .batch import Array, Batch, Engine, trouble
from .buffers import Look, RawFunction, Stage, aligned
from .build import Build, Options
from .driver import emit_signs
from .quick import Entry, Quick, absent

if TYPE_CHECKING:
    from lagrangian.graph import Program

    from .ir import Module

_BATCH = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p)
# For a short state, releasing and reacquiring the interpreter's lock would take longer: `single` keeps it.
# Without declared arguments, ctypes passes an address (a c_void_p) as it is, which is a quarter faster.
_SINGLE_SHORT = ctypes.PYFUNCTYPE(ctypes.c_int64)
_SINGLE_LONG = ctypes.CFUNCTYPE(ctypes.c_int64)

LONG_KERNEL_NODES = 20_000  # number of nodes from which a state counts as long
REMEMBERED = 64  # number of parameter sets whose shared block is cached


def _rebuilt(program: Program, options: Options, optional: Mapping[str, float], threads: int | None) -> Kernel:
    """Restore a kernel that was sent from another process, perhaps another machine: it is compiled for this machine."""
    return Kernel(Build(program, options, native.host()), optional=optional, threads=threads)


class Kernel:
    """A compiled program: arrays in, arrays out.

    Call it with the groups in the program's order, or by name. Each has the shape ``(..., n)``, and leading shapes are
    broadcast together; a group can also be a mapping from entry names to values. A single output is returned as an
    array of shape ``(..., *shape)``, several as a dict of such arrays. ``out`` (an array, or a dict of arrays) is
    filled and returned. No other argument is modified. Several threads may call a kernel at once.

    Raises :class:`~lagrangian.errors.RunError` if a shape or a type is wrong, a name is unknown or missing, or an input
    or output is not finite.
    """

    def __init__(self, build: Build, *, optional: Mapping[str, float], threads: int | None) -> None:
        program = build.program
        self.name, self.program, self.lanes = program.name, program, build.options.lanes
        self.threads = threads
        self.build, self._optional = build, dict(optional)
        self._groups = tuple(
            InputGroup(name, tuple(e), tuple(program.defaults.get(x) if name == "p" else optional.get(name) for x in e))
            for name, e in program.inputs.items()
        )
        self._outputs = {name: tuple(o.shape) for name, o in program.outputs.items()}
        hoist = build.options.hoist
        self._state_groups = [k for k, g in enumerate(self._groups) if g.name not in hoist]
        self._hoisted_groups = [k for k, g in enumerate(self._groups) if g.name in hoist]
        self._quick = Quick(self._groups, self._state_groups, self._hoisted_groups, self._outputs, threads, build)
        self._blocks: OrderedDict[bytes, Array] = OrderedDict()  # shared blocks by the bytes of their parameters
        self._engines = self._quick.engines
        self._lock = threading.Lock()
        self.quick: Callable[[Sequence[Any]], Any] = self._quick.__call__ if len(self._hoisted_groups) < 2 else _never
        """One thing a group, or None → the answer, or None where a closer look is due: calling the kernel takes it."""

    def __reduce__(self) -> Any:
        return _rebuilt, (self.program, self.build.options, self._optional, self.threads)

    def __repr__(self) -> str:
        inputs = ", ".join(f"{g.name}[{len(g.entries)}]" for g in self._groups)
        outputs = ", ".join(f"{n}{list(s)}" for n, s in self._outputs.items())
        return f"<Kernel {self.name!r}: {inputs} -> {outputs}>"

    @property
    def admit(self) -> Callable[[Array], Look | None] | None:
        """The function that checks hoisted values, (..., n), before they are used, and may raise an error.

        It may return machine code that checks single rows from then on; rows that this code accepts are not checked
        again.
        """
        return self._quick.admit

    @admit.setter
    def admit(self, look: Callable[[Array], Look | None]) -> None:
        self._quick.admit = look

    def also(self, keys: Mapping[Any, str]) -> None:
        """Let mappings of numbers use other keys beside the names of entries."""
        self._quick.also(keys)

    @property
    def operations(self) -> int:
        """The number of operations per state; a fused product and sum, a division, and a call count as one each."""
        return self.build.lowered.body.operations

    def __call__(self, *given: Any, out: Any = None, **named: Any) -> Any:
        """Evaluate the program; see the class."""
        if named:
            given = tuple(self._assigned(given, named))
        missing = len(self._groups) - len(given)
        if out is None and missing >= 0:
            answer = self.quick(given + (None,) * missing if missing else given)
            if answer is not None:
                return answer
        return self._general(self._assigned(given, {}), out)

    # Everything else -----------------------------------------------------------------------------------------------

    def _assigned(self, given: Sequence[Any], named: Mapping[str, Any]) -> list[Any]:
        """One argument for each group, None if it was not given."""
        names = [g.name for g in self._groups]
        if len(given) > len(names):
            raise RunError(f"{len(given)} arrays for {len(names)} groups", code="E501", fix=f"give {', '.join(names)}")
        slots = [*given, *[None] * (len(names) - len(given))]
        for name, value in named.items():
            if name not in names:
                hint = did_you_mean(name, names) or f"known: {', '.join(names)}"
                raise RunError(f"unknown argument '{name}'", code="E402", fix=hint)
            if names.index(name) < len(given):
                raise RunError(f"argument '{name}' is given twice", code="E404", fix="by place or by name, not both")
            slots[names.index(name)] = value
        return slots

    def _general(self, slots: list[Any], out: Any) -> Any:
        """Check, convert, broadcast, and run."""
        arrays, lead, shared = self._understood(slots)
        if lead == () and shared is not None and out is None:
            return self._one([arrays[k] for k in self._state_groups], shared)
        return self._many(arrays, lead, shared, out)()

    def _understood(self, slots: list[Any]) -> tuple[list[Array], tuple[int, ...], Array | None]:
        """Arrays by group, their common leading shape, and the shared block if all states have the same parameters."""
        arrays = [group.array(given) for group, given in zip(self._groups, slots, strict=True)]
        early = [arrays[k] for k in self._hoisted_groups]
        if any(a.size != a.shape[-1] for a in early):
            for k, a in zip(self._hoisted_groups, early, strict=True):
                self._check_each(self._groups[k], a)
            if self.admit is not None:
                self.admit(early[0])
            return arrays, self._lead(arrays), None
        lead = self._lead([arrays[k] for k in self._state_groups] + [a[..., :0] for a in early])
        shared = self._shared_block([a.reshape(-1) for a in early])
        if all(slots[k] is None for k in self._hoisted_groups):
            self._quick.standard = shared
        return arrays, lead, shared

    @staticmethod
    def _check_each(group: InputGroup, given: Array) -> None:
        """Raise an error for the first of many rows with an entry that is not finite or too large."""
        if within(given, LARGEST):
            return
        lead = given.shape[:-1]
        for state, row in enumerate(given.reshape(-1, given.shape[-1])):
            if found := unfit_input(group, row, where(lead, state), LARGEST):
                raise found

    def _lead(self, arrays: list[Array]) -> tuple[int, ...]:
        """The leading shape to which all groups are broadcast."""
        shapes = {a.shape[:-1] for a in arrays} - {()}
        try:
            return shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
        except ValueError as cause:
            shapes = ", ".join(f"{g.name} {a.shape}" for g, a in zip(self._groups, arrays, strict=True))
            raise RunError(
                f"leading shapes do not fit together: {shapes}",
                code="E501",
                fix="make all but the last axis equal, or 1",
            ) from cause

    def _shared_block(self, early: list[Array]) -> Array:
        """The results of the prologue for one parameter set; those of the most recent sets are cached."""
        key = b"".join(a.tobytes() for a in early)
        found = self._blocks.get(key)
        if found is not None:
            return found
        for k, a in zip(self._hoisted_groups, early, strict=True):
            if trouble := unfit_input(self._groups[k], a, "", LARGEST):
                raise trouble
        if self.admit is not None:
            self.admit(early[0])
        stage = self._stage()
        stage.key = None
        stage.hoisted[...] = early[0] if len(early) == 1 else np.concatenate([*early, np.empty(0)])
        self._quick.parameters(stage.where)
        shared = aligned(len(stage.own))
        shared[...] = stage.own
        self._quick.stages.append(stage)
        with self._lock:
            while len(self._blocks) >= REMEMBERED:
                self._blocks.popitem(last=False)
            self._blocks[key] = shared
        return shared

    def _stage(self) -> Stage:
        """A stage for a call; machine code for its parameters exists then."""
        quick = self._quick
        if quick.parameters is absent:
            quick.parameters = self._entry("batch" if "batch" in self.build.ready else "single", "parameters")
            quick.sizes = self.build.sizes
        return quick.stage()

    def _entry(self, kind: str, name: str) -> Entry:
        """A function in the module of a kind, to be called with the table of a stage."""
        long = len(self.program.graph.nodes) > LONG_KERNEL_NODES
        return (_SINGLE_LONG if long else _SINGLE_SHORT)(self.build.loaded(kind).address(name))

    def _one(self, late: list[Array], shared: Array) -> Any:
        """Evaluate one state."""
        quick = self._quick
        if quick.single is absent:
            quick.both, quick.single = self._entry("single", "both"), self._entry("single", "single")
        stage = self._stage()
        for array, (_, part, _) in zip(late, stage.rows, strict=True):
            part[...] = array
        stage.share(shared)
        fine = quick.single(stage.where) == 0
        answer = quick.answer(stage)
        quick.stages.append(stage)
        if not fine:
            inputs, groups = [a.reshape(-1) for a in late], [self._groups[k] for k in self._state_groups]
            results = [np.ravel(x) for x in (answer.values() if len(self._outputs) != 1 else [answer])]
            raise trouble(groups, inputs, self._outputs, results, "") or RunError("a result is not finite", code="E503")
        return answer

    def _many(self, arrays: list[Array], lead: tuple[int, ...], shared: Array | None, out: Any) -> Batch:
        """Evaluate any number of states."""
        if math.prod(lead) == 0:  # nothing is computed, so no code is needed
            engine = Engine(lambda *_: -1, (), self._outputs, self.lanes, 0, 0, None)
        else:
            engine = self._engine("batch" if shared is not None else "sweep")
        order = self._state_groups if shared is not None else self._state_groups + self._hoisted_groups
        given = [arrays[k] for k in order]
        return Batch(engine, given, lead, shared=shared, out=out, threads=self.threads)

    def _engine(self, kind: str) -> Engine:
        """The machine code for many states with a common parameter set (``batch``) or with one each (``sweep``)."""
        found = self._engines.get(kind)
        if found is None:
            order = self._state_groups if kind == "batch" else self._state_groups + self._hoisted_groups
            found = self._engines[kind] = Engine(
                call=_BATCH(self.build.loaded(kind).address("batch")),
                owner=self.build.loaded(kind),
                groups=tuple(self._groups[k] for k in order),
                outputs=self._outputs,
                lanes=self.lanes,
                work=self.build.sizes.work(self.lanes, kind == "sweep"),
                cost=len(self.program.graph.nodes),
            )
            self._quick.sizes = self.build.sizes
        return found

    def prepared(self, *given: Any, out: Any = None, **named: Any) -> Batch:
        """A call for certain float64 arrays with everything but the arithmetic prepared: ``batch()`` computes from
        their contents.

        It is meant for loops that evaluate the same arrays many times. The current parameters are used, unless each
        state has its own. There must be at least ``lanes`` states, and a single stride must cover the leading axes.
        """
        slots = self._assigned(given, named)
        arrays, lead, shared = self._understood(slots)
        batch = self._many(arrays, lead, shared, out)
        for k, row in zip(
            self._state_groups if shared is not None else self._state_groups + self._hoisted_groups,
            batch.inputs,
            strict=True,
        ):
            given_array = slots[k] if isinstance(slots[k], ndarray) and slots[k].size else None
            if given_array is not None and not (batch.direct and np.may_share_memory(given_array, row)):
                raise RunError(
                    f"'{self._groups[k].name}' cannot be read in place",
                    code="E501",
                    fix=f"give float64 arrays of at least {self.lanes} states, with leading axes in C order",
                )
        return batch

    # For callers in machine code ---------------------------------------------------------------------------------

    def raw(self, lanes: int = 1) -> RawFunction:
        """The body as a function pointer, for one state or for ``self.lanes`` at a time."""
        if lanes not in (1, self.lanes):
            raise RunError(f"no code for {lanes} lanes", fix=f"1 or {self.lanes}")
        code = self.build.loaded("single" if lanes == 1 else "batch")
        s = self.build.sizes
        name = f"body_{lanes}"
        return RawFunction(code.address(name), lanes, sum(s.groups), s.shared, sum(s.outputs), s.scratch, code)

    def signs(self, above: int) -> Look:
        """A check of the only group of a program: is every number small enough, are its first ``above`` outputs
        positive, and the others not negative?
        """

        def printer(module: Module, build: Build) -> None:
            build.emit_tapes(module, 1)
            emit_signs(module, build.sizes, above)

        code = self.build.extended(f"signs {above}", printer)
        return Look(code.address("signs"), code)

    def shared(self, *early: Any) -> Array:
        """The shared block of a parameter set (values of the hoisted groups), for :meth:`raw` functions."""
        given = [*early, *[None] * (len(self._hoisted_groups) - len(early))]
        rows = [self._groups[k].array(x).reshape(-1) for k, x in zip(self._hoisted_groups, given, strict=True)]
        block = self._shared_block(rows).view()
        block.flags.writeable = False
        return block


def _never(_: Sequence[Any]) -> None:
    """Return None: there is no quick way."""
