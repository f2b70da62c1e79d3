"""Mathematics on a page as a tree, before it is converted to text, LaTeX or MathML.

All formats render the same tree, so that order, signs, parentheses and line breaks are decided only once. A formula is
broken into lines between its *tokens*, see `breaking`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TypeAlias

from lagrangian.records import dataclass

GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "epsilon": "ε",
    "zeta": "ζ",
    "eta": "η",
    "theta": "θ",
    "iota": "ι",
    "kappa": "κ",
    "lambda": "λ",
    "lamda": "λ",
    "mu": "μ",
    "nu": "ν",
    "xi": "ξ",
    "omicron": "ο",
    "pi": "π",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "upsilon": "υ",
    "phi": "φ",
    "chi": "χ",
    "psi": "ψ",
    "omega": "ω",
    "Gamma": "Γ",
    "Delta": "Δ",
    "Theta": "Θ",
    "Lambda": "Λ",
    "Xi": "Ξ",
    "Pi": "Π",
    "Sigma": "Σ",
    "Upsilon": "Υ",
    "Phi": "Φ",
    "Psi": "Ψ",
    "Omega": "Ω",
}
"""Spelled Greek letters; the other capitals look like Latin letters and stay spelled."""

FUNCTIONS = frozenset(["sin", "cos", "tan", "sinh", "cosh", "tanh", "arcsin", "arccos", "arctan", "ln", "exp"])
"""Functions that need no parentheses before a single letter, and whose power follows the name: sin²θ."""


@dataclass(frozen=True)
class Letter:
    """A symbol: base letter, subscript parts, dots for time derivatives; ``star`` as in T*, ``plus`` for a sum over all
    that hangs on something, ``bold`` for a vector.

    A vector is ``apart`` if its plain letter would equal another symbol, so that even plain text must show it bold.
    ``base`` and the parts of ``sub`` are spelled: "theta", "x", "1r". A ``literal`` letter is shown exactly as spelled.
    """

    base: str
    sub: tuple[str, ...] = ()
    dots: int = 0
    star: bool = False
    bold: bool = False
    literal: bool = False
    apart: bool = False
    plus: bool = False

    @property
    def mark(self) -> str:
        """What stands behind it, raised."""
        return "*" if self.star else "+" if self.plus else ""

    @property
    def primes(self) -> str:
        """The rate of a name of several letters: lift′; a dot over one of them would read as a product, l̇ · ift."""
        return ("", "′", "″", "‴")[self.dots] if _several(self.base) else ""


_NUMBERED = re.compile(rf"({'|'.join(sorted(GREEK, key=len, reverse=True))}|[A-Za-z])([0-9]+)\Z")


def numbered(part: str) -> tuple[str, str] | None:
    """Return the letter (Greek ones spelled) and the number of a name such as ``phi1`` or ``k2``, or None."""
    found = _NUMBERED.match(part)
    return (found.group(1), found.group(2)) if found else None


@dataclass(frozen=True)
class Number:
    """A number or constant as text: "2", "9.81", "π", "∞"."""

    text: str


@dataclass(frozen=True)
class Word:
    """Upright words inside mathematics: "d", "otherwise", "⟨612 operations⟩"."""

    text: str


@dataclass(frozen=True)
class Addition:
    """A sum of terms with signs: (whether it is subtracted, term)."""

    terms: tuple[tuple[bool, Math], ...]


@dataclass(frozen=True)
class Times:
    """Factors side by side."""

    factors: tuple[Math, ...]


@dataclass(frozen=True)
class Power:
    """base^exponent."""

    base: Math
    exponent: Math


@dataclass(frozen=True)
class Quotient:
    """A fraction."""

    over: Math
    under: Math


@dataclass(frozen=True)
class Radical:
    """A square root."""

    of: Math


@dataclass(frozen=True)
class Apply:
    """A function with its arguments, perhaps with a power after its name: sin²θ."""

    name: str
    args: tuple[Math, ...]
    power: Math | None = None


@dataclass(frozen=True)
class Numeral:
    """A named quantity with its arguments: M(q)."""

    of: Letter
    args: tuple[Math, ...]


@dataclass(frozen=True)
class Fence:
    """Something in parentheses or bars."""

    of: Math
    left: str = "("
    right: str = ")"


@dataclass(frozen=True)
class Mark:
    """∂, d or δ in front of something."""

    sign: str
    of: Math


@dataclass(frozen=True)
class Relation:
    """Sides with a relation between any two: a = b = c, x < 0."""

    sides: tuple[Math, ...]
    sign: str = "="


@dataclass(frozen=True)
class Grid:
    """A matrix or column; if it is ``symmetric``, the cells below the diagonal are empty."""

    rows: tuple[tuple[Math, ...], ...]
    symmetric: bool = False


@dataclass(frozen=True)
class Cases:
    """A quantity with several branches; the condition None means "otherwise"."""

    branches: tuple[tuple[Math, Math | None], ...]


@dataclass(frozen=True)
class Tagged:
    """A term with its kind and the elements that it came from, as words and by their names."""

    of: Math
    elements: tuple[str, ...]
    kind: str
    names: tuple[str, ...] = ()


Math: TypeAlias = (
    Letter
    | Number
    | Word
    | Addition
    | Times
    | Power
    | Quotient
    | Radical
    | Apply
    | Numeral
    | Fence
    | Mark
    | Relation
    | Grid
    | Cases
    | Tagged
)


LOOSE = 100
"""The level of a line break in a product, before a function or between plain factors."""
GLUED = 200
"""The level of a line break between a factor and its parenthesis or its acceleration."""


@dataclass(frozen=True)
class Glyph:
    """A piece of a formula that is never broken.

    ``role``: "leaf" (``math`` is rendered), "plus", "minus" (between terms), "negative" (before the first term), "gap"
    (between factors), "open", "close" (``text`` is the fence), "exponent" (``math`` is raised), "sign" (``text`` is a
    relation). ``level`` says how bad a line break before it is (0 is best); None means that no break is allowed.
    ``depth`` counts the parentheses around it. ``tall`` fences contain a fraction.
    """

    role: str
    math: Math | None = None
    text: str = ""
    level: int | None = None
    tall: bool = False
    depth: int = 0


def tokens(math: Math, depth: int = 0) -> Iterator[Glyph]:
    """Split a formula into tokens; ``depth`` counts the parentheses around it."""
    if isinstance(math, Addition):
        for i, (subtracted, term) in enumerate(math.terms):
            if i:
                yield Glyph("minus" if subtracted else "plus", level=1 + depth, depth=depth)
            elif subtracted:
                yield Glyph("negative")
            yield from tokens(fenced(term, Addition), depth)
        if not math.terms:
            yield Glyph("leaf", Number("0"))
    elif isinstance(math, Times):
        factors = [_in_product(math.factors, i) for i in range(len(math.factors))]
        for i, factor in enumerate(factors):
            if i:
                loose = _stands_apart(factors[i - 1], factor)
                yield Glyph("gap", level=(LOOSE if loose else GLUED) + depth, depth=depth)
            yield from tokens(factor, depth)
    elif isinstance(math, Fence):
        tall = is_tall(math.of)
        yield Glyph("open", text=math.left, tall=tall)
        yield from tokens(math.of, depth + 1)
        yield Glyph("close", text=math.right, tall=tall)
    elif isinstance(math, Power) and isinstance(base := fenced(math.base, _Loose), Fence):
        yield from tokens(base, depth)
        yield Glyph("exponent", math.exponent)
    elif isinstance(math, Relation):
        for i, side in enumerate(math.sides):
            if i:
                yield Glyph("sign", text=math.sign, level=None if math.sign == "," else 0, depth=depth)
            yield from tokens(side, depth)
    elif isinstance(math, Tagged):
        yield from tokens(math.of, depth)
    else:
        yield Glyph("leaf", math, depth=depth)


def _stands_apart(before: Math, factor: Math) -> bool:
    """Whether a product may be broken before a factor: before a function, or between two plain factors."""
    if isinstance(factor, Apply):
        return before not in _SIGNS
    return not any(isinstance(x, Fence) or _moves(x) or x in _SIGNS or _fences(x) for x in (before, factor))


_SIGNS = (Word("·"), Quotient(Word("d"), Word("dt")))


def _moves(math: Math) -> bool:
    """Whether an expression is a rate or an acceleration, or a power of one."""
    return (isinstance(math, Letter) and math.dots > 0) or (isinstance(math, Power) and _moves(math.base))


def _fences(math: Math) -> bool:
    """Whether an expression is a parenthesis or a power of one."""
    return isinstance(math, Power) and isinstance(fenced(math.base, _Loose), Fence)


_Loose = (Addition, Times, Quotient, Power, Mark, Relation, Cases)


def fenced(math: Math, kinds: type | tuple[type, ...]) -> Math:
    """Put an expression in parentheses if it is of one of these kinds."""
    inner = math.of if isinstance(math, Tagged) else math
    return Fence(math) if isinstance(inner, kinds) else math


def _in_product(factors: tuple[Math, ...], i: int) -> Math:
    """Parentheses for sums among factors, and around a bare argument that would run into the next factor."""
    factor = fenced(factors[i], (Addition, Relation))
    following = factors[i + 1] if i + 1 < len(factors) else None
    if isinstance(factor, Apply) and following is not None and not isinstance(following, Apply) and bare(factor):
        return Apply(factor.name, (Fence(factor.args[0]),), factor.power)
    return factor


def bare(math: Apply) -> bool:
    """Whether an argument is written without parentheses: sin θ, sin 2θ."""
    if len(math.args) != 1 or math.name not in FUNCTIONS:
        return False
    arg = math.args[0]
    if isinstance(arg, Times) and len(arg.factors) == 2 and isinstance(arg.factors[0], Number):
        arg = arg.factors[1]
    return isinstance(arg, (Letter, Number))


def equality(sides: tuple[Math, ...]) -> Math:
    """Return a single side as it is, or several sides joined by equals signs."""
    return sides[0] if len(sides) == 1 else Relation(sides)


def is_word(math: Math | None) -> bool:
    """Whether it is a name of several letters, which needs space around it."""
    return isinstance(math, Word) or (isinstance(math, Letter) and (math.literal or _several(math.base)))


def _several(base: str) -> bool:
    return sum(map(str.isalnum, base)) > 1 and base not in GREEK


def in_parentheses(math: Math) -> bool:
    """Whether it is already in parentheses; bars do not count."""
    return isinstance(math, Fence) and math.left == "("


def product(front: Math, *rest: Math) -> Math:
    """Factors side by side; factors after a fraction move into its numerator."""
    if not rest:
        return front
    if isinstance(front, Quotient) and not isinstance(front.over, Number):
        return Quotient(product(front.over, *rest), front.under)
    if isinstance(front, Quotient) and not isinstance(front.under, Number):
        return Quotient(Times(rest) if front.over == Number("1") else Times((front.over, *rest)), front.under)
    factors = front.factors if isinstance(front, Times) else () if front == Number("1") else (front,)
    made = (*factors, *rest)
    return made[0] if len(made) == 1 else Times(made)


def is_tall(math: Math | None) -> bool:
    """Whether it contains a fraction with letters, or anything else that is taller than a line."""
    match math:
        case Quotient():
            return not (isinstance(math.over, Number) and isinstance(math.under, Number))
        case Grid() | Cases():
            return True
        case Addition():
            return any(is_tall(t) for _, t in math.terms)
        case Times():
            return any(is_tall(f) for f in math.factors)
        case Relation():
            return any(is_tall(s) for s in math.sides)
        case Power():
            return is_tall(math.base)
        case Apply():
            return any(is_tall(a) for a in math.args)
        case Fence() | Mark() | Radical() | Tagged():
            return is_tall(math.of)
        case _:
            return False
