"""Replaces nodes by other nodes in everything that reads them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from lagrangian.graph.graph import Graph, operands
from lagrangian.graph.program import reached


def replaced(graph: Graph, ids: Iterable[int], known: Mapping[int, int]) -> list[int]:
    """The nodes ``ids`` in which every node of ``known`` is replaced by its value, all at once."""
    ends = list(ids)
    value = dict(known)
    for i in reached(graph, ends, known):
        if i in value:
            continue
        node = graph.nodes[i]
        below = operands(node)
        new = tuple(value[k] for k in below)
        value[i] = i if new == below else _made(graph, node, new)
    return [value[i] for i in ends]


def copied(source: Graph, ids: Iterable[int], target: Graph) -> list[int]:
    """The nodes ``ids`` of one graph, made again in another; inputs keep their groups and places."""
    ends = list(ids)
    value: dict[int, int] = {}
    for i in reached(source, ends):
        node = source.nodes[i]
        if node[0] == "const":
            value[i] = target.const(node[1])
        elif node[0] == "input":
            value[i] = target.input(node[1], node[2])
        else:
            value[i] = _made(target, node, tuple(value[k] for k in operands(node)))
    return [value[i] for i in ends]


def _made(graph: Graph, node: tuple[Any, ...], new: tuple[int, ...]) -> int:
    """The operation of ``node`` with other operands."""
    if node[0] == "powi":
        return graph.powi(new[0], node[2])
    method: Any = getattr(graph, node[0] + "_" if node[0] in ("and", "or", "not") else node[0])
    return method(*new)
