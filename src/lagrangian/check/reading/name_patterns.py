"""What names look like in answers, for all that looks for them with regular expressions."""

from __future__ import annotations

LETTER = r"[^\W\d⁰¹²³⁴-⁹₀-₉¼½¾⅐-⅞]"
"""What a name begins with: a letter or _."""
INNER = r"[^\W⁰¹²³⁴-⁹¼½¾⅐-⅞]"
"""What a name goes on with: a letter, a digit, _ or an index, ₁; a raised digit is a power."""
WORD_LETTER = r"[^\W\d_⁰¹²³⁴-⁹₀-₉¼½¾⅐-⅞]"
"""A letter of a word."""
DOTS = r"[\u0307\u0308\u20db\u20dc]"
"""Dots above a letter, which are characters of their own."""
NAME = rf"{LETTER}{DOTS}*(?:{INNER}{DOTS}*)*"
"""A name, perhaps with dots."""
BARE_NAME = rf"{LETTER}{INNER}*+"
"""A name without dots."""
RATE_OR_NAME = rf"{LETTER}(?>{INNER}*)['’′″]{{0,3}}(?:\^2|²)?"
"""A name, a rate of it, or the square of either."""
IDENT = r"[^\W\d]\w{0,39}+"
"""A name as programs have it."""

CALLED_SO = (
    r"(?:(?:which|that|what|this)[ ]|and[ ]|,[ ]?|;[ ]?|\([ ]?|[–—-][ ])(?:(?:I|we)[ ](?:will[ ]|shall[ ])?(?:call|name"
    r"|denote|abbreviate)(?:[ ](?:it|this|that|by|as|with)){0,2}|(?:let(?:'s|[ ]us|[ ]me)[ ])?call(?:ed|ing)?"
    r"(?:[ ](?:it|this|that))?"
    r"|(?:abbreviated|denoted|named|genannt|kurz|for[ ]short|in[ ]short)(?:[ ](?:as|by|with|it))?"
    r"|is[ ](?:called|denoted[ ]by)|(?:ich|wir)(?:[ ]mit)?)[ ]"
)
"""Words behind a formula and in front of the name that it is given."""
CALLED_AFTER = r"(?:[ ](?:nenne|nennen|bezeichne|bezeichnen|for[ ]short|from[ ]now[ ]on|below))?[ ]?\)?"
"""Words behind such a name."""

RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
"""The digits and signs that stand for raised ones."""
LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
"""The digits that stand for lowered ones."""
OF_CHAPTER = r"(?:[IVX]{1,4}|[A-Z])\.\s?\d{1,2}[a-z]?"
"""The number of an equation in a chapter: IV.2, A.3b."""

_ADDED = r"(?:(?:just|only|simply|here|now|the|an?|my|our|nur|einfach|hier|die|eine|der)[ \t]){0,2}"
MEANS = (
    rf"(?:(?:(?:is|be|being|ist|sei)[ \t]|,[ \t])?{_ADDED}"
    r"(?:short(?:[ -]?hand)?|abbreviation|(?<=[ \t])(?:used|written)|kurz(?:form)?|abkürzung)[ \t](?:for|of|für|von)"
    r"|(?:is|be|being|ist|sei)[ \t](?:the[ \t](?:sum|total|product)|die[ \t]Summe|just|only|simply|einfach|nur)"
    r"(?:[ \t](?:of|von))?"
    r"|is|be|being|means|denotes|abbreviates|equals|stands[ \t]for|ist|sei|bezeichnet|bedeutet|steht[ \t]für)"
)
"""Words between a name and the formula that it stands for: is short for, stands for, is the sum."""
