"""Finds what an answer says, in words, about its own letters for the names of the system.

x₁ statt x (Klotz), c statt k                        x₁ is x, c is k
I write m for the puck's mass (m1), M for m2         m is m1, M is m2
- K ... stiffness of the flexure (kappa)             K is kappa
theta = angle of the pulley (x = R*theta)            ; x = R*theta ;   a statement that remains

A list is read item by item. Both sides must be names, the second one of the system. The letter taken may be one that
the system uses for something else: m for m1 and M for m2.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.markup import blanked
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.prose.words_or_mathematics import CHANGING
from lagrangian.check.reading.said.equated_letters import equated_letters, is_second
from lagrangian.check.reading.said.tabled_letters import tabled_letters
from lagrangian.check.reading.stated import energy_of, force_of
from lagrangian.model import Model
from lagrangian.read.letters import SPELLED, find, key, normal, undotted
from lagrangian.records import dataclass

MOST = 40
"""The largest number of letters that are declared in words."""
_PRODUCT = 4
"""The most letters of a product without signs in which a name is sought."""

LONGEST = 200
"""The most characters of one item of a list."""

_NAME = r"[$`*]{0,2}\\?[^\W\d_][^\W_]{0,11}(?:_\w{1,8}|_\{\w{1,8}\})?[$`*]{0,2}"
_NEW = rf"(?<![\w\\$`*^/+'’′-])(?P<new>{_NAME})"
_OWN = rf"(?P<own>{_NAME})(?![\w'’′^(*/+$\\{{])"
_WORD = r"(?:[^\W_][^\W_]{0,23}(?:[-'’.][^\W_]{0,23})?[ \t\n]{1,9})"
_GAP = r"[ \t\n]{1,9}"
_END = r"[ \t\n.!]*\Z"
_INSTEAD = (
    r"(?:instead[ \t\n]of|in[ \t\n](?:place|lieu)[ \t\n]of|rather[ \t\n]than|statt|anstatt|anstelle(?:[ \t\n]von)?"
    r"|an[ \t\n]Stelle[ \t\n]von)"
)
_STANDS = (
    r"(?P<stands>stands[ \t\n]for|replaces|corresponds[ \t\n]to|takes[ \t\n]the[ \t\n]place[ \t\n]of|steht[ \t\n]für"
    r"|ersetzt|entspricht)"
)
_IS = r"(?P<stands>denotes|means|is|bezeichnet|bedeutet|ist)"
_LINK = r"[ \t\n]{0,9}(?:=|:|[–—-]|\bis\b|\bist\b|\bfor\b|\bfür\b|\bdenotes\b|\bbezeichnet\b)[ \t\n]{1,9}"
_GIVEN = re.compile(r"(?<![\w*/+^-])\\?(?P<left>[^\W\d]\w{0,15})[ \t]*=(?=(?P<right>[^=\n;,]{1,80}))")
_ANY_NAME = re.compile(r"\\?[^\W\d]\w{0,15}")
_REST = r"(?P<rest>[^\0]{1,160})\Z"


def _forms(*forms: str) -> tuple[re.Pattern[str], ...]:
    return tuple(re.compile(form, re.IGNORECASE) for form in forms)


_SURE = _forms(
    rf"{_NEW}{_GAP}{_INSTEAD}{_GAP}{_REST}",
    rf"{_NEW}{_GAP}{_STANDS}{_GAP}{_REST}",
    rf"{_NEW}[ \t\n]{{0,9}}\([ \t]?(?:{_INSTEAD}{_GAP}|[=≙][ \t]?)(?P<rest>[^()=]{{1,80}})\){_END}",
    rf"(?<!\w)(?:{_INSTEAD}|for|für){_GAP}(?P<rest>[^()=+^/]{{1,60}}){_GAP}(?:(?:I|we){_GAP}(?:write|use|take|have|put)"
    rf"|(?:schreibe|nehme|verwende|benutze|setze){_GAP}ich){_GAP}(?P<new>{_NAME}){_END}",
    rf"(?<!\w)(?:renam(?:e|ed|ing)|replac(?:e|ed|ing)|ersetzt?e?){_GAP}{_OWN}{_GAP}(?:to|by|with|as|into|durch|zu|in)"
    rf"{_GAP}(?P<new>{_NAME}){_END}",
    rf"(?<!\w){_OWN}{_GAP}(?:is{_GAP}(?:called|renamed|written(?:{_GAP}as)?)|heißt)(?:{_GAP}(?:hier|bei{_GAP}mir|here))?"
    rf"{_GAP}(?P<new>{_NAME})(?:{_GAP}here)?{_END}",
)
_PIECES = "nstead place eu rather stat stelle stand steht repla correspond ersetz entspr fo fü ( nam all tten sst"
"""Forms that say nothing else, and pieces of them of which one stands in what they say, in small letters."""
_LIKELY = _forms(
    rf"{_NEW}{_LINK}{_WORD}{{1,8}}\([ \t]?(?:[=≙][ \t]?)?(?P<rest>[^()=]{{1,60}})\){_END}",
    rf"{_NEW}{_GAP}{_IS}{_GAP}{_REST}",
)
"""Forms that may also say to what a quantity belongs, s = stretch of the spring (k): the other letter is then used."""
_LED = _forms(
    rf"{_NEW}{_GAP}(?:for|für){_GAP}{_REST}",
    rf"{_NEW}[ \t]{{0,9}}(?:=|≙|:|->|→)[ \t]{{0,9}}{_REST}",
)
"""Forms that need a word such as uses or Letters in front of the list."""
_BEFORE = re.compile(rf"{_WORD}{{0,8}}")
_TAIL = re.compile(
    rf"(?:[ \t\n]{{1,9}}\([^()=]{{0,80}}\)|,[^()=+*^/]{{0,60}}|(?:[ \t\n]{{1,9}}{_WORD}{{0,8}}[^\W_]{{1,24}})?){_END}"
)
_NEXT = re.compile(
    r"[ \t]{0,3}(?:(?P<name>[^\W\d_](?:_?\d)?)(?!\w)|\([ \t]?(?P<first>[^\W\d_]\w{0,15})[ \t]{0,3}[-−+*/^·])"
)
"""A letter or a bracket behind a name, which may be a factor."""
_LEADS = re.compile(
    r"(?<!\w)(?:us(?:e|es|ed|ing)|writ(?:e|es|ing|ten)|wrote|call(?:s|ed)?|letters?|notation|names?|symbols?|renam\w{0,4}"
    r"|schreib\w{0,3}|verwend\w{0,3}|benutz\w{0,3}|nehme|nenn\w{0,3}|bezeichn\w{0,8}|buchstaben|formelzeichen)(?!\w)",
    re.IGNORECASE,
)
_RELATION = re.compile(
    rf"{_NEW}{_LINK}{_WORD}{{1,8}}\((?:[^()=,;]{{0,60}}[,;])?[ \t]?(?P<relation>{_NAME}[ \t]?=[ \t]?[^()=,;\n]{{1,60}})"
    r"\)[ \t\n.!]*\Z"
)
"""A new coordinate, what it is, and its relation to that of the system."""
_GROUP = re.compile(
    rf"{_NEW}(?P<more>(?:[ \t]{{0,9}}(?:,|and|und)[ \t]{{1,9}}{_NAME}){{1,7}})[ \t\n]{{1,9}}"
    rf"(?:{_INSTEAD}|for|für|stand[ \t\n]for|stehen[ \t\n]für|denote|are|sind)[ \t\n]{{1,9}}"
    r"(?:(?:the|die)[ \t\n](?:[^\W\d_]{3,20}[ \t\n]){1,3})?"
    rf"(?P<own>{_NAME}(?:[ \t]{{0,9}}(?:,|and|und)[ \t]{{1,9}}{_NAME}){{1,7}})(?![\w'’′^(*/+$\\{{=])"
)
_LISTED = re.compile(rf"\([ ]?(?P<own>{_NAME}(?:[ ]?(?:,|and|und)[ ]{_NAME}){{1,7}})(?:[ ][^()=+*/^]{{0,40}})?\)")
"""The names of the system in brackets behind a list that says for what the letters are."""
_FOR_WHAT = re.compile(rf"{_NEW}[ \t\n]{{1,9}}(?:for|für)[ \t\n]{{1,9}}(?:the|an?|die|den|das|der)[ \t\n]")
_SENTENCE = re.compile(r"[.;:!?](?=\s)|\n[ \t]*\n")
_DOTTED = re.compile(rf"^(?P<new>[ \t]*+(?:[-*•–][ \t]++)?{_NAME}[ \t]*+)(?P<dots>\.{{2,9}}|…)(?=[ \t])", re.MULTILINE)
"""A letter of a legend with the dots behind it, which stand for a colon."""
_TIME = re.compile(r"(?<![\w\\])t[ ]?=[ ]?(?P<own>[^\W\d_]\w{0,15}+)(?![\w'’′(*/+^-])(?:,[ ]?)?")
"""The letter of time for a coordinate, t = theta, where nothing is differentiated by it."""
_BY_TIME = re.compile(r"d[ ]?t(?!\w)|\([ ]?t[ ]?\)|(?<!\w)t[ ]?(?:>|>=|→)[ ]?0")
_ANY = re.compile(rf"(?<![\w\\]){_NAME}(?!\w)")
_RATE = re.compile(r"([^\W\d_]\w{0,15}+)['’′](?!\w)")
_SIGNS = frozenset("-+−*/^=(·½¼²³'’′")
_JOIN = re.compile(r"[(){}\[\]]|(?:(?<!\\)[,;]|\.(?=\s)|(?<!\w)(?:and|und|sowie)(?!\w)|\n)[ \t]*")
_STATED = re.compile(r"(?<![\w\\])\\?([^\W\d]\w{0,15}+)\*?[ \t]*+=(?!=)")
_LAST = re.compile(r"(?<![^\W_])[^\W\d_]\w{0,15}\Z")
_OPERATORS = tuple("-+−*/^)·²³'’′")
_PARAGRAPH = re.compile(r"\n[ \t]*\n")
_MATHEMATICS = re.compile(r"[=+^]|\w[ ]?[*/][ ]?\w|[’'′](?!\w)|\w\(")
_VARIANTS = {"varphi": "phi", "vartheta": "theta", "varepsilon": "epsilon", "varrho": "rho", "ell": "l"}
_MARKS = str.maketrans("", "", "$\\{}`*")
_IN_WORDS = "is it in on of to as at by or an no so we my if be he do ist im am es zu"
_OF = "of on in at to from between by von an auf in zwischen am im"
_NO_LETTERS, _PREPOSITIONS, _CUES = (frozenset(x.split()) for x in (_IN_WORDS, _OF, _PIECES))


@dataclass(frozen=True)
class DeclaredLetter:
    """A letter of the answer's own and the name of the system that it stands for; where an answer says so; whether the
    words can mean nothing else."""

    new: str
    own: str
    span: tuple[int, int]
    sure: bool


@dataclass(frozen=True)
class DeclaredLetters:
    """What an answer declares; its text without that, of the same length; and what to tell."""

    names: dict[str, str]
    text: str
    notes: tuple[str, ...] = ()


class _System:
    """The names of a system in any spelling."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self._found: dict[str, list[str]] = {}

    def find(self, name: str) -> list[str]:
        """The names that one can mean."""
        if name not in self._found:
            self._found[name] = find(name, self.model.symbols)
        return self._found[name]

    def is_constant(self, name: str) -> bool:
        """Whether this is one parameter."""
        return len(found := self.find(name)) == 1 and found[0] in {p.name for p in self.model.parameters}

    def is_coordinate(self, name: str) -> bool:
        """Whether this is one coordinate."""
        return len(found := self.find(name)) == 1 and found[0] in {c.name for c in self.model.coordinates}

    def states(self, name: str) -> bool:
        """Whether this is the name of an energy or of a generalized force."""
        return energy_of(name, self.model, lhs=True) is not None or force_of(name, self.model) is not None


