"""The equations of a run as functions of C in one file: what FMUs and S-functions have in common."""

from __future__ import annotations

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.errors import ModelError
from lagrangian.export.programs import program_of
from lagrangian.export.start import Start
from lagrangian.graph import Program
from lagrangian.model import Model


def equations(model: Model) -> dict[str, Program]:
    """The programs of a run by the names of their functions.

    ``eq_rhs``, ``eq_energy`` and, with constraints, ``eq_multipliers``, and ``eq_position`` and ``eq_velocity``, which
    correct a state that misses them.
    """
    found = {"eq_rhs": program_of(model, "rhs"), "eq_energy": program_of(model, "energy")}
    if not model.constraints:
        return found
    position, velocity = dynamics.projection(model)
    found["eq_multipliers"] = program_of(model, "multipliers")
    found |= {"eq_position": position} if position is not None else {}
    return found | ({"eq_velocity": velocity} if velocity is not None else {})


def static_function(program: Program, name: str) -> str:
    """A program as a static function, without the includes of its own file."""
    code, _ = machine.to_c(program, name=name)
    return code.split("#include <math.h>\n", 1)[1].replace(f"void {name}(", f"static void {name}(")


def sizes_and_starts(model: Model, start: Start, programs: dict[str, Program]) -> list[str]:
    """The numbers of entries, and the values with which a run begins; no array is empty."""
    nq, nv = len(model.coordinates), len(model.velocities)
    lam = len(programs["eq_multipliers"].ids) if "eq_multipliers" in programs else 0
    sizes = {"NQ": nq, "NX": nq + nv, "NU": len(model.inputs), "NP": len(model.parameters), "NL": lam}
    sizes |= {"HAS_POSITION": int("eq_position" in programs), "HAS_VELOCITY": int("eq_velocity" in programs)}
    lines = [f"#define {name} {value}" for name, value in sizes.items()]
    for name, values in (("x", start.x), ("u", start.u), ("p", start.p)):
        listed = ", ".join([*map(repr, values), "0.0"])
        lines.append(f"static const double start_{name}[{len(values) + 1}] = {{{listed}}};")
    return lines


def check_values(model: Model, what: str) -> None:
    """Raise `ModelError` for a parameter without a value, of which ``what`` needs a start."""
    for p in model.parameters:
        if p.value is None:
            raise ModelError(
                f"parameter '{p.name}' has no value, and {what} needs the start of every parameter",
                place=p.place,
                fix="declare a value; the program that runs it can change it",
                code="E401",
            )
