"""What an answer says of single bodies and springs, v_A = l φ̇ sin φ, J = m r², d = φ − x, and what follows from it.

A line that follows exactly from such a definition has its mistake there, whatever else would lead to the same line.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import combinations, islice, product
from typing import Any, TypeAlias, cast

import numpy as np
import sympy as sp

from lagrangian.check.align import LARGEST, Alignment, alignments
from lagrangian.check.explain.axes_meant import along_turned_axes
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.columns_said import Senses, columns, said_of_column, senses_of
from lagrangian.check.explain.its_body import of_its_body
from lagrangian.check.explain.line_mistakes import stated
from lagrangian.check.explain.nearest_axes import nearest
from lagrangian.check.explain.own_rates import said_of_length
from lagrangian.check.explain.parts_of_energies import parts_in_whole_terms
from lagrangian.check.explain.quantities import quantities_of
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.said_wrongly import SaidWrongly, right_quantities, said_of, said_of_rate
from lagrangian.check.explain.search import MOST_FOR_PAIRS, SMALL, Explanation, without_constant
from lagrangian.check.explain.sheets import sheets
from lagrangian.check.held import OnConstraints
from lagrangian.check.reference import Reference, without_time
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import index_of, right_value, without_dampers
from lagrangian.check.verdict import AnsweredLine, Finding
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import RigidBody
from lagrangian.page.formula import text
from lagrangian.read.letters import key
from lagrangian.records import dataclass

JUDGED = frozenset(["T", "V", "L", "D", "Xi", "p", "p-rate", "slope", "left", "equation"])
"""The kinds of lines that are compared with what definitions lead to."""
MOST_DEFINITIONS = 16
"""The largest number of definitions that are compared with the bodies."""
MOST_TOGETHER = 3
"""The largest number of wrong definitions from which one line follows."""
MOST_ALIGNED = 12
"""The most correspondences of the equations of an answer with the right ones that are tried."""
MOST_PARTS, MOST_FOR_THREE = 120, 16
"""The most quantities of bodies that are tried, and the most of which three are tried together."""
WHOLE = "translation_forgotten"
NOT_OF_BODIES = (
    "half_forgotten",
    "mass_swapped",
    "carried_mass_forgotten",
    WHOLE,
    "rotation_forgotten",
)
"""Mistakes that are not made in the speed, the position or the inertia of a body."""
LEFT_OUT = ("left_out_of_a_sum", "lost", "lost_in_a_sum", "not_squared")

Block: TypeAlias = tuple[Array, Array]
"""What is wrong in a line at every state, and what each definition adds to it, (parts, states); both are scaled."""


@dataclass(frozen=True)
class Blamed:
    """Wrong definitions, and the wrong lines and the other definitions that follow from them."""

    said: tuple[SaidWrongly, ...]
    because: tuple[AnsweredLine, ...]
    later: tuple[AnsweredLine, ...] = ()


def blamed_also(blamed: Blamed | None, said: Sequence[SaidWrongly], line: AnsweredLine) -> Blamed:
    """What is blamed, with what one more line follows from."""
    known = blamed if blamed is not None else Blamed((), ())
    lines = [p.line for p in known.said]
    more = [p for p in said if not any(p.line is x for x in lines)]
    return Blamed((*known.said, *more), (*known.because, line), known.later)


def agrees(explanation: Explanation, said: Sequence[SaidWrongly]) -> bool:
    """Whether an explanation may be what the definitions have wrong: it quotes no other letters than these.

    A number, a whole part that is left out, or masses that are exchanged would not show in them; that ½mv² is missing
    beside the moment of inertia about the centre of mass would.
    """
    central = all(p.elsewhere and p.words.of.kind == "axis" for p in said)
    known = frozenset[Any]().union(*(p.letters for p in said))
    for t in explanation.told:
        change, wrong = t.mistake.change, t.mistake.wrong
        if wrong is not None:
            quoted = {x for part in wrong.variant.what.parts if isinstance(part, sp.Symbol) for x in letters_in(part)}
            if (wrong.name in NOT_OF_BODIES and not (central and wrong.name == WHOLE)) or not quoted <= known:
                return False
        if change is not None:
            exprs = (change.right, change.written)
            right, written = (letters_in(x) if isinstance(x, sp.Expr) else set[Any]() for x in exprs)
            lost = change.kind in LEFT_OUT and right and all(right <= p.own_letters for p in said)
            if change.kind == "part" or lost or not right | written <= known:
                return False
    return True


def apart_from(right: Sequence[AnsweredLine], wrong: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The right lines that are no rows of an equation of matrices of which another row is wrong: they have the names of
    all entries."""
    texts = {(line.number, line.text) for line in wrong}
    return [x for x in right if (x.number, x.text) not in texts]


