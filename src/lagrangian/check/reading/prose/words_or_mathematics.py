"""Tells words from mathematics in plain text: headings, remarks in brackets, words before a statement."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.markup import before_factor, blank
from lagrangian.check.reading.name_patterns import BARE_NAME, RATE_OR_NAME, WORD_LETTER
from lagrangian.check.reading.prose.words import Words, function_of

_REMARK = re.compile(r"(?<!\S)\(([^\W\d_][^()=+*/^\n]*)\)")
_RELATIVE = re.compile(
    r"^[ \t]*+(?P<name>[^\W\d]\w{0,23}+)[ \t]*+"
    r"\((?:(?:rel|w\.r\.t)\.|(?:rel|relativ|relative|relatif|wrt|gegenüber|seen)\b)[^()=+*/^\n]{0,60}\)[ \t]*+=[^\n]*",
    re.MULTILINE | re.IGNORECASE,
)
"""A quantity that is counted from something else than the one of the same name: v_disc (rel. to the cart) = …"""
_ON_THE_LEFT = re.compile(r"^[ \t]*+([^\W\d]\w{0,23}+)(?:\^2|²)?[ \t]*+=", re.MULTILINE)
_MATHEMATICS = re.compile(r"\s[-−]\s|['′]{1,2}(?:\s|$)")
_IDENTIFIER = re.compile(BARE_NAME)
_WORD = re.compile(rf"{WORD_LETTER}+(?:['’-]{WORD_LETTER}+)*")
_TWO = re.compile(r"(?<!\w)([^\W\d_]{2,})(?=[ \t]([^\W\d_]{2,})(?![\w'’′(\[]))")
_BRACKETS = re.compile(r"[()\n]")
_SENTENCE = re.compile(
    rf"\s*(?P<who>(?:I|[Ww]e|[Ii]ch|[Ww]ir)[ \t]+)?(?P<first>{WORD_LETTER}{{3,}})"
    rf"(?:[ \t]*[,:;]|[ \t]+(?P<second>{WORD_LETTER}{{2,}})(?![\w(\[]))"
)
_INSIDE = re.compile(
    r"\((?:(?:with|where|mit|wobei|let|and|so|denn|because|also|da)\b|i\.e\.|d\.h\.|\s|,)*"
    r"[^\W\d]\w*+['′²]*+\s*+=(?!=)[^=]"
)
_REASON = re.compile(
    r"\(\s*+(?P<why>using|use|since|because|recall|note|by|weil|da|denn|car|times|multiplied|divided|mal|geteilt)\b",
    re.I,
)
"""How a bracket begins that says why, with an identity, or what was done: (using 2 cos² = 1 + cos 2φ), (times r²)."""
_EQUAL = re.compile(r"=(?![=>])")
_BEHIND = re.compile(r"[ \t]*(?:[.,;:!)]|\n|\Z)")
"""What stands behind a bracket that is no factor."""
_GAP = re.compile(r"(?<=\S)[ ]{2,}\Z|\t[ \t]*\Z")
_LINE_END = re.compile(r"[ \t]*[.,;]?[ \t]*(?:\n|\Z)")
_FIRST_WORD = re.compile(rf"[ \t]*({WORD_LETTER}{{5,24}})(?![\w'’′(\[])")
"""A word with which a remark in brackets begins; names of so many letters are rare."""
_ONE = rf"{WORD_LETTER}+(?:['’-]{WORD_LETTER}+)*"
_LEADING = re.compile(rf"\s*((?:{_ONE}[.,:]?\s+)+)(?=\S)")
_LAST = re.compile(rf"(?:(?<=\s)|(?<=[,;]))({_ONE})[.,;:!]*\s*\Z")
_DEFINES = re.compile(
    rf"\s*+(?P<words>(?:(?:[^\W_]|(?<=\w)[’'-](?=\w)){{1,20}}+[.,]?[ \t]++(?!=)){{1,16}}+)(?P<name>{RATE_OR_NAME})"
    r"\s*+=(?![=>])"
)
"""A name that is given a value behind words alone."""
_SAYING = frozenset(["get", "got", "find", "found", "obtain", "obtained", "have", "see", "write", "use", "arrive"])
"""What may follow I: with s = R θ I get."""
_ARTICLES = frozenset(["I", "a"])
"""Letters that are words between words."""
CHANGING = frozenset(
    ["twice", "half", "double", "triple", "minus", "negative", "times", "halb", "halbe", "doppelt", "doppelte", "mal"]
)
"""Words that change the value of what stands behind them, and are not left out in silence."""
ADDING = CHANGING | {"plus"}
"""Also the word that adds something, which makes part of a label: springs plus weight."""
_OFTEN, _DERIVES = "twice|once|zweimal|deux fois", "differentiated?|derived|abgeleitet|differenziert|dérivée?"
_DERIVED = re.compile(
    rf"\b(?:{_OFTEN})\s++(?:{_DERIVES})\b|\b(?:{_DERIVES})\s++(?:{_OFTEN})\b",
    re.IGNORECASE,
)
"""Words that say how often a statement was differentiated, not what its value is multiplied by."""
_EXPLAINED = re.compile(r"(?<=[\w)\]'’′″²³])\s*:\s+([^\W\d_][^=:+*/^]*)\Z")
"""What a definition means: ψ = θ − β : angle between pendulum and normal."""
_ASIDE = re.compile(r"(?<=[\w)\]'’′″²³])[ \t]{2,}((?:[^\W\d_]{1,24}[ \t]){2,16}[^\W\d_]{1,24})[.,;:!]?\s*\Z")
"""Words alone behind a gap: ρ = e + l sin θ      distance of a ball from the axis."""
_ENDS = re.compile(r"[\w\u0307\u0308)\]'’′″²³¹½]\s*+[.,;:]?\s*+\Z")
_PARTS = re.compile(r"['’-]")
_NUMBER_ALONE = re.compile(r"\s*+[(\[]?\s*+\d{0,3}[a-z]?\s*+[)\]]?\s*+[.,;:]?\s*+\Z")
_TITLE = re.compile(r"\s*\d{1,2}[.):]?\s+[^\W\d_]{4,}\s*\Z")
_RATE = re.compile(r"[\w)\]]['’′″\"]|[\u0307\u0308\u20db˙¨ẋẍẏÿżṙṁ]|\bd\w*/d|\w_?d?dot\b|\bdd?ot\b|\bdiff\b|\bDeriv")
_OPENS = re.compile(r"[(\[\d]")
_SINGLE = re.compile(r"\s*[^\W\d_]+[.,:]?\s*\Z")
_LISTED = (
    "the is are of for we with that this these as get gets gives obtain find finds have has so and then "
    "thus hence where let therefore since because both every equation equations motion energy kinetic "
    "potential coordinate coordinates first second becomes follows which yields now finally using from by "
    "in at on to reads be holds respectively "
    "die der das ist sind lautet lauten gilt folgt ergibt sich also daraus damit somit mit wobei und für "
    "wird dann nun aus dem den des eine einer bzw sowie nach erhält gleichung bewegungsgleichung "
    "est sont avec donc alors où obtient équation "
    "my our it if as an or by your its no not do zu im de la le"
)
LINKING = frozenset(_LISTED.split())
"""Words of English, German and French that are seldom names."""
ARTICLES = frozenset(["la", "le"])
"""Those of them that are names where they are used as such: 2 la (x1 - x2)."""

_MOST = 40
"""The largest number of words behind a statement."""

MOST_NAMES = 2
"""More words than this in a bracket without an equals sign make it a remark."""

_SHORTEST = 3
"""The fewest letters of a word that cannot be a name."""


def _apart(text: str) -> Iterator[tuple[int, int]]:
    """The places of the outermost brackets that open behind a blank and are closed on the same line."""
    opened: list[int] = []
    for match in _BRACKETS.finditer(text):
        mark, at = match.group(), match.start()
        if mark == "(":
            opened.append(at)
        elif mark == "\n":
            opened.clear()
        elif opened and mark == ")":
            start = opened.pop()
            if not opened and (start == 0 or text[start - 1].isspace()):
                yield start, at


_MEANT = re.compile(
    r"(?<=[\w)\]'’′″²³])[ \t]+(?:is|are|being|denotes?|bezeichnet|ist|est)[ \t]+"
    r"(?:the|an?|our|its|their|das|der|die|le|la)[ \t][^=\n]{0,300}\Z"
)
"""What a value is: M_s = k (φ2 - φ1) is the torque of the shaft."""


def stated_remarks(text: str) -> str:
    """Return an answer in which statements in brackets stand alone: … = 0 (with c = cos θ)."""
    letters = list(text)
    for start, end in _apart(text):
        if _states(text, start, end):
            letters[start] = letters[end] = ";"
            if text[end - 1] == "!":  # (Ω̇ = 0!)
                letters[end - 1] = " "
            if text[end + 1 : end + 2] == ":":  # drum (psi = phi/n): J psi'' = …
                letters[end + 1] = " "
    return "".join(letters)


def _states(text: str, start: int, end: int) -> bool:
    """Whether a bracket says something: it has an equals sign, and is neither a factor nor a side."""
    if _INSIDE.search(text, start, end):
        return True
    if _REASON.match(text, start) is not None:
        return False
    return _EQUAL.search(text, start, end) is not None and _BEHIND.match(text, end + 1) is not None


def without_remarks(text: str, words: Words) -> str:
    """Return an answer without words in brackets: T (kinetic), u = y + l θ (front end)."""
    text = _without_other_quantities(text, words)
    for match in reversed(list(_REMARK.finditer(text))):
        listed = _WORD.findall(match[1])
        if _MATHEMATICS.search(match[1]) or any(words.known(x) for x in _IDENTIFIER.findall(match[1]) if len(x) > 2):
            continue
        if any(is_word(x, words) for x in listed) and not any(len(x) > 2 and words.is_name(x) for x in listed):
            text = blank(text, match.start(), match.end())
    return _without_comments(text, words)


def _without_other_quantities(text: str, words: Words) -> str:
    """Return an answer without what a quantity is from elsewhere, as a note tells, if it is stated without that, too:
    v (rel. to the cart) = l θ', v² = …"""
    again = set(_ON_THE_LEFT.findall(text))
    for match in list(_RELATIVE.finditer(text)):
        if match["name"] in again and not words.names.known(match["name"]):
            told = f"'{' '.join(match.group().split())}' was not judged"
            words.names.notes.setdefault(f"{told}: {match['name']} is another quantity elsewhere.")
            text = blank(text, *match.span())
    return text


