r"""Reads tables of Markdown whose rows and columns stand for coordinates: a matrix, columns, or whole equations.

M q'' + h = f   | | x | θ |   | x | a | b |   | θ | b | d |        M_11 = a   M_12 = b   M_21 = b   M_22 = d
                | | h | f |   | x | k x | F |                      h_1 = k x   f_1 = F
                | h | k x | 0 |  below  | | x | θ |                h_1 = k x   h_2 = 0
**h**           - x: k x      - θ: 0                               h_1 = k x   h_2 = 0
| | x'' | θ'' | rest | right-hand side |   | x | a | b | k x | F | (a)*x'' + (b)*θ'' + (k x) = F

The cell in the corner or the line above says which letter of the general form it is; accelerations above the columns
say that it is the one in front of q″. A matrix may also stand there without heads, as so many rows of so many cells.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.read.letters import key
from lagrangian.records import dataclass

MOST, LONGEST = 12, 2_000
"""The most tables that are looked at, and the most characters of a line."""

_TABLE = re.compile(r"(?:^[ \t]*+\|[^\n]*\|[ \t]*+(?:\n|\Z))+", re.MULTILINE)
_RULE = re.compile(r"[ \t]*\|(?:[ \t]*:?-{1,40}:?[ \t]*\|){1,12}[ \t]*")
_SYMBOL = r"\\?[^\W\d_]\w{0,15}"
_RATED = re.compile(
    rf"(?P<name>{_SYMBOL}?)(?P<above>[\u0307\u0308]?)(?P<below>\w{{0,6}})(?P<primes>''|″|’’|′′|['’′]|\"|)"
    rf"|\\(?P<dots>d?dot)[ ]?\{{?[ ]?(?P<dotted>{_SYMBOL}(?:_?\{{\w{{1,6}}\}})?)[ ]?\}}?"
    rf"|d(?P<two>²|\^2)?[ ]?(?P<of>{_SYMBOL})[ ]?/[ ]?dt(?:²|\^2)?"
)
"""What stands for a coordinate or its rates in a head."""
_FACTOR = re.compile(
    r"(?:[×*·][ ]?|times[ ]|mal[ ]"
    r"|(?:the[ ])?(?:coefficients?|coeff\.|factors?|Koeffizient|Faktor)[ ](?:of|von|bei)[ ])\$?",
    re.IGNORECASE,
)
"""What may stand in front of what a column is multiplied by."""
_LABEL = re.compile(
    r"(?:(?:row|eq(?:uation)?\.?|equation of motion|coordinate|line|Zeile|Gleichung|Gl\.|for|of|für|von|d/dt)[ ]?)*"
    r"[(\[]?(?P<of>[^()\[\]\s-]{1,24})[)\]]?"
    r"(?:[ -]?(?:eq(?:uation)?\.?|row|component|coordinate|direction|balance|Gleichung|Zeile))?[.:]?",
    re.IGNORECASE,
)
_ORDINALS = {x: k for listed in ("1 2 3 4 5 6", "I II III IV V VI") for k, x in enumerate(listed.split())}
_RIGHT = re.compile(
    r"(?:=[ ]?)?(?:the[ ])?(?:right(?:[- ]?hand)?(?:[ ]?sides?)?|r\.?h\.?s\.?|rechte Seite|rechts)(?:[ ]?[(,:].{0,40})?"
    r"|=(?:[ ]?[^=|]{1,30})?",
    re.IGNORECASE,
)
_REST = re.compile(
    r"(?:the[ ])?(?:rest|others?|(?:other|remaining|further|more)[ ]terms)|everything else", re.IGNORECASE
)
_MASS = re.compile(r"\b(?:mass|inertia)(?:[ ]|-)?matrix|Massenmatrix|matrice (?:de masse|d'inertie)", re.IGNORECASE)
_LIST = re.compile(
    r"^[ \t]*+(?P<of>[#*`$\\{}\w(][^\n=+]{0,40}?)[ \t]*+[:=]?[ \t*]*+\n(?:[ \t]*+\n)?"
    r"(?P<items>(?:[ \t]*(?:[-*•]|\d[.)])[ \t]+[^\n=]{1,400}(?:\n|\Z)){2,6})",
    re.MULTILINE,
)
"""A line that may be the letter of a column, and a list below it."""
_ITEM = re.compile(
    r"^[ \t]*(?:[-*•]|\d[.)])[ \t]+(?:(?P<label>[^\n:|]{1,40}):[ \t]+)?(?P<value>[^\n]+?)[ \t]*+[.,;]?[ \t]*+$",
    re.MULTILINE,
)
_MARKS = re.compile(r"[*#`$]|\\mathbf|\\boldsymbol|\\bm|[{}]|\([^()\n]{0,40}\)")
"""What stands around a letter that says nothing of it, M(q) or **M**."""


@dataclass(frozen=True)
class FormLetters:
    """The letters of a general form M q'' + C q' + h = f: the matrix in front of the accelerations, other matrices,
    and the columns."""

    mass: str
    squares: frozenset[str]
    columns: frozenset[str]

    @property
    def all(self) -> frozenset[str]:
        """Every letter that stands for something with rows."""
        return self.columns | self.squares | {self.mass}


@dataclass(frozen=True)
class _Head:
    """What stands above a column: a coordinate by its number and how often it is differentiated."""

    number: int
    rates: int
    written: str


def with_matrix_tables(
    written: TracedText, coordinates: Sequence[str], letters: Callable[[str], FormLetters | None], *, latex: bool
) -> TracedText:
    """Return an answer in which the cells of such tables are statements, each on the line of its row; ``letters`` finds
    those of the general form, and ``coordinates`` are in the order of its columns."""
    drawn = "|" in written.text and "--" in written.text
    tables = list(islice(_TABLE.finditer(written.text), MOST)) if drawn else []
    lists = list(islice(_LIST.finditer(written.text), MOST))
    if not tables and not lists:
        return written
    form = letters(written.text)
    reader = _Reader(coordinates, form, latex)
    edits = list(_lists(lists, reader, form)) if form is not None else []
    for match in tables:
        lines = match.group().rstrip("\n").split("\n")
        if not 2 < len(lines) <= 12 or _RULE.fullmatch(lines[1]) is None or max(map(len, lines)) > LONGEST:
            continue
        cells = [[_bare(x) for x in line.strip()[1:-1].split("|")] for line in lines if line is not lines[1]]
        above = written.text[: match.start()].rstrip().rpartition("\n")[2]
        if len({len(row) for row in cells}) > 1 or (made := reader.read(cells, above)) is None:
            continue
        at = match.start()
        for k, line in enumerate(lines):
            edits.append((at, at + len(line), "" if k == 1 else "\n".join(made[max(0, k - 1)])))
            at += len(line) + 1
    return written.edited(edits)


def _lists(lists: Sequence[re.Match[str]], reader: _Reader, form: FormLetters) -> Iterator[Edit]:
    """The entries of columns that are listed below their letters, each behind its coordinate or in their order."""
    for match in lists:
        letter = _MARKS.sub(" ", match["of"]).strip(" :=\t")
        items = list(_ITEM.finditer(match["items"]))
        if letter not in form.columns or len(items) != reader.count or not all(_is_value(x["value"]) for x in items):
            continue
        said = [bool(x["label"]) for x in items]
        labels = reader.labels([x["label"] for x in items]) if all(said) else None if any(said) else range(len(items))
        for item, k in zip(items, labels or (), strict=False):
            start = match.start("items")
            yield start + item.start(), start + item.end(), reader.entry(letter, (k,), _bare(item["value"]))


def _bare(cell: str) -> str:
    """A cell without the marks around it."""
    bare = cell.strip().strip("*`").strip()
    return bare.strip("$").strip() if bare.count("$") == 2 and bare[0] == bare[-1] == "$" else bare


class _Reader:
    """Reads tables of an answer with these ``coordinates`` and letters of its general ``form``."""

    def __init__(self, coordinates: Sequence[str], form: FormLetters | None, latex: bool) -> None:
        self.numbers = {key(name): k for k, name in enumerate(coordinates)}
        self.count, self.form, self.latex = len(coordinates), form, latex

    def read(self, cells: Sequence[Sequence[str]], above: str) -> list[list[str]] | None:
        """The statements of each row, the head first; None for a table of another kind."""
        head, body = cells[0], cells[1:]
        if (made := self._equations(head, body)) is not None or self.form is None:
            return made
        made = self._square(head, body, above)
        made = self._columns(head, body) if made is None else made
        made = self._rows(head, body) if made is None else made
        return self._without_heads(cells, above) if made is None else made

    def _head(self, cell: str) -> _Head | None:
        """The coordinate that a cell stands for, with its rates."""
        lead = _FACTOR.match(cell)
        cell = cell[lead.end() :].rstrip("$") if lead is not None else cell
        match = _RATED.fullmatch(cell)
        if match is None:
            return None
        if match["dots"]:
            name, rates = re.sub(r"[{}]", "", match["dotted"]), len(match["dots"]) - 2
        elif match["of"]:
            name, rates = match["of"], 2 if match["two"] else 1
        else:
            name = match["name"] + match["below"]
            marks = {"\u0307": 1, "\u0308": 2}.get(match["above"], 0)
            rates = marks + (2 if match["primes"] in ("''", "″", "’’", "′′", '"') else bool(match["primes"]))
        number = self.numbers.get(key(name.lstrip("\\").removeprefix("var")))
        return None if number is None or rates > 2 else _Head(number, rates, cell.replace('"', "''"))

    def labels(self, cells: Sequence[str]) -> list[int] | None:
        """The numbers of the coordinates that cells in front of rows stand for; None if that is not sure."""
        found: list[int] = []
        for cell in cells:
            match = _LABEL.fullmatch(cell)
            of = match["of"].rstrip(":.") if match is not None else ""
            head = self._head(of)
            found.append(_ORDINALS.get(of, -1) if head is None else head.number)
        return found if sorted(found) == list(range(self.count)) else None

    def _heads(self, cells: Sequence[str]) -> list[_Head] | None:
        """Heads that are all coordinates, each once and with as many rates."""
        heads = [x for x in map(self._head, cells) if x is not None]
        if sorted(x.number for x in heads) != list(range(self.count)) or len(heads) < len(cells):
            return None
        return heads if len({x.rates for x in heads}) == 1 else None

    def _equations(self, head: Sequence[str], body: Sequence[Sequence[str]]) -> list[list[str]] | None:
        """The equations of a table that has accelerations above its columns, and a right side above the last."""
        labelled = 0 if self._head(head[0]) else 1
        heads = [self._head(x) for x in head[labelled:-1]]
        rest = [bool(_REST.fullmatch(x)) for x in head[labelled:-1]]
        known = all(a is not None or b for a, b in zip(heads, rest, strict=True))
        accelerations = sorted(x.number for x in heads if x is not None and x.rates == 2)
        if not known or accelerations != list(range(self.count)) or not _RIGHT.fullmatch(head[-1]):
            return None
        made: list[list[str]] = [[]]
        for row in body:
            terms = row[labelled:]
            if not all(map(_is_value, terms)):
                return None
            left = " + ".join(self._times(x, h) for x, h in zip(terms, heads, strict=False))
            made.append([self._statement(left, terms[-1])])
        return made

    def _times(self, entry: str, head: _Head | None) -> str:
        """An entry times what stands above it."""
        if self.latex:
            return rf"\left({entry}\right)" + (f" {head.written}" if head else "")
        return f"({entry})" + (f"*{head.written}" if head else "")

    def _letter(self, written: str) -> str | None:
        """The one letter of the form that a cell or a line is about: M(q), **Mass matrix M**, M =; None if not one."""
        assert self.form is not None
        words = re.findall(r"\\?[^\W_]+['’′]{0,2}", _MARKS.sub(" ", written))
        found = {x for x in words if x in self.form.all}
        if len(found) == 1 and len(written) <= 120 and "=" not in written.rstrip(" =:"):
            return found.pop()
        return self.form.mass if not found and _MASS.search(written) and "=" not in written else None

    def _square(self, head: Sequence[str], body: Sequence[Sequence[str]], above: str) -> list[list[str]] | None:
        """The entries of a matrix whose columns, and rows if they are named, stand for coordinates; columns of the form
        may stand behind them."""
        assert self.form is not None
        more = [self._letter(x) for x in head[self.count + 1 :]]
        if more and all(x in self.form.columns for x in more):
            end = self.count + 1
            square = self._square(head[:end], [row[:end] for row in body], above)
            beside = self._columns([head[0], *head[end:]], [[row[0], *row[end:]] for row in body])
            return None if square is None or beside is None else [[*a, *b] for a, b in zip(square, beside, strict=True)]
        labelled = len(head) == self.count + 1
        heads = self._heads(head[labelled:])
        labels = self.labels([row[0] for row in body]) if labelled else list(range(self.count))
        if heads is None or labels is None or len(body) != self.count:
            return None
        letter = self._letter(head[0]) if labelled and head[0] else self._letter(above)
        if (
            letter is None
            and not self.form.squares
            and "=" in above
            and self.form.mass in _MARKS.sub(" ", above).split()
        ):
            letter = self.form.mass  # the form itself stands above
        if letter in (None, *self.form.columns) and heads[0].rates == 2:
            letter = self.form.mass
        if letter is None or letter in self.form.columns or (heads[0].rates == 2 and letter != self.form.mass):
            return None
        rows = labels if labelled else [x.number for x in heads]
        made: list[list[str]] = [[]]
        for i, row in zip(rows, body, strict=True):
            entries = row[labelled:]
            if not all(map(_is_value, entries)):
                return None
            made.append([self.entry(letter, (i, h.number), x) for h, x in zip(heads, entries, strict=True)])
        return made

    def _columns(self, head: Sequence[str], body: Sequence[Sequence[str]]) -> list[list[str]] | None:
        """The entries of columns whose letters stand above them, beside the coordinates."""
        assert self.form is not None
        letters = [self._letter(x) for x in head[1:]]
        labels = self.labels([row[0] for row in body])
        if labels is None or not letters or not all(x in self.form.columns for x in letters):
            return None
        made: list[list[str]] = [[]]
        for i, row in zip(labels, body, strict=True):
            if not all(map(_is_value, row[1:])):
                return None
            made.append([self.entry(str(of), (i,), x) for of, x in zip(letters, row[1:], strict=True)])
        return made

    def _rows(self, head: Sequence[str], body: Sequence[Sequence[str]]) -> list[list[str]] | None:
        """The entries of columns that are written as rows, below the coordinates."""
        assert self.form is not None
        heads = self._heads(head[1:])
        letters = [self._letter(row[0]) for row in body]
        if heads is None or heads[0].rates == 2 or not all(x in self.form.columns for x in letters):
            return None
        if not all(_is_value(x) for row in body for x in row[1:]):
            return None
        pairs = zip(letters, body, strict=True)
        said = [[self.entry(str(of), (h.number,), x) for h, x in zip(heads, row[1:], strict=True)] for of, row in pairs]
        return [[], *said]

    def _without_heads(self, cells: Sequence[Sequence[str]], above: str) -> list[list[str]] | None:
        """The entries of a matrix or a column without names of rows, whose letter stands above the table."""
        assert self.form is not None
        rows = cells if any(cells[0]) else cells[1:]
        letter = self._letter(above)
        width = 1 if letter in self.form.columns else self.count
        if letter is None or len(rows) != self.count or any(len(row) != width for row in rows):
            return None
        if not all(_is_value(x) for row in rows for x in row):
            return None
        places = [[(i, j) if width > 1 else (i,) for j in range(width)] for i in range(self.count)]
        said = [
            [self.entry(letter, p, x) for p, x in zip(at, row, strict=True)]
            for at, row in zip(places, rows, strict=True)
        ]
        return said if any(cells[0]) else [[], *said]

    def entry(self, letter: str, place: tuple[int, ...], value: str) -> str:
        """The statement of an entry."""
        below = "".join(str(k + 1) for k in place)
        return self._statement(f"{letter}_{{{below}}}" if self.latex else f"{letter}_{below}", value)

    def _statement(self, left: str, value: str) -> str:
        return f"${left} = {value}$" if self.latex else f"{left} = {value}"


def _is_value(cell: str) -> bool:
    """Whether a cell holds one formula: no statement, no words."""
    bare = re.sub(r"\\[A-Za-z]+", " ", cell)
    return re.search(r"\w", bare) is not None and re.search(r"[=:;?…]|[^\W\d_]{6}", bare) is None
