"""Dots of rates on the line above the letters."""

import pytest

from lagrangian import built_in