def _without_comments(text: str, words: Words) -> str:
    """Return an answer without sentences in brackets behind a statement, which may hold mathematics, as a note tells:
    J_b = … (bar about the pivot, the same as m L²/3)."""
    for start, end in _apart(text):
        behind = start > 0 and "=" not in text[start:end] and _BEHIND.match(text, end + 1) is not None
        inside = text[start + 1 : end]
        said = behind and (_says(inside, words) or _speaks(inside, words) or _is_far(text, start, end, words))
        if said or _reasons(text, start, words):
            if re.search(r"[\d=+*/^'’′²³×·()]", inside) or any(map(words.is_name, _WORD.findall(inside))):
                told = " ".join(text[start : end + 1].split())
                words.names.notes.setdefault(f"'{told}' was not judged: it is a remark.")
            text = blank(text, start, end + 1)
    return text


def _is_far(text: str, start: int, end: int, words: Words) -> bool:
    """Whether brackets behind a gap at the end of a line begin with a word, as no factor does that has a meaning:
    D = J + m x²   (determinant / m)."""
    if _GAP.search(text, max(0, start - 3), start) is None or _LINE_END.match(text, end + 1) is None:
        return False
    first = _FIRST_WORD.match(text, start + 1)
    if first is None or first[1].lower() in ADDING or moves(text[start:end]) or function_of(first[1]) is not None:
        return False
    return words.count(first[1]) == 1 and not words.known(first[1]) and not words.is_product(first[1])


