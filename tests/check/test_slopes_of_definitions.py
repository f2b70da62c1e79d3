r"""What a system defines by one coordinate is called and differentiated as a function: p(φ), dp/dφ.

Oracle: a hatch with a weight on a rope, by hand. Every form has a wrong twin.
"""

from functools import cache

import pytest

import lagrangian as lg

HATCH = """name = "hatch"
[coordinates]
phi = {}

[parameters]
I = {}
r = {}
e = {}
m = {}
k = {}
g = {}

[define]
p = "sqrt(r^2 + e^2 + 2*r*e*sin(phi))"

[points]
W = ["0", "-p"]

[[frame]]
name = "hatch"
angle = "phi"

[[rigid_body]]
name = "hatch"
mass = 0
inertia = "I"
at = "origin"
frame = "hatch"

[[particle]]
name = "weight"
mass = "m"
at = "W"

[[gravity]]
direction = [0, -1]
g = "g"

[[damper]]
name = "guide"
b = "k"
deflection = "p"
"""


@cache
def hatch() -> lg.Derivation:
    """A hatch whose rope lifts a weight in a guide with a damper."""
    return lg.loads(HATCH).derive()


PLAIN = """{stated}
w = {slope} = r e cos(phi)/p, dw/dphi = -r e sin(phi)/p - r^2 e^2 cos(phi)^2/p^3
T = 1/2 (I + m w^2) phi'^2
V = -m g p
(I + m w^2) phi'' + m w dw/dphi phi'^2 - m g w = -k w^2 phi'
"""
LATEX = r"""$$ {stated}, \quad w(\phi) = {slope} = \frac{{r e\cos\phi}}{{p}}, \quad
w_\phi = \frac{{dw}}{{d\phi}} = -\frac{{re\sin\phi}}{{p}} - \frac{{r^2e^2\cos^2\phi}}{{p^3}} $$
$$ T = \tfrac12 (I + m w^2)\dot\phi^2, \quad V = -mgp $$
$$ (I + m w^2)\ddot\phi + m w\, w_\phi \dot\phi^2 - mgw = -k w^2\dot\phi $$
"""
STATED = ["p(phi) = sqrt(r^2 + e^2 + 2 r e sin(phi))", "h = p(phi) = sqrt(r^2 + e^2 + 2 r e sin(phi))"]
IN_TEXT = [(x, y) for x in STATED for y in ("dp/dphi", "∂p/∂φ")]
IN_LATEX = [
    (r"p(\phi)=\sqrt{r^2+e^2+2re\sin\phi}", r"\frac{dp}{d\phi}"),
    (r"p=\sqrt{r^2+e^2+2re\sin\phi}", r"\dfrac{\mathrm{d}p}{\mathrm{d}\phi}"),
    (r"p\left(\phi\right)=\sqrt{r^2+e^2+2re\sin\phi}", r"\frac{\partial p}{\partial\phi}"),
]


@pytest.mark.sampled(8)
@pytest.mark.parametrize(("stated", "slope"), [*IN_TEXT, *IN_LATEX])
def test_a_defined_quantity_is_called_and_differentiated_by_its_coordinate(stated: str, slope: str) -> None:
    written = (LATEX if "\\" in slope else PLAIN).format(stated=stated, slope=slope)
    if stated.startswith("h"):
        written = written.replace("-m g p", "-m g h")
    verdict = hatch().check(written)
    assert verdict.right, verdict.to_text()
    for now, wrong in (
        ("+ 2 r e", "- 2 r e"),
        ("+2re", "-2re"),
        ("= r e cos", "= 2 r e cos"),
        (r"{r e\cos", r"{2r e\cos"),
        (f"= {slope}", f"= 2 {slope}"),
        ("- mgw", "+ mgw"),
        ("- m g w", "+ m g w"),
    ):
        assert now not in written or not hatch().check(written.replace(now, wrong), hint=0).right, now


@pytest.mark.parametrize("other", ["p", "-p"])
def test_only_the_line_that_is_wrong_is_called_so(other: str) -> None:
    written = PLAIN.format(stated=STATED[0], slope="dp/dphi").replace(
        "V = -m g p\n", f"V = -m g p(phi)\nXi = k {other}'\n"
    )
    found = {f.line.number: f.status.right for f in hatch().check(written, hint=0).findings}
    assert found[2] and found[4]
    assert [n for n, right in found.items() if not right][:1] == [5]


def test_a_product_in_brackets_stays_one() -> None:
    """No line states p(φ), so that p (φ) is a product, and no height."""
    written = PLAIN.format(stated="h = 0", slope="dp/dphi")
    assert not hatch().check(written.replace("V = -m g p", "V = -m g p(phi)"), hint=0).right


RATE = """T = 1/2 I phi'^2 + 1/2 m p'^2
V = -m g p
p' = {rate}
T = 1/2 (I + m w^2) phi'^2 with w = {slope}
"""


@pytest.mark.slow
def test_a_position_that_a_right_line_shows_is_not_blamed_for_a_rate() -> None:
    """V has p as it is: only the rate has the ½."""
    slope = "r e cos(phi)/(2 p)"
    verdict = hatch().check(RATE.format(rate=f"{slope} phi'", slope=slope))
    (mistake,) = verdict.mistakes
    said = "Line 3 is not right: the rate of p is e*r*cos(phi)*phi'/p, not e*r*cos(phi)*phi'/(2*p)."
    assert str(mistake.what) == said
    slope = "r e cos(phi)/p"
    assert not hatch().check(RATE.format(rate=f"{slope} phi'", slope=slope)).mistakes


RELATION = """p^2 = {square}
2 p p' = {rate}
T = 1/2 I phi'^2 + 1/2 m p'^2
(I + m (r e cos(phi)/p)^2) phi'' = {moment}
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("square", "said"),
    [
        ("r^2 + e^2 - 2 r e sin(phi)", "2*e*r*sin(phi) has the wrong sign"),
        ("r^2 + e^2 + r e sin(phi)", "e*r*sin(phi) should be 2*e*r*sin(phi)"),
        ("r^2 - e^2 + 2 r e sin(phi)", "e^2 has the wrong sign"),
    ],
)
def test_the_term_that_is_wrong_in_a_relation_is_named(square: str, said: str) -> None:
    verdict = hatch().check(RELATION.format(square=square, rate="-2 r e cos(phi) phi'", moment="-m g r"))
    assert not verdict.right
    assert [str(m.what) for m in verdict.mistakes] == [f"In line 1, {said}."]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("square", ["r^2 + e^2 + 3 r e sin(phi)", "r^2 - e^2 - 2 r e sin(phi)", "r^2 + e^2"])
def test_nothing_is_named_in_a_relation_that_no_one_term_mends(square: str) -> None:
    verdict = hatch().check(RELATION.format(square=square, rate="-2 r e cos(phi) phi'", moment="-m g r"))
    assert not verdict.right and not any("line 1" in str(m.what) for m in verdict.mistakes)
