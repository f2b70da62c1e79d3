"""Evaluates expressions at random states, at which ranks are computed and routes compared."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Mapping, Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Output, Program, evaluate, from_sympy, vjp
from lagrangian.model import Element, Inductor, Model, MutualInductance, time
from lagrangian.model.rows import rows_of
from lagrangian.page.plain import plain

TRIES = 60
"""After this many random draws without a finite value, an expression counts as having none anywhere."""


SHARED = 0.2
"""The part of a random number that a mutual inductance gets."""


class Sampler:
    """Evaluates expressions at random coordinates, rates, accelerations, parameters, inputs and time.

    Everything is drawn from (0.4, 1.6), so that masses and lengths are positive and there are no special values; of a
    mutual inductance a fifth, because it is smaller than the inductances of its coils. With ``values``, parameters
    that have a value keep it. ``slopes_of`` are expressions whose derivatives by the symbols ``by`` come before the
    values of ``exprs``, row after row.
    """

    def __init__(
        self,
        model: Model,
        exprs: Sequence[sp.Expr],
        *,
        values: bool = False,
        slopes_of: Sequence[sp.Expr] = (),
        by: Sequence[sp.Expr] = (),
    ) -> None:
        self._model = model
        full, steep = ([model.expand(sp.sympify(e), constants=True) for e in listed] for listed in (exprs, slopes_of))
        atoms: set[sp.Basic] = set()
        for e in (*full, *steep):
            atoms |= bounded.names(e)
        self.symbols = sorted(atoms | {time}, key=sp.default_sort_key)
        graph = Graph()
        table = {s: graph.input("x", i) for i, s in enumerate(self.symbols)}
        columns = [table.get(x, graph.input("none", i)) for i, x in enumerate(by)]
        slopes = [x for e in steep for x in vjp(graph, [from_sympy(graph, e, table)], [graph.one], columns)]
        ids = (*slopes, *(from_sympy(graph, e, table) for e in full))
        names = tuple(plain(s) for s in self.symbols)
        self._program = Program("sample", graph, {"x": names}, {"y": Output(ids, (len(ids),))}, {})
        self._fixed: dict[sp.Basic, float] = {**model.values} if values else {}
        own = {s for e in model.branches if isinstance(e, Inductor) for use in e.uses() for s in use.expr.free_symbols}
        shared = {s for e in model.branches if isinstance(e, MutualInductance) for s in e.M.free_symbols}
        self._shared = shared - own

    def draw(self, seed: int) -> dict[sp.Basic, float]:
        """A random value for every symbol."""
        source = random.Random(seed)
        drawn: dict[sp.Basic, float] = {
            s: source.uniform(0.4, 1.6) * (SHARED if s in self._shared else 1) for s in self.symbols
        }
        drawn.update({s: v for s, v in self._fixed.items() if s in drawn})
        return drawn

    def at(self, state: Mapping[sp.Basic, float]) -> list[float]:
        """The values of the expressions at a state; NaN if there is none."""
        try:
            result = evaluate(self._program, {"x": [state[s] for s in self.symbols]})["y"]
        except (ZeroDivisionError, ValueError, OverflowError):
            return [math.nan] * len(self._program.outputs["y"].ids)
        return [float(y) for y in result]

    def states(self, count: int, *, seed: int = 1) -> Iterable[tuple[dict[sp.Basic, float], list[float]]]:
        """``count`` random states at which everything is finite, each with its values."""
        found = 0
        for attempt in range(TRIES + count):
            state = self.draw(seed * 7919 + attempt)
            values = self.at(state)
            if all(math.isfinite(v) for v in values):
                found += 1
                yield state, values
                if found == count:
                    return
        culprit = without_value(self._model)
        whose = f"{culprit.title} has" if culprit else f"the expressions of system '{self._model.name}' have"
        raise ModelError(
            f"{whose} no finite real value at any of {TRIES} random states",
            place=culprit.place if culprit else None,
            fix="check square roots, logarithms and divisions for arguments that are never allowed",
            code="E503",
        )


def without_value(model: Model, *, values: bool = False) -> Element | None:
    """The first element whose energy, force or constraint has no finite real value at any random state.

    With ``values``, parameters that have a value keep it.
    """
    for element in model.elements:
        acting = [x for action in element.works(model) for x in (action.effort, action.rate)]
        held = [
            x for row in rows_of(model) if row.element is element for x in (row.rate, row.position) if x is not None
        ]
        sampler = Sampler(model, [element.kinetic(model), element.potential(model), *acting, *held], values=values)
        if not any(all(map(math.isfinite, sampler.at(sampler.draw(k)))) for k in range(TRIES)):
            return element
    return None
