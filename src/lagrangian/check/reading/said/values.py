"""Finds what sentences say about names that nothing else explains.

A stands for M+m, B for m*l and D for J + m*l^2            A = M+m   B = m*l   D = J + m*l^2
$m_t$ is the total mass $M+m$                              m_t = M+m
P is the sum of the two forces, k x and b x'               P = k x + b x'
We write $s_1$ and $c_1$ for $\\sin x$ and $\\cos x$       s_1 = \\sin x   c_1 = \\cos x
Denote J + m l^2 by D; M_eff being m1 + m2                 D = J + m l^2   M_eff = m1 + m2
v is the velocity of the cart                              v is the rate of a coordinate

A sentence is a row of names without a meaning, of expressions, and of words between them, in any markup. Where the
words say that a name *is* the expression, that is its value. Everything else is a proposal that counts only if the
answer is right with it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from itertools import islice, pairwise, product

import sympy as sp

from lagrangian.check.reading.answer import Answer
from lagrangian.check.reading.numbered_rates import numbered_rates
from lagrangian.check.reading.plain.spans import spans
from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.prose.words_or_mathematics import CHANGING
from lagrangian.check.reading.said.axes import said_axes
from lagrangian.check.reading.said.rates_in_comments import rates_in_comments
from lagrangian.check.reading.unit_checks import UNITS
from lagrangian.model import Model
from lagrangian.read.letters import SPELLED, key
from lagrangian.records import dataclass, field

MOST, MOST_NAMES = 12, 6
"""The most readings that are proposed, and names for which they are sought."""

SHORTEST, NEAR = 4, 0.8
"""The letters of a name that may have a wrong one, and how similar it must be."""

_LONGEST = 3_000
"""The most characters of a sentence."""

_SAY = (
    "is are be being denotes denote stands stand for means equals equal as called call short abbreviates abbreviation "
    "write written with where let namely represents the ist sind sei seien bezeichnet steht für mit wobei heißt est "
    "sont soit désigne"
)
_IS = frozenset(_SAY.split())
"""Words that give a name its value."""
_HAVING = frozenset(["with", "mit"])
"""Words that may give a name something else than its value: the force N with the arm s."""
_VALUE = frozenset(["value", "values", "wert", "abbreviation", "abbreviations", "abkürzung", "abkürzungen"])
_NAMED = frozenset(
    [
        "by",
        "as",
        "call",
        "called",
        "calling",
        "name",
        "named",
        "denote",
        "denoted",
        "abbreviate",
        "abbreviated",
        "durch",
        "mit",
        "par",
    ]
)
"""Words between a value and the name for it."""
_POINTING = frozenset(["direction", "along", "against", "towards", "parallel", "opposite", "richtung", "entgegen"])
"""Words in front of what only gives a direction: λ is positive in the direction of Ω s."""
_DONE = frozenset(["times", "mal", "fois", "plus", "minus", "less"])
"""Words in front of what is done to an equation: F from the rear wheel, times n r."""
_JOINED = {"sum": "+", "sums": "+", "summe": "+", "somme": "+", "resultant": "+", "product": "*", "produkt": "*"}
"""Words for what one name is of several values, with the sign between these: the sum of F and k x."""
_SIGNS = {"times": "*", "mal": "*", "fois": "*", "plus": "+", "minus": "-", "less": "-"}
"""Words for signs between two values."""
_MOST_WORDS = 4
"""The most words that say what a value is, in front of it."""
_OF = frozenset(["of", "von", "de", "du"])
"""Words in front of a name to which belongs what has the value: the lever arm of A is s; not the value of A is s."""
_JOINS = frozenset(["and", "or", "und", "et", "resp", "respectively"])
_WHILE = frozenset([",", "while", "whereas", "where", "während", "wobei"])
"""What else may stand in front of another clause."""
_RATES = re.compile(r"(?:velocit|speed|rates?\b|geschwindigkeit|drehzahl|vitesse|current|strom|courant)", re.IGNORECASE)
_ACCELERATIONS = re.compile(r"acceler|beschleunig|accélér", re.IGNORECASE)
_ARTICLE = re.compile(
    r"[ \t]++(?!(?:in|on|at|by|as|or|and|for|if|is|of|to|here|there|above|below|instead|too|times)\b)[a-z]{2,24}+"
    r"(?![\w(=*/^'’′])"
)
"""What stands behind a letter that is an article: with a couple."""
_NAMED_IN = re.compile(r"[^\W\d_]\w*")
_ENDS = re.compile(r"(?<=[\w)\]}$'’′″²³])[.;](?=\s|\Z)|\n[ \t]*\n|\n(?=[ \t]*(?:\\|[A-Z(]|[^\n=]{0,200}=))")
_COMPARED = re.compile(r"[ \t$]*+(?:[<>≤≥≪≫]|\\(?:ll|gg|leq?|geq?)(?![a-z]))")
"""What stands behind a name in a condition: (for x > 0)."""
_MATH = re.compile(r"(?<!\\)\$(?P<dollar>[^$\n]{1,300})\$|\\\((?P<round>[^\n]{1,300}?)\\\)")
_DELIMITED = re.compile(r"\$|\\\(|\\\[|\\begin\{(?:equation|align|gather|eqnarray|multline|flalign)")
_STATES = re.compile(r"[=<>≈≡]|\\(?:approx|equiv|ll|gg|leq?|geq?|to|neq|begin|quad|qquad)(?![A-Za-z])")
_DISPLAY = re.compile(
    r"\$\$.*?\$\$|\\\[.*?\\\]|\\begin\{(?P<kind>(?:equation|align|gather|eqnarray|multline|flalign)\*?)\}.*?"
    r"\\end\{(?P=kind)\}",
    re.DOTALL,
)


@dataclass(frozen=True, slots=True)
class _Item:
    """A name without a meaning, an expression, or something else; ``before`` are the words in front of it."""

    kind: str
    text: str
    before: tuple[str, ...]


@dataclass(frozen=True)
class SaidValues:
    """Values of names, as an answer spells them; ``sure`` if its words say so; ``open`` if they leave something
    open, such as a sign."""

    values: dict[str, str]
    sure: bool
    open: bool = False
    shown: Mapping[str, str] = field(default_factory=dict)

    @property
    def told(self) -> list[str]:
        """How the names were read, if words say so."""
        said = {**self.values, **self.shown}.items() if self.sure or self.open else ()
        return [f"'{name}' was read as {value}, as the words say." for name, value in said]


def said_values(text: str, unknown: Sequence[str], words: Words, answer: Answer) -> list[SaidValues]:
    """Return what the sentences of an ``answer`` may say about the ``unknown`` names, the likeliest first."""
    latex = answer.notation == "latex"
    names = {key(x): x for x in unknown[:MOST_NAMES]}
    found: dict[str, dict[str, bool]] = {name: {} for name in names}
    coordinates = [c.name for c in words.names.model.coordinates]
    for sentence in _sentences(text, latex=latex):
        items = list(_combined(list(_items(sentence, names, words, latex=latex))))
        for name, value, sure in (*_paired(items), *_rated(items, coordinates, words, latex=latex)):
            found[name][value] = found[name].get(value, False) or sure
    readings = list(_readings({names[x]: said for x, said in found.items() if said}))
    numbered = {} if latex else numbered_rates(text, unknown, words.names.model)
    numbered |= {} if latex else rates_in_comments(text, unknown, words.names)
    if numbered:
        others = {x: v for y in readings if y.sure for x, v in y.values.items()}
        readings.insert(0, SaidValues({**others, **numbered}, True))
    axes = said_axes(text, unknown, answer, words.names.model)
    left = len(axes.values) > 1 or not axes.sure
    for k in reversed(range(len(axes.values))):
        value, shown = (axes.written(k, latex=x) for x in (latex, False))
        readings.insert(0, SaidValues(value, axes.sure and k == 0, left, shown))
    return readings


def misspelled(unknown: Sequence[str], known: Iterable[str]) -> dict[str, str]:
    """The names of the system that ``unknown`` ones may be with a letter wrong: theeta is theta; no number differs."""
    listed, found = list(known), dict[str, str]()
    for name in unknown[:MOST_NAMES]:
        close = get_close_matches(name, listed, 1, NEAR) if len(name) >= SHORTEST else []
        if close and re.sub(r"\D", "", name) == re.sub(r"\D", "", close[0]) and name not in SPELLED.values():
            found[name] = close[0]
    return found


def completed(text: str, values: Mapping[str, str], *, latex: bool) -> str:
    """An answer with the values of names as statements behind it."""
    marks = ("\\[", "\\]") if latex and _DELIMITED.search(text) else ("", "")
    spelled = {x: f"\\{x}" if latex and re.match(r"[^\W\d_]*", x)[0] in SPELLED.values() else x for x in values}  # type: ignore[index]
    return text.rstrip() + "".join(f"\n\n{marks[0]}{spelled[x]} = {value}{marks[1]}" for x, value in values.items())


def typed_in(text: str, answer: Answer) -> Answer:
    """The answer to a completed text without the statements that stand behind it."""
    last = text.count("\n") + 1
    return replace(answer, lines=tuple(x for x in answer.lines if (x.place.line or 0) <= last))


def _readings(found: dict[str, dict[str, bool]]) -> Iterator[SaidValues]:
    """The combinations of values, first that of what is said for sure."""
    certain = {name: values[0] for name, said in found.items() if len(values := [x for x in said if said[x]]) == 1}
    if certain:
        yield SaidValues(certain, True)
    others = islice(product(*found.values()), 2 * MOST)
    tried = (dict(zip(found, values, strict=True)) for values in others)
    yield from islice((SaidValues(x, False) for x in tried if x != certain and _differ(x)), MOST)


def _differ(values: dict[str, str]) -> bool:
    return len(set(values.values())) == len(values)


def _sentences(text: str, *, latex: bool) -> Iterator[str]:
    """The sentences of an answer; LaTeX's displayed mathematics has none."""
    if latex:
        text = _DISPLAY.sub(lambda m: ";\n\n" if "\\text" not in m.group() else _words_in(m.group()), text)
    yield from (x for x in _ENDS.split(text) if x and len(x) <= _LONGEST)


