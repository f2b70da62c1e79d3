"""Imagined students: right answers written in random notations, layouts, words and with definitions in any place.

An answer is made of the equations as they are derived, of names for some of their parts, and of what people write
around them. Only SymPy and the plain spelling of expressions are used, nothing of the reader.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from lagrangian.derivation import Derivation
from lagrangian.page.plain import plain

GREEK = {"theta": "θ", "phi": "φ", "alpha": "α", "tau": "τ", "Omega": "Ω", "omega": "ω"}
NAMES = ("A", "B_0", "C_1", "mu", "a_1", "kappa", "M_t", "J_p", "eta", "h", "W", "p1", "Z_2")
"""Letters for what a student abbreviates; those that the system has are not taken."""

_NAME = re.compile(r"(?P<name>[A-Za-z]\w*)(?P<primes>'*)")
_FUNCTIONS = {"sin", "cos", "tan", "sqrt", "exp"}


@dataclass(frozen=True)
class Notation:
    """How names with rates, and what is between them, are spelled; ``markup`` is "text", "code" or "latex"."""

    markup: str
    name: Callable[[str, int, bool], str]
    rest: tuple[tuple[str, str], ...] = ()
    equals: str = " = "
    comment: str = "#"


def _dotted(name: str, order: int, moves: bool) -> str:
    letter, number = re.fullmatch(r"([A-Za-z]+?)(_?\w*)", GREEK.get(name, name)) or (name, "")  # type: ignore[misc]
    return f"{letter}{number}" + "'" * order


def _unicode(name: str, order: int, moves: bool) -> str:
    head = re.match(r"[A-Za-z]+", name)
    word = head.group() if head else name
    shown = GREEK.get(word, word)
    tail = name[len(word) :]
    if len(shown) > 1:
        return name + "'" * order
    tail = tail.translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")) if tail.isdigit() else tail
    return shown + {0: "", 1: "\u0307", 2: "\u0308"}[order] + tail


def _latex(name: str, order: int, moves: bool) -> str:
    head = re.match(r"[A-Za-z]+", name)
    word = head.group() if head else name
    letter = f"\\{word}" if word in GREEK or word in ("mu", "kappa", "eta") else word
    if len(word) > 1 and not letter.startswith("\\"):
        letter = f"\\mathrm{{{word}}}" if not name[len(word) :].isdigit() or len(word) > 1 else word
    tail = name[len(word) :].lstrip("_")
    dotted = {0: letter, 1: f"\\dot{{{letter}}}", 2: f"\\ddot{{{letter}}}"}[order]
    return f"{dotted}_{{{tail}}}" if tail else dotted


def _called(form: str) -> Callable[[str, int, bool], str]:
    def spelled(name: str, order: int, moves: bool) -> str:
        return name if not order else form.format(name=name, order=order) if order > 1 else _first(form, name)

    return spelled


def _first(form: str, name: str) -> str:
    return form.format(name=name, order=1).replace(", 1)", ")").replace(",1)", ")").replace("{t, 1}", "t")


NOTATIONS = (
    Notation("text", lambda n, k, m: n + "'" * k),
    Notation("text", lambda n, k, m: n + "'" * k, (("*", " "),)),
    Notation("text", _unicode, (("*", " "), ("^2", "²"), ("-", "−"))),
    Notation("text", _unicode, (("*", "·"), ("^2", "²"))),
    Notation("text", lambda n, k, m: n + ("_" if k else "") + "d" * k + ("ot" if k else "")),
    Notation("code", lambda n, k, m: n + "d" * k),
    Notation("code", _called("diff({name}, t, {order})"), (("^", "**"),)),
    Notation("code", _called("{name}.diff(t, {order})"), (("^", "**"),)),
    Notation("code", _called("diff({name},t,{order})"), (), " == ", "%"),
    Notation("text", lambda n, k, m: n if not k else f"d{n}/dt" if k == 1 else f"d^2{n}/dt^2"),
    Notation("latex", _latex, (("*", r"\,"), ("sin(", r"\sin("), ("cos(", r"\cos("), ("sqrt(", r"\sqrt("))),
    Notation("latex", _latex, (("*", " "), ("sin(", r"\sin("), ("cos(", r"\cos("))),
    Notation("latex", _latex, (("*", r" \cdot "), ("sin(", r"\sin("), ("cos(", r"\cos("), ("^2", "^{2}"))),
)

OPENINGS = (
    "", "", "Hi, here is my solution.\n", "Dear all,\n\nI used Lagrange's equations of the second kind.\n",
    "Solution by Anna, matriculation number 4711\n", "Lösung:\n", "After a long calculation I get the following.\n",
    "Exercise 3b)\n", "Let me first set up the energies, then differentiate. The result:\n",
    "The two steps were T and V. ",
    "**Result**\n", "My answer is below - hope it's right!\n",
)  # fmt: skip
CLOSINGS = (
    "", "", "\nHope that is right!", "\nDone.", "\nq.e.d.", "\nThese are the equations of motion.",
    "\nBest wishes, Tom",
    "\nI checked the units; they agree.", "\n(All angles in rad.)", "\nGruß, Eva", "\nThat's it :)",
    "\nThe terms with the squares of rates are the centrifugal ones.",
)  # fmt: skip
LABELS = (
    "",
    "",
    "({k}) ",
    "{k}) ",
    "{k}. ",
    "Eq. {k}: ",
    "({r}) ",
    "For {q}: ",
    "{q}: ",
    "Equation of {q}: ",
    "- ",
    "* ",
    "=> ",
)
TAILS = ("", "", "", ".", "   ({k})", ",", "    (eq. {k})", ";")
BEFORE = (
    "{a} = {v}", "{a} := {v}", "Let {a} = {v}.", "let {a} = {v}", "With {a} = {v}:", "I write {a} for {v}.",
    "{a} stands for {v}.", "Denote {v} by {a}.", "We abbreviate {a} = {v}.", "Abbreviation: {a} = {v}",
    "{a} is short for {v}.", "Set {a} = {v} to save typing.", "Sei {a} = {v}.", "In what follows {a} denotes {v}.",
)  # fmt: skip
AFTER = (
    "where {a} = {v}", "where {a} = {v}.", "with {a} = {v}", "Here {a} = {v}.", "Here {a} denotes {v}.", "({a} = {v})",
    "{a} being {v}.", "wobei {a} = {v}", "where {a} stands for {v}", "where {a} is {v}.", "(with {a} = {v})",
)  # fmt: skip
LATEX_LAYOUTS = ("dollars", "brackets", "equation", "align", "aligned", "gather", "cases", "inline", "bare")


class Students:
    """Makes answers to one system, chosen by a seed."""

    def __init__(self, derivation: Derivation, seed: int | str) -> None:
        self.derivation = derivation
        self.model = derivation.model
        self.random = random.Random(f"{self.model.name} {seed}")
        self.sides = [(sp.sympify(e.lhs), sp.sympify(e.rhs)) for e in derivation.equations]
        taken = {x.lower() for x in self.model.symbols}
        self.letters = [x for x in NAMES if x.lower() not in taken and x[0].lower() not in taken]
        self.moving = {c.name for c in self.model.coordinates}

    def answer(self, sides: list[tuple[Any, Any]] | None = None) -> str:
        """The equations, or other ``sides``, as somebody may write them."""
        pick = self.random.choice
        notation = pick(NOTATIONS)
        sides = [self._arranged(*pair) for pair in (sides or self.sides)]
        sides, own = self._abbreviated(sides)
        spelled = [(self._spelled(a, notation), self._spelled(b, notation)) for a, b in sides]
        defined = [(self._spelled(a, notation), self._spelled(v, notation)) for a, v in own]
        rows = [notation.equals.join(pair) for pair in spelled]
        if notation.markup == "latex":
            body = self._in_latex(rows, defined)
        elif notation.markup == "code":
            body = self._in_code(rows, defined, notation)
        else:
            body = self._in_text(rows, defined)
        opening, closing = pick(OPENINGS), pick(CLOSINGS)
        if notation.markup == "code":
            opening, closing = (f"{notation.comment} {x.strip()}\n" if x.strip() else "" for x in (opening, closing))
            opening, closing = opening.replace("\n\n", " "), f"\n{closing}"
        return f"{opening}{body}{closing}\n"

    def spoiled(self) -> list[tuple[Any, Any]]:
        """The equations, one of them without one of its terms, or with its other sign."""
        sides = list(self.sides)
        k = self.random.randrange(len(sides))
        terms = sp.Add.make_args(sp.expand(sides[k][0]))
        sides[k] = (sides[k][0] - self.random.choice([1, 2]) * self.random.choice(terms), sides[k][1])
        return sides

    def _arranged(self, lhs: Any, rhs: Any) -> tuple[Any, Any]:
        form = self.random.randrange(4)
        if form == 0:
            return lhs - rhs, sp.S.Zero
        if form == 1:
            return rhs, lhs
        if form == 2 and isinstance(lhs, sp.Add):
            moved = self.random.choice(lhs.args)
            return lhs - moved, rhs - moved
        return lhs, rhs

    def _abbreviated(self, sides: list[tuple[Any, Any]]) -> tuple[list[tuple[Any, Any]], list[tuple[Any, Any]]]:
        """The sides with names of the student's own, and the value of each."""
        own: list[tuple[Any, Any]] = []
        for _ in range(self.random.randrange(3)):
            found = {x for pair in sides for side in pair for x in sp.preorder_traversal(side) if self._may_be_named(x)}
            if not found or len(own) >= len(self.letters):
                break
            value = self.random.choice(sorted(found, key=str))
            letter = sp.Symbol(self.random.choice([x for x in self.letters if x not in {str(a) for a, _ in own}]))
            own.append((letter, value))
            sides = [(a.xreplace({value: letter}), b.xreplace({value: letter})) for a, b in sides]
        return sides, own

    def _may_be_named(self, x: Any) -> bool:
        constant = isinstance(x, sp.Add) and not x.has(sp.Function) and x.free_symbols <= set(self._parameters())
        return constant or (isinstance(x, (sp.sin, sp.cos)) and not x.has(sp.Derivative))

    def _parameters(self) -> list[Any]:
        return [p.symbol for p in self.model.parameters]

    def _spelled(self, expr: Any, notation: Notation) -> str:
        def one(match: re.Match[str]) -> str:
            name = match["name"]
            if name in _FUNCTIONS:
                return match.group()
            return notation.name(name, len(match["primes"]), name in self.moving)

        written = _NAME.sub(one, plain(expr))
        for old, new in notation.rest:
            written = written.replace(old, new)
        return written

    # -- layouts ------------------------------------------------------------------------------------------------------

    def _in_text(self, rows: list[str], defined: list[tuple[str, str]]) -> str:
        pick = self.random.choice
        before = [pick(BEFORE).format(a=a, v=v) for a, v in defined]
        after = [pick(AFTER).format(a=a, v=v) for a, v in defined]
        first = self.random.random() < 0.5
        said = "\n".join(before if first else after)
        if self.random.random() < 0.15:
            body = pick((" and ", ";  ", "\n\nand\n\n")).join(rows)
        else:
            body = "\n".join(self._labelled(rows))
        if first:
            return f"{said}\n\n{body}" if said else body
        return f"{body}{pick((chr(10), chr(10) * 2))}{said}" if said else body

    def _labelled(self, rows: list[str]) -> list[str]:
        label, tail = self.random.choice(LABELS), self.random.choice(TAILS)
        names = [c.name for c in self.model.coordinates]
        roman = ["I", "II", "III", "IV", "V", "VI"]
        return [
            (label + row + tail).replace("{k}", str(k + 1)).replace("{r}", roman[k % 6]).replace("{q}", names[k])
            for k, row in enumerate(rows)
        ]

    def _in_code(self, rows: list[str], defined: list[tuple[str, str]], notation: Notation) -> str:
        said = [f"{a} = {v}" for a, v in defined]
        if notation.equals.strip() == "=" and self.random.random() < 0.5:
            rows = [f"eq{k} = Eq({row.replace(' = ', ', ')})" for k, row in enumerate(rows, 1)]
        end = ";" if notation.comment == "%" and self.random.random() < 0.5 else ""
        return "\n".join(f"{x}{end}" for x in (*said, *rows))

    def _in_latex(self, rows: list[str], defined: list[tuple[str, str]]) -> str:
        pick = self.random.choice
        layout = pick(LATEX_LAYOUTS)
        aligned = [row.replace(" = ", " &= ", 1) for row in rows]
        broken = " \\\\\n".join(aligned)
        plain_rows = " \\\\\n".join(rows)
        body = {
            "dollars": "\n\n".join(f"$${row}$$" for row in rows),
            "brackets": "\n\n".join(f"\\[ {row} \\]" for row in rows),
            "equation": "\n".join(f"\\begin{{equation}}\n{row}\n\\end{{equation}}" for row in rows),
            "align": f"\\begin{{align}}\n{broken}\n\\end{{align}}",
            "aligned": f"\\[\n\\begin{{aligned}}\n{broken}\n\\end{{aligned}}\n\\]",
            "gather": f"\\begin{{gather*}}\n{plain_rows}\n\\end{{gather*}}",
            "cases": f"\\[\n\\begin{{cases}}\n{plain_rows}\n\\end{{cases}}\n\\]",
            "inline": " and ".join(f"${row}$" for row in rows),
            "bare": "\n".join(rows),
        }[layout]
        if layout == "bare":
            return "\n".join([*(f"{a} = {v}" for a, v in defined), body])
        forms = [x for x in (*BEFORE, *AFTER) if "{a}" in x]
        said = "\n".join(_with_dollars(pick(forms), a, v) for a, v in defined)
        return f"{said}\n{body}" if self.random.random() < 0.5 else f"{body}\n{said}"


def _with_dollars(form: str, name: str, value: str) -> str:
    """A sentence with its mathematics between dollar signs."""
    for joined in ("{a} = {v}", "{a} := {v}"):
        if joined in form:
            return form.replace(joined, f"${name} = {value}$")
    return form.replace("{a}", f"${name}$").replace("{v}", f"${value}$")
