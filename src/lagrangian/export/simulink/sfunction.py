"""Writes a system as a C S-function of Simulink: continuous states, a port of inputs, ports of states and energies."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files as resources

from lagrangian.codegen.labels import comment, unit
from lagrangian.export.equations import check_values, equations, sizes_and_starts, static_function
from lagrangian.export.programs import coordinates_listed, unit_table
from lagrangian.export.start import start_of
from lagrangian.graph import Program, reached
from lagrangian.model import Model


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.c``, to be compiled by ``mex stem.c``.

    Raises `ModelError` for a parameter without a value.
    """
    check_values(model, "an S-function")
    programs = equations(model)
    programs.pop("eq_multipliers", None)  # they depend on inputs at once, and would close loops through every regulator
    head = [
        f"/* The dynamics of a system with coordinates {coordinates_listed(model)}, as an S-function of Simulink.",
        "",
        "   NOT RUN in Simulink: none was at hand. It was compiled and run against a stand-in of simstruc.h.",
        "",
        f"   In MATLAB: mex {stem}.c   Then an S-Function block with the name {stem} and the parameters [], [].",
        "   The first parameter holds the system's parameters, the second the state at the start; [] stands for the",
        "   values below. Port 1 of the outputs is x = [q; v], port 2 is [T; V]. SI units.",
        "",
        *_listed(model),
        "*/",
        "",
        f"#define S_FUNCTION_NAME {stem}",
        "#define S_FUNCTION_LEVEL 2",
        "",
        "#include <math.h>",
        '#include "simstruc.h"',
        "",
        f"#define ENERGY_READS_INPUTS {int(_reads_inputs(programs['eq_energy']))}",
    ]
    body = [static_function(program, name) for name, program in programs.items()]
    last = (resources("lagrangian.export.simulink") / "sfunction.c").read_text(encoding="utf-8")
    return {f"{stem}.c": "\n".join([*head, *sizes_and_starts(model, start_of(model), programs), "", *body, last])}


def _listed(model: Model) -> list[str]:
    """The order of states, inputs and parameters."""
    units, lines = unit_table(model), list[str]()
    for title, listed in (
        ("state", [*model.coordinates, *model.velocities]),
        ("input", model.inputs),
        ("parameter", model.parameters),
    ):
        for k, x in enumerate(listed, 1):
            shown = f" [{unit(units[x.name])}]" if units.get(x.name) else ""
            lines.append(f"     {title} {k}: {comment(x.name)}{shown}")
    return lines


def _reads_inputs(program: Program) -> bool:
    """Whether a result depends on an input of the system."""
    nodes = program.graph.nodes
    return any(nodes[i][:2] == ("input", "u") for i in reached(program.graph, program.ids))
