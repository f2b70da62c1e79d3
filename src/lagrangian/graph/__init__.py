"""The expression graph: building, differentiating, evaluating it, and `Program`, on which everything else is built."""

from lagrangian.graph.autodiff import Tangents, backwards, gradient, hessian, jacobian, jvp, vjp
from lagrangian.graph.bounds import bends, bounds, states_read
from lagrangian.graph.evaluate import Valuation, evaluate
from lagrangian.graph.from_sympy import from_sympy, unknown_part
from lagrangian.graph.graph import Graph, operands
from lagrangian.graph.prime_point import NotAlgebraic, PrimePoint
from lagrangian.graph.program import Count, Output, Program, count_operations, count_program, reached
from lagrangian.graph.replace import copied, replaced
from lagrangian.graph.scalar import Scalar
from lagrangian.graph.to_sympy import to_sympy

__all__ = [
    "Count",
    "Graph",
    "NotAlgebraic",
    "Output",
    "PrimePoint",
    "Program",
    "Scalar",
    "Tangents",
    "Valuation",
    "backwards",
    "bends",
    "bounds",
    "copied",
    "count_operations",
    "count_program",
    "evaluate",
    "from_sympy",
    "gradient",
    "hessian",
    "jacobian",
    "jvp",
    "operands",
    "reached",
    "replaced",
    "states_read",
    "to_sympy",
    "unknown_part",
    "vjp",
]
