"""Reads in which sense an answer counts a force of its own: H to the right, λ (uphill on the wagon), N: upward."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import TypeAlias

from lagrangian.read.letters import key

Sense: TypeAlias = tuple[str, str, str]
"""The name of a force, the way in which it is positive, and the word for what it acts on, or nothing."""

MOST = 40
"""The most places at which a name is looked for."""
WINDOW = 110
"""The number of characters behind a name among which the way is."""

_UP_A = r"(?:the[ ]|an?[ ])?(?:slope|incline|plane|hill|ramp|track|guide|wall)"
_ALONE = r"(?:(?<=[(])|(?<=,[ ])|(?<=positive[ ])|(?<=points[ ])|(?<=pointing[ ])|(?<=counted[ ])|(?<=grows[ ]))"
_END_OF = r"(?=[ ]on\b|[ \t]{0,3}(?:[,;:.)]|$))"
WAYS = {
    "right": r"(?:to|towards?)[ ]the[ ]right|rightwards?|nach[ ]rechts|(?:vers[ ]la|à)[ ]droite",
    "left": r"(?:to|towards?)[ ]the[ ]left|leftwards?|nach[ ]links|(?:vers[ ]la|à)[ ]gauche",
    "up": rf"uphill|upwards?|up[ ]{_UP_A}|hangaufwärts|bergauf|nach[ ]oben|vers[ ]le[ ]haut|{_ALONE}up{_END_OF}",
    "down": rf"downhill|downwards?|down[ ]{_UP_A}|hangabwärts|bergab|nach[ ]unten|vers[ ]le[ ]bas"
    rf"|{_ALONE}down{_END_OF}",
    "ahead": r"forwards?|vorwärts|nach[ ]vorne?",
    "back": r"backwards?|rückwärts|nach[ ]hinten",
    "starboard": r"to[ ]starboard",
    "port": r"to[ ]port",
    "counterclockwise": r"(?:counter|anti)[ -]?clockwise|gegen[ ]den[ ]uhrzeigersinn",
    "clockwise": r"clockwise|im[ ]uhrzeigersinn",
}
OPPOSITE = {"right": "left", "up": "down", "ahead": "back", "starboard": "port", "clockwise": "counterclockwise"}
OPPOSITE |= {b: a for a, b in OPPOSITE.items()}
_WAY = re.compile(r"(?<![\w-])(?:" + "|".join(f"(?P<{k}>{x})" for k, x in WAYS.items()) + r")(?!\w)", re.IGNORECASE)
_PIECES = "ght echt left nks up auf oben down ab nten for vor back rück star port clock uhr droite gauche haut bas"
_CUES = frozenset(_PIECES.split())
"""Pieces of the ways, in small letters, of which one stands wherever a way is named."""
_TOKEN = re.compile(r"(?<![\w\\])\\?(?P<name>[^\W\d]\w{0,23}+)")
_END = re.compile(r"\n|;|[.!?](?=\s|$)")
_BEGINS = re.compile(r"[\s$`*_{}\\]*+(?:(?:=|:|\(|,|-{1,2}|–|—)[\s$`*]*+)?+")
_WORDS = re.compile(r"[^\W\d_]++(?:[-' ,:()]{1,3}[^\W\d_]++)*+[-' ,:()]{0,3}")
_OTHERWISE = re.compile(
    r"\b(?:not|no|if|when|while|where|against|opposite|opposed|minus|nicht|wenn|gegen|\w*(?:mov|roll|turn|driv|runn|go)"
    r"(?:es?|s|ing)|\w*rollt|bewegt)\b",
    re.IGNORECASE,
)
_ON = re.compile(r"\b(?:on|auf)[ ](?:the[ ]|an?[ ]|de[nrm][ ]|die[ ]|das[ ])?(?P<body>[^\W\d_]{2,24}+)", re.IGNORECASE)


def ways_in(words: str) -> set[str]:
    """The ways that words name: right, left, up, down, …"""
    return {str(m.lastgroup) for m in islice(_WAY.finditer(words), MOST)}


def stated_senses(text: str, names: Sequence[str]) -> frozenset[Sense]:
    """What sentences and brackets behind some names say of the sense in which these are positive."""
    own = {key(name): name for name in names}
    places = ((own[key(m["name"])], m.end()) for m in _TOKEN.finditer(text) if key(m["name"]) in own)
    return frozenset(sense for name, end in islice(places, MOST) for sense in _behind(text[end : end + WINDOW], name))


def _behind(text: str, name: str) -> Iterator[Sense]:
    """The sense that the words right behind a name state, up to the end of their sentence."""
    begin = _BEGINS.match(text)
    start = begin.end() if begin is not None else 0
    stop = _END.search(text, start)
    said = text[start : stop.start() if stop is not None else len(text)]
    if not any(map(said.casefold().__contains__, _CUES)) or (way := _WAY.search(said)) is None:
        return
    between = said[: way.start()]
    if between and (_WORDS.fullmatch(between) is None or _OTHERWISE.search(between) or _has_letter(between)):
        return
    after = said[way.end() :].partition(")")[0]
    ons = [*_ON.finditer(between)][-1:] or [*_ON.finditer(after)][:1]
    yield name, str(way.lastgroup), ons[0]["body"].lower() if ons else ""


def _has_letter(words: str) -> bool:
    """Whether another name, a single letter, stands among words: H and N be the force on the horse (H to the right."""
    return any(len(x) == 1 and x not in "aA" for x in re.findall(r"\w+", words))
