"""What functions of a program say whose arguments are coordinates and rates by name.

accelerations(y, th, yd, thd)      [ydd, thdd], one for each; fewer where constraints are put in, by their names
acc(theta, omega)                  theta'' alone; letters that mean nothing else are the rates, in their order
acc(alpha, r, da, dr)              [alpha'', r'']; da can only be the rate of alpha
pendulum(theta, omega)             [omega, theta''], the rates of a state
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.layouts import ACCELERATES
from lagrangian.check.reading.carried_out.values import TIME, OwnFunction, State
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.model import Model
from lagrangian.read.letters import GREEK, key
from lagrangian.records import dataclass

_TURNS, _MOVES = re.compile(r"(?:w|om|Om|ω|Ω)\w{0,12}"), re.compile(r"(?:v|u|s)\w{0,12}")
"""Letters of angular velocities, and of velocities."""
_SAID = re.compile(r"accelerat|beschleunig", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class NamedArguments:
    """Finds the accelerations that such a function returns; ``rated`` is the coordinate whose rate a name is, and
    ``of_state`` what the rates of a state say."""

    run: Evaluator
    model: Model
    scope: AnswerScope
    rated: Callable[..., str | None]
    of_state: Callable[[State, Sequence[sp.Expr]], Any]

    def motion(self, f: OwnFunction, rates: Sequence[sp.Expr]) -> Any:
        """The pairs of q̈ and its value, and what the arguments are; None if the function says something else."""
        coordinates = [c.name for c in self.model.coordinates]
        named = [x for x in f.arguments if set(self.scope.meanings(x)[0]) & set(coordinates)]
        spelled = [x for x in f.arguments if x not in named and self.rated(x) is not None]
        own = self._own_rates(f, named, spelled) if len(named) == len(coordinates) else {}
        if len(rates) == 2 * len(named) == 2 * len(coordinates):
            state = [x for x in f.arguments if x in named or x in spelled or x in own]
            entries = {k: sp.Symbol(x) for k, x in enumerate(state, 1)}
            self.run.aliases.update({sp.Symbol(x): x for x in named})
            rated = set(rates) & {sp.Symbol(x) for x in (*spelled, *own)}
            if len(state) == len(rates) and rated and not set(rates) & {sp.Symbol(x) for x in named}:
                return self.of_state(State("", entries), rates)
        table = {sp.Symbol(x): sp.Function(q)(TIME).diff(TIME) for x, q in own.items()}
        returned = [self.rated(x, 2) or "" for x in (f.out or "").split(",")]
        more = rates[len(coordinates) :]  # multipliers that are solved for
        if len(named) != len(coordinates) or len(rates) < len(named) or not set(more) <= self.run.solved.keys():
            free = len(coordinates) - len(self.model.constraints)
            if not len(returned) == len(rates) >= max(free, 1) or not set(returned) <= set(named):
                return None
            named = returned
        elif (own or len(rates) == 1) and not self._says(f, rates) and not any(returned):
            return None
        return [(sp.Function(x)(TIME).diff(TIME, 2), value) for x, value in zip(named, rates, strict=False)], table

    def _own_rates(self, f: OwnFunction, named: Sequence[str], spelled: Sequence[str]) -> dict[str, str]:
        """The names of the program's own among the arguments that stand for the rates of coordinates; all or none."""
        done = {self.rated(x) for x in spelled}
        meant = {x: next(iter(self.scope.meanings(x)[0])) for x in named}
        left = [x for x in named if meant[x] not in done]
        free = [x for x in f.arguments if x not in named and x not in spelled and x != TIME.name]
        free = [x for x in free if not self.scope.meanings(x)[0]]
        begun = _begun(free, {x: meant[x] for x in left})
        left = [x for x in left if x not in begun.values()]
        if begun and not left:
            return begun
        free = [x for x in free if x not in begun and (_TURNS.fullmatch(x) or _MOVES.fullmatch(x))]
        turning, moving = ([x for x in free if form.fullmatch(x)] for form in (_TURNS, _MOVES))
        angles, lengths = ([x for x in left if _is_angle(meant[x]) is turns] for turns in (True, False))
        if len(turning) == len(angles) and len(moving) == len(lengths):
            return begun | dict(zip((*turning, *moving), (*angles, *lengths), strict=True))
        return begun | dict(zip(free, left, strict=True)) if len(free) == len(left) else {}

    def _says(self, f: OwnFunction, rates: Sequence[sp.Expr]) -> bool:
        """Whether a function says that it returns accelerations: by its name, in its words, or by solving for them."""
        words = ""
        if isinstance(f.body, list):
            words = getattr(getattr(f.body[0], "value", None), "value", "")  # of its docstring
        said = any(map(ACCELERATES.search, (f.name, f.out or ""))) or bool(_SAID.search(str(words)))
        return said or any(x.free_symbols & self.run.solved.keys() for x in rates)


def _begun(free: Sequence[str], left: Mapping[str, str]) -> dict[str, str]:
    """The names that are rates of the letters with which only one of the coordinates that are left begins: da of
    alpha."""
    found: dict[str, list[str]] = {}
    for x in free:
        stems = [key(stem) for order, stem in spelled_rates(x) if order == 1 and stem]
        begins = [q for q, name in left.items() if any(key(name).startswith(stem) for stem in stems)]
        if len(begins) == 1:
            found.setdefault(begins[0], []).append(x)
    return {listed[0]: q for q, listed in found.items() if len(listed) == 1}


def _is_angle(coordinate: str) -> bool:
    """Whether a coordinate has a Greek letter, as angles have."""
    letter = re.match(r"[^\W\d_]*+", key(coordinate))
    return letter is not None and letter.group() in GREEK.values()
