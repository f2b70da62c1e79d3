"""Reading what people wrote: expressions, quantities with units, model files."""

from lagrangian.read.expression import parse_expression
from lagrangian.read.quantity import Quantity, parse_quantity, unit_dimension
from lagrangian.read.scope import Scope

__all__ = ["Quantity", "Scope", "parse_expression", "parse_quantity", "unit_dimension"]
