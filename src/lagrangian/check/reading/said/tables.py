r"""Reads tables of Markdown in which no cell states anything by itself: what stands in front and above says of what.

| T | ½ m ẋ² |                                T = ½ m ẋ²          a quantity and its value; so Q_x, ∂L/∂ẋ, d/dt
| q | ∂L/∂q̇ | d/dt | Q |   | x | m ẋ | m ẍ | F |     ∂L/∂x' = m ẋ   d/dt(∂L/∂x') = m ẍ   Q_x = F
| part | kinetic | potential |   | plate | ½ M ẏ² | M g y |   T_plate = ½ M ẏ²   V_plate = M g y
| | x | y |   | ∂L/∂q̇ | m ẋ | m ẏ |                 ∂L/∂x' = m ẋ   ∂L/∂y' = m ẏ
| letter | meaning |   | e | x - u, stretch |       e = x - u           a new letter, its value and words about it
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.quantities.units import lookup
from lagrangian.records import dataclass

MOST, LONGEST = 40, 4_000
"""The most tables and lines of one, and the most characters of a line."""

_TABLE = re.compile(r"(?:^[ \t]*+\|[^\n]*\|[ \t]*+(?:\n|\Z))+", re.MULTILINE)
_RULE = re.compile(r"[ \t]*\|(?:[ \t]*:?-{1,40}:?[ \t]*\|)+[ \t]*")
_WORDS = re.compile(r"[^\W\d_]{4,}")
_LABEL = re.compile(r"[\w \t.,:()/*'’-]{0,60}")
"""What may stand in front of the statement of a row."""
_BEHIND = r"(?:[ ]?[-,:(][^|\n]{0,60}|[ ]of[ ][^|\n]{0,40})?"
_SIDES = tuple(
    re.compile(rf"(?:the[ ])?(?:{words}){_BEHIND}", re.IGNORECASE)
    for words in (
        r"left(?:[- ]?hand)?(?:[ ]?sides?)?|l\.?[ ]?h\.?[ ]?s\.?|linke(?:[ ]Seite)?|links"
        r"|(?:membre[ ]de[ ])?gauche|lado[ ]izquierdo",
        r"(?:=[ ]?)?(?:right(?:[- ]?hand)?(?:[ ]?sides?)?|r\.?[ ]?h\.?[ ]?s\.?|rechte(?:[ ]Seite)?|rechts"
        r"|(?:membre[ ]de[ ])?droite?|lado[ ]derecho)",
    )
)
"""What stands above the columns of the left sides and of the right sides."""
_EQUALS = re.compile(r"equals?|is|ist|gleich|égale?", re.IGNORECASE)
_EQUAL = re.compile(
    r"^[ \t]*(?:(?:in|for)[ ](?:every|each|all)[ ]rows?,?[ ])?(?:the[ ])?(?:left|first|second|linke)(?:[- ]?hand)?[ ]?"
    r"(?:sides?|columns?|Seite|Spalte)?[ ]?(?:=|equals?|is[ ]equal[ ]to|are[ ]equal[ ]to|ist[ ]gleich)[ ]?"
    r"(?:the[ ]|der[ ])?"
    r"(?:right|second|third|last|rechten?)(?:[- ]?hand)?[ ]?(?:sides?|columns?|(?:one|two)s?|Seite|Spalte)?"
    r"(?:[ ](?:in|for|of)[^=\n|]{0,40})?[.:]?[ \t]*$",
    re.MULTILINE | re.IGNORECASE,
)
"""Words that say that the columns of a table are equal: left side = right side in every row."""
_NOTHING = frozenset(["", "-", "–", "—", "−", "/", "none", "keine"])
_ENERGIES = {
    "T": ("T", "T*", "T^*", "kinetic", "kinetic energy", "Ekin", "E_kin", "kinetisch", "kinetische Energie", "KE"),
    "V": ("V", "U", "potential", "potential energy", "Epot", "E_pot", "potentiell", "potentielle Energie", "PE"),
    "D": ("dissipation", "Rayleigh", "Dissipation"),
}
_KINDS = {word: kind for kind, words in _ENERGIES.items() for word in words}
_SUM = re.compile(r"[Tt]otal|[Ss]um|[Ss]umme|[Gg]esamt|[Tt]ogether|Σ|∑|\\\\[Ss]um|\\\\Sigma")
"""What stands in front of a row that is the sum of those above."""
_LONG = 400
"""The most characters of an energy in a cell."""
_DOT = r"(?P<dot>\\dot\b[ ]?)?"
_SLOPE = re.compile(
    r"(?P<rate>(?:d[ ]?/[ ]?dt|\\[dt]?frac\{d\}\{dt\})[ ]?[(\[]?)?"
    r"(?:\\[dt]?frac\{)?(?:∂|d|\\partial)[ ]?"
    r"(?P<of>[TVLDℒ]|\\mathcal\{?L\}?|\\Xi)[ ]?(?:/|\}\{)[ ]?(?:∂|d|\\partial)[ ]?"
    rf"{_DOT}\{{?(?P<by>[^\W\d_](?:_?\w{{1,8}})?(?:[\u0307\u0308])?)\}}?(?P<prime>['’′])?\}}?[)\]]?"
)
_BY_TIME = re.compile(r"(?:d[ ]?/[ ]?dt|\\[dt]?frac\{d\}\{dt\})(?:[ ]?[(\[][.…\s]{0,4}[)\]])?")
_FORCE = re.compile(r"(?:Q|Ξ|\\Xi)(?:_\{?(?:q|nc|i|k|\\xi|ξ)\}?)?(?:\^\{?nc\}?)?")
_OF_ONE = re.compile(r"(?:Q|Ξ|\\Xi)_?\{?\\?[^\W_]{1,8}\}?")
_GENERAL = re.compile(r"(?:q|ξ|\\xi)(?:_?[ik])?|x_?[ik]")
_ABOUT = re.compile(
    r"(?:(?:q|ξ|\\xi|x|i|k|n)(?:_?[ijk]|_\{[ijk]\})?[ ]?(?:=|:|→|\\to)"
    r"|(?:for|of|by|row|column|coordinate|für|nach|Koordinate)[ ])"
    r"[ ]?(?P<of>\\?[^\W\d_]\w{0,11})"
)
"""Which coordinate a row or a column is about, if a general letter or a word says it."""
_WORD = re.compile(r"(?<![\w\\])[A-Za-z][a-z]{2,}(?![\w'’′(])")


@dataclass(frozen=True)
class _Quantity:
    """What a cell of a table stands for: a derivative of ``of`` by a coordinate or its ``rate``, a generalized force,
    or the derivative by time of what stands beside it."""

    kind: str
    of: str = ""
    rate: bool = False


def with_tables(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such tables are statements, each on the line of its cell.

    ``moves`` says whether a name is a coordinate, ``taken`` whether it belongs to the system.
    """
    edits: list[Edit] = []
    equal = list(islice(_EQUAL.finditer(written.text), MOST))
    for match in islice(_TABLE.finditer(written.text), MOST):
        lines = match.group().rstrip("\n").split("\n")
        if not 2 < len(lines) <= MOST or _RULE.fullmatch(lines[1]) is None or max(map(len, lines)) > LONGEST:
            continue
        cells = [[_bare(x) for x in line.strip()[1:-1].split("|")] for line in lines]
        cells = [
            [_coordinate(x, moves) for x in cells[0]],
            cells[1],
            *([_coordinate(x[0], moves), *x[1:]] for x in cells[2:]),
        ]
        sides = _sides(match.start(), lines, cells, equal=bool(equal))
        if sides or any("=" in x for row in cells for x in row):
            edits += sides or _without_labels(match.start(), lines)
            edits += ((*m.span(), "") for m in equal if sides)
            equal = [] if sides else equal
            continue
        rows = [cells[0], *cells[2:]]
        made = _made(rows, moves, taken) or _of_letters(rows, taken)
        if made is None:
            continue
        at = match.start()
        for k, line in enumerate(lines):
            said = [] if k == 1 else made[max(0, k - 1)]
            if said or k < 2:
                edits.append((at, at + len(line), "\n".join(said)))
            at += len(line) + 1
    return written.edited(edits)


