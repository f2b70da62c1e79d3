"""Takes what only marks a statement off its line: bullets, arrows, numbers and labels in front, numbers behind."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.name_patterns import OF_CHAPTER
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.check.reading.prose.words_or_mathematics import CHANGING, LINKING
from lagrangian.check.reading.stated import ENERGY_NAMES
from lagrangian.quantities.units import lookup
from lagrangian.records import dataclass

_ARROW = re.compile(r"\s*(?:<?=+>|⇒|⟹|⇔|⟺|<?-+>|→|⟶|↔|➔|➜|➡|➤|↪|∴|[•◦▪●‣⁃✓✔]|>|[·o]\t)\s*")
_BRACE = re.compile(r"\s*(?:[⎧⎨⎩⎪]|\{(?![^{}]*\}))\s*")
_CALLED_ENERGY = re.compile(r"[ \t]*+(?P<word>[^\W\d_]{4,20})[ \t]+(?=[^\W\d]\*?[ \t]*=)")
"""An energy by its name and its letter: Lagrangian L = T - V."""
_BULLET = re.compile(r"\s*[*+][ \t]+(?=[\w(\[])")
_EQUATION = r"(?:[Ee]qn?|[Ee]quation|[Gg]l|[Gg]ln|[Gg]leichung|EOM|DGL|BWG|[Éé]q)"
_NUMBER = r"\d{1,3}(?:\.\d{1,3}){0,2}[a-z]?['′*]{0,2}"
_OF_CHAPTER = rf"{OF_CHAPTER}['′*]{{0,2}}"
"""A number with that of its chapter: II.1, A.2."""
_NUMBERED = re.compile(
    rf"\s*(?:[(\[]\s*{_OF_CHAPTER}\s*[)\]]|\(\s*(?P<inside>{_NUMBER}|[ivx]{{1,5}}|[IVX]{{1,4}}|[A-Z]-?\d|[a-h])\s*\)|\[\s*{_NUMBER}\s*\]|[①-⑳]"
    r"|[(\[][ ]?(?:\*{1,3}|[†‡])[ ]?[)\]]"
    rf"|{_EQUATION}\.?\s*[(\[]?{_NUMBER}[)\]]?[.:]?|{_NUMBER}\s?(?:[.)]{{1,2}}|:)|(?P<open>[a-h](?=\))|[ivx]{{1,5}}|[IVX]{{1,4}})[.)])"
    r"(?=\s+(?:=+>|[^\s*/^=]))"
)
_SHORT = rf"(?:{_NUMBER}|[a-h]|[ivx]{{1,4}}|[IVX]{{1,4}})"
_NEXT = r"(?=\s+(?:=+>|[^\s*/^=+]))"
_SPOKEN = re.compile(rf"\s*(?P<words>(?:[^\W\d_]{{2,12}}\.?\s+){{1,2}}){_SHORT}\s?\)[.:]?{_NEXT}")
"""A word or two before a letter with a bracket that nothing opens: ad a), zu 1)."""
_CALLED = re.compile(
    r"\s*(?:ad|zu|to|re|for|für|from|aus|in|teil|part|punkt|point|question|frage|task|aufgabe|item|nr|no|exercise|problem"
    rf"|übung)\.?\s*+(?:\d{{1,2}}[.,]?[ \t]++(?=[a-h][ \t]?\)))?+[(\[]?\s*+{_SHORT}\s*+(?:[)\]][.:]?|[.:]){_NEXT}",
    re.IGNORECASE,
)
_STEP_NUMBER = re.compile(
    rf"\s*(?P<words>[^\W\d_]{{3,14}}\.?\s+){_SHORT}(?:\s?[.:)]{{1,2}}|\s[–—]){_NEXT}"
    rf"|\s*(?:[Ss]tep|[Pp]art|[Ss]chritt|[Tt]eil|[ÉéEe]tape|[Pp]aso|[Pp]asso)\s+{_SHORT}\s+-{_NEXT}"
)
"""A word with a number: Step 2. T = …, Paso 5. …, Step 4 - …"""
_COMBINED = re.compile(
    r"\s*+[(\[]?\s?+(?:\d?[·*]?[IVX]{1,4}|\d{1,2})(?:\s?+[-+−–]\s?+(?:\d?[·*]?[IVX]{1,4}|\d{1,2})){1,6}+\s?+[)\].:]{1,2}"
    r"(?=\s+(?:=+>|[^\s*/^=+]))"
)
"""Which equations were added: II-III) …"""
_STOPPED = re.compile(r"^[ \t]*+(\d{1,2})\.[ \t]", re.MULTILINE)
_STEPS = re.compile(rf"\s*+(?P<step>\d{{1,2}})[.)]\s?(?:[/&+,–-]|and|und)\s?\d{{1,2}}[.):]{{1,2}}{_NEXT}")
"""The numbers of two steps: 5./6. …"""
_OPEN = re.compile(r"\s*[^\W\d_]\w{0,11}['’′]{0,2}\s?\)[.:]?(?=\s+(?:=+>|[^\s*/^=+]))")
"""A name with a bracket that nothing opens: x), θ)."""
_LEFT = re.compile(r"\s*+:(?=\s)")
"""The colon of a label whose words are blank already: Eq. 1 (cart): …"""
_DASH = re.compile(r"^[ \t]*+(?P<dash>[-–—])[ \t]++(?P<rest>[^\n]++)", re.MULTILINE)
"""A dash at the beginning of a line: that of a list if a label is behind it."""
_ROUNDS = 4
"""How many marks of one kind may follow each other: (i) ⇒ from (2):"""
_ENERGIES = frozenset(["T", "V", "U", "L", "D", "W"])
_COORDINATE = re.compile(
    r"\s*(?:\(\s?(?P<round>[^\W\d]\w{0,12})(?P<primes>['’′]{0,2})\s?\)|\[\s?(?P<square>[^\W\d]\w{0,12})\s?\])"
    r"[.:]?(?P<gap>\s+)(?=[^\s*/^=+])"
)
_BROKEN = re.compile(r"(?<=[-+−–*·(=])[ \t]*+\n|\n[ \t]*+(?=[-+−–=])")
"""The end of a line where an equation goes on below it."""
_CLOSE = re.compile(r"\s*\(\s*\d{1,2}[a-z]?\s*\)")
_LABEL = re.compile(r"\s*+(?=[^=:]*[^\W\d_])[∑Σ↑→↓←↻↺⟲⟳⤵]*+\s*+[\w(][\w\s().,#'’\u0307\u0308–-]{0,60}:(?!=)")
_NAMED = r"[^\W\d_](?:\w|[\u0307\u0308]){0,15}(?:[*]|['’′″]{1,3})?"
_QUANTITY = rf"(?:[∂d][²2]?\s?/\s?(?:[∂d]\w{{1,12}}[²2]?|\([∂d]\w{{1,12}}\))|{_NAMED})"
_SLOPE = rf"(?:d\s?/\s?dt\s?)?\(?[∂d]\s?[TVULD]\s?/\s?[∂d]\s?{_NAMED}\)?"
_SIDE = rf"(?:{_SLOPE}|d\s?/\s?dt\s?\(?{_NAMED}\)?)"
_OF_QUANTITY = re.compile(rf"\s*+[(\[]?(?:{_QUANTITY}|{_SIDE}(?:[ \t]?[-+−–][ \t]?{_SIDE}){{0,3}})[)\]]?\s*+:(?!=)")
"""A quantity alone, or a side of the law: T*: …, θ'': …, ∂/∂x: …, d/dt ∂T/∂φ': …, d/dt p - ∂T/∂θ + ∂V/∂θ: …"""
_OF_VALUE = re.compile(
    r"\s*+(?:\w{1,3}[).]\s++)?[(\[]?(?:[^\W\d_]{2,12}[ \t]++){0,2}"
    r"(?P<name>(?:[qξηijkn]|[xX]i)(?:_?[ijkn\d])?)[ \t]*+=[ \t]*+"
    r"(?P<of>[^\W\d]\w{0,12}+|\d)[ \t]*+[)\]]?(?:[ \t]*+\([^()=]{1,20}\))?[ \t]*+(?::(?!=)|=+>|⇒|⟹|→|-+>|$)"
)
"""Which coordinate a general letter is: q = x: m x'' = F."""
_HEAD = re.compile(r"\s*+(?P<said>[^\W\d_](?:[^=:()]|\([^=:()]*+(?:\([^=:()]*+\)[^=:()]*+)*+\)){2,100}?):(?![=\w])")
_IN_BRACKETS = re.compile(r"\([^()]*+(?:\([^()]*+\)[^()]*+)*+\)")
_SPOKEN_SIGNS = re.compile(r"[\w\s.,#'’\u0307\u0308&+/*–-]*")
DIRECTIONS = "eqn?|equation|gl|gln|gleichung|dir|direction|axis|richtung|achse|coordinate|komponente|component"
_OF_NAME = re.compile(rf"\s*+[^\W\d_]\w{{0,12}}-(?:{DIRECTIONS})\b\.?[ \t]++(?=[^\s=+*/^-])", re.IGNORECASE)
_FAR = re.compile(r"\s*+(?P<said>[^\W\d_][\w.#’-]{1,24}(?:[ ][\w.#’-]{1,24}){0,3}+)(?:[ \t]{2,}|\t)(?=[^\s=+*/^])")
"""Words or a word with a number, far from the equation behind them: load1  m1*x1'' = …"""
_ONE_OF_SUM = rf"(?:\w{{1,9}}\.?\s?[·*]?\s?)?\(\s*(?:{_NUMBER}|[IVX]{{1,4}}|[ivx]{{1,5}}|[A-Za-z]\d?['′*]?)\s*\)"
_SUM_OF_NUMBERS = re.compile(
    rf"\s*+(?:[-+−]\s?)?{_ONE_OF_SUM}(?:\s?[-+−]\s?{_ONE_OF_SUM}){{0,8}}\s?:(?!=)(?:(?<=\d\):)|(?=\s))"
)
"""Which equations were added: (1) - r·(2): …, (I)+(II): …; the first number may be blank already."""
_ENERGY = re.compile(r"\s*+(?:[-*•+]\s+)?(?P<name>T\*?|[VUD]|E_?(?:kin|pot))\s?(?P<colon>:)(?!=)(?=[^=\n]+\Z)")
"""An energy without an equals sign: T: 1/2 m v^2."""
_WORDS = r"(?:where|with|and|so|thus|then|hence|therefore|let|also|gives|we get|so that)"
_TRAIL = re.compile(rf"(?<=[\w\u0307\u0308)\]'’′²³])(?:\s*+,)?\s++{_WORDS}\s*+[,:]?\s*+\Z", re.IGNORECASE)
_LEADERS = r"\s*+(?:\.\.|…|·{3}|-{4}|_{3})[\s.…·_-]{0,300}+"
_MARK = rf"{_OF_CHAPTER}|\d{{1,3}}[a-z]?['′*]{{0,2}}|[ivx]{{1,4}}|[IVX]{{2,4}}|[A-Z]\.?-?\d{{1,2}}|\*{{1,3}}"
_BEHIND = rf"[(\[]\s*(?:{_EQUATION}\.?\s*)?(?:{_MARK})\s*[)\]]"
_DECIMAL = rf"[(\[]\s*(?:{_EQUATION}\.?\s*)?{_NUMBER}\s*[)\]]"
_END = r"\s*+[.,;]?\s*+\Z"
_BEFORE_END = r"(?<=[\w\u0307\u0308)\]'’′″²³])(?:\s*+[.,;])?"
_NAMED = rf"[(\[]\s*{_EQUATION}\.?\s*{_NUMBER}\s*[)\]]"
_TAG = rf"(?:{_NUMBER}|[A-Za-z](?:[.-]?\d{{1,2}})?|[ivxIVX]{{1,5}}|\d{{1,2}}[.-][A-Za-z]|\*{{1,3}})"
_LED_TO = rf"(?:{_EQUATION}\.?\s*)?[(\[]\s*(?:{_EQUATION}\.?\s*)?{_TAG}\s*[)\]]"
"""What dots or strokes lead to, which is no factor: ...(i), ..... eq. (2), ---- [A]"""
_AFTER = re.compile(rf"{_BEFORE_END}(?:\s+{_BEHIND}|{_LEADERS}{_LED_TO}|(?:\s{{2,}}|\t){_DECIMAL}|\s*{_NAMED}){_END}")
_AFTER_CLOSE = re.compile(rf"{_BEFORE_END}(?:{_LEADERS}{_LED_TO}|\s*(?:{_BEHIND}|{_DECIMAL})){_END}")
_TAIL = re.compile(r"(?<!\.)[.,;:]\s*\Z")
_DONE = re.compile(
    r"(?<=[\w\u0307\u0308)\]'’′″²³])\s*(?:[!✓✔☑∎□■▢]+|q\.?\s?e\.?\s?d\.?|w\.?\s?z\.?\s?b\.?\s?w\.?"
    r"|[.,;][ \t]*(?:OK|ok|Ok|okay|[Cc]orrect|[Ff]ine|[Gg]ood|[Pp]asst|[Ss]timmt)[ \t]*[!.]*)\s*\Z"
)
_STEP = re.compile(r"\s\|\s*(?:[:·*/+÷−-]|d/dt|²|\(\s*\))[^=]*\Z|\s(?:<-+|←)\s[^=]*\Z")
"""What is done to an equation next, | : m, and what points at it, <- here; a side behind = is not part of it."""
_DOTS = re.compile(r"(?<=[\w\u0307\u0308)\]'’′²³])\s+(?:\.\.\.|…)\s+(?=[^\W\d_]{2})[^=+*/^()\[\]\d]{0,80}\Z")
"""Words behind dots: J_A = J + m*l^2 ... used below."""
_UNIT = re.compile(
    r"(?<=[\w\u0307\u0308)\]'’′″²³,.;])(?P<gap>[ \t]+)\[(?:in[ \t])?(?P<unit>[A-Za-zµΩ·*/^²³⁴⁻¹()\d \t-]{1,16})\]"
    r"(?=[ \t]*(?:[.,;:]|$)|[ \t]+[^\W\d_]{2,}[ \t])",
    re.MULTILINE,
)
"""The unit of what stands in front of it, at the end of a statement."""
_LETTER_BEHIND = re.compile(rf"\s[(\[]\s*(\w{{1,4}})\s*[)\]]{_END}")
_ROMAN = ["I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII"]
_ORDERS = (_ROMAN, [x.lower() for x in _ROMAN], list("abcdefghijklmnop"), list("ABCDEFGHIJKLMNOP"))
"""How equations are numbered in letters."""
_FACTOR_BEHIND = re.compile(rf"(?<=[\w\u0307\u0308)'’′])[ ]?\(\s?\d{{1,3}}[ ]?(?P<name>[a-z])['’′]{{0,2}}\s?\){_END}")
"""A number and a name in brackets right behind a factor: (2y')."""
_FAR_BEHIND = re.compile(
    rf"(?<![ \t])(?:[ ]{{2}}|[ ]?\t)[ \t]*+[(\[]\s*+(?P<tag>[IVX]{{1,4}}|[ivx]{{1,4}}|[A-Za-z]\d?)\s*+[)\]]{_END}"
)
"""A letter or a Roman number in brackets, far from the equation in front of it."""
_NUMBER_BEHIND = re.compile(rf"[(\[]\s*(?:\d{{1,3}}\.)?(\d{{1,3}})\s*[)\]]{_END}")


