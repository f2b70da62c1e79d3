"""Exports a Program as a Python function that makes a ``casadi.Function`` of symbols SX, with its derivatives."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .expressions import COMPARISONS, PRODUCTS, SUMS, Infix, SourceNotation, arguments_of, assignments
from .labels import WORD, comment, identifier
from .numpy_source import POWER

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lagrangian.graph import Program

INFIX: Infix = SUMS | PRODUCTS | COMPARISONS | {"neg": ("-{0}", 6, (6,)), "pow": ("{0}**{1}", 7, (8, 8))}
CALLS = {
    kind: f"ca.{kind}"
    for kind in (
        "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh",
        "exp", "log", "sign", "atan2",
    )
} | {
    "abs": "ca.fabs", "and": "ca.logic_and", "or": "ca.logic_or", "not": "ca.logic_not", "select": "ca.if_else",
    "min": "_smaller", "max": "_larger",
}  # fmt: skip

CASADI = SourceNotation(
    INFIX,
    CALLS,
    POWER,
    element="{0}[{1}]",
    first=0,
    nan="ca.nan",
    infinity="ca.inf",
    assignment="{0} = {1}",
    remark="  # {0}",
)

CASADI_HELPERS = '''\
def _smaller(a, b):
    """The smaller of two; where a is not a number, neither is the result, unlike that of fmin."""
    return ca.if_else(ca.logic_or(a <= b, a != a), a, b)


def _larger(a, b):
    """The larger of two; where a is not a number, neither is the result, unlike that of fmax."""
    return ca.if_else(ca.logic_or(a >= b, a != a), a, b)
'''
"""Functions that the module of `to_casadi` contains."""


def to_casadi(program: Program, *, name: str, units: Mapping[str, str] | None = None) -> str:
    """The text of a function without arguments that makes the Function ``name``, to stand in a module.

    The module has imported ``casadi`` as ``ca`` and contains `CASADI_HELPERS`. Arguments and results are columns,
    called by the names of the program's groups and outputs. ``units`` of entries, by name, are for the docstring.
    Raises `ValueError` for a name that CasADi does not take.
    """
    if not (WORD.fullmatch(name) or (name.isascii() and name.isidentifier())) or name[0] == "_" or "__" in name:
        raise ValueError(f"{name!r} cannot name a Function of CasADi")
    groups = arguments_of(program)
    given = [_called(g.group, k, "in") for k, g in enumerate(groups)]
    results = [_called(title, k, "out") for k, title in enumerate(program.outputs)]
    lines = [f"def {name}():", f'    """Make the Function of {comment(program.name)}: columns of SI units.', ""]
    for c, g in zip(given, groups, strict=True):
        lines.append(f"    {c}: {len(g.entries)} {g.described(units or {})}".rstrip())
    for c, output in zip(results, program.outputs.values(), strict=True):
        lines.append(f"    returns {c}: {' x '.join(str(n) for n in output.shape) or 'one number'}")
    lines.append('    """')
    lines += [f'    {g.word} = ca.SX.sym("{c}", {len(g.entries)})' for c, g in zip(given, groups, strict=True)]
    body, names = assignments(program, CASADI)
    lines += ["    " + line for line in body]
    for k, output in enumerate(program.outputs.values()):
        listed = f"ca.SX(ca.vertcat({', '.join(names[i] for i in output.ids)}))" if output.ids else "ca.SX(0, 1)"
        if len(output.shape) == 2:
            listed = f"ca.reshape({listed}, {output.shape[1]}, {output.shape[0]}).T"
        lines.append(f"    out{k} = {listed}")
    arguments = ", ".join(g.word for g in groups)
    answers = ", ".join(f"out{k}" for k in range(len(results)))
    lines.append(f'    return ca.Function("{name}", [{arguments}], [{answers}], {given!r}, {results!r})')
    return "\n".join(lines) + "\n"


def _called(name: str, k: int, other: str) -> str:
    """The name of an argument or a result: the program's own if it is a plain word."""
    return identifier("", name, k) if WORD.fullmatch(name) and "__" not in name else f"{other}{k}"
