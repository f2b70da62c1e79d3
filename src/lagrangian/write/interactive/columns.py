"""WebAssembly in columns, which compress by a third better: opcodes, locals, addresses and constants apart.

Neighbouring instructions differ in kind and are alike in pattern, and so are neighbouring operands of one kind. The
columns are joined again by `columns.js`. Instructions: WebAssembly Core Specification 2.0, section 5.4.
"""

from __future__ import annotations

OPCODES, LOCALS, MORE_OF_LOCALS, OFFSETS, MORE_OF_OFFSETS, CONSTANTS, REST = range(7)
"""The columns. Of a number in LEB128, the first byte and the following ones may have columns of their own."""

CODE = 10
"""The section with the functions."""

VECTOR, BULK = 0xFD, 0xFC
"""Prefixes of instructions on vectors, and on whole ranges of memory."""


class UnknownInstruction(Exception):
    """An instruction that is not in the tables of this module."""


def in_columns(code: bytes) -> bytes:
    """Return a module in columns: their number, their lengths, and the columns; the module itself after a 0 if an
    instruction is not known."""
    try:
        columns = _Splitter(code).columns
    except UnknownInstruction:
        return b"\0" + code
    return b"".join([_leb(len(columns)), *(_leb(len(c)) for c in columns), *columns])


def _leb(number: int) -> bytes:
    """A number in LEB128."""
    made = bytearray()
    while number > 127:
        made.append(number & 127 | 128)
        number >>= 7
    return bytes([*made, number])


class _Splitter:
    """Reads a module once and fills the columns."""

    def __init__(self, code: bytes) -> None:
        self.code, self.at = code, 0
        self.columns = [bytearray() for _ in range(7)]
        self._take(REST, 8)  # magic and version
        while self.at < len(code):
            section, size = self._take(REST, 1), self._number(REST)
            if section == CODE:
                self._functions()
            else:
                self._take(REST, size)

    def _functions(self) -> None:
        for _ in range(self._number(REST)):
            size = self._number(REST)
            end = self.at + size
            for _ in range(self._number(REST)):  # groups of locals: how many, and their type
                self._number(REST)
                self._take(REST, 1)
            while self.at < end:
                self._instruction(self._take(OPCODES, 1))

    def _instruction(self, code: int) -> None:
        """Distribute the operands of an instruction."""
        if code in (0x20, 0x21, 0x22):  # a local
            self._number(LOCALS, MORE_OF_LOCALS)
        elif 0x28 <= code <= 0x3E:  # loads and stores: alignment, offset
            self._number(REST)
            self._number(OFFSETS, MORE_OF_OFFSETS)
        elif code in (0x41, 0x42):  # whole constants
            self._number(CONSTANTS)
        elif code == 0x44:  # a double
            self._take(CONSTANTS, 8)
        elif code in (0x0C, 0x0D, 0x10, 0x23, 0x24):  # branches, calls, globals
            self._number(REST)
        elif 0x02 <= code <= 0x04:  # blocks and their types, which are no numbers of types here
            self._take(REST, 1)
        elif code == 0x11:  # calls by a table
            self._number(REST)
            self._number(REST)
        elif code == 0x0E:  # branches by a table
            for _ in range(self._number(REST) + 1):
                self._number(REST)
        elif code == VECTOR:
            self._vector(self._number(OPCODES))
        elif code == BULK:
            self._bulk(self._number(OPCODES))
        elif not (code in (0x00, 0x01, 0x05, 0x0B, 0x0F, 0x1A, 0x1B) or 0x45 <= code <= 0xC4):
            raise UnknownInstruction

    def _vector(self, code: int) -> None:
        if code <= 11 or 84 <= code <= 93:  # loads and stores; of one lane: its number
            self._number(REST)
            self._number(OFFSETS, MORE_OF_OFFSETS)
            if 84 <= code <= 91:
                self._take(REST, 1)
        elif code in (12, 13):  # a constant, a shuffle
            self._take(CONSTANTS, 16)
        elif 21 <= code <= 34:  # one lane
            self._take(REST, 1)

    def _bulk(self, code: int) -> None:
        if code in (10, 11):  # copy and fill memory
            self._take(REST, 12 - code)
        elif code > 7:
            raise UnknownInstruction

    def _take(self, column: int, count: int) -> int:
        """Move bytes into a column; return the first."""
        taken = self.code[self.at : self.at + count]
        self.columns[column] += taken
        self.at += count
        return taken[0] if taken else 0

    def _number(self, first: int, more: int | None = None) -> int:
        """Move a number in LEB128 into a column, or its first byte into one and the others into another."""
        value = shift = 0
        while True:
            byte = self._take(first if shift == 0 or more is None else more, 1)
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value
