"""What a program states, carried out on symbols: energies, equations, and the accelerations that it computes."""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from functools import partial
from itertools import chain
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.added_up import pieces
from lagrangian.check.reading.carried_out.closed_loops import OpenInterpreter, inputs_named, names_in
from lagrangian.check.reading.carried_out.given_values import given_values
from lagrangian.check.reading.carried_out.in_comments import equations_in_comments
from lagrangian.check.reading.carried_out.interpreter import Interpreter
from lagrangian.check.reading.carried_out.julia import in_matlab, is_julia
from lagrangian.check.reading.carried_out.loose import Loose, loose_rates
from lagrangian.check.reading.carried_out.marking import MarkingInterpreter
from lagrangian.check.reading.carried_out.matlab import in_python
from lagrangian.check.reading.carried_out.moving_names import MovingNames
from lagrangian.check.reading.carried_out.prescribed_rates import other_rates
from lagrangian.check.reading.carried_out.rates_said import symbols_said
from lagrangian.check.reading.carried_out.solved import equations, explicit
from lagrangian.check.reading.carried_out.states import StateFunction, StateReader
from lagrangian.check.reading.carried_out.values import (
    NAME,
    TIME,
    TROUBLES,
    AbandonedError,
    Equation,
    Shown,
    Value,
    listed,
)
from lagrangian.check.reading.carried_out.ways import in_own_coordinates, ways
from lagrangian.check.reading.carried_out.written import LONGEST_LINE, written
from lagrangian.check.reading.marked_values import ValueMarks
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.own_inputs import told
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.model import Model
from lagrangian.read.scope import Scope
from lagrangian.records import dataclass, field

LONGEST_PROGRAM, DEEPEST = 20_000, 40
"""The most characters of a program, and how deep brackets may stand in it."""
_PYTHON = re.compile(r"^[ \t]*+(?:import|from)[ \t]++\w|^[ \t]*+def[ \t]++\w++\(|=[ \t]*+lambda[ \t]", re.MULTILINE)
_QUOTED = re.compile(r"^[^\W\d]\w*+[ \t]*+=[ \t]*+(?P<q>[\"'])[^\"'\n]*[*^/+][^\"'\n]*(?P=q)[ \t]*+$", re.MULTILINE)
_MATLAB = re.compile(
    r"^[ \t]*+function\b[^\n(]{0,60}\(|^[ \t]*+syms[ \t]|[=(,][ \t]*+@\(|^[^%#\n\\]*+\\[ \t]?\w[^\n%]*+(?:%[^\n]*+)?$"
    r"|^[^%#\n\\=]*+=[^%#\n\\=]*+(?<=[\w\]) \t])\\(?:(?<=[ \t]\\)[ \t]++|(?<=[\w\])]\\))[\[(]"
    r"|^[^%#\n=]*+=[^%#\n]*?(?:(?<=[\w)\]])\.['’][ \t]*+\*|\b(?:blkdiag|eye)\()"
    r"|^[^%\n]*+%[^%\n=]{0,60}=[^%\n]{0,60}?\b[A-Z]\*[a-z]\b",
    re.MULTILINE,
)
"""Signs of MATLAB: a function, symbols, A \\ b, A \\ [c; d], A.'*b, eye(3), and % … = A*x."""
_LATEX = re.compile(r"\\(?:d?dot|[dt]?frac|begin|left|text|cdot)")
_MARKS = re.compile(r"^(?:[ \t]*+(?:```\w*+|>>>[ \t]?|\.\.\.[ \t]|In[ \t]*+\[\d*+\]:[ \t]?))", re.MULTILINE)
_COMMENT = re.compile(r"^[ \t]*+(?:#|%|//)++(?P<said>[^\n]*+)$", re.MULTILINE)
_ACCELERATES = re.compile(
    r"['’′]{2}|[\u0308″]|Derivative\([^\n]{1,40}2\)\)|\w(?:_?ddot|dd|_tt|pp)\b|(?<!\w)dd(?=[a-zA-Z])|\\ddot"
)
_LABEL = re.compile(r"[ \t]*+\w{1,20}[(\[]\d[)\]][ \t]*+=")
"""An entry of a column of the program, in a comment: eom(1) = …"""
_HEAD = re.compile(r"[ \t]*+(?P<name>[^\W\d]\w{0,24})[ \t]*+:(?!=)")
"""The name of the program's own for an equation, in front of it in a comment: eq1: …"""
_COMMENTED = re.compile(r"[#%][^\n]*+")
_MEANS = re.compile(
    r"(?<![\w'’*/+-])(?P<name>[^\W\d]\w{0,24})[ ](?:is|for|stands for|means|denotes|=|->)[ ](?:the[ ])?"
    r"(?P<of>[^\W\d]\w{0,24})(?![\w'’(*/+-])"
)
"""What a comment says of a name: R is r."""
_ENERGIES = frozenset(["T", "V", "U", "L", "D"])