def _words_in(display: str) -> str:
    """The words with mathematics between the rows of a display."""
    said = re.findall(r"\\(?:inter)?text\{((?:[^{}]|\{[^{}]*\})*)\}", display)
    return ";\n\n" + ";\n\n".join(x for x in said if "$" in x) + ";\n\n"


# -- items ------------------------------------------------------------------------------------------------------------


def _items(sentence: str, names: dict[str, str], words: Words, *, latex: bool) -> Iterator[_Item]:
    at = 0
    for start, end, stated in _pieces(sentence, words, latex=latex):
        before = tuple(re.findall(r"[^\W\d_]+|[,:=(]", sentence[at:start]))
        written = sentence[start:end].strip()
        at = end
        bare = key(re.sub(r"[\\{}\s]", "", written)) if latex else key(written)
        directed = written.startswith("+") or (
            written.startswith(("-", "−")) and before[-1:] in (("in",), ("along",))
        )  # in -x
        article = written == "a" and not latex and _ARTICLE.match(sentence, end) is not None
        if stated or directed or article or _COMPARED.match(sentence, end):
            yield _Item("other", written, before)
        elif bare in names:
            yield _Item("name", bare, before)
        else:
            yield _Item("value" if latex or _is_value(written, words) else "other", written, before)
    yield _Item("end", "", tuple(re.findall(r"[^\W\d_]+|[,:=(]", sentence[at:])))


