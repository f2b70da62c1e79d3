"""Exports a Program as a Python function of JAX arrays, which can be compiled, differentiated and mapped.

The function has no side effects and no condition on values, so that ``jax.jit``, ``jax.grad`` and ``jax.vmap`` apply.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from .arguments import is_scalar
from .expressions import SourceArgument, arguments_of, assignments, signature
from .labels import comment
from .numpy_source import CALLS, NUMPY

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lagrangian.graph import Program

JAX = replace(NUMPY, calls={kind: f"jnp.{name}" for kind, name in CALLS.items()}, nan="jnp.nan", infinity="jnp.inf")


def to_jax(program: Program, *, name: str, units: Mapping[str, str] | None = None) -> str:
    """The text of a function of one array for each group, each of shape (..., n), to stand in a module.

    The module has imported ``jax.numpy`` as ``jnp``, and ``PARAMETERS`` are the declared values if all are known.
    ``units``: the units of entries, by name, for the docstring. Raises `ValueError` for a name that is none.
    """
    if not (name.isascii() and name.isidentifier()):
        raise ValueError(f"{name!r} cannot name a Python function")
    groups = arguments_of(program)
    lines = [f"def {name}({signature(program, groups)}):"]
    lines += _docstring(program, groups, units or {})
    for g in groups:
        lines.append(f"    {g.word} = jnp.asarray({g.word}, dtype=float)")
        if is_scalar(g.group, g.entries):
            lines.append(f"    {g.word} = {g.word}[..., jnp.newaxis]")
        lines.append(f"    if {g.word}.shape[-1:] != ({len(g.entries)},):")
        shape = f"(..., {len(g.entries)})"
        lines.append(f'        raise ValueError(f"{g.word} must have shape {shape}, not {{{g.word}.shape}}")')
    lines.append(f"    lead = jnp.broadcast_shapes({', '.join(f'{g.word}.shape[:-1]' for g in groups)})")
    body, names = assignments(program, JAX)
    lines += ["    " + line for line in body]
    answers = []
    for k, output in enumerate(program.outputs.values()):
        listed = ", ".join(names[i] for i in output.ids)
        shape = "".join(f", {n}" for n in output.shape)
        if output.ids:
            lines.append(f"    out{k} = jnp.stack([jnp.broadcast_to(y, lead) for y in ({listed},)], axis=-1)")
        else:
            lines.append(f"    out{k} = jnp.zeros((*lead, 0))")
        answers.append(f"out{k}.reshape((*lead{shape},))" if output.shape else f"out{k}[..., 0]")
    return "\n".join([*lines, f"    return {', '.join(answers)}"]) + "\n"


def _docstring(program: Program, groups: tuple[SourceArgument, ...], units: Mapping[str, str]) -> list[str]:
    """The arguments with their entries, and the results."""
    lines = [f'    """{comment(program.name)}, of arrays of shape (..., n); leading dimensions are broadcast.', ""]
    for g in groups:
        shape = "(...)" if is_scalar(g.group, g.entries) else f"(..., {len(g.entries)})"
        lines.append(f"    {g.word}: {shape} {g.described(units)}".rstrip())
    for title, output in program.outputs.items():
        lines.append(f"    returns {comment(title)}: (...{''.join(f', {n}' for n in output.shape)})")
    return [*lines, '    """']
