"""Bounds of functions of a motion over a piece of it, which show that they have no zero there, or are monotonic.

A stretch is θ = c + s, |s| ≤ r. Of every node five numbers are known, given those of the states:

    v = f(c)   d = f′(c)   R ≥ |f(c + s) − v|   S ≥ |f′(c + s)|   K ≥ |f″(c + s)|

so that R = |d| r + K r²/2 and S = |d| + K r always serve. A product has K = |a| K_b + 2 S_a S_b + |b| K_a with the
greatest |a|, |b|; a function of a has K = |f″| S_a² + |f′| K_a with the greatest of its derivatives where a is. At a
kink K is `ENDLESS`, at a jump S as well; what is not a number bounds nothing. Rounding is left out.

Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009, chapters 5 and 6.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagrangian.graph.along import FUNCTIONS, Along, Slopes, above, greatest, smallest
from lagrangian.graph.graph import CONDITIONS, Graph, Node, operands
from lagrangian.graph.program import Output, Program, reached
from lagrangian.records import dataclass

ENDLESS = 1e200
"""A stand-in for an unbounded derivative: large enough to prove nothing, but finite, so that 0 times it is 0."""


@dataclass(frozen=True, slots=True)
class Truth:
    """A condition at the centre, and whether it has the same value on the whole stretch."""

    holds: int
    decided: int


def states_read(program: Program) -> tuple[int, ...]:
    """The entries of the group ``x`` that the outputs of a program depend on, in order."""
    nodes = program.graph.nodes
    return tuple(sorted({nodes[i][2] for i in reached(program.graph, program.ids) if nodes[i][:2] == ("input", "x")}))


def bounds(program: Program) -> Program:
    """Return a program that says for each entry of ``g`` whether it can be zero, or turn, on a stretch.

    Inputs: ``x``, ``rate`` and ``bend`` (value at the centre, derivative there, bound of the second derivative) of the
    entries in `states_read`; ``u`` and ``drift`` (value and derivative, which is constant); ``p``; ``t``, the time at
    the centre; ``stretch``: dt/dθ and r. The outputs have the length of ``g`` and are 1 or 0. ``clear`` is 1 if
    |v| > R or R = 0, which proves that the entry crosses 0 nowhere on the stretch. ``steady`` is 1 if |d| > K r, which
    proves that it rises or falls throughout.
    """
    walk, found, inputs = _walked(program)
    g = walk.g
    clear = tuple(g.select(g.or_(g.lt(a.R, g.abs(a.v)), g.eq(a.R, g.zero)), g.one, g.zero) for a in found)
    steady = tuple(g.select(g.lt(g.mul(a.K, walk.r), g.abs(a.d)), g.one, g.zero) for a in found)
    shape = (len(found),)
    outputs = {"clear": Output(clear, shape), "steady": Output(steady, shape)}
    return Program(f"{program.name} bounds", g, inputs, outputs, dict(program.defaults))


def bends(program: Program) -> Program:
    """Return a program for each entry's ``value`` at the centre of a stretch and the bound ``bend`` = K.

    The inputs are those of `bounds`. An entry without a finite bound has `ENDLESS`; one without a finite value has 0.
    """
    walk, found, inputs = _walked(program)
    g, shape = walk.g, (len(found),)

    def finite(x: int, otherwise: int) -> int:
        return g.select(g.lt(g.abs(x), walk.endless), x, otherwise)

    value = Output(tuple(finite(a.v, g.zero) for a in found), shape)
    bend = Output(tuple(finite(a.K, walk.endless) for a in found), shape)
    return Program(f"{program.name} bends", g, inputs, {"value": value, "bend": bend}, dict(program.defaults))


def _walked(program: Program) -> tuple[_Walk, list[Along], dict[str, tuple[str, ...]]]:
    """The bounds along a stretch for each entry of ``g``, and the inputs of the program."""
    read = states_read(program)
    names, u = program.inputs.get("x", ()), tuple(program.inputs.get("u", ()))
    kept = tuple(names[k] for k in read)
    inputs = {
        "x": kept, "rate": kept, "bend": kept, "u": u, "drift": u,
        "p": tuple(program.inputs.get("p", ())), "t": ("t",), "stretch": ("pace", "r"),
    }  # fmt: skip
    walk = _Walk(Graph(), program.graph, {k: i for i, k in enumerate(read)})
    found = [walk.number(i) for i in walk.over(program.outputs["g"].ids)]
    return walk, found, {n: e for n, e in inputs.items() if e}


class _Walk:
    """Computes `Along` for the nodes of ``old`` in the graph ``g``."""

    def __init__(self, g: Graph, old: Graph, states: dict[int, int]) -> None:
        self.g, self.old, self.states = g, old, states
        self.r = g.input("stretch", 1)
        self.known: dict[int, Along | Truth] = {}
        self.endless = g.const(ENDLESS)

    def over(self, ids: Sequence[int]) -> Sequence[int]:
        """Compute what the nodes ``ids`` need; return their bounds."""
        for i in reached(self.old, ids):
            node = self.old.nodes[i]
            self.known[i] = self._truth(node) if node[0] in CONDITIONS else self._along(node)
        return ids

    def number(self, i: int) -> Along:
        """The bounds of a node as a number; conditions become 1 and 0."""
        found = self.known[i]
        if isinstance(found, Along):
            return found
        g = self.g
        wide = g.select(found.decided, g.zero, g.one)
        jump = g.select(found.decided, g.zero, self.endless)
        return Along(g.select(found.holds, g.one, g.zero), g.zero, wide, jump, jump, True)

    # -- pieces -------------------------------------------------------------------------------------------------

    def still(self, v: int) -> Along:
        """The bounds of a constant."""
        zero = self.g.zero
        return Along(v, zero, zero, zero, zero)

    def smooth(self, v: int, d: int, K: int, *, R: int | None = None, S: int | None = None) -> Along:
        """The bounds from value, derivative and second derivative; ``R`` and ``S`` if they are bounded in another way
        as well."""
        g, size = self.g, self.g.abs(d)
        bent = g.mul(K, self.r)
        reach = g.mul(self.r, g.add(size, g.mul(g.const(0.5), bent)))
        slope = g.add(size, bent)
        return Along(
            v, d, reach if R is None else g.min(reach, R), slope if S is None else g.min(slope, S), K,
            R is not None or S is not None,
        )  # fmt: skip

    def apart(self, a: Along, b: Along) -> int:
        """Whether a and b are different on the whole stretch."""
        g = self.g
        return g.lt(g.add(a.R, b.R), g.abs(g.sub(a.v, b.v)))

    # -- operations ---------------------------------------------------------------------------------------------

    def _along(self, node: Node) -> Along:
        g, op = self.g, node[0]
        if op == "const":
            return self.still(g.const(node[1]))
        if op == "input":
            return self._input(node[1], node[2])
        if op == "select":
            return self._select(node)
        a = [self.number(k) for k in operands(node)]
        if op in FUNCTIONS:
            return self._function(a[0], FUNCTIONS[op](g, a[0]))
        match op:
            case "add" | "sub":
                return self._sum(a[0], a[1], op)
            case "neg":
                return Along(g.neg(a[0].v), g.neg(a[0].d), a[0].R, a[0].S, a[0].K, a[0].free)
            case "mul":
                return self._product(a[0], a[1])
            case "div":
                return self._quotient(a[0], a[1])
            case "powi":
                return self._function(a[0], self._power(a[0], g.const(float(node[2])), node[2]))
            case "pow":
                if self._moves(a[1]):
                    exponent = self._product(a[1], self._function(a[0], FUNCTIONS["log"](g, a[0])))
                    return self._function(exponent, FUNCTIONS["exp"](g, exponent))
                return self._function(a[0], self._power(a[0], a[1].v, None))
            case "abs":
                apart = g.lt(a[0].R, g.abs(a[0].v))
                d = g.mul(g.sign(a[0].v), a[0].d)
                return Along(g.abs(a[0].v), d, a[0].R, a[0].S, g.select(apart, a[0].K, self.endless), True)
            case "sign":
                jump = g.select(g.lt(a[0].R, g.abs(a[0].v)), g.zero, self.endless)
                return Along(g.sign(a[0].v), g.zero, g.min(jump, g.const(2.0)), jump, jump, True)
            case "min" | "max":
                return self._extreme(a[0], a[1], op)
            case "atan2":
                return self._angle(a[0], a[1])
            case _:
                raise KeyError(f"operation {op!r} has no bounds")

    def _input(self, group: str, index: int) -> Along:
        g = self.g
        if group == "x":
            k = self.states[index]
            return self.smooth(g.input("x", k), g.input("rate", k), g.input("bend", k))
        if group == "t":
            return self.smooth(g.input("t", 0), g.input("stretch", 0), g.zero)
        if group == "u":
            return self.smooth(g.input("u", index), g.input("drift", index), g.zero)
        return self.still(g.input(group, index))

    def _moves(self, a: Along) -> bool:
        return self.g.zero != a.R

    def _sum(self, a: Along, b: Along, op: str) -> Along:
        g = self.g
        join = g.add if op == "add" else g.sub
        v, d, K = join(a.v, b.v), join(a.d, b.d), g.add(a.K, b.K)
        if not (a.free or b.free):
            return self.smooth(v, d, K)
        return self.smooth(v, d, K, R=g.add(a.R, b.R), S=g.add(a.S, b.S))

    def _product(self, a: Along, b: Along) -> Along:
        g = self.g
        v, d = g.mul(a.v, b.v), g.add(g.mul(a.v, b.d), g.mul(b.v, a.d))
        A, B = greatest(g, a), greatest(g, b)
        K = g.add(g.mul(A, b.K), g.add(g.mul(g.const(2.0), g.mul(a.S, b.S)), g.mul(B, a.K)))
        if not (a.free or b.free):
            return self.smooth(v, d, K)
        R = g.add(g.mul(g.abs(a.v), b.R), g.mul(B, a.R))
        return self.smooth(v, d, K, R=R, S=g.add(g.mul(A, b.S), g.mul(B, a.S)))

    def _quotient(self, a: Along, b: Along) -> Along:
        """q″ = (a″ − 2 q′ b′ − q b″)/b."""
        g = self.g
        v = g.div(a.v, b.v)
        d = g.div(g.sub(a.d, g.mul(v, b.d)), b.v)
        least = smallest(g, b)
        most = g.div(greatest(g, a), least)
        S = g.div(g.add(a.S, g.mul(most, b.S)), least)
        K = g.div(g.add(a.K, g.add(g.mul(g.const(2.0), g.mul(S, b.S)), g.mul(most, b.K))), least)
        if not (a.free or b.free):
            return self.smooth(v, d, K)
        return self.smooth(v, d, K, R=g.div(g.add(a.R, g.mul(g.abs(v), b.R)), least), S=S)

    def _function(self, a: Along, f: Slopes) -> Along:
        g = self.g
        K = g.add(g.mul(f.second, g.mul(a.S, a.S)), g.mul(f.first, a.K))
        least = g.mul(f.first, a.R) if a.free else None
        if f.within is not None:
            span = g.add(g.abs(f.v), g.const(f.within))
            least = span if least is None else g.min(least, span)
        return self.smooth(f.v, g.mul(f.slope, a.d), K, R=least, S=g.mul(f.first, a.S) if a.free else None)

    def _power(self, a: Along, n: int, whole: int | None) -> Slopes:
        """a^n; |a|^(n−1) is largest at one of the ends."""
        g = self.g
        ends = (greatest(g, a),) if whole is not None and whole >= 2 else (smallest(g, a), greatest(g, a))
        m, k = g.sub(n, g.one), g.sub(n, g.const(2.0))

        def largest(exponent: int) -> int:
            found = g.pow(ends[0], exponent)
            for x in ends[1:]:
                found = g.max(found, g.pow(x, exponent))
            return found

        first = g.mul(g.abs(n), largest(m))
        return Slopes(g.pow(a.v, n), g.mul(n, g.pow(a.v, m)), first, g.mul(g.abs(g.mul(n, m)), largest(k)))

    def _extreme(self, a: Along, b: Along, op: str) -> Along:
        g = self.g
        first = g.le(a.v, b.v) if op == "min" else g.le(b.v, a.v)
        apart = self.apart(a, b)

        def taken(x: int, y: int, both: int) -> int:
            return g.select(apart, g.select(first, x, y), both)

        return Along(
            g.select(first, a.v, b.v), g.select(first, a.d, b.d), taken(a.R, b.R, g.max(a.R, b.R)),
            taken(a.S, b.S, g.max(a.S, b.S)), taken(a.K, b.K, self.endless), True,
        )  # fmt: skip

    def _angle(self, y: Along, x: Along) -> Along:
        """θ = atan2(y, x): with z = x + iy, θ′ = Im z′/z and θ″ = Im (z″/z − (z′/z)²); a jump where y = 0, x < 0."""
        g = self.g
        square = g.add(g.mul(x.v, x.v), g.mul(y.v, y.v))
        least = above(g, g.sub(g.sqrt(square), g.add(x.R, y.R)))
        d = g.div(g.sub(g.mul(x.v, y.d), g.mul(y.v, x.d)), square)
        speed = g.div(g.add(x.S, y.S), least)
        K = g.add(g.div(g.add(x.K, y.K), least), g.mul(speed, speed))
        whole = g.or_(g.lt(y.R, g.abs(y.v)), g.lt(x.R, x.v))
        found = self.smooth(g.atan2(y.v, x.v), d, K, S=speed)
        turn = g.const(2 * math.pi)
        return Along(
            found.v, found.d, g.select(whole, found.R, turn), g.select(whole, found.S, self.endless),
            g.select(whole, found.K, self.endless), True,
        )  # fmt: skip

    # -- conditions ---------------------------------------------------------------------------------------------

    def _truth(self, node: Node) -> Truth:
        g, op = self.g, node[0]
        if op in ("and", "or", "not"):
            parts = [self._condition(k) for k in node[1:]]
            if op == "not":
                return Truth(g.not_(parts[0].holds), parts[0].decided)
            join = g.and_ if op == "and" else g.or_
            return Truth(join(parts[0].holds, parts[1].holds), g.and_(parts[0].decided, parts[1].decided))
        a, b = self.number(node[1]), self.number(node[2])
        holds = {"lt": g.lt, "le": g.le, "eq": g.eq}[op](a.v, b.v)
        return Truth(holds, self.apart(a, b) if self._moves(a) or self._moves(b) else g.one)

    def _condition(self, i: int) -> Truth:
        found = self.known[i]
        if isinstance(found, Truth):
            return found
        return Truth(found.v, self.g.one)  # the constants 1 and 0

    def _select(self, node: Node) -> Along:
        g, c = self.g, self._condition(node[1])
        a, b = self.number(node[2]), self.number(node[3])

        def taken(x: int, y: int, both: int) -> int:
            return g.select(c.decided, g.select(c.holds, x, y), both)

        wide = g.add(g.max(a.R, b.R), g.abs(g.sub(a.v, b.v)))
        return Along(
            g.select(c.holds, a.v, b.v), g.select(c.holds, a.d, b.d), taken(a.R, b.R, wide),
            taken(a.S, b.S, self.endless), taken(a.K, b.K, self.endless), True,
        )  # fmt: skip
