"""Tables of Markdown whose cells hold values alone are read: what stands in front and above says of what.

Oracle: the energies, derivatives and forces of the cart with a pole. Every table has a wrong twin.
"""

import pytest

from built_in import derivation
from student_answers import CART, POLE, right

ENERGIES = """\
| what | value |
|---|---|
| T | `1/2 (M + m) x'^2 + m l x' theta' cos theta + 1/2 (J + m l^2) theta'^2` |
| V | m g l cos theta |
| Q_x | F - b x' |
| Q_theta | 0 |
"""
BY_COORDINATE = """\
| q | ∂T/∂q̇ | d/dt | ∂V/∂q | Q |
|:--|---|---|---|--:|
| x | (M + m) ẋ + m l θ̇ cos θ | (M + m) ẍ + m l θ̈ cos θ - m l θ̇² sin θ | – | F - b ẋ |
| θ | (J + m l²) θ̇ + m l ẋ cos θ | (J + m l²) θ̈ + m l ẍ cos θ - m l ẋ θ̇ sin θ | -m g l sin θ | 0 |
"""
BY_QUANTITY = r"""
| | $x$ | $\theta$ |
|---|---|---|
| $\partial T/\partial\dot q$ | $(M+m)\dot x+ml\dot\theta\cos\theta$ | $(J+ml^2)\dot\theta+ml\dot x\cos\theta$ |
| $\partial V/\partial q$ | 0 | $-mgl\sin\theta$ |
| $Q_q$ | $F - b\dot x$ | 0 |
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("table", "was", "now"),
    [
        (ENERGIES, "1/2 (J", "1/3 (J"),
        (ENERGIES, "F - b", "F + b"),
        (BY_COORDINATE, "- m l θ̇²", "+ m l θ̇²"),
        (BY_COORDINATE, "F - b", "F + b"),
        (BY_QUANTITY, "-mgl", "mgl"),
        (BY_QUANTITY, "F - b", "F + b"),
    ],
)
def test_the_cells_of_a_table_are_judged(table: str, was: str, now: str) -> None:
    energies = "T = 1/2 (M + m) x'^2 + m l x' theta' cos theta + 1/2 (J + m l^2) theta'^2\nV = m g l cos theta\n"
    sheet = f"{'' if table is ENERGIES else energies}\n{table}\n{CART}\n{POLE}"
    assert was in table
    assert right(sheet)
    assert not right(sheet.replace(table, table.replace(was, now)))


PARTS = """\
| part | kinetic | potential |
|:--|:--|:--|
| cart | 1/2 M x'^2 | – |
| pole | 1/2 m (x'^2 + 2 l x' theta' cos theta + l^2 theta'^2) + (1/2) J theta'^2 | m g l cos theta |
"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "head", ["kinetic | potential", "Kinetic energy T | Potential energy V", "T | V", "E_kin [J] | E_pot [J]"]
)
def test_a_table_with_columns_for_the_kinds_of_energies_states_parts(head: str) -> None:
    table = PARTS.replace("kinetic | potential", head)
    assert right(f"{table}\n{CART}\n{POLE}")
    for was, now in (
        ("1/2 M", "1/3 M"),
        ("| m g l cos", "| m g l sin"),
        ("(1/2) J", "(1/3) J"),
        ("+ 2 l x'", "- 2 l x'"),
    ):
        assert was in table
        assert not right(f"{table.replace(was, now)}\n{CART}\n{POLE}")


def test_a_row_of_sums_states_the_whole_energies() -> None:
    whole = "1/2 (M + m) x'^2 + m l x' theta' cos theta + 1/2 (J + m l^2) theta'^2"
    table = f"{PARTS}| total | {whole} | m g l cos theta |\n"
    assert right(f"{table}\n{CART}\n{POLE}")
    assert not right(f"{table.replace('1/2 (J', '1/3 (J')}\n{CART}\n{POLE}")


