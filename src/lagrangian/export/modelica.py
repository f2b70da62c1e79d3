"""Writes a system as a model of Modelica, without libraries: parameters, inputs, states, equations."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from lagrangian.codegen.labels import WORD, comment
from lagrangian.codegen.modelica import needed_functions, to_modelica
from lagrangian.errors import Error
from lagrangian.export.names import WORDS_OF_MODELICA
from lagrangian.export.programs import coordinates_listed, program_of, unit_table
from lagrangian.export.start import Start, start_of
from lagrangian.model import Model
from lagrangian.records import dataclass

RESERVED = WORDS_OF_MODELICA | {
    *("inverse_sinh", "inverse_cosh", "inverse_tanh", "energy_kinetic", "energy_potential"),
}
"""Words that cannot name a variable, and those of this file."""

UNIT = re.compile(r"[A-Za-z]+(\^[0-9])?( [A-Za-z]+(\^[0-9])?)*(/[A-Za-z]+(\^[0-9])?)?", re.ASCII)
"""Units that are written alike but for the signs between their parts."""


@dataclass(frozen=True)
class ModelicaNames:
    """What everything is called: names of the model where Modelica takes them, otherwise a letter and a number."""

    q: tuple[str, ...]
    v: tuple[str, ...]
    u: tuple[str, ...]
    p: tuple[str, ...]
    lam: tuple[str, ...]

    @classmethod
    def of(cls, model: Model, rows: int) -> ModelicaNames:
        """The names of a model with so many multipliers."""
        groups = {"q": model.coordinates, "v": model.velocities, "u": model.inputs, "p": model.parameters}
        return cls.among({letter: [x.name for x in group] for letter, group in groups.items()}, rows)

    @classmethod
    def among(cls, groups: Mapping[str, Sequence[str]], rows: int) -> ModelicaNames:
        """Names without a repetition for those of a model. A velocity is called after its coordinate, with ``_dot``."""
        used: set[str] = set()

        def chosen(name: str, other: str) -> str:
            plain = WORD.fullmatch(name) and name not in RESERVED and name[:2] not in ("e_", "m_", "r_")
            found = name if plain and name not in used else other
            while found in used:
                found += "_"
            used.add(found)
            return found

        def all_of(names: Sequence[str], letter: str) -> tuple[str, ...]:
            return tuple(chosen(x.replace("'", "_dot"), f"{letter}{k}") for k, x in enumerate(names, 1))

        q, u, p, v = (all_of(groups[letter], letter) for letter in "qupv")
        return cls(q, v, u, p, all_of([f"lambda{k}" for k in range(1, rows + 1)], "lambda"))

    @property
    def places(self) -> dict[tuple[str, int], str]:
        """The names by group and number; x = [q; v]."""
        groups = {"q": self.q, "v": self.v, "x": (*self.q, *self.v), "u": self.u, "p": self.p, "t": ("time",)}
        return {(group, k): name for group, listed in groups.items() for k, name in enumerate(listed)}


def files(model: Model, stem: str) -> Mapping[str, str]:
    """``stem.mo`` with the model ``stem``."""
    programs = {"r_": program_of(model, "rhs"), "e_": program_of(model, "energy")}
    if model.constraints:
        programs["m_"] = program_of(model, "multipliers")
    rows = len(programs["m_"].ids) if "m_" in programs else 0
    names = ModelicaNames.of(model, rows)
    defined: list[str] = []
    equations: list[str] = []
    results: dict[str, list[str]] = {}
    for prefix, program in programs.items():
        own, outputs, lines = to_modelica(program, names.places, prefix)
        defined, equations, results = defined + own, equations + lines, results | outputs
    states = (*names.q, *names.v)
    equations += [f"der({x}) = {y};" for x, y in zip(states, results["xdot"], strict=True)]
    equations += [f"energy_kinetic = {results['T'][0]};", f"energy_potential = {results['V'][0]};"]
    equations += [f"{x} = {y};" for x, y in zip(names.lam, results.get("lam", ()), strict=True)]
    lines = [*_head(model, stem), *needed_functions(list(programs.values())), *_declared(model, names)]
    lines += ["protected", *(f"  Real {name};" for name in defined)] if defined else []
    lines += ["equation", *(f"  {line}" for line in equations), f"end {stem};", ""]
    return {f"{stem}.mo": "\n".join(lines)}


def _head(model: Model, stem: str) -> list[str]:
    lines = [
        f"// The dynamics of a system with coordinates {coordinates_listed(model)}, for Modelica 3.2 and later.",
        "//",
        "// Run by Rumoca 0.10; NOT RUN with OpenModelica or Dymola, which were not at hand.",
        "// No library is needed. Inputs are inputs of the model: connect them, or set them by a declaration.",
    ]
    if model.constraints:
        lines += [
            "// The accelerations satisfy the constraints, and so do the starts of the states: change them together. A",
            "// motion drifts from the constraints by no more than the tolerance of the integration lets it.",
        ]
    return [*lines, f"model {stem} {_text(model.name)}"]


def _declared(model: Model, names: ModelicaNames) -> Iterator[str]:
    """The declarations of everything that has a meaning."""
    start, units, n = _start(model), unit_table(model), len(model.coordinates)

    def line(
        kind: str, name: str, said: str, unit: str, *, value: float | None = None, begin: float | None = None
    ) -> str:
        inner = [f'unit = "{_unit(unit)}"'] if _unit(unit) else []
        if kind == "" and begin is not None:
            inner += [f"start = {_number(begin)}", "fixed = true"]
        modified = f"({', '.join(inner)})" if inner else ""
        return f"  {kind}Real {name}{modified}{f' = {_number(value)}' if value is not None else ''} {_text(said)};"

    for name, p in zip(names.p, model.parameters, strict=True):
        yield line("parameter ", name, p.description or p.name, units[p.name], value=p.value)
    for name, u in zip(names.u, model.inputs, strict=True):
        yield line("input ", name, u.description or u.name, units[u.name])
    for k, (name, c) in enumerate(zip(names.q, model.coordinates, strict=True)):
        yield line("", name, c.description or c.name, units[c.name], begin=start.x[k] if start else None)
    for k, (name, v) in enumerate(zip(names.v, model.velocities, strict=True)):
        yield line("", name, v.name, units[v.name], begin=start.x[n + k] if start else None)
    yield line("output ", "energy_kinetic", "kinetic co-energy", "J")
    yield line("output ", "energy_potential", "potential energy", "J")
    for name in names.lam:
        yield line("output ", name, "multiplier of a constraint", "")


def _start(model: Model) -> Start | None:
    """The start of the model file; None if a parameter has no value, so that the importing model gives both."""
    try:
        return start_of(model)
    except Error:
        return None


def _unit(unit: str) -> str:
    """A unit as Modelica writes it, ``N.s/m`` and ``kg.m2``; empty for one that it would write another way."""
    if not UNIT.fullmatch(unit):
        return ""
    return unit.replace(" ", ".").replace("^", "")


def _number(x: float) -> str:
    return repr(float(x))


def _text(words: str) -> str:
    """A string of Modelica that nothing can end."""
    return f'"{comment(words)}"'
