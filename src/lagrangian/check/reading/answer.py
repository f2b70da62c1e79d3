"""The content of an answer, line by line, as SymPy."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Literal, TypeAlias

import sympy as sp

from lagrangian.check.reading.marked_values import ValueMarks
from lagrangian.errors import ParseError, Place
from lagrangian.records import dataclass, field

Kind: TypeAlias = Literal[
    "equation",
    "T",
    "V",
    "L",
    "D",
    "Xi",
    "p",
    "p-rate",
    "slope",
    "left",
    "T-p",
    "T-rate",
    "T-slope",
    "V-slope",
    "D-slope",
    "definition",
    "identity",
    "statement",
    "given",
]
"""What a line states:

    equation    lhs = rhs holds along every motion: an equation of motion. Where it says Ξ_i without its value, the
                placeholder ``generalized_force(name)`` stands there
    T, V, L, D  the kinetic co-energy, the potential energy, the Lagrangian, Rayleigh's dissipation function
    Xi          the generalized force Ξ of the coordinate ``name``
    p           ∂L/∂ξ̇ of the coordinate ``name``;  p-rate: d/dt ∂L/∂ξ̇;  slope: ∂L/∂ξ
    left        d/dt ∂L/∂ξ̇ − ∂L/∂ξ of the coordinate ``name``, worked out
    T-p         ∂T*/∂ξ̇ of the answer's own T*, for the coordinate ``name``
    T-rate      d/dt ∂T*/∂ξ̇ of the answer's own T*; T-slope: ∂T*/∂ξ, V-slope: ∂V/∂ξ, D-slope: ∂D/∂ξ̇, of its own V and
                D: what the equation of the coordinate ``name`` has too much by it
    definition  a name of the person's own, or a coordinate of the model in new ones
    identity    lhs = rhs holds whatever the motion: the rate of a name that was defined before
    given       the value of a parameter of the model in others, which is an assumption: J = m R²/2
    statement   a general truth that holds nothing of this system: d/dt ∂L/∂ξ̇ − ∂L/∂ξ = Ξ, before L was given;
                or what the quantity ``name`` is in such terms
