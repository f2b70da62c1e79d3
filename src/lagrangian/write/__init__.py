"""A derivation written out for people."""

from lagrangian.write.files import write_file

__all__ = ["write_file"]
