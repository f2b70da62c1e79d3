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

RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
"""The digits and signs that stand for raised ones."""
LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
"""The digits that stand for lowered ones."""
OF_CHAPTER = r"(?:[IVX]{1,4}|[A-Z])\.\s?\d{1,2}[a-z]?"
"""The number of an equation in a chapter: IV.2, A.3b."""
