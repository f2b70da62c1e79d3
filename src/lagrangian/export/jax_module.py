"""Writes a system as a module of JAX: functions for jit, grad and vmap."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.codegen.expressions import declared_values
from lagrangian.codegen.jax_source import to_jax
from lagrangian.export.programs import coordinates_listed, named_programs, program_of, unit_table
from lagrangian.model import Model

RUN_WITH = "JAX 0.10"
"""What such modules were run with."""


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.py``."""
    units = unit_table(model)
    functions = [to_jax(x, name=name, units=units) for name, x in named_programs(model, stem, whole=True).items()]
    head = f'''"""The dynamics of a system with coordinates {coordinates_listed(model)}, for JAX.

The functions take arrays of shape (..., n) in SI units, and jax.jit, jax.vmap, jax.grad and jax.jacfwd apply to them.
JAX computes with single precision unless jax.config.update("jax_enable_x64", True) comes before everything else.
Results are not checked: where one is not finite, it is returned as it is. Run with {RUN_WITH}.
"""'''
    parameters = "\n".join(declared_values(program_of(model, "forward")))
    return {
        f"{stem}.py": "\n\n".join(x for x in (head, "import jax.numpy as jnp", parameters, *_spaced(functions)) if x)
    }


def _spaced(functions: list[str]) -> list[str]:
    """Functions with two empty lines before each."""
    return ["\n" + function.rstrip("\n") for function in functions[:-1]] + ["\n" + functions[-1]]