def _sides(at: int, lines: Sequence[str], cells: Sequence[Sequence[str]], *, equal: bool) -> list[Edit]:
    """The equations of a table whose head says where the sides stand, | | inertia | = forces |, | | left | right |, or
    that has a column of equals signs, or of which words say that its columns are ``equal``: of each row its last
    cells."""
    head, body = cells[0], cells[2:]
    if any(len(row) != len(head) for row in body):
        return []
    signs = [k for k in range(1, len(head)) if all(row[k] == "=" for row in body)]
    said = [k for k, cell in enumerate(head) if k and re.match(r"=(?![=>])", cell)]
    named = len(head) > 1 and (equal or all(map(re.fullmatch, _SIDES, head[-2:])))
    if len(signs) == 1 and (head[signs[0]] in ("", "=") or _EQUALS.fullmatch(head[signs[0]])):
        left, right = signs[0] - 1, signs[0] + 1
    elif not signs and (said == [len(head) - 1] or named) and not any("=" in x for row in body for x in row):
        left, right = len(head) - 2, len(head) - 1
    else:
        return []
    if not 0 <= left <= 1 or right != len(head) - 1 or not all(row[left] and row[right] for row in body):
        return []  # more columns are terms, or forces
    edits: list[Edit] = []
    for k, line in enumerate(lines):
        row = body[k - 2] if k > 1 else None
        made = "" if row is None else _statement(row[left], row[right], latex="\\" in row[left] + row[right])
        edits.append((at, at + len(line), made))
        at += len(line) + 1
    return edits


