"""Derives the equations of motion from a description, step by step as in a lecture.

`derive` does all of it: 0 holonomic?, 1 coordinates, 2 T*, 3 V, 4 L, 5 left-hand sides, 6 Ξ, then the equations.
"""

from lagrangian.derive.derive import derive
from lagrangian.derive.derived import Derived, LedgerRow, NamedQuantity, Origin, QuantityKind, Step, WrittenForm
from lagrangian.derive.lagrange import Detail
from lagrangian.derive.multiplier import Minimal, Multiplier, SpeedLine
from lagrangian.derive.reasons import Why, why

__all__ = [
    "Derived",
    "Detail",
    "LedgerRow",
    "Minimal",
    "Multiplier",
    "NamedQuantity",
    "Origin",
    "QuantityKind",
    "SpeedLine",
    "Step",
    "Why",
    "WrittenForm",
    "derive",
    "why",
]
