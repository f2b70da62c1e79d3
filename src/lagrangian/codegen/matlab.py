"""Exports a Program as a function file of MATLAB and Octave, of many states at once: every state is a column.

Both compute with complex numbers where reals end, so that a root of a negative number times itself would be a number
again. The few functions with such an end have a real one of our own at the end of the file, which gives NaN there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from .expressions import BOTH_OR_EITHER, COMPARISONS, SUMS, Infix, SourceNotation, assignments
from .labels import comment, identifier, quoted, unit, word

if TYPE_CHECKING:
    from lagrangian.graph import Program

LONGEST_NAME = 63
"""The number of characters of a name that MATLAB reads; it ignores the others."""

INFIX: Infix = (
    SUMS
    | COMPARISONS
    | BOTH_OR_EITHER
    | {
        "mul": ("{0}.*{1}", 5, (5, 6)),
        "div": ("{0}./{1}", 5, (5, 6)),
        "neg": ("-{0}", 6, (7,)),
        "not": ("~{0}", 6, (8,)),
    }
)
OWN = {
    "sqrt": "real_sqrt", "log": "real_log", "asin": "real_asin", "acos": "real_acos", "acosh": "real_acosh",
    "atanh": "real_atanh", "pow": "real_power", "min": "smaller", "max": "larger", "select": "pick",
}  # fmt: skip
"""Operations that need a function of our own."""

CALLS = {
    kind: kind for kind in ("sin", "cos", "tan", "atan", "sinh", "cosh", "tanh", "asinh", "exp", "abs", "sign", "atan2")
} | OWN

MATLAB = SourceNotation(
    INFIX,
    CALLS,
    ("{0}.^{1}", 7, 8),
    element="{0}({1}, :)",
    first=1,
    nan="NaN",
    infinity="Inf",
    assignment="{0} = {1};",
    remark="  % {0}",
)

_PICK = """\
function y = pick(condition, a, b)
  n = ones(1, max([numel(condition), numel(a), numel(b)]));
  condition = condition & n;
  a = a.*n;
  y = b.*n;
  y(condition) = a(condition);
end
"""
_LIMITED = """\
function y = {0}(x)
  x({2}) = NaN;
  y = {1}(x);
end
"""
_COLUMNS = """\
function N = columns(N, x, rows, name)
  if size(x, 1) ~= rows
    error('columns:shape', '%s must have %d rows and a column for each state, not %d x %d', name, rows, size(x));
  elseif size(x, 2) ~= 1 && size(x, 2) ~= N && N ~= 1
    error('columns:shape', '%s has %d columns, and another argument %d', name, size(x, 2), N);
  end
  N = max(N, size(x, 2));
end
"""
_FUNCTIONS = {
    "columns": _COLUMNS,
    "pick": _PICK,
    "smaller": "function y = smaller(a, b)\n  y = pick(a <= b | a ~= a, a, b);\nend\n",
    "larger": "function y = larger(a, b)\n  y = pick(a >= b | a ~= a, a, b);\nend\n",
    "real_sqrt": _LIMITED.format("real_sqrt", "sqrt", "x < 0"),
    "real_log": _LIMITED.format("real_log", "log", "x < 0"),
    "real_asin": _LIMITED.format("real_asin", "asin", "abs(x) > 1"),
    "real_acos": _LIMITED.format("real_acos", "acos", "abs(x) > 1"),
    "real_acosh": _LIMITED.format("real_acosh", "acosh", "x < 1"),
    "real_atanh": _LIMITED.format("real_atanh", "atanh", "abs(x) > 1"),
    "real_power": """\
function y = real_power(a, b)
  y = abs(a).^b;
  y = pick(a < 0 & mod(b, 2) == 1, -y, y);
  y = pick(a < 0 & a > -Inf & b ~= round(b), NaN, y);