def _without_labels(at: int, lines: Sequence[str]) -> Iterator[Edit]:
    """Blank the words in front of the one statement of a row, | roller, along x | m x'' = H |, and its marks."""
    for line in lines:
        cells = line.split("|")
        stated = [k for k, cell in enumerate(cells) if "=" in cell]
        others = [cell for k, cell in enumerate(cells) if k not in stated]
        labels = any(_WORDS.search(x) for x in others) and all(_LABEL.fullmatch(x) for x in others)
        if len(stated) == 1 and labels:
            kept = [cell if k in stated else " " * len(cell) for k, cell in enumerate(cells)]
            yield at, at + len(line), " ".join(kept)
        at += len(line) + 1


def _made(
    rows: Sequence[Sequence[str]], moves: Callable[[str], bool], taken: Callable[[str], bool]
) -> list[list[str]] | None:
    """The statements of each row, the head first; None for a table of another kind."""
    width = len(rows[0])
    if width < 2 or any(len(row) != width for row in rows):
        return None
    if (parts := _parts(rows, moves, taken)) is not None:
        return parts
    if width == 2:
        named = [[_stated(row[0], row[1], taken)] for row in rows]
        return [[x for x in said if x] for said in named] if sum(bool(x[0]) for x in named) > 1 else None
    head, body = rows[0], rows[1:]
    if all(moves(_name(x)) for x in head[1:]):
        rows_of = ((_quantity(row[0]), row[1:], _quantity(body[k - 1][0]) if k else None) for k, row in enumerate(body))
        said = [[*_listed([kind] * (width - 1), head[1:], values, above)] for kind, values, above in rows_of]
        return [[], *said] if any(said) else None
    if all(moves(_name(row[0])) for row in body):
        kinds = [_quantity(x) for x in head[1:]]
        said = [[*_listed(kinds, [row[0]] * (width - 1), row[1:], None)] for row in body]
        return [[], *said] if any(said) else None
    return None


_NEW = re.compile(r"\\?[^\W\d][^\W_]{0,11}(?:_\w{1,11}|_\{\w{1,11}\})?(?:\(t\))?['’′]{0,2}")
"""A letter of the answer's own, in a cell."""
_SAID = re.compile(r"[^\n=+*/^\\()]*[^\W\d_]{3}[^\n=+*/^\\]*")
"""Words about a letter."""
_NAMES = re.compile(r"(?<![\w\\])\\?[^\W\d_][^\W_]*(?:_\w+)?")
_MOST_WORDS = 240
"""The most characters of such a cell."""


