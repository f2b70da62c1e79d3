"""Compiles a Program to machine code with LLVM, or exports it as C99, JavaScript or NumPy source."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from lagrangian.errors import RunError
from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from lagrangian.graph import Program

    from .brief import brief_javascript
    from .buffers import Look, RawFunction, aligned
    from .build import Build, Options
    from .c99 import to_c
    from .javascript import to_javascript
    from .kernel import Kernel
    from .matlab import to_matlab
    from .numpy_source import to_numpy
else:
    __getattr__ = lazily(
        __name__,
        {
            "brief": "brief_javascript",
            "build": "Build Options",
            "c99": "to_c",
            "javascript": "to_javascript",
            "kernel": "Kernel",
            "matlab": "to_matlab",
            "numpy_source": "to_numpy",
            "buffers": "Look RawFunction aligned",
        },
    )

__all__ = [
    "Build",
    "Kernel",
    "Look",
    "Options",
    "RawFunction",
    "aligned",
    "brief_javascript",
    "compile",
    "to_c",
    "to_javascript",
    "to_matlab",
    "to_numpy",
]


def compile(
    program: Program,
    *,
    hoist: Iterable[str] = ("p",),
    optional: Mapping[str, float] | None = None,
    lanes: int | None = None,
    threads: int | None = None,
    keep: bool = True,
) -> Kernel:
    """Compile ``program``; machine code is made at the first call of each kind (one state, many, one parameter set
    each).

    ``hoist``: groups that are the same for many states; what depends only on them is computed once per set.
    ``optional``: groups that may be omitted, with the values that their entries then have. ``lanes``: the number of
    states computed side by side in a batch (1, 2, 4, 8; by default as many as the processor can). ``threads``: the
    number of cores for a large batch (by default all). ``keep``: cache the code on disk.

    >>> from lagrangian.graph import Graph, Output, Program
    >>> g = Graph()
    >>> x, k = g.input("q", 0), g.input("p", 0)
    >>> inputs, outputs = {"q": ("x",), "p": ("k",)}, {"force": Output((g.mul(k, x),), (1,))}
    >>> spring = compile(Program("spring", g, inputs, outputs, {"k": 40.0}))
    >>> spring([0.5])
    array([20.])
    >>> spring([[0.5], [0.25]], p={"k": 8.0})
    array([[4.],
           [2.]])
    """
    from . import native  # imported here because exporting source code does not need LLVM
    from .build import Build, Options
    from .kernel import Kernel

    target = native.host()
    width = target.lanes if lanes is None else lanes
    if type(width) is not int or width not in (1, 2, 4, 8):
        raise RunError(f"lanes must be 1, 2, 4 or 8 (got {lanes!r})", code="E501")
    if threads is not None and (type(threads) is not int or threads < 1):
        raise RunError(f"threads must be a whole number, at least 1 (got {threads!r})", code="E501")
    build = Build(program, Options(width, tuple(hoist), keep=keep), target)
    return Kernel(build, optional=optional or {}, threads=threads)
