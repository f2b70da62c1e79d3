"""What the symbols of a program are that it differentiates by, as its comments list them or its functions imply.

syms x v acc real  % x, x', x''                         v = x', acc = x''
ddt = @(p) diff(p,x)*v + diff(p,v)*acc                  the same: the function is the derivative by time
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping, Sequence
from itertools import islice

import sympy as sp

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.values import NAME, TROUBLES, OwnFunction, Value
from lagrangian.check.reading.names import spelled_rates

_DECLARED = re.compile(
    r"^[ \t]*+(?:syms[ \t](?P<syms>[\w \t,]++)|(?P<names>[\w \t,]++)=[ \t]*+(?:\w++\.)?symbols\([^\n#]*+);?"
    r"[ \t]*+[#%]++(?P<said>[^\n]++)$",
    re.MULTILINE,
)
"""Symbols, and a comment that lists what they are: syms q qd qdd real  % x, x', x''."""
_OF_RATE = re.compile(r"[^\W\d]\w{0,24}['’′]{0,2}")
_COMMENT = re.compile(r"[#%][^\n]*+")
_RATED = re.compile(r"(?<![\w'’*/+-])(?P<name>[^\W\d]\w{0,24})[ ]?=[ ]?(?P<of>[^\W\d]\w{0,24}['’′]{1,2})(?![\w'’*/+-])")
MOST = 24
"""The most symbols of which a function is tried."""


def symbols_said(
    text: str,
    run: Evaluator,
    names: Mapping[str, Value],
    said: Mapping[str, str],
    is_coordinate: Callable[[str], bool],
    free: Callable[[str], bool],
) -> dict[str, str]:
    """What the symbols of a program with ``free`` names are: by its functions, or else by what comments say; ``said``
    are those that stand for names of the system."""
    symbols = [x for name, x in names.items() if isinstance(x, sp.Symbol) and x.name == name][:MOST]
    own = {x.name: said.get(x.name, x.name) for x in symbols}
    coordinates = {name: of for name, of in own.items() if is_coordinate(of)}
    found = _implied(run, names, symbols, coordinates, free) | _in_comments(text, own, is_coordinate)
    found |= listed_symbols(text)
    for x in symbols:  # vd of v, which is x'
        stems = [stem for order, stem in spelled_rates(x.name) if order == 1 and found.get(stem, "").count("'") == 1]
        if stems and x.name not in found and free(x.name):
            found[x.name] = f"{found[stems[0]]}'"
    return {name: said[name] for name in coordinates if name in said} | found


def _in_comments(text: str, own: Mapping[str, str], is_coordinate: Callable[[str], bool]) -> dict[str, str]:
    """The symbols that comments give as rates: v = x'."""
    found: dict[str, str] = {}
    for comment in islice(_COMMENT.finditer(text), MOST):
        for m in _RATED.finditer(comment.group()):
            if m["name"] in own and is_coordinate(own.get(stem := m["of"].rstrip("'’′"), stem)):
                found.setdefault(m["name"], re.sub("[’′]", "'", m["of"]))
    return found


def listed_symbols(text: str) -> dict[str, str]:
    """What a comment behind the declaration of symbols lists them as, each of them."""
    found: dict[str, str] = {}
    for m in _DECLARED.finditer(text):
        names = [x for x in NAME.findall(m["syms"] or m["names"]) if x not in ("real", "positive")]
        items = [x.strip() for x in m["said"].split(",")]
        if len(items) == len(names) and all(map(_OF_RATE.fullmatch, items)):
            found |= dict(zip(names, items, strict=True))
    return found


def _implied(
    run: Evaluator,
    names: Mapping[str, Value],
    symbols: Sequence[sp.Symbol],
    coordinates: Mapping[str, str],
    free: Callable[[str], bool],
) -> dict[str, str]:
    """What symbols with ``free`` names are by the functions of a program that are derivatives by time: of a coordinate
    its rate, and of that its acceleration; none that two functions, or two symbols, say differently."""
    functions = [*run.functions.values(), *(x for x in names.values() if isinstance(x, OwnFunction))]
    said: dict[str, set[str]] = {}
    for f in {id(x): x for x in functions if len(x.arguments) == 1 and _is_formula(x)}.values():
        rates = _rates_by(run, f, symbols)
        for x in (x for x in symbols if x.name in coordinates):
            first = rates.get(x)
            second = rates.get(first) if first is not None else None
            for order, rate in enumerate((first, second), 1):
                if rate is not None and free(rate.name):
                    said.setdefault(rate.name, set()).add(coordinates[x.name] + "'" * order)
    return {name: next(iter(of)) for name, of in said.items() if len(of) == 1}


def _rates_by(run: Evaluator, f: OwnFunction, symbols: Sequence[sp.Symbol]) -> dict[sp.Symbol, sp.Symbol]:
    """The symbols that a function makes of symbols, if it is a derivative: of a product by the rule for products."""
    try:
        made = {x: run.function(f, [x]) for x in symbols}
        moving = {x: y for x, y in made.items() if isinstance(y, sp.Symbol)}
        if not moving or run.function(f, [sp.S.One]) != 0:
            return {}
        a, b = next(iter(moving)), list(moving)[-1]
        product = run.function(f, [a * b]) - (a * moving[b] + b * moving[a])
        return moving if sp.expand(product) == 0 else {}
    except TROUBLES:
        return {}


def _is_formula(f: OwnFunction) -> bool:
    """Whether a function is a formula alone."""
    return isinstance(f.body, ast.expr) or (len(f.body) == 1 and isinstance(f.body[0], ast.Return))
