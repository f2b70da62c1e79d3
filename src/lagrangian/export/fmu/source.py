"""The C source of an FMU: the equations as functions, numbers, the instance, and the functions of the standard."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from importlib.resources import files
from typing import Literal

from lagrangian.codegen.labels import comment
from lagrangian.export.equations import equations, sizes_and_starts, static_function
from lagrangian.export.fmu.variables import FmuVariable
from lagrangian.export.programs import coordinates_listed
from lagrangian.export.start import start_of
from lagrangian.graph import Program
from lagrangian.integrate import METHODS
from lagrangian.integrate.methods.explicit import Explicit
from lagrangian.model import Model

Standard = Literal[2, 3]
"""The version of FMI."""

METHOD = "dop853"
"""The method that a co-simulation takes its steps by."""

TOLERANCE = 1e-9
"""The tolerance of these steps unless the importing program gives one."""


def source(model: Model, standard: Standard, token: str) -> str:
    """The whole source file. ``token`` is the GUID of the model description."""
    programs = equations(model)
    head = [
        f"/* The dynamics of a system with coordinates {coordinates_listed(model)}, for FMI {standard}.0.",
        "",
        "   One file that needs the headers of C99 alone. The importing program compiles it, or this command:",
        "     cc -std=c99 -O2 -shared -fPIC -o NAME.so THIS.c -lm",
        f"   System: {comment(model.name)} */",
        "",
        "#include <math.h>",
        "#include <stdlib.h>",
        "#include <string.h>",
        "",
        "#ifdef _WIN32",
        "#define EXPORTED __declspec(dllexport)",
        "#else",
        "#define EXPORTED",
        "#endif",
        "",
    ]
    body = [static_function(program, name) for name, program in programs.items()]
    parts = [_text("instance"), _text(f"fmi{standard}")]
    return "\n".join([*head, *_numbers(model, programs, token), *body, *parts])


def token_of(model: Model, variables: Sequence[FmuVariable], standard: Standard) -> str:
    """A GUID made of everything that the source contains: equal sources have equal ones."""
    found = hashlib.sha256(repr(variables).encode())
    found.update(source(model, standard, "").encode())
    text = found.hexdigest()
    return "{" + "-".join((text[:8], text[8:12], text[12:16], text[16:20], text[20:32])) + "}"


def _text(name: str) -> str:
    return (files("lagrangian.export.fmu") / f"{name}.c").read_text(encoding="utf-8")


def _numbers(model: Model, programs: dict[str, Program], token: str) -> list[str]:
    """Sizes, starts and the table of the method."""
    lines = [*sizes_and_starts(model, start_of(model), programs), ""]
    lines += [f'#define TOKEN "{token}"', "#define START_TIME 0.0", f"#define TOLERANCE {TOLERANCE!r}"]
    method = METHODS[METHOD]
    assert isinstance(method, Explicit)
    table, n = method.table, len(method.table.c)
    rows = ",\n".join("  {" + _listed((*row, *[0.0] * (n - len(row)))) + "}" for row in table.a)
    lines += ["", f"#define RK_STAGES {n}", f"static const double RK_C[{n}] = {{{_listed(table.c)}}};"]
    lines.append(f"static const double RK_A[{n}][{n}] = {{\n{rows}}};")
    for name, row in (("B", table.b), ("FIFTH", table.errors[0]), ("THIRD", table.errors[1])):
        lines.append(f"static const double RK_{name}[{n}] = {{{_listed(row)}}};")
    return [*lines, ""]


def _listed(row: Sequence[float]) -> str:
    return ", ".join(repr(float(x)) for x in row)
