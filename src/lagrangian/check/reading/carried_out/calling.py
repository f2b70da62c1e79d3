"""The values of calls in a program on symbols: its own functions, those of libraries, methods."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.mechanics import made
from lagrangian.check.reading.carried_out.methods import MechanicsMethod, method
from lagrangian.check.reading.carried_out.routines import SHOWN, SOLVING, applied, pairs_of, replaced, routine
from lagrangian.check.reading.carried_out.values import (
    LOST,
    TIME,
    UNKNOWN,
    AbandonedError,
    BoundMethod,
    Fields,
    Mechanical,
    Outside,
    OwnFunction,
    ReturnedError,
    Routine,
    Shown,
    SolverOptions,
    State,
    Value,
    called_name,
    checked,
    has_unknown,
    is_scalar,
    is_square,
    listed,
    matrix,
    number,
)
from lagrangian.records import dataclass

DEEPEST = 8
"""How deep functions may call each other."""


@dataclass(eq=False)
class Calling(Evaluator):
    """Finds the values of calls."""

    def call(self, node: ast.Call, names: dict[str, Value]) -> Value:
        """The value of a call."""
        called = called_name(node.func)
        if isinstance(node.func, ast.Name) and called not in names and called not in self.functions:
            of: Value = Routine(called)
        else:
            of = self.value(node.func, names)
        if isinstance(of, Routine) and of.name in (*SHOWN, *SOLVING):
            given = [self.value(x, names) for x in node.args if not isinstance(x, ast.Starred)]
            if of.name == "solve" and len(given) == 2 and is_square(given[0]):
                return self.solution(matrix(given[0]), matrix(given[1]))
            if of.name in SOLVING and given:
                self.stated += [Shown(node.lineno, None, v, True) for v in self.flat(given[0])]
            return UNKNOWN
        if isinstance(of, State) or (self.matlab and isinstance(of, (MatrixBase, list))):
            return self.entry(of, ast.Tuple(list(node.args), ast.Load()) if len(node.args) > 1 else node.args[0], names)
        self.sides |= {x.id for x in node.args if isinstance(x, ast.Name) and called == "Eq"}
        given = [y for x in node.args for y in self.unpacked(x, names)]
        options = {k.arg: self.value(k.value, names) for k in node.keywords if k.arg}
        if isinstance(of, OwnFunction):
            for table in (self.value(k.value, names) for k in node.keywords if not k.arg):  # f(**p)
                if not isinstance(table, (Fields, dict, sp.Symbol)):
                    raise AbandonedError
                options |= table.values if isinstance(table, Fields) else table if isinstance(table, dict) else {}
            return self.function(of, self._bound_to(of, given, options), called)
        if isinstance(of, BoundMethod):
            own = isinstance(of.of, Mechanical)
            return of.of.call(of.name, given, options) if own else self._method(of, given)
        if isinstance(of, (UndefinedFunction, sp.Basic)) and not isinstance(of, Outside):
            return applied(of, given)
        if isinstance(of, Routine):
            return self._routine(of.name, given, options, node)
        return of if of is LOST else UNKNOWN

    def _routine(self, name: str, given: Sequence[Value], options: dict[str, Value], node: ast.Call) -> Value:
        if name == "odeset":
            return _options(given)
        self.mass = next((x.mass for x in given if isinstance(x, SolverOptions)), self.mass)
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

    def _bound_to(self, of: OwnFunction, given: Sequence[Value], options: Mapping[str, Value]) -> list[Value]:
        """What the arguments of a function of the program are, also by their names and by what they are else."""
        if not options.keys() <= {*of.arguments[len(given) :]}:
            raise AbandonedError
        made, left = list(given), of.arguments[len(given) :]
        defaults = dict(zip(reversed(of.arguments), reversed(of.defaults), strict=False))
        for name in left:
            if name not in options and name not in defaults:
                if options or defaults.keys() & set(left):
                    raise AbandonedError
                break  # an argument that nothing gives
            value = options[name] if name in options else self.value(defaults[name], self.outer)
            given_number = name not in options and self.known(name) and isinstance(value, sp.Number)
            made.append(sp.Symbol(name) if given_number else value)
        return made

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
            return self.solution(matrix(value), matrix(given[0]))
        if isinstance(value, dict) and name in ("items", "keys", "values"):
            return [list(x) for x in value.items()] if name == "items" else list(getattr(value, name)())
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


def _options(given: Sequence[Value]) -> SolverOptions:
    """What odeset makes: the options in front, if there are some, with a mass matrix that is given behind its name."""
    before = given[0] if given and isinstance(given[0], SolverOptions) else None
    named = given[1:] if before is not None else given
    places = [k for k, x in enumerate(named[::2]) if x == "Mass"]
    mass = named[2 * places[-1] + 1] if places and 2 * places[-1] + 1 < len(named) else None
    return SolverOptions(mass if mass is not None or before is None else before.mass)
