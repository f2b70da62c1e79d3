"""Reads XML without trusting it: no document type, no entities, nothing outside the text; sizes are limited.

Every element and attribute knows its place in the text, so that every error can point at it.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_right
from collections.abc import Iterable
from typing import Any, NoReturn
from xml.parsers import expat

from lagrangian.codes import CodeText
from lagrangian.errors import ParseError, Place, did_you_mean
from lagrangian.quantities.source import printable, shown
from lagrangian.records import dataclass, field

MAX_TAGS = 50_000
"""The largest number of elements in a file."""

MAX_DEPTH = 64
"""The largest depth of elements within elements, above which a chain of MuJoCo's bodies is too deep, too."""

MAX_ATTRIBUTES = 200
"""The largest number of attributes of an element."""

MAX_TEXT = 200
"""The length of a text between tags, beyond which it is no number."""

MAX_ANGLE = 1000.0
"""The largest angle [rad] of a pose: what is far above a turn is a mistake, and its digits do not say where it ends."""

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,5})?\Z")
_SURROGATE = re.compile("[\ud800-\udfff]")


@dataclass(eq=False)
class Tag:
    """An element of the markup: its name, attributes and children in order, and ``start``, its offset in the text.

    ``text`` is what stands between its tags, if it has no children. ``seen`` are the attributes that the reader asked
    for, ``read`` whether it asked for the element at all: what it did not ask for is listed at the end, so that nothing
    is left out in silence. ``frames`` are the elements of MJCF that move it as a whole, from the outermost.
    """

    name: str
    attributes: dict[str, str]
    start: int
    file: MarkupFile = field(repr=False)
    children: list[Tag] = field(default_factory=list["Tag"], repr=False)
    seen: set[str] = field(default_factory=set[str], repr=False)
    read: bool = field(default=False, repr=False)
    text: str = field(default="", repr=False)
    frames: tuple[Tag, ...] = field(default=(), repr=False)

    @property
    def title(self) -> str:
        """The element in words: ``joint 'elbow'``, ``<origin>``."""
        name = self.attributes.get("name")
        return f"{self.name} {shown(name)}" if name else f"<{self.name}>"

    @property
    def place(self) -> Place:
        """Where it begins."""
        return self.file.place(self.start)

    def place_of(self, key: str) -> Place:
        """Where one of its attributes is written."""
        end = self.file.text.find(">", self.start)
        found = re.compile(rf"[\s'\"]{re.escape(key)}\s*=\s*").search(self.file.text, self.start, max(end, self.start))
        return self.place if found is None else self.file.place(found.end())

    def all(self, name: str) -> list[Tag]:
        """The children with a name, which count as read."""
        found = [child for child in self.children if child.name == name]
        for child in found:
            child.read = True
        return found

    def one(self, name: str) -> Tag | None:
        """The child with a name, or None; two of them are an error."""
        found = self.all(name)
        if len(found) > 1:
            raise found[1].error(f"there are two <{name}> in {self.title}", "keep one of the two", "E404")
        return found[0] if found else None

    def need(self, name: str, example: str) -> Tag:
        """The child with a name, which must exist."""
        found = self.one(name)
        if found is None:
            raise self.error(f"<{name}> is missing", f"write {example} within it", "E401")
        return found

    def get(self, key: str) -> str | None:
        """The text of an attribute, or None."""
        self.seen.add(key)
        return self.attributes.get(key)

    def word(self, key: str, example: str) -> str:
        """The text of an attribute, which must exist and not be empty."""
        value = self.get(key)
        if value is None or not value.strip():
            what = "is missing" if value is None else "is empty"
            raise self.error(f"the attribute '{key}' {what}", f'write {key}="{example}"', "E401")
        return value.strip()

    def number(self, key: str, default: float | None = None) -> float:
        """The number in an attribute; ``default`` if it is not there, or an error if there is no default."""
        value = self.get(key)
        if value is None:
            if default is None:
                raise self.error(f"the attribute '{key}' is missing", f'write {key}="a number"', "E401")
            return default
        return self._number(value.strip(), key, "one number")

    def content(self) -> float:
        """The number between the element's tags."""
        return self._number(self.text.strip(), None, "one number")

    def vector(self, key: str, default: tuple[float, ...], sizes: tuple[int, ...] = (3,)) -> tuple[float, ...]:
        """The numbers in an attribute, separated by spaces."""
        value = self.get(key)
        if value is None:
            return default
        parts = value.split()
        wanted = " or ".join(map(str, sizes)) + " numbers"
        numbers = tuple(self._number(part, key, wanted) for part in parts[: max(sizes) + 1])
        if len(parts) not in sizes:
            raise self.error(f"'{key}' has {len(parts)} entries", f"give {wanted}, separated by spaces", "E414", key)
        return numbers

    def check_angles(self, key: str, angles: Iterable[float]) -> None:
        """Raise an error if an angle [rad] in an attribute is too large for its digits to say where it ends."""
        for angle in angles:
            if abs(angle) > MAX_ANGLE:
                what = f"an angle in '{key}' is {angle:.4g} rad; at most {MAX_ANGLE:g} rad are read"
                raise self.error(what, "give it within a turn, −π to π", "E703", key)

    def _number(self, text: str, key: str | None, wanted: str) -> float:
        what = f"'{key}'" if key else f"the text of {self.title}"
        if _NUMBER.match(text) and math.isfinite(value := float(text)):
            return value
        if "$" in text:
            fix = "this is a macro of xacro: expand the file first, with the command xacro"
            raise self.error(f"{what} is {shown(text)}, which is not a number", fix, "E406", key)
        infinite = re.fullmatch(r"[+-]?(inf|infinity|nan)", text, re.IGNORECASE) or _NUMBER.match(text)
        said = f"{what} must be finite (got {shown(text)})" if infinite else f"{what} is {shown(text)}, not a number"
        raise self.error(said, f"write {wanted}, such as 0.25 or 1e-3", "E101" if infinite else "E406", key)

    def error(self, what: str, fix: str, code: CodeText, key: str | None = None) -> ParseError:
        """Return an error about this element, at the place of an attribute if one is named."""
        return ParseError(what, element=self.title, place=self.place_of(key) if key else self.place, fix=fix, code=code)

    def unknown(self, what: str, name: str, known: Any, key: str) -> NoReturn:
        """Raise the error for a name that the file does not define."""
        listed = list(known)
        fix = did_you_mean(name[:64], listed) or "known: " + (", ".join(map(str, listed[:12])) or "none")
        raise self.error(f"there is no {what} {shown(name)}", fix, "E402", key)


