"""Writes a system as C99: one source file with its header."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian import codegen as machine
from lagrangian.export.programs import named_programs
from lagrangian.model import Model


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.c`` and ``stem.h``."""
    codes, headers = [], []
    for name, program in named_programs(model, stem).items():
        code, header = machine.to_c(program, name=name)
        codes.append(code.replace(f'#include "{name}.h"', f'#include "{stem}.h"'))
        headers.append(header)
    return {f"{stem}.c": "\n".join(codes), f"{stem}.h": "\n".join(headers)}