_COUNTED = re.compile(r"[ \t]{0,3}+(\d{1,2}|[IVX]{1,4})[ \t]{2,}+(?=[^\s=+*/^-])")
FEWEST_STEPS = 2
"""No more numbers than these far in front of lines count no steps."""


@dataclass(frozen=True)
class Numbering:
    """Whether the equations of an answer are numbered in order in front, or behind, so that no number is a factor."""

    before: bool
    behind: bool
    lettered: bool = False
    """Whether they are numbered behind in letters, in order: (I), (II), … or (a), (b), …"""
    named: frozenset[str] = frozenset()
    """The names in brackets that only say which equation follows: the coordinates, each once, (r) …, (θ) …, or letters
    that are found nowhere else, (A) …, (B) …"""
    tags: frozenset[str] = frozenset()
    """The letters in brackets far behind equations that are found outside brackets nowhere."""
    chosen: frozenset[str] = frozenset()
    """The letters that stand for one coordinate after the other: q = x: …, q = θ: …"""
    counted: bool = False
    """Whether numbers in front of lines, far from these, count the steps: 2  T = …"""
    steps: frozenset[int] = frozenset()
    """The numbers with a full stop in front of lines: 4. L = …"""


def numbering(text: str, words: Words) -> Numbering:
    """Recognize how the equations of an answer are numbered: (1), (2), … one after the other."""
    lines = [line for line in text.split("\n") if "=" in line]
    first = [int(m[1]) for line in lines if (m := re.match(r"\s*\(\s*(\d{1,2})\s*\)", line))]
    last = [int(m[1]) for line in lines if (m := _NUMBER_BEHIND.search(line[-30:]))]
    before, behind = (len(x) > 1 and x == list(range(x[0], x[0] + len(x))) for x in (first, last))
    whole = _BROKEN.sub(" ", text).split("\n")
    first_names = [m for line in whole if "=" in line and (m := _COORDINATE.match(line)) and not m["primes"]]
    written = [m["round"] or m["square"] for m in first_names]
    apart = all(m["square"] or len(m["gap"]) > 1 for m in first_names) and len(set(written)) == len(written)
    far = apart and all(words.names.changes(x) or not words.is_name(x) or words.is_own(x) for x in written)
    called = [words.names.scope.meanings(x)[0] for x in written]
    coordinates = [c.name for c in words.names.model.coordinates]
    named = sorted(x[0] for x in called if x) == sorted(coordinates)
    lettered = all(len(x) == 1 and words.count(x) == 1 and not words.known(x) for x in written)
    marks = [m[1] for line in lines if (m := _LETTER_BEHIND.search(line[-30:]))]
    in_order = _in_order(marks)
    bracketed = [m for line in text.split("\n") if (m := _COORDINATE.match(line)) and m["round"] and not m["primes"]]
    marked = list(dict.fromkeys(m["round"] for m in bracketed))  # (D) differentiated: … is (D) once more
    told = len(written) > 1 and (named or lettered or far)
    told = told or (bool(written) and len(marked) > 1 and _in_order(marked))
    beside = len(written) == 1 and lettered and bool(first)  # (S) for the sum, beside (2), (3), …
    behind_far = {m["tag"] for line in lines if (m := _FAR_BEHIND.search(line)) is not None}
    tags = frozenset(x for x in behind_far if _is_tag(x, text, words))
    steps = [_count(m[1]) for line in text.split("\n") if (m := _COUNTED.match(line))]
    counted = len(steps) > FEWEST_STEPS and steps == list(range(steps[0], steps[0] + len(steps)))
    names = frozenset(written if told or beside else ())
    stops = frozenset(int(m[1]) for m in _STOPPED.finditer(text))
    return Numbering(before, behind, in_order, names, tags, _chosen(text, words), counted, stops)


