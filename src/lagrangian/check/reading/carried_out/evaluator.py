"""The values of the expressions of a program on symbols: operations, calls, entries."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.carried_out.mechanics import combined
from lagrangian.check.reading.carried_out.methods import MechanicsMethod
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
    is_scalar,
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
    mass: Value = None
    """The matrix of a solver's options that multiplies the rates of a state, or the function that gives it."""
    steps: int = 0
    work: int = 0
    """The operations of all results together."""
    depth: int = 0

    def carry_out(self, body: Sequence[ast.stmt], names: dict[str, Value]) -> None:
        """Carry out statements, which `Interpreter` does."""
        raise NotImplementedError

    def function(self, of: OwnFunction, given: Sequence[Value], called: str = "") -> Value:
        """The value of a function of the program, which `Calling` finds."""
        raise NotImplementedError

    def call(self, node: ast.Call, names: dict[str, Value]) -> Value:
        """The value of a call, which `Calling` finds."""
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
            return checked([y for x in node.elts for y in self.unpacked(x, names)])
        if isinstance(node, ast.Dict):
            pairs = zip(node.keys, node.values, strict=True)
            return {self.value(k, names): self.value(v, names) for k, v in pairs if k}
        if isinstance(node, ast.Attribute):
            return self._attribute(node, names)
        if isinstance(node, ast.Call):
            return self._kept(self.call(node, names))
        if isinstance(node, ast.Subscript):
            return self.entry(self.value(node.value, names), node.slice, names)
        if isinstance(node, (ast.ListComp, ast.GeneratorExp)):
            return [x for (x,) in self._comprehended(node.generators, [node.elt], names)]
        if isinstance(node, ast.DictComp):
            return dict(map(tuple, self._comprehended(node.generators, [node.key, node.value], names)))
        if isinstance(node, ast.Lambda):
            made = OwnFunction("", tuple(a.arg for a in node.args.args), node.body, None, tuple(node.args.defaults))
            return self.functions.setdefault(f"line {node.lineno}, {node.col_offset}", made)
        if isinstance(node, ast.Compare) and self.matlab and len(node.ops) == 1 and isinstance(node.ops[0], ast.Eq):
            self.sides |= {x.id for x in (node.left, node.comparators[0]) if isinstance(x, ast.Name)}
            return equated(self.value(node.left, names), self.value(node.comparators[0], names))
        if isinstance(node, ast.FormattedValue):
            return self.value(node.value, names)
        if isinstance(node, ast.JoinedStr):
            return joined([self.value(x, names) for x in node.values])  # f"x{i}"
        raise AbandonedError

    def unpacked(self, node: ast.expr, names: dict[str, Value]) -> list[Value]:
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
            return self.solution(matrix(a), matrix(b))
        if isinstance(op, (ast.Mult, ast.MatMult)):
            if isinstance(b, State) and isinstance(a, (MatrixBase, list)):
                b = sp.Matrix([b.entry(k + 1) for k in range(matrix(a).shape[1])])
            if isinstance(a, Inverse):
                return self.solution(a.matrix, matrix(b))
            return times(a, b)
        if isinstance(op, ast.Div):
            return over(a, b)
        if isinstance(op, ast.Pow):
            return power(a, b)
        raise AbandonedError

    def solution(self, A: MatrixBase, b: MatrixBase) -> Value:
        """The column x of A x = b, as unknowns; of many columns nothing is known."""
        n = A.shape[0]
        if A.shape != (n, n) or b.shape[0] != n:
            raise AbandonedError
        if 1 < b.shape[1] <= MOST_COLUMNS:
            return sp.Matrix.hstack(*(self.solution(A, b[:, k]) for k in range(b.shape[1])))
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

    def _comprehended(
        self, generators: Sequence[ast.comprehension], parts: Sequence[ast.expr], names: dict[str, Value]
    ) -> list[list[Value]]:
        """The values of the parts of a comprehension, each time that it is carried out."""
        first, *others = generators
        if first.ifs:
            raise AbandonedError
        inner = dict(names)
        found: list[list[Value]] = []
        for x in self.iterated(first.iter, names):
            bind(first.target, x, inner)
            found += (
                self._comprehended(others, parts, inner) if others else [[self.value(part, inner) for part in parts]]
            )
        return checked(found)

    def iterated(self, node: ast.expr, names: dict[str, Value]) -> list[Value]:
        """What a loop goes through: a list, range(…), zip(…), enumerate(…)."""
        if isinstance(node, ast.Call) and (called := called_name(node.func)) in ("range", "zip", "enumerate"):
            found = counted(called, [self.value(x, names) for x in node.args])
        else:
            found = listed(self.value(node, names))
        if len(found) > MOST_ENTRIES:
            raise AbandonedError
        return found

    def entry(self, of: Value, at: ast.expr, names: dict[str, Value]) -> Value:
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
