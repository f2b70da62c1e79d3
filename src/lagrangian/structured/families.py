"""Lines whose pattern repeats with an index are written once, with “k = 3 … 20”.

Two lines have one pattern if they are the same once every number in a name is replaced by its distance from the line's
own: v_x3 = L3 c_3 ω_3 + v_x2 and v_x4 = L4 c_4 ω_4 + v_x3. The definitions as data stay as they are.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.derive import NamedQuantity, Step
from lagrangian.model import Model
from lagrangian.page.formula import Formula, Heading, Item, Table, Text, text

LEAST = 4
"""The number of lines from which a pattern is written once."""

NEAR = 2
"""The distance up to which a number in a name counts as an index beside the line's own."""

Block = Sequence[Item]
"""Items that belong together: a formula, or a heading with what follows it."""

_NUMBER = re.compile(r"\d+")
_QUOTED = re.compile(r"'(\w+_\w+[+−\d]*)'")


class Families:
    """Writes repeated lines of a system once, with an index that is none of its names."""

    def __init__(self, model: Model) -> None:
        self.index = next((x for x in ("k", "j", "n") if x not in model.symbols), "#")

    def __call__(self, blocks: Iterable[Block]) -> Iterator[Item]:
        """The items of the blocks in order, where a pattern that repeats stands once, at its first place."""
        listed = [tuple(map(self._shortened, block)) for block in blocks]
        numbers = [_own_number(block) for block in listed]
        shapes: dict[str, list[int]] = {}
        for i, (block, n) in enumerate(zip(listed, numbers, strict=True)):
            if n is not None:
                shapes.setdefault(_shape(block, n), []).append(i)
        runs = {i: run for members in shapes.values() for run in _runs(members, numbers) for i in run}
        for i, block in enumerate(listed):
            run = runs.get(i)
            if run is None:
                yield from block
            elif i == min(run):
                yield from self._written(block, numbers[i] or 0, sorted(numbers[j] or 0 for j in run))

    def step(self, step: Step) -> Step:
        """A step whose lines stand one by one."""
        return replace(step, items=tuple(self([item] for item in step.items)))

    def patterns(self, quantities: Iterable[NamedQuantity]) -> tuple[NamedQuantity, ...]:
        """The names of quantities with the index in the place of a number, as in lines that stand for several."""
        found: dict[sp.Symbol, NamedQuantity] = {}
        for q in quantities:
            for number in dict.fromkeys(map(int, _NUMBER.findall(q.symbol.name))):
                for off in range(-NEAR, NEAR + 1):
                    symbol = _general(q.symbol, number + off, self.index)
                    found.setdefault(symbol, replace(q, symbol=symbol))
        return tuple(found.values())

    def _written(self, block: Block, n: int, members: Sequence[int]) -> Iterator[Item]:
        told = f"{self.index} = {members[0]} … {members[-1]}"
        for place, item in enumerate(block):
            made = _general(item, n, self.index)
            if place == 0 and isinstance(made, Heading):
                made = replace(made, text=Text((*made.text.parts, f", {told}"), made.text.brief))
            elif place == 0 and isinstance(made, Formula):
                before = (*made.note.parts, ", ") if made.note is not None else ()
                made = replace(made, note=text(*before, told))
            yield made

    def _shortened(self, item: Item) -> Item:
        """A table in which rows that repeat stand once; other items as they are."""
        if not isinstance(item, Table):
            return item
        cells: list[Any] = list(item.rows)
        found = self([[Formula(row)] for row in cells])
        rows = [x.sides if x.note is None else self._with_note(x) for x in found if isinstance(x, Formula)]
        return replace(item, rows=tuple(rows))

    @staticmethod
    def _with_note(row: Formula) -> tuple[Any, ...]:
        """The cells of a row that stands for several: the first one says for which."""
        first = row.sides[0]
        assert row.note is not None
        parts = first.parts if isinstance(first, Text) else (first,)
        return (text(*parts, ", ", *row.note.parts), *row.sides[1:])


def _runs(members: Sequence[int], numbers: Sequence[int | None]) -> Iterator[list[int]]:
    """The members in runs of consecutive numbers that are long enough."""
    run: list[int] = []
    for i in [*sorted(members, key=lambda i: numbers[i] or 0), None]:
        if run and (i is None or numbers[i] != (numbers[run[-1]] or 0) + 1):
            if len(run) >= LEAST:
                yield run
            run = []
        if i is not None:
            run.append(i)


def _own_number(block: Block) -> int | None:
    """The last number in what the first formula of a block defines."""
    first = next((item for item in block if isinstance(item, Formula)), None)
    found = _NUMBER.findall(str(first.sides[0])) if first is not None else []
    return int(found[-1]) if found else None


def _shape(x: Any, n: int) -> str:
    """A thing with the numbers of its names counted from ``n``; the order of terms and factors does not matter."""
    if isinstance(x, str):
        return _NUMBER.sub(lambda m: f"<{int(m[0]) - n}>" if abs(int(m[0]) - n) <= NEAR else m[0], x)
    if isinstance(x, sp.Symbol):
        return f"symbol {_shape(x.name, n)}"
    if isinstance(x, AppliedUndef):
        return f"{_shape(str(x.func), n)}{x.args}"
    if isinstance(x, (sp.Add, sp.Mul)):
        return f"{type(x).__name__}{sorted(_shape(a, n) for a in x.args)}"
    if isinstance(x, sp.Basic):
        return f"{type(x).__name__}{[_shape(a, n) for a in x.args]}" if x.args else str(x)
    if is_dataclass(x) and not isinstance(x, type):
        return f"{type(x).__name__}{[_shape(getattr(x, f.name), n) for f in fields(x)]}"
    if isinstance(x, (tuple, list)):
        return str([_shape(part, n) for part in x])
    return repr(x)


def _general(x: Any, n: int, index: str) -> Any:
    """A thing with an index in the place of the numbers of its names near ``n``."""
    if isinstance(x, str):
        return _QUOTED.sub(r"\1", _renamed(x, n, index))
    if isinstance(x, sp.Basic):
        table: dict[sp.Basic, sp.Basic] = {}
        for s in x.atoms(sp.Symbol):
            table[s] = sp.Symbol(_renamed(s.name, n, index), **s.assumptions0)
        for f in x.atoms(AppliedUndef):
            table[f] = sp.Function(_renamed(str(f.func), n, index), real=True)(*f.args)
        return x.xreplace(table)
    if is_dataclass(x) and not isinstance(x, type):
        return replace(x, **{f.name: _general(getattr(x, f.name), n, index) for f in fields(x)})
    if isinstance(x, tuple):
        return tuple(_general(part, n, index) for part in x)
    return x


def _renamed(name: str, n: int, index: str) -> str:
    """A name, or words, with the index for every number near ``n``: v_x3 becomes v_xk, L2 becomes L_k−1."""

    def put(match: re.Match[str]) -> str:
        off = int(match[0]) - n
        if abs(off) > NEAR:
            return match[0]
        before = re.split(r"\W", name[: match.start()])[-1]
        gap = "_" if before and "_" not in before else ""
        return gap + index + (f"+{off}" if off > 0 else f"−{-off}" if off < 0 else "")

    return _NUMBER.sub(put, name)
