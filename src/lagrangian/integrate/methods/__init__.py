"""Methods of integration, which are printed as machine code around a right-hand side."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from .dop853 import DOP853
from .gauss4 import GAUSS4
from .method import Method
from .rk4 import RK4
from .taylor import TAYLOR
from .tsit5 import TSIT5

METHODS: Mapping[str, Method] = MappingProxyType({m.name: m for m in (RK4, TSIT5, DOP853, GAUSS4, TAYLOR)})
"""All methods of integration that are printed as machine code, by name."""

__all__ = ["METHODS", "Method"]