end
""",
}
_NEEDS = {"smaller": "pick", "larger": "pick", "real_power": "pick"}


def to_matlab(
    program: Program, *, name: str | None = None, checked: bool = True, units: Mapping[str, str] | None = None
) -> str:
    """The text of ``name.m``, a function of one array for each group: (n, N) for N states, or (n, 1).

    ``name`` is that of the function and of its file; by default ``lg_`` and the program's name. The last arguments may
    be omitted: inputs are 0 then, parameters have their declared values. ``checked``: a result that is not finite is an
    error. ``units``: the units of entries, by name, for
    the comment. Raises `ValueError` for a name that MATLAB does not read whole.
    """
    function = name if name is not None else "lg_" + word(program.name)
    if not (function.isascii() and function.isidentifier() and function[0] != "_" and len(function) <= LONGEST_NAME):
        raise ValueError(f"{function!r} cannot name a function of MATLAB")
    groups = [(identifier("in_", g, k), g, tuple(entries)) for k, (g, entries) in enumerate(program.inputs.items())]
    results = [identifier("out_", o, k) for k, o in enumerate(program.outputs)]
    shown = results[0] if len(results) == 1 else f"[{', '.join(results)}]"
    lines = [f"function {shown} = {function}({', '.join(c for c, _, _ in groups)})"]
    lines += _help(program, function, groups, results, units or {})
    lines += _prepared(program, function, groups)
    body, names = assignments(program, MATLAB)
    lines += ["  " + line for line in body]
    for c, (title, output) in zip(results, program.outputs.items(), strict=True):
        lines += _result(c, title, [names[i] for i in output.ids], output.shape, function if checked else None)
    lines.append("end")
    used = {"columns"} | {OWN[node[0]] for node in program.graph.nodes if node[0] in OWN}
    used |= {_NEEDS[x] for x in used if x in _NEEDS}
    return "\n".join([*lines, "", *(text for key, text in _FUNCTIONS.items() if key in used)])


def _help(
    program: Program,
    function: str,
    groups: Sequence[tuple[str, str, tuple[str, ...]]],
    results: Sequence[str],
    units: Mapping[str, str],
) -> list[str]:
    """What ``help`` shows: the arguments with their entries, and the results."""
    lines = [f"%{function.upper()}  {comment(program.name)}. Every state is a column; SI units."]
    for c, group, entries in groups:
        lines.append(f"%   {c}: {comment(group)}, {len(entries)} x N{'' if entries else ', empty'}")
        for k, entry in enumerate(entries, 1):
            shown = f" [{unit(units[entry])}]" if units.get(entry) else ""
            default = program.defaults.get(entry) if group == "p" else None
            value = f" = {default!r} unless given" if default is not None else ""
            lines.append(f"%     ({k}) {comment(entry)}{shown}{value}")
    for c, (title, output) in zip(results, program.outputs.items(), strict=True):
        lines.append(f"%   {c}: {comment(title)}, {' x '.join(str(n) for n in (*output.shape, 'N'))}")
    return lines


def _prepared(program: Program, function: str, groups: Sequence[tuple[str, str, tuple[str, ...]]]) -> list[str]:
    """Default values from the last argument on, and N, once the shapes are checked."""
    lines: list[str] = []
    for k, (c, group, entries) in enumerate(groups, 1):
        values = [program.defaults.get(entry) if group == "p" else 0.0 for entry in entries]
        if group in ("u", "p", "t") and None not in values:
            shown = "; ".join(MATLAB.literal(float(x))[0] for x in values if x is not None)
            lines.append(f"  if nargin < {k}, {c} = {f'[{shown}]' if entries else 'zeros(0, 1)'}; end")
        else:
            lines.append(f"  if nargin < {k}, error('{function}:missing', '{c} is missing'); end")
    lines.append("  N = 1;")
    lines += [f"  N = columns(N, {c}, {len(entries)}, '{c}');" for c, _, entries in groups if entries]
    return lines


def _result(c: str, title: str, names: Sequence[str], shape: tuple[int, ...], function: str | None) -> list[str]:
    """A result is filled column by column of its matrix, given its shape, and checked for the function of this name."""
    order = range(len(names))
    if len(shape) == 2:
        order = [i * shape[1] + k for k in range(shape[1]) for i in range(shape[0])]
    lines = [f"  {c} = zeros({len(names)}, N);"]
    lines += [f"  {c}({row}, :) = {names[k]};" for row, k in enumerate(order, 1)]
    if len(shape) == 2:
        lines.append(f"  {c} = reshape({c}, {shape[0]}, {shape[1]}, N);")
    if function is None:
        return lines
    return lines + [
        f"  if ~all(isfinite({c}(:)))",
        f"    error('{function}:notFinite', {quoted(title + ' is not finite')});",
        "  end",
    ]
