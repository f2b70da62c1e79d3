"""Carries out a program that closes a loop with its inputs as they are: F = -kp*x - kd*v, tau = controller(t, y)."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence

import sympy as sp

from lagrangian.check.reading.carried_out.interpreter import Interpreter
from lagrangian.check.reading.carried_out.values import NAME, TIME, OwnFunction, Value, is_scalar, scalar
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.model import Model
from lagrangian.records import dataclass, field


@dataclass(eq=False)
class OpenInterpreter(Interpreter):
    """Carries out a program; an input of the system to which it gives a value is not replaced by this value."""

    inputs: Mapping[str, str] = field(default_factory=dict)
    """The inputs of the system, by the names that the program has for them."""
    closed: dict[str, set[sp.Basic]] = field(default_factory=dict)
    """The letters in what the program gives each input, but for numbers and functions of time."""

    def _assign(self, target: ast.expr, value: Value, names: dict[str, Value], line: int) -> None:
        if isinstance(target, ast.Name) and target.id in self.inputs:
            value = self._input(target.id, value)
        super()._assign(target, value, names, line)

    def function(self, of: OwnFunction, given: Sequence[Value], called: str = "") -> Value:
        """The value of a function of the program; one that is called as an input is this input."""
        value = super().function(of, given, called)
        return self._input(called, value) if called in self.inputs and given else value

    def _input(self, name: str, value: Value) -> Value:
        """The input itself, where its value comes from a state and not from another value of it."""
        if not is_scalar(value):
            return value
        letters = set(scalar(value).free_symbols) - {TIME}
        symbol = sp.Symbol(name)
        if not letters or symbol in letters:
            return value
        self.closed.setdefault(name, set()).update(letters)
        return symbol


def names_in(tree: ast.Module) -> set[str]:
    """The names in a program."""
    said: set[str] = set()
    for x in ast.walk(tree):
        if isinstance(x, ast.Constant) and isinstance(x.value, str):
            said.update(NAME.findall(x.value))  # symbols("m g")
        elif isinstance(x, (ast.Name, ast.Attribute, ast.arg)):
            said.add(x.id if isinstance(x, ast.Name) else x.attr if isinstance(x, ast.Attribute) else x.arg)
    return said


def inputs_named(tree: ast.Module, scope: AnswerScope, model: Model) -> dict[str, str]:
    """The inputs of the system that a program names, by its names for them."""
    return {x: u.name for x in names_in(tree) for u in model.inputs if u.name in scope.meanings(x)[0]}
