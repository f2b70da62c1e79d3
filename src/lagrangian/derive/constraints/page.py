"""The constraints of a system as a result: rows, verdict, integrals, and what they mean in words."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from typing import Any, NamedTuple, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.codes import Code
from lagrangian.derive.constraints.integrals import Integral
from lagrangian.derive.constraints.proposal import Proposal, proposals
from lagrangian.derive.constraints.verdict import Holonomy, judge
from lagrangian.errors import ModelError, Notice, listed
from lagrangian.model import Model, time
from lagrangian.model.rows import Row, rows_of
from lagrangian.page.formula import Heading, Item, Left, Name, Table, Text, formula, text
from lagrangian.page.plain import plain
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass
from lagrangian.write.written import Written


class _Given(NamedTuple):
    """A row with definitions written out."""

    name: str
    rate: sp.Expr
    position: sp.Expr | None


@dataclass(frozen=True, eq=False)
class Constraints(Written):
    """The constraints of a system and their consequences.

    ``rows`` are the scalar equations in the order given, ``holonomy`` the verdict with redundant rows and notes.
    ``proposals`` are ways to describe the system with fewer coordinates.
    """

    model: Model
    rows: tuple[Row, ...]
    holonomy: Holonomy
    proposals: tuple[Proposal, ...] = ()
    items: tuple[Item, ...] = ()

    @property
    def holonomic(self) -> bool | None:
        """Whether #GC = #DDOF; None if this is undecided."""
        return self.holonomy.holonomic

    @property
    def verdict(self) -> str:
        """The verdict in one line: ``nonholonomic by 2: #DDOF = 2, #GC = 4, growth (2, 3, 4)``."""
        return str(self.holonomy)

    @property
    def GC(self) -> int | None:
        """The number of generalized coordinates of all configurations that can be reached; None if undecided."""
        return self.holonomy.GC

    @property
    def DDOF(self) -> int:
        """The number of rates that can be chosen freely at an instant."""
        return self.holonomy.DDOF

    @property
    def integrals(self) -> tuple[Integral, ...]:
        """The surfaces f = constant that were found."""
        return self.holonomy.integrals

    def notices(self) -> tuple[Notice, ...]:
        """Return a notice for every redundant row."""
        return tuple(
            Notice(Code.E306, f"constraint '{row.name}'", f"left out: it says again what {_names(row.repeats)} say")
            if len(row.repeats) > 1
            else Notice(Code.E306, f"constraint '{row.name}'", f"left out: {_repeated(row.repeats)}")
            for row in self.holonomy.redundant
        )

    def report(self) -> Report[Model]:
        """Return the report."""
        return Report(
            f"Constraints of {self.model.name}",
            self.model,
            (Part(text("Constraints"), self.items),),
            {
                "system": self.model.name,
                "verdict": self.verdict,
                "holonomic": self.holonomic,
                "GC": self.GC,
                "DDOF": self.DDOF,
                "growth": list(self.holonomy.growth),
                "rows": [
                    {
                        "name": r.name,
                        "position": None if r.position is None else plain(r.position),
                        "rate": plain(r.rate),
                    }
                    for r in self.rows
                ],
                "redundant": [{"name": r.name, "repeats": list(r.repeats)} for r in self.holonomy.redundant],
                "integrals": [
                    {"expression": plain(i.expression), "rows": list(i.rows), "how": i.how} for i in self.integrals
                ],
                "notes": list(self.holonomy.notes),
            },
        )


def _names(names: Iterable[str]) -> str:
    return listed([f"'{name}'" for name in names])


def _repeated(names: tuple[str, ...]) -> str:
    return f"it says again what {_names(names)} says" if names else "it holds for all positions"


def constraints(model: Model, readable: Callable[[sp.Expr], Left]) -> Constraints:
    """Return the constraints of a model and their consequences; ``readable`` says how a row is written on the page.

    Raises `ModelError` (E302) for contradictions.
    """
    rows = rows_of(model)
    given = [_given(model, row) for row in rows]
    coordinates = tuple(c.symbol for c in model.coordinates)
    values: Mapping[Any, Any] = {
        symbol: sp.Rational(*Fraction(repr(value)).as_integer_ratio()) for symbol, value in model.values.items()
    }
    found = judge(given, coordinates, time, values=values, idle=len(model.floating))
    for row in found.contradictions:
        element = next(r.element for r in rows if r.name == row.name)
        raise ModelError(
            f"it contradicts {_names(row.repeats)}" if row.repeats else "no position satisfies it",
            element=f"constraint '{row.name}'",
            place=element.place,
            fix="leave one of them out, or change one so that both can hold",
            code="E302",
        )
    ways = proposals(found.integrals, coordinates, time)
    made = Constraints(model, rows, found, ways)
    return Constraints(model, rows, found, ways, tuple(_items(made, readable)))


def _given(model: Model, row: Row) -> _Given:
    position = None if row.position is None else model.expand(row.position, constants=True)
    rate = model.expand(row.rate, constants=True)
    speeds = {v: x for f in model.floating if f.floating is not None for v, x in f.floating.in_rates.items()}
    return _Given(row.name, cast("sp.Expr", bounded.replaced(rate, speeds)) if speeds else rate, position)


# -- in words -------------------------------------------------------------------------------------------------------


