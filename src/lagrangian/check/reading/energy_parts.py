"""Names the energies of parts of a system that an answer states by words alone, in lists and in tables, T_drum = …

Kinetic energy                   T                  | body | T | V |            rod: T = m v^2/2 + I w^2/2
  drum   1/2 J theta'^2          - cart: ½ M ẋ²     | cart | ½ M ẋ² | 0 |       T_rod = …
"""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.model import Body, Model, RigidBody
from lagrangian.read.letters import SPELLED, key, unaccented, undotted
from lagrangian.records import dataclass

LONGEST = 300
"""The most characters of such an energy, and of a line in which one is sought."""
LONGEST_WORD = 3
"""The most letters of a name that nothing explains."""

_KINDS = {"T": r"kin[eé]ti|cin[eé]t", "V": r"poten[tcz]i"}
_LETTERS = {
    "T": r"T\*?|E_?\{?(?:\\(?:text|mathrm)\{)?kin\}*",
    "V": r"V|U|E_?\{?(?:\\(?:text|mathrm)\{)?pot\}*",
}
_OF_KIND = {kind: re.compile(rf"\b(?:{words})", re.IGNORECASE) for kind, words in _KINDS.items()}
_ALONE = {
    kind: re.compile(rf"[ \t\W]*+(?:(?:[Ss]tep|[Ss]chritt)?[ \t]*+\d{{1,2}}[ \t.):]*+)?(?:{x})[ \t$*:.]*+\Z")
    for kind, x in _LETTERS.items()
}
"""A letter alone on a line, or in the head of a table."""
_LED = {kind: re.compile(rf"[ \t]*+(?:{x})[ \t]++(?=[^\W\d_]{{3}})") for kind, x in _LETTERS.items()}
"""A letter in front of the name of a part: T beam."""
_BULLET = re.compile(r"[ \t]*+(?:(?:[-*•+–]|\d{1,2}[.)]|\w\))[ \t]++)?")
_LABEL = re.compile(
    r"(?P<label>[^\W\d_][\w,+.()'’&/-]{0,24}(?:[ ][\w,+.()'’&/-]{1,24}){0,6}?)"
    r"(?P<gap>[ \t]?:(?=[ \t\w½¼⅐-⅞])|[ ]{2}|[ ]?\t|[ ][–—-](?=[ ]))[ \t]*+"
)
_WHOLE_LABEL = re.compile(
    r"(?:kinetic|potential|elastic and potential)(?:[ -]?co)?[ -]?energy"
    r"|(?:kinetische|potentielle|potenzielle)[ ]energie|énergie[ ](?:cinétique|potentielle)",
    re.IGNORECASE,
)
"""A label that says whose energy it is of nothing but of the whole."""
_MEANT = re.compile(r",[ \t]++(?:(?:with|where|mit|wobei)[ \t]++)?(?=[^\W\d]\w{0,24}+[ \t]*+=(?!=))")
"""What a letter in an energy means, behind it: 1/2 I φ'^2, I = J + m l^2."""
_ARROW = re.compile(r"(?:-+>|=+>|→|⇒|⟶)[ \t]*+")
_REMARK = re.compile(r"[ \t]{2}[(;,#]")
_REASON = re.compile(r"[ \t]+(?:because|since|as|weil|da)[ \t]")
_RATE = re.compile(r"['’′˙\u0307]|\\dot(?![A-Za-z])|_dot\b|(?<=[^\W\d])d(?:ot)?\d?(?:²|\^|\*\*)")
_TWICE = re.compile(r"['’′]{2}|[\u0308″¨]|\\ddot|ddot|dd\b")
_UMLAUT = re.compile("(?<=[A-Za-z])[äëïöü]|[ÄÖÜäëïöü](?=[A-Za-zß])")
_SQUARE = re.compile(r"²|\^\s?\{?2|\*\*\s?2")
_HALF = re.compile(r"½|\b1\s?/\s?2\b|\b0[.,]5|/\s?2\b|\\frac|[⅐-⅞¼¾]|\b1\s?/\s?\d")
_NAME = re.compile(r"\\?[^\W\d½¼¾⅐-⅞⁰-⁹¹²³](?:[^\W½¼¾⅐-⅞⁰⁴-⁹¹²³]|[\u0307\u0308]){0,24}")
_FORMULA = re.compile(r"[\w\s.,+\-−–*·×/^()\[\]{}'’′²³½¼⅐-⅞¾\\|⋅∙\u0307]{2,300}")
_OTHER = re.compile(
    r"damp|dissip|rayleigh|dämpf|amort|reib|fricti|loss|verlust|lagrang|power|leistung|work|arbeit|total|sum|gesamt"
    r"|whole|check|probe|deriv|force|kraft|equation|gleichung|result|momentum|unit|term"
    r"|together|everything|zusammen|system|overall|where|with|hence|thus|then|case|before|after|old|new",
    re.IGNORECASE,
)
"""Words of labels of other things, and of the energy of the whole."""
_SMALL = frozenset(["the", "its", "for", "der", "die", "das", "des", "von", "and", "und", "part"])
_STATED = re.compile(r"(?P<letter>T\*?|V|U)[ \t]*+=(?![=>])")
_LISTED = re.compile(
    r"[ \t]*+(?:(?:[-*•+–]|\d{1,2}[.)]|\w\))[ \t]++)?"
    r"(?P<label>[^\W\d_][\w-]{2,20}(?:[ ][\w-]{1,20}){0,3}?)[ \t]?:?[ \t]++(?P<letter>T\*?|V|U)[ \t]*+=(?![=>])"
)
"""An energy behind the name of what has it: flyer  T = 1/2 J phi'^2."""
_AGAIN = re.compile(r"[ \t]{2,}(?P<letter>T\*?|V|U)[ \t]*+=(?![=>])")
"""One more energy of what has the row above: its rotation below its translation."""
_WHOLE = re.compile(
    r"[ \t]*+(?:(?:[-*•+–]|\d{1,2}[.)]|\w\))[ \t]++)?(?:(?:total|whole|all|sum|system|gesamt)[ \t]?:?[ \t]++)?"
    r"(?P<letter>T\*?|V|U)[ \t]*+=(?![=>])",
    re.IGNORECASE,
)
"""A line that states the energy of the whole."""
_INDEXED = re.compile(r"[TVU]_?\{?[^\W_]{1,40}\}?")
_LATEX = re.compile(r"\\[A-Za-z(\[]|\$")
_DEFINED = re.compile(r"([^\W\d]\w{0,24})[ \t]*+(?:(?:²|\^2)[ \t]*+)?=(?![=>])")
_CELL = re.compile(r"\|")
_RULE = re.compile(r"[-+=| \t:]+")
_WORD = re.compile(r"[^\W\d_]{2,24}")
_NOTHING = frozenset("-–—−/")
"""What stands in a table where something has no such energy."""