def _count(mark: str) -> int:
    """The number that digits or a Roman number mean; 0 for none."""
    return int(mark) if mark.isdigit() else _ROMAN.index(mark) + 1 if mark in _ROMAN else 0


def _chosen(text: str, words: Words) -> frozenset[str]:
    """The letters of which lines say that they stand for one coordinate after the other."""
    found: dict[str, set[str]] = {}
    for match in filter(None, map(_OF_VALUE.match, text.split("\n"))):
        called = words.names.scope.meanings(match["of"])[0]
        if match["of"].isdigit() or (called and words.names.changes(match["of"])):
            found.setdefault(match["name"], set()).add(match["of"])
    return frozenset(name for name, values in found.items() if len(values) > 1)


def _in_order(marks: Sequence[str]) -> bool:
    """Whether several letters or Roman numbers count: (a), (b), … or (d), (e), (f); so may others behind them, (I)."""
    left = list(marks)
    while left:
        longest = max((_counted(left, order) for order in _ORDERS), default=0)
        if longest < (2 if any(left[0] == order[0] for order in _ORDERS) else 3):
            return False
        left = left[longest:]
    return bool(marks)


def _counted(marks: Sequence[str], order: Sequence[str]) -> int:
    """How many marks follow each other as in an order."""
    first = order.index(marks[0]) if marks[0] in order else len(order)
    pairs = zip(marks, order[first:], strict=False)
    return next((k for k, (mark, due) in enumerate(pairs) if mark != due), min(len(marks), len(order) - first))


