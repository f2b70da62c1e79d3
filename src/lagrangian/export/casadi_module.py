"""Writes a system as a module that makes Functions of CasADi, which have derivatives of every order."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.codegen.casadi_source import CASADI_HELPERS, to_casadi
from lagrangian.codegen.expressions import declared_values
from lagrangian.export.programs import coordinates_listed, named_programs, program_of, unit_table
from lagrangian.model import Model

RUN_WITH = "CasADi 3.8"
"""What such modules were run with."""


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.py``."""
    units = unit_table(model)
    functions = [to_casadi(x, name=name, units=units) for name, x in named_programs(model, stem, whole=True).items()]
    head = f'''"""The dynamics of a system with coordinates {coordinates_listed(model)}, for CasADi.

Every function here makes a casadi.Function of columns in SI units: f = {stem}_forward(); f(q, v, u, p, t). Its
derivatives are f.jacobian(), or ca.jacobian of an expression that contains a call. PARAMETERS are the declared values
of p, if all are known. Run with {RUN_WITH}.
"""'''
    parameters = "\n".join(declared_values(program_of(model, "forward")))
    parts = [head, "import casadi as ca", parameters, "\n" + CASADI_HELPERS.rstrip("\n")]
    text = "\n\n".join([*(x for x in parts if x), *("\n" + function.rstrip("\n") for function in functions)])
    return {f"{stem}.py": text + "\n"}
