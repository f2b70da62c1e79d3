"""L is a length of the answer's own, and dL/dθ its slope, where their values are made of lengths and angles."""

import pytest
from hatches import hatch

MASS = "(m a^2 + Jd b^2 (1 - sin θ)/(2 r^2)) θ'' - Jd b^2/(4 r^2) cos θ θ'^2 - m g a sin θ + c θ'"
ROW = f"{MASS} = - τ b cos(θ/2 + π/4)/r"
USED = """dL/dθ = b cos(θ/2 + π/4)
(m a^2 + Jd/r^2 (dL/dθ)^2) θ'' - Jd b^2/(4 r^2) cos θ θ'^2 - m g a sin θ + c θ' = - τ/r (dL/dθ)
"""
ROOT = f"""L^2 = 2 b^2 (1 + sin θ), so L = b sqrt(2 + 2 sin θ)
dL/dθ = b^2 cos θ/L
T = 1/2 m a^2 θ'^2 + 1/2 Jd/r^2 (dL/dθ)^2 θ'^2
V = m g a cos θ
{MASS} = - τ/r b^2 (cos θ)/L
"""
NAMED = r"""Let $L_1 = \frac{dL}{d\theta} = b\cos(\pi/4+\theta/2)$ and
$L_2 = \frac{d^2L}{d\theta^2} = -\frac{b}{2}\sin(\pi/4+\theta/2)$.
\[ ma^2\ddot\theta + \frac{J_d}{r^2}L_1(L_1\ddot\theta+L_2\dot\theta^2) + c\dot\theta - mga\sin\theta
 = -\frac{\tau}{r}L_1 \]
"""
UPRIGHT = r"""\[ L = b\sqrt{2(1+\sin\theta)}, \qquad \frac{\mathrm dL}{\mathrm d\theta} = \frac{b^2\cos\theta}{L} \]
\[ \left(ma^2 + \frac{J_db^2(1-\sin\theta)}{2r^2}\right)\ddot\theta - \frac{J_db^2\cos\theta}{4r^2}\dot\theta^2
 - mga\sin\theta + c\dot\theta = -\frac{\tau b^2\cos\theta}{rL} \]
"""
LAGRANGIAN = f"""T = 1/2 m a^2 θ'^2 + Jd b^2 (1 - sin θ) θ'^2/(4 r^2)
V = m g a cos θ
dL/dθ = m g a sin θ - Jd b^2 cos θ θ'^2/(4 r^2)
{ROW}
"""
ANSWERS = {
    USED: True,
    USED.replace("= b cos(θ/2 + π/4)", "= b cos θ"): False,
    ROOT: True,
    ROOT.replace("= b^2 cos θ/L", "= 2 b^2 cos θ/L"): False,
    ROOT.replace("1 + sin θ", "1 - sin θ").replace("2 + 2 sin", "2 - 2 sin"): False,
    NAMED: True,
    NAMED.replace(r"-\frac{b}{2}", r"\frac{b}{2}"): False,
    UPRIGHT: True,
    UPRIGHT.replace(r"2(1+\sin\theta)", r"2(1-\sin\theta)"): False,
    LAGRANGIAN: True,
    LAGRANGIAN.replace("dL/dθ = m g a sin θ", "dL/dθ = m g a cos θ"): False,
    LAGRANGIAN.replace("dL/dθ = m g a sin θ - Jd b^2 cos θ θ'^2/(4 r^2)", "dL/dθ = a sin θ"): False,
    f"L = T - V\ndL/dθ = a sin θ\n{ROW}": False,
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["s", "L"])
@pytest.mark.parametrize(("answer", "right"), ANSWERS.items())
def test_a_slope_of_lengths_is_that_of_a_length(name: str, answer: str, right: bool) -> None:
    verdict = hatch(name).check(answer)
    wrong = [f for f in verdict.findings if not f.status.right]
    assert (verdict.right and not wrong) == right, str(verdict)


def test_the_reading_is_told_and_no_energy_is_spoken_of() -> None:
    verdict = hatch("s").check(ROOT)
    assert "L was read as a length, not as the Lagrangian." in str(verdict)
    slope = next(f for f in verdict.findings if f.line.number == 2)
    assert slope.status.right
    assert "energies" not in str(slope.note)


@pytest.mark.parametrize("text", [LAGRANGIAN, LAGRANGIAN.replace("m g a sin θ - Jd", "m g a cos θ - Jd")])
def test_a_slope_with_a_weight_is_that_of_the_lagrangian(text: str) -> None:
    verdict = hatch("s").check(text)
    slope = next(f for f in verdict.findings if f.line.number == 3)
    assert slope.line.kind == "slope"
    assert slope.status.right == (text == LAGRANGIAN)