def declarations(text: str, model: Model) -> DeclaredLetters:
    """Return the letters that an answer declares in words, by the name of the system: {"k": "c"}.

    A letter that the system has, too, and words that may mean something else count only if the answer does without the
    name of the system.
    """
    system = _System(model)
    legend = _DOTTED.sub(lambda m: f"{m['new']}:".ljust(len(m.group())), text)
    items = list(_items(legend))
    found = list(islice(_declared(legend, system, items), MOST))
    relations = list(islice(_relations(text, system, items if legend == text else [*_items(text)]), MOST))
    if not found and not relations:
        return DeclaredLetters({}, text)
    bare = _blanked(text, [x.span for x in found])
    news, owns = ({key(x.new) for x in found}, {key(x.own) for x in found})
    used = _in_formulas(bare, {*model.symbols, *(x.new for x in found)})
    stated = {
        key(m[1]) for m in _STATED.finditer(bare) if not _is_factor(bare[max(0, m.start() - 40) : m.start()], system)
    }
    kept: dict[str, DeclaredLetter] = {}
    notes: list[str] = []
    for x in found:
        if x.own in kept or key(x.new) in {key(y.new) for y in kept.values()}:
            continue
        if (not x.sure and key(x.new) in stated) or _is_related(bare, x):
            continue  # what it is stands elsewhere
        other = bool(system.find(x.new)) and key(x.new) not in owns
        if key(x.own) in used - news and (other or not x.sure):
            if x.sure:
                told = f"{x.new} was read as the {x.new} of the system, as you use {x.own}, too"
                notes.append(f"You write that {x.new} stands for {x.own}: {told}.")
            continue
        kept[x.own] = x
    if kept:
        told = ", ".join(f"{x.new} {'stands ' if k == 0 else ''}for {x.own}" for k, x in enumerate(kept.values()))
        notes.append(f"As you write, {told}.")
    text = _blanked(text, [x.span for x in kept.values()])
    for start, first, end in relations:
        stands = text[first:end].rstrip(" .!\n)")
        text = f"{blanked(text[: first - 1], start, first - 1)};{stands};".ljust(end) + text[end:]
    return DeclaredLetters({own: x.new for own, x in kept.items()}, text, tuple(notes))


