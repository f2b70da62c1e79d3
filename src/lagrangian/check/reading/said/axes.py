"""Reads which place letters of an answer are of which words give the axes alone: x to the right, y downwards.

x to the right, y downwards                             x = r sin φ   y = r cos φ
horizontal x and vertical y of the child, y down        the same
Let x and y be the horizontal and the vertical position x = r sin φ   y = -r cos φ or r cos φ

They are the components of the position of what moves, or of the body or the point that the words name, from the origin
of the system or from the point that they name. What the words leave open is a proposal.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby, islice, product
from typing import Any, TypeAlias, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.answer import Answer
from lagrangian.check.reading.said.conventions import stated_coordinates
from lagrangian.check.reading.said.senses import WAYS
from lagrangian.model import Gravity, Model, time
from lagrangian.page.plain import plain
from lagrangian.read.letters import key
from lagrangian.records import dataclass

MOST, MOST_SENTENCES, LONGEST = 6, 60, 400
"""The most readings, and the most sentences that are looked at and the characters of one."""
LARGEST = 400
"""The largest size of a position, or of an equation that tells which way is positive."""

Axis: TypeAlias = tuple[int, int]
"""The component of a position, 1 the vertical one, and the sign with which it grows to the right or upwards; 0 where
words do not say it."""
Place: TypeAlias = tuple[sp.Expr, ...]
_Piece: TypeAlias = tuple[str, Any]
"""A letter, an axis or another name in a sentence, by its kind."""

_OF_WAYS: dict[str, Axis] = {"right": (0, 1), "left": (0, -1), "up": (1, 1), "down": (1, -1)}
_NAMED: dict[str, tuple[str, Axis]] = {
    "level": (r"horizontal\w{0,3}+|waage?recht\w{0,2}+", (0, 0)),
    "plumb": (r"verti[ck]al\w{0,3}+|(?:senk|lot)recht\w{0,2}+", (1, 0)),
    "high": (r"heights?|höhe|hauteur|above[ ]the|aufwärts", (1, 1)),
    "deep": (r"depths?|tiefe|profondeur|below[ ]the|abwärts", (1, -1)),
}
_BARE: dict[str, Axis] = {
    **dict.fromkeys(("right", "rechts", "droite"), (0, 1)),
    **dict.fromkeys(("left", "links", "gauche"), (0, -1)),
    **dict.fromkeys(("up", "oben", "haut"), (1, 1)),
    **dict.fromkeys(("down", "unten", "bas"), (1, -1)),
    **{"→": (0, 1), "←": (0, -1), "↑": (1, 1), "↓": (1, -1)},
}
"""Words for an axis right behind a letter, or behind the word for the axis: y vertical, down."""
_AXES: dict[str, Axis] = {**_OF_WAYS, **{k: axis for k, (_, axis) in _NAMED.items()}}
_PIECE = re.compile(
    "|".join(f"(?P<{k}>(?<![\\w-])(?:{WAYS[k]})(?!\\w))" for k in _OF_WAYS)
    + "|"
    + "|".join(f"(?P<{k}>(?<!\\w)(?:{form})(?!\\w))" for k, (form, _) in _NAMED.items())
    + rf"|(?P<bare>(?<![\w-])(?:{'|'.join(x for x in _BARE if x.isalpha())})(?=[ ]?(?:[,;:.)]|\Z)|"
    + r"[ ](?:and|und|et|from|with|is|ist|positive?|est)(?!\w))|[→←↑↓])"
    + r"|(?P<word>[^\W\d]\w{0,23}+)",
    re.IGNORECASE,
)
_BEFORE = re.compile(r"(?:[\w*/^+=\\'’′−-]|[*/^+=−-][ ])\Z")
_BEHIND = re.compile(r"['’′\^(*/²³\u0307\u0308\[]|[ ]?[*/^+<>≤≥]|[ ]?=[ ]?+(?![^\W\d_]{4,24}[ ,])|[ ]?[-−][ ]?\w(?!\w)")
"""What stands before and behind a name in a formula."""
_OF_TIME = re.compile(r"\([ ]?t[ ]?\)")
_FILLED = re.compile(
    r"[\s(,:=–—+-]*+(?:(?:axis|achse|axe|points?|pointing|positive?|pos|is|ist|est|being|counts?|counted|measured|grows?"
    r"|growing|goes|going|directed|zeigt|nach|vers|la|le|to|the)(?!\w)[\s(,:=.-]*+){0,5}",
    re.IGNORECASE,
)
_AGAINST = re.compile(
    r"(?<!\w)(?:from|to|against|with|between|above|below|gegen|gegenüber|zur?|von|unter|mit|avec|sur)[ ]"
    r"(?:(?:the|der|die|dem|den|la|une?)[ ]|l['’])?\Z",
    re.IGNORECASE,
)
"""What stands in front of an axis from which something is measured: the angle to the horizontal."""
_THING = re.compile(
    r"[ ](?:springs?|forces?|dampers?|arms?|walls?|rods?|plates?|bars?|beams?|links?|surfaces?|planes?|lines?|rails?|"
    r"guides?|tracks?|feder\w*|kraft|kräfte|stange\w*|wand|ebene|führung|schiene)(?!\w)",
    re.IGNORECASE,
)
"""What stands behind a word that says how a thing lies: the horizontal spring."""
_TURNS = re.compile(r"angles?|winkel\w*|rotations?|drehung|drehwinkel|tilt|turned|gedreht|inclinaison", re.IGNORECASE)
_PREPOSITION = re.compile(r"(?<!\w)(?:from|at|in|of|on|ab|von|im|des?|depuis|en|du|point|punkt)[ ]\Z", re.IGNORECASE)
_OTHERWISE = re.compile(
    r"(?<!\w)(?:not|never|nicht|uphill|downhill|hang(?:auf|ab)\w*|berg(?:auf|ab)|slopes?|inclines?|inclined|ramp|"
    r"perpendicular|rotating|rotates|body-fixed|körperfest\w*|mitbewegt\w*)(?!\w)",
    re.IGNORECASE,
)
"""Words for axes that are turned."""
_ORIGIN = re.compile(
    r"(?<!\w)(?:(?:origin|ursprung|nullpunkt|origine)(?:[ ](?:is|at|in|im|am|of|ist|liegt|est|en|au|à|du|lies)){0,3}|"
    r"(?:measured|counted|gemessen|mesurée?s?)[ ](?:from|ab|von|depuis)|relative[ ]to|relativ[ ]zu\w?|from|ab|depuis|"
    r"par[ ]rapport[ ]à|below|above)[ ](?P<words>[^,;:.()\n=]{1,40})",
    re.IGNORECASE,
)
_AT_REST = re.compile(
    r"(?<!\w)(?:rest\w*|relaxed|unstretched|unstrained|undeformed|unloaded|slack|natural|free|equilibrium|entspannt\w*|"
    r"ungespannt\w*|ruhelage|gleichgewicht\w*|équilibre|repos)(?!\w)",
    re.IGNORECASE,
)
_USUAL = ("x", "y", "X", "Y")
"""Letters of axes, of which the answer may use one only."""
_SENTENCE = re.compile(r"[.;!?](?=\s|\Z)")


@dataclass(frozen=True)
class SaidAxes:
    """What letters may be by the axes that words give them, the likeliest first, and whether that is sure."""

    values: tuple[dict[str, sp.Expr], ...] = ()
    sure: bool = False

    def written(self, number: int, *, latex: bool) -> dict[str, str]:
        """One reading as an answer would write it."""
        return {x: sp.latex(_with_symbols(v)) if latex else plain(v) for x, v in self.values[number].items()}


def said_axes(text: str, names: Sequence[str], answer: Answer, model: Model) -> SaidAxes:
    """Return the places that two of the ``names``, which accelerate or have rates, may be as words say their axes."""
    moving = {u.name: u.symbol for u in answer.unknown if u.name in names and isinstance(u.symbol, AppliedUndef)}
    if model.dimension != 2 or not moving or (down := _down(model)) is None:
        return SaidAxes()
    bare = re.sub(r"\\(?:text|mathrm|quad|[,;! ])|[$`{}\\]", "", text)
    defined = [str(x.name) for x in answer.lines if x.kind in ("definition", "identity") and x.name]
    letters = [*moving, *defined, *(x for x in _USUAL if x not in model.symbols)]
    axes, said = _axes_of(bare, list(dict.fromkeys(letters)))
    pair = sorted(axes, key=lambda x: axes[x][0])
    rest = stated_coordinates(text, pair).rest or any(_AT_REST.search(m["words"]) for x in said for m in _origin_of(x))
    if [axes[x][0] for x in pair] != [0, 1] or not moving.keys() & set(pair) or rest:
        return SaidAxes()
    places, one = _places(model, said)
    origins, known = _origins(model, said, places)
    if not places:
        return SaidAxes()
    senses = [_senses(axes[x], moving.get(x), answer, model) for x in pair]
    readings: list[dict[str, sp.Expr]] = []
    for place, origin, (right, up) in product(places, origins, product(*senses)):
        value = place[0] - origin[0], -down * (place[1] - origin[1])
        at = [bounded.expand(sign * x) for sign, x in zip((right, up), value, strict=True)]
        if all(x.has(AppliedUndef) and bounded.size(x) <= LARGEST for x in at):
            readings.append({x: v for x, v in zip(pair, at, strict=True) if x in moving})
    return SaidAxes(tuple(readings[:MOST]), one and known and bool(readings))


def _with_symbols(value: sp.Expr) -> sp.Expr:
    """An expression with letters in place of functions of time."""
    names = {f: sp.Symbol(str(cast("Any", f).func)) for f in value.atoms(AppliedUndef)}
    return cast("sp.Expr", value.xreplace(cast("Any", names)))


def _origin_of(sentence: str) -> Iterator[re.Match[str]]:
    """Where a sentence says from where something is measured."""
    return islice(_ORIGIN.finditer(sentence), MOST)


# -- the axes ---------------------------------------------------------------------------------------------------------


def _axes_of(text: str, names: Sequence[str]) -> tuple[dict[str, Axis], list[str]]:
    """The axis of each name of which words say one, and the sentences that speak of axes or their origin; none of a
    name of which they say two."""
    own = {key(x): x for x in names}
    found: dict[str, Axis] = {}
    said: list[str] = []
    wrong = set[str]()
    for sentence in islice(_sentences(text), MOST_SENTENCES):
        if _OTHERWISE.search(sentence):
            continue
        pieces = list(_pieces(sentence, own))
        if not any(kind == "letter" for kind, _ in pieces) or not any(kind == "axis" for kind, _ in pieces):
            said += [sentence] if _ORIGIN.match(sentence) else []
            continue
        said.append(sentence)
        for name, (axis, sign) in _assigned(pieces).items():
            before = found.get(name, (axis, 0))
            wrong |= {name} if before[0] != axis or before[1] * sign < 0 else set()
            found[name] = (axis, before[1] or sign)
    return {name: axis for name, axis in found.items() if name not in wrong}, said


def _sentences(text: str) -> Iterator[str]:
    """The sentences with their first characters; a line with an equals sign is read by itself."""
    made: list[list[str]] = [[]]
    for line in text.split("\n"):
        if not line.strip() or "=" in line or line.lstrip()[0] in "-*•–" or "=" in "".join(made[-1][-1:]):
            made.append([])
        made[-1].append(line)
    said = (x for lines in made for x in _SENTENCE.split(" ".join(lines)) if x.strip())
    return (" ".join(x.split())[:LONGEST] for x in said)


def _pieces(sentence: str, own: dict[str, str]) -> Iterator[_Piece]:
    """The letters, axes and other names of a sentence, in their order; an axis that two words give is one."""
    made: list[_Piece] = []
    end = 0
    for match in _PIECE.finditer(sentence):
        kind = str(match.lastgroup)
        before = sentence[max(0, match.start() - 20) : match.start()]
        if kind in ("level", "plumb") and (_AGAINST.search(before) or _THING.match(sentence, match.end())):
            made.append(("other", match.group()))
            continue
        if kind == "word":
            if (piece := _name(match, sentence, own)) is None:
                continue
            end = _word_end(match, sentence)
        else:
            filled = _FILLED.fullmatch(sentence, end, match.start())
            if kind == "bare" and (not made or made[-1][0] == "other" or not filled):
                continue
            axis = _BARE[match.group().lower()] if kind == "bare" else _AXES[kind]
            end = match.end()
            above = made[-1] if made and made[-1][0] == "axis" else None
            if above is not None and above[1][0] == axis[0] and above[1][1] * axis[1] in (0, 1):
                made[-1] = ("axis", (axis[0], above[1][1] or axis[1]))
                continue
            piece = ("axis", axis)
        made += [piece] if made[-1:] != [piece] else []
    yield from made


def _word_end(match: re.Match[str], sentence: str) -> int:
    """Where a word ends, with (t) behind it."""
    return (_OF_TIME.match(sentence, match.end()) or match).end()


def _name(match: re.Match[str], sentence: str, own: dict[str, str]) -> _Piece | None:
    """A word of a sentence as a letter with an axis, or as another name; None if it is neither."""
    name = match["word"]
    if key(name) in own:
        begins = sentence[max(0, match.start() - 2) : match.start()]
        if (match.start() > 2 and _BEFORE.search(begins)) or _BEHIND.match(sentence, _word_end(match, sentence)):
            return None
        return "letter", own[key(name)]
    if _TURNS.fullmatch(name):
        return "other", name
    alone = len(name) == 1 and name not in "aAIyt"
    if not alone or _PREPOSITION.search(sentence[max(0, match.start() - 12) : match.start()]):
        return None
    return "other", name


def _assigned(pieces: Sequence[_Piece]) -> dict[str, Axis]:
    """The axes of the letters of a sentence, which stand behind them or in front of them."""
    runs = [(kind, [x for _, x in group]) for kind, group in groupby(pieces, key=lambda x: x[0])]
    letters = {x for kind, x in pieces if kind == "letter"}
    for behind in (True, False):
        found: dict[str, Axis] = {}
        for k, (kind, listed) in enumerate(runs):
            beside = runs[k + 1 if behind else k - 1] if 0 <= (k + 1 if behind else k - 1) < len(runs) else ("", [])
            if kind != "letter" or beside[0] != "axis":
                continue
            n = min(len(listed), len(beside[1]))
            pairs = (
                zip(listed[-n:], beside[1][:n], strict=True) if behind else zip(listed[:n], beside[1][-n:], strict=True)
            )
            for name, axis in pairs:  # the sense of an axis may be said behind it: with y positive downwards
                above = found.setdefault(name, axis)
                found[name] = axis if above[0] == axis[0] and not above[1] else above
        if not behind and runs[-1][0] == "axis" and runs[-1][1][0][1] and len(runs) > 1:
            last = [x for x in found if found[x][0] == runs[-1][1][0][0]]
            found |= {x: runs[-1][1][0] for x in last if not found[x][1]}
        if letters <= found.keys() and len({axis for axis, _ in found.values()}) == len(found):
            return found
    return {}


def _senses(axis: Axis, symbol: Any, answer: Answer, model: Model) -> tuple[int, ...]:
    """The sign of an axis, or both, the likelier first: that of the weight in the answer."""
    if axis[1]:
        return (axis[1],)
    weights = [e.g for e in model.elements if isinstance(e, Gravity) and isinstance(e.g, sp.Symbol)]
    for line in answer.lines if axis[0] == 1 and symbol is not None else ():
        if (
            weights
            and line.kind in ("equation", "V", "L")
            and bounded.size(expr := sp.sympify(line.residual)) <= LARGEST
        ):
            along = symbol if line.kind != "equation" else sp.Derivative(symbol, (time, 2))
            slope = bounded.diff(expr, weights[0])
            product_of = bounded.diff(slope, along) if line.kind != "equation" else slope * bounded.diff(expr, along)
            value = cast("Any", product_of.xreplace(dict.fromkeys(product_of.free_symbols, sp.S.One)))
            if value.is_number and value.is_extended_real and value != 0:
                up = 1 if (value > 0) == (line.kind != "L") else -1
                return (up, -up)
    return (1, -1)


# -- the places -------------------------------------------------------------------------------------------------------


def _down(model: Model) -> int | None:
    """The sign of the second component along gravity; -1 without gravity, None where it pulls along neither way."""
    found = {tuple(e.direction) for e in model.elements if isinstance(e, Gravity)} or {(0, -1)}
    down = {(0, -1): -1, (0, 1): 1}
    return down.get(cast("Any", found.pop())) if len(found) == 1 else None


def _places(model: Model, said: Sequence[str]) -> tuple[list[Place], bool]:
    """The places of what moves along both axes, first of what words name, and whether they are one."""
    named: dict[Place, set[str]] = {}
    for what, point in [*((b.name, b.at) for b in model.bodies), *((p.name, p) for p in model.points)]:
        named.setdefault(_place(model, point), set()).update({what, point.name})
    moving = [at for at in named if all(x.has(AppliedUndef) for x in at)]
    others = [at for at in named if at not in moving and any(x.has(AppliedUndef) for x in at)]
    spoken = _ORIGIN.sub(" ", " ".join(said))
    called = [at for at in (*moving, *others) if any(_speaks_of(spoken, x) for x in named[at])]
    if len(called) == 1 and called[0] in moving:
        return called, True
    bodies = {_place(model, b.at) for b in model.bodies}
    mixed = [(a[0], b[1]) for a, b in product((*moving, *others), repeat=2) if a != b]  # letters of two bodies
    known = [at for at in dict.fromkeys(mixed) if all(x.has(AppliedUndef) for x in at) and at not in moving]
    return [*sorted(moving, key=lambda at: at not in bodies), *known], len(moving) == 1 and not others


def _place(model: Model, point: Any) -> Place:
    return tuple(model.expand(x, constants=True) for x in model.position(point))


def _speaks_of(words: str, name: str | None) -> bool:
    """Whether words name something: a word of its name, or the letter itself."""
    listed = set(re.findall(r"\w+", words))
    own = re.findall(r"\w+", (name or "").replace("_", " "))
    return (len(name or "") == 1 and name in listed) or bool(
        {x.lower() for x in own if len(x) > 2} & {x.lower() for x in listed}
    )


def _origins(model: Model, said: Sequence[str], places: Sequence[Place]) -> tuple[list[Place], bool]:
    """The places from which positions may be counted, the likeliest first, and whether there is one."""
    zero: Place = (sp.S.Zero, sp.S.Zero)
    points = {_place(model, p): p.name for p in model.points} | {_place(model, b.at): b.name for b in model.bodies}
    phrases = [m["words"] for x in said for m in _origin_of(x)]
    called = [at for at, name in points.items() if at not in places[:1] and any(_speaks_of(x, name) for x in phrases)]
    if len(called) == 1:
        return called, True
    q = [c.symbol for c in model.coordinates]
    fixed = [
        tuple(cast("sp.Expr", bounded.expand(x).as_independent(*q, as_Add=True)[0]) for x in at) for at in places[:1]
    ]
    fixed += [at for at in points if not any(x.has(AppliedUndef, time) for x in at)]
    others = [at for at in dict.fromkeys(fixed) if at != zero]
    return [zero, *others], not others