def _is_tag(letter: str, text: str, words: Words) -> bool:
    """Whether a letter is no name of the system or of the answer, and stands in brackets wherever it stands; I may be
    the word."""
    if words.known(letter) or function_of(letter) is not None:
        return False
    spoken = r"(?![ \t]+[a-z]{3})" if letter == "I" else ""
    return re.search(rf"(?<![(\[\w]){letter}(?!\w){spoken}|(?<=[(\[]){letter}(?![\w)\]])", text) is None


def before(line: str, words: Words, numbers: Numbering) -> str:
    """Blank out an arrow, a bullet, a number or a label before a statement."""
    if (energy := _ENERGY.match(line)) is not None and _is_energy(energy, line, words):
        at = energy.start("colon")
        return f"{blank(line, 0, energy.start('name'))[:at]}={line[at + 1 :]}"
    if numbers.counted and (step := _COUNTED.match(line)) is not None:
        line = blank(line, 0, step.end())
    for _ in range(_ROUNDS):
        above = line
        if (of := _OF_VALUE.match(line)) is not None and of["name"] in numbers.chosen:
            line = blank(line, 0, of.end())
        for form in (
            _BRACE,
            _ARROW,
            _BULLET,
            _SUM_OF_NUMBERS,
            _NUMBERED,
            _COMBINED,
            _SPOKEN,
            _CALLED,
            _STEP_NUMBER,
            _STEPS,
            _OPEN,
            _LABEL,
        ):
            match = form.match(line)
            if match is not None and form is _STEPS and int(match["step"]) - 1 not in numbers.steps:
                match = None  # 1./2. m x'^2
            if match is None and form is _NUMBERED and numbers.before:
                match = _CLOSE.match(line)
            called = _COORDINATE.match(line) if form is _NUMBERED else None
            labelled = called is not None and (called["round"] or called["square"]) in numbers.named
            if called is not None and called["primes"] and words.is_name(called["round"]):
                labelled = False
            match = called if labelled else match
            if form is _LABEL and (match is None or match.group().count("(") != match.group().count(")")):
                match = _label(line, words)
            if match is not None and (labelled or not _is_factor(match, words)):
                line = blank(line, 0, match.end())
        if line == above:
            break
    if (called := _CALLED_ENERGY.match(line)) is not None and called["word"] in ENERGY_NAMES:
        line = blank(line, 0, called.end())
    left = _LEFT.match(line)
    return line if left is None else blank(line, 0, left.end())


