"""The base class of integration methods, and the data from which one prints a step."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from lagrangian.codegen.ir import Function, Value
from lagrangian.records import dataclass, field

from .printer import Printer, Vec

# log2(1 + z) on 0 … 1 and 2^z on −½ … ½, least squares on Chebyshev points
LOG2 = (1.439093e-05, 1.44159208, -0.707253434, 0.411561482, -0.189832447, 0.0439286278)
EXP2 = (1.00000008, 0.693121034, 0.240221074, 0.0559220356, 0.0096760371)

if TYPE_CHECKING:
    from .jets import Jets

Rate = Callable[..., Vec]  # (t, x, into) → f(t, x)


@dataclass
class MethodStep:
    """One step in every lane: from ``x`` at ``t``, where the derivative is ``k``, over ``h``.

    ``lost`` is what the sums so far have lost to rounding (Kahan); ``atol`` has one number per entry, ``rtol`` is a
    single number.
    """

    p: Printer
    t: Value
    h: Value
    x: Vec
    lost: Vec
    k: Vec
    rate: Rate
    rtol: Value
    atol: Vec
    new_x: Vec  # slots for what trial() finds
    new_lost: Vec
    new_k: Vec
    inlet: tuple[Vec, ...]  # where the state must be written for ``rate`` to read it in place, if vectors are long
    running: str  # lanes that take part
    spend: Callable[[str, int], None]  # (flag, n): n more evaluations of the derivative where the flag holds
    memory: tuple[Vec, ...] = ()  # vectors and slots of the method's own, kept from step to step
    slots: tuple[int, ...] = ()
    lands_late: bool = False  # the derivative at the end is handed in after the trial
    unit: Value | None = None  # the unit of time of an expansion
    stages: list[Vec] = field(default_factory=list)  # derivatives computed in the step, the first being k

    def advance(self, increment: Callable[..., Value], *given: Vec) -> None:
        """Set ``new_x`` to x plus an increment; the rounding error of the sum is stored in ``new_lost``."""

        def add(x: Value, lost: Value, *rest: Value) -> tuple[Value, Value]:
            d = increment(*rest) + lost
            new = x + d
            return new, d - (new - x)

        self.new_x, self.new_lost = self.p.map(add, self.x, self.lost, *given, into=(self.new_x, self.new_lost))

    def scale(self, x: Value, new: Value, atol: Value) -> Value:
        """The tolerance of an entry: ``atol + rtol max(|x|, |new|)``."""
        f = self.p.f
        a, b = f.intrinsic("fabs", x), f.intrinsic("fabs", new)
        return f.fma(f.select(f.compare("ogt", a, b), a, b), self.rtol, atol)


class Method(ABC):
    """A one-step method: it prints a trial step and the polynomial inside a step.

    ``order``: that of the results; ``error_order``: the error estimate, which determines the step size, is proportional
    to h^error_order; None for fixed steps. ``evaluations``: the number of evaluations of the derivative per step.
    ``follows``: the last derivative is that at the end of the step, and the first of the next step.
    """

    name: str
    title: str
    source: str
    order: int
    error_order: int | None = None
    evaluations: int
    dense_evaluations: int = 0
    follows: bool = False
    limits: tuple[float, float] = (0.2, 10.0)  # how much the step size may change from step to step
    expands: bool = False  # the length of a step follows from an expansion at its start
    blocks: int = 0  # vectors of its own, f(t, x) in each at first
    slots: int = 0  # single numbers of its own
    lands_late: bool = False  # the derivative at a step's end may be taken after the error, at a projected end
    memory: float = 0.0  # weight of the previous step's error (PI control)

    @property
    def adaptive(self) -> bool:
        """Whether the method chooses its step size."""
        return self.error_order is not None

    @property
    def cost(self) -> int:
        """The approximate cost of a step in evaluations of the derivative."""
        return self.evaluations

    @property
    def dense_order(self) -> int:
        """The order of the dense output."""
        return 3

    def expand(self, s: MethodStep, jets: Callable[[list[list[Value]]], Jets]) -> Value:
        """Print the expansion at the start of a step; return the length of the step to take."""
        raise TypeError(f"{self.name} does not expand")

    def suited(self, tolerance: float) -> Method:
        """The method for a relative tolerance, if the tolerance determines more than the step size."""
        return self

    @abstractmethod
    def trial(self, s: MethodStep) -> Value | None:
        """Print a step; return the size of its error, where 1 is the tolerance.

        For fixed steps, return nothing, or a number that is not 0 where stages do not converge. It sets ``s.new_x``,
        ``s.new_lost`` and, if the method ``follows``, ``s.new_k``.
        """

    def landed(self, s: MethodStep, k: Vec) -> None:
        """Store the derivative at the end of a step that a projection moved."""
        s.new_k = k

    def interpolant(self, s: MethodStep) -> list[Vec]:
        """Print what the polynomial inside the step needs, after a trial; return its coefficients.

        The value at t + θ h is ``x + θ (F0 + (1 − θ)(F1 + θ (F2 + (1 − θ)(F3 + …))))``. The first three are those of
        Hermite's cubic: Δx, h k − Δx, 2 Δx − h (k + k_new).
        """
        if not self.follows:
            s.new_k = s.rate(s.t + s.h, s.new_x, s.new_k)

        def hermite(x: Value, new: Value, k: Value, new_k: Value) -> tuple[Value, Value, Value]:
            change = new - x
            return change, s.h * k - change, change + change - s.h * (k + new_k)

        return list(s.p.map(hermite, s.x, s.new_x, s.k, s.new_k))

    def between(self, s: MethodStep, coefficients: list[Vec], theta: Value) -> Callable[..., Value]:
        """The value at θ of an entry, from x and its coefficients."""
        rest = 1.0 - theta

        def value(x: Value, *entries: Value) -> Value:
            total: Value | None = None
            for k in range(len(entries) - 1, -1, -1):
                inner = entries[k] if total is None else entries[k] + total
                total = inner * (rest if k % 2 else theta)
            assert total is not None
            return x + total

        return value

    origin: float = 0.5
    """Where in the step, in θ, the powers of :meth:`powers` are 0."""

    def powers(self, s: MethodStep, coefficients: list[Vec], entry: int) -> list[Value]:
        """An entry inside the step as a polynomial: its coefficients of (θ − origin)⁰, (θ − origin)¹, …"""
        p = s.p
        given = [p.read(c, entry) for c in coefficients]
        found = [p.weighted(pairs) for pairs in _in_powers(given)]
        found[0] = found[0] + p.read(s.x, entry)
        return found


def _in_powers(given: Sequence[Value]) -> list[list[tuple[float, Value]]]:
    """The weights of F0, F1, … (see :meth:`Method.interpolant`) in the coefficients of (θ − ½)ʲ."""
    rows: list[list[tuple[float, Value]]] = [[] for _ in range(len(given) + 1)]
    product = [1.0]
    for k, value in enumerate(given):
        sign = 1.0 if k % 2 == 0 else -1.0  # θ = ½ + z and 1 − θ = ½ − z by turns
        product = [a * 0.5 + sign * b for a, b in zip([*product, 0.0], [0.0, *product], strict=True)]
        for j, weight in enumerate(product):
            if weight:
                rows[j].append((weight, value))
    return rows


def rough_power(f: Function, x: Value, exponent: float) -> Value:
    """``x^exponent`` for x ≥ 0 to about four digits: sufficient for a step size, and the same for every number of
    lanes."""
    bits = f.bits(x)
    whole = f.whole_op("lshr", bits, 52)
    mantissa = f.number(f.whole_op("or", f.whole_op("and", bits, 0xFFFFFFFFFFFFF), 0x3FF0000000000000))
    e = f.number(f.whole_op("add", whole, 0x4338000000000000)) - (6755399441055744.0 + 1023.0)
    log = f.polynomial(mantissa - 1.0, LOG2) + e
    y = log * exponent
    y = f.select(f.compare("ogt", y, 900.0), 900.0, f.select(f.compare("olt", y, -900.0), -900.0, y))
    turned = y + 6755399441055744.0
    fraction = y - (turned - 6755399441055744.0)
    scale = f.number(f.whole_op("shl", f.whole_op("add", f.bits(turned), 1023), 52))
    return f.polynomial(fraction, EXP2) * scale
