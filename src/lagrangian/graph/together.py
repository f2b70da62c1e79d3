"""The interpreter for many places at once: every operation computes an array with one number for each place."""

# NumPy's functions are called by their names:
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# pyright: reportUnknownLambdaType=false

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from lagrangian.graph.evaluate import DOUBLE, Table, computed
from lagrangian.graph.graph import UNARY
from lagrangian.graph.program import Program

Array = NDArray[np.float64]

OTHERWISE = {
    "asin": "arcsin",
    "acos": "arccos",
    "atan": "arctan",
    "asinh": "arcsinh",
    "acosh": "arccosh",
    "atanh": "arctanh",
}
"""NumPy's names of functions that it names differently."""

ARRAYS: Table = {
    **DOUBLE,
    **{name: getattr(np, OTHERWISE.get(name, name)) for name in UNARY},
    "div": np.divide,
    "pow": np.power,
    "powi": lambda a, n: np.power(a, float(n)),
    "sign": np.sign,
    "atan2": np.arctan2,
    "min": lambda a, b: np.where((a != a) | (a <= b), a, b),
    "max": lambda a, b: np.where((a != a) | (a >= b), a, b),
    "and": np.logical_and,
    "or": np.logical_or,
    "not": np.logical_not,
    "select": np.where,
}


def evaluate_together(program: Program, inputs: Mapping[str, Sequence[Array | float]]) -> dict[str, Array]:
    """The outputs at many places, (places, …) each, in double precision with infinities and NaN.

    ``inputs`` has for every entry of every group the numbers at the places, (places,), or one number for all of them.
    """
    count = max((np.size(x) for group in inputs.values() for x in group), default=1)
    with np.errstate(all="ignore"):
        found = computed(program, inputs, ARRAYS, np.asarray)
    return {
        name: np.array([np.broadcast_to(x, count) for x in found[name]], float).T.reshape(count, *out.shape)
        for name, out in program.outputs.items()
    }