def _reasons(text: str, start: int, words: Words) -> bool:
    """Whether a bracket says why, or what was done, and does not begin with a product: (mal cos θ + m l²)."""
    match = _REASON.match(text, start)
    return match is not None and not words.is_product(match["why"])


def _says(inside: str, words: Words) -> bool:
    """Whether what stands in brackets begins with a word that is no name, and another or a comma behind it."""
    match = _SENTENCE.match(inside)
    if match is None or match["first"].lower() in CHANGING or not is_word(match["first"], words):
        return False
    if match["who"] or match["second"] is None:
        return True
    return is_common(match["second"], words) or is_word(match["second"], words)


def _speaks(inside: str, words: Words) -> bool:
    """Whether what stands in brackets is mostly words: (J about the centre of mass, so J + m l^2 about the pivot)."""
    listed = _WORD.findall(inside)
    said = sum(is_common(x, words) or is_word(x, words) for x in listed)
    return said > MOST_NAMES and not moves(inside) and not any(x.lower() in CHANGING for x in listed)


def without_lead(text: str, words: Words) -> str:
    """Return a statement without the words in front of it: absolute displacements x1 = w1 + s."""
    match = _LEADING.match(text)
    if (said := _DEFINES.match(text)) is not None and _introduces(said, words):
        return blank(text, 0, before_factor(text, said.start("name")))
    if match is None:
        return text
    stated = "=" in text
    end, spoken = match.start(1), False
    for word in re.finditer(r"\S+\s+", match[1]):
        written = word.group().strip(" \t,:.")
        first = stated and end == match.start(1) + word.start()
        said = first and written == "I" and _spoken(match[1][word.end() :].split(maxsplit=1)[:1], words)
        own = first and is_word(written, words)
        common = spoken and len(written) > 1 and written.lower() in LINKING  # put this in …, where in is no i n
        ended = first and word.group().rstrip()[-1:] in ",:" and written.islower() and _is_new(written, words)
        if is_common(written, words) or said or common or own or (ended and len(written) > 1):  # is wound up, u = R φ
            end = match.start(1) + word.end()
        spoken = own and end == match.start(1) + word.end() and word.group().rstrip()[-1:] not in ".,:"
    changed = stated and any(x.strip(",:.").lower() in CHANGING for x in text[:end].split())
    changed = changed and _DERIVED.search(text, 0, end) is None
    return blank(text, 0, end) if end > match.start(1) and not changed else text