def _is_related(text: str, letter: DeclaredLetter) -> bool:
    """Whether an answer says how a letter and what it would stand for give each other: x = r φ, h = z - l sin θ."""
    same = {key(letter.own), key(letter.new)}
    for match in _GIVEN.finditer(text):
        names = {key(undotted(word.lstrip("\\"))[0]) for word in _ANY_NAME.findall(match["right"])}
        formula = len(names) > 1 or re.search(r"[-+−*/\d]", match["right"]) is not None
        if key(match["left"]) in same and formula and same & names == same - {key(match["left"])}:
            return True
    return False


def _is_factor(before: str, system: _System) -> bool:
    """Whether what stands before a name on its line makes it part of a formula: m g s cos P = 0."""
    before = before.rpartition("\n")[2].rstrip(" \t")
    word = _LAST.search(before)
    named = word is not None and (function_of(word.group()) is not None or bool(system.find(word.group())))
    return named or before[-1:] in _OPERATORS


def _declared(text: str, system: _System, listed: Sequence[tuple[int, int, bool]]) -> Iterator[DeclaredLetter]:
    """The declarations in their order, each once; those of the items ``listed`` last."""
    spans: list[tuple[int, int]] = []
    for match in _GROUP.finditer(text):
        new, own = ([_bare(x.group()) for x in _ANY.finditer(y)] for y in (match["new"] + match["more"], match["own"]))
        new, own = ([x for x in y if x not in ("and", "und")] for y in (new, own))
        paired = is_second(text, match.start()) or len(new) != len(own)
        if not paired and all(_may_be(a, b, system) for a, b in zip(new, own, strict=True)):
            spans.append(match.span())
            sure = re.search(_INSTEAD, match.group()) is not None
            for a, b in zip(new, own, strict=True):
                yield DeclaredLetter(a, system.find(b)[0], match.span(), sure)
    for pairs, span in tabled_letters(text, _bare, lambda a, b: key(a) == key(b) or _may_be(a, b, system)):
        pairs = [(a, b) for a, b in pairs if key(a) != key(b)]
        if pairs and all(b <= span[0] or span[1] <= a for a, b in spans):
            spans.append(span)
            yield from (DeclaredLetter(a, system.find(b)[0], span, True) for a, b in pairs)
    for match in _LISTED.finditer(text):
        first = max(0, match.start() - 2 * LONGEST)
        said = _SENTENCE.split(text[first : match.start()])[-1]
        items = list(_FOR_WHAT.finditer(text, match.start() - len(said), match.start()))
        own = [x for y in _ANY.finditer(match["own"]) if (x := _bare(y.group())) not in ("and", "und")]
        new = [_bare(x["new"]) for x in items]
        if len(new) == len(own) and all(_may_be(a, b, system) for a, b in zip(new, own, strict=True)):
            spans.append((items[0].start(), match.end()))
            for a, b in zip(new, own, strict=True):
                yield DeclaredLetter(a, system.find(b)[0], spans[-1], True)
    moving = {c.name for c in system.model.coordinates}
    for match in _TIME.finditer(text) if _BY_TIME.search(text) is None else ():
        if len(own := system.find(match["own"])) == 1 and own[0] in moving and not system.find("t"):
            spans.append(match.span())
            yield DeclaredLetter("t", own[0], match.span(), True)
            break
    for new, named, span in equated_letters(text, system.is_constant, system.is_coordinate):
        if _may_be(new, named, system) and all(b <= span[0] or span[1] <= a for a, b in spans):
            spans.append(span)
            yield DeclaredLetter(new, system.find(named)[0], span, True)
    for start, end, led in listed:
        if any(a < end and start < b for a, b in spans):
            continue
        said = _said(text[start:end], system, led=led)
        if said is not None:
            spans.append((start, end))
            yield DeclaredLetter(*said[:2], (start, end), said[2])