class MarkupFile:
    """The text of a file, and the root of its tree."""

    def __init__(self, text: str, name: str) -> None:
        self.text, self.name = text.replace("\r\n", "\n").replace("\r", "\n"), name
        self._lines = [0, *(m.end() for m in re.finditer("\n", self.text))]
        self._shown: dict[int, str | None] = {}
        self._open: list[Tag] = []
        self._count = 0
        self._root: Tag | None = None
        self._ascii = text.isascii()

    def parse(self) -> Tag:
        """Return the root of the tree, or raise `ParseError` with the place of what is wrong."""
        if (surrogate := _SURROGATE.search(self.text)) is not None:
            raise ParseError(
                f"U+{ord(surrogate.group()):04X} is half of a character",
                place=self.place(surrogate.start()),
                fix="save the file as UTF-8",
                code="E702",
            )
        parser = self._parser = expat.ParserCreate()
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._characters
        parser.buffer_text = True
        parser.StartDoctypeDeclHandler = self._refuse_doctype
        parser.EntityDeclHandler = self._refuse_entity
        parser.ExternalEntityRefHandler = self._refuse_entity
        parser.SkippedEntityHandler = self._refuse_entity
        try:
            parser.Parse(self.text, True)
        except expat.ExpatError as error:
            offset = self._offset(error.lineno, error.offset)
            what = expat.errors.messages.get(error.code, str(error))
            raise ParseError(
                f"this is not XML: {what}",
                place=self.place(offset),
                fix="every <tag> needs its </tag>, every value quotes; < and & in text are &lt; and &amp;",
                code="E701",
            ) from None
        assert self._root is not None  # a text without an element is an error of the parser
        return self._root

    def place(self, offset: int) -> Place:
        """The place of an offset in the text."""
        offset = max(0, min(offset, len(self.text)))
        row = bisect_right(self._lines, offset)
        start = self._lines[row - 1]
        if row not in self._shown:  # once for all places in a line
            end = self._lines[row] - 1 if row < len(self._lines) else len(self.text)
            self._shown[row] = printable(self.text[start:end])
        return Place(self.name, row, offset - start + 1, self._shown[row])

    def _offset(self, line: int, column: int) -> int:
        """The offset of a line and a column that the parser names."""
        return self._lines[min(line, len(self._lines)) - 1] + column

    def _here(self) -> int:
        if self._ascii:  # then bytes are characters
            return self._parser.CurrentByteIndex
        return self._offset(self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        self._count += 1
        if self._count > MAX_TAGS or len(self._open) >= MAX_DEPTH:
            deep = len(self._open) >= MAX_DEPTH
            what = f"elements are nested more than {MAX_DEPTH} deep" if deep else f"more than {MAX_TAGS} elements"
            self._refuse(what, "split the file: is this a robot?", "E703")
        if len(attributes) > MAX_ATTRIBUTES:  # classes of defaults hand them on
            self._refuse(f"an element has more than {MAX_ATTRIBUTES} attributes", "is this a robot?", "E703")
        made = Tag(name, attributes, self._here(), self)
        if self._open:
            self._open[-1].children.append(made)
        else:
            self._root = made
        self._open.append(made)

    def _end(self, name: str) -> None:
        self._open.pop()

    def _characters(self, text: str) -> None:
        if self._open and not self._open[-1].children and len(self._open[-1].text) < MAX_TEXT:
            self._open[-1].text += text[:MAX_TEXT]

    def _refuse_doctype(self, *_: object) -> NoReturn:
        self._refuse("a document type is not read", "remove <!DOCTYPE …>: a robot's file needs none", "E701")

    def _refuse_entity(self, *_: object) -> NoReturn:
        self._refuse("entities are not read", "write the text itself instead of &…;", "E701")

    def _refuse(self, what: str, fix: str, code: CodeText) -> NoReturn:
        raise ParseError(what, place=self.place(self._here()), fix=fix, code=code)
