"""Takes the remarks off an answer that stand beside its equations: a check, a special case, an equilibrium.

    Check: for m = 0 we get M x'' = F.         a line that begins with such a word, and what stands under it
    If the cart is fixed, x = 0, (...) = 0.    a sentence with a condition

They are about other motions than all, and an answer whose equations are complete does without them. What states T*, V,
L, D or a Ξ, what explains a name that is used elsewhere, and equations for all coordinates once more are no such
remarks.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import accumulate, islice

from lagrangian.check.reading.prose.blocks import closed, end_below, is_open
from lagrangian.check.reading.prose.remark_words import BESIDE_FREQUENCIES, CASES, CHECKS, FREQUENCIES, REST
from lagrangian.check.reading.prose.remarks import accelerates_in
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.prose.words_or_mathematics import moves
from lagrangian.check.reading.set_aside import MOST_TOLD
from lagrangian.check.reading.stated import energy_of, force_of
from lagrangian.check.reading.words_beside import words_beside
from lagrangian.model import Model
from lagrangian.read.letters import key, undotted
from lagrangian.read.scope import rate_stems
from lagrangian.records import dataclass

_FIRST = 6
"""The words of a line of which one says that it is a remark."""
_MOST = 40
"""The largest number of remarks."""

_WORD = re.compile(r"[^\W\d_]{2,}")
_LAST = re.compile(r"(?<![^\W_])[^\W\d_]{2,24}\Z")
_NAME = r"[^\W\d][\w\u0307\u0308]{0,23}+['’′]{0,2}"
_SIMPLE = rf"(?:[-−]?\d(?:[\d./,]{{0,8}}\d)?|{_NAME}|∞)"
_RELATION = re.compile(
    rf"(?<![\w^*/+)'’′-])(?P<left>{_NAME})(?P<chain>(?:[ \t]*=[ \t]*{_NAME}){{0,3}})"
    r"[ \t]*(?P<sign>->|→|≪|≫|<<|>>|≈|≡|=|(?<=[ \t])(?:(?:goes|tends)[ \t])?to(?=[ \t](?:infinity|∞|zero|0)\b))"
    rf"[ \t]*(?P<right>{_SIMPLE})(?![\w^*/+(²])(?!['’′])"
)
_ANGLE = re.compile(rf"(?P<of>(?<![\w\\*/^+'’′-])(?P<name>{_NAME})[ \t]*=[ \t]*)[-−]?\d{{1,3}}(?:[.,]\d{{1,3}})?[ ]?°")
"""An angle in degrees."""
_OFF = rf"(?<![\w*/^+]){_NAME}[ \t]*=[ \t]*{_NAME}[ \t]*\+[ \t]*{_NAME}(?![\w/(])"
_DEVIATION = re.compile(rf"\W{{0,6}}linear[^\W\d_]{{0,10}}+[^\n=]{{0,40}}{_OFF}", re.IGNORECASE)
"""Linearized about a position, with a letter for how far it is off: Linear, phi = phi_e + eta: …"""
_GOES_ON = re.compile(r"(?<=[\w'’′])[ \t]*[-+−*/·][ \t]*[\w(\\]")
"""What makes a value a sum or a product: s = x - R theta."""
_NEXT = re.compile(rf"[ \t]{{1,9}}(?P<name>{_NAME})(?![^\W²³]|['’′])")
_HELD = re.compile(
    r"^\W{0,4}(?:(?:if|when|wenn|falls|si)\b[^.;:=\n]{1,60}?\b(?:fixed|fest|fixe)|"
    r"(?:if|when|wenn|falls|si|with|mit|for|für|pour|avec)\b[^.;:=\n]{1,60}?\b(?:held|locked|blocked|clamped|stopped|zero|"
    r"at[ ]rest|festgehalten|blockiert\w?|null|bloquée?|nulle?))\b",
    re.IGNORECASE,
)
"""A sentence that begins with a coordinate or a body that is held, in words."""
_CUE = re.compile(
    r"(?<![^\W_])(?:if|when|whenever|for|unless|provided|assuming|setting|set|without|with|at|about|around|near|"
    r"wenn|falls|bei|um|"
    r"f(?:ü|ue|[\\ ]?\"[{ ]?u[} ]?)r|sofern|mit|ohne|setzt|setze|si|pour|sans|avec)(?![^\W_])",
    re.IGNORECASE,
)
_IF = re.compile(
    r"\W{0,4}(?:if|when|wenn|falls|si)\b(?P<said>[^,;:\n]{3,120})[,;:](?P<then>[^=\n]{0,300})\Z", re.IGNORECASE
)
"""A sentence with a condition in front and no equation behind it."""
_TERM = re.compile(r"[-+*/^²'’′:]|\w\(")
"""What stands between a condition and the word that begins it only if a formula begins there: for ẍ: ẍ = x θ̇² + …"""
_LABEL = re.compile(rf"[ \t(]*+{_NAME}[ \t]*(?:->|→|=)[ \t]*(?:{_SIMPLE})(?:[ \t]*[,;][^:=\n]{{1,60}})?[ \t]*:")
"""A condition in front of what holds under it: F = 0, small phi: …"""
_LABEL_IN_WORDS = re.compile(
    rf"[ \t]*+(?:[-•*][ \t]+|\(?[a-z\d]{{1,3}}[.)][ \t]+)?[^\W\d_]{{2}}[^=:;\n()]{{0,80}}\("
    rf"[ \t]*{_NAME}[ \t]*(?:->|→|=)[ \t]*(?:{_SIMPLE})(?:[ \t]*(?:,|=|and|und|et)[^:\n()]{{1,60}})?[ \t]*\)[ \t]*:"
)
"""The same in words, with the condition in brackets: weight locked in the middle (u = 0): …"""
_ABSENT = re.compile(
    r"\b(?:no|without|negligible|frictionless|undamped|unforced|small|ohne|kein(?:e[nr]?)?|reibungsfrei|ungedämpft|klein(?:e[nr]?)?"
    r"|sans|petite?s?)\b",
    re.IGNORECASE,
)
"""Words of what a check leaves out: no friction, small angles."""
_FORCES = (
    r"(?:gravity|weight|friction|damp\w{0,6}|drag|force|input|torque|drive|motor|load|springs?|losses|"
    r"dissipation|excitation|schwerkraft|gewicht|reibung|dämpf\w{0,6}|kraft|moment|antrieb|federn?|pesanteur|"
    r"frottement\w?|amortiss\w{0,8}|couple|ressorts?)\b"
)
_LACKS = re.compile(
    r"\W{0,4}(?:(?:for|with|and|small|angles?|motions?|oscillations?|für|kleine|winkel|und|mit|pour|petits?|angles|et|"
    r"alpha|beta|gamma|delta|theta|phi|psi|[^\W\d_])[ ]){0,6}?"
    r"(?:no|without|neglecting|ignoring|ohne|kein(?:e[nr]?)?|sans)[ ]"
    rf"(?:[^\W\d_]{{2,12}}[ ]){{0,2}}?{_FORCES}[^=\n:,]{{0,30}}[:,]"
    r"(?![^=\n]{0,200}\b(?:final|second|first|results?|equations?|solved|gives?|is|are|so|ergebnis|gleichung|ist)\b)"
    rf"|[^=\n:;]{{0,60}}\b{_FORCES}[ ](?:(?:is|are)[ ])?"
    r"(?:left[ ]out|neglected|ignored|weggelassen|vernachlässigt|négligée?s?)[ ]?:",
    re.IGNORECASE,
)
"""A sentence that leaves out a force, in words: without gravity, for small angles and no friction, …"""
_ITEM = re.compile(r"[ \t]*+(?:[-•*]|\(?[a-z\d]{1,3}[.)])[ \t]+")
_UNITS = re.compile(r"(?:units?|dimensions?|einheiten?|dimension|unités?)\b", re.IGNORECASE)
_ELSEWHERE = re.compile(
    r"\b(?:lectures?|(?:text)?book|slides?|literature|vorlesung|skript|lehrbuch|buch|cours|livre)\b"
    r"[^\n]{0,200}?\b(?:there|dort|là)\b[^\n.;]{0,60}=",
    re.IGNORECASE,
)
"""A sentence that compares with the system of another place: as in the lecture, if …: there l θ'' + g θ = 0."""
_SUBJECT = re.compile(r"(?<![\w/])(?:∂|d|\\partial)[ \t]?(?:\\mathcal\{)?[TVLUDK]\}?[ \t]?(?:/|\}[ \t]?\{)")
"""A derivative of an energy."""
_STATED = re.compile(
    r"(?P<name>(?<![\w\\])\\?[^\W\d]\w{0,23}+(?:_\{\w{1,12}\})?)\*?(?:\^\*)?[ \t]*&?=(?![=>])"
    r"(?P<zero>[ \t]*0(?![\w.]))?"
)
"""A name with a value, and whether that is 0."""
_ENDS = re.compile(r"[.;!?](?=\s|\Z)")
_MARKS = re.compile(r"\$|\\[\[\]()]|\\(?:begin|end)\{")
_TEX = re.compile(r"\\(?:dot|ddot|equiv|text|mathrm|approx|to|rightarrow|ll|gg)(?![A-Za-z])|[\\${}&`*]")
_BLANK = dict.fromkeys(map(ord, "${}&`*"), " ")
_SIGNS = {"equiv": "=", "approx": "=", "to": "→", "rightarrow": "→", "ll": "≪", "gg": "≫"}


@dataclass(frozen=True)
class _Remark:
    """A part of a text, and whether it is about a case that is not every motion, or leaves out a force."""

    start: int
    end: int
    case: bool
    lacks: bool = False


@dataclass(frozen=True)
class SideRemarks:
    """An answer in which remarks are blank, the numbers of the lines with their statements, and what words say of lines
    by number: what `words_beside` finds, and whether they are part of a "check" or of a "case"."""

    text: str
    lines: tuple[int, ...]
    said: Mapping[int, frozenset[str]]


def without_side_remarks(text: str, model: Model, known: Callable[[str], bool]) -> SideRemarks:
    """Find the remarks in an answer."""
    return _without(text, model, lambda name: name == "t" or known(name))  # at t = 0


def _as_zero(match: re.Match[str], moving: Collection[str]) -> str:
    """A position that a coordinate has in one case, θ = 90°, as θ = 0, which has the same length."""
    return f"{match['of']}0".ljust(len(match.group())) if key(match["name"]) in moving else match.group()


def _without(text: str, model: Model, known: Callable[[str], bool]) -> SideRemarks:
    lines = text.split("\n")
    starts = [0, *accumulate(len(line) + 1 for line in lines)]
    shown = _ANGLE.sub(partial(_as_zero, moving={key(c.name) for c in model.coordinates}), text).split("\n")
    found = [x for r in islice(_remarks(shown, starts, known), _MOST) for x in _without_stated(text, r, model)]
    found = [r for r in found if "=" in (part := text[r.start : r.end]) and _is_whole(part)]
    moving = [sum(map(accelerates_in, _general(text[r.start : r.end], known))) for r in found]
    resting = [r for r in found if REST.search(text[r.start : r.end].split("=", 1)[0])]
    if sum(n for r, n in zip(found, moving, strict=True) if not r.case and not r.lacks) >= len(model.coordinates):
        found = [r for r in found if r.case or r.lacks]
    elif model.constraints:  # a remark may state a constraint
        found = [r for r, n in zip(found, moving, strict=True) if r.case or n or r in resting]
    bare = _blanked(text, found)
    told = [r for r in found if r not in resting]  # a value at rest is no meaning
    stated = {m["name"] for m in _STATED.finditer(bare)}  # for d = 0: u = 1, where another line says what u is
    used = [
        r
        for r in told
        if any(_uses(bare, name) for name in _explained(text[r.start : r.end], known) if name not in stated)
    ]
    bare = _blanked(text, [r for r in found if r not in used]) if used else bare
    changed = [k for k, at in enumerate(starts[:-1]) if not bare.startswith(lines[k], at)]
    said: dict[int, frozenset[str]] = {}
    for r in found:
        inside = range(bisect_right(starts, r.start) - 1, bisect_right(starts, r.end - 1))
        rests = any(REST.search(lines[k]) for k in inside[:1])
        for k in inside:
            said[k + 1] = said.get(k + 1, frozenset()) | {
                "case" if r.case else "check",
                *(["lacks"] if r.lacks else []),
                *(["rest"] if rests else []),
            }
    for k, words in enumerate(words_beside(lines)):
        if words:
            said[k + 1] = said.get(k + 1, frozenset()) | words
    return SideRemarks(bare, tuple(k + 1 for k in changed if "=" in lines[k]), said)


def _without_stated(text: str, remark: _Remark, model: Model) -> Iterator[_Remark]:
    """A remark, or those lines of a case that state no energy, force or derivative, where one of them does."""
    if not _states(text[remark.start : remark.end], model):
        yield remark
    elif remark.case:
        at = remark.start
        for line in text[remark.start : remark.end].split("\n"):
            if not _states(line, model):
                yield replace(remark, start=at, end=at + len(line))
            at += len(line) + 1


def _blanked(text: str, remarks: Sequence[_Remark]) -> str:
    parts, at = [], 0
    for r in remarks:
        start, end = max(r.start, at), max(r.end, at)
        parts += [text[at:start], *("\n" if x == "\n" else " " for x in text[start:end])]
        at = end
    return "".join((*parts, text[at:]))


def _uses(text: str, name: str) -> bool:
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) is not None


def _general(part: str, known: Callable[[str], bool]) -> list[str]:
    """The statements of a remark, one a line, of which none holds in a special case alone or is about units; the lines
    below a case belong to it, up to the next item."""
    found: list[str] = []
    case = False
    for line in part.split("\n"):
        item = _ITEM.match(line)
        said = line[item.end() :] if item else line
        alone = _is_case(said, known, led=True)
        case = (case and item is None and bool(line.strip())) or _leaves_out(said) or _UNITS.match(said) is not None
        found += [line] if "=" in line and not (alone or case) else []
        case = case or (alone and item is not None)
    return found


def _is_whole(part: str) -> bool:
    """Whether a part of a text neither opens nor closes mathematics of LaTeX."""
    marks = [m.group() for m in _MARKS.finditer(part)]
    pairs = ((r"\[", r"\]"), (r"\(", r"\)"), (r"\begin{", r"\end{"))
    return marks.count("$") % 2 == 0 and all(marks.count(a) == marks.count(b) for a, b in pairs)


def _states(written: str, model: Model) -> bool:
    """Whether a part of a text states an energy, a generalized force or a derivative of an energy."""
    if any("=" in written[m.end() :] for m in _SUBJECT.finditer(written)):
        return True
    stated = (m["name"] for m in _STATED.finditer(written) if m["zero"] is None)
    names = [x.lstrip("\\").replace("{", "").replace("}", "") for x in stated]
    return any(energy_of(x, model, lhs=True) or force_of(x, model) for x in names)


def _explained(written: str, known: Callable[[str], bool]) -> Iterator[str]:
    """The names that a part of a text gives a value to and that the system does not have."""
    for match in _STATED.finditer(written):
        name = match["name"].lstrip("\\")
        own = not known(name) and not any(known(stem) for _, stem in rate_stems(name))  # r_ddot
        if own and _begins(written[max(0, match.start() - 40) : match.start()], known):
            yield match["name"]


# -- where remarks are ------------------------------------------------------------------------------------------------


def _remarks(lines: Sequence[str], starts: Sequence[int], known: Callable[[str], bool]) -> Iterator[_Remark]:
    k = 0
    while k < len(lines):
        kind = _kind(lines[k])
        if kind is None:
            yield from _sentences(lines, k, starts, known)
            k += 1
            continue
        end = closed(lines, k) or (end_below(lines, k) if is_open(lines, k) else k + 1)
        case = kind == "case" or _leaves_out(lines[k]) or _is_case(" ".join(lines[k:end][:2]), known, led=True)
        yield _Remark(starts[k], starts[end] - 1, case)
        k = end


def _leaves_out(part: str) -> bool:
    """Whether words in front of the first statement say that something is left out: no rotation, no friction: …"""
    return _ABSENT.search(part.split("=", 1)[0]) is not None


def _kind(line: str) -> str | None:
    """Whether a line begins as a check or a case."""
    head = line.split("=", 1)[0] if ":" not in line else line.split(":", 1)[0].split("=", 1)[0]
    words = [w.lower() for w in _WORD.findall(head)][:_FIRST]
    if CASES & set(words) or _DEVIATION.match(line):
        return "case"
    of_frequencies = bool(FREQUENCIES & set(words)) and set(words) <= BESIDE_FREQUENCIES and not moves(line)
    return "check" if CHECKS & set(words) or of_frequencies else None


def _sentences(lines: Sequence[str], k: int, starts: Sequence[int], known: Callable[[str], bool]) -> Iterator[_Remark]:
    """The sentences of a line that hold only under a condition, each with the line below if it goes on there."""
    line = lines[k]
    plain = _plain(line)
    if not any(x in plain for x in ("=", "→", "->", "≪", "≫")):
        return
    ends = [*(m.end() for m in _ENDS.finditer(line)), len(line)]
    start = 0
    for end in ends:
        part = line[start:end]
        led = _LABEL.match(part) is not None or _LABEL_IN_WORDS.match(part) is not None
        case = bool(part.strip()) and _is_case(part, known, led=led)
        kind = _kind(part) if start and ":" in part and "=" in part else None  # one that begins a line is taken above
        case = (
            case
            or _is_condition(part)
            or _ELSEWHERE.search(part) is not None
            or kind == "case"
            or (kind is not None and _leaves_out(part))
        )
        lacks = not case and _LACKS.match(part) is not None
        if case or kind or lacks or _HELD.match(part):
            last = k
            if end == len(line) and not _ENDS.search(line) and not _rest_states(part) and k + 1 < len(lines):
                last = k + 1
            yield _Remark(
                starts[k] + start, starts[k] + end if last == k else starts[last] + len(lines[last]), case, lacks
            )
        start = end


def _is_condition(part: str) -> bool:
    """Whether a sentence begins with if, and states nothing but its condition: if A = B, both motions are apart."""
    told = _IF.match(part)
    return told is not None and "=" in told["said"] and not accelerates_in(part)


def _rest_states(part: str) -> bool:
    """Whether a sentence has another equals sign than those of its conditions."""
    return "=" in _RELATION.sub(" ", _plain(part))


def _plain(line: str) -> str:
    """A line without the marks of LaTeX and Markdown, of the same length."""
    if "\\" not in line:
        return line.translate(_BLANK)
    return _TEX.sub(lambda m: _SIGNS.get(m.group()[1:], " ").ljust(len(m.group())), line)


def _is_case(part: str, known: Callable[[str], bool], *, led: bool) -> bool:
    """Whether a part of a text holds under a condition, x = 0 or M → ∞; ``led``: it needs no word in front of it."""
    plain = _plain(part)
    for match in _RELATION.finditer(plain):
        names = [match["left"], *re.findall(_NAME, match["chain"])]
        if not all(known(undotted(x.rstrip("'’′"))[0]) for x in names) or not _is_special(match, known):
            continue
        if not match["right"].isdigit() and _goes_on(plain, match.end(), known):
            continue
        before = plain[max(0, match.start() - 80) : match.start()]
        if (led or match["left"] == "t") and _begins(before, known):
            return True
        cues = list(_CUE.finditer(before))
        if cues and not _TERM.search(_RELATION.sub(" ", before[cues[-1].end() :])):
            return True
    return False


def _goes_on(plain: str, end: int, known: Callable[[str], bool]) -> bool:
    """Whether a value is part of a sum or a product: s = x - R theta, phi'' = F r."""
    word = _NEXT.match(plain, end)
    return _GOES_ON.match(plain, end) is not None or (word is not None and known(undotted(word["name"])[0]))


def _begins(before: str, known: Callable[[str], bool]) -> bool:
    """Whether a statement begins behind a text: it is empty, or ends in a mark or a word."""
    before = before.rstrip(" \t")
    word = _LAST.search(before)
    return (
        not before
        or before[-1] in ",;:(.$`*\n⇒"
        or (word is not None and not known(word.group()) and function_of(word.group()) is None)
    )


def _is_special(match: re.Match[str], known: Callable[[str], bool]) -> bool:
    """Whether a relation is no value of a parameter and no other name of a coordinate: x = 0, m1 = m2, φ' = W."""
    right = match["right"].rstrip("'’′")
    if match["sign"] not in ("=", "≡") or right in ("0", "∞", "pi", "π"):
        return True
    moves = match["left"][-1:] in "'’′"
    return moves or (not right[:1].isdigit() and known(right) and right != match["left"])


def told_remarks(lines: Sequence[int]) -> list[str]:
    """What to say about lines with remarks that were left out."""
    return [f"Line {k} was not judged: it is a remark beside the equations." for k in lines[:MOST_TOLD]]
