"""Writes a system for MATLAB and Octave: a function file for each program, and a script that shows the steps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lagrangian.codegen.labels import comment, quoted
from lagrangian.codegen.matlab import to_matlab
from lagrangian.errors import Error
from lagrangian.export.programs import exported, program_of, unit_table
from lagrangian.export.start import Start, start_of
from lagrangian.export.steps import step_sections
from lagrangian.model import Model

RUN_WITH = "Octave 7.3"
"""What these files were run with."""


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem_forward.m``, …: a function each; and ``stem_steps.m``, a script."""
    units, found = unit_table(model), dict[str, str]()
    for name in exported(model, whole=True):
        found[f"{stem}_{name}.m"] = to_matlab(program_of(model, name), name=f"{stem}_{name}", units=units)
    found[f"{stem}_steps.m"] = steps_script(model, stem)
    return found


def steps_script(model: Model, stem: str) -> str:
    """A script in sections: every step of the derivation as a comment, the numbers of that step, and a run."""
    lines = [
        f"%% {comment(model.name)}",
        "% The derivation by the Lagrangian approach, step by step, with numbers at one state, and a run.",
        f"% Run with {RUN_WITH}; not run with MATLAB, for which no syntax of Octave alone is used.",
        f"% The functions {stem}_forward, ... belong to it: keep these files in one folder.",
        "",
    ]
    start, why = _start(model)
    lines += _values(model, start) if start else [f"% There are no numbers: {why}", ""]
    for heading, body in step_sections(model):
        lines += [f"%% {heading}", *(f"% {line}".rstrip() for line in body)]
        lines += [*(_numbers(heading, stem) if start else ()), ""]
    if start:
        lines += _result(model, stem)
        lines += _run(model, stem, start)
    return "\n".join(lines)


def _start(model: Model) -> tuple[Start | None, str]:
    try:
        return start_of(model), ""
    except Error as error:
        return None, error.what


def _values(model: Model, start: Start) -> list[str]:
    """The state, inputs and parameters of the numbers, each line with its name."""
    n = len(model.coordinates)
    groups: list[tuple[str, Sequence[float], Sequence[str]]] = [
        ("q", start.x[:n], [c.name for c in model.coordinates]),
        ("v", start.x[n : n + len(model.velocities)], [v.name for v in model.velocities]),
        ("u", start.u, [u.name for u in model.inputs]),
        ("p", start.p, [p.name for p in model.parameters]),
    ]
    lines = ["%% The state at which numbers are given, the inputs and the parameters (SI units)"]
    for letter, values, names in groups:
        if not values:
            lines.append(f"{letter} = zeros(0, 1);")
            continue
        lines.append(f"{letter} = [")
        lines += [f"  {value!r}  % {comment(name)}" for value, name in zip(values, names, strict=True)]
        lines.append("];")
    if start.driven:
        listed = ", ".join(map(comment, start.driven))
        lines.append(f"% 0 here, and in the model a function of time or of the state: {listed}")
    return [*lines, f"t = {start.t!r};", ""]


def _numbers(heading: str, stem: str) -> list[str]:
    """The commands that belong to a step."""
    if heading.startswith("2 "):
        return [f"[T, V] = {stem}_energy(q, v, u, p, t);", "T"]
    if heading.startswith("3 "):
        return ["V"]
    if heading.startswith("4 "):
        return ["L = T - V"]
    return []


def _result(model: Model, stem: str) -> list[str]:
    """M, what is left at rest, and the accelerations, held against each other."""
    lines = [
        "%% The equations in numbers: M a + h = 0 with h = C v + G - Xi",
        f"M = {stem}_mass_matrix(q, v, u, p, t)",
        f"h = {stem}_inverse(q, v, zeros(size(v)), u, p, t)",
        f"a = {stem}_forward(q, v, u, p, t)",
    ]
    if model.constraints:
        lines += [
            f"lambda = {stem}_multipliers(q, v, u, p, t)   % here M a + h = A' lambda",
            f"[f, Av] = {stem}_residual(q, v, u, p, t)   % how far the state is from the constraints",
        ]
    else:
        lines.append("left = norm(M*a + h)   % 0 up to rounding")
    return [*lines, ""]


def _run(model: Model, stem: str, start: Start) -> list[str]:
    """A run with ode45, and a plot where there is a screen."""
    names = ", ".join(quoted(c.name) for c in model.coordinates)
    drift = "   % constraints drift: they hold up to the tolerance" if model.constraints else ""
    return [
        "%% A run",
        f"options = odeset('RelTol', 1e-9, 'AbsTol', 1e-12);{drift}",
        f"[time, x] = ode45(@(t, x) {stem}_rhs(x, u, p, t), t + [0, {start.duration!r}], [q; v], options);",
        "final = x(end, :)'",
        "if ~exist('OCTAVE_VERSION', 'builtin') || have_window_system()",
        f"  plot(time, x(:, 1:{len(model.coordinates)}));",
        f"  legend({names});",
        "  xlabel('t [s]');",
        "end",
        "",
    ]
