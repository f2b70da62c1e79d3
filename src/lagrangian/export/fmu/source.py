"""The C source of an FMU: the equations as functions, numbers, the instance, and the functions of the standard."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from importlib.resources import files
from typing import Literal

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.codegen.labels import comment
from lagrangian.export.fmu.variables import FmuVariable
from lagrangian.export.programs import coordinates_listed, program_of
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


def equations(model: Model) -> dict[str, Program]:
    """The programs of an FMU by the names of their functions."""
    found = {"eq_rhs": program_of(model, "rhs"), "eq_energy": program_of(model, "energy")}
    if not model.constraints:
        return found
    position, velocity = dynamics.projection(model)
    found["eq_multipliers"] = program_of(model, "multipliers")
    found |= {"eq_position": position} if position is not None else {}
    return found | ({"eq_velocity": velocity} if velocity is not None else {})


def source(model: Model, variables: Sequence[FmuVariable], standard: Standard, token: str) -> str:
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
    body = [_function(program, name) for name, program in programs.items()]
    parts = [_text("instance"), _text(f"fmi{standard}")]
    return "\n".join([*head, *_numbers(model, variables, programs, token), *body, *parts])


def token_of(model: Model, variables: Sequence[FmuVariable], standard: Standard) -> str:
    """A GUID made of everything that the source contains: equal sources have equal ones."""
    found = hashlib.sha256(repr(variables).encode())
    found.update(source(model, variables, standard, "").encode())
    text = found.hexdigest()
    return "{" + "-".join((text[:8], text[8:12], text[12:16], text[16:20], text[20:32])) + "}"


def _text(name: str) -> str:
    return (files("lagrangian.export.fmu") / f"{name}.c").read_text(encoding="utf-8")


def _function(program: Program, name: str) -> str:
    """A program as a static function, without the includes of its own file."""
    code, _ = machine.to_c(program, name=name)
    return code.split("#include <math.h>\n", 1)[1].replace(f"void {name}(", f"static void {name}(")


def _numbers(model: Model, variables: Sequence[FmuVariable], programs: dict[str, Program], token: str) -> list[str]:
    """Sizes, starts and the table of the method."""
    nq, nv = len(model.coordinates), len(model.velocities)
    lam = len(programs["eq_multipliers"].ids) if "eq_multipliers" in programs else 0
    sizes = {"NQ": nq, "NX": nq + nv, "NU": len(model.inputs), "NP": len(model.parameters), "NL": lam}
    sizes |= {"HAS_POSITION": int("eq_position" in programs), "HAS_VELOCITY": int("eq_velocity" in programs)}
    lines = [f"#define {name} {value}" for name, value in sizes.items()]
    lines += [f'#define TOKEN "{token}"', "#define START_TIME 0.0", f"#define TOLERANCE {TOLERANCE!r}", ""]
    for name, role in (("x", "state"), ("u", "input"), ("p", "parameter")):
        starts = [v.start for v in variables if v.role == role]
        listed = ", ".join([*(repr(float(s or 0.0)) for s in starts), "0.0"])
        lines.append(f"static const double start_{name}[{len(starts) + 1}] = {{{listed}}};")
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
