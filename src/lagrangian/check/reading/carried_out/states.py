"""Functions of a program that return the rates of a state, carried out with entries of this state as symbols."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.layouts import Layouts
from lagrangian.check.reading.carried_out.loose import Loose
from lagrangian.check.reading.carried_out.mass_matrix import with_mass
from lagrangian.check.reading.carried_out.named_arguments import NamedArguments
from lagrangian.check.reading.carried_out.reached import reached
from lagrangian.check.reading.carried_out.routines import PLAIN
from lagrangian.check.reading.carried_out.values import (
    NAME,
    TIME,
    TROUBLES,
    AbandonedError,
    Fields,
    OwnFunction,
    State,
    Value,
    has_unknown,
    listed,
)
from lagrangian.check.reading.implied_rates import implied_rates
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.model import Model
from lagrangian.read.letters import key
from lagrangian.records import dataclass

_LIST_BEHIND = re.compile(r"[%#]++[ \t]*+(?:=[ \t]*+)?\[(?P<entries>[^\[\]\n]{1,200}+)\][ \t]*+(?:\^T|['’])?[ \t]*+\Z")
_END = re.compile(r"(?:(?<=[a-zA-Z])\d++|(?<=_)[^\W_]++|)\Z")
"""What tells names of one kind apart: x1, v_u."""
_RATE = re.compile(r"(?<=\w)['’′]\Z")
_ACCELERATION = re.compile(r"acc|ddot|dd\b|_tt\b", re.IGNORECASE)
"""Names of functions that return accelerations, and nothing from which these are found."""


@dataclass(frozen=True, eq=False)
class StateFunction:
    """What a function says: q̈ and its value, pair by pair, and what the entries of the state are."""

    line: int
    accelerations: list[tuple[sp.Expr, sp.Expr]]
    moving: dict[sp.Symbol, sp.Expr]


@dataclass(frozen=True, eq=False)
class StateReader:
    """Finds the functions of a program that was carried out that return rates of a state, or accelerations."""

    run: Evaluator
    text: str
    model: Model
    scope: AnswerScope

    def functions(self, names: dict[str, Value]) -> Iterator[StateFunction]:
        """The functions that nothing calls, and what they say of the motion; if nothing, accelerations that the program
        uses."""
        made = [f for f in (*self.run.functions.values(), *names.values()) if isinstance(f, OwnFunction)]
        matrices = {name for name, x in names.items() if isinstance(x, MatrixBase) or _is_matrix(x)}
        own = self.run.functions | {name: x for name, x in names.items() if isinstance(x, OwnFunction)}
        functions = {id(f): f for f in made}.values()
        failed: list[OwnFunction] = []
        found = [(f, self._tried(f, matrices, own, failed)) for f in functions if f not in self.run.called]
        inner = reached(failed, own)
        said = [x for f, x in found if x is not None and f not in self.run.called | inner]
        others = (f for f in functions if f in self.run.called - inner and _ACCELERATION.search(f.name))
        yield from said or filter(None, (self._tried(f, matrices, own, failed) for f in others))

    def _tried(
        self, f: OwnFunction, matrices: Set[str], own: Mapping[str, OwnFunction], failed: list[OwnFunction]
    ) -> StateFunction | None:
        """What one function says; None for one that has no meaning on symbols, which has ``failed``."""
        try:
            return self._said_by(f, matrices, own)
        except TROUBLES:
            failed.append(f)
        return None

    def _said_by(self, f: OwnFunction, matrices: Set[str], own: Mapping[str, OwnFunction]) -> StateFunction | None:
        """What one function says of the motion; None if it says nothing."""
        given = {name: _argument(f, name, matrices, own, self.run.matlab) for name in f.arguments}
        value = self.run.function(f, list(given.values()))
        if has_unknown(value):
            raise AbandonedError
        several = self.run.several if isinstance(value, sp.Expr) and len(self.run.several) > 1 else value
        rates = _rates(several, alone=len(self.model.coordinates) == 1)
        if rates is None:
            return None
        table = self._parameters(given)
        rates = [cast("sp.Expr", x.xreplace(table)) for x in rates]
        states = [x for x in given.values() if isinstance(x, State) and not table.keys() & set(x.entries.values())]
        rates = with_mass(self.run, list(given.values()), rates) if states else rates
        layouts = Layouts(self.run, self.model, self.scope, self.in_comments, self.rated)
        found: Any = layouts.of_sums(given, rates)
        named = NamedArguments(self.run, self.model, self.scope, self.rated, self._as_motion)
        called = (
            f
            if f.name
            else replace(f, name=next((name for name, x in own.items() if x is f and name.isidentifier()), ""))
        )
        found = found or (self._of_state(states, rates) if states else named.motion(called, rates))
        found = found or layouts.of_residuals(states, rates) or layouts.of_accelerations(f, states, rates)
        return None if found is None else StateFunction(_line(f), found[0], found[1] | table)

    def _parameters(self, given: Mapping[str, Value]) -> dict[sp.Symbol, sp.Expr]:
        """The parameters that the entries of a column are, where each has the name of one: M = p(1); m = p(2)."""
        table: dict[sp.Symbol, sp.Expr] = {}
        for x in given.values():
            called = [self.run.aliases.get(y, "") for y in x.entries.values()] if isinstance(x, State) else []
            if isinstance(x, State) and called and all(map(self.run.known, called)):
                table |= {y: sp.Symbol(of) for y, of in zip(x.entries.values(), called, strict=True)}
        return table

    def in_the_open(self, loose: Loose, value: Value) -> StateFunction | None:
        """What rates without a function say, whose state a comment may name: dz = [w; …] with z = [phi; w]."""
        rates, state = _rates(value), loose.state
        if rates is None:
            return None
        table = {sp.Symbol(name): state.entry(k) for k, name in self.in_comments(state.name).items()}
        found = self._of_state([state], [cast("sp.Expr", x.xreplace(table)) for x in rates])
        return None if found is None else StateFunction(loose.line, *found)

    def _of_state(self, states: Sequence[State], rates: Sequence[sp.Expr]) -> Any:
        """The pairs and the meaning of the entries of the first argument whose entries are among the rates."""
        for state in states:
            if not state.entries or any(k > len(rates) for k in state.entries):
                continue
            whole = State(state.name, dict(state.entries))
            for k in range(len(rates)):
                whole.entry(k + 1)
            if (found := self._as_motion(whole, rates)) is not None:
                pairs, table = found
                for other in (x for x in states if x is not state):
                    table |= self._of_inputs(other)
                return pairs, table
        return None

    def _as_motion(self, state: State, rates: Sequence[sp.Expr]) -> Any:
        places: dict[sp.Expr, int] = {x: k for k, x in state.entries.items()}
        rate_of = {i + 1: places[x] for i, x in enumerate(rates) if x in places}
        comments = self.in_comments(state.name)
        if len(set(rate_of.values())) != len(rate_of) or any(j in rate_of for j in rate_of.values()):
            return self._as_said(state, comments, rates)
        coordinates = [c.name for c in self.model.coordinates]
        pairs: list[tuple[sp.Expr, sp.Expr]] = []
        table: dict[sp.Symbol, sp.Expr] = {}
        for order, (i, j) in enumerate(rate_of.items()):
            name = self.run.aliases.get(state.entries[i]) or comments.get(i)
            if name is None and len(rate_of) == len(coordinates):
                name = coordinates[order]
            if name is None:
                return None
            q = sp.Function(name)(TIME)
            table[state.entries[i]], table[state.entries[j]] = q, q.diff(TIME)
            pairs.append((q.diff(TIME, 2), rates[j - 1]))
        for k, x in state.entries.items():  # the rate of a coordinate that is left out because it is cyclic
            if x in table:
                continue
            stem = self.rated(self.run.aliases.get(x) or "") or self.rated(comments.get(k) or "")
            if stem is None:
                return None
            q = sp.Function(stem)(TIME)
            table[x] = q.diff(TIME)
            pairs.append((q.diff(TIME, 2), rates[k - 1]))
        return (pairs, table) if pairs else None

    def _as_said(self, state: State, comments: dict[int, str], rates: Sequence[sp.Expr]) -> Any:
        """What is said of a state whose first rates are no rates of positions: x' = x, which is not true."""
        coordinates = [sp.Function(c.name)(TIME) for c in self.model.coordinates]
        if len(rates) != 2 * len(coordinates):
            return None
        known = [*coordinates, *(q.diff(TIME) for q in coordinates)]
        said = [self.run.aliases.get(state.entry(k + 1)) or comments.get(k + 1) for k in range(len(known))]
        own = [sp.Function(x)(TIME) if x and NAME.fullmatch(x) else q for x, q in zip(said, coordinates, strict=False)]
        table = dict(
            zip([state.entry(k + 1) for k in range(len(known))], [*own, *(q.diff(TIME) for q in own)], strict=True)
        )
        return [(table[state.entry(k + 1)].diff(TIME), rates[k]) for k in range(len(known))], table

    def rated(self, name: str, order: int = 1) -> str | None:
        """The coordinate whose rate a name is, or its acceleration: psd of psi, and i where a comment says i = q'."""
        coordinates = {c.name for c in self.model.coordinates}
        said = (
            re.findall(rf"[#%][^\n]*?(?<!\w){re.escape(name)}[ ]?=[ ]?([^\W\d]\w*+)(?:['’]|[ ]?dot\b)", self.text)
            if name and order == 1
            else []
        )
        found = [s for k, s in spelled_rates(name) if k == order and set(self.scope.meanings(s)[0]) & coordinates]
        found += [s for s in said if set(self.scope.meanings(s)[0]) & coordinates]
        implied = implied_rates(self.model, [key(name)], [key(name)]) if order == 1 else {}
        found += [str(x.args[0].func) for x in implied.values()]  # the current of a charge
        return found[0] if found else None

    def rates_of(self, name: str, count: int) -> list[sp.Expr]:
        """The rates of the entries of a state that a comment lists, x = [phi; z; phidot; zdot] for xdot; none if their
        number is another one."""
        coordinates = {c.name for c in self.model.coordinates}
        for stem in (s for k, s in spelled_rates(name) if k == 1):
            said = list(self.in_comments(stem).values())
            own = [set(self.scope.meanings(x)[0]) & coordinates for x in said]
            moving = [(x, 1) if y else (self.rated(x) or "", 2) for x, y in zip(said, own, strict=True)]
            if all(own[: len(coordinates)]) and not any(self.scope.meanings(x)[0] for x in said[len(coordinates) :]):
                listed = said[: len(coordinates)]  # x = [x1; x2; v1; v2]
                if not _in_order(listed, said[len(coordinates) :]):
                    continue
                moving = [(x, order) for order in (1, 2) for x in listed] if len(said) == 2 * len(listed) else moving
            if len(said) == count and all(x for x, _ in moving):
                return [sp.Function(x)(TIME).diff(TIME, order) for x, order in moving]
        return []

    def _of_inputs(self, other: State) -> dict[sp.Symbol, sp.Expr]:
        """What the entries of a vector of inputs are."""
        comments, inputs = self.in_comments(other.name), [u.name for u in self.model.inputs]
        found: dict[sp.Symbol, sp.Expr] = {}
        for k, x in other.entries.items():
            name = comments.get(k) or self.run.aliases.get(x) or (inputs[k - 1] if k <= len(inputs) else None)
            if name is None:
                raise AbandonedError
            found[x] = sp.Symbol(name)
        return found

    def by_parts(self) -> StateFunction | None:
        """The accelerations that entries of a solution are called: s = A\\b and xdd = s(1), one for each coordinate."""
        called = {x.value: x for x in self.run.stated if x.name and isinstance(x.value, sp.Symbol)}
        parts = [(self.rated(x.name or "", 2), one, x.line) for one, x in called.items() if one in self.run.solved]
        named = [(sp.Function(name)(TIME).diff(TIME, 2), one, line) for name, one, line in parts if name]
        if len({rate for rate, *_ in named}) != len(self.model.coordinates) or len(named) > len(self.model.coordinates):
            return None
        return StateFunction(named[0][2], [(rate, one) for rate, one, _ in named], {})

    def in_comments(self, name: str) -> dict[int, str]:
        """The names of the entries that a comment lists: % z = [phi; x; phi'; x'], or z(1) = phi; of parts that are
        lists themselves, y = [q; qdot], those of these."""
        said = self._in_comments(name)
        entries: list[str] = []
        for k in range(1, max(said, default=0) + 1):
            part = said.get(k, "")
            stem = next((x for _, x in spelled_rates(part)), None)
            own = self._in_comments(part) if part else {}
            rates = self._in_comments(stem) if stem and not own else {}
            if stem != name and part != name and (own or rates):
                entries += [*own.values(), *(f"{x}dot" for x in rates.values())]
            else:
                entries.append(part)
        return {k: x for k, x in enumerate(entries, 1) if x}

    def _in_comments(self, name: str) -> dict[int, str]:
        """The names of the entries that a comment lists."""
        form = re.compile(
            rf"(?<![\w*]){re.escape(name)}['’]?\s*(?:=|:|is)\s*[\[(](?P<entries>[^\[\]\n]{{1,200}}?)[\])]"
        )
        single = re.compile(
            rf"(?<!\w){re.escape(name)}[(\[](\d)[)\]]\s*=\s*([^\W\d]\w*+)( ?(?:dot|rate|punkt)\b|['’])?(?![\w'/])"
        )
        found: dict[int, str] = {}
        for comment in re.finditer(r"(?:[#%]|\"\"\")[^\n]*", self.text):
            for match in form.finditer(comment.group()):
                words = [_RATE.sub("dot", x) for x in re.split(r"[\s,;]+", match["entries"].strip()) if x]
                if named := {k + 1: x for k, x in enumerate(words) if NAME.fullmatch(x)}:
                    return named
            found |= {int(m[1]): f"{m[2]}dot" if m[3] else m[2] for m in single.finditer(comment.group())}
        return found

    def behind(self, line: int) -> dict[int, str]:
        """The names of the entries that a comment behind a statement lists: A \\ b  % [xdd; thetadd; lambda]."""
        match = _LIST_BEHIND.search(self.text.split("\n")[line - 1])
        words = re.split(r"[\s,;]+", match["entries"].strip()) if match is not None else []
        return {k + 1: x for k, x in enumerate(words)} if all(map(NAME.fullmatch, words)) else {}