def _said(item: str, system: _System, *, led: bool) -> tuple[str, str, bool] | None:
    """The letter, the name of the system and whether it is sure, of an item that declares one."""
    surely = _SURE if any(map(item.casefold().__contains__, _CUES)) else ()
    for forms, sure in ((surely, True), (_LIKELY, False), (_LED if led else (), False)):
        for form in forms:
            match = form.search(item)
            if match is None or _MATHEMATICS.search(item[: match.start()]):
                continue
            new, named = _bare(match["new"]), match.groupdict().get("rest") or match["own"]
            if not sure and not led and system.states(new):
                continue
            own = _named(named, system, alone="stands" in form.groupindex)
            if own is not None and _may_be(new, own, system):
                return new, own, sure
    return None


def _named(rest: str, system: _System, *, alone: bool) -> str | None:
    """The name of the system in words: the mass M of the block; ``alone``: not what something else belongs to."""
    for match in _ANY.finditer(rest):
        found = system.find(_bare(match.group()))
        before = rest[: match.start()]
        if len(found) != 1 or _BEFORE.fullmatch(before) is None or _TAIL.match(rest, match.end()) is None:
            continue
        if any(x[:1].isdigit() or x.lower() in CHANGING or function_of(x) for x in before.split()):
            return None  # p stands for sin theta, for 2 m
        if any(map(system.find, (*map(_bare, before.split()[-1:]), *_RATE.findall(before)))):
            return None  # U = m e; v = r', on the line above J w' = M
        if any(x.lower() in CHANGING or function_of(x) for x in re.findall(r"[^\W\d_]+", rest[match.end() :])):
            return None  # B is the damper's force, b times speed; z is the height, l sin θ
        if (factor := _NEXT.match(rest, match.end())) is not None and any(map(system.find, factor.groups(""))):
            return None  # M is m L, g (m1 - m2)
        if not alone or _PREPOSITIONS.isdisjoint(before.lower().split()):
            return found[0]
    return None


