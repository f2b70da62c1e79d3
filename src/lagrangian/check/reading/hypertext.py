"""Answers copied from a web page: x<sub>1</sub>'<sup>2</sup> &minus; &theta; as x_1'^2 − θ.

<sup>1</sup>/<sub>2</sub> <i>m</i>, with nothing that is raised, is the fraction (1)/(2) m.
"""

from __future__ import annotations

import html
import re
from html.entities import html5

from lagrangian.check.reading.traced_text import TracedText

_TAGS = "p|sub|sup|br|i|b|em|strong|u|div|span|var|math|td|tr|th|table|tbody|thead|ul|ol|li|h[1-6]|pre|code|html|body"
_UNQUOTED = "align|valign|width|height|class|id|style|colspan|rowspan|border|clear"
_VALUE = r"""(?:"[^"<>\n]{0,200}"|'[^'<>\n]{0,200}')"""
_ATTRIBUTES = rf"(?:\s{{1,20}}(?:[a-z][\w:.-]{{0,40}}={_VALUE}|(?:{_UNQUOTED})=[^\s\"'<>=]{{1,100}})){{0,20}}"
"""name="value"; without quotation marks only after a name that mathematics does not have."""
_LETTER_TAG = re.compile(rf"<(?P<close>/?)(?P<tag>i|b|em|strong|u|span|var){_ATTRIBUTES}\s?>", re.IGNORECASE)
_TAG = re.compile(rf"<(?P<close>/?)(?P<tag>{_TAGS}){_ATTRIBUTES}\s?/?>", re.IGNORECASE)
_COMMENT = re.compile(r"<!--(?:(?!-->).){0,2000}-->", re.DOTALL)
_RAISED = re.compile(rf"<(?P<tag>su[bp]){_ATTRIBUTES}\s?>(?P<inside>[^<>]{{1,200}})</(?P=tag)\s?>", re.IGNORECASE)
_FRACTION = re.compile(
    r"(?<![\w)\]'’′″\u0300-\u036f])(?<!</sub>)<sup>(?P<above>[^<>]{1,60})</sup>\s?(?:[/⁄]|&frasl;)\s?"
    r"<sub>(?P<below>[^<>]{1,60})</sub>",
    re.IGNORECASE,
)
_ENTITY = re.compile(r"&(?:#(?:[xX][0-9A-Fa-f]{1,6}|[0-9]{1,7})|[A-Za-z][A-Za-z0-9]{1,31});")
_MARK = re.compile(r"d{0,3}dot|prime")
"""Words for a rate, which belong to the name: x<sub>1</sub>ddot."""
_SHORT = re.compile(r"\w+\Z")
_ROWS = frozenset(["p", "br", "div", "tr", "li", "table", "pre", "h1", "h2", "h3", "h4", "h5", "h6", "ul", "ol"])
_LETTERS = frozenset("biu")
_PARTS = frozenset(["td", "th"])


_PARAGRAPH = re.compile(
    r"<p(?:[ \t][^<>\n]{0,200})?>[^<]*(?:<(?!/?(?:p|pre|br|div|table|ul|ol)\b)[^<]*)*</p>", re.IGNORECASE
)
"""A paragraph, in which the end of a line means nothing."""


def without_tags(written: TracedText) -> TracedText:
    """Return an answer without tags and entities of HTML; each paragraph is a line."""
    if "<" in written.text and ">" in written.text:
        written = written.sub(_COMMENT, lambda match: " ")
        written = written.sub(_PARAGRAPH, lambda match: match.group().replace("\n", " "))
        written = written.sub(_LETTER_TAG, _tag).sub(_FRACTION, lambda m: f"(({m['above']})/({m['below']}))")
        written = written.sub(_RAISED, _raised).sub(_TAG, _tag)
    return written.sub(_ENTITY, _character) if "&" in written.text else written


def _raised(match: re.Match[str]) -> str:
    """x<sup>2</sup> as x^2, e<sup>-t</sup> as e^(-t), and m<sub>2</sub>s as m_2 s: a letter behind is another name."""
    inside = html.unescape(match["inside"]).strip()
    mark = "_" if match["tag"].lower() == "sub" else "^"
    if not inside or (mark == "^" and set(inside) <= set("'’′″")):
        return inside
    entity = _ENTITY.match(match.string, match.end())
    after = html.unescape(entity.group()) if entity else match.string[match.end() : match.end() + 6]
    apart = " " if after[:1].isalnum() and not _MARK.match(after) else ""
    return f"{mark}{inside}{apart}" if _SHORT.match(inside) else f"{mark}({inside}){apart}"


def _tag(match: re.Match[str]) -> str:
    """What a tag stands for; <b>, <i> and <u> that nothing closes are letters between signs, and stay."""
    tag = match["tag"].lower()
    if tag in _LETTERS and not match["close"] and f"</{match['tag']}" not in match.string:
        return match.group()
    return "\n" if tag in _ROWS else " " if tag in _PARTS else ""


def _character(match: re.Match[str]) -> str:
    """&theta; as θ; what has no meaning in HTML stays."""
    known = match.group()[1] == "#" or match.group()[1:] in html5
    return html.unescape(match.group()) if known else match.group()