def _line(f: OwnFunction) -> int:
    body = f.body if isinstance(f.body, ast.expr) else f.body[-1]
    return body.end_lineno or body.lineno


def _rates(value: Value, *, alone: bool = False) -> list[sp.Expr] | None:
    """The entries of what a function returns; columns in a list are joined. A value ``alone`` may be the only one."""
    value = [value] if alone and isinstance(value, sp.Expr) else value
    if not isinstance(value, (list, tuple, MatrixBase)):
        return None
    found: list[Any] = []
    for x in listed(value):
        found += listed(x) if isinstance(x, (list, tuple, MatrixBase)) else [x]
    return found if all(isinstance(x, sp.Expr) for x in found) else None


def _in_order(places: Sequence[str], rates: Sequence[str]) -> bool:
    """Whether rates stand in the order of their places, as far as their endings say: x1, x2 and v1, v2, not v2, v1."""
    ends = [[_END.search(x).group() for x in names] for names in (places, rates)]  # type: ignore[union-attr]  # or ""
    return all(a == b or b not in ends[0] or not b for a, b in zip(*ends, strict=False))


def _argument(
    f: OwnFunction, name: str, matrices: Set[str], own: Mapping[str, OwnFunction], matlab: bool, depth: int = 4
) -> Value:
    """What an argument is by its use: a state, parameters by name, or a number; ``matrices`` and ``own`` functions are
    the program's."""
    body = [f.body] if isinstance(f.body, ast.expr) else f.body
    nodes = [x for part in body for x in ast.walk(part)]
    if any(isinstance(x, ast.Attribute) and _is(x.value, name) and x.attr != "T" for x in nodes):
        return Fields()
    indices = [x.slice for x in nodes if isinstance(x, ast.Subscript) and _is(x.value, name)]
    listed_names = [x for x in nodes if isinstance(x, (ast.GeneratorExp, ast.ListComp)) and _takes_fields(x, name)]
    if listed_names or any(isinstance(x, ast.Constant) and isinstance(x.value, str) for x in indices):
        return Fields()
    calls = [x for x in nodes if isinstance(x, ast.Call)]
    called = [x for x in calls if _is(x.func, name)]
    unpacked = any(
        isinstance(x, ast.Assign) and isinstance(x.targets[0], (ast.Tuple, ast.List)) and _is(x.value, name)
        for x in nodes
    )
    passed = [
        (x.func.id if isinstance(x.func, ast.Name) else "", k)
        for x in calls
        for k, a in enumerate(x.args)
        if _is(a, name)
    ]
    to_own = [(own[to], k) for to, k in passed if to in own and depth and k < len(own[to].arguments)]
    found = [_argument(g, g.arguments[k], matrices, own, matlab, depth - 1) for g, k in to_own if g is not f]
    if (fields := next((x for x in found if isinstance(x, Fields)), None)) is not None:
        return fields
    whole = any(to not in PLAIN and to not in own for to, _ in passed) and name != "t" and matlab
    whole = whole or any(isinstance(x, State) for x in found)
    products = [x for x in nodes if isinstance(x, ast.BinOp) and isinstance(x.op, (ast.Mult, ast.MatMult))]
    whole = whole or any(_is(x.right, name) and any(_is(x.left, A) for A in matrices) for x in products)  # A*y
    if indices or unpacked or whole or (matlab and any(not _is(x.args[0], "t") for x in called if x.args)):
        return State(name)
    return TIME if name == "t" else sp.Symbol(name)


def _is_matrix(value: Value) -> bool:
    """Whether a value is a list of rows."""
    return isinstance(value, list) and bool(value) and all(isinstance(x, list) for x in value)


def _takes_fields(node: ast.GeneratorExp | ast.ListComp, name: str) -> bool:
    """Whether parameters are taken from a table by their names: (p[x] for x in ("m", "l"))."""
    of, names = node.elt, node.generators[0].iter
    strings = isinstance(names, (ast.Tuple, ast.List)) and all(
        isinstance(x, ast.Constant) and isinstance(x.value, str) for x in names.elts
    )
    return strings and isinstance(of, ast.Subscript) and _is(of.value, name)


def _is(node: ast.expr, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name
