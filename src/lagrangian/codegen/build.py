"""Compiles a Program to machine code: its functions and modules, and the cache of modules on disk.

A program becomes up to three modules, each built when it is first needed:

* ``single``: one state, scalar code; ``batch``: many states, ``lanes`` at a time, one parameter set;
* ``sweep``: many states, each with its own parameter set.
"""

from __future__ import annotations

import hashlib
import json
import logging
import threading
from collections.abc import Callable
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import llvmlite

from lagrangian.graph import reached
from lagrangian.records import dataclass

from . import cache as disk
from . import driver, native
from .emit import emit, plan
from .ir import Module, Target
from .packed_loop import PackedLoop
from .tape import Lowered, lower

if TYPE_CHECKING:
    from lagrangian.graph import Program

_log = logging.getLogger(__name__)
MAX_INLINE_OPERATIONS = 125  # a body with at most this many operations per lane is printed into the loop of the batch …
SIDE_BY_SIDE = 2  # … for this many blocks of states at once: while one waits for a result, another computes
LEVEL = 2  # LLVM's optimization level; higher levels gain nothing measurable for straight-line code


@dataclass(frozen=True)
class Options:
    """The options that, together with the program, determine the machine code."""

    lanes: int
    hoist: tuple[str, ...] = ("p",)
    chunk: int | None = None  # operations in one function; None: depends on the length of the program
    level: int = LEVEL
    keep: bool = True  # cached on disk


class Build:
    """The machine code of a program, module by module."""

    def __init__(self, program: Program, options: Options, target: Target) -> None:
        self.program, self.options, self.target = program, options, target
        self._lowered: Lowered | None = None
        self._sizes: driver.Sizes | None = None
        self._loaded: dict[str, native.Loaded] = {}
        self._key: str | None = None
        self._lock = threading.RLock()

    @property
    def lowered(self) -> Lowered:
        """The program as prologue and body."""
        with self._lock:
            if self._lowered is None:
                self._lowered = lower(self.program, self.options.hoist)
            return self._lowered

    @property
    def sizes(self) -> driver.Sizes:
        """The sizes of the blocks; for cached code they are known without lowering."""
        with self._lock:
            if self._sizes is None:
                low, program = self.lowered, self.program
                cuts = plan(low.body, self.options.chunk), plan(low.prologue, self.options.chunk)
                self._sizes = driver.Sizes(
                    groups=tuple(len(program.inputs[g]) for g in low.groups),
                    hoisted=tuple(len(program.inputs[g]) for g in low.hoisted),
                    shared=len(low.prologue.outputs),
                    outputs=tuple(len(o.ids) for o in program.outputs.values()),
                    scratch=max(cut.scratch for cut in cuts),
                )
            return self._sizes

    @property
    def ready(self) -> frozenset[str]:
        """The kinds of module that are already in memory."""
        return frozenset(self._loaded)

    def loaded(self, kind: str) -> native.Loaded:
        """The module of a kind, from memory, from disk, or compiled now."""
        found = self._loaded.get(kind)
        if found is None:
            with self._lock:
                found = self._loaded.get(kind) or self._loaded.setdefault(kind, self._load(kind))
        return found

    def _load(self, kind: str, printer: Callable[[Module, Build], None] | None = None) -> native.Loaded:
        keep = self.options.keep and disk.directory() is not None
        key = f"{self.key}-{kind}" if keep else ""
        content = disk.read(key) if keep else None
        if content is not None:
            head, _, code = content.partition(b"\n")
            self._sizes = self._sizes or _sizes(head)
            return native.Loaded(code, self.target)
        if printer is None:
            text = self.text(kind)
        else:
            module = Module(self.target)
            printer(module, self)
            text = module.text()
        _log.info("making machine code of %d operations", len(self.program.graph))
        code = native.object_code(text, self.target, self.options.level)
        if keep:
            disk.write(key, json.dumps(asdict(self.sizes)).encode() + b"\n" + code)
        return native.Loaded(code, self.target)

    @property
    def key(self) -> str:
        """A key for this program, these options, this machine and this version of the printer."""
        with self._lock:
            if self._key is None:
                self._key = fingerprint(self.program, self.options, self.target)
            return self._key

    def text(self, kind: str) -> str:
        """The LLVM IR of the module of a kind."""
        module, lanes = Module(self.target), self.options.lanes
        if kind == "single":
            self.emit_tapes(module, 1)
            driver.emit_single(module, self.sizes)
            return module.text()
        own = kind == "sweep"
        self.emit_tapes(module, lanes, own_shared=own)
        if lanes > 1 and not own:
            emit(module, "prologue_1", self.lowered.prologue, 1, chunk=self.options.chunk)
        if not own:
            driver.emit_parameters(module, self.sizes)
        body, prologue = f"body_{lanes}", f"prologue_{lanes}"
        driver.emit_batch(
            module, self.sizes, lanes, own_shared=own, body=body, prologue=prologue, short=None if own else self.short
        )
        return module.text()

    @property
    def short(self) -> PackedLoop | None:
        """The body, if it is short enough to be printed into the batch's own loop."""
        body, lanes = self.lowered.body, self.options.lanes
        fits = lanes > 1 and sum(self.sizes.groups) and body.operations <= MAX_INLINE_OPERATIONS * lanes
        return PackedLoop(body, SIDE_BY_SIDE) if fits else None

    def emit_tapes(self, module: Module, lanes: int, *, own_shared: bool = False) -> None:
        """Print ``body_<lanes>``, and ``prologue_<lanes>`` unless all lanes share one parameter set."""
        low, chunk = self.lowered, self.options.chunk
        if lanes == 1 or own_shared:
            emit(module, f"prologue_{lanes}", low.prologue, lanes, own_shared=own_shared, chunk=chunk)
        emit(module, f"body_{lanes}", low.body, lanes, own_shared=own_shared, chunk=chunk)

    def extended(self, name: str, printer: Callable[[Module, Build], None]) -> native.Loaded:
        """A module with additional functions, compiled and cached like the others.

        ``printer`` prints functions that call ``body_…`` (see :meth:`emit_tapes`), such as an integrator. ``name``
        identifies the printed text: different printers, or versions of one, must have different names.
        """
        with self._lock:
            kind = "x" + hashlib.sha256(name.encode()).hexdigest()[:24]
            found = self._loaded.get(kind)
            if found is None:
                found = self._loaded[kind] = self._load(kind, printer)
            return found


