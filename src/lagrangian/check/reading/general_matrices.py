r"""The general form of the equations in matrices whose entries, rows or columns stand elsewhere in an answer.

M(q) q'' + n(q, q') = f(q, q', τ)   with M11 = a, M12 = b, …, n1 = c, … and f = [d; e]
                                    [M11, M12; M21, M22]*q'' + [n1; n2] = f
Row 1 of M: [a, b]                  M = [a, b; c, d]
M_xx = a, M_xφ = b, …, n_x = c, …   entries that are named by the coordinates
| M₁₁ | a |                         M₁₁ = a
|  | x | φ |   | x | a | b |   …    M_11 = a, M_12 = b, …
\mathbf{M}(q)\ddot{q} + h(q, \dot q) = 0   with M_{11} = a, …
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import islice

from lagrangian.check.reading.name_patterns import LOWERED
from lagrangian.check.reading.programs.matrices import told_order
from lagrangian.check.reading.said.matrix_tables import FormLetters, with_matrix_tables
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.read.letters import GREEK, key
from lagrangian.records import dataclass

MOST = 6
"""The most rows of a matrix that is given so, and the most general forms of an answer that are looked at."""

_TABLE = re.compile(r"(?:^[ \t]*+\|[^\n]{1,2000}\|[ \t]*+(?:\n|\Z)){2,40}", re.MULTILINE)
_RULE = re.compile(r"[ \t]*\|(?:[ \t]*:?-{1,40}:?[ \t]*\|){1,9}[ \t]*")
_INDEX = r"_?\{?[1-6₁-₆]{1,2}\}?"
_COLUMN = r"[A-Za-zΞτΓ]|\\(?:Xi|tau|Gamma)(?![A-Za-z])"
"""The letter of a column."""
_NAMED_INDEX = r"_(?:\{[^{}\n=]{1,24}\}|\\[A-Za-z]{2,12}|[^\W\d]{1,12})"
"""An index that names coordinates: M_xφ, M_{\\theta s}."""
_ENTRY = rf"[A-Za-z]{_INDEX}"
_ENTRIES = re.compile(rf"{_ENTRY}(?:[ \t]*+=[ \t]*+{_ENTRY}){{0,3}}")
_ROW = re.compile(
    r"^[ \t]*(?:(?:row|Zeile)[ \t]+(?P<after>[1-6])|(?P<before>[1-6])(?:st|nd|rd|th|\.)[ \t]+(?:row|Zeile))[ \t]+"
    r"(?:of|von)[ \t]+(?P<name>[A-Z])[ \t]*[:=][ \t]*[\[(](?P<row>[^\[\]\n]{1,600})[\])][ \t]*+[,;.]?[ \t]*+$",
    re.MULTILINE | re.IGNORECASE,
)
_SIGN = r"[ \t]{0,9}[-+−][ \t]{0,9}"


@dataclass(frozen=True, slots=True)
class _Notation:
    """How an answer writes this form: what a matrix depends on, (q, q'), which says nothing; a name, the column of
    accelerations and that of the coordinates or their rates; a column that is written out; what stands in front of the
    form and behind it; how the definition of a name begins that is written out; and how the reader is given a matrix,
    its rows and the accelerations."""

    of: str
    name: str
    acceleration: str
    rates: str
    written_out: str
    front: str
    behind: str
    equals: str
    opened: str
    matrix: tuple[str, str, str, str]
    derived: str
    longer: str = ""
    """Names of several letters, each with a bar behind it, of which an answer gives entries: Mq."""

    @property
    def term(self) -> str:
        """A column: its name, with what it depends on, or a matrix times the coordinates, or what is written out."""
        name = self.name.replace("NAME", f"(?:{self.longer}{_COLUMN})")
        return rf"(?:{self.written_out}|{name}{self.of}(?:{self.rates})?)"

    def general(self) -> re.Pattern[str]:
        """The form: M q'' + n = f."""
        matrix, more = self.name.replace("NAME", f"(?P<matrix>{self.longer}[A-Z])"), rf"(?:{_SIGN}{self.term})"
        return re.compile(
            rf"{self.front}{matrix}{self.of}{self.acceleration}(?P<more>{more}{{0,3}})"
            rf"[ \t]{{0,9}}{self.equals}[ \t]{{0,9}}"
            rf"(?P<right>{_ZERO}|[-−]?[ \t]{{0,3}}{self.term}{more}{{0,3}}){self.behind}",
            re.MULTILINE,
        )

    def part(self) -> re.Pattern[str]:
        """One of the columns that are added up."""
        name = self.name.replace("NAME", f"(?P<name>{self.longer}{_COLUMN})")
        return re.compile(
            rf"(?P<sign>[-+−]?)[ \t]{{0,9}}(?:(?P<whole>{self.written_out})|{name}{self.of}(?P<rates>{self.rates})?)"
        )

    def written(self, rows: Sequence[Sequence[str]]) -> str:
        """A matrix of these rows."""
        begin, gap, row, end = self.matrix
        return begin + row.join(gap.join(x) for x in rows) + end


_ZERO = r"(?:[\[{]?0[\]}]?(?!\w)|\\(?:mathbf|boldsymbol|bm|vec)[ ]?\{?[ ]?0[ ]?\}?)"
_PLAIN = _Notation(
    of="(?:\\([\\w'’′\u0307\u0308 \\t,]{1,60}+\\))?",
    name=r"[\[{]?NAME[\]}]?",
    acceleration=(
        "[ \\t]{0,3}[·*]?[ \\t]{0,3}(?:\\{?[ \\t]?(?P<column>[qxzξ])[ \\t]?(?:''|″|’’|′′|\u0308)[ \\t]?\\}?"
        "|(?P<listed>(?:\\[[^\\[\\]\n=]{3,200}\\]|\\((?=[^()\n]{1,200},)[^()\n=]{3,200}\\)(?=\\^T|ᵀ))(?:\\^T|ᵀ)?))"
    ),
    rates="[ \\t]{0,3}[·*]?[ \\t]{0,3}\\{?[qxzξ](?:['’′\u0307]|(?![\\w'’′\u0307\u0308]))\\}?",
    written_out=r"\[[^\[\]\n=]{1,200}[,;][^\[\]\n=]{1,200}\](?:\^T|ᵀ)?",
    front=r"(?:(?<![\w*`])(?:\*\*|`)|(?<![\w'’′)+*/^=-]))",
    behind=r"(?:\*\*|`)?(?=[ \t]*+(?:$|[,;.:](?:$|[ \t])|(?<=[ \t])(?:with|where|mit|wobei)\b))",
    equals="=",
    opened=r"\[|diag[ ]?\(|\((?=[^\n=]{1,200},)",
    matrix=("[", ", ", "; ", "]"),
    derived="*{}''",
)
_BOLD = r"(?:\\(?:mathbf|boldsymbol|bm|mathrm|vec|underline)[ ]?)"
_GAP = r"(?:[ \t]|\\[,;!: ]){0,4}+"
_LETTER = r"(?:\\xi|[qxz])(?![A-Za-z])"
_BRACES = rf"{_BOLD}?\{{?[ ]?{_BOLD}?\{{?[ ]?"
_LATEX = _Notation(
    of=rf"(?:{_GAP}(?:\\left)?\([\w\\{{}}, \t'’′;]{{1,120}}?(?:\\right)?\))?",
    name=rf"(?:{_BOLD}\{{?[ ]?)?(?<![A-Za-z\\])NAME(?![A-Za-z_])(?:[ ]?\}})?",
    acceleration=(
        rf"{_GAP}(?=\\ddot|[^=+-]{{1,24}}'')(?:\\ddot[ ]?)?{_BRACES}(?P<column>{_LETTER})[ ]?\}}{{0,2}}(?:'')?"
    ),
    rates=rf"{_GAP}(?:\\dot[ ]?)?{_BRACES}{_LETTER}[ ]?\}}{{0,2}}'?",
    written_out=r"\\begin\{[bp]?matrix\}[^=\n]{1,200}?\\end\{[bp]?matrix\}",
    front=r"(?<![\w'^)+*/=}-])",
    behind=r"(?=[ \t]*+(?:$|[,;.]|\\[\])\\]|\\q?quad|\\end|\$|\\text))",
    equals="&?=",
    opened=r"\\begin\{[bpv]?matrix|\\left[(\[]|\\(?:mathrm|operatorname|text)\{diag\}|\((?=[^\n=]{1,200},)",
    matrix=(r"\begin{bmatrix}", " & ", r" \\ ", r"\end{bmatrix}"),
    derived=r" \ddot{{{}}}",
)
_LONGER = re.compile(r"(?<![\w\\])([A-Za-z]_?[a-z]{1,2})_?(?:11|₁₁)[ \t]*=(?!=)")
"""The name of several letters of a matrix, in front of the places of its first entry."""
_FORMS = {False: (_PLAIN, _PLAIN.general(), _PLAIN.part()), True: (_LATEX, _LATEX.general(), _LATEX.part())}
ACCELERATION = re.compile("''|″|’’|′′|\u0308|\\\\ddot")


def with_general_form(
    written: TracedText,
    coordinates: Sequence[str],
    taken: Callable[[str], bool],
    notes: dict[str, None],
    *,
    latex: bool,
) -> TracedText:
    """Return an answer with this form in the entries that it gives, one for each of the ``coordinates`` in a column, of
    which none is ``taken`` by the system; only if it gives all of them."""
    if not 2 <= len(coordinates) <= MOST or not ACCELERATION.search(written.text):
        return written
    coordinates = _ordered(coordinates, written.text)
    written = with_matrix_tables(written, coordinates, lambda text: _letters(text, latex=latex), latex=latex)
    if not latex:
        written = _with_rows(_with_entries(written), len(coordinates))
    form = _Form(written.text, coordinates, taken, latex=latex)
    return written.edited(list(form.edits(notes)))


def _ordered(coordinates: Sequence[str], text: str) -> Sequence[str]:
    """The coordinates as an answer lists them, q = (θ, x); as they are if it does not list all of them."""
    own = {key(name): name for name in coordinates}
    found = [x for written in told_order(text) if (x := own.get(key(written))) is not None]
    return found if sorted(found) == sorted(coordinates) else coordinates


def _letters(text: str, *, latex: bool) -> FormLetters | None:
    """The letters of the first general form in an answer."""
    _, general, part = _FORMS[latex]
    if (match := general.search(text)) is None:
        return None
    parts = [m for side in ("more", "right") for m in part.finditer(match[side]) if m["name"]]
    squares = frozenset(m["name"] for m in parts if m["rates"])
    return FormLetters(match["matrix"], squares, frozenset(m["name"] for m in parts) - squares)


class _Form:
    """The general form in an answer, with what the answer gives of its matrices and columns."""

    def __init__(self, text: str, coordinates: Sequence[str], taken: Callable[[str], bool], *, latex: bool) -> None:
        self.text, self.count, self.taken, self.latex = text, len(coordinates), taken, latex
        self.places = _places(coordinates)
        self.notation, self.general, self.part = _FORMS[latex]
        names = sorted(set() if latex else set(islice(_LONGER.findall(text), MOST)), key=len, reverse=True)
        if names:
            self.notation = replace(_PLAIN, longer="".join(rf"{x}(?![\w'’′])|" for x in names))
            self.general, self.part = self.notation.general(), self.notation.part()
        self.symmetric: list[str] = []
        """What is said of entries that only symmetry gives."""

    def edits(self, notes: dict[str, None]) -> Iterator[Edit]:
        """The forms, written out."""
        for match in islice(self.general.finditer(self.text), MOST):
            self.symmetric = []
            square = self._square(match["matrix"])
            sides = [self._side(match[x]) for x in ("more", "right")]
            if square is None or None in sides or not _is_closed(match.group()):
                continue
            before = self.text[self.text.rfind("\n", 0, match.start()) + 1 : match.start()].strip()
            start, end = ("", "") if self.latex else ("\n" if before else "", "\n")
            listed = match.groupdict().get("listed")
            if listed and not ACCELERATION.search(listed):
                continue
            derived = f"*{listed}" if listed else self.notation.derived.format(match["column"])
            notes.update(dict.fromkeys(self.symmetric))
            yield *match.span(), f"{start}{square}{derived}{sides[0]} = {sides[1]}{end}"

    def _side(self, side: str) -> str | None:
        """Columns that are added up on one side, each as its entries or by its name; None if one is not given."""
        if re.fullmatch(_ZERO, side.strip()):
            return "0"
        if self.part.sub("", side).strip():
            return None
        found: list[str] = []
        for part in self.part.finditer(side):
            column = part["whole"] or (self._square if part["rates"] else self._column)(part["name"])
            if column is None:
                return None
            times = "" if self.latex or not part["rates"] else "*"
            rates = f"{times}{(part['rates'] or '').strip(' *·')}"  # C q'
            found.append(f" {part['sign'].replace('−', '-')} {column}{rates}" if part["sign"] else f"{column}{rates}")
        return "".join(found)

    def _entries(self, name: str) -> dict[str, str]:
        """The entries of a name that an answer gives, as it writes them."""
        given = rf"(?<![\w\\])({re.escape(name)}(?:{_INDEX}|{_NAMED_INDEX}))[ \t]{{0,9}}{self.notation.equals}(?!=)"
        found = {m.translate(LOWERED) for m in re.findall(given, self.text)}
        begins = len(name.replace("_", ""))
        entries = {re.sub(r"[_{}]", "", m)[begins:]: m for m in found if not self.taken(re.sub(r"[{}]", "", m))}
        return {self.places.get(re.sub(r"[\\ ,]", "", place), place): m for place, m in entries.items()}

    def _square(self, name: str) -> str | None:
        """A matrix, by its entries, for which small letters may stand, too, or by its name; None if it is not given."""
        numbers = [str(k + 1) for k in range(self.count)]
        for written in (name, name.lower()):
            plain = self._entries(written)
            for i, j in ((i, j) for i in numbers for j in numbers if i + j not in plain and j + i in plain):
                self.symmetric.append(f"{written}{i}{j} was read as {written}{j}{i}: the matrix is symmetric.")
            rows = [[plain.get(i + j) or plain.get(j + i) for j in numbers] for i in numbers]
            if all(map(all, rows)):
                return self.notation.written([[str(x) for x in row] for row in rows])
            self.symmetric = []
        return self._whole(name)

    def _column(self, name: str) -> str | None:
        numbers = [str(k + 1) for k in range(self.count)]
        plain = self._entries(name)
        if all(k in plain for k in numbers):
            return self.notation.written([[plain[k]] for k in numbers])
        return self._whole(name)

    def _whole(self, name: str) -> str | None:
        """The name as it is written where it is given a matrix."""
        named = self.notation.name.replace("NAME", re.escape(name))
        given = rf"(?<![\w\\])(?P<named>{named}){self.notation.of}[ \t]{{0,9}}{self.notation.equals}[ \t\n]{{0,9}}"
        match = re.search(rf"{given}(?:{self.notation.opened})", self.text)
        return None if match is None else match["named"]


def _places(coordinates: Sequence[str]) -> dict[str, str]:
    """The numbers for which names of coordinates stand in an index, of one or two of them."""
    signs = {word: sign for sign, word in GREEK.items()}
    spelled = [{name, signs.get(name, name)} for name in coordinates]
    single = {x: str(k + 1) for k, names in enumerate(spelled) for x in names}
    pairs = {x + y: single[x] + single[y] for x in single for y in single}
    return single | {pair: place for pair, place in pairs.items() if pair not in single}


def _is_closed(written: str) -> bool:
    """Whether no brace or bracket is open in a text."""
    return all(written.count(x) == written.count(y) for x, y in ("{}", "[]", "()"))


def _with_entries(written: TracedText) -> TracedText:
    """An answer in which a table of entries and their values is a list of statements."""
    edits: list[Edit] = []
    for match in islice(_TABLE.finditer(written.text), MOST):
        lines = match.group().rstrip("\n").split("\n")
        titled = next((k for k, line in enumerate(lines[:2]) if _RULE.fullmatch(line)), 0)
        cells = [[x.strip().strip("$`*") for x in line.strip()[1:-1].split("|")] for line in lines]
        body = [row for row, line in zip(cells, lines, strict=True) if _RULE.fullmatch(line) is None and any(row)]
        body = body[1:] if titled == 1 else body
        if body and all(len(row) == 2 and _ENTRIES.fullmatch(row[0]) for row in body):
            edits += _statements(match.start(), lines, cells)
    return written.edited(edits)


def _statements(at: int, lines: Sequence[str], cells: Sequence[Sequence[str]]) -> Iterator[Edit]:
    for line, row in zip(lines, cells, strict=True):
        stated = len(row) == 2 and _ENTRIES.fullmatch(row[0]) is not None
        yield at, at + len(line), f"{row[0]} = {row[1]}" if stated else ""
        at += len(line) + 1


def _with_rows(written: TracedText, count: int) -> TracedText:
    """An answer in which a matrix of which every row has a line of its own is stated as a whole, in the first one."""
    found: dict[str, dict[str, re.Match[str]]] = {}
    for match in islice(_ROW.finditer(written.text), MOST * MOST):
        found.setdefault(match["name"], {}).setdefault(match["after"] or match["before"], match)
    edits: list[Edit] = []
    for name, rows in found.items():
        if sorted(rows) == [str(k + 1) for k in range(count)]:
            listed = [rows[k] for k in sorted(rows)]
            whole = "; ".join(m["row"] for m in listed)
            edits += [(*m.span(), f"{name} = [{whole}]" if k == 0 else "") for k, m in enumerate(listed)]
    return written.edited(edits)