def _spoken(listed: Sequence[str], words: Words) -> bool:
    """Whether what stands behind I is a word: I used …"""
    return any(is_word(x.strip(",:."), words) or is_common(x, words) for x in listed)


def _introduces(said: re.Match[str], words: Words) -> bool:
    """Whether what stands in front of a name that is given a value is a sentence: I prefer the distance X = a + x."""
    name = said["name"].rstrip("'’′″²^2")
    if is_word(name, words) and words.count(name) == 1:
        return False  # one side consists of words
    listed = [x.strip(".,") for x in said["words"].split()]
    if any(x.lower() in CHANGING and not _describes(listed[k + 1 :], words) for k, x in enumerate(listed)):
        return False
    plain = [x.isdigit() or is_common(x, words) or is_word(x, words) or x.lower() in CHANGING for x in listed]
    short = [x in _ARTICLES or (1 < len(x) < _SHORTEST and x.islower() and _is_new(x, words)) for x in listed]
    between = [x and any(plain[max(0, k - 1) : k + 2]) for k, x in enumerate(short)]
    return any(not x.isdigit() and is_word(x, words) for x in listed) and all(
        a or b for a, b in zip(plain, between, strict=True)
    )


def _is_new(written: str, words: Words) -> bool:
    """Whether neither the system nor the answer has a name, and it is no product of names."""
    return not words.known(written) and not words.is_product(written)


def _describes(after: Sequence[str], words: Words) -> bool:
    """Whether a changing word belongs to a noun, half length a = L/2, and not to a value, half the length a."""
    return bool(after) and not is_common(after[0], words) and is_word(after[0], words)


def without_tail(text: str, words: Words, *, led: bool = False) -> str:
    """Return a statement without the words behind it: s = r - l holds, φ = π/2 − θ be the angle from the top.

    ``led``: there were words in front, too, so that a single one may be behind: since r = R always.
    """
    if "=" not in text:
        return text
    if (meant := _MEANT.search(text)) is not None and "=" in text[: meant.start()]:
        text = blank(text, meant.start(), len(text))
    if (said := _EXPLAINED.search(text)) is not None and _explains(said[1], words):
        text = blank(text, said.start(), len(text))
    if (said := _ASIDE.search(text)) is not None:  # "the" is a word, though letters of the system may spell it
        spoken = [is_word(x, words) or (len(x) > 1 and x.lower() in LINKING) for x in said[1].split()]
        text = blank(text, said.start(), len(text)) if 2 * sum(spoken) > len(spoken) else text
    end, count, linked, below = len(text), 0, False, ""
    while count < _MOST and (match := _LAST.search(text, max(0, end - 80), end)) is not None:
        links = is_common(match[1], words)
        if (
            not links
            and not is_word(match[1], words)
            and not (match[1] == "I" and below in _SAYING)
            and not _is_letter(text[:end], match[1], words, inside=count > 0)
        ):
            break
        end, count, linked, below = match.start(1), count + 1, linked or links, match[1].lower()
    if below in ADDING:
        return text  # … = F plus the friction
    apart = count == 1 and text[max(0, end - 2) : end].isspace()  # D = …   Rayleigh
    if count < (1 if linked or apart or led else 2) or not _ENDS.search(text[:end]):
        return text
    return blank(text, end, len(text))