class BodiesSaid:
    """The wrong definitions of an answer that may be of bodies, ready to be compared with its lines.

    No name is defined wrongly that stands in a ``right`` line. ``rates`` are wrong rates of the answer's own places.
    """

    def __init__(
        self,
        truth: Reference,
        lines: Sequence[AnsweredLine],
        right: Sequence[AnsweredLine] = (),
        rates: Sequence[AnsweredLine] = (),
    ) -> None:
        self.truth, self.lines, self.rates = truth, lines, rates
        self.is_T_right = any(x.kind == "T" for x in right)
        self.proved = frozenset[str]().union(*(x.names for x in right if x.kind in JUDGED and x.expr != 0))

    @cached_property
    def parts(self) -> list[SaidWrongly]:
        """What the definitions may have wrong."""
        held = columns(self.lines)
        entries = {id(x) for column in held for x in column}
        entries |= {id(x) for x in parts_in_whole_terms(self.truth, self.lines)}
        told = [(x,) for x in self.lines if x.kind == "definition" and id(x) not in entries]
        open_ones = [x for x in held if key((x[0].name or "").removesuffix("_1")) not in self.proved]
        open_ones += [x for x in told if key(x[0].name or "") not in self.proved]
        open_ones += [(x,) for x in self.rates]
        ordered = sorted(open_ones, key=lambda x: x[0].number)[:MOST_DEFINITIONS]
        turned = along_turned_axes(self.truth, self.lines)
        senses = senses_of(self.truth, held)
        ordered.sort(key=lambda x: len(x) == 1 and bool(right_quantities(self.truth, x[0], turned=id(x[0]) in turned)))
        every = (p for x in ordered for p in _parts(self.truth, x, turned, senses))  # what is right comes last
        return sorted(islice(every, MOST_PARTS), key=lambda p: p.number)

    def of_all(self, findings: Sequence[Finding], every: Sequence[AnsweredLine]) -> Blamed | None:
        """The fewest wrong definitions from which all lines follow that are wrong; None if there are none.

        ``every`` are these lines, those that may have been meant otherwise not among them.
        """
        wrong = [line for line in every if not any(line is x for x in self.rates) and not self._holds(line)]
        if not wrong or any(line.kind not in JUDGED for line in wrong) or not self.parts:
            return None
        blocks = [self._of_value(x) for x in wrong if x.kind != "equation"]
        if any(x is None for x in blocks):
            return None
        direct = [x for x in blocks if x is not None]
        rows = [x for x in wrong if x.kind == "equation"]
        equations = [f for f in findings if f.line.kind == "equation" and f.line.expr != 0]
        dealt = [sheet for sheet in sheets(self.truth, equations) if any(x is y for x in sheet for y in rows)]
        if not all(any(x is y for sheet in dealt for y in sheet) for x in rows):
            return None
        under = [alignments(self.truth, *stated(self.truth, sheet))[:MOST_FOR_PAIRS] for sheet in dealt]
        for chosen in islice(product(*under), MOST_ALIGNED):
            if (found := self._blamed([*direct, *map(self._of_rows, chosen)], wrong)) is not None:
                return found
        return None

    def _holds(self, line: AnsweredLine) -> bool:
        """Whether an equation holds along every right motion on constraints, as what these ask of the accelerations."""
        if not isinstance(self.truth, OnConstraints) or line.kind != "equation":
            return False
        values = CompiledExpressions([line.expr]).at(self.truth.states, self.truth.accelerations)[0]
        return bool(np.isfinite(values).all()) and bool(np.abs(values).max() <= SMALL)

    def _of_rows(self, under: Alignment) -> Block:
        """What is wrong in a set of equations, and what each definition adds to them."""
        scale, rows = np.abs(under.rest).max() + np.abs(self.truth.W).max(), self._rows
        return under.rest.ravel() / scale, rows[:, list(under.rows)].reshape(len(rows), -1) / scale

    @cached_property
    def _rows(self) -> Array:
        """What each definition adds to the left-hand sides, (parts, n, states); NaN where it is too large."""
        every = np.array([p.rows(self.truth) for p in self.parts])
        every[~(np.abs(every) <= LARGEST).all(axis=(1, 2))] = np.nan
        return every

    def _of_value(self, line: AnsweredLine) -> Block | None:
        """What is wrong in an energy, a Ξ or a derivative, and what each definition adds to it; None if it is too small
        or too large."""
        truth, i = self.truth, index_of(self.truth, line.name)
        right = right_value(truth, line, i)
        if line.kind == "Xi" and (undamped := without_dampers(truth, line, i, self.lines)) is not None:
            right = undamped
        if right is None:
            return None
        exprs = [line.expr - right, *(p.adds(truth, line.kind, i) for p in self.parts)]
        exprs = [without_time(truth, sp.sympify(x)) for x in exprs] if line.kind == "V" else exprs
        values = CompiledExpressions(exprs).at(truth.states)
        values = without_constant(values) if line.kind in ("V", "L") else values
        size = np.abs(values[0]).max()
        return (values[0] / size, values[1:] / size) if 1e-12 < size < LARGEST else None

    def _blamed(self, blocks: Sequence[Block], wrong: Sequence[AnsweredLine]) -> Blamed | None:
        """The fewest definitions that add what is wrong, the first that uses no other one, and those that follow."""
        rest = np.concatenate([x for x, _ in blocks])
        effects = np.concatenate([x for _, x in blocks], axis=1)
        own = [k for k, p in enumerate(self.parts) if not p.elsewhere]
        good = [k for k in own if np.isfinite(effects[k]).all() and np.abs(effects[k]).max() > SMALL]
        for count in range(1, MOST_TOGETHER + 1 if len(good) <= MOST_FOR_THREE else 3):
            chosen = [k for k in combinations(good, count) if self._leads_to(effects, k, rest) and self._differ(k)]
            if not chosen:
                continue
            if self.is_T_right or all(x.kind == "V" for x in wrong):  # a height, not a position that is differentiated
                chosen.sort(key=lambda c: any(self.parts[k].T != 0 for k in c))
            said = nearest(self.truth, [tuple(self.parts[k] for k in c) for c in chosen])
            if count == 1:
                firsts: dict[int, SaidWrongly] = {}  # of several on one line, in the order in which they stand there
                for (k,) in chosen:
                    firsts.setdefault(id(self.parts[k].line), self.parts[k])
                first = _first_of(sorted(firsts.values(), key=lambda p: p.number))
                same = [p for k in chosen for p in [self.parts[k[0]]] if p.line is first.line]
                said = self._used_by(first, effects, good, rest) or (of_its_body(self.truth, self.lines, same),)
            own = self._of_their_own(said)
            places, lines = [self._place(p) for p in said], [p.line for p in own]
            wholes = [*(effects[k] for k in places), rest]
            alike = [k for k in good if any(np.abs(effects[k] - x).max() <= SMALL for x in wholes)]
            alike += [*self._of_energy_alone(places), *self._of_parts(said)]
            later = [self.parts[k].line for k in alike if not any(self.parts[k].line is x for x in lines)]
            later += [p.line for p in said if p not in own]
            return Blamed(own, tuple(wrong), tuple({id(x): x for x in later}.values()))
        return None

    def _of_their_own(self, said: tuple[SaidWrongly, ...]) -> tuple[SaidWrongly, ...]:
        """Those of several wrong definitions that are not right as soon as the others are which they use.

        So v² = v₁² + v₂² of one of two equal bodies follows from the v₂ above it, that is told of the other, and in a
        program, of which the values are put in, yc = yb of another body.
        """

        def follows(p: SaidWrongly) -> bool:
            used = [x for x in said if x is not p and (key(x.line.name or "") in p.line.names or _is_put_in(x, p))]
            if not used or p.right is None:
                return False
            expr = p.line.expr
            for x in used:
                expr = expr if x.right is None else cast("sp.Expr", expr.subs(x.line.expr, x.right))
            return zero_everywhere(self.truth, self.truth.put(self.truth.expand(expr)) - p.right)

        return tuple(p for p in said if not follows(p))

    def _used_by(self, said: SaidWrongly, effects: Array, good: Sequence[int], rest: Array) -> tuple[SaidWrongly, ...]:
        """The several definitions that one uses, and that add up to the same: T₂ is wrong by its ẋ₂ and its ẏ₂."""
        names = said.line.names - {key(said.line.name or "")}
        own = [k for k in good if key(self.parts[k].line.name or "") in names]
        for count in range(2, min(len(own), MOST_TOGETHER) + 1 if len(own) <= MOST_FOR_THREE else 3):
            for chosen in combinations(own, count):
                if self._leads_to(effects, chosen, rest) and self._differ(chosen):
                    return tuple(self.parts[k] for k in chosen)
        return ()

    def _place(self, said: SaidWrongly) -> int:
        """The place of what has the same effect among what the definitions may have wrong."""
        return next(k for k, p in enumerate(self.parts) if p.effect is said.effect)

    def _of_energy_alone(self, places: Sequence[int]) -> list[int]:
        """The definitions that add to T* or V alone what some others add to it, as v_S does beside r_S."""
        exprs = [x for p in self.parts for x in (p.T, p.V)]
        both = CompiledExpressions(exprs).at(self.truth.states).reshape(len(self.parts), 2, -1)
        sizes = np.abs(both).max(axis=2)
        found: list[int] = []
        for k, (p, size) in enumerate(zip(self.parts, sizes, strict=True)):
            energies = [j for j in (0, 1) if size[j] > 0]
            if len(energies) == 1 and not p.elsewhere and not any(p.effect.Xi) and not any(p.effect.left):
                j = energies[0]
                near = [np.abs(both[k, j] - both[i, j]).max() <= SMALL * size[j] for i in places if i != k]
                found += [k] if any(near) else []
        return found

    def _of_parts(self, said: Sequence[SaidWrongly]) -> list[int]:
        """The kinetic energies of which only the translation, or the rotation, is said with what some others add."""
        s, found = quantities_of(self.truth).of, list[int]()
        for k, p in enumerate(self.parts):
            owner = p.words.of.owner if p.words.of.kind == "kinetic" else None
            mine = [x.T for x in said if isinstance(owner, RigidBody) and x.words.of.owner is owner and x.T != 0]
            if not mine:
                continue
            rests = [p.T + self.truth.put(x) - sp.Add(*mine) for x in (s.rotation(owner), s.translation(owner))]
            values = CompiledExpressions([*rests, p.T]).at(self.truth.states)
            found += [k] if any(np.abs(x).max() <= SMALL * np.abs(values[-1]).max() for x in values[:-1]) else []
        return found

    def _leads_to(self, effects: Array, chosen: Sequence[int], rest: Array) -> bool:
        """Whether definitions of different lines add up to what is wrong."""
        if len({id(self.parts[k].line) for k in chosen}) < len(chosen):
            return False
        return bool(np.abs(effects[list(chosen)].sum(axis=0) - rest).max() <= SMALL)

    def _differ(self, chosen: Sequence[int]) -> bool:
        """Whether definitions say different quantities: one of them is not wrong twice."""
        return len(chosen) == 1 or len({str(text(*self.parts[k].words.of.words)) for k in chosen}) == len(chosen)

    def of_line(self, line: AnsweredLine) -> list[SaidWrongly]:
        """The wrong definitions from which a line of T*, V, L or D follows; none if it follows from none."""
        truth = self.truth
        right = right_value(truth, line, None) if line.kind in ("T", "V", "L", "D") else None
        if right is None or not self.parts:
            return []
        effects = [p.adds(truth, line.kind, None) for p in self.parts]
        exprs = [line.expr - right, *effects]
        exprs = [without_time(truth, sp.sympify(x)) for x in exprs] if line.kind == "V" else exprs
        values = CompiledExpressions(exprs).at(truth.states)
        level = values if line.kind in ("T", "D") else without_constant(values)
        return self._named(level[0], level[1:])

    def borne_out(self, pool: Pool, group: Sequence[Explanation]) -> list[Explanation]:
        """Of explanations of equations, those that change T* as a wrong definition does; all if no definition does."""
        parts = [p for p in self.parts if p.T != 0 and p.V == 0] if len(group) > 1 else []
        if not parts:
            return list(group)
        found: list[Explanation] = []
        for part, values in zip(parts, CompiledExpressions([p.T for p in parts]).at(self.truth.states), strict=True):
            size = np.abs(values).max()
            if not np.isfinite(values).all() or not 1e-12 < size < LARGEST:
                continue
            for e in group:
                made = np.sum([float(t.times) * pool.T[pool.places[id(t.mistake)]] for t in e.told], axis=0)
                if e not in found and agrees(e, [part]) and np.abs(made - values).max() <= SMALL * size:
                    found.append(e)
        return found or list(group)

    def _named(self, rest: Array, effects: Array) -> list[SaidWrongly]:
        """The fewest definitions whose effects add up to what is wrong; none if it is nothing."""
        size = np.abs(rest).max(initial=0.0)
        if not np.isfinite(rest).all() or not 1e-12 < size < LARGEST:
            return []
        good = [k for k, x in enumerate(effects) if np.isfinite(x).all() and np.abs(x).max() > 1e-12]
        for count in range(1, MOST_TOGETHER + 1 if len(good) <= MOST_FOR_THREE else 3):
            for chosen in combinations(good, count):
                said = [self.parts[k] for k in chosen]
                if len({p.number for p in said}) < count:
                    continue
                if np.abs(effects[list(chosen)].sum(axis=0) - rest).max() <= SMALL * size and self._differ(chosen):
                    return sorted(said, key=lambda p: p.number)
        return []


def _is_put_in(said: SaidWrongly, other: SaidWrongly) -> bool:
    """Whether what one definition says stands in another one below it."""
    own = said.line.expr
    return said.number < other.number and len(own.args) > 1 and other.line.expr.has(own)


def _parts(
    truth: Reference, lines: Sequence[AnsweredLine], turned: frozenset[int], senses: Senses
) -> Iterator[SaidWrongly]:
    """What a definition, a column or a rate may have wrong; ``turned`` are definitions along axes that turn."""
    if len(lines) > 1:
        return said_of_column(truth, tuple(lines), senses)
    (line,) = lines
    if line.kind == "equation":
        return said_of_length(truth, line)
    return said_of_rate(truth, line) if line.kind == "identity" else said_of(truth, line, turned=id(line) in turned)


def _first_of(said: Sequence[SaidWrongly]) -> SaidWrongly:
    """The first of several definitions of which each explains all, that uses none of the others."""
    names = [key(p.line.name or "") for p in said]
    free = [p for p, own in zip(said, names, strict=True) if not p.line.names & {x for x in names if x != own}]
    return (free or said)[0]
