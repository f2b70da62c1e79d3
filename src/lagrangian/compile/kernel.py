"""Kernel: a compiled program that is called with arrays."""

from __future__ import annotations

import ctypes
import math
import threading
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy import ndarray
from numpy.typing import NDArray

from lagrangian.errors import RunError, did_you_mean

from . import native, workers
from .arguments import FLOAT, Group, not_finite_input, rows, where
from .build import Build, Options
from .stage import RawFunction, Stage, address, aligned

if TYPE_CHECKING:
    from lagrangian.graph import Program

_TAPE = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)
_BATCH = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p)
# A short state takes less time than handing the interpreter's lock over and back: there `single` keeps it.
_SINGLE_SHORT = ctypes.PYFUNCTYPE(ctypes.c_int64, ctypes.c_void_p)
_SINGLE_LONG = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p)

LONG = 20_000  # nodes from which one state is long
REMEMBERED = 64  # parameter sets whose shared block is kept


def _rebuilt(program: Program, options: Options, optional: Mapping[str, float], threads: int | None) -> Kernel:
    """A kernel sent from another process, perhaps another machine: compiled here, for what is here."""
    return Kernel(Build(program, options, native.host()), optional=optional, threads=threads)


class Kernel:
    """A compiled program: arrays in, arrays out.

    Call it with the groups in the program's order, or by name; each of shape ``(..., n)``, leading shapes broadcast
    together; a group can also be a mapping from entry names to values. One output comes back as an array of shape
    ``(..., *shape)``, several as a dict of such arrays. ``out`` (an array, or a dict of arrays) is written to and
    returned. Nothing else that is handed over is written to. Kernels can be called from several threads at once.

    Raises :class:`~lagrangian.errors.RunError` where a shape or a type is wrong, a name is unknown or missing, or a
    value is not finite, in or out.
    """

    def __init__(self, build: Build, *, optional: Mapping[str, float], threads: int | None) -> None:
        program = build.program
        self.name, self.program, self.lanes = program.name, program, build.options.lanes
        self.threads = threads
        self.build, self._optional = build, dict(optional)
        self._groups = tuple(
            Group(name, tuple(e), tuple(program.defaults.get(x) if name == "p" else optional.get(name) for x in e))
            for name, e in program.inputs.items()
        )
        self._outputs = tuple(program.outputs)
        self._shapes = tuple(tuple(o.shape) for o in program.outputs.values())
        hoist = build.options.hoist
        self._late = [k for k, g in enumerate(self._groups) if g.name not in hoist]
        self._early = [k for k, g in enumerate(self._groups) if g.name in hoist]
        self._early_at = self._early[0] if self._early else len(self._groups)
        self._stages: list[Stage] = []
        self._blocks: OrderedDict[bytes, NDArray[np.float64]] = OrderedDict()
        self._standard: NDArray[np.float64] | None = None  # the shared block of the default parameters, once used
        self._single: Any = None
        self._batches: dict[str, Any] = {}
        self._lone = len(self._shapes) == 1 and self._shapes[0] != ()
        self._lock = threading.Lock()

    def __reduce__(self) -> Any:
        return _rebuilt, (self.program, self.build.options, self._optional, self.threads)

    def __repr__(self) -> str:
        inputs = ", ".join(f"{g.name}[{len(g.entries)}]" for g in self._groups)
        outputs = ", ".join(f"{n}{list(s)}" for n, s in zip(self._outputs, self._shapes, strict=True))
        return f"<Kernel {self.name!r}: {inputs} -> {outputs}>"

    @property
    def operations(self) -> int:
        """Operations a state takes; a fused product and sum, a division, a call each count as one."""
        return self.build.lowered.body.operations

    @property
    def parameter_operations(self) -> int:
        """Operations a parameter set takes, once."""
        return self.build.lowered.prologue.operations

    # One state, plain arrays: as little Python as possible ---------------------------------------------------------

    def __call__(self, *given: Any, out: Any = None, **named: Any) -> Any:
        """Evaluate; see the class."""
        if out is None and not named and self._stages:
            answer = self._quick(given)
            if answer is not None:
                return answer
        return self._general(self._assigned(given, named), out)

    def _quick(self, given: tuple[Any, ...]) -> Any:
        """The answer for one state in float64 vectors of the right length; None if anything needs a closer look."""
        count = len(given)
        early = given[self._early_at] if self._early_at < count else None
        if early is None:
            shared = self._standard
        elif type(early) is ndarray and early.dtype is FLOAT and early.ndim == 1 and len(self._early) == 1:
            shared = self._blocks.get(early.tobytes())
        else:
            return None
        if shared is None or count > len(self._groups) or len(self._early) > 1:
            return None
        try:
            stage = self._stages.pop()
        except IndexError:  # another thread took it
            return None
        answer = None
        if self._filled(stage, given, count):
            if stage.shared is not shared:
                stage.share(shared)
            if self._single(stage.where) == 0:
                answer = stage.results[0].copy() if self._lone else self._answer(stage)
        self._stages.append(stage)
        return answer

    @staticmethod
    def _filled(stage: Stage, given: tuple[Any, ...], count: int) -> bool:
        """Copy the groups that are plain into the stage; False if one is not."""
        for k, part, shape, scalar, default in stage.parts:
            array = given[k] if k < count else None
            if type(array) is ndarray:
                if array.dtype is not FLOAT or array.shape != shape or scalar:
                    return False
                part[...] = array  # a third of the time of part[:]
            elif array is None and default is not None:
                if default.size:
                    part[...] = default
            elif scalar and type(array) is float:
                part[0] = array
            else:
                return False
        return True

    def _answer(self, stage: Stage) -> Any:
        """The outputs of a stage, copied."""
        answers = [result.copy()[()] for result in stage.results]
        return answers[0] if len(answers) == 1 else dict(zip(self._outputs, answers, strict=True))

    # Everything else ---------------------------------------------------------------------------------------------

    def _assigned(self, given: Sequence[Any], named: Mapping[str, Any]) -> list[Any]:
        """One argument a group, None where nothing was given."""
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
        arrays = [group.array(given) for group, given in zip(self._groups, slots, strict=True)]
        early = [arrays[k] for k in self._early]
        sweep = any(a.size != a.shape[-1] for a in early)
        if not sweep:
            early = [a.reshape(-1) for a in early]
        shaped = arrays if sweep else [arrays[k] for k in self._late] + [arrays[k][..., :0] for k in self._early]
        lead = self._lead(shaped)
        if sweep:
            shared = None
        else:
            shared = self._shared_block(early)
            if all(given is None for given in (slots[k] for k in self._early)):
                self._standard = shared
        if lead == () and shared is not None and out is None:
            return self._one([arrays[k] for k in self._late], shared)
        return self._many(arrays, lead, shared, out)

    def _lead(self, arrays: list[NDArray[np.float64]]) -> tuple[int, ...]:
        """The leading shape that all groups broadcast to."""
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

    def _shared_block(self, early: list[NDArray[np.float64]]) -> NDArray[np.float64]:
        """The prologue's results for one parameter set; the latest few sets are remembered."""
        key = b"".join(a.tobytes() for a in early)
        found = self._blocks.get(key)
        if found is not None:
            return found
        for k, a in zip(self._early, early, strict=True):
            if trouble := not_finite_input(self._groups[k], a, ""):
                raise trouble
        code = self.build.loaded("batch" if "batch" in self.build.ready else "single")
        sizes = self.build.sizes
        block, shared, scratch = aligned(sum(sizes.hoisted)), aligned(sizes.shared), aligned(sizes.scratch)
        block[:] = np.concatenate([*early, np.empty(0)])
        _TAPE(code.address("prologue_1"))(address(block), None, address(shared), address(scratch))
        shared.flags.writeable = False
        with self._lock:
            while len(self._blocks) >= REMEMBERED:
                self._blocks.popitem(last=False)
            self._blocks[key] = shared
        return shared

    def _one(self, late: list[NDArray[np.float64]], shared: NDArray[np.float64]) -> Any:
        """One state."""
        if self._single is None:
            kind = _SINGLE_LONG if len(self.program.graph.nodes) > LONG else _SINGLE_SHORT
            self._single = kind(self.build.loaded("single").address("single"))
        try:
            stage = self._stages.pop()
        except IndexError:
            stage = Stage(self.build.sizes, [(k, self._groups[k]) for k in self._late], self._shapes)
        for array, (_, part, *_) in zip(late, stage.parts, strict=True):
            part[...] = array
        stage.share(shared)
        fine = self._single(stage.where) == 0
        answer = self._answer(stage)
        self._stages.append(stage)
        if not fine:
            given = [a.reshape(1, -1) for a in late]
            results = [np.reshape(x, (1, -1)) for x in (answer.values() if isinstance(answer, dict) else [answer])]
            raise self._trouble(given, results, (), 0, 1, self._late)
        return answer

    def _many(
        self,
        arrays: list[NDArray[np.float64]],
        lead: tuple[int, ...],
        shared: NDArray[np.float64] | None,
        out: Any,
    ) -> Any:
        """Any number of states."""
        results, answer = self._results(lead, out, arrays)
        count = math.prod(lead)
        if count == 0:
            return answer()
        order = self._late if shared is not None else self._late + self._early
        inputs = [rows(arrays[k], lead) for k in order]
        targets = results
        if count < self.lanes:  # machine code wants full lanes: the last state fills them
            fill = np.minimum(np.arange(self.lanes), count - 1)
            inputs, targets = [a[fill] for a in inputs], [np.empty((self.lanes, r.shape[1])) for r in results]
        kind = "batch" if shared is not None else "sweep"
        call = self._batches.get(kind)
        if call is None:
            call = self._batches[kind] = _BATCH(self.build.loaded(kind).address("batch"))
        entries = [n for a in (*inputs, *targets) for n in (address(a), *a.strides)]
        table = np.array([*entries, 0 if shared is None else address(shared)], np.int64)
        work = self.build.sizes.work(self.lanes, shared is None)

        def task(start: int, stop: int) -> int:
            space = aligned(work)
            return call(address(table), start, stop, address(space))

        cost = len(self.program.graph.nodes)
        bad = workers.over(max(count, self.lanes), self.lanes, cost, self.threads, task)
        if bad >= 0:
            raise self._trouble(inputs, targets, lead, bad, min(bad + self.lanes, count), order)
        if targets is not results:
            for result, target in zip(results, targets, strict=True):
                result[:] = target[:count]
        return answer()

    def _results(
        self, lead: tuple[int, ...], out: Any, arrays: list[NDArray[np.float64]]
    ) -> tuple[list[NDArray[np.float64]], Any]:
        """Arrays (states, size) to compute into, and a function that hands over what they become."""
        count = math.prod(lead)
        given = [None] * len(self._outputs) if out is None else self._targets(out, lead)
        results, finals = [], []
        for shape, target in zip(self._shapes, given, strict=True):
            size = math.prod(shape)
            direct = target is not None and target.flags.c_contiguous and target.flags.aligned
            if target is None or not direct or any(np.may_share_memory(target, a) for a in arrays):
                results.append(np.empty((count, size)))
            else:
                results.append(target.reshape(count, size))
            finals.append(target)

        def answer() -> Any:
            made = []
            for result, target, shape in zip(results, finals, self._shapes, strict=True):
                if target is None:
                    made.append(result.reshape(*lead, *shape)[()])
                    continue
                if not np.may_share_memory(result, target):
                    target[...] = result.reshape(*lead, *shape)
                made.append(target)
            return made[0] if len(made) == 1 else dict(zip(self._outputs, made, strict=True))

        return results, answer

    def _targets(self, out: Any, lead: tuple[int, ...]) -> list[NDArray[np.float64]]:
        """The arrays to write to, checked."""
        named = out if isinstance(out, Mapping) else {self._outputs[0]: out} if len(self._outputs) == 1 else None
        if named is None or set(named) != set(self._outputs):
            raise RunError("out does not fit", code="E501", fix=f"give arrays for {', '.join(self._outputs)}")
        for name, shape in zip(self._outputs, self._shapes, strict=True):
            a, wanted = named[name], (*lead, *shape)
            if not isinstance(a, np.ndarray) or a.dtype != FLOAT or a.shape != wanted or not a.flags.writeable:
                found = f"{a.dtype} {a.shape}" if isinstance(a, np.ndarray) else type(a).__name__
                raise RunError(
                    f"out for '{name}' must be a writable float64 array of shape {wanted} (got {found})", code="E501"
                )
        return [named[name] for name in self._outputs]

    def _trouble(
        self,
        inputs: list[NDArray[np.float64]],
        results: list[NDArray[np.float64]],
        lead: tuple[int, ...],
        start: int,
        stop: int,
        order: list[int],
    ) -> RunError:
        """The error for the first number that is not finite among the states of a block."""
        for state in range(start, stop):
            at = where(lead, state)
            for k, array in zip(order, inputs, strict=True):
                if found := not_finite_input(self._groups[k], array[state], at):
                    return found
            for name, shape, result in zip(self._outputs, self._shapes, results, strict=True):
                for j in np.flatnonzero(~np.isfinite(result[state])):
                    index = [int(i) for i in np.unravel_index(j, shape)] if shape else ""
                    return RunError(
                        f"output '{name}'{index} is {result[state][j]}{at}",
                        code="E503",
                        fix="the inputs are finite: look for a division by zero or a root of a negative number there",
                    )
        return RunError(
            "a result is not finite, but not twice in a row", code="E503", fix="do not change arrays in use"
        )

    # For callers in machine code ---------------------------------------------------------------------------------

    def raw(self, lanes: int = 1) -> RawFunction:
        """The body as a function pointer, for one state or for ``self.lanes`` at a time."""
        if lanes not in (1, self.lanes):
            raise RunError(f"no code for {lanes} lanes", fix=f"1 or {self.lanes}")
        code = self.build.loaded("single" if lanes == 1 else "batch")
        s = self.build.sizes
        name = f"body_{lanes}"
        return RawFunction(code.address(name), lanes, sum(s.groups), s.shared, sum(s.outputs), s.scratch, code)

    def shared(self, p: Any = None) -> NDArray[np.float64]:
        """The shared block of a parameter set, for :meth:`raw` functions."""
        return self._shared_block([self._groups[k].array(p).reshape(-1) for k in self._early])
