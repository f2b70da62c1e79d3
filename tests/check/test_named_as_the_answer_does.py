"""What is told has the names of the answer, is said once, and advises what fits.

Oracle: by hand. A tray m slides along a radius r of a dial (J) that turns with ψ, with a motor M on the dial, a damper
on the tray and one in the bearing:

    m r̈ − m r ψ̇² = −b ṙ,     (J + m r²) ψ̈ + 2 m r ṙ ψ̇ = M − c ψ̇
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import Derivation, System


@cache
def dial() -> Derivation:
    """A tray that slides on a dial."""
    sys = System("dial")
    r, psi = sys.coordinates("r psi")
    m, J, b, c = sys.parameters("m J b c")
    M = sys.inputs("M")
    turned = sys.frame(psi, name="dial")
    sys.rigid_body(0, J, at=sys.origin, frame=turned, name="dial")
    sys.particle(m, at=turned.point(r, 0), name="tray")
    sys.damper(b, deflection=r, name="guide")
    sys.damper(c, deflection=psi, name="bearing")
    sys.torque(M, on=psi, name="motor")
    return sys.derive()


T = "T = 1/2 m (r'^2 + r^2 psi'^2) + 1/2 J psi'^2\n"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("radial", "turning", "told"),
    [
        ("Q_r", "Q_psi", "Torque 'motor' is counted in Q_r in place of Q_psi."),
        ("Xi_r", "Xi_psi", "Torque 'motor' is counted in Xi_r in place of Xi_psi."),
        ("Q_1", "Q_2", "Torque 'motor' is counted in the Ξ of r in place of the Ξ of psi."),
    ],
)
def test_forces_have_the_names_of_the_answer(radial: str, turning: str, told: str) -> None:
    assert dial().check(f"{T}{radial} = -b r'\n{turning} = M - c psi'").right
    verdict = dial().check(f"{T}{radial} = M - b r'\n{turning} = -c psi'")
    assert [str(m.what) for m in verdict.mistakes] == [told]
    assert "It could also be this" not in verdict.to_text()


def test_a_missing_inertia_is_sought_among_bodies() -> None:
    rows = "m r'' - m r psi'^2 = -b r'\n(J + m r^2) psi'' + 2 m r r' psi' = M - c psi'"
    assert dial().check(rows).right
    [mistake] = dial().check(rows.replace("(J + m r^2)", "m r^2")).mistakes
    assert "springs" not in str(mistake.why), mistake.why


@pytest.mark.parametrize(
    ("line", "note"),
    [
        ("\\[ \\mathbf v = \\dot r \\mathbf e_1 + r \\dot\\psi \\mathbf e_2 \\]", "it is a vector"),
        ("d/dt(∂T/∂q') − ∂T/∂q + ∂V/∂q + ∂D/∂q' = Q", "it is a general form"),
    ],
)
def test_why_a_line_is_not_judged_is_true(line: str, note: str) -> None:
    rows = "m r'' - m r psi'^2 = -b r'\n(J + m r^2) psi'' + 2 m r r' psi' = M - c psi'"
    verdict = dial().check(f"{line}\n{rows}")
    assert verdict.right and any(str(n).endswith(f"was not judged: {note}.") for n in verdict.notes), verdict.notes


def test_words_and_differentials_are_no_products() -> None:
    rows = "m r'' - m r psi'^2 = -b r'\n(J + m r^2) psi'' + 2 m r r' psi' = M - c psi'"
    verdict = dial().check(f"The dial turns freely (with w = const).\n{rows}")
    assert verdict.right and not any("Products" in str(n) for n in verdict.notes), verdict.notes


@cache
def derrick() -> Derivation:
    """A boom with a load at its end, on a damper."""
    sys = System("derrick")
    phi = sys.coordinates("phi")
    m, l, M, c, g = sys.parameters("m l M c g")
    sys.rigid_body(m, m * l**2 / 12, at=sys.point("G", (l / 2 * cos(phi), l / 2 * sin(phi))), frame=sys.frame(phi))
    sys.particle(M, at=sys.point("L", (l * cos(phi), l * sin(phi))), name="load")
    sys.damper(c, deflection=phi, name="brake")
    sys.gravity((0, -1), g)
    return sys.derive()


def test_no_height_is_blamed_of_a_weight_that_is_missing() -> None:
    energies = "T = m l^2 phi'^2/6 + M l^2 phi'^2/2\nV = m g l/2 sin(phi){}\nQ_phi = -c phi'"
    assert derrick().check(energies.format(" + M g l sin(phi)")).right
    verdict = derrick().check(energies.format(""))
    assert str(verdict.mistakes[0].what) == "The weight of particle 'load' is missing in V."
    assert "height of particle" not in verdict.to_text()


def test_a_coordinate_has_one_letter_on_a_page() -> None:
    """The titles of lines, the equations and the mistakes call it the same, also in a class."""
    answer = f"{T}Xi_1 = M - b r'\nXi_2 = -c psi'"
    page = dial().check(answer).to_text()
    assert "(Ξ of ψ)" in page and "the Ξ of ψ" in page and "psi" not in page and "Ξ₁" not in page and "Xi" not in page
    found = dial().check_class({"ann": answer})
    told = "".join(c.sentence for c in found.statistics) + "".join(found.rows[0].comment)
    assert "the Ξ of psi" in told and "Xi" not in told