"""


Factors: TypeAlias = tuple[sp.Expr, ...]
"""The factors of a term as they are written: ½, m r² and (ẋ/r)²."""
Summands: TypeAlias = tuple[tuple[Factors, ...], ...]
"""The terms of a sum and, for each, behind the term as a whole, those of a bracket in it times the rest."""


@dataclass(frozen=True)
class AnswerLine:
    """One statement of an answer. ``lhs`` and ``rhs`` are the two sides as written; ``lhs`` is None if the left side
    only names the quantity that ``kind`` (and ``name``) describe. Names that the answer defines are written out;
    definitions of the model keep their names. ``place`` is where the line begins, and ``text`` is the line as it was
    written; ``names`` are the keys of the names in it, also of those of which it writes rates.
    """

    kind: Kind
    lhs: sp.Expr | None
    rhs: sp.Expr
    name: str | None
    place: Place
    text: str
    names: frozenset[str] = field(default=frozenset(), compare=False)
    summands: Summands = field(default=(), compare=False)
    """The terms of the value, of an equation those of left minus right, as they are written; see `summands`."""
    typed: str = field(default="", compare=False)
    """The line as it was typed, where ``text`` is it in other letters; empty if they do not stand in one row."""

    @property
    def residual(self) -> sp.Expr:
        """Left minus right; the right-hand side alone if there is no left-hand side."""
        return self.rhs if self.lhs is None else self.lhs - self.rhs


@dataclass(frozen=True)
class Unknown:
    """A name that the model does not have: its spelling, its symbol in the lines, its first place, and its probable
    meaning.

    The symbol is a function of time if the answer differentiates it. ``suggestion`` is a sentence or None.
    """

    name: str
    symbol: sp.Expr
    place: Place
    suggestion: str | None = None


@dataclass(frozen=True)
class MarkedRow:
    """A row with marks or words that may be no part of it: the line and the place where it begins, and the number of
    its other readings."""

    line: int
    start: int
    count: int


@dataclass(frozen=True)
class StatedCoordinates:
    """What words say of coordinates: those that are counted from rest, in which way each is positive, and from which
    axis angles are."""

    rest: frozenset[str] = frozenset()
    ways: tuple[tuple[str, str], ...] = ()
    axes: tuple[tuple[str, str], ...] = ()

    def __bool__(self) -> bool:
        """Whether anything is said."""
        return bool(self.rest or self.ways or self.axes)


@dataclass(frozen=True)
class Answer:
    """A whole answer, in the order in which it was written; ``notes`` say how unusual spellings were read.

    ``others`` read the same text in the less likely ways.
    """

    lines: tuple[AnswerLine, ...]
    notation: Literal["text", "latex"]
    unknown: tuple[Unknown, ...] = ()
    notes: tuple[str, ...] = ()
    described: frozenset[str] = frozenset()
    """The names of which words say what they are."""
    unread: frozenset[str] = frozenset()
    """The names, in the form of `lagrangian.read.letters.key`, in parts that were not read and may explain them."""
    beside: Mapping[int, frozenset[str]] = field(default_factory=dict)
    """What words say of lines that may stand beside the equations, by number; see `side_remarks`."""
    near: Mapping[int, frozenset[str]] = field(default_factory=dict)
    """The values and kinds of motion that lines, or those above them, speak of, by number; see `prose.values_said`."""
    others: tuple[Callable[[], Answer], ...] = field(default=(), repr=False, compare=False)
    doubt: ParseError | None = field(default=None, repr=False, compare=False)
    """The error of parts that were not read and may say what names of the system mean: no reason to call it wrong."""
    lacking: bool = field(default=False, repr=False, compare=False)
    """Whether parts that may be equations were not read."""

    marked_rows: Callable[[], tuple[MarkedRow, ...]] = field(default=tuple, repr=False, compare=False)
    read_marked: Callable[[tuple[tuple[int, int], ...]], Answer] | None = field(default=None, repr=False, compare=False)
    """The rows with other readings, and the answer in which those at some places are read so: (place, number), …"""
    read_without: Callable[[frozenset[int]], Answer] | None = field(default=None, repr=False, compare=False)
    """The answer as it is read without some of its lines, by number; the others keep theirs."""
    marked: Callable[[], tuple[Answer, ValueMarks]] | None = field(default=None, repr=False, compare=False)
    """The answer as it is read with marks in the values of its names."""
    commented: bool = field(default=False, repr=False, compare=False)
    """Whether comments hold equations of motion."""
    program: bool = field(default=False, repr=False, compare=False)
    """Whether these are the statements of a program that was carried out."""
    computed: Callable[[], Answer] | None = field(default=None, repr=False, compare=False)
    """The equations of motion that the program computes which this answer is, without its comments."""
    opened: Callable[[], Answer] | None = field(default=None, repr=False, compare=False)
    """What the program states with its inputs as they are; `ParseError` if it closes no loop."""
    senses: frozenset[tuple[str, str, str]] = field(default=frozenset(), repr=False, compare=False)
    """In which sense words count forces of the answer's own; see `said.senses`."""

    counted: StatedCoordinates = field(default=StatedCoordinates(), repr=False, compare=False)
    """From where and in which direction words count coordinates of the system."""
    renamed: tuple[Unknown, ...] = field(default=(), repr=False, compare=False)
    """The names that were read as other ones of the system, with the symbols of these: I as J."""
    mentioned: frozenset[str] = field(default=frozenset(), repr=False, compare=False)
    """The names, unknown or renamed, of which words that were not read may say a value."""

    sentences: tuple[ParseError, ...] = field(default=(), repr=False, compare=False)
    """The errors of sentences that were not read and may say an equation of motion."""

    @property
    def equations(self) -> tuple[AnswerLine, ...]:
        """The lines that state equations."""
        return tuple(line for line in self.lines if line.kind == "equation")


def without_lines(text: str, numbers: Collection[int]) -> str:
    """A text with some of its lines empty, by number."""
    return "\n".join("" if k in numbers else x for k, x in enumerate(text.split("\n"), 1))
