"""Elementary functions in LLVM IR, without branches, with the same code for a single number and for a vector.

``sincos``, ``exp``, ``log`` and ``atan2`` are implemented here; ``sinh``, ``cosh`` and ``tanh`` are computed from
``exp``, ``asin``, ``acos`` and ``atan`` from ``atan2``; the others call the C library lane by lane. Each is a function
of the module that is printed when it is first used.

The coefficients are computed by ``tools/minimax.py``; with z = r²

    sin r = r + r z S(z)     cos r = 1 − z/2 + z² C(z)     |r| ≤ π/4
    exp r = 1 + r + r² E(r)                                |r| ≤ ln 2 / 2
    atan r = r + r z A(z)                                  |r| ≤ tan π/8
    log m = 2 s + s z L(z), s = (m − 1)/(m + 1), z = s²     √½ ≤ m < √2
"""

from __future__ import annotations

import math
from collections.abc import Callable

from .ir import Function, Module, Value

SIN = (-0.16666666666666632, 0.008333333333322425, -0.00019841269829816863, 2.755731369519521e-06,
       -2.5050758648160705e-08, 1.5896827621544008e-10)  # fmt: skip
COS = (0.0416666666666666, -0.0013888888888874138, 2.4801587289491742e-05, -2.755731435521654e-07,
       2.087572368084499e-09, -1.1359669674695726e-11)  # fmt: skip
EXP = (0.5, 0.1666666666666667, 0.041666666666666685, 0.008333333333326141, 0.0013888888888874409,
       0.00019841269874802247, 2.4801587347314043e-05, 2.7557255423769634e-06, 2.755725293724237e-07,
       2.510520711668693e-08, 2.092158094033227e-09)  # fmt: skip
ATAN = (-0.333333333333332, 0.19999999999954082, -0.1428571428024855, 0.11111110786139472, -0.09090897836489972,
        0.07692061637766001, -0.06663120390587496, 0.05848008961100218, -0.05039845700820873, 0.0380783255473377,
        -0.01792228415811652)  # fmt: skip
LOG = (0.6666666666666734, 0.3999999999941468, 0.28571428742387506, 0.22222198573194615, 0.1818356432566764,
       0.15314050562241363, 0.1479594961068327)  # fmt: skip
HALF_PI = (1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33)  # their sum is π/2 to 160 bits
HALF_PI_SHORT = (1.5707963267341256, 6.077100506303966e-11, 2.0222662487111665e-21, 8.4784276603689e-32)
LN2 = (0.6931471806019545, -4.2009150726810846e-11)  # their sum is ln 2; n·LN2[0] is exact for |n| < 2^21

SHIFT = 6755399441055744.0  # 1.5·2⁵²: adding it rounds to a whole number, which is then in the low bits
SIGN = -(1 << 63)
SHIFT_BITS = 0x4338000000000000
LIBM = ("sin", "cos", "pow", "asinh", "acosh", "atanh")  # the order of the table of addresses
LANEWISE = ("pow", "asinh", "acosh", "atanh")


