"""Program: named inputs to named outputs, the one type that connects mechanics with numerical code."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from math import prod
from typing import Any, TypeVar, cast

from lagrangian.graph.graph import LEAVES, Graph, operands
from lagrangian.records import dataclass, field

T = TypeVar("T")


@dataclass(frozen=True)
class Output:
    """An array of results: its node ids, row after row, and its shape (``()`` for one number)."""

    ids: tuple[int, ...]
    shape: tuple[int, ...]

    def __post_init__(self) -> None:
        if len(self.ids) != prod(self.shape):
            raise ValueError(f"an output of shape {self.shape} needs {prod(self.shape)} ids, not {len(self.ids)}")


@dataclass(frozen=True)
class Program:
    """A graph with named inputs and outputs.

    ``inputs``: group → names of its entries in order; ``("input", group, k)`` is the k-th. ``outputs``: name →
    `Output`. ``defaults``: the values of the entries of the group ``"p"``, None if a value must be given.
    """

    name: str
    graph: Graph
    inputs: Mapping[str, tuple[str, ...]]
    outputs: Mapping[str, Output]
    defaults: Mapping[str, float | None] = field(default_factory=dict[str, float | None])
    _memo: dict[Any, Any] = field(default_factory=dict[Any, Any], init=False, repr=False, compare=False)

    def remembered(self, key: Any, make: Callable[[], T]) -> T:
        """Return what ``make`` computes from this program, cached under a key as long as the program exists."""
        if key not in self._memo:
            self._memo[key] = make()
        return self._memo[key]

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_memo": {}}

    @property
    def ids(self) -> tuple[int, ...]:
        """The node ids of all outputs, one output after another."""
        return tuple(i for output in self.outputs.values() for i in output.ids)


def reached(graph: Graph, ids: Iterable[int], stop: Iterable[int] = ()) -> list[int]:
    """The nodes that ``ids`` need, in ascending order; nodes behind those in ``stop`` are not visited."""
    nodes = graph.nodes
    seen: set[int] = set()
    halt = cast("Container[int]", stop) if isinstance(stop, (set, frozenset, Mapping)) else set(stop)
    stack = list(ids)
    while stack:
        i = stack.pop()
        if i in seen:
            continue
        seen.add(i)
        if i in halt:
            continue
        node = nodes[i]
        op = node[0]
        if op == "powi":
            stack.append(node[1])
        elif op not in LEAVES:
            stack.extend(node[1:])
    return sorted(seen)


@dataclass(frozen=True)
class Count:
    """The number of operations of a program.

    ``operations`` counts all except sines and cosines (a whole power counts as its products). ``sincos`` is the number
    of angles whose sine, cosine or both are needed. ``prologue`` counts the operations that depend only on hoisted
    groups.
    """

    operations: int
    sincos: int
    prologue: int = 0


def count_operations(graph: Graph, ids: Iterable[int], *, hoist: Iterable[str] = ()) -> Count:
    """Count the operations that ``ids`` need; those that depend only on the groups in ``hoist`` are counted
    separately."""
    nodes = graph.nodes
    held = frozenset(hoist)
    moving: set[int] = set()
    operations = prologue = 0
    angles: set[int] = set()
    for i in reached(graph, ids):
        node = nodes[i]
        op = node[0]
        if op in LEAVES:
            if op != "const" and node[1] not in held:
                moving.add(i)
            continue
        if moving.isdisjoint(operands(node)):
            prologue += 1
            continue
        moving.add(i)
        if op in ("sin", "cos"):
            angles.add(node[1])
        elif op == "powi":
            n = abs(node[2])
            operations += n.bit_length() - 1 + n.bit_count() - 1 + (node[2] < 0)
        else:
            operations += 1
    return Count(operations, len(angles), prologue)


def count_program(program: Program, *, hoist: Iterable[str] = ("p",)) -> Count:
    """`count_operations` of a whole program with hoisted parameters."""
    return count_operations(program.graph, program.ids, hoist=hoist)
