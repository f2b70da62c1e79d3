"""Sentences that say what a circuit shows: which charge flows through what, and what changes as things move."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.errors import listed
from lagrangian.look.board import Board
from lagrangian.look.circuit_loops import moved_by
from lagrangian.look.phrases import cut, said, short
from lagrangian.model import MutualInductance
from lagrangian.page.plain import plain


def circuits(board: Board) -> Iterator[str]:
    """One phrase for every charge that flows, in the order of the description."""
    carried: dict[str, list[str]] = {}
    couplings: list[str] = []
    for element in board.stage.model.branches:
        if element.name in board.hidden:
            continue
        flows = [short(plain(charge)) for charge in element.charges]
        changing = [c.name for c in moved_by(board, element)]
        words = said(element) + (f" (which changes with {listed(changing)})" if changing else "")
        if isinstance(element, MutualInductance):
            couplings.append(f"{words} couples the coils of {listed(flows)}")
        else:
            carried.setdefault(flows[0], []).append(words)
    for flow, elements in carried.items():
        yield f"charge {flow} flows through {listed(cut(elements, 'more'))}"
    yield from couplings
