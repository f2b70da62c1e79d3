"""WebAssembly: the target for LLVM, and modules made from printed functions, cached on disk like machine code.

A module imports its memory, stack pointer and, if it needs them, functions of the C library: sine and cosine of huge
angles, powers and inverse hyperbolic functions. The host supplies the latter from JavaScript's ``Math``.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Iterable
from functools import cache

from . import cache as disk
from . import native
from .elementary import LIBM
from .ir import Module, Target
from .wasm_link import Linked, linked

_log = logging.getLogger(__name__)
LANES = 2
"""Doubles in a vector register of WebAssembly."""

LEVEL = 2
"""LLVM's optimization level."""

FEATURES = "+simd128,+sign-ext,+bulk-memory,+nontrapping-fptoint"
"""Extensions of the first WebAssembly that every browser has had since 2023."""

IMPORTS = frozenset(("Math", name) for name in LIBM)
"""The functions that a module may import."""


ADDRESS = re.compile(r"getelementptr ([\w<> ]+), ptr (%\w+), i64 (?=\d+$)", re.MULTILINE)
"""An address at a constant distance from another."""

SAYS_UNSIGNED = 20
"""The first version of LLVM in which an address can say that its sum does not wrap."""


@cache
def target() -> Target:
    """WebAssembly with 32-bit addresses: vectors of two doubles, and no fused multiply-add."""
    splat = native.host().splat
    return Target("wasm32-unknown-unknown", "generic", FEATURES, False, LANES, splat, imports=True)


def compiled(printer: Callable[[Module], None], exports: Iterable[str], key: str = "") -> Linked:
    """Compile what ``printer`` prints into a module, and link it so that it exports the functions ``exports``.

    ``key`` identifies the text in the cache on disk; without one, nothing is cached. Raises `RunError` if LLVM cannot
    make WebAssembly, and `LinkError` for a symbol that neither the module nor the host has.
    """
    kept = disk.read(f"{key}-wasm") if key else None
    if kept is None:
        module = Module(target())
        printer(module)
        _log.info("making a module of WebAssembly")
        kept = native.object_code(_folding(module.text()), target(), LEVEL)
        if key:
            disk.write(f"{key}-wasm", kept)
    return linked(kept, exports, IMPORTS)


def _folding(text: str) -> str:
    """The same code, in which constant distances become a part of loads and stores instead of sums: every base lies in
    the host's memory and every distance is within its buffer, so no sum wraps."""
    if native.llvm.llvm_version_info[0] < SAYS_UNSIGNED:
        return text
    return ADDRESS.sub(r"getelementptr inbounds nuw \1, ptr \2, i64 ", text)