@dataclass(frozen=True)
class CarriedOut:
    """What a program states, each statement on the line where the program has it; with its comments and without."""

    text: str
    """With the comments that hold accelerations, as they are."""
    bare: str
    motion: str
    """The equations of motion alone, with what names in them mean."""
    notes: tuple[str, ...] = ()
    closed: Mapping[str, Set[sp.Basic]] = field(default_factory=dict)
    """The inputs that were left open, with the letters in what the program gives them."""


def carried_out(text: str, model: Model, marks: ValueMarks | None = None, *, opened: bool = False) -> CarriedOut | None:
    """Return what a program in Python, MATLAB or Julia states.

    None if it is no such program, or states nothing that can be carried out. Nothing is executed: the syntax tree is
    carried out on symbols; with ``marks``, in the values that it assigns. ``opened``: inputs that get values
    of a state are left as they are.
    """
    matlab = _PYTHON.search(text) is None and len(_QUOTED.findall(text)) < 2
    if len(text) > LONGEST_PROGRAM or _depth(text) > DEEPEST:
        return None
    loose = loose_rates(text) if matlab else None
    if matlab and ((_MATLAB.search(text) is None and loose is None) or _LATEX.search(text) is not None):
        return None
    matlab = matlab and (loose is None or not loose.from_zero)
    bare = _MARKS.sub(lambda m: "" if "`" not in m.group() else "#", text)
    scope = AnswerScope(Scope(model.symbols))
    scope.used = None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SyntaxWarning)
            bare = in_matlab(bare) if matlab and is_julia(bare) else bare
            tree = ast.parse(in_python(bare) if matlab else bare)
        known = partial(_is_constant, scope, model=model)
        said = {m["name"]: m["of"] for x in _COMMENTED.findall(text) for m in _MEANS.finditer(x)}
        given = {name for name, of in said.items() if known(of) and not scope.meanings(name)[0]}
        run = _interpreter(tree, model, scope, matlab=matlab, known=known, said=given, marks=marks, opened=opened)
        behind = ((k, _COMMENTED.search(x)) for k, x in enumerate(text.split("\n"), 1))
        run.behind = {k: m.group() for k, m in behind if m is not None}
        names = run.run(tree, {} if loose is None else {loose.state.name: loose.state})
        of_symbols = _of_symbols(text, run, names, said, model, scope)
        moving = MovingNames(model, scope, of_symbols)
        found = list(_statements(run, moving, _ENERGIES - _entries(tree)))
        reader = StateReader(run, text, model, scope)
        with suppress(*TROUBLES):  # a function of its own that returns no rates
            found += _of_states(run, names, reader, loose)
        found += [(one.line, f"{called} = {written(one.value)}") for one, called in other_rates(run)]
        twice = {name for name, of in of_symbols.items() if _ACCELERATES.search(of)}
        if not any(_accelerates(x, twice) for _, x in found):
            in_comments = equations_in_comments(run, names, reader)
            found += [(line, f"{written(explicit(run, x))} = 0") for line, entries in in_comments for x in entries]
    except (*TROUBLES, SyntaxError, RecursionError, MemoryError):
        return None
    if not any(_accelerates(x, twice) for _, x in found):
        return None
    own = {x.id for x in ast.walk(tree) if isinstance(x, ast.Name) and isinstance(x.ctx, ast.Store)}
    own -= {TIME.name, *of_symbols, *(x for x, q in names.items() if isinstance(q, AppliedUndef) and str(q.func) == x)}
    foreign = {x for x in own if not _is_of_system(scope, x)}
    meant = list(_renamed(of_symbols | said | run.renamed, found, scope))
    meant += _assigned(in_own_coordinates(run, found, model, scope))
    motion = [*meant, *(x for x in found if _accelerates(x[1], twice))]
    found = [
        *meant,
        *_assigned(ways(run, MovingNames(model, scope), model, partial(_is_place_of_system, scope))),
        *found,
    ]
    lines = text.split("\n")
    comments = _comments(lines, twice, foreign)
    bare, motion_alone = (_laid_out([""] * len(lines), x) for x in (found, motion))
    closed = run.closed if isinstance(run, OpenInterpreter) else {}
    return CarriedOut(_laid_out(comments, found), bare, motion_alone, tuple(_notes(run)), closed)