def _may_be(new: str, own: str, system: _System) -> bool:
    """Whether one is a letter, perhaps with an index, and the other one name of the system."""
    stem = re.match(r"[^\W\d_]*", key(new))[0]  # type: ignore[index]  # it always matches
    letter = len(re.sub(r"[\d_].*", "", normal(new))) == 1 or stem in SPELLED.values() or bool(system.find(new))
    two = new.isalpha() and len(new) == 2 and new.lower() not in _NO_LETTERS
    letter = letter or (two and (not new.islower() or new[0] == new[1]))
    return letter and function_of(new) is None and len(system.find(own)) == 1 and key(new) != key(own)


def _items(text: str) -> Iterator[tuple[int, int, bool]]:
    """The items of lists, and whether a word such as uses stands in front; a line may end in one of them."""
    at = 0
    for gap in [*(m.span() for m in _PARAGRAPH.finditer(text)), (len(text), len(text))]:
        paragraph, first = text[at : gap[0]], at
        at = gap[1]
        if len(_ANY.findall(paragraph)) < 2:
            continue
        lead = _LEADS.search(paragraph)
        for lines in (True, False):
            start, depth = 0, 0
            for match in [*_JOIN.finditer(paragraph), None]:
                mark = match.group().strip(" \t") if match is not None else ""
                if mark in ("(", "[", "{"):
                    depth += 1
                elif mark in (")", "]", "}"):
                    depth = max(0, depth - 1)
                elif match is None or (mark == "\n" and lines) or (mark != "\n" and depth == 0):
                    end = len(paragraph) if match is None else match.start()
                    depth = 0
                    item = paragraph[start:end]
                    if end - start <= LONGEST and item.strip() and (lines or "\n" in item):
                        yield first + start, first + end, lead is not None and lead.start() < end
                    start = len(paragraph) if match is None else match.end()