def _pieces(sentence: str, words: Words, *, latex: bool) -> Iterator[tuple[int, int, bool]]:
    """Where mathematics begins and ends in a sentence, and whether it says something by itself."""
    if not latex:
        yield from ((x.start, x.end, x.stated) for x in spans(sentence, words))
        return
    for match in _MATH.finditer(sentence):
        start, end = match.span("dollar" if match["dollar"] is not None else "round")
        depth, first = 0, start
        for i in range(start, end):
            depth += (sentence[i] in "({[") - (sentence[i] in ")}]")
            if depth == 0 and sentence[i] == "," and sentence[i - 1] != "\\":
                yield first, i, _STATES.search(sentence[first:i]) is not None
                first = i + 1
        yield first, end, _STATES.search(sentence[first:end]) is not None


def _is_value(written: str, words: Words) -> bool:
    """Whether this is an expression in known names."""
    named = re.findall(r"[^\W\d⁰¹²³⁴-⁹]\w*", written)
    if named == [written] and not words.names.known(written):
        return False  # another name of the answer
    if UNITS.issuperset(named) and not all(map(words.names.known, named)):
        return False  # the stiffness, N/m
    if written[0] in "'’′" or written[-1] in "+-*/^":
        return False
    return bool(named) and all(words.readable(x) or words.is_product(x) for x in named)


