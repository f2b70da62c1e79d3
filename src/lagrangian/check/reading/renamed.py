"""Reads an answer with letters of its own that it declares in words: c instead of k.

It is read with a system that has these names; the symbols of the lines are those of the system in any case.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeVar

import sympy as sp

from lagrangian.check.reading.answer import Answer, AnswerLine
from lagrangian.check.reading.placeholders import generalized_force
from lagrangian.model import Coordinate, Definition, Input, Model, Parameter
from lagrangian.read.letters import key

Named = TypeVar("Named", Coordinate, Parameter, Input, Definition)


def renamed(model: Model, names: Mapping[str, str]) -> Model:
    """Return a system whose quantities have other names, and the same symbols.

    One whose letter another takes, and that gets none, keeps a name that no answer writes.
    """
    taken = {key(x) for x in names.values()}

    def named(x: Named) -> Named:
        hidden = f"{x.name} of the system" if key(x.name) in taken else x.name
        return replace(x, name=names.get(x.name, hidden))

    return replace(
        model,
        coordinates=tuple(map(named, model.coordinates)),
        parameters=tuple(map(named, model.parameters)),
        inputs=tuple(map(named, model.inputs)),
        definitions=tuple(map(named, model.definitions)),
        _memo={},
    )


def restored(answer: Answer, model: Model, names: Mapping[str, str], notes: tuple[str, ...]) -> Answer:
    """Return an answer to a renamed system as one to the ``model`` itself, with ``notes`` in front."""
    back = {new: own for own, new in names.items()} | {f"{x} of the system": x for x in model.symbols}
    forces = {generalized_force(new): generalized_force(own) for new, own in back.items()}
    same_key = {key(new): key(own) for new, own in back.items()}
    same = {u.symbol: model.symbols[u.name] for u in answer.unknown if u.name in model.symbols}
    table = {**forces, **{a: b for a, b in same.items() if a != b}}

    def put(expr: sp.Expr) -> sp.Expr:
        return expr.xreplace(table).doit(deep=False) if table and expr.atoms(*map(type, table)) & table.keys() else expr

    def line(x: AnswerLine) -> AnswerLine:
        lhs = None if x.lhs is None else put(x.lhs)
        name = None if x.name is None else back.get(x.name, x.name)
        keys = frozenset(same_key.get(k, k) for k in x.names)
        return replace(x, lhs=lhs, rhs=put(x.rhs), name=name, names=keys)

    def again(read: Callable[[], Answer]) -> Callable[[], Answer]:
        return lambda: restored(read(), model, names, notes)

    marked = answer.read_marked
    return replace(
        answer,
        lines=tuple(map(line, answer.lines)),
        unknown=tuple(u for u in answer.unknown if u.name not in model.symbols),
        notes=(*notes, *answer.notes),
        others=tuple(map(again, answer.others)),
        read_marked=None if marked is None else lambda marks: restored(marked(marks), model, names, notes),
    )
