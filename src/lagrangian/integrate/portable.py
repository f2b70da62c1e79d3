"""An integrator as a module of WebAssembly, with the same steps, events and projection as in machine code.

The module has the functions ``run(table, work, budget)`` and ``facts(place)``. What the host needs to fill their
memory is in ``layout``; the scripts in the folder ``browser`` are a host.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import asdict
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from lagrangian.codegen import Options, wasm
from lagrangian.codegen.build import fingerprint
from lagrangian.codegen.ir import Module
from lagrangian.errors import RunError, did_you_mean
from lagrangian.records import dataclass

from . import check
from .machine import BLOCKS, identified
from .methods import METHODS, memory_layout
from .methods.events import ROUNDS
from .methods.loop import IntegratorVariant, Loop
from .projection import DRIFT, Projection
from .solver import BUDGET

if TYPE_CHECKING:
    from lagrangian.graph import Program

    from .problem import Events

STACK = 1 << 16
"""Bytes of the stack, on which functions pass pairs of results."""

HEAD = {"cursor": memory_layout.CURSOR, "last": memory_layout.LAST, "logged": memory_layout.LOGGED,
        "quit": memory_layout.QUIT, "log": memory_layout.LOG, "room": memory_layout.ROOM}  # fmt: skip
"""Words at the head of the work space that the host reads or writes."""


PARTS = ("about", "arguments", "signals", "sticking", "solver", "machine", "fallback")
"""The files of the driver, each after those whose functions it uses."""

DRIVER = ("makeSolver", "makeFallback", "load")
"""What the driver offers."""


@dataclass(frozen=True)
class PortableIntegrator:
    """A module's ``code``, and the ``layout`` of its memory as plain data."""

    code: bytes
    layout: Mapping[str, Any]


def portable(
    program: Program,
    method: str,
    *,
    events: Events | None = None,
    projection: Projection | None = None,
    signals: bool = False,
    lanes: int = 1,
    tolerance: float = 1e-12,
    keep: bool = True,
) -> PortableIntegrator:
    """Compile an integrator of ``program`` to WebAssembly; the arguments are those of `Solver`.

    ``signals``: inputs are piecewise linear in time, instead of constant. ``tolerance``: the relative tolerance of a
    step, which decides the order of Taylor's method. ``keep``: cache the module on disk.

    Raises `RunError` if the program, the method or the events do not fit together.
    """
    if method not in METHODS:
        hint = did_you_mean(str(method), METHODS) or f"known: {', '.join(METHODS)}"
        raise RunError(f"there is no method '{method}'", code="E402", fix=hint)
    check.suits(METHODS[method], program)
    chosen = METHODS[method].suited(tolerance)
    events = None if events is None else events.checked(program)
    projection = None if projection is None else projection.checked(program)
    variant = IntegratorVariant(lanes, True, signals, events is not None)

    def printer(module: Module) -> None:
        Loop(module, program, chosen, variant, events, projection).print()

    key = ""
    if keep:
        options, target = Options(lanes), wasm.target()
        text = fingerprint(program, options, target)
        text += identified(chosen, variant, events, projection, options, target)
        key = hashlib.sha256(text.encode()).hexdigest()
    made = wasm.compiled(printer, ("run", "facts"), key)
    cost = len(program.graph.nodes) * chosen.cost + sum(
        len(p.graph.nodes) for p in (projection.programs if projection is not None else ())
    )
    layout = {
        **asdict(variant),
        "size": len(program.inputs["x"]),
        "data": made.data,
        "stack": STACK,
        "rounds": 3 * ROUNDS,
        "drift": list(DRIFT),
        "facts": ["slots", *BLOCKS, *memory_layout.PLACES],
        "done": memory_layout.DONE,
        "running": memory_layout.RUNNING,
        "ended": memory_layout.ENDED,
        "budget": max(1, BUDGET // max(1, cost)),
        "head": HEAD,
        "table": list(memory_layout.TABLE),
    }
    return PortableIntegrator(made.code, layout)


def driver() -> str:
    """A plain script that defines ``lagrangianSolver``, which runs such modules in a browser, a worker or Node."""
    folder = files("lagrangian.integrate") / "browser"
    about, *parts = ((folder / f"{name}.js").read_text(encoding="utf-8").rstrip() for name in PARTS)
    head = [about, '"use strict";', "", "const lagrangianSolver = (() => {"]
    return "\n\n".join(["\n".join(head), *parts, f"return {{ {', '.join(DRIVER)} }};\n}})();\n"])