def _is_letter(text: str, last: str, words: Words, *, inside: bool) -> bool:
    """Whether the letter that ends a text is no name: a point behind a word, about A, or an article between words."""
    point = len(last) == 1 and last.isupper() and not words.known(last)
    if not point and not (inside and last in _ARTICLES):
        return False
    found = _LAST.search(text[-80:].rstrip(" .,;:!")[: -len(last)])
    return found is not None and (is_common(found[1], words) or is_word(found[1], words))


def _explains(said: str, words: Words) -> bool:
    """Whether words explain what stands before them: they begin with a word that is no name."""
    listed = _WORD.findall(said)
    return bool(listed) and (is_word(listed[0], words) or (is_common(listed[0], words) and len(listed) > 1))


def is_common(written: str, words: Words) -> bool:
    """Whether this is a common word of English, German or French, and no name of the system or of the answer."""
    return written.lower() in LINKING and not words.is_name(written) and not words.is_product(written)


def is_prose(text: str, words: Words) -> bool:
    """Whether a row without an equals sign is no expression: it contains a word, or only a number."""
    if "=" in text or re.search(r"\bEq\w*\s*[(\[]", text):
        return False
    if _NUMBER_ALONE.match(text) or _SINGLE.match(text) or _TITLE.match(text):
        return True
    named = [m.group() for m in _WORD.finditer(text) if not _OPENS.match(text, m.end())]
    return any(is_word(x, words) for x in named) or not any(map(words.known, _IDENTIFIER.findall(text)))


def is_sentence(text: str, words: Words) -> bool:
    """Whether a line without an equals sign is mostly words, so that no equation goes on behind it."""
    listed = _WORD.findall(text)
    said = sum(is_common(x, words) or is_word(x, words) for x in listed)
    return "=" not in text and said > MOST_NAMES and 2 * said > len(listed)


def moves(text: str) -> bool:
    """Whether a rate or an acceleration stands in a text."""
    return _RATE.search(text) is not None


_BY_TIME = re.compile(r"(?<!\w)d[ ]?/[ ]?dt(?!\w)")


def is_statement(text: str, words: Words) -> bool:
    """Whether a row has two sides, which consist of names and numbers, and d/dt of these."""
    named = _IDENTIFIER.findall(_BY_TIME.sub(" ", text))
    both = all(side.strip() for side in text.split("=")) and "=" in text
    return both and bool(named) and all(words.readable(x) or words.is_product(x) for x in named)


def has_words(text: str, words: Words) -> bool:
    """Whether two words that are no names stand next to each other, one a common one: = sum of inertias × φ''."""
    for match in _TWO.finditer(text):
        pair = match.groups()
        if any(is_common(x, words) for x in pair) and any(is_word(x, words) for x in pair):
            return True
    return False


def in_words(text: str, words: Words) -> bool:
    """Whether a side of a statement consists of words alone: f = tooth force * radius."""
    sides = text.split("=")
    listed = [_IDENTIFIER.findall(side) for side in sides]
    told = any(
        _TWO.search(side) is not None
        and all(len(x) >= _SHORTEST and x.isalpha() and not words.names.known(x) and not function_of(x) for x in named)
        for side, named in zip(sides, listed, strict=True)
    )
    own = any(words.names.known(x) for named in listed for x in named)
    return len(sides) > 1 and told and not own


def is_word(written: str, words: Words) -> bool:
    """Whether this is a word and no name: long enough, and nothing that the system or the answer has."""
    parts = _PARTS.split(written)
    return any(
        len(x) >= _SHORTEST and not words.readable(x) and not words.is_product(x) and not words.names.known(x)
        for x in parts
    )
