"""The largest numbers that systems are computed with: larger ones are named where they are given."""

LARGEST = 1e150
"""The largest size of a value in SI units: its square is still below the largest floating-point number, 1.8e308."""

SMALLER = "check its power of ten and its unit"
"""What to do about a value that is too large."""


def too_large(value: float) -> str | None:
    """Return what is wrong with a value whose products would not be numbers any more, None if nothing is."""
    return f"is too large to compute with: {value:g}; the limit is {LARGEST:g}" if abs(value) > LARGEST else None
