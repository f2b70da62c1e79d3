"""The order in which an elimination with rows eliminates its unknowns.

Two orders are tried, and their operations counted. The tape backwards is linear in the length of chains of loops. To
take the cheapest possible step next is better for small systems.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import islice

from lagrangian.dynamics.multipliers import RowElimination
from lagrangian.dynamics.row_problem import DependentRow, Problem, RowSolution
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, count_operations

FEW = 12
"""Up to this number of rates, the orders are also tried without the pairs of rule 2."""

MOST_FREE = 60
"""Up to this number of rates, every step is chosen as the cheapest."""


def tape_backwards(
    problem: Problem, *, pairs: bool, order: Sequence[int] = (), combining: bool = False
) -> RowElimination:
    """Go backwards over the tape, and eliminate every multiplier as soon as the rules allow it."""
    e = RowElimination.of(problem, order, combining=combining)
    _settle(e, pairs=pairs)
    for i in reversed(problem.tape.order):
        if i not in e.done:
            e.take(i, pairs=pairs)
            _settle(e, pairs=pairs)
    return e


def _settle(e: RowElimination, *, pairs: bool) -> None:
    """Eliminate every multiplier that the rules allow."""
    while True:
        for key in e.ready_rows():
            e.take_row(key)
        freed, e.freed = e.freed, []
        if pairs:
            for i in freed:
                if i in e.leaves and i not in e.done and e.paired(i) is not None:
                    e.take(i, pairs=True)
        if not e.freed and not e.ready_rows():
            return


def cheapest_first(
    problem: Problem, *, pairs: bool, order: Sequence[int] = (), combining: bool = False
) -> RowElimination:
    """Take the cheapest of all possible steps next."""
    e = RowElimination.of(problem, order, combining=combining)
    ready: set[int] = set()
    mates = {first: i for i, (first, *_) in problem.tape.turned.items()}
    while True:
        ready.update(mates.get(i, i) for i in e.freed)
        e.freed = []
        ready -= e.done
        rows = e.ready_rows()
        steps = [(_row_cost(e, key), -len(problem.tape.order) + key, key) for key in rows]
        for i in ready:
            if e.too_early(i) and e.paired(i) is None:
                continue
            turned = problem.tape.turned.get(i)
            if turned is None or (not e.users[i] and not e.users[turned[0]]):
                steps.append((_cost(e, i, pairs=pairs), -e.place[i], i))
        if not steps:
            if late := [i for i in ready if e.too_early(i)]:
                e.take(late[0], pairs=pairs)  # which says that it has no inertia
                continue
            return e
        _, _, i = min(steps)
        if i < 0:
            e.take_row(i)
        else:
            e.take(i, pairs=pairs)


def _row_cost(e: RowElimination, key: int) -> float:
    return len(e.H.rows.get(key, ())) ** 2 / 2


def _cost(e: RowElimination, i: int, *, pairs: bool) -> float:
    """A substitution costs parents × (neighbours + parents), a pivot neighbours²/2."""
    neighbours = len(e.H.rows.get(i, ()))
    if i not in e.leaves:
        turned = e.tape.turned.get(i)
        both = neighbours + (len(e.H.rows.get(turned[0], ())) if turned else 0)
        parents = len(e.tape.forms[i])
        return parents * (both + parents)
    key = e.paired(i) if pairs else None
    if key is None:
        return neighbours**2 / 2
    parents = len(e.H.rows[key]) - 1
    return parents * (neighbours - 1 + parents)


def _solved(problem: Problem, way: Callable[..., RowElimination], *, pairs: bool) -> RowSolution:
    """The solution in one order. Where rows are spare, a trial tells in which order their pivots come."""
    done = way(problem, pairs=pairs)
    if problem.spare:
        done = way(problem, pairs=pairs, order=done.guard.taken)
    return done.solution()


Order = tuple[int, Callable[..., RowElimination], bool]
"""Which of several problems is eliminated, in what order, and whether with pairs."""


def solutions(
    problem: Problem, *, combining: bool = False
) -> Iterator[tuple[RowSolution | ModelError, Callable[..., RowElimination], bool]]:
    """The solutions in all orders to be compared, or the reason why there is none; in large systems only the tape's."""
    ways: list[Callable[..., RowElimination]] = [tape_backwards, cheapest_first]
    ways = ways if len(problem.rates) <= MOST_FREE else ways[:1]
    if combining:
        ways = [partial(way, combining=True) for way in ways]
    for way in ways:
        for pairs in (True, False) if len(problem.rates) <= FEW else (True,):
            try:
                found = _solved(problem, way, pairs=pairs)
            except DependentRow:
                raise
            except ModelError as error:  # a rate without inertia that this order does not find a row for
                yield error, way, pairs
                continue
            yield found, way, pairs
            if not any(x == problem.graph.one for x in found.margins):
                break  # without pairs it is the same


def solution_in(order: Order, problems: Iterable[Problem]) -> RowSolution | None:
    """The solution in an order that was found before, or None if it does not succeed here."""
    at, way, pairs = order
    try:
        return next((_solved(problem, way, pairs=pairs) for problem in islice(problems, at, None)), None)
    except ModelError:
        return None


def found_solutions(problems: Iterable[Problem]) -> Iterator[tuple[RowSolution, Order, Graph]]:
    """All solutions to be compared, one by one, each with its order and its graph.

    Where no order succeeds, rows are combined for rates without inertia (`massless`). Raises the `ModelError` of the
    first order if that fails too, and `DependentRow`.
    """
    failed: list[ModelError] = []
    tried: list[Problem] = []
    succeeded = False
    for combining in (False, True):
        failed.clear()
        for at, problem in enumerate(tried if combining else problems):
            tried += () if combining else (problem,)
            for found, way, pairs in solutions(problem, combining=combining):
                if isinstance(found, ModelError):
                    failed.append(found)
                    continue
                succeeded = True
                yield found, (at, way, pairs), problem.graph
        if succeeded:
            return
    raise failed[0]


def cheapest_solution(problems: Iterable[Problem], *, multipliers: bool = True) -> tuple[RowSolution, Order]:
    """The solution with the fewest operations for v̇ and λ, or for v̇ alone, and its order; terms of parameters are not
    counted. Raises as `found_solutions`.
    """
    best: tuple[int, RowSolution, Order] | None = None
    for found, order, graph in found_solutions(problems):
        wanted = [*found.vdot, *found.multipliers] if multipliers else found.vdot
        cost = count_operations(graph, wanted, hoist=["p"]).operations
        if best is None or cost < best[0]:
            best = cost, found, order
    assert best is not None
    return best[1:]
