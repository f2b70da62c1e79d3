"""Carries out the syntax tree of a program on symbols: assignments, functions, loops over lists."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import replace

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.carried_out.altered import altered_by, is_doubtful, mutable
from lagrangian.check.reading.carried_out.calling import Calling
from lagrangian.check.reading.carried_out.changed_by import changed_by, returns
from lagrangian.check.reading.carried_out.given_values import GivenValues
from lagrangian.check.reading.carried_out.made_of import MadeOf, given_in
from lagrangian.check.reading.carried_out.matlab import UNREAD
from lagrangian.check.reading.carried_out.mechanics import Mass
from lagrangian.check.reading.carried_out.routines import SHOWN, SOLVING
from lagrangian.check.reading.carried_out.values import (
    LIBRARY,
    LOST,
    MOST_ENTRIES,
    TIME,
    TROUBLES,
    UNKNOWN,
    AbandonedError,
    Fields,
    Outside,
    OwnFunction,
    ReturnedError,
    Shown,
    State,
    Value,
    called_name,
    equated,
    has_unknown,
    is_list,
    is_number,
    is_scalar,
    is_sided,
    listed,
    matrix,
    number,
    scalar,
)
from lagrangian.check.reading.own_inputs import may_drive, of_value, says_else
from lagrangian.model.symbols import Parameter
from lagrangian.records import dataclass, field


@dataclass(eq=False)
class Interpreter(Calling):
    """Carries out a program, statement by statement."""

    valued: Sequence[Parameter] = ()
    """The parameters of the system that a program does not name."""
    driven: str | None = None
    """The one input of the system that a program does not name."""
    said: Set[str] = frozenset()
    """The names of parameters of the system in the program, as its comments say: Mc = M."""
    values: GivenValues = field(default_factory=GivenValues)
    behind: Mapping[int, str] = field(default_factory=dict)
    """The comments behind statements, by their lines."""
    read_as: dict[str, str] = field(default_factory=dict)
    """The parameters that names of the program are by their values."""
    left_out: list[tuple[int, int]] = field(default_factory=list)
    """The first and the last lines of statements that depend on conditions, which were not carried out."""
    altered: list[Value] = field(default_factory=list)
    """The lists and tables that a call that is not carried out may have changed."""
    drives: str | None = None
    """The function of the program that is this input."""

    def run(self, tree: ast.Module, given: dict[str, Value]) -> dict[str, Value]:
        """Carry out a whole program, with names that are ``given``; return its names."""
        names = dict(given)
        self.outer = names
        if any(isinstance(x, ast.NamedExpr) for x in ast.walk(tree)):
            raise AbandonedError
        try:
            self.carry_out(tree.body, names)
        except ReturnedError:  # outside of all functions
            raise AbandonedError from None
        return names

    def function(self, of: OwnFunction, given: Sequence[Value], called: str = "") -> Value:
        """The value of a function of the program; one of time alone may be the input that has no name, motor(t)."""
        value = Calling.function(self, of, given, called)
        if given and all(map(is_number, given)):  # acc(0, 0.1), to see what comes out
            return UNKNOWN if any(_letters(x) & self.solved.keys() for x in self.flat(value)) else value
        self.called |= {of} if called else set()
        if self.driven is None or not called or list(given) != [TIME] or not is_scalar(value):
            return value
        name, letters = of.name or called, set(scalar(value).free_symbols)
        if not letters <= {TIME} or not may_drive(name, constant=not letters) or self.drives not in (None, name):
            return value
        self.drives = name
        return sp.Symbol(self.driven)

    def call(self, node: ast.Call, names: dict[str, Value]) -> Value:
        """The value of a call; of what it may change, nothing is known from there on."""
        own = None if not isinstance(node.func, ast.Name) else names.get(node.func.id, self.functions.get(node.func.id))
        of = own if isinstance(own, OwnFunction) else None
        try:
            value = Calling.call(self, node, names)
        except TROUBLES:
            self.altered += altered_by(node, names, failed=True, of=of) if not self.matlab else ()
            raise
        if not self.matlab and (of is not None or is_doubtful(value, node)):
            self.altered += altered_by(node, names, failed=False, of=of)
        return value

    def _named(self, name: str, names: dict[str, Value]) -> Value:
        """The value of a name; nothing is known of one that a call may have changed."""
        value = Calling._named(self, name, names)
        return LOST if any(value is x for x in self.altered) else value

    # -- statements --------------------------------------------------------------------------------------------------

    def carry_out(self, body: Iterable[ast.stmt], names: dict[str, Value]) -> None:
        """Carry out statements in turn, with ``names`` that they may change."""
        for statement in body:
            self.count()
            self._statement(statement, names)

    def _statement(self, s: ast.stmt, names: dict[str, Value]) -> None:
        if isinstance(s, (ast.Import, ast.ImportFrom)):
            for alias in s.names:
                name = alias.asname or alias.name.partition(".")[0]
                own = self.functions.pop(name, None)
                if isinstance(s, ast.Import) or own is not None:
                    names[name] = LOST if own is not None else LIBRARY
        elif isinstance(s, ast.FunctionDef):
            out = s.returns.value if isinstance(s.returns, ast.Constant) else None
            made = OwnFunction(
                s.name, tuple(a.arg for a in s.args.args), s.body, str(out) if out else None, s.args.defaults
            )
            names[s.name] = self.functions[s.name] = made
        elif isinstance(s, ast.Assign):
            before = set(self.used)
            self.several = []
            value = self._value_of(s.value, names, called_name(s.targets[0]))
            if isinstance(s.targets[0], (ast.Tuple, ast.List)) and len(self.several) == len(s.targets[0].elts):
                value = self.several  # [M, h] = matrices(q)
            self.used = before if isinstance(value, Outside) else self.used  # nothing that is known uses them
            own = {x.id for x in s.targets if isinstance(x, ast.Name)}
            self.used -= own - before  # eq = simplify(eq)
            for target in s.targets:
                self._assign(target, value, names, s.lineno)
        elif isinstance(s, ast.AnnAssign) and s.value is not None:
            self._assign(s.target, self._value_of(s.value, names, called_name(s.target)), names, s.lineno)
        elif isinstance(s, ast.AugAssign):
            before = self._value_of(s.target, names)
            value = self.operated(s.op, before, self.value(s.value, names))
            self.altered += () if self.matlab else mutable(before)
            self._assign(s.target, LOST if isinstance(value, Outside) else value, names, s.lineno)
        elif isinstance(s, ast.Expr):
            with suppress(*TROUBLES):
                self._shown(s, names)
        elif isinstance(s, ast.Return):
            raise ReturnedError(self.value(s.value, names) if s.value is not None else UNKNOWN)
        elif isinstance(s, ast.For):
            self._loop(s, names)
        elif isinstance(s, ast.With) or (isinstance(s, ast.If) and "__name__" in ast.dump(s.test)):
            self.carry_out(s.body, names)
        elif isinstance(s, (ast.If, ast.While, ast.Try)):
            self._leave_out(s, names)
        elif isinstance(s, ast.ClassDef):
            self._class(s, names)
        elif isinstance(s, ast.Delete):
            held = [x.value for x in s.targets if isinstance(x, (ast.Subscript, ast.Attribute))]
            self.altered += [y for x in held for y in mutable(self.value(x, names))]
        elif not isinstance(s, (ast.Pass, ast.Global, ast.Nonlocal, ast.Assert, ast.Raise)):
            raise AbandonedError

    def _value_of(self, node: ast.expr, names: dict[str, Value], target: str = "") -> Value:
        """The value that a name gets; of one that has no meaning on symbols, nothing is known."""
        made = MadeOf(names, self.functions, self.known)
        try:
            value = self.value(node, names)
        except TROUBLES:
            return LOST if made.expression(node, target) else UNKNOWN
        if has_unknown(value) and isinstance(node, (ast.Tuple, ast.List)):
            return [self._value_of(x, names) for x in node.elts if not isinstance(x, ast.Starred)]
        unread = isinstance(node, ast.Call) and called_name(node.func) == UNREAD
        lost = value is UNKNOWN and replace(made, states=unread).expression(node, target)
        return LOST if lost else value

    def _loop(self, s: ast.For, names: dict[str, Value]) -> None:
        """Carry out a loop; of what one over too much changes, such as the steps of a solver, nothing is known."""
        before, stated = dict(names), len(self.stated)
        try:
            for x in self.iterated(s.iter, names):
                self._assign(s.target, x, names, s.lineno)
                self.carry_out(s.body, names)
        except TROUBLES:
            del self.stated[stated:]
            names.clear()
            names |= before
            self._leave_out(s, names)

    def _leave_out(self, s: ast.stmt, names: dict[str, Value]) -> None:
        """Nothing is known of what a statement with conditions changes, but that a parameter, or an input, is given."""
        changed = changed_by(s)
        lost = {x for x in changed if self.known(x) and not given_in(s, x, MadeOf(names, self.functions, self.known))}
        for name, own in changed.items():
            names[name] = LOST if name in lost else sp.Symbol(name) if self.known(name) and not own else UNKNOWN
            self.functions.pop(name, None)
            self.stated.append(Shown(s.lineno, name, UNKNOWN))
        if changed:
            self.left_out.append((s.lineno, s.end_lineno or s.lineno))
        if returns(s):
            raise ReturnedError(UNKNOWN)

    def _class(self, s: ast.ClassDef, names: dict[str, Value]) -> None:
        """The methods of a class are functions; its object has the fields that its first method sets. Of one whose
        parameters are something else than given values, nothing is known."""
        of = MadeOf(names, self.functions, self.known)
        held = [x for x in s.body if isinstance(x, (ast.Assign, ast.AnnAssign)) and x.value and of.expression(x.value)]
        fields = Fields({name: LOST for x in held for name in changed_by(x)})
        self.outer["self"] = fields
        first = None
        for method in s.body:
            if not isinstance(method, ast.FunctionDef):
                continue
            given = tuple(a.arg for a in method.args.args)
            made = OwnFunction(method.name, given[given[:1] == ("self",) :], method.body, None, method.args.defaults)
            if method.name == "__init__":
                first = made
            else:
                fields.values[method.name] = self.functions[method.name] = made
        if first is not None:
            Calling.function(self, first, [sp.Symbol(x) for x in first.arguments])
        own = [x for x in s.body if isinstance(x, ast.FunctionDef) and x.decorator_list and self.known(x.name)]
        lost = [x for name, x in fields.values.items() if x is LOST or (self.known(name) and of.value(x, name))]
        if own or lost or any(map(of.expression, s.bases)):
            names[s.name] = LOST

    def _shown(self, s: ast.Expr, names: dict[str, Value]) -> None:
        """A statement that is a value alone, or that prints some."""
        before = set(self.used)
        call = s.value if isinstance(s.value, ast.Call) else None
        called = "" if call is None else called_name(call.func)
        if call is not None and (called in SHOWN or called in SOLVING):
            for value in self._printed(call, names):
                self.used = before if isinstance(value, Outside) else self.used
                if self._is_check(value, before, names):
                    continue
                self.stated += [Shown(s.lineno, None, v, True) for v in self.flat(value)]
            return
        value = self.value(s.value, names)
        if called == "append" and call is not None and isinstance(call.func, ast.Attribute):
            self.used -= {getattr(call.func.value, "id", "")} - before  # a list that is filled is not used by that
        if not isinstance(s.value, ast.Constant):
            of = s.value.id if isinstance(s.value, ast.Name) else ""
            self.stated += [Shown(s.lineno, None, v, True, of) for v in self.flat(value)]

    def _printed(self, call: ast.Call, names: dict[str, Value]) -> Iterator[Value]:
        """The values that a call shows; print(left, "=", right) shows an equation."""
        parts = [y for x in call.args for y in (x.values if isinstance(x, ast.JoinedStr) else [x])]
        args = [x.value if isinstance(x, ast.FormattedValue) else x for x in parts]
        equals = [isinstance(x, ast.Constant) and str(x.value).strip() in ("=", "==") for x in args]
        k = 0
        while k < len(args):
            sides = [self.value(args[k], names)]
            if equals[k : k + 3] == [False, True, False]:
                sides.append(self.value(args[k + 2], names))
            yield from [equated(*sides)] if len(sides) > 1 and all(map(is_sided, sides)) else sides
            k += 2 * len(sides) - 1

    def _is_check(self, value: Value, before: set[str], names: dict[str, Value]) -> bool:
        """Whether a value that is shown is 0 everywhere: a check, which uses nothing but what a method formed."""
        parts = self.flat(value)
        if not parts or not all(isinstance(x, sp.Expr) and bounded.expand(x) == 0 for x in parts):
            return False
        formed = [x for _, method in self.methods for x in method.formed]
        self.used = before | {x for x in self.used - before if any(names.get(x) is y for y in formed)}
        return True

    def _assign(self, target: ast.expr, value: Value, names: dict[str, Value], line: int) -> None:
        if isinstance(target, (ast.Tuple, ast.List)):
            if isinstance(value, State):
                value = [value.entry(k + 1) for k in range(len(target.elts))]
            elif isinstance(value, Outside):
                value = [value] * len(target.elts)
            parts = listed(value)
            if len(parts) != len(target.elts):
                raise AbandonedError
            for one, part in zip(target.elts, parts, strict=True):
                self._assign(one, part, names, line)
        elif isinstance(target, ast.Name):
            if isinstance(value, Outside) and value is not LOST and self.known(target.id):
                value = sp.Symbol(target.id)  # F = workpiece(t, x), which the program has elsewhere
            given = isinstance(value, sp.Symbol) and not self.known(value.name) and "[" not in value.name
            given = given or (
                isinstance(value, sp.Expr) and value.free_symbols <= {TIME} and not value.atoms(AppliedUndef)
            )
            known = self.known(target.id)
            if isinstance(value, sp.Expr) and given and (known or target.id in self.said):
                value = sp.Symbol(target.id) if self.values.stands_for(target.id, value) else value
            elif isinstance(value, sp.Expr) and value.is_number and not known:
                value = self._of_value(value, target.id, line)
            names[target.id] = value = self._table(value, line)
            if isinstance(value, sp.Symbol) and "[" in value.name:
                self.aliases.setdefault(value, target.id)
            self.stated.append(Shown(line, target.id, value))
            self.lines |= {value: line} if isinstance(value, sp.Expr) else {}
        elif isinstance(target, ast.Subscript) or (self.matlab and isinstance(target, ast.Call)):
            self._put(target, value, names)
            self.lines |= {value: line} if isinstance(value, sp.Expr) else {}
        elif not isinstance(target, ast.Attribute):
            raise AbandonedError
        elif isinstance(of := self.value(target.value, names), Mass) and target.attr == "potential_energy":
            of.potential = scalar(value)
        elif isinstance(of, Fields):
            self._assign(ast.Name(target.attr), value, of.values, line)
        elif of is not LIBRARY and MadeOf(names, self.functions, self.known).value(value, target.attr):
            if not isinstance(target.value, ast.Name):
                raise AbandonedError
            names[target.value.id] = LOST

    def _table(self, value: Value, line: int) -> Value:
        """A table of numbers is one of parameters, dict(m=1, l=2): those of the system are their symbols."""
        if not isinstance(value, dict) or not value or not all(isinstance(x, str) for x in value):
            return value
        if not all(isinstance(x, (sp.Expr, str, Outside)) for x in value.values()):
            return value
        fields = Fields()
        for name, x in value.items():
            self._assign(ast.Name(name), x, fields.values, line)
        return fields

    def _of_value(self, value: sp.Expr, name: str, line: int) -> Value:
        """A number that a program gives to a name of its own, or the one parameter of this value that it does not name;
        nothing is known where the comment behind says something else."""
        same = of_value(value, self.valued)
        if same is not None and says_else(self.behind.get(line, ""), same):
            return LOST
        self.read_as |= {} if same is None else {name: same.name}
        return value if same is None else same.symbol

    def _put(self, target: ast.Subscript | ast.Call, value: Value, names: dict[str, Value]) -> None:
        """An entry of a list or a column gets a value; in MATLAB a column grows."""
        held = target.value if isinstance(target, ast.Subscript) else target.func
        places = [target.slice] if isinstance(target, ast.Subscript) else target.args
        places = [x for p in places for x in (p.elts if isinstance(p, ast.Tuple) else [p])]
        if not isinstance(held, ast.Name) or not 0 < len(places) <= 2:
            raise AbandonedError
        if len(places) == 1 and isinstance(places[0], ast.Slice):
            self._put_several(held, places[0], value, names)
            return
        at = [number(self.value(x, names)) - int(self.matlab) for x in places]
        if not all(0 <= k < MOST_ENTRIES for k in at):
            raise AbandonedError
        before = names.get(held.id)
        if before is LOST or any(before is x for x in self.altered):
            raise AbandonedError
        shared = (
            []
            if self.matlab
            else [k for k, x in names.items() if k != held.id and any(x is y for y in mutable(before))]
        )
        names |= dict.fromkeys(shared, LOST)  # other names of the same list
        if not self.matlab and before is not None and is_list(before) and len(at) == 1 and at[0] < len(before):
            names[held.id] = [value if k == at[0] else x for k, x in enumerate(before)]
            self.stated.append(Shown(held.lineno, held.id, names[held.id]))
            return
        made = matrix(before) if isinstance(before, (list, tuple, MatrixBase)) and len(before) else sp.zeros(0, 0)
        flat = len(at) == 1 and made.shape[0] == 1
        row, column = (0, at[0]) if flat else (at[0], at[1] if len(at) > 1 else 0)
        larger = sp.zeros(max(made.shape[0], row + 1), max(made.shape[1], column + 1))
        larger[: made.shape[0], : made.shape[1]] = made
        larger[row, column] = scalar(value)
        names[held.id] = larger
        self.stated.append(Shown(held.lineno, held.id, larger))

    def _put_several(self, held: ast.Name, at: ast.Slice, value: Value, names: dict[str, Value]) -> None:
        """The entries from one place to another get values: dz(1:2) = v."""
        values, first = self.flat(value), int(self.matlab)
        start = 0 if at.lower is None else number(self.value(at.lower, names)) - first
        if at.upper is not None and number(self.value(at.upper, names)) - start != len(values):
            raise AbandonedError
        for k, one in enumerate(values):
            place = ast.Subscript(held, ast.Constant(start + k + first), ast.Store())
            self._put(place, one, names)


def _letters(value: Value) -> set[sp.Basic]:
    return value.free_symbols if isinstance(value, sp.Expr) else set()