def _items(found: Constraints, readable: Callable[[sp.Expr], Left]) -> Iterator[Item]:
    yield Heading(text("The constraints"))
    yield text("Every scalar condition is called a row. A force, described by its multiplier λ, keeps it:")
    header = (text("row"), text("what it says"), text("its multiplier λ"))
    yield Table(header, tuple((text(r.name), _states(r, readable), text(*r.multiplier)) for r in found.rows))
    for notice in found.notices():
        yield text(f"The {notice.where} is {notice.text}.")
    yield Heading(text("Holonomic or not?"))
    yield from _verdict(found)
    if found.integrals:
        yield from _surfaces(found, readable)
    for note in found.holonomy.notes:
        yield text(note[0].upper() + note[1:] + ".")
    yield Heading(text("Three ways to go on"))
    yield from _routes(found)


def _states(row: Row, readable: Callable[[sp.Expr], Left]) -> Text:
    return text(readable(row.rate if row.position is None else row.position), " = 0")


def _count(n: int, what: str) -> str:
    return f"{n} {what}{'' if n == 1 else 's'}"


def _verdict(found: Constraints) -> Iterator[Item]:
    h, n = found.holonomy, len(found.model.velocities)
    m = n - h.DDOF  # fewer than the rows that are independent elsewhere, if some depend on others where all hold
    yield text(
        f"{_count(n, 'rate')} and {_count(m, 'independent row')}: #DDOF = {n} − {m} = {h.DDOF} is the number of rates "
        "that can be chosen freely at any instant."
    )
    if h.holonomic is None:
        yield text(f"Whether the system is holonomic was not decided beyond depth {len(h.growth)} of brackets.")
    elif h.holonomic:
        surface = "the surface that the row defines" if m == 1 else "the surfaces that the rows define"
        yield formula(Name("#GC"), Name("#DDOF"), Name(str(h.DDOF)), brief=True)
        yield text(
            f"No sequence of allowed motions leads off {surface}: #GC = {h.GC} is the number of coordinates that "
            "describe every configuration that can be reached. The two are equal, so the system is holonomic."
        )
    else:
        least = "" if h.complete else "at least "
        yield formula(Name("#GC"), Name(f"{'' if h.complete else '≥ '}{h.growth[-1]}"), brief=True)
        yield formula(Name("#DDOF"), Name(str(h.DDOF)), brief=True)
        depths = ", ".join(map(str, h.growth))
        yield text(
            "Make two allowed motions one after the other, then undo both in the same order: this loop ends beside its "
            "start, in a direction that no single allowed motion has. With loops, and loops of loops, the number of "
            f"directions grows: {depths}. So #GC = {h.growth[-1]} coordinates are needed in the long run and #DDOF = "
            f"{h.DDOF} rates at an instant: #GC > #DDOF, and the system is nonholonomic by {least}{h.degree}."
        )
    if h.DDOF == 0:
        yield text(
            "Nothing is left to move freely: the constraints alone decide the position at every instant, and the "
            "equations give the forces that hold it there."
        )
    if h.special is not None:
        yield text(f"With the given values of the parameters the verdict changes: {h.special}.")


def _surfaces(found: Constraints, readable: Callable[[sp.Expr], Left]) -> Iterator[Item]:
    many = len(found.integrals) > 1
    yield text("The motion stays on ", "these surfaces:" if many else "this surface:")
    for integral in found.integrals:
        level: Left = Name("constant") if integral.level is None else integral.level
        how = "" if integral.how == "given" else f" ({integral.how})"
        yield formula(readable(integral.expression), level, note=text(f"from {_names(integral.rows)}{how}"))


def _routes(found: Constraints) -> Iterator[Item]:
    h, n = found.holonomy, len(found.model.velocities)
    m = n - h.DDOF
    if found.proposals:
        yield text("1. Integrate, and use fewer coordinates:")
        for way in found.proposals:
            parts: list[str | Left] = []
            for q, value in way.written:
                parts += [", " if parts else "with ", q, " = ", value]
            new: list[str | Left] = [] if way.new is None else [", where ", way.new, " is a new coordinate"]
            constant = "" if way.integral.level is not None else " (c is set by the start)"
            yield text(*parts, *new, f"{constant}, {_names(way.integral.rows)} holds by itself.")
    elif h.integrals:
        yield text("1. Integrate: done above, but no simple choice of fewer coordinates was found.")
    elif h.holonomic is not False or h.missing:
        yield text("1. Integrate: no elementary integral was found.")
    else:
        yield text(
            "1. Integrate: impossible. The rows keep no function of the coordinates constant, so no coordinate can be "
            "left out."
        )
    solved = (
        f"2. Eliminate: the rows are linear in the {_count(n, 'rate')}. Solved for {m} of them they leave {h.DDOF} free"
    )
    yield text(
        f"{solved}, and the equations of motion are written along these alone. The rows must not be put into L before "
        "it is differentiated: L has to be compared under wiggles that the rows forbid."
        if h.holonomic is False
        else f"{solved}."
    )
    yield text(
        f"3. Use the rows as they are: {'both' if n == 2 else f'all {n}'} coordinates stay, and every row adds its "
        f"force to Lagrange's equations with a multiplier λ. That makes {_count(m, 'more unknown')} and "
        f"{_count(m, 'more equation')}: {'the row' if m == 1 else 'the rows'}, differentiated until "
        "accelerations appear."
    )
