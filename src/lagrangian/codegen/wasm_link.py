"""Links an object file of WebAssembly into a module.

An object file as LLVM writes it is nearly a module: indices of types, functions and globals, and addresses counted from
0, are in place already. What is missing are the exports, and what has to go are the sections for linkers. Any symbol
that is not defined, other than a known import of the host, is refused.

Format: WebAssembly Core Specification 2.0, section 5.5, and "WebAssembly Object File Linking"
(github.com/WebAssembly/tool-conventions, Linking.md).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lagrangian.records import dataclass

MAGIC = b"\0asm\1\0\0\0"
CUSTOM, IMPORT, EXPORT, DATA = 0, 2, 7, 11
ORDER = (1, 2, 3, 4, 5, 13, 6, 7, 8, 9, 12, 10, 11)
"""Sections in the order in which a module has them."""

FUNCTION, TABLE, MEMORY, GLOBAL = range(4)
"""Kinds of imports and exports."""

SYMBOL_TABLE = 8
"""The subsection of ``linking`` that lists the symbols."""

FUNCTION_SYMBOL, DATA_SYMBOL, SECTION_SYMBOL = 0, 1, 3
UNDEFINED, EXPLICIT_NAME = 0x10, 0x40

IN_PLACE = frozenset({0, 3, 4, 5, 6, 7})
"""Relocations that hold an index or address of this file already: of functions, memory, types and globals."""

PROVIDED = frozenset({"__linear_memory", "__stack_pointer"})
"""What the host provides of the module ``env``."""


class LinkError(Exception):
    """An object file that cannot become a module on its own."""


@dataclass(frozen=True)
class Linked:
    """A module: its bytes, the functions that it imports as (module, name), and the bytes of memory its data takes."""

    code: bytes
    imports: tuple[tuple[str, str], ...]
    data: int


class _Reader:
    """Reads numbers, names and sections from bytes."""

    def __init__(self, content: bytes) -> None:
        self.content, self.at = content, 0

    def __bool__(self) -> bool:
        return self.at < len(self.content)

    def byte(self) -> int:
        self.at += 1
        return self.content[self.at - 1]

    def number(self) -> int:
        """An unsigned LEB128."""
        value = shift = 0
        while True:
            byte = self.byte()
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def take(self, count: int) -> bytes:
        self.at += count
        return self.content[self.at - count : self.at]

    def name(self) -> str:
        return self.take(self.number()).decode()

    def sections(self) -> Iterator[tuple[int, bytes]]:
        while self:
            kind = self.byte()
            yield kind, self.take(self.number())


def linked(content: bytes, exports: Iterable[str], known: Iterable[tuple[str, str]] = ()) -> Linked:
    """Return an object file as a module with the functions ``exports``.

    ``known`` are the functions (module, name) that the host can supply. Raises `LinkError` for anything else that is
    not defined, for a relocation that is not in place, and for an export that the file does not have.
    """
    if content[: len(MAGIC)] != MAGIC:
        raise LinkError("this is not an object file of WebAssembly")
    sections: dict[int, bytes] = {}
    functions: dict[str, int] = {}
    for kind, body in _Reader(content[len(MAGIC) :]).sections():
        if kind != CUSTOM:
            sections[kind] = body
            continue
        reader = _Reader(body)
        name = reader.name()
        if name == "linking":
            functions = _defined(reader)
        elif name.startswith("reloc."):
            _check_relocations(reader, name)
    imports = _imported(sections.get(IMPORT, b"\0"), known)
    wanted = list(exports)
    if missing := [name for name in wanted if name not in functions]:
        raise LinkError(f"the object file has no function {', '.join(missing)}")
    rows = [_text(name) + bytes([FUNCTION]) + _leb(functions[name]) for name in wanted]
    sections[EXPORT] = _leb(len(rows)) + b"".join(rows)
    whole = MAGIC + b"".join(bytes([k]) + _leb(len(sections[k])) + sections[k] for k in ORDER if k in sections)
    return Linked(whole, tuple(pair for pair in imports if pair[0] != "env"), _extent(sections.get(DATA, b"\0")))


def _imported(body: bytes, known: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """The imported functions, in the order of their indices. Raises `LinkError` for one that is not known."""
    reader, found, allowed = _Reader(body), list[tuple[str, str]](), set(known)
    for _ in range(reader.number()):
        pair = reader.name(), reader.name()
        kind = reader.byte()
        if kind == FUNCTION:
            reader.number()
            found.append(pair)
        elif kind == GLOBAL:
            reader.take(2)
        else:
            if kind == TABLE:
                reader.byte()
            limited = reader.byte()
            reader.number()
            if limited & 1:
                reader.number()
        if pair not in allowed if kind == FUNCTION else pair[0] != "env" or pair[1] not in PROVIDED:
            raise LinkError(f"'{pair[1]}' of '{pair[0]}' is not defined anywhere")
    return found


def _defined(reader: _Reader) -> dict[str, int]:
    """The functions of the symbol table by name. Raises `LinkError` for data that are not defined.

    Whatever else is not defined is an import, and `_imported` has looked at it.
    """
    reader.number()  # the version of the section
    functions: dict[str, int] = {}
    for part, body in reader.sections():
        symbols = _Reader(body if part == SYMBOL_TABLE else b"\0")
        for _ in range(symbols.number()):
            kind, flags = symbols.byte(), symbols.number()
            if kind == DATA_SYMBOL:
                name = symbols.name()
                if flags & UNDEFINED:
                    raise LinkError(f"the data '{name}' are not defined anywhere")
                for _ in range(3):  # segment, offset, size
                    symbols.number()
                continue
            index, name = symbols.number(), ""
            if kind != SECTION_SYMBOL and (not flags & UNDEFINED or flags & EXPLICIT_NAME):
                name = symbols.name()
            if kind == FUNCTION_SYMBOL and not flags & UNDEFINED:
                functions[name] = index
    return functions


def _check_relocations(reader: _Reader, name: str) -> None:
    """Raise `LinkError` for a kind of relocation whose value is not in place."""
    reader.number()  # the section to which they belong
    for _ in range(reader.number()):
        kind = reader.byte()
        if kind not in IN_PLACE:
            raise LinkError(f"{name} has a relocation of kind {kind}, which is not in place")
        for _ in range(3 if kind in (3, 4, 5) else 2):  # the place, the index and, of addresses, what is added
            reader.number()


def _extent(body: bytes) -> int:
    """The end of the data in memory; every segment begins at ``i32.const`` address."""
    reader, end = _Reader(body), 0
    for _ in range(reader.number()):
        if reader.number() != 0 or reader.byte() != 0x41:
            raise LinkError("the data has a segment without an address")
        start = reader.number()
        reader.byte()
        size = reader.number()
        reader.take(size)
        end = max(end, start + size)
    return end


def _leb(value: int) -> bytes:
    """An unsigned LEB128."""
    found = bytearray()
    while True:
        value, low = value >> 7, value & 127
        found.append(low | (128 if value else 0))
        if not value:
            return bytes(found)


def _text(name: str) -> bytes:
    return _leb(len(name.encode())) + name.encode()
