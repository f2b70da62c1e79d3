"""Holds the sheets of an exercise against its model file, which is read back as somebody who checks answers reads it.

The solution is judged as an answer to the file: whole as Markdown, and its results as text, LaTeX and HTML. The values
of the question are read from its table of letters, by the reader of quantities. A formula in a description must agree
with the values.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Protocol

from lagrangian.check.html_formulas import as_markdown
from lagrangian.check.printed import printed_checks
from lagrangian.derive import Derived
from lagrangian.errors import Error
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.page.plain import plain
from lagrangian.quantities.quantity import parse_quantity
from lagrangian.worksheet.worded import claims, number, parts_of, values_of

TOLERANCE = 1e-9
"""Printed values differ from those of the file by no more than this, relative to these."""

_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_POWER = re.compile(r"(?:(\d[\d.]*)·)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)(?!\d)")
_ROW = re.compile(r"\| ?\$(?P<letter>.+?)\$ ?\|(?P<what>.*)\| (?P<value>[^|]*?) ?\|?\Z")


def sheet_checks(
    derive: Callable[[], Derived], question: Callable[[str], str], solution: Callable[[str, bool], str]
) -> tuple[Check, ...]:
    """Return the checks of a solution and of a question sheet.

    ``derive`` returns the derivation of the model file, ``question`` a sheet in a format, ``solution`` the solution in
    a format, whole or brief. ``holds`` is None for what cannot be read back.
    """
    what = text("the solution, read back, is right for the model file")
    try:
        own = derive()
    except Error as error:
        return (Check(what, False, f"the model file is refused: {error.what[:120]}"),)
    if own.form != "expanded":
        unread = Check(what, None, "not checked: equations in named quantities are not read as an answer")
        return unread, *_sheets(own.model, question), *_described(own.model)
    (whole,) = printed_checks(own, {"whole": solution("markdown", False)})
    if whole.holds is None:  # a page may be too long for an answer: then its results alone
        (whole,) = printed_checks(own, {"brief": solution("markdown", True)})
    pages = {name: solution(name.lower(), True) for name in ("text", "LaTeX")}
    rest = printed_checks(own, {**pages, "HTML": as_markdown(solution("html", True))})
    judged = [
        Check(text(f"the solution as {name}, read back, is right for the model file"), c.holds, c.figure)
        for name, c in zip(("Markdown", *pages, "HTML"), (whole, *rest), strict=True)
    ]
    return *judged, *_sheets(own.model, question), *_described(own.model)


class Sheets(Protocol):
    """An exercise, as `lagrangian.Worksheet` is one."""

    @property
    def seed(self) -> int | None: ...  # noqa: D102
    def verify(self) -> tuple[Check, ...]: ...  # noqa: D102


def variant_checks(make: Callable[[], Sheets]) -> tuple[Check, ...]:
    """Return the checks of the exercise that ``make`` makes of a variant of a system."""
    try:
        made = make()
    except Error as error:
        return (Check(text("the sheets of a worksheet"), None, f"not checked: {error.what[:120]}"),)
    which = f"worksheet, variant {made.seed}: "
    return tuple(replace(c, what=text(which, *c.what.parts)) for c in made.verify())


def _sheets(model: Model, question: Callable[[str], str]) -> Iterator[Check]:
    """The checks of the values on the question sheet."""
    sheets = {"Markdown": question("markdown"), "HTML": as_markdown(question("html"))}
    yield from (_values(model, name, sheet) for name, sheet in sheets.items())


def _values(model: Model, name: str, sheet: str) -> Check:
    """Whether a question sheet prints the values of the parameters of a model, in their order."""
    what = text(f"the values on the question sheet as {name} are those of the model file")
    wanted = [(p.name, p.value) for p in model.parameters if p.value is not None]
    printed = list(_printed(sheet))
    if len(printed) != len(wanted):
        return Check(what, False, f"{len(printed)} values are printed, and the file has {len(wanted)}")
    wrong = [p for (p, value), cell in zip(wanted, printed, strict=True) if not _same(value, cell)]
    return Check(what, not wrong, f"{', '.join(wrong)} differ" if wrong else f"{len(wanted)} values")


def _described(model: Model) -> Iterator[Check]:
    """Whether the formulas in the descriptions of letters agree with the values, if there are such formulas."""
    values, wrong, count = values_of(model), list[str](), 0
    for p in model.parameters:
        for claim in (c for part in parts_of(p.description) for c in claims(model, p, part) if not c.loose):
            held = claim.holds(values)
            count += held is not None
            if held is False:
                numbers = [f"{side:.4g}" for x in (claim.left, claim.right) if (side := number(x, values)) is not None]
                wrong.append(f"{plain(claim.left)} = {plain(claim.right)} of '{p.name}' says {' = '.join(numbers)}")
    if count:
        what = text("the formulas in the descriptions of letters agree with the values")
        said = f"{count} formula{'s' if count > 1 else ''}"
        yield Check(what, not wrong, "; ".join(wrong) if wrong else said)


def _printed(sheet: str) -> Iterator[str]:
    """The values in the rows of a sheet that begin with a letter and end with a number."""
    for line in sheet.splitlines():
        row = _ROW.match(line)
        if row is not None and re.match(r"[−-]?\d", row["value"]):
            yield row["value"]


def _same(value: float, cell: str) -> bool:
    """Whether a cell such as ``200 g (0.2 kg)`` or ``2·10⁻⁶ kg·m²`` says this value."""
    words = re.sub(r"\\(.)", r"\1", cell.partition(" (")[0].strip()).replace("−", "-")
    plain = _POWER.sub(lambda m: f"{m[1] or 1}e{m[2].translate(_RAISED)}", words)
    try:
        shown = parse_quantity(plain.replace("⋅", "·")).value
    except Error:
        return False
    return abs(shown - value) <= TOLERANCE * abs(value)
