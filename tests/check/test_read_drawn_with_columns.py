"""Matrices drawn in two lines, with the column of all coordinates by its letter between them.

Oracle: the equations of two masses on springs. Every form has a wrong twin.
"""

from functools import cache

import pytest

import lagrangian as lg

DRAWN = {
    "rates by letter": """
[ m   0 ]        [  b   -b ]       [ k1 + k2   -k2 ]      [ F ]
[ 0   M ] q''  + [ -b    b ] q'  + [  -k2       k2 ] q  = [ 0 ]
""",
    "in the first line": """
[ m   0 ] q'' + [  b   -b ] q' + [ k1 + k2   -k2 ] q = [ F ]
[ 0   M ]       [ -b    b ]      [  -k2       k2 ]     [ 0 ]
""",
    "spelled out": """
[ m   0 ]       [  b   -b ]        [ k1 + k2   -k2 ]      [ F ]
[ 0   M ] qdd + [ -b    b ] qd  +  [  -k2       k2 ] q  = [ 0 ]
""",
}


@cache
def masses() -> lg.Derivation:
    """Two masses in a row on springs, with a damper between them."""
    s = lg.System("two masses")
    x, y = s.coordinates("x y")
    m, M, k1, k2, b = s.parameters("m M k1 k2 b")
    s.particle(m, at=s.point("one", (x, 0)), name="one")
    s.particle(M, at=s.point("two", (y, 0)), name="two")
    s.spring(k1, deflection=x)
    s.spring(k2, deflection=y - x)
    s.damper(b, deflection=y - x)
    s.force(s.input("F"), deflection=x)
    return s.derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", DRAWN)
def test_a_column_by_its_letter_stands_between_drawn_matrices(form: str) -> None:
    written = f"q = (x, y)\n{DRAWN[form]}"
    assert masses().check(written).right
    assert not masses().check(written.replace("k1 + k2", "k1 - k2")).right
    assert not masses().check(written.replace("[ F ]", "[-F ]")).right