def _of_letters(rows: Sequence[Sequence[str]], taken: Callable[[str], bool]) -> list[list[str]] | None:
    """The statements of a table that lists the letters of an answer with their values, before or behind words in the
    same cell or in another one; None for another table. A letter that the system has is only told."""
    made: list[list[str]] = [[]]
    new = {_name(row[0]) for row in rows[1:] if _NEW.fullmatch(row[0]) and not taken(_name(row[0]))}

    def known(name: str) -> bool:
        return taken(name) or name in new

    for row in rows[1:]:
        values = [x for cell in row[1:] if (x := _value_in(cell, known)) is not None]
        own = _name(row[0]) in new and len(values) == 1 and values[0] != row[0]
        made.append([_statement(row[0], values[0], latex="\\" in row[0] + values[0])] if own else [])
    return made if new and any(made) and all(_SAID.fullmatch(x) or not x for x in rows[0]) else None


def _value_in(cell: str, known: Callable[[str], bool]) -> str | None:
    """The formula of known names that a cell holds beside words: x - u, the stretch; total mass: M + m."""
    if len(cell) > _MOST_WORDS:
        return None
    if _is_value(whole := re.sub(r"[`$]", " ", cell).strip(), known):
        return whole
    for mark in re.finditer(r"[,;:](?=[ ])|[`$]|(?<=[ ])[(–—-](?=[^\W\d_]{3})", cell):
        parts = [re.sub(r"[`$]", " ", x).strip(" ,;:") for x in (cell[: mark.start()], cell[mark.end() :])]
        for value, words in (parts, parts[::-1]):
            if _is_value(value, known) and _SAID.fullmatch(words):
                return value
    return None


def _is_value(written: str, known: Callable[[str], bool]) -> bool:
    """Whether a text is a formula all of whose names are known, and no mere number or unit."""
    names = [_name(x) for x in _NAMES.findall(written)]
    if not re.search(r"[-−+(]", written) and all(lookup(x) is not None for x in names):
        return False  # N/m
    stray = [x for x in names if function_of(x) is None and x not in _COMMANDS and not known(x)]
    return bool(names) and not stray and re.search(r"[=,:;]", written) is None


_COMMANDS = frozenset(["frac", "dfrac", "tfrac", "sqrt", "dot", "ddot", "cdot", "left", "right", "mathrm", "t"])
"""What is no name of a quantity in a formula."""


def _parts(
    rows: Sequence[Sequence[str]], moves: Callable[[str], bool], taken: Callable[[str], bool]
) -> list[list[str]] | None:
    """The energies of a table with a column for each kind and a row for each body or spring, as parts of them by its
    name, and its row of sums as the whole; None for another table."""
    head, body = rows[0], rows[1:]
    kinds = [_kind_in(cell, taken) for cell in head[1:]]
    cells = [x for row in body for x in row[1:] if x not in _NOTHING]
    if None in kinds or len(set(kinds)) < len(kinds) or any(moves(_name(row[0])) for row in body):
        return None
    if _kind_in(head[0], taken) or not cells or not all(_is_formula(x, taken) and len(x) <= _LONG for x in cells):
        return None
    if not all(_LABEL.fullmatch(row[0]) or _SUM.fullmatch(row[0]) for row in body):
        return None
    made: list[list[str]] = [[]]
    used: set[str] = set()
    for k, row in enumerate(body, 1):
        words = "_".join(re.findall(r"[^\W_]+", row[0])) or str(k)
        label = words if words not in used else f"{words}_{k}"
        used.add(label)
        latex = "\\" in "".join(row[1:])
        named = rf"_{{\mathrm{{{label}}}}}" if latex else f"_{label}"
        named = "" if _SUM.fullmatch(row[0]) else named
        stated = [(kind, x) for kind, x in zip(kinds, row[1:], strict=True) if x not in _NOTHING]
        made.append([_statement(f"{kind}{named}", x, latex=latex) for kind, x in stated])
    return made


def _kind_in(cell: str, taken: Callable[[str], bool]) -> str | None:
    """The kind of the energies in a column, by its head: kinetic, Kinetic energy T, E_kin [J], $T$."""
    bare = re.sub(r"[ ]?[\[(][^()\[\]]{0,20}[\])]\Z", "", cell).replace("$", "").replace("\\", "")
    spoken = re.sub(r"(?<=[a-z]{4})[ ,:]{1,3}[A-Z]\*?\Z", "", bare)
    for word in (bare, spoken, spoken[:1].lower() + spoken[1:]):
        if (kind := _KINDS.get(word)) is not None and not taken(word.rstrip("*^")):
            return kind
    return None


