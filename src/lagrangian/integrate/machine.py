"""The machine code of an integrator: compiling, caching and calling it."""

from __future__ import annotations

import ctypes
import hashlib
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Build, Options, aligned, native
from lagrangian.codegen.buffers import address
from lagrangian.codegen.build import fingerprint

from .methods.loop import IntegratorVariant, Loop
from .methods.memory_layout import PLACES
from .methods.method import Method

if TYPE_CHECKING:
    from lagrangian.codegen.ir import Module, Target
    from lagrangian.graph import Program

    from .problem import Events
    from .projection import Projection

_RUN = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64)
_TAPE = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)


@cache
def _printer_version() -> str:
    """A checksum of the sources in this package, because a change in them may change the code."""
    total = hashlib.sha256()
    for source in sorted((Path(__file__).parent / "methods").glob("*.py")):
        total.update(source.read_bytes())
    return total.hexdigest()


class Machine:
    """An integrator in memory: its function, and the size of its work space."""

    def __init__(
        self,
        build: Build,
        method: Method,
        variant: IntegratorVariant,
        events: Events | None = None,
        projection: Projection | None = None,
    ) -> None:
        def printer(module: Module, build: Build) -> None:
            Loop(module, build.program, method, variant, events, projection).print()

        name = identified(method, variant, events, projection, build.options, build.target)
        self.variant = variant
        self._loaded = build.extended(name, printer)
        self.call = _RUN(self._loaded.address("run"))
        facts = (ctypes.c_int64 * (1 + len(BLOCKS) + len(PLACES)))()
        ctypes.CFUNCTYPE(None, ctypes.c_void_p)(self._loaded.address("facts"))(ctypes.addressof(facts))
        self.slots, *rest = facts
        self._shared = rest[: len(BLOCKS)]
        self.places = dict(zip(PLACES, rest[len(BLOCKS) :], strict=True))

    def space(self) -> NDArray[np.float64]:
        """Work space for a range of runs, with empty lanes."""
        return aligned_to(8 * self.variant.lanes, self.slots * self.variant.lanes)

    def shared(self, p: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """The results that depend only on one parameter set for all runs, for the table."""
        blocks = {}
        for (entry, name), count in zip(BLOCKS.items(), self._shared, strict=True):
            block = blocks[entry] = aligned(count)
            if count and not self.variant.own:
                given = aligned(len(p))
                given[:] = p
                scratch = self.space()
                _TAPE(self._loaded.address(name))(address(given), None, address(block), address(scratch))
        return blocks


BLOCKS = {
    "shared": "body_prologue_1",
    "guard_shared": "guard_prologue_1",
    "after_shared": "after_prologue_1",
    "bounds_shared": "bounds_prologue_1",
    "approach_shared": "approach_prologue_1",
    "landing_shared": "landing_prologue_1",
}
"""Entries of the table and the functions that fill what they point to."""


def identified(
    method: Method,
    variant: IntegratorVariant,
    events: Events | None,
    projection: Projection | None,
    options: Options,
    target: Target,
) -> str:
    """A text that identifies everything around the right-hand side, in the key of the code."""
    text = f"{method.name} {method.order} {variant!r} {_printer_version()} "
    if events is not None:
        text += f"{fingerprint(events.program, options, target)} {(events.direction, events.terminal, events.reset)}"
    if projection is not None:
        known = (
            None if program is None else fingerprint(program, options, target)
            for program in (projection.position, projection.velocity)
        )
        text += f" {list(known)} {projection.corrects} {projection.joint}"
    return text


def aligned_to(size: int, count: int) -> NDArray[np.float64]:
    """Zeros that start at a multiple of ``size`` bytes, which is at least a cache line."""
    size = max(size, 64)
    raw = np.zeros(8 * count + size, np.uint8)
    start = -address(raw) % size
    return raw[start : start + 8 * count].view(np.float64)


def build_of(program: Program, lanes: int, keep: bool) -> Build:
    """The build of the modules for a program's integrators."""
    return Build(program, Options(lanes, ("p",), keep=keep), native.host())
