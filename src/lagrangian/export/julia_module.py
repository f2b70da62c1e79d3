"""Writes a system as a module of Julia."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.codegen.expressions import declared_values
from lagrangian.codegen.julia import JULIA_HELPERS, to_julia
from lagrangian.export.programs import coordinates_listed, named_programs, program_of, unit_table
from lagrangian.model import Model


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.jl``."""
    units, programs = unit_table(model), named_programs(model, stem, whole=True)
    functions = [to_julia(x, name=name, units=units) for name, x in programs.items()]
    head = [
        f"# The dynamics of a system with coordinates {coordinates_listed(model)}, for Julia 1.",
        "#",
        "# NOT RUN: no Julia was at hand. The formulas were read back and compared; the syntax was read by a parser.",
        "#",
        f'# include("{stem}.jl"); using .{_module(stem)}',
        f"# a = {stem}_forward(q, v, u, p, t)   # vectors in SI units, in the order listed above each function",
        "#",
        f"# For DifferentialEquations.jl: f(x, p, t) = {stem}_rhs(x, u, p, t). Numbers may be of any type, such",
        "# as those of ForwardDiff.jl. A result that is not finite is a DomainError.",
        "",
        f"module {_module(stem)}",
        "",
        "export " + ", ".join(programs),
        "",
    ]
    parameters = declared_values(program_of(model, "forward"))
    if parameters:
        parameters = ["const " + parameters[0], *parameters[1:], ""]
    return {f"{stem}.jl": "\n".join([*head, *parameters, JULIA_HELPERS, "", *functions, "end", ""])}


def _module(stem: str) -> str:
    """The name of the module: that of the file, unlike those of functions in capitals."""
    return stem[:1].upper() + stem[1:] + "Dynamics"
