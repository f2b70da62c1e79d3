"""LLVM IR as text: a module, its functions, and values that print an instruction when an operator is applied.

Everything is straight-line code on ``double`` or ``<lanes x double>``. No fast-math flag is ever set: where a product
and a sum should be rounded only once, :meth:`Function.fma` says so, so that scalar and vector code round alike.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from itertools import count

from lagrangian.records import dataclass, field

BIND = "bind_libm"  # every module has this function, which receives the table of C functions once, after loading
LIBM_TABLE = f"""@libm = internal global ptr null
define void @{BIND}(ptr %table) {{
  store ptr %table, ptr @libm
  ret void
}}"""


def hexadecimal(x: float) -> str:
    """A double as LLVM writes it exactly: ``0x`` and the 16 hexadecimal digits of its bits."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', x))[0]:016X}"


def shuffle_mask(indices: Iterable[int]) -> str:
    """The mask of a shuffle."""
    numbers = list(indices)
    return f"<{len(numbers)} x i32> <" + ", ".join(f"i32 {k}" for k in numbers) + ">"


@dataclass(frozen=True, slots=True)
class Target:
    """What the printed code may rely on: the name of the machine for the compiler, fused multiply-add, vector width."""

    triple: str
    cpu: str
    features: str
    fma: bool
    lanes: int  # doubles in the widest vector register
    splat: bool  # whether the assembler reads ``splat (double c)`` (LLVM 19 and later)
    imports: bool = False  # C functions are imports of the module, by name, instead of entries of the table


@dataclass
class Module:
    """The text of an LLVM module; intrinsics and helper functions are printed once, when they are first needed."""

    target: Target
    _declared: dict[str, str] = field(default_factory=dict)
    _functions: dict[str, str] = field(default_factory=dict)

    def declare(self, name: str, result: str, arguments: Sequence[str], attributes: str = "") -> str:
        """Declare the function ``name``, such as an intrinsic; return its symbol."""
        if name not in self._declared:
            self._declared[name] = f"declare {result} @{name}({', '.join(arguments)}) {attributes}".rstrip()
        return "@" + name

    def define(self, name: str, text: str) -> None:
        """Add a function's text."""
        self._functions[name] = text

    def defines(self, name: str) -> bool:
        """Whether a function of this name exists."""
        return name in self._functions

    def text(self) -> str:
        """The whole module; unless C functions are imported, with the pointer to their table and what sets it."""
        head = [f'target triple = "{self.target.triple}"']
        if not self.target.imports:
            head.append(LIBM_TABLE)
        return "\n".join([*head, *self._declared.values(), *self._functions.values(), ""])


class Value:
    """A number in a register; arithmetic on it prints an instruction. Plain floats become constants in every lane."""

    __slots__ = ("function", "name")

    def __init__(self, function: Function, name: str) -> None:
        self.function, self.name = function, name

    def __add__(self, other: Value | float) -> Value:
        return self.function.binary("fadd", self, other)

    def __radd__(self, other: float) -> Value:
        return self.function.binary("fadd", other, self)

    def __sub__(self, other: Value | float) -> Value:
        return self.function.binary("fsub", self, other)

    def __rsub__(self, other: float) -> Value:
        return self.function.binary("fsub", other, self)

    def __mul__(self, other: Value | float) -> Value:
        return self.function.binary("fmul", self, other)

    def __rmul__(self, other: float) -> Value:
        return self.function.binary("fmul", other, self)

    def __truediv__(self, other: Value | float) -> Value:
        return self.function.binary("fdiv", self, other)

    def __rtruediv__(self, other: float) -> Value:
        return self.function.binary("fdiv", other, self)

    def __neg__(self) -> Value:
        return Value(self.function, self.function.put(f"fneg {self.function.real} {self.name}"))


