"""The same system in other coordinates."""

from lagrangian.analyze.change.carry import carried, changed
from lagrangian.analyze.change.change import Change, read_change

__all__ = ["Change", "carried", "changed", "read_change"]
