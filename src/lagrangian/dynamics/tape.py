"""The velocity tape: how body velocities come out of the rates, node by node.

Every velocity is linear in the rates, and the graph already holds the steps: ``v_i = Σ_j c_ij v_j``, where c_ij depends
on positions alone. The tape lists those steps in an order of evaluation, each rate immediately before its first use,
and marks two patterns that the elimination treats as one: a rate that only one node uses, and a pair of nodes that is
a rotation of another pair.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence

from lagrangian.errors import ModelError
from lagrangian.graph import Graph, operands
from lagrangian.graph.graph import Node
from lagrangian.records import dataclass, field

Form = dict[int, int]
"""A linear form: node → coefficient node."""


@dataclass
class EliminationTape:
    """``order``: rates and nodes, parents first. ``forms``: node → its linear form in earlier entries.

    ``exchanged``: node t → (rate, ±1 node) where t = … ± rate is the rate's only user. ``turned``: second node of a
    rotated pair → (first node, parent a, parent b, c, s) with first = c a + s b and second = c b − s a.
    """

    order: list[int] = field(default_factory=list)
    forms: dict[int, Form] = field(default_factory=dict)
    exchanged: dict[int, tuple[int, int]] = field(default_factory=dict)
    turned: dict[int, tuple[int, int, int, int, int]] = field(default_factory=dict)


def is_linear(node: Node, moves: set[int]) -> bool:
    """Whether a node is linear in those of its operands that move."""
    op = node[0]
    if op == "mul":
        return not (node[1] in moves and node[2] in moves)
    if op == "div":
        return node[2] not in moves
    return op in ("add", "sub", "neg") or (op == "select" and node[1] not in moves)


def linear_terms(graph: Graph, node: Node, moves: set[int]) -> list[tuple[int, int]]:
    """The (coefficient, operand) pairs of a node that is linear in those of its operands that move."""
    op = node[0]
    one = graph.one
    terms: list[tuple[int, int]] = []
    if not is_linear(node, moves):
        raise ModelError(
            "a velocity is not linear in the rates of the coordinates",
            fix="positions and angles may depend on coordinates and time, not on rates",
            code="E419",
        )
    if op in ("add", "sub"):
        terms = [(one, node[1]), (one if op == "add" else graph.negative, node[2])]
    elif op == "neg":
        terms = [(graph.negative, node[1])]
    elif op == "mul":
        a, b = (node[1], node[2]) if node[2] in moves else (node[2], node[1])
        terms = [(a, b)]
    elif op == "div":
        terms = [(graph.div(one, node[2]), node[1])]
    else:
        terms = [
            (graph.select(node[1], one, graph.zero), node[2]),
            (graph.select(node[1], graph.zero, one), node[3]),
        ]
    return [(c, a) for c, a in terms if a in moves]


def moving_nodes(graph: Graph, ends: Iterable[int], rates: Iterable[int]) -> list[int]:
    """The nodes between ``rates`` and ``ends`` that depend on the rates, in increasing order."""
    nodes = graph.nodes
    leaves = set(rates)
    state: dict[int, bool] = {}
    stack = list(ends)
    while stack:
        i = stack[-1]
        if i in state:
            stack.pop()
            continue
        node = nodes[i]
        if i in leaves or node[0] in ("const", "input"):
            state[i] = i in leaves
            stack.pop()
            continue
        below = (node[1],) if node[0] == "powi" else node[1:]
        waiting = [k for k in below if k not in state]
        if waiting:
            stack.extend(waiting)
        else:
            state[i] = any(state[k] for k in below)
            stack.pop()
    return sorted(i for i, moves in state.items() if moves)


def make_tape(
    graph: Graph, seeds: Sequence[int], rates: Sequence[int], held: Container[int] | None = None
) -> EliminationTape:
    """The tape from ``rates`` to the nodes in ``seeds``.

    Products and signs are folded into coefficients; a sum stays a node where several use it or where it is a seed.
    A rate that only one node uses is exchanged for it unless it is in ``held``; None holds them all.
    """
    active = moving_nodes(graph, seeds, rates)
    moves = set(active)
    leaves = set(rates)
    seeded = set(seeds)
    terms: dict[int, list[tuple[int, int]]] = {}
    users: dict[int, int] = {}
    for i in active:
        if i not in leaves:
            terms[i] = linear_terms(graph, graph.nodes[i], moves)
            for _, a in terms[i]:
                users[a] = users.get(a, 0) + 1
    forms = _forms(graph, active, terms, users, seeded)
    tape = EliminationTape()
    _place(graph, tape, forms, seeds, leaves)
    idle = leaves.difference(tape.order)
    tape.order[:0] = [r for r in rates if r in idle]
    if held is not None:
        _mark_exchanges(tape, graph, held, leaves)
    return tape


def _forms(
    graph: Graph,
    active: list[int],
    terms: dict[int, list[tuple[int, int]]],
    users: dict[int, int],
    seeded: set[int],
) -> dict[int, Form]:
    """The linear forms of the nodes that stay, in terms of nodes that stay."""
    open_forms: dict[int, Form] = {}
    kept: dict[int, Form] = {}
    for i in active:
        if i not in terms:
            open_forms[i] = {i: graph.one}
            continue
        form: Form = {}
        for c, a in terms[i]:
            for parent, inner in open_forms[a].items():
                form[parent] = graph.add(form.get(parent, graph.zero), graph.mul(c, inner))
        form = {k: c for k, c in form.items() if c != graph.zero}
        if i in seeded or (len(form) > 1 and users.get(i, 0) > 1):
            kept[i] = form
            open_forms[i] = {i: graph.one}
        else:
            open_forms[i] = form
    return kept


def _place(graph: Graph, tape: EliminationTape, forms: dict[int, Form], seeds: Sequence[int], leaves: set[int]) -> None:
    """Order the nodes depth first from the seeds: parents first, the two of a rotated pair side by side."""
    mates = _mates(graph, forms)
    tape.forms = forms
    placed: set[int] = set()
    for seed in seeds:
        stack = [seed]
        while stack:
            i = stack[-1]
            if i in placed or (i not in forms and i not in leaves):
                stack.pop()
                continue
            waiting = [k for k in forms.get(i, {}) if k not in placed]
            steps = [k for k in waiting if k in forms]
            if steps:  # the rates wait until everything else is there
                stack.extend(reversed(steps))
                continue
            tape.order.extend(waiting)
            placed.update(waiting)
            tape.order.append(i)
            placed.add(i)
            stack.pop()
            mate = mates.get(i)
            if mate is not None and mate[0] not in placed:
                second, *rest = mate
                tape.order.append(second)
                placed.add(second)
                a, b, c, s = rest
                tape.turned[second] = (i, a, b, c, s)


def _mates(graph: Graph, forms: dict[int, Form]) -> dict[int, tuple[int, int, int, int, int]]:
    """Node t → (mate, a, b, c, s) such that t = c a + s b, mate = c b − s a and c² + s² = 1."""
    pairs: dict[tuple[int, int], list[int]] = {}
    for i, form in forms.items():
        if len(form) == 2:
            a, b = sorted(form)
            pairs.setdefault((a, b), []).append(i)
    found: dict[int, tuple[int, int, int, int, int]] = {}
    for (a, b), group in pairs.items():
        for i in group:
            c, s = forms[i][a], forms[i][b]
            if i in found or not is_unit(graph, c, s):
                continue
            for k in group:
                if k == i or k in found:
                    continue
                if forms[k][b] == c and forms[k][a] == graph.neg(s):
                    found[i], found[k] = (k, a, b, c, s), (i, b, a, c, graph.neg(s))
                    break
    return found


def is_unit(graph: Graph, c: int, s: int) -> bool:
    """Whether c and s are, up to sign, cosine and sine of one angle."""
    bare = [graph.nodes[x[1]] if x[0] == "neg" else x for x in (graph.nodes[c], graph.nodes[s])]
    return {bare[0][0], bare[1][0]} == {"sin", "cos"} and bare[0][1] == bare[1][1]


def _mark_exchanges(tape: EliminationTape, graph: Graph, held: Container[int], leaves: set[int]) -> None:
    users: dict[int, list[int]] = {}
    for i, form in tape.forms.items():
        for k in form:
            users.setdefault(k, []).append(i)
    for rate in leaves:
        using = users.get(rate, ())
        if len(using) == 1 and rate not in held and using[0] not in tape.exchanged:
            t = using[0]
            c = tape.forms[t][rate]
            if c in (graph.one, graph.negative) and len(tape.forms[t]) > 1:
                tape.exchanged[t] = (rate, c)


def maximal_linear_nodes(g: Graph, energy: int, v: Sequence[int]) -> list[int]:
    """The nodes linear in v that feed an operation of ``energy`` that is not."""
    active = moving_nodes(g, [energy], v)
    moves = set(active)
    linear = set(v)
    maximal: dict[int, None] = {}
    for i in active:
        if i in linear:
            continue
        node = g.nodes[i]
        below = [k for k in operands(node) if k in moves]
        if all(k in linear for k in below) and is_linear(node, moves):
            linear.add(i)
        else:
            maximal.update((k, None) for k in below if k in linear)
    return list(maximal) or [energy]