class Function:
    """The instructions of one function, printed one after another.

    ``real``, ``whole`` and ``flag`` are the types of a number, a 64-bit integer and a truth value in every lane.
    """

    def __init__(self, module: Module, lanes: int) -> None:
        self.module, self.lanes = module, lanes
        self.real, self.whole, self.flag = (self.vector(t) for t in ("double", "i64", "i1"))
        self.suffix = "f64" if lanes == 1 else f"v{lanes}f64"
        self.lines: list[str] = []
        self._numbers = count(1)

    def widened(self, lanes: int) -> Function:
        """A view that prints vector code of another width into the same function."""
        other = Function(self.module, lanes)
        other.lines, other._numbers = self.lines, self._numbers
        return other

    def vector(self, element: str) -> str:
        """The type with one ``element`` per lane."""
        return element if self.lanes == 1 else f"<{self.lanes} x {element}>"

    def put(self, instruction: str) -> str:
        """Print ``%name = instruction``; return the name."""
        name = f"%v{next(self._numbers)}"
        self.lines.append(f"  {name} = {instruction}")
        return name

    def do(self, instruction: str) -> None:
        """Print an instruction without a result."""
        self.lines.append("  " + instruction)

    def label(self, name: str) -> None:
        """Start a basic block."""
        self.lines.append(f"{name}:")

    # Constants ---------------------------------------------------------------------------------------------------

    def constant(self, x: float) -> str:
        """A number as an operand, the same in every lane."""
        return self.spread("double", hexadecimal(x))

    def integer(self, i: int) -> str:
        """A 64-bit integer as an operand, the same in every lane."""
        return self.spread("i64", str(i))

    def spread(self, element: str, text: str) -> str:
        """A constant operand in every lane."""
        if self.lanes == 1:
            return text
        if self.module.target.splat:
            return f"splat ({element} {text})"
        return "<" + ", ".join([f"{element} {text}"] * self.lanes) + ">"

    def operand(self, x: Value | float) -> str:
        """The operand for ``x`` in an instruction."""
        return x.name if isinstance(x, Value) else self.constant(x)

    # Arithmetic --------------------------------------------------------------------------------------------------

    def binary(self, operation: str, a: Value | float, b: Value | float) -> Value:
        """``a operation b`` on numbers."""
        return Value(self, self.put(f"{operation} {self.real} {self.operand(a)}, {self.operand(b)}"))

    def fma(self, a: Value | float, b: Value | float, c: Value | float) -> Value:
        """``a b + c``, rounded once if the machine supports it, otherwise twice."""
        if not self.module.target.fma:
            return self.binary("fadd", self.binary("fmul", a, b), c)
        return self.intrinsic("fma", a, b, c)

    def intrinsic(self, name: str, *arguments: Value | float) -> Value:
        """LLVM's elementwise function of that name: ``sqrt``, ``fabs``, ``copysign``, ``fma``."""
        symbol = self.module.declare(f"llvm.{name}.{self.suffix}", self.real, [self.real] * len(arguments))
        passed = ", ".join(f"{self.real} {self.operand(a)}" for a in arguments)
        return Value(self, self.put(f"call {self.real} {symbol}({passed})"))

    def polynomial(self, x: Value, coefficients: Sequence[float]) -> Value:
        """``Σ c_k x^k`` by Estrin's scheme: first pairs, then pairs of pairs with x², x⁴ ….

        It has half the depth of Horner's scheme.
        """
        terms: list[Value | float] = list(coefficients)
        power = x
        while len(terms) > 1:
            pairs = [self.fma(terms[k + 1], power, terms[k]) for k in range(0, len(terms) - 1, 2)]
            terms = [*pairs, *terms[len(terms) // 2 * 2 :]]
            if len(terms) > 1:
                power = power * power
        only = terms[0]
        return only if isinstance(only, Value) else Value(self, self.constant(only))

    # Comparison and bits -----------------------------------------------------------------------------------------

    def compare(self, condition: str, a: Value | float, b: Value | float) -> str:
        """A truth value per lane.

        ``condition`` is LLVM's: ``olt``, ``ole``, ``oeq`` are false if an operand is NaN.
        """
        return self.put(f"fcmp {condition} {self.real} {self.operand(a)}, {self.operand(b)}")

    def select(self, flag: str, a: Value | float, b: Value | float) -> Value:
        """``a`` where the flag holds, otherwise ``b``."""
        chosen = f"select {self.flag} {flag}, {self.real} {self.operand(a)}, {self.real} {self.operand(b)}"
        return Value(self, self.put(chosen))

    def logic(self, operation: str, a: str, b: str) -> str:
        """``and``, ``or``, ``xor`` of truth values."""
        return self.put(f"{operation} {self.flag} {a}, {b}")

    def opposite(self, flag: str) -> str:
        """The flag negated."""
        return self.logic("xor", flag, self.spread("i1", "true"))

    def bits(self, x: Value) -> str:
        """The 64 bits of a double as an integer."""
        return self.put(f"bitcast {self.real} {x.name} to {self.whole}")

    def number(self, bits: str) -> Value:
        """The double with these 64 bits."""
        return Value(self, self.put(f"bitcast {self.whole} {bits} to {self.real}"))

    def whole_op(self, operation: str, a: str, b: int | str) -> str:
        """An operation on integers: ``add``, ``sub``, ``and``, ``shl``, ``lshr``, ``ashr``, ``xor``."""
        other = self.integer(b) if isinstance(b, int) else b
        return self.put(f"{operation} {self.whole} {a}, {other}")

    def all_lanes(self, flag: str) -> str:
        """A single truth value: whether the flag holds in every lane."""
        if self.lanes == 1:
            return flag
        symbol = self.module.declare(f"llvm.vector.reduce.and.v{self.lanes}i1", "i1", [self.flag])
        return self.put(f"call i1 {symbol}({self.flag} {flag})")

    # Lanes and memory --------------------------------------------------------------------------------------------

    def lane(self, x: Value, k: int) -> str:
        """Lane k as a scalar ``double`` operand."""
        return x.name if self.lanes == 1 else self.put(f"extractelement {self.real} {x.name}, i32 {k}")

    def gathered(self, scalars: Sequence[str]) -> Value:
        """The vector of these scalar operands."""
        if self.lanes == 1:
            return Value(self, scalars[0])
        name = "poison"
        for k, scalar in enumerate(scalars):
            name = self.put(f"insertelement {self.real} {name}, double {scalar}, i32 {k}")
        return Value(self, name)

    def broadcast(self, scalar: str) -> Value:
        """A scalar ``double`` operand in every lane."""
        if self.lanes == 1:
            return Value(self, scalar)
        first = self.put(f"insertelement {self.real} poison, double {scalar}, i32 0")
        return Value(
            self,
            self.put(f"shufflevector {self.real} {first}, {self.real} poison, <{self.lanes} x i32> zeroinitializer"),
        )

    def whole_broadcast(self, x: str) -> str:
        """A scalar 64-bit integer in every lane."""
        if self.lanes == 1:
            return x
        first = self.put(f"insertelement {self.whole} poison, i64 {x}, i32 0")
        return self.put(
            f"shufflevector {self.whole} {first}, {self.whole} poison, <{self.lanes} x i32> zeroinitializer"
        )

    def part(self, x: Value, narrow: Function, k: int) -> Value:
        """The k-th piece of a vector, as a vector for a narrower function."""
        if narrow.lanes == self.lanes:
            return Value(narrow, x.name)
        mask = shuffle_mask(range(k * narrow.lanes, (k + 1) * narrow.lanes))
        return Value(narrow, self.put(f"shufflevector {self.real} {x.name}, {self.real} poison, {mask}"))

    def joined(self, names: Sequence[str], wide: Function) -> Value:
        """A power of two of vectors, joined to one vector for a wider function."""
        lanes, pieces = self.lanes, list(names)
        while len(pieces) > 1:
            kind, mask = f"<{lanes} x double>", shuffle_mask(range(2 * lanes))
            pieces = [
                self.put(f"shufflevector {kind} {a}, {kind} {b}, {mask}")
                for a, b in zip(pieces[::2], pieces[1::2], strict=True)
            ]
            lanes *= 2
        return Value(wide, pieces[0])

    def load(self, base: str, index: int, *, uniform: bool = False) -> Value:
        """Load slot ``index`` of a block of numbers: ``lanes`` doubles per slot, or one double for all lanes if
        uniform."""
        if uniform or self.lanes == 1:
            address = self.put(f"getelementptr double, ptr {base}, i64 {index}")
            return self.broadcast(self.put(f"load double, ptr {address}, align 8"))
        address = self.put(f"getelementptr {self.real}, ptr {base}, i64 {index}")
        return Value(self, self.put(f"load {self.real}, ptr {address}, align {8 * self.lanes}"))

    def store(self, x: Value | float, base: str, index: int) -> None:
        """Write slot ``index`` of a block of numbers, ``lanes`` doubles per slot."""
        address = self.put(f"getelementptr {self.real}, ptr {base}, i64 {index}")
        self.do(f"store {self.real} {self.operand(x)}, ptr {address}, align {8 * self.lanes}")

    def finish(self, name: str, result: str, arguments: str, attributes: str = "") -> None:
        """Close the function and add it to the module."""
        head = f"define {result} @{name}({arguments}) {attributes} {{".replace("  ", " ")
        self.module.define(name, "\n".join([head, "entry:", *self.lines, "}"]))
