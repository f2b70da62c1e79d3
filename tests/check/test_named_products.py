"""Products of a matrix and a column that an answer gives as a whole: C(q, q') q' = [a; b], and M q'' + C q' + G = Q.

Oracle: the equations of the cart with a pole. Every form has a wrong twin.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError

MASSES = "M(q) = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2]"
SPEEDS = "[-m*l*sin(theta)*theta'^2; 0]"
REST = "G = [0; -m*g*l*sin(theta)]\nQ = [F - b*x'; 0]"
LATEX = r"""$$M\ddot q + C(q, \dot q)\dot q + G = Q$$
$$M = \begin{bmatrix} M+m & ml\cos\theta\\ ml\cos\theta & J+ml^2\end{bmatrix}$$
$$C(q,\dot q)\dot q = \begin{bmatrix} -ml\sin\theta\,\dot\theta^2\\0\end{bmatrix}$$
$$G = \begin{pmatrix}0\\-mgl\sin\theta\end{pmatrix}, \quad Q=\begin{pmatrix}F-b\dot x\\0\end{pmatrix}$$
"""
FORMS = {
    "product": f"q = (x, theta)\n{MASSES}\nC(q,q')*q' = {SPEEDS}\n{REST}\nM*q'' + C*q' + G = Q",
    "below": f"M q'' + C(q,q') q' + G = Q with\n{MASSES}\nC(q,q') q' = {SPEEDS}\n{REST}",
    "spelled out": f"{MASSES}\nC(q, qdot) qdot = {SPEEDS}\n{REST}\nM(q) qddot + C(q, qdot) qdot + G = Q",
    "named too": f"{MASSES}\nh = C(q,q')*q' = {SPEEDS}\n{REST}\nM*q'' + h + G = Q",
    "masses too": "M(q) q'' = [(M + m) x'' + m*l*cos(theta) theta''; m*l*cos(theta) x'' + (J + m*l^2) theta'']\n"
    f"C(q,q') q' = {SPEEDS}\nG = [0; -m*g*l*sin(theta)]\nD q' = [b x'; 0]\nM q'' + C q' + D q' + G = [F; 0]",
    "unused": f"C(q,q') q' = {SPEEDS}\n(M + m) x'' + m l cos(theta) theta'' - m l sin(theta) theta'^2 = F - b x'\n"
    "m l cos(theta) x'' + (J + m l^2) theta'' - m g l sin(theta) = 0",
    "latex": LATEX,
}


def right(written: str) -> bool:
    """Whether an answer is right; one that is refused is not."""
    try:
        return derivation("cart-pole").check(written, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", FORMS)
def test_a_product_with_a_column_is_given_as_a_whole(form: str) -> None:
    written = FORMS[form]
    assert right(written)
    speeds, others = ("-ml\\sin", "ml\\sin") if form == "latex" else (SPEEDS, SPEEDS.replace("-", ""))
    assert speeds in written
    assert form == "unused" or not right(written.replace(speeds, others))
    gravity = ("-mgl", "mgl") if form == "latex" else ("-m*g*l", "m*g*l") if form != "unused" else ("- m g", "+ m g")
    assert gravity[0] in written
    assert not right(written.replace(*gravity))


def test_a_factor_of_the_product_counts() -> None:
    written = FORMS["product"]
    assert not right(written.replace("C*q' + G", "2*C*q' + G"))
    half = written.replace(SPEEDS, SPEEDS.replace("m*l*sin", "m*l/2*sin"))
    assert not right(half)
    assert right(half.replace("C*q' + G", "2*C*q' + G"))


def test_what_no_line_gives_is_no_product() -> None:
    assert not right("A q'' = [F - b*x' + m*l*sin(theta)*theta'^2; m*g*l*sin(theta)]")
    assert not right(f"q = (x, theta)\n{MASSES}\n{REST}\nM*q'' + C*q' + G = Q")