def _combined(items: Sequence[_Item]) -> Iterator[_Item]:
    """The items, those values as one that words add or multiply: k times the stretch s - s0; the sum of F and k x.

    A single value behind such a word is no value of the name: P is the sum of F, which is one of its parts, and others.
    """
    made: list[_Item] = []
    joins = ""
    for item in items:
        lower = [x.lower() for x in item.before]
        above = made[-1] if made and made[-1].kind == item.kind == "value" else None
        sign = _SIGNS.get(lower[0], "") if lower else ""
        listed = lower[:1] in ([","], ["and"], ["und"], ["et"])
        if above is not None and (sign or (listed and joins)) and _only_says_what(lower[1:]):
            made[-1] = _Item("value", _with_sign(above.text, sign or joins, item.text, spoken=bool(sign)), above.before)
            continue
        found = {_JOINED[x] for x in lower if x in _JOINED} if item.kind == "value" else set[str]()
        joins = found.pop() if len(found) == 1 else ""
        made.append(item)
    for item in made:
        alone = not any(x in item.text[1:] for x in "+-−*") and _JOINED.keys() & {x.lower() for x in item.before}
        yield _Item("other", item.text, item.before) if item.kind == "value" and alone else item


def _only_says_what(words: Sequence[str]) -> bool:
    """Whether words in front of a value only say what it is: and the damper's; and they may be an "and" before that."""
    bare = [x for x in words if x not in _JOINS and x != ","]
    return len(bare) <= _MOST_WORDS and not set(bare) & (_IS - {"the", "s"} | {"(", "=", ":"} | CHANGING)


def _with_sign(left: str, sign: str, right: str, *, spoken: bool) -> str:
    """Two values with a sign between them."""
    if sign == "*" or right[0] in "+-−":
        right = right if right.isalnum() else f"({right})"
    if sign == "*" and not left.isalnum() and (spoken or left[0] != "("):
        left = f"({left})"
    return f"{left} {sign} {right}"


# -- pairs ------------------------------------------------------------------------------------------------------------