def without_dashes(text: str, words: Words) -> str:
    """Blank out dashes in front of labels: - moment of inertia: J_0 = m L^2/3."""

    def bare(match: re.Match[str]) -> str:
        rest = match["rest"]
        labelled = ":" in rest and (_LABEL.match(rest) or _label(rest, words)) is not None
        return match.group().replace(match["dash"], " ", 1) if labelled else match.group()

    return _DASH.sub(bare, text)


def _is_energy(match: re.Match[str], line: str, words: Words) -> bool:
    """Whether an energy is stated behind its letter and a colon, and no words."""
    listed = re.findall(r"[^\W\d_]{3,}", line[match.end() :])
    spoken = any(not words.readable(x) and not words.is_product(x) for x in listed)
    return not spoken and not words.is_name(match["name"].rstrip("*"))


def _label(line: str, words: Words) -> re.Match[str] | None:
    """What only says of which quantity or part an equation is: T*: …, weight + springs: …, theta-eq  …, load1  …"""
    if (match := _OF_QUANTITY.match(line) or _OF_NAME.match(line)) is not None:
        return match
    head, far = _HEAD.match(line), _FAR.match(line)
    if (
        head is not None
        and _SPOKEN_SIGNS.fullmatch(bare := _IN_BRACKETS.sub(" ", head["said"]))
        and _told(bare, words, sure=True)
    ):
        return head
    return far if far is not None and "=" in line and _told(far["said"], words, sure=False) else None


