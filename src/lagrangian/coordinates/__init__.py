"""Describes the same system in other coordinates."""

from lagrangian.coordinates.carry import Carrier, carried, changed
from lagrangian.coordinates.change import Change, check_regular, is_regular, read_change

__all__ = ["Carrier", "Change", "carried", "changed", "check_regular", "is_regular", "read_change"]
