"""The values of the expressions of a program on symbols: operations, calls, entries."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.carried_out.mechanics import combined, made
from lagrangian.check.reading.carried_out.methods import MechanicsMethod, method
from lagrangian.check.reading.carried_out.routines import SHOWN, SOLVING, applied, pairs_of, replaced, routine
from lagrangian.check.reading.carried_out.values import (
    LIBRARY,
    LOST,
    MODULES,
    MOST_COLUMNS,
    MOST_ENTRIES,
    MOST_STEPS,
    TIME,
    UNKNOWN,
    AbandonedError,
    BoundMethod,
    Equation,
    Fields,
    Inverse,
    Mechanical,
    Outside,
    OwnFunction,
    ReturnedError,
    Routine,
    Shown,
    State,
    Value,
    added,
    bind,
    called_name,
    checked,
    constant,
    counted,
    entry_of,
    equated,
    has_unknown,
    is_scalar,
    is_square,
    joined,
    listed,
    matrix,
    number,
    over,
    power,
    times,
    transposed,
)
from lagrangian.records import dataclass, field

MOST_WORK = 200_000
"""The most operations of all results of a program together."""
DEEPEST = 8
"""How deep functions may call each other."""


@dataclass(eq=False)
class Evaluator:
    """Finds the values of expressions; ``matlab``: indices are in round brackets and from 1, A @ b is A\\b."""

    matlab: bool
    known: Callable[[str], bool] = lambda name: False
    """Whether a name is a parameter or an input of the system: what it is given, a number or the name of a function,
    does not take its place."""
    states: int = 0
    """How many entries a state has where a program says: up to the last."""
    stated: list[Shown] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    """The names whose values were used."""
    sides: set[str] = field(default_factory=set)
    """The names that are a side of an equation of the program."""
    called: set[OwnFunction] = field(default_factory=set)
    """The functions of the program that another of its values uses."""
    solved: dict[sp.Symbol, tuple[MatrixBase, MatrixBase, tuple[sp.Symbol, ...]]] = field(default_factory=dict)
    """For unknowns of linear equations A x = b: A, b and x."""
    aliases: dict[sp.Symbol, str] = field(default_factory=dict)
    """The names that entries of a state were given."""
    methods: list[tuple[int, MechanicsMethod]] = field(default_factory=list)
    """SymPy's methods that a program sets up."""
    lines: dict[sp.Expr, int] = field(default_factory=dict)
    """The lines where values were assigned last."""
    renamed: dict[str, str] = field(default_factory=dict)
    """The functions of time in whose places a program puts symbols."""
    functions: dict[str, OwnFunction] = field(default_factory=dict)
    outer: dict[str, Value] = field(default_factory=dict)
    """The names of the program outside of its functions."""
    several: list[Value] = field(default_factory=list)
    """All results of the function of MATLAB that was called last."""
    steps: int = 0
    work: int = 0
    """The operations of all results together."""
    depth: int = 0

    def carry_out(self, body: Sequence[ast.stmt], names: dict[str, Value]) -> None:
        """Carry out statements, which `Interpreter` does."""
        raise NotImplementedError

    def count(self) -> None:
        """Count a step; raise if they are too many."""
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise AbandonedError

    def flat(self, value: Value) -> list[Value]:
        """The entries of a list or a matrix, or a value alone."""
        return listed(value) if isinstance(value, (list, tuple, MatrixBase)) else [value]

    def value(self, node: ast.expr, names: dict[str, Value]) -> Value:
        """The value of an expression."""
        self.count()
        if isinstance(node, ast.Constant):
            return constant(node.value)
        if isinstance(node, ast.Name):
            return self._named(node.id, names)
        if isinstance(node, ast.BinOp):
            return self._kept(self.operated(node.op, self.value(node.left, names), self.value(node.right, names)))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            sign = sp.Integer(-1 if isinstance(node.op, ast.USub) else 1)
            return self.operated(ast.Mult(), sign, self.value(node.operand, names))
        if isinstance(node, (ast.List, ast.Tuple)):
            return checked([y for x in node.elts for y in self._unpacked(x, names)])
        if isinstance(node, ast.Dict):
            pairs = zip(node.keys, node.values, strict=True)
            return {self.value(k, names): self.value(v, names) for k, v in pairs if k}
        if isinstance(node, ast.Attribute):
            return self._attribute(node, names)
        if isinstance(node, ast.Call):
            return self._kept(self._call(node, names))
        if isinstance(node, ast.Subscript):
            return self._entry(self.value(node.value, names), node.slice, names)
        if isinstance(node, (ast.ListComp, ast.GeneratorExp)):
            return self._comprehended(node, names)
        if isinstance(node, ast.Lambda):
            made = OwnFunction("", tuple(a.arg for a in node.args.args), node.body)
            return self.functions.setdefault(f"line {node.lineno}, {node.col_offset}", made)
        if isinstance(node, ast.Compare) and self.matlab and len(node.ops) == 1 and isinstance(node.ops[0], ast.Eq):
            self.sides |= {x.id for x in (node.left, node.comparators[0]) if isinstance(x, ast.Name)}
            return equated(self.value(node.left, names), self.value(node.comparators[0], names))
        if isinstance(node, ast.FormattedValue):
            return self.value(node.value, names)
        if isinstance(node, ast.JoinedStr):
            return joined([self.value(x, names) for x in node.values])  # f"x{i}"
        raise AbandonedError

    def _unpacked(self, node: ast.expr, names: dict[str, Value]) -> list[Value]:
        """The entries that an entry of a list is: [0, *x, 0]."""
        return listed(self.value(node.value, names)) if isinstance(node, ast.Starred) else [self.value(node, names)]

    def _kept(self, value: Value) -> Value:
        """A result, whose operations are counted."""
        parts = value.flat() if isinstance(value, MatrixBase) else [value] if isinstance(value, sp.Expr) else []
        self.work += sum(map(bounded.size, parts))
        if self.work > MOST_WORK:
            raise AbandonedError
        return value

    def _named(self, name: str, names: dict[str, Value]) -> Value:
        self.used.add(name)
        if name in names:
            return names[name]
        if name in self.functions:
            return self.functions[name]
        if name in MODULES:
            return LIBRARY
        if name == "pi":
            return sp.pi
        if name == "t":
            return TIME
        return sp.Symbol(name)

    def operated(self, op: ast.operator, a: Value, b: Value) -> Value:
        """The value of a sum, product, quotient or power; of what is unknown, nothing is known."""
        if isinstance(a, Outside) or isinstance(b, Outside):
            return LOST if a is LOST or b is LOST else UNKNOWN
        if isinstance(a, Mechanical) or isinstance(b, Mechanical):
            return combined(op, a, b)
        if isinstance(op, (ast.Add, ast.Sub)):
            return added(a, b, 1 if isinstance(op, ast.Add) else -1)
        if isinstance(op, ast.MatMult) and self.matlab and is_scalar(a):
            return over(b, a)
        if isinstance(op, ast.MatMult) and self.matlab:  # A \ b
            return self._solution(matrix(a), matrix(b))
        if isinstance(op, (ast.Mult, ast.MatMult)):
            if isinstance(b, State) and isinstance(a, (MatrixBase, list)):
                b = sp.Matrix([b.entry(k + 1) for k in range(matrix(a).shape[1])])
            if isinstance(a, Inverse):
                return self._solution(a.matrix, matrix(b))
            return times(a, b)
        if isinstance(op, ast.Div):
            return over(a, b)
        if isinstance(op, ast.Pow):
            return power(a, b)
        raise AbandonedError

    def _solution(self, A: MatrixBase, b: MatrixBase) -> Value:
        """The column x of A x = b, as unknowns; of many columns nothing is known."""
        n = A.shape[0]
        if A.shape != (n, n) or b.shape[0] != n:
            raise AbandonedError
        if 1 < b.shape[1] <= MOST_COLUMNS:
            return sp.Matrix.hstack(*(self._solution(A, b[:, k]) for k in range(b.shape[1])))
        x = tuple(sp.Symbol(f"solved[{len(self.solved) + k}]") for k in range(n if b.shape[1] == 1 else 0))
        self.solved |= dict.fromkeys(x, (A, b, x))
        return sp.Matrix(x) if x else UNKNOWN

    def _attribute(self, node: ast.Attribute, names: dict[str, Value]) -> Value:
        if node.attr == "_t":
            return TIME  # dynamicsymbols._t
        of = self.value(node.value, names)
        if isinstance(of, Outside) and of is not LIBRARY:
            return sp.Symbol(node.attr) if self.known(node.attr) and of is not LOST else of  # p.m of p = Parameters()
        if isinstance(of, Outside):
            return sp.pi if node.attr == "pi" else Routine(node.attr)
        if isinstance(of, Mechanical):
            return of.attribute(node.attr)
        if isinstance(of, Routine):
            return Routine(node.attr)  # np.linalg.solve
        if node.attr == "T" and isinstance(of, (sp.Expr, MatrixBase, list)):
            return transposed(of, self.known)
        free = isinstance(of, sp.Symbol) and (self.matlab or not hasattr(of, node.attr))
        if isinstance(of, Fields):
            return of.value(node.attr)  # p.m
        if free:
            return sp.Symbol(node.attr)
        if isinstance(of, Equation) and node.attr in ("lhs", "rhs"):
            return of.left if node.attr == "lhs" else of.right
        return BoundMethod(of, node.attr)

    def _comprehended(self, node: ast.ListComp | ast.GeneratorExp, names: dict[str, Value]) -> list[Value]:
        if len(node.generators) != 1 or node.generators[0].ifs:
            raise AbandonedError
        inner = dict(names)
        found: list[Value] = []
        for x in self.iterated(node.generators[0].iter, names):
            bind(node.generators[0].target, x, inner)
            found.append(self.value(node.elt, inner))
        return found

    def iterated(self, node: ast.expr, names: dict[str, Value]) -> list[Value]:
        """What a loop goes through: a list, range(…), zip(…), enumerate(…)."""
        if isinstance(node, ast.Call) and (called := called_name(node.func)) in ("range", "zip", "enumerate"):
            found = counted(called, [self.value(x, names) for x in node.args])
        else:
            found = listed(self.value(node, names))
        if len(found) > MOST_ENTRIES:
            raise AbandonedError
        return found

    # -- calls -------------------------------------------------------------------------------------------------------

    def _call(self, node: ast.Call, names: dict[str, Value]) -> Value:
        called = called_name(node.func)
        if isinstance(node.func, ast.Name) and called not in names and called not in self.functions:
            of: Value = Routine(called)
        else:
            of = self.value(node.func, names)
        if isinstance(of, Routine) and of.name in (*SHOWN, *SOLVING):
            given = [self.value(x, names) for x in node.args if not isinstance(x, ast.Starred)]
            if of.name == "solve" and len(given) == 2 and is_square(given[0]):
                return self._solution(matrix(given[0]), matrix(given[1]))
            if of.name in SOLVING and given:
                self.stated += [Shown(node.lineno, None, v, True) for v in self.flat(given[0])]
            return UNKNOWN
        if isinstance(of, State) or (self.matlab and isinstance(of, (MatrixBase, list))):
            return self._entry(
                of, ast.Tuple(list(node.args), ast.Load()) if len(node.args) > 1 else node.args[0], names
            )
        self.sides |= {x.id for x in node.args if isinstance(x, ast.Name) and called == "Eq"}
        given = [self.value(x, names) for x in node.args if not isinstance(x, ast.Starred)]
        options = {k.arg: self.value(k.value, names) for k in node.keywords if k.arg}
        if isinstance(of, OwnFunction):
            return self.function(of, given, called)
        if isinstance(of, BoundMethod):
            own = isinstance(of.of, Mechanical)
            return of.of.call(of.name, given, options) if own else self._method(of, given)
        if isinstance(of, (UndefinedFunction, sp.Basic)) and not isinstance(of, Outside):
            return applied(of, given)
        if isinstance(of, Routine):
            return self._routine(of.name, given, options, node)
        return of if of is LOST else UNKNOWN

    def _routine(self, name: str, given: Sequence[Value], options: dict[str, Value], node: ast.Call) -> Value:
        if any(map(has_unknown, given)):
            return UNKNOWN
        if (of := made(name, given, options) or method(name, given, options)) is not None:
            self.methods += [(node.lineno, of)] if isinstance(of, MechanicsMethod) else []
            return of
        if name in ("subs", "Subs") and len(given) > 1:
            return self._replaced(given[0], pairs_of(given[1:]))
        if self.matlab and isinstance(node.func, ast.Name) and given and not options:
            found = routine(name, given, options, matlab=True)
            if isinstance(found, Outside) and list(given) == [TIME]:
                return sp.Symbol(name)  # tau(t), a function that the program does not hold
            if isinstance(found, Outside) and all(isinstance(x, sp.Integer) for x in given):
                return State(name).entry(number(given[0]))  # z(2), where nothing says what z is
            return found
        if not given and name != "Function":
            return options if options and all(map(is_scalar, options.values())) else UNKNOWN  # dict(m=1, l=2)
        return routine(name, given, options)

    def function(self, of: OwnFunction, given: Sequence[Value], called: str = "") -> Value:
        """The value of a function of the program, which may have no name but that by which it is ``called``."""
        if self.known(of.name or called) and list(given) == [TIME]:
            return sp.Symbol(of.name or called)  # an input, of which the program has an example
        self.depth += 1
        if self.depth > DEEPEST:
            raise AbandonedError
        names = self.outer | dict(zip(of.arguments, given, strict=False))
        try:
            if isinstance(of.body, ast.expr):
                return self.value(of.body, names)
            self.carry_out(of.body, names)
            self.several = [names.get(x, UNKNOWN) for x in (of.out or "").split(",")]
            return self.several[0]
        except ReturnedError as returned:
            return returned.value
        finally:
            self.depth -= 1

    def _replaced(self, value: Value, pairs: dict[Any, Any]) -> Value:
        """A value with others in place of parts; a symbol in place of a function of time is a name of this."""
        for old, new in pairs.items():
            if isinstance(old, AppliedUndef) and isinstance(new, sp.Symbol):
                self.renamed[new.name] = str(old.func)
        return replaced(value, pairs)

    def _method(self, of: BoundMethod, given: Sequence[Value]) -> Value:
        value, name = of.of, of.name
        if isinstance(value, Outside):
            return UNKNOWN
        if name == "subs":
            return self._replaced(value, pairs_of(given))
        if name in ("LUsolve", "solve", "gauss_jordan_solve", "LDLsolve", "cholesky_solve") and given:
            return self._solution(matrix(value), matrix(given[0]))
        if name in ("append", "extend") and isinstance(value, list):
            value.append(given[0]) if name == "append" else value.extend(checked(listed(given[0])))
            checked(value)
            return UNKNOWN
        if name == "reshape" or (name == "applyfunc" and not isinstance(given[0], OwnFunction)):
            return value
        if name == "col" and isinstance(value, MatrixBase):
            return value[:, number(given[0])]
        if name == "row" and isinstance(value, MatrixBase):
            return value[number(given[0]), :]
        made = routine(name, [value, *given], {})
        if isinstance(made, Outside):
            raise AbandonedError
        return made

    def _entry(self, of: Value, at: ast.expr, names: dict[str, Value]) -> Value:
        """An entry or a part of a list, a matrix or a state."""
        if isinstance(of, Outside):
            return UNKNOWN
        said = names.get(at.id) if isinstance(at, ast.Name) else getattr(at, "value", None)
        if isinstance(of, (Fields, sp.Symbol, Routine)) and isinstance(said, str):
            return of.value(said) if isinstance(of, Fields) else sp.Symbol(said)
        if isinstance(of, dict):
            return of.get(self.value(at, names), UNKNOWN)
        if isinstance(of, Routine) and of.name == "r_":  # np.r_[v, a]
            return [x for part in listed(self.value(at, names)) for x in self.flat(part)]
        first = int(self.matlab)
        if isinstance(of, State):
            if isinstance(at, ast.Slice):
                start = self._bound(at.lower, names, 0, first)
                half = bool(of.entries) and max(of.entries) <= self.states // 2 and at.lower is None  # v(:), of rates
                end = self._bound(at.upper, names, self.states // 2 if half else self.states, 0)
                found = [of.entry(k + 1) for k in range(start, end)]
                return sp.Matrix(found) if found else found
            return of.entry(number(self.value(at, names)) + 1 - first)
        if isinstance(at, ast.Tuple) and isinstance(of, MatrixBase) and len(at.elts) == 2:
            row, column = (x if isinstance(x, ast.Slice) else number(self.value(x, names)) - first for x in at.elts)
            if isinstance(row, ast.Slice) and isinstance(column, ast.Slice):
                return of
            if isinstance(row, ast.Slice) or isinstance(column, ast.Slice):
                return of[:, column] if isinstance(row, ast.Slice) else of[row, :]
            return entry_of(of, row, column)
        if isinstance(at, ast.Slice):
            entries = listed(of)
            start = self._bound(at.lower, names, 0, first)
            end = self._bound(at.upper, names, len(entries), 0)
            found = entries[start:end]
            return sp.Matrix(found) if isinstance(of, MatrixBase) else found
        entries = [of] if is_scalar(of) else listed(of)  # (v.T*v)[0]
        k = number(self.value(at, names)) - first
        if not -len(entries) <= k < len(entries):
            raise AbandonedError
        return entries[k]

    def _bound(self, node: ast.expr | None, names: dict[str, Value], default: int, first: int) -> int:
        return default if node is None else number(self.value(node, names)) - first