def _told(said: str, words: Words, *, sure: bool) -> bool:
    """Whether a text consists of words and of energies' letters, and of no names; unless it is ``sure`` that it is a
    label, of no products of names either."""
    listed = re.findall(r"[^\W\d_]+\d?", said)
    if any(x.lower() in CHANGING for x in listed):
        return False
    spoken = [
        len(x.rstrip("0123456789")) > 2 and not words.readable(x) and (sure or not words.is_product(x)) for x in listed
    ]
    letters = [sure and len(x) == 1 and x.isupper() for x in listed]  # disc + A:
    fitting = (
        a or b or x in _ENERGIES or x.lower() in LINKING for a, b, x in zip(spoken, letters, listed, strict=True)
    )
    return any(spoken) and all(fitting) and not any(map(words.is_name, listed))


def is_label(head: str, words: Words, numbers: Numbering) -> bool:
    """Whether a text that ends with a colon only marks the statement behind it."""
    return not before(f"{head} x = 0", words, numbers)[: len(head)].strip()


def is_mark(text: str) -> bool:
    """Whether a text is only a number or a letter with a bracket, perhaps after a word: (ii), ad a)."""
    mark = text.rstrip()
    found = (form.match(f"{mark} x") for form in (_NUMBERED, _SPOKEN, _CALLED, _OPEN))
    return any(match is not None and match.end() == len(mark) for match in found)