def sincos(module: Module, lanes: int) -> str:
    """The symbol of ``{sin x, cos x} = sincos(x)``: at most 2 ulp for |x| ≤ 10⁶.

    n = round(2x/π), r = x − n π/2 by Cody and Waite's method: π/2 is split into three parts and each subtraction is one
    fused operation, so the error is half an ulp of r. (Without fused operations there are four short parts, whose
    products with n are exact, and the rounding error of the second subtraction is carried on.) The quadrant n mod 4
    swaps sine and cosine and determines the signs. Arguments out of range, infinities and NaN are passed to the C
    library.
    """
    name = f"sincos_{lanes}"
    if module.defines(name):
        return "@" + name
    f = Function(module, lanes)
    x = Value(f, "%x")
    reach = 2.0**30 if module.target.fma else 2.0**20
    within = f.compare("ole", f.intrinsic("fabs", x), reach)
    turned = f.fma(x, 2 / math.pi, SHIFT)
    n = turned - SHIFT
    r = _reduced(f, x, n)
    z = r * r
    zz = z * z
    sin_r = f.fma(r * z, _poly6(f, z, zz, SIN), r)
    cos_r = f.fma(zz, _poly6(f, z, zz, COS), f.fma(z, -0.5, 1.0))
    quadrant = f.bits(turned)
    odd = f.put(f"icmp ne {f.whole} {f.whole_op('and', quadrant, 1)}, {f.integer(0)}")
    turns = f.whole_op("shl", quadrant, 62)  # bit 1 of the quadrant is now the sign
    sin_sign = f.whole_op("and", turns, SIGN)
    cos_sign = f.whole_op("and", f.whole_op("add", turns, 1 << 62), SIGN)
    s = f.number(f.whole_op("xor", f.bits(f.select(odd, cos_r, sin_r)), sin_sign))
    c = f.number(f.whole_op("xor", f.bits(f.select(odd, sin_r, cos_r)), cos_sign))
    f.do(f"br i1 {f.all_lanes(within)}, label %near, label %far")
    f.label("near")
    _return_two(f, s, c)

    f.label("far")  # the result in a lane must not depend on its neighbours
    if lanes > module.target.lanes:
        _return_two(f, *_by_halves(f, x))
    else:
        far_s, far_c = (_lanewise(f, LIBM.index(k), [x]) for k in ("sin", "cos"))
        _return_two(f, f.select(within, s, far_s), f.select(within, c, far_c))
    f.finish(name, f"internal {{ {f.real}, {f.real} }}", f"{f.real} %x", "noinline nounwind")
    return "@" + name