def _interpreter(
    tree: ast.Module, model: Model, scope: AnswerScope, *, marks: ValueMarks | None, opened: bool, **given: Any
) -> Interpreter:
    """What carries out a program, with the parameters and the input that it does not name."""
    named = {y for x in names_in(tree) for y in scope.meanings(x)[0]}
    free = [u.name for u in model.inputs if u.name not in named]
    given |= {"valued": [p for p in model.parameters if p.name not in named], "states": 2 * len(model.coordinates)}
    given |= {"driven": free[0] if len(free) == 1 else None, "values": given_values(names_in(tree), model, scope)}
    if opened:
        return OpenInterpreter(inputs=inputs_named(tree, scope, model), **given)
    return Interpreter(**given) if marks is None else MarkingInterpreter(marks=marks, **given)


def _notes(run: Interpreter) -> Iterator[str]:
    """What names of the program were read as, and what was not carried out."""
    if run.drives is not None and run.driven is not None:
        yield told(f"{run.drives}(t)", run.driven)
    yield from (told(name, of) for name, of in run.read_as.items())
    yield from run.values.notes()
    yield from (_left_out(first, last) for first, last in dict.fromkeys(run.left_out))


def _comments(lines: Sequence[str], twice: Set[str], foreign: Set[str]) -> list[str]:
    """What comments with accelerations say, line by line, which have no ``foreign`` names but in front of equations."""
    said_of = [m["said"] if (m := _COMMENT.match(x)) and _accelerates(m["said"], twice) else "" for x in lines]
    said_of = [x[m.end() :] if (m := _HEAD.match(x)) and m["name"] in foreign else x for x in said_of]
    said_of = ["" if foreign & set(NAME.findall(x)) else x for x in said_of]
    return [f"{x[m.end() :]} = 0" if (m := _LABEL.match(x)) and x.count("=") == 1 else x for x in said_of]


def _accelerates(said: str, twice: Set[str]) -> bool:
    """Whether an acceleration is in a text: in its spelling, or by one of the names that stand for some."""
    return _ACCELERATES.search(said) is not None or not twice.isdisjoint(NAME.findall(said))


def _left_out(first: int, last: int) -> str:
    """The note on a statement that was not carried out."""
    said = f"Line {first} was" if first == last else f"Lines {first} to {last} were"
    return f"{said} not carried out: nothing is known of what changes there."


def _assigned(values: Iterable[tuple[int, str, list[sp.Expr]]]) -> Iterator[tuple[int, str]]:
    """What names stand for, with their lines."""
    for line, name, value in values:
        with suppress(AbandonedError):
            entries = ", ".join(map(written, value))
            yield line, f"{name} = ({entries})" if len(value) > 1 else f"{name} = {entries}"


def _is_place_of_system(scope: AnswerScope, name: str) -> bool:
    """Whether a name of a place is one of the system, or of a momentum: px of x."""
    return _is_of_system(scope, name) or (name.startswith("p") and _is_of_system(scope, name[1:].lstrip("_")))


def _is_of_system(scope: AnswerScope, name: str) -> bool:
    """Whether a name is one of the system, or of a rate of it in letters."""
    return any(scope.meanings(x)[0] for x in (name, *(stem for _, stem in spelled_rates(name))))


def _renamed(
    meant: Mapping[str, str], found: Sequence[tuple[int, str]], scope: AnswerScope
) -> Iterator[tuple[int, str]]:
    """What symbols in statements are that the system does not have, as subs(…) or a comment says."""
    for name, of in meant.items():
        used = any(re.search(rf"(?<!\w){re.escape(name)}(?!\w)", x) for _, x in found)
        if used and not scope.meanings(name)[0] and _is_of_system(scope, of.rstrip("'’′")):
            yield 1, f"{name} = {of}"


def _of_symbols(
    text: str, run: Interpreter, names: Mapping[str, Value], said: Mapping[str, str], model: Model, scope: AnswerScope
) -> dict[str, str]:
    """What symbols are that the system does not name, as comments say or else the program's derivatives by time."""
    coordinates, used = {c.name for c in model.coordinates}, set(run.used)

    def is_coordinate(name: str) -> bool:
        return not coordinates.isdisjoint(scope.meanings(name)[0])

    found = symbols_said(text, run, names, said, is_coordinate, lambda name: not _is_of_system(scope, name))
    run.used = used
    return found


def _is_constant(scope: AnswerScope, name: str, model: Model) -> bool:
    """Whether a name is a parameter or an input."""
    found = scope.meanings(name)[0]
    return any(x.name in found for x in (*model.parameters, *model.inputs))


def _depth(text: str) -> int:
    depth = most = 0
    for c in text:
        depth += (c in "([{") - (c in ")]}")
        most = max(most, depth)
    return most