def without_units(text: str, words: Words) -> str:
    """Blank out the units behind statements: T = … [N m], where u = … [m] is …"""
    return _UNIT.sub(lambda m: " " * len(m.group()) if _is_unit(m["unit"], words, m["gap"]) else m.group(), text)


def _is_unit(written: str, words: Words, gap: str) -> bool:
    """Whether all words in brackets are units, and one no letter that is a name; far from a statement, all may be."""
    found = re.findall("[A-Za-zµΩ]+", written)
    if not found or any(lookup(x) is None and x not in ("Nm", "kgm", "Nms") for x in found):
        return False
    return len(gap) > 1 or not all(len(x) == 1 and words.is_name(x) for x in found)


def _is_factor(match: re.Match[str], words: Words) -> bool:
    """Whether the letter of a number in front, (i) or (a), is a name of the system, or a word in front a factor."""
    named = match.groupdict()
    if (spoken := named.get("words")) is not None:
        return any(words.known(x) or function_of(x) is not None for x in re.findall(r"[^\W\d_]+", spoken))
    bracket = match.group().rstrip().endswith(")")
    letter = named.get("inside") or (None if bracket else named.get("open"))
    return letter is not None and not letter[0].isdigit() and words.is_name(letter)


def behind(line: str, numbers: Numbering, words: Words) -> str:
    """Blank out the number of an equation after it, a full stop and a linking word; d (2y') ends with a factor."""
    if (factor := _FACTOR_BEHIND.search(line)) is not None and words.is_name(factor["name"]):
        return line
    if line.count("|") == 1 or "<-" in line or "←" in line:
        line = _STEP.sub(lambda m: " " * len(m.group()), line)
    if numbers.lettered and (match := _LETTER_BEHIND.search(line)) is not None and _AFTER.search(line) is None:
        line = blank(line, match.start(), len(line))  # what leads to the letter goes with it below: ..... eq. (i)
    if (far := _FAR_BEHIND.search(line)) is not None and far["tag"] in numbers.tags and "=" in line[: far.start()]:
        line = blank(line, far.start(), len(line))
    for form in (_DOTS, _TAIL, _TRAIL, _AFTER_CLOSE if numbers.behind else _AFTER, _DONE, _TAIL):
        if match := form.search(line):
            line = blank(line, match.start(), len(line))
    return line
