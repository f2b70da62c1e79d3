"""Converts statements to lines: determines what each one states, and the order in which names are defined."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise
from typing import cast

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.amounts import amounts_to, parameter_given, without_amounts
from lagrangian.check.reading.answer import AnswerLine, Kind
from lagrangian.check.reading.chained_names import given_by_chains
from lagrangian.check.reading.circles import first_without_circles
from lagrangian.check.reading.line_forms import (
    Statement,
    accelerates,
    asides,
    define_rate,
    entries_of,
    forget_unused,
    is_general,
    is_of_entries,
    is_rate_of,
    made_line,
    matrix_rows,
    rated_energy,
    says_constant,
    solves,
    tell_expression,
    together,
    without_expressions,
)
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.named_accelerations import named_accelerations
from lagrangian.check.reading.named_factors import with_solved_factors
from lagrangian.check.reading.names import COLUMNS, Names, Value, spelled_rates
from lagrangian.check.reading.nodes import derived, differentiated_by, has_matrix, is_matrix, names_in, only_name
from lagrangian.check.reading.own_angles import own_angle
from lagrangian.check.reading.own_letters import own_letters
from lagrangian.check.reading.parts import left_out, tell_general, tell_vectors, tells, why_not_judged, without_parts
from lagrangian.check.reading.placeholders import (
    ENERGIES,
    generalized_force,
    is_placeholder,
    is_slope,
    is_vector,
    multiple_of_energy,
    slope_of_L,
)
from lagrangian.check.reading.primes_beside_rates import values_beside_rates
from lagrangian.check.reading.reading_budget import ReadingBudget
from lagrangian.check.reading.redefined import contradicting
from lagrangian.check.reading.said.quantity_words import labelled
from lagrangian.check.reading.set_aside import MOST_LACKING, MOST_TOLD, does_without, may_be_result, told, unused
from lagrangian.check.reading.slopes_by_dots import sloped
from lagrangian.check.reading.subject import Subject, is_label_of_equation, named_anew
from lagrangian.check.reading.subjects import Subjects, bare_names
from lagrangian.check.reading.summed_energies import PartsOfEnergies
from lagrangian.errors import ParseError
from lagrangian.model import Model, time
from lagrangian.read.letters import key, undotted

MAX_CHAIN = 20
"""The largest number of definitions that may each need the one below it."""


class Lines:
    """Reads the statements of one answer."""

    def __init__(self, model: Model, names: Names | None = None) -> None:
        self.model = model
        self.names, self._free = names or Names(model), len(model.coordinates) - len(model.constraints)
        self.names.later, self.budget = self._look_ahead, ReadingBudget()
        self.subjects, self.energies = Subjects(model, self.names), PartsOfEnergies(model, self.names)
        self._statements: Sequence[Statement] = ()
        self._waiting, self._made = dict[str, int](), dict[int, list[AnswerLine]]()
        self._chain, self._matrices = 0, set[str]()
        self.remarks, self.doubts = (list[ParseError]() for _ in range(2))
        """The errors of lines that matter only beside incomplete equations, and of those redefining a name."""
        self.failed, self.results, self.lacking = (list[ParseError]() for _ in range(3))
        """The errors of all rows that cannot be read, of those that may be the result, and of those to do without."""
        self.unread = set[str]()  # the names in parts of the answer that were not read

    def read(self, statements: Sequence[Statement], errors: Sequence[ParseError] = ()) -> tuple[AnswerLine, ...]:
        """Return the lines of the statements, in their order; raise one error for all statements that cannot be read,
        ``errors`` included, in the order of their places."""
        self._statements = statements = with_solved_factors(statements, self.subjects)
        self.names.gather(tree for s in statements for tree in s.sides)
        self._collect()
        complete, aside, results = self._complete(), list[ParseError](), list(self.results)
        found = [*errors, *([] if complete else self.remarks)]
        for i in self.energies.order(statements):
            try:
                self._line(i)
                self._made[i] += self.energies.whole(i, self._made)
            except ParseError as error:
                if complete and says_constant(statements[i], self.names):
                    continue
                self.failed.append(error)
                remark = complete and error.code != "E703" and statements[i].remark()
                (self.remarks if remark else aside if self._is_general(i, error) else found).append(error)
                results += [error] if may_be_result(statements[i].source.text) else []
            if len(found) >= MOST_LACKING or any(e.code == "E703" for e in found):
                break
        for i, line in contradicting(self.names, [s.source for s in statements], self._made):
            self._made.setdefault(i, []).append(line)
        lines = without_expressions(self._made, statements, self.names)
        accelerating = sum(line.kind == "equation" and accelerates(sp.sympify(line.residual)) for line in lines)
        self.lacking = found or (aside if accelerating < len(self.model.coordinates) else [])
        if self.lacking and not does_without(self.lacking, results, lines, self._free):
            raise together(self.lacking[:MOST_TOLD])
        forget_unused(lines, self.names)
        self.doubts += self.lacking[:MOST_TOLD]
        self.names.notes |= dict.fromkeys(told(self.lacking, self.remarks))
        return lines

    def _complete(self) -> bool:
        """Whether there is an equation with accelerations for every degree of freedom, perhaps in one of matrices."""
        moving = [s for s in self._statements if any(map(self.subjects.accelerates, s.sides))]
        return len(moving) >= self._free or any(self._has_matrices(s.sides) for s in moving)

    def _is_general(self, i: int, error: ParseError) -> bool:
        """Whether a statement without a value holds letters that nothing explains, M(q) q'' + h = f; a note says so."""
        sides = self._statements[i].sides
        new = sorted({str(x) for side in sides for x, _ in names_in(side) if not self._explains(str(x))})
        if error.code != "E701" or not new:
            return False
        tell_general(self._statements[i].source, new, self.names)
        return True

    def _explains(self, written: str) -> bool:
        """Whether the system or a statement of the answer says what a name is."""
        base = key(undotted(written)[0])
        return base in self.names.defined or base in COLUMNS or self.names.known(written)

    def _collect(self) -> None:
        """Record which names are defined where, which energies are stated, and how many statements may be equations."""
        self.subjects.plain = own_letters([s.sides for s in self._statements], self.subjects)
        self.subjects.counted = self.subjects.counted_from_coordinates(s.sides for s in self._statements)
        turned = [self.subjects.turned(list(s.sides)) for s in self._statements]
        self._places = asides(self._statements, turned, self.names)
        self._made |= {i: [] for i in self._places}
        first = [None if i in self._places else subject for i, (subject, _) in enumerate(turned)]
        self._equal = sum(s is None or (s.kind == "definition" and s.right) for s in first)
        defining = [(i, x) for i, x in enumerate(first) if x is not None and x.kind == "definition"]
        self._solved = {i for i, subject in defining if subject.order > 1}
        ends = {i for i, _ in defining if any(map(self.subjects.accelerates, self._statements[i].sides))}
        alone = named_accelerations({i: (key(str(x.token)), turned[i][1][1:]) for i, x in defining if not x.order})
        self.subjects.accelerations = set(alone.values())
        last = {i: (x.order > 0, x.right, i not in alone, i in ends, i) for i, x in defining}
        ordered = sorted(defining, key=lambda x: last[x[0]])  # omega = theta' before omega' = …
        shared = ((x, i) for i, s in ordered for x in (s.token, *self.subjects.sharing(s, turned[i][1])[1]))
        self._waiting |= first_without_circles(shared, lambda i: turned[i][1][1:])
        self._waiting |= {key(str(x.token)): i for i, x in enumerate(first) if x and self.subjects.is_letter(x)}
        named = [s for s in first if s is not None and s.kind == "definition" and not s.order]
        self._matrices = {key(str(s.token)) for s in named if is_matrix(self._statements[first.index(s)].sides[1])}
        self.names.given_matrices = self._matrices
        self.subjects.leading = Counter(key(undotted(str(s.token))[0]) for s in named if not s.right)
        self.subjects.gives_rates = set().union(*(self.subjects.in_rates(s.sides) for s in self._statements))
        self.subjects.bare = bare_names(side for s in self._statements for side in s.sides)
        self.names.defined = self.subjects.defined = {key(undotted(str(s.token))[0]) for s in named}
        self.names.differentiated = differentiated_by([side for s in self._statements for side in s.sides])
        self._waiting |= given_by_chains(dict(enumerate(turned)), self.names)
        self.names.sloped = sloped(turned, self._statements, self.names)
        self.names.stating = {s.kind for s in first if s is not None and s.kind in ENERGIES}
        self.energies.gather(defining, self._statements)

    def _has_matrices(self, sides: Sequence[Tree]) -> bool:
        """Whether a matrix stands in a statement, or two names of matrices; M alone may be a mass."""
        if len(sides) > 1 and only_name(sides[0]) is not None and is_matrix(sides[1]):
            return False  # its entries are in the letters of the system
        names = {key(str(token)) for side in sides for token, _ in names_in(side)} & self._matrices
        written = any(map(has_matrix, sides))
        return len(names) > 1 or (written and (bool(self._matrices) or self.names.has_column(sides)))

    def _look_ahead(self, base: str) -> None:
        """Read the definition of a name that comes later in the answer; that of an acceleration only for another."""
        if self._waiting.get(base) in self._solved and not self.names.moving:
            return  # D = cos q2, and q2'' = …/D further down
        if (at := self._waiting.pop(base, None)) is None or at in self._made or self._chain >= MAX_CHAIN:
            return
        self._chain += 1
        self._line(at)
        self._chain -= 1

    def _line(self, i: int) -> None:
        if i in self._made:
            return
        self._made[i] = []  # a definition that refers to itself finds its own name unknown
        statement = self._statements[i]
        subject, sides = self.subjects.turned(list(statement.sides))
        above = self.names.moving, self.names.matrices, self.names.statement
        self.names.statement = i
        self.names.moving = any(self.subjects.accelerates(x) for x in sides)
        self.names.matrices = self._has_matrices(statement.sides)

        def read() -> list[AnswerLine]:
            reader = Meaning(statement.source, self.names, self.budget, None if subject is None else subject.kind)
            stated = [x for own, its in self.subjects.each(subject, sides) for x in self._about(own, its, reader)]
            return stated if subject else self._equations(sides, reader)

        self._waiting = {base: at for base, at in self._waiting.items() if at != i}
        before = set(self.names.unknown)
        lines = self.names.fitting(sides, read)
        if all(line.kind == "statement" for line in lines):  # it may use its own letters: ξ_i
            self.names.unknown = {base: u for base, u in self.names.unknown.items() if base in before}
        self.names.relations.add(lines)
        self._made[i] = lines
        self.names.moving, self.names.matrices, self.names.statement = above

    def _about(self, subject: Subject, sides: list[Tree], reader: Meaning) -> list[AnswerLine]:
        lines: list[AnswerLine] = []
        above: Value = None
        sides, same = self.subjects.sharing(subject, sides)
        if self.subjects.names_sides(subject, sides):
            left_out(sides[0], reader.value(sides[0]), reader)
            return self._equations(sides[1:], reader)
        values = values_beside_rates(sides[1:], reader)
        told = [tells(subject.kind, value, values[k + 1 :], self.names) for k, value in enumerate(values)]
        for side, value, judged in zip(sides[1:], values, told, strict=True):
            if not judged:
                left_out(side, value, reader)
                continue
            if isinstance(value, MatrixBase):
                lines += self._matrix_of(subject, value, sides[0], reader)
            elif subject.kind == "definition" and amounts_to(above, value, self.model):
                continue
            elif subject.kind == "definition" and (given := parameter_given(above, value, self.model)) is not None:
                lines.append(made_line("given", None, value, given, sides[0], side, reader))
                continue
            elif above is not None and subject.kind == "definition" and sp.S.Zero == value and not subject.order:
                lines += self._equation(above, sp.S.Zero, side, side, reader)  # f = r - R = 0
            elif above is not None and subject.kind == "p-rate" and accelerates(above) and not accelerates(value):
                lines.append(made_line("equation", above, value, None, side, side, reader))  # d/dt ∂L/∂x' = m x'' = F
            else:
                lines.append(self._stated(subject, value, sides, side, reader))
            above = value
        for token in same:
            self.names.define(token, above)
        return lines

    def _stated(self, subject: Subject, value: sp.Expr, sides: list[Tree], side: Tree, reader: Meaning) -> AnswerLine:
        value, given = reader.finite(value, side), self.subjects.parameter(sides[0], value)
        subject = subject if given else named_anew(subject, value)
        kind, name, lhs = subject.kind, subject.name, cast("sp.Expr | None", None)
        if is_general(value) and kind == "Xi" and name is not None:
            return made_line("statement", generalized_force(name), value, None, sides[0], side, reader)
        if is_general(value):
            if (why := why_not_judged(value)) is not None:
                self._not_judged(reader, why)  # L = T - V + λ (x² + y² - l²)
            return made_line("statement", None, value, name or kind, sides[0], side, reader)
        if kind in ENERGIES and given is not None:
            return made_line("given", None, value, given, sides[0], side, reader)
        if kind in ENERGIES:
            self.names.stated[kind] = value
            if subject.token is not None and self.subjects.is_letter(subject):
                self.names.define(subject.token, value)
        elif kind == "definition":
            assert subject.token is not None
            above = [s.sides for s in self._statements[: self.names.statement]]
            if self.subjects.equates(subject, value, self._equal) or self.subjects.is_force_found(subject, above):
                left = sp.S.Zero if is_label_of_equation(subject) else reader.scalar(sides[0])
                left, right = (value, left) if subject.right else (left, value)  # m x'' = N keeps its signs
                return made_line("equation", left, right, None, sides[0], side, reader)
            rate = self.names.rates.get((key(undotted(subject.token)[0]), subject.order))
            if rated := rated_energy(subject.token, subject.order, value, (sides[0], side), reader):
                return rated  # dT/dt = m x' x''
            self._define(subject, value)
            self._used_nowhere(subject, reader)
            if isinstance(rate, sp.Expr) and not is_vector(rate) and bounded.expand(rate - value) != 0:
                kind = "equation" if accelerates(rate) or accelerates(value) else "identity"
                return made_line(kind, rate, value, None, sides[0], side, reader)  # v' = x'' and v' = F/M
        elif kind == "identity":
            lhs = reader.scalar(sides[0])
            kind = "equation" if solves(lhs, value) else kind
        elif kind in ("Xi", "slope") and name is not None and accelerates(value):  # d/dt p_θ = ∂L/∂θ is Lagrange's
            lhs, value = value, generalized_force(name) if kind == "Xi" else slope_of_L(name, self.model)
            kind, name = "equation" if kind == "Xi" else "statement", None
        return made_line(kind, lhs, value, name, sides[0], side, reader)

    def _define(self, subject: Subject, value: sp.Expr) -> None:
        assert subject.token is not None
        if subject.order:
            define_rate(subject.token, subject.order, value, self.names, self.subjects.bare)
        else:
            self.names.define(subject.token, own_angle(subject, value, self._statements, self.names, self.budget))

    def _used_nowhere(self, subject: Subject, reader: Meaning) -> None:
        """Tell that a definition is not judged if nothing else uses the name."""
        assert subject.token is not None
        sides = [side for s in self._statements for side in s.sides]
        used = self.names.occurs(subject.token) > 1 or key(str(subject.token)) in derived(sides)
        if not used and not subject.order and not self.subjects.only_calls(subject.token):
            self._not_judged(reader, unused(str(subject.token)))

    def _matrix_of(self, subject: Subject, value: Value, side: Tree, reader: Meaning) -> list[AnswerLine]:
        """Read a named matrix: a column of all Ξ states each of them; any other is stored for the lines that use it."""
        token = subject.token
        if token is not None and subject.order:
            return self._rate_of_matrix(subject, value, side, reader)
        if token is None:
            reader.fail("a single quantity cannot equal a matrix", side, fix="write one equation per line")
        names = [c.name for c in self.model.coordinates]
        if key(token) in ("Xi", "Q", "bold Xi", "bold Q") and value.shape == (len(names), 1):
            self.names.define(token, value)  # M q'' + K q = Q means the forces that this answer gives
            own = is_of_entries(token, self._statements[self.names.statement].sides[-1])
            stated = [] if own else zip(names, value, strict=True)
            return [self._stated(Subject("Xi", name=n), x, [side, side], side, reader) for n, x in stated]
        self.names.define(token, value)
        rates = {k for k, x in spelled_rates(token) if x in COLUMNS and not self.names.scope.meanings(x)[0]}
        if 2 in rates and self.names.occurs(token) == 1 and value.shape == (len(names), 1):  # qdd = [a; b]
            pairs = zip([c.symbol.diff(time, 2) for c in self.model.coordinates], value, strict=True)
            return [made_line("equation", a, b, None, side, side, reader) for a, b in pairs]
        if not (acts := value.shape == (len(names),) * 2 or value.has(*(u.symbol for u in self.model.inputs))):
            self._used_nowhere(subject, reader)
        if (acts or self.names.occurs(token) > 1) and not self._is_used_as_matrix(token):
            self._not_judged(reader, f"no equation uses this matrix {token}")
        return entries_of(token, value, side, reader)

    def _is_used_as_matrix(self, token: Token) -> bool:
        """Whether a statement uses a name beside other matrices, or as one side, M q'' = f, or states its rate."""
        listed = (s.sides for s in self._statements if self._has_matrices(s.sides))
        rated = any(is_rate_of(token, s.sides[0]) for s in self._statements)
        return rated or any(key(undotted(x)[0]) == key(token) for y in listed for side in y for x, _ in names_in(side))

    def _rate_of_matrix(self, subject: Subject, value: Value, side: Tree, reader: Meaning) -> list[AnswerLine]:
        """Compare the velocity or acceleration of a point with the derivative of its position, given before."""
        token, order = subject.token, subject.order
        assert token is not None
        self._look_ahead(key(undotted(token)[0]))
        if self.names.mine(key(undotted(token)[0])) is None:
            self.names.rates[key(undotted(token)[0]), order] = value
            self._not_judged(reader, f"nothing says what {token} is")
            return []
        if not isinstance(above := reader.value(side), MatrixBase) or above.shape != value.shape:
            reader.fail("a single quantity cannot equal a matrix", side, fix="write one equation per line")
        return [
            made_line("equation" if solves(a, b) else "identity", a, b, None, side, side, reader)
            for a, b in zip(above.flat(), value.flat(), strict=True)
        ]

    def _equations(self, sides: list[Tree], reader: Meaning) -> list[AnswerLine]:
        values = values_beside_rates(sides, reader)
        if len(values) == 1:
            listed = isinstance(values[0], MatrixBase)
            said = listed or any(len(s.sides) > 1 for s in self._statements)  # rod: m L^2/3
            moves = any(accelerates(x) and not x.is_Derivative for x in (values[0] if listed else values))
            if said and ((meant := labelled(values[0], sides[0], reader, moving=moves)) or not moves):
                tell_expression(sides[0], reader, "a list" if listed else "an expression")
                return meant
            values = [sp.S.Zero, *values] if "=" in reader.source.text else [*values, sp.S.Zero]  # eq1 = m x'' - F
            sides = [*sides, sides[0]]
        values, sides = without_parts(*without_amounts(values, sides, self.model), reader)
        pairs = zip(pairwise(values), pairwise(sides), strict=False)
        return [x for (a, b), (left, right) in pairs for x in self._equation(a, b, left, right, reader)]

    def _equation(self, left: Value, right: Value, a: Tree, b: Tree, reader: Meaning) -> list[AnswerLine]:
        if is_vector(left) or is_vector(right):
            return tell_vectors((left, right), (a, b), reader)
        matrices = isinstance(left, MatrixBase) or isinstance(right, MatrixBase)
        pairs = matrix_rows(left, right, b, reader) if matrices else [(left, right)]
        return [self._judged(reader.finite(x, a), reader.finite(y, b), a, b, reader) for x, y in pairs]

    def _judged(self, left: sp.Expr, right: sp.Expr, a: Tree, b: Tree, reader: Meaning) -> AnswerLine:
        itself = self.subjects.is_chain_rule((a, left), (b, right))
        kind: Kind = "identity" if itself or reader.of_matrix > accelerates(left - right) else "equation"
        for side, value in ((a, right), (b, left)):
            if (subject := self.subjects.left_side(side)) is not None and accelerates(value):
                return made_line("left", None, value, subject.name, a, b, reader)
        if (derived := self.subjects.derived((a, left), (b, right))) is not None:
            return made_line(*derived, a, b, reader)
        for side, value in ((left, right), (right, left)):
            if not is_general(value) and (own := multiple_of_energy(side)) is not None:  # 2 T = m x'^2, (T, V) = (…, …)
                return made_line(cast("Kind", own[0]), None, value / own[1], None, a, b, reader)
        if is_general(left) or is_general(right):
            kind = "statement"
            if any(is_slope(x) for side in (left, right) for x in side.atoms(AppliedUndef)):
                self._unjudged(left, right, reader)
        elif (found := only_name(a)) is not None and not found[1] and self.subjects.changes_coordinate(found[0], right):
            return made_line("definition", None, right, self.names.scope.meanings(found[0])[0][0], a, b, reader)
        elif (given := self.subjects.parameter(a, right) or self.subjects.parameter(b, left)) is not None:
            return made_line("given", None, right if left == self.names.scope[given] else left, given, a, b, reader)
        return made_line(kind, left, right, None, a, b, reader)

    def _not_judged(self, reader: Meaning, why: str) -> None:
        self.names.notes.setdefault(f"'{' '.join(reader.source.text.split())}' was not judged: {why}.")

    def _unjudged(self, left: sp.Expr, right: sp.Expr, reader: Meaning) -> None:
        """Tell that an equation of this system is not judged, because it derives something that has no value."""
        rates, pairs = left.atoms(sp.Derivative) | right.atoms(sp.Derivative), ((left, right), (right, left))
        if any((is_slope(x) or is_slope(-x)) and not is_general(y) for x, y in pairs) or any(
            d.derivative_count > 1 and not is_placeholder(d.expr) for d in rates
        ):
            self._not_judged(reader, "nothing says what is differentiated there")
