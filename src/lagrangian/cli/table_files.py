"""Tables of numbers in CSV files: the signal of an input, and measured data."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path

from lagrangian.errors import ModelError, Place

MAX_BYTES = 64_000_000
"""The largest size in bytes of a table: a million lines of two long numbers."""

MOST_COLUMNS = 1000

MISSING = ("", "nan", "na", "n/a", "-")
"""Cells of samples that are missing, in small letters."""

_HEAD = re.compile(r"([^\[\]]*)\[([^\[\]]*)\]\Z")
"""The head of a column with its unit: theta [deg]."""


def times_and_values(path: str) -> tuple[list[float], list[float]]:
    """Return the times and values of a CSV file; a first line of names is skipped."""
    from lagrangian.simulate.inputs import MAX_KNOTS

    times: list[float] = []
    values: list[float] = []
    for number, line in enumerate(table_text(path).splitlines(), 1):
        cells = [cell.strip().strip('"') for cell in line.split(",")]
        if not line.strip() or line.lstrip().startswith("#") or (number == 1 and not any(map(_is_number, cells))):
            continue
        if len(cells) != 2 or not all(map(_is_number, cells)):
            raise ModelError(
                f"'{line[:60]}' is not a time and a value",
                place=Place(path, number),
                fix="write two numbers on each line: 0.5,12.3",
                code="E406",
            )
        times.append(float(cells[0]))
        values.append(float(cells[1]))
        if len(times) > MAX_KNOTS:
            raise ModelError(f"more than {MAX_KNOTS} lines", place=Place(path, number), code="E703")
    if not times:
        raise ModelError(
            "the table contains no numbers", place=Place(path), fix="write a time and a value on each line", code="E406"
        )
    return times, values


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def table_text(path: str) -> str:
    """Return the text of a table, up to the largest allowed size, without a byte order mark."""
    try:
        with Path(path).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
        text = data.decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as trouble:
        reason = getattr(trouble, "strerror", None) or "it is not text"
        what, fix = f"cannot read the table: {reason.lower()}", "name a text file with a time and a value on each line"
        raise ModelError(what, place=Place(path), fix=fix, code="E702") from None
    if len(data) > MAX_BYTES:
        raise ModelError(f"the table has more than {MAX_BYTES} bytes", place=Place(path), code="E703")
    return text


def named_columns(path: str) -> dict[str, list[float]]:
    """Return the columns of a CSV file by the names in its first line, in SI units: ``t, theta [deg], x'``.

    Empty cells and nan are samples that are missing (NaN). Lines that begin with # are comments.
    """
    lines = [(n, line) for n, line in enumerate(table_text(path).splitlines(), 1) if line.strip()]
    lines = [(n, line) for n, line in lines if not line.lstrip().startswith("#")]
    if not lines:
        raise _wrong("the table is empty", path, 1)
    heads = _cells(lines[0][1], path, lines[0][0])
    if len(heads) > MOST_COLUMNS:
        raise _wrong(f"the table has {len(heads)} columns; at most {MOST_COLUMNS} are read", path, lines[0][0])
    if all(_is_number(head) for head in heads):
        raise _wrong("the first line has no names", path, lines[0][0])
    named = [_name_and_factor(head, path, lines[0][0]) for head in heads]
    names = [name for name, _ in named]
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise _wrong(f"the column '{twice}' is there twice", path, lines[0][0])
    found: dict[str, list[float]] = {name: [] for name in names}
    for number, line in lines[1:]:
        row = _cells(line, path, number)
        if len(row) != len(named):
            raise _wrong(f"a line with {len(row)} cells under {len(named)} names", path, number)
        for (name, factor), cell in zip(named, row, strict=True):
            found[name].append(_sample(cell, name, path, number) * factor)
    if not lines[1:]:
        raise _wrong("the table has names but no numbers", path, lines[0][0])
    return found


def _cells(line: str, path: str, number: int) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([line], skipinitialspace=True))]
    except csv.Error:
        raise _wrong("this line cannot be read", path, number) from None


def _name_and_factor(head: str, path: str, line: int) -> tuple[str, float]:
    """The name of a column, and what its numbers are multiplied by."""
    from lagrangian.quantities.quantity import unit_factor

    with_unit = _HEAD.match(head)
    name, unit = (with_unit[1].strip(), with_unit[2].strip()) if with_unit else (head, "")
    if not name:
        raise _wrong("a column has no name", path, line)
    try:
        return name, float(unit_factor(unit)) if unit else 1.0
    except ModelError as error:
        what = f"the unit of the column '{name[:40]}': {error.what}"
        raise ModelError(what, place=Place(path, line), fix=error.fix, code="E408") from None


def _sample(cell: str, name: str, path: str, line: int) -> float:
    if cell.lower() in MISSING:
        return math.nan
    if not _is_number(cell):
        raise _wrong(f"'{cell[:40]}' in the column '{name[:40]}' is not a number", path, line)
    return float(cell)


def _wrong(what: str, path: str, line: int) -> ModelError:
    fix = "the first line has names and every other line as many numbers: t,theta and then 0.5,12.3; leave a cell empty"
    return ModelError(what, place=Place(path, line), fix=f"{fix} where nothing was measured", code="E406")