def _by_halves(f: Function, x: Value) -> tuple[Value, Value]:
    """Sine and cosine of more lanes than a register has, computed in two halves."""
    half = f.widened(f.lanes // 2)
    symbol, pair = sincos(f.module, half.lanes), f"{{ {half.real}, {half.real} }}"
    found = [f.put(f"call {pair} {symbol}({half.real} {part.name})") for part in (f.part(x, half, k) for k in range(2))]
    s, c = ([f.put(f"extractvalue {pair} {both}, {k}") for both in found] for k in range(2))
    return half.joined(s, f), half.joined(c, f)


def _reduced(f: Function, x: Value, n: Value) -> Value:
    """``x − n π/2``."""
    if f.module.target.fma:
        r = x
        for part in HALF_PI:
            r = f.fma(n, -part, r)
        return r
    first, second, third, fourth = HALF_PI_SHORT
    near = x - n * first  # exact, and so is n·second
    r = near - n * second
    lost = (near - r) - n * second
    return r - (n * third + n * fourth - lost)


def _poly6(f: Function, z: Value, zz: Value, c: tuple[float, ...]) -> Value:
    """``Σ c_k z^k`` with six terms, for known z²."""
    low, middle, high = (f.fma(z, c[k + 1], c[k]) for k in (0, 2, 4))
    return f.fma(zz, f.fma(zz, high, middle), low)


def _return_two(f: Function, a: Value, b: Value) -> None:
    pair = f"{{ {f.real}, {f.real} }}"
    first = f.put(f"insertvalue {pair} poison, {f.real} {a.name}, 0")
    f.do(f"ret {pair} {f.put(f'insertvalue {pair} {first}, {f.real} {b.name}, 1')}")


def function(module: Module, name: str, lanes: int) -> str:
    """The symbol of an elementary function: our own, or the C library's for each lane."""
    symbol = f"{name}_{lanes}"
    if module.defines(symbol):
        return "@" + symbol
    f = Function(module, lanes)
    arguments = ["%x", "%y"] if name in ("atan2", "pow") else ["%x"]
    values = [Value(f, a) for a in arguments]
    result = _lanewise(f, LIBM.index(name), values) if name in LANEWISE else _PRINTERS[name](f, *values)
    f.do(f"ret {f.real} {result.name}")
    f.finish(symbol, f"internal {f.real}", ", ".join(f"{f.real} {a}" for a in arguments), "noinline nounwind")
    return "@" + symbol


def _lanewise(f: Function, index: int, arguments: list[Value]) -> Value:
    """Call entry ``index`` of the table of C functions for each lane.

    The table is accessed through memory, not by name, so that no linker has to find the C library on any system. A
    module of WebAssembly imports the function instead, from the host's object ``Math``.
    """
    if f.module.target.imports:
        imported = f'"wasm-import-module"="Math" "wasm-import-name"="{LIBM[index]}"'
        callee = f.module.declare(f"math_{LIBM[index]}", "double", ["double"] * len(arguments), imported)
    else:
        table = f.put("load ptr, ptr @libm")
        callee = f.put(f"load ptr, ptr {f.put(f'getelementptr ptr, ptr {table}, i64 {index}')}")
    results = []
    for k in range(f.lanes):
        passed = ", ".join("double " + f.lane(a, k) for a in arguments)
        results.append(f.put(f"call double {callee}({passed})"))
    return f.gathered(results)


def _exp(f: Function, x: Value) -> Value:
    """``exp x = 2^n exp r``, n = round(x / ln 2); 2^n is split into two factors, so that results below 2^−1022 round
    once."""
    x = f.select(f.compare("olt", x, -746.0), -746.0, x)
    excess, n = _exp_parts(f, x)
    value = excess + 1.0
    half = f.whole_op("ashr", n, 1)
    for part in (half, f.whole_op("sub", n, half)):
        value = value * _power_of_two(f, part)
    return value


def _exp_parts(f: Function, x: Value) -> tuple[Value, str]:
    """``exp r − 1`` and n of ``x = n ln 2 + r``; above 711 all results overflow, so x is limited to that."""
    x = f.select(f.compare("ogt", x, 711.0), 711.0, x)
    turned = f.fma(x, 1 / math.log(2), SHIFT)
    n = turned - SHIFT
    r = f.fma(n, -LN2[1], f.fma(n, -LN2[0], x))
    return f.fma(r * r, f.polynomial(r, EXP), r), f.whole_op("sub", f.bits(turned), SHIFT_BITS)


def _power_of_two(f: Function, n: str) -> Value:
    """``2^n`` for −1022 ≤ n ≤ 1023, made from its bits."""
    return f.number(f.whole_op("shl", f.whole_op("add", n, 1023), 52))


def _eighth(f: Function, x: Value) -> Value:
    """``(exp x − 1)/8`` for x ≥ 0, without cancellation near 0: s (exp r − 1) + (s − ⅛), s = 2^(n−3)."""
    excess, n = _exp_parts(f, x)
    s = _power_of_two(f, f.whole_op("sub", n, 3))
    return f.fma(s, excess, s - 0.125)


def _sinh(f: Function, x: Value) -> Value:
    """``sinh |x| = h + h/(2h + 1)``, h = (exp |x| − 1)/2, with the sign of x."""
    h = _eighth(f, f.intrinsic("fabs", x)) * 4.0
    value = h + h / (h + h + 1.0)
    value = f.select(f.compare("oeq", h, math.inf), h, value)
    return f.intrinsic("copysign", value, x)


def _cosh(f: Function, x: Value) -> Value:
    """``cosh x = h + ¼/h``, h = exp |x| / 2."""
    h = _eighth(f, f.intrinsic("fabs", x)) * 4.0 + 0.5
    return h + 0.25 / h


def _tanh(f: Function, x: Value) -> Value:
    """``tanh |x| = e/(e + 2)``, e = exp 2|x| − 1, with the sign of x; 1 for |x| ≥ 22."""
    size = f.intrinsic("fabs", x)
    size = f.select(f.compare("ogt", size, 22.0), 22.0, size)
    eighth = _eighth(f, size + size)
    return f.intrinsic("copysign", eighth / (eighth + 0.25), x)


def _log(f: Function, x: Value) -> Value:
    """``log x = k ln 2 + log m``, √½ ≤ m < √2; with f = m − 1 and s = f/(2 + f)

    log m = f − (f²/2 − s (f²/2 + z L(z))): the leading f is exact, and what is rounded is small.
    """
    tiny = f.compare("olt", x, 2.0**-1022)
    bits = f.bits(f.select(tiny, x * 2.0**54, x))
    above = f.whole_op("sub", bits, 0x3FE6A09E667F3BCD)  # the bits of √½
    k = f.whole_op("ashr", above, 52)
    m = f.number(f.whole_op("sub", bits, f.whole_op("shl", k, 52)))
    power = f.number(f.whole_op("add", k, SHIFT_BITS)) - SHIFT - f.select(tiny, 54.0, 0.0)
    excess = m - 1.0
    s = excess / (excess + 2.0)
    z = s * s
    half = excess * excess * 0.5
    tail = f.fma(s, f.fma(z, f.polynomial(z, LOG), half), power * LN2[1])
    value = power * LN2[0] - ((half - tail) - excess)
    value = f.select(f.compare("oeq", x, math.inf), math.inf, value)
    value = f.select(f.compare("oeq", x, 0.0), -math.inf, value)
    return f.select(f.compare("oge", x, 0.0), value, math.nan)


def _atan2(f: Function, y: Value, x: Value) -> Value:
    """The angle of (x, y): with t = min/max of the magnitudes, atan t by A, or π/4 + atan((t − 1)/(t + 1)) beyond tan
    π/8.

    There is only one division, because numerator and denominator are chosen before it. Two zeros give 0 or ±π depending
    on their signs, and two infinities odd multiples of π/4, as in C.
    """
    ax, ay = f.intrinsic("fabs", x), f.intrinsic("fabs", y)
    steep = f.compare("ogt", ay, ax)
    small, large = f.select(steep, ax, ay), f.select(steep, ay, ax)
    scale = f.select(f.compare("ogt", large, 2.0**1000), 2.0**-100, 1.0)  # their sum must not overflow
    endless = f.logic("and", f.compare("oeq", small, math.inf), f.compare("oeq", large, math.inf))
    small, large = (f.select(endless, 1.0, side * scale) for side in (small, large))
    middle = f.compare("ogt", small, large * math.tan(math.pi / 8))
    top = f.select(middle, small - large, small)
    bottom = f.select(middle, small + large, large)
    bottom = f.select(f.compare("oeq", large, 0.0), 1.0, bottom)
    t = top / bottom
    z = t * t
    angle = f.fma(t * z, f.polynomial(z, ATAN), t)
    angle = f.select(middle, math.pi / 4, 0.0) + (angle + f.select(middle, HALF_PI[1] / 2, 0.0))
    angle = f.select(steep, HALF_PI[0] - (angle - HALF_PI[1]), angle)
    left = f.compare("olt", f.intrinsic("copysign", 1.0, x), 0.0)
    angle = f.select(left, math.pi - (angle - 2 * HALF_PI[1]), angle)
    return f.intrinsic("copysign", angle, y)


def _atan(f: Function, x: Value) -> Value:
    """``atan x`` = angle of (1, x)."""
    return _atan2(f, x, Value(f, f.constant(1.0)))


def _leg(f: Function, x: Value) -> Value:
    """``√(1 − x²)`` without cancellation near |x| = 1; NaN for |x| > 1."""
    return f.intrinsic("sqrt", (1.0 - x) * (x + 1.0))


def _asin(f: Function, x: Value) -> Value:
    """``asin x`` = angle of (√(1 − x²), x)."""
    return _atan2(f, x, _leg(f, x))


def _acos(f: Function, x: Value) -> Value:
    """``acos x`` = angle of (x, √(1 − x²))."""
    return _atan2(f, _leg(f, x), x)


_PRINTERS: dict[str, Callable[..., Value]] = {
    "exp": _exp,
    "log": _log,
    "sinh": _sinh,
    "cosh": _cosh,
    "tanh": _tanh,
    "atan2": _atan2,
    "atan": _atan,
    "asin": _asin,
    "acos": _acos,
}