def _laid_out(lines: Sequence[str], found: Sequence[tuple[int, str]]) -> str:
    """The statements on their lines, behind what is there."""
    made = list(lines)
    for line, said in found:
        at = min(max(line - 1, 0), len(made) - 1)
        made[at] = f"{made[at]} ; {said}" if made[at] else said
    return "\n".join(made)


def _entries(tree: ast.Module) -> set[str]:
    """The names that stand in entries of square matrices, which are no energies: D in [D, I; I, I]."""
    rows = [x.elts for x in ast.walk(tree) if isinstance(x, ast.List) and len(x.elts) > 1]
    square = [x for x in rows if all(isinstance(row, ast.List) and len(row.elts) == len(x) for row in x)]
    parts = [entry for matrix in square for row in matrix for entry in cast("ast.List", row).elts]
    found: set[str] = set()
    while parts:
        part = parts.pop()
        found |= {part.id} if isinstance(part, ast.Name) else set()
        if isinstance(part, (ast.BinOp, ast.UnaryOp)):  # no call: diff(T, x)
            parts += [x for x in ast.iter_child_nodes(part) if isinstance(x, ast.expr)]
    return found


def _statements(run: Interpreter, rates: MovingNames, energies: Set[str]) -> Iterator[tuple[int, str]]:
    """The energies and the equations that are assigned or shown; an equation that is used for another is none."""
    told: set[str] = set()
    hidden = [x for _, method in run.methods for x in method.hidden]
    shown = [Shown(line, None, x, True) for line, method in run.methods for x in method.told]
    last = {x.name: x for x in run.stated}
    for one in (*shown, *(x for x in run.stated if x.name is None or last[x.name] is x)):
        if any(one.value is x for x in hidden):
            continue  # F_r and F_r* of Kane's method
        if isinstance(one.value, str) and one.name is not None and _in_quotes(one.value):
            yield one.line, one.value if "=" in one.value else f"{one.name} = {one.value}"
            continue
        final = (one.shown or one.name not in run.used) and one.of not in run.sides
        for value in listed(one.value) if isinstance(one.value, (list, MatrixBase)) else [one.value]:
            said = None
            if isinstance(value, Equation):
                said = f"{written(value.left)} = {written(value.right)}" if final else None
            elif not isinstance(value, sp.Expr) or not value.args:
                continue
            elif one.name in energies and rates.order(value) == 1:
                *parts, (_, said) = pieces(str(one.name), run.stated) or [(one.line, f"{one.name} = {written(value)}")]
                yield from parts
            elif final and rates.order(value) == 2:
                said = f"{written(value)} = 0"
            if said is not None and said not in told:
                told.add(said)
                yield one.line, said


def _in_quotes(text: str) -> bool:
    return 4 < len(text) < LONGEST_LINE and re.search(r"[\w)][ ]?(?:\*|\+|=|/|\^)", text) is not None


def _of_states(
    run: Interpreter, names: dict[str, Value], reader: StateReader, loose: Loose | None
) -> Iterator[tuple[int, str]]:
    """The accelerations that the functions of a program return, as equations of motion."""
    in_the_open = None if loose is None else reader.in_the_open(loose, names.get(loose.rates))
    functions = reader.functions(names) if in_the_open is None else (in_the_open,)
    none = True
    for found in chain(functions, _solved_in_the_open(run, reader)):
        none = False
        yield from equations(run, found, reader)
    if none and (found := reader.by_parts()) is not None:
        yield from equations(run, found, reader)


def _solved_in_the_open(run: Interpreter, reader: StateReader) -> Iterator[StateFunction]:
    """What acc = A\\b says in the open, whose entries a comment may name."""
    coordinates = [c.name for c in reader.model.coordinates]
    for one in run.stated:
        solved = one.value if isinstance(one.value, MatrixBase) else sp.zeros(0, 1)
        if one.name is None or one.name in run.used or not len(solved) or not set(solved.flat()) <= run.solved.keys():
            continue
        called = reader.in_comments(one.name) or reader.behind(one.line)
        rates = [sp.Symbol(called[k + 1]) for k in range(len(solved)) if k + 1 in called]
        n = len(coordinates)
        if not rates and len(solved) in (n, n + len(reader.model.constraints)):
            said = reader.in_comments("q")
            named = [said.get(k + 1, "") for k in range(n)]
            listed_so = sorted(x for name in named for x in reader.scope.meanings(name)[0]) == sorted(coordinates)
            rates = [sp.Function(x)(TIME).diff(TIME, 2) for x in (named if listed_so else coordinates)]
            solved = solved[:n, :]
        rates = rates or reader.rates_of(one.name, len(solved))
        if len(rates) == len(solved):
            yield StateFunction(one.line, list(zip(rates, solved.flat(), strict=True)), {})
