"""Converts the bytes of a model file to validated data; every error has its place in the file."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from pydantic import BaseModel, ValidationError

from lagrangian.calls import MEANT
from lagrangian.errors import ParseError, Place, did_you_mean
from lagrangian.quantities.source import printable, shown
from lagrangian.read.file_schema import ModelFile
from lagrangian.read.toml_index import Index, Path

MAX_BYTES = 1 << 20
"""The largest size of a model file in bytes (1 MiB)."""

MEANT_SECTIONS = {
    meant: section
    for section, names in {
        "velocity_constraint": "nonholonomic nonholonomic_constraint velocity velocity_constraints pfaffian knife_edge",
        "constraint": "holonomic holonomic_constraint position_constraint distance closure loop rod",
        "pin": "hinge revolute revolute_joint joint",
        "ball": "spherical spherical_joint ball_joint",
        "slider": "prismatic prismatic_joint guide",
        "weld": "fixed fixed_joint rigid_connection",
        "rolling": "roll no_slip rolling_contact wheel",
        "rope": "cable string belt",
        "particle": "mass point_mass mass_point",
        "rigid_body": "body link disc disk cylinder beam",
        "frame": "floating floating_frame free_body ball_frame free",
        "damper": "dashpot",
        "friction": "coulomb dry_friction stiction",
        "torque": "motor moment couple",
    }.items()
    for meant in names.split()
}
"""Names in books and other programs, and the sections that describe the same here."""

WITH = {
    **dict.fromkeys(("floating", "floating_frame", "free_body", "free"), " with floating = true"),
    "ball_frame": " with ball = true",
}
"""What a section needs to be what was meant."""

MAX_NESTING = 12
_STRINGS = re.compile(
    r'"""(?:[^\\]|\\[\s\S])*?"{3,5}' + r"|'''[\s\S]*?'{3,5}" + r'|"(?:[^"\\\n]|\\.)*"' + r"|'[^'\n]*'|#[^\n]*"
)
_DOTTED = re.compile(rf"(?:[\w-]+[ \t]*\.[ \t]*){{{MAX_NESTING}}}")
_PLACE = re.compile(r"\s*\(at line (\d+), column (\d+)\)\Z")
_END = re.compile(r"\s*\(at end of document\)\Z")
_KINDS = {bool: "true or false", int: "a number", float: "a number", str: "text", list: "a list", dict: "a table"}
_WORDS = {"text": "text", "number": "a number", "list": "a list", "table": "a table { … }"}


def decode(data: bytes, name: str) -> str:
    """Return the text of a file; raise an error if it is too large, binary or not UTF-8."""
    if len(data) > MAX_BYTES:
        raise ParseError(
            f"the file is larger than {MAX_BYTES} bytes",
            place=Place(name),
            fix="a model file is a few kilobytes; is this the right file?",
            code="E703",
        )
    if b"\0" in data:
        line = data.count(b"\n", 0, data.index(b"\0")) + 1
        raise ParseError(
            "the file is binary, not text (it contains a zero byte)",
            place=Place(name, line, 1),
            fix="give a model file in TOML; UTF-16 text must be saved as UTF-8",
            code="E702",
        )
    try:
        return data.decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        before = data[: error.start]
        line, start = before.count(b"\n") + 1, before.rfind(b"\n") + 1
        column = len(before[start:].decode("utf-8", "replace")) + 1
        raise ParseError(
            f"the file is not UTF-8: the byte 0x{data[error.start]:02x} is not a character",
            place=Place(name, line, column),
            fix="save it as UTF-8",
            code="E702",
        ) from None


def read_toml(text: str, name: str) -> tuple[ModelFile, dict[str, Any], Index]:
    """Return the validated file, its raw data and the places of everything in it."""
    if not isinstance(text, str):
        raise ParseError(f"a model file is text (got {type(text).__name__})", place=Place(name), code="E406")
    if len(text) > MAX_BYTES:
        raise ParseError(f"the file is larger than {MAX_BYTES} bytes", place=Place(name), fix="split it", code="E703")
    text = text.replace("\r\n", "\n")
    if not _STRINGS.sub("", text).strip():
        raise ParseError(
            "the file is empty",
            place=_place(text, name, 0),
            fix="`lagrangian new pendulum` writes an example to start from",
            code="E401",
        )
    _check_nesting(text, name)
    data, index = _parse(text, name)
    try:
        return ModelFile.model_validate(data), data, index
    except ValidationError as error:
        raise _translated(error, data, index) from None


def _check_nesting(text: str, name: str) -> None:
    """Raise an error for deeply nested brackets and dotted keys, before any recursive function sees them."""
    bare = _STRINGS.sub(lambda m: "s" + " " * (len(m.group()) - 1) if "\n" not in m.group() else m.group(), text)
    depth = 0
    for match in re.finditer(r"[\[\]{}\n]", bare):
        c = match.group()
        depth += 1 if c in "[{" else -1 if c in "]}" else 0
        if depth > MAX_NESTING:
            raise ParseError(
                f"brackets are nested more than {MAX_NESTING} deep",
                place=_place(text, name, match.start()),
                fix="use at most three levels: a model file needs no more",
                code="E703",
            )
    if match := _DOTTED.search(bare):
        raise ParseError(
            f"a key with more than {MAX_NESTING} parts",
            place=_place(text, name, match.start()),
            fix="use at most three levels: a model file needs no more",
            code="E703",
        )


def _place(text: str, name: str, offset: int) -> Place:
    start = text.rfind("\n", 0, offset) + 1
    end = text.find("\n", offset)
    line = text[start : end if end >= 0 else len(text)]
    return Place(name, text.count("\n", 0, offset) + 1, offset - start + 1, printable(line))


def _parse(text: str, name: str) -> tuple[dict[str, Any], Index]:
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _toml_error(str(error), text, name) from None
    except ValueError:  # Python does not read integers of more than 4300 digits
        digits = re.search(r"[0-9_]{1000,}", text)
        raise ParseError(
            "the number has too many digits",
            place=_place(text, name, digits.start() if digits else 0),
            fix="write it with a power of ten: 1e30",
            code="E703",
        ) from None
    return data, Index(text, name)


def _toml_error(message: str, text: str, name: str) -> ParseError:
    index = Index(text, name)
    if index.duplicates:
        path, first, second = index.duplicates[0]
        lines = index.place(first).line, index.place(second).line
        return ParseError(
            f"{shown('.'.join(map(str, path)))} is given twice (line {lines[0]}, line {lines[1]})",
            place=index.place(second),
            fix="keep one of the two",
            code="E404",
        )
    if match := _PLACE.search(message):
        line, column = int(match.group(1)), int(match.group(2))
        lines = text.split("\n")
        offset = sum(len(x) + 1 for x in lines[: line - 1]) + column - 1
        what = message[: match.start()]
    else:
        offset, what = len(text.rstrip()), _END.sub("", message)
        what += "; the file ends too early"
    fix = "TOML writes key = value, text in quotes, lists in [ ]"
    at = _place(text, name, offset)
    if what.startswith("Invalid value") and at.text is not None and "=" in at.text:
        value = at.text.split("=", 1)[1].split("#")[0].strip()
        if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", value):
            return ParseError(
                f"cannot read {shown(value)} as a number", place=at, fix=f"write {value.replace(',', '.')}", code="E406"
            )
        fix = f'put text in quotes: "{value[:40]}"' if value else "write a value after ="
    return ParseError(f"this is not TOML: {what[:1].lower()}{what[1:]}", place=at, fix=fix, code="E701")


# -- what pydantic found ------------------------------------------------------------------------------------------


def _known(name: str, path: Path, data: dict[str, Any]) -> str:
    """The fields that are known where an unknown one stands, and the one that may be meant."""
    known = [f.alias or n for n, f in _table_of(path[:-1], data).model_fields.items()]
    meant = (MEANT_SECTIONS if len(path) == 1 else MEANT).get(name)
    hint = f"Did you mean '{meant}'{WITH.get(name, '')}?" if meant in known else did_you_mean(name[:64], known)
    listed = "known: " + ", ".join(known)
    return f"{hint} ({listed})" if hint else listed


def _translated(error: ValidationError, data: dict[str, Any], index: Index) -> ParseError:
    """Return the first error in the file, unknown fields before missing ones (a misspelled field is both)."""
    found = [(_path(e["loc"], data), e) for e in error.errors(include_url=False)]
    found.sort(key=lambda pair: (pair[1]["type"] != "extra_forbidden", index.offset(pair[0])))
    path, first = found[0]
    kind, name = first["type"], path[-1]
    element = owner(path, data) or None
    if kind == "extra_forbidden":
        return ParseError(
            f"unknown field {shown(str(name))}",
            element=element or "the file",
            place=index.of_key(path),
            fix=_known(str(name), path, data),
            code="E405",
        )
    if kind == "missing":
        return ParseError(
            f"the field '{name}' is missing",
            element=element or "the file",
            place=index.of_key(path[:-1]) if len(path) > 1 else index.place(0),
            fix=f"write {name} = …: {_description(path, data)}",
            code="E401",
        )
    field = _label(path)
    if kind in ("too_short", "too_long"):
        wanted = first.get("ctx", {})
        count = wanted.get("actual_length")
        low, high = wanted.get("min_length"), wanted.get("max_length")
        return ParseError(
            f"{field} has {count} {'entry' if count == 1 else 'entries'}",
            element=element,
            place=index.of_value(path),
            fix=f"give {'at least ' + str(low) if low is not None else 'at most ' + str(high)}",
            code="E414",
        )
    value = _get(data, path)
    if kind in ("finite_number", "float_parsing"):
        return ParseError(
            f"{field} must be a finite number (got {value})",
            element=element,
            place=index.of_value(path),
            fix="write a finite number",
            code="E101",
        )
    shape = "an array of tables" if kind == "list_type" and len(path) == 1 else None
    fix = f"write [[{path[0]}]] with two brackets" if shape else f"write {_wanted(first)}"
    if kind in ("dict_type", "model_type") and len(path) == 1:
        fix = f"write [{path[0]}] on a line of its own, and its entries below, a line for each"
    return ParseError(
        f"{field} must be {shape or _wanted(first)} (got {_KINDS.get(type(value), 'a date or time')})",
        element=element,
        place=index.of_key(path) if isinstance(value, dict) else index.of_value(path),
        fix=fix,
        code="E406",
    )


def _wanted(error: Any) -> str:
    kind, context = error["type"], error.get("ctx", {})
    if kind.startswith("union_tag"):
        expected = context.get("expected_tags")
        if expected is None:
            return "an expression (text) or a number"
        return " or ".join(_WORDS[tag.strip().strip("'")] for tag in expected.split(","))
    table = {
        "bool_type": "true or false",
        "string_type": "text",
        "list_type": "a list",
        "dict_type": "a table",
        "model_type": "a table",
    }
    return table.get(kind, "a number" if "float" in kind else "another kind of value")


def _path(location: tuple[str | int, ...], data: Any) -> Path:
    """The keys of an error's location, without pydantic's own names for branches of a union."""
    path: list[str | int] = []
    at = data
    for i, part in enumerate(location):
        last = i == len(location) - 1
        if isinstance(at, dict) and isinstance(part, str) and (part in at or last):
            at = at.get(part)
        elif isinstance(at, list) and isinstance(part, int) and part < len(at):
            at = at[part]
        else:
            continue
        path.append(part)
    return tuple(path)


def _get(data: Any, path: Path) -> Any:
    for part in path:
        data = data[part]
    return data


def _label(path: Path) -> str:
    """The place of a value in words: ``offset[1]``, ``the section [points]``."""
    if len(path) == 1:
        return f"the section {shown(str(path[0]))}" if path[0] != "name" else "the name of the system"
    words = [str(p) for p in path if isinstance(p, str)][-1]
    after = [p for p in path[max(i for i, p in enumerate(path) if isinstance(p, str)) + 1 :] if isinstance(p, int)]
    if len(path) == 2 and isinstance(path[1], int):
        return f"[[{path[0]}]] number {path[1] + 1}"
    return f"'{words[:64]}'" + "".join(f" entry {p + 1}" for p in after)


def owner(path: Path, data: dict[str, Any]) -> str:
    """The element or section to which a path belongs, in words: ``particle 'cart 1'``, ``the point 'A'``."""
    if len(path) < 2:
        return ""
    section = str(path[0])
    if isinstance(path[1], int):
        table = data[section][path[1]] if isinstance(data.get(section), list) else None
        name = table.get("name") if isinstance(table, dict) else None
        words = section.replace("_", " ")
        return f"{words} {shown(name)}" if isinstance(name, str) and name else f"{words} number {path[1] + 1}"
    singular = {"coordinates": "coordinate", "parameters": "parameter", "inputs": "input", "points": "point"}
    if section in singular and len(path) >= 2:
        return f"{singular[section]} {shown(str(path[1]))}"
    return f"[{section}]"


def _table_of(path: Path, data: dict[str, Any]) -> type[BaseModel]:
    """The pydantic model of the table at a path."""
    from lagrangian.read import file_schema as schema

    if not path:
        return ModelFile
    section = str(path[0])
    tables: dict[str, type[BaseModel]] = {
        "coordinates": schema.CoordinateTable,
        "parameters": schema.ParameterTable,
        "inputs": schema.InputTable,
        "points": schema.PointTable,
        "energies": schema.EnergiesTable,
        "simulate": schema.SimulateTable,
        "frame": schema.FrameTable,
        **schema.TABLES,
    }
    if section == "look":
        return _look_table(path[1:])
    if len(path) >= 3:  # a table inside an element can only be a point
        return schema.PointTable
    return tables[section]


def _look_table(path: Path) -> type[BaseModel]:
    """The pydantic model of a table within [look]."""
    from lagrangian.read import file_schema as schema

    inner = {"view": schema.ViewTable, "line": schema.LookLineTable, "shape": schema.LookShapeTable}
    return inner.get(str(path[0]), schema.LookTable) if path else schema.LookTable


def _description(path: Path, data: dict[str, Any]) -> str:
    fields = _table_of(path[:-1], data).model_fields
    for name, field in fields.items():
        if (field.alias or name) == path[-1]:
            return (field.description or "").rstrip(".").lower() or "it is needed"
    return "it is needed"