def _listed(
    kinds: Sequence[_Quantity | None], names: Sequence[str], values: Sequence[str], above: _Quantity | None
) -> Iterator[str]:
    """The statements of the cells of a row."""
    last = above
    for kind, name, value in zip(kinds, names, values, strict=True):
        if kind is not None and kind.kind != "time":
            last = kind
        if kind is None or value in _NOTHING or (kind.kind == "time" and (last is None or not last.rate)):
            continue
        meant = last if kind.kind == "time" and last is not None else kind
        latex = "\\" in "".join((*values, name))
        left = _left(meant, _name(name) if not latex else name, latex=latex, by_time=kind.kind in ("time", "p-rate"))
        yield _statement(left, value, latex=latex)


def _left(kind: _Quantity, name: str, *, latex: bool, by_time: bool) -> str:
    """How a quantity of a coordinate is written."""
    if kind.kind == "force":
        return f"Q_{{{name}}}" if latex else f"Q_{name}"
    if not latex:
        made = f"∂{kind.of}/∂{name}{chr(39) if kind.rate else ''}"
        return f"d/dt({made})" if by_time else made
    by = rf"\dot{{{name}}}" if kind.rate else name
    return rf"{chr(92)}frac{{d}}{{dt}} " * by_time + rf"\frac{{\partial {kind.of}}}{{\partial {by}}}"


def _quantity(cell: str) -> _Quantity | None:
    """What a cell in front or above stands for, in general: ∂L/∂q̇, d/dt, Q."""
    if _BY_TIME.fullmatch(cell):
        return _Quantity("time")
    if _FORCE.fullmatch(cell):
        return _Quantity("force")
    match = _SLOPE.fullmatch(cell)
    if match is None:
        return None
    by = match["by"]
    dotted = by.endswith("\u0307") or by == "q̇"
    if not _GENERAL.fullmatch(by.rstrip("\u0307")):
        return None
    of = "L" if match["of"] in ("ℒ",) or "cal" in match["of"] else match["of"]
    rate = bool(match["dot"] or match["prime"] or dotted)
    return _Quantity("p-rate" if match["rate"] else "slope", of, rate)


def _stated(cell: str, value: str, taken: Callable[[str], bool]) -> str | None:
    """The statement of a row of two cells: an energy, a force or a derivative, and its value."""
    cell = re.sub(r"[ ]?\([^()]{1,40}\)\Z", "", cell) if cell[:1] in _KINDS else cell
    energy = _KINDS.get(cell) if not taken(cell.rstrip("*^")) else None
    named = energy is not None or cell in ("L", "ℒ", "D", "\\mathcal{L}") or _OF_ONE.fullmatch(cell)
    named = named or _SLOPE.fullmatch(cell) or _BY_TIME.fullmatch(cell)
    if not named or not _is_formula(value, taken):
        return None
    return _statement(energy or cell, value, latex="\\" in value + cell)


def _is_formula(cell: str, taken: Callable[[str], bool]) -> bool:
    """Whether a cell holds a formula and no words."""
    bare = re.sub(r"\\[A-Za-z]+", " ", cell)
    words = [x for x in _WORD.findall(bare) if function_of(x) is None and not taken(x)]
    return not re.search(r"[=,:;]", cell) and len(words) < 2 and re.search(r"\w", cell) is not None


def _statement(left: str, value: str, *, latex: bool) -> str:
    """A statement, as mathematics of LaTeX where that is used."""
    return f"${left} = {value}$" if latex else f"{left} = {value}"


def _bare(cell: str) -> str:
    """A cell without the marks around it."""
    bare = cell.strip().strip("*`").strip()
    marked = bare.startswith("$") and bare.endswith("$") and bare.count("$") == 2
    return bare.strip("$").strip() if marked else bare


def _coordinate(cell: str, moves: Callable[[str], bool]) -> str:
    """The coordinate that a cell in front or above is about, q = x, i = x or "for x"; other cells as they are."""
    match = _ABOUT.fullmatch(cell)
    return match["of"] if match is not None and moves(_name(match["of"])) else cell


def _name(cell: str) -> str:
    return cell.lstrip("\\").removeprefix("var")
