"""Data classes that are compiled at their first use behave as the standard ones in all that is asked of them."""

import copy
import dataclasses
import inspect
import pickle
from collections.abc import Callable
from dataclasses import field
from functools import cached_property
from typing import Any, ClassVar

import pytest

from lagrangian import records

OPTIONS = [{}, {"frozen": True}, {"frozen": True, "eq": False}, {"eq": False}, {"frozen": True, "kw_only": True}]


def made(decorator: Any, options: dict[str, bool]) -> tuple[Any, Any]:
    """A class and one that inherits from it, by one of the two decorators."""

    @decorator(**options)
    class Base:
        name: str
        weight: float = field(default=1.0, compare=False)
        KIND: ClassVar[str] = "none"

        def __post_init__(self) -> None:
            if not self.name:
                raise ValueError("no name")

        @cached_property
        def size(self) -> int:
            return len(self.name)

    @decorator(**options)
    class Child(Base):
        parts: list[int] = field(default_factory=list, hash=False)
        hidden: tuple[int, ...] = field(default=(), repr=False, init=False)

    return Base, Child


def told(call: Callable[[], Any]) -> Any:
    """What a call returns, or its error, without the places where functions are."""
    try:
        return call()
    except Exception as error:
        return type(error), str(error)


def answers(decorator: Any, options: dict[str, bool]) -> list[Any]:
    base, child = made(decorator, options)
    x, y, z = child(name="a"), child(name="a", weight=2.0), child(name="a", parts=[1])
    calls: list[Callable[[], Any]] = [
        lambda: (repr(base(name="ab")), repr(child(name="ab"))),
        lambda: (x == y, x == z, x != y, x == base(name="a"), x == 1, x == x),
        lambda: (hash(x) == hash(y), hash(x) == hash(z), base.__hash__ is None),
        lambda: child("b", 3.0, [1]).parts,
        lambda: (x.parts is not child(name="a").parts, x.hidden, x.KIND, base(name="abc").size),
        lambda: base(),
        lambda: base("a", unknown=1),
        lambda: base(name=""),
        lambda: setattr(x, "name", "c") or x.name,
        lambda: setattr(x, "other", 1) or x.other,
        lambda: delattr(y, "name"),
        lambda: str(inspect.signature(child)),
        lambda: [(f.name, f.init, f.repr) for f in dataclasses.fields(child)],
        lambda: (dataclasses.replace(z, name="n").name, dataclasses.asdict(z)),
        lambda: repr(copy.deepcopy(z)),
        lambda: (base.__match_args__, child.__match_args__),
    ]
    return [told(call) for call in calls]


@pytest.mark.parametrize("options", OPTIONS)
def test_they_behave_as_the_standard_ones(options: dict[str, bool]) -> None:
    assert answers(records.dataclass, options) == answers(dataclasses.dataclass, options)


@records.dataclass(frozen=True)
class Kept:
    """At the top of a file, as what is pickled must be."""

    name: str
    inner: tuple["Kept", ...] = ()


def test_objects_are_pickled_and_nothing_is_compiled_before_it_is_used() -> None:
    whole = Kept("a", (Kept("b"),))
    assert "__eq__" in vars(Kept) and not inspect.isfunction(vars(Kept)["__eq__"])
    assert pickle.loads(pickle.dumps(whole)) == whole and {whole: 1}[Kept("a", (Kept("b"),))] == 1
    assert all(inspect.isfunction(vars(Kept)[name]) for name in ("__init__", "__eq__", "__hash__"))


def test_a_record_that_holds_itself_is_printed() -> None:
    @records.dataclass
    class Knot:
        ends: list[Any]

    knot = Knot([])
    knot.ends.append(knot)
    assert repr(knot).endswith("Knot(ends=[...])")
