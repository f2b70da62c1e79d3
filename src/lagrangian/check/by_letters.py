"""Calls elements as a student knows them: torque P a, and not torque 1; the reel, and not kinetic 'reel'.

Of two of one kind it says: one of the springs 'left' and 'right', and not one of spring 'left' and spring 'right'.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Model
from lagrangian.model.elements.raw import Kinetic
from lagrangian.page.formula import Item, Left, Table, Text, Verbatim, text

MOST = 6
"""The most operations of a value by which an element is called."""
MOST_OF_ENERGY = 20
"""The same for a kinetic energy."""
PLURALS = {"rigid body": "rigid bodies"}
_SEVERAL = re.compile(
    r"\b(?P<one>[Oo]ne of )(?P<kind>[a-z]{1,20}(?: body)?) (?P<a>'[^']{1,60}') and (?P=kind) (?P<b>'[^']{1,60}')"
)
"""Two elements of one kind, of which one is told."""
_OF_LINES = re.compile(r"(?<=[Ξξ\u0307] of )([^\W\d]\w*+)")
"""The coordinate in the title of a line: Ξ of x, ∂L/∂ξ̇ of x."""
VALUES = ("value", "b", "k")
"""What holds the value of a force, a damper and a spring."""


def called_by_letters(items: Iterable[Item], model: Model) -> tuple[Item, ...]:
    """The items of a report, in whose sentences elements that were numbered have the letters of their values."""
    energies = {e.title: e for e in model.elements if isinstance(e, Kinetic)}
    table = _letters(model) | {title: e.value for title, e in energies.items() if not _is_named(e) and _is_short(e)}
    named = {title: f"the {e.name}" for title, e in energies.items() if _is_named(e)}
    titles = "|".join(rf"\b{re.escape(x)}(?![\w'])" for x in (*table, *named))
    form = re.compile(rf"(?P<of>\b(?:kinetic )?energy of )?(?P<title>{titles or '(?!)'})", re.IGNORECASE)
    coordinates = {c.name: c.symbol for c in model.coordinates}

    def put(item: Item) -> Item:
        if isinstance(item, Table):
            rows = tuple(
                tuple(_of_coordinates(x, coordinates) if isinstance(x, Text) else x for x in r) for r in item.rows
            )
            return replace(item, rows=rows)
        return _of_coordinates(_put(item, form, table, named), coordinates) if isinstance(item, Text) else item

    return tuple(map(put, items))


def _of_coordinates(item: Text, symbols: Mapping[str, sp.Expr]) -> Text:
    """A text in which the coordinate of a line stands as a symbol: Ξ of θ₁, and not Ξ of theta1."""
    parts: list[str | Verbatim | Left] = []
    for part in item.parts:
        if not isinstance(part, str):
            parts.append(part)
            continue
        for k, x in enumerate(_OF_LINES.split(part)):
            parts += [symbols.get(x, x)] if k % 2 else [x] if x else []
    return text(*parts, brief=item.brief)


def _is_named(element: Kinetic) -> bool:
    """Whether the name of an energy is that of a thing: words, and no letter of an energy."""
    words = element.name.split() if element.name != element.title else []
    return bool(words) and all(w.isalpha() and w.isascii() and len(w) > 2 for w in words)


def _is_short(element: Kinetic) -> bool:
    return bounded.operations(element.value) <= MOST_OF_ENERGY


def _put(item: Text, form: re.Pattern[str], table: dict[str, sp.Expr], named: dict[str, str]) -> Text:
    """A sentence with elements called by other words, and by their values."""
    own = {title.lower(): words for title, words in named.items()}
    values = {title.lower(): value for title, value in table.items()}

    def parts() -> Iterator[str | Verbatim | Left]:
        for part in item.parts:
            if not isinstance(part, str):
                yield part
                continue
            at, said = 0, _SEVERAL.sub(_together, part)
            for match in form.finditer(said):
                title, of = match["title"].lower(), match["of"] or ""
                before = said[at : match.start()]
                if title in own:
                    yield f"{before}{of}{own[title]}"
                elif title.startswith("kinetic "):
                    yield f"{before}{of.removesuffix('of ') or 'the kinetic energy '}"
                    yield values[title]
                else:
                    yield f"{before}{of}{match['title'].rpartition(' ')[0]} "
                    yield values[title]
                at = match.end()
            yield said[at:]

    return text(*(x for x in parts() if x != ""), brief=item.brief)


def _together(match: re.Match[str]) -> str:
    """Two elements of one kind with the word for both: one of the springs 'left' and 'right'."""
    return f"{match['one']}the {PLURALS.get(match['kind'], match['kind'] + 's')} {match['a']} and {match['b']}"


def _letters(model: Model) -> dict[str, sp.Expr]:
    """The values of the elements that have a number and no name, by their titles, where each has another one."""
    found = dict[str, sp.Expr]()
    for e in model.elements:
        if e.name != e.title or not e.name.rpartition(" ")[2].isdigit():
            continue
        values: list[Any] = [v for x in VALUES if isinstance(v := getattr(e, x, None), sp.Expr)]
        if len(values) == 1 and values[0].free_symbols and bounded.operations(values[0]) <= MOST:
            value = values[0]
            found[e.title] = -value if value.could_extract_minus_sign() else value
    every = list(found.values())
    return {title: value for title, value in found.items() if every.count(value) == 1}
