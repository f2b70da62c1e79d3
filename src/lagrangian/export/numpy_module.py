"""Writes a system as a module of Python that needs NumPy alone."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian import codegen as machine
from lagrangian.export.programs import named_programs
from lagrangian.model import Model


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.py``, functions of NumPy arrays."""
    functions = [_renamed(machine.to_numpy(program), name) for name, program in named_programs(model, stem).items()]
    first = f'"""The dynamics of a system with coordinates {", ".join(c.name for c in model.coordinates)}."""'
    return {f"{stem}.py": f"{first}\n\nimport numpy as np\n\n\n" + "\n\n".join(functions)}


def _renamed(module: str, name: str) -> str:
    """Rename the only function of a module."""
    body = module[module.index("\ndef ") + 1 :]
    return f"def {name}" + body[body.index("(") :]