def _relations(text: str, system: _System, items: Sequence[tuple[int, int, bool]]) -> Iterator[tuple[int, int, int]]:
    """Where one of the items begins, where the relation in its brackets does, and where it ends."""
    spans: list[tuple[int, int]] = []
    for start, end, _ in items:
        match = _RELATION.search(text[start:end]) if text.find("(", start, end) >= 0 else None
        if match is None or any(a < end and start < b for a, b in spans):
            continue
        new, own = _bare(match["new"]), _bare(match["relation"].partition("=")[0].strip())
        names = [_bare(x.group()) for x in _ANY.finditer(match["relation"].partition("=")[2])]
        known = find(own, [c.name for c in system.model.coordinates]) and not system.find(new)
        if known and new in names and all(x == new or system.find(x) or function_of(x) for x in names):
            spans.append((start, end))
            yield start, start + match.start("relation"), start + match.end("relation") + 1


def _bare(name: str) -> str:
    """A name without marks of LaTeX and Markdown."""
    bare = name.translate(_MARKS)
    stem = re.match(r"[^\W\d_]*", bare)[0]  # type: ignore[index]  # it always matches
    return _VARIANTS.get(stem, stem) + bare[len(stem) :]


def _blanked(text: str, spans: Sequence[tuple[int, int]]) -> str:
    for start, end in spans:
        text = blanked(text, start, end)
    return text


def _in_formulas(text: str, known: Collection[str]) -> set[str]:
    """The names that are parts of formulas, alone or in short products of known letters, in their common form."""
    found: set[str] = set()
    for match in _ANY.finditer(text):
        before = text[max(0, match.start() - 2) : match.start()].rstrip(" ")[-1:]
        behind = text[match.end() : match.end() + 2].lstrip(" ")[:1]
        if before + behind == "()" or _SIGNS.isdisjoint(before + behind):
            continue
        name = undotted(_bare(match.group()))[0]
        found.add(key(name))
        if name not in known and len(name) <= _PRODUCT and all(x in known for x in name):
            found.update(map(key, name))
    return found