def _sizes(head: bytes) -> driver.Sizes:
    """Restore what ``asdict`` wrote."""
    n = json.loads(head)
    return driver.Sizes(tuple(n["groups"]), tuple(n["hoisted"]), n["shared"], tuple(n["outputs"]), n["scratch"])


@cache
def _printer_version() -> str:
    """A checksum of the sources in this package and LLVM's version, because a change in either may change the code."""
    total = hashlib.sha256(f"{llvmlite.__version__} {native.llvm.llvm_version_info}".encode())
    for source in sorted(Path(__file__).parent.glob("*.py")):
        total.update(source.read_bytes())
    return total.hexdigest()


def fingerprint(program: Program, options: Options, target: Target) -> str:
    """SHA-256 of everything that determines the machine code; names, and nodes that no output needs, are ignored."""
    nodes = program.graph.nodes
    order = reached(program.graph, program.ids)
    position = {i: k for k, i in enumerate(order)}
    rows = []
    for i in order:
        node = nodes[i]
        if node[0] in ("const", "input"):
            rows.append(node)
        elif node[0] == "powi":
            rows.append(("powi", position[node[1]], node[2]))
        else:
            rows.append((node[0], *[position[k] for k in node[1:]]))
    shape = [(group, len(names)) for group, names in program.inputs.items()]
    outputs = [[position[i] for i in output.ids] for output in program.outputs.values()]
    total = hashlib.sha256(repr((rows, shape, outputs, asdict(options), asdict(target))).encode())
    total.update(_printer_version().encode())
    return total.hexdigest()