def with_parts_of_energies(written: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such energies have a name: that of the body, or the first word in front of it.

    ``taken`` tells whether the system has a name. A T = … behind the name of one body, which has no mass or moment of
    inertia of another, is the energy of this body; in a list of such rows, each is that of what stands in front of it,
    and a line above them says that the whole is their sum, where the answer neither states it nor uses their names.
    """
    lines = list(re.finditer(r"[^\n]+", written.text))
    own = {key(m[1]) for m in _DEFINED.finditer(written.text)}
    latex = _LATEX.search(written.text) is not None
    parts = _Parts(model, lambda x: taken(x) or key(x) in own, own, latex=latex)
    labels = Counter(m["label"].lower() for line in lines if (m := _LABEL.match(line.group())) is not None)
    parts.whole = frozenset(x for x, count in labels.items() if count == 1 and _WHOLE_LABEL.fullmatch(x))
    parts.listed = parts.rows_of_parts(line.group() for line in lines)
    named = [edit for line in lines for edit in parts.named(line)]
    return written.edited([*parts.sums(lines), *named])


@dataclass(frozen=True)
class _Row:
    """A line with a label: the label, and where what it says begins and ends."""

    label: str
    start: int
    end: int


class _Parts:
    """Finds parts of energies line by line; ``kind`` is the energy that a heading above announces."""

    def __init__(self, model: Model, known: Callable[[str], bool], own: set[str], *, latex: bool) -> None:
        self.model, self.known, self.own, self.latex = model, known, set(own), latex
        self.kind: str | None = None
        self.columns: list[str | None] = []
        self.body, self.indent = list[str](), 0
        self.listed = self.more = frozenset[str]()
        """The rows of lists that state the energy of a part, each with the name of it in front."""
        self.whole = frozenset[str]()
        """The labels, in small letters, of an energy of the whole: kinetic energy."""
        self.summands = dict[str, list[tuple[int, str, str]]]()
        """Of each energy, the rows of its list: where each begins, the letter in it, and its name."""
        self.inertias = {b.name: inertia_letters(b) for b in model.bodies}

    def named(self, line: re.Match[str]) -> Iterator[Edit]:
        """What is put into a line so that the energies of parts in it have names."""
        text, at = line.group(), line.start()
        if len(text) > 2 * LONGEST or _RULE.fullmatch(text):
            return
        if text.count("|") > 1:
            yield from self._in_table(text, at)
            return
        self.columns = []
        if text in self.more and (row := _AGAIN.match(text)) is not None:
            listed = self.summands["T" if row["letter"][0] == "T" else "V"]
            listed.append((at, row["letter"], f"{listed[-1][2]}x"))
            yield at + row.start("letter"), at + row.end("letter"), listed[-1][2]
        elif text in self.listed and (row := _LISTED.match(text)) is not None:
            kind = "T" if row["letter"][0] == "T" else "V"
            name = self._name(kind, row["label"])
            self.summands.setdefault(kind, []).append((at, row["letter"], name))
            yield at + row.start("label"), at + row.end("letter"), name
        elif (stated := self._of_body(text)) is not None:
            yield (at + stated[0], at + stated[1], stated[2])
        elif not self.latex and (found := self._in_list(text)) is not None:
            yield (at + found[0], at + found[0], f"{found[1]} = ")

    # -- lists -----------------------------------------------------------------------------------------------------

    def _in_list(self, text: str) -> tuple[int, str] | None:
        """Where a value begins behind its label, and its name."""
        row = self._row(text)
        kind = None if row is None else self._kind(row.label, text[row.start : row.end], ":" in text[: row.start])
        sides = [] if row is None else text[row.start : row.end].split("=")
        one = row is not None and len(self._bodies(row.label)) == 1
        whole = len(sides) == 1 or (one and self.kind is not None and kind == self.kind)
        if row is not None and kind is not None and whole and all(self._is_energy(kind, x.strip()) for x in sides):
            return row.start, self._name(kind, row.label)
        row = row if len(sides) == 1 else None
        if "=" not in text and not _is_dotted_twice(text):
            self.kind = _heading(text)
        elif row is None:
            self.kind = None if _is_dotted_twice(text) else self.kind
        return None

    def _row(self, text: str) -> _Row | None:
        bullet = _BULLET.match(text)
        label = _LABEL.match(text, bullet.end() if bullet is not None else 0)
        if label is None or _OTHER.search(label["label"]) or not self._speaks(label["label"]):
            return None
        start, end = label.end(), len(text.rstrip(" \t.;,"))
        for arrow in _ARROW.finditer(text, start):
            start = arrow.end()
        for form in (_REMARK, _REASON, _MEANT):
            if (remark := form.search(text, start, end)) is not None:
                end = remark.start()
        return _Row(label["label"], start, end)

    def _kind(self, label: str, value: str, marked: bool) -> str | None:
        """Which energy a label or the heading above it says; without both, a mass and squares of rates show T."""
        said = next((k for k in _KINDS if _OF_KIND[k].search(label) or _LED[k].match(f"{label} ")), None)
        if said is not None or self.kind is not None:
            return said or self.kind
        bare = key("".join(value.split()))
        heavy = any(x in bare for letters in self.inertias.values() for x in letters)
        return "T" if marked and heavy and _is_kinetic(value) and _HALF.search(value) else None

    def _speaks(self, label: str) -> bool:
        """Whether a word of a label is no name of the system or of the answer."""
        words = _WORD.findall(label)
        return any(len(x) > 2 and not self.known(x) and x not in _GREEK for x in words)

    def _is_energy(self, kind: str, value: str) -> bool:
        plain = unicodedata.normalize("NFD", value)
        if _FORMULA.fullmatch(plain) is None or _TWICE.search(plain) or not all(map(self._reads, _NAME.findall(plain))):
            return False
        return _is_kinetic(value) if kind == "T" else not _RATE.search(plain) and bool(_NAME.search(plain))

    def _reads(self, word: str) -> bool:
        """Whether a run of letters may be a name or a product of names."""
        base = undotted(word.lstrip("\\"))[0]
        if word.startswith("\\") or len(base) <= LONGEST_WORD or function_of(base) is not None:
            return True
        stems = [base, *(stem for _, stem in spelled_rates(base))]
        return any(self.known(x) or x in _GREEK for x in stems) or any(x in base for x in ("sin", "cos"))

    # -- tables ----------------------------------------------------------------------------------------------------

    def _in_table(self, text: str, at: int) -> Iterator[Edit]:
        """The names of the energies in a row of a table; its head says what the columns are."""
        bars = [m.start() for m in _CELL.finditer(text)]
        cells = [(a + 1, b) for a, b in pairwise(bars)]
        listed = [text[a:b].strip() for a, b in cells]
        if len(heads := [_heading(x.strip("$ ")) for x in listed]) > 1 and any(heads[1:]):
            self.columns = heads
            return
        label = listed[0] if listed else ""
        if not self._speaks(label) or _OTHER.search(label):
            return
        led = next((k for k in _KINDS if _OF_KIND[k].search(label) or _LED[k].match(f"{label} ")), None)
        kinds = self.columns if len(self.columns) == len(cells) else [None, led] if len(cells) == 2 else []
        for (a, b), kind in list(zip(cells, kinds, strict=False))[1:]:
            inside = text[a:b].strip()
            math = inside.startswith("$") and inside.endswith("$") and inside.count("$") == 2
            value = inside.strip("$ ")
            if kind is not None and value in _NOTHING:
                yield at + a, at + b, " "
            if kind is None or "=" in value or math != self.latex or not self._is_energy(kind, value):
                continue
            place = at + text.index(value, a)
            yield place, place, f"{self._name(kind, label)} = "

    # -- energies of one body --------------------------------------------------------------------------------------

    def _of_body(self, text: str) -> tuple[int, int, str] | None:
        """The T of one body, or of several of one name: where its letter stands, and its name."""
        bullet = _BULLET.match(text)
        begins = bullet.end() if bullet is not None else 0
        head, colon, _ = text[begins:].partition(":")
        indent = len(text) - len(text.lstrip())
        if colon and "=" not in head and len(head) <= 6 * 12:
            found = self._bodies(head)
            alike = len(found) < len(self.inertias) and len({self._kind_of(x) for x in found}) == 1
            self.body, self.indent = (found if len(found) == 1 or alike else []), indent
            begins += len(head) + 1
        elif not (self.body and indent > self.indent):
            self.body = []
        stated = _STATED.match(text, len(text) - len(text[begins:].lstrip()))
        if not self.body or stated is None or stated["letter"] not in ("T", "T*"):
            return None
        others = frozenset[str]().union(*(x for name, x in self.inertias.items() if name not in self.body))
        mine = frozenset[str]().union(*(self.inertias[name] for name in self.body))
        named = {key(x) for x in _NAME.findall(text[stated.end() :])}
        if not others - mine or not mine & named or named & (others - mine):
            return None
        return *stated.span("letter"), self._name("T", self.body[0] if len(self.body) == 1 else text[:begins])

    def rows_of_parts(self, lines: Iterable[str]) -> frozenset[str]:
        """The rows that state T, or V, behind names of what has it, where each has only some of the letters of all."""
        found = dict[str, dict[str, set[str]]]()
        above, more = "", dict[str, str]()
        for text in lines:
            row = _LISTED.match(text) if len(text) <= 2 * LONGEST else None
            again = _AGAIN.match(text) if row is None else None
            if again is not None and above and again["letter"] == _LISTED.match(above)["letter"]:  # type: ignore[index]
                more[text] = above
            above = text if row is not None else ""
            if row is None or _OTHER.search(row["label"]) or not self._speaks(row["label"]):
                continue
            named = {key(x) for x in _NAME.findall(text[row.end() :])}
            mine = {p.name for p in self.model.parameters if key(p.name) in named}
            found.setdefault(row["letter"][0], {})[text] = mine
        rows = set[str]()
        for listed in found.values():
            every = set[str]().union(*listed.values())
            parts = [text for text, mine in listed.items() if mine < every]
            labels = {_LISTED.match(text)["label"] for text in listed}  # type: ignore[index]
            rows.update(parts if len(parts) == len(listed) == len(labels) > 1 else ())
        self.more = frozenset(text for text, of in more.items() if of in rows)
        return frozenset(rows | self.more)

    def sums(self, lines: Sequence[re.Match[str]]) -> Iterator[Edit]:
        """Lines above such rows that say what the whole is, where no other states it or has all their names."""
        others = [x.group() for x in lines if x.group() not in self.listed]
        used = {_spelling(m.group()) for text in others if "=" in text for m in _INDEXED.finditer(text)}
        stated = [m["letter"][0] for x in others if (m := _WHOLE.match(x)) is not None]
        whole = {"T" if x == "T" else "V" for x in stated}
        for kind, rows in self.summands.items():
            names = list(dict.fromkeys(name for _, _, name in rows))
            if kind not in whole and not used >= set(map(_spelling, names)):
                at, letter, _ = rows[0]
                yield at, at, f"{letter} = {' + '.join(names)}\n"

    # -- names -----------------------------------------------------------------------------------------------------

    def _name(self, kind: str, label: str) -> str:
        """The name of an energy of a part, new in the answer unless a line states the same once more."""
        if label.lower() in self.whole and key(kind) not in self.own and not self.known(kind):
            return kind
        found = self._bodies(label)
        words = [x for x in _WORD.findall(label) if len(x) > 2 and x.lower() not in _SMALL and not self.known(x)]
        more = [x for x in words if re.match(r"(?:trans|rot)", x, re.IGNORECASE)]
        index = unaccented(found[0]) if len(found) == 1 else "".join(map(unaccented, words[:1]))
        name = f"{kind}_{index}{''.join(map(unaccented, more[:1])) if index not in map(unaccented, more[:1]) else ''}"
        while key(name) in self.own and len(found) != 1:
            name += "x"
        self.own.add(key(name))
        return name.replace(f"{kind}_", f"{kind}_{{") + "}" if self.latex else name

    def _bodies(self, label: str) -> list[str]:
        """The bodies that a label names by a word of their names."""
        said = {x.lower() for x in _WORD.findall(label)}
        said |= {x[:-1] for x in said if x.endswith("s")}
        return [b.name for b in self.model.bodies if said & {x.lower() for x in _WORD.findall(b.name)}]

    def _kind_of(self, body: str) -> str:
        """The last word of a body's name: the upper and the lower link are links."""
        return (_WORD.findall(body) or [body])[-1].lower()


_GREEK = frozenset(x.lower() for x in SPELLED.values()) | frozenset(SPELLED.values())


def _spelling(name: str) -> str:
    """The common form of a name with an index, in LaTeX or not."""
    return key(name.replace("{", "").replace("}", "")).lower()


def _heading(text: str) -> str | None:
    """The energy that a heading announces; None if it is no such heading."""
    found = [k for k in _KINDS if _OF_KIND[k].search(text) or _ALONE[k].match(text)]
    return found[0] if len(found) == 1 else None


def _is_kinetic(value: str) -> bool:
    plain = unicodedata.normalize("NFD", value)
    return _RATE.search(plain) is not None and _SQUARE.search(plain) is not None


def inertia_letters(body: Body, *, lengths: bool = True) -> frozenset[str]:
    """The letters of the mass and the moments of inertia of a body; without ``lengths`` only m of m l²/12."""
    listed = [body.mass, *(body.inertia.flat() if isinstance(body, RigidBody) else ())]
    letters = ((x, sp.sympify(expr)) for expr in listed for x in sp.sympify(expr).free_symbols)
    return frozenset(key(str(x)) for x, expr in letters if lengths or not bounded.diff(expr, x).has(x))


def _is_dotted_twice(text: str) -> bool:
    """Whether an acceleration stands in a text; the dots of a letter within a word are no rates: für, Körper."""
    return _TWICE.search(unicodedata.normalize("NFD", _UMLAUT.sub("", text))) is not None
