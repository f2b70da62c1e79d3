"""Writes a system as a module of Python that needs NumPy alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from lagrangian import codegen as machine
from lagrangian.codegen.expressions import declared_values
from lagrangian.codegen.labels import comment
from lagrangian.errors import Error
from lagrangian.export.programs import named_programs, program_of
from lagrangian.export.start import start_of
from lagrangian.model import Model


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.py``, functions of NumPy arrays; it runs as it is where all parameters have values."""
    functions = [_renamed(machine.to_numpy(program), name) for name, program in named_programs(model, stem).items()]
    names = ", ".join(comment(c.name) for c in model.coordinates)
    first = f'"""The dynamics of a system with coordinates {names}."""'
    parameters = declared_values(program_of(model, "forward"))
    head = "\n".join([first, "", "import numpy as np", *(["", *parameters] if parameters else [])])
    return {f"{stem}.py": "\n\n\n".join([head, *(x.rstrip("\n") for x in functions), *_shown(model, stem)]) + "\n"}


def _shown(model: Model, stem: str) -> Iterator[str]:
    """What the file does when it is run: the accelerations at the start of the model, or why it does nothing."""
    try:
        start = start_of(model)
    except Error as error:
        yield f"# run as it is, this file does nothing: {comment(error.what)}"
        return
    n = len(model.coordinates)
    yield "\n".join(
        [
            'if __name__ == "__main__":  # the state in which the model starts',
            f"    q = {[*start.x[:n]]!r}",
            f"    v = {[*start.x[n : n + len(model.velocities)]]!r}",
            f"    u = {[*start.u]!r}",
            f"    print({stem}_forward(q, v, u))",
        ]
    )


def _renamed(module: str, name: str) -> str:
    """Rename the only function of a module."""
    body = module[module.index("\ndef ") + 1 :]
    return f"def {name}" + body[body.index("(") :]