MATRIX = """\
| | x | θ |
|---|---|---|
| x | M + m | m l cos θ |
| θ | m l cos θ | J + m l² |
"""
COLUMN = "- h_x = b x' - m l θ'² sin θ\n- h_θ = - m l g sin θ\n"
NAMED = "M(q) q'' + h(q, q') = Q\n\n**M**\n\n{matrix}\n**h**\n\n{column}\n**Q**\n\n- Q_x = F\n- Q_θ = 0\n"
HEADS = MATRIX.replace("| | x | θ |", "| | x'' | θ'' |")
FORMS = {
    "a heading": NAMED.format(matrix=MATRIX, column=COLUMN),
    "words": NAMED.format(matrix=MATRIX, column=COLUMN).replace("**M**", "Here is the mass matrix M(q):"),
    "the corner": NAMED.format(matrix=MATRIX.replace("| | x", "| **M** | x"), column=COLUMN).replace("**M**", ""),
    "accelerations": NAMED.format(matrix=HEADS, column=COLUMN).replace("**M**", ""),
    "coefficients": NAMED.format(matrix=HEADS.replace("| x'' | θ''", "| coefficient of x'' | × θ''"), column=COLUMN),
    "capital Xi": NAMED.format(matrix=HEADS, column=COLUMN).replace("**M**", "").replace("Q", "Ξ"),
    "another order": "q = (θ, x)ᵀ\n\n"
    + NAMED.format(
        matrix="| | θ | x |\n|---|---|---|\n| eq. x | m l cos θ | M + m |\n| eq. θ | J + m l² | m l cos θ |\n",
        column=COLUMN,
    ),
    "no heads": NAMED.format(
        matrix="| | |\n|---|---|\n| M + m | m l cos θ |\n| m l cos θ | J + m l² |\n", column=COLUMN
    ),
    "first row as head": NAMED.format(
        matrix="| M + m | m l cos θ |\n|---|---|\n| m l cos θ | J + m l² |\n", column=COLUMN
    ),
    "listed by coordinates": NAMED.format(matrix=MATRIX, column=COLUMN.replace("h_x =", "x:").replace("h_θ =", "θ:")),
    "listed in order": NAMED.format(matrix=MATRIX, column=COLUMN.replace("- h_x =", "1.").replace("- h_θ =", "2.")),
    "column as a table": NAMED.format(
        matrix=MATRIX, column="| | h |\n|---|---|\n| x | b x' - m l θ'² sin θ |\n| θ | - m l g sin θ |\n"
    ),
    "column as a row": NAMED.format(
        matrix=MATRIX, column="| | x | θ |\n|---|---|---|\n| h | b x' - m l θ'² sin θ | - m l g sin θ |\n"
    ),
    "equations": "| | x'' | θ'' | rest | = right side |\n|---|---|---|---|---|\n"
    "| cart | M + m | m l cos θ | b x' - m l θ'² sin θ | F |\n| pole | m l cos θ | J + m l² | - m l g sin θ | 0 |\n",
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", FORMS)
def test_rows_and_columns_that_stand_for_coordinates(form: str) -> None:
    assert right(FORMS[form])
    for was, now in (("J + m l²", "J - m l²"), ("- m l θ'²", "+ m l θ'²"), ("| M + m", "| M"), ("l g sin", "l g cos")):
        assert not right(FORMS[form].replace(was, now)) or was not in FORMS[form]


def test_such_a_table_in_latex() -> None:
    sheet = r"""$\mathbf M\ddot{\mathbf q} + \mathbf h = \mathbf f$ with $\mathbf q = (\theta, x)^T$.

| **M** | $\theta$ | $x$ |
|---|---|---|
| $\theta$ | $J + m l^2$ | $m l\cos\theta$ |
| $x$ | $m l\cos\theta$ | $M + m$ |

- $h_\theta = -m g l\sin\theta$
- $h_x = b\dot x - m l\dot\theta^2\sin\theta$
- $f_\theta = 0$, $f_x = F$
"""
    assert right(sheet)
    for was, now in (("J + m l^2", "J"), ("$M + m$", "$M$"), ("= -m g l", "= m g l"), ("(\\theta, x)", "(x, \\theta)")):
        assert was in sheet
        assert right(sheet.replace(was, now)) == (was[0] == "(")  # the entries are named by their coordinates


def test_a_table_of_something_else_is_no_matrix() -> None:
    told = MATRIX.replace("M + m", "2").replace("J + m l²", "3")
    assert right(f"How often each term was checked:\n\n{told}\n{CART}\n{POLE}")


def test_accelerations_alone_above_columns_are_no_equations() -> None:
    verdict = derivation("cart-pole").check(f"{HEADS}\n{CART}\n{POLE}")
    assert verdict.right or all(f.status.right for f in verdict.findings)
    assert not derivation("cart-pole").check(f"{HEADS}\n{CART}\n{POLE}".replace("b x'", "2 b x'")).right