def _paired(items: Sequence[_Item]) -> Iterator[tuple[str, str, bool]]:
    """Each name with the value beside it, in groups of equal length: a and b for x and y; none in a list
    that says what there is for which coordinate."""
    groups = _groups(items)
    if any(a[0] in ("value", "other") and b[2] in (("for",), ("für",)) for a, b in pairwise(groups)):
        return  # -λ r/p for r, 0 for φ, λ for z: what stands in which equation
    for (kind, first, said), (other, second, between) in pairwise(groups):
        lower = {x.lower() for x in between}
        if {x.lower() for x in between[-3:]} & _POINTING or {x.lower() for x in between[-1:]} & _DONE:
            continue
        if (kind, other) == ("name", "value") and not _belongs(said):
            values = second if len(second) == len(first) else second[:1] if len(first) == 1 else []
            has = bool(lower & _HAVING) and between[-1].lower() not in _HAVING  # the force N with the arm s
            has &= not (lower & _IS) - _HAVING - {"the"} and not lower & _VALUE
            says = lower & _IS - {"the"} or between[:1] == ("the",)  # the string pulls with A at the lever r
            has |= any(
                x.lower() in _JOINS and y.lower() in _HAVING for x, y in pairwise(between)
            )  # N and with a couple
            sure = bool(says) and not has and not lower & {"not", "nicht"} and len(first) == len(second)
            sure &= not _has_own_subject(between)
            changed = bool(lower & CHANGING)  # A is twice m; a is half the length l/2
            yield from (
                (a, b, sure)
                for a, b in zip(first, values, strict=False)
                if not (changed and b.isalnum()) and a not in _NAMED_IN.findall(b)  # the deflection is A sin(w t)
            )
        elif (kind, other) == ("value", "name") and len(first) == len(second) and lower & _NAMED:
            sure = bool({x.lower() for x in said} & _NAMED) or "by" in lower or "called" in lower
            yield from ((a, b, sure) for a, b in zip(second, first, strict=True))


def _has_own_subject(between: Sequence[str]) -> bool:
    """Whether words behind a name begin to speak of something else that has the value: the saddle pushes with N, and
    the arms pull with k s; not N, which is k s."""
    lower = [x.lower() for x in between]
    last = max((k for k, x in enumerate(lower) if x in _JOINS | _WHILE), default=None)
    clause = [] if last is None else lower[last + 1 :]
    verb = next((k for k, x in enumerate(clause) if x in _IS - {"the"}), 0)
    return verb > 1 and not _VALUE & set(clause[:verb])


def _belongs(said: Sequence[str]) -> bool:
    """Whether the words in front of a name make it what something else belongs to: the lever arm of A."""
    lower = [x.lower() for x in said]
    return bool(lower) and lower[-1] in _OF and not _VALUE & set(lower[-4:])


def _groups(items: Sequence[_Item]) -> list[tuple[str, list[str], tuple[str, ...]]]:
    """Items of one kind that only commas and "and" join, with the words in front of them."""
    found: list[tuple[str, list[str], tuple[str, ...]]] = []
    for item in items:
        joined = all(x.lower() in _JOINS or x == "," for x in item.before)
        if found and joined and item.before and found[-1][0] == item.kind:
            found[-1][1].append(item.text)
        else:
            found.append((item.kind, [item.text], item.before))
    return found


def _rated(
    items: Sequence[_Item], coordinates: Sequence[str], words: Words, *, latex: bool
) -> Iterator[tuple[str, str, bool]]:
    """The rates that a name may be of which words only say that it is a velocity or an acceleration."""
    for item, below in pairwise(items):
        said = " ".join(below.before)
        order = 2 if _ACCELERATIONS.search(said) else 1 if _RATES.search(said) else 0
        if item.kind != "name" or not order:
            continue
        beside = below.kind == "value" and not (below.before[0] == "(" and below.before[-1] == ",")  # i (current), x
        named = words.names.scope.meanings(re.sub(r"[\\{}\s]", "", below.text))[0] if beside else []
        own = [x for x in coordinates if x in named]
        if beside and not own:
            continue
        for name in own or coordinates:
            shown = below.text if own else rf"\mathrm{{{name}}}"
            written = f"\\{'d' * order}ot{{{shown}}}" if latex else name + "'" * order
            yield item.text, written, len(own) == 1


def related(answer: Answer, values: Mapping[str, str], model: Model) -> bool:
    """Whether a line says how a name depends on what it would be read as, x = r φ: then it is another quantity."""
    symbols = {u.name: u.symbol for u in answer.unknown}
    for line in answer.lines:
        expr = sp.sympify(line.residual)
        both = line.kind in ("equation", "identity") and not expr.atoms(sp.Derivative)
        for name, value in values.items():
            other = model.symbols.get(value)
            said = line.kind == "definition" and line.name == value and expr != symbols.get(name)
            if (
                name in symbols
                and expr.has(symbols[name])
                and (said or (both and other is not None and expr.has(other)))
            ):
                return True
    return False
