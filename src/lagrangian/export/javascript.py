"""Writes a system as JavaScript, for pages, workers and Node."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian import codegen as machine
from lagrangian.codegen.labels import comment
from lagrangian.export.programs import named_programs, unit_table
from lagrangian.model import Model


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.js``, a script of JavaScript that is also a module of Node."""
    programs = named_programs(model, stem)
    names = ", ".join(comment(c.name) for c in model.coordinates)
    head = [
        f"/* The dynamics of a system with coordinates {names}.",
        "",
        "   A plain script for pages, workers and Node (require), without dependencies. Every function takes arrays in",
        "   the order listed above it, in SI units, and the time as a number. It returns a Float64Array with all its",
        "   results, one after another; one that is passed as the last argument is filled and returned. A result that",
        "   is not finite is thrown as a RangeError.",
        "",
        "   `lagrangian verify` runs these functions in Node at random states. It compares them with the formulas they",
        "   were made from, and these with the equations that were derived by another route. */",
        '"use strict";',
        "",
    ]
    table = unit_table(model)
    functions = [machine.to_javascript(program, name=name, units=table) for name, program in programs.items()]
    tail = f'if (typeof module !== "undefined") module.exports = {{ {", ".join(programs)} }};'
    return {f"{stem}.js": "\n".join([*head, *functions, tail, ""])}
