"""Reads an answer with letters of its own that it declares in words: c instead of k.

It is read with a system that has these names; the symbols of the lines are those of the system in any case.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import partial
from typing import TypeVar

import sympy as sp

from lagrangian.check.reading.answer import Answer, AnswerLine
from lagrangian.check.reading.placeholders import generalized_force
from lagrangian.check.reading.said.own_names import declarations
from lagrangian.check.reading.said.own_parameters import own_letters_of
from lagrangian.errors import ParseError
from lagrangian.model import Coordinate, Definition, Input, Model, Parameter
from lagrangian.read.letters import key

Named = TypeVar("Named", Coordinate, Parameter, Input, Definition)


def read_in_own_letters(text: str, model: Model, read: Callable[[str, Model], Answer]) -> Answer:
    """The content of an answer, in whose sentences names of the system may be renamed, and which may use letters of
    parameters for what changes with time."""
    said = declarations(text, model)
    own = own_letters_of(said.text, model)
    free = set(own.may) - said.names.keys() - set(said.names.values())

    def parsed(hidden: frozenset[str]) -> Answer:
        notes = (*said.notes, *(f"{x} was read as your own: you give it a value that moves." for x in sorted(hidden)))
        if not said.names and not hidden:
            found = read(said.text, model)
            return replace(found, notes=(*notes, *found.notes))
        return restored(read(said.text, renamed(model, said.names, hidden)), model, said.names, notes)

    more = own.sure | free
    try:
        found = parsed(own.sure)
    except ParseError:
        if not free:
            raise
        try:
            return parsed(more)
        except ParseError:
            pass
        raise
    return replace(found, others=(*found.others, partial(parsed, more))) if free else found


def renamed(model: Model, names: Mapping[str, str], hidden: Collection[str] = ()) -> Model:
    """Return a system whose quantities have other names, and the same symbols.

    One whose letter another takes, or that is ``hidden``, and that gets none, keeps a name that no answer writes.
    """
    taken = {key(x) for x in (*names.values(), *hidden)}

    def named(x: Named) -> Named:
        kept = f"{x.name} of the system" if key(x.name) in taken else x.name
        return replace(x, name=names.get(x.name, kept))

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
